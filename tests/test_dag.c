/* The canonical form: what is equal has one index, whatever the order of construction. */
#include <signal.h>
#include <criterion/criterion.h>
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "random_expression.h"
#include "sweep.h"

/* ---- numbers ---- */

Test(dag, numbers_are_exact_rationals)
{
    nh_num sum = nh_num_add(nh_num_ratio(1, 10), nh_num_ratio(2, 10));
    cr_expect(sum.p == 3 && sum.q == 10);
    nh_num a = nh_num_ratio(-6, -4), b = nh_num_ratio(6, -4);
    cr_expect(a.p == 3 && a.q == 2);
    cr_expect(b.p == -3 && b.q == 2);
    cr_expect(nh_num_equal(nh_num_pow(nh_num_ratio(2, 3), -3), nh_num_ratio(27, 8)));
    cr_expect(nh_num_is(nh_num_mul(nh_num_ratio(7, 3), nh_num_inv(nh_num_ratio(7, 3))), 1));
    cr_expect(nh_num_is(nh_num_real(-0.0), 0));
    cr_expect(nh_num_short(nh_num_real(9007199254740991.0)));
    cr_expect_not(nh_num_exact(nh_num_real(9007199254740992.0)));
    cr_expect_not(nh_num_exact(nh_num_real(0.1)));
    for (int p = -40; p <= 40; p++)
        for (int q = 1; q <= 1000; q += 7)
            cr_expect(nh_num_equal(nh_num_decimal((double)p / q), nh_num_ratio(p, q)), "%d/%d", p, q);
    cr_expect(nh_num_equal(nh_num_decimal(0.333333333333333), nh_num_mul(nh_num_int(333333333333333), nh_num_pow(nh_num_int(10), -15))));
    cr_expect(nh_num_equal(nh_num_decimal(0.1), nh_num_ratio(1, 10)) && nh_num_equal(nh_num_decimal(-1250), nh_num_int(-1250)));
}

/* Rationals too long for 64 bits go on exactly: sums, products, inverses and powers lead back to short ones. */
/* exp(u) is positive: its roots are exponentials. */
Test(dag, roots_of_exponentials_are_exponentials)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), e = nh_call(d, NH_EXP, nh_mul(d, nh_int(d, -2), x));
    cr_expect_eq(nh_sqrt(d, e), nh_call(d, NH_EXP, nh_neg(d, x)));
    cr_expect_eq(nh_pow(d, nh_call(d, NH_EXP, x), nh_ratio(d, 3, 2)), nh_call(d, NH_EXP, nh_mul(d, nh_ratio(d, 3, 2), x)));
    nh_dag_free(d);
}

Test(dag, long_rationals)
{
    nh_num a = nh_num_ratio(INT64_MAX, 3), b = nh_num_ratio(INT64_MAX - 1, 7), product = nh_num_mul(a, b), tiny = nh_num_pow(nh_num_int(10), -25);
    cr_expect(nh_num_exact(product) && !nh_num_short(product));
    cr_expect(nh_num_equal(nh_num_mul(product, nh_num_inv(b)), a));
    cr_expect(nh_num_is(nh_num_add(nh_num_add(product, a), nh_num_mul(nh_num_int(-1), nh_num_add(a, product))), 0));
    cr_expect(nh_num_equal(nh_num_mul(b, a), product), "equal numbers are the same number");
    cr_expect(nh_num_is(nh_num_mul(tiny, nh_num_pow(nh_num_int(10), 25)), 1));
    cr_expect_eq(nh_num_value(tiny), 1e-25);
    cr_expect(nh_num_equal(nh_num_decimal(1e-25), tiny));
    cr_expect_eq(nh_num_value(nh_num_mul(nh_num_int(-1), product)), -nh_num_value(product));
    nh_num near = nh_num_add(nh_num_int(1), tiny); /* not 1, although its double is */
    cr_expect(nh_num_exact(near) && !nh_num_is(near, 1) && nh_num_value(near) == 1);
    cr_expect_not(nh_num_exact(nh_num_pow(nh_num_int(3), 100000)), "there is a limit");
    cr_expect_not(nh_num_is(nh_num_pow(nh_num_int(10), -400), 0), "its double is 0, it is not");
}

