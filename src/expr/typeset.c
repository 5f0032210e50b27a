#include <ctype.h>
#include <string.h>

#include "expr/typeset_internal.h"

/* How one form writes what formulas are made of. */
typedef struct {
    const char *group[2], *fraction[3], *root[2], *power[3], *below[3], *dot[2], *ddot[2], *open, *close, *bar[2];
    const char *plus, *minus, *equal, *times, *dot_times, *apply, *comma, *number[2], *italic[2], *upright[2], *pi;
} script;

static const script scripts[] = {
    [NH_MATHML] = {{"<mrow>", "</mrow>"}, {"<mfrac>", "", "</mfrac>"}, {"<msqrt>", "</msqrt>"}, {"<msup>", "", "</msup>"}, {"<msub>", "", "</msub>"},
                   {"<mover accent=\"true\">", "<mo>\u02d9</mo></mover>"}, {"<mover accent=\"true\">", "<mo>\u00a8</mo></mover>"}, "<mo>(</mo>", "<mo>)</mo>",
                   {"<mo>|</mo>", "<mo>|</mo>"}, "<mo>+</mo>", "<mo>\u2212</mo>", "<mo>=</mo>", "<mo>\u2062</mo>", "<mo>\u00b7</mo>", "<mo>\u2061</mo>",
                   "<mo>,</mo>", {"<mn>", "</mn>"}, {"<mi>", "</mi>"}, {"<mi mathvariant=\"normal\">", "</mi>"}, "<mi>\u03c0</mi>"},
    [NH_LATEX] = {{"{", "}"}, {"\\frac", "", ""}, {"\\sqrt{", "}"}, {"", "^", ""}, {"", "_", ""}, {"\\dot{", "}"}, {"\\ddot{", "}"}, "\\left(", "\\right)",
                  {"\\left|", "\\right|"}, " + ", " - ", " = ", "\\,", "\\cdot ", "", ", ", {"", ""}, {"", ""}, {"\\mathrm{", "}"}, "\\pi "},
};

static const struct {
    const char *name, *letter, *command;
} greek[] = {
    {"alpha", "α", "\\alpha "},    {"beta", "β", "\\beta "},     {"gamma", "γ", "\\gamma "},   {"delta", "δ", "\\delta "},    {"epsilon", "ε", "\\varepsilon "},
    {"zeta", "ζ", "\\zeta "},      {"eta", "η", "\\eta "},       {"theta", "θ", "\\theta "},   {"iota", "ι", "\\iota "},      {"kappa", "κ", "\\kappa "},
    {"lambda", "λ", "\\lambda "},  {"mu", "μ", "\\mu "},         {"nu", "ν", "\\nu "},         {"xi", "ξ", "\\xi "},          {"rho", "ρ", "\\rho "},
    {"sigma", "σ", "\\sigma "},    {"tau", "τ", "\\tau "},       {"phi", "φ", "\\varphi "},    {"chi", "χ", "\\chi "},        {"psi", "ψ", "\\psi "},
    {"omega", "ω", "\\omega "},    {"Gamma", "Γ", "\\Gamma "},   {"Delta", "Δ", "\\Delta "},   {"Theta", "Θ", "\\Theta "},    {"Lambda", "Λ", "\\Lambda "},
    {"Xi", "Ξ", "\\Xi "},          {"Sigma", "Σ", "\\Sigma "},   {"Phi", "Φ", "\\Phi "},       {"Psi", "Ψ", "\\Psi "},        {"Omega", "Ω", "\\Omega "},
    {"varphi", "φ", "\\varphi "},  {"Pi", "Π", "\\Pi "},         {"upsilon", "υ", "\\upsilon "},
};

typedef struct {
    nh_typeset_form form;
    const script *s;
    nh_text *out;
} writer;

static void put(const writer *w, const nh_seen *e);

static void add(const writer *w, const char *text) { nh_text_add(w->out, text); }

static void grouped(const writer *w, const nh_seen *e)
{
    add(w, w->s->group[0]);
    put(w, e);
    add(w, w->s->group[1]);
}

