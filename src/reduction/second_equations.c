/* second_equations: the equations of a second stage on a slice of the shape space (second.h). */
#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "reduction/second.h"
#include "reduction/subspace.h"

#include <string.h>

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

static nh_ex tidy(const nh_second *s, nh_ex e) { return s->slice.tidy ? nh_simplify(s->slice.dag, e) : e; }

/* I = Khat_ee, Av = I^-1 Khat_ex and Kt = Khat_xx - Av^T Khat_ex. */
static bool connection(nh_second *s)
{
    const nh_slice *c = &s->slice;
    nh_dag *d = c->dag;
    size_t n = s->n, g = s->d, m = c->m;
    nh_ex *b = nh_alloc_array(g + 1, sizeof *b);
    for (size_t a = 0; a < g * g; a++) s->inertia[a] = c->K[(n + a / g) * m + n + a % g];
    nh_lu *lu = nh_lu_create(d, g, s->inertia, nh_slice_pivot_score, &s->slice, NULL);
    for (size_t i = 0; i < n && lu; i++) {
        for (size_t a = 0; a < g; a++) b[a] = c->K[(n + a) * m + i];
        nh_lu_solve(lu, b, b);
        for (size_t a = 0; a < g; a++) s->Av[a * n + i] = tidy(s, b[a]);
    }
    for (size_t i = 0; i < n && lu; i++)
        for (size_t j = 0; j <= i; j++) { /* Av^T I Av = Av^T Khat_ex */
            nh_ex e = c->K[i * m + j];
            for (size_t a = 0; a < g; a++) e = plus(d, e, nh_neg(d, s->Av[a * n + i]), c->K[(n + a) * m + j]);
            s->Kt[i * n + j] = s->Kt[j * n + i] = tidy(s, e);
        }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(b);
    return good;
}

/* Bv^a_ij = d_i Av^a_j - d_j Av^a_i - C_bk^a Av^b_i Av^k_j. */
static void curvature(nh_second *s)
{
    nh_dag *d = s->slice.dag;
    size_t n = s->n;
    for (size_t a = 0; a < s->d; a++)
        for (size_t i = 0; i < n; i++)
            for (size_t j = 0; j <= i; j++) {
                nh_ex e =
                    nh_sub(d, nh_diff(d, s->Av[a * n + j], s->slice.x[i]), nh_diff(d, s->Av[a * n + i], s->slice.x[j]));
                for (size_t b = 0; b < s->d; b++)
                    for (size_t k = 0; k < s->d; k++) {
                        nh_ex c = s->action.constant[(b * s->d + k) * s->d + a];
                        if (!nh_is_zero(d, c))
                            e = plus(d, e, nh_neg(d, c), nh_mul(d, s->Av[b * n + i], s->Av[k * n + j]));
                    }
                e = tidy(s, e);
                s->Bv[(a * n + i) * n + j] = e;
                s->Bv[(a * n + j) * n + i] = nh_neg(d, e);
            }
}

/* The part of the force on the shape space that Khat and V do not give: that of the first stage, and the magnetic one
 * of ahat. */
static nh_ex force_of_first(const nh_chaplygin *f, const nh_kinetic *hat, size_t i)
{
    nh_dag *d = f->dag;
    nh_ex sum = f->force[i];
    for (size_t j = 0; j < f->n; j++)
        sum = plus(d, sum, nh_sub(d, nh_diff(d, f->a[j], f->slice->x[i]), nh_diff(d, f->a[i], f->slice->x[j])),
                   hat->v[j]);
    return sum;
}

/* g_r = Fr^i_r force_i(xhat, xhat') on the slice, xhat' = Fr (x', zeta). */
static void gyroscopic(const nh_second *s, const nh_ex *u, nh_ex *g)
{
    const nh_slice *c = &s->slice;
    nh_dag *d = c->dag;
    size_t m = c->m, n = c->n;
    nh_ex *speed = nh_alloc_array(4 * m + 2 * s->d + 1, sizeof *speed), *force = speed + m, *from = force + m,
          *to = from + m + s->d;
    for (size_t i = 0; i < m; i++) speed[i] = nh_int(d, 0);
    for (size_t i = 0; i < n; i++) speed[c->shape[i]] = u[i];
    for (size_t i = 0; i < m; i++)
        for (size_t a = 0; a < s->d; a++) speed[i] = plus(d, speed[i], c->E[i * s->d + a], u[n + a]);
    for (size_t a = 0; a < s->d; a++) {
        from[a] = s->hat->q[c->along[a]];
        to[a] = c->y[a];
    }
    memcpy(from + s->d, s->hat->v, m * sizeof *from);
    memcpy(to + s->d, speed, m * sizeof *to);
    for (size_t i = 0; i < m; i++) force[i] = nh_substitute(d, force_of_first(s->first, s->hat, i), s->d + m, from, to);
    for (size_t i = 0; i < n; i++) g[i] = force[c->shape[i]];
    for (size_t a = 0; a < s->d; a++) {
        g[n + a] = nh_int(d, 0);
        for (size_t i = 0; i < m; i++) g[n + a] = plus(d, g[n + a], c->E[i * s->d + a], force[i]);
    }
    nh_free(speed);
}

