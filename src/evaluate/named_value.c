#include "evaluate/named_value.h"

#include <math.h>

#include "graph/function.h"

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

/* A stand-in for the unspecified function number x[0]: the derivative of order x[1] at x[2] of a sum of three waves.
 * Its derivatives below the sixth satisfy no linear relation. */
static void stand_in(acb_t out, acb_srcptr x, slong bits)
{
    static const double size[] = {0.8125, 0.5625, 0.3125}, often[] = {0.6171875, 1.1328125, 1.7890625};
    long number = lround(arf_get_d(arb_midref(acb_realref(x)), ARF_RND_NEAR)),
         order = lround(arf_get_d(arb_midref(acb_realref(x + 1)), ARF_RND_NEAR));
    acb_t angle, factor;
    acb_init(angle);
    acb_init(factor);
    acb_zero(out);
    for (int k = 0; k < 3; k++) {
        acb_set_d(factor, often[k] + (double)(number % 8) / 32);
        acb_mul(angle, factor, x + 2, bits);
        acb_add_si(angle, angle, k + number, bits);
        (order % 2 ? acb_cos : acb_sin)(angle, angle, bits);
        if (order % 4 > 1) acb_neg(angle, angle);
        acb_pow_ui(factor, factor, (ulong)order, bits);
        acb_mul(angle, angle, factor, bits);
        acb_set_d(factor, size[k]);
        acb_addmul(out, angle, factor, bits);
    }
    acb_clear(angle);
    acb_clear(factor);
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
    case NH_RIEMANN_C_PRIME: nh_riemann(out, false, part == PRIME, x, bits); break;
    case NH_RIEMANN_S:
    case NH_RIEMANN_S_PRIME: nh_riemann(out, true, part == PRIME, x, bits); break;
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
    case NH_UNSPECIFIED: stand_in(out, x, bits); break;
    default: acb_indeterminate(out); break;
    }
    if (f == NH_BESSEL_K_PRIME) acb_neg(out, out);
}

/* False: it is not real, which more bits do not change. */
static bool real_value(nh_function f, arb_srcptr argument, arb_t out, slong bits)
{
    size_t n = nh_function_arity(f);
    acb_t all;
    acb_ptr x = _acb_vec_init((slong)n);
    acb_init(all);
    for (size_t i = 0; i < n; i++) acb_set_arb(x + i, argument + i);
    value(all, f, x, bits);
    bool real = arb_contains_zero(acb_imagref(all));
    if (real) arb_set(out, acb_realref(all));
    else arb_indeterminate(out);
    _acb_vec_clear(x, (slong)n);
    acb_clear(all);
    return real;
}

void nh_named_value_ball(nh_function f, arb_srcptr argument, arb_t out, slong bits)
{
    real_value(f, argument, out, bits);
}

/* The double with all digits of a ball, or with an absolute error below the smallest double; NaN: it is too wide. */
static double rounded(const arb_t x)
{
    bool precise = arb_is_finite(x) &&
                   (arb_rel_accuracy_bits(x) >= wanted_bits || mag_cmp_2exp_si(arb_radref(x), below_doubles) < 0);
    return precise ? arf_get_d(arb_midref(x), ARF_RND_NEAR) : NAN;
}

double nh_named_value(nh_function f, const double *argument)
{
    size_t n = nh_function_arity(f);
    bool riemann = f >= NH_RIEMANN_C && f <= NH_RIEMANN_S_PRIME;
    double out = NAN;
    arb_t all;
    arb_ptr x = _arb_vec_init((slong)n);
    arb_init(all);
    for (size_t i = 0; i < n; i++) arb_set_d(x + i, argument[i]);
    /* a path to Riemann's z takes a part of the digits */
    bool real = true;
    for (slong bits = riemann ? 2 * least_bits : least_bits; bits <= most_bits && isnan(out) && real; bits *= 2) {
        if (riemann) nh_riemann_at(all, f >= NH_RIEMANN_S, (f - NH_RIEMANN_C) % 2, argument, bits);
        else real = real_value(f, x, all, bits);
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
