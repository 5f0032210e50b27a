/* A stage of the search, for two velocities along one coordinate s, without a potential: the roller racer, carts that
 * are hinged together.
 *
 *     Q = M_ij w^i w^j/2 constant, M = M(s):
 *     u = (M_11 w^1 + M_12 w^2, D w^2)/sqrt(M_11),   D^2 = det M,   2 Q = |u|^2
 *
 * |u| is constant, so u turns; where the angle depends on s alone, so that d(angle)/ds = f(s), the two linear currents
 * are
 *
 *     u^1 cos F + u^2 sin F,   u^2 cos F - u^1 sin F,   F = int f ds
 *
 * The coefficients of linear currents solve a linear equation of second order in s; Q reduces it to this integral. */
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "exact/square.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "integrals/exact_points.h"
#include "search/stage_solver.h"

typedef struct {
    nh_stage_solver *x;
    const nh_model *o;
    nh_dag *d;
    nh_ex M[3];                     /* M_11, M_12, M_22 */
    nh_ex w[2], a[2], s, rate_of_s; /* velocities, their rates; the coordinate */
} problem;

static nh_ex short_form(const problem *p, nh_ex e) { return nh_simplify_short(p->d, e, 0); }

/* M of a current that is homogeneous of degree two in the velocities, with the one coordinate on which it depends. */
static bool quadratic(problem *p, nh_ex Q)
{
    nh_dag *d = p->d;
    const nh_system *system = p->o->system;
    nh_ex half = nh_ratio(d, 1, 2), w0 = p->w[0], w1 = p->w[1];
    size_t positions = 0;
    p->M[0] = short_form(p, nh_diff(d, nh_diff(d, Q, w0), w0));
    p->M[1] = short_form(p, nh_diff(d, nh_diff(d, Q, w0), w1));
    p->M[2] = short_form(p, nh_diff(d, nh_diff(d, Q, w1), w1));
    nh_ex form[] = {nh_product(d, 4, (nh_ex[]){half, p->M[0], w0, w0}), nh_product(d, 3, (nh_ex[]){p->M[1], w0, w1}),
                    nh_product(d, 4, (nh_ex[]){half, p->M[2], w1, w1})};
    for (size_t i = 0; i < 3; i++) {
        if (nh_depends(d, p->M[i], w0) || nh_depends(d, p->M[i], w1) || nh_depends(d, p->M[i], system->t)) return false;
        Q = nh_sub(d, Q, form[i]);
    }
    for (size_t s = 0; s < p->o->m; s++) {
        nh_ex q = system->coordinate[s].q;
        if (!nh_depends(d, p->M[0], q) && !nh_depends(d, p->M[1], q) && !nh_depends(d, p->M[2], q)) continue;
        p->s = q;
        p->rate_of_s = p->o->rho[s];
        positions++;
    }
    return positions == 1 && nh_is_zero(d, short_form(p, Q));
}

/* The square root of e = N/D as sqrt(N D)/D, as far as that shows squares. */
static nh_ex root_of(const problem *p, nh_ex e)
{
    nh_dag *d = p->d;
    nh_ex outside, inside;
    return nh_square_split_quotient(d, e, &outside, &inside) ? nh_mul(d, outside, nh_sqrt(d, inside)) : nh_sqrt(d, e);
}

static bool of_s_alone(const problem *p, nh_ex f)
{
    const nh_system *system = p->o->system;
    for (size_t s = 0; s < p->o->m; s++)
        if (system->coordinate[s].q != p->s && nh_depends(p->d, f, system->coordinate[s].q)) return false;
    return !nh_depends(p->d, f, system->t);
}

/* d(angle)/ds of (N, D w^2), N = M_11 w^1 + M_12 w^2:
 *
 *     D (N dw^2/dt + D'/D ds/dt N w^2 - w^2 dN/dt)/(M_11 M_ij w^i w^j ds/dt)
 *
 * at one w; whether it is the same at all shows the proof of the currents.  False where it depends on more than s. */
