#include "commands/figures.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "commands/simulate.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

enum { outputs = 601, scan_points = 128, scan_values = 401 };

/* ---- one motion ---- */

/* Computes a motion with one parameter changed, for which the files are read anew: initial values and expressions may
 * depend on it. */
static bool open_motion(nh_simulation *s, const nh_analysis *result, const nh_request *q, const nh_figure_request *f,
                        double value, nh_state *initial, double *until, nh_error *error)
{
    nh_setting *setting = nh_arena_alloc(s->arena, (q->settings + 1) * sizeof *setting);
    size_t settings = q->settings;
    if (settings) memcpy(setting, q->setting, settings * sizeof *setting);
    if (f->values) setting[settings++] = (nh_setting){.name = f->vary, .value = value};
    nh_request motion = {.system_path = q->system_path,
                         .analysis_path = q->analysis_path,
                         .settings = settings,
                         .setting = setting,
                         .chart = q->chart,
                         .options = result->question->options,
                         .until_given = true,
                         .tolerance_given = true};
    if (motion.chart == NH_CHART_AUTO) motion.chart = result->question->analysis->chart;
    return nh_simulate_read(s, &motion, initial, until, error);
}

/* Follows a motion from the initial time to `end`, which may be earlier: quantity k at value[i * n + k], i counted from
 * the initial time. */
static nh_trajectory *integrate(nh_simulation *s, const nh_analysis *result, const nh_request *q,
                                const nh_figure_request *f, const nh_state *initial, double end, size_t count,
                                double *times, nh_error *error)
{
    nh_options options = result->question->options;
    nh_ex *e = nh_arena_alloc(s->arena, (f->quantities + 1) * sizeof *e);
    for (size_t k = 0; k < f->quantities; k++) e[k] = f->quantity[k].value;
    for (size_t i = 0; i < count; i++) times[i] = initial->t + (end - initial->t) * (double)i / (double)(count - 1);
    nh_trajectory_request request = {.model = s->model,
                                     .initial = initial,
                                     .count = count,
                                     .times = times,
                                     .options = &options,
                                     .n = f->quantities,
                                     .e = e};
    if (!(q->accuracy > 0)) return nh_trajectory_create(&request, error);
    nh_accuracy ignored;
    nh_choice choice = {.system = s->system, .model = s->model, .seed = (uint64_t)options.seed};
    nh_choice_open(&choice, false);
    nh_trajectory *t = nh_trajectory_accurate(&request, q->accuracy, &choice.ways, &ignored, error);
    nh_choice_close(&choice);
    return t;
}

typedef struct {
    size_t count;
    double *time, *value; /* count; count x quantities; in the result's arena */
} course;

/* Adds the outputs of one direction, the initial one only once, backwards where time runs back. */
static void join(course *c, const nh_trajectory *part, size_t n, bool back)
{
    size_t count = part->motion->count, skip = back || c->count == 0 ? 0 : 1;
    for (size_t i = skip; i < count; i++) {
        size_t from = back ? count - 1 - (i - skip) : i;
        c->time[c->count] = part->motion->time[from];
        memcpy(c->value + c->count * n, part->value + from * n, n * sizeof *c->value);
        c->count++;
    }
}

static bool follow(nh_analysis *result, const nh_request *q, size_t which, double value, course *out, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_simulation *s = nh_arena_alloc(arena, sizeof *s);
    nh_state initial;
    double until;
    s->arena = arena;
    bool good = open_motion(s, result, q, &result->question->analysis->figure[which], value, &initial, &until, error);
    const nh_figure_request *f = good ? &s->analysis->figure[which] : NULL;
    double begin = good && f->has_time ? f->begin : initial.t, end = good && f->has_time ? f->end : until;
    out->time = nh_arena_alloc(result->arena, 2 * outputs * sizeof *out->time);
    out->value = good ? nh_arena_alloc(result->arena, 2 * outputs * (f->quantities + 1) * sizeof *out->value) : NULL;
    out->count = 0;
    double *times = nh_arena_alloc(arena, outputs * sizeof *times);
    for (int part = 0; part < 2 && good; part++) {
        double to = part == 0 ? begin : end;
        if (part == 0 ? !(to < initial.t) : !(to > initial.t)) continue;
        nh_trajectory *t = integrate(s, result, q, f, &initial, to, outputs, times, error);
        good = t != NULL;
        if (good) join(out, t, f->quantities, part == 0);
        nh_trajectory_free(t);
    }
    nh_simulation_free(s);
    return good && out->count > 1;
}

