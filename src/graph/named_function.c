#include "graph/named_function.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/parse.h"

/* The second derivative, in the letters of the arguments, f and g = f'
 * [DLMF 14.2.1, 15.10.1, 15.11.1, 13.2.1, 10.2.1, 10.25.1, 9.2.1]. */
static const struct {
    nh_function f;
    const char *second;
} equation[] = {
    {NH_LEGENDRE_P, "(2*x*g - n*(n + 1)*f)/(1 - x^2)"},
    {NH_LEGENDRE_Q, "(2*x*g - n*(n + 1)*f)/(1 - x^2)"},
    {NH_HYP2F1, "(a*b*f - (c - (a + b + 1)*x)*g)/(x*(1 - x))"},
    {NH_GAUSS_F, "(p*f - (c - (s + 1)*x)*g)/(x*(1 - x))"}, /* s = a + b, p = a b */
    {NH_RIEMANN_C, "(a + b*x + c*x^2)*f/(1 + x^2)^2"},     /* 15.11.1 with the singular points i, -i and infinity */
    {NH_RIEMANN_S, "(a + b*x + c*x^2)*f/(1 + x^2)^2"},
    {NH_HYP1F1, "(a*f - (b - x)*g)/x"},
    {NH_HYPERU, "(a*f - (b - x)*g)/x"},
    {NH_BESSEL_J, "(n^2/x^2 - 1)*f - g/x"},
    {NH_BESSEL_Y, "(n^2/x^2 - 1)*f - g/x"},
    {NH_BESSEL_I, "(n^2/x^2 + 1)*f - g/x"},
    {NH_BESSEL_K, "(n^2/x^2 + 1)*f - g/x"},
    {NH_AIRY_AI, "x*f"},
    {NH_AIRY_BI, "x*f"},
};

/* First derivatives of elliptic integrals [DLMF 19.4, with m = k^2, n = alpha^2]. */
static const struct {
    nh_function f;
    size_t argument;
    const char *first;
} slope[] = {
    {NH_ELLIPTIC_K, 0, "(elliptic_e(m) - (1 - m)*f)/(2*m*(1 - m))"},
    {NH_ELLIPTIC_E, 0, "(f - elliptic_k(m))/(2*m)"},
    {NH_ELLIPTIC_F, 0, "1/sqrt(1 - m*sin(u)^2)"},
    {NH_ELLIPTIC_F, 1,
     "(elliptic_einc(u, m) - (1 - m)*f)/(2*m*(1 - m)) - sin(2*u)/(4*(1 - "
     "m)*sqrt(1 - m*sin(u)^2))"},
    {NH_ELLIPTIC_EINC, 0, "sqrt(1 - m*sin(u)^2)"},
    {NH_ELLIPTIC_EINC, 1, "(f - elliptic_f(u, m))/(2*m)"},
    {NH_ELLIPTIC_PI, 0,
     "(elliptic_einc(u, m) + (m - n)/n*elliptic_f(u, m) + (n^2 - m)/n*f - n*sqrt(1 - m*sin(u)^2)*sin(2*u)/(2*(1 - "
     "n*sin(u)^2)))/(2*(m - n)*(n - 1))"},
    {NH_ELLIPTIC_PI, 1, "1/((1 - n*sin(u)^2)*sqrt(1 - m*sin(u)^2))"},
    {NH_ELLIPTIC_PI, 2, "(elliptic_einc(u, m)/(m - 1) + f - m*sin(2*u)/(2*(m - 1)*sqrt(1 - m*sin(u)^2)))/(2*(n - m))"},
};

bool nh_named_function_has_elliptic(const nh_dag *dag, nh_ex e)
{
    nh_ex *node;
    bool found = false;
    size_t n = nh_nodes_in(dag, 1, &e, &node);
    for (size_t i = 0; i < n && !found; i++)
        found = nh_kind_of(dag, node[i]) == NH_FUNCTION && nh_is_incomplete_elliptic(nh_function_of(dag, node[i]));
    nh_free(node);
    return found;
}

nh_function nh_named_function_base(nh_function f) { return f < NH_ELLIPTIC_K ? f - (f - NH_LEGENDRE_P) % 2 : f; }

typedef struct {
    nh_dag *dag;
    nh_function f, other;
    const nh_ex *argument;
} letters;