static void parenthesised(const writer *w, const nh_seen *e)
{
    add(w, w->s->group[0]);
    add(w, w->s->open);
    put(w, e);
    add(w, w->s->close);
    add(w, w->s->group[1]);
}

/* ---- names and numbers ---- */

static size_t greek_letter(const char *text, size_t length)
{
    size_t i = 0, n = sizeof greek / sizeof *greek;
    while (i < n && (strlen(greek[i].name) != length || strncmp(greek[i].name, text, length))) i++;
    return i;
}

bool nh_typeset_is_greek(const char *text, size_t length) { return greek_letter(text, length) < sizeof greek / sizeof *greek; }

/* A letter, or a word set upright.  Names are made of letters, digits and _ only. */
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
    for (size_t i = 0; i < length; i++) {
        if (text[i] == '_' && w->form == NH_LATEX) add(w, "\\_");
        else nh_text_add_n(w->out, text + i, 1);
    }
    add(w, around[1]);
}

/* The dots of a derivative stand above the letter, not above its index. */
static void letter(const writer *w, const char *text, size_t length, size_t primes)
{
    const char *const *dot = primes == 2 ? w->s->ddot : w->s->dot;
    if (primes) add(w, dot[0]);
    if (primes) add(w, w->s->group[0]);
    word(w, text, length);
    if (primes) add(w, w->s->group[1]);
    if (primes) add(w, dot[1]);
}

static void name(const writer *w, const char *text, size_t primes)
{
    size_t length = strlen(text), base = strcspn(text + 1, "_") + 1, below;
    if (base == length)
        while (base > 1 && isdigit((unsigned char)text[base - 1])) base--;
    below = base + (base < length && text[base] == '_' && base + 1 < length);
    if (base == length || below == length) {
        letter(w, text, length, primes);
        return;
    }
    add(w, w->s->below[0]);
    add(w, w->s->group[0]);
    letter(w, text, base, primes);
    add(w, w->s->group[1]);
    add(w, w->s->below[1]);
    add(w, w->s->group[0]);
    if (isdigit((unsigned char)text[below])) word(w, text + below, length - below);
    else name(w, text + below, 0);
    add(w, w->s->group[1]);
    add(w, w->s->below[2]);
}

static void dotted(const writer *w, const nh_seen *e)
{
    if (!strcmp(e->text, "pi") && !e->primes) add(w, w->s->pi);
    else name(w, e->text, e->primes);
}

void nh_typeset_plain(const char *text, nh_text *out)
{
    size_t length = strcspn(text, "'_0123456789, =.(");
    if (nh_typeset_is_greek(text, length)) {
        nh_text_add(out, greek[greek_letter(text, length)].letter);
        text += length;
    }
    for (; *text; text++)
        if (*text == '\'') nh_text_add(out, "\u2032");
        else nh_text_add_n(out, text, 1);
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
    nh_text_addf(w->out, "%s%s10%s%s", w->s->group[0], w->s->number[0], w->s->number[1], w->s->group[1]);
    add(w, w->s->power[1]);
    nh_text_addf(w->out, "%s%s%s%s%s%s", w->s->group[0], minus ? w->s->minus : "", w->s->number[0], exponent, w->s->number[1], w->s->group[1]);
    add(w, w->s->power[2]);
}

/* ---- functions and powers ---- */

static void function_name(const writer *w, const char *text)
{
    static const char *const known[] = {"sin", "cos", "tan", "sinh", "cosh", "tanh", "exp"};
    static const char *const inverse[][2] = {{"asin", "arcsin"}, {"acos", "arccos"}, {"atan", "arctan"}, {"log", "ln"}};
    const char *shown = text;
    bool command = false;
    for (size_t i = 0; i < sizeof inverse / sizeof *inverse; i++)
        if (!strcmp(text, inverse[i][0])) shown = inverse[i][1], command = true;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) command |= !strcmp(text, known[i]);
    if (w->form == NH_MATHML) nh_text_addf(w->out, "<mi mathvariant=\"normal\">%s</mi>", shown);
    else nh_text_addf(w->out, command ? "\\%s" : "\\operatorname{%s}", shown);
}

