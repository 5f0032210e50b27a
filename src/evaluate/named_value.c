#include "evaluate/named_value.h"

#include <math.h>
#include <stdint.h>
#include <string.h>

enum { least_bits = 64, most_bits = 4096, wanted_bits = 54, below_doubles = -1100 };

/* The derivative with respect to x, by values of the function with other orders
 * [DLMF 10.6.1, 10.29.1, 13.3.15, 13.3.22, 14.10.5, 15.5.1]. */
typedef enum { PLAIN, PRIME } which;

static void add_integer(acb_t out, const acb_t a, slong n, slong bits) { acb_add_si(out, a, n, bits); }

/* n (P_(n-1) - x P_n)/(1 - x^2) */
static void legendre(acb_t out, bool second, acb_srcptr x, which part, slong bits)
{
    acb_t order, value, zero;
    acb_init(order);
    acb_init(value);
    acb_init(zero);
    acb_set(value, x + 1);
    double place = fabs(arf_get_d(arb_midref(acb_realref(value)), ARF_RND_NEAR));
    int type = second && place > 1; /* beyond 1, Q is another branch, which is real as well */
    (second ? acb_hypgeom_legendre_q : acb_hypgeom_legendre_p)(value, x, zero, x + 1, type, bits);
    if (part == PRIME) {
        add_integer(order, x, -1, bits);
        (second ? acb_hypgeom_legendre_q : acb_hypgeom_legendre_p)(out, order, zero, x + 1, type, bits);
        acb_submul(out, value, x + 1, bits);
        acb_mul(out, out, x, bits);
        acb_mul(value, x + 1, x + 1, bits);
        acb_sub_ui(value, value, 1, bits);
        acb_neg(value, value);
        acb_div(out, out, value, bits);
    } else {
        acb_set(out, value);
    }
    acb_clear(order);
    acb_clear(value);
    acb_clear(zero);
}

/* 2F1(a, b; c; x), its derivative a b/c 2F1(a + 1, b + 1; c + 1; x).  `flags`:
 * which differences are whole numbers. */
static void gauss(acb_t out, acb_t a, acb_t b, const acb_t product, const acb_t c, const acb_t x, which part, int flags,
                  slong bits)
{
    acb_t below;
    acb_init(below);
    acb_set(below, c);
    if (part == PRIME) {
        add_integer(a, a, 1, bits);
        add_integer(b, b, 1, bits);
        add_integer(below, c, 1, bits);
    }
    acb_hypgeom_2f1(out, a, b, below, x, flags, bits);
    if (part == PRIME) {
        acb_mul(out, out, product, bits);
        acb_div(out, out, c, bits);
    }
    acb_clear(below);
}

static void by_parameters(acb_t out, acb_srcptr x, which part, slong bits)
{
    acb_t a, b, product;
    acb_init(a);
    acb_init(b);
    acb_init(product);
    acb_set(a, x);
    acb_set(b, x + 1);
    acb_mul(product, a, b, bits);
    gauss(out, a, b, product, x + 2, x + 3, part, 0, bits);
    acb_clear(a);
    acb_clear(b);
    acb_clear(product);
}

/* a, b = s/2 +- sqrt(s^2/4 - p) */
static void by_sum_and_product(acb_t out, acb_srcptr x, which part, slong bits)
{
    acb_t a, b, root, difference;
    acb_init(a);
    acb_init(b);
    acb_init(root);
    acb_init(difference);
    acb_mul_2exp_si(a, x, -1);
    acb_mul(root, a, a, bits);
    acb_sub(root, root, x + 1, bits);
    acb_sqrt(root, root, bits);
    acb_sub(b, a, root, bits);
    acb_add(a, a, root, bits);
    acb_sub(difference, x, x + 2, bits);
    gauss(out, a, b, x + 1, x + 2, x + 3, part, acb_is_int(difference) ? ACB_HYPGEOM_2F1_ABC : 0, bits);
    acb_clear(a);
    acb_clear(b);
    acb_clear(root);
    acb_clear(difference);
}

/* M' = a/b M(a + 1, b + 1), U' = -a U(a + 1, b + 1) */
static void confluent(acb_t out, bool second, acb_srcptr x, which part, slong bits)
{
    acb_t a, b;
    acb_init(a);
    acb_init(b);
    add_integer(a, x, part == PRIME, bits);
    add_integer(b, x + 1, part == PRIME, bits);
    if (second) acb_hypgeom_u(out, a, b, x + 2, bits);
    else acb_hypgeom_m(out, a, b, x + 2, 0, bits);
    if (part == PRIME) acb_mul(out, out, x, bits);
    if (part == PRIME && second) acb_neg(out, out);
    if (part == PRIME && !second) acb_div(out, out, x + 1, bits);
    acb_clear(a);
    acb_clear(b);
}