static bool speed_of_turn(const problem *p, nh_ex N, nh_ex D, nh_ex *f)
{
    nh_dag *d = p->d;
    const nh_model *model = p->o;
    static const int at[][2] = {{0, 1}, {1, 0}, {1, 1}};
    nh_ex square = nh_powi(d, D, 2), value[2], ds = nh_int(d, 0);
    for (size_t i = 0; i < sizeof at / sizeof *at && nh_is_zero(d, ds); i++) {
        for (size_t j = 0; j < 2; j++) value[j] = nh_int(d, at[i][j]);
        ds = short_form(p, nh_substitute(d, p->rate_of_s, 2, p->w, value));
    }
    if (nh_is_zero(d, ds)) return false;
    nh_ex slope = nh_div(d, nh_diff(d, square, p->s), nh_mul(d, nh_int(d, 2), square));
    nh_ex rate = nh_product(d, 4, (nh_ex[]){slope, p->rate_of_s, N, p->w[1]});
    rate = nh_add(d, rate, nh_sub(d, nh_mul(d, N, p->a[1]), nh_mul(d, p->w[1], nh_model_gamma(model, N))));
    nh_ex twice = nh_add(d, nh_mul(d, N, N), nh_product(d, 3, (nh_ex[]){square, p->w[1], p->w[1]}));
    rate = short_form(p, nh_substitute(d, rate, 2, p->w, value));
    twice = short_form(p, nh_substitute(d, twice, 2, p->w, value));
    *f = short_form(p, nh_div(d, nh_mul(d, D, rate), nh_mul(d, twice, ds)));
    return of_s_alone(p, *f);
}

/* How many of the two are currents that hold everywhere. */
static size_t certified(const problem *p, const nh_ex e[2])
{
    size_t found = 0;
    for (size_t i = 0; i < 2 && !nh_stage_solver_done(p->x); i++)
        found += nh_stage_solver_certify(p->x, e[i], "a turn of two velocities along one coordinate");
    return found;
}

/* Where d(ds/dt)/dt = h(s) (ds/dt)^2 with ds/dt = l_i w^i, the angle needs no integral: with g = exp(-int h ds),
 * e = (-l_2, l_1) and n_j = e^i M_ij the two are
 *
 *     C = g ds/dt,   K = g n_j w^j/D */
typedef struct {
    nh_ex v, D, C, K;       /* v = ds/dt */
    nh_ex e[2], unit[2], n; /* velocities: v(e) = 0, v(unit) = 1; n_j w^j */
} apart;

static nh_ex at(const problem *p, nh_ex form, const nh_ex w[2])
{
    return short_form(p, nh_substitute(p->d, form, 2, p->w, w));
}

/* int f ds; false where f is no function of s alone, or has none. */
static bool integral(const problem *p, bool general, nh_ex f, nh_ex *F)
{
    return of_s_alone(p, f) && nh_stage_solver_integral(p->x, p->s, general ? f : nh_model_values(p->o, f), true, F);
}

/* dx/dt = alpha ds/dt + beta n_j w^j:   x C - C int alpha ds - K int beta D ds */
static void position(const problem *p, const apart *y, bool general, size_t x)
{
    nh_dag *d = p->d;
    nh_ex rate = p->o->rho[x], A, B, beta = short_form(p, nh_div(d, at(p, rate, y->e), at(p, y->n, y->e)));
    nh_ex alpha = nh_sub(d, at(p, rate, y->unit), nh_mul(d, beta, at(p, y->n, y->unit)));
    if (!integral(p, general, short_form(p, alpha), &A) || !integral(p, general, nh_mul(d, beta, y->D), &B)) return;
    nh_ex first = nh_mul(d, nh_sub(d, p->o->system->coordinate[x].q, A), y->C);
    nh_stage_solver_certify(p->x, nh_sub(d, first, nh_mul(d, B, y->K)), "a position along two velocities");
}

