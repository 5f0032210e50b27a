#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "report/html_internal.h"

enum { most_curves = 7, most_frames = 201 };

/* ---- plots over time ---- */

static void flush(nh_html_writer *w, const char *what, const char *axis, const char *caption, size_t n, nh_curve *curve)
{
    char title[200];
    if (n == 0) return;
    snprintf(title, sizeof title, "%s over time", what);
    nh_plot plot = {.title = title, .description = caption, .x_label = "t", .y_label = axis, .timed = true, .curves = n, .curve = curve};
    nh_html_figure(w, &plot, caption);
}

/* Tracks of one kind in plots of at most so many curves.  `skip` of the kind are left out at the front, `take` are shown. */
static void tracks(nh_html_writer *w, nh_track_kind kind, size_t skip, size_t take, const char *what, const char *axis, const char *caption)
{
    const nh_validation *v = w->r->validation;
    nh_curve curve[most_curves];
    size_t n = 0, seen = 0;
    for (size_t j = 0; j < v->watches; j++) {
        if (w->r->track[j].kind != kind || seen++ < skip || seen > skip + take) continue;
        curve[n++] = (nh_curve){.name = w->r->track[j].name, .count = v->count, .x = v->time, .x_stride = 1, .y = v->watch + j, .y_stride = v->watches};
        if (n < most_curves) continue;
        flush(w, what, axis, caption, n, curve);
        n = 0;
    }
    flush(w, what, axis, caption, n, curve);
}

/* Angles and lengths have different units: each gets its own plot. */
static void positions(nh_html_writer *w)
{
    static const struct {
        nh_coordinate_type type;
        const char *what, *caption;
    } kind[] = {{NH_ANGLE, "angle / rad", "Angles over time."}, {NH_LENGTH, "length", "Lengths over time."}, {NH_PLAIN, "coordinate", "Other coordinates over time."}};
    const nh_validation *v = w->r->validation;
    const nh_system *s = w->r->system;
    for (size_t k = 0; k < 3; k++) {
        nh_curve curve[most_curves];
        size_t n = 0;
        for (size_t i = 0; i < s->coordinates; i++) {
            if (s->coordinate[i].type != kind[k].type) continue;
            curve[n++] = (nh_curve){.name = s->coordinate[i].name, .count = v->count, .x = v->time, .x_stride = 1, .y = v->watch + i, .y_stride = v->watches};
            if (n < most_curves) continue;
            flush(w, "Coordinates", kind[k].what, kind[k].caption, n, curve);
            n = 0;
        }
        flush(w, "Coordinates", kind[k].what, kind[k].caption, n, curve);
    }
}

static void multipliers(nh_html_writer *w)
{
    const nh_validation *v = w->r->validation;
    size_t k = w->r->model->k, n = k < most_curves ? k : most_curves;
    nh_curve curve[most_curves];
    char name[most_curves][40];
    for (size_t a = 0; a < n; a++) {
        snprintf(name[a], sizeof name[a], "\u03bc%zu", a + 1);
        curve[a] = (nh_curve){.name = name[a], .count = v->count, .x = v->time, .x_stride = 1, .y = v->multiplier + a, .y_stride = k};
    }
    flush(w, "Chetaev multipliers", "\u03bc", k == 1 ? "The Chetaev multiplier over time." : "Chetaev multipliers over time, in the order of the constraints.", n, curve);
}

/* ---- the drawing ---- */

/* Column of number j of shape i. */
static size_t column_of(const nh_result *r, size_t i, size_t j)
{
    size_t before = j, at = 0;
    for (size_t k = 0; k < i; k++) before += nh_shape_numbers(r->shape[k].kind);
    for (;; at++)
        if (r->track[at].kind == NH_TRACK_SHAPE && before-- == 0) return at;
}

static void path_plot(nh_html_writer *w)
{
    const nh_result *r = w->r;
    const nh_validation *v = r->validation;
    nh_curve curve[most_curves];
    char name[most_curves][60];
    size_t n = 0;
    for (size_t i = 0; i < r->shapes && n < most_curves; i++) {
        if (r->shape[i].kind == NH_SHAPE_SEGMENT) continue;
        snprintf(name[n], sizeof name[n], "%s %zu", nh_shape_name(r->shape[i].kind), i + 1);
        curve[n] = (nh_curve){.name = name[n], .count = v->count, .x = v->watch + column_of(r, i, 0), .x_stride = v->watches, .y = v->watch + column_of(r, i, 1), .y_stride = v->watches};
        bool heads = r->shape[i].kind == NH_SHAPE_ARROW || r->shape[i].kind == NH_SHAPE_WHEEL;
        if (heads) curve[n].heading = v->watch + column_of(r, i, 2);
        n++;
    }
    if (!n) return;
    nh_plot plot = {.title = "Path in the plane", .description = "The path of the test motion in the plane, both axes on one scale", .x_label = "first axis", .y_label = "second axis",
                    .equal = true, .curves = n, .curve = curve};
    const nh_system *s = r->system;
    for (size_t i = s->coordinates; i-- > 0;) {
        if (s->coordinate[i].q == r->shape[0].value[0]) plot.x_label = s->coordinate[i].name;
        if (s->coordinate[i].q == r->shape[0].value[1]) plot.y_label = s->coordinate[i].name;
    }
    nh_html_figure(w, &plot, "Path of the test motion; the marks show where a body heads, at equal steps of time.");
}

static void number(nh_html_writer *w, double value) { nh_text_addf(w->out, isfinite(value) ? "%.6g" : "null", value); }

