/* Reduction of the equations themselves, for systems to which nothing else applies (quotient.h; docs/method.md (27)).
 *
 *      prolong       eta_a from R eta_a = rho^r d_r e_a - e_a^r d_r rho            n velocities for each generator
 *      on the slice  zeta from e_a^y zeta^a = rho^y                               d x d
 *      reduced       x' = rho^x - zeta^a e_a^x,   w' = a - zeta^a eta_a
 *      energy        constant along Gamma at the chart's probes? then it is shown as conserved */
#include "reduction/quotient.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

/* eta of one generator: least squares by the normal equations, which the prolonged field satisfies exactly. */
static bool prolong(const nh_model *model, const nh_ex *e, nh_ex *eta)
{
    nh_dag *d = model->dag;
    size_t m = model->m, n = model->n;
    const nh_coordinate *c = model->system->coordinate;
    nh_ex *q = nh_alloc_array(2 * m + n * n + n + 1, sizeof *q), *right = q + m, *N = right + m, *b = N + n * n;
    bool any = false, good = true;
    for (size_t s = 0; s < m; s++) q[s] = c[s].q;
    for (size_t s = 0; s < m; s++) {
        right[s] = nh_simplify(
            d, nh_sub(d, nh_diff_along(d, e[s], m, q, model->rho), nh_diff_along(d, model->rho[s], m, q, e)));
        any |= !nh_is_zero(d, right[s]);
    }
    for (size_t i = 0; i < n; i++) {
        b[i] = eta[i] = nh_int(d, 0);
        for (size_t j = 0; j < n; j++) N[i * n + j] = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) {
            b[i] = plus(d, b[i], model->R[s * n + i], right[s]);
            for (size_t j = 0; j < n; j++)
                N[i * n + j] = plus(d, N[i * n + j], model->R[s * n + i], model->R[s * n + j]);
        }
    }
    if (any && !model->chart->quasi) {
        /* there the components of w are components of v */
        for (size_t i = 0; i < n; i++) eta[i] = right[model->chart->free[i]];
    } else if (any) {
        nh_lu *lu = nh_lu_create(d, n, N, nh_chart_pivot_score, model->chart, NULL);
        good = lu != NULL;
        if (lu) nh_lu_solve(lu, b, eta);
        nh_lu_free(lu);
    }
    nh_free(q);
    return good;
}

/* |dE/dt| + |rho^s dE/dq^s| + |a_i dE/dw^i|, of all terms. */
static nh_ex terms_of_rate(const nh_model *model)
{
    nh_dag *d = model->dag;
    nh_ex sum = nh_terms_moduli(d, nh_diff(d, model->E, model->system->t));
    for (size_t s = 0; s < model->m; s++)
        sum = nh_add(
            d, sum, nh_terms_moduli(d, nh_mul(d, model->rho[s], nh_diff(d, model->E, model->system->coordinate[s].q))));
    for (size_t i = 0; i < model->n; i++)
        sum = nh_add(d, sum, nh_terms_moduli(d, nh_mul(d, model->a[i], nh_model_Y(model, i, model->E))));
    return sum;
}

/* One over the time in which coordinates change by their size: max_s |rho^s| / size_s at a probe, sizes over all of
   them, 1 for angles. */
static double pace(const nh_model *model, const double *rho)
{
    const nh_chart *c = model->chart;
    double most = 0;
    for (size_t s = 0; s < model->m; s++) {
        double size = 0;
        for (size_t p = 0; p < c->probes; p++) size = fmax(size, fabs(c->probe[p * c->width + 1 + s]));
        if (model->system->coordinate[s].type == NH_ANGLE || size == 0) size = 1;
        most = fmax(most, fabs(rho[s]) / size);
    }
    return most;
}

/* Is the energy constant along Gamma at the chart's probes?  Its rate is compared with its terms, which may be only
 * rounding, and with the energy's own terms within the time in which coordinates change by their size. */
