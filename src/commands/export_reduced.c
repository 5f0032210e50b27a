/* export_reduced: the stages of a reduction as functions: reduced equations, the motion in the group, and the place q
 * that both determine.
 *
 *     g = exp(t_1 e_1) ... exp(t_d e_d),    M(t) t' = Ad_g zeta,    q = flow_1(t_1) o ... o flow_d(t_d) (sigma(x))
 *
 * [reduction/reconstruct.h].  Ad and the flows of fields that are affine in the coordinates are exponentials of
 * matrices N. Where N^4 = lambda N^2 (translations, rotations, screws, boosts, nilpotent matrices) these have a closed
 * form, with w^2 = -lambda, and likewise for the other signs of lambda:
 *
 *     exp(tN) = 1 + tN + (1 - cos(wt))/w^2 N^2 + (wt - sin(wt))/w^3 N^3 */
#include <math.h>
#include <string.h>

#include "commands/export_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"

typedef struct {
    nh_export *x;
    const nh_reduction *r;
    const nh_reduction_stage *stage;
    const nh_reduced *o;
    const nh_slice *slice;
    nh_dag *d;
    size_t number, n, w, g; /* shape coordinates, velocities, group */
    nh_ex *state;           /* n + w: shape and momenta */
    const char **rate;      /* n + w */
} scope;

static nh_ex *take(const scope *s, size_t n) { return nh_arena_alloc(s->x->arena, (n + 1) * sizeof(nh_ex)); }

static scope scope_of(nh_export *x, const nh_reduction *r, size_t i)
{
    const nh_reduction_stage *stage = r->stage[i].named ? r->stage[i].named : &r->stage[i];
    const nh_reduced *o = stage->shown;
    scope s = {.x = x,
               .r = r,
               .stage = stage,
               .o = o,
               .slice = stage->shown_slice,
               .d = r->system->dag,
               .number = i + 1,
               .n = o->n,
               .w = o->r,
               .g = o->d};
    s.state = take(&s, s.n + s.w);
    s.rate = nh_arena_alloc(x->arena, (s.n + s.w + 1) * sizeof *s.rate);
    memcpy(s.state, o->x, s.n * sizeof *s.state);
    for (size_t k = 0; k < s.w; k++) s.state[s.n + k] = o->plain ? o->w[k] : nh_symbol_fresh(s.d, o->momentum[k]);
    for (size_t k = 0; k < s.n + s.w; k++) s.rate[k] = nh_arena_printf(x->arena, "%s'", nh_name_of(s.d, s.state[k]));
    return s;
}

/* In velocities from the momenta: M w = p. */
static nh_export_function *add(const scope *s, const char *suffix, const char *doc)
{
    nh_export_function *f = nh_export_add(s->x, NH_EXPORT_REDUCED, s->r->system,
                                          nh_arena_printf(s->x->arena, "stage%zu%s", s->number, suffix), doc);
    f->stage = s->number - 1;
    nh_export_argument(s->x, f, "state", "shape coordinates, then momenta", s->n + s->w, s->state);
    return f;
}

static void solve_mass(const scope *s, nh_export_function *f)
{
    if (!s->o->plain && s->w) nh_export_linear(s->x, f, s->w, s->o->M, s->state + s->n, s->o->w);
}

