/* The dense linear algebra: every decomposition is multiplied out again, or compared with a second way to the same numbers. */
#include <criterion/criterion.h>
#include <float.h>
#include <math.h>
#include <string.h>
#include <unistd.h>

#include "base/linalg.h"
#include "base/parallel.h"
#include "base/memory.h"
#include "base/progress.h"
#include "base/saddle.h"

extern int openblas_get_num_threads(void) __attribute__((weak));

static unsigned long long state = 2385;

static double uniform(void)
{
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(state >> 11) / 4503599627370496.0 - 1;
}

static double *random_matrix(size_t m, size_t n)
{
    double *a = nh_alloc_array(m * n, sizeof *a);
    for (size_t i = 0; i < m * n; i++)
        a[i] = uniform();
    return a;
}

static double *copy_of(size_t count, const double *a)
{
    double *b = nh_alloc_array(count, sizeof *b);
    memcpy(b, a, count * sizeof *b);
    return b;
}

static double distance(size_t count, const double *a, const double *b)
{
    double largest = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(a[i] - b[i]));
    return largest;
}

/* a^T b by the definition; a: m x p, b: m x q. */
static double *gram(size_t m, size_t p, size_t q, const double *a, const double *b)
{
    double *c = nh_alloc_array(p * q, sizeof *c);
    for (size_t i = 0; i < p; i++)
        for (size_t j = 0; j < q; j++)
            for (size_t k = 0; k < m; k++)
                c[i + j * p] += a[k + i * m] * b[k + j * m];
    return c;
}

static void check_below_diagonal(size_t n, const double *r)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = j + 1; i < n; i++)
            cr_assert_eq(r[i + j * n], 0, "r(%zu, %zu) = %g", i, j, r[i + j * n]);
}

/* Feed the m x n matrix a in blocks of these sizes, cyclically. */
static double *streamed(size_t m, size_t n, const double *a, const size_t *sizes, size_t count)
{
    nh_qr *qr = nh_qr_create(n, 1);
    double *r = nh_alloc_array(n * n, sizeof *r), *b = copy_of(m * n, a);
    for (size_t done = 0, k = 0; done < m; k++) {
        size_t rows = sizes[k % count] < m - done ? sizes[k % count] : m - done;
        nh_qr_add(qr, rows, b + done, m);
        done += rows;
    }
    nh_qr_triangle(qr, r);
    cr_assert_eq(nh_qr_rows(qr), m);
    nh_qr_free(qr);
    nh_free(b);
    return r;
}

/* Rows of R are unique up to their sign: compare with a modified Gram-Schmidt, run twice for orthogonality. */
static double *gram_schmidt(size_t m, size_t n, const double *a)
{
    double *q = copy_of(m * n, a), *r = nh_alloc_array(n * n, sizeof *r);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < 2 * j; i++) {
            double product = 0;
            for (size_t k = 0; k < m; k++)
                product += q[k + (i % j) * m] * q[k + j * m];
            for (size_t k = 0; k < m; k++)
                q[k + j * m] -= product * q[k + (i % j) * m];
            r[i % j + j * n] += product;
        }
        double square = 0;
        for (size_t k = 0; k < m; k++)
            square += q[k + j * m] * q[k + j * m];
        r[j + j * n] = sqrt(square);
        for (size_t k = 0; k < m; k++)
            q[k + j * m] /= r[j + j * n];
    }
    nh_free(q);
    return r;
}

static void check_streaming(size_t m, size_t n)
{
    const size_t one[] = {m}, odd[] = {1, 7, 64, 13, 129}, single[] = {1};
    double *a = random_matrix(m, n);
    double *r1 = streamed(m, n, a, one, 1), *r2 = streamed(m, n, a, odd, 5), *r3 = streamed(m, n, a, single, 1);
    double *reference = gram_schmidt(m, n, a);
    check_below_diagonal(n, r1);
    cr_assert_eq(memcmp(r1, r2, n * n * sizeof *r1), 0, "%zu x %zu: the cut into blocks shows", m, n);
    cr_assert_eq(memcmp(r1, r3, n * n * sizeof *r1), 0, "%zu x %zu: the cut into rows shows", m, n);
    for (size_t i = 0; i < n; i++) {
        double sign = r1[i + i * n] < 0 ? -1 : 1;
        for (size_t j = i; j < n; j++)
            cr_assert_float_eq(sign * r1[i + j * n], reference[i + j * n], 1e-12, "%zu x %zu: r(%zu, %zu)", m, n, i, j);
    }
    nh_free(a);
    nh_free(r1);
    nh_free(r2);
    nh_free(r3);
    nh_free(reference);
}

