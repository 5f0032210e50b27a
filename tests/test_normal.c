/* normal, simplify: identities are zero, non-identities are not, and simpler forms are equal by rigorous evaluation. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "base/memory.h"
#include "base/progress.h"
#include "exact/ball.h"
#include "graph/diff.h"
#include "exact/form.h"
#include "exact/normal.h"
#include "exact/print_quotient.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "sweep.h"
#include "typed.h"

static nh_zero_verdict verdict_of(const char *text)
{
    nh_dag *dag = nh_dag_create();
    nh_zero_verdict verdict = nh_normal_is_zero(dag, ex(dag, text), 0);
    nh_dag_free(dag);
    return verdict;
}

/* Four bodies on a circle: their angles are cut into differences, not into the single ones, of which there would be too many terms. */
Test(normal, sums_of_angles)
{
    static const char *const cotangents =
        "cos(x-y)/sin(x-y)*cos(y-z)/sin(y-z)"
        "+cos(y-z)/sin(y-z)*cos(z-x)/sin(z-x)+cos(z-x)/sin(z-x)*cos(x-y)/sin(x-y)"
        "+cos(x-y)/sin(x-y)*cos(y-u)/sin(y-u)"
        "+cos(y-u)/sin(y-u)*cos(u-x)/sin(u-x)+cos(u-x)/sin(u-x)*cos(x-y)/sin(x-y)"
        "+cos(x-z)/sin(x-z)*cos(z-u)/sin(z-u)+cos(z-u)/sin(z-u)*cos(u-x)/sin(u-x)+cos(u-x)/sin(u-x)*cos(x-z)/sin(x-z)"
        "+cos(y-z)/sin(y-z)*cos(z-u)/sin(z-u)+cos(z-u)/sin(z-u)*cos(u-y)/sin(u-y)+cos(u-y)/sin(u-y)*cos(y-z)/sin(y-z)-4";
    static const char *const forces =
        "(cos(x-y)/sin(x-y)^3+cos(x-z)/sin(x-z)^3+cos(x-u)/sin(x-u)^3)*g"
        "+(cos(y-x)/sin(y-x)^3+cos(y-z)/sin(y-z)^3+cos(y-u)/sin(y-u)^3)*g"
        "+(cos(z-x)/sin(z-x)^3+cos(z-y)/sin(z-y)^3+cos(z-u)/sin(z-u)^3)*g"
        "+(cos(u-x)/sin(u-x)^3+cos(u-y)/sin(u-y)^3+cos(u-z)/sin(u-z)^3)*g";
    cr_expect_eq(verdict_of(cotangents), NH_ZERO);
    cr_expect_eq(verdict_of(forces), NH_ZERO);
    cr_expect_eq(verdict_of("1/(x-y)+1/(y-z)-2/(x-z)"), NH_NONZERO);
}

