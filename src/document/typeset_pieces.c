/* Formulas in pieces, so that a line may end between them.  A wide part is split until no piece is wide: a wide sum
 * gets parentheses that do not stretch, a wide numerator stands beside its fraction, a wide denominator after a slash,
 * a wide root becomes a power. */
#include <string.h>

#include "document/typeset_internal.h"

typedef struct {
    double widest;       /* width of a piece, in letters */
    nh_typeset_writer w; /* writes to the present piece */
    nh_text text;
    nh_typeset_piece *piece;
    void *context;
    size_t count;
} flow;

static void open_up(flow *f, const nh_formula_node *e, int depth);

static void add(flow *f, const char *text) { nh_text_add(&f->text, text); }

/* ---- widths ---- */

static double width(const nh_formula_node *e);

static double width_of_name(const char *text)
{
    size_t length = strlen(text), base = strcspn(text, "_0123456789");
    return (nh_typeset_is_greek(text, base) ? 1.2 : (double)base) + 0.6 * (double)(length - base);
}

static double widths(const nh_formula_node *first, double between)
{
    double sum = 0;
    for (const nh_formula_node *c = first; c; c = c->next) sum += width(c) + (c == first ? 0 : between);
    return sum;
}

/* The width in letters, about. */
static double width(const nh_formula_node *e)
{
    double above, below;
    switch (e->kind) {
    case NH_FORMULA_NODE_NUMBER: return 0.9 * (double)strlen(e->text);
    case NH_FORMULA_NODE_NAME: return width_of_name(e->text);
    case NH_FORMULA_NODE_CALL:
        return (strcmp(e->text, "sqrt") ? 0.8 * (double)strlen(e->text) + 1.5 : 1) + widths(e->child, 1);
    case NH_FORMULA_NODE_MINUS: return 2 + width(e->child);
    case NH_FORMULA_NODE_SUM: return widths(e->child, 2.5) + 2;
    case NH_FORMULA_NODE_PRODUCT: return widths(e->child, 0.4);
    case NH_FORMULA_NODE_POWER: return width(e->child) + 0.7 * width(e->child->next);
    case NH_FORMULA_NODE_EQUATION: return widths(e->child, 3);
    case NH_FORMULA_NODE_FRACTION: break;
    }
    above = width(e->child);
    below = width(e->child->next);
    return 0.5 + (above > below ? above : below);
}

static bool wide(const flow *f, const nh_formula_node *e) { return width(e) > f->widest; }

/* Does it contain a fraction when it is split?  A fraction with a wide denominator becomes a slash. */
static bool tall(const flow *f, const nh_formula_node *e)
{
    if (!wide(f, e)) return nh_typeset_tall(e);
    if (e->kind == NH_FORMULA_NODE_FRACTION && !wide(f, e->child->next)) return true;
    bool any = false;
    for (const nh_formula_node *c = e->child; c && !any; c = c->next) any = tall(f, c);
    return any;
}

/* ---- breaks ---- */

/* Allows a break here; its penalty grows with the depth inside the formula. */
static void may_break(flow *f, int penalty, nh_typeset_follows follows)
{
    f->piece(f->context, nh_text_string(&f->text), follows);
    f->count++;
    nh_text_clear(&f->text);
    if (f->w.form == NH_LATEX) nh_text_addf(&f->text, "\\penalty%d ", penalty);
}

static int of_sum(int depth) { return depth < 8 ? 60 * depth : 480; }
static int of_product(int depth) { return 300 + of_sum(depth); }

static void bracketed(flow *f, const nh_formula_node *e, int depth)
{
    bool high = tall(f, e);
    add(f, high ? f->w.s->tall_open : f->w.s->wide_open);
    open_up(f, e, depth + 1);
    add(f, high ? f->w.s->tall_close : f->w.s->wide_close);
}

/* It stands beside other factors or a sign; a slash would be misread there. */
static void factor(flow *f, const nh_formula_node *e, bool alone, int depth)
{
    bool sum = e->kind == NH_FORMULA_NODE_SUM || e->kind == NH_FORMULA_NODE_MINUS,
         slash = e->kind == NH_FORMULA_NODE_FRACTION && wide(f, e->child->next) && !alone;
    if (sum && !wide(f, e)) {
        nh_typeset_parenthesised(&f->w, e);
    } else if (sum || slash) {
        bracketed(f, e, depth);
    } else {
        open_up(f, e, depth);
    }
}

static void sum(flow *f, const nh_formula_node *e, int depth)
{
    for (const nh_formula_node *c = e->child; c; c = c->next) {
        if (c != e->child) may_break(f, of_sum(depth), NH_FOLLOWS_TERM);
        if (c->minus) add(f, c == e->child ? f->w.s->minus : f->w.s->next_minus);
        else if (c != e->child) add(f, f->w.s->next_plus);
        factor(f, c, true, depth);
    }
}

/* Does the factor stand beside the fraction?  Wide factors do; where there are none, those that are not short. */
static bool apart(const flow *f, const nh_formula_node *first, const nh_formula_node *c)
{
    bool any = false;
    for (const nh_formula_node *other = first; other; other = other->next) any = any || wide(f, other);
    return width(c) > (any ? 1 : 0.25) * f->widest;
}

/* The factors that stand beside the fraction, or the others. */
static void factors(flow *f, const nh_formula_node *first, bool beside, bool all, bool begun, int depth)
{
    for (const nh_formula_node *c = first; c; c = c->next) {
        if (!all && apart(f, first, c) != beside) continue;
        bool dot = begun && nh_typeset_times(&f->w, c);
        if (begun && beside) may_break(f, of_product(depth), dot ? NH_FOLLOWS_TERM : NH_FOLLOWS_FACTOR);
        factor(f, c, false, depth);
        begun = true;
    }
}

