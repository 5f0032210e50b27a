/* ball: rigorous values, exact where they can be, and honest about what is not finite. */
#include <criterion/criterion.h>
#include <math.h>

#include "exact/ball_matrix.h"
#include "exact/ball_fit.h"
#include "graph/dag.h"
#include "graph/function.h"

static nh_dag *dag;
static nh_ball *ball;
static nh_ex x, y;

static void start(void)
{
    dag = nh_dag_create();
    x = nh_symbol(dag, "x");
    y = nh_symbol(dag, "y");
    ball = nh_ball_create(dag, 128);
}

static void stop(void)
{
    nh_ball_free(ball);
    nh_dag_free(dag);
}

TestSuite(ball, .init = start, .fini = stop);

static void expect_value(nh_ex e, double expected)
{
    double mid, radius;
    cr_assert(nh_ball_value(ball, e, &mid, &radius));
    cr_expect_leq(fabs(mid - expected), radius + 4e-16 * fabs(expected), "%.17g instead of %.17g", mid, expected);
    cr_expect_leq(radius, 1e-15 * fabs(expected) + 1e-30, "radius %g", radius);
}

static bool has_value(nh_ex e)
{
    double mid, radius;
    return nh_ball_value(ball, e, &mid, &radius);
}

Test(ball, functions)
{
    static const struct {
        nh_function f;
        double (*g)(double);
    } table[] = {{NH_SIN, sin}, {NH_COS, cos}, {NH_TAN, tan}, {NH_ASIN, asin}, {NH_ACOS, acos}, {NH_ATAN, atan}, {NH_SINH, sinh},
                 {NH_COSH, cosh}, {NH_TANH, tanh}, {NH_ASINH, asinh}, {NH_ATANH, atanh}, {NH_EXP, exp}, {NH_LOG, log}, {NH_ABS, fabs}};
    nh_ball_set_double(ball, x, 0.7236);
    for (size_t i = 0; i < sizeof table / sizeof *table; i++) expect_value(nh_call(dag, table[i].f, x), table[i].g(0.7236));
    nh_ball_set_double(ball, x, -2.385);
    expect_value(nh_call(dag, NH_ABS, x), 2.385);
    expect_value(nh_call(dag, NH_SIGN, x), -1);
    expect_value(nh_call(dag, NH_ACOSH, nh_neg(dag, x)), acosh(2.385));
    expect_value(nh_pi(dag), acos(-1));
}

Test(ball, arctangent_of_two_arguments)
{
    static const double point[][2] = {{1, 2}, {1, -2}, {-1, -2}, {-1, 2}, {0, 3}, {3, 0}, {-3, 0}};
    for (size_t i = 0; i < sizeof point / sizeof *point; i++) {
        nh_ball_set_double(ball, y, point[i][0]);
        nh_ball_set_double(ball, x, point[i][1]);
        expect_value(nh_call2(dag, NH_ATAN2, y, x), atan2(point[i][0], point[i][1]));
    }
}

Test(ball, powers)
{
    nh_ball_set_ratio(ball, x, 9, 4);
    nh_ball_set_ratio(ball, y, -3, 1);
    expect_value(nh_sqrt(dag, x), 1.5);
    expect_value(nh_pow(dag, x, nh_ratio(dag, -3, 2)), 8.0 / 27);
    expect_value(nh_pow(dag, x, nh_ratio(dag, 1, 3)), cbrt(2.25));
    expect_value(nh_pow(dag, x, y), 64.0 / 729);
    expect_value(nh_powi(dag, y, -3), -1.0 / 27);
    nh_ball_set_ratio(ball, x, 999999, 1000000);
    expect_value(nh_powi(dag, x, 1000000), exp(1e6 * log1p(-1e-6)));
    nh_ball_set_ratio(ball, x, 9, 4);
    cr_expect_not(has_value(nh_sqrt(dag, y)));
    cr_expect_not(has_value(nh_pow(dag, y, nh_ratio(dag, 1, 3))));
    cr_expect_not(has_value(nh_pow(dag, y, x)));
    cr_expect_not(has_value(nh_powi(dag, nh_add(dag, y, nh_int(dag, 3)), -1)));
    cr_expect_not(has_value(nh_call(dag, NH_LOG, y)));
}

