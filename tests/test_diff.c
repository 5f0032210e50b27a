/* Exact derivatives against a complex step, against differences of the derivative one order lower, and against Newton. */
#include <complex.h>
#include <criterion/criterion.h>
#include <math.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "random_expression.h"
#include "sweep.h"

/* ---- a complex evaluator ---- */

/* The inverse functions lose a tiny imaginary part in the C library; they are continued by their derivative. */
static double inverse_slope(nh_function f, double a)
{
    switch (f) {
    case NH_ASIN: return 1 / sqrt(1 - a * a);
    case NH_ACOS: return -1 / sqrt(1 - a * a);
    case NH_ATAN: return 1 / (1 + a * a);
    case NH_ASINH: return 1 / sqrt(1 + a * a);
    case NH_ACOSH: return 1 / sqrt(a * a - 1);
    default: return 1 / (1 - a * a);
    }
}

static complex double complex_call(nh_function f, complex double a, complex double b)
{
    static complex double (*const of[])(complex double) = {
        [NH_SIN] = csin, [NH_COS] = ccos, [NH_TAN] = ctan, [NH_SINH] = csinh, [NH_COSH] = ccosh, [NH_TANH] = ctanh,
        [NH_EXP] = cexp, [NH_LOG] = clog};
    if (f <= NH_LOG && of[f]) return of[f](a);
    if (f < NH_LOG) return naive_call(f, creal(a), 0) + I * cimag(a) * inverse_slope(f, creal(a));
    double sign = creal(a) < 0 ? -1 : 1;
    if (f == NH_ABS) return sign * a;
    if (f == NH_SIGN) return sign;
    if (f == NH_PI) return acos(-1);
    double angle = atan2(creal(a), creal(b)); /* d atan2 = (b da - a db)/(a^2 + b^2) */
    return angle + I * (creal(b) * cimag(a) - creal(a) * cimag(b)) / (creal(a) * creal(a) + creal(b) * creal(b));
}

/* Whole powers by multiplication: the logarithm of a negative number has no room for a tiny imaginary part. */
static complex double complex_power(complex double base, complex double x)
{
    if (cimag(x) != 0 || creal(x) != floor(creal(x)) || fabs(creal(x)) > 100) return cexp(x * clog(base));
    complex double value = 1;
    for (double n = fabs(creal(x)); n > 0; n--) value *= base;
    return creal(x) < 0 ? 1 / value : value;
}

static complex double complex_value(const nh_dag *dag, nh_ex e, const nh_ex *symbol, const complex double *at)
{
    nh_kind kind = nh_kind_of(dag, e);
    if (kind == NH_NUMBER) return nh_num_value(nh_number_of(dag, e));
    for (size_t i = 0; kind == NH_SYMBOL && i < SYMBOLS; i++)
        if (symbol[i] == e) return at[i];
    size_t n = nh_arity(dag, e);
    if (kind == NH_FUNCTION) {
        complex double a = n > 0 ? complex_value(dag, nh_child(dag, e, 0), symbol, at) : 0;
        return complex_call(nh_function_of(dag, e), a, n > 1 ? complex_value(dag, nh_child(dag, e, 1), symbol, at) : 0);
    }
    complex double value = nh_num_value(nh_constant_of(dag, e));
    for (size_t i = 0; i < n; i++) {
        complex double v = complex_value(dag, nh_child(dag, e, i), symbol, at);
        if (kind == NH_SUM) value += nh_num_value(nh_coefficient_of(dag, e, i)) * v;
        else value *= complex_power(v, complex_value(dag, nh_exponent_of(dag, e, i), symbol, at));
    }
    return value;
}

/* ---- random expressions ---- */

typedef struct {
    source s;
    nh_ex e;
    double at[SYMBOLS];
} sample;

/* An expression and a point where it is defined, with its neighbourhood. */
static bool draw(sample *p, uint64_t seed, int depth)
{
    p->s = source_create(seed);
    p->e = random_expression(&p->s, depth);
    for (int i = 0; i < SYMBOLS; i++) p->at[i] = random_real(&p->s, 0.2, 1.7);
    double size = 0, value = naive_value(p->s.dag, p->e, p->s.symbol, p->at, &size);
    return isfinite(value) && size < 1e3;
}

