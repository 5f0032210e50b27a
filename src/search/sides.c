/* sides: the search once more for the equations without kinks. [docs/method.md, sec. 4, "The sides of a kink"]
 *
 *     |u| -> s u,  sign(u) -> s      s a new parameter of a copy of the system
 *     search, count                  of the copy: what is constant for all s
 *     s -> sign(u)                   where a root has s: the sign at the sampling box */
#include "search/searches.h"

#include <math.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "exact/walls.h"
#include "geometry/distribution.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "search/missing.h"

enum { most_sides = 4 };

typedef struct {
    const nh_model *o;
    nh_dag *d;
    nh_wall_sides sides;
} kinks;

static bool depends_on_state(const nh_model *model, nh_ex u)
{
    bool found = nh_depends(model->dag, u, model->system->t);
    for (size_t s = 0; s < model->system->coordinates && !found; s++)
        found = nh_depends(model->dag, u, model->system->coordinate[s].q) ||
                nh_depends(model->dag, u, model->system->coordinate[s].v);
    for (size_t i = 0; i < model->system->quasi && !found; i++)
        found = nh_depends(model->dag, u, model->system->quasi_velocity[i]);
    return found;
}

static nh_ex side_of_state(void *kinks_, nh_ex u)
{
    kinks *x = kinks_;
    return depends_on_state(x->o, u) ? nh_walls_side(&x->sides, u) : 0;
}

/* e with symbols for the signs, the outer ones first: their arguments are kept as they stand in the system. */
static nh_ex with_symbols(kinks *x, nh_ex e) { return nh_walls_piece(x->d, e, side_of_state, x); }

/* The sign where the model is sampled; 1 where it has both. */
static int sign_of(const kinks *x, size_t k)
{
    return nh_model_sign(x->o, nh_child(x->d, x->sides.sign[k], 0)) < 0 ? -1 : 1;
}

/* The system with symbols for the signs, which are parameters of it; it shares everything else. */
static nh_system *without_kinks(kinks *x, nh_arena *arena, const nh_system *system)
{
    nh_system *s = nh_other_system_copy(arena, system, NH_MOST_SIDES, 0);
    s->lagrangian = with_symbols(x, system->lagrangian);
    s->force = nh_arena_alloc(arena, (s->coordinates + 1) * sizeof *s->force);
    for (size_t i = 0; i < s->coordinates; i++) s->force[i] = with_symbols(x, system->force[i]);
    for (size_t i = 0; i < s->constraints; i++) {
        nh_constraint *c = &s->constraint[i];
        c->lhs = with_symbols(x, c->lhs);
        c->rhs = with_symbols(x, c->rhs);
        if (c->position) c->level = with_symbols(x, c->level);
    }
    for (size_t k = 0; k < x->sides.count; k++) nh_other_system_parameter(s, "side", x->sides.symbol[k], sign_of(x, k));
    return s;
}

/* e with the signs in their places; a root of one is real on one side only, and e is given for that on which the model
 * is sampled. */
static nh_ex with_signs(const kinks *x, nh_ex e)
{
    nh_dag *d = x->d;
    NH_LIST(base);
    for (size_t j = x->sides.count; j-- > 0;) {
        nh_ex sign = x->sides.sign[j], side = x->sides.symbol[j];
        size_t n = nh_radicands_in(d, e, &base);
        for (size_t i = 0; i < n; i++)
            if (nh_depends(d, base[i], side)) sign = nh_int(d, sign_of(x, j));
        e = nh_substitute(d, e, 1, &side, &sign);
    }
    return nh_simplify_short(d, e, 0);
}

/* One of the system without kinks, with the signs in their places, as a current of the system. */
static void take(nh_stage_solver *solver, const kinks *x, const nh_current *f)
{
    if (f->series || !f->proof.proved || nh_stage_solver_done(solver)) return;
    nh_stage_solver_certify(solver, with_signs(x, f->phi), "the equations on one side of a kink");
}

/* First those that are polynomials, and functions of the others there: the others may have a root of a sign. */
static void take_all(nh_stage_solver *solver, const kinks *x, const nh_analysis *found)
{
    for (size_t k = 0; k < found->list->furthers; k++) take(solver, x, &found->list->further[k].current);
    for (size_t k = 0; k < found->list->count; k++) take(solver, x, &found->list->found[k]);
}

void nh_sides_search(nh_stage_solver *solver, nh_whole_search *search)
{
    nh_analysis *result = solver->r;
    kinks x = {
        .o = result->question->model, .d = result->question->model->dag, .sides.dag = result->question->model->dag};
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_system *system = without_kinks(&x, result->arena, result->question->system);
    if (!x.sides.count || x.sides.count > most_sides || x.sides.left_out || nh_late()) return;
    nh_progress("the equations on one side of a kink", -1);
    nh_chart_choice choice = result->question->model->chart->quasi ? NH_CHART_AUTO : NH_CHART_COORDINATES;
    nh_analysis *side = nh_other_system_open(result, system, choice);
    if (!side) return;
    bool same = side->question->model->n == result->question->model->n;
    for (size_t i = 0; i < result->question->model->n && same; i++)
        same = side->question->model->chart->w[i] == result->question->model->chart->w[i];
    if (same && search(side, &ignored)) {
        if (!nh_late()) nh_missing_count(side, true);
        nh_budget_begin(result->question->options.work);
        take_all(solver, &x, side);
        nh_budget_begin(INFINITY);
        result->used |= side->used;
    }
    nh_other_system_close(side);
}
