/* antiderivative: closed forms are found where they exist, are continuous where that is promised, and their derivatives are compared in numbers,
 * which shares nothing with the linear algebra that found them. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "evaluate/tape.h"
#include "exact/antiderivative.h"
#include "graph/print.h"
#include "base/memory.h"
#include "graph/dag.h"
#include "typed.h"

enum { names = 6, samples = 12 };
static const char *const name[names] = {"x", "a", "b", "c", "p", "k"};

/* x in an interval, the others fixed. */
typedef struct {
    nh_dag *dag;
    double low, high;
} place;

static double value_at(const place *p, nh_ex e, double x)
{
    static const double others[names] = {0, 1.3, 0.7, 0.4, 2.1, 0.6};
    nh_ex symbol[names];
    double in[names], out;
    for (size_t i = 0; i < names; i++) symbol[i] = nh_symbol(p->dag, name[i]);
    memcpy(in, others, sizeof in);
    in[0] = x;
    nh_tape *tape = nh_tape_create(p->dag, names, symbol, 1, &e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, in, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static double sample(const place *p, size_t i) { return p->low + (p->high - p->low) * (0.5 + (double)i) / samples; }

static int sign(void *context, nh_ex e)
{
    const place *p = context;
    int all = 0;
    for (size_t i = 0; i < samples; i++) {
        double v = value_at(p, e, sample(p, i));
        int s = (v > 0) - (v < 0);
        if (i && s != all) return 0;
        all = s;
    }
    return all;
}

typedef enum { ELEMENTARY, ELLIPTIC, WITHIN_HALF_TURN } what;

static bool integrate(place *p, const char *text, what kind, nh_ex *f, nh_ex *F)
{
    nh_ex constant[names - 1];
    for (size_t i = 1; i < names; i++) constant[i - 1] = nh_symbol(p->dag, name[i]);
    nh_integration in = {.dag = p->dag, .x = nh_symbol(p->dag, "x"), .constants = names - 1, .constant = constant, .elliptic = kind != ELEMENTARY, .within_half_turn = kind == WITHIN_HALF_TURN, .sign = sign, .context = p};
    *f = ex(p->dag, text);
    return nh_antiderivative(&in, *f, F);
}

/* F between neighbouring samples against Simpson's rule: a jump would show. */
static void check_kind(const char *text, what kind, double low, double high)
{
    place p = {nh_dag_create(), low, high};
    nh_ex f, F;
    cr_expect(integrate(&p, text, kind, &f, &F), "no antiderivative of %s", text);
    char *shown = nh_print_string(p.dag, F);
    for (size_t i = 0; i + 1 < samples; i++) {
        enum { parts = 40 };
        double a = sample(&p, i), h = (sample(&p, i + 1) - a) / parts, sum = 0;
        for (int j = 0; j < parts; j++) sum += h / 6 * (value_at(&p, f, a + j * h) + 4 * value_at(&p, f, a + (j + 0.5) * h) + value_at(&p, f, a + (j + 1) * h));
        double difference = value_at(&p, F, a + parts * h) - value_at(&p, F, a);
        cr_expect(fabs(difference - sum) <= 1e-6 * (1 + fabs(sum)), "%s: %s rises by %g instead of %g from %g", text, shown, difference, sum, a);
    }
    nh_free(shown);
    nh_dag_free(p.dag);
}

static void check(const char *text, double low, double high) { check_kind(text, ELEMENTARY, low, high); }

Test(antiderivative, rational)
{
    check("(a*x^3 + b)/x^2", 0.5, 3);
    check("1/(x^2 + a)", -2, 2);
    check("1/(x^2 - a)", -1, 1);
    check("1/(x^2 - a)", 1.3, 3);
    check("x^5/((x^2 + 1)^2*(x + b))", -0.5, 2);
    check("1/(x^3 - a^3)", 1.5, 3);
}

Test(antiderivative, exponentials_and_logarithms)
{
    check("x^2*exp(-a*x)", 0, 2);
    check("exp(-a*x)*cos(b*x + c)", 0, 5);
    check("1/(a + b*exp(k*x))", -2, 2);
    check("log(x)^2/x", 0.5, 2);
    check("x*log(a*x + b)", 0.5, 2);
    check("tanh(a*x)", -1, 2);
    check("1/cosh(a*x)", -1, 2);
}

/* Integration by parts: what stands in the logarithm or the inverse function is not in a denominator before. */
Test(antiderivative, logarithms_and_inverse_functions_by_parts)
{
    check("log(x^2 + 1)", -2, 2);
    check("a*log(b*x)^2 + x*log(b*x)", 0.5, 2);
    check("x^2*atan(a*x)", -2, 2);
    check("asinh(x/a)", -2, 2);
    check("x*asin(x/p)", -1, 1);
    check("log(1 + x)^3", 0.5, 2);
    check("(x + 1)*atanh(x/p)", -1, 1);
}

/* The logarithms stand in the denominator without the root: a^2 (c - b x^2) - k^2 x^2. */
Test(antiderivative, sums_with_roots_in_denominators)
{
    check("1/(sqrt(c - b*x^2)*(a*sqrt(c - b*x^2) + k*x))", 0.1, 0.4);
    check("1/(a*sqrt(c - b*x^2) + k*x)", 0.1, 0.4);
    check("sqrt(c - b*x^2)/(a*sqrt(c - b*x^2) + k*x)", 0.1, 0.4);
}

Test(antiderivative, turning)
{
    check("x*sin(a*x)^2", 0, 9);
    check("1/(p + a*cos(x) + b*sin(x))", 0, 12);
    check("1/(c + p*cos(x))", -1.2, 1.2);
    check("1/(a*cos(3*x/7) + b*sin(3*x/7))", 0, 1); /* no polynomials in the functions of x/7 */
    check("1/(sqrt(2)*a*sin(3*k*x) + b*cos(3*k*x))", 0, 0.4);
    check("1/(exp(5*x) + exp(-5*x))", -1, 1);
    check("cos(x)*sin(x/2)/(a*cos(x/2) + b*sin(x/2))", -1, 1);
    check("tan(x)", -1, 1);
    check("1/cos(x)^3", -1, 1);
}

Test(antiderivative, roots)
{
    check("1/sqrt(a^2 - x^2)", -1, 1);
    check("x^2/sqrt(a*x^2 + b)", -1, 1);
    check("sqrt(x^2 - a)", 1.3, 3);
    check("1/(x*sqrt(p*x - a*x^2 - b^2))", 0.5, 1.2);
    check("x/sqrt(p*x - a*x^2 - b^2)", 0.5, 1.2);
    check("1/((x^2 - a^2)*sqrt(p^2 - x^2))", -1, 1);
    check("(a*x + b)^(3/2)", 0, 2);
    check("x^(k - 1)", 0.5, 2);
    check("1/sqrt(2*exp(-x) - exp(-2*x) - c)", -0.4, 1);
    check("1/(exp(x) + sqrt(1 + exp(2*x)))", -1, 1);
    check("1/(sqrt(a + x)*sqrt(p - x))", -1, 2);
    check("(cos(x) - 1)*sqrt(4*a*b + (a - b)^2*sin(x)^2)/((a*(cos(x) - 1) - b*(cos(x) + 1))*sin(x))", 0.3, 2.5); /* a pole where the cosine is 1 */
    check("sqrt(p + a*cos(x))/sqrt(1 + cos(x))", -1, 1); /* by half angles */
    check("sqrt(a + p*cos(x))/sqrt(1 + cos(x))", -1, 1);
}

/* exp(-F) is a power of functions, wherever F's logarithms are of squares or of one sine and its cosine. */
Test(antiderivative, integrating_factor)
{
    static const char *const row[][2] = {{"atanh(cos(x))/2 + log(sin(x)^2)/4", "1/sqrt(1 + cos(x))"},
                                         {"log(sin(x)^2)/4", "1/sqrt(sin(x))"},
                                         {"log((a + x)^2)", "1/(a + x)^2"},
                                         {"a*x - log(x)", "x*exp(-a*x)"}};
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        place p = {nh_dag_create(), 0.3, 1.2};
        nh_ex mu = nh_antiderivative_factor(p.dag, ex(p.dag, row[i][0])), ratio = nh_div(p.dag, mu, ex(p.dag, row[i][1]));
        char *shown = nh_print_string(p.dag, mu);
        for (size_t k = 1; k < samples; k++)
            cr_expect_float_eq(value_at(&p, ratio, sample(&p, k))/value_at(&p, ratio, sample(&p, 0)), 1, 1e-12, "%s: %s", row[i][0], shown);
        cr_expect(!strstr(shown, "log") && !strstr(shown, "atanh"), "%s", shown);
        nh_free(shown);
        nh_dag_free(p.dag);
    }
}

/* Motions in the potentials a exp(k x), a/cosh(x)^2, a tanh(x), a x^(2/3). */
Test(antiderivative, roots_of_exponentials_and_powers)
{
    check("1/sqrt(a + b*exp(k*x))", -1, 1);
    check("1/sqrt(p - b*exp(3*x))", -1, 0.3);
    check("1/sqrt(p - a/cosh(x)^2)", -1, 1);
    check("1/sqrt(a + b*tanh(x))", -1, 1);
    check("1/sqrt(a + b*x^(2/3))", 0.5, 2);
    check("1/sqrt(p - a*x^(2/3))", 0.5, 1.5);
    check("1/(x*sqrt(a + b*x))", 0.5, 2);
    check("1/((x + c)*sqrt(a*x + b))", 0.5, 2);
}

/* The error function, an elliptic integral, an exponential integral: none is elementary. */
Test(antiderivative, not_elementary)
{
    static const char *const text[] = {"exp(-a*x^2)", "1/sqrt(1 + x^3)", "exp(x)/x", "cos(a*exp(-b*x))", "sin(x)/x", "log(x)*atan(x)", "log(1 + exp(x))"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        place p = {nh_dag_create(), 0.5, 2};
        nh_ex f, F;
        cr_expect(!integrate(&p, text[i], false, &f, &F), "%s", text[i]);
        nh_dag_free(p.dag);
    }
}

/* With a root of a + c sin(x)^2, which is positive: all three kinds, also beyond a quarter of a turn, poles in pairs, at the roots of quadratic polynomials of the
 * cosine and of symbols, and elementary parts, odd in the cosine. */
Test(antiderivative, elliptic)
{
    check_kind("1/sqrt(p - a*sin(x)^2)", ELLIPTIC, -2, 5);
    check_kind("sqrt(p + a*cos(x)^2)", ELLIPTIC, -1, 3);
    check_kind("sin(x)^2/sqrt(p - a*sin(x)^2)", ELLIPTIC, -1, 3);
    check_kind("1/((a + b*cos(x)^2)*sqrt(p + c*sin(x)^2))", ELLIPTIC, -2, 4);
    check_kind("(b + cos(x))/((p + k*sin(x)^2)*sqrt(a - b*cos(x)^2))", ELLIPTIC, -1, 2);
    check_kind("1/((p + a*cos(x))*sqrt(a + b*sin(x)^2))", ELLIPTIC, -1, 2);
    check_kind("cos(x)/(sin(x)^2*sqrt(a + b*sin(x)^2))", ELLIPTIC, 0.4, 2);
    check_kind("1/sqrt(p + a*cos(x))", ELLIPTIC, -2, 5);
    check_kind("(c + cos(x))*sqrt(p - a*cos(x))", ELLIPTIC, -2, 5);
    check_kind("sin(x)^2/((p + b*cos(x))*sqrt(p + a*cos(x)))", ELLIPTIC, -2, 2);
    check_kind("cos(x)/((16/7 + 3/2*cos(x) - 2/9*cos(x)^2)*sqrt(2 - sin(x)^2))", ELLIPTIC, -1, 1.5);
}

/* Roots of even quartics, with ends of two signs and of one, real roots and complex ones; of quartics in the tangent and the area tangent of half an argument; and of
 * what is positive about u = pi or a quarter turn only. */
Test(antiderivative, elliptic_by_quartics)
{
    check_kind("1/sqrt(4 - x^2 - x^4)", ELLIPTIC, -1.2, 1.2);
    check_kind("c/sqrt(4 + x^2 - x^4)", ELLIPTIC, -1.5, 1.5);
    check_kind("1/sqrt(x^4 - x^2 - 3)", ELLIPTIC, 1.7, 5);
    check_kind("1/sqrt(p + a*x^2 + b*x^4)", ELLIPTIC, -3, 3);
    check_kind("1/sqrt(3 - 2*x^2 + x^4)", ELLIPTIC, -3, 3);
    check_kind("1/sqrt(9 - 7*x^2 + x^4)", ELLIPTIC, -1.1, 1.1);
    check_kind("1/sqrt(p + a*cosh(2*x))", ELLIPTIC, -2, 2);
    check_kind("1/sqrt(7 - a*cosh(x))", ELLIPTIC, -1, 1);
    check_kind("1/sqrt(9 + cos(x) + 2*cos(x)^2)", ELLIPTIC, -2.5, 2.5);
    check_kind("1/sqrt(3 + cos(x/3) + 2*cos(x/3)^2)", ELLIPTIC, -2, 2);
    check_kind("1/sqrt(1 - 3*cos(x))", ELLIPTIC, 1.6, 4.6);
    check_kind("1/sqrt(1/2 - cos(x)^2)", ELLIPTIC, 1, 2);
}

/* In a well of a quartic, on either side of 0; and amplitudes that begin anew with every half turn, which swings about pi and about a quarter turn need. */
Test(antiderivative, elliptic_in_wells)
{
    check_kind("1/sqrt(3*x^2 - x^4 - 1)", ELLIPTIC, 0.65, 1.6);
    check_kind("c/sqrt(5*x^2 - 2*x^4 - p)", ELLIPTIC, -1.1, -0.8);
    check_kind("1/sqrt(1/2 - cos(x))", WITHIN_HALF_TURN, 1.1, 5.2);
    check_kind("1/sqrt(1/2 - cos(x))", WITHIN_HALF_TURN, -5.2, -1.1);
    check_kind("(c + cos(x))*sqrt(1/2 + cos(x))", WITHIN_HALF_TURN, -2, 2);
    check_kind("1/sqrt(1/2 - cos(x)^2)", WITHIN_HALF_TURN, 4, 5.4);
    check_kind("1/sqrt(1/2 - sin(x)^2)", WITHIN_HALF_TURN, 2.4, 3.9);
}

/* They are candidates where they are asked for; and two roots are of a higher genus. */
Test(antiderivative, not_elliptic)
{
    static const struct {
        const char *text;
        what kind;
    } rows[] = {{"1/sqrt(p - a*sin(x)^2)", ELEMENTARY}, {"1/(sqrt(p - a*sin(x)^2)*sqrt(a + b*sin(x)^2))", ELLIPTIC}, {"1/sqrt(p - a*sin(x)^3)", ELLIPTIC}};
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        place p = {nh_dag_create(), 0.5, 2};
        nh_ex f, F;
        cr_expect(!integrate(&p, rows[i].text, rows[i].kind, &f, &F), "%s", rows[i].text);
        nh_dag_free(p.dag);
    }
}
