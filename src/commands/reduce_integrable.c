/* reduce_integrable: what the constraints and the reaction leave constant beside the momenta of the group.
 *
 *     growth      ranks of D, D + [D,D], ..: where the last one is below m, m - r functions of the positions are
 *                 constant, and D is not bracket generating [BellaicheRisler1996, ch. 1]
 *     leaf        of these, the sums c_s q^s with constants c_s: c_s X^s = 0 for all X in D
 *     momenta     of fields in D that leave L invariant, but not D: combinations with constants of cyclic coordinates
 *                 and of the group's generators.  The reaction vanishes along them: Noether's theorem [Bloch1996] */
#include <string.h>

#include "base/progress.h"
#include "commands/reduce_internal.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "reduction/section.h"
#include "reduction/subspace.h"

/* X_i = d rho/dw^i, n x m. */
static nh_ex *directions(const nh_kinetic *k)
{
    const nh_chart *chart = k->model->chart;
    nh_ex *X = nh_alloc_array(chart->n * k->m + 1, sizeof *X);
    for (size_t i = 0; i < chart->n; i++)
        for (size_t s = 0; s < k->m; s++) X[i * k->m + s] = nh_diff(k->dag, chart->rho[s], chart->w[i]);
    return X;
}

/* Sums of coordinates that D leaves constant. */
static void leaves(nh_reduction *r, size_t n, const nh_ex *X)
{
    const nh_kinetic *k = r->kinetic;
    nh_dag *d = k->dag;
    size_t m = k->m, count = 0;
    nh_ex *entry = nh_alloc_array(n * m + 1, sizeof *entry);
    for (size_t i = 0; i < n * m; i++) entry[i] = X[i % n * m + i / n];
    const nh_ex *c = nh_section_relations(k, m, n, entry, &r->options, &count);
    r->leaf = nh_arena_alloc(r->arena, (count + 1) * sizeof *r->leaf);
    for (size_t i = 0; i < count && c; i++) {
        nh_ex sum = nh_int(d, 0);
        for (size_t s = 0; s < m; s++) sum = nh_add(d, sum, nh_mul(d, c[i * m + s], k->q[s]));
        sum = nh_simplify(d, nh_numerator(d, sum));
        r->leaf[r->leaf_count++] = nh_section_negative(d, sum) ? nh_neg(d, sum) : sum;
    }
    nh_free(entry);
}

/* ---- momenta ---- */

/* Does L not depend on q^s? */
static bool cyclic(const nh_kinetic *k, size_t s)
{
    bool in = nh_depends(k->dag, k->V, k->q[s]);
    for (size_t i = 0; i < k->m * k->m; i++) in |= nh_depends(k->dag, k->K[i], k->q[s]);
    for (size_t i = 0; i < k->m; i++) in |= nh_depends(k->dag, k->a[i], k->q[s]);
    return !in;
}

/* The group's generators, and those of cyclic coordinates that are none of them; room for d + m. */
static size_t of_lagrangian(const nh_reduction *r, nh_generator *g)
{
    const nh_kinetic *k = r->kinetic;
    nh_dag *d = k->dag;
    size_t n = r->group->action.d, own = n;
    nh_ex *e = nh_alloc_array(k->m, sizeof *e);
    memcpy(g, r->group->action.generator, n * sizeof *g);
    for (size_t s = 0; s < k->m; s++) {
        bool old = !cyclic(k, s);
        for (size_t i = 0; i < k->m; i++) e[i] = nh_int(d, i == s);
        for (size_t a = 0; a < own; a++) old |= !memcmp(g[a].component, e, k->m * sizeof *e);
        if (!old) nh_generator_init(&g[n++], k, NULL, e, &r->options);
    }
    nh_free(e);
    return n;
}

/* Is it, where the constraints hold, a sum of the others with constant coefficients? */
static bool known(const nh_reduction *r, nh_ex J)
{
    const nh_kinetic *k = r->kinetic;
    const nh_chart *chart = k->model->chart;
    size_t n = r->momenta.count, count = 0;
    nh_ex *e = nh_alloc_array(n + 1, sizeof *e);
    for (size_t i = 0; i < n; i++) e[i] = nh_chart_compose(chart, r->momenta.momentum[i].value);
    e[n] = nh_chart_compose(chart, J);
    const nh_ex *c = nh_section_relations(k, n + 1, 1, e, &r->options, &count);
    bool old = false;
    for (size_t i = 0; i < count && c; i++) old |= !nh_is_zero(k->dag, c[i * (n + 1) + n]);
    nh_free(e);
    return old;
}

