/* Candidates with square roots of polynomials of degree two, for antiderivatives (antiderivative.h).
 *
 *      root of Q(y), Q = a y^2 + b y + c                 y = x, x^(1/n), exp(lambda x), cos u, sin u, tan(u/2)
 *
 *        int dy/sqrt(Q)              first kind          log or atan         put_first_kind
 *        int dy/((y - p) sqrt(Q))    third kind          area function, or atan; p from the divisors   put_third_kind
 *
 *      root of a + c sin(u)^2 or a + b cos(u)            elliptic integrals of u or u/2       put_elliptic
 *      root of k_0 + k_2 y^2 + k_4 y^4                   F, the first kind alone         first_kind_of_quartic
 *
 * Only the functions are proposed here; which of them occur, and with what coefficients, the linear system of
 * antiderivative.c decides, except for the quartic, whose integral is F itself. */
#include "exact/antiderivative_internal.h"

#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"

typedef nh_antiderivative_builder builder;
typedef nh_antiderivative_letter letter;

/* sqrt(Q) with a polynomial Q in x, or in y = x^(1/n), exp(lambda x), cos(u) or sin(u): then candidates are functions
   of y. */
typedef struct {
    nh_ex x, Q, root, back; /* the variable; back: what it stands for */
    int degree;             /* of Q */
    size_t count;           /* 0: it is x */
    /* from[i] becomes to[i], a function of y; of the other one of sine and cosine only squares are functions of y */
    nh_ex from[2], to[2];
} radical;

/* The degree, 1 or 2, of Q = a x^2 + b x + c; 0 where it is no such polynomial. */
static int coefficients_of(const builder *b, nh_ex x, nh_ex Q, nh_ex out[3])
{
    nh_dag *d = b->d;
    nh_ex zero = nh_int(d, 0), first = nh_diff(d, Q, x), second = nh_simplify_short(d, nh_diff(d, first, x), 0);
    if (nh_depends(d, second, x)) return 0;
    out[0] = nh_simplify_short(d, nh_substitute(d, Q, 1, &x, &zero), 0);
    out[1] = nh_simplify_short(d, nh_substitute(d, first, 1, &x, &zero), 0);
    out[2] = nh_mul(d, nh_ratio(d, 1, 2), second);
    return nh_is_zero(d, second) ? !nh_is_zero(d, out[1]) : 2;
}

/* y replaced by what it stands for. */
static nh_ex back(const builder *b, const radical *r, nh_ex e)
{
    return r->count ? nh_substitute(b->d, e, 1, &r->x, &r->back) : e;
}

/* exp(k log y) as y^k */
static nh_ex with_powers(nh_dag *d, nh_ex e, nh_ex y)
{
    enum { most = 32 };
    NH_LIST(call);
    nh_ex by[most];
    size_t n = nh_functions_in(d, e, &call), count = 0;
    for (size_t i = 0; i < n && i < most; i++) {
        if (nh_function_of(d, call[i]) != NH_EXP || !nh_depends(d, call[i], y)) continue;
        nh_ex k = nh_simplify_short(d, nh_mul(d, y, nh_diff(d, nh_child(d, call[i], 0), y)), 0);
        if (nh_kind_of(d, k) != NH_NUMBER) continue;
        by[count] = nh_pow(d, y, k);
        call[count++] = call[i];
    }
    return nh_substitute(d, e, count, call, by);
}

/* An expression in x written in the variable y of the radical. */
static nh_ex in_variable(const builder *b, const radical *r, nh_ex e)
{
    nh_dag *d = b->d;
    if (!r->count) return e;
    return nh_simplify_short(d, nh_canonical(d, with_powers(d, nh_substitute(d, e, r->count, r->from, r->to), r->x), 0),
                             0);
}

