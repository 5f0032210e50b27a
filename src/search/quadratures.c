/* quadratures: motions along every state as parameter, and their constants as currents.
 *
 *     nh_quadratures_complete    before the large stages: without roots, where one current or a linear one is missing
 *     nh_quadratures_search      1. parameters as symbols   2. some with their values   3. combined coordinates
 *
 * The best motion is reported: most states known, then fewest integrals J, then fewest roots. */
#include "search/quadratures_internal.h"

#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "graph/measure.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/real_where.h"
#include "search/currents.h"
#include "search/explicit_motion.h"

/* Is the parameter replaced, or does a replaced one depend on it? */
static bool is_needed(const nh_model *model, const nh_ex *fixed, size_t parameter)
{
    for (size_t i = 0; i < model->system->parameters; i++)
        if (nh_fixed_has(model, fixed, i) &&
            (i == parameter || nh_depends(model->dag, fixed[i], model->parameter[parameter])))
            return true;
    return false;
}

/* The parameters that keep their values, where some must: those in functions and exponents of the equations of motion
 * and of the currents, and those that a current needs.  NULL: none. */
static const nh_ex *special_values(const nh_analysis *result)
{
    const nh_model *model = result->question->model;
    NH_LIST(call);
    size_t n = model->system->parameters;
    bool *fixed = nh_alloc_array(n + 1, sizeof *fixed), any = false;
    for (size_t j = 0; j < model->m + model->n + result->list->count; j++) {
        const nh_current *f = j < model->m + model->n ? NULL : &result->list->found[j - model->m - model->n];
        nh_ex e = f ? f->phi : j < model->m ? model->rho[j] : model->a[j - model->m];
        size_t calls = nh_functions_in(model->dag, e, &call);
        for (size_t p = 0; p < n; p++) {
            if (f && !f->proof.all_parameters) fixed[p] |= !f->proof.fixed || is_needed(model, f->proof.fixed, p);
            for (size_t i = 0; i < calls; i++) fixed[p] |= nh_depends(model->dag, call[i], model->parameter[p]);
            any |= fixed[p];
        }
    }
    const nh_ex *list = any ? nh_fixed_those(model, fixed) : NULL;
    nh_free(fixed);
    return list;
}

/* The currents in closed form; `general`: that hold for all values of the parameters. */
static size_t gather(const nh_stage_solver *solver, bool general, nh_ex **current)
{
    const nh_analysis *r = solver->r;
    size_t n = 0;
    nh_ex *list = *current =
        nh_arena_alloc(r->arena, (r->list->count + r->question->model->m + r->question->model->n + 1) * sizeof *list);
    for (size_t k = 0; k < r->list->count; k++)
        if (!r->list->found[k].series && (r->list->found[k].proof.all_parameters || !general))
            list[n++] = r->list->found[k].phi;
    return nh_quadratures_with_parts(r, solver->ranges, n, list);
}

/* Is it better?  More states are; then no integrals without closed form; then no roots; then time as the parameter;
 * then fewer parameters with values. */
static bool better(const nh_explicit_motion *a, const nh_explicit_motion *b)
{
    if (!b || a->known != b->known) return !b || a->known > b->known;
    if (a->integrals != b->integrals) return a->integrals < b->integrals;
    if (a->roots != b->roots) return a->roots < b->roots;
    if (!a->fixed != !b->fixed) return !a->fixed;
    return false;
}

/* ---- the constants of integration as currents ---- */

typedef struct {
    nh_ex e;
    bool fixed, timed;
    size_t length;
} constant;

/* Sorts currents for all values of the parameters before those for some; those without t, of which more is counted,
 * before those with t; short before long. */
static int by_generality(const void *left, const void *right)
{
    const constant *a = left, *b = right;
    if (a->fixed != b->fixed) return a->fixed ? 1 : -1;
    if (a->timed != b->timed) return a->timed ? 1 : -1;
    if (a->length != b->length) return a->length < b->length ? -1 : 1;
    return a->e < b->e ? -1 : a->e > b->e;
}

/* Constants of integration of all motions that were tried, general and short ones first. */
static void harvest(nh_stage_solver *solver, size_t count, const nh_explicit_motion *const *tried)
{
    const nh_model *model = solver->r->question->model;
    size_t n = 0, most = 1;
    for (size_t k = 0; k < count; k++) most += tried[k]->constants;
    constant *list = nh_alloc_array(most, sizeof *list);
    for (size_t k = 0; k < count; k++)
        for (size_t j = 0; j < tried[k]->constants; j++) {
            if (!tried[k]->constant[j].integrated || tried[k]->constant[j].at_start) continue;
            nh_ex e = nh_quadratures_form(solver->r, tried[k]->constant[j].value, !tried[k]->fixed);
            list[n++] = (constant){.e = e,
                                   .fixed = tried[k]->fixed != NULL,
                                   .timed = nh_depends(model->dag, e, model->system->t),
                                   .length = nh_complexity(model->dag, e)};
        }
    qsort(list, n, sizeof *list, by_generality);
    for (size_t j = 0; j < n && !nh_stage_solver_done(solver); j++)
        nh_stage_solver_certify(solver, list[j].e, "integration of one equation after another");
    nh_free(list);
}

