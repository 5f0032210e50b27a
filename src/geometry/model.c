/* model: the geometry in the order of docs/method.md, sec. 2.  A formula is made in the graph and simplified at once.
 *
 *     slopes_of        dL/dq, dL/dv of the Lagrangian as it is written, in (t, q, v)
 *     momenta          Lbar, p_s, E, R^s_i, pbar_i: composed with the chart, in (t, q, w)             (1), (2), (10)
 *     mass_matrix      M_ij; refused where it is singular (model_regular.c)                           (5)
 *     inertial_forces  of chains of bodies only: dL/dq - X_0(p) by recursion instead of derivatives
 *     matrices         A_i and G_ij                                                                   (5)
 *     accelerations    a = M^-1 A by LU in the graph;  multipliers: c_s, mu_a, the reaction           (6), (7) */
#include "geometry/model.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/progress.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "geometry/model_internal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "system/embedding.h"

static nh_ex *take(nh_model *model, size_t count) { return nh_arena_alloc(model->arena, (count + 1) * sizeof(nh_ex)); }

enum { large_length = 3000 }; /* nh_complexity of a Lagrangian */

/* After the budget is spent longer formulas are better than none; after an interruption nothing is kept: see
 * nh_model_create. */
static nh_ex simple(const nh_model *model, nh_ex e)
{
    return nh_budget_spent() || nh_interrupted() ? e : nh_simplify_short(model->dag, e, nh_simplify_longest(model->n));
}

/* ---- derivatives along fields ---- */

nh_ex nh_model_X0(const nh_model *model, nh_ex e)
{
    nh_ex result = nh_diff(model->dag, e, model->system->t);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex d = nh_diff(model->dag, e, model->system->coordinate[s].q);
        if (!nh_is_zero(model->dag, d)) result = nh_add(model->dag, result, nh_mul(model->dag, model->rho[s], d));
    }
    return result;
}

nh_ex nh_model_X(const nh_model *model, size_t i, nh_ex e)
{
    nh_ex result = nh_int(model->dag, 0);
    for (size_t s = 0; s < model->m; s++) {
        if (nh_is_zero(model->dag, model->R[s * model->n + i])) continue;
        nh_ex d = nh_diff(model->dag, e, model->system->coordinate[s].q);
        if (!nh_is_zero(model->dag, d))
            result = nh_add(model->dag, result, nh_mul(model->dag, model->R[s * model->n + i], d));
    }
    return result;
}

nh_ex nh_model_Y(const nh_model *model, size_t i, nh_ex e) { return nh_diff(model->dag, e, model->chart->w[i]); }

nh_ex nh_model_gamma(const nh_model *model, nh_ex e)
{
    nh_ex result = nh_model_X0(model, e);
    for (size_t i = 0; i < model->n; i++) {
        nh_ex d = nh_model_Y(model, i, e);
        if (!nh_is_zero(model->dag, d)) result = nh_add(model->dag, result, nh_mul(model->dag, model->a[i], d));
    }
    return result;
}

bool nh_model_is_constant(const nh_model *model, nh_ex e)
{
    for (size_t j = 0; j < model->width; j++)
        if (nh_depends(model->dag, e, model->chart->symbol[j])) return false;
    return true;
}

nh_ex nh_model_without_constants(const nh_model *model, nh_ex e)
{
    nh_dag *d = model->dag;
    if (nh_kind_of(d, e) != NH_PRODUCT) return e;
    nh_ex rest = nh_int(d, 1);
    for (size_t f = 0; f < nh_arity(d, e); f++) {
        nh_ex factor = nh_pow(d, nh_child(d, e, f), nh_exponent_of(d, e, f));
        if (!nh_model_is_constant(model, factor)) rest = nh_mul(d, rest, factor);
    }
    return rest;
}

nh_ex nh_model_along(const nh_model *model, const nh_field *f, nh_ex e)
{
    nh_dag *d = model->dag;
    nh_ex result = nh_mul(d, f->time, nh_diff(d, e, model->system->t));
    for (size_t s = 0; s < model->m; s++)
        if (!nh_is_zero(d, f->space[s]))
            result = nh_add(d, result, nh_mul(d, f->space[s], nh_diff(d, e, model->system->coordinate[s].q)));
    for (size_t i = 0; i < model->n; i++)
        if (!nh_is_zero(d, f->velocity[i]))
            result = nh_add(d, result, nh_mul(d, f->velocity[i], nh_model_Y(model, i, e)));
    return result;
}