Test(ball, exact_rationals)
{
    double bound;
    nh_ball_set_ratio(ball, x, 1, 3);
    nh_ball_set_ratio(ball, y, 1, 4);
    /* 4 y - 1 is exact, 3 x - 1 is zero to 38 digits */
    nh_ex e = nh_sub(dag, nh_mul(dag, nh_int(dag, 4), y), nh_int(dag, 1));
    cr_expect(nh_ball_log10_bound(ball, e, &bound));
    cr_expect_eq(bound, -INFINITY);
    e = nh_sub(dag, nh_mul(dag, nh_int(dag, 3), x), nh_int(dag, 1));
    cr_expect(nh_ball_log10_bound(ball, e, &bound));
    cr_expect_lt(bound, -37);
}

Test(ball, radius_covers_the_rounding_to_a_double)
{
    double mid, radius;
    nh_ball_set_ratio(ball, x, 1, 3);
    cr_assert(nh_ball_value(ball, x, &mid, &radius));
    cr_expect_eq(mid, 1.0 / 3);
    cr_expect_geq(radius, 1.8e-17); /* 1/3 - (double)1/3 = 1.85e-17 */
    cr_expect_leq(radius, 1.9e-17);
}

Test(ball, forgetting)
{
    nh_ex e = nh_add(dag, nh_mul(dag, x, x), nh_int(dag, 1));
    cr_expect_not(has_value(e), "x has no value");
    nh_ball_set_double(ball, x, 2);
    expect_value(e, 5);
    nh_ball_set_double(ball, x, 3);
    expect_value(e, 10);
    nh_ball_set_expression(ball, y, e);
    nh_ball_set_double(ball, x, 4);
    expect_value(nh_add(dag, x, y), 14);
    cr_expect_not(has_value(nh_symbol(dag, "z")));
    nh_ball_set_expression(ball, x, nh_symbol(dag, "z"));
    cr_expect_not(has_value(e));
}

Test(ball, graph_grows)
{
    nh_ball_set_double(ball, x, 1);
    nh_ex e = x;
    for (int i = 0; i < 1500; i++) {
        e = nh_call(dag, NH_ATAN, nh_add(dag, e, nh_int(dag, i)));
        if (i % 100 == 0) cr_expect(has_value(e));
    }
    cr_expect(has_value(e));
    for (int i = 0; i < 100000; i++) e = nh_call(dag, NH_SIN, e);
    cr_expect_not(has_value(e), "too deep for the stack, and told so");
}

Test(ball, sizes_beyond_doubles)
{
    double bound;
    nh_ball_set_double(ball, x, -2000);
    cr_expect(nh_ball_log10_bound(ball, nh_call(dag, NH_EXP, x), &bound));
    cr_expect_float_eq(bound, -2000 / log(10), 1e-9);
    cr_expect(nh_ball_log10_bound(ball, nh_call(dag, NH_EXP, nh_neg(dag, x)), &bound));
    cr_expect_float_eq(bound, 2000 / log(10), 1e-9);
    cr_expect_not(has_value(nh_call(dag, NH_EXP, nh_neg(dag, x))), "no double holds exp(2000)");
}

