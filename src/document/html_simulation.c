/* A simulation as a page. */
#include <math.h>
#include <stdio.h>

#include "document/typeset.h"
#include "document/html_internal.h"

static void answer(nh_html_writer *w, const nh_simulation *s)
{
    const nh_ensemble *e = s->ensemble;
    size_t count = e ? e->count : s->motion->count;
    const double *time = e ? e->time : s->motion->time;
    bool complete = e ? e->incomplete == 0 : s->motion->complete;
    nh_text_addf(w->out, "<p class=\"answer %s\">", complete && !(s->checked && !s->held) ? "found" : "undecided");
    if (e) {
        nh_html_count(w, e->members);
        nh_html_add(w, " motions");
    } else {
        nh_html_add(w, "A motion");
    }
    nh_html_add(w, " from t = ");
    nh_html_number(w, time[0], 6);
    nh_html_add(w, " to ");
    nh_html_number(w, time[count - 1], 6);
    nh_html_add(w, complete ? ".</p>\n" : e ? "; not all members reach the end.</p>\n" : ", where it ended early.</p>\n");
    nh_html_add(w, "<p>");
    nh_html_text(w, s->method);
    nh_html_add(w, " in ");
    nh_html_chart_name(w, s->formulation);
    if (!isnan(s->tolerance)) { /* a fixed step follows below */
        nh_html_add(w, ", tolerance ");
        nh_html_number(w, s->tolerance, 2);
    }
    nh_html_add(w, ".");
    if (s->checked) {
        nh_html_add(w, " Accuracy: ");
        nh_html_text(w, s->why);
        nh_html_add(w, ".");
    }
    nh_html_add(w, "</p>\n");
    if (!s->scene) return;
    nh_html_add(w, "<p>The smallest model that determines the observables: ");
    nh_html_text(w, s->scene);
    nh_html_add(w, ".</p>\n");
}

/* Every member as a thin line, one plot per quantity. */
static void fans(nh_html_writer *w, const nh_simulation *s)
{
    enum { most_members = 60 };
    const nh_ensemble *e = s->ensemble;
    nh_curve curve[most_members];
    size_t members = e->members < most_members ? e->members : most_members;
    nh_html_add(w, "<p>Each line is one member");
    if (members < e->members) nh_html_add(w, "; only the first members are drawn");
    nh_html_add(w, ".</p>\n");
    for (size_t k = 0; k < e->n; k++) {
        char title[200];
        for (size_t j = 0; j < members; j++)
            curve[j] = (nh_curve){.name = s->columns.track[k].name, .count = e->count, .x = e->time, .x_stride = 1, .y = e->value + j * e->count * e->n + k, .y_stride = e->n};
        nh_text plain;
        nh_text_init(&plain);
        nh_typeset_plain(s->columns.track[k].name, &plain);
        snprintf(title, sizeof title, "%.100s of the members over time", nh_text_string(&plain));
        nh_text_clear(&plain);
        nh_plot plot = {.title = title, .description = "One thin line per member of the ensemble", .x_label = "t", .y_label = s->columns.track[k].name, .fan = true, .curves = members, .curve = curve};
        nh_html_figure(w, &plot, title);
    }
}

static void stats(nh_html_writer *w, const nh_simulation *s)
{
    const nh_ensemble *e = s->ensemble;
    nh_html_add(w, "<p>");
    nh_html_number(w, (double)(e ? e->evaluations : s->motion->evaluations), 10);
    nh_html_add(w, " evaluations of the equations, ");
    nh_html_number(w, e ? e->seconds : s->motion->seconds, 3);
    nh_html_add(w, " seconds of integration.</p>\n");
}

void nh_html_simulation(const nh_simulation *s, const nh_run *run, nh_text *out)
{
    nh_html_writer w = {.out = out, .system = s->system, .analysis = s->analysis, .dag = s->model->dag, .shown = run->shown, .written = INFINITY};
    const char *note = s->ensemble ? s->ensemble->note : s->motion->note;
    nh_html_begin(&w, s->ensemble ? "many motions" : "a motion");
    answer(&w, s);
    nh_html_links(&w, "motion|Motion|system|System|repeat|Repeat it");
    if (note[0]) nh_html_warning(&w, note);
    nh_html_add(&w, "<section id=\"motion\"><h2>Motion</h2>\n");
    nh_time_series *c = s->ensemble ? NULL : nh_time_series_of_simulation(s);
    if (c) nh_html_time_series(&w, c);
    else fans(&w, s);
    stats(&w, s);
    nh_html_add(&w, "</section>\n<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(&w);
    nh_html_add(&w, "<h3>As it was understood</h3>\n");
    nh_html_equations(&w, s->model);
    nh_html_add(&w, "</section>\n");
    nh_html_repeat(&w, run);
    nh_html_end(&w);
    nh_time_series_free(c);
}
