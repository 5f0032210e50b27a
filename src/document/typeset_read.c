#include <ctype.h>
#include <string.h>

#include "document/typeset_internal.h"

enum { deepest = 300 };

typedef struct {
    nh_arena *arena;
    const char *at;
    int depth;
} reader;

static nh_formula_node *sum(reader *r);
static nh_formula_node *unary(reader *r);

static nh_formula_node *make(reader *r, nh_formula_node_kind kind, nh_formula_node *child)
{
    nh_formula_node *s = nh_arena_alloc(r->arena, sizeof *s);
    s->kind = kind;
    s->child = child;
    return s;
}

static void skip(reader *r)
{
    while (isspace((unsigned char)*r->at)) r->at++;
}

static bool take(reader *r, char c)
{
    skip(r);
    if (*r->at != c) return false;
    r->at++;
    return true;
}

static nh_formula_node *number(reader *r)
{
    const char *begin = r->at;
    while (isdigit((unsigned char)*r->at) || *r->at == '.') r->at++;
    if (*r->at == 'e' || *r->at == 'E') {
        size_t sign = r->at[1] == '-' || r->at[1] == '+';
        if (isdigit((unsigned char)r->at[1 + sign])) {
            r->at += 1 + sign;
            while (isdigit((unsigned char)*r->at)) r->at++;
        }
    }
    nh_formula_node *s = make(r, NH_FORMULA_NODE_NUMBER, NULL);
    s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
    return s;
}

static bool arguments(reader *r, nh_formula_node *call)
{
    nh_formula_node **last = &call->child;
    if (take(r, ')')) return true;
    do {
        *last = sum(r);
        if (!*last) return false;
        last = &(*last)->next;
    } while (take(r, ','));
    return take(r, ')');
}

static nh_formula_node *name(reader *r)
{
    const char *begin = r->at;
    while (isalnum((unsigned char)*r->at) || *r->at == '_') r->at++;
    nh_formula_node *s = make(r, NH_FORMULA_NODE_NAME, NULL);
    s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
    const char *primes = r->at;
    for (; *r->at == '\''; r->at++) s->primes++;
    if (*primes == '\'' && *r->at == '(') { /* the derivative of a function: V'(r) */
        s->text = nh_arena_strndup(r->arena, begin, (size_t)(r->at - begin));
        s->primes = 0;
    }
    if (s->primes || !take(r, '(')) return s;
    s->kind = NH_FORMULA_NODE_CALL;
    return arguments(r, s) ? s : NULL;
}

static nh_formula_node *atom(reader *r)
{
    skip(r);
    if (isdigit((unsigned char)*r->at) || (*r->at == '.' && isdigit((unsigned char)r->at[1]))) return number(r);
    if (isalpha((unsigned char)*r->at) || *r->at == '_') return name(r);
    if (!take(r, '(')) return NULL;
    nh_formula_node *s = sum(r);
    return s && take(r, ')') ? s : NULL;
}

static nh_formula_node *power(reader *r)
{
    nh_formula_node *base = atom(r);
    if (!base || !take(r, '^')) return base;
    nh_formula_node *exponent = unary(r);
    if (!exponent) return NULL;
    base->next = exponent;
    return make(r, NH_FORMULA_NODE_POWER, base);
}

static nh_formula_node *unary(reader *r)
{
    if (++r->depth > deepest) return NULL;
    nh_formula_node *s;
    if (take(r, '-')) {
        nh_formula_node *inner = unary(r);
        s = inner ? make(r, NH_FORMULA_NODE_MINUS, inner) : NULL;
    } else {
        take(r, '+');
        s = power(r);
    }
    r->depth--;
    return s;
}

static nh_formula_node *times(reader *r, nh_formula_node *left, nh_formula_node *right)
{
    if (left->kind != NH_FORMULA_NODE_PRODUCT) left = make(r, NH_FORMULA_NODE_PRODUCT, left);
    nh_formula_node *last = left->child;
    while (last->next) last = last->next;
    last->next = right;
    nh_formula_node *called = last->kind == NH_FORMULA_NODE_POWER ? last->child : last;
    called->followed = !nh_typeset_names_a_function(right);
    return left;
}

/* a/b/c is one fraction. */
static nh_formula_node *over(reader *r, nh_formula_node *left, nh_formula_node *right)
{
    if (left->kind == NH_FORMULA_NODE_FRACTION) {
        left->child->next = times(r, left->child->next, right);
        return left;
    }
    left->next = right;
    return make(r, NH_FORMULA_NODE_FRACTION, left);
}

/* A parenthesis around a product or a fraction remains one factor. */
static nh_formula_node *factor(reader *r)
{
    nh_formula_node *s = unary(r);
    bool wrapped = s && (s->kind == NH_FORMULA_NODE_PRODUCT || s->kind == NH_FORMULA_NODE_FRACTION);
    return wrapped ? make(r, NH_FORMULA_NODE_PRODUCT, s) : s;
}

static nh_formula_node *term(reader *r)
{
    nh_formula_node *left = factor(r);
    while (left) {
        bool star = take(r, '*'), slash = !star && take(r, '/');
        if (!star && !slash) return left;
        nh_formula_node *right = slash ? unary(r) : factor(r);
        if (!right) return NULL;
        left = star ? times(r, left, right) : over(r, left, right);
    }
    return NULL;
}

static nh_formula_node *sum(reader *r)
{
    if (++r->depth > deepest) return NULL;
    nh_formula_node *first = NULL, **last = &first;
    for (size_t count = 0;; count++) {
        bool minus = take(r, '-');
        if (!minus && !take(r, '+') && count) break;
        nh_formula_node *s = term(r);
        if (!s) return NULL;
        s->minus = minus;
        *last = s;
        last = &s->next;
    }
    r->depth--;
    return first->next || first->minus ? make(r, NH_FORMULA_NODE_SUM, first) : first;
}