/* ---- Riemann's equation (1 + z^2)^2 y'' = (a + b z + c z^2) y, singular at i, -i and infinity [DLMF 15.11] ---- */

/* Its solutions are products of powers and 2F1 of (1 + i z)/2.  They are computed by Taylor series on a path from 0 to
 * z, because 2F1 is slow there, slowest where c = 3/4, and needs other formulas where exponents differ by whole
 * numbers. */
enum { A, B, C };
/* radius of the disc over the distance from i and -i; step over that radius */
static const double disc = 0.6, stride = 0.25;
static const double nearly = 0.999, rounding = 1e-12;

static double distance_below(const acb_t z, int sign)
{
    acb_t apart;
    arf_t below;
    acb_init(apart);
    arf_init(below);
    acb_onei(apart);
    if (sign > 0) acb_add(apart, z, apart, least_bits);
    else acb_sub(apart, z, apart, least_bits);
    acb_get_abs_lbound_arf(below, apart, least_bits);
    double out = arf_get_d(below, ARF_RND_DOWN);
    acb_clear(apart);
    arf_clear(below);
    return out;
}

static void add_product(mag_t out, const acb_t x, const mag_t by)
{
    mag_t size;
    mag_init(size);
    acb_get_mag(size, x);
    mag_addmul(out, size, by);
    mag_clear(size);
}

/* A bound of |y| for |z - at| <= radius: |y''| <= M |y| there, so that |y| <= (|y(at)| + radius |y'(at)|) exp(sqrt(M)
 * radius). */
static void bound(mag_t out, acb_srcptr y, acb_srcptr p, const acb_t at, double radius, double left, double right)
{
    mag_t size, reach, growth, below;
    mag_init(size);
    mag_init(reach);
    mag_init(growth);
    mag_init(below);
    mag_set_d(size, radius);
    acb_get_mag(reach, at);
    mag_add(reach, reach, size); /* |z| */
    mag_set_d(growth, 0);
    add_product(growth, p + C, reach);
    mag_mul(growth, growth, reach);
    add_product(growth, p + B, reach);
    mag_one(below);
    add_product(growth, p + A, below);
    mag_set_d_lower(below, (left - radius) * (right - radius) * (1 - rounding));
    mag_div(growth, growth, below);
    mag_div(growth, growth, below);
    mag_sqrt(growth, growth);
    mag_mul(growth, growth, size);
    mag_exp(growth, growth);
    acb_get_mag(out, y);
    add_product(out, y + 1, size);
    mag_mul(out, out, growth);
    mag_clear(size);
    mag_clear(reach);
    mag_clear(growth);
    mag_clear(below);
}

/* The coefficients u_0 .. u_(n - 1) of y at `at`, u_0 and u_1 given, of ((1 + at^2) + 2 at h + h^2)^2 y'' = (a + b z +
 * c z^2) y. */
static void taylor(acb_ptr u, slong n, acb_srcptr p, const acb_t at, slong bits)
{
    enum { e0, e1, d0, d1, d2, d3, n0, n1, sum, all };
    acb_ptr w = _acb_vec_init(all);
    acb_mul(w + e0, at, at, bits);
    acb_mul(w + n0, p + C, w + e0, bits);
    acb_addmul(w + n0, p + B, at, bits);
    acb_add(w + n0, w + n0, p + A, bits);
    acb_add_ui(w + e0, w + e0, 1, bits);
    acb_mul_2exp_si(w + e1, at, 1);
    acb_mul(w + n1, p + C, w + e1, bits);
    acb_add(w + n1, w + n1, p + B, bits);
    acb_mul(w + d0, w + e0, w + e0, bits);
    acb_mul(w + d1, w + e0, w + e1, bits);
    acb_mul_2exp_si(w + d1, w + d1, 1);
    acb_mul(w + d2, w + e1, w + e1, bits);
    acb_addmul_si(w + d2, w + e0, 2, bits);
    acb_mul_2exp_si(w + d3, w + e1, 1);
    acb_inv(w + d0, w + d0, bits);
    for (slong k = 0; k + 2 < n; k++) {
        acb_mul(w + sum, w + n0, u + k, bits);
        if (k > 0) acb_addmul(w + sum, w + n1, u + k - 1, bits);
        if (k > 1) acb_addmul(w + sum, p + C, u + k - 2, bits);
        acb_mul(u + k + 2, w + d1, u + k + 1, bits);
        acb_submul_si(w + sum, u + k + 2, (k + 1) * k, bits);
        acb_mul(u + k + 2, w + d2, u + k, bits);
        acb_submul_si(w + sum, u + k + 2, k * (k - 1), bits);
        if (k > 2) {
            acb_mul(u + k + 2, w + d3, u + k - 1, bits);
            acb_submul_si(w + sum, u + k + 2, (k - 1) * (k - 2), bits);
            acb_submul_si(w + sum, u + k - 2, (k - 2) * (k - 3), bits);
        }
        acb_mul(w + sum, w + sum, w + d0, bits);
        acb_div_ui(u + k + 2, w + sum, (ulong)((k + 2) * (k + 1)), bits);
    }
    _acb_vec_clear(w, all);
}

