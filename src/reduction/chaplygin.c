/* The first stage for V + D = TQ, V cap D = 0 (chaplygin.h; docs/method.md (23)), as expressions on the slice:
 *
 *      connection      A = om_e^-1 om_x                                           d x n
 *      curvature       B^a_ij = d_i A^a_j - d_j A^a_i - C_bc^a A^b_i A^c_j        d x n x n
 *      metric          Khat = H^T Kf H, H = (1; -A)                               n x n
 *      gyroscopic      U_lij with Ups_ij = U_lij x'^l = J_a B^a_ij                n x n x n
 *      drift           A_0, ahat, Vhat, J0 where constraints are affine, L has a part af u, or there are forces
 *      equations       p_i' = 1/2 x'^T d_i Khat x' + (d_i ahat_j - d_j ahat_i) x'^j - d_i Vhat + force_i */
#include "reduction/chaplygin.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"

/* sum + a b, without nodes for zeros. */
static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

/* A by LU factorization of om_e in the graph; fails where om_e is singular: there is no connection. */
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
    if (lu) nh_lu_solve(lu, s->b, b);
    for (size_t r = 0; r < f && lu; r++) c->A0[r] = s->pivots || nh_is_zero(d, b[r]) ? b[r] : nh_simplify(d, b[r]);
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(a);
    return good || nh_fail(error, NH_NUMERIC, "",
                           "the orbits of the group meet the constraint distribution: there is no connection");
}

/* B^a_ij = d_i A^a_j - d_j A^a_i - C_bc^a A^b_i A^c_j, antisymmetric in i and j. */
static void curvature(nh_chaplygin *c)
{
    nh_dag *d = c->dag;
    const nh_action *g = c->slice->action;
    const nh_ex *x = c->slice->x;
    size_t n = c->n, dim = c->d;
    bool tidy = c->slice->tidy;
    for (size_t a = 0; a < dim; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                nh_ex e = nh_sub(d, nh_diff(d, c->A[a * n + j], x[i]), nh_diff(d, c->A[a * n + i], x[j]));
                for (size_t b = 0; b < dim; b++)
                    for (size_t k = 0; k < dim; k++) {
                        nh_ex constant = g->constant[(b * dim + k) * dim + a];
                        if (!nh_is_zero(d, constant))
                            e = plus(d, e, nh_neg(d, constant), nh_mul(d, c->A[b * n + i], c->A[k * n + j]));
                    }
                if (tidy) e = nh_simplify(d, e);
                c->B[(a * n + i) * n + j] = e;
                c->B[(a * n + j) * n + i] = nh_neg(d, e);
            }
}

/* J_aj = (Kf_e H)_aj, d x n, and Khat_ij = K_ij - K_ia A^a_j - A^a_i J_aj. */
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

/* The terms from affine constraints, from a part of L that is linear in the velocities, and from forces. */
static void drift(nh_chaplygin *c)
{
    const nh_slice *s = c->slice;
    nh_dag *d = c->dag;
    const nh_action *g = s->action;
    size_t n = c->n, dim = c->d, m = s->m;
    nh_ex half = nh_ratio(d, 1, 2);
    for (size_t a = 0; a < dim; a++) {
        c->J0[a] = s->a[n + a];
        for (size_t b = 0; b < dim; b++) {
            c->J0[a] = plus(d, c->J0[a], nh_neg(d, s->K[(n + a) * m + n + b]), c->A0[b]);
            c->V = plus(d, c->V, nh_neg(d, nh_mul(d, half, s->K[(n + a) * m + n + b])), nh_mul(d, c->A0[a], c->A0[b]));
        }
        c->V = plus(d, c->V, s->a[n + a], c->A0[a]);
        for (size_t i = 0; i < n; i++) {
            nh_ex e = nh_diff(d, c->A0[a], s->x[i]);
            for (size_t b = 0; b < dim; b++)
                for (size_t k = 0; k < dim; k++) {
                    nh_ex constant = g->constant[(b * dim + k) * dim + a];
                    if (!nh_is_zero(d, constant))
                        e = plus(d, e, nh_neg(d, constant), nh_mul(d, c->A[b * n + i], c->A0[k]));
                }
            c->B0[a * n + i] = s->tidy ? nh_simplify(d, e) : e;
        }
    }
    for (size_t i = 0; i < n; i++) {
        c->a[i] = s->a[i];
        for (size_t a = 0; a < dim; a++) {
            c->a[i] = plus(d, c->a[i], nh_neg(d, s->K[i * m + n + a]), c->A0[a]);
            c->a[i] = plus(d, c->a[i], nh_neg(d, c->A[a * n + i]), c->J0[a]);
        }
        if (s->tidy) c->a[i] = nh_simplify(d, c->a[i]);
    }
    if (s->tidy) c->V = nh_simplify(d, c->V);
}