Test(linalg, streaming_qr_is_the_qr_however_the_rows_are_cut)
{
    check_streaming(50, 1);
    check_streaming(317, 5);
    check_streaming(317, 23);
    check_streaming(500, 64);
    check_streaming(517, 67); /* two panels, the second incomplete */
    check_streaming(901, 150);
}

Test(linalg, streaming_qr_goes_on_after_a_look_at_the_triangle)
{
    enum { M = 90, N = 9 };
    double *a = random_matrix(M, N), *b = copy_of(M * N, a), r[N * N], early[N * N];
    nh_qr *qr = nh_qr_create(N, 1);
    nh_qr_add(qr, 31, b, M);
    nh_qr_triangle(qr, early);
    nh_qr_add(qr, M - 31, b + 31, M);
    nh_qr_triangle(qr, r);
    double *expected = gram(M, N, N, a, a), *got = gram(N, N, N, r, r);
    cr_assert_lt(distance(N * N, expected, got), 1e-12);
    cr_assert_gt(distance(N * N, r, early), 0.1);
    nh_qr_free(qr);
    nh_free(a);
    nh_free(b);
    nh_free(expected);
    nh_free(got);
}

Test(linalg, streaming_qr_beside_the_caller_gives_the_same_triangle)
{
    enum { M = 1501, N = 150 };
    double *a = random_matrix(M, N), *one = streamed(M, N, a, (const size_t[]){64}, 1), *r = nh_alloc_array(N * N, sizeof *r);
    nh_qr *qr = nh_qr_create(N, 2);
    for (int again = 0; again < 2; again++) { /* the second time after rows that are forgotten while they are on their way */
        double *b = copy_of(M * N, a);
        nh_qr_reset(qr);
        for (size_t done = 0; done < M; done += 100) nh_qr_add(qr, M - done < 100 ? M - done : 100, b + done, M);
        nh_free(b);
        if (again) nh_qr_triangle(qr, r);
    }
    cr_assert_eq(nh_qr_rows(qr), M);
    cr_assert_eq(memcmp(one, r, N * N * sizeof *r), 0);
    nh_qr_free(qr);
    nh_free(a);
    nh_free(one);
    nh_free(r);
}

Test(linalg, streaming_qr_with_fewer_rows_than_columns_keeps_the_gram_matrix)
{
    enum { M = 4, N = 11 };
    const size_t odd[] = {3, 1};
    double *a = random_matrix(M, N), *r = streamed(M, N, a, odd, 2);
    double *expected = gram(M, N, N, a, a), *got = gram(N, N, N, r, r);
    check_below_diagonal(N, r);
    cr_assert_lt(distance(N * N, expected, got), 1e-13);
    nh_free(a);
    nh_free(r);
    nh_free(expected);
    nh_free(got);
}

Test(linalg, streaming_qr_does_not_lose_small_columns)
{
    enum { M = 200, N = 40 };
    const size_t odd[] = {17};
    double *a = random_matrix(M, N);
    for (size_t i = 0; i < M * N; i++)
        a[i] *= pow(10, -(double)(i / M % 30));
    double *r = streamed(M, N, a, odd, 1), *reference = gram_schmidt(M, N, a);
    for (size_t j = 0; j < N; j++) /* relative to its own column */
        cr_assert_float_eq(fabs(r[j + j * N]) / reference[j + j * N], 1, 1e-13, "pivot %zu", j);
    nh_free(a);
    nh_free(r);
    nh_free(reference);
}

