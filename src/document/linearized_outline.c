/* linearized_outline: the linear equations as a document. */
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "document/linearized.h"
#include "document/pen.h"

enum { digits = 14 };

static const char *digits_of(const nh_linearized *x, double value)
{
    return nh_arena_printf(x->arena, "%.*g", digits, value == 0 ? 0 : value);
}

/* ---- the state ---- */

static void names(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e, bool closed)
{
    const char *between = "";
    for (size_t i = 0; i < e->s + e->n; i++) {
        if (e->closed[i] != closed) continue;
        nh_pen_say(p, "%s<%s>", between, nh_linearize_name(x, e, i));
        between = ", ";
    }
}

static void put_values(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    const nh_system *s = x->system;
    const char *between = "";
    for (size_t i = 0; i < 2 * e->m; i++) {
        double value = i < e->m ? e->q[i] : e->v[i - e->m];
        if (value == 0) continue;
        nh_ex symbol = i < e->m ? s->coordinate[i].q : s->coordinate[i - e->m].v;
        nh_pen_say(p, "%s<%s> = %s", between, nh_name_of(s->dag, symbol), digits_of(x, value));
        between = ", ";
    }
    nh_pen_say(p, *between ? "; all else is 0" : "at rest, all coordinates 0");
}

static void steadiness(nh_pen *p, const nh_linear_equations *e)
{
    if (e->residual > 0)
        nh_pen_say(p, "no: what the matrix depends on changes, at the rate %.6g at most", e->residual);
    else if (e->changes)
        nh_pen_say(p, "the rates vanish, but the linear equations change with time");
    else if (e->moves) nh_pen_say(p, "yes: what moves does not occur in the linear equations");
    else nh_pen_say(p, "yes: an equilibrium");
}

static void state(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "state", "The state");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, "State");
    put_values(p, x, e);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Steady");
    steadiness(p, e);
    nh_pen_close(p, NH_PEN_FACT);
    if (e->size < e->s + e->n) {
        nh_pen_fact_begin(p, "Left out");
        names(p, x, e, false);
        nh_pen_say(p, ": no rate of the others depends on them");
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
}

/* ---- eigenvalues ---- */

static void eigenvalues(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "eigenvalues", "Eigenvalues");
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "Of the linear equations for ");
    names(p, x, e, true);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
    nh_pen_table(p, "", "#real part|#imaginary part|#error|#times");
    for (size_t i = 0; i < e->eigenvalues; i++) {
        const nh_eigenvalue *z = &e->eigenvalue[i];
        nh_pen_row(p, "%s|%s|%.1g|%zu", digits_of(x, z->re), digits_of(x, z->im), z->error, z->times);
    }
    nh_pen_table_end(p);
}

/* ---- matrices ---- */

static void matrix(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e, const char *caption,
                   const double *entry, size_t columns, size_t first)
{
    nh_text head;
    nh_text_init(&head);
    for (size_t j = 0; j < columns; j++) nh_text_addf(&head, "|#%s", nh_linearize_name(x, e, first + j));
    nh_pen_table(p, caption, nh_text_string(&head));
    for (size_t i = 0; i < e->n; i++) {
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", nh_linearize_name(x, e, e->s + i));
        for (size_t j = 0; j < columns; j++)
            nh_pen_cell(p, NH_PEN_CELL, "%s", digits_of(x, entry[i * columns + j]));
        nh_pen_close(p, NH_PEN_ROW);
    }
    nh_pen_table_end(p);
    nh_text_clear(&head);
}

static void equations(nh_pen *p, const nh_linearized *x, const nh_linear_equations *e)
{
    nh_pen_section(p, "equations", "Linear equations");
    nh_pen_words(p, "M dw' + C dw + K dx = 0: dx deviations of coordinates, dw of their velocities. The dependent ones "
                    "follow from the constraints. Errors of the entries: %.1g at most.", e->error);
    matrix(p, x, e, "M", e->M, e->n, e->s);
    matrix(p, x, e, "C", e->C, e->n, e->s);
    matrix(p, x, e, "K", e->N, e->s, 0);
}

/* ---- along a family ---- */