nh_formula_node *nh_typeset_read(nh_arena *arena, const char *text)
{
    reader r = {.arena = arena, .at = text};
    nh_formula_node *left = sum(&r);
    if (left && take(&r, '=')) {
        left->next = sum(&r);
        left = left->next ? make(&r, NH_FORMULA_NODE_EQUATION, left) : NULL;
    }
    skip(&r);
    return left && !*r.at ? left : NULL;
}

/* ---- functions with an index: a letter, some of the arguments as its index, the others in parentheses ---- */

static const char prime[] = "_prime";

static const struct {
    const char *name, *letter;
    const char *left, *right; /* numbers below the letter, on both sides */
    size_t index;             /* number of arguments that form the index */
    const char *between;      /* the others */
} table[] = {
    {"legendre_p", "P", NULL, NULL, 1, ","},
    {"legendre_q", "Q", NULL, NULL, 1, ","},
    {"bessel_j", "J", NULL, NULL, 1, ","},
    {"bessel_y", "Y", NULL, NULL, 1, ","},
    {"bessel_i", "I", NULL, NULL, 1, ","},
    {"bessel_k", "K", NULL, NULL, 1, ","},
    {"hyp2f1", "F", "2", "1", 0, ",;;"},
    {"gauss_f", "F", NULL, NULL, 3, ","},
    {"riemann_c", "Pc", NULL, NULL, 3, ","},
    {"riemann_s", "Ps", NULL, NULL, 3, ","},
    {"hyp1f1", "F", "1", "1", 0, ";;"},
    {"hyperu", "U", NULL, NULL, 0, ",,"},
    {"airy_ai", "Ai", NULL, NULL, 0, ","},
    {"airy_bi", "Bi", NULL, NULL, 0, ","},
    {"elliptic_k", "K", NULL, NULL, 0, ","},
    {"elliptic_e", "E", NULL, NULL, 0, ","},
    {"elliptic_f", "F", NULL, NULL, 0, "|"},
    {"elliptic_einc", "E", NULL, NULL, 0, "|"},
    {"elliptic_pi", "\u03a0", NULL, NULL, 0, ";|"},
};
enum { rows = sizeof table / sizeof *table };

static size_t row_of(const char *name)
{
    size_t length = strlen(name), tail = strlen(prime), i = 0;
    if (length > tail && !strcmp(name + length - tail, prime)) length -= tail;
    while (i < rows && (strlen(table[i].name) != length || strncmp(table[i].name, name, length))) i++;
    return i;
}

bool nh_typeset_is_named(const char *name) { return row_of(name) < rows; }

/* {}_2F_1, with the prime */
static void put_numbered(const nh_typeset_writer *w, size_t i, bool derived)
{
    if (w->form == NH_LATEX)
        nh_text_addf(w->out, "{}_%s%s_%s%s", table[i].left, table[i].letter, table[i].right, derived ? "'" : "");
    else
        nh_text_addf(w->out,
                     "<mmultiscripts><mi>%s</mi><mn>%s</mn>%s<mprescripts/><mn>%s</"
                     "mn><mrow></mrow></mmultiscripts>",
                     table[i].letter, table[i].right, derived ? "<mo>\u2032</mo>" : "<mrow></mrow>", table[i].left);
}

static void put_letter(const nh_typeset_writer *w, size_t i, bool derived)
{
    const char *letter = table[i].letter;
    bool greek = (unsigned char)*letter > 127, word = letter[1] != 0 && !greek;
    if (w->form == NH_LATEX) {
        nh_text_addf(w->out, word ? "\\mathrm{%s}%s" : "%s%s", greek ? "\\Pi" : letter, derived ? "'" : "");
        return;
    }
    if (derived) nh_text_add(w->out, "<msup>");
    nh_text_addf(w->out, word ? "<mi mathvariant=\"normal\">%s</mi>" : "<mi>%s</mi>", letter);
    if (derived) nh_text_add(w->out, "<mo>\u2032</mo></msup>");
}

const nh_formula_node *nh_typeset_named_head(const nh_typeset_writer *w, const nh_formula_node *e)
{
    size_t i = row_of(e->text);
    bool derived = strlen(e->text) > strlen(table[i].name);
    const nh_formula_node *c = e->child;
    if (table[i].left) put_numbered(w, i, derived);
    else if (!table[i].index) put_letter(w, i, derived);
    if (!table[i].index) return c;
    nh_text_add(w->out, w->s->below[0]);
    put_letter(w, i, derived);
    nh_text_add(w->out, w->s->below[1]);
    nh_text_add(w->out, w->s->group[0]);
    for (size_t k = 0; k < table[i].index && c; k++, c = c->next) {
        if (k) nh_text_add(w->out, w->s->comma);
        nh_typeset_put(w, c);
    }
    nh_text_add(w->out, w->s->group[1]);
    nh_text_add(w->out, w->s->below[2]);
    return c;
}

void nh_typeset_named_comma(const nh_typeset_writer *w, const char *name, size_t k)
{
    const char *between = table[row_of(name)].between;
    char c = between[k < strlen(between) ? k : strlen(between) - 1];
    if (c == ',') nh_text_add(w->out, w->s->comma);
    else if (w->form == NH_MATHML) nh_text_addf(w->out, c == ';' ? "<mo>;</mo>" : "<mo>|</mo>");
    else nh_text_add(w->out, c == ';' ? "; " : "\\mid ");
}