Test(normal, identities)
{
    static const char *const zero[] = {
        "(m+n)^(1-x)-m*(m+n)^(-x)-n*(m+n)^(-x)", "(m+n)^(2-2*x+3*y)-m*(m+n)^(1-2*x+3*y)-n*(m+n)^(1-2*x+3*y)", "(m+n)^(1-m/(m+n))-m*(m+n)^(-m/(m+n))-n*(m+n)^(-m/(m+n))",
        "(m+n)^(1/2-x/2)*(m+n)^(1/2+x/2)-m-n", "m*(m+n)^(1/2-x)+n*(m+n)^(1/2-x)-sqrt(m+n)*(m+n)^(1-x)", "(m+n)^(x*(y-1))*(m+n)^x-(m+n)^(x*y)",
        "0", "(x+y)^3-x^3-3*x^2*y-3*x*y^2-y^3", "1/(x-y)+1/(y-x)", "(x^2-y^2)/(x+y)-x+y",
        "1/(x*(x+1))-1/x+1/(x+1)", "sin(f)^2+cos(f)^2-1", "sin(a+b)-sin(a)*cos(b)-cos(a)*sin(b)",
        "cos(a-2*b)-cos(a)*cos(2*b)-sin(a)*sin(2*b)", "cos(2*x)-1+2*sin(x)^2", "sin(5*x)-16*sin(x)^5+20*sin(x)^3-5*sin(x)",
        "sin(12*x)-2*sin(6*x)*cos(6*x)", "sin(x/2)^2-(1-cos(x))/2", "cos(x/2+y/3)^2+sin(y/3+x/2)^2-1",
        "sin(x/2)*cos(x/3)+cos(x/2)*sin(x/3)-sin(5*x/6)", "1/(1+tan(f)^2)-cos(f)^2", "sin(f)/(1+cos(f))-tan(f/2)",
        "tan(x+y)-(tan(x)+tan(y))/(1-tan(x)*tan(y))", "sin(x+pi/2)-cos(x)", "cos(x-3*pi)+cos(x)", "sin(pi/7)^2+cos(pi/7)^2-1",
        "cos(pi/4)-sqrt(2)/2", "sin(-5*pi/6)+1/2", "sin(x+2*pi/3)+sin(x)/2-sqrt(3)/2*cos(x)", "sin(x)+sin(x+2*pi/3)+sin(x+4*pi/3)", "cos(x/2-y-7*pi/4)-cos(pi/4-y+x/2)",
        "sin(x*y+z)^2-1+cos(z+y*x)^2", "sin((x^2-1)/(x-1)+y)-sin(x+1+y)", "sin(2.5*x)^2+cos(2.5*x)^2-1", "sin(3/10)-3*sin(1/10)+4*sin(1/10)^3", "cos(x+3/10)-cos(x)*cos(3/10)+sin(x)*sin(3/10)", "cos(4/5)-1+2*sin(2/5)^2",
        "cosh(x)^2-sinh(x)^2-1", "tanh(x)*cosh(x)-sinh(x)", "cosh(x)+sinh(x)-exp(x)", "cosh(x+y)-cosh(x)*cosh(y)-sinh(x)*sinh(y)",
        "1/cosh(x)^2-1+tanh(x)^2", "tanh(x/2)-sinh(x)/(cosh(x)+1)", "exp(a+b)-exp(a)*exp(b)", "exp(3*x)-exp(x)^3", "exp(-x)*exp(x)-1",
        "exp(x^2+3*x)*exp(-x^2-2*x)-exp(x)", "exp(x/2)*exp(x/3)-exp(5*x/6)", "exp(2+x)-exp(1)^2*exp(x)",
        "x/sqrt(x^2+y^2)*sqrt(x^2+y^2)-x", "(x^2+y^2)/sqrt(x^2+y^2)-sqrt(x^2+y^2)", "sqrt(8)-2*sqrt(2)", "sqrt(6)-sqrt(2)*sqrt(3)",
        "sqrt(m)*sqrt(u^2+1)-sqrt(m+m*u^2)", "sqrt(x^2-1)/sqrt(x-1)-sqrt(x+1)", "sqrt(x/y)*sqrt(y)-sqrt(x)",
        "sqrt(12*x)-2*sqrt(3)*sqrt(x)", "1/sqrt(2)-sqrt(2)/2", "sqrt(4*x+4*y)-2*sqrt(x+y)", "(x+y)^(1/3)*(x+y)^(1/6)-sqrt(x+y)",
        "(x/y+1)^(3/2)-(x/y+1)*sqrt((x+y)/y)", "(x-1)/(sqrt(x)-1)-sqrt(x)-1", "sqrt(sqrt(x)+1)^4-x-2*sqrt(x)-1",
        "sqrt((x+1)^2+y^2)-sqrt(x^2+2*x+1+y^2)", "sqrt(x+sqrt(x^2+1))^2-x-sqrt(1+x^2)", "sqrt(1-sin(f)^2)^2-cos(f)^2",
        "sqrt(x+1/sqrt(x^2+1))^2*sqrt(x^2+1)-x*sqrt(x^2+1)-1", "(sqrt(x+1/y)+1)^2-x-1/y-1-2*sqrt(x+1/y)", "(sqrt(x/(y+1)+1)+1)^5/(sqrt(x/(y+1)+1)-1)*x/(y+1)-(1+sqrt(x/(y+1)+1))^6",
        "((x+1/y)^(1/3)+z)^3-x-1/y-3*z*(x+1/y)^(2/3)-3*z^2*(x+1/y)^(1/3)-z^3", "abs(x+y)^2-x^2-2*x*y-y^2", "abs((x+y)*(x-y))-abs(x^2-y^2)",
        "sign(x+y)*(x+y)-abs(x+y)", "abs(x-y)/(x-y)-sign(x-y)", "sign(x+y)^3-sign(x+y)", "abs(y-x)*sign(x-y)-x+y", "(abs(x+y)+sign(x+y))^2-(x+y+1)^2",
        "x^(a+1)-x*x^a", "x^(2*a+3)-x^3*(x^a)^2", "(x+1)^(a-b)*(1+x)^b-(x+1)^a", "x^(a/2)*x^(a/3)-x^(5*a/6)",
        "log((x+1)^2)-log(x^2+2*x+1)", "atan((x^2-1)/(x-1))-atan(x+1)", "atan2(x*(x+1),y)-atan2(x+x^2,y)",
        "log(sin(x)^2+cos(x)^2+y)-log(1+y)", "asinh(cosh(x)^2-sinh(x)^2+y)-asinh(y+1)", "sign(x*y+x)-sign(x*(1+y))",
        "sin(y+z/(z+2))-sin(y)*cos(z/(z+2))-cos(y)*sin(z/(z+2))", "sinh(2*log(x))-x^2/2+1/(2*x^2)",
        "atan(1/(2+sin(x)))-atan((2-sin(x))/(3+cos(x)^2))", "log((x-1)/(sqrt(x)-1))-log(sqrt(x)+1)",
        "exp(atan((x+1)^2)+log(x))/exp(log(x))-exp(atan(x^2+2*x+1))", "0.1*x+0.2*x-(0.1+0.2)*x", "(0.1*x+1)^2-0.01*x^2-0.2*x-1",
    };
    for (size_t i = 0; i < sizeof zero / sizeof *zero; i++) {
        nh_zero_verdict verdict = verdict_of(zero[i]);
        cr_expect(verdict == NH_ZERO, "%s is zero, verdict %d", zero[i], verdict);
    }
}