static void equations(const scope *s)
{
    const nh_reduced *o = s->o;
    nh_ex *rate = take(s, s->n + s->w);
    nh_export_function *f = add(s, "", "Reduced equations of motion.");
    solve_mass(s, f);
    memcpy(rate, o->dx, s->n * sizeof *rate);
    memcpy(rate + s->n, o->F, s->w * sizeof *rate);
    nh_export_result(s->x, f, "rate", "derivatives of the state", s->n + s->w, 1, rate, s->rate);
    nh_export_result(s->x, f, "zeta", "body velocity of the group", s->g, 1, o->zeta, NULL);
    f = add(s, "_energy", o->conservative ? "The energy, which is conserved." : "The energy.");
    solve_mass(s, f);
    nh_export_result(s->x, f, "energy", "E", 1, 1, &o->energy, NULL);
    if (o->plain) return;
    nh_ex *state = take(s, s->n + s->w);
    memcpy(state, o->x, s->n * sizeof *state);
    for (size_t i = 0; i < s->w; i++) {
        state[s->n + i] = nh_int(s->d, 0);
        for (size_t j = 0; j < s->w; j++)
            state[s->n + i] = nh_add(s->d, state[s->n + i], nh_mul(s->d, o->M[i * s->w + j], o->w[j]));
    }
    f = nh_export_add(s->x, NH_EXPORT_REDUCED, s->r->system, nh_arena_printf(s->x->arena, "stage%zu_state", s->number),
                      "The state from shape and velocities.");
    f->stage = s->number - 1;
    nh_export_argument(s->x, f, "shape", "shape coordinates", s->n, o->x);
    nh_export_argument(s->x, f, "w", "velocities", s->w, o->w);
    const char **label = nh_arena_alloc(s->x->arena, (s->n + s->w + 1) * sizeof *label);
    for (size_t k = 0; k < s->n + s->w; k++) label[k] = nh_name_of(s->d, s->state[k]);
    nh_export_result(s->x, f, "state", "shape coordinates, then momenta", s->n + s->w, 1, state, label);
}

/* ---- exponentials of matrices ---- */

static void multiply(const scope *s, size_t n, const nh_ex *a, const nh_ex *b, nh_ex *out)
{
    nh_dag *d = s->d;
    nh_ex *c = take(s, n * n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            nh_ex sum = nh_int(d, 0);
            for (size_t k = 0; k < n; k++)
                if (!nh_is_zero(d, a[i * n + k]) && !nh_is_zero(d, b[k * n + j]))
                    sum = nh_add(d, sum, nh_mul(d, a[i * n + k], b[k * n + j]));
            c[i * n + j] = nh_is_zero(d, sum) ? sum : nh_simplify_short(d, sum, 0);
        }
    memcpy(out, c, n * n * sizeof *c);
}

/* The lambda with N^4 = lambda N^2; false where there is none. */
static bool quartic(const scope *s, size_t n, const nh_ex *square, const nh_ex *fourth, nh_ex *lambda)
{
    nh_dag *d = s->d;
    *lambda = nh_int(d, 0);
    for (size_t i = 0; i < n * n && nh_is_zero(d, *lambda); i++)
        if (!nh_is_zero(d, fourth[i]) && !nh_is_zero(d, square[i]))
            *lambda = nh_simplify(d, nh_div(d, fourth[i], square[i]));
    for (size_t i = 0; i < n * n; i++)
        if (nh_normal_is_zero(d, nh_sub(d, fourth[i], nh_mul(d, *lambda, square[i])), 0) != NH_ZERO) return false;
    return true;
}

/* exp(tN); false where it has no closed form of this kind. */
static bool exponential(const scope *s, size_t n, const nh_ex *N, nh_ex t, nh_ex *out)
{
    nh_dag *d = s->d;
    nh_ex *square = take(s, n * n), *cube = take(s, n * n), *fourth = take(s, n * n), lambda, S, C, one = nh_int(d, 1);
    multiply(s, n, N, N, square);
    multiply(s, n, square, N, cube);
    multiply(s, n, square, square, fourth);
    if (!quartic(s, n, square, fourth, &lambda)) return false;
    double sign = nh_system_number(s->r->system, lambda);
    if (!isfinite(sign)) return false;
    if (sign == 0) {
        C = nh_div(d, nh_powi(d, t, 2), nh_int(d, 2));
        S = nh_div(d, nh_powi(d, t, 3), nh_int(d, 6));
    } else {
        nh_ex w = nh_simplify(d, nh_sqrt(d, sign < 0 ? nh_neg(d, lambda) : lambda)), wt = nh_mul(d, w, t);
        C = sign < 0 ? nh_sub(d, one, nh_call(d, NH_COS, wt)) : nh_sub(d, nh_call(d, NH_COSH, wt), one);
        S = sign < 0 ? nh_sub(d, wt, nh_call(d, NH_SIN, wt)) : nh_sub(d, nh_call(d, NH_SINH, wt), wt);
        C = nh_div(d, C, nh_powi(d, w, 2));
        S = nh_div(d, S, nh_powi(d, w, 3));
    }
    for (size_t i = 0; i < n * n; i++) {
        nh_ex e = nh_add(d, nh_mul(d, t, N[i]), nh_add(d, nh_mul(d, C, square[i]), nh_mul(d, S, cube[i])));
        out[i] = nh_simplify_short(d, i % (n + 1) ? e : nh_add(d, one, e), 0);
    }
    return true;
}

