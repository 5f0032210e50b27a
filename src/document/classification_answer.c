/* The first screen of a classification: which values have more, what is new there, what is excluded. */
#include <ctype.h>
#include <math.h>
#include <string.h>

#include "document/classification_internal.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/print.h"

/* ---- what is conserved at a place ---- */

static char *text_of(const nh_analysis *result, const nh_current *f)
{
    return nh_print_string(result->question->model->dag,
                           nh_current_signed(result, f, nh_classification_formula(result, f)));
}

/* Is the quantity one of those for almost all values?  Their meanings agree (energy, momenta), or their texts. */
static bool is_known(const nh_classified *x, const nh_current *f, const char *text)
{
    bool known = false;
    for (size_t k = 0; k < x->known && !known; k++) {
        const nh_current *g = nh_classified_current(x->almost_all, x->currents[k]);
        char *other = text_of(x->almost_all, g);
        known = (*g->meaning && !strcmp(g->meaning, f->meaning)) || !strcmp(other, text);
        nh_free(other);
    }
    return known;
}

/* At a special value a function of the others is shown where it is one of those that are more, by its degree; `all`:
 * those for almost all values. */
static void put_currents(const nh_classified *x, const nh_classified_finding *at, size_t first, bool all, bool colour,
                         nh_text *block)
{
    enum { most_lines = 4 };
    const nh_analysis *result = at->result;
    const nh_current_list *list = result->list;
    for (size_t k = 0; k < at->count; k++) {
        size_t i = at->index ? at->index[k] : k;
        const nh_current *f = nh_classified_current(result, i);
        bool further = i >= list->count && list->further[i - list->count].degree <= first,
             follows = f->independence == NH_DEPENDENT || i >= list->count;
        if (!f->proof.proved || f->series || (!all && follows && !further)) continue;
        char *text = text_of(result, f);
        if (all || !is_known(x, f, text))
            nh_screen_put(block, colour, 2, nh_current_label(result, f), text, most_lines, NULL);
        nh_free(text);
    }
}

static void put_place(const nh_classified *x, const nh_classified_place *at, bool colour, nh_text *block)
{
    const nh_classified_finding *f = &at->finding;
    nh_text words;
    nh_text_init(&words);
    nh_text_addf(block, colour ? "\n\033[1m%s\033[0m\n" : "\n%s\n", at->where);
    bool exact = f->complete >= at->first;
    if (f->shown)
        nh_text_addf(&words, "%c%s%s.", toupper((unsigned char)f->shown[0]), f->shown + 1, exact ? ", proved" : "");
    else if (!f->result)
        nh_text_addf(&words, "There are more by their number; they were not constructed: %s.",
                     f->why ? f->why : "the run was ended");
    else {
        put_currents(x, f, at->first, false, colour, block);
        nh_text_addf(&words, "More from degree %zu on. ", at->first);
        if (exact)
            nh_text_addf(&words, "All are proved; others up to degree %zu are functions of those listed.", f->complete);
        else nh_text_add(&words, "Proved, but not all that were counted were constructed.");
    }
    nh_screen_say(block, 2, &words);
}

static void put_places(const nh_classified *x, bool colour, size_t tail, nh_text *out)
{
    nh_text block;
    nh_text_init(&block);
    size_t left = 0;
    if (!x->question && x->known) {
        nh_text_addf(&block, colour ? "\n\033[1many %s\033[0m\n" : "\nany %s\n",
                     x->parameters > 1 ? "values" : x->over[0]);
        put_currents(x, &(nh_classified_finding){.result = x->almost_all, .count = x->known, .index = x->currents}, 0,
                     true, colour, &block);
        nh_screen_fit(out, &block, tail);
    }
    for (size_t k = 0; k < x->places; k++) {
        put_place(x, &x->place[k], colour, &block);
        left += !nh_screen_fit(out, &block, tail + 2);
    }
    if (left) nh_text_addf(out, "\n%zu more place%s: --details\n", left, left == 1 ? "" : "s");
}

/* ---- the headline ---- */

/* "eps = 1 and eps = 6"; nothing where they are many. */
static void put_list(const nh_classified *x, nh_text *out)
{
    enum { most = 5 };
    for (size_t k = 0; k < x->places && x->places <= most; k++)
        nh_text_addf(out, "%s%s", !k ? ": " : k + 1 < x->places ? ", " : " and ", x->place[k].where);
    nh_text_add(out, ".");
}

