/* named_match: which equation is it? [docs/method.md, sec. 10, (31a)]
 *
 *     add_poles       the zeros of denominators of P and Q: real points, and a conjugate pair
 *     three_points    three regular singular points, infinity among them or regular: Gauss's function
 *     conjugate       a pair, moved to +-i: Riemann's equation in real form, elementary where b = 0, c = l (l + 1)
 *     confluent       at most one point, moved to 0: u = g v, v'' = R v: powers, Bessel, Airy, Kummer */
#include "integrals/named_coefficients.h"

#include <math.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_points = 3, most_factors = 64 };

typedef struct {
    nh_dag *d;
    nh_ex x;
    nh_ex p, q, meaning;
    nh_named_value_of *value;
    void *context;
} matcher;

static nh_ex simple(nh_dag *d, nh_ex e) { return nh_simplify_short(d, e, 0); }
static nh_ex number(matcher *m, int64_t top, int64_t bottom) { return nh_ratio(m->d, top, bottom); }
static nh_ex times(matcher *m, nh_ex a, nh_ex b) { return nh_mul(m->d, a, b); }
static nh_ex plus(matcher *m, nh_ex a, nh_ex b) { return nh_add(m->d, a, b); }
static nh_ex over(matcher *m, nh_ex a, nh_ex b) { return nh_div(m->d, a, b); }
static nh_ex shifted(matcher *m, nh_ex a, int64_t top, int64_t bottom)
{
    return nh_add(m->d, a, number(m, top, bottom));
}

/* The expression with the meaning of the variable substituted. */
static double value_of(matcher *m, nh_ex e)
{
    return m->value(m->context, nh_substitute(m->d, e, 1, &m->x, &m->meaning));
}
static bool is_zero(matcher *m, nh_ex e) { return nh_normal_is_zero(m->d, e, 0) == NH_ZERO; }
static nh_ex put_in(matcher *m, nh_ex e, nh_ex place) { return simple(m->d, nh_substitute(m->d, e, 1, &m->x, &place)); }

/* sqrt(e) without roots of squares: the root of b^2 is b or -b, whichever is positive here. */
static nh_ex root(matcher *m, nh_ex e)
{
    nh_dag *d = m->d;
    e = simple(d, e);
    if (nh_kind_of(d, e) != NH_PRODUCT) return nh_sqrt(d, e);
    nh_ex even = nh_int(d, 1), rest = nh_number(d, nh_constant_of(d, e));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex base = nh_child(d, e, i), exponent = nh_exponent_of(d, e, i);
        nh_num x = nh_kind_of(d, exponent) == NH_NUMBER ? nh_number_of(d, exponent) : nh_num_real(0.5);
        bool square = nh_num_short(x) && x.q == 1 && x.p % 2 == 0;
        if (square) even = times(m, even, nh_powi(d, base, x.p / 2));
        else rest = times(m, rest, nh_pow(d, base, exponent));
    }
    return times(m, value_of(m, even) < 0 ? nh_neg(d, even) : even, nh_sqrt(d, rest));
}

/* ---- singular points ---- */

typedef struct {
    nh_ex at;
    bool infinite;
    nh_ex sum, product; /* of its two exponents */
} singular;

/* Real ones, and a conjugate pair middle +- i height. */
typedef struct {
    size_t count;
    singular of[most_points + 1];
    bool pair;
    nh_ex middle, height;
} points;

static bool add_point(matcher *m, points *s, nh_ex at)
{
    for (size_t i = 0; i < s->count; i++)
        if (is_zero(m, nh_sub(m->d, s->of[i].at, at))) return true;
    if (s->count == most_points) return false;
    s->of[s->count++].at = at;
    return true;
}

/* A second pair that is another one ends the match. */
static bool add_pair(matcher *m, points *s, nh_ex middle, nh_ex height)
{
    if (s->pair)
        return is_zero(m, nh_sub(m->d, s->middle, middle)) &&
               is_zero(m, nh_sub(m->d, nh_powi(m->d, s->height, 2), nh_powi(m->d, height, 2)));
    s->pair = true;
    s->middle = middle;
    s->height = height;
    return true;
}

