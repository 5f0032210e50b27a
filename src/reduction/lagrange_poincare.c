/* lagrange_poincare: the objects of the Lagrange-d'Alembert-Poincare equations (docs/method.md (26)), by elimination
 * in the graph of expressions; short results are simplified. In order: chi (vertical), I (inertia), A (orthogonal), B
 * (curvature), then v, omega, mu, Kh, pi (momenta) and dl/dx^i (slopes). */
#include "reduction/lagrange_poincare.h"

#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "reduction/reduced.h"

enum { large_length = 3000 };

static nh_ex tidy(const nh_lagrange_poincare *l, nh_ex e) { return nh_simplify_short(l->slice->dag, e, large_length); }
static nh_ex *take(nh_arena *arena, size_t n) { return nh_arena_alloc(arena, (n + 1) * sizeof(nh_ex)); }

static nh_ex plus(nh_dag *d, nh_ex sum, nh_ex a, nh_ex b)
{
    return nh_is_zero(d, a) || nh_is_zero(d, b) ? sum : nh_add(d, sum, nh_mul(d, a, b));
}

void nh_lagrange_poincare_bracket(const nh_lagrange_poincare *l, const nh_ex *xi, const nh_ex *eta, nh_ex *out)
{
    nh_dag *g = l->slice->dag;
    size_t d = l->d;
    for (size_t a = 0; a < d; a++) {
        out[a] = nh_int(g, 0);
        for (size_t b = 0; b < d; b++)
            for (size_t c = 0; c < d; c++) {
                nh_ex constant = l->slice->action->constant[(b * d + c) * d + a];
                if (!nh_is_zero(g, constant) && !nh_is_zero(g, xi[b]))
                    out[a] = plus(g, out[a], nh_mul(g, constant, xi[b]), eta[c]);
            }
    }
}

/* Which f group directions are solved for, and which span S: those that serve as velocities of the master equations
   do. */
static bool choose(const nh_slice *s, size_t *solved, size_t *free)
{
    size_t m = s->m, n = s->n, *independent = nh_alloc_array(m + 1, sizeof *independent), r = 0, f = 0;
    nh_reduced_independent(s, independent);
    for (size_t a = 0; a < s->d; a++) {
        bool kept = false;
        for (size_t i = 0; i < m - s->f; i++) kept |= independent[i] == n + a;
        if (kept) free[r++] = a;
        else solved[f++] = a;
    }
    nh_free(independent);
    return f == s->f;
}

/* chi_alpha = e_free - om_solved^-1 om_free; a solution of om_e A = om_x likewise. */
static bool vertical(nh_arena *arena, nh_lagrange_poincare *l, const size_t *solved, const size_t *free)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t f = s->f, m = s->m, n = l->n;
    nh_ex *a = take(arena, f * f), *b = take(arena, f);
    for (size_t i = 0; i < f * f; i++) a[i] = s->omega[i / f * m + n + solved[i % f]];
    nh_lu *lu = nh_lu_create(g, f, a, nh_slice_pivot_score, (void *)s, NULL);
    for (size_t i = 0; i < l->d * l->r; i++) l->chi[i] = nh_int(g, 0);
    for (size_t i = 0; i < l->d * n; i++) l->A[i] = nh_int(g, 0);
    for (size_t c = 0; c < l->r + n && lu; c++) {
        for (size_t r = 0; r < f; r++) b[r] = s->omega[r * m + (c < l->r ? n + free[c] : c - l->r)];
        nh_lu_solve(lu, b, b);
        if (c < l->r) l->chi[free[c] * l->r + c] = nh_int(g, 1);
        for (size_t r = 0; r < f; r++)
            if (c < l->r) l->chi[solved[r] * l->r + c] = tidy(l, nh_neg(g, b[r]));
            else l->A[solved[r] * n + c - l->r] = tidy(l, b[r]);
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    return good;
}

/* chi^T K_ee chi with the kinetic energy, or with an inner product of the generators. */
static void inertia(const nh_lagrange_poincare *l, const nh_ex *inner, nh_ex *out)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t n = l->n, d = l->d, r = l->r, m = s->m;
    for (size_t p = 0; p < r; p++)
        for (size_t q = 0; q < r; q++) {
            nh_ex e = nh_int(g, 0);
            for (size_t a = 0; a < d; a++)
                for (size_t b = 0; b < d; b++) {
                    nh_ex K = inner ? inner[a * d + b] : s->K[(n + a) * m + n + b];
                    if (!nh_is_zero(g, l->chi[a * r + p]))
                        e = plus(g, e, nh_mul(g, l->chi[a * r + p], K), l->chi[b * r + q]);
                }
            out[p * r + q] = tidy(l, e);
        }
}