static double value_at(const sample *p, nh_ex e, double *size)
{
    return naive_value(p->s.dag, e, p->s.symbol, p->at, size);
}

static void show(const sample *p, nh_ex derivative, double exact, double other)
{
    char *e = nh_print_string(p->s.dag, p->e), *d = nh_print_string(p->s.dag, derivative);
    cr_assert_fail("%s has the derivative %s = %.15g, not %.15g", e, d, exact, other);
}

Test(diff, first_derivatives_against_a_complex_step)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 6000; seed++) {
        sample p;
        bool good = draw(&p, seed, 2 + (int)(seed % 4));
        for (int i = 0; good && i < SYMBOLS; i++) {
            complex double at[SYMBOLS];
            for (int k = 0; k < SYMBOLS; k++) at[k] = p.at[k];
            at[i] += 1e-100 * I;
            double step = cimag(complex_value(p.s.dag, p.e, p.s.symbol, at)) / 1e-100, size = fabs(step) + 1;
            nh_ex d = nh_diff(p.s.dag, p.e, p.s.symbol[i]);
            double exact = value_at(&p, d, &size);
            if (!isfinite(exact) || !isfinite(step) || size > 1e6) continue;
            if (fabs(exact - step) > 1e-10 * size) show(&p, d, exact, step);
            compared++;
        }
        nh_dag_free(p.s.dag);
    }
    cr_expect_gt(compared, 10000);
}

/* (f(x + h) - f(x - h))/2h, improved once by Richardson. */
static double difference(sample *p, nh_ex e, int i, double *size)
{
    double middle = p->at[i], d[2];
    for (int k = 0; k < 2; k++) {
        double h = 2e-4 / (1 + k), high, low;
        p->at[i] = middle + h;
        high = value_at(p, e, size);
        p->at[i] = middle - h;
        low = value_at(p, e, size);
        d[k] = (high - low) / (2 * h);
    }
    p->at[i] = middle;
    *size = fmax(*size, 1e7 * fabs(d[1] - d[0])); /* close to a singularity differences tell little */
    return (4 * d[1] - d[0]) / 3;
}

Test(diff, higher_derivatives_against_differences)
{
    size_t compared[3] = {0};
    for (uint64_t seed = 1; seed <= 6000; seed++) {
        sample p;
        nh_ex e = draw(&p, seed, 2 + (int)(seed % 3)) ? p.e : 0;
        for (int order = 1; order <= 3; order++) {
            int i = random_below(&p.s, SYMBOLS);
            nh_ex d = nh_diff(p.s.dag, e, p.s.symbol[i]);
            double size = 1, exact = value_at(&p, d, &size), other = difference(&p, e, i, &size);
            if (!isfinite(exact) || !isfinite(other) || size > 1e5) break;
            if (fabs(exact - other) > 1e-7 * size) show(&p, d, exact, other);
            compared[order - 1] += !nh_is_zero(p.s.dag, d);
            e = d;
        }
        nh_dag_free(p.s.dag);
    }
    cr_expect(compared[0] > 1000 && compared[1] > 400 && compared[2] > 200, "%zu %zu %zu", compared[0], compared[1], compared[2]);
}

Test(diff, mixed_derivatives_commute)
{
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        sample p;
        if (draw(&p, seed, 3)) {
            nh_ex x = p.s.symbol[random_below(&p.s, 2)], y = p.s.symbol[2 + random_below(&p.s, 2)];
            nh_ex a = nh_diff(p.s.dag, nh_diff(p.s.dag, p.e, x), y), b = nh_diff(p.s.dag, nh_diff(p.s.dag, p.e, y), x);
            double size = 1, va = value_at(&p, a, &size), vb = value_at(&p, b, &size);
            if (isfinite(va + vb) && size < 1e8 && fabs(va - vb) > 1e-11 * size) show(&p, a, va, vb);
        }
        nh_dag_free(p.s.dag);
    }
}

/* ---- known derivatives ---- */

