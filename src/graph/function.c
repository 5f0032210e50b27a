/* function: calls of functions in canonical form: values at numbers, signs of odd and even functions. */
#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "base/text.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/dag_internal.h"

#define NAMED(f, name, arity, arguments) [NH_##f] = {name, arity, 0, -1, -1, NULL, arguments}
#define PAIR(f, name, arity, arguments)                                                                                \
    NAMED(f, name, arity, arguments), NAMED(f##_PRIME, name "_prime", arity, arguments)

#define X(id, name, parity, at_zero, at_one) [NH_##id] = {#name, 1, parity, at_zero, at_one, name},
/* The members of NH_ELEMENTARY_TABLE. */
static const struct {
    const char *name;
    int arity, parity; /* parity: -1 odd, 1 even, 0 neither */
    int at_zero, at_one;
    double (*f)(double);
    const char *arguments; /* of a named function */
} table[NH_FUNCTION_COUNT] = {
    NH_ELEMENTARY_TABLE(X)[NH_ABS] = {"abs", 1, 1, 0, 1, fabs},
    [NH_SIGN] = {"sign", 1, -1, 0, 1, NULL},
    [NH_ATAN2] = {"atan2", 2, 0, -1, -1, NULL},
    [NH_PI] = {"pi", 0, 0, -1, -1, NULL},
    PAIR(LEGENDRE_P, "legendre_p", 2, "n, x"),
    PAIR(LEGENDRE_Q, "legendre_q", 2, "n, x"),
    PAIR(HYP2F1, "hyp2f1", 4, "a, b, c, x"),
    PAIR(GAUSS_F, "gauss_f", 4, "s, p, c, x"),
    PAIR(RIEMANN_C, "riemann_c", 4, "a, b, c, x"),
    PAIR(RIEMANN_S, "riemann_s", 4, "a, b, c, x"),
    PAIR(HYP1F1, "hyp1f1", 3, "a, b, x"),
    PAIR(HYPERU, "hyperu", 3, "a, b, x"),
    PAIR(BESSEL_J, "bessel_j", 2, "n, x"),
    PAIR(BESSEL_Y, "bessel_y", 2, "n, x"),
    PAIR(BESSEL_I, "bessel_i", 2, "n, x"),
    PAIR(BESSEL_K, "bessel_k", 2, "n, x"),
    PAIR(AIRY_AI, "airy_ai", 1, "x"),
    PAIR(AIRY_BI, "airy_bi", 1, "x"),
    NAMED(ELLIPTIC_K, "elliptic_k", 1, "m"),
    NAMED(ELLIPTIC_E, "elliptic_e", 1, "m"),
    NAMED(ELLIPTIC_F, "elliptic_f", 2, "u, m"),
    NAMED(ELLIPTIC_EINC, "elliptic_einc", 2, "u, m"),
    NAMED(ELLIPTIC_PI, "elliptic_pi", 3, "n, u, m"),
    NAMED(UNSPECIFIED, "an unspecified function", 3, "f, n, x"), /* no name of the language */
    NAMED(TABLE, "a function of a table", 4, "f, n, x, y"),      /* likewise */
};
#undef X

const char *nh_function_name(nh_function f) { return table[f].name; }
size_t nh_function_arity(nh_function f) { return (size_t)table[f].arity; }
const char *nh_function_arguments(nh_function f) { return table[f].arguments; }
bool nh_is_named_function(nh_function f) { return table[f].arguments != NULL; }
bool nh_is_incomplete_elliptic(nh_function f)
{
    return f == NH_ELLIPTIC_F || f == NH_ELLIPTIC_EINC || f == NH_ELLIPTIC_PI;
}

size_t nh_function_constants(nh_function f)
{
    if (f == NH_TABLE) return 2;
    return table[f].arguments && (f < NH_ELLIPTIC_K || f == NH_UNSPECIFIED) ? (size_t)table[f].arity - 1 : 0;
}

const char *nh_function_nearest(const char *word)
{
    const char *list[NH_FUNCTION_COUNT + 1] = {"sqrt"};
    for (int f = 0; f < NH_FUNCTION_COUNT; f++) list[1 + f] = nh_function_name((nh_function)f);
    return nh_text_nearest(word, list, NH_FUNCTION_COUNT + 1);
}

/* Names of functions in other languages, and what to write instead. */
const char *nh_function_elsewhere(const char *name)
{
    static const char *const other[][2] = {
        {"ln", "the natural logarithm is written `log`"},
        {"cot", "write 1/tan(...)"},
        {"sec", "write 1/cos(...)"},
        {"csc", "write 1/sin(...)"},
        {"diff", "a velocity is written with a prime: x'"},
        {"Derivative", "a velocity is written with a prime: x'"},
        {"besselj", "write bessel_j(n, x)"},
        {"jv", "write bessel_j(n, x)"},
        {"bessely", "write bessel_y(n, x)"},
        {"yv", "write bessel_y(n, x)"},
        {"besseli", "write bessel_i(n, x)"},
        {"iv", "write bessel_i(n, x)"},
        {"besselk", "write bessel_k(n, x)"},
        {"kv", "write bessel_k(n, x)"},
        {"airy", "write airy_ai(x) or airy_bi(x)"},
        {"legendre", "write legendre_p(n, x)"},
        {"hypergeom", "write hyp2f1(a, b, c, x) or hyp1f1(a, b, x)"},
        {"ellipk", "write elliptic_k(m) with the parameter m, the square of the modulus"},
        {"ellipe", "write elliptic_e(m) with the parameter m, the square of the modulus"},
        {"ellippi", "write elliptic_pi(n, u, m) with 1 - n sin(u)^2 below and m, the square of the modulus"},
        {"kummer_m", "write hyp1f1(a, b, x)"},
        {"kummer_u", "write hyperu(a, b, x)"},
        {"sgn", "write x/abs(x)"},
        {"sign", "write x/abs(x)"},
        {"max", "write (a + b + abs(a - b))/2"},
        {"heaviside", "write (1 + x/abs(x))/2"},
        {"min", "write (a + b - abs(a - b))/2"},
    };
    for (size_t i = 0; i < sizeof other / sizeof *other; i++)
        if (!strcmp(name, other[i][0])) return other[i][1];
    return NULL;
}

/* Of x and -x exactly one looks negative (sums have a positive first coefficient). */
static bool looks_negative(const nh_dag *dag, nh_ex e)
{
    if (nh_kind_of(dag, e) == NH_NUMBER) return nh_num_value(nh_number_of(dag, e)) < 0;
    return nh_kind_of(dag, e) == NH_PRODUCT && nh_num_value(nh_constant_of(dag, e)) < 0;
}

/* sin(k pi/12) where it is a number or half a root. */
static bool sine_of_twelfths(nh_dag *dag, int64_t k, nh_ex *out)
{
    int64_t turn = (k % 24 + 24) % 24, up = turn % 12, at = up > 6 ? 12 - up : up;
    nh_num sign = nh_num_int(turn < 12 ? 1 : -1);
    if (at == 1 || at == 5) return false;
    if (at == 0 || at == 6) *out = nh_number(dag, at ? sign : nh_num_int(0));
    else if (at == 2) *out = nh_number(dag, nh_num_mul(sign, nh_num_inv(nh_num_int(2))));
    else
        *out = nh_mul(dag, nh_number(dag, nh_num_mul(sign, nh_num_inv(nh_num_int(2)))),
                      nh_sqrt(dag, nh_int(dag, at == 3 ? 2 : 3)));
    return true;
}

/* e = c inner. */
static nh_ex without_factor(const nh_dag *dag, nh_ex e, nh_num *c)
{
    *c = nh_num_int(1);
    if (nh_kind_of(dag, e) != NH_PRODUCT || nh_arity(dag, e) != 1 || !nh_is_number(dag, nh_exponent_of(dag, e, 0), 1))
        return e;
    *c = nh_constant_of(dag, e);
    return nh_child(dag, e, 0);
}

static bool is_pi(const nh_dag *dag, nh_ex e)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == NH_PI;
}