/* ---- reconstruction ---- */

/* M, whose column a is Ad of the first a - 1 factors on e_a, and Ad_g; (ad_a)_kb = C_ab^k. */
static bool adjoint(const scope *s, const nh_ex *t, nh_ex *M, nh_ex *Ad)
{
    size_t n = s->g;
    nh_ex *ad = take(s, n * n), *E = take(s, n * n);
    for (size_t i = 0; i < n * n; i++) Ad[i] = nh_int(s->d, i % (n + 1) == 0);
    for (size_t a = 0; a < n; a++) {
        for (size_t k = 0; k < n; k++) M[k * n + a] = Ad[k * n + a];
        for (size_t k = 0; k < n; k++)
            for (size_t b = 0; b < n; b++) ad[k * n + b] = s->slice->action->constant[(a * n + b) * n + k];
        if (!exponential(s, n, ad, t[a], E)) return false;
        multiply(s, n, Ad, E, Ad);
    }
    return true;
}

/* q moved by exp(t e): e = B q + b, so that (q, 1) is multiplied by the exponential of ( B b ; 0 0 ). */
static bool flow(const scope *s, const nh_generator *e, nh_ex t, nh_ex *q)
{
    const nh_kinetic *k = s->slice->kinetic;
    nh_dag *d = s->d;
    size_t m = k->m, n = m + 1;
    nh_ex *N = take(s, n * n), *E = take(s, n * n), *moved = take(s, m), *zero = take(s, m);
    for (size_t i = 0; i < n * n; i++) N[i] = nh_int(d, 0);
    for (size_t i = 0; i < m; i++) zero[i] = nh_int(d, 0);
    for (size_t r = 0; r < m; r++) {
        for (size_t c = 0; c < m; c++) {
            nh_ex B = N[r * n + c] = nh_simplify(d, nh_diff(d, e->component[r], k->q[c]));
            for (size_t i = 0; i < m; i++)
                if (nh_depends(d, B, k->q[i])) return false;
        }
        N[r * n + m] = nh_substitute(d, e->component[r], m, k->q, zero);
    }
    if (!exponential(s, n, N, t, E)) return false;
    for (size_t r = 0; r < m; r++) {
        moved[r] = E[r * n + m];
        for (size_t c = 0; c < m; c++) moved[r] = nh_add(d, moved[r], nh_mul(d, E[r * n + c], q[c]));
    }
    memcpy(q, moved, m * sizeof *q);
    return true;
}

static const char **coordinate_names(const scope *s, const char *tail)
{
    const nh_kinetic *k = s->slice->kinetic;
    const char **out = nh_arena_alloc(s->x->arena, (k->m + 1) * sizeof *out);
    for (size_t i = 0; i < k->m; i++) out[i] = nh_arena_printf(s->x->arena, "%s%s", k->name[i], tail);
    return out;
}

static bool place(const scope *s, const nh_ex *t)
{
    const nh_slice *slice = s->slice;
    size_t m = slice->m;
    nh_ex *q = take(s, m);
    for (size_t i = 0; i < s->n; i++) q[slice->shape[i]] = s->o->x[i];
    for (size_t a = 0; a < s->g; a++) q[slice->along[a]] = slice->y[a];
    for (size_t a = s->g; a-- > 0;)
        if (!flow(s, &s->slice->action->generator[a], t[a], q)) return false;
    nh_export_function *f = add(s, "_place", "All coordinates, from a reduced state and the coordinates of the group.");
    nh_export_argument(s->x, f, "group", "coordinates of the group", s->g, t);
    nh_export_result(s->x, f, "q", "coordinates", m, 1, q, coordinate_names(s, ""));
    return true;
}

