/* simulate_start: the system, the analysis file and the initial state of a motion: the given one, or one that satisfies
 * the constraints. */
#include "commands/simulate_internal.h"

#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "base/linalg.h"
#include "base/progress.h"
#include "graph/node.h"
#include "motion/first_state.h"

nh_analysis_file *nh_simulate_initial(const char *from, const char *initial, nh_error *error)
{
    return nh_analysis_file_start(from ? from : "--initial", initial, from ? NH_INPUT : NH_USAGE, error);
}

static bool resolve(nh_simulation *s, const nh_request *q, nh_analysis_file **own, nh_error *error)
{
    double begin = nh_budget_used();
    nh_progress("the equations of motion", -1);
    s->model =
        nh_model_create(s->system, nh_chart_create(s->system, q->chart, (uint64_t)q->options.seed, error), error);
    s->deriving = 1e6 * (nh_budget_used() - begin);
    if (!s->model || (s->analysis && !nh_analysis_file_resolve(s->analysis, s->model, error))) return false;
    return !q->initial || ((*own = nh_simulate_initial(q->from, q->initial, error)) &&
                           nh_analysis_file_resolve(*own, s->model, error));
}

/* "`dependent: [x, y]` does not follow .." */
static const char *words_chosen(const nh_simulation *s, const size_t *dependent)
{
    const nh_model *model = s->model;
    bool same = true;
    nh_text words;
    nh_text_init(&words);
    for (size_t a = 0; a < model->k; a++) {
        bool named = false;
        for (size_t b = 0; b < model->k; b++) named |= s->system->dependent[b] == dependent[a];
        same = same && named;
        nh_text_addf(&words, "%s%s'", a ? ", " : "", model->system->coordinate[dependent[a]].name);
    }
    const char *out = nh_arena_printf(s->arena,
                                      "at the initial state the constraints do not determine the velocities under "
                                      "`dependent:`; the program takes %s instead",
                                      nh_text_string(&words));
    nh_text_clear(&words);
    return same ? NULL : out;
}

/* Chooses, by the initial state, the branch of a quadratic constraint, and the dependent velocities, where those of the
 * chart do not follow from the constraints there, or its formulas are 0/0. */
static bool needs_other_chart(nh_simulation *s, const nh_state *at)
{
    const nh_model *model = s->model;
    size_t *dependent = nh_arena_alloc(s->arena, (model->m + 1) * sizeof *dependent);
    double *start = nh_arena_alloc(s->arena, (1 + 2 * model->m) * sizeof *start);
    if (nh_dynamics_other_branch(model, at)) {
        s->system->branch = -model->chart->branch;
        return true;
    }
    start[0] = at->t;
    memcpy(start + 1, at->q, model->m * sizeof *start);
    if (!nh_dynamics_other_dependents(model, at, dependent, start + 1 + model->m)) return false;
    if (s->system->dependents) s->chosen = words_chosen(s, dependent);
    s->system->dependent = dependent;
    s->system->dependents = model->k;
    s->system->start = start;
    return true;
}

static bool resolve_again(nh_simulation *s, const nh_request *q, nh_analysis_file **own, nh_error *error)
{
    nh_model_free(s->model);
    nh_analysis_file_free(*own);
    nh_analysis_file_free(s->analysis);
    s->model = NULL;
    s->analysis = *own = NULL;
    if (q->analysis_path && !(s->analysis = nh_analysis_file_read(q->analysis_path, error))) return false;
    return resolve(s, q, own, error);
}

/* The state as text after --initial: coordinates and the independent velocities. */
static const char *words_of_point(const nh_simulation *s, const double *z)
{
    const nh_chart *c = s->model->chart;
    nh_text words;
    nh_text_init(&words);
    for (size_t i = z[0] == 0; i < 1 + s->model->m + s->model->n; i++) {
        char number[40];
        nh_text_number(z[i], number, sizeof number);
        nh_text_addf(&words, "%s%s=%s", words.length ? ", " : "", nh_name_of(s->model->dag, c->symbol[i]), number);
    }
    const char *out = nh_arena_strdup(s->arena, nh_text_string(&words));
    nh_text_clear(&words);
    return out;
}