/* y and y' from `at` to `at` + h; not finite where h leaves the disc of convergence.  Not inlined: GCC 14 would take y
 * for its first part, and warn. */
__attribute__((noinline)) static void advance(acb_ptr y, acb_srcptr p, const acb_t at, const acb_t h, slong bits)
{
    double left = distance_below(at, 1), right = distance_below(at, -1), radius = disc * fmin(left, right);
    mag_t size, ratio, tail;
    mag_init(size);
    mag_init(ratio);
    mag_init(tail);
    acb_get_mag(size, h);
    mag_set_d_lower(tail, radius);
    mag_div(ratio, size, tail);
    double q = mag_get_d(ratio);
    if (!(q < 0.75)) {
        acb_indeterminate(y);
        acb_indeterminate(y + 1);
    } else {
        slong n = q > 0 ? 4 + (slong)((double)(bits + 30) / fmax(-log2(q), 0.4)) : 4;
        acb_ptr u = _acb_vec_init(n);
        acb_set(u, y);
        acb_set(u + 1, y + 1);
        taylor(u, n, p, at, bits);
        bound(tail, y, p, at, radius, left, right);
        _acb_poly_evaluate2(y, y + 1, u, n, h, bits);
        mag_pow_ui(ratio, ratio, (ulong)n - 1); /* |u_k| <= tail/radius^k */
        mag_mul(tail, tail, ratio);
        mag_mul_ui(tail, tail, 16 * (ulong)n); /* sum of k q^(k - 1), 1/(1 - q)^2 <= 16 */
        acb_add_error_mag(y, tail);
        mag_set_d_lower(size, radius);
        mag_div(tail, tail, size);
        acb_add_error_mag(y + 1, tail);
        _acb_vec_clear(u, n);
    }
    mag_clear(size);
    mag_clear(ratio);
    mag_clear(tail);
}

/* Of the solution with y(0) = 1, y'(0) = 0, or 0 and 1: y and y' at z = argument[3]. */
static void transport(acb_ptr y, bool second, acb_srcptr argument, slong bits)
{
    acb_t z, at, next, middle, step;
    double gone = 0, length;
    mag_t size;
    mag_init(size);
    acb_init(z);
    acb_init(at);
    acb_init(next);
    acb_init(middle);
    acb_init(step);
    acb_set(z, argument + 3);
    acb_set_ui(y, !second);
    acb_set_ui(y + 1, second);
    acb_get_mid(middle, z);
    acb_get_mag(size, middle);
    length = mag_get_d(size);
    for (bool done = !acb_is_finite(z); !done;) {
        double reach = disc * stride * fmin(distance_below(at, 1), distance_below(at, -1)) * nearly;
        done = !(gone + reach < length) || !(reach > 1e-6);
        gone += reach;
        if (done) acb_set(next, z);
        else acb_set_d(next, gone / length);
        if (!done) acb_mul(next, next, middle, bits);
        if (!done) acb_get_mid(next, next);
        acb_sub(step, next, at, bits);
        advance(y, argument, at, step, bits);
        acb_get_mid(at, next);
    }
    if (!acb_is_finite(z)) _acb_vec_indeterminate(y, 2);
    mag_clear(size);
    acb_clear(z);
    acb_clear(at);
    acb_clear(next);
    acb_clear(middle);
    acb_clear(step);
}