Test(ball, relative_sum)
{
    double ratio;
    nh_ball_set_ratio(ball, x, 12345, 6789);
    nh_ex s = nh_powi(dag, nh_call(dag, NH_SIN, x), 2), c = nh_powi(dag, nh_call(dag, NH_COS, x), 2);
    nh_ex terms[3] = {s, c, nh_int(dag, -1)};
    cr_expect(nh_ball_relative_sum(ball, 3, terms, &ratio));
    cr_expect_lt(ratio, -36);
    terms[2] = nh_ratio(dag, -999999, 1000000);
    cr_expect(nh_ball_relative_sum(ball, 3, terms, &ratio));
    cr_expect_float_eq(ratio, -6, 1e-5);
    cr_expect_not(nh_ball_relative_sum(ball, 1, (nh_ex[]){nh_int(dag, 0)}, &ratio), "every term is zero");
    cr_expect_not(nh_ball_relative_sum(ball, 1, &y, &ratio), "y has no value");
    nh_ex tiny[2] = {nh_call(dag, NH_EXP, nh_mul(dag, nh_int(dag, -4000), x)), nh_int(dag, 0)};
    cr_expect(nh_ball_relative_sum(ball, 2, tiny, &ratio));
    cr_expect_float_eq(ratio, 0, 1e-9);
}

/* A hundred digits confirm what sixteen cannot refute. */
Test(ball, precision)
{
    nh_ball *fine = nh_ball_create(dag, 400);
    double coarse_bound, fine_bound;
    /* exp(pi sqrt(163)) is within 1e-12 of a whole number, and is none */
    nh_ex e = nh_call(dag, NH_EXP, nh_mul(dag, nh_pi(dag), nh_sqrt(dag, nh_int(dag, 163))));
    e = nh_sub(dag, e, nh_int(dag, 262537412640768744));
    cr_expect(nh_ball_log10_bound(ball, e, &coarse_bound));
    cr_expect(nh_ball_log10_bound(fine, e, &fine_bound));
    cr_expect_float_eq(fine_bound, log10(7.4992740280181431e-13), 1e-12);
    cr_expect_geq(coarse_bound, fine_bound);
    nh_ball_free(fine);
}

/* ---- ball_fit: sin(x + 1/3) = a sin x + b cos x, and the same with a disturbance that no double can see ---- */

static double fitted_digits(nh_ex left, double *a, double *b)
{
    nh_ex term[] = {left, nh_call(dag, NH_SIN, x), nh_call(dag, NH_COS, x)};
    bool leading[] = {true, false, false};
    double ratio = 0;
    nh_ball_fit *fit = nh_ball_fit_create(ball, 3, term, leading);
    for (int p = 1; p <= 5; p++) {
        nh_ball_set_ratio(ball, x, p * p, 7);
        cr_assert(nh_ball_fit_add(fit));
    }
    cr_assert_eq(nh_ball_fit_solve(fit, 25, true), 1);
    nh_ball_set_ratio(ball, x, 22, 13);
    cr_assert(nh_ball_fit_residual(fit, 0, &ratio));
    *a = -nh_ball_fit_coefficient(fit, 0, 1) / nh_ball_fit_coefficient(fit, 0, 0);
    *b = -nh_ball_fit_coefficient(fit, 0, 2) / nh_ball_fit_coefficient(fit, 0, 0);
    nh_ball_fit_free(fit);
    return -ratio;
}

Test(ball, fit_tells_true_from_nearly_true)
{
    double a, b;
    nh_ex shifted = nh_call(dag, NH_SIN, nh_add(dag, x, nh_ratio(dag, 1, 3)));
    cr_expect_gt(fitted_digits(shifted, &a, &b), 30);
    cr_expect_float_eq(a, cos(1. / 3), 1e-15);
    cr_expect_float_eq(b, sin(1. / 3), 1e-15);
    nh_ex disturbed = nh_add(dag, shifted, nh_mul(dag, nh_powi(dag, nh_int(dag, 10), -17), nh_powi(dag, x, 2)));
    double digits = fitted_digits(disturbed, &a, &b);
    cr_expect(digits > 14 && digits < 19, "%g digits", digits);
}

