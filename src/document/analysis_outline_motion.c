/* The motion along which currents were checked, and the figures that an analysis file defines. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/analysis.h"
#include "document/analysis_internal.h"
#include "document/current_words.h"
#include "document/facts.h"
#include "document/live.h"

/* ---- the motion ---- */

static void drifts(nh_pen *p, const nh_analysis *result)
{
    const nh_validation *v = result->validation;
    char heads[200];
    if (!v->currents) return;
    snprintf(heads, sizeof heads, "current|#%g|#%g|#%g", v->tolerance[0], v->tolerance[1], v->tolerance[2]);
    nh_pen_table(p, "Drift of the currents, by tolerance of the integration", heads);
    for (size_t k = 0; k < v->currents; k++) {
        char text[NH_DRIFT_RUNS][16];
        for (size_t i = 0; i < NH_DRIFT_RUNS; i++) {
            double d = v->current[k].drift[i];
            snprintf(text[i], sizeof text[i], isfinite(d) ? "%.2g" : "\u2013", d);
        }
        nh_pen_row(p, "#<%s>|%s|%s|%s", result->list->found[k].name, text[0], text[1], text[2]);
    }
    nh_pen_table_end(p);
}
_Static_assert(NH_DRIFT_RUNS == 3, "the table of drifts has a column for each tolerance");

static const char *agree(double difference) { return difference > NH_MOTIONS_APART ? "differ by" : "agree to"; }

static void second_opinion(nh_pen *p, const nh_analysis *result)
{
    const nh_validation *v = result->validation;
    bool constrained = result->question->system->constraints > 0;
    if (v->crossing_chart && !isnan(v->crossing))
        nh_pen_words(p, "The chart of {%s} breaks down at t = %.4g; the chart of this motion is regular there.",
                     v->crossing_chart, v->crossing);
    if (!v->multiplier_form) return;
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "The same motion %s (%s): states %s %.2g",
               constrained ? "with Chetaev multipliers" : "by the equations of all coordinates", v->multiplier_method,
               agree(v->state_difference), v->state_difference);
    if (constrained)
        nh_pen_say(p, ", multipliers %s %.2g, and the constraints hold to %.2g", agree(v->multiplier_difference),
                   v->multiplier_difference, v->violation);
    if (v->multistep)
        nh_pen_say(p, "; by CVODE Adams states %s %.2g", agree(v->multistep_difference), v->multistep_difference);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
}

void nh_analysis_write_motion(nh_pen *p, const nh_analysis *result)
{
    const nh_validation *v = result->validation;
    if (!v || v->count < 2) return;
    nh_time_series *c = nh_time_series_of_analysis(result);
    nh_pen_section(p, "motion", "A motion");
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "%s in {%s}, t = %.4g to %.6g, %ld evaluations", v->method, v->chart, v->begin, v->end,
               v->evaluations);
    if (v->checked) nh_pen_say(p, ": %s", v->accuracy.why);
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
    p->ink->series(p->to, c);
    nh_time_series_free(c);
    drifts(p, result);
    if (v->scene)
        nh_pen_words(p, "%s: the same values to %.2g, with %ld evaluations.", v->scene, v->scene_difference,
                     v->scene_evaluations);
    second_opinion(p, result);
}

/* ---- figures ---- */

static nh_curve curve_of(const nh_figure_curve *c)
{
    return (nh_curve){
        .name = c->name, .count = c->count, .x = c->x, .x_stride = 1, .y = c->y, .y_stride = 1, .heading = c->heading};
}

/* Figures side by side, one per value of the parameter. */
static void paths(nh_pen *p, const nh_figure *f)
{
    const nh_named *q = f->request->quantity;
    nh_pen_open(p, NH_PEN_BESIDE, NULL, NULL);
    for (size_t k = 0; k < f->curves; k++) {
        char title[300];
        nh_curve curve = curve_of(&f->curve[k]);
        snprintf(title, sizeof title, f->request->values ? "%.150s: %.100s" : "%.150s", f->request->title,
                 f->curve[k].name);
        nh_plot plot = {.title = title,
                        .description = "A path in the plane, both axes on one scale",
                        .x_label = q[0].name,
                        .y_label = q[1].name,
                        .equal = true,
                        .curves = 1,
                        .curve = &curve};
        nh_pen_plot(p, &plot, title);
    }
    nh_pen_close(p, NH_PEN_BESIDE);
}

