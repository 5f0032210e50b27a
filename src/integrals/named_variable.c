/* named_variable: with x = r(s), u_s = r' u_x and u_ss = r'^2 u_xx + r'' u_x, so that u_ss = p u_s + q u becomes
 *     u_xx = ((p r' - r'') u_x + q u)/r'^2,
 * the coefficients written in x by the inverse of r. [docs/method.md, sec. 10, "Functions with names"] */
#include "integrals/named_coefficients.h"

#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_calls = 32, most_multiple = 6 };

typedef enum { PLAIN, COSINE, SINE, COTANGENT, HALF_EXPONENTIAL, EXPONENTIAL, KINDS } kind;

static nh_ex simple(nh_dag *d, nh_ex e) { return nh_simplify_short(d, e, 0); }

/* a = k s with a small whole number k; 0: it is not. */
static int64_t multiple_of(nh_dag *d, nh_ex a, nh_ex s)
{
    nh_ex k = simple(d, nh_div(d, a, s));
    nh_num n = nh_kind_of(d, k) == NH_NUMBER ? nh_number_of(d, k) : nh_num_int(0);
    return nh_num_short(n) && n.q == 1 && n.p > 0 && n.p <= most_multiple ? n.p : 0;
}

/* cos(k s), sin(k s) by C = cos s, S = sin s. */
static void turned(nh_dag *d, int64_t k, nh_ex C, nh_ex S, nh_ex *cosine, nh_ex *sine)
{
    *cosine = nh_int(d, 1);
    *sine = nh_int(d, 0);
    for (int64_t i = 0; i < k; i++) {
        nh_ex c = nh_sub(d, nh_mul(d, *cosine, C), nh_mul(d, *sine, S));
        *sine = nh_add(d, nh_mul(d, *sine, C), nh_mul(d, *cosine, S));
        *cosine = c;
    }
}

/* e with sines and cosines of multiples of s written in C and S; false where s
 * occurs otherwise. */
static bool in_waves(nh_dag *d, nh_ex e, nh_ex s, nh_ex C, nh_ex S, nh_ex *out)
{
    NH_LIST(call);
    nh_ex to[most_calls], from[most_calls];
    size_t n = nh_functions_in(d, e, &call), k = 0;
    for (size_t i = 0; i < n && i < most_calls; i++) {
        nh_function f = nh_function_of(d, call[i]);
        int64_t times = nh_depends(d, call[i], s) && f <= NH_TAN ? multiple_of(d, nh_child(d, call[i], 0), s) : 0;
        if (!times) continue;
        nh_ex cosine, sine;
        turned(d, times, C, S, &cosine, &sine);
        from[k] = call[i];
        to[k++] = f == NH_SIN ? sine : f == NH_COS ? cosine : nh_div(d, sine, cosine);
    }
    *out = simple(d, nh_substitute(d, e, k, from, to));
    return n <= most_calls && !nh_depends(d, *out, s);
}

/* The rate k of some exp(k s) in e; the number 0 where there is none. */
static nh_ex rate_in(nh_dag *d, nh_ex e, nh_ex s)
{
    NH_LIST(call);
    size_t n = nh_functions_in(d, e, &call);
    for (size_t i = 0; i < n; i++) {
        if (nh_function_of(d, call[i]) != NH_EXP) continue;
        nh_ex k = simple(d, nh_diff(d, nh_child(d, call[i], 0), s));
        if (!nh_is_zero(d, k) && !nh_depends(d, k, s)) return k;
    }
    return nh_int(d, 0);
}

/* No root of something with x in it. */
static bool rational_in(nh_dag *d, nh_ex e, nh_ex x)
{
    enum { most = 128 };
    NH_LIST(product);
    size_t n = nh_products_in(d, e, &product);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < nh_arity(d, product[i]); j++) {
            nh_ex exponent = nh_exponent_of(d, product[i], j);
            bool whole = nh_kind_of(d, exponent) == NH_NUMBER && nh_number_of(d, exponent).q == 1;
            if (!whole && nh_child(d, product[i], j) != x && nh_depends(d, nh_child(d, product[i], j), x)) return false;
        }
    return n <= most;
}

