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

static nh_ex *take(nh_model *o, size_t count) { return nh_arena_alloc(o->arena, (count + 1) * sizeof(nh_ex)); }

enum { large_length = 3000 }; /* nh_complexity of a Lagrangian */

/* After the budget is spent longer formulas are better than none; after an interruption nothing is kept: see
 * nh_model_create. */
static nh_ex simple(const nh_model *o, nh_ex e)
{
    return nh_budget_spent() || nh_interrupted() ? e : nh_simplify_short(o->dag, e, nh_simplify_longest(o->n));
}

/* ---- derivatives along fields ---- */

nh_ex nh_model_X0(const nh_model *o, nh_ex e)
{
    nh_ex result = nh_diff(o->dag, e, o->system->t);
    for (size_t s = 0; s < o->m; s++) {
        nh_ex d = nh_diff(o->dag, e, o->system->coordinate[s].q);
        if (!nh_is_zero(o->dag, d)) result = nh_add(o->dag, result, nh_mul(o->dag, o->rho[s], d));
    }
    return result;
}

nh_ex nh_model_X(const nh_model *o, size_t i, nh_ex e)
{
    nh_ex result = nh_int(o->dag, 0);
    for (size_t s = 0; s < o->m; s++) {
        if (nh_is_zero(o->dag, o->R[s * o->n + i])) continue;
        nh_ex d = nh_diff(o->dag, e, o->system->coordinate[s].q);
        if (!nh_is_zero(o->dag, d)) result = nh_add(o->dag, result, nh_mul(o->dag, o->R[s * o->n + i], d));
    }
    return result;
}

nh_ex nh_model_Y(const nh_model *o, size_t i, nh_ex e) { return nh_diff(o->dag, e, o->chart->w[i]); }

nh_ex nh_model_gamma(const nh_model *o, nh_ex e)
{
    nh_ex result = nh_model_X0(o, e);
    for (size_t i = 0; i < o->n; i++) {
        nh_ex d = nh_model_Y(o, i, e);
        if (!nh_is_zero(o->dag, d)) result = nh_add(o->dag, result, nh_mul(o->dag, o->a[i], d));
    }
    return result;
}

bool nh_model_is_constant(const nh_model *o, nh_ex e)
{
    for (size_t j = 0; j < o->width; j++)
        if (nh_depends(o->dag, e, o->chart->symbol[j])) return false;
    return true;
}

nh_ex nh_model_without_constants(const nh_model *o, nh_ex e)
{
    nh_dag *d = o->dag;
    if (nh_kind_of(d, e) != NH_PRODUCT) return e;
    nh_ex rest = nh_int(d, 1);
    for (size_t f = 0; f < nh_arity(d, e); f++) {
        nh_ex factor = nh_pow(d, nh_child(d, e, f), nh_exponent_of(d, e, f));
        if (!nh_model_is_constant(o, factor)) rest = nh_mul(d, rest, factor);
    }
    return rest;
}

nh_ex nh_model_along(const nh_model *o, const nh_field *f, nh_ex e)
{
    nh_dag *d = o->dag;
    nh_ex result = nh_mul(d, f->time, nh_diff(d, e, o->system->t));
    for (size_t s = 0; s < o->m; s++)
        if (!nh_is_zero(d, f->space[s]))
            result = nh_add(d, result, nh_mul(d, f->space[s], nh_diff(d, e, o->system->coordinate[s].q)));
    for (size_t i = 0; i < o->n; i++)
        if (!nh_is_zero(d, f->velocity[i])) result = nh_add(d, result, nh_mul(d, f->velocity[i], nh_model_Y(o, i, e)));
    return result;
}