/* What is printed is read again as the same number: short decimals, fractions of long numbers. */
Test(dag, long_rationals_are_printed_exactly)
{
    nh_dag *d = nh_dag_create();
    nh_num third = nh_num_mul(nh_num_ratio(INT64_MAX, 3), nh_num_int(1000)), tiny = nh_num_pow(nh_num_int(10), -25), huge = nh_num_pow(nh_num_int(7), 40);
    nh_num each[] = {third, tiny, huge, nh_num_mul(tiny, nh_num_int(-125)), nh_num_mul(huge, nh_num_ratio(1, 11)), nh_num_add(huge, nh_num_ratio(1, 3))};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) {
        nh_ex x = nh_symbol(d, "x"), e[3] = {nh_number(d, each[i]), nh_mul(d, nh_number(d, each[i]), x), nh_powi(d, nh_add(d, nh_number(d, each[i]), x), 2)};
        for (size_t k = 0; k < 3; k++) {
            char *text = nh_print_string(d, e[k]);
            cr_expect_eq(parsed(d, text), e[k], "%s", text);
            nh_free(text);
        }
    }
    nh_dag_free(d);
}

/* -1 times a sum whose numbers are too long to be multiplied into it; it was printed as parentheses without end. */
Test(dag, minus_a_sum_of_long_numbers_is_printed)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y"),
          sum = nh_sub(d, nh_mul(d, nh_ratio(d, 4611686018427387847, 3), x), nh_mul(d, nh_int(d, 2), y)), e = nh_mul(d, y, nh_neg(d, sum));
    char *text = nh_print_string(d, nh_neg(d, sum)), *product = nh_print_string(d, e);
    cr_expect_str_eq(text, "(6*y - 4611686018427387847*x)/3");
    cr_expect_eq(parsed(d, text), nh_neg(d, sum), "%s", text);
    cr_expect_eq(parsed(d, product), e, "%s", product);
    nh_free(text);
    nh_free(product);
    nh_dag_free(d);
}

/* Beyond the range of doubles a number is neither 0 nor infinite, and leads back. */
Test(dag, numbers_beyond_doubles_are_kept_and_printed)
{
    nh_dag *d = nh_dag_create();
    const struct {
        nh_num number;
        const char *text;
    } each[] = {{nh_num_pow(nh_num_int(10), -400), "1e-400"},
                {nh_num_mul(nh_num_ratio(-5, 4), nh_num_pow(nh_num_int(10), 400)), "-1.25e400"},
                {nh_num_mul(nh_num_ratio(1, 3), nh_num_pow(nh_num_int(10), -320)), "3.3333333333333333e-321"}};
    for (size_t i = 0; i < sizeof each / sizeof *each; i++) {
        char *text = nh_print_string(d, nh_number(d, each[i].number));
        cr_expect_str_eq(text, each[i].text);
        cr_expect(nh_num_exact(each[i].number));
        cr_expect(nh_num_is(nh_num_mul(each[i].number, nh_num_inv(each[i].number)), 1), "%s", each[i].text);
        nh_free(text);
    }
    nh_dag_free(d);
}

Test(dag, numbers_past_the_limits_become_doubles)
{
    nh_num big = nh_num_int(INT64_MAX), sum = nh_num_add(big, big);
    cr_expect(nh_num_exact(sum));
    cr_expect_eq(nh_num_value(sum), 18446744073709551616.0);
    cr_expect_eq(nh_num_value(nh_num_int(INT64_MIN)), -9223372036854775808.0);
    cr_expect_eq(nh_num_value(nh_num_mul(big, big)), 0x1p126);
    nh_num two = nh_num_add(nh_num_ratio(INT64_MAX, INT64_MAX - 1), nh_num_ratio(INT64_MAX, INT64_MAX - 2));
    cr_expect_eq(nh_num_value(two), 2);
    cr_expect(nh_num_is(nh_num_real(2), 2), "a whole double is the whole number, so that it has one node");
    cr_expect_eq(nh_num_value(nh_num_pow(nh_num_int(3), 100)), pow(3, 100));
    cr_expect_eq(nh_num_value(nh_num_pow(nh_num_int(2), INT64_MIN)), 0);
    cr_expect(isinf(nh_num_value(nh_num_pow(nh_num_int(-2), INT64_MAX))));
    cr_expect(nh_num_is(nh_num_pow(nh_num_int(-1), INT64_MAX), -1));
    cr_expect_eq(nh_num_value(nh_num_ratio(INT64_MIN, -1)), 9223372036854775808.0);
    cr_expect(isnan(nh_num_value(nh_num_inv(nh_num_int(0)))));
}