/* Do the generators depend on the shape?  Otherwise q' = x'^i d_i + (Ad_g zeta)^a e_a(q). */
static bool place_rate(const scope *s, const nh_ex *t, const nh_ex *spatial)
{
    const nh_kinetic *k = s->slice->kinetic;
    const nh_action *action = s->slice->action;
    nh_ex *rate = take(s, k->m);
    for (size_t i = 0; i < k->m; i++) rate[i] = nh_int(s->d, 0);
    for (size_t i = 0; i < s->n; i++) rate[s->slice->shape[i]] = s->o->dx[i];
    for (size_t a = 0; a < s->g; a++)
        for (size_t r = 0; r < k->m; r++) {
            nh_ex e = action->generator[a].component[r];
            for (size_t i = 0; i < s->n; i++)
                if (nh_depends(s->d, e, s->o->x[i])) return false;
            rate[r] = nh_add(s->d, rate[r], nh_mul(s->d, spatial[a], e));
        }
    nh_ex *q = take(s, k->m); /* the place has coordinates of its own: those of the shape are in the state already */
    nh_ex *along = nh_export_symbols(s->x, s->d, "q", k->m);
    for (size_t i = 0; i < k->m; i++) q[i] = along[i];
    for (size_t r = 0; r < k->m; r++) {
        nh_ex *from = take(s, s->g), *to = take(s, s->g);
        for (size_t a = 0; a < s->g; a++) from[a] = k->q[s->slice->along[a]], to[a] = q[s->slice->along[a]];
        rate[r] = nh_substitute(s->d, rate[r], s->g, from, to);
    }
    nh_export_function *f = add(
        s, "_place_rate", "The velocities of all coordinates, from a reduced state and the coordinates of the group.");
    nh_export_argument(s->x, f, "group", "coordinates of the group", s->g, t);
    nh_export_argument(s->x, f, "q", "coordinates", k->m, q);
    solve_mass(s, f);
    nh_export_result(s->x, f, "v", "derivatives of the coordinates", k->m, 1, rate, coordinate_names(s, "'"));
    return true;
}

static void reconstruction(const scope *s)
{
    nh_dag *d = s->d;
    size_t n = s->g;
    if (!n) return;
    nh_ex *t = nh_export_symbols(s->x, d, "theta", n), *M = take(s, n * n), *Ad = take(s, n * n), *spatial = take(s, n),
          *rate = take(s, n);
    if (!adjoint(s, t, M, Ad)) {
        nh_export_note(s->x, "stage %zu: no reconstruction, as the group's adjoint has no closed form", s->number);
        return;
    }
    const char **label = nh_arena_alloc(s->x->arena, (n + 1) * sizeof *label);
    bool abelian = true;
    for (size_t a = 0; a < n; a++) {
        label[a] = nh_arena_printf(s->x->arena, "theta%zu'", a + 1);
        rate[a] = nh_symbol_fresh(d, label[a]);
        spatial[a] = nh_int(d, 0);
        for (size_t b = 0; b < n; b++) spatial[a] = nh_add(d, spatial[a], nh_mul(d, Ad[a * n + b], s->o->zeta[b]));
        for (size_t b = 0; b < n; b++) abelian = abelian && nh_is_number(d, M[a * n + b], a == b);
    }
    nh_export_function *f = add(
        s, "_group", "The motion in the group, g = exp(theta1 e1) exp(theta2 e2) ...: from theta = 0 on the slice.");
    nh_export_argument(s->x, f, "group", "coordinates of the group", n, t);
    solve_mass(s, f);
    if (!abelian) nh_export_linear(s->x, f, n, M, spatial, rate);
    nh_export_result(s->x, f, "group_rate", "their derivatives", n, 1, abelian ? spatial : rate, label);
    if (!place(s, t) && !place_rate(s, t, spatial))
        nh_export_note(s->x, "stage %zu: the place has no formula, as the flows of the group's fields have none",
                       s->number);
}

void nh_export_stages(nh_export *x, const nh_reduction *r)
{
    for (size_t i = 0; i < r->stages; i++) {
        if (r->stage[i].shown->force) { /* it is computed, and has no formula */
            nh_export_note(x, "stage %zu has no formula", i + 1);
            continue;
        }
        scope s = scope_of(x, r, i);
        equations(&s);
        reconstruction(&s);
    }
}
