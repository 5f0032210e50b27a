/* typeset_break: a formula in pieces that fit a narrow page.
 *
 * What is wider than the page is opened: a sum before its terms; a product before its factors; a wide fraction n/d becomes (1/d)(n), and (n)/(d) when d
 * is wide too; wide arguments, powers and roots keep their parentheses, which may stand on different lines. */
#include <ctype.h>
#include <string.h>

#include "expr/typeset_internal.h"

typedef struct {
    size_t widest;
    nh_typeset_piece *piece;
    void *context;
    size_t count;
    nh_text one;      /* the piece that is being written */
    size_t filled;    /* its width so far */
} breaker;

enum { symbol = 2, index_digit = 1, around_operator = 3 }; /* widths, in halves of a letter */

static size_t width_of_name(const char *text)
{
    size_t length = strlen(text), base = strcspn(text, "_0123456789"), below = length - base;
    return (base > 1 && !nh_typeset_is_greek(text, base) ? symbol * base : symbol) + index_digit * below;
}

/* Of what stands side by side; a fraction is as wide as its wider part. */
static size_t width(const nh_seen *e)
{
    size_t sum = 0, most = 0, parts = 0;
    for (const nh_seen *c = e->child; c; c = c->next, parts++) {
        size_t n = width(c) + (c->kind == NH_SEEN_SUM && e->kind != NH_SEEN_FRACTION && e->kind != NH_SEEN_CALL ? symbol : 0);
        sum += n;
        if (n > most) most = n;
    }
    switch (e->kind) {
    case NH_SEEN_NUMBER: return symbol * strlen(e->text);
    case NH_SEEN_NAME: return width_of_name(e->text);
    case NH_SEEN_CALL: return symbol * strlen(e->text) + sum + parts * symbol;
    case NH_SEEN_FRACTION: return most + symbol / 2;
    case NH_SEEN_SUM: return sum + around_operator * parts;
    case NH_SEEN_POWER: return width(e->child) + (e->child->kind == NH_SEEN_SUM || e->child->kind == NH_SEEN_FRACTION ? symbol : 0) + (sum - width(e->child)) / 2;
    case NH_SEEN_PRODUCT: return sum + parts / 2;
    default: return sum + around_operator;
    }
}

static void add(breaker *b, const char *mathml) { nh_text_add(&b->one, mathml); }

/* Here a line may end. */
static void cut(breaker *b)
{
    if (!b->one.length) return;
    b->piece(b->context, nh_text_string(&b->one));
    b->count++;
    b->filled = 0;
    nh_text_clear(&b->one);
}

static void whole(breaker *b, const nh_seen *e)
{
    b->filled += width(e);
    nh_typeset_seen(e, NH_MATHML, &b->one);
}

static void open(breaker *b, const nh_seen *e);

static void in_parentheses(breaker *b, const nh_seen *e)
{
    if (b->filled + 6 * symbol > b->widest) cut(b);
    add(b, "<mo stretchy=\"false\">(</mo>");
    b->filled += symbol / 2;
    open(b, e);
    add(b, "<mo stretchy=\"false\">)</mo>");
    b->filled += symbol / 2;
}

static bool fits(const breaker *b, const nh_seen *e) { return width(e) <= b->widest; }

/* A factor or a term: sums stand in parentheses. */
static void factor(breaker *b, const nh_seen *e)
{
    bool sum = e->kind == NH_SEEN_SUM || e->kind == NH_SEEN_MINUS;
    if (!fits(b, e)) {
        if (sum) in_parentheses(b, e);
        else open(b, e);
        return;
    }
    if (b->filled + width(e) > b->widest) cut(b);
    if (sum) add(b, "<mrow><mo>(</mo>");
    whole(b, e);
    if (sum) add(b, "<mo>)</mo></mrow>");
}

static void terms(breaker *b, const nh_seen *e)
{
    for (const nh_seen *c = e->child; c; c = c->next) {
        if (c != e->child) cut(b);
        b->filled += around_operator;
        if (c->minus) add(b, c == e->child ? "<mo>\u2212</mo>" : "<mo form=\"infix\">\u2212</mo>");
        else if (c != e->child) add(b, "<mo form=\"infix\">+</mo>");
        factor(b, c);
    }
}

