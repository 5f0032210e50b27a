#include <ctype.h>
#include <inttypes.h>
#include <string.h>

#include "base/memory.h"
#include "expr/typeset_code.h"

enum { in_sum, in_product, in_power };

static void put(nh_dag *d, nh_ex e, int context, nh_text *out);

static const char *const greek[] = {"alpha", "beta", "gamma", "delta", "epsilon", "zeta", "eta", "theta", "iota", "kappa", "lambda", "mu", "nu", "xi", "rho", "sigma", "tau",
                                    "upsilon", "phi", "chi", "psi", "omega", "varphi", "vartheta", "Gamma", "Delta", "Theta", "Lambda", "Xi", "Sigma", "Phi", "Psi", "Omega"};

static void put_stem(const char *stem, size_t length, nh_text *out)
{
    for (size_t i = 0; i < sizeof greek / sizeof *greek; i++)
        if (strlen(greek[i]) == length && !strncmp(greek[i], stem, length)) {
            nh_text_addf(out, "\\%s", greek[i]);
            return;
        }
    if (length > 1) nh_text_add(out, "\\mathrm{");
    nh_text_add_n(out, stem, length);
    if (length > 1) nh_text_add(out, "}");
}

/* stem, digits or what follows an underscore as an index, a prime as a dot above the stem */
void nh_typeset_latex_name(const char *name, nh_text *out)
{
    size_t length = strcspn(name, "'"), stem = strcspn(name, "_'");
    bool dotted = name[length] == '\'', index = stem < length;
    size_t tail = index ? stem + 1 : stem;
    while (!index && stem > 1 && isdigit((unsigned char)name[stem - 1])) stem--;
    if (!index) tail = stem;
    if (dotted) nh_text_add(out, "\\dot{");
    put_stem(name, stem, out);
    if (dotted) nh_text_add(out, "}");
    if (tail >= length) return;
    nh_text_add(out, "_{");
    if (isdigit((unsigned char)name[tail])) {
        nh_text_add_n(out, name + tail, length - tail);
    } else {
        char *rest = nh_strdup(name + tail);
        rest[length - tail] = 0;
        nh_typeset_latex_name(rest, out);
        nh_free(rest);
    }
    nh_text_add(out, "}");
}

static void put_num(nh_num x, nh_text *out)
{
    char text[40];
    if (x.q > 1) {
        nh_text_addf(out, "%s\\frac{%" PRId64 "}{%" PRId64 "}", x.p < 0 ? "-" : "", x.p < 0 ? -x.p : x.p, x.q);
        return;
    }
    nh_text_number(nh_num_value(x), text, sizeof text);
    char *e = strchr(text, 'e');
    if (e) *e = 0;
    nh_text_add(out, text);
    if (e) nh_text_addf(out, " \\cdot 10^{%s}", e + 1);
}

/* `alone`: nothing stands beside it, so that a sum needs no parentheses. */
static void put_power(nh_dag *d, nh_ex base, nh_num power, bool alone, nh_text *out)
{
    if (nh_num_is(power, 1)) {
        put(d, base, alone ? in_sum : in_product, out);
    } else if (power.p == 1 && power.q == 2) {
        nh_text_add(out, "\\sqrt{");
        put(d, base, in_sum, out);
        nh_text_add(out, "}");
    } else {
        put(d, base, in_power, out);
        nh_text_add(out, "^{");
        put_num(power, out);
        nh_text_add(out, "}");
    }
}

static size_t put_side(nh_dag *d, nh_ex e, bool below, size_t written, bool alone, nh_text *out)
{
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex exponent = nh_exponent_of(d, e, i), base = nh_child(d, e, i);
        bool numeric = nh_kind_of(d, exponent) == NH_NUMBER;
        nh_num power = numeric ? nh_number_of(d, exponent) : nh_num_int(1);
        if ((numeric && nh_num_value(power) < 0) != below) continue;
        if (written++) nh_text_add(out, " ");
        if (numeric) {
            put_power(d, base, below ? nh_num_mul(power, nh_num_int(-1)) : power, alone, out);
        } else {
            put(d, base, in_power, out);
            nh_text_add(out, "^{");
            put(d, exponent, in_sum, out);
            nh_text_add(out, "}");
        }
    }
    return written;
}

