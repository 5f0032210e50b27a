/* How Bessel, Legendre, hypergeometric and Airy functions and elliptic
 * integrals stand on paper: a letter, some of the arguments as its index, the
 * others in parentheses; the derivative has a prime. */
#include <string.h>

#include "document/typeset_internal.h"

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