static void check_svd(size_t m, size_t n)
{
    size_t k = m < n ? m : n;
    double *a = random_matrix(m, n), *u = random_matrix(m, k), *vt = random_matrix(k, n), *s = random_matrix(k, 1);
    double *b = copy_of(m * n, a), *only = random_matrix(k, 1), *sum = nh_alloc_array(m * n, sizeof *sum);
    cr_assert(nh_svd(m, n, b, s, u, vt));
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++)
            for (size_t l = 0; l < k; l++)
                sum[i + j * m] += u[i + l * m] * s[l] * vt[l + j * k];
    cr_assert_lt(distance(m * n, a, sum), 1e-13, "%zu x %zu", m, n);
    double *orthogonal = gram(m, k, k, u, u);
    for (size_t i = 0; i < k * k; i++)
        cr_assert_float_eq(orthogonal[i], i % (k + 1) == 0, 1e-13);
    for (size_t i = 1; i < k; i++)
        cr_assert(s[i] >= 0 && s[i] <= s[i - 1]);
    for (int which = 0; which < 3; which++) { /* none, left, right */
        memcpy(b, a, m * n * sizeof *a);
        cr_assert(nh_svd(m, n, b, only, which == 1 ? u : NULL, which == 2 ? vt : NULL));
        cr_assert_lt(distance(k, s, only), 1e-13);
    }
    nh_free(a);
    nh_free(u);
    nh_free(vt);
    nh_free(s);
    nh_free(b);
    nh_free(only);
    nh_free(sum);
    nh_free(orthogonal);
}

Test(linalg, svd_multiplies_out)
{
    check_svd(1, 1);
    check_svd(30, 7);
    check_svd(7, 30);
    check_svd(19, 19);
}

Test(linalg, what_is_not_finite_is_refused_and_does_not_hang)
{
    const double bad[] = {NAN, INFINITY, -INFINITY};
    for (size_t k = 0; k < 3; k++) {
        double a[9] = {1, 2, 3, 4, bad[k], 6, 7, 8, 9}, b[9] = {0}, s[3], im[3];
        cr_assert_not(nh_svd(3, 3, a, s, NULL, NULL));
        cr_assert_not(nh_eigen(3, a, s, im, NULL));
        cr_assert_not(nh_solve(3, a, 1, b, NULL));
        cr_assert_eq(nh_least_squares(3, 3, a, 1, b, 3, 1e-12), -1);
    }
}

Test(linalg, eigenvalues_of_a_companion_matrix_are_the_roots)
{
    /* (x - 2.385)(x + 0.7)(x^2 - 0.6 x + 1.3): 0.3 +- i 1.1 */
    const double root_re[] = {2.385, -0.7, 0.3, 0.3}, root_im[] = {0, 0, 1.1, -1.1};
    double p2 = -(2.385 - 0.7), p3 = 2.385 * -0.7; /* x^2 + p2 x + p3 */
    double c[4] = {p3 * 1.3, p2 * 1.3 - 0.6 * p3, 1.3 - 0.6 * p2 + p3, p2 - 0.6}, a[16] = {0}, re[4], im[4], v[16], b[16];
    for (size_t i = 0; i < 4; i++)
        a[i + 12] = -c[i];
    a[1] = a[6] = a[11] = 1;
    memcpy(b, a, sizeof b);
    cr_assert(nh_eigen(4, a, re, im, v));
    for (size_t k = 0; k < 4; k++) {
        double nearest = INFINITY;
        for (size_t j = 0; j < 4; j++)
            nearest = fmin(nearest, hypot(re[j] - root_re[k], im[j] - root_im[k]));
        cr_assert_lt(nearest, 1e-13, "root %zu is missing by %g", k, nearest);
        if (im[k] < 0)
            continue;
        const double *x = v + 4 * k, *y = im[k] > 0 ? x + 4 : NULL;
        for (size_t i = 0; i < 4; i++) { /* real part of a (x + i y) = (re + i im)(x + i y) */
            double sum = 0;
            for (size_t l = 0; l < 4; l++)
                sum += b[i + 4 * l] * x[l];
            cr_assert_float_eq(sum, re[k] * x[i] - (y ? im[k] * y[i] : 0), 1e-13);
        }
    }
}

