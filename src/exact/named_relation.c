#include "exact/named_relation.h"

#include <math.h>

#include "base/memory.h"
#include "exact/kernel.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/named_function.h"
#include "graph/node.h"
#include "graph/num.h"

enum { most_steps = 24 };

/* The function whose order is larger or smaller by one, in the letters of
 * nh_named_function_read [DLMF 10.6.2, 10.29.2, 14.10, 15.5, 13.3]. */
static const struct {
    nh_function f;
    size_t order;
    const char *up, *down;
} neighbour[] = {
    {NH_LEGENDRE_P, 0, "x*f - (1 - x^2)*g/(n + 1)", "x*f + (1 - x^2)*g/n"},
    {NH_LEGENDRE_Q, 0, "x*f - (1 - x^2)*g/(n + 1)", "x*f + (1 - x^2)*g/n"},
    {NH_HYP2F1, 0, "f + x*g/a", "(x*(1 - x)*g + (c - a - b*x)*f)/(c - a)"},
    {NH_HYP2F1, 1, "f + x*g/b", "(x*(1 - x)*g + (c - b - a*x)*f)/(c - b)"},
    {NH_HYP2F1, 2, "c*((1 - x)*g + (c - a - b)*f)/((c - a)*(c - b))", "f + x*g/(c - 1)"},
    {NH_GAUSS_F, 2, "c*((1 - x)*g + (c - s)*f)/(c^2 - c*s + p)", "f + x*g/(c - 1)"},
    {NH_HYP1F1, 0, "f + x*g/a", "(x*g + (b - a - x)*f)/(b - a)"},
    {NH_HYP1F1, 1, "b*(f - g)/(b - a)", "f + x*g/(b - 1)"},
    {NH_HYPERU, 0, "(a*f + x*g)/(a*(1 + a - b))", "(a - b + x)*f - x*g"},
    {NH_HYPERU, 1, "f - g", "-((b - 1)*f + x*g)/(a - b + 1)"},
    {NH_BESSEL_J, 0, "n*f/x - g", "n*f/x + g"},
    {NH_BESSEL_Y, 0, "n*f/x - g", "n*f/x + g"},
    {NH_BESSEL_I, 0, "g - n*f/x", "g + n*f/x"},
    {NH_BESSEL_K, 0, "n*f/x - g", "-n*f/x - g"},
};

/* The derivative of the second solution by the determinant of Wronski; F, G:
 * the first and its derivative [DLMF 10.5.2, 10.28.2, 14.2.4, 9.2.7]. */
static const struct {
    nh_function second, first;
    const char *derivative;
} wronskian[] = {
    {NH_LEGENDRE_Q, NH_LEGENDRE_P, "(G*f + 1/(1 - x^2))/F"},
    {NH_BESSEL_Y, NH_BESSEL_J, "(G*f + 2/(pi*x))/F"},
    {NH_BESSEL_K, NH_BESSEL_I, "(G*f - 1/x)/F"},
    {NH_RIEMANN_S, NH_RIEMANN_C, "(G*f + 1)/F"},
    {NH_AIRY_BI, NH_AIRY_AI, "(G*f + 1/pi)/F"},
};

/* The number of steps of one by which a number lies beyond (0, 1], or the constant part of another order beyond (-1,
 * 0]; 0 also where that is too far. */
static long steps_beyond(nh_dag *dag, nh_ex order)
{
    nh_parts parts;
    double constant = 0;
    nh_parts_make(dag, false, order, &parts);
    for (size_t i = 0; i < parts.count; i++)
        if (nh_is_number(dag, parts.item[i].atom, 1))
            constant = nh_num_short(parts.item[i].coefficient) ? nh_num_value(parts.item[i].coefficient) : NAN;
    nh_free(parts.item);
    double steps = nh_kind_of(dag, order) == NH_NUMBER ? ceil(constant) - 1 : ceil(constant);
    return fabs(steps) <= most_steps ? (long)steps : 0;
}