/* int dx/sqrt(Q): with a > 0 the logarithm of 2 sqrt(a Q) + Q', with a < 0 the arctangent of Q'/(2 sqrt(-a Q)). */
static void put_first_kind(builder *b, const radical *r, const nh_ex k[3])
{
    nh_dag *d = b->d;
    nh_ex two = nh_int(d, 2), slope = back(b, r, nh_add(d, k[1], nh_product(d, 3, (nh_ex[]){two, k[2], r->x})));
    int sign = nh_antiderivative_mostly(b, k[2]);
    if (sign > 0)
        nh_antiderivative_put_logarithm(
            b, nh_add(d, nh_product(d, 3, (nh_ex[]){two, nh_antiderivative_root(b, k[2]), r->root}), slope));
    if (sign < 0)
        nh_antiderivative_put(
            b, nh_call(d, NH_ATAN,
                       nh_div(d, slope,
                              nh_product(d, 3, (nh_ex[]){two, nh_antiderivative_root(b, nh_neg(d, k[2])), r->root}))));
}

/* int dx/((x - p) sqrt(Q)): with T = 2 Q(p) + Q'(p) (x - p) the area function of T/(2 sqrt(Q(p) Q)), or the arctangent
   for Q(p) < 0; for a Q of degree one, where T = Q(p) + Q, they are twice those of sqrt(Q/Q(p)). */
static void put_third_kind(builder *b, const radical *r, nh_ex p)
{
    nh_dag *d = b->d;
    nh_ex at = nh_simplify_short(d, nh_substitute(d, r->Q, 1, &r->x, &p), 0), slope = nh_diff(d, r->Q, r->x),
          two = nh_int(d, 2);
    slope = nh_simplify_short(d, nh_substitute(d, slope, 1, &r->x, &p), 0);
    int sign = nh_antiderivative_mostly(b, at);
    if (nh_is_zero(d, at) || sign == 0) return;
    nh_ex T = back(b, r, nh_add(d, nh_mul(d, two, at), nh_mul(d, slope, nh_sub(d, r->x, p))));
    nh_ex size = nh_antiderivative_root(b, sign > 0 ? at : nh_neg(d, at));
    nh_ex f = r->degree == 1 ? nh_div(d, r->root, size) : nh_div(d, T, nh_product(d, 3, (nh_ex[]){two, size, r->root}));
    if (sign > 0) nh_antiderivative_put_area(b, f);
    else nh_antiderivative_put(b, nh_call(d, NH_ATAN, f));
}

/* The third kind at the real zeros of the divisor p, a polynomial in y of degree one or two. */
static void put_poles(builder *b, const radical *r, nh_ex p)
{
    nh_dag *d = b->d;
    nh_ex k[3], zero = nh_int(d, 0), slope = nh_simplify_short(d, nh_diff(d, p, r->x), 0);
    if (nh_is_zero(d, slope)) return;
    if (!nh_depends(d, slope, r->x)) {
        put_third_kind(b, r, nh_neg(d, nh_div(d, nh_substitute(d, p, 1, &r->x, &zero), slope)));
    } else if (coefficients_of(b, r->x, p, k) == 2) {
        nh_ex D = nh_simplify_short(
                  d, nh_sub(d, nh_powi(d, k[1], 2), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), k[2], k[0]})), 0),
              two = nh_mul(d, nh_int(d, 2), k[2]);
        if (nh_antiderivative_sign(b, D) <= 0) return;
        put_third_kind(b, r, nh_div(d, nh_sub(d, nh_antiderivative_root(b, D), k[1]), two));
        put_third_kind(b, r, nh_neg(d, nh_div(d, nh_add(d, nh_antiderivative_root(b, D), k[1]), two)));
    }
}

/* First kind where Q has degree two, and the third for each divisor; for y = exp(lambda x) also with p = 0, because
 * dx = dy/(lambda y). */
static void put_integrals(builder *b, radical r)
{
    nh_dag *d = b->d;
    nh_ex k[3];
    bool is_exponential = r.count && nh_kind_of(d, r.back) == NH_FUNCTION && nh_function_of(d, r.back) == NH_EXP;
    r.Q = in_variable(b, &r, r.Q);
    if ((r.count && nh_depends(d, r.Q, b->in->x)) || !nh_depends(d, r.Q, r.x)) return;
    r.degree = coefficients_of(b, r.x, r.Q, k);
    if (!r.degree) return;
    if (r.degree == 2) put_first_kind(b, &r, k);
    if (is_exponential) put_third_kind(b, &r, nh_int(d, 0)); /* dx = dy/(lambda y) */
    for (size_t j = 0; j < b->divisors; j++) {
        bool other_wave = r.count == 2 && b->divisor[j].e == r.from[1];
        nh_ex p = other_wave ? nh_sub(d, nh_int(d, 1), nh_powi(d, r.x, 2)) : in_variable(b, &r, b->divisor[j].e);
        if (!r.count || !nh_depends(d, p, b->in->x)) put_poles(b, &r, p);
    }
}

