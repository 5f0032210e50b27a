/* The first screen of a classification: which values have more, what is new there, what is excluded. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/print.h"

/* A place in the space of the parameters, and what is conserved there. */
typedef struct {
    const char *where;
    const nh_analysis *r; /* NULL: nothing was constructed, for the reason `why` */
    size_t count;
    const size_t *index;     /* of its currents; NULL: the first `count` */
    size_t first, complete;  /* degrees */
    const char *why, *shown; /* shown: what another question found */
} place;

typedef struct {
    const nh_classified *family;
    nh_text *out;
    bool colour;
    size_t places, capacity;
    place *place;
} screen;

static void add_place(screen *x, place one)
{
    if (x->places == x->capacity) {
        x->capacity = 2 * x->capacity + 8;
        x->place = nh_realloc_array(x->place, x->capacity, sizeof *x->place);
    }
    x->place[x->places++] = one;
}

static void add_value(screen *x, const char *where, const nh_classified_value *at, size_t first)
{
    const nh_analysis *r = at->result;
    add_place(x, (place){.where = where,
                         .r = r,
                         .count = r ? r->count + r->furthers : 0,
                         .first = first,
                         .complete = at->complete,
                         .why = at->why,
                         .shown = at->shown});
}

static void add_along(screen *x, const char *where, const nh_classified *along, size_t first, size_t complete,
                      const char *why)
{
    add_place(x, (place){.where = where,
                         .r = along ? along->almost_all : NULL,
                         .count = along ? along->known : 0,
                         .index = along ? along->currents : NULL,
                         .first = first,
                         .complete = complete,
                         .why = why});
}

/* ---- what is conserved at a place ---- */

static char *text_of(const nh_analysis *r, const nh_current *f)
{
    return nh_print_string(r->model->dag, nh_current_signed(r, f, nh_classification_formula(r, f)));
}

/* Is the quantity one of those for almost all values?  Their meanings agree (energy, momenta), or their texts. */
static bool is_known(const screen *x, const nh_current *f, const char *text)
{
    const nh_classified *y = x->family;
    bool known = false;
    for (size_t k = 0; k < y->known && !known; k++) {
        const nh_current *g = nh_classified_current(y->almost_all, y->currents[k]);
        char *other = text_of(y->almost_all, g);
        known = (*g->meaning && !strcmp(g->meaning, f->meaning)) || !strcmp(other, text);
        nh_free(other);
    }
    return known;
}

/* At a special value a function of the others is shown where it is one of those that are more, by its degree. */
static void put_currents(const screen *x, const place *at, bool all, nh_text *block)
{
    enum { most_lines = 4 };
    for (size_t k = 0; k < at->count; k++) {
        size_t i = at->index ? at->index[k] : k;
        const nh_current *f = nh_classified_current(at->r, i);
        bool further = i >= at->r->count && at->r->further[i - at->r->count].degree <= at->first,
             follows = f->independence == NH_DEPENDENT || i >= at->r->count;
        if (!f->proof.proved || f->series || (!all && follows && !further)) continue;
        char *text = text_of(at->r, f);
        if (all || !is_known(x, f, text))
            nh_screen_put(block, x->colour, 2, nh_current_label(at->r, f), text, most_lines, NULL);
        nh_free(text);
    }
}

static void put_place(const screen *x, const place *at, nh_text *block)
{
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(block, x->colour ? "\n\033[1m%s\033[0m\n" : "\n%s\n", at->where);
    bool exact = at->complete >= at->first;
    if (at->shown)
        nh_text_addf(&words, "%c%s%s.", toupper((unsigned char)at->shown[0]), at->shown + 1, exact ? ", proved" : "");
    else if (!at->r)
        nh_text_addf(&words, "There are more by their number; they were not constructed: %s.",
                     at->why ? at->why : "the run was ended");
    else {
        put_currents(x, at, false, block);
        nh_text_addf(&words, "More from degree %zu on. ", at->first);
        if (exact)
            nh_text_addf(&words, "All are proved; others up to degree %zu are functions of those listed.",
                         at->complete);
        else nh_text_add(&words, "Proved, but not all that were counted were constructed.");
    }
    nh_screen_say(block, 2, &words);
}