void nh_second_form(const nh_second *s, size_t count, nh_ex *out)
{
    const nh_slice *c = &s->slice;
    nh_dag *d = c->dag;
    size_t m = c->m, n = c->n, cube = m * m * m;
    nh_ex *h = nh_alloc_array(m * m + cube + s->d + 1, sizeof *h), *U = h + m * m, *from = U + cube;
    for (size_t a = 0; a < s->d; a++) from[a] = s->hat->q[c->along[a]];
    for (size_t i = 0; i < cube; i++) U[i] = nh_substitute(d, s->first->U[i], s->d, from, c->y);
    for (size_t r = 0; r < m; r++)
        for (size_t i = 0; i < count; i++) {
            h[r * m + i] = i < n ? nh_int(d, c->shape[i] == r) : c->E[r * s->d + i - n];
            for (size_t a = 0; a < s->d && i < n; a++)
                h[r * m + i] = plus(d, h[r * m + i], nh_neg(d, c->E[r * s->d + a]), s->Av[a * n + i]);
        }
    for (size_t at = 0; at < count * count * count; at++) {
        size_t k = at / (count * count), i = at / count % count, j = at % count;
        out[at] = nh_int(d, 0);
        for (size_t r = 0; r < cube; r++) {
            size_t a = r / (m * m), b = r / m % m, e = r % m;
            if (!nh_is_zero(d, U[r]))
                out[at] = plus(d, out[at], nh_mul(d, U[r], h[a * m + k]), nh_mul(d, h[b * m + i], h[e * m + j]));
        }
    }
    nh_free(h);
}

static void names(nh_second *s)
{
    nh_reduced *o = &s->reduced;
    const nh_kinetic *k = s->first->slice->kinetic;
    for (size_t i = 0; i < s->n; i++) {
        size_t c = s->slice.shape[i];
        o->w[i] = o->dx[i] = s->hat->v[c];
        o->momentum[i] = nh_kinetic_unused_name(k, "p_%s", s->hat->name[c]);
    }
    for (size_t a = 0; a < s->d; a++) {
        o->w[s->n + a] = nh_symbol_fresh(s->slice.dag, nh_kinetic_unused_name(k, "v%zu", a + 1));
        o->momentum[s->n + a] = nh_kinetic_unused_name(k, "m_%zu", a + 1);
    }
}

/* The force on pt_i: without the gyroscopic form of the first stage. */
static nh_ex shape_force(const nh_second *s, size_t i, const nh_ex *momentum)
{
    const nh_reduced *o = &s->reduced;
    nh_dag *d = s->slice.dag;
    size_t n = s->n, dim = s->d;
    nh_ex x = s->slice.x[i], sum = nh_neg(d, nh_diff(d, s->slice.V, x)), half = nh_ratio(d, 1, 2);
    for (size_t a = 0; a < n; a++)
        for (size_t b = 0; b < n; b++)
            sum = plus(d, sum, nh_mul(d, half, nh_diff(d, s->Kt[a * n + b], x)), nh_mul(d, o->w[a], o->w[b]));
    for (size_t a = 0; a < dim; a++) {
        for (size_t b = 0; b < dim; b++)
            sum = plus(d, sum, nh_mul(d, half, nh_diff(d, s->inertia[a * dim + b], x)),
                       nh_mul(d, o->w[n + a], o->w[n + b]));
        for (size_t j = 0; j < n; j++) sum = plus(d, sum, s->Bv[(a * n + i) * n + j], nh_mul(d, momentum[a], o->w[j]));
        for (size_t l = 0; l < dim; l++)
            for (size_t k = 0; k < dim; k++) {
                nh_ex c = s->action.constant[(l * dim + k) * dim + a];
                if (!nh_is_zero(d, c))
                    sum = plus(d, sum, nh_mul(d, c, s->Av[l * n + i]), nh_mul(d, momentum[a], o->w[n + k]));
            }
    }
    return sum;
}