nh_ex nh_model_omega(const nh_model *model, const nh_field *a, const nh_field *b)
{
    nh_dag *d = model->dag;
    nh_ex result = nh_sub(d, nh_mul(d, nh_model_along(model, b, model->E), a->time),
                          nh_mul(d, nh_model_along(model, a, model->E), b->time));
    for (size_t s = 0; s < model->m; s++) {
        result = nh_add(d, result, nh_mul(d, nh_model_along(model, a, model->p[s]), b->space[s]));
        result = nh_sub(d, result, nh_mul(d, nh_model_along(model, b, model->p[s]), a->space[s]));
    }
    return result;
}

nh_ex nh_model_compose(const nh_model *model, nh_ex e) { return nh_chart_compose(model->chart, e); }

nh_tape *nh_model_tape(const nh_model *model, size_t count, const nh_ex *out)
{
    return nh_tape_create(model->dag, model->width, model->chart->symbol, count, out, model->system->parameters,
                          model->parameter, model->parameter_value);
}

nh_ex nh_model_values(const nh_model *model, nh_ex e) { return nh_system_values(model->system, model->dag, e); }

double nh_model_number(const nh_model *model, nh_ex e)
{
    double value;
    nh_tape_constants(model->dag, 1, &e, model->system->parameters, model->parameter, model->parameter_value, &value);
    return value;
}

/* ---- construction ---- */

/* Differentiates a large Lagrangian, such as that of a chain of bodies, with respect to all symbols at once, and along
 * X_0 by one more accumulation (tau). */
typedef struct {
    bool large;
    nh_ex *dq, *dv;  /* m: dL/dq^s, dL/dv^s */
    nh_ex *inertial; /* m: dL/dq^s - X_0(p_s) for bodies and joints; otherwise NULL */
    nh_ex tau;
} slopes;

static bool is_large(const nh_model *model)
{
    return !model->chart->implicit && !nh_complexity_within(model->dag, nh_frame_lagrangian(model), large_length);
}

const nh_chain *nh_model_chain(const nh_model *model, nh_ex *rest)
{
    const nh_chain *c = model->system->chain;
    if (!c || !is_large(model)) return NULL;
    *rest = nh_sub(model->dag, model->system->lagrangian, nh_sub(model->dag, c->kinetic, c->potential));
    return c;
}

/* Not composed.  A short L is differentiated along the frame, a long one by one sweep over its graph (nh_gradient). */
static slopes slopes_of(const nh_model *model)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    slopes s = {.large = is_large(model)};
    nh_ex *symbol = nh_arena_alloc(model->arena, (4 * model->m + 1) * sizeof *symbol);
    s.dq = symbol + 2 * model->m;
    s.dv = s.dq + model->m;
    for (size_t i = 0; i < model->m; i++)
        symbol[i] = system->coordinate[i].q, symbol[model->m + i] = system->coordinate[i].v;
    if (s.large) nh_gradient(d, system->lagrangian, 2 * model->m, symbol, s.dq);
    nh_ex L = nh_frame_lagrangian(model);
    for (size_t i = 0; i < model->m && !s.large; i++)
        s.dq[i] = nh_diff(d, L, symbol[i]), s.dv[i] = nh_diff(d, L, nh_frame_rate(model, i));
    if (!s.large) return s;
    s.tau = nh_symbol_fresh(d, "tau");
    nh_diff_rule(d, system->t, s.tau, nh_int(d, 1));
    for (size_t i = 0; i < model->m; i++) nh_diff_rule(d, system->coordinate[i].q, s.tau, model->rho[i]);
    return s;
}

/* dL/dq^s - X_0(p_s) for a chain of bodies, by recursion: -(c_s + K_sr X_0(rho^r)), and the same for the terms that the
 * file adds to its Lagrangian. */
static void inertial_forces(nh_model *model, slopes *slope)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    nh_ex rest;
    const nh_chain *c = nh_model_chain(model, &rest);
    if (!c) return;
    nh_ex *q = take(model, 3 * model->m), *v = q + model->m, *bias = v + model->m;
    for (size_t s = 0; s < model->m; s++) q[s] = system->coordinate[s].q, v[s] = system->coordinate[s].v;
    nh_chain_bias(c, &(nh_chain_scope){.dag = d, .arena = model->arena, .t = system->t, .m = model->m, .q = q, .v = v},
                  bias);
    slope->inertial = take(model, model->m);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex e = nh_neg(d, nh_model_compose(model, bias[s]));
        for (size_t r = 0; r < model->m; r++) {
            nh_ex a = nh_model_X0(model, model->rho[r]);
            if (!nh_is_zero(d, a)) e = nh_sub(d, e, nh_mul(d, c->K[s * model->m + r], a));
        }
        e = nh_add(d, e, nh_model_compose(model, nh_diff(d, rest, q[s])));
        slope->inertial[s] = nh_sub(d, e, nh_model_X0(model, nh_model_compose(model, nh_diff(d, rest, v[s]))));
    }
}