nh_ex nh_model_omega(const nh_model *o, const nh_field *a, const nh_field *b)
{
    nh_dag *d = o->dag;
    nh_ex result =
        nh_sub(d, nh_mul(d, nh_model_along(o, b, o->E), a->time), nh_mul(d, nh_model_along(o, a, o->E), b->time));
    for (size_t s = 0; s < o->m; s++) {
        result = nh_add(d, result, nh_mul(d, nh_model_along(o, a, o->p[s]), b->space[s]));
        result = nh_sub(d, result, nh_mul(d, nh_model_along(o, b, o->p[s]), a->space[s]));
    }
    return result;
}

nh_ex nh_model_compose(const nh_model *o, nh_ex e) { return nh_chart_compose(o->chart, e); }

nh_tape *nh_model_tape(const nh_model *o, size_t count, const nh_ex *out)
{
    return nh_tape_create(o->dag, o->width, o->chart->symbol, count, out, o->system->parameters, o->parameter,
                          o->parameter_value);
}

nh_ex nh_model_values(const nh_model *o, nh_ex e) { return nh_system_values(o->system, o->dag, e); }

double nh_model_number(const nh_model *o, nh_ex e)
{
    double value;
    nh_tape_constants(o->dag, 1, &e, o->system->parameters, o->parameter, o->parameter_value, &value);
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

static bool is_large(const nh_model *o)
{
    return !o->chart->implicit && !nh_complexity_within(o->dag, nh_frame_lagrangian(o), large_length);
}

const nh_chain *nh_model_chain(const nh_model *o, nh_ex *rest)
{
    const nh_chain *c = o->system->chain;
    if (!c || !is_large(o)) return NULL;
    *rest = nh_sub(o->dag, o->system->lagrangian, nh_sub(o->dag, c->kinetic, c->potential));
    return c;
}

static slopes slopes_of(const nh_model *o)
{
    nh_dag *d = o->dag;
    const nh_system *y = o->system;
    slopes s = {.large = is_large(o)};
    nh_ex *symbol = nh_arena_alloc(o->arena, (4 * o->m + 1) * sizeof *symbol);
    s.dq = symbol + 2 * o->m;
    s.dv = s.dq + o->m;
    for (size_t i = 0; i < o->m; i++) symbol[i] = y->coordinate[i].q, symbol[o->m + i] = y->coordinate[i].v;
    if (s.large) nh_gradient(d, y->lagrangian, 2 * o->m, symbol, s.dq);
    nh_ex L = nh_frame_lagrangian(o);
    for (size_t i = 0; i < o->m && !s.large; i++)
        s.dq[i] = nh_diff(d, L, symbol[i]), s.dv[i] = nh_diff(d, L, nh_frame_rate(o, i));
    if (!s.large) return s;
    s.tau = nh_symbol_fresh(d, "tau");
    nh_diff_rule(d, y->t, s.tau, nh_int(d, 1));
    for (size_t i = 0; i < o->m; i++) nh_diff_rule(d, y->coordinate[i].q, s.tau, o->rho[i]);
    return s;
}

/* dL/dq^s - X_0(p_s) for a chain of bodies, by recursion: -(c_s + K_sr X_0(rho^r)), and the same for the terms that the
 * file adds to its Lagrangian. */
static void inertial_forces(nh_model *o, slopes *slope)
{
    nh_dag *d = o->dag;
    const nh_system *y = o->system;
    nh_ex rest;
    const nh_chain *c = nh_model_chain(o, &rest);
    if (!c) return;
    nh_ex *q = take(o, 3 * o->m), *v = q + o->m, *bias = v + o->m;
    for (size_t s = 0; s < o->m; s++) q[s] = y->coordinate[s].q, v[s] = y->coordinate[s].v;
    nh_chain_bias(c, &(nh_chain_scope){.dag = d, .arena = o->arena, .t = y->t, .m = o->m, .q = q, .v = v}, bias);
    slope->inertial = take(o, o->m);
    for (size_t s = 0; s < o->m; s++) {
        nh_ex e = nh_neg(d, nh_model_compose(o, bias[s]));
        for (size_t r = 0; r < o->m; r++) {
            nh_ex a = nh_model_X0(o, o->rho[r]);
            if (!nh_is_zero(d, a)) e = nh_sub(d, e, nh_mul(d, c->K[s * o->m + r], a));
        }
        e = nh_add(d, e, nh_model_compose(o, nh_diff(d, rest, q[s])));
        slope->inertial[s] = nh_sub(d, e, nh_model_X0(o, nh_model_compose(o, nh_diff(d, rest, v[s]))));
    }
}

static void momenta(nh_model *o, const slopes *slope)
{
    nh_dag *d = o->dag;
    o->Lbar = simple(o, nh_frame_compose(o, nh_frame_lagrangian(o)));
    o->E = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++) {
        o->frame_p[s] = simple(o, nh_frame_compose(o, slope->dv[s]));
        o->E = nh_add(d, o->E, nh_mul(d, o->frame_p[s], o->frame_rho[s]));
        for (size_t i = 0; i < o->n; i++) {
            o->R[s * o->n + i] = nh_model_Y(o, i, o->rho[s]);
            if (o->framed) o->frame_R[s * o->n + i] = nh_model_Y(o, i, o->frame_rho[s]);
        }
    }
    if (o->framed) nh_frame_covector(o, o->frame_p, o->p);
    o->E = simple(o, nh_sub(d, o->E, o->Lbar));
    for (size_t i = 0; i < o->n; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t s = 0; s < o->m; s++) sum = nh_add(d, sum, nh_mul(d, o->frame_p[s], o->frame_R[s * o->n + i]));
        o->pbar[i] = simple(o, sum);
    }
}