static void factors(breaker *b, const nh_seen *first)
{
    for (const nh_seen *c = first; c; c = c->next) {
        bool number = c->kind == NH_SEEN_NUMBER || (c->kind == NH_SEEN_POWER && c->child->kind == NH_SEEN_NUMBER);
        if (c != first) add(b, number ? "<mo>\u00b7</mo>" : "<mo>\u2062</mo><mspace width=\"0.17em\"/>");
        factor(b, c);
    }
}

static bool short_factor(const nh_seen *e) { return e->kind != NH_SEEN_SUM && e->kind != NH_SEEN_MINUS && width(e) < 8 * symbol; }

/* What is short among the factors stays above the line. */
static void fraction(breaker *b, const nh_seen *e)
{
    const nh_seen *below = e->child->next, *first = e->child->kind == NH_SEEN_PRODUCT ? e->child->child : e->child;
    bool line = fits(b, below), any = false;
    if (line && b->filled + width(below) > b->widest) cut(b);
    if (line) add(b, "<mfrac><mrow>");
    for (const nh_seen *c = first; line && c; c = first == e->child ? NULL : c->next) {
        if (!short_factor(c)) continue;
        if (any) add(b, "<mo>\u2062</mo>");
        whole(b, c);
        any = true;
    }
    if (line && !any) add(b, "<mn>1</mn>");
    if (line) add(b, "</mrow><mrow>");
    if (line) whole(b, below);
    if (line) add(b, "</mrow></mfrac>");
    for (const nh_seen *c = first; c; c = first == e->child ? NULL : c->next) {
        if (line && short_factor(c)) continue;
        if (any || line) add(b, "<mo>\u2062</mo>");
        factor(b, c);
        any = true;
    }
    if (line) return;
    cut(b);
    add(b, "<mo>/</mo>");
    in_parentheses(b, below);
}

static void call(breaker *b, const nh_seen *e)
{
    bool root = !strcmp(e->text, "sqrt"), bar = !strcmp(e->text, "abs");
    if (!root && !bar) nh_text_addf(&b->one, "<mi mathvariant=\"normal\">%s</mi>", !strcmp(e->text, "log") ? "ln" : e->text);
    add(b, bar ? "<mo stretchy=\"false\">|</mo>" : "<mo stretchy=\"false\">(</mo>");
    for (const nh_seen *c = e->child; c; c = c->next) {
        open(b, c);
        if (c->next) add(b, "<mo>,</mo>");
    }
    add(b, root ? "<msup><mo stretchy=\"false\">)</mo><mrow><mn>1</mn><mo>/</mo><mn>2</mn></mrow></msup>" : bar ? "<mo stretchy=\"false\">|</mo>" : "<mo stretchy=\"false\">)</mo>");
}

static void power(breaker *b, const nh_seen *e)
{
    add(b, "<mo stretchy=\"false\">(</mo>");
    open(b, e->child);
    add(b, "<msup><mo stretchy=\"false\">)</mo><mrow>");
    whole(b, e->child->next);
    add(b, "</mrow></msup>");
}

/* As it is when it fits, else in its parts. */
static void open(breaker *b, const nh_seen *e)
{
    if (fits(b, e) && e->kind != NH_SEEN_SUM) {
        if (b->filled + width(e) > b->widest) cut(b);
        whole(b, e);
        return;
    }
    switch (e->kind) {
    case NH_SEEN_SUM: terms(b, e); break;
    case NH_SEEN_PRODUCT: factors(b, e->child); break;
    case NH_SEEN_FRACTION: fraction(b, e); break;
    case NH_SEEN_CALL: call(b, e); break;
    case NH_SEEN_POWER: power(b, e); break;
    case NH_SEEN_MINUS:
        add(b, "<mo>\u2212</mo>");
        factor(b, e->child);
        break;
    case NH_SEEN_EQUATION:
        open(b, e->child);
        cut(b);
        add(b, "<mo>=</mo>");
        open(b, e->child->next);
        break;
    default: whole(b, e);
    }
}

size_t nh_typeset_lines(const char *text, size_t widest, nh_typeset_piece *piece, void *context)
{
    nh_arena *arena = nh_arena_create();
    const nh_seen *e = nh_typeset_read(arena, text);
    breaker b = {.widest = widest * symbol, .piece = piece, .context = context};
    nh_text_init(&b.one);
    if (e) open(&b, e);
    cut(&b);
    nh_text_clear(&b.one);
    nh_arena_free(arena);
    return b.count;
}
