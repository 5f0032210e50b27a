#include "search/searches.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/prove.h"
#include "search/currents.h"
#include "search/other_system.h"
#include "search/quadratures.h"

/* Of m coordinates. */
typedef struct {
    const nh_model *o;
    const nh_system *system;
    nh_dag *d;
    size_t m, turns;
    nh_ex *velocity;       /* x' */
    nh_ex *u, *map, *back; /* symbols; x' in them; they in x' */
    nh_ex *solved;         /* u in the others by a constraint, or 0 */
    bool *turned;
} frame;

static nh_ex short_form(const frame *f, nh_ex e) { return nh_simplify_short(f->d, e, 0); }

static nh_ex *copy(nh_arena *arena, size_t n, const nh_ex *from)
{
    nh_ex *out = nh_arena_alloc(arena, (n + 1) * sizeof *out);
    if (n) memcpy(out, from, n * sizeof *out);
    return out;
}

static frame frame_of(nh_arena *arena, const nh_model *model)
{
    const nh_system *system = model->system;
    frame f = {.o = model, .system = system, .d = model->dag, .m = system->coordinates};
    f.velocity = nh_arena_alloc(arena, (f.m + 1) * sizeof *f.velocity);
    f.u = nh_arena_alloc(arena, (f.m + 1) * sizeof *f.u);
    for (size_t i = 0; i < f.m; i++) {
        f.velocity[i] = system->coordinate[i].v;
        f.u[i] = nh_symbol_fresh(f.d, "u");
    }
    f.map = copy(arena, f.m, f.u);
    f.back = copy(arena, f.m, f.velocity);
    f.solved = nh_arena_alloc(arena, (f.m + 1) * sizeof *f.solved);
    f.turned = nh_arena_alloc(arena, (f.m + 1) * sizeof *f.turned);
    return f;
}

/* A constraint in the new velocities. */
static nh_ex constraint(const frame *f, size_t a)
{
    const nh_constraint *c = &f->system->constraint[a];
    return short_form(f, nh_substitute(f->d, nh_sub(f->d, c->lhs, c->rhs), f->m, f->velocity, f->map));
}

/* x' and y' in u along the angle and v across it. */
static void turn(frame *f, size_t x, size_t y, nh_ex angle)
{
    nh_dag *d = f->d;
    nh_ex c = nh_call(d, NH_COS, angle), s = nh_call(d, NH_SIN, angle);
    f->map[x] = nh_sub(d, nh_mul(d, c, f->u[x]), nh_mul(d, s, f->u[y]));
    f->map[y] = nh_add(d, nh_mul(d, s, f->u[x]), nh_mul(d, c, f->u[y]));
    f->back[x] = nh_add(d, nh_mul(d, c, f->velocity[x]), nh_mul(d, s, f->velocity[y]));
    f->back[y] = nh_sub(d, nh_mul(d, c, f->velocity[y]), nh_mul(d, s, f->velocity[x]));
    f->turned[x] = f->turned[y] = true;
}

static void turn_back(frame *f, size_t x, size_t y)
{
    f->map[x] = f->u[x];
    f->map[y] = f->u[y];
    f->back[x] = f->velocity[x];
    f->back[y] = f->velocity[y];
    f->turned[x] = f->turned[y] = false;
}

/* How many constraints contain the angle in a sine or cosine. */
static size_t with_angle(const frame *f, nh_ex angle)
{
    nh_ex sine = nh_call(f->d, NH_SIN, angle), cosine = nh_call(f->d, NH_COS, angle);
    size_t n = 0;
    for (size_t a = 0; a < f->system->constraints; a++) {
        nh_ex e = constraint(f, a);
        n += nh_depends(f->d, e, sine) || nh_depends(f->d, e, cosine);
    }
    return n;
}

/* Does a sine or cosine of the angle multiply x' in a constraint? */
static bool is_turned(const frame *f, size_t x, nh_ex angle)
{
    nh_ex sine = nh_call(f->d, NH_SIN, angle), cosine = nh_call(f->d, NH_COS, angle);
    bool found = false;
    for (size_t a = 0; a < f->system->constraints && !found; a++) {
        const nh_constraint *c = &f->system->constraint[a];
        nh_ex by = nh_diff(f->d, nh_sub(f->d, c->lhs, c->rhs), f->velocity[x]);
        found = nh_depends(f->d, by, sine) || nh_depends(f->d, by, cosine);
    }
    return found;
}

/* Turns the first two velocities for which fewer constraints contain the angle. */
static bool turn_pair(frame *f, nh_ex angle)
{
    size_t before = with_angle(f, angle);
    for (size_t x = 0; x < f->m && before; x++)
        for (size_t y = 0; y < f->m && !f->turned[x] && is_turned(f, x, angle); y++) {
            if (x == y || f->turned[y] || !is_turned(f, y, angle)) continue;
            turn(f, x, y, angle);
            if (with_angle(f, angle) < before) return true;
            turn_back(f, x, y);
        }
    return false;
}

