#include "exact/ball_matrix.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
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
static const double nearly = 1e-9;

static void join_equal(size_t n, double *re, double *im)
{
    double *mean = nh_alloc_array(2 * n + 1, sizeof *mean), largest = 0;
    for (size_t k = 0; k < n; k++) largest = fmax(largest, hypot(re[k], im[k]));
    for (size_t k = 0; k < n; k++) {
        double count = 0;
        for (size_t j = 0; j < n; j++) {
            if (hypot(re[j] - re[k], im[j] - im[k]) > nearly * largest) continue;
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

/* ---- is a row independent of those before it? ---- */

/* The entry of a row whose distance from zero is certainly the largest; `width` where none is certainly nonzero. */
static size_t pivot_of(size_t width, arb_srcptr row)
{
    size_t best = width;
    double largest = -INFINITY;
    for (size_t j = 0; j < width; j++) {
        double size = nh_ball_log10_lower(row + j);
        if (size <= largest) continue;
        largest = size;
        best = j;
    }
    return best;
}

static void eliminate(size_t rows, size_t width, arb_ptr a, size_t r, size_t pivot, long bits)
{
    arb_t factor;
    arb_init(factor);
    for (size_t i = r + 1; i < rows; i++) {
        arb_div(factor, a + i * width + pivot, a + r * width + pivot, bits);
        for (size_t j = 0; j < width; j++) arb_submul(a + i * width + j, factor, a + r * width + j, bits);
        arb_zero(a + i * width + pivot);
    }
    arb_clear(factor);
}

static void bounds_of(size_t width, arb_srcptr row, double *lower, double *upper)
{
    *lower = *upper = -INFINITY;
    for (size_t j = 0; j < width; j++) {
        *lower = fmax(*lower, nh_ball_log10_lower(row + j));
        *upper = fmax(*upper, nh_ball_log10_upper(row + j));
    }
}

bool nh_ball_rank_left(nh_ball *ball, size_t rows, size_t width, const nh_ex *e, const double *scale,
                       double *log10_lower, double *log10_upper)
{
    long bits = nh_ball_bits(ball);
    arb_ptr a = _arb_vec_init((slong)(rows * width)), last = a + (rows - 1) * width;
    arb_t factor;
    double before_lower, before_upper;
    bool good = true;
    arb_init(factor);
    for (size_t k = 0; k < rows * width && good; k++) {
        good = nh_ball_eval(ball, e[k], a + k);
        arb_set_d(factor, scale[k % width]);
        arb_mul(a + k, a + k, factor, bits);
    }
    if (good) bounds_of(width, last, &before_lower, &before_upper);
    good = good && isfinite(before_lower);
    for (size_t r = 0; r + 1 < rows && good; r++) {
        size_t pivot = pivot_of(width, a + r * width);
        good = pivot < width;
        if (good) eliminate(rows, width, a, r, pivot, bits);
    }
    if (good) {
        bounds_of(width, last, log10_lower, log10_upper);
        *log10_lower -= before_upper;
        *log10_upper -= before_lower;
    }
    arb_clear(factor);
    _arb_vec_clear(a, (slong)(rows * width));
    return good;
}

/* ---- all eigenvalues, multiple and defective ones too ---- */

enum { pellet_bits = 64, head_bits = 320, bits_each = 32 };

long nh_ball_spectrum_bits(size_t n) { return head_bits + bits_each * (long)n; }

/* ---- Pellet's discs ---- */

/* log2 of bounds of |b|: of an upper one, and of a lower one */
static double log2_of(const arf_t x)
{
    if (arf_is_zero(x)) return -INFINITY;
    arf_t mantissa;
    fmpz_t exponent;
    arf_init(mantissa);
    fmpz_init(exponent);
    arf_frexp(mantissa, exponent, x);
    double value = log2(fabs(arf_get_d(mantissa, ARF_RND_NEAR))) + fmpz_get_d(exponent);
    arf_clear(mantissa);
    fmpz_clear(exponent);
    return value;
}

static double bound(const acb_t b, bool upper)
{
    arf_t x;
    arf_init(x);
    if (upper) acb_get_abs_ubound_arf(x, b, pellet_bits);
    else acb_get_abs_lbound_arf(x, b, pellet_bits);
    double value = log2_of(x);
    arf_clear(x);
    return value;
}

/* Does the inequality hold for r = 2^k?  With sums of powers of two, whose logarithms are rounded: the margin covers
 * that. */
static bool holds(const double *log2_b, size_t n, size_t s, double k)
{
    static const double margin = 1e-9;
    double sum = 0;
    for (size_t j = 0; j <= n; j++)
        if (j != s) sum += exp2(log2_b[j] + (double)j * k - (log2_b[s] + (double)s * k));
    return sum < 1 - margin;
}

/* log2 of a radius of a disc around c with exactly s roots of p, the least one that is tried. */
static bool disc(const arb_poly_t p, const acb_t c, size_t s, long bits, double *log2_r)
{
    enum { most_steps = 400 };
    static const double step = 0.25;
    slong n = arb_poly_degree(p);
    acb_poly_t shifted;
    acb_poly_init(shifted);
    acb_poly_set_arb_poly(shifted, p);
    acb_poly_taylor_shift(shifted, shifted, c, bits);
    double *b = nh_alloc_array((size_t)n + 1, sizeof *b), least = -(double)bits;
    for (slong j = 0; j <= n; j++) {
        acb_srcptr coefficient = acb_poly_get_coeff_ptr(shifted, j);
        b[j] = coefficient ? bound(coefficient, (size_t)j != s) : -INFINITY;
    }
    for (size_t j = 0; j < s; j++) least = fmax(least, (b[j] - b[s]) / (double)(s - j));
    bool good = false;
    for (int i = 0; !good && isfinite(b[s]) && isfinite(least) && i < most_steps; i++) {
        *log2_r = least + i * step;
        good = holds(b, (size_t)n, s, *log2_r);
    }
    nh_free(b);
    acb_poly_clear(shifted);
    return good;
}

/* ---- clusters ---- */

typedef struct {
    size_t n;
    double scale; /* the largest eigenvalue */
    acb_ptr near; /* n approximations */
    size_t *of;   /* the cluster of each: the index of its first one */
} clusters;

static double distance(acb_srcptr a, acb_srcptr b)
{
    acb_t d;
    acb_init(d);
    acb_sub(d, a, b, pellet_bits);
    double value =
        hypot(arf_get_d(arb_midref(acb_realref(d)), ARF_RND_NEAR), arf_get_d(arb_midref(acb_imagref(d)), ARF_RND_NEAR));
    acb_clear(d);
    return value;
}

/* Joins what is nearer than `equal` times the scale, by chains. */
static void join(clusters *x, double equal)
{
    for (size_t i = 0; i < x->n; i++) x->of[i] = i;
    for (bool moved = true; moved;) {
        moved = false;
        for (size_t i = 0; i < x->n; i++)
            for (size_t j = 0; j < i; j++) {
                if (x->of[i] == x->of[j] || distance(x->near + i, x->near + j) > equal * x->scale) continue;
                x->of[i] = x->of[j] = x->of[i] < x->of[j] ? x->of[i] : x->of[j];
                moved = true;
            }
    }
}

/* The mean of a cluster, on an axis where it is near it.  Returns the number of its members. */
static size_t centre(const clusters *x, size_t first, double equal, long bits, acb_t c)
{
    size_t s = 0;
    acb_zero(c);
    for (size_t i = 0; i < x->n; i++)
        if (x->of[i] == first) acb_add(c, c, x->near + i, bits), s++;
    acb_div_ui(c, c, s, bits);
    acb_get_mid(c, c);
    arb_ptr part[2] = {acb_realref(c), acb_imagref(c)};
    for (int i = 0; i < 2; i++)
        if (fabs(arf_get_d(arb_midref(part[i]), ARF_RND_NEAR)) <= equal * x->scale) arb_zero(part[i]);
    return s;
}

/* All clusters with their discs, which must not meet.  Returns how many; 0: at least one has no disc. */
static size_t enclose(const clusters *x, const arb_poly_t p, double equal, long bits, nh_eigenvalue *out)
{
    static const double shown = 1e-15, least = 1e-40; /* rounding of 15 digits; a radius that is as good as 0 */
    size_t count = 0;
    bool good = true;
    acb_t c;
    acb_init(c);
    for (size_t i = 0; i < x->n && good; i++) {
        double log2_r;
        if (x->of[i] != i) continue;
        size_t s = centre(x, i, equal, bits, c);
        good = disc(p, c, s, bits, &log2_r);
        if (!good) break;
        double re = arf_get_d(arb_midref(acb_realref(c)), ARF_RND_NEAR),
               im = arf_get_d(arb_midref(acb_imagref(c)), ARF_RND_NEAR),
               r = fmax(exp2(log2_r), fmax(least * x->scale, DBL_MIN));
        for (size_t j = 0; j < count; j++) good &= hypot(out[j].re - re, out[j].im - im) > 2 * (out[j].radius + r);
        out[count++] = (nh_eigenvalue){re, im, r, r + shown * hypot(re, im), s};
    }
    acb_clear(c);
    return good ? count : 0;
}

static int by_real_part(const void *a, const void *b)
{
    const nh_eigenvalue *x = a, *y = b;
    double d = x->re - y->re;
    if (fabs(d) <= x->error + y->error) d = x->im - y->im;
    return d < 0 ? 1 : d > 0 ? -1 : 0;
}

size_t nh_ball_spectrum(const arb_mat_t A, long bits, nh_eigenvalue *out)
{
    static const double joined[] = {1e-40, 1e-15, 1e-12, 1e-9, 1e-6};
    size_t n = (size_t)arb_mat_nrows(A), count = 0;
    if (n == 0) return 0;
    acb_mat_t matrix;
    arb_poly_t p;
    clusters x = {.n = n, .near = _acb_vec_init((slong)n), .of = nh_alloc_array(n, sizeof *x.of)};
    acb_mat_init(matrix, (slong)n, (slong)n);
    arb_poly_init(p);
    acb_mat_set_arb_mat(matrix, A);
    acb_mat_get_mid(matrix, matrix);
    acb_mat_approx_eig_qr(x.near, NULL, NULL, matrix, NULL, 0, bits);
    arb_mat_charpoly(p, A, bits);
    acb_t zero;
    acb_init(zero);
    for (size_t i = 0; i < n; i++) x.scale = fmax(x.scale, distance(x.near + i, zero));
    acb_clear(zero);
    for (size_t i = 0; i < sizeof joined / sizeof *joined && !count && isfinite(x.scale); i++) {
        if (nh_interrupted()) break;
        join(&x, joined[i]);
        count = enclose(&x, p, joined[i], bits, out);
    }
    qsort(out, count, sizeof *out, by_real_part);
    arb_poly_clear(p);
    acb_mat_clear(matrix);
    _acb_vec_clear(x.near, (slong)n);
    nh_free(x.of);
    return count;
}
