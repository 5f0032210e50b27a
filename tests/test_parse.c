/* The language: every message with its place, text that reads well, and the round trip from expression to text and back. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "graph/dag.h"
#include "graph/parse.h"
#include "exact/normal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/print.h"
#include "random_expression.h"
#include "sweep.h"

/* ---- text that reads well ---- */

static const char *const PRINTED[][2] = {
    {"m/2*(x'^2+y'^2)", "m*(x'^2 + y'^2)/2"},
    {"-omega*v/(a*k^2)", "-omega*v/(a*k^2)"},
    {"sqrt(2*E/m)", "sqrt(2*E/m)"},
    {"1/cos(phi)^2", "1/cos(phi)^2"},
    {"exp(-a*t)", "exp(-a*t)"},
    {"x^(1/3)", "x^(1/3)"},
    {"(a+b)^n", "(a + b)^n"},
    {"-(a-b)", "b - a"},
    {"2^(1/2)", "sqrt(2)"},
    {"-phi'*x'/(a*k^2*cos(phi))", "-phi'*x'/(a*k^2*cos(phi))"},
    {"a*phi'^2*cos(phi) - phi'*x'*tan(phi)", "a*phi'^2*cos(phi) - phi'*x'*tan(phi)"},
    {"1/2*m*v^2 - m*g*z", "m*v^2/2 - m*g*z"},
    {"1/sqrt(2*m*E)", "1/sqrt(2*m*E)"},
    {"sqrt(x*y)", "sqrt(x*y)"},
    {"1/sqrt(x*y)", "1/sqrt(x*y)"},
    {"1 - x", "1 - x"},
    {"1/(1 - x)", "1/(1 - x)"},
    {"x^-2", "1/x^2"},
    {"x^-n", "x^(-n)"},
    {"x^(y^z)", "x^(y^z)"},
    {"(x^y)^z", "(x^y)^z"},
    {"2*(x + y)", "2*(x + y)"},
    {"(x - y)/2", "(x - y)/2"},
    {"-(x - y)/2*z", "z*(y - x)/2"},
    {"2/3*x*y^(3/2)", "2*x*y^(3/2)/3"},
    {"-x/(2*y)", "-x/(2*y)"},
    {"1/(2*y)", "1/(2*y)"},
    {"-1/2", "-1/2"},
    {"(-1/2)^n", "(-1/2)^n"},
    {"x + 1/2", "x + 1/2"},
    {"atan2(y', x')", "atan2(y', x')"},
    {"pi*r^2", "pi*r^2"},
    {"cos(phi/2 - pi/4)", "cos(phi/2 - pi/4)"},
    {"1e-20*x", "1e-20*x"},
    {"(1e-20)^n", "(1e-20)^n"},
    {"0.125*x", "x/8"},
    {"abs(x)^3", "x^2*abs(x)"},
    {"x' - y'*tan(theta)", "x' - y'*tan(theta)"},
    {"sqrt(1 - v^2/c^2)", "sqrt(1 - v^2/c^2)"},
    {"m*x*-1", "-m*x"},
    {"(a - b)*(c - d)*-1", "(b - a)*(c - d)"},
};

Test(parse, text_reads_well)
{
    for (size_t i = 0; i < sizeof PRINTED / sizeof *PRINTED; i++) {
        nh_dag *d = nh_dag_create();
        nh_ex e = parsed(d, PRINTED[i][0]);
        char *text = nh_print_string(d, e);
        cr_expect_str_eq(text, PRINTED[i][1], "%s is written %s, not %s", PRINTED[i][0], text, PRINTED[i][1]);
        cr_expect_eq(parsed(d, text), e, "%s", text);
        nh_free(text);
        nh_dag_free(d);
    }
}

/* ---- what texts mean ---- */