Test(dag, a_decimal_of_seventeen_digits_has_the_value_of_its_double)
{
    source s = source_create(1);
    for (int i = 0; i < 20000; i++) {
        double value = random_real(&s, 0.1, 1) + 1e-9 * random_real(&s, 0, 1);
        char text[40];
        snprintf(text, sizeof text, "%.17f", value);
        int64_t digits = strtoll(text + 2, NULL, 10);
        cr_assert_eq(nh_num_value(nh_num_ratio(digits, 100000000000000000)), value, "%s", text);
    }
    nh_dag_free(s.dag);
}

/* ---- identities ---- */

static const char *const EQUAL[][2] = {
    /* sums */
    {"x + y", "y + x"}, {"(x + y) + z", "x + (z + y)"}, {"x - x", "0"}, {"(a - b) - (a - b)", "0"}, {"x + x", "2*x"},
    {"x + y - y", "x"}, {"-(x - y)", "y - x"}, {"x/2 + y/3", "(3*x + 2*y)/6"}, {"2*(x + y) - 2*x", "2*y"},
    {"x*y + y*x", "2*x*y"}, {"0.1 + 0.2", "3/10"}, {"x*0", "0"}, {"0.25*x + 0.75*x", "x"}, {"-(-x)", "x"},
    {"3*(x + 1)/3 - 1", "x"}, {"x + 2*(y - x/2)", "2*y"},
    /* products */
    {"x*y", "y*x"}, {"(x*y)*z", "x*(z*y)"}, {"x/x", "1"}, {"x*x", "x^2"}, {"x^2/x^3", "1/x"}, {"x^a*x^b", "x^(a + b)"},
    {"x^a/x^a", "1"}, {"(x*y)^2", "x^2*y^2"}, {"(x/y)^-1", "y/x"}, {"(2*x)^3", "8*x^3"}, {"(x^a)^2", "x^(2*a)"},
    {"(y - x)^2", "(x - y)^2"}, {"(y - x)^3", "-(x - y)^3"}, {"(2*x + 2*y)^2", "4*(x + y)^2"}, {"1/(1/x)", "x"},
    {"(x + y)/(x + y)", "1"}, {"x/(y/z)", "x*z/y"}, {"(-x)*(-y)", "x*y"}, {"(y - x)/(x - y)", "-1"},
    /* roots */
    {"sqrt(x)*sqrt(x)", "x"}, {"sqrt(x)^4", "x^2"}, {"sqrt(4*x)", "2*sqrt(x)"}, {"sqrt(x/4)", "sqrt(x)/2"},
    {"sqrt(2)*sqrt(2)", "2"}, {"sqrt(8)", "2*sqrt(2)"}, {"sqrt(2)*sqrt(3)", "sqrt(6)"}, {"sqrt(2/3)", "sqrt(6)/3"},
    {"1/sqrt(2)", "sqrt(2)/2"}, {"12^(3/4)", "12^(1/4)*12^(1/4)*12^(1/4)"}, {"4^(1/3)", "2^(2/3)"}, {"27^(2/3)", "9"},
    {"(9/4)^(3/2)", "27/8"}, {"8^(1/6)", "sqrt(2)"}, {"sqrt(x*y)*sqrt(x*y)", "x*y"}, {"(x*y)^(3/2)", "x*y*sqrt(x*y)"},
    {"(x*y)^(-1/2)*x*y", "sqrt(x*y)"}, {"sqrt(2*x + 2*y)", "sqrt(2)*sqrt(x + y)"}, {"2*2^n", "2^(n + 1)"},
    {"sqrt(1000003)*sqrt(1000003)", "1000003"}, {"(-x)^(1/2)*(-x)^(1/2)", "-x"}, {"(-x)^(3/2)", "-x*(-x)^(1/2)"},
    {"(x*y)^n*x*y", "(x*y)^(n + 1)"}, {"sqrt(1000003^2*x)", "1000003*sqrt(x)"},
    /* functions */
    {"sin(-x)", "-sin(x)"}, {"sin(y - x)", "-sin(x - y)"}, {"cos(y - x)", "cos(x - y)"}, {"tan(-2*x)", "-tan(2*x)"},
    {"abs(-x)", "abs(x)"}, {"abs(x)^2", "x^2"}, {"abs(x)^3", "x^2*abs(x)"}, {"abs(x)*abs(x)*abs(x)", "abs(x)^3"},
    {"x^2/abs(x)^2", "1"}, {"exp(log(x))", "x"}, {"log(exp(x))", "x"}, {"sin(0)", "0"}, {"cos(0)", "1"}, {"exp(0)", "1"},
    {"log(1)", "0"}, {"sin(pi)", "0"}, {"cos(pi)", "-1"}, {"sin(pi/2)", "1"}, {"cos(-3*pi/2)", "0"}, {"sin(7*pi/2)", "-1"},
    {"1/tan(pi/2)", "0"}, {"x/tan(-3*pi/2)^2", "0"}, {"tan(pi/4)", "1"}, {"tan(3*pi/4)", "-1"}, {"abs(-3/2)", "3/2"}, {"sign(-sqrt(2)*x/3)", "-sign(x)"}, {"sign(2*a*x)", "sign(a*x)"}, {"sign(2*sqrt(3))", "1"}, {"sin(2*atan(x))", "2*x/(1 + x^2)"}, {"cos(-2*atan(x))", "(1 - x^2)/(1 + x^2)"},
    {"elliptic_f(-x, y)", "-elliptic_f(x, y)"}, {"elliptic_pi(n, -2*x, y)", "-elliptic_pi(n, 2*x, y)"}, {"sign(-3/2)", "-1"}, {"cos(9223372036854775807*pi/2)", "0"}, {"sin(-3*pi/2)", "1"},
    {"abs(2*x)^2", "4*x^2"}, {"sinh(-x)", "-sinh(x)"}, {"cosh(-x)", "cosh(x)"}, {"atan(-x)", "-atan(x)"},
};

