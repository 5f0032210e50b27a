#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/html_internal.h"
#include "document/perspective.h"

enum { most_curves = 7, most_frames = 401 };

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
    nh_html_figure(w, &plot, caption);
}

static nh_curve curve_of(const nh_time_series *c, const nh_line *line)
{
    return (nh_curve){
        .name = line->name, .count = c->count, .x = c->time, .x_stride = 1, .y = line->value, .y_stride = line->stride};
}

/* Lines of one kind, in plots of at most so many curves.  Without the first `skip` lines of the kind, `take` are
 * shown. */
static void lines(nh_html_writer *w, const nh_time_series *c, nh_track_kind kind, size_t skip, size_t take,
                  const char *what, const char *axis, const char *caption)
{
    nh_curve curve[most_curves];
    char letter[most_curves][24];
    size_t n = 0, seen = 0;
    for (size_t j = 0; j < c->lines; j++) {
        if (c->line[j].kind != kind || seen++ < skip || seen > skip + take) continue;
        curve[n] = curve_of(c, &c->line[j]);
        snprintf(letter[n], sizeof *letter, c->model->k == 1 ? "mu" : "mu_%zu", seen);
        if (kind == NH_TRACK_MULTIPLIER) curve[n].name = letter[n]; /* names as in the formulas */
        if (++n < most_curves) continue;
        flush(w, c, what, axis, caption, n, curve);
        n = 0;
    }
    flush(w, c, what, axis, caption, n, curve);
}