Test(normal, non_identities)
{
    static const char *const other[] = {
        "1", "x", "sin(f)^2+cos(f)^2", "sin(f)^2-cos(f)^2-1", "sin(a+b)-sin(a)*cos(b)+cos(a)*sin(b)", "cosh(x)^2+sinh(x)^2-1",
        "sqrt(x^2)-x", "sqrt(x^2)+x", "abs(x)-x", "sign(x+y)-1", "sign(x-y)*(x+y)-abs(x+y)", "abs(x+y)+sign(x+y)*(x+y)", "sqrt(6)-sqrt(2)*sqrt(3)-1/1000000007", "log(x*y)-log(x)*log(y)",
        "exp(a*b)-exp(a)*exp(b)", "x^(a*b)-x^a*x^b", "sin(2*x)-2*sin(x)", "tan(x/2)-sin(x)/(1-cos(x))", "atan(x)-atan(y)",
        "atan2(x,y)-atan2(y,x)", "(x+y)^5-x^5-y^5", "1/(x-y)-1/(y-x)", "sin(pi*x)^2", "x^(1/3)*x^(1/3)-x",
        "sin(100000*x)-2*sin(50000*x)", "sqrt(x+1)*sqrt(x-1)-x", "1/(sin(x)^2+cos(x)^2-1)", "x-x*(1+1/10^15)",
    };
    for (size_t i = 0; i < sizeof other / sizeof *other; i++) {
        nh_zero_verdict verdict = verdict_of(other[i]);
        cr_expect(verdict == NH_NONZERO, "%s is not zero, verdict %d", other[i], verdict);
    }
}

/* A symbol that satisfies a polynomial: expressions are reduced by it, on all of its branches at once. */
Test(normal, what_a_symbol_satisfies)
{
    static const struct { unsigned order; const char *value, *zero, *nonzero; } list[] = {
        {2, "x^2 + y^2", "(u^5 + u)/(1 + (x^2 + y^2)^2) - u", "u - sqrt(x^2 + y^2)"},
        {2, "x^2 + y^2", "1/(1 + u) - (1 - u)/(1 - x^2 - y^2)", "u - x - y"},
        {2, "x^2 + y^2", "sqrt(u^2 + 1) - sqrt(x^2 + y^2 + 1)", "sqrt(u^2 + 1) - sqrt(x^2 + y^2)"},
        {2, "3*x*u - 2*x^2", "u^3 - 7*x^2*u + 6*x^3", "u - x"}, /* u = x or u = 2 x */
        {2, "(c^2 - x*u)/(1 + y^2)", "u^3*(1 + y^2)^2 - (c^2 - x*u)*u*(1 + y^2)", "u^2*(1 + y^2) - c^2"},
        {2, "sin(x)", "u^4 + cos(x)^2 - 1", "u^2 - cos(x)"},
        {3, "x + y*u", "u^5 - x*u^2 - x*y - y^2*u", "u^3 - x"},
        {1, "x*y", "u^2 + u - x^2*y^2 - x*y", "u - x"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex zero = ex(dag, list[i].zero), nonzero = ex(dag, list[i].nonzero);
        nh_relate(dag, nh_symbol(dag, "u"), list[i].order, ex(dag, list[i].value));
        cr_expect_eq(nh_normal_is_zero(dag, zero, 0), NH_ZERO, "u^%u = %s: %s", list[i].order, list[i].value, list[i].zero);
        cr_expect_eq(nh_normal_is_zero(dag, nonzero, 0), NH_NONZERO, "u^%u = %s: %s", list[i].order, list[i].value, list[i].nonzero);
        cr_expect(nh_is_zero(dag, nh_simplify(dag, zero)), "u^%u = %s: %s", list[i].order, list[i].value, list[i].zero);
        nh_dag_free(dag);
    }
}

Test(normal, doubles_are_what_they_are)
{
    nh_dag *dag = nh_dag_create();
    nh_ex x = nh_symbol(dag, "x"), c = nh_real(dag, 0.1), s = nh_call(dag, NH_SIN, x), co = nh_call(dag, NH_COS, x);
    /* c x (sin^2 + cos^2) - c x */
    nh_ex unit = nh_add(dag, nh_mul(dag, s, s), nh_mul(dag, co, co));
    nh_ex e = nh_sub(dag, nh_mul(dag, nh_mul(dag, c, x), unit), nh_mul(dag, c, x));
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_ZERO);
    /* the double 0.1 is not the number 1/10 */
    e = nh_sub(dag, nh_mul(dag, nh_mul(dag, c, x), unit), nh_mul(dag, nh_ratio(dag, 1, 10), x));
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_NONZERO);
    e = nh_mul(dag, x, nh_real(dag, NAN));
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_NONZERO);
    cr_expect_eq(nh_simplify(dag, e), e);
    /* simplifying keeps the constant and does not print it as a fraction of two 17-digit numbers */
    e = nh_mul(dag, nh_mul(dag, c, x), unit);
    cr_expect_eq(nh_simplify(dag, e), nh_mul(dag, c, x));
    nh_dag_free(dag);
}

Test(normal, limits)
{
    nh_dag *dag = nh_dag_create();
    nh_ex e = ex(dag, "(a+b+c+d+e+f+g+h)^30-(a+b)^30");
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_NONZERO, "its form is too long, a value is not");
    cr_expect_eq(nh_simplify(dag, e), e);
    e = ex(dag, "((a+b+c+d)*(e+f+g+h)+x)^8-((a+b)*(e+f+g+h)+(c+d)*(e+f+g+h)+x)^8");
    cr_expect_eq(nh_normal_is_zero(dag, e, 600), NH_TOO_LARGE, "no value differs from zero");
    cr_expect_eq(nh_normal_is_zero(dag, nh_add(dag, e, ex(dag, "a/1000000")), 600), NH_NONZERO);
    e = ex(dag, "(a+b+c+d)^6-(a+b)^6");
    cr_expect_eq(nh_normal_is_zero(dag, e, 20), NH_TOO_LARGE);
    cr_expect_eq(nh_normal_is_zero(dag, e, 200), NH_NONZERO);
    e = ex(dag, "x^100000000*sin(y)^2+x^100000000*cos(y)^2-x^100000000");
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_ZERO);
    e = ex(dag, "x^(1/1000)*sin(y)^2+x^(1/1000)*cos(y)^2-x^(1/1000)");
    cr_expect_eq(nh_normal_is_zero(dag, e, 0), NH_ZERO);
    nh_dag_free(dag);
}

