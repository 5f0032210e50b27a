#include "search/staged_search.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "integrals/prove.h"
#include "search/stage_solver.h"
#include "search/constraint_integrals.h"
#include "search/quadratures.h"
#include "search/stages.h"

/* Currents found so far as factors: Phi times 1, t, positions and the system's functions. */
static void known_stage(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    nh_ex *f = nh_arena_alloc(r->arena, (2 + x->words.positions + x->words.atoms + x->words.potentials) * sizeof *f);
    size_t m = 0;
    f[m++] = nh_int(r->model->dag, 1);
    f[m++] = r->system->t;
    for (size_t i = 0; i < x->words.positions; i++) f[m++] = x->words.position[i];
    for (size_t i = 0; i < x->words.atoms; i++) f[m++] = x->words.atom[i];
    for (size_t i = 0; i < x->words.potentials; i++) f[m++] = x->words.potential[i];
    if (x->factors < 2) return;
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *both = nh_arena_alloc(r->arena, sizeof *both);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = x->factors, .term = x->factor};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = m, .term = f};
    both[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    nh_stage_solver_stage(x, "currents found so far times t, positions and the system's functions", 1, both);
}

/* The energy and each momentum alone: nothing nearly dependent beside them can take their place. */
static void single_stages(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    for (size_t i = 0; i <= x->words.momenta && !nh_stage_solver_done(x); i++) {
        nh_ex *e = nh_arena_alloc(r->arena, sizeof *e);
        nh_family *all = nh_arena_alloc(r->arena, sizeof *all);
        *e = i == 0 ? r->model->E : x->words.momentum[i - 1];
        *all = (nh_family){.kind = NH_TERMS, .terms = 1, .term = e};
        if (nh_stage_solver_promising(x, 1, all)) nh_stage_solver_stage(x, i == 0 ? "energy" : "a momentum", 1, all);
        else nh_stage_solver_certify(x, *e, i == 0 ? "energy, in ball arithmetic" : "a momentum, in ball arithmetic");
    }
}

/* Each of the system's functions alone: many at once are nearly dependent on a small interval. */
static void function_stages(nh_stage_solver *x)
{
    nh_analysis *r = x->r;
    size_t n = x->words.velocities + x->words.forms;
    nh_ex *linear = nh_arena_alloc(r->arena, (n + 1) * sizeof *linear);
    memcpy(linear, x->words.velocity, x->words.velocities * sizeof *linear);
    memcpy(linear + x->words.velocities, x->words.form, x->words.forms * sizeof *linear);
    for (size_t i = 0; i < x->words.atoms && !nh_stage_solver_done(x); i++) {
        nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, sizeof *all);
        part[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = linear};
        part[1] = (nh_family){.kind = NH_TERMS, .terms = 1, .term = &x->words.atom[i]};
        all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
        if (nh_stage_solver_promising(x, 1, all))
            nh_stage_solver_stage(x, "velocities and forms times one function", 1, all);
    }
}

/* The usual integrals of many bodies, before stages that are too large for such systems. */
static void stages_of_many(nh_stage_solver *x)
{
    enum { few_coordinates = 6, turns = 1 };
    nh_stage stage;
    x->wide = true;
    for (size_t i = 0; x->r->model->m > few_coordinates && !nh_stage_solver_done(x) &&
                       nh_stage_of_many(x->r->arena, x->r->model, &x->words, i, &stage);
         i++) {
        if (i == turns) nh_linear_motion_forms(x);
        if (i != turns || !x->forms) nh_stage_solver_stage(x, stage.name, stage.families, stage.family);
    }
    x->wide = false;
}

/* Whether a limit ended the search.  Work ends it at the same place everywhere, time does not; a stage that was too
 * large is skipped and ends nothing. */
static void how_it_ended(nh_analysis *r, bool spent)
{
    for (size_t i = 0; i < r->stages; i++)
        spent |= r->stage[i].limit.option && !strcmp(r->stage[i].limit.option, "work");
    if (r->independent >= r->local_maximum) r->search = NH_SEARCH_COMPLETE;
    else r->search = spent || nh_late() ? NH_SEARCH_CUT : NH_SEARCH_EXHAUSTED;
    if (r->search != NH_SEARCH_CUT || !spent) return;
    r->partial = true;
    nh_analysis_warn(r, "the limit of %g million units of work ended the search; raise it by --option work=%g",
                     r->options.work, 10 * r->options.work);
}

bool nh_staged_search_run(nh_analysis *r, nh_error *error)
{
    enum { counted_from = 1, pencils_after = 2, isometries_after = 4, time_after = 13 };
    nh_stage_solver x;
    if (!nh_stage_solver_begin(&x, r, error)) return false;
    nh_budget_begin(r->options.work);
    r->counted = nh_count_memory_create();
    x.words = nh_dictionary_of(r->model);
    nh_stage stage;
    nh_integrals_find(&x);
    single_stages(&x);
    for (size_t i = 0; !nh_stage_solver_done(&x) && nh_stage_at(r->arena, r->model, &x.words, i, &stage); i++) {
        x.counted.on = i >= counted_from;
        nh_stage_solver_stage(&x, stage.name, stage.families, stage.family);
        if (i + 1 == pencils_after) stages_of_many(&x);
        if (i + 1 == pencils_after && !nh_stage_solver_done(&x)) nh_linear_motion_search(&x);
        if (i + 1 == pencils_after && !nh_stage_solver_done(&x)) nh_rates_search(&x);
        if (i + 1 == isometries_after && !nh_stage_solver_done(&x)) nh_isometries_search(&x);
        if (i + 1 == isometries_after) function_stages(&x);
        if (i + 1 == isometries_after && !nh_stage_solver_done(&x)) known_stage(&x);
        if (i + 1 == isometries_after && !nh_stage_solver_done(&x)) nh_quadratures_complete(&x);
        if (i + 1 == isometries_after && !nh_stage_solver_done(&x)) nh_series_stages(&x);
        if (i + 1 == time_after) nh_stage_solver_series_in_time(&x);
    }
    if (!nh_stage_solver_done(&x)) nh_stage_solver_series_in_each(&x);
    nh_quadratures_search(&x);
    bool spent = nh_budget_spent();
    nh_budget_begin(INFINITY);
    nh_currents_finish(x.bench);
    how_it_ended(r, spent);
    nh_stage_solver_end(&x);
    return true;
}