/* Which velocities are the chart's: the constraints determine the others, also where its formulas lose digits. */
static bool *independent_velocities(const nh_simulation *s)
{
    const nh_model *model = s->model;
    bool *own = nh_arena_alloc(s->arena, (model->m + 1) * sizeof *own);
    for (size_t i = 0; i < model->m; i++)
        for (size_t j = 0; j < model->n; j++) own[i] |= model->system->coordinate[i].v == model->chart->w[j];
    return own;
}

/* A state that satisfies the constraints where none is given: the chart's first probe, rounded where that is
 * possible. */
static bool choose_initial(nh_simulation *s, nh_state *initial)
{
    const nh_model *model = s->model;
    if (!model->chart->probes) return false;
    double *z = nh_arena_alloc(s->arena, model->width * sizeof *z);
    *initial = (nh_state){.q = nh_arena_alloc(s->arena, model->m * sizeof(double)),
                          .v = nh_arena_alloc(s->arena, model->m * sizeof(double))};
    memcpy(z, model->chart->probe, model->width * sizeof *z);
    if (!nh_first_state(model, z, initial->v)) return false;
    initial->t = z[0];
    memcpy(initial->q, z + 1, model->m * sizeof(double));
    nh_simulate_assemble(s, initial);
    if (s->assembled) { /* the probe satisfies the constraints between velocities alone */
        s->assembled = NULL;
        memcpy(z + 1, initial->q, model->m * sizeof(double));
        if (!nh_first_state(model, z, initial->v)) return false;
    }
    s->begin = words_of_point(s, z);
    if (!model->chart->quasi) initial->given = independent_velocities(s);
    return true;
}

static bool no_initial(const nh_simulation *s, nh_error *error)
{
    const char *name = s->system->coordinate[0].name;
    nh_fail(error, NH_USAGE, "", "simulate needs an initial state, and none was found on the constraints");
    return nh_error_hint(error, "--initial \"%s=0, %s'=1\"; omitted values are 0 or follow from the constraints", name,
                         name);
}

bool nh_simulate_read(nh_simulation *s, const nh_request *q, nh_state *initial, double *until, nh_error *error)
{
    nh_analysis_file *own = NULL;
    if (q->analysis_path && !(s->analysis = nh_analysis_file_read(q->analysis_path, error))) return false;
    size_t count = s->analysis ? s->analysis->settings : 0;
    nh_setting *setting = nh_arena_alloc(s->arena, (count + q->settings + 1) * sizeof *setting);
    if (count) memcpy(setting, s->analysis->setting, count * sizeof *setting);
    if (q->settings) memcpy(setting + count, q->setting, q->settings * sizeof *setting);
    if (!(s->system = nh_system_read(q->system_path, count + q->settings, setting, error))) return false;
    bool good = nh_system_needs_values(s->system, "a motion", error) && resolve(s, q, &own, error);
    nh_analysis_file *first = own ? own : s->analysis;
    if (good && q->project && first && first->has_initial) nh_simulate_assemble(s, &first->initial);
    if (good && first && first->has_initial && needs_other_chart(s, &first->initial)) {
        good = resolve_again(s, q, &own, error);
        first = own ? own : s->analysis;
        if (good && q->project) nh_simulate_assemble(s, &first->initial);
    }
    if (!good) {
        nh_analysis_file_free(own);
        return false;
    }
    const nh_analysis_file *from = own ? own : s->analysis;
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
    s->tolerance = !q->tolerance_given && s->analysis && s->analysis->has_tolerance ? s->analysis->tolerance
                                                                                    : q->options.tolerance;
    nh_analysis_file_free(own);
    if (given) return true;
    return choose_initial(s, initial) || no_initial(s, error);
}