static void momenta(nh_model *model, const slopes *slope)
{
    nh_dag *d = model->dag;
    model->Lbar = simple(model, nh_frame_compose(model, nh_frame_lagrangian(model)));
    model->E = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++) {
        model->frame_p[s] = simple(model, nh_frame_compose(model, slope->dv[s]));
        model->E = nh_add(d, model->E, nh_mul(d, model->frame_p[s], model->frame_rho[s]));
        for (size_t i = 0; i < model->n; i++) {
            model->R[s * model->n + i] = nh_model_Y(model, i, model->rho[s]);
            if (model->framed) model->frame_R[s * model->n + i] = nh_model_Y(model, i, model->frame_rho[s]);
        }
    }
    if (model->framed) nh_frame_covector(model, model->frame_p, model->p);
    model->E = simple(model, nh_sub(d, model->E, model->Lbar));
    for (size_t i = 0; i < model->n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t s = 0; s < model->m; s++)
            sum = nh_add(d, sum, nh_mul(d, model->frame_p[s], model->frame_R[s * model->n + i]));
        model->pbar[i] = simple(model, sum);
    }
}

/* dL/dq^s + Q_s along the frame, composed. */
static nh_ex applied_force(const nh_model *model, const slopes *slope, size_t s)
{
    if (!model->framed) return nh_model_compose(model, nh_add(model->dag, slope->dq[s], model->system->force[s]));
    nh_ex force = nh_model_compose(model, simple(model, nh_frame_along(model, s, model->system->force)));
    return nh_add(model->dag, nh_frame_compose(model, nh_frame_along(model, s, slope->dq)), force);
}

/* X_0(p_s) */
static nh_ex rate_of_momentum(const nh_model *model, const slopes *slope, size_t s)
{
    return slope->large ? nh_diff(model->dag, model->p[s], slope->tau) : nh_model_X0(model, model->frame_p[s]);
}

/* M_ij = Y_i(p_s) R^s_j, not simplified. */
static void mass_matrix(nh_model *model)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            nh_ex M = nh_int(d, 0);
            for (size_t s = 0; s < model->m; s++)
                M = nh_add(d, M, nh_mul(d, nh_model_Y(model, i, model->frame_p[s]), model->frame_R[s * n + j]));
            model->M[i * n + j] = model->M[j * n + i] = M;
        }
}

/* All X_i(p_s), computed once. */
static nh_ex along(const nh_model *model, nh_ex *known, size_t i, size_t s)
{
    nh_ex *e = &known[i * model->m + s];
    return *e ? *e : (*e = nh_model_X(model, i, model->frame_p[s]));
}

/* A_i */
static nh_ex force_along(const nh_model *model, const slopes *slope, size_t i)
{
    nh_dag *d = model->dag;
    nh_ex A = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++) {
        nh_ex R = model->frame_R[s * model->n + i];
        if (nh_is_zero(d, R)) continue;
        nh_ex force = slope->inertial ? nh_add(d, slope->inertial[s], nh_model_compose(model, model->system->force[s]))
                                      : nh_sub(d, applied_force(model, slope, s), rate_of_momentum(model, slope, s));
        A = nh_add(d, A, nh_mul(d, R, force));
    }
    A = nh_add(d, A, nh_frame_turn(model, model->frame_R + i, model->n, model->frame_rho, 1));
    return simple(model, A);
}

/* G_ij, not simplified; X has room for all X_i(p_s). */
static nh_ex gyroscopic(const nh_model *model, nh_ex *X, size_t i, size_t j)
{
    nh_dag *d = model->dag;
    nh_ex G = nh_int(d, 0);
    for (size_t s = 0; s < model->m; s++) {
        G = nh_add(d, G, nh_mul(d, along(model, X, i, s), model->frame_R[s * model->n + j]));
        G = nh_sub(d, G, nh_mul(d, along(model, X, j, s), model->frame_R[s * model->n + i]));
    }
    return nh_add(d, G, nh_frame_turn(model, model->frame_R + i, model->n, model->frame_R + j, model->n));
}

