#include "study/simulate.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

enum { default_outputs = 100, most_outputs = 10000000 };

nh_analysis *nh_simulate_initial(nh_arena *arena, const char *initial, nh_error *error)
{
    size_t length = strlen(initial);
    char *text = nh_arena_alloc(arena, 2 * length + 64), *to = text + sprintf(text, "validate:\n  initial: {");
    for (const char *c = initial; *c; c++) {
        if (*c == '=') {
            *to++ = ':';
            *to++ = ' ';
        } else {
            *to++ = *c;
        }
    }
    strcpy(to, "}\n");
    return nh_analysis_text("--initial", text, error);
}

static bool resolve(nh_simulation *s, const nh_simulate_request *q, nh_analysis **own, nh_error *error)
{
    s->model = nh_model_create(s->system, nh_chart_create(s->system, q->chart, (uint64_t)q->options.seed, error), error);
    if (!s->model || (s->analysis && !nh_analysis_resolve(s->analysis, s->model, error))) return false;
    return !q->initial || ((*own = nh_simulate_initial(s->arena, q->initial, error)) && nh_analysis_resolve(*own, s->model, error));
}

/* The initial state chooses the branch of a quadratic constraint. */
static bool resolve_again(nh_simulation *s, const nh_simulate_request *q, nh_analysis **own, nh_error *error)
{
    s->system->branch = -s->model->chart->branch;
    nh_model_free(s->model);
    nh_analysis_free(*own);
    nh_analysis_free(s->analysis);
    s->model = NULL;
    s->analysis = *own = NULL;
    if (q->analysis_path && !(s->analysis = nh_analysis_read(q->analysis_path, error))) return false;
    return resolve(s, q, own, error);
}

static bool read_all(nh_simulation *s, const nh_simulate_request *q, nh_state *initial, double *until, nh_error *error)
{
    nh_analysis *own = NULL;
    if (q->analysis_path && !(s->analysis = nh_analysis_read(q->analysis_path, error))) return false;
    size_t count = s->analysis ? s->analysis->settings : 0;
    nh_setting *setting = nh_arena_alloc(s->arena, (count + q->settings + 1) * sizeof *setting);
    if (count) memcpy(setting, s->analysis->setting, count * sizeof *setting);
    if (q->settings) memcpy(setting + count, q->setting, q->settings * sizeof *setting);
    if (!(s->system = nh_system_read(q->system_path, count + q->settings, setting, error))) return false;
    bool good = resolve(s, q, &own, error);
    const nh_state *at = own ? &own->initial : s->analysis ? &s->analysis->initial : NULL;
    if (good && at && nh_dynamics_other_branch(s->model, at)) good = resolve_again(s, q, &own, error);
    if (!good) {
        nh_analysis_free(own);
        return false;
    }
    const nh_analysis *from = own ? own : s->analysis;
    bool given = from && from->has_initial;
    if (given) {
        *initial = from->initial;
        initial->q = nh_arena_alloc(s->arena, (s->model->m + 1) * sizeof(double));
        initial->v = nh_arena_alloc(s->arena, (s->model->m + 1) * sizeof(double));
        memcpy(initial->q, from->initial.q, s->model->m * sizeof(double));
        memcpy(initial->v, from->initial.v, s->model->m * sizeof(double));
        if (from->initial.given) {
            initial->given = nh_arena_alloc(s->arena, (s->model->m + 1) * sizeof(bool));
            memcpy(initial->given, from->initial.given, s->model->m * sizeof(bool));
        }
    }
    *until = !q->until_given && s->analysis && s->analysis->has_until ? s->analysis->until : q->options.until;
    s->tolerance = !q->tolerance_given && s->analysis && s->analysis->has_tolerance ? s->analysis->tolerance : q->options.tolerance;
    nh_analysis_free(own);
    if (given) return true;
    nh_fail(error, NH_USAGE, "", "simulate needs an initial state");
    return nh_error_hint(error, "--initial \"%s=0, %s=1\"; what is not named is 0 or follows from the constraints", s->system->coordinate[0].name, nh_name_of(s->model->dag, s->model->chart->w[0]));
}