/* chi^T (Kf_ei - Kf_ee A_i), or -chi^T g0 A_i. */
static void off_orthogonal(const nh_lagrange_poincare *l, const nh_ex *inner, size_t i, nh_ex *c)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t n = l->n, d = l->d, r = l->r, m = s->m;
    for (size_t p = 0; p < r; p++) {
        c[p] = nh_int(g, 0);
        for (size_t a = 0; a < d; a++) {
            nh_ex off = inner ? nh_int(g, 0) : s->K[(n + a) * m + i];
            for (size_t b = 0; b < d; b++)
                off = plus(g, off, nh_neg(g, inner ? inner[a * d + b] : s->K[(n + a) * m + n + b]), l->A[b * n + i]);
            c[p] = plus(g, c[p], l->chi[a * r + p], off);
        }
    }
}

/* A_i + chi c_i with I c_i = chi^T (Kf_ei - Kf_ee A_i); the same with g0 for Kf_ee and 0 for Kf_ei. */
static bool orthogonal(nh_arena *arena, nh_lagrange_poincare *l)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t n = l->n, d = l->d, r = l->r;
    nh_ex *c = take(arena, r), *I = l->lifts ? take(arena, r * r) : l->I;
    inertia(l, NULL, l->I);
    if (l->lifts) inertia(l, l->lifts, I);
    nh_lu *lu = n && r ? nh_lu_create(g, r, I, nh_slice_pivot_score, (void *)s, NULL) : NULL;
    for (size_t i = 0; i < n && lu; i++) {
        off_orthogonal(l, l->lifts, i, c);
        nh_lu_solve(lu, c, c);
        for (size_t a = 0; a < d; a++) {
            for (size_t p = 0; p < r; p++) l->A[a * n + i] = plus(g, l->A[a * n + i], l->chi[a * r + p], c[p]);
            l->A[a * n + i] = tidy(l, l->A[a * n + i]);
        }
        for (size_t p = 0; p < r; p++) l->C[i * r + p] = nh_int(g, 0);
        if (l->lifts) off_orthogonal(l, NULL, i, l->C + i * r);
        for (size_t p = 0; p < r; p++) l->C[i * r + p] = tidy(l, l->C[i * r + p]);
    }
    bool good = lu || !n || !r;
    nh_lu_free(lu);
    return good;
}

static void curvature(nh_arena *arena, nh_lagrange_poincare *l)
{
    nh_dag *g = l->slice->dag;
    size_t n = l->n, d = l->d;
    nh_ex *Ai = take(arena, 3 * d), *Aj = Ai + d, *turn = Aj + d;
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            for (size_t a = 0; a < d; a++) Ai[a] = l->A[a * n + i], Aj[a] = l->A[a * n + j];
            nh_lagrange_poincare_bracket(l, Ai, Aj, turn);
            for (size_t a = 0; a < d; a++) {
                nh_ex e = nh_sub(g, nh_diff(g, Aj[a], l->slice->x[i]), nh_diff(g, Ai[a], l->slice->x[j]));
                l->B[(a * n + i) * n + j] = i == j ? nh_int(g, 0) : tidy(l, nh_sub(g, e, turn[a]));
            }
        }
}