/* y = exp(lambda x), exp(-lambda x), and their powers: cosh(x) is (1 + exp(2 x))/(2 exp(x)). */
static void put_root_of_exponentials(builder *b, nh_ex Q, nh_ex root, nh_ex exponential)
{
    enum { most_times = 4 };
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"),
          lambda = nh_simplify_short(d, nh_diff(d, nh_child(d, exponential, 0), b->in->x), 0);
    for (int i = 0; i < 2 * most_times && !nh_depends(d, lambda, b->in->x); i++) {
        nh_ex rate = nh_mul(d, nh_int(d, i % 2 ? -(i / 2 + 1) : i / 2 + 1), lambda);
        put_integrals(b, (radical){.x = y,
                                   .Q = Q,
                                   .root = root,
                                   .back = nh_call(d, NH_EXP, nh_mul(d, rate, b->in->x)),
                                   .count = 1,
                                   .from = {b->in->x},
                                   .to = {nh_div(d, nh_call(d, NH_LOG, y), rate)}});
    }
}

/* int du/((y - p) sqrt(Q)), Q = a + c sin(u)^2, y = cos u: with n = 1/(1 - p^2) the part that is even in y is an
 * elliptic integral of the third kind, and the odd one, with kappa^2 = a n + c, an area function or arctangent of
 * kappa sin(u)/sqrt(Q).  `square`: p^2. */
static void put_elliptic_pole(builder *b, const radical *r, nh_ex a, nh_ex c, nh_ex square, nh_ex angle, nh_ex sine)
{
    nh_dag *d = b->d;
    nh_ex apart = nh_simplify_short(d, nh_sub(d, nh_int(d, 1), square), 0);
    if (nh_is_zero(d, apart)) return; /* a pole at sin u = 0 is a function of the first two kinds */
    nh_ex n = nh_simplify_short(d, nh_powi(d, apart, -1), 0);
    nh_ex third[] = {n, angle, nh_neg(d, nh_div(d, c, a))};
    nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_PI, third));
    nh_ex kappa = nh_simplify_short(d, nh_add(d, nh_mul(d, a, n), c), 0);
    int sign = nh_antiderivative_sign(b, kappa);
    if (!sign) return;
    nh_ex f = nh_div(d, nh_mul(d, nh_antiderivative_root(b, sign > 0 ? kappa : nh_neg(d, kappa)), sine), r->root);
    if (sign > 0) nh_antiderivative_put_area(b, f);
    else nh_antiderivative_put(b, nh_call(d, NH_ATAN, f));
}

/* An angle u or u - pi/2 as an amplitude: itself, or without half turns, where elliptic integrals with m > 1 are real
 * on all of a motion about u = pi, too. */
static nh_ex amplitude(const builder *b, nh_ex u, bool turned)
{
    nh_dag *d = b->d;
    nh_ex sine = nh_call(d, NH_SIN, u), cosine = nh_call(d, NH_COS, u);
    if (!b->in->within_half_turn) return turned ? nh_sub(d, u, nh_mul(d, nh_ratio(d, 1, 2), nh_pi(d))) : u;
    if (turned) return nh_neg(d, nh_call(d, NH_ATAN, nh_div(d, cosine, sine)));
    return nh_call(d, NH_ATAN, nh_div(d, sine, cosine));
}

/* Those of Q = k_0 + k_1 cos u = (k_0 + k_1)(1 - m sin(u/2)^2), and of poles p_0 + p_1 cos u; from u = pi on where Q is
 * positive only there. */