static const char *const DIFFERENT[][2] = {
    {"(x^2)^(1/2)", "x"}, {"(x^2)^(1/2)", "abs(x)"}, {"sqrt(x*y)", "sqrt(x)*sqrt(y)"}, {"(x^a)^(1/a)", "x"}, {"abs(x)", "x"},
    {"cos(-x)", "-cos(x)"}, {"acos(-x)", "-acos(x)"}, {"log(x*y)", "log(x) + log(y)"}, {"sin(pi/3)", "0"}, {"x^(1/3)", "x"},
    {"sqrt(-x)", "-sqrt(x)"}, {"sqrt(-x)*sqrt(-x)", "x"}, {"(-8)^n", "-8^n"}, {"sign(x)^2", "1"}, {"exp(-x)", "-exp(x)"},
    {"sqrt((x - y)^2)", "x - y"}, {"sin(2)", "2"}, {"9007199254740993*x", "9007199254740992*x"},
};

Test(dag, equal_expressions_have_one_index)
{
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof EQUAL / sizeof *EQUAL; i++) {
        nh_ex a = parsed(d, EQUAL[i][0]), b = parsed(d, EQUAL[i][1]);
        char *left = nh_print_string(d, a), *right = nh_print_string(d, b);
        cr_expect_eq(a, b, "%s gives %s, but %s gives %s", EQUAL[i][0], left, EQUAL[i][1], right);
        nh_free(left);
        nh_free(right);
    }
    nh_dag_free(d);
}

Test(dag, different_expressions_stay_different)
{
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof DIFFERENT / sizeof *DIFFERENT; i++)
        cr_expect_neq(parsed(d, DIFFERENT[i][0]), parsed(d, DIFFERENT[i][1]), "%s and %s", DIFFERENT[i][0], DIFFERENT[i][1]);
    nh_dag_free(d);
}