/* The zeros of a factor c0 + c1 x + c2 x^2. */
static bool add_zeros(matcher *m, points *s, nh_ex factor)
{
    nh_dag *d = m->d;
    nh_ex zero = nh_int(d, 0), first = simple(d, nh_diff(d, factor, m->x)), second = simple(d, nh_diff(d, first, m->x));
    nh_ex c0 = put_in(m, factor, zero), c1 = put_in(m, first, zero), c2 = simple(d, times(m, second, number(m, 1, 2)));
    if (nh_depends(d, c2, m->x)) return false;
    if (nh_is_zero(d, c2)) return add_point(m, s, simple(d, nh_neg(d, over(m, c0, c1))));
    nh_ex discriminant = nh_sub(d, nh_powi(d, c1, 2), times(m, nh_int(d, 4), times(m, c0, c2)));
    double sign = value_of(m, discriminant);
    if (!isfinite(sign) || sign == 0) return false;
    nh_ex r = root(m, sign < 0 ? nh_neg(d, discriminant) : discriminant), below = times(m, nh_int(d, 2), c2);
    if (sign < 0) return add_pair(m, s, simple(d, nh_neg(d, over(m, c1, below))), simple(d, over(m, r, below)));
    return add_point(m, s, simple(d, over(m, nh_sub(d, r, c1), below))) &&
           add_point(m, s, simple(d, nh_neg(d, over(m, plus(m, r, c1), below))));
}

/* The zeros of denominators. */
static bool add_poles(matcher *m, points *s, nh_ex e)
{
    NH_LIST(product);
    size_t n = nh_products_in(m->d, e, &product);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < nh_arity(m->d, product[i]); j++) {
            nh_ex base = nh_child(m->d, product[i], j), exponent = nh_exponent_of(m->d, product[i], j);
            bool below = nh_kind_of(m->d, exponent) == NH_NUMBER && nh_num_value(nh_number_of(m->d, exponent)) < 0;
            if (below && nh_depends(m->d, base, m->x) && !add_zeros(m, s, base)) return false;
        }
    return n <= most_factors;
}

/* r^2 + (A - 1) r + B = 0 with A = -lim (x - a) P, B = -lim (x - a)^2 Q; at
 * infinity r^2 + (1 - A) r + B = 0 with x instead of x - a. */
static bool exponents(matcher *m, singular *s)
{
    nh_dag *d = m->d;
    nh_ex away = s->infinite ? nh_powi(d, m->x, -1) : nh_sub(d, m->x, s->at), unit = s->infinite ? m->x : away,
          one = nh_int(d, 1);
    nh_ex A = nh_neg(d, times(m, unit, m->p)), B = nh_neg(d, times(m, nh_powi(d, unit, 2), m->q)),
          y = nh_symbol(d, "the reciprocal of a variable");
    if (s->infinite) {
        nh_ex back = nh_powi(d, y, -1);
        A = nh_substitute(d, A, 1, &m->x, &back);
        B = nh_substitute(d, B, 1, &m->x, &back);
    }
    nh_ex symbol = s->infinite ? y : m->x, place = s->infinite ? nh_int(d, 0) : s->at;
    A = simple(d, nh_substitute(d, simple(d, A), 1, &symbol, &place));
    B = simple(d, nh_substitute(d, simple(d, B), 1, &symbol, &place));
    s->sum = s->infinite ? nh_sub(d, A, one) : nh_sub(d, one, A);
    s->product = B;
    return isfinite(value_of(m, A)) && isfinite(value_of(m, B));
}

/* ---- Gauss ---- */

/* z = (x - p0)(p1 - p2)/((x - p2)(p1 - p0)): 0, 1, infinity at the three
 * points; factors with the infinite one cancel. */
static nh_ex moebius(matcher *m, const singular *p0, const singular *p1, const singular *p2)
{
    nh_dag *d = m->d;
    nh_ex z = nh_int(d, 1);
    if (!p0->infinite) z = times(m, z, nh_sub(d, m->x, p0->at));
    if (!p2->infinite) z = over(m, z, nh_sub(d, m->x, p2->at));
    if (!p1->infinite && !p2->infinite) z = times(m, z, nh_sub(d, p1->at, p2->at));
    if (!p1->infinite && !p0->infinite) z = over(m, z, nh_sub(d, p1->at, p0->at));
    return simple(d, z);
}

