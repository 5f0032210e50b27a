/* source_expression: writes one expression in a language, with the names of its parts. */
#include <string.h>

#include "document/source_internal.h"
#include "graph/declared.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/num_long.h"

static void put(nh_source *w, nh_ex e, int around);

bool nh_source_simple(const nh_source *w, nh_ex e) { return w->name[e] || nh_kind_of(w->dag, e) == NH_SYMBOL; }

static void put_double(nh_source *w, double x)
{
    char text[40];
    nh_text_number(x, text, sizeof text);
    nh_text_add(w->out, text);
    if (w->language->point && !text[strcspn(text, ".en")]) nh_text_add(w->out, ".0");
}

/* A whole number, or a number that is no ratio. */
static void put_piece(nh_source *w, nh_num x)
{
    if (!w->language->exact) {
        put_double(w, nh_num_value(x));
        return;
    }
    nh_text text;
    nh_text_init(&text);
    nh_num_write(x, &text);
    const char *word = nh_text_string(&text);
    bool decimal = w->language->fraction[0] && nh_num_exact(x) && word[strcspn(word, ".e")];
    nh_text_addf(w->out, decimal ? "sp.Rational('%s')" : "%s", word);
    nh_text_clear(&text);
}

static void put_number(nh_source *w, nh_num x, int around)
{
    nh_num top, bottom;
    nh_num_split(x, &top, &bottom);
    bool ratio = !nh_num_is(bottom, 1), wrap = around > NH_IN_SUM && (ratio || nh_num_value(x) < 0);
    const char *const *form = w->language->fraction;
    if (ratio && form[0]) {
        nh_text_add(w->out, form[0]);
        put_piece(w, top);
        nh_text_add(w->out, form[1]);
        put_piece(w, bottom);
        nh_text_add(w->out, form[2]);
        return;
    }
    if (wrap) nh_text_add(w->out, "(");
    put_piece(w, top);
    if (ratio) nh_text_add(w->out, "/");
    if (ratio) put_piece(w, bottom);
    if (wrap) nh_text_add(w->out, ")");
}

int64_t nh_source_small_power(const nh_source *w, nh_num exponent)
{
    enum { most_factors = 4 };
    double size = nh_num_value(exponent);
    if (!w->language->products || size <= 0 || size > most_factors || !nh_num_short(exponent) || exponent.q > 2)
        return 0;
    return exponent.p;
}

static void put_root(nh_source *w, nh_ex base)
{
    nh_text_addf(w->out, "%s(", w->language->root);
    put(w, base, NH_IN_SUM);
    nh_text_add(w->out, ")");
}

/* base^exponent with exponent > 0. */
static void put_power(nh_source *w, nh_ex base, nh_num exponent, int around)
{
    const char *const *form = w->language->power;
    int64_t p = nh_source_small_power(w, exponent);
    if (nh_num_is(exponent, 1)) {
        put(w, base, around);
    } else if (exponent.p == 1 && exponent.q == 2) {
        put_root(w, base);
    } else if (p && nh_source_simple(w, base)) {
        for (int64_t i = 0; i < p / exponent.q; i++) {
            if (i) nh_text_add(w->out, "*");
            put(w, base, NH_IN_POWER);
        }
        if (exponent.q == 2) nh_text_add(w->out, "*");
        if (exponent.q == 2) put_root(w, base);
    } else {
        bool call = *form[0] != 0;
        nh_text_add(w->out, form[0]);
        put(w, base, call ? NH_IN_SUM : NH_IN_POWER);
        nh_text_add(w->out, form[1]);
        put_number(w, exponent, call ? NH_IN_SUM : NH_IN_POWER);
        nh_text_add(w->out, form[2]);
    }
}

static void put_general_power(nh_source *w, nh_ex base, nh_ex exponent)
{
    const char *const *form = w->language->power;
    bool call = *form[0] != 0;
    nh_text_add(w->out, form[0]);
    put(w, base, call ? NH_IN_SUM : NH_IN_POWER);
    nh_text_add(w->out, form[1]);
    put(w, exponent, call ? NH_IN_SUM : NH_IN_POWER);
    nh_text_add(w->out, form[2]);
}

static bool is_below(const nh_dag *d, nh_ex exponent)
{
    return nh_kind_of(d, exponent) == NH_NUMBER && nh_num_value(nh_number_of(d, exponent)) < 0;
}

static size_t put_side(nh_source *w, nh_ex e, bool below, size_t written)
{
    for (size_t i = 0; i < nh_arity(w->dag, e); i++) {
        nh_ex exponent = nh_exponent_of(w->dag, e, i), base = nh_child(w->dag, e, i);
        if (is_below(w->dag, exponent) != below) continue;
        if (written++) nh_text_add(w->out, "*");
        if (nh_kind_of(w->dag, exponent) != NH_NUMBER) put_general_power(w, base, exponent);
        else
            put_power(w, base,
                      below ? nh_num_mul(nh_number_of(w->dag, exponent), nh_num_int(-1))
                            : nh_number_of(w->dag, exponent),
                      NH_IN_PRODUCT);
    }
    return written;
}