/* Nothing may hang or overflow the stack, whatever the verdict. */
Test(normal, monsters, PLAIN_ONLY)
{
    static const char *const text[] = {
        "(x^1000-y^1000)/(x^7-y^7)", "(sin(a)+cos(b)+sin(c)+cos(d)+sin(e)+x)^12-x", "(sqrt(a)+sqrt(b)+sqrt(c)+sqrt(d)+sqrt(e))^16-1",
        "1/(a+b+c+d)^4+1/(b+c+d+e)^4+1/(c+d+e+f)^4+1/(d+e+f+g)^4", "((x^999+y)^999+z)^999", "sin(x^77+12345678901*y)^12*cos(99*x)^99",
        "(x^60+y^59*z+w^58*x^3-1)^3/(x^60-z^60+y^31*w^20-7*x*y*z)", "1/(x-1)^900+1/(y-1)^900+1/(z-1)^900",
    };
    nh_dag *dag = nh_dag_create();
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        nh_ex e = ex(dag, text[i]);
        nh_normal_is_zero(dag, e, 0);
        nh_simplify(dag, e);
    }
    nh_ex deep = nh_symbol(dag, "x"), root = deep, sum = deep;
    for (int i = 0; i < 20000; i++) {
        deep = nh_call(dag, NH_ATAN, deep);
        if (i < 2000) root = nh_add(dag, nh_sqrt(dag, root), nh_symbol(dag, "y"));
        if (i < 2000) sum = nh_div(dag, nh_int(dag, 1), nh_add(dag, sum, nh_symbol(dag, "y")));
    }
    cr_expect_neq(nh_normal_is_zero(dag, nh_add(dag, deep, nh_symbol(dag, "y")), 0), NH_ZERO);
    cr_expect_neq(nh_normal_is_zero(dag, root, 0), NH_ZERO);
    cr_expect_neq(nh_normal_is_zero(dag, sum, 0), NH_ZERO);
    nh_simplify(dag, root);
    nh_simplify(dag, sum);
    nh_dag_free(dag);
}

Test(normal, derivatives)
{
    /* d/dx of the first is the second */
    static const char *const pair[][2] = {
        {"sqrt(x^2+y^2)", "x/sqrt(x^2+y^2)"}, {"tan(x*y)", "y*(1+tan(x*y)^2)"}, {"x^x", "x^x*(log(x)+1)"}, {"tanh(x)", "1/cosh(x)^2"},
        {"atan(x/y)", "y/(x^2+y^2)"}, {"asin(x/3)", "1/sqrt(9-x^2)"}, {"log(sin(x))", "cos(x)/sin(x)"}, {"atan2(y,x)", "-y/(x^2+y^2)"},
        {"(x^2+1)^(y/2)", "x*y*(x^2+1)^(y/2-1)"}, {"exp(-x^2/2)*sin(x)", "exp(-x^2/2)*(cos(x)-x*sin(x))"},
        {"acosh(x)^2", "2*acosh(x)/(sqrt(x-1)*sqrt(x+1))"}, {"1/(x^2+y^2)^(3/2)", "-3*x*(x^2+y^2)^(-5/2)"},
    };
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex d = nh_diff(dag, ex(dag, pair[i][0]), ex(dag, "x")), expected = ex(dag, pair[i][1]);
        cr_expect_eq(nh_normal_is_zero(dag, nh_sub(dag, d, expected), 0), NH_ZERO, "d/dx %s", pair[i][0]);
        cr_expect_neq(nh_normal_is_zero(dag, nh_add(dag, d, expected), 0), NH_ZERO, "d/dx %s", pair[i][0]);
        nh_dag_free(dag);
    }
}

