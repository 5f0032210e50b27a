#include "exact/ball_eigenvalues.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "exact/ball_internal.h"

static bool values(nh_ball *ball, size_t n, const nh_ex *e, arb_mat_t out)
{
    bool good = true;
    for (size_t i = 0; i < n * n && good; i++)
        good = nh_ball_eval(ball, e[i], arb_mat_entry(out, (slong)(i / n), (slong)(i % n)));
    return good;
}

/* M^-1 K */
static bool quotient(nh_ball *ball, size_t n, const nh_ex *M, const nh_ex *K, acb_mat_t out)
{
    arb_mat_t left, right, both;
    arb_mat_init(left, (slong)n, (slong)n);
    arb_mat_init(right, (slong)n, (slong)n);
    arb_mat_init(both, (slong)n, (slong)n);
    bool good =
        values(ball, n, M, left) && values(ball, n, K, right) && arb_mat_solve(both, left, right, nh_ball_bits(ball));
    if (good) acb_mat_set_arb_mat(out, both);
    arb_mat_clear(both);
    arb_mat_clear(right);
    arb_mat_clear(left);
    return good;
}

/* As a double, with a bound of its error, the rounding included. */
static double middle(const arb_t x, double *error)
{
    double value = arf_get_d(arb_midref(x), ARF_RND_NEAR), radius = mag_get_d(arb_radref(x));
    *error = fmax(*error, radius + ldexp(fabs(value), -52));
    return value;
}

bool nh_ball_eigenvalue_roots(nh_ball *ball, size_t n, const nh_ex *M, const nh_ex *K, double *re, double *im,
                              double *error)
{
    acb_mat_t A, vectors;
    acb_ptr near = _acb_vec_init((slong)n), value = _acb_vec_init((slong)n);
    long bits = nh_ball_bits(ball);
    acb_mat_init(A, (slong)n, (slong)n);
    acb_mat_init(vectors, (slong)n, (slong)n);
    bool good = quotient(ball, n, M, K, A);
    if (good) acb_mat_approx_eig_qr(near, NULL, vectors, A, NULL, 0, bits);
    good = good && acb_mat_eig_simple(value, NULL, NULL, A, near, vectors, bits);
    *error = 0;
    for (size_t i = 0; i < n && good; i++) {
        good = !acb_contains_zero(value + i);
        bool left = arf_sgn(arb_midref(acb_realref(value + i))) < 0; /* away from the branch cut of the root */
        if (left) acb_neg(value + i, value + i);
        acb_sqrt(value + i, value + i, bits);
        if (left) acb_mul_onei(value + i, value + i);
        re[i] = middle(acb_realref(value + i), error);
        im[i] = middle(acb_imagref(value + i), error);
    }
    acb_mat_clear(vectors);
    acb_mat_clear(A);
    _acb_vec_clear(value, (slong)n);
    _acb_vec_clear(near, (slong)n);
    return good && isfinite(*error);
}

/* as a part of the largest: equal eigenvalues, of so many bits, are nearer */
static const double equal = 1e-9;

/* Eigenvalues nearer to each other than `equal` times the largest become their mean. */
static void join_equal(size_t n, double *re, double *im)
{
    double *mean = nh_alloc_array(2 * n + 1, sizeof *mean), largest = 0;
    for (size_t k = 0; k < n; k++) largest = fmax(largest, hypot(re[k], im[k]));
    for (size_t k = 0; k < n; k++) {
        double count = 0;
        for (size_t j = 0; j < n; j++) {
            if (hypot(re[j] - re[k], im[j] - im[k]) > equal * largest) continue;
            count++;
            mean[k] += re[j];
            mean[n + k] += im[j];
        }
        mean[k] /= count;
        mean[n + k] /= count;
    }
    memcpy(re, mean, n * sizeof *re);
    memcpy(im, mean + n, n * sizeof *im);
    nh_free(mean);
}

bool nh_ball_eigenvalues(nh_ball *ball, size_t n, const nh_ex *A, double *re, double *im)
{
    arb_mat_t entries;
    acb_mat_t matrix;
    acb_ptr value = _acb_vec_init((slong)n);
    double error = 0;
    arb_mat_init(entries, (slong)n, (slong)n);
    acb_mat_init(matrix, (slong)n, (slong)n);
    bool good = values(ball, n, A, entries);
    if (good) {
        acb_mat_set_arb_mat(matrix, entries);
        acb_mat_approx_eig_qr(value, NULL, NULL, matrix, NULL, 0, nh_ball_bits(ball));
    }
    for (size_t i = 0; i < n && good; i++) good = acb_is_finite(value + i);
    for (size_t i = 0; i < n && good; i++) {
        re[i] = middle(acb_realref(value + i), &error);
        im[i] = middle(acb_imagref(value + i), &error);
    }
    if (good) join_equal(n, re, im);
    acb_mat_clear(matrix);
    arb_mat_clear(entries);
    _acb_vec_clear(value, (slong)n);
    return good;
}