/* The larger exponent, and half the difference of the two; false where they are
 * not real. */
static bool larger(matcher *m, const singular *s, nh_ex *exponent, nh_ex *half)
{
    nh_ex middle = times(m, s->sum, number(m, 1, 2)),
          apart = simple(m->d, nh_sub(m->d, nh_powi(m->d, middle, 2), s->product));
    if (value_of(m, apart) < 0) return false;
    *half = nh_is_zero(m->d, apart) ? apart : root(m, apart);
    *exponent = simple(m->d, plus(m, middle, *half));
    return true;
}

/* 2F1 with a + b = s, a b = p: Legendre's function, by its parameters, or by s
 * and p. */
static nh_ex gauss(matcher *m, nh_ex s, nh_ex p, nh_ex c, nh_ex z)
{
    nh_dag *d = m->d;
    nh_ex apart = simple(d, nh_sub(d, times(m, nh_powi(d, s, 2), number(m, 1, 4)), p)),
          half = times(m, s, number(m, 1, 2));
    nh_ex all[4] = {s, p, c, z};
    if (value_of(m, apart) < 0) return nh_call_any(d, NH_GAUSS_F, all);
    nh_ex r = root(m, apart);
    if (nh_is_number(d, s, 1) && nh_is_number(d, c, 1)) {
        nh_ex legendre[2] = {simple(d, nh_sub(d, r, number(m, 1, 2))),
                             simple(d, nh_sub(d, nh_int(d, 1), times(m, nh_int(d, 2), z)))};
        return nh_call_any(d, NH_LEGENDRE_P, legendre);
    }
    all[0] = simple(d, plus(m, half, r));
    all[1] = simple(d, nh_sub(d, half, r));
    return nh_call_any(d, NH_HYP2F1, all);
}

/* z^r0 (1 - z)^r1 2F1(a, b; c; z) with a + b = 2 (r0 + r1) + sum at the third,
 * c = 1 + r0 - r0'. */
static bool around(matcher *m, const singular *p0, const singular *p1, const singular *p2, nh_ex *out)
{
    nh_dag *d = m->d;
    nh_ex z = moebius(m, p0, p1, p2), r0, r1, half0, half1;
    double at = value_of(m, z);
    if (!(at > 0 && at < 1) || !larger(m, p0, &r0, &half0) || !larger(m, p1, &r1, &half1)) return false;
    nh_ex both = simple(d, plus(m, r0, r1)), s = simple(d, plus(m, times(m, nh_int(d, 2), both), p2->sum));
    nh_ex p = simple(d, plus(m, nh_powi(d, both, 2), plus(m, times(m, both, p2->sum), p2->product)));
    nh_ex c = simple(d, plus(m, nh_int(d, 1), times(m, nh_int(d, 2), half0))),
          other = simple(d, nh_sub(d, nh_int(d, 1), z));
    *out = nh_product(d, 3, (nh_ex[]){nh_pow(d, z, r0), nh_pow(d, other, r1), gauss(m, s, p, c, z)});
    return true;
}

/* Two solutions around p0 and p1, where the variable lies between them; the third point is each in turn. */
static size_t three_points(matcher *m, points *s, nh_ex out[2])
{
    s->of[s->count] = (singular){.infinite = true};
    for (size_t i = 0; i <= s->count; i++)
        if (!exponents(m, &s->of[i])) return 0;
    size_t n = s->count + 1;
    if (n == 4) { /* infinity must be a regular point: exponents 0 and 1 */
        n = 3;
        if (!nh_is_zero(m->d, s->of[3].product)) return 0;
    }
    if (n != 3) return 0;
    for (size_t last = n; last-- > 0;) {
        const singular *p0 = &s->of[(last + 1) % 3], *p1 = &s->of[(last + 2) % 3], *p2 = &s->of[last];
        if (around(m, p0, p1, p2, &out[0])) return around(m, p1, p0, p2, &out[1]) ? 2 : 1;
    }
    return 0;
}

/* ---- v'' = R v ---- */