Test(normal, forms)
{
    static const char *const pair[][2] = {
        {"m*cos(f)^2+m*sin(f)^2", "m"}, {"(1+tan(f)^2)*x", "x/cos(f)^2"},
        {"(x^2*sin(f)^2+x^2*cos(f)^2+2*a*w*x*sin(f)*cos(f)-2*a*w*x*cos(f)*sin(f)+a^2*w^2)/2", "(x^2+a^2*w^2)/2"},
        {"-(m*a*w*v)/(m*a^2*(k^2-1)+m*a^2)", "-w*v/(a*k^2)"}, {"m*g*l*sin(t)*(sin(t)^2+cos(t)^2)", "m*g*l*sin(t)"},
        {"m*cosh(x)^2-m*sinh(x)^2", "m"}, {"x*sin(f)^2/cos(f)^2", "x*tan(f)^2"}, {"sin(f)/cos(f)", "tan(f)"}, {"cos(f)/sin(f)", "1/tan(f)"},
        {"m*sin(a+b)*(k^2-1)+m*sin(a+b)", "m*k^2*sin(a+b)"}, {"(x^2+y^2)/sqrt(x^2+y^2)", "sqrt(x^2+y^2)"},
        {"sqrt(x^2-y^2)/((x-y)*(x+y))", "1/sqrt(x^2-y^2)"}, {"(x/(x^2+y^2)^(3/2))^2+(y/(x^2+y^2)^(3/2))^2", "1/(x^2+y^2)^2"},
        {"m*((v*cos(f)-a*w*sin(f))^2+(v*sin(f)+a*w*cos(f))^2)/2+J*w^2/2", "(m*v^2+(J+m*a^2)*w^2)/2"},
        {"m*(xd*cos(f)+yd*sin(f))^2/2+m*(xd*sin(f)-yd*cos(f))^2/2", "m*(xd^2+yd^2)/2"},
        {"log(x*sin(f)^2+x*cos(f)^2)", "log(x)"}, {"atan((x^2-1)/(x-1))", "atan(x+1)"}, {"sqrt((x^3-x)/(x-1))", "sqrt(x*(x+1))"},
        {"x*y+x*z+w*y+w*z", "(x+w)*(y+z)"}, {"sin(x)/(1+cos(x))-(1-cos(x))/sin(x)", "0"}, {"exp(a)*exp(b)/exp(a-b)", "exp(2*b)"},
        {"a*sin(f)^2+b-b*sin(f)^2-b*cos(f)^2", "a*sin(f)^2"}, {"x^(n+1)/x^(n-1)", "x^2"},
        {"m*cos(f)^2+m*sin(f)^2+n*sin(f)^2", "m+n*sin(f)^2"}, {"m*cosh(f)^2-m*sinh(f)^2+n*sinh(f)^2", "m+n*sinh(f)^2"},
        {"m*cosh(f)^2-m*sinh(f)^2+n*cosh(f)^2", "m+n*cosh(f)^2"},
        {"sin(f)*log(x+y*(sin(g)^2+cos(g)^2))", "sin(f)*log(x+y)"},
    };
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e = ex(dag, pair[i][0]), expected = ex(dag, pair[i][1]), s = nh_simplify(dag, e);
        char *text = nh_print_string(dag, s);
        cr_expect_eq(nh_normal_is_zero(dag, nh_sub(dag, s, expected), 0), NH_ZERO, "%s -> %s", pair[i][0], text);
        cr_expect_leq(nh_complexity(dag, s), nh_complexity(dag, expected), "%s -> %s", pair[i][0], text);
        nh_free(text);
        nh_dag_free(dag);
    }
}

/* However it was written, and e and -e are told apart. */
Test(normal, one_sum_of_equal_expressions)
{
    static const char *const pair[][2] = {
        {"m*(x+y)^2-4*m*x*y", "m*(y-x)^2"}, {"a*sin(f)^2+b*cos(f)*sin(f)*2", "a+b*sin(2*f)-a*cos(f)^2"}, {"(x-1)*(x+1)/(y+x*y)", "(x-1)/y"},
        {"J*(p-q*cos(h))-m*r^2*p", "p*(J-m*r^2)-J*cos(h)*q"}, {"exp(a)*x/exp(b)", "x*exp(a-b)"}, {"(x+y)/sqrt(x+y)", "sqrt(x+y)"},
    };
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex a = ex(dag, pair[i][0]), b = ex(dag, pair[i][1]);
        cr_expect_eq(nh_canonical_sum(dag, a), nh_canonical_sum(dag, b), "%s and %s", pair[i][0], pair[i][1]);
        cr_expect_eq(nh_normal_is_zero(dag, nh_sub(dag, nh_canonical_sum(dag, a), a), 0), NH_ZERO, "%s", pair[i][0]);
        cr_expect_eq(nh_canonical_sign(dag, a), nh_canonical_sign(dag, b), "%s and %s", pair[i][0], pair[i][1]);
        cr_expect_eq(nh_canonical_sign(dag, a), -nh_canonical_sign(dag, nh_neg(dag, b)), "%s and its opposite", pair[i][0]);
        nh_dag_free(dag);
    }
}

/* Not on which was made first. */
Test(normal, an_order_that_depends_on_what_they_are)
{
    static const char *const text[] = {
        "2", "z", "x", "x*y", "x*z", "y*z", "x+y", "y-z", "y+z", "2*x-3*y", "h*cos(p)", "h*sin(p)", "x*cos(p)", "x*sin(p)-y*cos(p)", "y*sin(p)+x*cos(p)", "x^2*y",
        "x*y^2", "sqrt(x*y)", "exp(-x)*y", "m*(x+y)", "m*(x-y)", "(x+y)/z", "(x-y)/z", "x*(y+z)*cos(p)", "x*(y+z)*sin(p)",
    };
    enum { count = sizeof text / sizeof *text };
    nh_dag *dag[2] = {nh_dag_create(), nh_dag_create()};
    nh_ex e[2][count];
    for (int k = 0; k < 2; k++) {
        ex(dag[k], "m+x+y+z+h+p");
        for (size_t i = 0; i < count; i++) {
            size_t j = k ? count - 1 - i : i;
            e[k][j] = ex(dag[k], text[j]);
        }
    }
    for (size_t i = 0; i < count; i++)
        for (size_t j = 0; j < count; j++) {
            int order[2], back = nh_complexity_order(dag[0], e[0][j], e[0][i]);
            for (int k = 0; k < 2; k++) order[k] = nh_complexity_order(dag[k], e[k][i], e[k][j]);
            cr_expect((order[0] < 0) == (order[1] < 0) && (order[0] > 0) == (order[1] > 0), "%s and %s", text[i], text[j]);
            cr_expect((order[0] == 0) == (i == j) && (order[0] < 0) == (back > 0), "%s and %s", text[i], text[j]);
        }
    nh_dag_free(dag[0]);
    nh_dag_free(dag[1]);
}

