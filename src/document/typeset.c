#include <ctype.h>
#include <string.h>

#include "base/escape.h"
#include "document/typeset_internal.h"
#include "graph/parse.h"

static const nh_typeset_script scripts[] = {
    [NH_MATHML] = {{"<mrow>", "</mrow>"},
                   {"<mrow>", "</mrow>"},
                   {"<mfrac>", "", "</mfrac>"},
                   {"<msqrt>", "</msqrt>"},
                   {"<msup>", "", "</msup>"},
                   {"<msub>", "", "</msub>"},
                   {"<mover accent=\"true\">", "<mo>\u02d9</mo></mover>"},
                   {"<mover accent=\"true\">", "<mo>\u00a8</mo></mover>"},
                   "<mo>(</mo>",
                   "<mo>)</mo>",
                   {"<mrow><mo form=\"prefix\">|</mo>", "<mo form=\"postfix\">|</mo></mrow>"},
                   "<mo>+</mo>",
                   "<mo>\u2212</mo>",
                   "<mo>=</mo>",
                   "<mo>\u2062</mo><mspace width=\"0.12em\"/>",
                   "<mo>\u00b7</mo>",
                   "<mo>\u2061</mo>",
                   "<mo>,</mo>",
                   {"<mn>", "</mn>"},
                   {"<mi>", "</mi>"},
                   {"<mi mathvariant=\"normal\">", "</mi>"},
                   "<mi>\u03c0</mi>",
                   "<mo stretchy=\"false\">(</mo>",
                   "<mo stretchy=\"false\">)</mo>",
                   "<mo stretchy=\"false\">(</mo>",
                   "<mo stretchy=\"false\">)</mo>",
                   "<mo stretchy=\"false\">|</mo>",
                   "<mo>/</mo>",
                   "<mo minsize=\"2.2em\" maxsize=\"2.2em\">(</mo>",
                   "<mo minsize=\"2.2em\" maxsize=\"2.2em\">)</mo>",
                   "<mo form=\"infix\">+</mo>",
                   "<mo form=\"infix\">\u2212</mo>"},
    [NH_LATEX] = {{"{", "}"},
                  {"", ""},
                  {"\\frac", "", ""},
                  {"\\sqrt{", "}"},
                  {"", "^", ""},
                  {"", "_", ""},
                  {"\\dot{", "}"},
                  {"\\ddot{", "}"},
                  "\\left(",
                  "\\right)",
                  {"\\left|", "\\right|"},
                  " + ",
                  " - ",
                  " = ",
                  "\\,",
                  "\\cdot ",
                  "",
                  ", ",
                  {"", ""},
                  {"", ""},
                  {"\\mathrm{", "}"},
                  "\\pi ",
                  "\\left(",
                  "\\right)",
                  "\\bigl(",
                  "\\bigr)",
                  "\\bigm|",
                  "\\big/",
                  "\\biggl(",
                  "\\biggr)",
                  " + ",
                  " - "},
};