static bool alone(const problem *p, nh_ex D, bool general)
{
    nh_dag *d = p->d;
    const nh_system *system = p->o->system;
    nh_ex zero = nh_int(d, 0), v = p->rate_of_s, F;
    nh_ex h = short_form(p, nh_div(d, nh_model_gamma(p->o, v), nh_mul(d, v, v)));
    if (!of_s_alone(p, h) || nh_depends(d, h, p->w[0]) || nh_depends(d, h, p->w[1])) return false;
    if (!nh_stage_solver_integral(p->x, p->s, general ? h : nh_model_values(p->o, h), false, &F)) return false;
    nh_ex g = nh_antiderivative_factor(d, F), l[] = {nh_diff(d, v, p->w[0]), nh_diff(d, v, p->w[1])};
    apart y = {.v = v, .D = D, .C = nh_mul(d, g, v), .e = {nh_neg(d, l[1]), l[0]}, .unit = {zero, zero}, .n = zero};
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < 2; j++) y.n = nh_add(d, y.n, nh_product(d, 3, (nh_ex[]){y.e[i], p->M[i + j], p->w[j]}));
    y.K = short_form(p, nh_div(d, nh_mul(d, g, y.n), D));
    size_t first = nh_is_zero(d, l[0]);
    y.unit[first] = nh_div(d, nh_int(d, 1), l[first]);
    if (!certified(p, (nh_ex[]){y.C, y.K})) return false;
    for (size_t x = 0; x < p->o->m && !nh_stage_solver_done(p->x); x++)
        if (system->coordinate[x].q != p->s) position(p, &y, general, x);
    nh_ex T;
    if (!nh_stage_solver_done(p->x) && integral(p, general, g, &T))
        nh_stage_solver_certify(p->x, nh_sub(d, nh_mul(d, system->t, y.C), T), "time along two velocities");
    return true;
}

/* Whether that gives a current that holds everywhere.  `general`: for all values of the parameters. */
static bool turn(const problem *p, bool general)
{
    nh_dag *d = p->d;
    nh_ex N = nh_add(d, nh_mul(d, p->M[0], p->w[0]), nh_mul(d, p->M[1], p->w[1])), f, F;
    nh_ex determinant = short_form(p, nh_sub(d, nh_mul(d, p->M[0], p->M[2]), nh_powi(d, p->M[1], 2)));
    if (nh_model_sign(p->o, determinant) <= 0) return false;
    nh_ex D = root_of(p, determinant), side = nh_int(d, nh_model_sign(p->o, p->M[0]));
    if (alone(p, D, general)) return true;
    if (!speed_of_turn(p, N, D, &f)) return false;
    if (!nh_stage_solver_integral(p->x, p->s, general ? f : nh_model_values(p->o, f), true, &F)) return false;
    nh_ex scale = nh_powi(d, root_of(p, nh_mul(d, side, p->M[0])), -1), cosine = nh_call(d, NH_COS, F),
          sine = nh_call(d, NH_SIN, F);
    nh_ex u[] = {nh_mul(d, scale, N), nh_product(d, 3, (nh_ex[]){scale, D, p->w[1]})};
    nh_ex e[] = {nh_add(d, nh_mul(d, u[0], cosine), nh_mul(d, u[1], sine)),
                 nh_sub(d, nh_mul(d, u[1], cosine), nh_mul(d, u[0], sine))};
    return certified(p, e) > 0;
}

/* The integral, and where the root of M_11 jumps, depend on which velocity is the first. */
void nh_velocity_turn_search(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    const nh_ex *w = model->chart->w, *a = model->a;
    if (model->n != 2 || model->chart->implicit) return;
    for (size_t k = 0; k < solver->r->list->count && !nh_stage_solver_done(solver); k++) {
        nh_ex Q = solver->r->list->found[k].phi;
        problem p = {.x = solver, .o = model, .d = model->dag, .w = {w[0], w[1]}, .a = {a[0], a[1]}};
        problem q = {.x = solver, .o = model, .d = model->dag, .w = {w[1], w[0]}, .a = {a[1], a[0]}};
        if (solver->r->list->found[k].series || !quadratic(&p, Q) || !quadratic(&q, Q)) continue;
        if (!turn(&p, true) && !turn(&q, true) && !turn(&p, false)) turn(&q, false);
        return;
    }
}