static void put_elliptic_of_half(builder *b, const radical *r, const nh_ex k[3], nh_ex angle)
{
    nh_dag *d = b->d;
    nh_ex two = nh_int(d, 2), first = k[1], a = nh_simplify_short(d, nh_add(d, k[0], first), 0);
    bool turned = nh_antiderivative_sign(b, a) <= 0;
    if (turned) {
        first = nh_neg(d, first);
        a = nh_simplify_short(d, nh_add(d, k[0], first), 0);
        if (nh_antiderivative_sign(b, a) <= 0) return;
    }
    nh_ex half = amplitude(b, nh_mul(d, nh_ratio(d, 1, 2), angle), turned);
    nh_ex m = nh_simplify_short(d, nh_div(d, nh_mul(d, two, first), a), 0);
    nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_F, (nh_ex[]){half, m}));
    nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_EINC, (nh_ex[]){half, m}));
    for (size_t j = 0; j < b->divisors; j++) {
        nh_ex p[3], e = in_variable(b, r, b->divisor[j].e);
        if (nh_depends(d, e, b->in->x) || coefficients_of(b, r->x, e, p) != 1) continue;
        nh_ex slope = turned ? nh_neg(d, p[1]) : p[1], sum = nh_simplify_short(d, nh_add(d, p[0], slope), 0);
        if (nh_is_zero(d, sum)) continue; /* a pole at u = 0 is a function of the first two kinds */
        nh_ex n = nh_simplify_short(d, nh_div(d, nh_mul(d, two, slope), sum), 0);
        nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_PI, (nh_ex[]){n, half, m}));
    }
}

/* The elliptic integrals of Q = k_0 + k_2 cos(u)^2 that is positive where the cosine is 1, and those of the poles. */
static void put_elliptic(builder *b, nh_ex Q, nh_ex root, nh_ex cosine, nh_ex sine)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), other = nh_sqrt(d, nh_sub(d, nh_int(d, 1), nh_powi(d, y, 2)));
    nh_ex k[3], angle = nh_child(d, sine, 0);
    radical r = {y, Q, root, cosine, 0, 2, {cosine, sine}, {y, other}};
    r.Q = in_variable(b, &r, r.Q);
    int kind = nh_depends(d, r.Q, b->in->x) ? 0 : coefficients_of(b, r.x, r.Q, k);
    if (kind == 1) put_elliptic_of_half(b, &r, k, angle);
    if (kind != 2 || !nh_is_zero(d, k[1])) return;
    nh_ex a = nh_simplify_short(d, nh_add(d, k[0], k[2]), 0), c = nh_neg(d, k[2]);
    if (nh_antiderivative_sign(b, a) <= 0) {
        if (nh_antiderivative_sign(b, k[0]) <= 0) return; /* a quarter turn further: k_0 (1 - m sin^2) */
        nh_ex quarter = amplitude(b, angle, true);
        nh_ex turned[] = {quarter, nh_simplify_short(d, nh_neg(d, nh_div(d, k[2], k[0])), 0)};
        nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_F, turned));
        nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_EINC, turned));
        return;
    }
    angle = amplitude(b, angle, false);
    nh_ex argument[] = {angle, nh_simplify_short(d, nh_neg(d, nh_div(d, c, a)), 0)};
    nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_F, argument));
    nh_antiderivative_put(b, nh_call_any(d, NH_ELLIPTIC_EINC, argument));
    for (size_t j = 0; j < b->divisors; j++) {
        nh_ex p[3], e = in_variable(b, &r, b->divisor[j].e);
        int degree = nh_depends(d, e, b->in->x) ? 0 : coefficients_of(b, r.x, e, p);
        if (degree == 2 && nh_is_zero(d, p[1])) {
            put_elliptic_pole(b, &r, a, c, nh_neg(d, nh_div(d, p[0], p[2])), angle, sine);
        } else if (degree == 1) {
            put_elliptic_pole(b, &r, a, c, nh_powi(d, nh_div(d, p[0], p[1]), 2), angle, sine);
        } else if (degree == 2) {
            nh_ex D = nh_sub(d, nh_powi(d, p[1], 2), nh_product(d, 3, (nh_ex[]){nh_int(d, 4), p[2], p[0]}));
            D = nh_simplify_short(d, D, 0);
            if (nh_antiderivative_sign(b, D) <= 0) continue;
            nh_ex half = nh_antiderivative_root(b, D), twice = nh_mul(d, nh_int(d, 2), p[2]);
            for (int side = -1; side <= 1; side += 2) {
                nh_ex at = nh_div(d, nh_sub(d, nh_mul(d, nh_int(d, side), half), p[1]), twice);
                put_elliptic_pole(b, &r, a, c, nh_powi(d, at, 2), angle, sine);
            }
        }
    }
}