/* dL/dq^s + Q_s along the frame, composed. */
static nh_ex applied_force(const nh_model *o, const slopes *slope, size_t s)
{
    if (!o->framed) return nh_model_compose(o, nh_add(o->dag, slope->dq[s], o->system->force[s]));
    nh_ex force = nh_model_compose(o, simple(o, nh_frame_along(o, s, o->system->force)));
    return nh_add(o->dag, nh_frame_compose(o, nh_frame_along(o, s, slope->dq)), force);
}

/* X_0(p_s) */
static nh_ex rate_of_momentum(const nh_model *o, const slopes *slope, size_t s)
{
    return slope->large ? nh_diff(o->dag, o->p[s], slope->tau) : nh_model_X0(o, o->frame_p[s]);
}

/* M_ij = Y_i(p_s) R^s_j, not simplified. */
static void mass_matrix(nh_model *o)
{
    nh_dag *d = o->dag;
    size_t n = o->n;
    for (size_t i = 0; i < n; i++)
        for (size_t j = i; j < n; j++) {
            nh_ex M = nh_int(d, 0);
            for (size_t s = 0; s < o->m; s++)
                M = nh_add(d, M, nh_mul(d, nh_model_Y(o, i, o->frame_p[s]), o->frame_R[s * n + j]));
            o->M[i * n + j] = o->M[j * n + i] = M;
        }
}

/* All X_i(p_s), computed once. */
static nh_ex along(const nh_model *o, nh_ex *known, size_t i, size_t s)
{
    nh_ex *e = &known[i * o->m + s];
    return *e ? *e : (*e = nh_model_X(o, i, o->frame_p[s]));
}

/* A_i */
static nh_ex force_along(const nh_model *o, const slopes *slope, size_t i)
{
    nh_dag *d = o->dag;
    nh_ex A = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++) {
        nh_ex R = o->frame_R[s * o->n + i];
        if (nh_is_zero(d, R)) continue;
        nh_ex force = slope->inertial ? nh_add(d, slope->inertial[s], nh_model_compose(o, o->system->force[s]))
                                      : nh_sub(d, applied_force(o, slope, s), rate_of_momentum(o, slope, s));
        A = nh_add(d, A, nh_mul(d, R, force));
    }
    A = nh_add(d, A, nh_frame_turn(o, o->frame_R + i, o->n, o->frame_rho, 1));
    return simple(o, A);
}

