/* The figures that an analysis asks for. */
#include <stdio.h>

#include "base/memory.h"
#include "document/html_internal.h"

static nh_curve curve_of(const nh_figure_curve *c)
{
    return (nh_curve){.name = c->name, .count = c->count, .x = c->x, .x_stride = 1, .y = c->y, .y_stride = 1, .heading = c->heading};
}

/* Side by side, one per value of the parameter. */
static void paths(nh_html_writer *w, const nh_figure *f)
{
    const nh_named *q = f->request->quantity;
    nh_html_add(w, "<div class=\"beside\">\n");
    for (size_t k = 0; k < f->curves; k++) {
        char title[300];
        nh_curve curve = curve_of(&f->curve[k]);
        snprintf(title, sizeof title, f->request->values ? "%.150s: %.100s" : "%.150s", f->request->title, f->curve[k].name);
        nh_plot plot = {.title = title, .description = "A path in the plane, both axes on one scale", .x_label = q[0].name, .y_label = q[1].name, .equal = true, .curves = 1, .curve = &curve};
        nh_html_figure(w, &plot, title);
    }
    nh_html_add(w, "</div>\n");
}

static void over_time(nh_html_writer *w, const nh_figure *f)
{
    nh_curve *curve = nh_alloc_array(f->curves + 1, sizeof *curve);
    for (size_t k = 0; k < f->curves; k++) curve[k] = curve_of(&f->curve[k]);
    nh_plot plot = {.title = f->request->title, .description = "Quantities along motions, over time", .x_label = "t", .y_label = f->request->quantities == 1 ? f->request->quantity[0].name : "value",
                    .curves = f->curves, .curve = curve};
    nh_html_figure(w, &plot, f->request->title);
    nh_free(curve);
}

/* With the values that were found as points. */
static void scan(nh_html_writer *w, const nh_figure *f)
{
    const nh_analysis *r = w->r;
    size_t n = r->hits ? r->hits->count : 0, u = f->request->unknown;
    double *found = nh_alloc_array(2 * n + 1, sizeof *found);
    for (size_t k = 0; k < n; k++) found[k] = r->hits->hit[k].value[u], found[n + k] = r->hits->hit[k].quotient;
    nh_curve curve[] = {curve_of(&f->curve[0]), {.name = "values found", .count = n, .x = found, .x_stride = 1, .y = found + n, .y_stride = 1, .dots = true}};
    curve[0].name = "smallest singular value that is not null everywhere";
    nh_plot plot = {.title = f->request->title, .description = "The smallest generalized singular value that does not vanish for all values of the unknown, on a logarithmic scale; it falls to rounding error where a current exists",
                    .x_label = f->curve[0].name, .y_label = "singular value", .log_y = true, .floor = 1e-17, .curves = n ? 2 : 1, .curve = curve};
    nh_html_figure(w, &plot, f->request->title);
    nh_free(found);
}

static void samples(nh_html_writer *w, const nh_figure *f)
{
    nh_curve curve[] = {curve_of(&f->curve[0]), curve_of(&f->curve[1])};
    curve[0].marks = curve[1].marks = true;
    nh_plot plot = {.title = f->request->title, .description = "The two sides of the gap in the spectrum of generalized singular values, on logarithmic scales", .x_label = "samples", .y_label = "singular value",
                    .log_x = true, .log_y = true, .floor = 1e-18, .curves = 2, .curve = curve};
    nh_html_figure(w, &plot, f->request->title);
}

void nh_html_figures(nh_html_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->figures) return;
    nh_html_add(w, "<section id=\"figures\"><h2>Figures</h2>\n<p>The analysis file defines these figures.</p>\n");
    for (size_t i = 0; i < r->figures; i++) {
        const nh_figure *f = &r->figure[i];
        if (!f->curves) continue;
        if (f->request->kind == NH_FIGURE_PATH) paths(w, f);
        else if (f->request->kind == NH_FIGURE_PLOT) over_time(w, f);
        else if (f->request->kind == NH_FIGURE_SCAN) scan(w, f);
        else samples(w, f);
    }
    nh_html_add(w, "</section>\n");
}
