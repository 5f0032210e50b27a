#include <inttypes.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "document/typeset_code.h"

typedef struct {
    nh_dag *dag;
    nh_text *out;
    uint32_t *uses;   /* per node */
    size_t *name;     /* per node: 1 + number of its temporary; 0: none */
    size_t size;      /* nodes when the tables were made */
} writer;

static void put(writer *w, nh_ex e);

void nh_typeset_c_name(const char *name, nh_text *out)
{
    static const char *const keywords[] = {"auto", "break", "case", "char", "const", "continue", "default", "do", "double", "else", "enum", "extern", "float", "for", "goto",
                                           "if", "inline", "int", "long", "register", "restrict", "return", "short", "signed", "sizeof", "static", "struct", "switch",
                                           "typedef", "union", "unsigned", "void", "volatile", "while"};
    size_t length = strcspn(name, "'");
    nh_text_add_n(out, name, length);
    if (name[length]) nh_text_add(out, "_dot");
    for (size_t i = 0; i < sizeof keywords / sizeof *keywords; i++)
        if (!strcmp(name, keywords[i])) nh_text_add(out, "_");
}

static void put_double(writer *w, double x)
{
    char text[40];
    nh_text_number(x, text, sizeof text);
    nh_text_add(w->out, text);
    if (!text[strcspn(text, ".en")]) nh_text_add(w->out, ".0"); /* a whole number */
}

static void put_num(writer *w, nh_num x)
{
    bool wrap = nh_num_value(x) < 0 || x.q > 1;
    if (wrap) nh_text_add(w->out, "(");
    if (x.q > 1) nh_text_addf(w->out, "%" PRId64 ".0/%" PRId64 ".0", x.p, x.q);
    else put_double(w, nh_num_value(x));
    if (wrap) nh_text_add(w->out, ")");
}

static bool simple(const writer *w, nh_ex e) { return nh_kind_of(w->dag, e) == NH_SYMBOL || nh_kind_of(w->dag, e) == NH_NUMBER || (e < w->size && w->name[e]); }

/* base^exponent with exponent > 0 */
static void put_power(writer *w, nh_ex base, nh_num exponent)
{
    if (nh_num_is(exponent, 1)) {
        put(w, base);
    } else if (nh_num_is(exponent, 2) && simple(w, base)) {
        put(w, base);
        nh_text_add(w->out, "*");
        put(w, base);
    } else if (exponent.p == 1 && exponent.q == 2) {
        nh_text_add(w->out, "sqrt(");
        put(w, base);
        nh_text_add(w->out, ")");
    } else {
        nh_text_add(w->out, "pow(");
        put(w, base);
        nh_text_add(w->out, ", ");
        put_num(w, exponent);
        nh_text_add(w->out, ")");
    }
}

static size_t put_side(writer *w, nh_ex e, bool below, size_t written)
{
    for (size_t i = 0; i < nh_arity(w->dag, e); i++) {
        nh_ex exponent = nh_exponent_of(w->dag, e, i), base = nh_child(w->dag, e, i);
        bool numeric = nh_kind_of(w->dag, exponent) == NH_NUMBER;
        nh_num power = numeric ? nh_number_of(w->dag, exponent) : nh_num_int(1);
        if ((numeric && nh_num_value(power) < 0) != below) continue;
        if (written++) nh_text_add(w->out, "*");
        if (numeric) {
            put_power(w, base, below ? nh_num_mul(power, nh_num_int(-1)) : power);
        } else {
            nh_text_add(w->out, "pow(");
            put(w, base);
            nh_text_add(w->out, ", ");
            put(w, exponent);
            nh_text_add(w->out, ")");
        }
    }
    return written;
}

static void put_product(writer *w, nh_ex e)
{
    nh_num c = nh_constant_of(w->dag, e);
    size_t below = 0;
    for (size_t i = 0; i < nh_arity(w->dag, e); i++) {
        nh_ex exponent = nh_exponent_of(w->dag, e, i);
        below += nh_kind_of(w->dag, exponent) == NH_NUMBER && nh_num_value(nh_number_of(w->dag, exponent)) < 0;
    }
    bool written = !nh_num_is(c, 1) || below == nh_arity(w->dag, e);
    nh_text_add(w->out, "(");
    if (written) put_num(w, c);
    put_side(w, e, false, written);
    if (below) {
        nh_text_add(w->out, "/(");
        put_side(w, e, true, 0);
        nh_text_add(w->out, ")");
    }
    nh_text_add(w->out, ")");
}