static bool resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    const letters *x = context;
    const char *list = nh_function_arguments(x->f), *at = strchr(list, name[0]);
    (void)fault;
    if (at) *out = x->argument[(at - list) / 3]; /* "n, x" */
    else if (name[0] == 'f' || name[0] == 'g') *out = nh_call_any(x->dag, x->f + (name[0] == 'g'), x->argument);
    else *out = nh_call_any(x->dag, x->other + (name[0] == 'G'), x->argument);
    return true;
}

bool nh_named_function_read(nh_dag *dag, const char *text, nh_function f, nh_function other, const nh_ex *argument,
                            nh_ex *out)
{
    letters x = {dag, f, other, argument};
    nh_parse_fault fault;
    return nh_parse(dag, text, resolve, &x, out, &fault);
}

/* What cannot be written becomes not-a-number. */
static nh_ex read_or_nan(nh_dag *dag, const char *text, nh_function f, const nh_ex *argument)
{
    nh_ex out;
    return text && nh_named_function_read(dag, text, f, f, argument, &out) ? out : nh_real(dag, NAN);
}

static bool is_arctangent(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == NH_ATAN;
}

/* The sine and the cosine of u = atan(w) or -atan(w) as w/sqrt(1 + w^2) and 1/sqrt(1 + w^2), which stand in squares. */
static nh_ex without_arctangent(nh_dag *dag, nh_ex e, nh_ex u)
{
    nh_ex angle = is_arctangent(dag, u) ? u : nh_neg(dag, u), one = nh_int(dag, 1);
    if (!is_arctangent(dag, angle)) return e;
    nh_ex w = nh_child(dag, angle, 0), root = nh_sqrt(dag, nh_add(dag, one, nh_powi(dag, w, 2)));
    nh_ex wave[] = {nh_call(dag, NH_SIN, angle), nh_call(dag, NH_COS, angle)},
          by[] = {nh_div(dag, w, root), nh_div(dag, one, root)};
    return nh_substitute(dag, e, 2, wave, by);
}

/* sqrt(1 - m sin(u)^2) for u = 2 atan(w), as sqrt((1 + w^2)^2 - 4 m w^2)/(1 + w^2): where w has a root, this radicand
 * is the shorter one. */
static nh_ex with_short_root(nh_dag *dag, nh_ex e, nh_ex u, nh_ex m)
{
    nh_ex one = nh_int(dag, 1), angle = nh_mul(dag, nh_ratio(dag, 1, 2), u);
    if (!is_arctangent(dag, angle)) return without_arctangent(dag, e, u);
    nh_ex square = nh_powi(dag, nh_child(dag, angle, 0), 2), sum = nh_add(dag, one, square);
    nh_ex radicand = nh_sub(dag, one, nh_mul(dag, m, nh_powi(dag, nh_call(dag, NH_SIN, u), 2)));
    nh_ex other = nh_sub(dag, nh_powi(dag, sum, 2), nh_product(dag, 3, (nh_ex[]){nh_int(dag, 4), m, square}));
    return nh_substitute_root(dag, e, radicand, nh_div(dag, nh_sqrt(dag, other), sum));
}

nh_ex nh_named_function_rate(nh_dag *dag, nh_ex e, size_t i)
{
    nh_function f = nh_function_of(dag, e), base = nh_named_function_base(f);
    nh_ex argument[NH_MOST_ARGUMENTS];
    const char *text = NULL;
    for (size_t k = 0; k < nh_arity(dag, e); k++) argument[k] = nh_child(dag, e, k);
    if (f == NH_UNSPECIFIED) {
        if (i == 2) argument[1] = nh_add(dag, argument[1], nh_int(dag, 1));
        return i == 2 ? nh_call_any(dag, f, argument) : nh_real(dag, NAN);
    }
    if (f == NH_TABLE) return nh_declared_table_rate(dag, e, i);
    if (f >= NH_ELLIPTIC_K) {
        for (size_t k = 0; k < sizeof slope / sizeof *slope; k++)
            if (slope[k].f == f && slope[k].argument == i) text = slope[k].first;
        nh_ex rate = read_or_nan(dag, text, f, argument);
        size_t m = nh_arity(dag, e) - 1;
        return nh_is_incomplete_elliptic(f) ? with_short_root(dag, rate, argument[m - 1], argument[m]) : rate;
    }
    if (i < nh_function_constants(f)) return nh_real(dag, NAN);
    if (f == base) return nh_call_any(dag, f + 1, argument);
    for (size_t k = 0; k < sizeof equation / sizeof *equation; k++)
        if (equation[k].f == base) text = equation[k].second;
    return read_or_nan(dag, text, base, argument);
}