static void frames(nh_html_writer *w, const char *before, const double *value, size_t stride, size_t step)
{
    const nh_validation *v = w->r->validation;
    nh_text_addf(w->out, "%s[", before);
    for (size_t i = 0; i < v->count; i += step) {
        if (i) nh_html_add(w, ",");
        number(w, value[i * stride]);
    }
    nh_html_add(w, "]");
}

/* The numbers for the script; there is no text of the user in it. */
static void data(nh_html_writer *w)
{
    const nh_result *r = w->r;
    const nh_validation *v = r->validation;
    size_t step = (v->count + most_frames - 2) / most_frames;
    if (step == 0) step = 1;
    nh_html_add(w, "<script type=\"application/json\" id=\"motion-data\">{");
    frames(w, "\"t\":", v->time, 1, step);
    nh_html_add(w, ",\"shapes\":[");
    for (size_t i = 0; i < r->shapes; i++) {
        nh_text_addf(w->out, "%s{\"kind\":\"%s\",\"v\":[", i ? "," : "", nh_shape_name(r->shape[i].kind));
        for (size_t j = 0; j < nh_shape_numbers(r->shape[i].kind); j++) frames(w, j ? "," : "", v->watch + column_of(r, i, j), v->watches, step);
        nh_html_add(w, "]}");
    }
    nh_html_add(w, "]}</script>\n");
}

static void player(nh_html_writer *w)
{
    nh_html_add(w, "<div id=\"player\" hidden=\"hidden\">\n");
    if (w->r->shapes)
        nh_html_add(w, "<figure><svg id=\"scene\" class=\"plot\" role=\"img\" aria-label=\"The system in motion; the slider below chooses the time\" viewBox=\"0 0 640 420\" width=\"640\" height=\"420\"></svg>"
                       "<figcaption>The system in its plane, with its track.</figcaption></figure>\n");
    nh_html_add(w, "<div class=\"controls\"><button type=\"button\" id=\"play\" aria-label=\"play or pause\">Play</button>"
                   "<input type=\"range\" id=\"when\" min=\"0\" max=\"1000\" value=\"0\" step=\"1\" aria-label=\"time\"/> <output id=\"clock\" for=\"when\">t = 0</output></div></div>\n");
    data(w);
}

/* ---- the tables ---- */

static void drifts(nh_html_writer *w)
{
    const nh_validation *v = w->r->validation;
    if (!v->currents) return;
    nh_html_add(w, "<div class=\"wide\"><table><caption>Drift of the currents, by tolerance of the integration</caption><thead><tr><th scope=\"col\">current</th>");
    for (size_t i = 0; i < NH_DRIFT_RUNS; i++) {
        nh_html_add(w, "<th scope=\"col\">");
        nh_html_number(w, v->tolerance[i], 2);
        nh_html_add(w, "</th>");
    }
    nh_html_add(w, "</tr></thead><tbody>\n");
    for (size_t k = 0; k < v->currents; k++) {
        nh_html_add(w, "<tr><th scope=\"row\">");
        nh_html_source(w, w->r->found[k].name);
        nh_html_add(w, "</th>");
        for (size_t i = 0; i < NH_DRIFT_RUNS; i++) {
            nh_html_add(w, "<td>");
            nh_html_number(w, v->current[k].drift[i], 2);
            nh_html_add(w, "</td>");
        }
        nh_html_add(w, "</tr>\n");
    }
    nh_html_add(w, "</tbody></table></div>\n");
}

static void second_opinion(nh_html_writer *w)
{
    const nh_validation *v = w->r->validation;
    if (v->crossing_chart && !isnan(v->crossing)) {
        nh_html_add(w, "<p>The chart of ");
        nh_html_text(w, v->crossing_chart);
        nh_html_add(w, " breaks down at t = ");
        nh_html_number(w, v->crossing, 4);
        nh_html_add(w, "; the one used here is regular there.</p>\n");
    }
    if (!v->multiplier_form) return;
    nh_text_addf(w->out, "<p>The same motion with Chetaev multipliers (%s): states agree to ", v->multiplier_method);
    nh_html_number(w, v->state_difference, 1);
    nh_html_add(w, ", multipliers to ");
    nh_html_number(w, v->multiplier_difference, 1);
    nh_html_add(w, ", and the constraints hold to ");
    nh_html_number(w, v->violation, 1);
    nh_html_add(w, ".</p>\n");
}

void nh_html_motion_plots(nh_html_writer *w)
{
    const nh_result *r = w->r;
    size_t m = r->model->m, all = r->tracks;
    if (!r->validation || r->validation->count < 2) return;
    path_plot(w);
    positions(w);
    if (r->model->chart->quasi) tracks(w, NH_TRACK_STATE, 2 * m, all, "Quasi-velocities", "quasi-velocity", "Quasi-velocities over time.");
    else tracks(w, NH_TRACK_STATE, m, m, "Velocities", "velocity", "Velocities over time.");
    tracks(w, NH_TRACK_ENERGY, 0, all, "Energy", "E", "The energy function over time.");
    tracks(w, NH_TRACK_WATCH, 0, all, "Watched quantities", "value", "What the analysis file asks to watch, over time.");
    if (r->model->k) multipliers(w);
}

void nh_html_motion(nh_html_writer *w)
{
    const nh_result *r = w->r;
    const nh_validation *v = r->validation;
    if (!v || v->count < 2) return;
    nh_text_addf(w->out, "<section id=\"motion\"><h2>A motion</h2>\n<p>%s in ", v->method);
    nh_html_text(w, v->chart);
    nh_html_add(w, ", t = ");
    nh_html_number(w, v->begin, 6);
    nh_html_add(w, " to ");
    nh_html_number(w, v->end, 6);
    nh_html_add(w, ".</p>\n");
    player(w);
    nh_html_motion_plots(w);
    drifts(w);
    second_opinion(w);
    nh_html_add(w, "</section>\n");
}