static const struct {
    const char *name, *letter, *command;
} greek[] = {
    {"alpha", "α", "\\alpha "},
    {"beta", "β", "\\beta "},
    {"gamma", "γ", "\\gamma "},
    {"delta", "δ", "\\delta "},
    {"epsilon", "ε", "\\varepsilon "},
    {"zeta", "ζ", "\\zeta "},
    {"eta", "η", "\\eta "},
    {"theta", "θ", "\\theta "},
    {"iota", "ι", "\\iota "},
    {"kappa", "κ", "\\kappa "},
    {"lambda", "λ", "\\lambda "},
    {"mu", "μ", "\\mu "},
    {"nu", "ν", "\\nu "},
    {"xi", "ξ", "\\xi "},
    {"rho", "ρ", "\\rho "},
    {"sigma", "σ", "\\sigma "},
    {"tau", "τ", "\\tau "},
    {"phi", "φ", "\\varphi "},
    {"chi", "χ", "\\chi "},
    {"psi", "ψ", "\\psi "},
    {"omega", "ω", "\\omega "},
    {"Gamma", "Γ", "\\Gamma "},
    {"Delta", "Δ", "\\Delta "},
    {"Theta", "Θ", "\\Theta "},
    {"Lambda", "Λ", "\\Lambda "},
    {"Xi", "Ξ", "\\Xi "},
    {"Sigma", "Σ", "\\Sigma "},
    {"Phi", "Φ", "\\Phi "},
    {"Psi", "Ψ", "\\Psi "},
    {"Omega", "Ω", "\\Omega "},
    {"varphi", "φ", "\\varphi "},
    {"Pi", "Π", "\\Pi "},
    {"upsilon", "υ", "\\upsilon "},
    {"Upsilon", "ϒ", "\\Upsilon "}, /* the letter with hooks: the other one looks like an italic Y */
    {"vartheta", "ϑ", "\\vartheta "},
};

typedef nh_typeset_writer writer;

static void put(const writer *w, const nh_formula_node *e);

static void add(const writer *w, const char *text) { nh_text_add(w->out, text); }

static void grouped(const writer *w, const nh_formula_node *e)
{
    add(w, w->s->group[0]);
    put(w, e);
    add(w, w->s->group[1]);
}

bool nh_typeset_tall(const nh_formula_node *e)
{
    if (e->kind == NH_FORMULA_NODE_FRACTION) return true;
    if (e->kind == NH_FORMULA_NODE_POWER) return nh_typeset_tall(e->child);
    bool any = false;
    for (const nh_formula_node *c = e->child; c && !any; c = c->next) any = nh_typeset_tall(c);
    return any;
}

void nh_typeset_parenthesised(const writer *w, const nh_formula_node *e)
{
    bool tall = nh_typeset_tall(e);
    add(w, w->s->group[0]);
    add(w, tall ? w->s->open : w->s->flat_open);
    put(w, e);
    add(w, tall ? w->s->close : w->s->flat_close);
    add(w, w->s->group[1]);
}

/* ---- names and numbers ---- */

static size_t greek_letter(const char *text, size_t length)
{
    size_t i = 0, n = sizeof greek / sizeof *greek;
    while (i < n && (strlen(greek[i].name) != length || strncmp(greek[i].name, text, length))) i++;
    return i;
}

bool nh_typeset_is_greek(const char *text, size_t length)
{
    return greek_letter(text, length) < sizeof greek / sizeof *greek;
}

/* The name with the characters whose numbers are in it. */
static void put_characters(const char *text, size_t length, nh_text *out)
{
    uint32_t code;
    for (size_t i = 0, n; i < length; i += n ? n : 1) {
        n = nh_name_code(text + i, &code);
        if (n && i + n <= length) nh_utf8_add(out, code);
        else nh_text_add_n(out, text + i, 1), n = 1;
    }
}

static bool has_code(const char *text)
{
    uint32_t code;
    while (*text && !nh_name_code(text, &code)) text++;
    return *text;
}

/* A letter, or a word set upright.  Names consist of letters, digits and _ only. */
static void word(const writer *w, const char *text, size_t length)
{
    if (nh_typeset_is_greek(text, length)) {
        size_t i = greek_letter(text, length);
        add(w, w->s->italic[0]);
        add(w, w->form == NH_MATHML ? greek[i].letter : greek[i].command);
        add(w, w->s->italic[1]);
        return;
    }
    bool digits = length && isdigit((unsigned char)text[0]);
    const char *const *around = digits ? w->s->number : length == 1 ? w->s->italic : w->s->upright;
    add(w, around[0]);
    if (w->form == NH_MATHML) put_characters(text, length, w->out);
    for (size_t i = 0; i < length && w->form == NH_LATEX; i++) {
        if (text[i] == '_') add(w, "\\_");
        else nh_text_add_n(w->out, text + i, 1);
    }
    add(w, around[1]);
}