static void put_sum(writer *w, nh_ex e)
{
    nh_num constant = nh_constant_of(w->dag, e);
    bool first = nh_num_is(constant, 0);
    nh_text_add(w->out, "(");
    if (!first) put_num(w, constant);
    for (size_t i = 0; i < nh_arity(w->dag, e); i++) {
        nh_num c = nh_coefficient_of(w->dag, e, i);
        bool minus = nh_num_value(c) < 0;
        if (minus) c = nh_num_mul(c, nh_num_int(-1));
        nh_text_add(w->out, first ? (minus ? "-" : "") : minus ? " - " : " + ");
        if (!nh_num_is(c, 1)) {
            put_num(w, c);
            nh_text_add(w->out, "*");
        }
        put(w, nh_child(w->dag, e, i));
        first = false;
    }
    nh_text_add(w->out, ")");
}

static void put_function(writer *w, nh_ex e)
{
    nh_function f = nh_function_of(w->dag, e);
    if (f == NH_PI) {
        nh_text_add(w->out, "3.141592653589793");
        return;
    }
    if (f == NH_SIGN) { /* C has none */
        nh_text_add(w->out, "copysign(1.0, ");
    } else {
        nh_text_addf(w->out, "%s(", f == NH_ABS ? "fabs" : nh_function_name(f));
    }
    for (size_t i = 0; i < nh_arity(w->dag, e); i++) {
        if (i) nh_text_add(w->out, ", ");
        put(w, nh_child(w->dag, e, i));
    }
    nh_text_add(w->out, ")");
}

static void put_inside(writer *w, nh_ex e)
{
    switch (nh_kind_of(w->dag, e)) {
    case NH_NUMBER: put_num(w, nh_number_of(w->dag, e)); break;
    case NH_SYMBOL: nh_typeset_c_name(nh_name_of(w->dag, e), w->out); break;
    case NH_SUM: put_sum(w, e); break;
    case NH_PRODUCT: put_product(w, e); break;
    default: put_function(w, e);
    }
}

static void put(writer *w, nh_ex e)
{
    if (e < w->size && w->name[e]) nh_text_addf(w->out, "t%zu", w->name[e] - 1);
    else put_inside(w, e);
}

/* Children of a node that are printed. */
static size_t children(const nh_dag *d, nh_ex e, size_t i, nh_ex out[2])
{
    out[0] = nh_child(d, e, i);
    if (nh_kind_of(d, e) != NH_PRODUCT) return 1;
    out[1] = nh_exponent_of(d, e, i);
    return nh_kind_of(d, out[1]) == NH_NUMBER ? 1 : 2;
}

void nh_typeset_c(nh_dag *dag, size_t n, const nh_ex *e, const char *const *target, size_t *temporaries, nh_text *out)
{
    size_t size = nh_dag_size(dag);
    writer w = {dag, out, nh_alloc_array(size, sizeof *w.uses), nh_alloc_array(size, sizeof *w.name), size};
    for (size_t i = 0; i < n; i++) w.uses[e[i]]++;
    for (size_t at = size; at-- > 0;) { /* parents have larger numbers than their children */
        nh_ex x = (nh_ex)at, child[2];
        nh_kind kind = nh_kind_of(dag, x);
        if (!w.uses[x] || kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        for (size_t i = 0; i < nh_arity(dag, x); i++)
            for (size_t k = children(dag, x, i, child); k-- > 0;) w.uses[child[k]]++;
    }
    for (size_t at = 0; at < size; at++) {
        nh_ex x = (nh_ex)at;
        nh_kind kind = nh_kind_of(dag, x);
        if (w.uses[x] < 2 || kind == NH_NUMBER || kind == NH_SYMBOL) continue;
        nh_text_addf(out, "    const double t%zu = ", *temporaries);
        put_inside(&w, x);
        nh_text_add(out, ";\n");
        w.name[x] = ++*temporaries;
    }
    for (size_t i = 0; i < n; i++) {
        nh_text_addf(out, "    %s = ", target[i]);
        put(&w, e[i]);
        nh_text_add(out, ";\n");
    }
    nh_free(w.uses);
    nh_free(w.name);
}