/* G_ij, not simplified; X has room for all X_i(p_s). */
static nh_ex gyroscopic(const nh_model *o, nh_ex *X, size_t i, size_t j)
{
    nh_dag *d = o->dag;
    nh_ex G = nh_int(d, 0);
    for (size_t s = 0; s < o->m; s++) {
        G = nh_add(d, G, nh_mul(d, along(o, X, i, s), o->frame_R[s * o->n + j]));
        G = nh_sub(d, G, nh_mul(d, along(o, X, j, s), o->frame_R[s * o->n + i]));
    }
    return nh_add(d, G, nh_frame_turn(o, o->frame_R + i, o->n, o->frame_R + j, o->n));
}

static void matrices(nh_model *o, const slopes *slope)
{
    nh_dag *d = o->dag;
    size_t n = o->n;
    nh_ex *X = take(o, n * o->m);
    memset(X, 0, n * o->m * sizeof *X);
    for (size_t i = 0; i < n && !nh_interrupted(); i++) {
        o->A[i] = force_along(o, slope, i);
        for (size_t j = 0; j < n && !nh_interrupted(); j++) {
            nh_ex G = j > i && o->G ? gyroscopic(o, X, i, j) : 0;
            o->M[i * n + j] = j < i ? o->M[j * n + i] : simple(o, o->M[i * n + j]);
            if (j > i && o->G) o->G[i * n + j] = simple(o, G), o->G[j * n + i] = nh_neg(d, o->G[i * n + j]);
        }
        if (o->G) o->G[i * n + i] = nh_int(d, 0);
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

static bool accelerations(nh_model *o, nh_error *error)
{
    o->M_lu = nh_lu_create(o->dag, o->n, o->M, nh_chart_pivot_score, o->chart, NULL);
    if (!o->M_lu) return nh_model_singular(o, error);
    nh_lu_solve(o->M_lu, o->A, o->a);
    for (size_t i = 0; i < o->n; i++) o->a[i] = simple(o, o->a[i]);
    return true;
}

/* dL/dq^s + Q_s - Gamma(p_s) along the frame, of bodies and joints without the derivatives of p_s by position. */
static nh_ex unbalanced(const nh_model *o, const slopes *slope, size_t s)
{
    nh_dag *d = o->dag;
    if (!slope->inertial) {
        nh_ex c = nh_sub(d, applied_force(o, slope, s), nh_model_gamma(o, o->frame_p[s]));
        return nh_add(d, c, nh_frame_turn_along(o, s));
    }
    nh_ex c = nh_add(d, slope->inertial[s], nh_model_compose(o, o->system->force[s]));
    for (size_t i = 0; i < o->n; i++) c = nh_sub(d, c, nh_mul(d, o->a[i], nh_model_Y(o, i, o->p[s])));
    return c;
}

/* The reaction and df/dv in coordinates, from those along the frame. */
static void reaction_and_slopes(nh_model *o, const nh_ex *c, const nh_ex *nu)
{
    nh_frame_covector(o, c, o->reaction);
    for (size_t s = 0; s < o->m; s++) o->reaction[s] = nh_neg(o->dag, o->reaction[s]);
    for (size_t a = 0; a < o->k; a++) nh_frame_covector(o, nu + a * o->m, o->nu + a * o->m);
    for (size_t s = 0; s < o->k * o->m; s++) o->nu[s] = simple(o, o->nu[s]);
}

/* Solves c_s = mu_a df^a/dv^s for the multipliers mu_a, by its normal equations. */
static bool multipliers(nh_model *o, const slopes *slope, nh_error *error)
{
    nh_dag *d = o->dag;
    const nh_system *y = o->system;
    size_t k = o->k, m = o->m;
    nh_ex *c = take(o, m), *nu = o->framed ? take(o, k * m) : o->nu;
    for (size_t s = 0; s < m; s++) o->reaction[s] = nh_int(d, 0);
    if (k == 0) return true;
    for (size_t s = 0; s < m; s++) {
        c[s] = unbalanced(o, slope, s);
        if (m <= 12) c[s] = simple(o, c[s]);
        o->reaction[s] = nh_neg(d, c[s]);
        for (size_t a = 0; a < k; a++) nu[a * m + s] = simple(o, nh_frame_slope(o, a, s));
    }
    if (o->framed) reaction_and_slopes(o, c, nu);
    /* normal equations (nu nu^T) mu = nu c: regular wherever the constraints are independent, in every chart */
    nh_ex *N = take(o, k * k), *b = take(o, k);
    for (size_t a = 0; a < k; a++) {
        b[a] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) b[a] = nh_add(d, b[a], nh_mul(d, nu[a * m + s], c[s]));
        for (size_t e = 0; e < k; e++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t s = 0; s < m; s++) sum = nh_add(d, sum, nh_mul(d, nu[a * m + s], nu[e * m + s]));
            N[a * k + e] = simple(o, sum);
        }
    }
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, o->chart, NULL);
    if (!lu)
        return nh_fail(error, NH_NUMERIC, "", "the constraints of %s become dependent on the sampling domain", y->name);
    nh_lu_solve(lu, b, o->mu);
    for (size_t a = 0; a < k; a++) o->mu[a] = simple(o, o->mu[a]);
    nh_lu_free(lu);
    return true;
}