/* g with g'/g = P/2, for P = sum of c_k x^k with whole k >= -1; a power may
 * have a symbol. */
static bool gauge(matcher *m, nh_ex *g)
{
    enum { most_degree = 6 };
    nh_dag *d = m->d;
    nh_ex term = simple(d, times(m, m->x, m->p)), zero = nh_int(d, 0), sum = zero, factorial = nh_int(d, 1);
    nh_ex first = put_in(m, term, zero);
    if (!isfinite(value_of(m, first))) return false;
    for (int k = 1; k <= most_degree; k++) {
        term = simple(d, nh_diff(d, term, m->x));
        factorial = times(m, factorial, nh_int(d, k));
        nh_ex c = over(m, put_in(m, term, zero), factorial);
        if (!isfinite(value_of(m, c))) return false;
        sum = plus(m, sum, over(m, times(m, c, nh_powi(d, m->x, k)), nh_int(d, 2 * k)));
    }
    if (!is_zero(m, nh_diff(d, term, m->x))) return false;
    *g = times(m, nh_pow(d, m->x, times(m, first, number(m, 1, 2))), nh_call(d, NH_EXP, simple(d, sum)));
    return true;
}

static size_t pair(matcher *m, nh_ex front, nh_function f, nh_function h, nh_ex n, nh_ex z, nh_ex out[2])
{
    nh_ex all[2] = {n, z};
    bool airy = f == NH_AIRY_AI;
    out[0] = times(m, front, nh_call_any(m->d, f, airy ? &z : all));
    out[1] = times(m, front, nh_call_any(m->d, h, airy ? &z : all));
    return 2;
}

/* R = A x^m + B/x^2: W = x^2 R has W' = (m + 2) A x^(m + 1). */
static size_t bessel(matcher *m, nh_ex R, nh_ex out[2])
{
    nh_dag *d = m->d;
    nh_ex W = simple(d, times(m, R, nh_powi(d, m->x, 2))), slope = simple(d, nh_diff(d, W, m->x));
    if (nh_is_zero(d, slope)) return 0;
    nh_ex k = simple(d, over(m, times(m, m->x, nh_diff(d, slope, m->x)), slope));
    if (nh_depends(d, k, m->x)) return 0;
    nh_ex e = shifted(m, k, 1, 1), A = simple(d, over(m, slope, times(m, e, nh_pow(d, m->x, k)))); /* e = m + 2 */
    nh_ex B = simple(d, nh_sub(d, W, times(m, A, nh_pow(d, m->x, e))));
    double sign = value_of(m, A), square = value_of(m, B);
    if (nh_depends(d, A, m->x) || nh_depends(d, B, m->x) || 1 + 4 * square < 0 || value_of(m, e) == 0) return 0;
    if (nh_is_number(d, e, 3) && nh_is_zero(d, B)) {
        nh_ex positive = sign < 0 ? nh_neg(d, A) : A, third = nh_pow(d, positive, number(m, 1, 3));
        nh_ex z = times(m, third, m->x);
        return pair(m, nh_int(d, 1), NH_AIRY_AI, NH_AIRY_BI, 0, sign < 0 ? nh_neg(d, z) : z, out);
    }
    nh_ex n = simple(d, over(m, root(m, shifted(m, times(m, nh_int(d, 4), B), 1, 1)), e)),
          size = root(m, sign < 0 ? nh_neg(d, A) : A);
    if (value_of(m, n) < 0) n = nh_neg(d, n);
    nh_ex z =
        times(m, over(m, times(m, nh_int(d, 2), size), e), nh_pow(d, m->x, simple(d, times(m, e, number(m, 1, 2)))));
    if (value_of(m, e) < 0) z = nh_neg(d, z);
    return pair(m, nh_sqrt(d, m->x), sign < 0 ? NH_BESSEL_J : NH_BESSEL_I, sign < 0 ? NH_BESSEL_Y : NH_BESSEL_K, n, z,
                out);
}

static size_t kummer(matcher *m, nh_ex front, nh_ex a, nh_ex b, nh_ex z, nh_ex out[2])
{
    nh_ex all[3] = {simple(m->d, a), simple(m->d, b), z};
    out[0] = times(m, front, nh_call_any(m->d, NH_HYP1F1, all));
    out[1] = times(m, front, nh_call_any(m->d, NH_HYPERU, all));
    return 2;
}