static void turn_all(frame *f)
{
    NH_LIST(call);
    for (size_t a = 0; a < f->system->constraints; a++) {
        const nh_constraint *c = &f->system->constraint[a];
        size_t n = nh_functions_in(f->d, nh_sub(f->d, c->lhs, c->rhs), &call);
        for (size_t i = 0; i < n; i++) {
            nh_function name = nh_function_of(f->d, call[i]);
            if (name == NH_SIN || name == NH_COS) f->turns += turn_pair(f, nh_child(f->d, call[i], 0));
        }
    }
}

static bool is_constant(const frame *f, nh_ex e)
{
    bool good = !nh_depends(f->d, e, f->system->t);
    for (size_t i = 0; i < f->m && good; i++)
        good = !nh_depends(f->d, e, f->system->coordinate[i].q) && !nh_depends(f->d, e, f->u[i]);
    return good;
}

/* Solves e = 0 for one of the velocities in which it is linear with a constant coefficient, for one that was turned if
 * possible: the last of these, across the heading. */
static bool solve_for_one(frame *f, nh_ex e)
{
    nh_dag *d = f->d;
    for (int turned = 1; turned >= 0; turned--)
        for (size_t i = f->m; i-- > 0;) {
            nh_ex k = f->turned[i] == turned && !f->solved[i] ? short_form(f, nh_diff(d, e, f->u[i])) : nh_int(d, 0);
            if (nh_is_zero(d, k) || !is_constant(f, k)) continue;
            nh_ex value = short_form(f, nh_sub(d, f->u[i], nh_div(d, e, k)));
            for (size_t j = 0; j < f->m; j++)
                if (f->solved[j]) f->solved[j] = short_form(f, nh_substitute(d, f->solved[j], 1, &f->u[i], &value));
            f->solved[i] = value;
            return true;
        }
    return false;
}

static nh_ex with_solved(const frame *f, nh_ex e)
{
    for (size_t i = 0; i < f->m; i++)
        if (f->solved[i]) e = nh_substitute(f->d, e, 1, &f->u[i], &f->solved[i]);
    return short_form(f, e);
}

/* The system with the remaining velocities as quasi-velocities; NULL: the constraints give no constant coefficients. */
static nh_system *system_in(frame *f, nh_arena *arena)
{
    nh_system *system = nh_other_system_copy(arena, f->system, 0, 0);
    for (size_t a = 0; a < system->constraints; a++) {
        nh_ex e = with_solved(f, constraint(f, a));
        if (!nh_is_zero(f->d, e) && !solve_for_one(f, e)) return NULL;
    }
    system->quasi_velocity = nh_arena_alloc(arena, (f->m + 1) * sizeof *system->quasi_velocity);
    system->quasi_map = nh_arena_alloc(arena, (f->m + 1) * sizeof *system->quasi_map);
    for (size_t i = 0; i < f->m; i++) {
        system->quasi_map[i] = with_solved(f, f->map[i]);
        if (!f->solved[i]) system->quasi_velocity[system->quasi++] = f->u[i];
    }
    system->dependents = 0;
    return system;
}

/* The proved currents of one analysis as currents of the other, where they are proved in its velocities, too: long
 * formulas may not be.  `value`: what velocities of the first are in the second. */
static void hand_over(nh_stage_solver *to, const nh_analysis *from, size_t n, const nh_ex *velocity, const nh_ex *value)
{
    const nh_current_list *list = from->list;
    const nh_model *model = to->r->question->model;
    for (size_t k = 0; k < list->count && !nh_stage_solver_done(to); k++) {
        if (list->found[k].series || !list->found[k].proof.proved) continue;
        nh_ex e = nh_model_compose(model, nh_substitute(model->dag, list->found[k].phi, n, velocity, value));
        e = nh_simplify_short(model->dag, e, 0);
        if (nh_currents_known(to->bench, e, true)) continue;
        if (!nh_prove_claim(model, e, (nh_claim){.free = true}, &to->r->question->options).proved) continue;
        nh_stage_solver_certify(to, e, "integration in velocities along and across headings");
    }
}

void nh_frames_search(nh_stage_solver *solver)
{
    enum { many = 8 };               /* constraints of systems whose equations are too long to be integrated */
    static const double part = 0.04; /* of the work: what is short is found with much less */
    nh_analysis *result = solver->r;
    nh_stage_solver x;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!result->question->system->constraints || result->question->system->constraints > many ||
        result->question->system->quasi || result->question->model->chart->implicit || nh_late())
        return;
    frame f = frame_of(result->arena, result->question->model);
    turn_all(&f);
    nh_system *system = f.turns ? system_in(&f, result->arena) : NULL;
    if (!system) return;
    nh_progress("integration in velocities along and across headings", -1);
    nh_analysis *other = nh_other_system_open(result, system, NH_CHART_AUTO);
    if (!other) return;
    nh_budget_begin(part * result->question->options.work);
    if (other->question->model->chart->quasi && nh_stage_solver_begin(&x, other, &ignored)) {
        hand_over(&x, result, f.m, f.velocity, system->quasi_map);
        nh_slopes_search(&x);
        nh_quadratures_search(&x);
        hand_over(solver, other, f.m, f.u, f.back);
        nh_stage_solver_end(&x);
    }
    nh_budget_begin(INFINITY);
    nh_other_system_close(other);
}