static void arguments(const writer *w, const nh_seen *e)
{
    add(w, w->s->apply);
    bool bare = e->child && !e->child->next && e->child->kind == NH_SEEN_NAME;
    if (bare) add(w, w->form == NH_LATEX ? " " : "<mspace width=\"0.17em\"/>");
    if (bare) {
        put(w, e->child);
        return;
    }
    add(w, w->s->open);
    for (const nh_seen *c = e->child; c; c = c->next) {
        put(w, c);
        if (c->next) add(w, w->s->comma);
    }
    add(w, w->s->close);
}

static void call(const writer *w, const nh_seen *e)
{
    const char *const *around = !strcmp(e->text, "sqrt") ? w->s->root : !strcmp(e->text, "abs") ? w->s->bar : NULL;
    if (around && e->child && !e->child->next) {
        add(w, around[0]);
        put(w, e->child);
        add(w, around[1]);
        return;
    }
    function_name(w, e->text);
    arguments(w, e);
}

/* sin(x)^2 carries its power on the function. */
static void power(const writer *w, const nh_seen *e)
{
    const nh_seen *base = e->child, *exponent = base->next;
    bool on_function = base->kind == NH_SEEN_CALL && exponent->kind == NH_SEEN_NUMBER && strcmp(base->text, "sqrt") && strcmp(base->text, "abs");
    bool plain = base->kind == NH_SEEN_NAME || base->kind == NH_SEEN_NUMBER || (base->kind == NH_SEEN_CALL && !strcmp(base->text, "abs"));
    add(w, w->s->power[0]);
    if (on_function) {
        add(w, w->s->group[0]);
        function_name(w, base->text);
        add(w, w->s->group[1]);
    } else if (plain) {
        grouped(w, base);
    } else {
        parenthesised(w, base);
    }
    add(w, w->s->power[1]);
    grouped(w, exponent);
    add(w, w->s->power[2]);
    if (on_function) arguments(w, base);
}

/* ---- sums and products ---- */

static void factor(const writer *w, const nh_seen *e)
{
    if (e->kind == NH_SEEN_SUM || e->kind == NH_SEEN_MINUS) parenthesised(w, e);
    else put(w, e);
}

static bool starts_with_number(const nh_seen *e)
{
    while (e->kind == NH_SEEN_POWER || e->kind == NH_SEEN_PRODUCT) e = e->child;
    return e->kind == NH_SEEN_NUMBER;
}

static bool starts_with_name_of_function(const nh_seen *e)
{
    if (e->kind == NH_SEEN_POWER) e = e->child;
    return e->kind == NH_SEEN_CALL && strcmp(e->text, "sqrt") && strcmp(e->text, "abs");
}

static void product(const writer *w, const nh_seen *e)
{
    for (const nh_seen *c = e->child; c; c = c->next) {
        if (c != e->child) add(w, starts_with_number(c) ? w->s->dot_times : w->s->times);
        if (c != e->child && w->form == NH_MATHML && starts_with_name_of_function(c)) add(w, "<mspace width=\"0.17em\"/>");
        factor(w, c);
    }
}

static void term(const writer *w, const nh_seen *e, bool first)
{
    if (e->minus) add(w, w->s->minus);
    else if (!first) add(w, w->s->plus);
    factor(w, e);
}

static void put(const writer *w, const nh_seen *e)
{
    switch (e->kind) {
    case NH_SEEN_NUMBER: number(w, e->text); break;
    case NH_SEEN_NAME: dotted(w, e); break;
    case NH_SEEN_CALL: call(w, e); break;
    case NH_SEEN_POWER: power(w, e); break;
    case NH_SEEN_PRODUCT: product(w, e); break;
    case NH_SEEN_MINUS:
        add(w, w->s->minus);
        factor(w, e->child);
        break;
    case NH_SEEN_SUM:
        for (const nh_seen *c = e->child; c; c = c->next) term(w, c, c == e->child);
        break;
    case NH_SEEN_FRACTION:
        add(w, w->s->fraction[0]);
        grouped(w, e->child);
        grouped(w, e->child->next);
        add(w, w->s->fraction[2]);
        break;
    case NH_SEEN_EQUATION:
        put(w, e->child);
        add(w, w->s->equal);
        put(w, e->child->next);
        break;
    }
}