Test(dag, functions_of_numbers)
{
    nh_dag *d = nh_dag_create();
    cr_expect_eq(nh_kind_of(d, parsed(d, "sin(2)")), NH_FUNCTION, "exact arguments stay exact");
    nh_ex s = nh_call(d, NH_SIN, nh_real(d, 2.385));
    cr_expect_eq(nh_num_value(nh_number_of(d, s)), sin(2.385));
    cr_expect(isnan(nh_num_value(nh_number_of(d, nh_pow(d, nh_int(d, 0), nh_int(d, -1))))));
    cr_expect(isinf(nh_num_value(nh_number_of(d, nh_call(d, NH_LOG, nh_int(d, 0))))));
    cr_expect_eq(nh_real(d, NAN), nh_real(d, -NAN));
    cr_expect_eq(nh_pi(d), nh_pi(d));
    nh_dag_free(d);
}

/* Products with coefficients that are no numbers must not make the constructors go round for ever. */
Test(dag, powers_of_products_with_odd_coefficients)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x");
    const double odd[] = {NAN, INFINITY, -INFINITY, 0.1, -1e-300, 49.1};
    for (size_t i = 0; i < sizeof odd / sizeof *odd; i++) {
        nh_ex e = nh_mul(d, nh_real(d, odd[i]), x);
        cr_expect(nh_depends(d, nh_sqrt(d, e), x));
        cr_expect(nh_depends(d, nh_pow(d, e, nh_symbol(d, "n")), x));
        nh_powi(d, e, INT64_MIN); /* 0 or infinite: that it ends is enough */
        nh_powi(d, e, INT64_MAX);
    }
    nh_ex p = nh_call(d, NH_ABS, x);
    cr_expect(nh_depends(d, nh_powi(d, p, -INT64_MAX), x));
    cr_expect(nh_depends(d, nh_pow(d, nh_mul(d, x, nh_symbol(d, "y")), nh_ratio(d, -INT64_MAX, 2)), x));
    nh_dag_free(d);
}

/* Coefficients that the content would push out of 64 bits stay exact. */
Test(dag, large_coefficients_stay_exact)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y");
    nh_ex term[] = {x, y};
    nh_ex e = nh_linear(d, 2, (nh_num[]){nh_num_int(INT64_MAX - 1), nh_num_ratio(1, 7)}, term);
    cr_assert_eq(nh_kind_of(d, e), NH_SUM, "not 1/7 of a sum with 7 times the coefficients");
    cr_expect(nh_num_short(nh_coefficient_of(d, e, 0)) && nh_num_short(nh_coefficient_of(d, e, 1)));
    nh_ex rest = nh_sub(d, e, nh_mul(d, nh_int(d, INT64_MAX - 1), x));
    cr_expect_eq(rest, nh_div(d, y, nh_int(d, 7)));
    nh_dag_free(d);
}

/* ---- random expressions ---- */

/* A few expressions combined in two random orders. */
static nh_ex combine(source *s, size_t n, const nh_ex *part, nh_ex (*join)(nh_dag *, nh_ex, nh_ex))
{
    nh_ex heap[8];
    for (size_t i = 0; i < n; i++) heap[i] = part[i];
    while (n > 1) {
        size_t i = (size_t)random_below(s, (int)n), j = (size_t)random_below(s, (int)n - 1);
        j += j >= i;
        heap[i] = join(s->dag, heap[i], heap[j]);
        heap[j] = heap[--n];
    }
    return heap[0];
}

static void compare(nh_dag *d, nh_ex a, nh_ex b, const char *what)
{
    char *left = nh_print_string(d, a), *right = nh_print_string(d, b);
    cr_assert_eq(a, b, "%s: %s\n    and %s", what, left, right);
    nh_free(left);
    nh_free(right);
}

