/* slopes: for each pair of velocities whose accelerations contain no other state.
 *
 *     with_slope    v = p u in F and G; roots of squares of u become side u times a root of p
 *     bernoulli     Q = R/u = F/(G - p F) = A + B u^m: m = 1 + u Q''/Q' by u, then B and A
 *     current_of    mu u^(-m) + m int mu B dp, mu = exp(m int A dp); with B = 0, u exp(-int A dp)
 *     in_states     p = v/u and the roots as they stand in the accelerations */
#include "search/searches.h"

#include <string.h>

#include "base/budget.h"
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "exact/walls.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/measure.h"
#include "graph/node.h"

enum { most_roots = 4 };

typedef struct {
    nh_stage_solver *x;
    nh_model *o;
    nh_dag *d;
    nh_ex u, v, p, side; /* side: the sign of u */
    size_t roots;
    nh_ex inside[most_roots], root[most_roots]; /* sqrt(inside(p)) = root, in the roots of the accelerations */
} plane;

/* In the states of the model. */
static nh_ex in_states(const plane *y, nh_ex e)
{
    for (size_t k = 0; k < y->roots; k++) e = nh_substitute_root(y->d, e, y->inside[k], y->root[k]);
    nh_ex from[] = {y->p, y->side}, to[] = {nh_div(y->d, y->v, y->u), nh_call(y->d, NH_SIGN, y->u)};
    return nh_substitute(y->d, e, 2, from, to);
}

static nh_ex side_of_u(void *plane_, nh_ex e)
{
    const plane *y = plane_;
    return e == y->u ? y->side : 0;
}

static int sign_of(void *plane_, nh_ex e)
{
    const plane *y = plane_;
    return nh_model_sign(y->o, in_states(y, e));
}

/* e with v = p u, and roots of squares of u as such: sqrt(u^2 + v^2) = side u sqrt(1 + p^2). */
static nh_ex with_slope(plane *y, nh_ex e)
{
    enum { most = 32 };
    nh_dag *d = y->d;
    NH_LIST(base);
    nh_ex outside, inside, pu = nh_mul(d, y->p, y->u);
    size_t n = nh_radicands_in(d, e, &base);
    for (size_t i = 0; i < n && i < most && y->roots < most_roots; i++) {
        nh_ex radicand = nh_simplify_short(d, nh_substitute(d, base[i], 1, &y->v, &pu), 0);
        bool square = nh_depends(d, radicand, y->u) && nh_square_split(d, radicand, &outside, &inside);
        if (!square || nh_depends(d, inside, y->u)) continue;
        nh_ex size = nh_call(d, NH_ABS, outside);
        e = nh_substitute_root(d, e, base[i], nh_mul(d, size, nh_sqrt(d, inside)));
        y->inside[y->roots] = inside;
        y->root[y->roots++] = nh_div(d, nh_sqrt(d, base[i]), size);
    }
    e = nh_substitute(d, e, 1, &y->v, &pu);
    return nh_simplify_short(d, nh_walls_piece(d, e, side_of_u, y), 0);
}

/* int f dp, with the parameters and the side as constants. */
static bool integral(const plane *y, nh_ex f, nh_ex *F)
{
    const nh_system *system = y->o->system;
    size_t n = system->parameters;
    nh_ex *constant = nh_alloc_array(n + 1, sizeof *constant);
    if (n) memcpy(constant, y->o->parameter, n * sizeof *constant);
    constant[n] = y->side;
    nh_integration in = {.dag = y->d,
                         .x = y->p,
                         .constants = n + 1,
                         .constant = constant,
                         .max_terms = (size_t)y->x->r->question->options.proof_terms,
                         .sign = sign_of,
                         .context = (void *)y};
    bool found = nh_antiderivative(&in, nh_simplify_short(y->d, f, 0), F);
    nh_free(constant);
    return found;
}