/* The sine and the cosine of c pi, where they are known: wheels stand at angles of 2 pi/3. */
static bool known_turn(nh_dag *dag, nh_num c, nh_ex *sine, nh_ex *cosine)
{
    if (c.q < 1 || c.q > 6 || 12 % c.q != 0) return false;
    int64_t twelfths = c.p % (2 * c.q) * (12 / c.q);
    return sine_of_twelfths(dag, twelfths, sine) && sine_of_twelfths(dag, twelfths + 6, cosine);
}

bool nh_split_turn(nh_dag *dag, nh_ex a, nh_ex *rest, nh_ex *sine, nh_ex *cosine)
{
    nh_num c, factor;
    nh_ex inner = without_factor(dag, a, &c);
    for (size_t i = 0; nh_kind_of(dag, inner) == NH_SUM && i < nh_arity(dag, inner); i++) {
        if (!is_pi(dag, without_factor(dag, nh_child(dag, inner, i), &factor))) continue;
        c = nh_num_mul(nh_num_mul(c, factor), nh_coefficient_of(dag, inner, i));
        *rest = nh_sub(dag, a, nh_mul(dag, nh_number(dag, c), nh_pi(dag)));
        return known_turn(dag, c, sine, cosine);
    }
    return false;
}

static bool number_value(nh_dag *dag, nh_function f, nh_ex a, nh_ex *out)
{
    nh_num x = nh_number_of(dag, a);
    if (f == NH_SIGN || f == NH_ABS) {
        double v = nh_num_value(x);
        *out = f == NH_ABS ? nh_number(dag, v < 0 ? nh_num_mul(x, nh_num_int(-1)) : x) : nh_int(dag, (v > 0) - (v < 0));
        return true;
    }
    if (nh_num_is(x, 0) && table[f].at_zero >= 0) {
        *out = nh_int(dag, table[f].at_zero);
        return true;
    }
    if (nh_num_is(x, 1) && table[f].at_one >= 0) {
        *out = nh_int(dag, table[f].at_one);
        return true;
    }
    if (!table[f].f) return false;
    double y = table[f].f(nh_num_value(x));
    *out = nh_real(dag, y);
    return !nh_num_exact(x) || !isfinite(y); /* log(0) is no number; sin(2) stays exact */
}