Test(linalg, solve_satisfies_the_equations_and_tells_the_condition)
{
    enum { N = 12, RHS = 3 };
    double *a = random_matrix(N, N), *b = random_matrix(N, RHS), *lu = copy_of(N * N, a), *x = copy_of(N * RHS, b), product[N * RHS];
    double rcond = -1;
    cr_assert(nh_solve(N, lu, RHS, x, &rcond));
    nh_multiply(N, RHS, N, a, x, product);
    cr_assert_lt(distance(N * RHS, product, b), 1e-11);
    cr_assert(rcond > 1e-5 && rcond < 1);
    double diagonal[4] = {1, 0, 0, 1e-6}, one[2] = {1, 1}, singular[4] = {1, 2, 2, 4}, two[2] = {1, 1};
    cr_assert(nh_solve(2, diagonal, 1, one, &rcond));
    cr_assert_float_eq(rcond, 1e-6, 1e-12);
    cr_assert_float_eq(one[1], 1e6, 1e-6);
    double shear[4] = {1, 0, 7, 2}, three[2] = {1, 1}; /* in the 1-norm: |a| = 9, |a^-1| = 4 */
    cr_assert(nh_solve(2, shear, 1, three, &rcond));
    cr_assert_float_eq(rcond, 1 / 36., 1e-14);
    cr_assert_not(nh_solve(2, singular, 1, two, NULL));
    nh_free(a);
    nh_free(b);
    nh_free(lu);
    nh_free(x);
}

/* The minimiser has a residual orthogonal to the columns; the shortest one lies in the row space. */
static void check_least_squares(size_t m, size_t n, size_t rank)
{
    size_t ld = m > n ? m : n;
    double *left = random_matrix(m, rank), *right = random_matrix(rank, n), *a = random_matrix(m, n), *b = random_matrix(ld, 1);
    nh_multiply(m, n, rank, left, right, a);
    double *work = copy_of(m * n, a), *x = copy_of(ld, b), *residual = copy_of(m, b);
    cr_assert_eq(nh_least_squares(m, n, work, 1, x, ld, 1e-10), (int)rank);
    for (size_t i = 0; i < m; i++)
        for (size_t j = 0; j < n; j++)
            residual[i] -= a[i + j * m] * x[j];
    double *normal = gram(m, n, 1, a, residual);
    for (size_t j = 0; j < n; j++)
        cr_assert_float_eq(normal[j], 0, 1e-12, "%zu x %zu: normal equation %zu: %g", m, n, j, normal[j]);
    double *stacked = nh_alloc_array((rank + 1) * n, sizeof *stacked), s[64]; /* [right; x^T] has the rank of right */
    for (size_t j = 0; j < n; j++) {
        memcpy(stacked + j * (rank + 1), right + j * rank, rank * sizeof *right);
        stacked[rank + j * (rank + 1)] = x[j];
    }
    cr_assert(nh_svd(rank + 1, n, stacked, s, NULL, NULL));
    cr_assert(rank >= n || s[rank] < 1e-12, "%zu x %zu: not the shortest", m, n);
    nh_free(left);
    nh_free(right);
    nh_free(a);
    nh_free(b);
    nh_free(work);
    nh_free(x);
    nh_free(residual);
    nh_free(normal);
    nh_free(stacked);
}

Test(linalg, least_squares_is_the_shortest_minimiser)
{
    check_least_squares(20, 6, 6);
    check_least_squares(20, 6, 4);
    check_least_squares(5, 9, 5);
    check_least_squares(5, 9, 3);
}