/* Radicands are shown as they were written where that is shorter than their canonical form. */
Test(normal, radicands_are_kept)
{
    static const char *const pair[][2] = {
        {"(x-a)/sqrt((x-a)^2+(y-b)^2)+a/sqrt((x-a)^2+(y-b)^2)", "x/sqrt((x-a)^2+(y-b)^2)"},
        {"sin(f)^2*((x-a)^2+(y-b)^2)^(3/2)+cos(f)^2*((x-a)^2+(y-b)^2)^(3/2)", "((x-a)^2+(y-b)^2)^(3/2)"},
    };
    for (size_t i = 0; i < sizeof pair / sizeof *pair; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex s = nh_simplify(dag, ex(dag, pair[i][0]));
        char *text = nh_print_string(dag, s);
        cr_expect_eq(s, ex(dag, pair[i][1]), "%s", text);
        nh_free(text);
        nh_dag_free(dag);
    }
}

Test(normal, simple_forms_stay)
{
    static const char *const text[] = {"x", "3/7", "m*g*l*(1-cos(t))", "sqrt(x^2+y^2)", "m*(v^2+a^2*w^2)/2", "tan(f)", "sinh(x)*w",
                                       "exp(-x)*y", "atan2(y,x)", "x^a", "log((x+1)*(y+1))", "abs(x)*x", "sin(2*x)"};
    for (size_t i = 0; i < sizeof text / sizeof *text; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e = ex(dag, text[i]), s = nh_simplify(dag, e);
        char *shown = nh_print_string(dag, s);
        cr_expect_eq(s, e, "%s -> %s", text[i], shown);
        nh_free(shown);
        nh_dag_free(dag);
    }
}

Test(normal, complexity)
{
    static const struct {
        const char *text;
        size_t length;
    } known[] = {{"x", 1}, {"7", 1}, {"-7", 2}, {"x+y", 3}, {"2*x", 3}, {"x/2", 3}, {"x^2", 3}, {"sqrt(x)", 2}, {"1/x", 3}, {"sin(x)", 2},
                 {"x*(y+z)", 6}, {"x/(y*z)", 6}, {"-x*y", 4}, {"atan2(x,y)", 3}, {"x^(a+1)", 6}, {"pi", 1}};
    nh_dag *dag = nh_dag_create();
    for (size_t i = 0; i < sizeof known / sizeof *known; i++)
        cr_expect_eq(nh_complexity(dag, ex(dag, known[i].text)), known[i].length, "%s: %zu", known[i].text,
                     nh_complexity(dag, ex(dag, known[i].text)));
    nh_ex e = ex(dag, "x"); /* a tree of 2^200 leaves */
    for (int i = 0; i < 200; i++) e = nh_mul(dag, nh_call(dag, NH_SIN, e), nh_call(dag, NH_COS, e));
    cr_expect_gt(nh_complexity(dag, e), UINT32_MAX);
    nh_dag_free(dag);
}

/* ---- random expressions ---- */

static uint64_t state = 0x2545f4914f6cdd1d;

static unsigned dice(unsigned n)
{
    state ^= state << 13;
    state ^= state >> 7;
    state ^= state << 17;
    return (unsigned)((state >> 33) % n);
}

static nh_ex leaf(nh_dag *dag)
{
    static const char *const name[] = {"x", "y", "z"};
    if (dice(4) == 0) return nh_ratio(dag, (int64_t)dice(7) - 3, 1 + dice(3));
    return nh_symbol(dag, name[dice(3)]);
}

static nh_ex random_expression(nh_dag *dag, int depth)
{
    static const nh_function smooth[] = {NH_SIN, NH_COS, NH_TAN, NH_EXP, NH_ATAN, NH_SINH, NH_COSH, NH_TANH, NH_ABS, NH_ASINH};
    if (depth == 0) return leaf(dag);
    nh_ex a = random_expression(dag, depth - 1);
    switch (dice(9)) {
    case 0: case 1: return nh_add(dag, a, random_expression(dag, depth - 1));
    case 2: case 3: return nh_mul(dag, a, random_expression(dag, depth - 1));
    case 4: return nh_div(dag, a, nh_add(dag, nh_int(dag, 2), random_expression(dag, depth - 1)));
    case 5: return nh_powi(dag, a, (int64_t)dice(5) - 1);
    case 6: return nh_pow(dag, nh_add(dag, nh_int(dag, 1), nh_mul(dag, a, a)), nh_ratio(dag, (int64_t)dice(5) - 2, 2 + dice(2)));
    case 7: return nh_call(dag, NH_LOG, nh_add(dag, nh_int(dag, 3), nh_mul(dag, a, a)));
    default: return nh_call(dag, smooth[dice(sizeof smooth / sizeof *smooth)], a);
    }
}

static nh_ex disguise(nh_dag *dag, nh_ex e);