/* y = tan(u/2) = sin u/(1 + cos u), where Q/(1 + cos u)^2 = k_0 + k_2 y^2: int du/sqrt(Q/(1 + cos u)^2) has a pole at
 * y^2 = -1, with the arctangent or area function of sqrt(k_0 - k_2) y/sqrt(Q). */
static void put_root_of_half_angle(builder *b, nh_ex Q, nh_ex root, nh_ex cosine, nh_ex sine)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), one = nh_int(d, 1), square = nh_powi(d, y, 2), above = nh_add(d, one, cosine),
          below = nh_add(d, one, square), k[3];
    radical r = {.x = y,
                 .Q = nh_div(d, Q, nh_powi(d, above, 2)),
                 .root = nh_div(d, root, above),
                 .back = nh_div(d, sine, above),
                 .count = 2,
                 .from = {cosine, sine},
                 .to = {nh_div(d, nh_sub(d, one, square), below), nh_div(d, nh_mul(d, nh_int(d, 2), y), below)}};
    r.Q = in_variable(b, &r, r.Q);
    if (nh_depends(d, r.Q, b->in->x) || coefficients_of(b, y, r.Q, k) != 2 || !nh_is_zero(d, k[1])) return;
    put_first_kind(b, &r, k);
    nh_ex at = nh_simplify_short(d, nh_sub(d, k[0], k[2]), 0);
    int sign = nh_antiderivative_sign(b, at);
    if (!sign) return;
    nh_ex f = nh_div(d, nh_mul(d, nh_antiderivative_root(b, sign > 0 ? at : nh_neg(d, at)), r.back), r.root);
    if (sign > 0) nh_antiderivative_put(b, nh_call(d, NH_ATAN, f));
    else nh_antiderivative_put_area(b, f);
}

/* y = cos u and sin u */
static void put_root_of_waves(builder *b, nh_ex Q, nh_ex root, nh_ex cosine, nh_ex sine)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), other = nh_sqrt(d, nh_sub(d, nh_int(d, 1), nh_powi(d, y, 2)));
    put_integrals(b, (radical){y, Q, root, cosine, 0, 2, {cosine, sine}, {y, other}});
    put_integrals(b, (radical){y, Q, root, sine, 0, 2, {sine, cosine}, {y, other}});
    put_root_of_half_angle(b, Q, root, cosine, sine);
}

/* y = x^(1/n) */
static void put_root_of_powers(builder *b, nh_ex Q, nh_ex root, int64_t n)
{
    nh_dag *d = b->d;
    nh_ex y = nh_symbol_fresh(d, "y"), log_y = nh_call(d, NH_LOG, y);
    put_integrals(b, (radical){.x = y,
                               .Q = Q,
                               .root = root,
                               .back = nh_pow(d, b->in->x, nh_ratio(d, 1, n)),
                               .count = 1,
                               .from = {b->in->x},
                               .to = {nh_call(d, NH_EXP, nh_mul(d, nh_int(d, n), log_y))}});
}

/* Q = k_0 + k_2 y^2 + k_4 y^4? */
static bool is_even_quartic(const builder *b, nh_ex y, nh_ex Q, nh_ex k[5])
{
    nh_dag *d = b->d;
    nh_ex slope = Q, zero = nh_int(d, 0);
    for (int i = 0; i <= 4; i++) {
        k[i] = slope;
        slope = nh_simplify_short(d, nh_mul(d, nh_ratio(d, 1, i + 1), nh_diff(d, slope, y)), 0);
    }
    if (!nh_is_zero(d, slope)) return false; /* it is no polynomial, and may have no value at 0 */
    for (int i = 0; i <= 4; i++) k[i] = nh_simplify_short(d, nh_substitute(d, k[i], 1, &y, &zero), 0);
    return nh_is_zero(d, k[1]) && nh_is_zero(d, k[3]) && !nh_is_zero(d, k[4]);
}