Test(ball, fit_refuses_what_is_not_determined)
{
    nh_ex term[] = {nh_int(dag, 1), x, nh_mul(dag, nh_int(dag, 2), x)};
    bool leading[] = {true, false, false};
    double ratio;
    nh_ball_fit *fit = nh_ball_fit_create(ball, 3, term, leading);
    cr_expect_not(nh_ball_fit_add(fit), "x has no value yet");
    for (int p = 1; p < 5; p++) {
        nh_ball_set_ratio(ball, x, p, 3);
        cr_assert(nh_ball_fit_add(fit));
    }
    if (nh_ball_fit_solve(fit, 25, true)) { /* rounding may hide the singularity, the residual does not */
        nh_ball_set_ratio(ball, x, 9, 2);
        cr_assert(nh_ball_fit_residual(fit, 0, &ratio));
        cr_expect_gt(ratio, -5);
    }
    nh_ball_fit_free(fit);
}

/* Neither sin x - x, nor cos x - 1, nor the shifted sine alone: only one combination of two disturbed relations is true. */
Test(ball, fit_finds_the_true_combination)
{
    nh_ex tiny = nh_mul(dag, nh_powi(dag, nh_int(dag, 10), -15), nh_call(dag, NH_EXP, x)), s = nh_call(dag, NH_SIN, x), c = nh_call(dag, NH_COS, x);
    nh_ex term[] = {nh_add(dag, nh_call(dag, NH_SIN, nh_add(dag, x, nh_int(dag, 1))), tiny), nh_sub(dag, nh_call(dag, NH_SIN, nh_add(dag, x, nh_int(dag, 2))), tiny), s, c};
    bool leading[] = {true, true, false, false};
    nh_ball_free(ball);
    ball = nh_ball_create(dag, 400);
    nh_ball_fit *fit = nh_ball_fit_create(ball, 4, term, leading);
    for (int p = 1; p <= 8; p++) {
        nh_ball_set_ratio(ball, x, p * p - 9, 17);
        cr_assert(nh_ball_fit_add(fit));
    }
    cr_assert_eq(nh_ball_fit_solve(fit, 20, false), 1);
    cr_expect_float_eq(nh_ball_fit_coefficient(fit, 0, 0) / nh_ball_fit_coefficient(fit, 0, 1), 1, 1e-15);
    double ratio;
    nh_ball_set_ratio(ball, x, 3, 5);
    cr_expect(nh_ball_fit_residual(fit, 0, &ratio) && ratio < -25, "%g", ratio);
    nh_ball_fit_free(fit);
}

/* x1'' = -7/10 x1, x2'' = x1 - 7/10 x2, x3'' = x2 - 7/10 x3: +- i sqrt(7/10), three times each, in one block of Jordan's. */
Test(ball, a_multiple_eigenvalue_is_not_split)
{
    enum { n = 6 };
    nh_ex A[n * n];
    double re[n], im[n];
    for (size_t i = 0; i < n * n; i++) A[i] = nh_int(dag, 0);
    for (size_t i = 0; i < 3; i++) {
        A[i * n + i + 3] = nh_int(dag, 1);
        A[(i + 3) * n + i] = nh_ratio(dag, -7, 10);
        if (i) A[(i + 3) * n + i - 1] = nh_int(dag, 1);
    }
    cr_assert(nh_ball_eigenvalues(ball, n, A, re, im));
    size_t above = 0;
    for (size_t i = 0; i < n; i++) {
        above += im[i] > 0;
        cr_expect_leq(fabs(fabs(im[i]) - sqrt(0.7)), 1e-14, "%.17g", im[i]);
        cr_expect_leq(fabs(re[i]), 1e-14, "%.17g", re[i]);
    }
    cr_expect_eq(above, 3);
    A[0] = nh_call(dag, NH_LOG, nh_int(dag, -1));
    re[0] = im[0] = 7; /* as they were where there is nothing to say */
    cr_expect_not(nh_ball_eigenvalues(ball, n, A, re, im));
    cr_expect(re[0] == 7 && im[0] == 7);
}
