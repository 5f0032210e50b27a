/* ball_series: Taylor series whose error bounds hold, and are no larger than they need be. */
#include <criterion/criterion.h>
#include <math.h>

#include "exact/ball_series.h"
#include "graph/dag.h"
#include "graph/parse.h"

enum { degree = 12, points = 41 };

static nh_dag *dag;
static nh_ball *ball;
static nh_ex x, a, R, J, L;

static void start(void)
{
    dag = nh_dag_create();
    ball = nh_ball_create(dag, 256);
    x = nh_symbol(dag, "x"), a = nh_symbol(dag, "a"), R = nh_symbol(dag, "R"), J = nh_symbol(dag, "J"),
    L = nh_symbol(dag, "L");
}

static void stop(void)
{
    nh_ball_free(ball);
    nh_dag_free(dag);
}

TestSuite(ball_series, .init = start, .fini = stop);

static bool resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    (void)context, (void)fault;
    *out = nh_symbol(dag, name);
    return true;
}

static nh_ex read(const char *text)
{
    nh_parse_fault fault;
    nh_ex e;
    cr_assert(nh_parse(dag, text, resolve, NULL, &e, &fault), "%s: %s", text, fault.what);
    return e;
}

static double at(nh_ex e, double value)
{
    double mid, radius;
    nh_ball_set_double(ball, x, value);
    cr_assert(nh_ball_value(ball, e, &mid, &radius) && radius < 1e-14);
    return mid;
}

/* e, of the series, is `same` as a formula. */
static void expect_series(nh_ex e, nh_ex same, double centre, double half, size_t defined,
                          const nh_ball_defined *define, const char *name)
{
    double c[degree], bound, worst = 0;
    nh_ball_set_double(ball, x, centre);
    nh_ball_series *s = nh_ball_series_create(dag, ball, x, defined, define);
    cr_assert(nh_ball_series_take(s, 1, &e, degree, half, c, &bound), "%s", name);
    nh_ball_series_free(s);
    for (int i = 0; i < points; i++) {
        double d = half * (2.0 * i / (points - 1) - 1), sum = 0;
        for (size_t k = degree; k-- > 0;) sum = sum * d + c[k];
        worst = fmax(worst, fabs(at(same, centre + d) - sum));
    }
    cr_expect_leq(worst, bound + 1e-15, "%s: off by %g, bound %g", name, worst, bound);
    cr_expect_leq(bound, 1e4 * worst + 1e-14, "%s: off by %g, bound %g", name, worst, bound);
}

Test(ball_series, bounds_hold)
{
    static const char *const texts[] = {"exp(a*x)*sin(3*x)",
                                        "1/(1 + x^2)",
                                        "sqrt(2 + cos(x))",
                                        "(1 + x)^a",
                                        "log(2 + x)*atan(x)",
                                        "tan(x) + asin(x/2) - acos(x/3)",
                                        "cosh(x)/(2 + sinh(x))^3",
                                        "a^2 - 3/7",
                                        "x",
                                        "(2 + x)^(-1/2) + x^5",
                                        "tanh(a*x) + asinh(x)/3",
                                        "acosh(2 + x)*atanh(x)",
                                        "atan2(x - 2, x - 1) + atan2(1 + x, a)",
                                        "abs(x - 2)*sign(x - 1)",
                                        "2^x + (1 + x)^(a*x)"};
    nh_ball_set_ratio(ball, a, 7, 3);
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        nh_ex e = read(texts[i]);
        expect_series(e, e, 0.3, 0.125, 0, NULL, texts[i]);
        expect_series(e, e, -0.2, 0.01, 0, NULL, texts[i]);
    }
}

