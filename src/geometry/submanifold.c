/* submanifold: forms, Euler expressions and matrices from the model, by exact derivatives. */
#include "geometry/submanifold.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

enum { large_length = 3000 }; /* nh_complexity: longer formulas are not simplified */

static nh_ex tidy(const nh_model *o, nh_ex e) { return nh_simplify_short(o->dag, e, large_length); }
static nh_ex *take(nh_arena *arena, size_t n) { return nh_arena_alloc(arena, (n + 1) * sizeof(nh_ex)); }

/* phi^a = N^-1 nu (dq - rho dt), N: the columns of nu that belong to the dependent velocities. */
static void normal_forms(nh_arena *arena, nh_submanifold *s, const size_t *dependent)
{
    const nh_model *o = s->model;
    nh_dag *d = o->dag;
    size_t k = o->k, m = o->m;
    nh_ex *N = take(arena, k * k), *column = take(arena, k);
    for (size_t a = 0; a < k; a++)
        for (size_t b = 0; b < k; b++) N[a * k + b] = o->nu[a * m + dependent[b]];
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, o->chart, NULL);
    for (size_t c = 0; c <= m && lu; c++) {
        for (size_t a = 0; a < k; a++) {
            nh_ex e = c ? o->nu[a * m + c - 1] : nh_int(d, 0);
            for (size_t r = 0; r < m && !c; r++) e = nh_sub(d, e, nh_mul(d, o->nu[a * m + r], o->rho[r]));
            column[a] = e;
        }
        nh_lu_solve(lu, column, column);
        for (size_t a = 0; a < k; a++) s->form[a * (1 + m) + c] = tidy(o, column[a]);
    }
    for (size_t a = 0; a < k; a++)
        for (size_t r = 0; r < m; r++) s->across[a * m + r] = nh_int(d, dependent[a] == r);
    nh_lu_free(lu);
}

/* Where no velocities are dependent: phi^a = nu^a (dq - rho dt) and V = nu^T (nu nu^T)^-1. */
static void plain_forms(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *o = s->model;
    nh_dag *d = o->dag;
    size_t k = o->k, m = o->m;
    nh_ex *N = take(arena, k * k), *unit = take(arena, k);
    for (size_t a = 0; a < k; a++) {
        nh_ex time = nh_int(d, 0);
        for (size_t r = 0; r < m; r++) {
            s->form[a * (1 + m) + 1 + r] = o->nu[a * m + r];
            time = nh_sub(d, time, nh_mul(d, o->nu[a * m + r], o->rho[r]));
        }
        s->form[a * (1 + m)] = tidy(o, time);
        for (size_t b = 0; b < k; b++) {
            N[a * k + b] = nh_int(d, 0);
            for (size_t r = 0; r < m; r++)
                N[a * k + b] = nh_add(d, N[a * k + b], nh_mul(d, o->nu[a * m + r], o->nu[b * m + r]));
        }
    }
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, o->chart, NULL);
    for (size_t a = 0; a < k && lu; a++) {
        for (size_t b = 0; b < k; b++) unit[b] = nh_int(d, a == b);
        nh_lu_solve(lu, unit, unit);
        for (size_t r = 0; r < m; r++) {
            nh_ex e = nh_int(d, 0);
            for (size_t b = 0; b < k; b++) e = nh_add(d, e, nh_mul(d, o->nu[b * m + r], unit[b]));
            s->across[a * m + r] = tidy(o, e);
        }
    }
    nh_lu_free(lu);
}

static void euler_expressions(nh_submanifold *s, const size_t *dependent)
{
    const nh_model *o = s->model;
    nh_dag *d = o->dag;
    size_t n = o->n;
    for (size_t l = 0; l < n; l++) {
        s->force[l] = tidy(o, nh_sub(d, nh_model_X(o, l, o->Lbar), nh_model_X0(o, o->pbar[l])));
        for (size_t r = 0; r < n; r++) s->inertia[l * n + r] = tidy(o, nh_model_Y(o, r, o->pbar[l]));
        for (size_t a = 0; a < o->k && s->normal; a++) {
            size_t y = dependent[a];
            nh_ex slope = o->R[y * n + l];
            s->slope[a * n + l] = tidy(o, slope);
            s->turn[a * n + l] = tidy(o, nh_sub(d, nh_model_X(o, l, o->rho[y]), nh_model_X0(o, slope)));
            for (size_t r = 0; r < n; r++) s->bend[(a * n + l) * n + r] = tidy(o, nh_model_Y(o, r, slope));
        }
    }
}

static void inverse(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *o = s->model;
    size_t n = o->n;
    nh_ex *column = take(arena, n);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) column[i] = nh_int(o->dag, -(int64_t)(i == j));
        nh_lu_solve(o->M_lu, column, column);
        for (size_t i = 0; i < n; i++) s->inverse[i * n + j] = tidy(o, column[i]);
    }
}

/* The matrices in all velocities, before the constraints are imposed. */
static void unconstrained(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *o = s->model;
    nh_dag *d = o->dag;
    const nh_system *y = o->system;
    size_t m = o->m;
    nh_ex *p = take(arena, m);
    for (size_t i = 0; i < m; i++) p[i] = nh_diff(d, y->lagrangian, y->coordinate[i].v);
    for (size_t i = 0; i < m; i++) {
        nh_ex rate = nh_diff(d, p[i], y->t);
        for (size_t r = 0; r < m; r++) {
            rate = nh_add(d, rate, nh_mul(d, y->coordinate[r].v, nh_diff(d, p[i], y->coordinate[r].q)));
            s->free_B[i * m + r] = tidy(o, nh_neg(d, nh_diff(d, p[i], y->coordinate[r].v)));
        }
        s->free_A[i] = tidy(o, nh_sub(d, nh_add(d, nh_diff(d, y->lagrangian, y->coordinate[i].q), y->force[i]), rate));
        for (size_t a = 0; a < o->k; a++)
            s->f_v[a * m + i] = tidy(o, nh_diff(d, nh_chart_constraint(o->chart, a), y->coordinate[i].v));
    }
}

nh_submanifold *nh_submanifold_of(nh_arena *arena, const nh_model *o, const size_t *dependent)
{
    size_t m = o->m, n = o->n, k = o->k;
    nh_submanifold *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_submanifold){.model = o,
                          .normal = k && !o->chart->quasi,
                          .form = take(arena, k * (1 + m)),
                          .across = take(arena, k * m),
                          .slope = take(arena, k * n),
                          .turn = take(arena, k * n),
                          .bend = take(arena, k * n * n),
                          .force = take(arena, n),
                          .inertia = take(arena, n * n),
                          .inverse = take(arena, n * n),
                          .free_A = take(arena, m),
                          .free_B = take(arena, m * m),
                          .f_v = take(arena, k * m)};
    const size_t *chosen = dependent ? dependent : s->normal ? o->chart->dependent : NULL;
    if (k && chosen) normal_forms(arena, s, chosen);
    else if (k) plain_forms(arena, s);
    euler_expressions(s, o->chart->dependent);
    inverse(arena, s);
    unconstrained(arena, s);
    return s;
}
