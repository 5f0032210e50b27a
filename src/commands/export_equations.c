/* export_equations: equations of motion, momenta and multipliers as functions, in all coordinates and on the constraint
 * submanifold. */
#include <string.h>

#include "base/linalg.h"
#include "base/progress.h"
#include "commands/export_internal.h"
#include "exact/normal.h"
#include "geometry/bordered.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/node.h"

/* Symbols and labels of a model's states. */
typedef struct {
    nh_export *x;
    const nh_model *o;
    nh_dag *d;
    nh_arena *arena;
    size_t m, k, n;
    nh_ex *q, *v;            /* m each */
    const char **rate;       /* m: x'' */
    const char **constraint; /* k: the names c1, c2, .. */
} scope;

static scope scope_of(nh_export *x, const nh_model *model)
{
    scope s = {.x = x, .o = model, .d = model->dag, .arena = x->arena, .m = model->m, .k = model->k, .n = model->n};
    s.q = nh_arena_alloc(x->arena, (2 * s.m + 1) * sizeof *s.q);
    s.v = s.q + s.m;
    s.rate = nh_arena_alloc(x->arena, (s.m + s.k + 1) * sizeof *s.rate);
    s.constraint = s.rate + s.m;
    for (size_t i = 0; i < s.m; i++) {
        s.q[i] = model->system->coordinate[i].q;
        s.v[i] = model->system->coordinate[i].v;
        s.rate[i] = nh_arena_printf(x->arena, "%s''", model->system->coordinate[i].name);
    }
    for (size_t a = 0; a < s.k; a++) s.constraint[a] = nh_arena_printf(x->arena, "c%zu", a + 1);
    return s;
}

static nh_ex *take(const scope *s, size_t n) { return nh_arena_alloc(s->arena, (n + 1) * sizeof(nh_ex)); }

static const char **names_of(const scope *s, size_t n, const nh_ex *symbol)
{
    const char **out = nh_arena_alloc(s->arena, (n + 1) * sizeof *out);
    for (size_t i = 0; i < n; i++) out[i] = nh_name_of(s->d, symbol[i]);
    return out;
}

static void place_and_velocity(const scope *s, nh_export_function *f)
{
    nh_export_argument(s->x, f, "q", "coordinates", s->m, s->q);
    nh_export_argument(s->x, f, "v", "their velocities", s->m, s->v);
}

/* Simplified, where that is quick. */
static void simplify(const scope *s, size_t n, nh_ex *e)
{
    for (size_t i = 0; i < n && !nh_interrupted(); i++) e[i] = nh_simplify_short(s->d, e[i], 0);
}

/* ---- all coordinates, with multipliers ---- */

/* From the multiplier mu of f without poles, F = df/dv, to that of the constraint as it was written, nu = df/dv: mu_a =
 * mu F.nu / nu.nu, on the constraint. */
static nh_ex of_written(const scope *s, size_t a, nh_ex mu, const nh_ex *F)
{
    nh_dag *d = s->d;
    nh_ex f = nh_chart_constraint(s->o->chart, a), top = nh_int(d, 0), bottom = top;
    bool same = true;
    for (size_t i = 0; i < s->m; i++) {
        nh_ex nu = nh_diff(d, f, s->v[i]), own = F[a + i * s->k];
        same = same && nu == own;
        top = nh_add(d, top, nh_mul(d, own, nu));
        bottom = nh_add(d, bottom, nh_mul(d, nu, nu));
    }
    return same ? mu : nh_mul(d, mu, nh_simplify_short(d, nh_div(d, top, bottom), 0));
}

/* [ K F^T ; F 0 ] (v', mu) = -(h, g), and the force of the constraints on the bodies, -mu_a df^a/dv
 * [geometry/bordered.h]. */
