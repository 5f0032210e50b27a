/* A classification as a document. */
#include <string.h>

#include "document/classification_internal.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/print.h"

typedef nh_pen pen;

/* ---- pieces ---- */

/* Writes every line as words, without leading blanks; clears the text. */
static void write_lines(pen *p, nh_text *text)
{
    char *line = nh_strdup(nh_text_string(text));
    for (char *at = line, *end; *at; at = end) {
        at += strspn(at, " \n");
        end = at + strcspn(at, "\n");
        if (*end) *end++ = 0;
        if (*at) nh_pen_words(p, "%s", at);
    }
    nh_free(line);
    nh_text_clear(text);
}

/* The currents with these indices (NULL: the first ones), also functions of others that are polynomial in the
 * velocities: the numbers by degree count them. */
static void write_currents(pen *p, const nh_analysis *result, size_t count, const size_t *index)
{
    for (size_t k = 0; k < count; k++) {
        const nh_current *f = nh_classified_current(result, index ? index[k] : k);
        if (!f->proof.proved || f->series) continue;
        nh_ex e = nh_current_signed(result, f, nh_classification_formula(result, f));
        char *text = nh_print_short(result->question->model->dag, e, result->question->options.shown);
        if (text) p->ink->equation(p->to, strcmp(nh_current_label(result, f), "E = ") ? f->name : "E", text);
        else nh_pen_words(p, "A longer current (option `shown`).");
        nh_free(text);
    }
}

/* "B", "A and B": the parameters that vary on a curve or surface. */
static const char *varying_names(const nh_classified *x, const nh_classified_place *at)
{
    const char *names = NULL;
    for (size_t v = x->parameters; v-- > 0;) {
        bool given = false;
        for (size_t k = 0; k < at->zeros.count; k++) given |= at->zeros.gives[k] == (int)v;
        if (!given) names = names ? nh_arena_printf(x->arena, "%s and %s", names, x->over[v]) : x->over[v];
    }
    return names;
}

static void write_finding(const nh_classified *x, pen *p, const nh_classified_place *at)
{
    const nh_classified_finding *f = &at->finding;
    bool all = f->complete >= at->first;
    if (f->shown) nh_pen_words(p, "%s%s.", f->shown, all ? ", proved" : "");
    else if (!f->result)
        nh_pen_words(p, "Counted modulo primes%s%s.",
                     x->question ? "; " : ". No currents: ", f->why ? f->why : "the run was ended");
    else {
        write_currents(p, f->result, f->count, f->index);
        if (!all)
            nh_pen_words(p, "Proved, but fewer than were counted: the others were not constructed, or hold in a region "
                            "only.");
        else if (at->dimension && x->parameters > 1)
            nh_pen_words(p, "All proved for every %s; for almost all the list is complete up to degree %zu.",
                         varying_names(x, at), f->complete);
        else nh_pen_words(p, "All proved; the list is complete up to degree %zu.", f->complete);
    }
}

/* ---- the whole ---- */

static void write_places(const nh_classified *x, pen *p)
{
    static const char *const id[] = {"points", "curves", "surfaces"}, *const title[] = {"More at the points",
                                                                                        "More on the curves",
                                                                                        "More on the surfaces"};
    nh_text text;
    nh_text_init(&text);
    for (size_t k = 0; k < x->places; k++) {
        const nh_classified_place *at = &x->place[k];
        if (k == 0 || at->dimension != at[-1].dimension) {
            if (x->parameters == 1) nh_pen_section(p, "special", nh_classification_where(x));
            else nh_pen_section(p, id[at->dimension], title[at->dimension]);
        }
        nh_pen_place_card(p, at->where);
        nh_classification_numbers(x, at, &text);
        write_lines(p, &text);
        write_finding(x, p, at);
    }
}