/* ---- a figure ---- */

static const char *name_of(nh_analysis *result, const nh_figure_request *f, size_t k, double value)
{
    char number[40];
    nh_text_number(value, number, sizeof number);
    if (!f->values) return f->kind == NH_FIGURE_PATH ? f->title : f->quantity[k].name;
    if (f->kind == NH_FIGURE_PATH) return nh_arena_printf(result->arena, "%s = %s", f->vary, number);
    return nh_arena_printf(result->arena, "%s, %s = %s", f->quantity[k].name, f->vary, number);
}

static double *column(nh_analysis *result, const course *c, size_t n, size_t k)
{
    double *out = nh_arena_alloc(result->arena, (c->count + 1) * sizeof *out);
    for (size_t i = 0; i < c->count; i++) out[i] = c->value[i * n + k];
    return out;
}

static void add_motion(nh_analysis *result, nh_figure *figure, const course *c, double value)
{
    const nh_figure_request *f = figure->request;
    size_t n = f->quantities;
    if (f->kind == NH_FIGURE_PATH) {
        figure->curve[figure->curves++] = (nh_figure_curve){
            name_of(result, f, 0, value),          0, value, c->count, column(result, c, n, 0), column(result, c, n, 1),
            n > 2 ? column(result, c, n, 2) : NULL};
        return;
    }
    for (size_t k = 0; k < n; k++)
        figure->curve[figure->curves++] =
            (nh_figure_curve){name_of(result, f, k, value), k, value, c->count, c->time, column(result, c, n, k), NULL};
}

static void motions(nh_analysis *result, const nh_request *q, size_t which, nh_figure *figure)
{
    const nh_figure_request *f = figure->request;
    size_t count = f->values ? f->values : 1;
    figure->curve = nh_arena_alloc(result->arena, (count * f->quantities + 1) * sizeof *figure->curve);
    for (size_t i = 0; i < count && !nh_interrupted(); i++) {
        nh_error trouble;
        nh_error_clear(&trouble);
        course c;
        double value = f->values ? f->value[i] : NAN;
        if (follow(result, q, which, value, &c, &trouble)) add_motion(result, figure, &c, value);
        else nh_analysis_warn(result, "figure `%s`: a curve is missing: %s", f->title, trouble.what);
    }
}

static void scan(nh_analysis *result, nh_figure *figure)
{
    nh_model *model = result->question->model;
    const nh_analysis_file *a = result->question->analysis;
    const nh_unknown *u = &a->unknown[figure->request->unknown];
    nh_error trouble;
    nh_error_clear(&trouble);
    double *x = nh_arena_alloc(result->arena, scan_values * sizeof *x),
           *y = nh_arena_alloc(result->arena, scan_values * sizeof *y);
    for (size_t i = 0; i < scan_values; i++) x[i] = u->low + (u->high - u->low) * (double)i / (scan_values - 1);
    nh_points *points = nh_points_create(model, scan_points, 1, (uint64_t)result->question->options.seed, &trouble);
    bool good = points && result->hits &&
                nh_unknowns_scan(model, points, a->families, a->family, u, &result->question->options,
                                 result->hits->generic, scan_values, x, y, &trouble);
    nh_points_free(points);
    if (!good) {
        nh_analysis_warn(result, "figure `%s`: %s", figure->request->title,
                         trouble.code != NH_OK ? trouble.what : "the unknown was not searched");
        return;
    }
    figure->curve = nh_arena_alloc(result->arena, 2 * sizeof *figure->curve);
    figure->curve[figure->curves++] =
        (nh_figure_curve){nh_name_of(model->dag, u->symbol), 0, NAN, scan_values, x, y, NULL};
}