static void put_places(screen *x, size_t tail)
{
    const nh_classified *y = x->family;
    nh_text block;
    nh_text_init(&block);
    size_t left = 0;
    if (!y->question && y->known) {
        nh_text_addf(&block, x->colour ? "\n\033[1many %s\033[0m\n" : "\nany %s\n", y->second ? "values" : y->over);
        put_currents(x, &(place){.r = y->almost_all, .count = y->known, .index = y->currents}, true, &block);
        nh_screen_fit(x->out, &block, tail);
    }
    for (size_t k = 0; k < x->places; k++) {
        put_place(x, &x->place[k], &block);
        left += !nh_screen_fit(x->out, &block, tail + 2);
    }
    if (left) nh_text_addf(x->out, "\n%zu more place%s: --details\n", left, left == 1 ? "" : "s");
}

/* ---- one parameter ---- */

/* "eps = 1 and eps = 6"; nothing where they are many. */
static void put_list(const screen *x, nh_text *out)
{
    enum { most = 5 };
    for (size_t k = 0; k < x->places && x->places <= most; k++)
        nh_text_addf(out, "%s%s", !k ? ": " : k + 1 < x->places ? ", " : " and ", x->place[k].where);
    nh_text_add(out, ".");
}

static const char *up_to(const nh_classified *x, size_t degree)
{
    return x->question ? "" : nh_arena_printf(x->arena, " for polynomials in the velocities up to degree %zu", degree);
}

/* What is excluded at all degrees. */
static void put_rest(const screen *x, const nh_classification *c, nh_text *out)
{
    const char *other = x->places ? "other " : "";
    size_t theorems = 0, unlifted = nh_classification_unlifted(x->family);
    double height = INFINITY;
    for (size_t d = 0; d < c->rows; d++) {
        theorems += c->row[d].theorem;
        if (!c->row[d].theorem) height = fmin(height, c->row[d].lifted ? c->row[d].height : 0);
    }
    if (theorems == c->rows) {
        nh_text_addf(out,
                     x->places ? " No other number has, real or complex: proved%s."
                               : " This is proved%s, for all numbers, real or complex.",
                     up_to(x->family, c->rows));
        return;
    }
    nh_text_addf(
        out, " No %stranscendental number has%s: proved%s.", other,
        height < 1 ? "" : nh_arena_printf(x->family->arena, ", and no %sfraction with terms up to %.1e", other, height),
        up_to(x->family, c->rows));
    if (unlifted)
        nh_text_addf(out, " Up to %zu algebraic number%s, known modulo primes only, may have.", unlifted,
                     unlifted == 1 ? "" : "s");
    else nh_text_add(out, " Irrational algebraic numbers are almost, but not completely, ruled out.");
}

static void of_line(screen *x, const nh_classified *y, nh_text *words)
{
    const nh_classification *c = y->classification;
    for (size_t k = 0; k < c->values; k++)
        if (c->value[k].first && !c->value[k].degenerate)
            add_value(x, nh_classified_words(y, &c->value[k].polynomial), &y->value[k], c->value[k].first);
    if (!c->rows) {
        nh_text_add(words, "Undecided: no degree could be counted.");
        return;
    }
    if (x->places) nh_text_addf(words, "%zu", x->places);
    else nh_text_add(words, nh_classification_unlifted(y) ? "No known" : "No");
    nh_text_addf(words, " value%s of %s %s %s", x->places > 1 ? "s" : "", y->over, x->places > 1 ? "have" : "has",
                 nh_classification_more(y));
    put_list(x, words);
    put_rest(x, c, words);
}

/* ---- two and three parameters ---- */

static void put_number(const nh_classified *y, const char *const *noun, const size_t *n, size_t kinds, nh_text *words)
{
    for (size_t i = 0, told = 0; i < kinds; i++, told++)
        nh_text_addf(words, "%s%zu %s%s",
                     !told           ? ""
                     : i + 1 < kinds ? ", "
                                     : " and ",
                     n[i], noun[i], n[i] == 1 ? "" : "s");
    nh_text_addf(words, " with %s.", nh_classification_more(y));
}