static void write_sections(const nh_classified *x, pen *p)
{
    nh_text text;
    nh_text_init(&text);
    if (x->parameters > 1 && !p->ink->brief) {
        nh_pen_section(p, "picture", x->parameters == 3 ? "Slices" : "The plane of both parameters");
        nh_classification_picture(x, p);
    }
    nh_pen_section(p, "almost",
                   x->parameters > 1 ? "For almost all values"
                                     : nh_arena_printf(x->arena, "For almost all %s", x->over[0]));
    for (size_t d = 1; d <= x->classification->rows; d++) nh_classification_almost_all(x, d, &text);
    write_lines(p, &text);
    write_currents(p, x->almost_all, x->known, x->currents);
    write_places(x, p);
    nh_pen_section(p, "excluded", "What is excluded");
    nh_classification_left(x, &text);
    nh_classification_excluded(x, &text);
    write_lines(p, &text);
    char room[200];
    const char *why = nh_classification_end(x, room, sizeof room);
    if (why && x->question) nh_pen_words(p, "The question was not answered: %s.", why);
    else if (why) nh_pen_words(p, "Degree %zu was not reached: %s.", x->classification->rows + 1, why);
}

/* "2 values of eps have more ..", "1 curve and 2 points with more .." */
static void write_headline(const nh_classified *x, pen *p)
{
    const nh_classification *c = x->classification;
    if (c->obstacle) {
        nh_pen_say(p, "Nothing can be said: %s.", c->obstacle);
        return;
    }
    size_t unlifted = x->parameters == 1 ? nh_classification_unlifted(x) : 0;
    if (x->parameters == 1) {
        if (x->places) nh_pen_say(p, "%zu value%s of ", x->places, x->places == 1 ? "" : "s");
        else nh_pen_say(p, unlifted ? "No known value of " : "No value of ");
        nh_pen_name(p, x->over[0]);
        nh_pen_say(p, x->places > 1 ? " have %s" : " has %s", nh_classification_more(x));
    } else {
        for (size_t d = x->parameters, n; d-- > 0;) {
            const char *kind = nh_classification_kind(x, d, &n);
            nh_pen_say(p, "%zu %s%s%s", n, kind, n == 1 ? "" : "s", d > 1 ? ", " : d == 1 ? " and " : " with ");
        }
        nh_pen_say(p, "%s", nh_classification_more(x));
    }
    if (x->question) nh_pen_say(p, ".");
    else nh_pen_say(p, " (searched: polynomials in the velocities up to degree %zu).", c->rows);
    if (unlifted)
        nh_pen_say(p, " Up to %zu algebraic value%s, known modulo primes only, may have more.", unlifted,
                   unlifted == 1 ? "" : "s");
}

void nh_classification_write(const nh_classified *x, const nh_run *run, nh_pen_style style, nh_text *out)
{
    static const char *const picture[] = {"", "picture|The plane|", "picture|Slices|"};
    if (nh_screen_is_wanted(style)) {
        nh_classification_write_answer(x, style.colour, out);
        return;
    }
    const nh_analysis *result = x->almost_all;
    nh_model *model = result->question->model;
    nh_pen_subject subject = {.system = result->question->system,
                              .dag = model->dag,
                              .chart = model->chart,
                              .shown = run->shown,
                              .open = {x->over[0], x->over[1], x->over[2]}};
    pen all, *p = &all;
    nh_text head;
    nh_text_init(&head);
    nh_pen_begin(p, style, &subject, "classification", out);
    nh_pen_open(p, NH_PEN_ANSWER, "found", NULL);
    write_headline(x, p);
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_classification_head(x, &head);
    write_lines(p, &head);
    p->ink->links(p->to, nh_arena_printf(x->arena,
                                         "%salmost|For almost all values|excluded|What is excluded|system|System|"
                                         "words|Words|repeat|Repeat it",
                                         picture[x->parameters - 1]));
    if (!x->classification->obstacle) write_sections(x, p);
    nh_pen_system(p, model, NULL);
    nh_pen_glossary(p, "current, degree, proved, complete");
    nh_pen_end(p, run);
}