static bool conservative(const nh_model *model)
{
    static const double small = 1e-9;
    nh_ex *e = nh_alloc_array(model->m + 3, sizeof *e);
    double *out = nh_alloc_array(model->m + 3, sizeof *out);
    e[0] = nh_model_gamma(model, model->E);
    e[1] = terms_of_rate(model);
    e[2] = nh_terms_moduli(model->dag, model->E);
    memcpy(e + 3, model->rho, model->m * sizeof *e);
    nh_tape *tape = nh_model_tape(model, model->m + 3, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    bool good = true;
    for (size_t p = 0; p < model->chart->probes; p++) {
        nh_tape_eval(tape, work, model->chart->probe + p * model->chart->width, out);
        good = good && isfinite(out[0]) && fabs(out[0]) <= small * (out[1] + pace(model, out + 3) * out[2]);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
    nh_free(out);
    return good;
}

static void names(nh_reduced *out, const nh_model *model)
{
    for (size_t i = 0; i < model->n; i++) {
        out->w[i] = model->chart->w[i];
        out->momentum[i] = nh_name_of(model->dag, model->chart->w[i]);
        out->M[i * (model->n + 1)] = nh_int(model->dag, 1);
    }
    out->plain = true;
}

bool nh_quotient_init(nh_reduced *out, const nh_model *model, const nh_slice *s, nh_error *error)
{
    nh_dag *d = model->dag;
    size_t n = s->n, g = s->d, r = model->n, m = model->m;
    const nh_action *action = s->action;
    if (model->chart->implicit)
        return nh_fail(error, NH_NUMERIC, "", "the constraints cannot be solved for velocities in closed form");
    nh_reduced_init(out, s->kinetic, n, s->x, r, g);
    names(out, model);
    nh_ex *from = nh_alloc_array(g + m + g * g + g * r + 1, sizeof *from), *rho = from + g, *minor = rho + m,
          *eta = minor + g * g;
    for (size_t a = 0; a < g; a++) from[a] = s->kinetic->q[s->along[a]];
    for (size_t i = 0; i < m; i++) rho[i] = nh_substitute(d, model->rho[i], g, from, s->y);
    bool good = true;
    for (size_t a = 0; a < g; a++) {
        good = good && prolong(model, action->generator[a].component, eta + a * r);
        for (size_t b = 0; b < g; b++) minor[a * g + b] = s->E[s->along[a] * g + b];
        out->zeta[a] = rho[s->along[a]];
    }
    nh_lu *lu = good ? nh_lu_create(d, g, minor, nh_slice_pivot_score, (void *)s, NULL) : NULL;
    if (lu) nh_lu_solve(lu, out->zeta, out->zeta);
    good = lu != NULL;
    for (size_t a = 0; a < g && good; a++) out->zeta[a] = nh_simplify(d, out->zeta[a]);
    for (size_t i = 0; i < n && good; i++) {
        out->dx[i] = rho[s->shape[i]];
        for (size_t a = 0; a < g; a++)
            out->dx[i] = plus(d, out->dx[i], nh_neg(d, s->E[s->shape[i] * g + a]), out->zeta[a]);
        out->dx[i] = nh_simplify(d, out->dx[i]);
    }
    for (size_t k = 0; k < r && good; k++) {
        out->F[k] = nh_substitute(d, model->a[k], g, from, s->y);
        for (size_t a = 0; a < g; a++)
            out->F[k] = plus(d, out->F[k], nh_neg(d, nh_substitute(d, eta[a * r + k], g, from, s->y)), out->zeta[a]);
        if (s->tidy) out->F[k] = nh_simplify(d, out->F[k]);
    }
    out->t = model->system->t;
    for (size_t i = 0; i < n + r + g && good; i++)
        out->timed |= nh_depends(d, i < n ? out->dx[i] : i < n + r ? out->F[i - n] : out->zeta[i - n - r], out->t);
    out->energy = nh_substitute(d, model->E, g, from, s->y);
    out->conservative = !nh_depends(d, out->energy, out->t) && conservative(model);
    nh_reduced_guard_slice(out, s);
    nh_lu_free(lu);
    nh_free(from);
    return good || nh_fail(error, NH_NUMERIC, "",
                           "the generators cannot be expressed in the chart's velocities, or the slice is singular");
}

/* ---- states ---- */

/* Gauss-Newton for rho(t, q, w) = v from w as it is; the distance that is left, relative. */
static double fit(const nh_model *model, nh_tape *tape, nh_tape_work *work, double *z, const double *v)
{
    enum { most = 60 };
    size_t m = model->m, n = model->n;
    double *value = nh_alloc_array(m * (1 + n) + m * n + m + n, sizeof *value), *R = value + m * (1 + n),
           *b = R + m * n, off = INFINITY;
    for (int i = 0; i < most; i++) {
        double size = 0, now = 0;
        nh_tape_eval(tape, work, z, value);
        for (size_t s = 0; s < m; s++) {
            b[s] = v[s] - value[s];
            now = fmax(now, fabs(b[s]));
            size = fmax(size, fabs(v[s]));
            for (size_t k = 0; k < n; k++) R[s + k * m] = value[m + s * n + k];
        }
        if (!isfinite(now) || !isfinite(nh_largest(m * n, R))) break;
        off = size > 0 ? now / size : now; /* at rest there is nothing to compare with */
        if (off < 1e-15 || nh_least_squares(m, n, R, 1, b, m > n ? m : n, 1e-12) < 0) break;
        for (size_t k = 0; k < n; k++) z[1 + m + k] += b[k];
    }
    nh_free(value);
    return off;
}

bool nh_quotient_velocities(const nh_model *model, double t, const double *q, const double *v, double *w,
                            nh_error *error)
{
    static const double allowed = 1e-10;
    size_t m = model->m, n = model->n;
    nh_ex *e = nh_alloc_array(m * (1 + n), sizeof *e);
    memcpy(e, model->rho, m * sizeof *e);
    memcpy(e + m, model->R, m * n * sizeof *e);
    nh_tape *tape = nh_model_tape(model, m * (1 + n), e);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *z = nh_alloc_array(model->width + 1, sizeof *z), off = INFINITY;
    for (size_t p = 0; p < 1 + model->chart->probes && off > allowed; p++) {
        z[0] = t;
        memcpy(z + 1, q, m * sizeof *z);
        for (size_t k = 0; k < n; k++)
            z[1 + m + k] = p                     ? model->chart->probe[(p - 1) * model->chart->width + 1 + m + k]
                           : model->chart->quasi ? 0.1 + 0.1 * (double)k
                                                 : v[model->chart->free[k]];
        off = fit(model, tape, work, z, v);
    }
    memcpy(w, z + 1 + m, n * sizeof *w);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
    nh_free(z);
    return off <= allowed || nh_fail(error, NH_NUMERIC, "",
                                     "the velocities of the chart (%s) do not cover the initial state, which lies on "
                                     "another branch of the constraints",
                                     model->chart->name);
}

/* ---- momenta ---- */

/* Values of expressions over the model's points at the sample states of the kinetic; *good counts the states that the
   chart covers. */
static double *sampled(const nh_model *model, const nh_kinetic *k, size_t count, const nh_ex *e, size_t *good)
{
    enum { most_places = 24 };
    size_t m = model->m, places = k->places < most_places ? k->places : most_places;
    nh_tape *tape = nh_model_tape(model, count, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    double *out = nh_alloc_array(places * count + 1, sizeof *out), *z = nh_alloc_array(model->width + 1, sizeof *z);
    *good = 0;
    for (size_t p = 0; p < places; p++) {
        nh_error ignored = {0};
        z[0] = k->time[p];
        memcpy(z + 1, k->place + p * m, m * sizeof *z);
        if (!nh_quotient_velocities(model, z[0], k->place + p * m, k->speed + p * m, z + 1 + m, &ignored)) continue;
        nh_tape_eval(tape, work, z, out + *good * count);
        *good += isfinite(nh_largest(count, out + *good * count));
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(z);
    return out;
}

/* Does the field lie in the distribution: xi^s df^A/dv^s = 0 for all constraints, exactly? */
static bool admissible(const nh_model *model, const nh_kinetic *k, const nh_ex *field, const nh_options *options)
{
    nh_dag *d = model->dag;
    bool good = true;
    for (size_t a = 0; a < k->f && good; a++) {
        nh_ex e = nh_int(d, 0);
        for (size_t s = 0; s < model->m; s++) e = plus(d, e, field[s], nh_diff(d, k->force[a], k->v[s]));
        e = nh_model_compose(model, e);
        good = nh_is_zero(d, e) || nh_prove_zero(model, 1, &e, false, options).proved;
    }
    return good;
}

static void add(nh_momenta *out, const nh_model *model, const nh_action *g, const nh_ex *rate, const double *c,
                const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *d = model->dag;
    nh_momentum *p = &out->momentum[out->count++];
    *p = (nh_momentum){.f = nh_arena_alloc(k->arena, (g->d + model->m) * sizeof *p->f), .value = nh_int(d, 0)};
    p->field = p->f + g->d;
    for (size_t s = 0; s < model->m; s++) p->field[s] = nh_int(d, 0);
    p->proof = nh_section_coefficients(k, g->d, rate, c, nh_section_pivot(g->d, c), options, p->f);
    for (size_t a = 0; a < g->d; a++) {
        for (size_t s = 0; s < model->m; s++) p->field[s] = plus(d, p->field[s], p->f[a], g->generator[a].component[s]);
    }
    for (size_t s = 0; s < model->m; s++)
        p->value = plus(d, p->value, p->field[s], nh_diff(d, model->system->lagrangian, k->v[s]));
    p->horizontal = admissible(model, k, p->field, options);
    p->value = nh_simplify(d, p->value);
}

/* By numbers, where the exact relations are not known. */
static size_t combinations_at_places(const nh_model *model, const nh_kinetic *k, size_t d, const nh_ex *rate,
                                     const nh_options *options, double *c)
{
    size_t places;
    double *value = sampled(model, k, d, rate, &places), *rows = nh_alloc_array(places * d + 1, sizeof *rows);
    for (size_t p = 0; p < places; p++)
        for (size_t a = 0; a < d; a++) rows[p + a * places] = value[p * d + a];
    size_t n = places ? nh_kernel(places, d, rows, options->group, c, NULL, NULL) : 0;
    nh_column_echelon(d, n, options->group, c);
    nh_free(value);
    nh_free(rows);
    return n;
}

void nh_quotient_momenta(nh_momenta *out, const nh_model *model, const nh_action *g, const nh_options *options)
{
    const nh_kinetic *k = g->kinetic;
    nh_dag *dag = model->dag;
    size_t d = g->d, n;
    *out = (nh_momenta){.momentum = nh_arena_alloc(k->arena, (d + 1) * sizeof *out->momentum)};
    out->untried = model->chart->implicit;
    if (!d || out->untried) return;
    nh_ex *rate = nh_alloc_array(d, sizeof *rate);
    for (size_t a = 0; a < d; a++) {
        nh_ex J = nh_int(dag, 0);
        for (size_t s = 0; s < model->m; s++) J = plus(dag, J, g->generator[a].component[s], model->p[s]);
        rate[a] = nh_model_gamma(model, J);
    }
    double *c = nh_alloc_array(d * d + 1, sizeof *c);
    if (!nh_section_combinations(k, d, 1, rate, options, c, &n))
        n = combinations_at_places(model, k, d, rate, options, c);
    for (size_t j = 0; j < n; j++) add(out, model, g, rate, c + j * d, options);
    nh_free(c);
    nh_free(rate);
}