static void side(nh_pen *p, nh_linear_verdict verdict, size_t positive)
{
    nh_pen_say(p, "%s", nh_linearized_word(verdict));
    if (positive) nh_pen_say(p, positive == 1 ? " (%zu positive real part)" : " (%zu positive real parts)", positive);
}

static void changes(nh_pen *p, const nh_linearized *x)
{
    nh_pen_section(p, "changes", "Where the stability changes");
    if (!x->changes) nh_pen_words(p, "Nowhere between the values.");
    else nh_pen_table(p, "", nh_arena_printf(x->arena, "#%s|#error|below|above", x->over));
    for (size_t i = 0; i < x->changes; i++) {
        const nh_linear_change *c = &x->change[i];
        nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
        nh_pen_cell(p, NH_PEN_CELL, "%s", nh_arena_printf(x->arena, "%.15g", c->low + (c->high - c->low) / 2));
        nh_pen_cell(p, NH_PEN_CELL, "%.1g", (c->high - c->low) / 2);
        nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
        side(p, c->before, c->positive_before);
        nh_pen_close(p, NH_PEN_CELL);
        nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
        side(p, c->after, c->positive_after);
        nh_pen_close(p, NH_PEN_CELL);
        nh_pen_close(p, NH_PEN_ROW);
    }
    if (x->changes) nh_pen_table_end(p);
}

static void values(nh_pen *p, const nh_linearized *x)
{
    nh_pen_section(p, "values", "Eigenvalues along the family");
    nh_pen_table(p, "", nh_arena_printf(x->arena, "#%s|verdict|#largest real part|#its imaginary part", x->over));
    for (size_t i = 0; i < x->rows; i++) {
        const nh_linear_row *row = &x->row[i];
        const nh_linear_equations *e = row->equations;
        bool any = e && e->eigenvalues;
        nh_pen_row(p, "%s|%s|%s|%s", digits_of(x, row->value.value), e ? nh_linearized_word(row->verdict) : row->why,
                   any ? digits_of(x, e->eigenvalue[0].re) : "", any ? digits_of(x, e->eigenvalue[0].im) : "");
    }
    nh_pen_table_end(p);
}

static void picture(nh_pen *p, const nh_linearized *x)
{
    nh_curve *curves;
    nh_plot plot = nh_linearized_plot(x, &curves);
    nh_pen_plot(p, &plot, x->over ? "Real and imaginary parts of the eigenvalues." : "The eigenvalues in the plane.");
    nh_free(curves);
}

static void answer(nh_pen *p, const nh_linearized *x)
{
    nh_linear_verdict v = x->row[0].verdict;
    bool decided = v == NH_LINEAR_UNSTABLE || v == NH_LINEAR_STABLE;
    nh_pen_open(p, NH_PEN_ANSWER, x->over || decided ? "found" : "undecided", NULL);
    if (!x->over) nh_pen_say(p, "%s", nh_linearized_sentence(v));
    else
        nh_pen_say(p, x->changes == 1 ? "The stability changes at %zu value of <%s>."
                                      : "The stability changes at %zu values of <%s>.", x->changes, x->over);
    nh_pen_close(p, NH_PEN_ANSWER);
}

void nh_linearized_write(const nh_linearized *x, const nh_run *run, nh_pen_style style, nh_text *out)
{
    nh_pen pen, *p = &pen;
    nh_pen_subject subject = {.system = x->system, .dag = x->system->dag, .shown = run->shown};
    nh_pen_begin(p, style, &subject, "linear equations of motion", out);
    answer(p, x);
    p->ink->links(p->to, x->over ? "changes|Changes|values|Values|system|System|repeat|Repeat it"
                                 : "state|The state|eigenvalues|Eigenvalues|equations|Equations|system|System|repeat|"
                                   "Repeat it");
    if (x->over) {
        changes(p, x);
        values(p, x);
        picture(p, x);
    } else {
        const nh_linear_equations *e = x->row[0].equations;
        state(p, x, e);
        eigenvalues(p, x, e);
        picture(p, x);
        equations(p, x, e);
    }
    nh_pen_system(p, NULL, NULL);
    nh_pen_end(p, run);
}