void nh_typeset_seen(const nh_seen *e, nh_typeset_form form, nh_text *out) { put(&(writer){form, &scripts[form], out}, e); }

bool nh_typeset(const char *text, nh_typeset_form form, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const nh_seen *e = nh_typeset_read(arena, text);
    if (e) put(&(writer){form, &scripts[form], out}, e);
    nh_arena_free(arena);
    return e != NULL;
}

/* ---- pieces ---- */

typedef struct {
    nh_typeset_piece *piece;
    void *context;
    size_t count;
} pieces;

static void hand_over(pieces *p, nh_text *one)
{
    p->piece(p->context, nh_text_string(one));
    p->count++;
    nh_text_clear(one);
}

/* The sum with the most terms among the factors, or NULL. */
static const nh_seen *longest_sum(const nh_seen *factors, size_t *terms)
{
    const nh_seen *best = NULL;
    for (const nh_seen *c = factors; c; c = c->next) {
        size_t n = 0;
        for (const nh_seen *t = c->kind == NH_SEEN_SUM ? c->child : NULL; t; t = t->next) n++;
        if (n <= *terms) continue;
        best = c;
        *terms = n;
    }
    return best;
}

/* (a + b + ...) f/d, where it is too long for a line, is (f/d) (a + b + ...) in pieces. */
static bool open_product(nh_typeset_form form, const nh_seen *e, pieces *p)
{
    bool minus = e->kind == NH_SEEN_SUM;
    const nh_seen *n = minus ? e->child : e, *below = NULL;
    size_t terms = 2;
    if (minus && (e->child->next || !e->child->minus)) return false;
    if (n->kind == NH_SEEN_FRACTION) {
        below = n->child->next;
        n = n->child;
    }
    nh_seen alone = *n;
    alone.next = NULL;
    const nh_seen *factors = n->kind == NH_SEEN_PRODUCT ? n->child : &alone, *sum = longest_sum(factors, &terms);
    if (!sum || (!below && !factors->next && !minus)) return false;
    nh_text one, above;
    nh_text_init(&one);
    nh_text_init(&above);
    writer w = {form, &scripts[form], &above};
    bool any = false;
    for (const nh_seen *c = factors; c; c = c->next) {
        if (c == sum) continue;
        if (any) add(&w, w.s->times);
        factor(&w, c);
        any = true;
    }
    if (!any && below) nh_text_addf(&above, "%s1%s", w.s->number[0], w.s->number[1]);
    w.out = &one;
    if (minus) add(&w, w.s->minus);
    if (below) nh_text_addf(&one, "%s%s%s%s", w.s->fraction[0], w.s->group[0], nh_text_string(&above), w.s->group[1]);
    if (below) grouped(&w, below);
    nh_text_add(&one, below ? w.s->fraction[2] : nh_text_string(&above));
    nh_text_clear(&above);
    add(&w, form == NH_MATHML ? "<mo stretchy=\"false\">(</mo>" : "\\bigl(");
    for (const nh_seen *c = sum->child; c; c = c->next) {
        term(&w, c, c == sum->child);
        if (!c->next) add(&w, form == NH_MATHML ? "<mo stretchy=\"false\">)</mo>" : "\\bigr)");
        hand_over(p, &one);
    }
    return true;
}

size_t nh_typeset_pieces(const char *text, nh_typeset_form form, nh_typeset_piece *piece, void *context)
{
    enum { long_text = 60 }; /* characters that fit on a line when set */
    nh_arena *arena = nh_arena_create();
    const nh_seen *e = nh_typeset_read(arena, text), *first = e && e->kind == NH_SEEN_SUM ? e->child : e;
    pieces p = {piece, context, 0};
    bool opened = e && strlen(text) > long_text && open_product(form, e, &p);
    for (const nh_seen *c = opened ? NULL : first; c; c = e == first ? NULL : c->next) {
        nh_text one;
        nh_text_init(&one);
        writer w = {form, &scripts[form], &one};
        if (e == first) put(&w, c);
        else term(&w, c, c == first);
        hand_over(&p, &one);
    }
    nh_arena_free(arena);
    return p.count;
}