/* (f/d) (wide factors of the numerator) */
static void beside(flow *f, const nh_formula_node *above, const nh_formula_node *below, int depth)
{
    nh_formula_node alone = *above;
    alone.next = NULL;
    const nh_formula_node *first = above->kind == NH_FORMULA_NODE_PRODUCT ? above->child : &alone;
    double left = 0;
    for (const nh_formula_node *c = first; c; c = c->next) left += apart(f, first, c) ? 0 : 0.4 + width(c);
    bool split = left > 0 && left <= f->widest;
    add(f, f->w.s->fraction[0]);
    add(f, f->w.s->group[0]);
    if (split) factors(f, first, false, false, false, depth);
    else nh_text_addf(&f->text, "%s1%s", f->w.s->number[0], f->w.s->number[1]);
    add(f, f->w.s->group[1]);
    add(f, f->w.s->group[0]);
    nh_typeset_put(&f->w, below);
    add(f, f->w.s->group[1]);
    add(f, f->w.s->fraction[2]);
    factors(f, first, true, !split, true, depth);
}

static void fraction(flow *f, const nh_formula_node *e, int depth)
{
    const nh_formula_node *above = e->child, *below = above->next;
    if (!wide(f, below)) {
        beside(f, above, below, depth);
        return;
    }
    factor(f, above, false, depth);
    may_break(f, of_product(depth), NH_FOLLOWS_TERM);
    add(f, f->w.s->slash);
    bracketed(f, below, depth);
}

static void call(flow *f, const nh_formula_node *e, int depth)
{
    const nh_typeset_script *s = f->w.s;
    bool root = !strcmp(e->text, "sqrt"), bar = !strcmp(e->text, "abs"), named = nh_typeset_is_named(e->text);
    const nh_formula_node *first = e->child;
    size_t k = 0;
    if (named) first = nh_typeset_named_head(&f->w, e);
    else if (!root && !bar) nh_typeset_function(&f->w, e->text);
    if (!root && !bar) add(f, s->apply);
    bool high = tall(f, e);
    add(f, bar ? s->wide_bar : high ? s->tall_open : s->wide_open);
    for (const nh_formula_node *c = first; c; c = c->next) {
        open_up(f, c, depth + 1);
        if (c->next && named) nh_typeset_named_comma(&f->w, e->text, k++);
        else if (c->next) add(f, s->comma);
        if (c->next) may_break(f, of_sum(depth + 1), NH_FOLLOWS_TERM);
    }
    if (root) add(f, s->power[0]);
    add(f, bar ? s->wide_bar : high ? s->tall_close : s->wide_close);
    if (root)
        nh_text_addf(&f->text, "%s%s%s1%s%s%s2%s%s%s", s->power[1], s->group[0], s->number[0], s->number[1], s->slash,
                     s->number[0], s->number[1], s->group[1], s->power[2]);
}

static void power(flow *f, const nh_formula_node *e, int depth)
{
    const nh_typeset_script *s = f->w.s;
    bool high = tall(f, e->child);
    add(f, high ? s->tall_open : s->wide_open);
    open_up(f, e->child, depth + 1);
    add(f, s->power[0]);
    add(f, high ? s->tall_close : s->wide_close);
    add(f, s->power[1]);
    add(f, s->group[0]);
    nh_typeset_put(&f->w, e->child->next);
    add(f, s->group[1]);
    add(f, s->power[2]);
}

static void open_up(flow *f, const nh_formula_node *e, int depth)
{
    if (e->kind == NH_FORMULA_NODE_EQUATION) {
        open_up(f, e->child, depth);
        may_break(f, 0, NH_FOLLOWS_TERM);
        add(f, f->w.s->equal);
        open_up(f, e->child->next, depth);
    } else if (e->kind == NH_FORMULA_NODE_SUM) {
        sum(f, e, depth);
    } else if (!wide(f, e)) {
        nh_typeset_put(&f->w, e);
    } else if (e->kind == NH_FORMULA_NODE_MINUS) {
        add(f, f->w.s->minus);
        factor(f, e->child, true, depth);
    } else if (e->kind == NH_FORMULA_NODE_PRODUCT) {
        factors(f, e->child, true, true, false, depth);
    } else if (e->kind == NH_FORMULA_NODE_FRACTION) {
        fraction(f, e, depth);
    } else if (e->kind == NH_FORMULA_NODE_CALL) {
        call(f, e, depth);
    } else if (e->kind == NH_FORMULA_NODE_POWER) {
        power(f, e, depth);
    } else {
        nh_typeset_put(&f->w, e);
    }
}

size_t nh_typeset_pieces(const char *text, nh_typeset_form form, double widest, nh_typeset_piece *piece, void *context)
{
    nh_arena *arena = nh_arena_create();
    const nh_formula_node *e = nh_typeset_read(arena, text);
    flow f = {.widest = widest, .piece = piece, .context = context};
    f.w = (nh_typeset_writer){form, nh_typeset_script_of(form), &f.text};
    nh_text_init(&f.text);
    if (e) open_up(&f, e, 0);
    if (e) piece(context, nh_text_string(&f.text), NH_FOLLOWS_NOTHING);
    nh_text_clear(&f.text);
    nh_arena_free(arena);
    return e ? f.count + 1 : 0;
}

double nh_typeset_width(const char *text)
{
    nh_arena *arena = nh_arena_create();
    const nh_formula_node *e = nh_typeset_read(arena, text);
    double all = e ? width(e) : 0;
    nh_arena_free(arena);
    return all;
}