static void matrices(nh_model *model, const slopes *slope)
{
    nh_dag *d = model->dag;
    size_t n = model->n;
    nh_ex *X = take(model, n * model->m);
    memset(X, 0, n * model->m * sizeof *X);
    for (size_t i = 0; i < n && !nh_interrupted(); i++) {
        model->A[i] = force_along(model, slope, i);
        for (size_t j = 0; j < n && !nh_interrupted(); j++) {
            nh_ex G = j > i && model->G ? gyroscopic(model, X, i, j) : 0;
            model->M[i * n + j] = j < i ? model->M[j * n + i] : simple(model, model->M[i * n + j]);
            if (j > i && model->G)
                model->G[i * n + j] = simple(model, G), model->G[j * n + i] = nh_neg(d, model->G[i * n + j]);
        }
        if (model->G) model->G[i * n + i] = nh_int(d, 0);
    }
}

const nh_ex *nh_model_G(const nh_model *model)
{
    nh_model *o = (nh_model *)model;
    size_t n = o->n;
    if (o->G) return o->G;
    nh_ex *X = take(o, n * o->m);
    memset(X, 0, n * o->m * sizeof *X);
    o->G = take(o, n * n);
    for (size_t i = 0; i < n; i++) o->G[i * n + i] = nh_int(o->dag, 0);
    for (size_t i = 0; i < n; i++)
        for (size_t j = i + 1; j < n; j++) {
            o->G[i * n + j] = nh_interrupted() ? nh_int(o->dag, 0) : simple(o, gyroscopic(o, X, i, j));
            o->G[j * n + i] = nh_neg(o->dag, o->G[i * n + j]);
        }
    return o->G;
}

static bool accelerations(nh_model *model, nh_error *error)
{
    model->M_lu = nh_lu_create(model->dag, model->n, model->M, nh_chart_pivot_score, model->chart, NULL);
    if (!model->M_lu) return nh_model_singular(model, error);
    nh_lu_solve(model->M_lu, model->A, model->a);
    for (size_t i = 0; i < model->n; i++) model->a[i] = simple(model, model->a[i]);
    return true;
}

/* dL/dq^s + Q_s - Gamma(p_s) along the frame, of bodies and joints without the derivatives of p_s by position. */
static nh_ex unbalanced(const nh_model *model, const slopes *slope, size_t s)
{
    nh_dag *d = model->dag;
    if (!slope->inertial) {
        nh_ex c = nh_sub(d, applied_force(model, slope, s), nh_model_gamma(model, model->frame_p[s]));
        return nh_add(d, c, nh_frame_turn_along(model, s));
    }
    nh_ex c = nh_add(d, slope->inertial[s], nh_model_compose(model, model->system->force[s]));
    for (size_t i = 0; i < model->n; i++) c = nh_sub(d, c, nh_mul(d, model->a[i], nh_model_Y(model, i, model->p[s])));
    return c;
}

/* The reaction and df/dv in coordinates, from those along the frame. */
static void reaction_and_slopes(nh_model *model, const nh_ex *c, const nh_ex *nu)
{
    nh_frame_covector(model, c, model->reaction);
    for (size_t s = 0; s < model->m; s++) model->reaction[s] = nh_neg(model->dag, model->reaction[s]);
    for (size_t a = 0; a < model->k; a++) nh_frame_covector(model, nu + a * model->m, model->nu + a * model->m);
    for (size_t s = 0; s < model->k * model->m; s++) model->nu[s] = simple(model, model->nu[s]);
}

/* Solves c_s = mu_a df^a/dv^s for the multipliers mu_a, by its normal equations. */
static bool multipliers(nh_model *model, const slopes *slope, nh_error *error)
{
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    size_t k = model->k, m = model->m;
    nh_ex *c = take(model, m), *nu = model->framed ? take(model, k * m) : model->nu;
    for (size_t s = 0; s < m; s++) model->reaction[s] = nh_int(d, 0);
    if (k == 0) return true;
    for (size_t s = 0; s < m; s++) {
        c[s] = unbalanced(model, slope, s);
        if (m <= 12) c[s] = simple(model, c[s]);
        model->reaction[s] = nh_neg(d, c[s]);
        for (size_t a = 0; a < k; a++) nu[a * m + s] = simple(model, nh_frame_slope(model, a, s));
    }
    if (model->framed) reaction_and_slopes(model, c, nu);
    /* normal equations (nu nu^T) mu = nu c: regular wherever the constraints are independent, in every chart */
    nh_ex *N = take(model, k * k), *b = take(model, k);
    for (size_t a = 0; a < k; a++) {
        b[a] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) b[a] = nh_add(d, b[a], nh_mul(d, nu[a * m + s], c[s]));
        for (size_t e = 0; e < k; e++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t s = 0; s < m; s++) sum = nh_add(d, sum, nh_mul(d, nu[a * m + s], nu[e * m + s]));
            N[a * k + e] = simple(model, sum);
        }
    }
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, model->chart, NULL);
    if (!lu)
        return nh_fail(error, NH_NUMERIC, "", "the constraints of %s become dependent on the sampling domain",
                       system->name);
    nh_lu_solve(lu, b, model->mu);
    for (size_t a = 0; a < k; a++) model->mu[a] = simple(model, model->mu[a]);
    nh_lu_free(lu);
    return true;
}

