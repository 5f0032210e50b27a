/* master: the equations of a symmetric system on a slice, for any group and any constraints (reduced.h;
 * docs/method.md (22)).
 *
 *      u = (x', zeta) = rho w + c          rho: m x r, c: m;  omf u + bf = 0 solved for the dependent components
 *      (pi, mu) = Kf u + af                momenta in the frame
 *      M_ij = rho_i . Kf rho_j             what is integrated: p = M w, the part of rho_i . (pi, mu) linear in w
 *      p_i' = rho_i^j (frame force)_j + x'^j d_j rho_i . (pi, mu) + rho_i . Qf - rate of the rest */
#include <string.h>

#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "reduction/reduced.h"

/* rho (m x r) and c (m): u = rho w + c, the dependent components by omf_dep u_dep = -omf_ind w - bf. */
static bool solve_constraints(const nh_slice *s, const size_t *independent, nh_ex *rho, nh_ex *constant,
                              nh_error *error)
{
    nh_dag *d = s->dag;
    size_t m = s->m, f = s->f, r = m - f, n = 0, *dependent = nh_alloc_array(f + 1, sizeof *dependent);
    nh_ex *a = nh_alloc_array(f * f + f + 1, sizeof *a), *b = a + f * f;
    for (size_t j = 0; j < m; j++) {
        bool free_one = false;
        for (size_t i = 0; i < r; i++) {
            free_one |= independent[i] == j;
            rho[j * r + i] = nh_int(d, independent[i] == j);
        }
        constant[j] = nh_int(d, 0);
        if (!free_one && n < f) dependent[n++] = j;
    }
    for (size_t i = 0; i < f; i++)
        for (size_t j = 0; j < f; j++) a[i * f + j] = s->omega[i * m + dependent[j]];
    nh_lu *lu = nh_lu_create(d, f, a, nh_slice_pivot_score, (void *)s, NULL);
    for (size_t i = 0; i < r && lu; i++) {
        for (size_t c = 0; c < f; c++) b[c] = nh_neg(d, s->omega[c * m + independent[i]]);
        nh_lu_solve(lu, b, b);
        for (size_t c = 0; c < f; c++) rho[dependent[c] * r + i] = s->pivots ? b[c] : nh_simplify(d, b[c]);
    }
    for (size_t c = 0; c < f; c++) b[c] = nh_neg(d, s->b[c]);
    if (lu) nh_lu_solve(lu, b, b);
    for (size_t c = 0; c < f && lu; c++) constant[dependent[c]] = s->pivots ? b[c] : nh_simplify(d, b[c]);
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(a);
    nh_free(dependent);
    return good || nh_fail(error, NH_NUMERIC, "", "the constraints cannot be solved on the slice");
}

/* sum_k a_k b_k with strides. */
static nh_ex dot(nh_dag *d, size_t n, const nh_ex *a, size_t stride, const nh_ex *b, size_t step)
{
    nh_ex sum = nh_int(d, 0);
    for (size_t i = 0; i < n; i++)
        if (!nh_is_zero(d, a[i * stride]) && !nh_is_zero(d, b[i * step]))
            sum = nh_add(d, sum, nh_mul(d, a[i * stride], b[i * step]));
    return sum;
}

/* The force on the frame component j: 1/2 u^T d_j Kf u + d_j af u - d_j V along the shape, C_ab^k zeta^a mu_k along the
   group. */
