/* A classification as a document. */
#include <string.h>

#include "document/classification_internal.h"
#include "document/current_words.h"
#include "document/screen.h"
#include "graph/print.h"

typedef nh_classified_plane plane;
typedef nh_pen pen;

/* ---- pieces ---- */

/* Writes every line as words, without leading blanks. */
void nh_classification_write_lines(pen *p, nh_text *text)
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

void nh_classification_write_currents(pen *p, const nh_analysis *r, size_t count, const size_t *index)
{
    if (!index) count = r->count + r->furthers;
    for (size_t k = 0; k < count; k++) {
        const nh_current *f = nh_classified_current(r, index ? index[k] : k);
        if (!f->proof.proved || f->series) continue;
        nh_ex e = nh_current_signed(r, f, nh_classification_formula(r, f));
        char *text = nh_print_short(r->model->dag, e, r->options.shown);
        if (text) p->ink->equation(p->to, strcmp(nh_current_label(r, f), "E = ") ? f->name : "E", text);
        else nh_pen_words(p, "A longer current (option `shown`).");
        nh_free(text);
    }
}

void nh_classification_write_numbers(const nh_classified *x, pen *p, size_t rows, const nh_classify_number *n,
                                     size_t first, size_t complete, const size_t *almost_all)
{
    nh_text text;
    nh_text_init(&text);
    for (size_t d = first; d <= rows; d++)
        nh_classification_counted(x, d, d == first, &n[d], almost_all[d], complete >= d, &text);
    nh_text_add(&text, ".");
    nh_classification_write_lines(p, &text);
}

void nh_classification_write_no_currents(const nh_classified *x, pen *p, const char *why)
{
    nh_pen_words(p, "Counted modulo primes%s%s.",
                 x->question ? "; " : ". No currents: ", why ? why : "the run was ended");
}

const char nh_classification_fewer[] =
    "Proved, but fewer than were counted: the others were not constructed, or hold in a region only.";

void nh_classification_write_value(const nh_classified *x, pen *p, const nh_classified_value *at, size_t first)
{
    if (at->shown) {
        nh_pen_words(p, "%s%s.", at->shown, at->complete >= first ? ", proved" : "");
        return;
    }
    if (!at->result) {
        nh_classification_write_no_currents(x, p, at->why);
        return;
    }
    nh_classification_write_currents(p, at->result, 0, NULL);
    if (at->complete >= first) nh_pen_words(p, "All proved; the list is complete up to degree %zu.", at->complete);
    else nh_pen_words(p, "%s", nh_classification_fewer);
}

void nh_classification_write_almost_all(const nh_classified *x, pen *p, nh_text *degrees)
{
    nh_pen_section(p, "almost",
                   x->second ? "For almost all values" : nh_arena_printf(x->arena, "For almost all %s", x->over));
    nh_classification_write_lines(p, degrees);
    nh_classification_write_currents(p, x->almost_all, x->known, x->currents);
}

/* ---- one parameter ---- */

static void outline_line(const nh_classified *x, pen *p)
{
    const nh_classification *c = x->classification;
    size_t almost_all[NH_COUNT_HIGHEST_DEGREE + 1] = {0}, written = 0;
    nh_text text;
    nh_text_init(&text);
    for (size_t d = 1; d <= c->rows; d++) {
        almost_all[d] = c->row[d - 1].number.bound;
        nh_classification_almost_all(x, d, &c->row[d - 1].number, c->row[d - 1].known, &text);
    }
    nh_classification_write_almost_all(x, p, &text);
    for (size_t k = 0; k < c->values; k++) {
        const nh_classify_value *v = &c->value[k];
        if (!v->first || v->degenerate) continue;
        if (!written++) nh_pen_section(p, "special", nh_classification_where(x));
        nh_pen_place_card(p, nh_classified_words(x, &v->polynomial));
        nh_classification_write_numbers(x, p, c->rows, v->number, v->first, x->value[k].exact, almost_all);
        nh_classification_write_value(x, p, &x->value[k], v->first);
    }
    nh_pen_section(p, "excluded", "What is excluded");
    nh_classification_left(x, &text);
    nh_classification_excluded(x, &text);
    nh_classification_write_lines(p, &text);
    char words[200];
    if (c->end && x->question)
        nh_pen_words(p, "The question was not answered: %s.", nh_classification_end(c->end, words, sizeof words));
    else if (c->end)
        nh_pen_words(p, "Degree %zu was not reached: %s.", c->rows + 1,
                     nh_classification_end(c->end, words, sizeof words));
}

/* ---- two parameters ---- */

static void outline_curve(const plane *x, pen *p, size_t k, const size_t *almost_all)
{
    const nh_plane_curve *c = &x->plane->curve[k];
    const nh_classified_curve *at = &x->curve[k];
    nh_pen_place_card(p, nh_classified_surface_words(x->family, &c->polynomial));
    nh_classification_write_numbers(x->family, p, x->plane->rows, c->number, c->first, at->complete, almost_all);
    if (!at->along) {
        nh_classification_write_no_currents(x->family, p, at->why);
        return;
    }
    nh_classification_write_currents(p, at->along->almost_all, at->along->known, at->along->currents);
    if (at->complete)
        nh_pen_words(p, "All proved for every %s; for almost all the list is complete up to degree %zu.",
                     at->along->over, at->complete);
    else nh_pen_words(p, "%s", nh_classification_fewer);
}