/* The two values beside the gap for one number of samples; NAN where there is no such value. */
static bool gap_at(const nh_analysis *result, const nh_ansatz *a, size_t count, double out[2], nh_error *error)
{
    nh_points *points =
        nh_points_create(result->question->model, count, 1, (uint64_t)result->question->options.seed, error);
    if (!points) return false;
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_rows *rows = nh_rows_create(result->question->model, a, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&result->question->options);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, error);
    out[0] = s && s->dimension ? s->spectrum[s->dimension - 1] : NAN;
    out[1] = s && s->dimension < s->rank ? s->spectrum[s->dimension] : NAN;
    bool good = s != NULL;
    nh_nullspace_free(s);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_points_free(points);
    return good;
}

static void samples(nh_analysis *result, size_t families, const nh_family *family, nh_figure *figure)
{
    const nh_figure_request *f = figure->request;
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_points *ranges = families ? nh_points_create(result->question->model, scan_points, 1,
                                                    (uint64_t)result->question->options.seed, &trouble)
                                 : NULL;
    nh_ansatz *a = ranges ? nh_ansatz_create(result->question->model, ranges, families, family,
                                             (size_t)result->question->options.columns, &trouble)
                          : NULL;
    nh_points_free(ranges);
    double *x = nh_arena_alloc(result->arena, (f->values + 1) * sizeof *x), *y[2], gap[2];
    size_t n = 0;
    for (int j = 0; j < 2; j++) y[j] = nh_arena_alloc(result->arena, (f->values + 1) * sizeof **y);
    for (size_t i = 0; i < f->values && a && !nh_interrupted(); i++) {
        if (!gap_at(result, a, (size_t)f->value[i], gap, &trouble)) continue;
        x[n] = f->value[i];
        y[0][n] = gap[0];
        y[1][n++] = gap[1];
    }
    nh_ansatz_free(a);
    if (!n)
        nh_analysis_warn(result, "figure `%s`: %s", f->title,
                         trouble.code != NH_OK ? trouble.what : "it needs an ansatz in the analysis file");
    figure->curve = nh_arena_alloc(result->arena, 2 * sizeof *figure->curve);
    for (int j = 0; j < 2 && n; j++)
        figure->curve[figure->curves++] =
            (nh_figure_curve){j ? "smallest value above the gap" : "largest null value", 0, NAN, n, x, y[j], NULL};
}

/* ---- where the equations hold ---- */

enum { map_points = 2000, bands = 3 };
static const double band_ends[bands] = {1e-12, 1e-6, INFINITY};
static const char *const band_names[bands] = {"below 1e-12", "1e-12 to 1e-6", "above 1e-6"};

/* The function that the figure is about, or all currents, with those of a part of the motions. */
static size_t functions_of(const nh_analysis *result, const nh_figure_request *f, nh_ex *phi)
{
    const nh_current_list *list = result->list;
    size_t n = 0;
    if (f->of) phi[n++] = f->of;
    for (size_t k = 0; k < list->count && !f->of; k++) phi[n++] = list->found[k].phi;
    for (size_t k = 0; k < list->pieces && !f->of; k++) phi[n++] = list->piece[k].phi;
    return n;
}

/* At each point the largest |Gamma(Phi)| of n functions, relative to the sum of the terms |q'^s dPhi/dq^s|,
 * |w'^i dPhi/dw^i|, |dPhi/dt|. */