/* c times the factors of a product, c > 0 where the sign has been written already. */
static void put_factors(nh_source *w, nh_ex e, nh_num c)
{
    nh_num top, bottom;
    size_t n = nh_arity(w->dag, e), below = 0;
    nh_num_split(c, &top, &bottom);
    bool divided = !nh_num_is(bottom, 1);
    for (size_t i = 0; i < n; i++) below += is_below(w->dag, nh_exponent_of(w->dag, e, i));
    bool number = !nh_num_is(top, 1) || below == n;
    if (number) put_piece(w, top);
    put_side(w, e, false, number);
    if (!below && !divided) return;
    bool wrap = below + divided > 1 || !divided;
    nh_text_add(w->out, wrap ? "/(" : "/");
    if (divided) put_piece(w, bottom);
    put_side(w, e, true, divided);
    if (wrap) nh_text_add(w->out, ")");
}

static void put_product(nh_source *w, nh_ex e, int around)
{
    nh_num c = nh_constant_of(w->dag, e);
    bool minus = nh_num_value(c) < 0, wrap = around == NH_IN_POWER || (around == NH_IN_PRODUCT && minus);
    if (wrap) nh_text_add(w->out, "(");
    if (minus) nh_text_add(w->out, "-");
    put_factors(w, e, minus ? nh_num_mul(c, nh_num_int(-1)) : c);
    if (wrap) nh_text_add(w->out, ")");
}

void nh_source_put_term(nh_source *w, nh_ex e, size_t i, bool first)
{
    nh_dag *d = w->dag;
    nh_num c = nh_coefficient_of(d, e, i), all = c;
    nh_ex child = nh_child(d, e, i);
    bool product = !w->name[child] && nh_kind_of(d, child) == NH_PRODUCT;
    if (product) all = nh_num_mul(c, nh_constant_of(d, child));
    bool minus = nh_num_value(all) < 0;
    if (minus) all = nh_num_mul(all, nh_num_int(-1));
    nh_text_add(w->out, first ? (minus ? "-" : "") : minus ? " - " : " + ");
    if (product) {
        put_factors(w, child, all);
        return;
    }
    nh_num top, bottom;
    nh_num_split(all, &top, &bottom);
    if (!nh_num_is(top, 1)) put_piece(w, top);
    if (!nh_num_is(top, 1)) nh_text_add(w->out, "*");
    put(w, child, NH_IN_PRODUCT);
    if (nh_num_is(bottom, 1)) return;
    nh_text_add(w->out, "/");
    put_piece(w, bottom);
}

void nh_source_put_terms(nh_source *w, nh_ex e, size_t begin, size_t end)
{
    nh_num constant = nh_constant_of(w->dag, e);
    bool first = begin > 0 || nh_num_is(constant, 0);
    if (!first) put_number(w, constant, NH_IN_SUM);
    for (size_t i = begin; i < end; i++) {
        nh_source_put_term(w, e, i, first && i == begin);
        first = false;
    }
}

/* "$1/$2*jv($1, $2)" with the arguments inserted. */
static void put_template(nh_source *w, nh_ex e, const char *form)
{
    for (; *form; form++) {
        if (*form == '$') put(w, nh_child(w->dag, e, (size_t)(*++form - '1')), NH_IN_POWER);
        else nh_text_add_n(w->out, form, 1);
    }
}

static void put_function(nh_source *w, nh_ex e)
{
    nh_function f = nh_function_of(w->dag, e);
    if (f == NH_PI) {
        nh_text_add(w->out, w->language->pi);
        return;
    }
    if (nh_is_named_function(f) && !w->language->plain) {
        put_template(w, e, w->language->named[f] ? w->language->named[f] : nh_function_name(f));
        return;
    }
    w->sign |= f == NH_SIGN;
    size_t first = nh_declared_put(w->dag, e, w->out);
    if (first == 0) nh_text_add(w->out, w->language->plain ? nh_function_name(f) : w->language->call[f]);
    nh_text_add(w->out, "(");
    for (size_t i = first; i < nh_declared_arguments(w->dag, e); i++) {
        if (i > first) nh_text_add(w->out, ", ");
        put(w, nh_child(w->dag, e, i), NH_IN_SUM);
    }
    nh_text_add(w->out, ")");
}

void nh_source_put_inside(nh_source *w, nh_ex e, int around)
{
    bool wrap = around > NH_IN_SUM;
    switch (nh_kind_of(w->dag, e)) {
    case NH_NUMBER: put_number(w, nh_number_of(w->dag, e), around); break;
    case NH_SYMBOL: nh_text_add(w->out, nh_source_name(w, e)); break;
    case NH_PRODUCT: put_product(w, e, around); break;
    case NH_SUM:
        if (wrap) nh_text_add(w->out, "(");
        nh_source_put_terms(w, e, 0, nh_arity(w->dag, e));
        if (wrap) nh_text_add(w->out, ")");
        break;
    default: put_function(w, e);
    }
}

static void put(nh_source *w, nh_ex e, int around)
{
    if (w->name[e]) nh_text_add(w->out, w->name[e]);
    else nh_source_put_inside(w, e, around);
}

void nh_source_put(nh_source *w, nh_ex e) { put(w, e, NH_IN_SUM); }