Test(diff, table)
{
    static const char *const known[][2] = {
        {"x^n", "n*x^(n - 1)"}, {"n^x", "n^x*log(n)"}, {"2^x", "2^x*log(2)"}, {"sin(x)", "cos(x)"}, {"cos(x)", "-sin(x)"},
        {"tan(x)", "1 + tan(x)^2"}, {"asin(x)", "1/sqrt(1 - x^2)"}, {"acos(x)", "-1/sqrt(1 - x^2)"}, {"atan(x)", "1/(1 + x^2)"},
        {"sinh(x)", "cosh(x)"}, {"cosh(x)", "sinh(x)"}, {"tanh(x)", "1 - tanh(x)^2"}, {"asinh(x)", "1/sqrt(1 + x^2)"},
        {"acosh(x)", "1/(sqrt(x - 1)*sqrt(x + 1))"}, {"atanh(x)", "1/(1 - x^2)"}, {"exp(a*x)", "a*exp(a*x)"}, {"log(x)", "1/x"},
        {"abs(x)", "sign(x)"}, {"sign(x)", "0"}, {"atan2(x, y)", "y/(x^2 + y^2)"}, {"atan2(y, x)", "-y/(x^2 + y^2)"},
        {"sqrt(x*y)", "sqrt(x*y)/(2*x)"}, {"1/x", "-1/x^2"}, {"x*y*z", "y*z"}, {"pi*x", "pi"}, {"y", "0"}, {"x^x", "x^x + x^x*log(x)"},
        {"sin(x)^2*x^3/(1 + x)", "2*sin(x)*cos(x)*x^3/(1 + x) + 3*sin(x)^2*x^2/(1 + x) - sin(x)^2*x^3/(1 + x)^2"},
    };
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        nh_ex e = nh_diff(d, parsed(d, known[i][0]), nh_symbol(d, "x"));
        char *text = nh_print_string(d, e);
        cr_expect_eq(e, parsed(d, known[i][1]), "%s gives %s", known[i][0], text);
        nh_free(text);
    }
    nh_dag_free(d);
}

Test(diff, along_a_field)
{
    for (uint64_t seed = 1; seed <= 500; seed++) {
        sample p;
        if (draw(&p, seed, 4)) {
            nh_dag *d = p.s.dag;
            nh_ex field[SYMBOLS], sum = nh_int(d, 0);
            for (int i = 0; i < SYMBOLS; i++) field[i] = i == 2 ? nh_int(d, 0) : random_expression(&p.s, 2);
            for (int i = 0; i < SYMBOLS; i++) sum = nh_add(d, sum, nh_mul(d, field[i], nh_diff(d, p.e, p.s.symbol[i])));
            cr_assert_eq(nh_diff_along(d, p.e, SYMBOLS, p.s.symbol, field), sum);
        }
        nh_dag_free(p.s.dag);
    }
    nh_dag *d = nh_dag_create();
    cr_expect(nh_is_zero(d, nh_diff_along(d, parsed(d, "x^2"), 0, NULL, NULL)));
    nh_dag_free(d);
}

/* ---- implicit symbols ---- */

/* u with u^3 + u = x y: u_x = y/(3 u^2 + 1), u_y = x/(3 u^2 + 1). */
static double root_of(double xy)
{
    double u = 0;
    for (int i = 0; i < 60; i++) u -= (u * u * u + u - xy) / (3 * u * u + 1);
    return u;
}

static double implicit_value(nh_dag *d, nh_ex e, double x, double y)
{
    nh_ex symbol[SYMBOLS] = {nh_symbol(d, "x"), nh_symbol(d, "y"), nh_symbol(d, "u"), nh_symbol(d, "unused")};
    double size = 0;
    return naive_value(d, e, symbol, (double[]){x, y, root_of(x * y), 0}, &size);
}