/* The slice of the shape space, and the first stage's connection on it. */
static void guard(nh_second *s)
{
    const nh_reduced *first = &s->first->reduced;
    nh_reduced *o = &s->reduced;
    nh_guard *g = &o->guard[0];
    size_t d = s->d, n = first->guard[0].rows * first->guard[0].columns;
    nh_ex *from = nh_alloc_array(d + 1, sizeof *from);
    for (size_t a = 0; a < d; a++) from[a] = s->hat->q[s->slice.along[a]];
    nh_reduced_guard_slice(o, &s->slice);
    *g = first->guard[0];
    g->e = nh_arena_alloc(s->hat->arena, (n + 1) * sizeof *g->e);
    for (size_t i = 0; i < n; i++) g->e[i] = nh_substitute(s->slice.dag, first->guard[0].e[i], d, from, s->slice.y);
    nh_free(from);
}

static void equations(nh_second *s)
{
    nh_reduced *o = &s->reduced;
    nh_dag *d = s->slice.dag;
    size_t n = s->n, dim = s->d, r = n + dim;
    nh_reduced_init(o, s->hat, n, s->slice.x, r, dim);
    names(s);
    nh_ex *u = nh_alloc_array(2 * r + dim + 1, sizeof *u), *ups = u + r, *momentum = ups + r;
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++)
            o->M[i * r + j] = i < n && j < n     ? s->Kt[i * n + j]
                              : i >= n && j >= n ? s->inertia[(i - n) * dim + j - n]
                                                 : nh_int(d, 0);
    for (size_t i = 0; i < n; i++) u[i] = o->w[i];
    for (size_t a = 0; a < dim; a++) {
        o->zeta[a] = o->w[n + a];
        for (size_t i = 0; i < n; i++) o->zeta[a] = plus(d, o->zeta[a], nh_neg(d, s->Av[a * n + i]), o->w[i]);
        u[n + a] = o->zeta[a];
        momentum[a] = nh_int(d, 0);
        for (size_t b = 0; b < dim; b++) momentum[a] = plus(d, momentum[a], s->inertia[a * dim + b], o->w[n + b]);
    }
    gyroscopic(s, u, ups);
    for (size_t i = 0; i < n; i++) {
        o->F[i] = nh_add(d, shape_force(s, i, momentum), ups[i]);
        for (size_t a = 0; a < dim; a++) o->F[i] = plus(d, o->F[i], nh_neg(d, s->Av[a * n + i]), ups[n + a]);
    }
    /* of ahat: with it m_b + ahat(e_b) is conserved */
    for (size_t b = 0; b < dim && !s->first->plain; b++) o->F[n + b] = ups[n + b];
    for (size_t b = 0; b < dim; b++)
        for (size_t a = 0; a < dim; a++)
            for (size_t k = 0; k < dim; k++) {
                nh_ex c = s->action.constant[(a * dim + b) * dim + k];
                if (!nh_is_zero(d, c)) o->F[n + b] = plus(d, o->F[n + b], nh_mul(d, c, o->zeta[a]), momentum[k]);
            }
    guard(s);
    o->conservative = s->first->reduced.conservative;
    o->energy = s->slice.V;
    for (size_t i = 0; i < r; i++)
        for (size_t j = 0; j < r; j++)
            o->energy = plus(d, o->energy, nh_mul(d, nh_ratio(d, 1, 2), o->M[i * r + j]), nh_mul(d, o->w[i], o->w[j]));
    nh_free(u);
}

/* rank of C_ab^k m_k at a generic m. */
static size_t orbit_dimension(const nh_algebra *g)
{
    size_t d = g->d;
    double *a = nh_alloc_array(d * d + 1, sizeof *a), *u = nh_alloc_array(d * d + 1, sizeof *u);
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++)
            for (size_t k = 0; k < d; k++)
                a[i + j * d] += g->c[(i * d + j) * d + k] * (0.7 + 0.31 * (double)k * (double)(k + 1));
    size_t rank = nh_span(d, d, a, 1e-9, u);
    nh_free(a);
    nh_free(u);
    return rank;
}

bool nh_second_equations(nh_second *s, const size_t *shape, const size_t *along, const double *y0, nh_error *error)
{
    nh_arena *arena = s->hat->arena;
    size_t n = s->n, d = s->d;
    nh_slice_init(&s->slice, &s->action, shape, along, y0);
    s->slice.pivots = s->pivots;
    s->inertia = nh_arena_alloc(arena, (d * d + d * n + n * n + d * n * n + n * n * n + 1) * sizeof *s->inertia);
    s->Av = s->inertia + d * d;
    s->Kt = s->Av + d * n;
    s->Bv = s->Kt + n * n;
    s->U = s->Bv + d * n * n;
    if (!connection(s)) return nh_fail(error, NH_NUMERIC, "", "the locked inertia of the second group is singular");
    curvature(s);
    nh_second_form(s, n, s->U);
    equations(s);
    s->orbit = orbit_dimension(&s->action.algebra);
    return true;
}
