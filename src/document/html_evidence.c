#include <math.h>
#include <stdio.h>

#include "base/memory.h"
#include "graph/print.h"
#include "document/facts.h"
#include "document/html_internal.h"

/* Spectra of both routes over the index, with null values on the floor. */
static void spectrum_plot(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    const nh_spectrum *s[] = {&r->current, &r->symmetry};
    static const char *const names[] = {"current route", "symmetry route"};
    nh_curve curve[2];
    size_t most = 0, curves = 0;
    for (int i = 0; i < 2; i++)
        if (s[i]->done && s[i]->rank > most) most = s[i]->rank;
    if (most < 3) return; /* what the table says is all there is to see */
    double *index = nh_alloc_array(most, sizeof *index);
    for (size_t i = 0; i < most; i++) index[i] = (double)(i + 1);
    for (int i = 0; i < 2; i++)
        if (s[i]->done && s[i]->rank)
            curve[curves++] = (nh_curve){.name = names[i], .count = s[i]->rank, .x = index, .x_stride = 1, .y = s[i]->spectrum, .y_stride = 1, .dots = true};
    nh_plot plot = {.title = "Singular spectrum", .description = "Generalized singular values in ascending order on a logarithmic scale; those below the gap belong to currents",
                    .x_label = "index", .y_label = "singular value", .log_y = true, .floor = 1e-18, .curves = curves, .curve = curve};
    nh_html_figure(w, &plot, "Generalized singular values. Those below the gap, at rounding error, belong to currents.");
    nh_free(index);
}

static void spectrum(nh_html_writer *w, const char *name, const nh_spectrum *s)
{
    if (!s->done) return;
    double number[NH_SPECTRUM_NUMBERS];
    nh_facts_spectrum(s, number);
    nh_text_addf(w->out, "<tr><th scope=\"row\">%s</th>", name);
    for (size_t i = 0; i < NH_SPECTRUM_NUMBERS; i++) nh_html_cell(w, number[i], i < NH_SPECTRUM_COUNTS ? 10 : 2);
    nh_html_add(w, "</tr>\n");
}

static void spectra(nh_html_writer *w)
{
    if (!w->r->current.done && !w->r->symmetry.done) return;
    nh_html_table(w, "Linear problems", "route|" NH_SPECTRUM_HEADS);
    spectrum(w, "current", &w->r->current);
    spectrum(w, "symmetry", &w->r->symmetry);
    nh_html_table_end(w);
    const nh_counted_space *counted = &w->r->counted_space;
    if (counted->compared) {
        nh_html_add(w, counted->agrees ? "<p>The current route agrees with the count of degree " : "<p>The current route DISAGREES with the count of degree ");
        nh_html_number(w, (double)counted->degree, 1);
        nh_html_add(w, ": the largest angle between a null vector and the products of the currents is ");
        nh_html_number(w, counted->angle, 1);
        nh_html_add(w, ".</p>\n");
    }
    if (!w->r->routes_compared) return;
    nh_html_add(w, w->r->routes_agree ? "<p>The two routes agree: the angle between the spaces that they find is " : "<p>The two routes DISAGREE: the angle between the spaces that they find is ");
    nh_html_number(w, w->r->routes_angle, 1);
    nh_html_add(w, ".</p>\n");
}

static void unknowns(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    for (size_t k = 0; r->hits && k < r->specials; k++)
        for (size_t j = 0; j < r->hits->unknowns; j++) {
            nh_html_add(w, "<p>Unknown ");
            nh_html_source(w, nh_name_of(r->model->dag, r->analysis->unknown[j].symbol));
            nh_html_add(w, " = ");
            if (r->special[k].recognised[j]) {
                char *text = nh_print_string(r->model->dag, r->special[k].recognised[j]);
                nh_html_source(w, text);
                nh_html_add(w, "= ");
                nh_free(text);
            }
            nh_html_number(w, r->special[k].value[j], 15);
            nh_html_add(w, r->special[k].hit->by_pencil && r->special[k].hit->by_search ? ", by the eigenvalues of a pencil and by a search" : "");
            nh_html_add(w, "</p>\n");
        }
    if (r->hits && !r->specials) nh_html_add(w, "<p>No value of the unknowns gives a current.</p>\n");
}

static void stages(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->stages) return;
    nh_html_table(w, "What was tried", "stage|columns|null values|new currents");
    for (size_t i = 0; i < r->stages; i++) {
        const nh_stage_record *s = &r->stage[i];
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_text(w, s->name);
        nh_html_add(w, "</th>");
        if (s->skipped) {
            nh_html_add(w, "<td colspan=\"3\">not tried, too large: <code>");
            nh_html_text(w, nh_limit_words(r->arena, &s->limit));
            nh_html_add(w, "</code></td></tr>\n");
            continue;
        }
        nh_html_cell(w, (double)s->columns, 10);
        nh_html_add(w, "<td>");
        nh_html_count(w, s->dimension);
        nh_html_add(w, s->undecided ? " (undecided)</td><td>" : "</td><td>");
        nh_html_count(w, s->found);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_table_end(w);
}

void nh_html_evidence(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    nh_html_add(w, r->count ? "<section id=\"search\"><h2>How it was found</h2>\n<p>Ansatz " : "<section id=\"search\"><h2>What was tried</h2>\n<p>The ansatz was ");
    nh_html_text(w, r->ansatz_note);
    nh_html_add(w, ". ");
    nh_html_count(w, r->samples);
    nh_html_add(w, " sample points");
    if (r->beyond) {
        nh_html_add(w, " and, near where the chart breaks down, ");
        nh_html_count(w, r->beyond);
        nh_html_add(w, " in all coordinates");
    }
    nh_html_add(w, ", ");
    nh_html_count(w, r->rejected);
    nh_html_add(w, " rejected.</p>\n");
    unknowns(w);
    spectrum_plot(w);
    spectra(w);
    stages(w);
    nh_html_add(w, "</section>\n");
}