/* v, omega, mu, Kh, pi. */
static void momenta(nh_lagrange_poincare *l)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t n = l->n, d = l->d, m = s->m;
    for (size_t a = 0; a < d; a++) {
        l->v[a] = nh_int(g, 0);
        for (size_t p = 0; p < l->r; p++) l->v[a] = plus(g, l->v[a], l->chi[a * l->r + p], l->nu[p]);
        l->omega[a] = l->v[a];
        for (size_t i = 0; i < n; i++) l->omega[a] = plus(g, l->omega[a], nh_neg(g, l->A[a * n + i]), l->dx[i]);
    }
    for (size_t a = 0; a < d; a++) {
        l->mu[a] = nh_int(g, 0);
        for (size_t i = 0; i < n; i++) l->mu[a] = plus(g, l->mu[a], s->K[(n + a) * m + i], l->dx[i]);
        for (size_t b = 0; b < d; b++) l->mu[a] = plus(g, l->mu[a], s->K[(n + a) * m + n + b], l->omega[b]);
        l->mu[a] = tidy(l, l->mu[a]);
    }
    for (size_t i = 0; i < n; i++) {
        l->pi[i] = nh_int(g, 0);
        for (size_t j = 0; j < n; j++) {
            nh_ex e = s->K[i * m + j];
            for (size_t a = 0; a < d; a++) {
                e = plus(g, e, nh_neg(g, s->K[i * m + n + a]), l->A[a * n + j]);
                e = plus(g, e, nh_neg(g, s->K[(n + a) * m + j]), l->A[a * n + i]);
                for (size_t b = 0; b < d; b++)
                    if (!nh_is_zero(g, l->A[a * n + i]))
                        e = plus(g, e, nh_mul(g, l->A[a * n + i], s->K[(n + a) * m + n + b]), l->A[b * n + j]);
            }
            l->Kh[i * n + j] = tidy(l, e);
            l->pi[i] = plus(g, l->pi[i], l->Kh[i * n + j], l->dx[j]);
        }
        for (size_t p = 0; p < l->r; p++) l->pi[i] = plus(g, l->pi[i], l->C[i * l->r + p], l->nu[p]);
    }
}

/* 1/2 u^T d_i Kf u - mu_a d_i A^a_j x'^j - d_i V, u = (x', omega). */
static void slopes(nh_lagrange_poincare *l)
{
    const nh_slice *s = l->slice;
    nh_dag *g = s->dag;
    size_t n = l->n, m = s->m;
    for (size_t i = 0; i < n; i++) {
        nh_ex e = nh_neg(g, nh_diff(g, s->V, s->x[i])), kinetic = nh_int(g, 0);
        for (size_t p = 0; p < m; p++)
            for (size_t q = 0; q < m; q++) {
                nh_ex u = p < n ? l->dx[p] : l->omega[p - n], w = q < n ? l->dx[q] : l->omega[q - n];
                kinetic = plus(g, kinetic, nh_diff(g, s->K[p * m + q], s->x[i]), nh_mul(g, u, w));
            }
        e = nh_add(g, e, nh_mul(g, nh_ratio(g, 1, 2), kinetic));
        for (size_t a = 0; a < l->d; a++)
            for (size_t j = 0; j < n; j++)
                e = plus(g, e, nh_neg(g, nh_mul(g, l->mu[a], l->dx[j])), nh_diff(g, l->A[a * n + j], s->x[i]));
        l->slope[i] = tidy(l, e);
    }
}

nh_lagrange_poincare *nh_lagrange_poincare_of(nh_arena *arena, const nh_slice *s, const nh_ex *lifts)
{
    size_t n = s->n, d = s->d, r = d - s->f, *solved = nh_arena_alloc(arena, (2 * d + 2) * sizeof *solved),
           *free = solved + d + 1;
    if (s->f > d || !choose(s, solved, free)) return NULL;
    nh_lagrange_poincare *l = nh_arena_alloc(arena, sizeof *l);
    *l = (nh_lagrange_poincare){.slice = s,
                                .n = n,
                                .d = d,
                                .r = r,
                                .chi = take(arena, d * r),
                                .A = take(arena, d * n),
                                .B = take(arena, d * n * n),
                                .dx = take(arena, n),
                                .nu = take(arena, r),
                                .omega = take(arena, d),
                                .v = take(arena, d),
                                .Kh = take(arena, n * n),
                                .I = take(arena, r * r),
                                .C = take(arena, n * r),
                                .lifts = lifts,
                                .mu = take(arena, d),
                                .pi = take(arena, n),
                                .slope = take(arena, n)};
    for (size_t i = 0; i < n; i++) l->dx[i] = s->kinetic->v[s->shape[i]];
    for (size_t p = 0; p < r; p++) l->nu[p] = nh_symbol_fresh(s->dag, nh_arena_printf(arena, "nu_%zu", p + 1));
    if (!vertical(arena, l, solved, free) || !orthogonal(arena, l)) return NULL;
    curvature(arena, l);
    momenta(l);
    slopes(l);
    return l;
}