Test(dag, order_does_not_matter, PLAIN_ONLY)
{
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        source s = source_create(seed);
        nh_ex part[5];
        for (int i = 0; i < 5; i++) part[i] = random_expression(&s, 3);
        nh_ex sum = combine(&s, 5, part, nh_add), product = combine(&s, 5, part, nh_mul);
        compare(s.dag, sum, combine(&s, 5, part, nh_add), "sum");
        nh_num one[5] = {{1, 1, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 0}, {1, 1, 0}};
        compare(s.dag, sum, nh_linear(s.dag, 5, one, part), "sum at once");
        compare(s.dag, product, combine(&s, 5, part, nh_mul), "product");
        compare(s.dag, product, nh_product(s.dag, 5, part), "product at once");
        nh_dag_free(s.dag);
    }
}

Test(dag, what_is_added_can_be_taken_away, PLAIN_ONLY)
{
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        source s = source_create(seed);
        nh_dag *d = s.dag;
        nh_ex a = random_expression(&s, 4), b = random_expression(&s, 4), x = s.symbol[0];
        compare(d, nh_sub(d, nh_add(d, a, b), b), a, "a + b - b");
        compare(d, nh_neg(d, nh_neg(d, a)), a, "-(-a)");
        if (!nh_is_zero(d, b)) compare(d, nh_div(d, nh_mul(d, a, b), b), a, "a*b/b");
        compare(d, nh_powi(d, a, 3), nh_mul(d, a, nh_mul(d, a, a)), "a^3");
        compare(d, nh_call(d, NH_SINH, nh_neg(d, a)), nh_neg(d, nh_call(d, NH_SINH, a)), "sinh");
        nh_ex to = nh_symbol(d, "other");
        compare(d, nh_substitute(d, nh_substitute(d, a, 1, &x, &to), 1, &to, &x), a, "there and back");
        nh_dag_free(d);
    }
}

/* The constructors change no value. */
Test(dag, values_are_kept)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 3000; seed++) {
        source s = source_create(seed);
        nh_ex a = random_expression(&s, 3), b = random_expression(&s, 3);
        double at[SYMBOLS], size = 1;
        for (int i = 0; i < SYMBOLS; i++) at[i] = random_real(&s, 0.2, 1.7);
        double u = naive_value(s.dag, a, s.symbol, at, &size), v = naive_value(s.dag, b, s.symbol, at, &size);
        double sum = naive_value(s.dag, nh_add(s.dag, a, b), s.symbol, at, &size);
        double product = naive_value(s.dag, nh_mul(s.dag, a, b), s.symbol, at, &size);
        double power = naive_value(s.dag, nh_pow(s.dag, a, nh_ratio(s.dag, 3, 2)), s.symbol, at, &size);
        if (isfinite(u + v + u * v) && size < 1e6) {
            cr_assert_float_eq(sum, u + v, 1e-8 * size);
            if (isfinite(product)) cr_assert_float_eq(product, u * v, 1e-8 * size * size);
            if (u > 0 && isfinite(power)) cr_assert_float_eq(power, pow(u, 1.5), 1e-8 * size * size);
            compared++;
        }
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, 1000);
}

/* ---- looking, substituting ---- */

Test(dag, occurrence)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y");
    NH_LIST(found);
    for (int i = 0; i < 200; i++) { /* enough symbols that the 64-bit masks collide */
        char text[16];
        snprintf(text, sizeof text, "s%d", i);
        nh_symbol(d, text);
    }
    nh_ex e = parsed(d, "x*sin(y) + s3^2 - s100");
    cr_expect(nh_depends(d, e, x));
    cr_expect(nh_depends(d, e, nh_symbol(d, "s100")));
    for (int i = 0; i < 200; i++) {
        char text[16];
        snprintf(text, sizeof text, "s%d", i);
        cr_expect_eq(nh_depends(d, e, nh_symbol(d, text)), i == 3 || i == 100);
    }
    cr_expect_eq(nh_symbols_in(d, e, &found), 4);
    cr_expect(found[0] == x && found[1] == y);
    cr_expect_eq(nh_symbols_in(d, parsed(d, "cos(1)"), &found), 0);
    nh_ex fresh = nh_symbol_fresh(d, "x");
    cr_expect_neq(fresh, x);
    cr_expect_eq(nh_symbol(d, "x"), x);
    nh_dag_free(d);
}