static void accented(const writer *w, const char *text, size_t length, const char *const accent[2])
{
    if (accent) add(w, accent[0]);
    if (accent) add(w, w->s->base[0]);
    word(w, text, length);
    if (accent) add(w, w->s->base[1]);
    if (accent) add(w, accent[1]);
}

/* A stem, with the digits at the end, or the part behind an underscore, as its index; an accent belongs to the stem.
 * An index p_1 or phi_1 has an index too, but words such as left_joint stand together. */
static void name(const writer *w, const char *text, bool index, const char *const accent[2])
{
    size_t length = strlen(text), base = length ? strcspn(text + 1, "_") + 1 : 0, below;
    bool together = index && base < length && base > 1 && !nh_typeset_is_greek(text, base);
    if (together) base = length;
    if (base == length && !together && !has_code(text))
        while (base > 1 && isdigit((unsigned char)text[base - 1])) base--;
    below = base + (base < length && text[base] == '_' && base + 1 < length);
    if (base == length || below == length || isdigit((unsigned char)text[0])) {
        accented(w, text, length, accent);
        return;
    }
    add(w, w->s->below[0]);
    add(w, w->s->base[0]);
    accented(w, text, base, accent);
    add(w, w->s->base[1]);
    add(w, w->s->below[1]);
    add(w, w->s->group[0]);
    name(w, text + below, true, NULL);
    add(w, w->s->group[1]);
    add(w, w->s->below[2]);
}

static void dotted(const writer *w, const nh_formula_node *e)
{
    if (!strcmp(e->text, "pi") && !e->primes) add(w, w->s->pi);
    else name(w, e->text, false, e->primes == 0 ? NULL : e->primes == 2 ? w->s->ddot : w->s->dot);
}

static void plain(const char *text, nh_text *out)
{
    size_t length = strcspn(text, "'_0123456789, =.(");
    if (nh_typeset_is_greek(text, length)) {
        nh_text_add(out, greek[greek_letter(text, length)].letter);
        text += length;
    } else {
        length = strcspn(text, "'_0123456789, =.(/+-*^");
        nh_text_add_n(out, text, length);
        text += length;
    }
    size_t digits = strspn(text + (*text == '_'), "0123456789");
    if (length && digits &&
        !strchr("_.abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ",
                text[(*text == '_') + digits] ? text[(*text == '_') + digits] : ' '))
        /* digits as indices: U+2080 and on */
        for (text += *text == '_'; digits-- > 0; text++) nh_text_addf(out, "\xe2\x82%c", 0x80 + (*text - '0'));
    for (; *text; text++)
        if (*text == '\'') nh_text_add(out, "\u2032");
        else nh_text_add_n(out, text, 1);
}

void nh_typeset_plain(const char *text, nh_text *out)
{
    nh_text characters;
    nh_text_init(&characters);
    put_characters(text, strlen(text), &characters);
    plain(nh_text_string(&characters), out);
    nh_text_clear(&characters);
}

/* 1.5e-7 as 1.5 times a power of ten. */
static void number(const writer *w, const char *text)
{
    size_t mantissa = strcspn(text, "eE");
    add(w, w->s->number[0]);
    nh_text_add_n(w->out, text, mantissa);
    add(w, w->s->number[1]);
    if (!text[mantissa]) return;
    const char *exponent = text + mantissa + 1;
    bool minus = *exponent == '-';
    exponent += *exponent == '-' || *exponent == '+';
    add(w, w->s->dot_times);
    add(w, w->s->power[0]);
    nh_text_addf(w->out, "%s%s10%s%s", w->s->base[0], w->s->number[0], w->s->number[1], w->s->base[1]);
    add(w, w->s->power[1]);
    nh_text_addf(w->out, "%s%s%s%s%s%s", w->s->group[0], minus ? w->s->minus : "", w->s->number[0], exponent,
                 w->s->number[1], w->s->group[1]);
    add(w, w->s->power[2]);
}