const char *nh_classification_place(const plane *x, const nh_classified_point *q)
{
    nh_text text;
    nh_text_init(&text);
    for (int v = 1; v >= 0; v--)
        nh_text_addf(&text, q->about[v] - q->about[v] == 0 ? "%s%s = %s" : "%s%.0s%s", v ? "" : ", ", x->over[v],
                     q->value[v]);
    if (q->curve != SIZE_MAX)
        nh_text_addf(&text, "   (on %s)",
                     nh_classified_surface_words(x->family, &x->plane->curve[q->curve].polynomial));
    const char *out = nh_arena_strdup(x->family->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

static void outline_plane(const plane *x, pen *p)
{
    const nh_plane *o = x->plane;
    size_t almost_all[NH_COUNT_HIGHEST_DEGREE + 1] = {0}, written = 0;
    nh_text text;
    nh_text_init(&text);
    if (!p->ink->brief) {
        nh_pen_section(p, "picture", "The plane of both parameters");
        nh_classification_picture(x, p);
    }
    for (size_t d = 1; d <= o->rows; d++) {
        almost_all[d] = o->row[d - 1].number.bound;
        nh_classification_almost_all(x->family, d, &o->row[d - 1].number, o->row[d - 1].known, &text);
    }
    nh_classification_write_almost_all(x->family, p, &text);
    for (size_t k = 0; k < o->curves; k++) {
        if (!o->curve[k].first || o->curve[k].degenerate) continue;
        if (!written++) nh_pen_section(p, "curves", "More on the curves");
        outline_curve(x, p, k, almost_all);
    }
    for (size_t k = 0; k < x->points; k++) {
        const nh_classified_point *q = &x->point[k];
        if (!k) nh_pen_section(p, "points", "More at the points");
        nh_pen_place_card(p, nh_classification_place(x, q));
        nh_classification_write_numbers(x->family, p, o->rows, q->number, q->first, q->at->exact, almost_all);
        nh_classification_write_value(x->family, p, q->at, q->first);
    }
    nh_pen_section(p, "excluded", "What is excluded");
    nh_classification_plane_left(x, &text);
    nh_classification_plane_excluded(x, &text);
    nh_classification_write_lines(p, &text);
    char words[200];
    if (o->end)
        nh_pen_words(p, "Degree %zu was not reached: %s.", o->rows + 1,
                     nh_classification_end(o->end, words, sizeof words));
}

static size_t count_line(const nh_classified *x)
{
    size_t n = 0;
    for (size_t k = 0; k < x->classification->values; k++)
        n += x->classification->value[k].first > 0 && !x->classification->value[k].degenerate;
    return n;
}

/* "1 curve and 2 points with more conservation laws" */
static void answer(pen *p, const nh_classified *line, const plane *x, const nh_classified_space *y)
{
    const nh_classified *family = y ? y->family : x ? x->family : line;
    const char *obstacle = y ? y->space->obstacle : x ? x->plane->obstacle : line->classification->obstacle;
    size_t curves = 0, rows = y ? y->space->rows : x ? x->plane->rows : line->classification->rows;
    for (size_t k = 0; x && k < x->plane->curves; k++)
        curves += x->plane->curve[k].first && !x->plane->curve[k].degenerate;
    if (obstacle) {
        nh_pen_say(p, "Nothing can be said: %s.", obstacle);
        return;
    }
    if (y) nh_classification_space_answer(y, p);
    else if (x)
        nh_pen_say(p, "%zu curve%s and %zu point%s with %s", curves, curves == 1 ? "" : "s", x->points,
                   x->points == 1 ? "" : "s", nh_classification_more(family));
    else {
        size_t n = count_line(line), unlifted = nh_classification_unlifted(line);
        if (n) nh_pen_say(p, "%zu value%s of ", n, n == 1 ? "" : "s");
        else nh_pen_say(p, unlifted ? "No known value of " : "No value of ");
        nh_pen_name(p, line->over);
        nh_pen_say(p, n > 1 ? " have %s" : " has %s", nh_classification_more(line));
    }
    if (line && line->question) nh_pen_say(p, ".");
    else nh_pen_say(p, " (searched: polynomials in the velocities up to degree %zu).", rows);
    size_t unlifted = line && !obstacle && !x && !y ? nh_classification_unlifted(line) : 0;
    if (unlifted)
        nh_pen_say(p, " Up to %zu algebraic value%s, known modulo primes only, may have more.", unlifted,
                   unlifted == 1 ? "" : "s");
}

void nh_classification_write(const nh_classified *line, const plane *x, const nh_classified_space *y, const nh_run *run,
                             nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        nh_classification_write_answer(line, x, y, style.colour, out);
        return;
    }
    static const char over_one[] = "almost|For almost all values|excluded|What is "
                                   "excluded|system|System|words|Words|repeat|Repeat it";
    const nh_classified *family = y ? y->family : x ? x->family : line;
    const nh_analysis *r = family->almost_all;
    nh_pen_subject subject = {.system = r->system,
                              .dag = r->model->dag,
                              .chart = r->model->chart,
                              .shown = run->shown,
                              .open = {family->over, family->second, family->third}};
    pen all, *p = &all;
    nh_text head;
    nh_text_init(&head);
    nh_pen_begin(p, style, &subject, "classification", out);
    nh_pen_open(p, NH_PEN_ANSWER, "found", NULL);
    answer(p, line, x, y);
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_classification_head(family, &head);
    nh_classification_write_lines(p, &head);
    const char *picture = y ? "picture|Slices" : x ? "picture|The plane" : NULL;
    p->ink->links(p->to, picture ? nh_arena_printf(family->arena, "%s|%s", picture, over_one) : over_one);
    if (y && !y->space->obstacle) nh_classification_outline_space(y, p);
    else if (x && !x->plane->obstacle) outline_plane(x, p);
    else if (line && !line->classification->obstacle) outline_line(line, p);
    nh_pen_system(p, r->model, NULL);
    nh_pen_glossary(p, "current, degree, proved, complete");
    nh_pen_end(p, run);
}