static double *residuals(const nh_model *model, const nh_points *points, size_t n, const nh_ex *function)
{
    nh_dag *d = model->dag;
    size_t terms = 1 + model->m + model->n, per = 1 + terms;
    nh_ex *e = nh_alloc_array(n * per + 1, sizeof *e);
    for (size_t k = 0; k < n; k++) {
        nh_ex phi = function[k], *own = e + k * per;
        own[0] = nh_model_gamma(model, phi);
        own[1] = nh_diff(d, phi, model->system->t);
        for (size_t s = 0; s < model->m; s++)
            own[2 + s] = nh_mul(d, model->rho[s], nh_diff(d, phi, model->system->coordinate[s].q));
        for (size_t i = 0; i < model->n; i++) own[2 + model->m + i] = nh_mul(d, model->a[i], nh_model_Y(model, i, phi));
    }
    double *value = nh_alloc_array(n * per * points->count + 1, sizeof *value),
           *worst = nh_alloc_array(points->count + 1, sizeof *worst);
    nh_points_evaluate(points, model, n * per, e, value);
    for (size_t k = 0; k < n; k++)
        for (size_t p = 0; p < points->count; p++) {
            double size = 0, rate = fabs(value[k * per * points->count + p]);
            for (size_t j = 1; j < per; j++) size += fabs(value[(k * per + j) * points->count + p]);
            if (isfinite(rate) && isfinite(size) && rate > 0) worst[p] = fmax(worst[p], rate / fmax(size, rate));
        }
    nh_free(value);
    nh_free(e);
    return worst;
}

static void residual(nh_analysis *result, nh_figure *figure)
{
    const nh_figure_request *f = figure->request;
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_points *points = nh_points_create(result->question->model, map_points, 1,
                                         (uint64_t)result->question->options.seed + 1, &trouble);
    nh_ex *phi = nh_arena_alloc(result->arena, (result->list->count + result->list->pieces + 2) * sizeof *phi);
    size_t n = functions_of(result, f, phi);
    if (!points || !n) {
        nh_analysis_warn(result, "figure `%s`: %s", f->title, points ? "there are no currents" : trouble.what);
        nh_points_free(points);
        return;
    }
    double *worst = residuals(result->question->model, points, n, phi),
           *at = nh_alloc_array(2 * points->count + 1, sizeof *at);
    nh_points_evaluate(points, result->question->model, 2, (nh_ex[]){f->quantity[0].value, f->quantity[1].value}, at);
    figure->curve = nh_arena_alloc(result->arena, bands * sizeof *figure->curve);
    for (int b = 0; b < bands; b++) {
        nh_figure_curve c = {band_names[b], 0, NAN, 0, NULL, NULL, NULL};
        c.x = nh_arena_alloc(result->arena, (points->count + 1) * sizeof *c.x);
        c.y = nh_arena_alloc(result->arena, (points->count + 1) * sizeof *c.y);
        for (size_t p = 0; p < points->count; p++) {
            if (worst[p] >= band_ends[b] || (b && worst[p] < band_ends[b - 1])) continue;
            c.x[c.count] = at[p];
            c.y[c.count++] = at[points->count + p];
        }
        if (c.count) figure->curve[figure->curves++] = c;
    }
    nh_free(at);
    nh_free(worst);
    nh_points_free(points);
}

void nh_figures_compute(nh_analysis *result, const nh_request *q, size_t families, const nh_family *family)
{
    const nh_analysis_file *a = result->question->analysis;
    if (!a || !a->figures) return;
    nh_progress("the figures of the analysis file", -1);
    result->figure = nh_arena_alloc(result->arena, a->figures * sizeof *result->figure);
    for (size_t i = 0; i < a->figures && !nh_interrupted(); i++) {
        nh_figure *f = &result->figure[result->figures++];
        *f = (nh_figure){.request = &a->figure[i]};
        if (f->request->kind == NH_FIGURE_SCAN) scan(result, f);
        else if (f->request->kind == NH_FIGURE_SAMPLES) samples(result, families, family, f);
        else if (f->request->kind == NH_FIGURE_RESIDUAL) residual(result, f);
        else motions(result, q, i, f);
    }
}