/* ---- functions and powers ---- */

void nh_typeset_function(const writer *w, const char *text)
{
    static const char *const known[] = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "exp"};
    static const char *const inverse[][2] = {{"asin", "arcsin"}, {"acos", "arccos"}, {"atan", "arctan"}, {"log", "ln"}};
    const char *shown = text, *primes = text + strcspn(text, "'");
    bool command = false;
    if (*primes) { /* V'(r) */
        nh_text_add(w->out, w->form == NH_MATHML ? "<msup><mi mathvariant=\"normal\">" : "\\operatorname{");
        nh_text_add_n(w->out, text, (size_t)(primes - text));
        nh_text_add(w->out, w->form == NH_MATHML ? "</mi><mo>" : "}");
        for (; *primes; primes++) nh_text_add(w->out, w->form == NH_MATHML ? "\u2032" : "'");
        if (w->form == NH_MATHML) nh_text_add(w->out, "</mo></msup>");
        return;
    }
    for (size_t i = 0; i < sizeof inverse / sizeof *inverse; i++)
        if (!strcmp(text, inverse[i][0])) shown = inverse[i][1], command = true;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) command |= !strcmp(text, known[i]);
    if (w->form == NH_MATHML) nh_text_addf(w->out, "<mi mathvariant=\"normal\">%s</mi>", shown);
    else nh_text_addf(w->out, command ? "\\%s" : "\\operatorname{%s}", shown);
}

static void arguments(const writer *w, const nh_formula_node *e)
{
    add(w, w->s->apply);
    bool bare = e->child && !e->child->next && e->child->kind == NH_FORMULA_NODE_NAME && !e->followed;
    if (bare) add(w, w->form == NH_LATEX ? " " : "<mspace width=\"0.17em\"/>");
    if (bare) {
        put(w, e->child);
        return;
    }
    bool tall = nh_typeset_tall(e);
    add(w, tall ? w->s->open : w->s->flat_open);
    for (const nh_formula_node *c = e->child; c; c = c->next) {
        put(w, c);
        if (c->next) add(w, w->s->comma);
    }
    add(w, tall ? w->s->close : w->s->flat_close);
}

static void named_call(const writer *w, const nh_formula_node *e)
{
    size_t k = 0;
    const nh_formula_node *c = nh_typeset_named_head(w, e);
    bool tall = nh_typeset_tall(e);
    add(w, w->s->apply);
    add(w, tall ? w->s->open : w->s->flat_open);
    for (; c; c = c->next) {
        put(w, c);
        if (c->next) nh_typeset_named_comma(w, e->text, k++);
    }
    add(w, tall ? w->s->close : w->s->flat_close);
}

static void call(const writer *w, const nh_formula_node *e)
{
    if (nh_typeset_is_named(e->text)) {
        named_call(w, e);
        return;
    }
    const char *const *around = !strcmp(e->text, "sqrt") ? w->s->root : !strcmp(e->text, "abs") ? w->s->bar : NULL;
    if (around && e->child && !e->child->next) {
        add(w, around[0]);
        put(w, e->child);
        add(w, around[1]);
        return;
    }
    nh_typeset_function(w, e->text);
    arguments(w, e);
}