/* J_a (B^a_ij x'^j + B^a_i0) + (H^T Qf)_i; true where its power vanishes. */
static bool forces(nh_chaplygin *c, const nh_ex *speed)
{
    const nh_slice *s = c->slice;
    nh_dag *d = c->dag;
    size_t n = c->n, m = s->m;
    nh_ex *u = nh_alloc_array(2 * m + 1, sizeof *u), *Q = u + m, power = nh_int(d, 0);
    for (size_t r = 0; r < m; r++) Q[r] = nh_int(d, 0), u[r] = r < n ? speed[r] : nh_neg(d, c->A0[r - n]);
    for (size_t a = 0; a < c->d; a++)
        for (size_t i = 0; i < n; i++) u[n + a] = plus(d, u[n + a], nh_neg(d, c->A[a * n + i]), speed[i]);
    if (s->kinetic->forced) nh_reduced_add_forces(s, u, Q);
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = Q[i], turning = nh_int(d, 0);
        for (size_t a = 0; a < c->d; a++) {
            nh_ex J = c->J0[a];
            for (size_t k = 0; k < n; k++) J = plus(d, J, c->J[a * n + k], speed[k]);
            sum = plus(d, sum, nh_neg(d, c->A[a * n + i]), Q[n + a]);
            sum = plus(d, sum, J, c->B0[a * n + i]);
            turning = plus(d, turning, J, c->B0[a * n + i]);
            for (size_t j = 0; j < n; j++) sum = plus(d, sum, nh_mul(d, c->J0[a], c->B[(a * n + i) * n + j]), speed[j]);
        }
        power = plus(d, power, turning, speed[i]);
        for (size_t k = 0; k < n; k++)
            for (size_t j = 0; j < n; j++) sum = plus(d, sum, c->U[(k * n + i) * n + j], nh_mul(d, speed[k], speed[j]));
        c->force[i] = sum;
    }
    nh_free(u);
    return !s->kinetic->forced && (s->kinetic->linear || nh_normal_is_zero(d, power, 0) == NH_ZERO);
}

/* (2.11) in velocities: p_i' = 1/2 x'^T d_i Khat x' + (d_i ahat_j - d_j ahat_i) x'^j - d_i Vhat + force_i. */
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
        o->momentum[i] = nh_kinetic_unused_name(k, "p_%s", k->name[s->shape[i]]);
    }
    o->conservative = forces(c, o->w);
    for (size_t i = 0; i < n; i++) {
        nh_ex sum = nh_sub(d, c->force[i], nh_diff(d, c->V, s->x[i]));
        for (size_t a = 0; a < n; a++) {
            sum = plus(d, sum, nh_sub(d, nh_diff(d, c->a[a], s->x[i]), nh_diff(d, c->a[i], s->x[a])), o->w[a]);
            for (size_t b = 0; b < n; b++) {
                nh_ex square = nh_mul(d, o->w[a], o->w[b]);
                if (b <= a)
                    sum = plus(d, sum, nh_mul(d, nh_ratio(d, a == b ? 1 : 2, 2), nh_diff(d, c->K[a * n + b], s->x[i])),
                               square);
                energy = plus(d, energy, nh_mul(d, nh_ratio(d, 1, 2), c->K[a * n + b]), i ? nh_int(d, 0) : square);
            }
        }
        o->F[i] = sum;
    }
    for (size_t a = 0; a < c->d; a++) {
        o->zeta[a] = nh_neg(d, c->A0[a]);
        for (size_t i = 0; i < n; i++) o->zeta[a] = plus(d, o->zeta[a], nh_neg(d, c->A[a * n + i]), o->w[i]);
    }
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
    if (d != s->f)
        return nh_fail(error, NH_NUMERIC, "",
                       "a Chaplygin system needs as many symmetries as constraints: %zu, not %zu", s->f, d);
    c->plain = s->kinetic->reducible;
    c->A = nh_arena_alloc(arena, (3 * d * n + d * n * n + n * n + n * n * n + 2 * d + 2 * n + 1) * sizeof *c->A);
    c->J = c->A + d * n;
    c->B = c->J + d * n;
    c->K = c->B + d * n * n;
    c->U = c->K + n * n;
    c->A0 = c->U + n * n * n;
    c->J0 = c->A0 + d;
    c->B0 = c->J0 + d;
    c->a = c->B0 + d * n;
    c->force = c->a + n;
    if (!connection(c, error)) return false;
    curvature(c);
    metric(c);
    gyroscopic(c);
    drift(c);
    equations(c);
    return true;
}