static const struct {
    const char *text;
    double value;
} VALUES[] = {
    {"2 + 3*4", 14}, {"2*3^2", 18}, {"-2^2", -4}, {"2^3^2", 512}, {"2^-1", 0.5}, {"(-2)^2", 4}, {"8/4/2", 1}, {"8 - 4 - 2", 2},
    {"--2", 2}, {"-+-2", 2}, {"2*-3", -6}, {"1e-3", 1e-3}, {".5", 0.5}, {"5.", 5}, {"1.5e2", 150}, {"1E+2", 100},
    {"0.1", 0.1}, {"1e300", 1e300}, {"1e-300", 1e-300}, {"123456789012345678901", 123456789012345678901.0},
    {"12345.678901234567", 12345.678901234567}, {"\t2\n+ 2\r ", 4}, {"sqrt(2)", 1.4142135623730951}, {"1.e1", 10},
    {"00012", 12}, {"0.00000000000000000000000001", 1e-26}, {"9223372036854775807", 9223372036854775807.0},
    {"-9223372036854775808", -9223372036854775808.0}, {"1000000000000000000000e-3", 1e18}, {"0e99999999999", 0},
    {"0.1e1000", -1}, {"2-1", 1}, {"2^(1/2)", 1.4142135623730951}, {"4^-.5", 0.5},
};

/* As formats.md promises: a decimal is exact, with or without a point or an exponent, up to 80 digits. */
Test(parse, long_decimals_are_exact)
{
    static const char *const same[][2] = {{"0.7071067811865475244", "7071067811865475244/10^19"}, {"3.14159265358979323846264338327950288", "314159265358979323846264338327950288/10^35"},
                                          {"123456789012345678901.5e-3", "1234567890123456789015/10^4"}, {"0.00000000000000000000123456789012345678", "123456789012345678/10^38"},
                                          {"1.000000000000000000000000", "1"}, {"0.10000000000000000000000000001", "1/10+1/10^29"}, {"5e-100", "5/10^100"}, {"000.50", "1/2"}, {"0.000", "0"}};
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof same / sizeof *same; i++) cr_expect_eq(parsed(d, same[i][0]), parsed(d, same[i][1]), "%s", same[i][0]);
    nh_dag_free(d);
}

Test(parse, values)
{
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof VALUES / sizeof *VALUES; i++) {
        nh_ex e = parsed(d, VALUES[i].text);
        double size = 0, value = naive_value(d, e, NULL, NULL, &size);
        if (VALUES[i].value == -1) cr_expect(isnan(value));
        else cr_expect_float_eq(value, VALUES[i].value, 2e-16 * fabs(VALUES[i].value), "%s", VALUES[i].text);
    }
    cr_expect(nh_num_short(nh_number_of(d, parsed(d, "0.1"))));
    cr_expect(nh_num_short(nh_number_of(d, parsed(d, "123456789.012345678"))));
    cr_expect(nh_num_short(nh_number_of(d, parsed(d, "2.385e-15"))));
    cr_expect(nh_num_exact(nh_number_of(d, parsed(d, "1e-30"))));
    cr_expect_eq(parsed(d, "1e-30*1e30"), nh_int(d, 1));
    cr_expect_eq(parsed(d, "123456789012345678901234567890/123456789012345678901234567890"), nh_int(d, 1));
    cr_expect_not(nh_num_exact(nh_number_of(d, parsed(d, "1.2345678901234567e-30")))); /* what some double was rounded to */
    nh_dag_free(d);
}

Test(parse, names)
{
    cr_expect(nh_is_name("x") && nh_is_name("_a1") && nh_is_name("Omega_2"));
    cr_expect_not(nh_is_name("") || nh_is_name("1x") || nh_is_name("x'") || nh_is_name("a b") || nh_is_name("\xcf\x86"));
    cr_expect(nh_is_reserved("sin") && nh_is_reserved("pi") && nh_is_reserved("t") && nh_is_reserved("sqrt") && nh_is_reserved("atan2"));
    cr_expect_not(nh_is_reserved("x") || nh_is_reserved("Sin") || nh_is_reserved("sinus"));
}

/* ---- messages ---- */

#define OPERAND "a number, a name or `(`"
#define ARGUMENT "does this belong to the argument of the function?"
#define LETTERS "names consist of the letters a-z, A-Z, digits and _"
#define EQUATION "an equation is expected only under constraints, forces, definitions and the map of velocities"
#define FOREIGN "a character that the expression language does not have; "
#define NAME64 "abcdefghijklmnopqrstuvwxyz_abcdefghijklmnopqrstuvwxyz_0123456789"

typedef struct {
    const char *text;
    size_t offset;
    const char *what, *hint;
} fault_case;

