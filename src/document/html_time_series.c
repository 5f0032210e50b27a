#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/html_internal.h"
#include "document/perspective.h"

enum { most_curves = 7, page_points = 80 };

/* ---- plots over time ---- */

static void flush(nh_html_writer *w, const nh_time_series *c, const char *what, const char *axis, const char *caption,
                  size_t n, nh_curve *curve)
{
    char title[200], alone[160];
    if (n == 0) return;
    snprintf(title, sizeof title, "%s over time", what);
    /* no legend contains its name */
    if (n == 1)
        snprintf(alone, sizeof alone, "%.80s%.60s", curve[0].name, strchr(axis, '/') ? strchr(axis, '/') - 1 : "");
    nh_plot plot = {.title = title,
                    .description = caption,
                    .x_label = "t",
                    .y_label = n == 1 ? alone : axis,
                    .timed = c->count > 1,
                    .curves = n,
                    .curve = curve};
    if (w->stage) nh_html_live_figure(w, &plot, what, axis);
    else nh_html_figure(w, &plot, caption);
}

/* A page with scripts draws its own curves: those of the file are for other readers, with fewer points. */
static size_t every_of(const nh_html_writer *w, const nh_time_series *c)
{
    return w->stage ? 1 + c->count / page_points : 1;
}

static nh_curve curve_of(const nh_html_writer *w, const nh_time_series *c, const nh_line *line)
{
    size_t every = every_of(w, c);
    return (nh_curve){.name = line->name,
                      .count = (c->count - 1) / every + 1,
                      .x = c->time,
                      .x_stride = every,
                      .y = line->value,
                      .y_stride = line->stride * every};
}

/* Plots of one kind of lines.  The first `skip` lines of the kind are left out; the next `take` are drawn, each plot
 * with a limited number of curves. */
static void lines(nh_html_writer *w, const nh_time_series *c, nh_track_kind kind, size_t skip, size_t take,
                  const char *what, const char *axis, const char *caption)
{
    nh_curve curve[most_curves];
    char letter[most_curves][24];
    size_t n = 0, seen = 0;
    for (size_t j = 0; j < c->lines; j++) {
        if (c->line[j].kind != kind || seen++ < skip || seen > skip + take) continue;
        curve[n] = curve_of(w, c, &c->line[j]);
        snprintf(letter[n], sizeof *letter, c->model->k == 1 ? "mu" : "mu_%zu", seen);
        if (kind == NH_TRACK_MULTIPLIER) curve[n].name = letter[n]; /* names as in the formulas */
        if (++n < most_curves) continue;
        flush(w, c, what, axis, caption, n, curve);
        n = 0;
    }
    flush(w, c, what, axis, caption, n, curve);
}

/* "length / m" when all coordinates of that type have one unit. */
static const char *axis_of(const nh_system *system, nh_coordinate_type type, const char *what, char out[80])
{
    const char *unit = NULL;
    for (size_t i = 0; i < system->coordinates; i++) {
        const nh_coordinate *c = &system->coordinate[i];
        const char *own = c->unit && c->unit[0] ? c->unit : type == NH_ANGLE ? "rad" : "";
        if (c->type == type) unit = !unit || !strcmp(unit, own) ? own : "";
    }
    snprintf(out, 80, unit && unit[0] ? "%s / %.50s" : "%s", what, unit ? unit : "");
    return out;
}

/* Angles and lengths have different units: each gets its own plot. */
static void positions(nh_html_writer *w, const nh_time_series *c)
{
    static const struct {
        nh_coordinate_type type;
        const char *what, *caption;
    } kind[] = {{NH_ANGLE, "angle", "Angles over time."},
                {NH_LENGTH, "length", "Lengths over time."},
                {NH_PLAIN, "coordinate", "Other coordinates over time."}};
    const nh_system *system = w->system;
    for (size_t k = 0; k < 3; k++) {
        nh_curve curve[most_curves];
        char label[80];
        const char *axis = axis_of(system, kind[k].type, kind[k].what, label);
        size_t n = 0;
        for (size_t i = 0; i < system->coordinates; i++) {
            if (system->coordinate[i].type != kind[k].type) continue;
            curve[n++] = curve_of(w, c, &c->line[i]);
            if (n < most_curves) continue;
            flush(w, c, "Coordinates", axis, kind[k].caption, n, curve);
            n = 0;
        }
        flush(w, c, "Coordinates", axis, kind[k].caption, n, curve);
    }
}

/* |Phi - Phi(0)| of quantities that should be constant. */
static void constancy(nh_html_writer *w, const nh_time_series *c)
{
    nh_curve curve[most_curves];
    double *y = nh_alloc_array(most_curves * c->count + 1, sizeof *y);
    size_t n = 0;
    for (size_t j = 0; j < c->lines && n < most_curves; j++) {
        const nh_line *line = &c->line[j];
        if (line->kind != NH_TRACK_CURRENT) continue;
        for (size_t i = 0; i < c->count; i++)
            y[n * c->count + i] = fabs(line->value[i * line->stride] - line->value[0]);
        curve[n] = (nh_curve){
            .name = line->name, .count = c->count, .x = c->time, .x_stride = 1, .y = y + n * c->count, .y_stride = 1};
        n++;
    }
    nh_plot plot = {.title = "Change of the known currents",
                    .description = "Absolute change since the start on a logarithmic scale",
                    .x_label = "t",
                    .y_label = "change",
                    .log_y = true,
                    .floor = 1e-17,
                    .timed = c->count > 1,
                    .curves = n,
                    .curve = curve};
    if (n)
        nh_html_figure(w, &plot, "Change of the known currents since the start, a measure of the error of the motion.");
    nh_free(y);
}