/* J without the velocities that the rates of the leaves give, where it is shorter so. */
static nh_ex shorter(const nh_reduction *r, nh_ex J)
{
    const nh_kinetic *k = r->kinetic;
    nh_dag *d = k->dag;
    for (size_t i = 0; i < r->leaf_count; i++) {
        nh_ex best = J, rate = nh_diff_along(d, r->leaf[i], k->m, k->q, k->v);
        for (size_t s = 0; s < k->m; s++) { /* rate = c v^s + the others */
            nh_ex c = nh_diff(d, r->leaf[i], k->q[s]);
            if (nh_is_zero(d, c)) continue;
            nh_ex v = nh_sub(d, k->v[s], nh_div(d, rate, c)), e = nh_simplify(d, nh_substitute(d, J, 1, &k->v[s], &v));
            if (nh_complexity(d, e) < nh_complexity(d, best)) best = e;
        }
        J = best;
    }
    return J;
}

static void take(nh_reduction *r, const nh_action *all, const double *c)
{
    const nh_kinetic *k = r->kinetic;
    nh_dag *d = k->dag;
    size_t own = r->group->action.d;
    nh_momentum new = {.of_lagrangian = true, .f = nh_arena_alloc(k->arena, (all->d + 1) * sizeof *new.f)};
    new.field = nh_arena_alloc(k->arena, k->m * sizeof *new.field);
    new.proof = nh_momenta_horizontal(all, c, false, &r->options, new.f);
    for (size_t a = 0; a < own && new.proof.proved; a++)
        if (c[a] != 0) new.proof = nh_proof_both(k->model, new.proof, nh_generator_proof(k, &all->generator[a]));
    new.value = nh_int(d, 0);
    size_t lead = own; /* the first cyclic coordinate gets the coefficient 1 */
    while (lead < all->d && nh_is_zero(d, new.f[lead])) lead++;
    nh_ex unit = lead < all->d ? new.f[lead] : nh_int(d, 1);
    for (size_t a = 0; a < all->d; a++) new.f[a] = nh_simplify(d, nh_div(d, new.f[a], unit));
    for (size_t s = 0; s < k->m; s++) {
        nh_ex J = k->a[s], e = nh_int(d, 0);
        for (size_t i = 0; i < k->m; i++) J = nh_add(d, J, nh_mul(d, k->K[s * k->m + i], k->v[i]));
        for (size_t a = 0; a < all->d; a++) e = nh_add(d, e, nh_mul(d, new.f[a], all->generator[a].component[s]));
        new.field[s] = nh_simplify(d, e);
        if (!nh_is_zero(d, new.field[s])) new.value = nh_add(d, new.value, nh_mul(d, new.field[s], J));
    }
    new.value = shorter(r, nh_simplify(d, new.value));
    if (!new.proof.proved || nh_is_zero(d, new.value) || known(r, new.value)) return;
    nh_momentum *list = nh_arena_alloc(k->arena, (r->momenta.count + 1) * sizeof *list);
    if (r->momenta.count) memcpy(list, r->momenta.momentum, r->momenta.count * sizeof *list);
    list[r->momenta.count++] = new;
    r->momenta.momentum = list;
}

static void momenta(nh_reduction *r)
{
    const nh_kinetic *k = r->kinetic;
    size_t own = r->group->action.d, most = own + k->m;
    nh_generator *g = nh_alloc_array(most + 1, sizeof *g);
    double *c = nh_alloc_array(most * most + 1, sizeof *c);
    size_t n = of_lagrangian(r, g);
    if (n > own) {
        nh_action all;
        nh_action_init(&all, k, n, g, &r->options);
        size_t count = nh_action_horizontal(&all, &r->options, c);
        for (size_t j = 0; j < count; j++)
            if (nh_largest(n - own, c + j * n + own) > 0) take(r, &all, c + j * n);
        nh_action_clear(&all);
    }
    nh_free(g);
    nh_free(c);
}

void nh_reduction_integrable(nh_reduction *r)
{
    const nh_kinetic *k = r->kinetic;
    const nh_chart *chart = k->model->chart;
    if (!k->f || !k->linear || !k->autonomous || !k->quadratic || nh_interrupted()) return;
    if (nh_reduction_late(r, "the growth vector of the constraints")) return;
    nh_ex *X = directions(k);
    r->growth = nh_growth_of(k->model, chart->n, k->m, k->q, X, 0);
    bool generating = r->growth.length && r->growth.rank[r->growth.length - 1] == k->m;
    if (r->growth.length && !generating) leaves(r, chart->n, X);
    nh_free(X);
    if (!k->forced && !nh_reduction_late(r, "momenta of cyclic coordinates")) momenta(r);
}