/* R/u = A + B u^m; m = 0: B = 0.  False: it is not of this form. */
static bool bernoulli(const plane *y, nh_ex quotient, nh_ex *A, nh_ex *B, nh_ex *m)
{
    nh_dag *d = y->d;
    nh_ex slope = nh_simplify_short(d, nh_diff(d, quotient, y->u), 0);
    *m = *B = nh_int(d, 0);
    *A = quotient;
    if (nh_is_zero(d, slope)) return true;
    nh_ex second = nh_mul(d, y->u, nh_div(d, nh_diff(d, slope, y->u), slope));
    *m = nh_simplify_short(d, nh_add(d, nh_int(d, 1), second), 0);
    if (nh_kind_of(d, *m) != NH_NUMBER || nh_is_zero(d, *m)) return false;
    nh_ex power = nh_pow(d, y->u, *m);
    *B = nh_simplify_short(d, nh_div(d, nh_mul(d, slope, y->u), nh_mul(d, *m, power)), 0);
    *A = nh_simplify_short(d, nh_sub(d, quotient, nh_mul(d, *B, power)), 0);
    return !nh_depends(d, *A, y->u) && !nh_depends(d, *B, y->u);
}

/* The current of the plane of u and v; false: it has none of this form. */
static bool current_of(const plane *y, nh_ex F, nh_ex G, nh_ex *phi)
{
    nh_dag *d = y->d;
    nh_ex turn = nh_simplify_short(d, nh_sub(d, G, nh_mul(d, y->p, F)), 0), A, B, m, a, b;
    if (nh_is_zero(d, turn)) return false; /* p is constant */
    nh_ex quotient = nh_simplify_short(d, nh_div(d, F, turn), 0);
    if (!bernoulli(y, quotient, &A, &B, &m) || !integral(y, A, &a)) return false;
    if (nh_is_zero(d, m)) {
        *phi = nh_mul(d, y->u, nh_antiderivative_factor(d, nh_neg(d, a)));
        return true;
    }
    nh_ex mu = nh_antiderivative_factor(d, nh_neg(d, nh_mul(d, m, a)));
    if (!integral(y, nh_mul(d, mu, B), &b)) return false;
    *phi = nh_add(d, nh_mul(d, mu, nh_pow(d, y->u, nh_neg(d, m))), nh_mul(d, m, b));
    return true;
}

/* Do the accelerations depend on the two velocities only? */
static bool is_closed(const nh_model *model, size_t i, size_t k)
{
    const nh_ex *symbol = model->chart->symbol;
    for (size_t j = 0; j < model->width; j++) {
        if (symbol[j] == model->chart->w[i] || symbol[j] == model->chart->w[k]) continue;
        if (nh_depends(model->dag, model->a[i], symbol[j]) || nh_depends(model->dag, model->a[k], symbol[j]))
            return false;
    }
    return true;
}

void nh_slopes_search(nh_stage_solver *solver)
{
    enum { longest = 400 };
    nh_model *model = solver->r->question->model;
    nh_dag *d = model->dag;
    if (model->chart->implicit) return;
    for (size_t i = 0; i < model->n; i++)
        for (size_t k = 0; k < model->n && !nh_stage_solver_done(solver) && !nh_budget_spent(); k++) {
            if (i == k || !is_closed(model, i, k)) continue;
            if (!nh_complexity_within(d, model->a[i], longest) || !nh_complexity_within(d, model->a[k], longest))
                continue;
            plane y = {.x = solver,
                       .o = model,
                       .d = d,
                       .u = model->chart->w[i],
                       .v = model->chart->w[k],
                       .p = nh_symbol_fresh(d, "slope"),
                       .side = nh_symbol_fresh(d, "side")};
            nh_ex phi;
            if (current_of(&y, with_slope(&y, model->a[i]), with_slope(&y, model->a[k]), &phi) &&
                nh_stage_solver_certify(solver, nh_simplify_short(d, in_states(&y, phi), 0),
                                        "two velocities by their quotient"))
                break;
        }
}