static void over_time(nh_pen *p, const nh_figure *f)
{
    nh_curve *curve = nh_alloc_array(f->curves + 1, sizeof *curve);
    for (size_t k = 0; k < f->curves; k++) curve[k] = curve_of(&f->curve[k]);
    nh_plot plot = {.title = f->request->title,
                    .description = "Quantities along motions, over time",
                    .x_label = "t",
                    .y_label = f->request->quantities == 1 ? f->request->quantity[0].name : "value",
                    .curves = f->curves,
                    .curve = curve};
    nh_pen_plot(p, &plot, f->request->title);
    nh_free(curve);
}

/* The curve, with the values that were found as points. */
static void scan(nh_pen *p, const nh_analysis *result, const nh_figure *f)
{
    size_t n = result->hits ? result->hits->count : 0, u = f->request->unknown;
    double *found = nh_alloc_array(2 * n + 1, sizeof *found);
    for (size_t k = 0; k < n; k++)
        found[k] = result->hits->hit[k].value[u], found[n + k] = result->hits->hit[k].quotient;
    nh_curve curve[] = {
        curve_of(&f->curve[0]),
        {.name = "values found", .count = n, .x = found, .x_stride = 1, .y = found + n, .y_stride = 1, .dots = true}};
    curve[0].name = "smallest singular value that is not null everywhere";
    nh_plot plot = {.title = f->request->title,
                    .description = "The smallest generalized singular value that does not vanish for all values of the "
                                   "unknown, on a logarithmic "
                                   "scale; it falls to rounding error where a current exists",
                    .x_label = f->curve[0].name,
                    .y_label = "singular value",
                    .log_y = true,
                    .floor = 1e-17,
                    .curves = n ? 2 : 1,
                    .curve = curve};
    nh_pen_plot(p, &plot, f->request->title);
    nh_free(found);
}

static void samples(nh_pen *p, const nh_figure *f)
{
    nh_curve curve[] = {curve_of(&f->curve[0]), curve_of(&f->curve[1])};
    curve[0].marks = curve[1].marks = true;
    nh_plot plot = {
        .title = f->request->title,
        .description = "The two sides of the gap in the spectrum of generalized singular values, on logarithmic scales",
        .x_label = "samples",
        .y_label = "singular value",
        .log_x = true,
        .log_y = true,
        .floor = 1e-18,
        .curves = 2,
        .curve = curve};
    nh_pen_plot(p, &plot, f->request->title);
}

static void residual(nh_pen *p, const nh_figure *f)
{
    nh_curve *curve = nh_alloc_array(f->curves + 1, sizeof *curve);
    for (size_t k = 0; k < f->curves; k++) {
        curve[k] = curve_of(&f->curve[k]);
        curve[k].dots = true;
    }
    nh_plot plot = {.title = f->request->title,
                    .description = "Sample points of the constraint submanifold, by the largest relative rate of the "
                                   "functions there",
                    .x_label = f->request->quantity[0].name,
                    .y_label = f->request->quantity[1].name,
                    .curves = f->curves,
                    .curve = curve};
    nh_pen_plot(
        p, &plot,
        "Sample points, by the largest rate there, relative to its terms: below rounding where it is conserved.");
    nh_free(curve);
}

void nh_analysis_write_figures(nh_pen *p, const nh_analysis *result)
{
    if (!result->figures || p->ink->brief) return;
    nh_pen_section(p, "figures", "Figures");
    nh_pen_words(p, "The analysis file defines these figures.");
    for (size_t i = 0; i < result->figures; i++) {
        const nh_figure *f = &result->figure[i];
        if (!f->curves) continue;
        if (f->request->kind == NH_FIGURE_PATH) paths(p, f);
        else if (f->request->kind == NH_FIGURE_PLOT) over_time(p, f);
        else if (f->request->kind == NH_FIGURE_SCAN) scan(p, result, f);
        else if (f->request->kind == NH_FIGURE_SAMPLES) samples(p, f);
        else residual(p, f);
    }
}

