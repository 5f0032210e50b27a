#include "exact/ball_series_internal.h"
#include "graph/function.h"

#include <stdlib.h>

/* ---- by their derivatives: f(p) = f(p_0) + int f'(p) p' ---- */

/* p := first + int rate p' */
static void by_rate(arb_poly_t p, const arb_t first, const arb_poly_t rate, slong terms, slong bits)
{
    arb_poly_derivative(p, p, bits);
    arb_poly_mullow(p, p, rate, terms, bits);
    arb_poly_integral(p, p, bits);
    arb_poly_truncate(p, terms);
    arb_poly_set_coeff_arb(p, 0, first);
}

/* out := sign p^2 + one */
static void square_and(arb_poly_t out, const arb_poly_t p, int sign, int one, slong terms, slong bits)
{
    arb_poly_t c;
    arb_poly_init(c);
    arb_poly_set_si(c, one);
    arb_poly_mullow(out, p, p, terms, bits);
    if (sign < 0) arb_poly_neg(out, out);
    arb_poly_add(out, out, c, bits);
    arb_poly_clear(c);
}

/* asinh' = 1/sqrt(p^2 + 1), acosh' = 1/sqrt(p^2 - 1) for p > 1, atanh' = 1/(1 - p^2). */
static void area_function(nh_function f, arb_poly_t p, slong terms, slong bits)
{
    arb_poly_t rate;
    arb_t first;
    arb_poly_init(rate);
    arb_init(first);
    arb_poly_get_coeff_arb(first, p, 0);
    if (f == NH_ASINH) arb_asinh(first, first, bits);
    else if (f == NH_ACOSH) arb_acosh(first, first, bits);
    else arb_atanh(first, first, bits);
    square_and(rate, p, f == NH_ATANH ? -1 : 1, f == NH_ACOSH ? -1 : 1, terms, bits);
    if (f == NH_ATANH) arb_poly_inv_series(rate, rate, terms, bits);
    else arb_poly_rsqrt_series(rate, rate, terms, bits);
    by_rate(p, first, rate, terms, bits);
    arb_clear(first);
    arb_poly_clear(rate);
}

/* On the side of 0 on which all of p_0 lies. */
static bool sided(nh_function f, arb_poly_t p)
{
    arb_t first;
    arb_init(first);
    arb_poly_get_coeff_arb(first, p, 0);
    bool above = arb_is_positive(first), below = arb_is_negative(first);
    if (f == NH_SIGN) arb_poly_set_si(p, above ? 1 : -1);
    else if (below) arb_poly_neg(p, p);
    arb_clear(first);
    return above || below;
}

/* d atan2(y, x) = (x dy - y dx)/(x^2 + y^2) */
bool nh_ball_series_angle(arb_poly_t y, const arb_poly_t x, slong terms, slong bits)
{
    arb_poly_t top, part, norm;
    arb_t first, u, v;
    arb_poly_init(top), arb_poly_init(part), arb_poly_init(norm);
    arb_init(first), arb_init(u), arb_init(v);
    arb_poly_get_coeff_arb(u, x, 0);
    arb_poly_get_coeff_arb(v, y, 0);
    bool fine = arb_is_positive(u) || !arb_contains_zero(v);
    arb_atan2(first, v, u, bits);
    arb_poly_derivative(top, y, bits);
    arb_poly_mullow(top, top, x, terms, bits);
    arb_poly_derivative(part, x, bits);
    arb_poly_mullow(part, part, y, terms, bits);
    arb_poly_sub(top, top, part, bits);
    arb_poly_mullow(norm, x, x, terms, bits);
    arb_poly_mullow(part, y, y, terms, bits);
    arb_poly_add(norm, norm, part, bits);
    arb_poly_div_series(top, top, norm, terms, bits);
    arb_poly_integral(y, top, bits);
    arb_poly_truncate(y, terms);
    arb_poly_set_coeff_arb(y, 0, first);
    arb_clear(v), arb_clear(u), arb_clear(first);
    arb_poly_clear(norm), arb_poly_clear(part), arb_poly_clear(top);
    return fine;
}

static void tanh_series(arb_poly_t p, slong terms, slong bits)
{
    arb_poly_t c;
    arb_poly_init(c);
    arb_poly_sinh_cosh_series(p, c, p, terms, bits);
    arb_poly_div_series(p, p, c, terms, bits);
    arb_poly_clear(c);
}

bool nh_ball_series_function(nh_function f, arb_poly_t p, slong terms, slong bits)
{
    switch (f) {
    case NH_SIN: arb_poly_sin_series(p, p, terms, bits); return true;
    case NH_COS: arb_poly_cos_series(p, p, terms, bits); return true;
    case NH_TAN: arb_poly_tan_series(p, p, terms, bits); return true;
    case NH_ASIN: arb_poly_asin_series(p, p, terms, bits); return true;
    case NH_ACOS: arb_poly_acos_series(p, p, terms, bits); return true;
    case NH_ATAN: arb_poly_atan_series(p, p, terms, bits); return true;
    case NH_SINH: arb_poly_sinh_series(p, p, terms, bits); return true;
    case NH_COSH: arb_poly_cosh_series(p, p, terms, bits); return true;
    case NH_TANH: tanh_series(p, terms, bits); return true;
    case NH_ASINH:
    case NH_ACOSH:
    case NH_ATANH: area_function(f, p, terms, bits); return true;
    case NH_EXP: arb_poly_exp_series(p, p, terms, bits); return true;
    case NH_LOG: arb_poly_log_series(p, p, terms, bits); return true;
    case NH_ABS:
    case NH_SIGN: return sided(f, p);
    default: return false;
    }
}

bool nh_ball_series_half_power(arb_poly_t p, int64_t n, int64_t halves, slong terms, slong bits)
{
    enum { largest = 1000 };
    if (llabs((long long)n) > largest) return false;
    if (halves == 1) arb_poly_sqrt_series(p, p, terms, bits);
    arb_poly_pow_ui_trunc_binexp(p, p, (ulong)llabs((long long)n), terms, bits);
    if (n < 0) arb_poly_inv_series(p, p, terms, bits);
    return true;
}

void nh_ball_series_power(arb_poly_t p, const arb_poly_t x, slong terms, slong bits)
{
    if (arb_poly_length(x) < 2) {
        arb_t first;
        arb_init(first);
        arb_poly_get_coeff_arb(first, x, 0);
        arb_poly_pow_arb_series(p, p, first, terms, bits);
        arb_clear(first);
    } else arb_poly_pow_series(p, p, x, terms, bits);
}