/* |c| times the factors */
static void put_product(nh_dag *d, nh_ex e, nh_num c, nh_text *out)
{
    size_t below = 0, n = nh_arity(d, e);
    for (size_t i = 0; i < n; i++) {
        nh_ex exponent = nh_exponent_of(d, e, i);
        below += nh_kind_of(d, exponent) == NH_NUMBER && nh_num_value(nh_number_of(d, exponent)) < 0;
    }
    nh_num top = nh_num_short(c) ? nh_num_int(c.p) : c, bottom = nh_num_int(nh_num_short(c) ? c.q : 1);
    bool fraction = below || !nh_num_is(bottom, 1);
    if (fraction) nh_text_add(out, "\\frac{");
    bool number = !nh_num_is(top, 1) || below == n;
    if (number) put_num(top, out);
    put_side(d, e, false, number, fraction && !number && n - below == 1, out);
    if (!fraction) return;
    nh_text_add(out, "}{");
    if (!nh_num_is(bottom, 1)) put_num(bottom, out);
    put_side(d, e, true, !nh_num_is(bottom, 1), nh_num_is(bottom, 1) && below == 1, out);
    nh_text_add(out, "}");
}

static void put_term(nh_dag *d, nh_num c, nh_ex e, bool first, nh_text *out)
{
    nh_ex scaled = nh_mul(d, nh_number(d, c), e);
    nh_num k = nh_kind_of(d, scaled) == NH_PRODUCT ? nh_constant_of(d, scaled) : nh_num_int(1);
    bool minus = nh_num_value(k) < 0;
    nh_text_add(out, first ? (minus ? "-" : "") : minus ? " - " : " + ");
    if (nh_kind_of(d, scaled) == NH_PRODUCT) put_product(d, scaled, minus ? nh_num_mul(k, nh_num_int(-1)) : k, out);
    else put(d, scaled, in_product, out);
}

static void put_sum(nh_dag *d, nh_ex e, nh_text *out)
{
    nh_num constant = nh_constant_of(d, e);
    for (size_t i = 0; i < nh_arity(d, e); i++) put_term(d, nh_coefficient_of(d, e, i), nh_child(d, e, i), i == 0, out);
    if (nh_num_is(constant, 0)) return;
    bool minus = nh_num_value(constant) < 0;
    nh_text_add(out, minus ? " - " : " + ");
    put_num(minus ? nh_num_mul(constant, nh_num_int(-1)) : constant, out);
}

static void put_function(nh_dag *d, nh_ex e, nh_text *out)
{
    static const char *const own[] = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "exp", "log"};
    const char *name = nh_function_name(nh_function_of(d, e));
    bool known = false;
    if (nh_function_of(d, e) == NH_PI) {
        nh_text_add(out, "\\pi");
        return;
    }
    for (size_t i = 0; i < sizeof own / sizeof *own; i++) known |= !strcmp(name, own[i]);
    nh_text_addf(out, known ? "\\%s" : "\\operatorname{%s}", name);
    nh_text_add(out, "\\left(");
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        if (i) nh_text_add(out, ", ");
        put(d, nh_child(d, e, i), in_sum, out);
    }
    nh_text_add(out, "\\right)");
}

static void put(nh_dag *d, nh_ex e, int context, nh_text *out)
{
    nh_kind kind = nh_kind_of(d, e);
    bool minus = kind == NH_PRODUCT && nh_num_value(nh_constant_of(d, e)) < 0;
    bool wrap = (kind == NH_SUM && context > in_sum) || (kind == NH_PRODUCT && (context == in_power || (minus && context > in_sum)))
                || (kind == NH_NUMBER && context > in_sum && (nh_num_value(nh_number_of(d, e)) < 0 || (context == in_power && nh_number_of(d, e).q != 1)))
                || (kind == NH_FUNCTION && context == in_power);
    if (wrap) nh_text_add(out, "\\left(");
    if (kind == NH_NUMBER) put_num(nh_number_of(d, e), out);
    else if (kind == NH_SYMBOL) nh_typeset_latex_name(nh_name_of(d, e), out);
    else if (kind == NH_SUM) put_sum(d, e, out);
    else if (kind == NH_FUNCTION) put_function(d, e, out);
    else put_term(d, nh_num_int(1), e, true, out);
    if (wrap) nh_text_add(out, "\\right)");
}

void nh_typeset_latex(nh_dag *d, nh_ex e, nh_text *out) { put(d, e, in_sum, out); }