Test(dag, substitution_is_simultaneous)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y");
    nh_ex e = parsed(d, "x - 2*y + x^y + atan2(x, y) + 3");
    cr_expect_eq(nh_substitute(d, e, 2, (nh_ex[]){x, y}, (nh_ex[]){y, x}), parsed(d, "y - 2*x + y^x + atan2(y, x) + 3"));
    cr_expect_eq(nh_substitute(d, parsed(d, "sqrt(x^2 + 9)"), 1, &x, (nh_ex[]){nh_int(d, 4)}), nh_int(d, 5));
    cr_expect_eq(nh_substitute(d, e, 1, (nh_ex[]){nh_symbol(d, "absent")}, &x), e);
    nh_dag_free(d);
}

/* 1e5 terms: a second, where term by term would take hours. */
Test(dag, long_sums_take_linear_time, PLAIN_ONLY)
{
    enum { n = 100000 };
    nh_dag *d = nh_dag_create();
    nh_ex *term = nh_alloc_array(n, sizeof *term), x = nh_symbol(d, "x"), y = nh_symbol(d, "y");
    nh_num *c = nh_alloc_array(n, sizeof *c);
    for (int i = 0; i < n; i++) {
        term[i] = nh_call(d, NH_SIN, nh_mul(d, nh_int(d, i + 1), x));
        c[i] = nh_num_ratio(2 * (i % 7) - 7, 1 + i % 5);
    }
    nh_ex sum = nh_linear(d, n, c, term);
    cr_expect_eq(nh_arity(d, nh_child(d, sum, 0)), n, "30 is the denominator");
    nh_ex there = nh_substitute(d, sum, 1, &x, &y);
    cr_expect_eq(nh_substitute(d, there, 1, &y, &x), sum);
    char *text = nh_print_string(d, sum);
    cr_expect_eq(parsed(d, text), sum);
    nh_free(text);
    nh_ex product = nh_product(d, n, term);
    cr_expect_eq(nh_arity(d, product), n);
    cr_expect_neq(nh_substitute(d, product, 1, &x, &y), product);
    nh_free(term);
    nh_free(c);
    nh_dag_free(d);
}

Test(dag, radicands_are_bases_of_half_powers)
{
    nh_dag *d = nh_dag_create();
    NH_LIST(base);
    nh_ex x = nh_symbol(d, "x"), y = nh_symbol(d, "y"), u = parsed(d, "1 + x^2");
    cr_expect_eq(nh_radicands_in(d, parsed(d, "y*sqrt(1 + x^2) + cos(x)/sqrt(1 + x^2) + (1 + x^2)^(3/2) + x^(1/3)*y^2"), &base), 1);
    cr_expect_eq(base[0], u);
    nh_ex below = nh_sqrt(d, nh_add(d, y, nh_sqrt(d, x)));
    cr_expect_eq(nh_radicands_in(d, below, &base), 2, "also below another root");
    nh_dag_free(d);
}

static void make_one(size_t index, void *dag) { nh_int(dag, 1000 + (int)index); }

/* Threads make expressions in copies of a graph: the numbers of the old ones stay, the graph does not change. */
static void make_in_copy(size_t index, void *original)
{
    nh_dag *d = nh_dag_copy(original);
    size_t before = nh_dag_size(original);
    nh_ex x = nh_symbol(d, "x"), e = parsed(d, "sin(x)^2/(1 + x)");
    cr_expect_eq(nh_dag_size(d), before, "what the graph has is found again");
    nh_ex y = nh_symbol(d, "y"), product = nh_mul(d, nh_int(d, 1000 + (int)index), nh_mul(d, e, y));
    cr_expect_gt(nh_dag_size(d), before);
    cr_expect_eq(nh_diff(d, nh_diff(d, product, y), x), nh_diff(d, nh_mul(d, nh_int(d, 1000 + (int)index), e), x));
    cr_expect_str_eq(nh_name_of(d, x), "x");
    cr_expect_eq(nh_dag_size(original), before);
    nh_dag_free(d);
}