/* ---- the whole ---- */

/* With every state as the parameter; the best one, or the one that was best before. */
static const nh_explicit_motion *try_all(nh_stage_solver *solver, nh_explicit_request request,
                                         const nh_explicit_motion *best, size_t *count,
                                         const nh_explicit_motion **tried)
{
    const nh_model *model = solver->r->question->model;
    size_t states = 1 + model->m + model->n;
    for (size_t i = 0; i < states && !nh_budget_spent(); i++) {
        request.rival = best && best->known == states ? best : NULL;
        const nh_explicit_motion *m = nh_explicit_motion_along(solver->r->arena, model, &request, i);
        if (!m && request.combined && i == 0) return best;
        if (!m) continue;
        tried[(*count)++] = m;
        if (better(m, best)) best = m;
        /* no other parameter can give a simpler motion */
        if (i == 0 && m->known == states && !m->roots && !m->integrals) break;
    }
    return best;
}

static const char *joined(nh_arena *arena, const char *all, const char *one)
{
    if (!one || (all && strstr(all, one))) return all;
    return all ? nh_arena_printf(arena, "%s, %s", all, one) : one;
}

/* The region in which its constants do not jump, and are real, which may hold for bound motions only; NULL:
 * everywhere. */
static const char *region_of(nh_stage_solver *solver, const nh_explicit_motion *m)
{
    const nh_model *model = solver->r->question->model;
    nh_arena *arena = solver->r->arena;
    const char *all = NULL;
    for (size_t j = 0; j < m->constants; j++) {
        nh_ex positive[NH_MOST_REAL_WHERE], value = m->constant[j].value;
        size_t n = nh_real_where(model, value, positive);
        all =
            joined(arena, all, nh_currents_region(solver->bench, value, solver->r->question->options.digits / 2, NULL));
        for (size_t i = 0; i < n; i++) {
            char *text = nh_model_is_constant(model, positive[i]) ? NULL : nh_print_string(model->dag, positive[i]);
            if (text) all = joined(arena, all, nh_arena_printf(arena, "where %s > 0", text));
            nh_free(text);
        }
    }
    return all;
}

void nh_quadratures_complete(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    size_t states = 1 + model->m + model->n;
    if (model->chart->implicit) return;
    nh_ex *current;
    size_t n = gather(solver, true, &current);
    nh_explicit_forms forms = {0};
    nh_explicit_request request = {.points = solver->ranges,
                                   .currents = n,
                                   .current = current,
                                   .linear = true,
                                   .options = &result->question->options,
                                   .forms = &forms};
    bool open = !nh_counted_covers(&solver->counted, 1, false);
    for (size_t i = 0; i < states && !nh_budget_spent(); i++) {
        const nh_explicit_motion *m = nh_explicit_motion_along(result->arena, model, &request, i);
        if (!m || (m->known < states && !open)) continue;
        harvest(solver, 1, &m);
        if (m->known == states) break;
    }
    nh_explicit_forms_clear(&forms);
}

void nh_quadratures_search(nh_stage_solver *solver)
{
    nh_analysis *result = solver->r;
    const nh_model *model = result->question->model;
    size_t states = 1 + model->m + model->n, count = 0;
    if (model->chart->implicit || nh_budget_spent()) return;
    nh_progress("integration of one equation after another", nh_budget_part());
    nh_ex *current, *special;
    nh_explicit_forms forms = {0};
    nh_explicit_request request = {.points = solver->ranges, .options = &result->question->options, .forms = &forms},
                        valued = request;
    request.currents = gather(solver, true, &current);
    request.current = current;
    valued.currents = gather(solver, false, &special);
    valued.current = special;
    valued.fixed = special_values(result);
    const nh_explicit_motion **tried = nh_arena_alloc(result->arena, 2 * states * sizeof *tried),
                             *best = try_all(solver, request, NULL, &count, tried);
    if (valued.fixed && !(best && best->known == states && !best->integrals))
        best = try_all(solver, valued, best, &count, tried);
    harvest(solver, count, tried);
    /* the formulas of motions in combined coordinates are not shown: their constants are currents */
    request.combined = valued.combined = true;
    count = 0;
    if (!nh_stage_solver_done(solver)) try_all(solver, request, NULL, &count, tried);
    if (!nh_stage_solver_done(solver) && valued.fixed) try_all(solver, valued, NULL, &count, tried);
    harvest(solver, count, tried);
    nh_explicit_forms_clear(&forms);
    if (!best || best->known <= 1) return;
    nh_explicit_motion *m = nh_arena_alloc(result->arena, sizeof *m);
    *m = *best;
    m->region = region_of(solver, m);
    result->motion = m;
}