static const fault_case FAULTS[] = {
    {"", 0, "the expression ends here, but " OPERAND " was expected", ""},
    {"  ", 2, "the expression ends here, but " OPERAND " was expected", ""},
    {"x +", 3, "the expression ends here, but " OPERAND " was expected", ""},
    {"x*", 2, "the expression ends here, but " OPERAND " was expected", ""},
    {"x^", 2, "the expression ends here, but " OPERAND " was expected", ""},
    {"-", 1, "the expression ends here, but " OPERAND " was expected", ""},
    {"(x", 2, "the expression ends here, but an operator or `)` was expected", ""},
    {"sin(x", 5, "the expression ends here, but an operator or `)` was expected", ""},
    {"atan2(x", 7, "the expression ends here, but an operator or `,` was expected", ""},
    {"x)", 1, "`)` cannot stand here; an operator or the end of the expression was expected", ""},
    {"()", 1, "`)` cannot stand here; " OPERAND " was expected", ""},
    {"sin()", 4, "`)` cannot stand here; " OPERAND " was expected", ""},
    {"x + * y", 4, "`*` cannot stand here; " OPERAND " was expected", ""},
    {"x***2", 3, "`*` cannot stand here; " OPERAND " was expected", ""},
    {"x $ y", 2, "`$` cannot stand here; an operator or the end of the expression was expected", ""},
    {"x, y", 1, "`,` cannot stand here; an operator or the end of the expression was expected", ""},
    {"x\001", 1, "a control character cannot stand here; an operator or the end of the expression was expected", ""},
    {"\xe2\x82\x81 + 1", 0, FOREIGN OPERAND " was expected", LETTERS ": write `1`"},
    {"2*\xc3\xa4", 2, FOREIGN OPERAND " was expected", LETTERS},
    {"x = y", 2, "`=` cannot stand here; an operator or the end of the expression was expected", EQUATION},
    {"x == y", 2, "`=` cannot stand here; an operator or the end of the expression was expected", EQUATION},
    {"1e+", 3, "the expression ends here, but " OPERAND " was expected", ""},
    {"0x10", 1, "hexadecimal numbers are not read", "write `0*x10` for a product"},
    {"(x)(y)", 3, "an operator is missing before this", "write `(x)*(y)`"},
    {"(x)2", 3, "an operator is missing before this", "write `(x)*2`"},
    {"2 2", 2, "an operator is missing before this", "write `2*2`"},
    {"pi(2)", 2, "an operator is missing before this", "write `pi*(2)`"},
    {"x(y)", 1, "`x` is not a function: a product with a parenthesis has a sign or a blank between", "write `x*(y)`"},
    {"x y(z)", 3, "`y` is not a function: a product with a parenthesis has a sign or a blank between", "write `x y*(z)`"},
    {"a/b c", 4, "this product after a quotient can be read in two ways", "write `a/b*c`, or `a/(b*c)`"},
    {"1/2x", 3, "this product after a quotient can be read in two ways", "write `1/2*x`, or `1/(2*x)`"},
    {"sin x y", 6, ARGUMENT, "write `sin(x*y)`, or `sin(x)*y`"},
    {"sin x^2", 5, ARGUMENT, "write `sin(x^2)`, or `sin(x)^2`"},
    {"sin x/2", 5, ARGUMENT, "write `sin(x/2)`, or `sin(x)/2`"},
    {"sin^-1(x)", 0, "an exponent after the name of a function must be a number above 0", "write `asin(...)`, or `1/sin(...)`"},
    {"sqrt^n(x)", 0, "an exponent after the name of a function must be a number above 0", "write `sqrt(...)^(...)`"},
    {"1.2.3", 3, "a second decimal point in a number", ""},
    {"1..2", 2, "a second decimal point in a number", ""},
    {".", 0, "`.` cannot stand here; " OPERAND " was expected", ""},
    {"1e400", 0, "this number is too large", ""},
    {"1 + 1e-400", 4, "this number is too small: it would become 0", ""},
    {"1e-99999999999999999999", 0, "this number is too small: it would become 0", ""},
    {"2 + 1e300*1e300", 3, "a number in this expression has become too large", ""},
    {"1e300^2", 5, "this power has no finite value", ""},
    {"(1e300*x)^2", 9, "a number in this expression has become too large", ""},
    {"1e308*x + 1e308*x", 0, "a number in this expression has become too large", ""},
    {"sin", 3, "`sin` is a function; `(` was expected after it", "write `sin(...)`"},
    {"sin(x, y)", 5, "`sin` takes one argument", ""},
    {"sqrt(x, y)", 6, "`sqrt` takes one argument", ""},
    {"atan2(x)", 7, "`atan2` takes two arguments", ""},
    {"atan2(x, y, 1)", 10, "`atan2` takes two arguments", ""},
    {"1 + log(0)", 4, "`log` has no finite value here", ""},
    {"acos(1.5)", 0, "`acos` has no finite value here", ""},
    {"2 + sqrt(-2)", 4, "the square root of a negative number", ""},
    {"0^-1", 1, "this power has no finite value", ""},
    {"(-8)^(1/3)", 4, "this power has no finite value", ""},
    {"x/0", 1, "division by zero", ""},
    {"x/(y - y)*2", 1, "division by zero", ""},
    {"1 + x''", 4, "second derivatives cannot be used: a system is written with coordinates and velocities", ""},
    {"1 + unknown*2", 4, "unknown name `unknown`", "write `1 + unknow*n*2`"},
    {"1 + unknown'", 4, "unknown name `unknown'`", "write `1 + unknow*n'`"},
    {"1 + mispelt", 4, "a word with an error", "misspelt"},
    {NAME64, 0, "a name longer than 63 characters", ""},
};

