/* submanifold: forms, Euler expressions and matrices from the model, by exact derivatives. */
#include "geometry/submanifold.h"

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"

enum { large_length = 3000 }; /* nh_complexity: longer formulas are not simplified */

static nh_ex tidy(const nh_model *model, nh_ex e) { return nh_simplify_short(model->dag, e, large_length); }
static nh_ex *take(nh_arena *arena, size_t n) { return nh_arena_alloc(arena, (n + 1) * sizeof(nh_ex)); }

/* phi^a = N^-1 nu (dq - rho dt), N: the columns of nu that belong to the dependent velocities. */
static void normal_forms(nh_arena *arena, nh_submanifold *s, const size_t *dependent)
{
    const nh_model *model = s->model;
    nh_dag *d = model->dag;
    size_t k = model->k, m = model->m;
    nh_ex *N = take(arena, k * k), *column = take(arena, k);
    for (size_t a = 0; a < k; a++)
        for (size_t b = 0; b < k; b++) N[a * k + b] = model->nu[a * m + dependent[b]];
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, model->chart, NULL);
    for (size_t c = 0; c <= m && lu; c++) {
        for (size_t a = 0; a < k; a++) {
            nh_ex e = c ? model->nu[a * m + c - 1] : nh_int(d, 0);
            for (size_t r = 0; r < m && !c; r++) e = nh_sub(d, e, nh_mul(d, model->nu[a * m + r], model->rho[r]));
            column[a] = e;
        }
        nh_lu_solve(lu, column, column);
        for (size_t a = 0; a < k; a++) s->form[a * (1 + m) + c] = tidy(model, column[a]);
    }
    for (size_t a = 0; a < k; a++)
        for (size_t r = 0; r < m; r++) s->across[a * m + r] = nh_int(d, dependent[a] == r);
    nh_lu_free(lu);
}

/* Where no velocities are dependent: phi^a = nu^a (dq - rho dt) and V = nu^T (nu nu^T)^-1. */
static void plain_forms(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *model = s->model;
    nh_dag *d = model->dag;
    size_t k = model->k, m = model->m;
    nh_ex *N = take(arena, k * k), *unit = take(arena, k);
    for (size_t a = 0; a < k; a++) {
        nh_ex time = nh_int(d, 0);
        for (size_t r = 0; r < m; r++) {
            s->form[a * (1 + m) + 1 + r] = model->nu[a * m + r];
            time = nh_sub(d, time, nh_mul(d, model->nu[a * m + r], model->rho[r]));
        }
        s->form[a * (1 + m)] = tidy(model, time);
        for (size_t b = 0; b < k; b++) {
            N[a * k + b] = nh_int(d, 0);
            for (size_t r = 0; r < m; r++)
                N[a * k + b] = nh_add(d, N[a * k + b], nh_mul(d, model->nu[a * m + r], model->nu[b * m + r]));
        }
    }
    nh_lu *lu = nh_lu_create(d, k, N, nh_chart_pivot_score, model->chart, NULL);
    for (size_t a = 0; a < k && lu; a++) {
        for (size_t b = 0; b < k; b++) unit[b] = nh_int(d, a == b);
        nh_lu_solve(lu, unit, unit);
        for (size_t r = 0; r < m; r++) {
            nh_ex e = nh_int(d, 0);
            for (size_t b = 0; b < k; b++) e = nh_add(d, e, nh_mul(d, model->nu[b * m + r], unit[b]));
            s->across[a * m + r] = tidy(model, e);
        }
    }
    nh_lu_free(lu);
}

/* eps'_l(Lbar) = X_l(Lbar) - X_0(pbar_l) and Y_r(pbar_l), (n and n x n); of a chart of coordinate velocities also
 * g^a_l = R^y_l, eps'_l(g^a) = X_l(g^a) - X_0(g^a_l) and g^a_lr, y the coordinate of the dependent velocity a.
 * [CechMusilova2014, eq. 8] */
static void euler_expressions(nh_submanifold *s, const size_t *dependent)
{
    const nh_model *model = s->model;
    nh_dag *d = model->dag;
    size_t n = model->n;
    for (size_t l = 0; l < n; l++) {
        s->force[l] = tidy(model, nh_sub(d, nh_model_X(model, l, model->Lbar), nh_model_X0(model, model->pbar[l])));
        for (size_t r = 0; r < n; r++) s->inertia[l * n + r] = tidy(model, nh_model_Y(model, r, model->pbar[l]));
        for (size_t a = 0; a < model->k && s->normal; a++) {
            size_t y = dependent[a];
            nh_ex slope = model->R[y * n + l];
            s->slope[a * n + l] = tidy(model, slope);
            s->turn[a * n + l] = tidy(model, nh_sub(d, nh_model_X(model, l, model->rho[y]), nh_model_X0(model, slope)));
            for (size_t r = 0; r < n; r++) s->bend[(a * n + l) * n + r] = tidy(model, nh_model_Y(model, r, slope));
        }
    }
}

/* Bbar = -M, so its inverse is n solutions of M x = -e_j. */
static void inverse(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *model = s->model;
    size_t n = model->n;
    nh_ex *column = take(arena, n);
    for (size_t j = 0; j < n; j++) {
        for (size_t i = 0; i < n; i++) column[i] = nh_int(model->dag, -(int64_t)(i == j));
        nh_lu_solve(model->M_lu, column, column);
        for (size_t i = 0; i < n; i++) s->inverse[i * n + j] = tidy(model, column[i]);
    }
}

/* The matrices in all velocities, before the constraints are imposed. */
static void unconstrained(nh_arena *arena, nh_submanifold *s)
{
    const nh_model *model = s->model;
    nh_dag *d = model->dag;
    const nh_system *system = model->system;
    size_t m = model->m;
    nh_ex *p = take(arena, m);
    for (size_t i = 0; i < m; i++) p[i] = nh_diff(d, system->lagrangian, system->coordinate[i].v);
    for (size_t i = 0; i < m; i++) {
        nh_ex rate = nh_diff(d, p[i], system->t);
        for (size_t r = 0; r < m; r++) {
            rate = nh_add(d, rate, nh_mul(d, system->coordinate[r].v, nh_diff(d, p[i], system->coordinate[r].q)));
            s->free_B[i * m + r] = tidy(model, nh_neg(d, nh_diff(d, p[i], system->coordinate[r].v)));
        }
        s->free_A[i] =
            tidy(model,
                 nh_sub(d, nh_add(d, nh_diff(d, system->lagrangian, system->coordinate[i].q), system->force[i]), rate));
        for (size_t a = 0; a < model->k; a++)
            s->f_v[a * m + i] = tidy(model, nh_diff(d, nh_chart_constraint(model->chart, a), system->coordinate[i].v));
    }
}

nh_submanifold *nh_submanifold_of(nh_arena *arena, const nh_model *model, const size_t *dependent)
{
    size_t m = model->m, n = model->n, k = model->k;
    nh_submanifold *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_submanifold){.model = model,
                          .normal = k && !model->chart->quasi,
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
    const size_t *chosen = dependent ? dependent : s->normal ? model->chart->dependent : NULL;
    if (k && chosen) normal_forms(arena, s, chosen);
    else if (k) plain_forms(arena, s);
    euler_expressions(s, model->chart->dependent);
    inverse(arena, s);
    unconstrained(arena, s);
    return s;
}
