#include "reduction/quasi_symmetry.h"

#include <math.h>
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "integrals/prove.h"
#include "reduction/subspace.h"

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

nh_kinetic *nh_quasi_symmetry_kinetic(const nh_kinetic *k)
{
    nh_dag *d = k->dag;
    nh_kinetic *w = nh_arena_alloc(k->arena, sizeof *w);
    nh_ex *Q = nh_arena_alloc(k->arena, 2 * k->m * sizeof *Q), *none = Q + k->m;
    for (size_t s = 0; s < k->m; s++) {
        none[s] = nh_int(d, 0);
        Q[s] = nh_neg(d, nh_diff(d, k->V, k->q[s]));
        if (k->forced) Q[s] = nh_add(d, Q[s], k->Q[s]);
        for (size_t r = 0; r < k->m; r++)
            Q[s] = plus(d, Q[s], nh_sub(d, nh_diff(d, k->a[r], k->q[s]), nh_diff(d, k->a[s], k->q[r])), k->v[r]);
        Q[s] = nh_simplify(d, Q[s]);
    }
    *w = *k;
    w->V = nh_int(d, 0);
    w->a = none;
    w->Q = Q;
    w->forced = true;
    w->magnetic = w->reducible = false;
    w->obstacle = "--weak allows symmetries of the equations";
    return w;
}

/* `proof` becomes the weaker one of both statements. */
static bool vanishes(const nh_kinetic *k, nh_ex e, const nh_options *options, nh_proof *proof)
{
    *proof = nh_proof_both(k->model, *proof, nh_prove_zero(k->model, 1, &e, true, options));
    return proof->proved;
}

/* phi_0 with d phi_0 = form, when that is a polynomial of degree two: g_i q^i + 1/2 H_ij q^i q^j. */
static bool primitive(const nh_kinetic *k, const nh_ex *form, const nh_options *options, nh_ex *out, nh_proof *proof)
{
    nh_dag *d = k->dag;
    size_t m = k->m;
    nh_ex *zero = nh_alloc_array(m + 1, sizeof *zero);
    bool good = true;
    *out = nh_int(d, 0);
    for (size_t i = 0; i < m; i++) zero[i] = nh_int(d, 0);
    for (size_t i = 0; i < m; i++) {
        *out = plus(d, *out, nh_substitute(d, form[i], m, k->q, zero), k->q[i]);
        for (size_t j = 0; j < m; j++)
            *out = plus(d, *out, nh_substitute(d, nh_diff(d, form[i], k->q[j]), m, k->q, zero),
                        nh_mul(d, nh_ratio(d, 1, 2), nh_mul(d, k->q[i], k->q[j])));
    }
    for (size_t i = 0; i < m && good; i++)
        good = vanishes(k, nh_sub(d, form[i], nh_diff(d, *out, k->q[i])), options, proof);
    nh_free(zero);
    return good;
}

/* omega(xi) = 0, xi . Q = 0, xi(V) constant: exactly. */
static bool holds(const nh_kinetic *k, const nh_ex *xi, nh_ex slope, const nh_options *options, nh_proof *proof)
{
    nh_dag *d = k->dag;
    nh_ex power = nh_int(d, 0);
    bool good = true;
    for (size_t s = 0; s < k->m && k->forced; s++) power = plus(d, power, xi[s], k->Q[s]);
    good = vanishes(k, power, options, proof);
    for (size_t i = 0; i < k->f && good; i++) {
        nh_ex e = nh_int(d, 0);
        for (size_t s = 0; s < k->m; s++) e = plus(d, e, k->omega[i * k->m + s], xi[s]);
        good = vanishes(k, e, options, proof);
    }
    for (size_t s = 0; s < k->m && good; s++) good = vanishes(k, nh_diff(d, slope, k->q[s]), options, proof);
    return good;
}

static bool fill(nh_momentum *p, const nh_kinetic *k, const nh_action *g, const double *c, const nh_options *options)
{
    nh_dag *d = k->dag;
    size_t m = k->m;
    *p = (nh_momentum){
        .horizontal = true, .f = nh_arena_alloc(k->arena, (g->d + m) * sizeof *p->f), .value = nh_int(d, 0)};
    p->field = p->f + g->d;
    for (size_t s = 0; s < m; s++) p->field[s] = nh_int(d, 0);
    nh_action strict = *g; /* of the system itself: what --weak calls a force is no condition */
    strict.kinetic = k;
    p->proof = nh_momenta_horizontal(&strict, c, false, options, p->f);
    for (size_t a = 0; a < g->d; a++) {
        for (size_t s = 0; s < m; s++) p->field[s] = plus(d, p->field[s], p->f[a], g->generator[a].component[s]);
    }
    nh_ex slope = nh_simplify(d, nh_field_along(k, p->field, k->V)), phi = 0;
    if (!holds(k, p->field, slope, options, &p->proof)) return false;
    nh_ex *form = nh_alloc_array(m + 1, sizeof *form);
    for (size_t i = 0; i < m; i++) {
        form[i] = nh_field_along(k, p->field, k->a[i]);
        for (size_t r = 0; r < m; r++) form[i] = plus(d, form[i], k->a[r], nh_diff(d, p->field[r], k->q[i]));
    }
    bool good = primitive(k, form, options, &phi, &p->proof);
    for (size_t r = 0; r < m; r++) {
        p->value = plus(d, p->value, p->field[r], k->a[r]);
        for (size_t s = 0; s < m; s++) p->value = plus(d, p->value, p->field[r], nh_mul(d, k->K[r * m + s], k->v[s]));
    }
    p->value = nh_simplify(d, nh_add(d, nh_sub(d, p->value, phi), nh_mul(d, k->model->system->t, slope)));
    nh_free(form);
    return good;
}

void nh_quasi_symmetry_momenta(nh_momenta *out, const nh_kinetic *k, const nh_action *g, const nh_options *options)
{
    double *c = nh_alloc_array(g->d * g->d + 1, sizeof *c);
    size_t n = g->d ? nh_action_horizontal(g, options, c) : 0;
    *out = (nh_momenta){.momentum = nh_arena_alloc(k->arena, (n + 1) * sizeof *out->momentum)};
    for (size_t j = 0; j < n; j++) out->count += fill(&out->momentum[out->count], k, g, c + j * g->d, options);
    nh_free(c);
}