static nh_ex frame_force(const nh_slice *s, size_t j, const nh_ex *u, const nh_ex *momentum)
{
    nh_dag *d = s->dag;
    size_t m = s->m, n = s->n;
    nh_ex sum = nh_int(d, 0);
    if (j < n) {
        for (size_t r = 0; r < m; r++)
            for (size_t c = 0; c <= r; c++) {
                nh_ex slope = nh_diff(d, s->K[r * m + c], s->x[j]);
                if (nh_is_zero(d, slope)) continue;
                sum = nh_add(
                    d, sum,
                    nh_mul(d, nh_mul(d, r == c ? nh_ratio(d, 1, 2) : nh_int(d, 1), slope), nh_mul(d, u[r], u[c])));
            }
        for (size_t r = 0; r < m; r++) {
            nh_ex slope = nh_diff(d, s->a[r], s->x[j]);
            if (!nh_is_zero(d, slope)) sum = nh_add(d, sum, nh_mul(d, slope, u[r]));
        }
        return nh_sub(d, sum, nh_diff(d, s->V, s->x[j]));
    }
    const nh_action *g = s->action;
    for (size_t a = 0; a < g->d; a++)
        for (size_t k = 0; k < g->d; k++) {
            nh_ex c = g->constant[(a * g->d + (j - n)) * g->d + k];
            if (!nh_is_zero(d, c)) sum = nh_add(d, sum, nh_mul(d, c, nh_mul(d, u[n + a], momentum[n + k])));
        }
    return sum;
}

static void name_velocities(nh_reduced *o, const nh_slice *s, const size_t *independent)
{
    const nh_kinetic *k = s->kinetic;
    for (size_t i = 0; i < o->r; i++) {
        bool shape = independent[i] < s->n;
        const char *name =
            shape ? k->name[s->shape[independent[i]]] : nh_arena_printf(k->arena, "%zu", independent[i] - s->n + 1);
        o->w[i] =
            shape ? k->v[s->shape[independent[i]]] : nh_symbol_fresh(k->dag, nh_kinetic_unused_name(k, "zeta%s", name));
        o->momentum[i] = nh_kinetic_unused_name(k, shape ? "p_%s" : "mu_%s", name);
    }
}

/* The minors that must stay away from zero: of the constraints' dependent columns, of the generators on the slice. */
static void guard(nh_reduced *o, const nh_slice *s, const size_t *independent)
{
    size_t n = 0, *columns = nh_alloc_array(s->f + 1, sizeof *columns);
    for (size_t j = 0; j < s->m; j++) {
        bool free_one = false;
        for (size_t i = 0; i < o->r; i++) free_one |= independent[i] == j;
        if (!free_one && n < s->f) columns[n++] = j;
    }
    nh_reduced_guard_slice(o, s);
    nh_reduced_guard_constraints(o, s, columns);
    nh_free(columns);
}

/* Fr^T Q(sigma(x), Fr u). */
void nh_reduced_add_forces(const nh_slice *s, const nh_ex *u, nh_ex *force)
{
    const nh_kinetic *k = s->kinetic;
    nh_dag *d = s->dag;
    size_t m = s->m, n = s->n;
    nh_ex *from = nh_alloc_array(4 * m, sizeof *from), *to = from + 2 * m;
    for (size_t i = 0; i < m; i++) {
        from[i] = k->q[i], from[m + i] = k->v[i];
        to[i] = k->q[i], to[m + i] = nh_int(d, 0);
    }
    for (size_t a = 0; a < s->d; a++) to[s->along[a]] = s->y[a];
    for (size_t i = 0; i < n; i++) to[m + s->shape[i]] = u[i];
    for (size_t i = 0; i < m; i++)
        for (size_t a = 0; a < s->d; a++)
            if (!nh_is_zero(d, s->E[i * s->d + a]))
                to[m + i] = nh_add(d, to[m + i], nh_mul(d, s->E[i * s->d + a], u[n + a]));
    for (size_t i = 0; i < m; i++) {
        nh_ex Q = nh_substitute(d, k->Q[i], 2 * m, from, to);
        if (nh_is_zero(d, Q)) continue;
        for (size_t j = 0; j < n; j++)
            if (s->shape[j] == i) force[j] = nh_add(d, force[j], Q);
        for (size_t a = 0; a < s->d; a++) force[n + a] = nh_add(d, force[n + a], nh_mul(d, s->E[i * s->d + a], Q));
    }
    nh_free(from);
}