static void velocities(nh_html_writer *w, const nh_time_series *c)
{
    size_t m = c->model->m;
    if (c->model->chart->quasi)
        lines(w, c, NH_TRACK_STATE, 2 * m, c->lines, "Quasi-velocities", "quasi-velocity",
              "Quasi-velocities over time.");
    else lines(w, c, NH_TRACK_STATE, m, m, "Velocities", "velocity", "Velocities over time.");
}

/* ---- the drawing ---- */

/* The name of a shape, or its kind, with a number when there are several. */
static void shape_name(const nh_time_series *c, size_t i, char *out, size_t size)
{
    size_t before = 0, all = 0;
    for (size_t k = 0; k < c->shapes; k++) {
        if (c->shape[k].kind != c->shape[i].kind || c->shape[k].name) continue;
        before += k <= i;
        all++;
    }
    if (c->shape[i].name) snprintf(out, size, "%s", c->shape[i].name);
    else snprintf(out, size, all > 1 ? "%s %zu" : "%s", nh_shape_name(c->shape[i].kind), before);
}

static void path_plot(nh_html_writer *w, const nh_time_series *c)
{
    nh_curve curve[most_curves];
    char name[most_curves][60];
    size_t n = 0;
    for (size_t i = 0; i < c->shapes && n < most_curves; i++) {
        if (c->shape[i].kind == NH_SHAPE_SEGMENT || nh_shape_in_space(c->shape[i].kind)) continue;
        const nh_line *x = nh_time_series_shape(c, i, 0), *y = nh_time_series_shape(c, i, 1);
        shape_name(c, i, name[n], sizeof name[n]);
        size_t every = every_of(w, c);
        curve[n] = (nh_curve){.name = name[n],
                              .count = (c->count - 1) / every + 1,
                              .x = x->value,
                              .x_stride = x->stride * every,
                              .y = y->value,
                              .y_stride = y->stride * every};
        bool heads = c->shape[i].kind == NH_SHAPE_ARROW || c->shape[i].kind == NH_SHAPE_WHEEL;
        if (heads) curve[n].heading = nh_time_series_shape(c, i, 2)->value;
        n++;
    }
    if (!n) return;
    nh_plot plot = {.title = "Path in the plane",
                    .description = "The path of the motion in the plane, both axes on one scale",
                    .x_label = "first axis",
                    .y_label = "second axis",
                    .equal = true,
                    .curves = n,
                    .curve = curve};
    const nh_system *system = w->system;
    bool marks = false;
    for (size_t k = 0; k < n; k++) marks |= curve[k].heading != NULL;
    for (size_t i = system->coordinates; i-- > 0;)
        for (size_t k = c->shapes; k-- > 0;) {
            if (c->shape[k].kind == NH_SHAPE_SEGMENT || nh_shape_in_space(c->shape[k].kind)) continue;
            if (system->coordinate[i].q == c->shape[k].value[0]) plot.x_label = system->coordinate[i].name;
            if (system->coordinate[i].q == c->shape[k].value[1]) plot.y_label = system->coordinate[i].name;
        }
    nh_html_figure(w, &plot,
                   marks ? "Path of the motion; the marks show the heading of a body at equal time steps."
                         : "Path of the motion.");
}

/* A still picture for paper, for files, and where no script runs. */
static void still(nh_html_writer *w, const nh_time_series *c)
{
    enum { wide = 640, high = 420 };
    nh_view *view = nh_view_create(c, c->count, wide, high);
    nh_plot plot = {.title = "Bodies in space",
                    .description = "The bodies at the end of the motion in perspective, with their paths",
                    .view = view,
                    .at = c->count - 1};
    if (view)
        nh_html_figure(w, &plot, "The bodies at the end of the motion, with their paths; hidden sides are faint.");
    nh_view_free(view);
}

void nh_html_still(nh_html_writer *w, const nh_time_series *c)
{
    still(w, c);
    path_plot(w, c);
}

void nh_html_plots(nh_html_writer *w, const nh_time_series *c)
{
    bool states = c->lines && c->line[0].kind == NH_TRACK_STATE;
    if (states) positions(w, c);
    if (states) velocities(w, c);
    lines(w, c, NH_TRACK_ENERGY, 0, c->lines, "Energy", "E", "The energy function over time.");
    lines(w, c, NH_TRACK_WATCH, 0, c->lines, "Observables", "value", "Observables over time.");
    lines(w, c, NH_TRACK_MULTIPLIER, 0, c->lines, "Chetaev multipliers", "multiplier",
          c->model->k == 1 ? "The Chetaev multiplier over time."
                           : "Chetaev multipliers over time, in the order of the constraints.");
    bool live = w->stage && !w->stage->live->why; /* such a page draws the drift */
    if (!c->drifts_elsewhere && !live) constancy(w, c);
}