Test(linalg, products_and_triangles)
{
    enum { M = 6, N = 5, K = 4 };
    double *a = random_matrix(M, K), *b = random_matrix(K, N), *r = random_matrix(K, K), c[M * N], expected[M * N] = {0};
    nh_multiply(M, N, K, a, b, c);
    for (size_t i = 0; i < M; i++)
        for (size_t j = 0; j < N; j++)
            for (size_t k = 0; k < K; k++)
                expected[i + j * M] += a[i + k * M] * b[k + j * K];
    cr_assert_lt(distance(M * N, c, expected), 1e-15);
    double upper[K * K] = {0}, product[M * N];
    for (size_t j = 0; j < K; j++)
        for (size_t i = 0; i <= j; i++)
            upper[i + j * K] = i == j ? 2 + r[i + j * K] : r[i + j * K];
    for (size_t j = 0; j < K; j++) /* what is below the diagonal must not be read */
        for (size_t i = 0; i <= j; i++)
            r[i + j * K] = upper[i + j * K];
    double *right = copy_of(M * K, a), *left = copy_of(K * N, b);
    nh_solve_triangle_right(M, K, r, K, right);
    nh_multiply(M, K, K, right, upper, product);
    cr_assert_lt(distance(M * K, product, a), 1e-14);
    nh_solve_triangle(K, N, r, K, left, K);
    nh_multiply(K, N, K, upper, left, product);
    cr_assert_lt(distance(K * N, product, b), 1e-14);
    nh_multiply(2, 2, 0, a, b, c);
    cr_assert(c[0] == 0 && c[1] == 0 && c[2] == 0 && c[3] == 0);
    nh_free(a);
    nh_free(b);
    nh_free(r);
    nh_free(right);
    nh_free(left);
}

Test(linalg, one_thread)
{
    nh_linalg_threads(1);
    cr_assert(!openblas_get_num_threads || openblas_get_num_threads() == 1);
}

/* Rows that depend on each other are harmless where they agree: the accelerations are those of the independent rows. */
Test(linalg, bordered_equations_with_rows_that_agree)
{
    enum { m = 3, k = 2 };
    static const double K[m * m] = {2, 0.5, 0, 0.5, 1, 0.2, 0, 0.2, 3}, h[m] = {1, -1, 0.5}, first[m] = {1, 2, -1};
    double F[k * m], g[k] = {0.6, 1.8}, work[(m + k) * (m + k + 4) + 1], a[m], one[m], rcond;
    for (size_t j = 0; j < m; j++) F[j * k] = first[j], F[1 + j * k] = 3 * first[j];
    cr_assert(nh_saddle_solve(m, 1, K, first, h, g, one, NULL, &rcond, work));
    cr_assert(nh_saddle_solve(m, k, K, F, h, g, a, NULL, &rcond, work));
    for (size_t j = 0; j < m; j++) cr_expect_float_eq(a[j], one[j], 1e-13, "%zu: %g", j, a[j] - one[j]);
    g[1] = 1.7;
    cr_expect(!nh_saddle_solve(m, k, K, F, h, g, a, NULL, &rcond, work), "rows that contradict each other");
    g[1] = 0;
    for (size_t j = 0; j < m; j++) F[1 + j * k] = 0;
    cr_expect(!nh_saddle_solve(m, k, K, F, h, g, a, NULL, &rcond, work), "a row of zeros");
}

/* [K F^T; F 0]: units of coordinates and constraints, powers of two here, change the solution by these factors and by no rounding, nor its condition;
 * the equations are satisfied, also by a K that is not positive or has a coordinate that only a constraint holds. */