static void riemann(acb_t out, bool second, acb_srcptr argument, which part, slong bits)
{
    acb_ptr y = _acb_vec_init(2);
    transport(y, second, argument, bits);
    acb_set(out, y + (part == PRIME));
    _acb_vec_clear(y, 2);
}

/* Whoever asks for y mostly asks for y' at the same place, perhaps after a batch of other places: what one transport
 * gave is kept until another place wants its row.  Of a thread, so that no lock is needed; what is kept is what would
 * be computed again. */
typedef struct {
    double place[4];
    double y[2]; /* NaN: not yet to all digits */
    slong bits;  /* of the last transport; 0: none */
} solution;
enum { kept = 512 };

static solution *solution_at(bool second, const double *place)
{
    static _Thread_local solution all[kept];
    uint64_t hash = second;
    for (size_t i = 0; i < 4; i++) {
        uint64_t word;
        memcpy(&word, place + i, sizeof word);
        hash = (hash ^ word) * UINT64_C(0x9E3779B97F4A7C15);
        hash ^= hash >> 32;
    }
    solution *at = all + hash % (kept / 2) * 2 + second;
    if (at->bits == 0 || memcmp(at->place, place, sizeof at->place) != 0) {
        *at = (solution){.y = {NAN, NAN}};
        memcpy(at->place, place, sizeof at->place);
    }
    return at;
}

typedef void bessel_function(acb_t out, const acb_t order, const acb_t x, slong bits);

/* J' = (J_(n-1) - J_(n+1))/2, as Y; I' = (I_(n-1) + I_(n+1))/2, K' = -(K_(n-1)
 * + K_(n+1))/2 */
static void bessel(acb_t out, bessel_function *f, int sign_of_next, acb_srcptr x, which part, slong bits)
{
    if (part == PLAIN) {
        f(out, x, x + 1, bits);
        return;
    }
    acb_t order, next;
    acb_init(order);
    acb_init(next);
    add_integer(order, x, 1, bits);
    f(next, order, x + 1, bits);
    add_integer(order, x, -1, bits);
    f(out, order, x + 1, bits);
    if (sign_of_next > 0) acb_add(out, out, next, bits);
    else acb_sub(out, out, next, bits);
    acb_mul_2exp_si(out, out, -1);
    acb_clear(order);
    acb_clear(next);
}

static void airy(acb_t out, nh_function f, acb_srcptr x, slong bits)
{
    acb_hypgeom_airy(f == NH_AIRY_AI ? out : NULL, f == NH_AIRY_AI_PRIME ? out : NULL, f == NH_AIRY_BI ? out : NULL,
                     f == NH_AIRY_BI_PRIME ? out : NULL, x, bits);
}

static void value(acb_t out, nh_function f, acb_srcptr x, slong bits)
{
    which part = (f - NH_LEGENDRE_P) % 2 ? PRIME : PLAIN;
    switch (f) {
    case NH_LEGENDRE_P:
    case NH_LEGENDRE_P_PRIME: legendre(out, false, x, part, bits); break;
    case NH_LEGENDRE_Q:
    case NH_LEGENDRE_Q_PRIME: legendre(out, true, x, part, bits); break;
    case NH_HYP2F1:
    case NH_HYP2F1_PRIME: by_parameters(out, x, part, bits); break;
    case NH_GAUSS_F:
    case NH_GAUSS_F_PRIME: by_sum_and_product(out, x, part, bits); break;
    case NH_RIEMANN_C:
    case NH_RIEMANN_C_PRIME: riemann(out, false, x, part, bits); break;
    case NH_RIEMANN_S:
    case NH_RIEMANN_S_PRIME: riemann(out, true, x, part, bits); break;
    case NH_HYP1F1:
    case NH_HYP1F1_PRIME: confluent(out, false, x, part, bits); break;
    case NH_HYPERU:
    case NH_HYPERU_PRIME: confluent(out, true, x, part, bits); break;
    case NH_BESSEL_J:
    case NH_BESSEL_J_PRIME: bessel(out, acb_hypgeom_bessel_j, -1, x, part, bits); break;
    case NH_BESSEL_Y:
    case NH_BESSEL_Y_PRIME: bessel(out, acb_hypgeom_bessel_y, -1, x, part, bits); break;
    case NH_BESSEL_I:
    case NH_BESSEL_I_PRIME: bessel(out, acb_hypgeom_bessel_i, 1, x, part, bits); break;
    case NH_BESSEL_K:
    case NH_BESSEL_K_PRIME: bessel(out, acb_hypgeom_bessel_k, 1, x, part, bits); break;
    case NH_AIRY_AI:
    case NH_AIRY_AI_PRIME:
    case NH_AIRY_BI:
    case NH_AIRY_BI_PRIME: airy(out, f, x, bits); break;
    case NH_ELLIPTIC_K: acb_elliptic_k(out, x, bits); break;
    case NH_ELLIPTIC_E: acb_elliptic_e(out, x, bits); break;
    case NH_ELLIPTIC_F: acb_elliptic_f(out, x, x + 1, 0, bits); break;
    case NH_ELLIPTIC_EINC: acb_elliptic_e_inc(out, x, x + 1, 0, bits); break;
    case NH_ELLIPTIC_PI: acb_elliptic_pi_inc(out, x, x + 1, x + 2, 0, bits); break;
    default: acb_indeterminate(out); break;
    }
    if (f == NH_BESSEL_K_PRIME) acb_neg(out, out);
}