Test(dag, is_copied_for_each_thread)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), e = parsed(d, "sin(x)^2/(1 + x)"), slope = nh_simplify(d, nh_diff(d, e, x));
    size_t size = nh_dag_size(d);
    nh_parallel(8, 4, make_in_copy, d);
    nh_parallel(2, 1, make_in_copy, d);
    cr_expect_eq(nh_dag_size(d), size);
    cr_expect_eq(nh_simplify(d, nh_diff(d, e, x)), slope);
    nh_dag_free(d);
}

typedef struct {
    nh_dag *original, *copy[4];
    nh_ex e[4][3];
    char *text[4];
} brought;

static void make_and_keep(size_t index, void *context)
{
    brought *b = context;
    nh_dag *d = b->copy[index] = nh_dag_copy(b->original);
    char text[80];
    snprintf(text, sizeof text, "%zu*z%zu*exp(x)/(3 + x^2)^(1/3) - 1/7*atan2(x, w)", index + 2, index);
    b->e[index][0] = parsed(d, text);
    b->e[index][1] = parsed(d, "sin(x)^2/(1 + x)");
    b->e[index][2] = nh_mul(d, nh_pow(d, nh_number(d, nh_num_decimal(0.1)), nh_symbol(d, "x")), b->e[index][0]);
    b->text[index] = nh_print_string(d, b->e[index][0]);
}

/* Expressions of copies in the graph that these were made from: as if they had been made there; what it had is the
 * same, whatever it has made since. */
Test(dag, expressions_of_copies_are_brought_back)
{
    brought b = {.original = nh_dag_create()};
    nh_dag *d = b.original;
    nh_ex x = nh_symbol(d, "x"), e = parsed(d, "sin(x)^2/(1 + x)");
    nh_symbol(d, "w");
    for (size_t i = 0; i < 4; i++) {
        char name[8];
        snprintf(name, sizeof name, "z%zu", i);
        nh_symbol(d, name);
    }
    nh_parallel(4, 2, make_and_keep, &b);
    parsed(d, "w^5 - tan(x)");
    for (size_t i = 0; i < 4; i++) {
        char text[80], *here;
        nh_dag_bring(d, b.copy[i], 3, b.e[i]);
        nh_dag_free(b.copy[i]);
        snprintf(text, sizeof text, "%zu*z%zu*exp(x)/(3 + x^2)^(1/3) - 1/7*atan2(x, w)", i + 2, i);
        here = nh_print_string(d, b.e[i][0]);
        cr_expect_eq(b.e[i][0], parsed(d, text), "%s", text);
        cr_expect_eq(b.e[i][1], e);
        cr_expect_eq(b.e[i][2], nh_mul(d, nh_pow(d, nh_ratio(d, 1, 10), x), b.e[i][0]));
        cr_expect_str_eq(here, b.text[i]);
        nh_free(here);
        nh_free(b.text[i]);
    }
    nh_dag_free(d);
}

/* A symbol that was made in a copy is a new one, the same in all expressions that are brought together. */
Test(dag, new_symbols_of_copies_stay_apart)
{
    nh_dag *d = nh_dag_create(), *copy = nh_dag_copy(d);
    nh_ex own = nh_symbol_fresh(copy, "C"), e[2] = {nh_mul(copy, own, nh_int(copy, 5)), nh_call(copy, NH_SIN, own)},
          other = nh_symbol_fresh(d, "C");
    nh_dag_bring(d, copy, 2, e);
    nh_dag_free(copy);
    nh_ex C = nh_child(d, e[1], 0);
    cr_expect_eq(e[0], nh_mul(d, nh_int(d, 5), C));
    cr_expect_neq(C, other);
    cr_expect_str_eq(nh_name_of(d, C), "C");
    nh_dag_free(d);
}

static void look(size_t index, void *worker) { ((unsigned long *)worker)[index] = nh_parallel_worker(); }

/* A sanitized build ends where an expression is made there. */
Test(dag, is_frozen_while_others_may_read, .signal = NH_CHECKED ? SIGABRT : 0)
{
    unsigned long worker[2] = {0};
    nh_parallel(2, 2, look, worker);
    cr_assert(worker[0] && worker[1] && !nh_parallel_worker());
    if (NH_CHECKED) nh_parallel(1, 1, make_one, nh_dag_create());
}