/* p_i = rho_i . Kf rho w, and the rest of rho_i . (pi, mu): a function of the place, whose rate is subtracted. */
static void momenta(nh_reduced *o, const nh_slice *s, const nh_ex *rho, const nh_ex *constant, const nh_ex *u,
                    nh_ex *rest)
{
    nh_dag *d = s->dag;
    size_t m = s->m, r = o->r;
    nh_ex *K = nh_alloc_array(m * (r + 1) + 1, sizeof *K), *Kc = K + m * r;
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < r; i++) K[j * r + i] = dot(d, m, s->K + j * m, 1, rho + i, r);
        Kc[j] = nh_add(d, dot(d, m, s->K + j * m, 1, constant, 1), s->a[j]);
    }
    for (size_t i = 0; i < r; i++) {
        for (size_t c = 0; c < r; c++) o->M[i * r + c] = dot(d, m, rho + i, r, K + c, r);
        nh_ex left = dot(d, m, rho + i, r, Kc, 1);
        rest[i] = nh_diff_along(d, left, s->n, s->x, u);
    }
    nh_free(K);
}

/* E = 1/2 u^T Kf u + V; where the constraints are affine, less c^a mu_a with constants c such that c^a e_a satisfies
 * them: the moving energy [FassoSansonetto2016].  Not known where there are no such constants, or with forces. */
static void energy(nh_reduced *o, const nh_slice *s, const nh_ex *u, const nh_ex *momentum, const double *moving)
{
    const nh_kinetic *k = s->kinetic;
    nh_dag *d = s->dag;
    nh_ex sum = s->V;
    for (size_t j = 0; j < s->m; j++)
        sum = nh_add(d, sum, nh_mul(d, nh_mul(d, nh_ratio(d, 1, 2), u[j]), dot(d, s->m, s->K + j * s->m, 1, u, 1)));
    for (size_t a = 0; a < s->d && moving; a++)
        if (moving[a] != 0) sum = nh_sub(d, sum, nh_mul(d, nh_real(d, moving[a]), momentum[s->n + a]));
    o->energy = sum;
    o->conservative = !k->forced && (k->linear || moving);
}

bool nh_reduced_master(nh_reduced *o, const nh_slice *s, const size_t *independent, nh_error *error)
{
    nh_dag *d = s->dag;
    size_t m = s->m, r = m - s->f, n = s->n;
    nh_reduced_init(o, s->kinetic, n, s->x, r, s->d);
    name_velocities(o, s, independent);
    nh_ex *rho = nh_alloc_array(m * r + 4 * m + r + 1, sizeof *rho), *u = rho + m * r, *momentum = u + m,
          *force = momentum + m, *constant = force + m, *rest = constant + m;
    double *moving = nh_alloc_array(s->d + 1, sizeof *moving);
    bool good = solve_constraints(s, independent, rho, constant, error);
    for (size_t j = 0; j < m && good; j++) u[j] = nh_add(d, dot(d, r, rho + j * r, 1, o->w, 1), constant[j]);
    for (size_t j = 0; j < m && good; j++) momentum[j] = nh_add(d, dot(d, m, s->K + j * m, 1, u, 1), s->a[j]);
    for (size_t j = 0; j < m && good; j++) force[j] = frame_force(s, j, u, momentum);
    if (good && s->kinetic->forced) nh_reduced_add_forces(s, u, force);
    if (good) momenta(o, s, rho, constant, u, rest);
    for (size_t i = 0; i < r && good; i++) {
        o->F[i] = nh_sub(d, dot(d, m, rho + i, r, force, 1), rest[i]);
        for (size_t j = 0; j < m; j++) {
            nh_ex turn = nh_diff_along(d, rho[j * r + i], n, s->x, u);
            if (!nh_is_zero(d, turn)) o->F[i] = nh_add(d, o->F[i], nh_mul(d, turn, momentum[j]));
        }
    }
    if (good) {
        memcpy(o->dx, u, n * sizeof *u);
        memcpy(o->zeta, u + n, s->d * sizeof *u);
        energy(o, s, u, momentum, !s->kinetic->linear && nh_action_moving(s->action, moving) ? moving : NULL);
        guard(o, s, independent);
    }
    nh_free(rho);
    nh_free(moving);
    return good;
}
