/* How currents were found: ansatz, values of unknowns, singular values, stages. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/analysis_internal.h"
#include "document/facts.h"
#include "graph/node.h"
#include "graph/print.h"

/* The spectra of both routes over the index; null values are drawn at the bottom. */
static void spectrum_plot(nh_pen *p, const nh_analysis *result)
{
    const nh_spectrum *s[] = {&result->current, &result->symmetry};
    static const char *const names[] = {"fit of currents", "fit of fields"};
    nh_curve curve[2];
    size_t most = 0, curves = 0;
    for (int i = 0; i < 2; i++)
        if (s[i]->done && s[i]->rank > most) most = s[i]->rank;
    if (most < 3) return; /* the table says the same */
    double *index = nh_alloc_array(most, sizeof *index);
    for (size_t i = 0; i < most; i++) index[i] = (double)(i + 1);
    for (int i = 0; i < 2; i++)
        if (s[i]->done && s[i]->rank)
            curve[curves++] = (nh_curve){.name = names[i],
                                         .count = s[i]->rank,
                                         .x = index,
                                         .x_stride = 1,
                                         .y = s[i]->spectrum,
                                         .y_stride = 1,
                                         .dots = true};
    nh_plot plot = {.title = "Singular spectrum",
                    .description = "Generalized singular values in ascending order on a logarithmic scale; those below "
                                   "the gap belong to currents",
                    .x_label = "index",
                    .y_label = "singular value",
                    .log_y = true,
                    .floor = 1e-18,
                    .curves = curves,
                    .curve = curve};
    nh_pen_plot(p, &plot, "Generalized singular values. Those below the gap, at rounding error, belong to currents.");
    nh_free(index);
}

static void spectrum(nh_pen *p, const char *name, const nh_spectrum *s)
{
    if (!s->done || !s->columns) return;
    nh_pen_fact_begin(p, name);
    nh_pen_say(p, "%zu columns (%zu independent), %zu rows: ", s->columns, s->rank, s->rows);
    if (!s->rank) nh_pen_say(p, "no column varies on the samples");
    else if (!s->dimension) nh_pen_say(p, "no null value; the smallest is %.2g", s->spectrum[0]);
    else {
        nh_pen_say(p, "%zu null value%s up to %.2g", s->dimension, s->dimension == 1 ? "" : "s",
                   s->spectrum[s->dimension - 1]);
        if (s->dimension < s->rank) nh_pen_say(p, ", then %.2g: gap %.2g", s->spectrum[s->dimension], s->gap);
        else nh_pen_say(p, ", and nothing else");
    }
    for (size_t i = 0; p->ink->brief && p->style.verbose && i < s->rank; i++)
        nh_pen_say(p, i ? " %.2g" : "; all of them: %.2g", s->spectrum[i]);
    nh_pen_close(p, NH_PEN_FACT);
}

static void spectra(nh_pen *p, const nh_analysis *result)
{
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    spectrum(p, "Fit of fields", &result->symmetry);
    spectrum(p, "Fit of currents", &result->current);
    nh_pen_close(p, NH_PEN_FACTS);
}

static void comparisons(nh_pen *p, const nh_analysis *result)
{
    const nh_counted_space *c = &result->counted_space;
    if (c->compared)
        nh_pen_words(p,
                     "%s %s with the count of degree %zu: the largest angle between a null vector and "
                     "the products of the currents is %.2g.",
                     c->fields ? "The fit of fields" : "The fit of currents", c->agrees ? "agrees" : "DISAGREES",
                     c->degree, c->angle);
    if (result->routes_compared)
        nh_pen_words(p, "The two fits %s: the angle between the spaces that they find is %.2g.",
                     result->routes_agree ? "agree" : "DISAGREE", result->routes_angle);
}

static void unknown(nh_pen *p, const nh_analysis *result, const nh_special *s, size_t j)
{
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(
        p, "Unknown <%s> = ", nh_name_of(result->question->model->dag, result->question->analysis->unknown[j].symbol));
    if (s->recognised[j]) {
        char *text = nh_print_string(result->question->model->dag, s->recognised[j]);
        nh_pen_say(p, "<%s> = ", text);
        nh_free(text);
    }
    nh_pen_say(p, "%.15g%s", s->value[j],
               s->hit->by_pencil && s->hit->by_search ? ", by the eigenvalues of a pencil and by a search" : "");
    nh_pen_close(p, NH_PEN_WORDS);
}

