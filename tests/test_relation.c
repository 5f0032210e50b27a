/* relation: known relations are recovered exactly, and nothing is found where there is none or more than one.
 *
 * A result is checked against the expected vector up to a factor, by cross products in the normal form, and by numbers in
 * sum c_j e_j, which shares nothing with the solver but the expressions. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/print.h"
#include "exact/relation.h"
#include "exact/relation_express.h"
#include "exact/relation_unknown.h"
#include "evaluate/tape.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "sweep.h"
#include "typed.h"

enum { most = 24 };

/* "m a k" */
static size_t symbols(nh_dag *dag, const char *names, nh_ex *out)
{
    char copy[100], *rest = copy, *name;
    size_t n = 0;
    snprintf(copy, sizeof copy, "%s", names);
    while ((name = strsep(&rest, " ")))
        if (*name) out[n++] = nh_symbol(dag, name);
    return n;
}

static const char *const names[] = {"x", "y", "z", "u", "v", "w", "f", "m", "a", "b", "k", "t", "A", "B", "C", "J", "w1", "w2", "w3", "q"};
enum { name_count = sizeof names / sizeof *names };

static unsigned long long random_state = 2385;

static double uniform(double from, double to)
{
    random_state = random_state * 6364136223846793005ULL + 1442695040888963407ULL;
    return from + (to - from) * (double)(random_state >> 11) / 9007199254740992.0;
}