/* The coefficients of a polynomial of x up to x^4; false where it is none. */
static bool quartic(matcher *m, nh_ex e, nh_ex c[5])
{
    nh_dag *d = m->d;
    nh_ex zero = nh_int(d, 0);
    static const int64_t factorial[5] = {1, 1, 2, 6, 24};
    for (int k = 0; k < 5; k++) {
        c[k] = simple(d, over(m, put_in(m, e, zero), nh_int(d, factorial[k])));
        if (!isfinite(value_of(m, c[k]))) return false;
        e = simple(d, nh_diff(d, e, m->x));
    }
    return is_zero(m, e);
}

/* x^2 R = A x^2 + B x + C: v = x^(1/2 + n) exp(-k x) M(1/2 + n + B/(2 k), 1 + 2
 * n, 2 k x), k^2 = A, n^2 = 1/4 + C [DLMF 13.14.2]; x^2 R = A x^4 + B x^2 + C:
 * v = x^(1/2 + n) exp(-k x^2/2) M((1 + n)/2 + B/(4 k), 1 + n, k x^2).
 * The other solution has U for M; or -n for n where that is another one: for n
 * = 1/2 both are analytic at x = 0, where U has a branch point. */
static size_t whittaker(matcher *m, nh_ex R, nh_ex out[2])
{
    nh_dag *d = m->d;
    nh_ex c[5], x = m->x, one = nh_int(d, 1), two = nh_int(d, 2), other[2];
    if (!quartic(m, simple(d, times(m, R, nh_powi(d, x, 2))), c) || !nh_is_zero(d, c[3])) return 0;
    bool square = !nh_is_zero(d, c[4]);
    nh_ex A = square ? c[4] : c[2], B = square ? c[2] : c[1], apart = simple(d, shifted(m, c[0], 1, 4));
    if ((square && !nh_is_zero(d, c[1])) || !(value_of(m, A) > 0) || value_of(m, apart) < 0) return 0;
    nh_ex k = root(m, A), n = nh_is_zero(d, apart) ? apart : root(m, apart), half = number(m, 1, 2);
    nh_ex z = times(m, k, square ? nh_powi(d, x, 2) : times(m, two, x)), decay = times(m, number(m, -1, 2), z);
    nh_ex order = square ? n : simple(d, times(m, two, n));
    bool both = nh_kind_of(d, order) == NH_NUMBER && nh_number_of(d, order).q > 1;
    for (int sign = both ? -1 : 1; sign <= 1; sign += 2) {
        nh_ex own = sign > 0 ? n : nh_neg(d, n);
        nh_ex front = times(m, nh_pow(d, x, simple(d, plus(m, half, own))), nh_call(d, NH_EXP, decay));
        nh_ex a = square ? plus(m, times(m, half, plus(m, one, own)), over(m, B, times(m, nh_int(d, 4), k)))
                         : plus(m, plus(m, half, own), over(m, B, times(m, two, k)));
        kummer(m, front, a, plus(m, one, square ? own : times(m, two, own)), z, sign > 0 ? out : other);
    }
    if (both) out[1] = other[0];
    return 2;
}

/* x moved so that `at` becomes 0. */
static void move(matcher *m, nh_ex at)
{
    nh_ex back = nh_add(m->d, m->x, at);
    m->p = put_in(m, m->p, back);
    m->q = put_in(m, m->q, back);
    m->meaning = simple(m->d, nh_sub(m->d, m->meaning, at));
}

/* Where there is no pole: the middle of R = A x^2 + B x + C or A x + B. */
static void complete_square(matcher *m, nh_ex R)
{
    nh_dag *d = m->d;
    nh_ex c[5];
    if (!quartic(m, R, c) || !nh_is_zero(d, c[3]) || !nh_is_zero(d, c[4])) return;
    if (!nh_is_zero(d, c[2])) move(m, simple(d, nh_neg(d, over(m, c[1], times(m, nh_int(d, 2), c[2])))));
    else if (!nh_is_zero(d, c[1])) move(m, simple(d, nh_neg(d, over(m, c[0], c[1]))));
}

