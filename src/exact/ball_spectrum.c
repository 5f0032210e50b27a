/* ball_spectrum: approximate eigenvalues by the QR iteration, joined where they are near each other; then the number of
 * roots of the characteristic polynomial in a disc around each cluster is proved by Pellet's theorem [Marden1966, sec.
 * 28]: with p(x + c) = sum b_j x^j,
 *
 *     |b_s| r^s > sum_{j != s} |b_j| r^j        implies that exactly s roots have |x - c| < r
 *
 * The coefficients are balls, so that this holds for every matrix of the ball. */
#include "exact/ball_spectrum.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/progress.h"

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