/* e(s) in x. */
static bool express(nh_dag *d, nh_ex e, nh_ex s, kind k, nh_ex rate, nh_ex x, nh_ex *out)
{
    nh_ex one = nh_int(d, 1), other = nh_sqrt(d, nh_sub(d, one, nh_powi(d, x, 2))),
          sine = nh_pow(d, nh_add(d, one, nh_powi(d, x, 2)), nh_ratio(d, -1, 2));
    if (k == COTANGENT) return in_waves(d, e, s, nh_mul(d, x, sine), sine, out) && rational_in(d, *out, x);
    if (k == COSINE || k == SINE)
        return in_waves(d, e, s, k == COSINE ? x : other, k == COSINE ? other : x, out) && rational_in(d, *out, x);
    nh_ex inverse = k == PLAIN ? x : nh_div(d, nh_call(d, NH_LOG, x), rate);
    *out = simple(d, nh_substitute(d, e, 1, &s, &inverse));
    return !nh_depends(d, *out, s);
}

nh_ex nh_named_tidy(nh_dag *d, nh_ex e, nh_ex s)
{
    nh_ex x = nh_symbol(d, "the variable of an equation"), back = nh_powi(d, nh_call(d, NH_TAN, s), -1), tidy;
    if (!express(d, e, s, COTANGENT, 0, x, &tidy)) return e;
    tidy = nh_substitute(d, tidy, 1, &x, &back);
    return nh_complexity(d, tidy) < nh_complexity(d, e) ? tidy : e;
}

/* x = r(s): u_xx = ((p r' - r'') u_x + q u)/r'^2. */
static bool change(nh_dag *d, const nh_named_equation *in, nh_ex meaning, kind k, nh_ex rate, nh_named_equation *out)
{
    nh_ex s = in->variable, x = out->variable, first = nh_diff(d, meaning, s), second = nh_diff(d, first, s),
          square = nh_powi(d, first, -2);
    nh_ex p = nh_mul(d, nh_sub(d, nh_mul(d, in->p, first), second), square), q = nh_mul(d, in->q, square);
    out->meaning = meaning;
    return express(d, p, s, k, rate, x, &out->p) && express(d, q, s, k, rate, x, &out->q);
}

/* y = x^2, where only that occurs. */
static bool squared(nh_dag *d, const nh_named_equation *in, nh_named_equation *out)
{
    nh_ex x = in->variable, y = out->variable, root = nh_sqrt(d, y), two = nh_int(d, 2),
          square = nh_powi(d, nh_mul(d, two, x), -2);
    nh_ex p = nh_mul(d, nh_sub(d, nh_mul(d, in->p, nh_mul(d, two, x)), two), square), q = nh_mul(d, in->q, square);
    out->p = simple(d, nh_substitute(d, p, 1, &x, &root));
    out->q = simple(d, nh_substitute(d, q, 1, &x, &root));
    out->meaning = nh_powi(d, in->meaning, 2);
    NH_LIST(product);
    nh_ex pair = nh_add(d, nh_mul(d, out->p, nh_symbol(d, "a factor of its own")), out->q);
    size_t n = nh_products_in(d, pair, &product);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < nh_arity(d, product[i]); j++)
            if (nh_child(d, product[i], j) == y && nh_exponent_of(d, product[i], j) == nh_ratio(d, 1, 2)) return false;
    return rational_in(d, pair, y);
}

size_t nh_named_variables(nh_dag *d, const nh_named_equation *in, nh_named_equation out[NH_MOST_EQUATIONS])
{
    nh_ex s = in->variable,
          rate = rate_in(d, nh_add(d, in->p, nh_mul(d, in->q, nh_symbol(d, "a factor of its own"))), s);
    const nh_ex half = nh_mul(d, nh_ratio(d, 1, 2), rate);
    const nh_ex meaning[KINDS] = {s,
                                  nh_call(d, NH_COS, s),
                                  nh_call(d, NH_SIN, s),
                                  nh_powi(d, nh_call(d, NH_TAN, s), -1),
                                  nh_call(d, NH_EXP, nh_mul(d, half, s)),
                                  nh_call(d, NH_EXP, nh_mul(d, rate, s))};
    size_t n = 0;
    for (kind k = PLAIN; k < KINDS; k++) {
        if (k >= HALF_EXPONENTIAL && nh_is_zero(d, rate)) continue;
        out[n] = (nh_named_equation){.variable = nh_symbol(d, "the variable of an equation")};
        if (!change(d, in, meaning[k], k, k == HALF_EXPONENTIAL ? half : rate, &out[n])) continue;
        nh_named_equation square = {.variable = nh_symbol(d, "the square of a variable")};
        bool even = squared(d, &out[n], &square);
        n++;
        if (even) out[n++] = square;
    }
    return n;
}