/* With the sign of k_0, or that of k_4, only known to be positive, or negative: that of the other one may change. */
static nh_ex first_kind_of_either_sign(const builder *b, const nh_ex k[5], nh_ex y, nh_ex root)
{
    nh_dag *d = b->d;
    nh_ex two = nh_int(d, 2), four = nh_int(d, 4), half = nh_ratio(d, 1, 2), unit = nh_neg(d, k[4]);
    bool ends = nh_antiderivative_sign(b, k[4]) < 0; /* the motion ends at the largest zero of Q */
    if (!ends && nh_antiderivative_sign(b, k[0]) <= 0) return 0;
    nh_ex D = nh_sub(d, nh_powi(d, k[2], 2), nh_product(d, 3, (nh_ex[]){four, k[0], k[4]}));
    D = nh_simplify_short(d, D, 0);
    if (nh_antiderivative_sign(b, D) <= 0) return 0;
    nh_ex apart = nh_sqrt(d, D), square = nh_mul(d, half, nh_add(d, k[2], apart));
    if (nh_antiderivative_sign(b, square) <= 0) return 0;
    nh_ex above = nh_add(d, nh_add(d, apart, k[2]), nh_product(d, 3, (nh_ex[]){two, k[4], nh_powi(d, y, 2)}));
    nh_ex tangent = ends ? nh_div(d, above, nh_product(d, 3, (nh_ex[]){two, nh_sqrt(d, unit), root}))
                         : nh_mul(d, nh_sqrt(d, nh_div(d, square, k[0])), y);
    nh_ex F = nh_call_any(d, NH_ELLIPTIC_F, (nh_ex[]){nh_call(d, NH_ATAN, tangent), nh_div(d, apart, square)});
    nh_ex value = nh_div(d, F, nh_sqrt(d, square));
    return ends ? nh_neg(d, nh_mul(d, nh_call(d, NH_SIGN, y), value)) : value;
}

/* int dy/root, root^2 = Q = k_0 + k_2 y^2 + k_4 y^4.  For k_0 k_4 < 0, with D = k_2^2 - 4 k_0 k_4, and for positive k_0
 * and k_4:
 *
 *     F(2 atan(D^(1/4) y/root) | 1/2 + k_2/(2 sqrt(D)))/(2 D^(1/4)),  of the sign of k_0,
 *     F(2 atan((k_4/k_0)^(1/4) y) | 1/2 - k_2/(4 sqrt(k_0 k_4)))/(2 (k_0 k_4)^(1/4))
 *
 * because 1 - m sin^2 of the amplitude is the square of (k_0 - k_4 y^4)/(Q + sqrt(D) y^2), and Q over the square of
 * sqrt(k_0) + sqrt(k_4) y^2.  For k_4 < 0, whatever the sign of k_0, from the largest zero of Q to 0 or another zero
 *
 *     -sign(y) F(atan((sqrt(D) + k_2 + 2 k_4 y^2)/(2 sqrt(-k_4) root)) | sqrt(D)/s^2)/s,   s^2 = (k_2 + sqrt(D))/2
 *
 * where 1 - m sin^2 is -k_4 y^2/s^2; and for k_0 > 0, whatever the sign of k_4, if D and s^2 are positive,
 *
 *     F(atan(s y/sqrt(k_0)) | sqrt(D)/s^2)/s
 *
 * because Q = k_0 (1 + s^2 y^2/k_0) (1 + (s^2 - sqrt(D)) y^2/k_0).  The root may have either sign where it stands in
 * the amplitude.  0: none of them. */