static nh_ex disguise_function(nh_dag *dag, nh_ex e)
{
    nh_function f = nh_function_of(dag, e);
    if (!nh_arity(dag, e)) return e;
    nh_ex a = disguise(dag, nh_child(dag, e, 0)), y = nh_symbol(dag, "y"), b = nh_add(dag, a, y);
    nh_ex minus = nh_call(dag, NH_EXP, nh_neg(dag, a)), plus = nh_call(dag, NH_EXP, a);
    if (dice(2)) return nh_call(dag, f, a);
    switch (f) {
    case NH_SIN: /* sin(a+y) cos y - cos(a+y) sin y */
        return nh_sub(dag, nh_mul(dag, nh_call(dag, NH_SIN, b), nh_call(dag, NH_COS, y)),
                      nh_mul(dag, nh_call(dag, NH_COS, b), nh_call(dag, NH_SIN, y)));
    case NH_COS: return nh_div(dag, nh_sub(dag, nh_int(dag, 1), nh_powi(dag, nh_call(dag, NH_SIN, a), 2)), nh_call(dag, NH_COS, a));
    case NH_TAN: return nh_div(dag, nh_call(dag, NH_SIN, a), nh_call(dag, NH_COS, a));
    case NH_EXP: return nh_add(dag, nh_call(dag, NH_SINH, a), nh_call(dag, NH_COSH, a));
    case NH_SINH: return nh_div(dag, nh_sub(dag, plus, minus), nh_int(dag, 2));
    case NH_COSH: return nh_div(dag, nh_add(dag, plus, minus), nh_int(dag, 2));
    case NH_TANH: return nh_div(dag, nh_sub(dag, plus, minus), nh_add(dag, plus, minus));
    default: return nh_call(dag, f, a);
    }
}

/* b^x; whole powers multiplied out */
static nh_ex disguise_power(nh_dag *dag, nh_ex b, nh_ex x)
{
    b = disguise(dag, b);
    nh_num n = nh_kind_of(dag, x) == NH_NUMBER ? nh_number_of(dag, x) : nh_num_int(0);
    if (n.q != 1 || n.p < 2 || n.p > 4 || nh_kind_of(dag, b) != NH_SUM) return nh_pow(dag, b, x);
    nh_ex rest = nh_powi(dag, b, n.p - 1), sum = nh_mul(dag, nh_number(dag, nh_constant_of(dag, b)), rest);
    for (size_t i = 0; i < nh_arity(dag, b); i++) {
        nh_ex c = nh_number(dag, nh_coefficient_of(dag, b, i));
        sum = nh_add(dag, sum, nh_mul(dag, nh_mul(dag, c, rest), nh_child(dag, b, i)));
    }
    return sum;
}

/* The same function, written differently. */
static nh_ex disguise(nh_dag *dag, nh_ex e)
{
    nh_kind kind = nh_kind_of(dag, e);
    nh_ex x = nh_symbol(dag, "x"), one = nh_int(dag, 1);
    if (kind == NH_NUMBER) return e;
    if (kind == NH_FUNCTION) return disguise_function(dag, e);
    if (kind == NH_SYMBOL) /* e (x + 1) - e x */
        return dice(3) ? e : nh_sub(dag, nh_mul(dag, e, nh_add(dag, x, one)), nh_mul(dag, e, x));
    nh_ex result = nh_number(dag, nh_constant_of(dag, e));
    for (size_t i = 0; i < nh_arity(dag, e); i++) {
        nh_ex child = nh_child(dag, e, i);
        if (kind == NH_PRODUCT) result = nh_mul(dag, result, disguise_power(dag, child, nh_exponent_of(dag, e, i)));
        else result = nh_add(dag, result, nh_mul(dag, nh_number(dag, nh_coefficient_of(dag, e, i)), disguise(dag, child)));
    }
    return result;
}

Test(normal, random_disguises)
{
    enum { trials = 600 };
    int zero = 0, large = 0;
    for (int i = 0; i < trials; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e = random_expression(dag, 3), other = disguise(dag, e), difference = nh_sub(dag, e, other);
        nh_zero_verdict verdict = nh_normal_is_zero(dag, difference, 0);
        zero += verdict == NH_ZERO;
        large += verdict == NH_TOO_LARGE;
        char *text = nh_print_string(dag, difference);
        bool defined = !strstr(text, "nan") && !strstr(text, "inf"); /* 1/0 occurs */
        cr_expect(verdict != NH_NONZERO || !defined, "%s", text);
        nh_ex wrong = nh_add(dag, difference, nh_mul(dag, nh_ratio(dag, 1, 1000003), nh_symbol(dag, "x")));
        cr_expect_neq(nh_normal_is_zero(dag, wrong, 0), NH_ZERO, "%s + x/1000003", text);
        nh_free(text);
        nh_dag_free(dag);
    }
    cr_expect_gt(zero, trials * 9 / 10, "only %d of %d were decided, %d too large", zero, trials, large);
}

static nh_ball *at_random_point(nh_dag *dag)
{
    static const char *const name[] = {"x", "y", "z"};
    nh_ball *ball = nh_ball_create(dag, 256);
    for (int i = 0; i < 3; i++) nh_ball_set_ratio(ball, nh_symbol(dag, name[i]), 100 + dice(1900), 1009);
    return ball;
}