Test(diff, implicit_symbols_follow_their_rules)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y"), u = nh_symbol(d, "u"), e = parsed(d, "u^2*sin(x + u)/y");
    nh_ex before = nh_diff(d, e, u);
    nh_diff_rule(d, u, x, parsed(d, "y/(3*u^2 + 1)"));
    nh_diff_rule(d, u, y, parsed(d, "x/(3*u^2 + 1)"));
    cr_expect_eq(nh_diff(d, e, u), before, "a rule in x changes no derivative in u");
    cr_expect_eq(nh_diff(d, u, x), parsed(d, "y/(3*u^2 + 1)"));
    cr_expect_eq(nh_diff(d, parsed(d, "z*y"), x), nh_int(d, 0));
    nh_ex f = e;
    const double at[2] = {1.2385, 0.7071}, h = 1e-4;
    for (int order = 1; order <= 3; order++) { /* d/dx, d2/dxdy, d3/dxdydx */
        nh_ex next = nh_diff(d, f, order % 2 ? x : y);
        double dx = order % 2 ? h : 0, dy = h - dx;
        double near = (implicit_value(d, f, at[0] + dx, at[1] + dy) - implicit_value(d, f, at[0] - dx, at[1] - dy)) / (2 * h);
        double far = (implicit_value(d, f, at[0] + 2 * dx, at[1] + 2 * dy) - implicit_value(d, f, at[0] - 2 * dx, at[1] - 2 * dy)) / (4 * h);
        double exact = implicit_value(d, next, at[0], at[1]);
        cr_expect_float_eq(exact, (4 * near - far) / 3, 1e-9 * (1 + fabs(exact)), "order %d: %g", order, exact);
        f = next;
    }
    nh_ex xy = nh_diff(d, nh_diff(d, e, x), y), yx = nh_diff(d, nh_diff(d, e, y), x);
    cr_expect_float_eq(implicit_value(d, xy, at[0], at[1]), implicit_value(d, yx, at[0], at[1]), 1e-13);
    nh_dag_free(d);
}

/* ---- size ---- */

Test(diff, deep_expressions_need_no_deep_stack, PLAIN_ONLY)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), e = x;
    for (int i = 0; i < 100000; i++) e = nh_call(d, NH_SIN, nh_add(d, e, nh_symbol(d, "a")));
    nh_ex derivative = nh_diff(d, e, nh_symbol(d, "a"));
    cr_expect(nh_depends(d, derivative, x));
    nh_dag_free(d);
}

Test(diff, wide_expressions, PLAIN_ONLY)
{
    int sum_terms = sweep_whole() ? 100000 : 30000, factors = sweep_whole() ? 1000 : 400;
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), *part = nh_alloc_array(sum_terms, sizeof *part);
    nh_num *one = nh_alloc_array(sum_terms, sizeof *one);
    for (int i = 0; i < sum_terms; i++) {
        one[i] = nh_num_int(1);
        part[i] = nh_call(d, NH_SIN, nh_mul(d, nh_int(d, i + 1), x));
    }
    cr_expect_eq(nh_arity(d, nh_diff(d, nh_linear(d, sum_terms, one, part), x)), sum_terms);
    cr_expect_eq(nh_arity(d, nh_diff(d, nh_product(d, factors, part), x)), factors);
    nh_free(one);
    nh_free(part);
    nh_dag_free(d);
}

/* All derivatives at once, by accumulation, against one at a time. */
Test(diff, gradient_agrees_with_diff)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 300; seed++) {
        source s = source_create(seed);
        nh_ex e = random_expression(&s, 5), slope[SYMBOLS];
        double at[SYMBOLS];
        nh_gradient(s.dag, e, SYMBOLS, s.symbol, slope);
        for (size_t i = 0; i < SYMBOLS; i++) at[i] = random_real(&s, 0.4, 1.7);
        for (size_t i = 0; i < SYMBOLS; i++) {
            double size = 1, one = naive_value(s.dag, nh_diff(s.dag, e, s.symbol[i]), s.symbol, at, &size), all = naive_value(s.dag, slope[i], s.symbol, at, &size);
            if (!isfinite(one) || !(size < 1e5)) continue;
            cr_expect_leq(fabs(one - all), 1e-9 * (1 + size), "seed %d, symbol %zu: %.17g and %.17g", (int)seed, i, one, all);
            compared++;
        }
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, (size_t)600, "only %zu", compared);
}