static void accelerations(const scope *s, const nh_ex *K, const nh_ex *h, const nh_ex *F, const nh_ex *g)
{
    nh_dag *d = s->d;
    size_t m = s->m, k = s->k, n = m + k;
    nh_ex *A = take(s, n * n), *b = take(s, n), *value = take(s, n + m), *multiplier = value + m, *reaction = value + n,
          zero = nh_int(d, 0);
    nh_ex *mu = nh_export_symbols(s->x, d, "lambda", k);
    for (size_t i = 0; i < n * n; i++) A[i] = zero;
    for (size_t i = 0; i < m; i++) {
        value[i] = nh_symbol_fresh(d, s->rate[i]);
        b[i] = nh_neg(d, h[i]);
        for (size_t j = 0; j < m; j++) A[i * n + j] = K[i + j * m];
        for (size_t a = 0; a < k; a++) A[i * n + m + a] = A[(m + a) * n + i] = F[a + i * k];
    }
    for (size_t a = 0; a < k; a++) b[m + a] = nh_neg(d, g[a]);
    memcpy(multiplier, mu, k * sizeof *mu);
    nh_export_function *f =
        nh_export_add(s->x, NH_EXPORT_EQUATIONS, s->o->system, "accelerations",
                      k ? "Equations of motion in all coordinates, with Chetaev multipliers:\nmomentum' = dL/dq + "
                          "forces - sum of multiplier*d(constraint)/dv"
                        : "Equations of motion in all coordinates.");
    place_and_velocity(s, f);
    nh_export_linear(s->x, f, n, A, b, value);
    for (size_t i = 0; i < m; i++) {
        reaction[i] = zero;
        for (size_t a = 0; a < k; a++) reaction[i] = nh_sub(d, reaction[i], nh_mul(d, mu[a], F[a + i * k]));
    }
    for (size_t a = 0; a < k; a++) multiplier[a] = of_written(s, a, mu[a], F);
    nh_export_result(s->x, f, "acceleration", "second derivatives of the coordinates", m, 1, value, s->rate);
    nh_export_result(s->x, f, "multiplier", "of the constraints as they are written (left side minus right side)", k, 1,
                     multiplier, s->constraint);
    if (k)
        nh_export_result(s->x, f, "reaction", "force of the constraints along each coordinate", m, 1, reaction,
                         names_of(s, m, s->q));
}

void nh_export_equations(nh_export *x, const nh_model *model)
{
    scope s = scope_of(x, model);
    nh_dag *d = s.d;
    size_t m = s.m, k = s.k;
    nh_ex *K = take(&s, m * m), *h = take(&s, m), *F = take(&s, k * m), *g = take(&s, k), *f = take(&s, k),
          *rows = take(&s, k * m), *energy = take(&s, 1);
    nh_bordered_expressions(model, K, h, F, g, f);
    simplify(&s, m * m, K);
    simplify(&s, m, h);
    simplify(&s, k * m, F);
    simplify(&s, k, g);
    accelerations(&s, K, h, F, g);
    nh_export_function *e =
        nh_export_add(x, NH_EXPORT_EQUATIONS, model->system, "terms",
                      k ? "What the equations consist of: mass*acceleration + bias = -jacobian^T*multipliers, "
                          "jacobian*acceleration + drift = 0;\nhere each constraint is multiplied by its denominator."
                        : "What the equations consist of: mass*acceleration + bias = 0.");
    place_and_velocity(&s, e);
    for (size_t a = 0; a < k; a++)
        for (size_t i = 0; i < m; i++) rows[a * m + i] = F[a + i * k];
    const char **label = names_of(&s, m, s.q);
    nh_export_result(x, e, "mass", "d2L/dv dv", m, m, K, label);
    nh_export_result(x, e, "bias", "the terms of Lagrange's equations without accelerations", m, 1, h, label);
    nh_export_result(x, e, "jacobian", "derivatives of the constraints by the velocities", k, m, rows, s.constraint);
    nh_export_result(x, e, "drift", "derivatives of the constraints along the motion, without the accelerations", k, 1,
                     g, s.constraint);
    nh_export_result(x, e, "violation", "values of the constraints", k, 1, f, s.constraint);
    energy[0] = nh_neg(d, model->system->lagrangian);
    for (size_t i = 0; i < m; i++)
        energy[0] = nh_add(d, energy[0], nh_mul(d, s.v[i], nh_diff(d, model->system->lagrangian, s.v[i])));
    simplify(&s, 1, energy);
    e = nh_export_add(x, NH_EXPORT_EQUATIONS, model->system, "energy", "E = v*dL/dv - L, and L.");
    place_and_velocity(&s, e);
    nh_export_result(x, e, "energy", "E", 1, 1, energy, NULL);
    nh_export_result(x, e, "lagrangian", "L", 1, 1, &model->system->lagrangian, NULL);
}