nh_model *nh_model_bare(nh_system *system, nh_chart *chart)
{
    if (!chart) return NULL;
    nh_arena *arena = nh_arena_create();
    nh_model *model = nh_arena_alloc(arena, sizeof *model);
    *model = (nh_model){.system = system,
                        .chart = chart,
                        .dag = system->dag,
                        .arena = arena,
                        .m = system->coordinates,
                        .n = chart->n,
                        .k = system->constraints,
                        .rho = chart->rho,
                        .width = chart->width};
    nh_system_bindings(system, &model->parameter, &model->parameter_value);
    return model;
}

/* On invariant levels of a system the constraints need no force. */
static bool levels_kept(const nh_model *model, nh_error *error)
{
    enum { terms = 20000 };
    size_t levels = model->system->levels;
    for (size_t i = 0; i < levels; i++) {
        nh_zero_verdict verdict = nh_normal_is_zero(model->dag, model->mu[model->k - levels + i], terms);
        if (verdict != NH_ZERO) return nh_system_refuse_level(model->system, i, verdict == NH_NONZERO, error);
    }
    return true;
}

nh_model *nh_model_create(nh_system *system, nh_chart *chart, nh_error *error)
{
    nh_model *model = nh_model_bare(system, chart);
    if (!model) return NULL;
    size_t m = model->m, n = model->n, k = model->k;
    model->R = take(model, m * n);
    model->p = take(model, m);
    model->pbar = take(model, n);
    model->M = take(model, n * n);
    model->A = take(model, n);
    model->a = take(model, n);
    model->mu = take(model, k);
    model->nu = take(model, k * m);
    model->reaction = take(model, m);
    nh_frame_open(model);
    if (is_large(model)) model->chart->framed = NULL, nh_frame_open(model);
    slopes slope = slopes_of(model);
    if (!slope.large) model->G = take(model, n * n);
    momenta(model, &slope);
    mass_matrix(model);
    if (!nh_model_regular(model, error)) {
        nh_model_free(model);
        return NULL;
    }
    inertial_forces(model, &slope);
    matrices(model, &slope);
    bool good = !nh_interrupted() && accelerations(model, error) && multipliers(model, &slope, error) &&
                levels_kept(model, error);
    if (nh_interrupted()) {
        nh_error_clear(error);
        good = nh_fail_ended(error, "while the equations of motion were derived");
    }
    if (good) nh_model_pair_roots(model);
    if (good) return model;
    nh_model_free(model);
    return NULL;
}

void nh_model_free(nh_model *model)
{
    if (!model) return;
    nh_lu_free(model->M_lu);
    nh_chart_free(model->chart);
    nh_arena_free(model->arena);
}

nh_model *nh_model_copy(const nh_model *model, nh_dag *dag)
{
    nh_arena *arena = nh_arena_create();
    nh_model *o = nh_arena_alloc(arena, sizeof *o);
    nh_system *system = nh_arena_alloc(arena, sizeof *system);
    nh_chart *chart = nh_arena_alloc(arena, sizeof *chart);
    *system = *model->system;
    system->dag = dag;
    system->arena = arena;
    *chart = *model->chart;
    chart->system = system;
    chart->arena = arena;
    *o = *model;
    o->arena = arena;
    o->system = system;
    o->chart = chart;
    o->dag = dag;
    o->M_lu = model->M_lu ? nh_lu_copy(model->M_lu, dag) : NULL;
    return o;
}

void nh_model_copy_free(nh_model *copy)
{
    if (!copy) return;
    nh_lu_free(copy->M_lu);
    nh_arena_free(copy->arena);
}

int nh_model_sign(const nh_model *model, nh_ex e)
{
    const nh_chart *c = model->chart;
    nh_tape *tape = nh_model_tape(model, 1, &e);
    nh_tape_work *work = nh_tape_work_create(tape);
    size_t above = 0, below = 0;
    for (size_t p = 0; p < c->probes; p++) {
        double value;
        nh_tape_eval(tape, work, c->probe + p * c->width, &value);
        above += value > 0;
        below += value < 0;
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return above == c->probes ? 1 : below == c->probes ? -1 : 0;
}