void nh_named_value_ball(nh_function f, arb_srcptr argument, arb_t out, slong bits)
{
    size_t n = nh_function_arity(f);
    acb_t all;
    acb_ptr x = _acb_vec_init((slong)n);
    acb_init(all);
    for (size_t i = 0; i < n; i++) acb_set_arb(x + i, argument + i);
    value(all, f, x, bits);
    if (arb_contains_zero(acb_imagref(all))) arb_set(out, acb_realref(all));
    else arb_indeterminate(out);
    _acb_vec_clear(x, (slong)n);
    acb_clear(all);
}

/* The double with all digits of a ball, or with an absolute error below the smallest double; NaN: it is too wide. */
static double rounded(const arb_t x)
{
    bool precise = arb_is_finite(x) &&
                   (arb_rel_accuracy_bits(x) >= wanted_bits || mag_cmp_2exp_si(arb_radref(x), below_doubles) < 0);
    return precise ? arf_get_d(arb_midref(x), ARF_RND_NEAR) : NAN;
}

static double riemann_to_all_digits(bool second, which part, const double *place)
{
    solution *at = solution_at(second, place);
    acb_ptr x = _acb_vec_init(4), y = _acb_vec_init(2);
    for (slong i = 0; i < 4; i++) acb_set_d(x + i, place[i]);
    while (isnan(at->y[part]) && at->bits < most_bits) {
        at->bits = at->bits > 0 ? 2 * at->bits : least_bits;
        transport(y, second, x, at->bits);
        for (slong i = 0; i < 2; i++) {
            if (isnan(at->y[i]) && arb_contains_zero(acb_imagref(y + i))) at->y[i] = rounded(acb_realref(y + i));
        }
    }
    _acb_vec_clear(x, 4);
    _acb_vec_clear(y, 2);
    return at->y[part];
}

double nh_named_value(nh_function f, const double *argument)
{
    if (f >= NH_RIEMANN_C && f <= NH_RIEMANN_S_PRIME)
        return riemann_to_all_digits(f >= NH_RIEMANN_S, (f - NH_RIEMANN_C) % 2 ? PRIME : PLAIN, argument);
    size_t n = nh_function_arity(f);
    double out = NAN;
    arb_t all;
    arb_ptr x = _arb_vec_init((slong)n);
    arb_init(all);
    for (size_t i = 0; i < n; i++) arb_set_d(x + i, argument[i]);
    for (slong bits = least_bits; bits <= most_bits && isnan(out); bits *= 2) {
        nh_named_value_ball(f, x, all, bits);
        out = rounded(all);
    }
    _arb_vec_clear(x, (slong)n);
    arb_clear(all);
    return out;
}

double complex nh_named_value_complex(nh_function f, const double complex *argument)
{
    size_t n = nh_function_arity(f);
    double complex out = CMPLX(NAN, NAN);
    acb_t all;
    acb_ptr x = _acb_vec_init((slong)n);
    acb_init(all);
    for (size_t i = 0; i < n; i++) acb_set_d_d(x + i, creal(argument[i]), cimag(argument[i]));
    for (slong bits = least_bits; bits <= most_bits && isnan(creal(out)); bits *= 2) {
        value(all, f, x, bits);
        double re = rounded(acb_realref(all)), im = rounded(acb_imagref(all));
        if (!isnan(re) && !isnan(im)) out = CMPLX(re, im);
    }
    _acb_vec_clear(x, (slong)n);
    acb_clear(all);
    return out;
}