/* Everything is a name but `unknown`; for `mispelt` the caller has an explanation. */
static bool resolve(void *context, const char *name, nh_ex *out, nh_parse_fault *fault)
{
    if (!strncmp(name, "unknown", 7)) return false;
    if (!strcmp(name, "mispelt")) {
        snprintf(fault->what, sizeof fault->what, "a word with an error");
        snprintf(fault->hint, sizeof fault->hint, "misspelt");
        return false;
    }
    snprintf(fault->hint, sizeof fault->hint, "left over"); /* must not show up in later messages */
    *out = nh_symbol(context, name);
    return true;
}

static void expect_fault(const nh_parse_fault *fault, const fault_case *expected)
{
    cr_expect_str_eq(fault->what, expected->what, "%s: %s", expected->text, fault->what);
    cr_expect_str_eq(fault->hint, expected->hint, "%s: %s", expected->text, fault->hint);
    cr_expect_eq(fault->offset, expected->offset, "%s: at %zu", expected->text, fault->offset);
}

Test(parse, messages)
{
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof FAULTS / sizeof *FAULTS; i++) {
        nh_ex e;
        nh_parse_fault fault;
        cr_expect_not(nh_parse(d, FAULTS[i].text, resolve, d, &e, &fault), "%s", FAULTS[i].text);
        expect_fault(&fault, &FAULTS[i]);
    }
    nh_dag_free(d);
}

static const fault_case EQUATION_FAULTS[] = {
    {"x + y", 5, "an equation `... = ...` was expected, but there is no `=`", "write `x + y = 0`"},
    {"x == y", 3, "an equation is written with a single `=`", ""},
    {"x = y = z", 6, "`=` cannot stand here; an operator or the end of the expression was expected",
     "an equation has one `=` between two expressions"},
    {"= y", 0, "`=` cannot stand here; " OPERAND " was expected", "an equation has one `=` between two expressions"},
    {"x =", 3, "the expression ends here, but " OPERAND " was expected", ""},
    {"x) = y", 1, "`)` cannot stand here; an operator or `=` was expected", ""},
};

Test(parse, equations)
{
    nh_dag *d = nh_dag_create();
    nh_ex lhs, rhs;
    nh_parse_fault fault;
    cr_assert(nh_parse_equation(d, " y' = x'*tan(phi) ", resolve, d, &lhs, &rhs, &fault));
    cr_expect_eq(lhs, parsed(d, "y'"));
    cr_expect_eq(rhs, parsed(d, "x'*tan(phi)"));
    for (size_t i = 0; i < sizeof EQUATION_FAULTS / sizeof *EQUATION_FAULTS; i++) {
        cr_expect_not(nh_parse_equation(d, EQUATION_FAULTS[i].text, resolve, d, &lhs, &rhs, &fault));
        expect_fault(&fault, &EQUATION_FAULTS[i]);
    }
    nh_dag_free(d);
}