/* R = Q + P^2/4 - P'/2. */
static nh_ex invariant(matcher *m)
{
    nh_dag *d = m->d;
    nh_ex R = plus(m, m->q, times(m, nh_powi(d, m->p, 2), number(m, 1, 4)));
    return simple(d, nh_sub(d, R, times(m, nh_diff(d, m->p, m->x), number(m, 1, 2))));
}

/* Euler's equation, R = B/x^2: x^r with r (r - 1) = B, in real functions where r is not. */
static size_t powers(matcher *m, nh_ex R, nh_ex out[2])
{
    nh_dag *d = m->d;
    nh_ex B = simple(d, times(m, R, nh_powi(d, m->x, 2))), half = number(m, 1, 2);
    nh_ex square = simple(d, shifted(m, times(m, nh_int(d, 4), B), 1, 1));
    if (nh_depends(d, B, m->x) || nh_is_zero(d, B)) return 0;
    nh_ex x = value_of(m, m->x) < 0 ? nh_neg(d, m->x) : m->x, middle = nh_sqrt(d, x), logarithm = nh_call(d, NH_LOG, x);
    double sign = value_of(m, square);
    if (!isfinite(sign) || (sign == 0 && !is_zero(m, square))) return 0;
    nh_ex w = sign == 0 ? logarithm : times(m, half, root(m, sign > 0 ? square : nh_neg(d, square)));
    for (int k = 0; k < 2; k++) {
        nh_ex wave = nh_call(d, k ? NH_SIN : NH_COS, times(m, w, logarithm));
        if (sign > 0) out[k] = nh_pow(d, x, simple(d, k ? nh_sub(d, half, w) : plus(m, half, w)));
        else out[k] = sign < 0 ? times(m, middle, wave) : k ? times(m, middle, logarithm) : middle;
    }
    return 2;
}

/* The point, or the middle of a square, is moved to 0; then the kinds of R in turn. */
static size_t confluent(matcher *m, const points *s, nh_ex out[2])
{
    nh_ex g;
    if (s->count) move(m, s->of[0].at);
    else complete_square(m, invariant(m));
    nh_ex R = invariant(m);
    size_t n = gauge(m, &g) ? powers(m, R, out) : 0;
    if (!n) n = gauge(m, &g) ? bessel(m, R, out) : 0;
    if (!n) n = gauge(m, &g) ? whittaker(m, R, out) : 0;
    for (size_t i = 0; i < n; i++) out[i] = times(m, g, out[i]);
    return n;
}

/* ---- Riemann ---- */

/* (1 + x^2)^exponent with the meaning of the variable substituted: where it is a square, such as 1/sin(s)^2, the power
 * of the root that is positive here. */
static nh_ex positive_power(matcher *m, nh_ex base, nh_ex exponent)
{
    nh_dag *d = m->d;
    nh_ex out = nh_int(d, 1), rest;
    base = simple(d, nh_substitute(d, base, 1, &m->x, &m->meaning));
    if (nh_kind_of(d, base) != NH_PRODUCT) return nh_pow(d, base, exponent);
    rest = nh_number(d, nh_constant_of(d, base));
    for (size_t i = 0; i < nh_arity(d, base); i++) {
        nh_ex factor = nh_child(d, base, i), k = nh_exponent_of(d, base, i);
        nh_num x = nh_kind_of(d, k) == NH_NUMBER ? nh_number_of(d, k) : nh_num_real(0.5);
        bool square = nh_num_short(x) && x.q == 1 && x.p % 2 == 0;
        if (square && value_of(m, factor) < 0) factor = nh_neg(d, factor);
        if (square) out = times(m, out, nh_pow(d, factor, times(m, k, exponent)));
        else rest = times(m, rest, nh_pow(d, factor, k));
    }
    return times(m, out, nh_pow(d, rest, exponent));
}

/* v'' = (a + l (l + 1) x^2)/(1 + x^2)^2 v for a whole number l: with x = tan s, v = sqrt(1 + x^2) u, it is u'' +
 * (w^2 - l (l + 1)/cos(s)^2) u = 0 for w^2 = 1 - a + l (l + 1), and (d/ds + j tan s) leads from j - 1 to j. */