/* The derivative of a row with respect to x, which is replaced by a symbol first. */
static bool read_row(nh_dag *dag, const char *text, nh_function f, bool prime, nh_ex *argument, nh_ex *out)
{
    size_t last = nh_function_arity(f) - 1;
    nh_ex place = argument[last], x = prime ? nh_symbol(dag, "the argument of a function") : place;
    argument[last] = x;
    bool good = nh_named_function_read(dag, text, f, f, argument, out);
    argument[last] = place;
    if (good && prime) *out = nh_substitute(dag, nh_diff(dag, *out, x), 1, &x, &place);
    return good;
}

static bool next_order(nh_dag *dag, nh_ex e, nh_function f, nh_ex *argument, nh_ex *out)
{
    bool prime = nh_function_of(dag, e) != f;
    for (size_t k = 0; k < sizeof neighbour / sizeof *neighbour; k++) {
        if (neighbour[k].f != f) continue;
        size_t i = neighbour[k].order;
        nh_ex order = argument[i];
        long steps = steps_beyond(dag, order);
        if (!steps) continue;
        argument[i] = nh_add(dag, order, nh_int(dag, steps > 0 ? -1 : 1));
        if (read_row(dag, steps > 0 ? neighbour[k].up : neighbour[k].down, f, prime, argument, out)) return true;
        argument[i] = order;
    }
    return false;
}

/* 2F1(a, b; a + 1; x): which of the first two arguments is smaller than the third by one?  False: none is. */
static bool is_beta(nh_dag *dag, nh_ex f, size_t *which)
{
    enum { first_two = 2, third = 2 };
    if (nh_named_function_base(nh_function_of(dag, f)) != NH_HYP2F1) return false;
    for (*which = 0; *which < first_two; ++*which)
        if (nh_is_number(dag, nh_sub(dag, nh_child(dag, f, third), nh_child(dag, f, *which)), 1)) return true;
    return false;
}

/* x f' = a ((1 - x)^(-b) - f): the part without f, and the factor of f. */
static void beta_equation(nh_dag *dag, nh_ex f, size_t which, nh_ex *constant, nh_ex *factor)
{
    enum { last = 3 };
    nh_ex a = nh_child(dag, f, which), b = nh_child(dag, f, 1 - which), x = nh_child(dag, f, last),
          ratio = nh_div(dag, a, x);
    *constant = nh_mul(dag, ratio, nh_pow(dag, nh_sub(dag, nh_int(dag, 1), x), nh_neg(dag, b)));
    *factor = nh_neg(dag, ratio);
}

bool nh_named_relation_first_order(nh_dag *dag, nh_ex f, size_t *place, nh_ex *constant, nh_ex *factor)
{
    enum { last = 3 };
    size_t which;
    nh_function kind = nh_function_of(dag, f);
    if (kind == NH_ELLIPTIC_F || kind == NH_ELLIPTIC_EINC || kind == NH_ELLIPTIC_PI) {
        *place = kind == NH_ELLIPTIC_PI; /* of the angle */
        *constant = nh_named_function_rate(dag, f, *place);
        *factor = nh_int(dag, 0);
        return true;
    }
    if (kind != NH_HYP2F1 || !is_beta(dag, f, &which)) return false;
    *place = last;
    beta_equation(dag, f, which, constant, factor);
    return true;
}

bool nh_named_relation_step(nh_dag *dag, nh_ex e, nh_ex *out)
{
    nh_function f = nh_function_of(dag, e), base = nh_named_function_base(f);
    nh_ex argument[NH_MOST_ARGUMENTS], constant, factor;
    size_t which;
    if (f >= NH_ELLIPTIC_K) return false;
    for (size_t i = 0; i < nh_arity(dag, e); i++) argument[i] = nh_child(dag, e, i);
    if (is_beta(dag, e, &which)) {
        nh_ex beta = nh_call_any(dag, base, argument);
        if (f == base) return false;
        beta_equation(dag, beta, which, &constant, &factor);
        *out = nh_add(dag, constant, nh_mul(dag, factor, beta));
        return true;
    }
    if (next_order(dag, e, base, argument, out)) return true;
    for (size_t k = 0; k < sizeof wronskian / sizeof *wronskian && f != base; k++)
        if (wronskian[k].second == base)
            return nh_named_function_read(dag, wronskian[k].derivative, base, wronskian[k].first, argument, out);
    return false;
}