Test(linalg, bordered_equations_do_not_depend_on_units)
{
    enum { m = 4, k = 2 };
    static const double metrics[][m * m] = {{4, 1, 0.5, 0.2, 1, 3, 0.3, -0.4, 0.5, 0.3, 2, 0.1, 0.2, -0.4, 0.1, 1}, /* positive */
                                            {0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 2, 0, 0, 2, 0.1},                      /* indefinite */
                                            {1, 0.2, 0, 0, 0.2, 2, 0, 0, 0, 0, 3, 0, 0, 0, 0, 0}};                   /* without inertia along the last */
    static const double F[k * m] = {1, 0, 0.3, 0.2, 0, 1, -0.7, 0.4}, h[m] = {1, -2, 0.5, 0.7}, g[k] = {0.3, -1}, none[k * m] = {0};
    static const int of_coordinate[m] = {-60, 41, 0, 17}, of_constraint[k] = {33, -28};
    double work[(m + k) * (m + k + 4) + 1], a[m], mu[k], rcond, K2[m * m], F2[k * m], h2[m], g2[k], a2[m], mu2[k], rcond2;
    cr_assert_leq(nh_saddle_work(m, k), sizeof work / sizeof *work);
    for (size_t which = 0; which < 3; which++) {
        const double *K = metrics[which];
        cr_assert(nh_saddle_solve(m, k, K, F, h, g, a, mu, &rcond, work) && rcond > 1e-3);
        for (size_t i = 0; i < m; i++) {
            double sum = h[i];
            for (size_t j = 0; j < m; j++) sum += K[i + j * m] * a[j];
            for (size_t c = 0; c < k; c++) sum += F[c + i * k] * mu[c];
            cr_expect_float_eq(sum, 0, 1e-14, "metric %zu, row %zu: %g", which, i, sum);
        }
        for (size_t c = 0; c < k; c++) {
            double sum = g[c];
            for (size_t j = 0; j < m; j++) sum += F[c + j * k] * a[j];
            cr_expect_float_eq(sum, 0, 1e-14, "metric %zu, constraint %zu: %g", which, c, sum);
        }
        if (which == 1) continue; /* the scales of 0 b; b 0 are known as a product only */
        for (size_t i = 0; i < m; i++) {
            for (size_t j = 0; j < m; j++) K2[i + j * m] = ldexp(K[i + j * m], 2 * (of_coordinate[i] + of_coordinate[j]));
            for (size_t c = 0; c < k; c++) F2[c + i * k] = ldexp(F[c + i * k], of_constraint[c] + 2 * of_coordinate[i]);
            h2[i] = ldexp(h[i], 2 * of_coordinate[i]);
        }
        for (size_t c = 0; c < k; c++) g2[c] = ldexp(g[c], of_constraint[c]);
        cr_assert(nh_saddle_solve(m, k, K2, F2, h2, g2, a2, mu2, &rcond2, work), "metric %zu", which);
        if (which == 0) cr_expect_eq(rcond, rcond2);
        cr_expect_gt(rcond2, 1e-3, "metric %zu: %g", which, rcond2);
        for (size_t i = 0; i < m; i++) cr_expect_float_eq(ldexp(a2[i], 2 * of_coordinate[i]), a[i], which ? 1e-13 : 0, "metric %zu: %g, not %g", which, a2[i], a[i]);
        for (size_t c = 0; c < k; c++) cr_expect_float_eq(ldexp(mu2[c], of_constraint[c]), mu[c], which ? 1e-13 : 0, "metric %zu", which);
    }
    cr_expect_not(nh_saddle_solve(m, k, metrics[2], none, h, g, a, mu, &rcond, work), "nothing holds the last coordinate");
}

Test(linalg, empty_matrices_are_harmless)
{
    double nothing[1] = {0}, im[1];
    nh_qr *qr = nh_qr_create(0, 1);
    nh_qr_add(qr, 5, nothing, 5);
    nh_qr_triangle(qr, nothing);
    cr_assert_eq(nh_qr_rows(qr), 5);
    nh_qr_free(qr);
    cr_assert(nh_svd(0, 3, nothing, nothing, NULL, NULL));
    cr_assert(nh_eigen(0, nothing, nothing, im, NULL));
    cr_assert(nh_solve(0, nothing, 1, nothing, NULL));
    cr_assert_eq(nh_least_squares(0, 1, nothing, 1, nothing, 1, 1e-12), 0);
}

/* An interruption leaves a large decomposition to itself; small ones are done in any case.  Last: it cannot be taken back. */
Test(linalg, a_large_decomposition_can_be_left)
{
    enum { large = 500, small = 30 };
    double *a = random_matrix(large, large), *s = nh_alloc_array(large, sizeof *s), *vt = nh_alloc_array(large * large, sizeof *vt);
    nh_interrupt();
    cr_expect_not(nh_svd(large, large, a, s, NULL, vt));
    cr_expect(nh_svd(small, small, a, s, NULL, vt));
    nh_free(a);
    nh_free(s);
    nh_free(vt);
    for (int i = 0; i < 3000 && nh_jobs_left(); i++) usleep(10000);
    cr_expect_eq(nh_jobs_left(), 0, "they end by themselves");
}