/* R = -sqrt(1 + x^2); J' = x/R, so J = R - R(c) = .. ; L' = J R + x J x/R and so on: integrals of integrals. */
Test(ball_series, roots_and_integrals)
{
    const nh_ball_defined define[] = {{R, read("1 + x^2"), false},
                                      {J, nh_div(dag, x, nh_neg(dag, R)), true},
                                      {L, nh_mul(dag, J, read("cos(x)")), true}};
    const double centre = 0.4;
    double root = sqrt(1 + centre * centre);
    nh_ball_set_double(ball, R, -root);
    nh_ball_set_ratio(ball, J, 0, 1);
    nh_ball_set_ratio(ball, L, 0, 1);
    expect_series(R, read("-sqrt(1 + x^2)"), centre, 0.1, 3, define, "R");
    expect_series(J, read("sqrt(1 + x^2) - sqrt(29/25)"), centre, 0.1, 3, define, "J");
    /* J' = sin 3 x, L' = J cos x: J = (cos 6/5 - cos 3 x)/3, L by the products' sums */
    const nh_ball_defined other[] = {{J, read("sin(3*x)"), true}, {L, nh_mul(dag, J, read("cos(x)")), true}};
    expect_series(L, read("cos(6/5)*(sin(x) - sin(2/5))/3 - (sin(4*x)/8 + sin(2*x)/4 - sin(8/5)/8 - sin(4/5)/4)/3"),
                  centre, 0.1, 2, other, "L");
}

/* From centre to centre: the integral keeps its value, the root its sign; there is no way across a zero of the root. */
Test(ball_series, the_centre_moves)
{
    const nh_ball_defined define[] = {{R, read("3 - x^2"), false}, {J, nh_div(dag, x, R), true}, {L, nh_mul(dag, J, x), true}};
    static const double centre[] = {1, 1.2, 1.4, 1.2, 0.7, 0.1, -0.5};
    nh_ball_set_double(ball, x, 1);
    nh_ball_set_expression(ball, R, read("-sqrt(2)"));
    nh_ball_set_ratio(ball, J, 0, 1);
    nh_ball_set_ratio(ball, L, 0, 1);
    nh_ball_series *s = nh_ball_series_create(dag, ball, x, 3, define);
    nh_ball *other = nh_ball_create(dag, 256);
    nh_ex is_R = read("-sqrt(3 - x^2)"), is_J = read("sqrt(3 - x^2) - sqrt(2)");
    /* J x = x sqrt(3 - x^2) - sqrt(2) x, whose integral from 1 follows */
    nh_ex is_L = read("2*sqrt(2)/3 - (3 - x^2)^(3/2)/3 - sqrt(2)*(x^2 - 1)/2");
    for (size_t i = 1; i < sizeof centre / sizeof *centre; i++) {
        cr_assert(nh_ball_series_move(s, centre[i], 0.03), "to %g", centre[i]);
        nh_ball_set_double(other, x, centre[i]);
        for (int j = 0; j < 3; j++) {
            double mid, radius, is, digits;
            cr_assert(nh_ball_value(ball, (nh_ex[]){R, J, L}[j], &mid, &radius));
            cr_assert(nh_ball_value(other, (nh_ex[]){is_R, is_J, is_L}[j], &is, &digits));
            cr_expect_float_eq(mid, is, radius + 4e-16, "%d at %g: %.17g, %.17g", j, centre[i], mid, is);
            cr_expect_lt(radius, 1e-13, "%d at %g: %g", j, centre[i], radius);
        }
    }
    cr_expect_not(nh_ball_series_move(s, -1.8, 0.2));
    double mid, radius;
    cr_expect(nh_ball_value(ball, x, &mid, &radius) && mid <= -0.5 && mid > -sqrt(3));
    nh_ball_free(other);
    nh_ball_series_free(s);
}

Test(ball_series, what_has_none_is_refused)
{
    static const char *const texts[] = {"log(x)", "sqrt(x)", "1/x", "abs(x - 1/4)", "bessel_j(0, x)", "acosh(x)", "atan2(x - 1/4, -1)", "(-2)^x"};
    double c[degree], bound;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        nh_ex e = read(texts[i]);
        nh_ball_set_double(ball, x, 0.25);
        nh_ball_series *s = nh_ball_series_create(dag, ball, x, 0, NULL);
        cr_expect(!nh_ball_series_take(s, 1, &e, degree, 0.5, c, &bound), "%s", texts[i]);
        nh_ball_series_free(s);
    }
}