static void of_plane(screen *x, const nh_classified_plane *y, nh_text *words)
{
    const nh_plane *o = y->plane;
    size_t n[2] = {0, y->points};
    double height = INFINITY;
    for (size_t k = 0; k < o->curves; k++) {
        const nh_plane_curve *c = &o->curve[k];
        if (!c->first || c->degenerate) continue;
        add_along(x, nh_classified_surface_words(y->family, &c->polynomial), y->curve[k].along, c->first,
                  y->curve[k].complete, y->curve[k].why);
        n[0]++;
    }
    for (size_t k = 0; k < y->points; k++)
        add_value(x, nh_classification_place(y, &y->point[k]), y->point[k].at, y->point[k].first);
    put_number(y->family, (const char *[]){"curve", "point"}, n, 2, words);
    for (size_t d = 0; d < o->rows; d++) height = fmin(height, o->row[d].lifted ? o->row[d].height : 0);
    if (o->rows && height >= 1)
        nh_text_addf(words, " No other pair of fractions with terms up to %.1e has: proved%s.", height,
                     up_to(y->family, o->rows));
    else if (o->rows) nh_text_add(words, " Others are known modulo primes only (--details).");
}

static void of_space(screen *x, const nh_classified_space *y, nh_text *words)
{
    size_t n[3] = {0, y->curves, y->points};
    for (size_t k = 0; k < y->parts; k++) {
        const nh_classified_part *part = &y->part[k];
        const nh_plane_curve *s = part->surface == SIZE_MAX ? NULL : &y->space->surface[part->surface];
        if (!s || !s->first || s->degenerate) continue;
        add_along(x, nh_classified_surface_words(y->family, &s->polynomial), part->within ? part->within->family : NULL,
                  s->first, part->complete, part->why);
        n[0]++;
    }
    for (size_t k = 0; k < y->curves; k++) {
        const nh_classified_plane *within = y->part[y->curve[k].part].within;
        const nh_classified_curve *c = &within->curve[y->curve[k].index];
        add_along(x, y->curve[k].where, c->along, within->plane->curve[y->curve[k].index].first, c->complete, c->why);
    }
    for (size_t k = 0; k < y->points; k++)
        add_value(x, nh_classification_space_place(y, &y->point[k]), y->point[k].at->at, y->point[k].at->first);
    put_number(y->family, (const char *[]){"surface", "curve", "point"}, n, 3, words);
    nh_text_add(words, " Other values are excluded only in part (--details).");
}

void nh_classification_write_answer(const nh_classified *line, const nh_classified_plane *plane,
                                    const nh_classified_space *space, bool colour, nh_text *out)
{
    enum { tail = 5 };
    const nh_classified *family = space ? space->family : plane ? plane->family : line;
    const char *obstacle = space   ? space->space->obstacle
                           : plane ? plane->plane->obstacle
                                   : line->classification->obstacle;
    screen x = {.family = family, .out = out, .colour = colour};
    nh_text words, left;
    nh_text_init(&words);
    nh_text_init(&left);
    const char *const open[3] = {family->over, family->second, family->third};
    if (obstacle) nh_text_addf(&words, "Nothing can be said: %s.", obstacle);
    else if (space) of_space(&x, space, &words);
    else if (plane) of_plane(&x, plane, &words);
    else of_line(&x, line, &words);
    nh_screen_begin(out, colour, family->almost_all->system, open, &words);
    if (!obstacle) put_places(&x, tail);
    if (line && !obstacle) nh_classification_left(line, &left);
    else if (plane && !obstacle) nh_classification_plane_left(plane, &left);
    size_t rows = space ? space->space->rows : plane ? plane->plane->rows : line->classification->rows;
    const char *end = space ? space->space->end : plane ? plane->plane->end : line->classification->end;
    char why[200];
    if (end && !obstacle)
        nh_text_addf(&left, "Degree %zu was not reached: %s.\n", rows + 1, nh_classification_end(end, why, sizeof why));
    if (left.length) {
        nh_text block;
        nh_text_init(&block);
        nh_text_add(&block, "\n");
        nh_screen_fold(nh_text_string(&left), &block);
        nh_screen_fit(out, &block, 3);
    }
    nh_text_clear(&left);
    nh_screen_more(out, "how many of each degree, and how other values are excluded", NULL);
    nh_free(x.place);
}