static const char *up_to(const nh_classified *x)
{
    return x->question ? ""
                       : nh_arena_printf(x->arena, " for polynomials in the velocities up to degree %zu",
                                         x->classification->rows);
}

/* What is excluded at all degrees; the lowest height is that of those without a theorem. */
static void put_rest(const nh_classified *x, size_t theorems, double height, nh_text *out)
{
    const char *other = x->places ? "other " : "";
    size_t unlifted = nh_classification_unlifted(x);
    if (theorems == x->classification->rows) {
        nh_text_addf(out,
                     x->places ? " No other number has, real or complex: proved%s."
                               : " This is proved%s, for all numbers, real or complex.",
                     up_to(x));
        return;
    }
    nh_text_addf(out, " No %stranscendental number has%s: proved%s.", other,
                 height < 1 ? ""
                            : nh_arena_printf(x->arena, ", and no %sfraction with terms up to %.1e", other, height),
                 up_to(x));
    if (unlifted)
        nh_text_addf(out, " Up to %zu algebraic number%s, known modulo primes only, may have.", unlifted,
                     unlifted == 1 ? "" : "s");
    else nh_text_add(out, " Irrational algebraic numbers are almost, but not completely, ruled out.");
}

static void put_headline(const nh_classified *x, nh_text *words)
{
    const nh_classification *c = x->classification;
    size_t theorems = 0;
    double height = INFINITY;
    if (c->obstacle) {
        nh_text_addf(words, "Nothing can be said: %s.", c->obstacle);
        return;
    }
    for (size_t d = 0; d < c->rows; d++) {
        theorems += c->row[d].theorem;
        if (!c->row[d].theorem) height = fmin(height, c->row[d].lifted ? c->row[d].height : 0);
    }
    if (x->parameters > 1) {
        for (size_t d = x->parameters, n; d-- > 0;) {
            const char *kind = nh_classification_kind(x, d, &n);
            nh_text_addf(words, "%zu %s%s%s", n, kind, n == 1 ? "" : "s", d > 1 ? ", " : d == 1 ? " and " : " with ");
        }
        nh_text_addf(words, "%s.", nh_classification_more(x));
        if (x->parameters == 3) nh_text_add(words, " Other values are excluded only in part (--details).");
        else if (c->rows && height >= 1)
            nh_text_addf(words, " No other pair of fractions with terms up to %.1e has: proved%s.", height, up_to(x));
        else if (c->rows) nh_text_add(words, " Others are known modulo primes only (--details).");
        return;
    }
    if (!c->rows) {
        nh_text_add(words, "Undecided: no degree could be counted.");
        return;
    }
    if (x->places) nh_text_addf(words, "%zu", x->places);
    else nh_text_add(words, nh_classification_unlifted(x) ? "No known" : "No");
    nh_text_addf(words, " value%s of %s %s %s", x->places > 1 ? "s" : "", x->over[0], x->places > 1 ? "have" : "has",
                 nh_classification_more(x));
    put_list(x, words);
    put_rest(x, theorems, height, words);
}

/* ---- the screen ---- */

void nh_classification_write_answer(const nh_classified *x, bool colour, nh_text *out)
{
    enum { tail = 5 };
    char room[200];
    const char *why = nh_classification_end(x, room, sizeof room);
    nh_text words, left, block;
    nh_text_init(&words);
    nh_text_init(&left);
    nh_text_init(&block);
    put_headline(x, &words);
    nh_screen_begin(out, colour, x->almost_all->question->system, x->over, &words);
    if (!x->classification->obstacle) {
        put_places(x, colour, tail, out);
        if (x->parameters < 3) nh_classification_left(x, &left);
        if (why) nh_text_addf(&left, "Degree %zu was not reached: %s.\n", x->classification->rows + 1, why);
    }
    if (left.length) {
        nh_text_add(&block, "\n");
        nh_screen_fold(nh_text_string(&left), &block);
        nh_screen_fit(out, &block, 3);
    }
    nh_text_clear(&left);
    nh_screen_more(out, "how many of each degree, and how other values are excluded", NULL);
}