static void add(nh_simulation *s, const char *name, nh_column_kind kind, nh_ex value) { s->column[s->columns++] = (nh_simulated){name, kind, value}; }

static void list_columns(nh_simulation *s)
{
    const nh_model *o = s->model;
    nh_error ignored;
    nh_error_clear(&ignored);
    size_t watches = s->analysis ? s->analysis->watches : 0;
    s->column = nh_arena_alloc(s->arena, (2 * o->m + o->n + o->k + s->system->currents + watches + 2) * sizeof *s->column);
    for (size_t i = 0; i < o->m; i++) add(s, s->system->coordinate[i].name, NH_COLUMN_STATE, s->system->coordinate[i].q);
    for (size_t i = 0; i < o->m; i++) add(s, nh_name_of(o->dag, s->system->coordinate[i].v), NH_COLUMN_STATE, o->rho[i]);
    for (size_t i = 0; i < o->n && o->chart->quasi; i++) add(s, nh_name_of(o->dag, o->chart->w[i]), NH_COLUMN_STATE, o->chart->w[i]);
    for (size_t k = 0; k < s->system->currents; k++) {
        nh_ex e;
        if (nh_analysis_to_chart(o, s->system->current[k].value, &e, &ignored)) add(s, s->system->current[k].name, NH_COLUMN_CURRENT, e);
    }
    for (size_t a = 0; a < o->k; a++) add(s, nh_arena_printf(s->arena, "c%zu", a + 1), NH_COLUMN_MULTIPLIER, o->mu[a]);
    add(s, "E", NH_COLUMN_ENERGY, o->E);
    for (size_t i = 0; i < watches; i++) add(s, s->analysis->watch[i].name, NH_COLUMN_WATCH, s->analysis->watch[i].value);
}

static double *output_times(nh_simulation *s, const nh_simulate_request *q, double begin, double end, size_t *count, nh_error *error)
{
    double span = fabs(end - begin), step = q->step > 0 ? q->step : span / default_outputs, steps = ceil(span / step * (1 - 1e-12));
    if (!(span > 0) || !(steps < most_outputs)) {
        nh_fail(error, NH_USAGE, "", span > 0 ? "the output step %g is too small for the time %g" : "the motion ends where it begins (t = %g)", span > 0 ? step : end, span);
        return NULL;
    }
    *count = (size_t)steps + 1;
    double *times = nh_arena_alloc(s->arena, *count * sizeof *times);
    for (size_t i = 0; i < *count; i++) times[i] = i + 1 == *count ? end : begin + (end > begin ? step : -step) * (double)i;
    return times;
}

nh_simulation *nh_simulate(const nh_simulate_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_simulation *s = nh_arena_alloc(arena, sizeof *s);
    nh_state initial;
    double until, *times = NULL;
    size_t count;
    s->arena = arena;
    if (read_all(s, q, &initial, &until, error)) times = output_times(s, q, initial.t, until, &count, error);
    if (times) {
        nh_options options = q->options;
        options.tolerance = s->tolerance;
        list_columns(s);
        nh_ex *e = nh_arena_alloc(arena, (s->columns + 1) * sizeof *e);
        for (size_t k = 0; k < s->columns; k++) e[k] = s->column[k].value;
        s->motion = nh_motion_of(s->model, &initial, q->project, count, times, &options, &s->formulation, s->columns, e, &s->value, error);
        if (s->motion) return s;
    }
    nh_simulation_free(s);
    return NULL;
}

void nh_simulation_free(nh_simulation *s)
{
    if (!s) return;
    nh_motion_free(s->motion);
    nh_free(s->value);
    nh_model_free(s->model);
    nh_analysis_free(s->analysis);
    nh_system_free(s->system);
    nh_arena_free(s->arena);
}