static bool is_call(const nh_dag *dag, nh_ex e, nh_function f)
{
    return nh_kind_of(dag, e) == NH_FUNCTION && nh_function_of(dag, e) == f;
}

bool nh_is_infinite_tangent(nh_dag *dag, nh_ex e)
{
    nh_ex sine, cosine;
    nh_num turn;
    return is_call(dag, e, NH_TAN) && is_pi(dag, without_factor(dag, nh_child(dag, e, 0), &turn)) &&
           known_turn(dag, turn, &sine, &cosine) && nh_is_zero(dag, cosine);
}

/* sin(2 atan u) and cos(2 atan u) */
static bool of_twice_an_arctangent(nh_dag *dag, nh_function f, nh_ex a, nh_ex *out)
{
    nh_num twice;
    nh_ex inner = without_factor(dag, a, &twice);
    if ((f != NH_SIN && f != NH_COS) || !nh_num_is(twice, 2) || !is_call(dag, inner, NH_ATAN)) return false;
    nh_ex u = nh_child(dag, inner, 0), one = nh_int(dag, 1), square = nh_powi(dag, u, 2);
    nh_ex above = f == NH_SIN ? nh_mul(dag, nh_int(dag, 2), u) : nh_sub(dag, one, square);
    *out = nh_div(dag, above, nh_add(dag, one, square));
    return true;
}

/* A product without its positive numbers and roots of numbers. */
static nh_ex without_numbers(nh_dag *dag, nh_ex a)
{
    if (nh_kind_of(dag, a) != NH_PRODUCT || nh_num_value(nh_constant_of(dag, a)) <= 0) return a;
    nh_ex rest = nh_int(dag, 1);
    for (size_t i = 0; i < nh_arity(dag, a); i++) {
        nh_ex base = nh_child(dag, a, i);
        bool positive = nh_kind_of(dag, base) == NH_NUMBER && nh_num_value(nh_number_of(dag, base)) > 0;
        if (!positive) rest = nh_mul(dag, rest, nh_pow(dag, base, nh_exponent_of(dag, a, i)));
    }
    return rest;
}

nh_ex nh_call(nh_dag *dag, nh_function f, nh_ex a)
{
    nh_ex e, sine, cosine;
    nh_num turn;
    if (nh_kind_of(dag, a) == NH_NUMBER && number_value(dag, f, a, &e)) return e;
    if (table[f].parity && looks_negative(dag, a)) {
        e = nh_call(dag, f, nh_neg(dag, a));
        return table[f].parity < 0 ? nh_neg(dag, e) : e;
    }
    if ((f == NH_SIN || f == NH_COS || f == NH_TAN) && is_pi(dag, without_factor(dag, a, &turn)) &&
        known_turn(dag, turn, &sine, &cosine)) {
        if (f != NH_TAN) return f == NH_SIN ? sine : cosine;
        if (!nh_is_zero(dag, cosine)) return nh_div(dag, sine, cosine);
    }
    if (f == NH_SIGN && (e = without_numbers(dag, a)) != a) return nh_call(dag, f, e);
    if (of_twice_an_arctangent(dag, f, a, &e)) return e;
    if (f == NH_EXP && is_call(dag, a, NH_LOG)) return nh_child(dag, a, 0);
    if (f == NH_LOG && is_call(dag, a, NH_EXP)) return nh_child(dag, a, 0);
    return nh_dag_intern(dag, NH_FUNCTION, f, 1, &a);
}

nh_ex nh_call2(nh_dag *dag, nh_function f, nh_ex a, nh_ex b)
{
    uint32_t arg[2] = {a, b};
    return nh_dag_intern(dag, NH_FUNCTION, f, 2, arg);
}

nh_ex nh_call_any(nh_dag *dag, nh_function f, const nh_ex *argument)
{
    size_t at = (size_t)table[f].arity - 2; /* the amplitude, in which elliptic integrals are odd */
    if (nh_is_incomplete_elliptic(f) && looks_negative(dag, argument[at])) {
        nh_ex other[NH_MOST_ARGUMENTS];
        memcpy(other, argument, (size_t)table[f].arity * sizeof *other);
        other[at] = nh_neg(dag, other[at]);
        return nh_neg(dag, nh_call_any(dag, f, other));
    }
    return table[f].arity == 1 ? nh_call(dag, f, argument[0])
                               : nh_dag_intern(dag, NH_FUNCTION, f, (size_t)table[f].arity, argument);
}

nh_ex nh_pi(nh_dag *dag) { return nh_dag_intern(dag, NH_FUNCTION, NH_PI, 0, NULL); }