/* "length / m" when all coordinates of that type have one unit. */
static const char *axis_of(const nh_system *s, nh_coordinate_type type, const char *what, char out[80])
{
    const char *unit = NULL;
    for (size_t i = 0; i < s->coordinates; i++) {
        const nh_coordinate *c = &s->coordinate[i];
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
    const nh_system *s = w->system;
    for (size_t k = 0; k < 3; k++) {
        nh_curve curve[most_curves];
        char label[80];
        const char *axis = axis_of(s, kind[k].type, kind[k].what, label);
        size_t n = 0;
        for (size_t i = 0; i < s->coordinates; i++) {
            if (s->coordinate[i].type != kind[k].type) continue;
            curve[n++] = curve_of(c, &c->line[i]);
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
        curve[n] = (nh_curve){.name = name[n],
                              .count = c->count,
                              .x = x->value,
                              .x_stride = x->stride,
                              .y = y->value,
                              .y_stride = y->stride};
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
    const nh_system *s = w->system;
    bool marks = false;
    for (size_t k = 0; k < n; k++) marks |= curve[k].heading != NULL;
    for (size_t i = s->coordinates; i-- > 0;)
        for (size_t k = c->shapes; k-- > 0;) {
            if (c->shape[k].kind == NH_SHAPE_SEGMENT || nh_shape_in_space(c->shape[k].kind)) continue;
            if (s->coordinate[i].q == c->shape[k].value[0]) plot.x_label = s->coordinate[i].name;
            if (s->coordinate[i].q == c->shape[k].value[1]) plot.y_label = s->coordinate[i].name;
        }
    nh_html_figure(w, &plot,
                   marks ? "Path of the motion; the marks show the heading of a body at equal time steps."
                         : "Path of the motion.");
}

static void number(nh_html_writer *w, double value, int digits)
{
    if (isfinite(value)) nh_text_addf(w->out, "%.*g", digits, value);
    else nh_html_add(w, "null");
}

/* `once`: constants are written once. */
static void frames(nh_html_writer *w, const char *before, size_t count, const nh_line *line, size_t step, bool once)
{
    enum { digits = 6, in_space = 5 };
    bool same = once;
    for (size_t i = 0; i < count && same; i++) same = line->value[i * line->stride] == line->value[0];
    nh_text_addf(w->out, "%s[", before);
    for (size_t i = 0; i < count; i += same ? count : step) {
        if (i) nh_html_add(w, ",");
        number(w, line->value[i * line->stride], once ? in_space : digits);
    }
    nh_html_add(w, "]");
}

static void three(nh_html_writer *w, const char *key, const double v[3])
{
    nh_text_addf(w->out, "\"%s\":[%.9g,%.9g,%.9g],", key, v[0], v[1], v[2]);
}

static void eye(nh_html_writer *w, const nh_view *v, size_t step)
{
    nh_text_addf(w->out, ",\"view\":{\"wide\":%g,\"high\":%g,\"up\":%d,\"sides\":%d,\"arcs\":%d,", v->wide, v->high,
                 v->up, NH_VIEW_SIDES, NH_VIEW_ARCS);
    three(w, "towards", v->towards);
    three(w, "right", v->right);
    three(w, "top", v->top);
    three(w, "light", v->light);
    const struct {
        const char *key;
        double value;
    } all[] = {{"ambient", v->ambient}, {"direct", v->direct}, {"white", v->white},       {"solid", v->solid},
               {"faint", v->faint},     {"behind", v->behind}, {"distance", v->distance}, {"scale", v->scale},
               {"x", v->x},             {"y", v->y},           {"floor", v->floor},       {"pitch", v->pitch},
               {"dot", v->dot}};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++)
        nh_text_addf(w->out, "\"%s\":%.9g,", all[k].key, all[k].value);
    for (size_t j = 0; j < 3; j++) {
        const nh_line middle = {.value = v->middle + j, .stride = 3};
        frames(w, j ? "," : "\"middle\":[", v->count, &middle, step, true);
    }
    nh_html_add(w, "]}");
}

/* The numbers for the script; they contain no text of the user. */
static void data(nh_html_writer *w, const nh_time_series *c, const nh_view *view)
{
    size_t step = (c->count + most_frames - 2) / most_frames, shown = 0;
    const nh_line time = {.value = c->time, .stride = 1};
    if (step == 0) step = 1;
    nh_html_add(w, "<script type=\"application/json\" id=\"motion-data\">{");
    frames(w, "\"t\":", c->count, &time, step, false);
    if (view) eye(w, view, step);
    nh_html_add(w, ",\"shapes\":[");
    for (size_t i = 0; i < c->shapes; i++) {
        if (w->space && c->shape[i].flat) continue;
        nh_text_addf(w->out, "%s{\"kind\":\"%s\",\"v\":[", shown++ ? "," : "", nh_shape_name(c->shape[i].kind));
        for (size_t j = 0; j < nh_shape_numbers(c->shape[i].kind); j++)
            frames(w, j ? "," : "", c->count, nh_time_series_shape(c, i, j), step, w->space);
        nh_html_add(w, "]}");
    }
    nh_html_add(w, "]}</script>\n");
}

static void player(nh_html_writer *w, const nh_time_series *c, const nh_view *view)
{
    w->space = view != NULL;
    nh_html_add(w, "<div id=\"player\" hidden=\"hidden\">\n");
    if (c->shapes) {
        nh_html_add(w, "<figure><svg id=\"scene\" class=\"plot\" role=\"img\" aria-label=\"The system in motion; the "
                       "slider below chooses the time\" viewBox=\"0 0 640 420\" width=\"640\" height=\"420\"></svg>"
                       "<figcaption>The system in motion, with its path. Drawn: ");
        nh_html_text(w, w->space ? "bodies in space, in perspective" : c->drawing);
        nh_html_add(w, ".</figcaption></figure>\n");
    }
    nh_html_add(w,
                "<div class=\"controls\"><button type=\"button\" id=\"play\" aria-label=\"play or pause\">Play</button>"
                "<input type=\"range\" id=\"when\" min=\"0\" max=\"1000\" value=\"0\" step=\"1\" aria-label=\"time\"/> "
                "<output id=\"clock\" for=\"when\">t = 0</output>\n"
                "<label>speed <select id=\"speed\"><option>0.25</option><option>0.5</option><option "
                "selected=\"selected\">1</option>"
                "<option>2</option><option>4</option></select></label> "
                "<label><input type=\"checkbox\" id=\"loop\"/> loop</label> ");
    if (c->shapes) nh_html_add(w, "<button type=\"button\" id=\"full\">Full screen</button>");
    nh_html_add(w, "</div></div>\n");
    data(w, c, view);
}

/* A still picture for paper, for files, and where no script runs. */
static void still(nh_html_writer *w, const nh_time_series *c, const nh_view *view)
{
    nh_plot plot = {.title = "Bodies in space",
                    .description = "The bodies at the end of the motion in perspective, with their paths",
                    .view = view,
                    .at = c->count - 1};
    if (!view) return;
    nh_html_add(w, "<div class=\"still\">");
    nh_html_figure(w, &plot, "The bodies at the end of the motion, with their paths; hidden sides are faint.");
    nh_html_add(w, "</div>\n");
}

void nh_html_time_series(nh_html_writer *w, const nh_time_series *c)
{
    enum { wide = 640, high = 420 };
    bool states = c->lines && c->line[0].kind == NH_TRACK_STATE;
    nh_view *view = nh_view_create(c, c->count, wide, high);
    player(w, c, view);
    still(w, c, view);
    nh_view_free(view);
    path_plot(w, c);
    if (states) positions(w, c);
    if (states) velocities(w, c);
    lines(w, c, NH_TRACK_ENERGY, 0, c->lines, "Energy", "E", "The energy function over time.");
    lines(w, c, NH_TRACK_WATCH, 0, c->lines, "Observables", "value", "Observables over time.");
    lines(w, c, NH_TRACK_MULTIPLIER, 0, c->lines, "Chetaev multipliers", "multiplier",
          c->model->k == 1 ? "The Chetaev multiplier over time."
                           : "Chetaev multipliers over time, in the order of the constraints.");
    if (!c->drifts_elsewhere) constancy(w, c);
}
