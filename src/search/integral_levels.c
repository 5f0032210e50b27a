#include "search/searches.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/measure.h"
#include "search/other_system.h"

enum { most_levels = 4 };

typedef struct {
    nh_stage_solver *solver;
    const nh_model *o;
    nh_dag *d;
    size_t count;
    nh_ex integral[most_levels], symbol[most_levels]; /* P in the coordinates' velocities, and c */
    double value[most_levels];
} levels;

/* Is it linear in the velocities, perhaps with a part without them, and does it contain one? */
static bool is_linear(const nh_model *model, nh_ex phi)
{
    bool moves = false;
    for (size_t i = 0; i < model->n; i++) {
        nh_ex slope = nh_simplify_short(model->dag, nh_diff(model->dag, phi, model->chart->w[i]), 0);
        for (size_t j = 0; j < model->n; j++)
            if (nh_depends(model->dag, slope, model->chart->w[j])) return false;
        moves |= !nh_is_zero(model->dag, slope);
    }
    return moves;
}

/* Of the size that it has in the domain, in few digits: they go into exact computations. */
static double value_of(const levels *x, nh_ex e)
{
    enum { least_points = 8 };
    const nh_points *points = x->solver->ranges;
    double *value = nh_alloc_array(points->count + 1, sizeof *value), sum = 0;
    size_t finite = 0;
    char text[40];
    nh_points_evaluate(points, x->o, 1, &e, value);
    for (size_t p = 0; p < points->count; p++) {
        if (!isfinite(value[p])) continue;
        finite++;
        sum += value[p] * value[p];
    }
    nh_free(value);
    if (finite < least_points) return 0;
    snprintf(text, sizeof text, "%.1e", sqrt(sum / (double)finite));
    return nh_model_sign(x->o, e) < 0 ? -strtod(text, NULL) : strtod(text, NULL);
}

/* The linear integrals that hold for all values of the parameters; one velocity at least stays free. */
static void gather(levels *x)
{
    enum { longest = 60 };
    const nh_analysis *result = x->solver->r;
    for (size_t k = 0; k < result->list->count && x->count < most_levels && x->count + 1 < x->o->n; k++) {
        const nh_current *f = &result->list->found[k];
        bool usable = !f->series && f->proof.all_parameters && f->has_in_velocities &&
                      f->independence == NH_INDEPENDENT && !nh_depends(x->d, f->phi, x->o->system->t);
        if (!usable || nh_complexity(x->d, f->in_velocities) > longest || !is_linear(x->o, f->phi)) continue;
        /* J w as w: J h' itself would be a constant, as its symbol is none of a chart of quasi-velocities */
        nh_ex free = nh_model_without_constants(x->o, f->phi), over = nh_div(x->d, free, f->phi);
        double value = value_of(x, free);
        if (!isnormal(value)) continue;
        x->integral[x->count] = nh_simplify_short(x->d, nh_mul(x->d, over, f->in_velocities), 0);
        x->value[x->count] = value;
        x->symbol[x->count++] = nh_symbol_fresh(x->d, "level");
    }
}

static nh_system *system_on(const levels *x, nh_arena *arena, const nh_system *system)
{
    nh_system *s = nh_other_system_copy(arena, system, x->count, x->count);
    for (size_t i = 0; i < x->count; i++) {
        nh_other_system_parameter(s, "level", x->symbol[i], x->value[i]);
        s->constraint[s->constraints++] =
            (nh_constraint){.text = "a level", .lhs = x->integral[i], .rhs = x->symbol[i]};
    }
    /* velocities of the file would be too many */
    s->dependents = s->quasi = 0;
    return s;
}

static void take(const levels *x, const nh_current *f)
{
    if (f->series || !f->proof.all_parameters || !f->has_in_velocities || nh_stage_solver_done(x->solver)) return;
    nh_ex e = nh_substitute(x->d, f->in_velocities, x->count, x->symbol, x->integral);
    e = nh_simplify_short(x->d, nh_model_compose(x->o, e), 0);
    nh_stage_solver_certify(x->solver, e, "the levels of linear integrals");
}

void nh_integral_levels_search(nh_stage_solver *solver)
{
    static const double part = 0.04; /* of the work: what is short is found with much less */
    nh_analysis *result = solver->r;
    nh_model *model = result->question->model;
    levels x = {.solver = solver, .o = model, .d = model->dag};
    nh_error ignored;
    nh_error_clear(&ignored);
    if (result->question->derived || model->chart->implicit || nh_late()) return;
    gather(&x);
    if (!x.count) return;
    nh_progress("the levels of linear integrals", -1);
    nh_analysis *on =
        nh_other_system_open(result, system_on(&x, result->arena, result->question->system), NH_CHART_AUTO);
    if (!on) return;
    nh_budget_begin(part * result->question->options.work);
    nh_stage_solver y;
    if (nh_stage_solver_begin(&y, on, &ignored)) {
        y.words = nh_dictionary_of(on->question->model);
        nh_linear_motion_search(&y);
        if (!nh_stage_solver_done(&y)) nh_linear_motion_functions(&y);
        for (size_t k = 0; k < on->list->count; k++) take(&x, &on->list->found[k]);
        nh_stage_solver_end(&y);
    }
    nh_budget_begin(INFINITY);
    nh_other_system_close(on);
}