/* ---- hostile texts ---- */

/* n times `open`, x, n times `close`. */
static char *nested(size_t n, const char *open, const char *close)
{
    nh_text t;
    nh_text_init(&t);
    for (size_t i = 0; i < n; i++) nh_text_add(&t, open);
    nh_text_add(&t, "x");
    for (size_t i = 0; i < n; i++) nh_text_add(&t, close);
    return t.data;
}

Test(parse, nesting_is_limited)
{
    static const char *const shell[][2] = {{"(", ")"}, {"-", ""}, {"+", ""}, {"x^", ""}, {"x^(", ")"}, {"sin(", ")"}, {"sqrt(", ")"},
                                           {"atan2(x, ", ")"}, {"atan2(", ", x)"}};
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof shell / sizeof *shell; i++) {
        static const size_t levels[] = {200, 201, 100000};
        for (size_t k = 0; k < 3; k++) {
            nh_ex e;
            nh_parse_fault fault;
            char *text = nested(levels[k], shell[i][0], shell[i][1]);
            bool good = nh_parse(d, text, resolve, d, &e, &fault);
            cr_expect_eq(good, k == 0, "%zu of %s", levels[k], shell[i][0]);
            if (!good) cr_expect_str_eq(fault.what, "nested deeper than 200 levels");
            nh_free(text);
        }
    }
    nh_dag_free(d);
}

/* What could be read is printed so that it can be read again: a^b^c as a^(b^c). */
Test(parse, towers_of_powers_come_back)
{
    nh_dag *d = nh_dag_create();
    nh_parse_fault fault;
    nh_ex e, back;
    char *tower = nested(200, "x^", "");
    cr_assert(nh_parse(d, tower, resolve, d, &e, &fault));
    char *text = nh_print_string(d, e);
    cr_assert(strstr(text, "...") || nh_parse(d, text, resolve, d, &back, &fault), "%s", fault.what);
    cr_expect(strstr(text, "...") || back == e);
    nh_free(text);
    nh_free(tower);
    tower = nested(120, "x^", "");
    cr_assert(nh_parse(d, tower, resolve, d, &e, &fault));
    text = nh_print_string(d, e);
    cr_assert(!strstr(text, "...") && nh_parse(d, text, resolve, d, &back, &fault), "%s", fault.what);
    cr_expect_eq(back, e);
    nh_free(text);
    nh_free(tower);
    nh_dag_free(d);
}

/* Deeper than any stack, through names that stand for expressions. */
Test(parse, deep_expressions_are_cut_off)
{
    nh_dag *d = nh_dag_create();
    nh_ex e = nh_symbol(d, "x");
    for (int i = 0; i < 100000; i++) e = nh_call(d, i % 2 ? NH_SIN : NH_EXP, e);
    char *text = nh_print_string(d, e);
    cr_expect_lt(strlen(text), 10000);
    cr_expect(strstr(text, "sin(exp(...))"));
    nh_free(text);
    nh_dag_free(d);
}

/* A hundred thousand operands of every operator. */
Test(parse, long_texts_take_linear_time, PLAIN_ONLY)
{
    nh_dag *d = nh_dag_create();
    static const char *const operator[] = {" + ", " - ", "*", "/"};
    for (size_t k = 0; k < 4; k++) {
        nh_text t;
        nh_text_init(&t);
        for (int i = 0; i < 100000; i++) nh_text_addf(&t, "%ssin(%d*x)", i ? operator[k] : "", i % 50000 + 1);
        nh_ex e = parsed(d, t.data);
        if (k < 2) e = nh_child(d, e, 0); /* 2 or -2 times the sum */
        cr_expect_eq(nh_arity(d, e), k % 2 ? 49999 : 50000, "%s", operator[k]);
        nh_text_clear(&t);
    }
    nh_dag_free(d);
}