static bool turning(matcher *m, nh_ex a, nh_ex c, nh_ex front, nh_ex out[2])
{
    enum { most_steps = 6 };
    nh_dag *d = m->d;
    nh_ex square = simple(d, plus(m, nh_sub(d, nh_int(d, 1), a), c)), s = nh_call(d, NH_ATAN, m->x);
    double sign = value_of(m, square);
    int steps = 0;
    while (steps < most_steps && !nh_is_zero(d, nh_sub(d, c, nh_int(d, steps * (steps + 1))))) steps++;
    if (steps == most_steps || !isfinite(sign) || (sign == 0 && !is_zero(m, square))) return false;
    nh_ex w = times(m, root(m, sign > 0 ? square : nh_neg(d, square)), s);
    out[0] = sign == 0 ? nh_int(d, 1) : nh_call(d, sign > 0 ? NH_COS : NH_COSH, w);
    out[1] = sign == 0 ? s : nh_call(d, sign > 0 ? NH_SIN : NH_SINH, w);
    for (int k = 0; k < 2; k++) {
        for (int j = 1; j <= steps; j++)
            out[k] = plus(m, times(m, plus(m, nh_int(d, 1), nh_powi(d, m->x, 2)), nh_diff(d, out[k], m->x)),
                          times(m, times(m, nh_int(d, j), m->x), out[k]));
        out[k] = times(m, front, simple(d, out[k]));
        if (is_zero(m, out[k])) return false; /* w is 1 .. l */
    }
    return true;
}

/* g with g'/g = P/2 for P = (p0 + p1 x)/(1 + x^2), and the solutions of v'' = (a + b x + c x^2)/(1 + x^2)^2 v. */
static size_t conjugate(matcher *m, const points *s, nh_ex out[2])
{
    nh_dag *d = m->d;
    move(m, s->middle);
    nh_ex stretched = times(m, s->height, m->x), x = m->x, below = plus(m, nh_int(d, 1), nh_powi(d, x, 2));
    m->p = simple(d, times(m, s->height, put_in(m, m->p, stretched)));
    m->q = simple(d, times(m, nh_powi(d, s->height, 2), put_in(m, m->q, stretched)));
    m->meaning = simple(d, over(m, m->meaning, s->height));
    nh_ex p[5], r[5];
    if (!quartic(m, simple(d, times(m, m->p, below)), p) ||
        !quartic(m, simple(d, times(m, invariant(m), nh_powi(d, below, 2))), r))
        return 0;
    for (int k = 2; k < 5; k++)
        if (!nh_is_zero(d, p[k]) || (k > 2 && !nh_is_zero(d, r[k]))) return 0;
    nh_ex g = times(m, positive_power(m, below, times(m, p[1], number(m, 1, 4))),
                    nh_call(d, NH_EXP, times(m, times(m, p[0], number(m, 1, 2)), nh_call(d, NH_ATAN, x))));
    nh_ex all[4] = {r[0], r[1], r[2], x};
    if (nh_is_zero(d, r[1]) && turning(m, r[0], r[2], times(m, g, nh_sqrt(d, below)), out)) return 2;
    out[0] = times(m, g, nh_call_any(d, NH_RIEMANN_C, all));
    out[1] = times(m, g, nh_call_any(d, NH_RIEMANN_S, all));
    return 2;
}

size_t nh_named_match(nh_dag *d, const nh_named_equation *e, nh_named_value_of *value, void *context, nh_ex out[2])
{
    matcher m = {d, e->variable, e->p, e->q, e->meaning, value, context};
    points s = {0};
    bool good = add_poles(&m, &s, m.p) && add_poles(&m, &s, m.q);
    size_t n = !good || s.count < 2 || s.pair ? 0 : three_points(&m, &s, out);
    if (good && s.pair && !s.count) n = conjugate(&m, &s, out);
    if (!n && (!good || s.count < 2) && !s.pair) n = confluent(&m, &s, out);
    for (size_t i = 0; i < n; i++) out[i] = simple(d, nh_substitute(d, out[i], 1, &m.x, &m.meaning));
    return n;
}
