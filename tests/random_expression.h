/* random_expression: seeded random expressions in a few symbols, and their value computed the naive way. */
#ifndef NH_TESTS_RANDOM_EXPRESSION_H
#define NH_TESTS_RANDOM_EXPRESSION_H

#include <math.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/parse.h"

enum { SYMBOLS = 4 };

typedef struct {
    nh_dag *dag;
    nh_ex symbol[SYMBOLS];
    uint64_t state;
    bool inexact; /* use numbers that no rational represents */
} source;

static inline source source_create(uint64_t seed)
{
    static const char *const name[SYMBOLS] = {"x", "y", "x'", "omega"};
    source s = {.dag = nh_dag_create(), .state = seed * 2654435761u + 2385};
    for (size_t i = 0; i < SYMBOLS; i++) s.symbol[i] = nh_symbol(s.dag, name[i]);
    return s;
}

static inline uint64_t random_bits(source *s)
{
    s->state = s->state * 6364136223846793005u + 1442695040888963407u;
    return s->state >> 33;
}

static inline int random_below(source *s, int n) { return (int)(random_bits(s) % (uint64_t)n); }

static inline double random_real(source *s, double low, double high)
{
    return low + (high - low) * (double)random_bits(s) / 2147483648.0;
}

static inline nh_ex random_number(source *s)
{
    if (s->inexact && random_below(s, 2)) return nh_real(s->dag, random_real(s, -3, 3) * exp(random_real(s, -40, 40)));
    return nh_ratio(s->dag, random_below(s, 19) - 9, 1 + random_below(s, 6));
}

static inline nh_ex random_leaf(source *s)
{
    int k = random_below(s, 10);
    if (k < 7) return s->symbol[random_below(s, SYMBOLS)];
    return k == 7 ? nh_pi(s->dag) : random_number(s);
}

static inline nh_ex random_exponent(source *s)
{
    static const int ratio[][2] = {{2, 1}, {3, 1}, {-1, 1}, {-2, 1}, {1, 2}, {-1, 2}, {3, 2}, {1, 3}, {-2, 3}, {5, 4}};
    int k = random_below(s, 12);
    if (k == 11) return nh_add(s->dag, s->symbol[random_below(s, SYMBOLS)], nh_ratio(s->dag, random_below(s, 5) - 2, 2));
    if (k == 10) return s->symbol[random_below(s, SYMBOLS)];
    return nh_ratio(s->dag, ratio[k][0], ratio[k][1]);
}

/* What divides by zero or overflows has no text; it is not used. */
static inline bool printable(const nh_dag *dag, nh_ex e)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) return isfinite(nh_num_value(nh_number_of(dag, e)));
    if (kind != NH_SUM && kind != NH_PRODUCT) return true;
    double size = fabs(nh_num_value(nh_constant_of(dag, e)));
    for (size_t i = 0; kind == NH_SUM && i < nh_arity(dag, e); i++) size += fabs(nh_num_value(nh_coefficient_of(dag, e, i)));
    return isfinite(size);
}

static inline nh_ex random_expression(source *s, int depth)
{
    nh_dag *d = s->dag;
    if (depth == 0 || random_below(s, 12) == 0) return random_leaf(s);
    nh_ex a = random_expression(s, depth - 1), e = a;
    int k = random_below(s, 20);
    if (k < 5) e = nh_add(d, a, random_expression(s, depth - 1));
    else if (k < 7) e = nh_sub(d, a, random_expression(s, depth - 1));
    else if (k < 11) e = nh_mul(d, a, random_expression(s, depth - 1));
    else if (k < 13) e = nh_div(d, a, random_expression(s, depth - 1));
    else if (k < 16 && nh_kind_of(d, a) != NH_NUMBER) e = nh_pow(d, a, random_exponent(s));
    else if (k < 16) e = nh_pow(d, nh_int(d, 2 + random_below(s, 40)), random_exponent(s));
    else if (k == 19 && random_below(s, 4) == 0) e = nh_call2(d, NH_ATAN2, a, random_expression(s, depth - 1));
    else e = nh_call(d, (nh_function)random_below(s, NH_ATAN2), a);
    return printable(d, e) ? e : a;
}

/* ---- text ---- */

static inline bool any_name(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)fault;
    *out = nh_symbol(context, name);
    return true;
}

/* The expression that a text means; every name is a symbol.  Not a number when it cannot be read. */
static inline nh_ex parsed(nh_dag *dag, const char *text)
{
    nh_ex e;
    nh_parse_fault fault;
    return nh_parse(dag, text, any_name, dag, &e, &fault) ? e : nh_real(dag, NAN);
}

/* ---- the value, by plain recursion ---- */

static inline double naive_call(nh_function f, double a, double b)
{
#define X(id, name, parity, at_zero, at_one) [NH_##id] = name,
    static double (*const of[])(double) = {NH_ELEMENTARY_TABLE(X)[NH_ABS] = fabs};
#undef X
    if (f == NH_PI) return acos(-1);
    if (f == NH_ATAN2) return atan2(a, b);
    if (f == NH_SIGN) return isnan(a) ? a : (a > 0) - (a < 0);
    return of[f](a);
}

/* `size` becomes the largest magnitude met on the way: how much rounding to expect. */
static inline double naive_value(const nh_dag *dag, nh_ex e, const nh_ex *symbol, const double *at, double *size)
{
    nh_kind kind = nh_kind_of(dag, e);
    double value = NAN;
    if (kind == NH_NUMBER) value = nh_num_value(nh_number_of(dag, e));
    for (size_t i = 0; kind == NH_SYMBOL && i < SYMBOLS; i++)
        if (symbol[i] == e) value = at[i];
    size_t n = nh_arity(dag, e);
    if (kind == NH_SUM || kind == NH_PRODUCT) value = nh_num_value(nh_constant_of(dag, e));
    for (size_t i = 0; i < n && kind != NH_FUNCTION; i++) {
        double v = naive_value(dag, nh_child(dag, e, i), symbol, at, size);
        if (kind == NH_SUM) value += nh_num_value(nh_coefficient_of(dag, e, i)) * v;
        else value *= pow(v, naive_value(dag, nh_exponent_of(dag, e, i), symbol, at, size));
        *size = fmax(*size, fabs(value));
    }
    if (kind == NH_FUNCTION) {
        double a = n > 0 ? naive_value(dag, nh_child(dag, e, 0), symbol, at, size) : 0;
        double b = n > 1 ? naive_value(dag, nh_child(dag, e, 1), symbol, at, size) : 0;
        value = naive_call(nh_function_of(dag, e), a, b);
    }
    *size = fmax(*size, fabs(value));
    return value;
}

#endif