/* simplify(e) = e to 30 digits wherever both are defined; and never longer */
Test(normal, random_simplification, PLAIN_ONLY)
{
    enum { trials = 600 };
    int compared = 0;
    for (int i = 0; i < trials; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e = random_expression(dag, 3 + (i % 2));
        if (i % 3 == 0) e = disguise(dag, e);
        nh_ex s = nh_simplify(dag, e), terms[2] = {e, nh_neg(dag, s)};
        cr_expect_leq(nh_complexity(dag, s), nh_complexity(dag, e));
        for (int k = 0; k < 3; k++) {
            double ratio; /* none where both are zero or out of range */
            nh_ball *ball = at_random_point(dag);
            if (nh_ball_relative_sum(ball, 2, terms, &ratio)) {
                char *before = nh_print_string(dag, e), *after = nh_print_string(dag, s);
                cr_expect_lt(ratio, -30, "%s\n -> %s", before, after);
                nh_free(before);
                nh_free(after);
                compared++;
            }
            nh_ball_free(ball);
        }
        nh_dag_free(dag);
    }
    cr_expect_gt(compared, trials * 2, "compared only %d times", compared);
}

/* A form that is not built because it would be too long is too long. */
Test(normal, lengths_are_bounded_before_forms_are_built)
{
    enum { trials = 400 };
    size_t bounds = 0, lengths = 0;
    for (int i = 0; i < trials; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex e = random_expression(dag, 3);
        if (i % 3 == 0) e = disguise(dag, e);
        nh_forms forms;
        nh_form form;
        nh_forms_init(&forms, dag, i % 2, 1000);
        nh_arena *arena = nh_arena_create();
        bool fine = nh_form_make(&forms, e, true, &form) == NH_FIELD_FINE;
        for (size_t k = 0; k < form.kernels.count; k++) form.kernels.item[k].length = 1;
        for (int factored = 0; factored < 2 && fine; factored++) {
            nh_pieces pieces;
            if (!nh_pieces_make(form.field, arena, form.value, factored, &pieces)) continue;
            for (int way = 0; way < 3; way++) {
                bool terms = way == 2;
                nh_ex built = terms ? nh_print_quotient_terms(&form.kernels, &pieces) : nh_print_quotient_product(&form.kernels, &pieces, way);
                size_t length = nh_complexity(dag, built), bound = terms ? nh_print_quotient_terms_least(&form.kernels, &pieces)
                                                                         : nh_print_quotient_product_least(&form.kernels, &pieces, way);
                char *text = bound > length ? nh_print_string(dag, built) : NULL;
                cr_expect(bound <= length, "way %d: %zu > %zu, %s", way, bound, length, text);
                nh_free(text);
                bounds += bound;
                lengths += length;
            }
        }
        nh_arena_free(arena);
        nh_form_clear(&form);
        nh_forms_clear(&forms);
        nh_dag_free(dag);
    }
    cr_expect(5 * bounds > lengths, "the bounds are %zu of %zu", bounds, lengths);
}

/* Written out e would have 2^45 factors, and as many paths lead down through its graph: whatever asks all parts must ask each once. */
Test(normal, what_is_shared_is_looked_at_once)
{
    nh_dag *dag = nh_dag_create();
    nh_ex x = nh_symbol(dag, "x"), y = nh_symbol(dag, "y"), e = x;
    for (int i = 0; i < 45; i++) e = nh_mul(dag, nh_add(dag, e, nh_int(dag, 1)), nh_add(dag, e, nh_int(dag, 2)));
    nh_ex sum = nh_add(dag, e, nh_call(dag, NH_SIN, nh_add(dag, e, y)));
    cr_expect_eq(nh_simplify(dag, sum), sum);
    cr_expect_neq(nh_diff(dag, sum, x), nh_diff(dag, sum, y));
    nh_dag_free(dag);
}

/* d(fg) = f dg + g df, and derivatives commute */
Test(normal, random_derivatives)
{
    for (int i = 0; i < 150; i++) {
        nh_dag *dag = nh_dag_create();
        nh_ex x = nh_symbol(dag, "x"), y = nh_symbol(dag, "y");
        nh_ex f = random_expression(dag, 2), g = random_expression(dag, 2), fg = nh_mul(dag, f, g);
        nh_ex leibniz = nh_add(dag, nh_mul(dag, f, nh_diff(dag, g, x)), nh_mul(dag, g, nh_diff(dag, f, x)));
        nh_zero_verdict verdict = nh_normal_is_zero(dag, nh_sub(dag, nh_diff(dag, fg, x), leibniz), 0);
        char *text = nh_print_string(dag, fg);
        bool defined = !strstr(text, "nan");
        cr_expect(verdict == NH_ZERO || !defined, "Leibniz: %s", text);
        nh_ex xy = nh_diff(dag, nh_diff(dag, fg, x), y), yx = nh_diff(dag, nh_diff(dag, fg, y), x);
        verdict = nh_normal_is_zero(dag, nh_sub(dag, xy, yx), 0);
        cr_expect(verdict == NH_ZERO || !defined, "d2/dxdy: %s", text);
        nh_free(text);
        nh_dag_free(dag);
    }
}

/* A proof that has begun ends with the time limit, without a verdict; what is short is still done, so that results can be shown. */
Test(normal, behind_a_deadline_nothing_long_is_decided)
{
    static const char *const long_zero = "(a + b + x + y + sin(x) + exp(y))^12 - ((a + b + x)^2 + 2*(a + b + x)*(y + sin(x) + exp(y)) + (y + sin(x) + exp(y))^2)^6";
    nh_deadline_set(-1);
    cr_expect_eq(verdict_of("(a + b)^3*(sin(x)^2 + cos(x)^2) - (a + b)^2*(a + b)"), NH_ZERO);
    cr_expect_eq(verdict_of(long_zero), NH_TOO_LARGE);
    nh_deadline_set(INFINITY);
    cr_expect_eq(verdict_of(long_zero), NH_ZERO);
}