static double largest_at_point(nh_dag *dag, size_t n, const nh_ex *e, const nh_ex *c, double *sum)
{
    nh_ex symbol[name_count], out[2 * most];
    double value[name_count], number[2 * most], largest = 0;
    for (size_t i = 0; i < name_count; i++) {
        symbol[i] = nh_symbol(dag, names[i]);
        value[i] = uniform(0.3, 1.7);
    }
    memcpy(out, e, n * sizeof *e);
    memcpy(out + n, c, n * sizeof *c);
    nh_tape *tape = nh_tape_create(dag, name_count, symbol, 2 * n, out, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, value, number);
    *sum = 0;
    for (size_t j = 0; j < n; j++) {
        double term = number[j] * number[n + j];
        *sum += term;
        largest = fmax(largest, fabs(term));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return largest;
}

static void expect_vanishing(nh_dag *dag, size_t n, const nh_ex *e, const nh_ex *c, const char *what)
{
    for (int point = 0; point < 5; point++) {
        double sum, largest = largest_at_point(dag, n, e, c, &sum);
        cr_expect(fabs(sum) <= 1e-10 * largest + 1e-13, "%s: %g of %g", what, sum, largest);
    }
}

/* c = (factor) * expected */
static void expect_proportional(nh_dag *dag, size_t n, const nh_ex *c, const nh_ex *expected, const char *what)
{
    size_t pivot = 0;
    while (pivot < n && nh_is_zero(dag, expected[pivot])) pivot++;
    cr_assert(pivot < n);
    cr_expect(!nh_is_zero(dag, c[pivot]), "%s: coefficient %zu", what, pivot);
    for (size_t j = 0; j < n; j++) {
        nh_ex cross = nh_sub(dag, nh_mul(dag, c[j], expected[pivot]), nh_mul(dag, c[pivot], expected[j]));
        char *text = nh_print_string(dag, c[j]);
        cr_expect(nh_normal_is_zero(dag, cross, 0) == NH_ZERO, "%s: coefficient %zu is %s", what, j, text);
        nh_free(text);
    }
}

typedef struct {
    const char *parameters;
    nh_relation_verdict verdict;
    const char *e[most], *c[most];
} example;

static void try(const example *x)
{
    nh_dag *dag = nh_dag_create();
    nh_ex parameter[most], e[most], c[most] = {0}, expected[most];
    size_t n = 0, parameters = symbols(dag, x->parameters, parameter);
    for (; x->e[n]; n++) e[n] = ex(dag, x->e[n]);
    nh_relation_verdict verdict = nh_relation_find(dag, n, e, parameters, parameter, 0, c);
    cr_expect(verdict == x->verdict, "%s, %s: verdict %d", x->e[0], x->e[1] ? x->e[1] : "", verdict);
    if (verdict == NH_RELATION_UNIQUE && x->verdict == verdict) {
        for (size_t j = 0; j < n; j++) expected[j] = ex(dag, x->c[j]);
        expect_proportional(dag, n, c, expected, x->e[0]);
        expect_vanishing(dag, n, e, c, x->e[0]);
    }
    nh_dag_free(dag);
}

static void try_all(size_t n, const example *x)
{
    for (size_t i = 0; i < n; i++) try(&x[i]);
}

#define TRY(list) try_all(sizeof(list) / sizeof *(list), list)

Test(relation, rational_coefficients)
{
    static const example list[] = {
        {"", NH_RELATION_UNIQUE, {"sin(x)^2", "cos(x)^2", "1"}, {"1", "1", "-1"}},
        {"", NH_RELATION_UNIQUE, {"tan(x)^2", "1/cos(x)^2", "1"}, {"1", "-1", "1"}},
        {"", NH_RELATION_UNIQUE, {"sin(x+y)", "sin(x)*cos(y)", "cos(x)*sin(y)"}, {"1", "-1", "-1"}},
        {"", NH_RELATION_UNIQUE, {"(x+y)^2", "x^2+y^2", "x*y"}, {"1", "-1", "-2"}},
        {"", NH_RELATION_UNIQUE, {"x/3", "5*x/7"}, {"15", "-7"}},
        {"", NH_RELATION_UNIQUE, {"cosh(x)", "exp(x)", "exp(-x)"}, {"2", "-1", "-1"}},
        {"", NH_RELATION_UNIQUE, {"1/(x-1)", "1/(x+1)", "1/(x^2-1)"}, {"1", "-1", "-2"}},
        {"", NH_RELATION_UNIQUE, {"1/(x*(x+1))", "1/x", "1/(x+1)", "y"}, {"1", "-1", "1", "0"}},
        {"", NH_RELATION_UNIQUE, {"sqrt(x^2+2*x+1+y^2)*y", "y*sqrt((x+1)^2+y^2)", "x"}, {"1", "-1", "0"}},
        {"", NH_RELATION_UNIQUE, {"1/(sqrt(x)-1)", "sqrt(x)/(x-1)", "1/(1-x)"}, {"1", "-1", "1"}},
        {"", NH_RELATION_UNIQUE, {"v/sqrt(x/y+1)", "v*sqrt(x/y+1)*y/(x+y)"}, {"1", "-1"}},
        {"", NH_RELATION_UNIQUE, {"sqrt(v^2+4*w^2)", "(v^2+4*w^2)/sqrt(4*v^2+16*w^2)"}, {"1", "-2"}},
        {"", NH_RELATION_UNIQUE, {"sqrt(2)*x", "x"}, {"1", "-sqrt(2)"}},
        {"", NH_RELATION_UNIQUE, {"pi*x+x", "x"}, {"1", "-1-pi"}},
        {"", NH_RELATION_NONE, {"x", "y"}, {0}},
        {"", NH_RELATION_NONE, {"sin(x)", "cos(x)", "1"}, {0}},
        {"", NH_RELATION_NONE, {"sqrt(x)", "x", "1/x"}, {0}},
        {"", NH_RELATION_NONE, {"a*x", "x"}, {0}},
        {"", NH_RELATION_SEVERAL, {"x", "2*x", "3*x"}, {0}},
        {"", NH_RELATION_SEVERAL, {"sin(2*x)", "sin(x)*cos(x)", "cos(2*x)", "cos(x)^2", "1"}, {0}},
    };
    TRY(list);
}

Test(relation, degenerate)
{
    static const example list[] = {
        {"", NH_RELATION_UNIQUE, {"0"}, {"1"}},
        {"", NH_RELATION_UNIQUE, {"sin(x)^2+cos(x)^2-1"}, {"1"}},
        {"", NH_RELATION_NONE, {"x"}, {0}},
        {"a", NH_RELATION_NONE, {"a"}, {0}},
        {"a", NH_RELATION_UNIQUE, {"a", "1"}, {"1", "-a"}},
        {"a", NH_RELATION_UNIQUE, {"x", "(x+1)^2-x^2-2*x-1", "a*y"}, {"0", "1", "0"}},
        {"", NH_RELATION_SEVERAL, {"0", "x", "0"}, {0}},
        {"", NH_RELATION_SEVERAL, {"x", "x", "y", "y"}, {0}},
        {"a b", NH_RELATION_SEVERAL, {"x", "a*x", "y", "b*y", "z"}, {0}},
        {"", NH_RELATION_UNIQUE, {"z", "y", "x", "x"}, {"0", "0", "1", "-1"}},
        {"", NH_RELATION_TOO_LARGE, {"1/(sin(x)^2+cos(x)^2-1)", "x"}, {0}},
    };
    TRY(list);
    nh_dag *dag = nh_dag_create();
    cr_expect(nh_relation_find(dag, 0, NULL, 0, NULL, 0, NULL) == NH_RELATION_NONE);
    nh_dag_free(dag);
}

Test(relation, parameters)
{
    static const example list[] = {
        {"m a k", NH_RELATION_UNIQUE,
         {"a*w^2*sin(f/k)+v*w*cos(f/k)/k", "-w*v*cos(f/k)/(a*k^2)-w^2*sin(f/k)/k"}, {"1", "a*k"}},
        {"a b", NH_RELATION_UNIQUE, {"a*x", "a*b*x"}, {"b", "-1"}},
        {"a b m", NH_RELATION_UNIQUE, {"(a^2-b^2)*x/m", "(a+b)^2*x"}, {"m*(a+b)", "b-a"}},
        {"J m a", NH_RELATION_UNIQUE, {"w^2+x", "v^2", "(J+m*a^2)*w^2+m*v^2+(J+m*a^2)*x"}, {"J+m*a^2", "m", "-1"}},
        {"J m a", NH_RELATION_UNIQUE, {"v*w/(J+m*a^2)+x", "v*w", "x"}, {"J+m*a^2", "-1", "-J-m*a^2"}},
        {"A B C", NH_RELATION_UNIQUE, {"2*w1*w2*w3*(B-C)/A", "2*w2*w3*w1*(C-A)/B"}, {"A*(C-A)", "B*(C-B)"}},
        {"A B C", NH_RELATION_SEVERAL,
         {"2*w1*w2*w3*(B-C)/A", "2*w2*w3*w1*(C-A)/B", "2*w1*w2*w3*(A-B)/C"}, {0}},
        {"A B C", NH_RELATION_UNIQUE,
         {"w1*(B-C)/A+w2", "w1*(C-A)/B+w2", "w1*(A-B)/C+w2"},
         {"(C-A)/B-(A-B)/C", "(A-B)/C-(B-C)/A", "(B-C)/A-(C-A)/B"}},
        {"a b", NH_RELATION_UNIQUE, {"sin(a*x+b*y)", "sin(a*x)*cos(b*y)", "b*cos(a*x)*sin(b*y)"}, {"b", "-b", "-1"}},
        {"a", NH_RELATION_UNIQUE, {"x*sin(a)^2", "x*cos(a)^2+y", "x+y"}, {"1", "1", "-1"}},
        {"a", NH_RELATION_UNIQUE, {"sin(x+a)", "sin(x)", "cos(x)"}, {"1", "-cos(a)", "-sin(a)"}},
        {"a", NH_RELATION_UNIQUE, {"exp(x+a)", "exp(x)", "y"}, {"1", "-exp(a)", "0"}},
        {"a b", NH_RELATION_UNIQUE, {"(a+b)^(x+1)", "(b+a)^x", "x*y"}, {"1", "-a-b", "0"}},
        {"a", NH_RELATION_NONE, {"x^a", "1"}, {0}},
        {"a", NH_RELATION_UNIQUE, {"x^(a+1)", "(x+a)*x^a", "x^a"}, {"1", "-1", "a"}},
        {"m", NH_RELATION_NONE, {"x", "m*y", "x*y"}, {0}},
        {"m a", NH_RELATION_NONE, {"x*m+a*y", "a*x+m*y"}, {0}},
        {"a b", NH_RELATION_NONE, {"x*sin(a*x)", "x*sin(b*x)"}, {0}},
    };
    TRY(list);
}

Test(relation, roots_of_parameters)
{
    static const example list[] = {
        {"m", NH_RELATION_UNIQUE, {"x*sqrt(m)", "m*x"}, {"sqrt(m)", "-1"}},
        {"m", NH_RELATION_UNIQUE, {"x/sqrt(m)", "x+m*x"}, {"m+1", "-1/sqrt(m)"}},
        {"J m a", NH_RELATION_UNIQUE, {"x*sqrt(J+m*a^2)+y", "x*(J+a^2*m)", "y"}, {"sqrt(J+m*a^2)", "-1", "-sqrt(J+m*a^2)"}},
        {"J m a", NH_RELATION_UNIQUE, {"x+y*sqrt(J+m*a^2)", "x*sqrt(J+a^2*m)+(J+m*a^2)*y"}, {"sqrt(J+m*a^2)", "-1"}},
        {"J m a", NH_RELATION_NONE, {"x+y*sqrt(J+m*a^2)", "x*sqrt(J+a^2*m)-(J+m*a^2)*y"}, {0}},
        {"m a", NH_RELATION_UNIQUE, {"x*m^(1/3)+y", "x*m+m^(2/3)*y"}, {"m^(2/3)", "-1"}},
        {"m a", NH_RELATION_UNIQUE, {"x/(1+sqrt(m))", "x/(1-sqrt(m))", "y"}, {"1+sqrt(m)", "sqrt(m)-1", "0"}},
        {"m a", NH_RELATION_UNIQUE, {"x*(sqrt(m)+sqrt(a))", "x*(a-m)"}, {"sqrt(m)-sqrt(a)", "1"}},
        {"m a k", NH_RELATION_UNIQUE, {"x*sqrt(m)*(k^(1/6)+1)", "x*m^(1/3)*a^(1/6)"}, {"a^(1/6)", "-m^(1/6)*(k^(1/6)+1)"}},
        {"m a", NH_RELATION_UNIQUE, {"x*sqrt(m/a+1)", "x*(m/a+1)"}, {"sqrt(m/a+1)", "-1"}},
    };
    TRY(list);
}

/* |u|, sign(u) and u are related, also from one expression to the next. */
Test(relation, pieces)
{
    static const example list[] = {
        {"k a m J", NH_RELATION_UNIQUE, {"k*(a-abs(x-y))*sign(x-y)/m", "k*(x-y-a*sign(x-y))/J"}, {"m", "J"}},
        {"a", NH_RELATION_UNIQUE, {"abs(x)*x", "a*sign(x)*x^2"}, {"a", "-1"}},
        {"a", NH_RELATION_UNIQUE, {"sign(x)^3*y", "a*abs(x)*y/x"}, {"a", "-1"}},
        {"a", NH_RELATION_NONE, {"abs(x)", "a*x"}, {0}},
    };
    TRY(list);
}

/* Roots of variables with a constant ratio. */
Test(relation, proportional_roots)
{
    static const example list[] = {
        {"m", NH_RELATION_UNIQUE, {"sqrt(m*(x^2+y^2))", "sqrt(x^2+y^2)"}, {"1", "-sqrt(m)"}},
        {"a k", NH_RELATION_UNIQUE, {"sqrt(v^2/a^2+k^2*w^2)", "1/sqrt(v^2+a^2*k^2*w^2)", "sqrt(v^2+a^2*k^2*w^2)"},
         {"sqrt(a^2)", "0", "-1"}},
        {"m a", NH_RELATION_UNIQUE, {"(m*x+a*m)^(1/3)", "(x+a)^(4/3)/(x+a)"}, {"1", "-m^(1/3)"}},
        {"m", NH_RELATION_UNIQUE, {"sqrt(m*x+m)*sqrt(m)+y", "m*sqrt(x+1)+y"}, {"1", "-1"}},
        {"m a", NH_RELATION_UNIQUE, {"sqrt(m*x+m)*m^(1/3)", "sqrt(x+1)*(1+sqrt(a))"}, {"1+sqrt(a)", "-m^(5/6)"}},
        {"m", NH_RELATION_NONE, {"sqrt(m*x+m)", "(x+1)^(1/3)"}, {0}},
        {"m", NH_RELATION_NONE, {"sqrt(m*x^2+y^2)", "sqrt(x^2+y^2)"}, {0}},
        {"", NH_RELATION_NONE, {"sqrt(m*(x^2+y^2))", "sqrt(x^2+y^2)"}, {0}},
    };
    TRY(list);
}

/* ---- derivatives along the Chaplygin sleigh: v' = a w^2, w' = -v w/(a k^2), f' = w ---- */

static nh_ex gamma_of(nh_dag *dag, const char *text, size_t fixed, const char *const (*value)[2])
{
    nh_ex symbol[4], component[4], from[4], to[4];
    static const char *const flow[4][2] = {{"v", "a*w^2"}, {"w", "-v*w/(a*k^2)"}, {"f", "w"}, {"t", "1"}};
    for (size_t i = 0; i < 4; i++) {
        symbol[i] = ex(dag, flow[i][0]);
        component[i] = ex(dag, flow[i][1]);
    }
    for (size_t i = 0; i < fixed; i++) {
        from[i] = ex(dag, value[i][0]);
        to[i] = ex(dag, value[i][1]);
    }
    return nh_substitute(dag, nh_diff_along(dag, ex(dag, text), 4, symbol, component), fixed, from, to);
}

static void sleigh(size_t fixed, const char *const (*value)[2], size_t n, const char *const *phi, const char *const *expected)
{
    nh_dag *dag = nh_dag_create();
    nh_ex parameter[3], e[most], c[most], x[most];
    size_t parameters = fixed ? 0 : symbols(dag, "m a k", parameter);
    for (size_t j = 0; j < n; j++) e[j] = gamma_of(dag, phi[j], fixed, value);
    cr_assert(nh_relation_find(dag, n, e, parameters, parameter, 0, c) == NH_RELATION_UNIQUE, "%s", phi[0]);
    for (size_t j = 0; j < n; j++) x[j] = ex(dag, expected[j]);
    expect_proportional(dag, n, c, x, phi[0]);
    expect_vanishing(dag, n, e, c, phi[0]);
    nh_dag_free(dag);
}

#define ENERGY "(m/2*(v^2+a^2*k^2*w^2))"
#define SPEED "sqrt(v^2/a^2+k^2*w^2)"

Test(relation, sleigh)
{
    static const char *const value[3][2] = {{"m", "2"}, {"a", "1"}, {"k", "2"}};
    static const char *const turn[] = {"v*sin(f/k)", "w*cos(f/k)"}, *const turned[] = {"1", "a*k"};
    static const char *const energy[] = {"v^2", "w^2", "v*sin(f/k)"}, *const energies[] = {"1", "a^2*k^2", "0"};
    static const char *const drift[] = {"t*sqrt(" ENERGY ")", "log((" SPEED "+v/a)/(" SPEED "-v/a))"};
    static const char *const exact[] = {"1", "-2"}, *const general[] = {"2", "-k^2*sqrt(m*a^2/2)"};
    sleigh(0, NULL, 2, turn, turned);
    sleigh(0, NULL, 3, energy, energies);
    sleigh(3, value, 2, drift, exact);
    sleigh(0, NULL, 2, drift, general);
}

/* ---- the form of the result ---- */

static void expect_exactly(const char *parameters, const char *const *text, const char *const *expected)
{
    nh_dag *dag = nh_dag_create();
    nh_ex parameter[most], e[most], c[most];
    size_t n = 0, count = symbols(dag, parameters, parameter);
    for (; text[n]; n++) e[n] = ex(dag, text[n]);
    cr_assert(nh_relation_find(dag, n, e, count, parameter, 0, c) == NH_RELATION_UNIQUE, "%s", text[0]);
    for (size_t j = 0; j < n; j++) {
        char *got = nh_print_string(dag, c[j]);
        cr_expect(c[j] == ex(dag, expected[j]), "%s: %s is %s", text[j], expected[j], got);
        nh_free(got);
    }
    nh_dag_free(dag);
}

#define PULL(q, p) "*cos(" q " - " p ")/sin(" q " - " p ")^3"

/* The forces among four particles on a circle, which add up to zero: as polynomials in sines and cosines their common
   denominator has more than 5000 terms, in exponentials less. */
Test(relation, sines_of_differences_have_short_denominators)
{
    static const char *const text[] = {"a*(m" PULL("x", "y") " + m" PULL("x", "z") " + m" PULL("x", "u") ")",
                                       "m" PULL("y", "x") " + m" PULL("y", "z") " + m" PULL("y", "u"),
                                       "m" PULL("z", "x") " + m" PULL("z", "y") " + m" PULL("z", "u"),
                                       "m" PULL("u", "x") " + m" PULL("u", "y") " + m" PULL("u", "z")};
    static const char *const expected[] = {"1", "a", "a", "a"};
    enum { n = 4, few = 5000 };
    nh_dag *dag = nh_dag_create();
    nh_ex parameter[2], e[n], c[n];
    size_t parameters = symbols(dag, "a m", parameter);
    for (size_t j = 0; j < n; j++) e[j] = ex(dag, text[j]);
    cr_assert(nh_relation_find(dag, n, e, parameters, parameter, few, c) == NH_RELATION_UNIQUE);
    for (size_t j = 0; j < n; j++) cr_expect(c[j] == ex(dag, expected[j]), "coefficient %zu", j);
    nh_dag_free(dag);
}

#define LIST(...) (const char *const[]){__VA_ARGS__, NULL}

/* No common factor, a positive leading coefficient first, factored where that is shorter. */
Test(relation, normalised)
{
    expect_exactly("", LIST("-x", "x"), LIST("1", "1"));
    expect_exactly("", LIST("6*x", "-4*x"), LIST("2", "3"));
    expect_exactly("a b", LIST("y", "-6*a^2*x", "-4*a*b*x"), LIST("0", "2*b", "-3*a"));
    expect_exactly("a b", LIST("(a+b)*x/a", "(a+b)^2*x"), LIST("a*(a+b)", "-1"));
    expect_exactly("a b m", LIST("x", "x*m*(a+b)^3*(a-2*b)"), LIST("m*(a+b)^3*(a-2*b)", "-1"));
    expect_exactly("m", LIST("x*sqrt(m)", "m*x"), LIST("sqrt(m)", "-1"));
    expect_exactly("m", LIST("x*sqrt(m)", "x*(1+m)"), LIST("m+1", "-sqrt(m)"));
}

/* ---- limits ---- */

static nh_relation_verdict verdict_with(size_t max_terms, const char *first, const char *second)
{
    nh_dag *dag = nh_dag_create();
    nh_ex e[2] = {ex(dag, first), ex(dag, second)}, c[2];
    nh_relation_verdict verdict = nh_relation_find(dag, 2, e, 0, NULL, max_terms, c);
    nh_dag_free(dag);
    return verdict;
}

Test(relation, limits)
{
    cr_expect(verdict_with(0, "(x+y+z)^8", "2*(x+y+z)^8") == NH_RELATION_UNIQUE);
    cr_expect(verdict_with(40, "(x+y+z)^8", "2*(x+y+z)^8") == NH_RELATION_TOO_LARGE);
    cr_expect(verdict_with(0, "(x+y+z+u+v+w)^40", "x") == NH_RELATION_TOO_LARGE);
    cr_expect(verdict_with(0, "10000000000000000000*x", "x") == NH_RELATION_TOO_LARGE);
    cr_expect(verdict_with(0, "9000000000000000000*x*(1+9000000000000000000*y)", "x+9000000000000000000*y*x") == NH_RELATION_UNIQUE);
    cr_expect(verdict_with(0, "3000000000*x", "x/5000000000") == NH_RELATION_TOO_LARGE, "the coefficient does not fit");
}

Test(relation, inexact_constants)
{
    nh_dag *dag = nh_dag_create();
    nh_ex x = nh_symbol(dag, "x"), c[2], e[2] = {nh_mul(dag, nh_real(dag, 0.1), x), nh_mul(dag, nh_real(dag, 0.3), x)};
    cr_expect(nh_relation_find(dag, 2, e, 0, NULL, 0, c) == NH_RELATION_TOO_LARGE);
    e[0] = nh_call(dag, NH_SIN, e[0]);
    e[1] = nh_mul(dag, nh_int(dag, 2), e[0]);
    cr_expect(nh_relation_find(dag, 2, e, 0, NULL, 0, c) == NH_RELATION_TOO_LARGE);
    e[0] = nh_add(dag, x, nh_ratio(dag, 1, 10));
    e[1] = nh_mul(dag, nh_int(dag, 2), e[0]);
    cr_expect(nh_relation_find(dag, 2, e, 0, NULL, 0, c) == NH_RELATION_UNIQUE);
    nh_dag_free(dag);
}

/* ---- built relations ---- */

/* Independent over the field of the parameters m, a, k, b. */
static const char *const independent[] = {
    "x*y", "y*sin(x)^2", "w*cos(x)", "x/(y+m)", "y*sqrt(x^2+m)", "exp(x)", "y^3", "sin(x+a*y)", "tan(x)", "w*log(x)",
    "x^2*y^2/(a^2+k)", "w*sin(2*x)", "1/(x+y)^2", "w^2/(m*x+y*k)", "k*cosh(y)", "sqrt(y+1)*w", "1", "v*cos(x)/(1+sin(x))",
};
static const char *const factors[] = {"1", "m", "a*k", "-3", "J+m*a^2", "(A-C)/B", "1/k", "2*a-b", "m*k^2", "-a/(m+b)", "5/7", "(m+J)*(a-1)"};

static size_t below(size_t n) { return (size_t)uniform(0, (double)n) % n; }

static void build(nh_dag *dag, size_t n, nh_ex *e, nh_ex *expected)
{
    size_t pool = sizeof independent / sizeof *independent, start = below(pool), last = below(n);
    nh_ex sum = nh_int(dag, 0), own = ex(dag, factors[below(sizeof factors / sizeof *factors)]);
    for (size_t j = 0, i = start; j < n; j++) {
        if (j == last) continue;
        e[j] = ex(dag, independent[i++ % pool]);
        expected[j] = below(4) ? ex(dag, factors[below(sizeof factors / sizeof *factors)]) : nh_int(dag, 0);
        if (below(3) == 0) e[j] = nh_mul(dag, e[j], ex(dag, "sin(u)^2+cos(u)^2"));
        sum = nh_add(dag, sum, nh_mul(dag, expected[j], e[j]));
    }
    expected[last] = own;
    e[last] = nh_mul(dag, nh_div(dag, sum, nh_neg(dag, own)), ex(dag, "(1+tan(w)^2)*cos(w)^2"));
}

Test(relation, recovers_what_was_built, PLAIN_ONLY)
{
    for (int round = 0; round < 60; round++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e[most], expected[most], c[most], parameter[8];
        size_t n = 2 + below(11), parameters = symbols(dag, "m a k b J A B C", parameter);
        char what[40];
        snprintf(what, sizeof what, "round %d, n = %zu", round, n);
        build(dag, n, e, expected);
        nh_relation_verdict verdict = nh_relation_find(dag, n, e, parameters, parameter, 0, c);
        cr_assert(verdict == NH_RELATION_UNIQUE, "%s: verdict %d", what, verdict);
        expect_proportional(dag, n, c, expected, what);
        expect_vanishing(dag, n, e, c, what);
        size_t other = below(n);
        e[other] = nh_add(dag, e[other], ex(dag, "w^5*x"));
        verdict = nh_relation_find(dag, n, e, parameters, parameter, 0, c);
        bool free_column = nh_is_zero(dag, expected[other]);
        cr_expect(verdict == (free_column ? NH_RELATION_UNIQUE : NH_RELATION_NONE), "%s, spoilt: verdict %d", what, verdict);
        nh_dag_free(dag);
    }
}

/* n general vectors in n - 1 dimensions: the coefficients are minors, which no sparsity gives away. */
Test(relation, dense)
{
    for (size_t n = 3; n <= 7; n++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e[most], c[most], parameter[3];
        char text[200];
        size_t parameters = symbols(dag, "m a k", parameter);
        for (size_t j = 0; j < n; j++) {
            e[j] = nh_int(dag, 0);
            for (size_t i = 1; i < n; i++) {
                snprintf(text, sizeof text, "(%zu*m+%zu*a+k*%zu+%zu)*x^%zu", below(9), below(9), below(3), 1 + below(9), i);
                e[j] = nh_add(dag, e[j], ex(dag, text));
            }
        }
        cr_assert(nh_relation_find(dag, n, e, parameters, parameter, 0, c) == NH_RELATION_UNIQUE, "n = %zu", n);
        expect_vanishing(dag, n, e, c, "dense");
        nh_ex sum = nh_int(dag, 0);
        for (size_t j = 0; j < n; j++) sum = nh_add(dag, sum, nh_mul(dag, c[j], e[j]));
        cr_expect(nh_normal_is_zero(dag, sum, 0) == NH_ZERO);
        nh_dag_free(dag);
    }
}

/* ---- numbers for which there is a relation ---- */

/* Rates of terms along x'' = .., with unknown numbers A, B; at the values of the parameters a, b, k these are `value`. */
typedef struct {
    const char *what, *rate[4];
    double c[4], parameter[3], value[2];
    const char *expected[2];
} unknown_case;

static void expect_unknown(const unknown_case *s)
{
    nh_dag *dag = nh_dag_create();
    nh_ex e[4], parameter[3], unknown[2], x[2];
    size_t n = 0, unknowns = s->expected[1] ? 2 : 1;
    symbols(dag, "a b k", parameter);
    symbols(dag, "A B", unknown);
    for (; n < 4 && s->rate[n]; n++) e[n] = ex(dag, s->rate[n]);
    nh_unknown_numbers numbers = {dag, 3, parameter, s->parameter, unknowns, unknown, s->value, 0};
    cr_assert(nh_relation_unknown(&numbers, n, e, s->c, x), "%s: nothing found", s->what);
    for (size_t i = 0; i < unknowns; i++) {
        char *text = nh_print_string(dag, x[i]);
        cr_expect(nh_normal_is_zero(dag, nh_sub(dag, x[i], ex(dag, s->expected[i])), 0) == NH_ZERO, "%s: %s", s->what, text);
        nh_free(text);
    }
    nh_dag_free(dag);
}

Test(relation, numbers_are_solved_for)
{
    /* v' = -k x/a: v cos(A t) + A x sin(A t) */
    expect_unknown(&(unknown_case){"a frequency", {"-k*x/a*cos(A*t) - A*v*sin(A*t)", "v*sin(A*t) + A*x*cos(A*t)"}, {1, 1.5}, {2, 1, 4.5}, {1.5}, {"sqrt(k)/sqrt(a)"}});
    /* v' = -a v - k x, underdamped: e^(A t) (c_1 x sin(B t) + c_2 x cos(B t) + v cos(B t)), A = a/2 and B^2 = k - a^2/4 */
    expect_unknown(&(unknown_case){"a decay with a frequency", {"exp(A*t)*(v*sin(B*t) + A*x*sin(B*t) + B*x*cos(B*t))", "exp(A*t)*(v*cos(B*t) + A*x*cos(B*t) - B*x*sin(B*t))",
                                    "exp(A*t)*(-(a*v + k*x)*cos(B*t) + A*v*cos(B*t) - B*v*sin(B*t))"}, {1.2, 0.5, 1}, {1, 3, 1.69}, {0.5, 1.2}, {"a/2", "sqrt(4*k - a^2)/2"}});
    /* v' = -a v - k x, overdamped */
    expect_unknown(&(unknown_case){"one of two decays", {"exp(A*t)*(A*x + v)", "exp(A*t)*(A*v - a*v - k*x)"}, {2, 1}, {3, 1, 2}, {1}, {"(a - sqrt(a^2 - 4*k))/2"}});
    expect_unknown(&(unknown_case){"an exponent", {"x^A*v*(A*a - b)"}, {1}, {3, 1, 2}, {1. / 3}, {"b/a"}});
}

/* A number that no relation needs is no function of the parameters, and neither is one of a cubic equation. */
Test(relation, numbers_without_a_form_are_left_alone)
{
    nh_dag *dag = nh_dag_create();
    nh_ex e[1] = {ex(dag, "x*(A^3 - A - a)")}, parameter[1], unknown[1], x[1];
    double a = 6, value = 2, c = 1;
    symbols(dag, "a", parameter);
    symbols(dag, "A", unknown);
    cr_expect_not(nh_relation_unknown(&(nh_unknown_numbers){dag, 1, parameter, &a, 1, unknown, &value, 0}, 1, e, &c, x));
    value = 3; /* there is no relation */
    cr_expect_not(nh_relation_unknown(&(nh_unknown_numbers){dag, 1, parameter, &a, 1, unknown, &value, 0}, 1, e, &c, x));
    nh_dag_free(dag);
}

/* ---- one by others ---- */

/* The last as a combination of the others: which of them, the first possible ones; by residues along a curve, and by normal forms where these say nothing. */
Test(relation, one_expression_by_others)
{
    static const struct {
        const char *parameters;
        size_t n;
        const char *e[6];
        bool found;
        const char *c[5];
    } ROW[] = {
        {"a b", 4, {"x^2", "x", "1", "(a*x + b)^2"}, true, {"a^2", "2*a*b", "b^2"}},
        {"a", 3, {"x", "1", "1/(x + a)"}, false, {0}},
        {"", 4, {"sin(x)^2", "cos(x)^2", "cos(2*x)", "1"}, true, {"1", "1", "0"}}, /* the first possible ones */
        {"a", 4, {"1/x", "1/(x + a)", "1/(x*(x + a))", "(2*x + a)/(x*(x + a))"}, true, {"1", "1", "0"}},
        {"a k", 3, {"exp(a*x)*x", "exp(a*x)", "exp(a*x)*(x - k)/k"}, true, {"1/k", "-1"}},
        {"a", 2, {"sqrt(x + a)/x", "(x + a)/(x*sqrt(x + a))"}, true, {"1"}},
        {"", 2, {"x", "0*x"}, true, {"0"}},
        {"", 3, {"y*x", "y", "y*(3*x - 5)/7"}, true, {"3/7", "-5/7"}},
        {"", 2, {"y*x", "x"}, false, {0}},
        {"a", 2, {"legendre_p(a, x)*x", "x*legendre_p(a, x)/a"}, true, {"1/a"}}, /* not along a curve */
    };
    for (size_t i = 0; i < sizeof ROW / sizeof *ROW; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e[6], c[5], parameter[4];
        for (size_t j = 0; j < ROW[i].n; j++) e[j] = ex(dag, ROW[i].e[j]);
        size_t parameters = symbols(dag, ROW[i].parameters, parameter);
        bool found = nh_relation_express(dag, ROW[i].n, e, parameters, parameter, 0, c);
        cr_expect_eq(found, ROW[i].found, "%s", ROW[i].e[ROW[i].n - 1]);
        for (size_t j = 0; j + 1 < ROW[i].n && found && ROW[i].found; j++)
            cr_expect_eq(nh_normal_is_zero(dag, nh_sub(dag, c[j], ex(dag, ROW[i].c[j])), 0), NH_ZERO, "%s: number %zu", ROW[i].e[ROW[i].n - 1], j);
        nh_dag_free(dag);
    }
}

/* s^2 = x^2: s is x only on one branch, so that it is not expressed by x. */
Test(relation, one_expression_by_others_on_two_branches)
{
    nh_dag *dag = nh_dag_create();
    nh_ex x = nh_symbol(dag, "x"), s = nh_symbol(dag, "s"), e[] = {x, s}, c[1];
    nh_relate(dag, s, 2, ex(dag, "x^2"));
    cr_expect(!nh_relation_express(dag, 2, e, 0, NULL, 0, c));
    nh_dag_free(dag);
}