/* Any bytes: a clean failure or an expression, never a crash. */
Test(parse, noise)
{
    static const char alphabet[] = "xy'()+-*/^.,0123e =sincoqrtalgpb\n\xcf";
    source s = source_create(2385);
    for (int i = 0; i < (sweep_whole() ? 100000 : sweep_sanitized() ? 10000 : 30000); i++) {
        char text[40];
        int n = random_below(&s, 39);
        for (int k = 0; k < n; k++) text[k] = alphabet[random_below(&s, (int)sizeof alphabet - 1)];
        text[n] = 0;
        nh_ex e, rhs;
        nh_parse_fault fault;
        if (nh_parse(s.dag, text, any_name, s.dag, &e, &fault)) {
            char *printed = nh_print_string(s.dag, e);
            cr_assert_eq(parsed(s.dag, printed), e, "%s is written %s", text, printed);
            nh_free(printed);
        } else {
            cr_assert_leq(fault.offset, strlen(text));
            cr_assert(fault.what[0]);
        }
        nh_parse_equation(s.dag, text, any_name, s.dag, &e, &rhs, &fault);
    }
    nh_dag_free(s.dag);
}

/* ---- round trips ---- */

Test(parse, exact_expressions_come_back_identical)
{
    for (uint64_t seed = 1; seed <= 10000; seed++) {
        if (!sweep_tries(seed, 1, 5)) continue;
        source s = source_create(seed);
        nh_ex e = random_expression(&s, 2 + (int)(seed % 4));
        char *text = nh_print_string(s.dag, e);
        nh_parse_fault fault = {0};
        nh_ex back;
        bool good = nh_parse(s.dag, text, any_name, s.dag, &back, &fault);
        cr_assert(good, "%s: %s", text, fault.what);
        char *again = nh_print_string(s.dag, back);
        cr_assert_eq(back, e, "%s\n comes back as %s", text, again);
        nh_free(again);
        nh_free(text);
        nh_dag_free(s.dag);
    }
}

/* p/q of up to 18 digits each, with powers of 2 and 5 that may cancel. */
static nh_num long_ratio(source *s)
{
    int64_t part[2] = {1 + random_below(s, 999), 1};
    for (int i = 0; i < 2; i++)
        for (int k = random_below(s, 14); k > 0; k--) part[i] *= random_below(s, 2) ? 5 : 10;
    return nh_num_ratio(part[0], part[1]);
}

/* A long factor is not multiplied into a sum of long coefficients: the products would be rounded. */
Test(parse, long_numbers_stay_exact)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 5000; seed++) {
        source s = source_create(seed);
        nh_num c[SYMBOLS];
        for (size_t i = 0; i < SYMBOLS; i++) c[i] = long_ratio(&s);
        nh_ex e = nh_mul(s.dag, nh_number(s.dag, long_ratio(&s)), nh_linear(s.dag, SYMBOLS, c, s.symbol));
        if (nh_is_exact(s.dag, e)) {
            char *text = nh_print_string(s.dag, e);
            nh_ex back = parsed(s.dag, text); /* at the limit of 64 bits perhaps not taken together in the same way */
            cr_assert(back == e || (nh_is_exact(s.dag, back) && nh_normal_is_zero(s.dag, nh_sub(s.dag, back, e), 1000) == NH_ZERO), "%s", text);
            nh_free(text);
            compared++;
        }
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, 1000);
}

Test(parse, inexact_expressions_come_back_with_their_value)
{
    size_t compared = 0;
    for (uint64_t seed = 1; seed <= 10000; seed++) {
        source s = source_create(seed);
        s.inexact = true;
        nh_ex e = random_expression(&s, 1 + (int)(seed % 4));
        char *text = nh_print_string(s.dag, e);
        nh_ex back = parsed(s.dag, text);
        double at[SYMBOLS], size = 0;
        for (int i = 0; i < SYMBOLS; i++) at[i] = random_real(&s, 0.2, 1.7);
        double value = naive_value(s.dag, e, s.symbol, at, &size);
        if (isfinite(value) && size < 1e30) {
            cr_assert_float_eq(naive_value(s.dag, back, s.symbol, at, &size), value, 1e-9 * (fabs(value) + 1e-6 * size), "%s", text);
            compared++;
        }
        if (nh_kind_of(s.dag, e) == NH_NUMBER)
            cr_assert_eq(nh_num_value(nh_number_of(s.dag, back)), nh_num_value(nh_number_of(s.dag, e)), "%s", text);
        nh_free(text);
        nh_dag_free(s.dag);
    }
    cr_expect_gt(compared, 5000);
}