nh_model *nh_model_bare(nh_system *system, nh_chart *chart)
{
    if (!chart) return NULL;
    nh_arena *arena = nh_arena_create();
    nh_model *o = nh_arena_alloc(arena, sizeof *o);
    *o = (nh_model){.system = system,
                    .chart = chart,
                    .dag = system->dag,
                    .arena = arena,
                    .m = system->coordinates,
                    .n = chart->n,
                    .k = system->constraints,
                    .rho = chart->rho,
                    .width = chart->width};
    nh_system_bindings(system, &o->parameter, &o->parameter_value);
    return o;
}

/* On invariant levels of a system the constraints need no force. */
static bool levels_kept(const nh_model *o, nh_error *error)
{
    enum { terms = 20000 };
    size_t levels = o->system->levels;
    for (size_t i = 0; i < levels; i++) {
        nh_zero_verdict verdict = nh_normal_is_zero(o->dag, o->mu[o->k - levels + i], terms);
        if (verdict != NH_ZERO) return nh_system_refuse_level(o->system, i, verdict == NH_NONZERO, error);
    }
    return true;
}

nh_model *nh_model_create(nh_system *system, nh_chart *chart, nh_error *error)
{
    nh_model *o = nh_model_bare(system, chart);
    if (!o) return NULL;
    size_t m = o->m, n = o->n, k = o->k;
    o->R = take(o, m * n);
    o->p = take(o, m);
    o->pbar = take(o, n);
    o->M = take(o, n * n);
    o->A = take(o, n);
    o->a = take(o, n);
    o->mu = take(o, k);
    o->nu = take(o, k * m);
    o->reaction = take(o, m);
    nh_frame_open(o);
    if (is_large(o)) o->chart->framed = NULL, nh_frame_open(o);
    slopes slope = slopes_of(o);
    if (!slope.large) o->G = take(o, n * n);
    momenta(o, &slope);
    mass_matrix(o);
    if (!nh_model_regular(o, error)) {
        nh_model_free(o);
        return NULL;
    }
    inertial_forces(o, &slope);
    matrices(o, &slope);
    bool good = !nh_interrupted() && accelerations(o, error) && multipliers(o, &slope, error) && levels_kept(o, error);
    if (nh_interrupted()) {
        nh_error_clear(error);
        good = nh_fail_ended(error, "while the equations of motion were derived");
    }
    if (good) nh_model_pair_roots(o);
    if (good) return o;
    nh_model_free(o);
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

int nh_model_sign(const nh_model *o, nh_ex e)
{
    const nh_chart *c = o->chart;
    nh_tape *tape = nh_model_tape(o, 1, &e);
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