/* ---- the motion with its quantities, at the top of a page ---- */

enum { room = 24 }; /* characters, for the names of parameters */

/* The tracks of the analysis, then the multipliers: the lines of its time series. */
static const nh_observables *with_multipliers(const nh_analysis *result)
{
    nh_model *model = result->question->model;
    nh_observables *t = nh_arena_alloc(result->arena, sizeof *t);
    *t = result->tracks;
    t->track = nh_arena_alloc(result->arena, (t->count + model->k + 1) * sizeof *t->track);
    memcpy(t->track, result->tracks.track, t->count * sizeof *t->track);
    for (size_t a = 0; a < model->k; a++)
        t->track[t->count++] =
            (nh_track){nh_arena_printf(result->arena, "c%zu", a + 1), NH_TRACK_MULTIPLIER, model->mu[a]};
    return t;
}

/* Without the sign of equality, or the full stop, at its end. */
static const char *without_end(nh_arena *arena, const char *text, const char *end)
{
    size_t n = strlen(text);
    while (n && strchr(end, text[n - 1])) n--;
    return nh_arena_strndup(arena, text, n);
}

static const char *joined(nh_arena *arena, const char *a, const char *b)
{
    return nh_arena_printf(arena, "%s%s%s", a, *b ? " " : "", b);
}

/* "for all m, k", and under which conditions; many names are not told. */
static const char *brief_proof(const nh_analysis *result, const nh_current *f)
{
    static const char *const conditions[] = {" with ", ", real where "};
    static const char all[] = " for all ";
    const char *sure = nh_facts_proof(result, f), *rest = sure + strlen(sure);
    for (size_t i = 0; i < sizeof conditions / sizeof *conditions; i++) {
        const char *at = strstr(sure, conditions[i]);
        if (at && at < rest) rest = at;
    }
    bool listed = f->proof.all_parameters && !strncmp(sure, all, sizeof all - 1);
    if (!listed || (size_t)(rest - sure) <= room) return sure;
    return nh_arena_printf(result->arena, "for all parameter values%s", rest);
}

static nh_stage_row row_of(const nh_analysis *result, const nh_current *f)
{
    nh_current_words words = nh_current_words_of(result, f, true, NULL);
    const char *sure = brief_proof(result, f);
    nh_stage_row row = {.name = joined(result->arena, words.name, words.of),
                        .doc = f->independence == NH_DEPENDENT ? "follows from the others" : words.doc,
                        .from = joined(result->arena, words.how, words.what),
                        .sure = *sure == ' ' ? sure + 1 : sure,
                        .anchor = nh_arena_printf(result->arena, "q-%s", f->name),
                        .label = without_end(result->arena, nh_current_label(result, f), "= "),
                        .value = nh_analysis_answer_shown(result, f),
                        .proved = f->proof.proved,
                        .series = f->series != NULL,
                        .drift = f->drift.drift[NH_DRIFT_RUNS - 1]};
    return row;
}

nh_stage *nh_analysis_stage(const nh_analysis *result, const nh_run *run)
{
    const nh_current_list *list = result->list;
    const nh_validation *v = result->validation;
    if (!v || v->count < 2) return NULL;
    nh_stage *s = nh_arena_alloc(result->arena, sizeof *s);
    nh_stage_row *row = nh_arena_alloc(result->arena, (list->count + 1) * sizeof *row);
    for (size_t k = 0; k < list->count; k++) row[k] = row_of(result, &list->found[k]);
    const nh_observables *tracks = with_multipliers(result);
    *s = (nh_stage){.series = nh_time_series_of_analysis(result),
                    .tracks = tracks,
                    .live = nh_live_of_analysis(result, tracks),
                    .command = nh_live_command(result->arena, run, result->question->system),
                    .rows = list->count,
                    .row = row};
    return s;
}