static nh_ex first_kind_of_quartic(const builder *b, const nh_ex k[5], nh_ex y, nh_ex root)
{
    nh_dag *d = b->d;
    nh_ex half = nh_ratio(d, 1, 2), quarter = nh_ratio(d, 1, 4), two = nh_int(d, 2), size, m, tangent;
    int first = nh_antiderivative_sign(b, k[0]), last = nh_antiderivative_sign(b, k[4]);
    if (first * last < 0) {
        nh_ex unit = last < 0 ? nh_neg(d, k[4]) : k[4], middle = nh_simplify_short(d, nh_div(d, k[2], unit), 0);
        nh_ex ends = nh_simplify_short(d, nh_div(d, nh_mul(d, nh_int(d, 4), k[0]), k[4]), 0);
        nh_ex D = nh_simplify_short(d, nh_sub(d, nh_powi(d, middle, 2), ends), 0);
        size = nh_mul(d, nh_sqrt(d, unit), nh_pow(d, D, quarter));
        m = nh_mul(d, half, nh_add(d, nh_int(d, 1), nh_div(d, middle, nh_sqrt(d, D))));
        tangent = nh_div(d, nh_mul(d, size, y), root);
        if (first < 0) size = nh_neg(d, size);
    } else if (first > 0 && last > 0) {
        nh_ex ratio = nh_simplify_short(d, nh_div(d, k[4], k[0]), 0), middle = nh_div(d, k[2], k[0]);
        middle = nh_mul(d, half, nh_simplify_short(d, middle, 0));
        size = nh_mul(d, nh_pow(d, ratio, quarter), nh_sqrt(d, k[0]));
        m = nh_mul(d, half, nh_sub(d, nh_int(d, 1), nh_div(d, middle, nh_sqrt(d, ratio))));
        tangent = nh_mul(d, nh_pow(d, ratio, quarter), y);
    } else {
        return first_kind_of_either_sign(b, k, y, root);
    }
    nh_ex angle = nh_mul(d, two, nh_call(d, NH_ATAN, tangent));
    return nh_div(d, nh_call_any(d, NH_ELLIPTIC_F, (nh_ex[]){angle, m}), nh_mul(d, two, size));
}

/* y = tan(u/2), with 1 + y^2 = 2/(1 + cos u), or y = tanh(u/2), with 1 - y^2 = 1/cosh(u/2)^2, and the root times that:
 * of a form in cos u or cosh u of degree two it is that of a quartic, and dy/root is u'/2 dx over the first root. */
typedef struct {
    nh_ex y, back, factor, rate; /* rate: u'/2 */
    nh_ex P;                     /* of the root in y; it still depends on x where it is no function of y */
} half_argument;

/* Q in y: cos u = (1 - y^2)/(1 + y^2), sin u = 2 y/(1 + y^2), or exp(u) = (1 + y)/(1 - y); P = Q factor^2, factor = 1
 * + y^2 or 1 - y^2. False where P still contains x. */
static bool half_argument_of(const builder *b, const letter *l, nh_ex Q, half_argument *h)
{
    nh_dag *d = b->d;
    nh_ex one = nh_int(d, 1), y = nh_symbol_fresh(d, "y"), square = nh_powi(d, y, 2), half = nh_ratio(d, 1, 2);
    if (l->kind != NH_KERNEL_COS && l->kind != NH_KERNEL_EXP) return false;
    nh_ex u = nh_child(d, l->e, 0), rate = nh_simplify_short(d, nh_diff(d, u, b->in->x), 0);
    if (nh_depends(d, rate, b->in->x)) return false;
    *h = (half_argument){.y = y, .rate = nh_mul(d, half, rate)};
    if (l->kind == NH_KERNEL_COS) {
        nh_ex sine = nh_kernel_power(&b->form.kernels, b->form.kernels.item[l->index].partner, 1);
        h->back = nh_call(d, NH_TAN, nh_mul(d, half, u));
        h->factor = nh_add(d, one, square);
        nh_ex to[] = {nh_div(d, nh_sub(d, one, square), h->factor), nh_div(d, nh_mul(d, nh_int(d, 2), y), h->factor)};
        h->P = nh_substitute(d, Q, 2, (nh_ex[]){l->e, sine}, to);
    } else {
        nh_ex z = nh_symbol_fresh(d, "z"), quotient = nh_div(d, nh_add(d, one, y), nh_sub(d, one, y));
        radical r = {.x = z, .count = 1, .from = {b->in->x}, .to = {nh_div(d, nh_call(d, NH_LOG, z), rate)}};
        h->back = nh_call(d, NH_TANH, nh_mul(d, half, u));
        h->factor = nh_sub(d, one, square);
        h->P = nh_substitute(d, in_variable(b, &r, Q), 1, &z, &quotient);
    }
    h->P = nh_simplify_short(d, nh_canonical(d, nh_mul(d, h->P, nh_powi(d, h->factor, 2)), 0), 0);
    return !nh_depends(d, h->P, b->in->x);
}

