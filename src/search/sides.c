/* sides: the search once more for the equations without kinks. [docs/method.md, sec. 4, "The sides of a kink"]
 *
 *     |u| -> s u,  sign(u) -> s      s a new parameter of a copy of the system
 *     search, count                  of the copy: what is constant for all s
 *     s -> sign(u)                   where a root has s: the sign at the sampling box */
#include "search/sides.h"

#include <math.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "geometry/distribution.h"
#include "graph/dag.h"
#include "graph/function.h"
#include "graph/node.h"
#include "search/missing.h"

enum { most_sides = 4, nested = 4 };

typedef struct {
    const nh_model *o;
    nh_dag *d;
    size_t count;
    nh_ex u[most_sides], symbol[most_sides];
    int sign[most_sides]; /* where the model is sampled; 1 where it has both */
    bool good;            /* there was room for all */
} sides;

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

/* The symbol for sign(u). */
static nh_ex side_of(sides *x, nh_ex u)
{
    for (size_t k = 0; k < x->count; k++)
        if (x->u[k] == u) return x->symbol[k];
    if (x->count == most_sides) {
        x->good = false;
        return nh_int(x->d, 1);
    }
    x->u[x->count] = u;
    x->sign[x->count] = nh_model_sign(x->o, u) < 0 ? -1 : 1;
    return x->symbol[x->count++] = nh_symbol_fresh(x->d, "side");
}

/* e with symbols for the signs, the outer ones first: their arguments are kept as they stand in the system. */
static nh_ex with_symbols(sides *x, nh_ex e)
{
    enum { most = 64 };
    nh_dag *d = x->d;
    NH_LIST(call);
    nh_ex by[most];
    for (size_t level = 0; level < nested; level++) {
        size_t n = nh_functions_in(d, e, &call), pieces = 0;
        if (n > most) x->good = false;
        for (size_t i = 0; i < n && i < most; i++) {
            nh_function f = nh_function_of(d, call[i]);
            nh_ex u = f == NH_ABS || f == NH_SIGN ? nh_child(d, call[i], 0) : 0;
            if (!u || !depends_on_state(x->o, u)) continue;
            call[pieces] = call[i];
            by[pieces++] = nh_mul(d, side_of(x, u), f == NH_ABS ? u : nh_int(d, 1));
        }
        if (!pieces) break;
        e = nh_substitute(d, e, pieces, call, by);
    }
    return e;
}

/* The system with symbols for the signs, which are parameters of it; it shares everything else. */
static nh_system *without_kinks(sides *x, nh_arena *arena, const nh_system *system)
{
    nh_system *s = nh_other_system_copy(arena, system, most_sides, 0);
    s->lagrangian = with_symbols(x, system->lagrangian);
    s->force = nh_arena_alloc(arena, (s->coordinates + 1) * sizeof *s->force);
    for (size_t i = 0; i < s->coordinates; i++) s->force[i] = with_symbols(x, system->force[i]);
    for (size_t i = 0; i < s->constraints; i++) {
        nh_constraint *c = &s->constraint[i];
        c->lhs = with_symbols(x, c->lhs);
        c->rhs = with_symbols(x, c->rhs);
        if (c->position) c->level = with_symbols(x, c->level);
    }
    for (size_t k = 0; k < x->count; k++) nh_other_system_parameter(s, "side", x->symbol[k], x->sign[k]);
    return s;
}

/* e with the signs in their places; a root of one is real on one side only, and e is given for that on which the model
 * is sampled. */
static nh_ex with_signs(const sides *x, nh_ex e)
{
    enum { most = 64 };
    nh_dag *d = x->d;
    NH_LIST(base);
    for (size_t j = x->count; j-- > 0;) {
        nh_ex sign = nh_call(d, NH_SIGN, x->u[j]);
        size_t n = nh_radicands_in(d, e, &base);
        for (size_t i = 0; i < n; i++)
            if (nh_depends(d, base[i], x->symbol[j])) sign = nh_int(d, x->sign[j]);
        e = nh_substitute(d, e, 1, &x->symbol[j], &sign);
    }
    return nh_simplify_short(d, e, 0);
}

/* One of the system without kinks, with the signs in their places, as a current of the system. */
static void take(nh_stage_solver *solver, const sides *x, const nh_current *f)
{
    if (f->series || !f->proof.proved || nh_stage_solver_done(solver)) return;
    nh_stage_solver_certify(solver, with_signs(x, f->phi), "the equations on one side of a kink");
}

/* First those that are polynomials, and functions of the others there: the others may have a root of a sign. */
static void take_all(nh_stage_solver *solver, const sides *x, const nh_analysis *found)
{
    for (size_t k = 0; k < found->furthers; k++) take(solver, x, &found->further[k].current);
    for (size_t k = 0; k < found->count; k++) take(solver, x, &found->found[k]);
}

void nh_sides_search(nh_stage_solver *solver, nh_whole_search *search)
{
    nh_analysis *result = solver->r;
    sides x = {.o = result->model, .d = result->model->dag, .good = true};
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_system *system = without_kinks(&x, result->arena, result->system);
    if (!x.count || !x.good || nh_late()) return;
    nh_progress("the equations on one side of a kink", -1);
    nh_chart_choice choice = result->model->chart->quasi ? NH_CHART_AUTO : NH_CHART_COORDINATES;
    nh_analysis *side = nh_other_system_open(result, system, choice);
    if (!side) return;
    bool same = side->model->n == result->model->n;
    for (size_t i = 0; i < result->model->n && same; i++) same = side->model->chart->w[i] == result->model->chart->w[i];
    if (same && search(side, &ignored)) {
        if (!nh_late()) nh_missing_count(side, true);
        nh_budget_begin(result->options.work);
        take_all(solver, &x, side);
        nh_budget_begin(INFINITY);
        result->used |= side->used;
    }
    nh_other_system_close(side);
}