/* sin(x)^2 has its power at the name of the function. */
static void power(const writer *w, const nh_formula_node *e)
{
    const nh_formula_node *base = e->child, *exponent = base->next;
    bool on_function = base->kind == NH_FORMULA_NODE_CALL && exponent->kind == NH_FORMULA_NODE_NUMBER &&
                       strcmp(base->text, "sqrt") && strcmp(base->text, "abs") && !nh_typeset_is_named(base->text);
    bool plain = base->kind == NH_FORMULA_NODE_NAME || base->kind == NH_FORMULA_NODE_NUMBER ||
                 (base->kind == NH_FORMULA_NODE_CALL && !strcmp(base->text, "abs"));
    add(w, w->s->power[0]);
    if (on_function) {
        add(w, w->s->base[0]);
        nh_typeset_function(w, base->text);
        add(w, w->s->base[1]);
    } else if (plain) {
        add(w, w->s->base[0]);
        put(w, base);
        add(w, w->s->base[1]);
    } else {
        nh_typeset_parenthesised(w, base);
    }
    add(w, w->s->power[1]);
    grouped(w, exponent);
    add(w, w->s->power[2]);
    if (on_function) arguments(w, base);
}

/* ---- sums and products ---- */

static void factor(const writer *w, const nh_formula_node *e)
{
    if (e->kind == NH_FORMULA_NODE_SUM || e->kind == NH_FORMULA_NODE_MINUS) nh_typeset_parenthesised(w, e);
    else put(w, e);
}

static bool starts_with_number(const nh_formula_node *e)
{
    while (e->kind == NH_FORMULA_NODE_POWER || e->kind == NH_FORMULA_NODE_PRODUCT) e = e->child;
    return e->kind == NH_FORMULA_NODE_NUMBER;
}

bool nh_typeset_names_a_function(const nh_formula_node *e)
{
    if (e->kind == NH_FORMULA_NODE_POWER) e = e->child;
    return e->kind == NH_FORMULA_NODE_CALL && strcmp(e->text, "sqrt") && strcmp(e->text, "abs");
}

bool nh_typeset_times(const writer *w, const nh_formula_node *factor)
{
    bool dot = starts_with_number(factor);
    add(w, dot ? w->s->dot_times : w->s->times);
    if (w->form == NH_MATHML && nh_typeset_names_a_function(factor)) add(w, "<mspace width=\"0.17em\"/>");
    return dot;
}

static void product(const writer *w, const nh_formula_node *e)
{
    for (const nh_formula_node *c = e->child; c; c = c->next) {
        if (c != e->child) nh_typeset_times(w, c);
        factor(w, c);
    }
}

static void term(const writer *w, const nh_formula_node *e, bool first)
{
    if (e->minus) add(w, w->s->minus);
    else if (!first) add(w, w->s->plus);
    factor(w, e);
}

static void put(const writer *w, const nh_formula_node *e)
{
    switch (e->kind) {
    case NH_FORMULA_NODE_NUMBER: number(w, e->text); break;
    case NH_FORMULA_NODE_NAME: dotted(w, e); break;
    case NH_FORMULA_NODE_CALL: call(w, e); break;
    case NH_FORMULA_NODE_POWER: power(w, e); break;
    case NH_FORMULA_NODE_PRODUCT: product(w, e); break;
    case NH_FORMULA_NODE_MINUS:
        add(w, w->s->minus);
        factor(w, e->child);
        break;
    case NH_FORMULA_NODE_SUM:
        for (const nh_formula_node *c = e->child; c; c = c->next) term(w, c, c == e->child);
        break;
    case NH_FORMULA_NODE_FRACTION:
        add(w, w->s->fraction[0]);
        grouped(w, e->child);
        grouped(w, e->child->next);
        add(w, w->s->fraction[2]);
        break;
    case NH_FORMULA_NODE_EQUATION:
        put(w, e->child);
        add(w, w->s->equal);
        put(w, e->child->next);
        break;
    }
}

void nh_typeset_put(const writer *w, const nh_formula_node *e) { put(w, e); }

const nh_typeset_script *nh_typeset_script_of(nh_typeset_form form) { return &scripts[form]; }

bool nh_typeset(const char *text, nh_typeset_form form, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const nh_formula_node *e = nh_typeset_read(arena, text);
    if (e) put(&(writer){form, &scripts[form], out}, e);
    nh_arena_free(arena);
    return e != NULL;
}