bool nh_antiderivative_elliptic_quartic(const builder *b, nh_ex f, bool halves, nh_ex *F)
{
    const nh_kernel *kernel = b->form.kernels.item;
    nh_dag *d = b->d;
    nh_ex k[5], x = b->in->x;
    for (size_t i = 0; i < b->letters; i++) {
        const letter *u = &b->letter[i];
        if (u->kind != NH_KERNEL_ROOT || kernel[u->index].unit.q != 2) continue;
        nh_ex Q = kernel[u->index].atom, c = nh_simplify_short(d, nh_mul(d, f, u->e), 0), value = 0;
        if (nh_depends(d, c, x)) continue;
        if (!halves) value = is_even_quartic(b, x, Q, k) ? first_kind_of_quartic(b, k, x, u->e) : 0;
        for (size_t j = 0; j < b->letters && halves && !value; j++) {
            half_argument h;
            if (!half_argument_of(b, &b->letter[j], Q, &h) || !is_even_quartic(b, h.y, h.P, k)) continue;
            nh_ex factor = nh_substitute(d, h.factor, 1, &h.y, &h.back);
            value = first_kind_of_quartic(b, k, h.back, nh_mul(d, factor, u->e));
            if (value) value = nh_div(d, value, h.rate);
        }
        if (!value) continue;
        *F = nh_mul(d, c, value);
        return true;
    }
    return false;
}

void nh_antiderivative_put_elliptic(builder *b)
{
    const nh_kernel *k = b->form.kernels.item;
    for (size_t i = 0; i < b->letters; i++) {
        const letter *u = &b->letter[i];
        if (u->kind != NH_KERNEL_ROOT || k[u->index].unit.q != 2) continue;
        for (size_t j = 0; j < b->letters; j++) {
            const letter *l = &b->letter[j];
            if (l->kind != NH_KERNEL_COS) continue;
            put_elliptic(b, k[u->index].atom, u->e, l->e, nh_kernel_power(&b->form.kernels, k[l->index].partner, 1));
        }
    }
}

/* One root of f: in x itself, then in each y that f's letters offer. */
static void put_root(builder *b, nh_ex Q, nh_ex root)
{
    put_integrals(b, (radical){.x = b->in->x, .Q = Q, .root = root});
    for (size_t i = 0; i < b->letters; i++) {
        const letter *l = &b->letter[i];
        const nh_kernel *k = &b->form.kernels.item[l->index];
        if (l->kind == NH_KERNEL_ROOT && k->atom == b->in->x) put_root_of_powers(b, Q, root, k->unit.q);
        if (l->kind == NH_KERNEL_EXP) put_root_of_exponentials(b, Q, root, l->e);
        if (l->kind == NH_KERNEL_COS)
            put_root_of_waves(b, Q, root, l->e,
                              nh_kernel_power(&b->form.kernels, b->form.kernels.item[l->index].partner, 1));
    }
}

void nh_antiderivative_put_roots(builder *b)
{
    const nh_kernel *k = b->form.kernels.item;
    for (size_t i = 0; i < b->letters; i++) {
        const letter *u = &b->letter[i];
        if (u->kind != NH_KERNEL_ROOT || k[u->index].unit.q != 2) continue;
        put_root(b, k[u->index].atom, u->e);
        for (size_t j = 0; j < i; j++) {
            const letter *v = &b->letter[j];
            if (v->kind == NH_KERNEL_ROOT && k[v->index].unit.q == 2)
                put_root(b, nh_mul(b->d, k[u->index].atom, k[v->index].atom), nh_mul(b->d, u->e, v->e));
        }
    }
}