static void unknowns(nh_pen *p, const nh_analysis *result)
{
    for (size_t k = 0; result->hits && k < result->specials; k++)
        for (size_t j = 0; j < result->hits->unknowns; j++) unknown(p, result, &result->special[k], j);
    if (result->hits && !result->specials)
        nh_pen_words(p, "No value of the unknowns %sgives a current.",
                     nh_analysis_by_trial(result) ? "that was tried " : "");
}

static void stages(nh_pen *p, const nh_analysis *result)
{
    if (!result->stages) return;
    nh_pen_table(p, nh_facts_given(result) ? "Then, by the program's own search" : "What was tried",
                 "stage|columns|null values|new currents");
    for (size_t i = 0; i < result->stages; i++) {
        const nh_stage_record *s = &result->stage[i];
        if (s->skipped)
            nh_pen_row(p, "#%s: not tried, too large; %s|||", s->name, nh_limit_words(result->arena, &s->limit));
        else
            nh_pen_row(p, "#%s|%zu%s|%zu%s|%zu", s->name, s->columns,
                       s->sectors > 1 ? nh_arena_printf(result->arena, " in %zu sectors", s->sectors) : "",
                       s->dimension, s->undecided ? " (undecided)" : "", s->found);
    }
    nh_pen_table_end(p);
}

/* The grid of the largest linear problem: its kind, why points were rejected, its branches and its box. */
static void grid(nh_pen *p, const nh_analysis *result)
{
    const nh_grid_report *g = &result->grid;
    const nh_analysis_question *q = result->question;
    const nh_chart *c = q->model->chart;
    const struct {
        size_t count;
        const char *why;
    } reason[] = {{g->not_finite, "not finite"},
                  {g->not_solved, "without a solution of the constraints"},
                  {g->degenerate, "near a singularity"},
                  {g->outside, "outside of the domain"}};
    if (!g->used) return;
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    nh_pen_fact_begin(p, "Grid");
    nh_pen_say(p, "%s%s", q->grid.kind == NH_GRID_FILE ? "points of " : "",
               q->grid.kind == NH_GRID_FILE ? q->grid.path : nh_sample_grid_word(q->grid.kind));
    if (g->variables) nh_pen_say(p, " in %zu variables", g->variables);
    nh_pen_say(p, "; the largest problem has %zu points", g->used);
    for (size_t i = 0; i < sizeof reason / sizeof *reason; i++)
        if (reason[i].count) nh_pen_say(p, ", rejected %s: %zu", reason[i].why, reason[i].count);
    for (size_t i = 0; i < g->branches; i++)
        nh_pen_say(p, "%s%s: %zu points", i ? ", " : "; where ", g->branch[i].name, g->branch[i].points);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_fact_begin(p, "Domain");
    for (size_t j = 0; j < 1 + q->model->m + q->model->n; j++)
        nh_pen_say(p, "%s%s in [%.4g, %.4g]", j ? ", " : "", nh_name_of(q->model->dag, c->symbol[j]), c->low[j],
                   c->high[j]);
    nh_pen_close(p, NH_PEN_FACT);
    nh_pen_close(p, NH_PEN_FACTS);
}

void nh_analysis_write_search(nh_pen *p, const nh_analysis *result)
{
    nh_pen_section(p, "search", result->list->count ? "How it was found" : "The search");
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, result->list->count ? "Ansatz %s. %zu sample points" : "The ansatz was %s. %zu sample points",
               result->ansatz_note, result->samples);
    if (result->beyond) nh_pen_say(p, " and, near where the chart breaks down, %zu in all coordinates", result->beyond);
    nh_pen_say(p, ", %zu rejected.", result->rejected);
    nh_pen_close(p, NH_PEN_WORDS);
    grid(p, result);
    unknowns(p, result);
    spectrum_plot(p, result);
    spectra(p, result);
    comparisons(p, result);
    stages(p, result);
}