/* ---- momenta ---- */

/* Solves momenta p = value(w) for velocities, with the Jacobian M: a linear system where M does not depend on w,
 * otherwise an iteration from a guess. */
static void invert(const scope *s, nh_export_function *f, size_t n, const nh_ex *w, const nh_ex *value, const nh_ex *M,
                   const nh_ex *p)
{
    nh_dag *d = s->d;
    nh_ex *zero = take(s, n), *right = take(s, n);
    bool affine = true;
    for (size_t i = 0; i < n; i++) zero[i] = nh_int(d, 0);
    for (size_t i = 0; i < n * n; i++)
        for (size_t j = 0; j < n; j++) affine = affine && !nh_depends(d, M[i], w[j]);
    for (size_t i = 0; i < n; i++)
        right[i] = affine ? nh_sub(d, p[i], nh_substitute(d, value[i], n, w, zero)) : nh_sub(d, value[i], p[i]);
    if (affine) {
        nh_export_linear(s->x, f, n, M, right, w);
        return;
    }
    nh_export_argument(s->x, f, "guess", "velocities to start the iteration from", n,
                       nh_export_symbols(s->x, d, "guess", n));
    nh_export_newton(s->x, f, n, M, right, w, f->arguments - 1);
}

/* Is the matrix regular somewhere on the sampling domain? */
static bool regular(const scope *s, size_t n, const nh_ex *K)
{
    static const double small = 1e-10;
    const nh_chart *c = s->o->chart;
    nh_ex *e = take(s, n * n);
    double *a = nh_alloc_array(n * n + n + 1, sizeof *a);
    bool found = false;
    for (size_t i = 0; i < n * n; i++) e[i] = nh_chart_compose(c, K[i]);
    nh_tape *tape = nh_model_tape(s->o, n * n, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    for (size_t p = 0; p < c->probes && !found; p++) {
        nh_tape_eval(tape, work, c->probe + p * c->width, a);
        found =
            nh_all_finite(n * n, a) && nh_svd(n, n, a, a + n * n, NULL, NULL) && a[n * n + n - 1] > small * a[n * n];
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(a);
    return found;
}

void nh_export_momenta(nh_export *x, const nh_model *model)
{
    scope s = scope_of(x, model);
    size_t m = s.m;
    nh_ex *p = take(&s, m), *K = take(&s, m * m), *symbol = nh_export_symbols(x, s.d, "p", m);
    const char **label = names_of(&s, m, s.v), **names = names_of(&s, m, s.q);
    for (size_t i = 0; i < m; i++) {
        p[i] = nh_diff(s.d, model->system->lagrangian, s.v[i]);
        simplify(&s, 1, p + i);
        for (size_t j = 0; j < m; j++) K[i * m + j] = nh_diff(s.d, p[i], s.v[j]);
    }
    nh_export_function *f =
        nh_export_add(x, NH_EXPORT_MOMENTA, model->system, "momenta", "Momenta dL/dv in all coordinates.");
    place_and_velocity(&s, f);
    nh_export_result(x, f, "momentum", "one for each coordinate", m, 1, p, names);
    if (!regular(&s, m, K)) {
        nh_export_note(x, "the momenta do not determine all velocities without the constraints: some have no inertia");
        return;
    }
    f = nh_export_add(x, NH_EXPORT_MOMENTA, model->system, "velocities_of_momenta",
                      "The velocities that have these momenta.");
    nh_export_argument(x, f, "q", "coordinates", m, s.q);
    nh_export_argument(x, f, "momentum", "one for each coordinate", m, symbol);
    invert(&s, f, m, s.v, p, K, symbol);
    nh_export_result(x, f, "v", "velocities", m, 1, s.v, label);
}

/* ---- on the constraint submanifold ---- */

static nh_ex *state_of(const scope *s)
{
    nh_ex *out = take(s, s->m + s->n);
    memcpy(out, s->q, s->m * sizeof *out);
    memcpy(out + s->m, s->o->chart->w, s->n * sizeof *out);
    return out;
}

/* Says which branch of a quadratic constraint it is, and how to get the other: in the function, and once in the
 * notes. */
static const char *with_branch(const scope *s, const char *doc)
{
    const nh_chart *c = s->o->chart;
    if (!c->branch) return doc;
    char *here = nh_chart_branch_name(c, c->branch), *there = nh_chart_branch_name(c, -c->branch);
    const char *note = nh_arena_printf(s->arena,
                                       "the functions on the constraint submanifold are those of the branch %s; an "
                                       "interval under `domain:` in which %s chooses the other one",
                                       here, there);
    bool said = false;
    for (size_t i = 0; i < s->x->notes; i++) said = said || !strcmp(s->x->note[i], note);
    if (!said) nh_export_note(s->x, "%s", note);
    doc = nh_arena_printf(s->arena, "%s  On the branch %s.", doc, here);
    nh_free(here);
    nh_free(there);
    return doc;
}

/* A function of the state (q, w).  Velocities that the constraints determine only implicitly are solved for first, from
 * a guess. */
static nh_export_function *on_submanifold(const scope *s, nh_export_part part, const char *name, const char *doc)
{
    const nh_chart *c = s->o->chart;
    size_t k = c->implicit;
    nh_export_function *f = nh_export_add(s->x, part, s->o->system, name, with_branch(s, doc));
    nh_export_argument(s->x, f, "state", "coordinates, then the velocities of the chart", s->m + s->n, state_of(s));
    if (!k) return f;
    nh_ex *J = take(s, k * k);
    for (size_t i = 0; i < k * k; i++) J[i] = nh_diff(s->d, c->residual[i / k], c->u[i % k]);
    nh_export_argument(s->x, f, "guess", "dependent velocities to start the iteration from", k,
                       nh_export_symbols(s->x, s->d, "guess", k));
    nh_export_newton(s->x, f, k, J, c->residual, c->u, f->arguments - 1);
    return f;
}

/* The number of operations of n expressions, about. */
static size_t operations(const scope *s, size_t n, const nh_ex *e)
{
    nh_ex sum = nh_int(s->d, 0);
    for (size_t i = 0; i < n; i++) sum = nh_add(s->d, sum, nh_mul(s->d, nh_symbol_fresh(s->d, "e"), e[i]));
    return nh_node_count(s->d, sum);
}

/* q' = rho, w' = a: in closed form, or from M w' = A where that is shorter. */
static void rates(const scope *s)
{
    const nh_model *model = s->o;
    size_t m = s->m, n = s->n, factor = n * n * n / 3 + n * n;
    nh_ex *rate = take(s, m + n), *both = take(s, n * n + n);
    memcpy(both, model->M, n * n * sizeof *both);
    memcpy(both + n * n, model->A, n * sizeof *both);
    nh_export_function *f =
        on_submanifold(s, NH_EXPORT_SUBMANIFOLD, "rates", "Equations of motion on the constraint submanifold.");
    memcpy(rate, model->rho, m * sizeof *rate);
    memcpy(rate + m, model->a, n * sizeof *rate);
    if (operations(s, n, model->a) > operations(s, n * n + n, both) + factor) {
        for (size_t i = 0; i < n; i++)
            rate[m + i] = nh_symbol_fresh(s->d, nh_arena_printf(s->arena, "%s'", nh_name_of(s->d, model->chart->w[i])));
        nh_export_linear(s->x, f, n, model->M, model->A, rate + m);
    }
    const char **label = names_of(s, m + n, state_of(s));
    for (size_t i = 0; i < m + n; i++) label[i] = nh_arena_printf(s->arena, "%s'", label[i]);
    nh_export_result(s->x, f, "rate", "derivatives of the state", m + n, 1, rate, label);
    if (model->chart->implicit)
        nh_export_result(s->x, f, "dependent", "dependent velocities, the next guess", model->chart->implicit, 1,
                         model->chart->u, names_of(s, model->chart->implicit, model->chart->u));
}

/* v = rho(t, q, w), and its inverse. */
static void embedding(const scope *s)
{
    const nh_model *model = s->o;
    nh_ex *state = take(s, s->m + s->n);
    nh_export_function *f = on_submanifold(s, NH_EXPORT_SUBMANIFOLD, "velocities", "Velocities of all coordinates.");
    nh_export_result(s->x, f, "v", "one for each coordinate", s->m, 1, model->rho, names_of(s, s->m, s->v));
    memcpy(state, s->q, s->m * sizeof *state);
    if (!nh_chart_inverse(model->chart, state + s->m)) {
        nh_export_note(s->x, "the chart %s is not solved for its velocities", model->chart->name);
        return;
    }
    f = nh_export_add(
        s->x, NH_EXPORT_SUBMANIFOLD, model->system, "state_of",
        with_branch(s, "The state on the constraint submanifold from coordinates and velocities that satisfy the "
                       "constraints."));
    place_and_velocity(s, f);
    nh_export_result(s->x, f, "state", "coordinates, then the velocities of the chart", s->m + s->n, 1, state,
                     names_of(s, s->m + s->n, state_of(s)));
}

static void submanifold_momenta(const scope *s)
{
    const nh_model *model = s->o;
    size_t n = s->n;
    nh_ex *p = nh_export_symbols(s->x, s->d, "p", n);
    const char **label = names_of(s, n, model->chart->w);
    nh_export_function *f = on_submanifold(s, NH_EXPORT_SUBMANIFOLD, "submanifold_momenta",
                                           "Momenta on the constraint submanifold, dL/dv * dv/dw.");
    nh_export_result(s->x, f, "momentum", "one for each velocity of the chart", n, 1, model->pbar, label);
    if (model->chart->implicit) return;
    for (size_t i = 0; i < s->m * n; i++) /* M is their Jacobian only where v is affine in w */
        for (size_t j = 0; j < n; j++)
            if (nh_depends(s->d, model->R[i], model->chart->w[j]))
                return nh_export_note(s->x, "the momenta on the constraint submanifold are not inverted: constraints "
                                            "are not affine in the velocities");
    f = nh_export_add(s->x, NH_EXPORT_SUBMANIFOLD, model->system, "submanifold_state_of_momenta",
                      "The state that has these momenta.");
    nh_export_argument(s->x, f, "q", "coordinates", s->m, s->q);
    nh_export_argument(s->x, f, "momentum", "one for each velocity of the chart", n, p);
    invert(s, f, n, model->chart->w, model->pbar, model->M, p);
    nh_export_result(s->x, f, "state", "coordinates, then the velocities of the chart", s->m + n, 1, state_of(s),
                     names_of(s, s->m + n, state_of(s)));
}

void nh_export_submanifold(nh_export *x, const nh_model *model)
{
    scope s = scope_of(x, model);
    size_t n = s.n, k = s.k;
    const char **label = names_of(&s, n, model->chart->w);
    rates(&s);
    embedding(&s);
    nh_export_function *f = on_submanifold(&s, NH_EXPORT_SUBMANIFOLD, "submanifold_terms",
                                           "What these equations consist of: mass*w' = force.");
    nh_export_result(x, f, "mass", "mass matrix", n, n, model->M, label);
    nh_export_result(x, f, "force", "all but the accelerations", n, 1, model->A, label);
    f = on_submanifold(&s, NH_EXPORT_SUBMANIFOLD, "submanifold_energy", "Energy and constrained Lagrangian.");
    nh_export_result(x, f, "energy", "E", 1, 1, &model->E, NULL);
    nh_export_result(x, f, "lagrangian", "L", 1, 1, &model->Lbar, NULL);
    submanifold_momenta(&s);
    if (!k) return;
    f = on_submanifold(&s, NH_EXPORT_SUBMANIFOLD, "multipliers",
                       "Chetaev multipliers, and the force of the constraints.");
    nh_export_result(x, f, "multiplier", "of the constraints as they are written (left side minus right side)", k, 1,
                     model->mu, s.constraint);
    nh_export_result(x, f, "reaction", "force of the constraints along each coordinate", s.m, 1, model->reaction,
                     names_of(&s, s.m, s.q));
}

/* ---- currents ---- */

/* d/dt, d/dq, d/dv by one sweep; through implicit velocities one by one. */
static void gradient(const scope *s, nh_ex e, size_t n, const nh_ex *symbol, bool implicit, nh_ex *out)
{
    if (!implicit) nh_gradient(s->d, e, n, symbol, out);
    for (size_t i = 0; i < n && implicit; i++) out[i] = nh_diff(s->d, e, symbol[i]);
}

static void currents_in(const scope *s, const nh_analysis *result, bool submanifold)
{
    const nh_current_list *list = result->list;
    size_t n = 1 + s->m + (submanifold ? s->n : s->m), count = 0;
    nh_ex *symbol = take(s, n), *value = take(s, list->count), *slope = take(s, list->count * n);
    const char **label = nh_arena_alloc(s->arena, (list->count + 1) * sizeof *label);
    symbol[0] = s->o->system->t;
    memcpy(symbol + 1, s->q, s->m * sizeof *symbol);
    memcpy(symbol + 1 + s->m, submanifold ? s->o->chart->w : s->v, (n - 1 - s->m) * sizeof *symbol);
    for (size_t i = 0; i < list->count; i++) {
        const nh_current *f = &list->found[i];
        if (!submanifold && !f->has_in_velocities) continue;
        label[count] = f->name;
        value[count] = submanifold ? f->phi : f->in_velocities;
        gradient(s, value[count], n, symbol, submanifold && s->o->chart->implicit, slope + count * n);
        count++;
    }
    if (!count) return;
    for (int which = 0; which < 2; which++) {
        const char *name = submanifold ? (which ? "submanifold_current_gradients" : "submanifold_currents")
                           : which     ? "current_gradients"
                                       : "currents";
        const char *doc = which ? "Gradients of the currents: by the time, the coordinates, the velocities."
                                : "Functions that every motion keeps constant.";
        nh_export_function *f;
        if (submanifold) f = on_submanifold(s, NH_EXPORT_CURRENTS, name, doc);
        else place_and_velocity(s, f = nh_export_add(s->x, NH_EXPORT_CURRENTS, s->o->system, name, doc));
        if (which) nh_export_result(s->x, f, "gradient", "a row for each current", count, n, slope, label);
        else nh_export_result(s->x, f, "current", "conserved", count, 1, value, label);
    }
}

void nh_export_currents(nh_export *x, const nh_analysis *result)
{
    scope s = scope_of(x, result->question->model);
    if (!result->list->count) nh_export_note(x, "currents: none was found");
    currents_in(&s, result, false);
    currents_in(&s, result, true);
}
