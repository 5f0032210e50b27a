#include "reduction/chaplygin.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "expr/diff.h"
#include "expr/normal.h"
#include "expr/solve.h"

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

static bool connection(nh_chaplygin *c, nh_error *error)
{
    const nh_slice *s = c->slice;
    nh_dag *d = c->dag;
    size_t f = s->f, n = c->n;
    nh_ex *a = nh_alloc_array(f * f + f + 1, sizeof *a), *b = a + f * f;
    for (size_t i = 0; i < f; i++)
        for (size_t j = 0; j < f; j++) a[i * f + j] = s->omega[i * s->m + n + j];
    nh_lu *lu = nh_lu_create(d, f, a, nh_slice_pivot_score, (void *)s, NULL);
    for (size_t i = 0; i < n && lu; i++) {
        for (size_t r = 0; r < f; r++) b[r] = s->omega[r * s->m + i];
        nh_lu_solve(lu, b, b);
        for (size_t r = 0; r < f; r++) c->A[r * n + i] = s->pivots ? b[r] : nh_simplify(d, b[r]);
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(a);
    return good || nh_fail(error, NH_NUMERIC, "", "the orbits of the group meet the constraint distribution: there is no connection");
}

static void curvature(nh_chaplygin *c)
{
    nh_dag *d = c->dag;
    const nh_algebra *g = &c->slice->action->algebra;
    const nh_ex *x = c->slice->x;
    size_t n = c->n, dim = c->d;
    bool tidy = c->slice->tidy;
    for (size_t a = 0; a < dim; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                nh_ex e = nh_sub(d, nh_diff(d, c->A[a * n + j], x[i]), nh_diff(d, c->A[a * n + i], x[j]));
                for (size_t b = 0; b < dim; b++)
                    for (size_t k = 0; k < dim; k++) {
                        double constant = g->c[(b * dim + k) * dim + a];
                        if (constant != 0) e = plus(d, e, nh_real(d, -constant), nh_mul(d, c->A[b * n + i], c->A[k * n + j]));
                    }
                if (tidy) e = nh_simplify(d, e);
                c->B[(a * n + i) * n + j] = e;
                c->B[(a * n + j) * n + i] = nh_neg(d, e);
            }
}

static void metric(nh_chaplygin *c)
{
    const nh_slice *s = c->slice;
    nh_dag *d = c->dag;
    size_t n = c->n, m = s->m;
    bool tidy = s->tidy;
    for (size_t a = 0; a < c->d; a++)
        for (size_t j = 0; j < n; j++) {
            nh_ex e = s->K[(n + a) * m + j];
            for (size_t b = 0; b < c->d; b++) e = plus(d, e, nh_neg(d, s->K[(n + a) * m + n + b]), c->A[b * n + j]);
            c->J[a * n + j] = tidy ? nh_simplify(d, e) : e;
        }
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) { /* K_ij - K_ia A^a_j - A^a_i J_aj */
            nh_ex e = s->K[i * m + j];
            for (size_t a = 0; a < c->d; a++) {
                e = plus(d, e, nh_neg(d, s->K[i * m + n + a]), c->A[a * n + j]);
                e = plus(d, e, nh_neg(d, c->A[a * n + i]), c->J[a * n + j]);
            }
            c->K[i * n + j] = c->K[j * n + i] = tidy ? nh_simplify(d, e) : e;
        }
}

static void gyroscopic(nh_chaplygin *c)
{
    nh_dag *d = c->dag;
    size_t n = c->n;
    bool tidy = c->slice->tidy;
    for (size_t k = 0; k < n; k++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                nh_ex e = nh_int(d, 0);
                for (size_t a = 0; a < c->d; a++) e = plus(d, e, c->J[a * n + k], c->B[(a * n + i) * n + j]);
                if (tidy) e = nh_simplify(d, e);
                c->U[(k * n + i) * n + j] = e;
                c->U[(k * n + j) * n + i] = nh_neg(d, e);
            }
}

/* (2.11) in velocities: p_i' = 1/2 x'^T d_i Khat x' - d_i V + U_kij x'^k x'^j. */
static void equations(nh_chaplygin *c)
{
    const nh_slice *s = c->slice;
    const nh_kinetic *k = s->kinetic;
    nh_dag *d = c->dag;
    nh_reduced *o = &c->reduced;
    size_t n = c->n;
    nh_reduced_init(o, k, n, s->x, n, c->d);
    nh_ex energy = c->V;
    memcpy(o->M, c->K, n * n * sizeof *o->M);
    for (size_t i = 0; i < n; i++) {
        o->w[i] = o->dx[i] = k->v[s->shape[i]];
        o->momentum[i] = nh_arena_printf(k->arena, "p_%s", k->name[s->shape[i]]);
    }
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = nh_neg(d, nh_diff(d, c->V, s->x[i]));
        for (size_t a = 0; a < n; a++)
            for (size_t b = 0; b < n; b++) {
                nh_ex square = nh_mul(d, o->w[a], o->w[b]);
                if (b <= a) sum = plus(d, sum, nh_mul(d, nh_ratio(d, a == b ? 1 : 2, 2), nh_diff(d, c->K[a * n + b], s->x[i])), square);
                sum = plus(d, sum, c->U[(a * n + i) * n + b], square);
                energy = plus(d, energy, nh_mul(d, nh_ratio(d, 1, 2), c->K[a * n + b]), i ? nh_int(d, 0) : square);
            }
        o->F[i] = sum;
    }
    for (size_t a = 0; a < c->d; a++)
        for (size_t i = 0; i < n; i++) o->zeta[a] = plus(d, o->zeta[a], nh_neg(d, c->A[a * n + i]), o->w[i]);
    o->energy = energy;
    size_t *columns = nh_alloc_array(c->d + 1, sizeof *columns);
    for (size_t a = 0; a < c->d; a++) columns[a] = n + a;
    nh_reduced_guard_slice(o, s);
    nh_reduced_guard_constraints(o, s, columns);
    nh_free(columns);
}

bool nh_chaplygin_init(nh_chaplygin *c, const nh_slice *s, nh_error *error)
{
    nh_arena *arena = s->kinetic->arena;
    size_t n = s->n, d = s->d;
    *c = (nh_chaplygin){.slice = s, .dag = s->dag, .n = n, .d = d, .V = s->V};
    if (d != s->f) return nh_fail(error, NH_NUMERIC, "", "a Chaplygin system needs as many symmetries as constraints: %zu, not %zu", s->f, d);
    c->A = nh_arena_alloc(arena, (2 * d * n + d * n * n + n * n + n * n * n + 1) * sizeof *c->A);
    c->J = c->A + d * n;
    c->B = c->J + d * n;
    c->K = c->B + d * n * n;
    c->U = c->K + n * n;
    if (!connection(c, error)) return false;
    curvature(c);
    metric(c);
    gyroscopic(c);
    equations(c);
    return true;
}
