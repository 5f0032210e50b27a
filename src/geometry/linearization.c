/* linearization: expressions once for a system, then balls for every state.
 *
 *     terms, derivatives       K, h, F, g, f, P and their derivatives, as expressions of t, q, v, a, mu
 *     nh_linear_start          a state on the constraints            (linearization_state.c)
 *     nh_linear_matrices       R, S, T, M, C, N, A at this state     (linearization_matrices.c)
 *     close_equations          coordinates on which nothing depends are left out
 *     nh_ball_spectrum         eigenvalues of what is left
 *     changes                  is the matrix the same along the motion? */
#include "geometry/linearization.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "exact/walls.h"
#include "geometry/bordered.h"
#include "geometry/linearization_internal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/num.h"

/* ---- expressions ---- */

static nh_ex *take(nh_linearization *l, size_t count) { return nh_arena_alloc(l->arena, (count + 1) * sizeof(nh_ex)); }

/* out[i*m + j] = d e_i/d symbol_j. */
static void jacobian(nh_linearization *l, size_t rows, const nh_ex *e, const nh_ex *symbol, nh_ex *out)
{
    for (size_t i = 0; i < rows; i++) nh_gradient(l->dag, e[i], l->m, symbol, out + i * l->m);
}

static void transpose(size_t rows, size_t columns, const nh_ex *by_columns, nh_ex *out)
{
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < columns; j++) out[i * columns + j] = by_columns[i + j * rows];
}

/* K, F (transposed: here row by row), h, g, f of geometry/bordered.h, and P, P_q of the constraints between
 * positions. */
static void terms(nh_linearization *l)
{
    size_t m = l->m, k = l->k;
    nh_chart chart = {.system = l->system};
    nh_model model = {.system = l->system, .chart = &chart, .dag = l->dag, .arena = l->arena, .m = m, .k = k};
    nh_ex *K = take(l, m * m), *F = take(l, k * m);
    l->K = take(l, m * m), l->h = take(l, m), l->F = take(l, k * m), l->g = take(l, k), l->f = take(l, k);
    nh_system_bindings(l->system, &model.parameter, &model.parameter_value);
    nh_bordered_expressions(&model, K, l->h, F, l->g, l->f);
    transpose(m, m, K, l->K);
    transpose(k, m, F, l->F);
    l->P = take(l, k), l->P_q = take(l, k * m);
    for (size_t a = 0; a < k; a++)
        if (l->system->constraint[a].position) l->P[l->p++] = l->system->constraint[a].level;
    jacobian(l, l->p, l->P, l->q, l->P_q);
}

/* The balance K a + h + F^T mu (m) and the differentiated constraints F a + g (k), with a and mu as symbols of their
 * own: d_q, d_v, c_q, c_v are derivatives at constant a and mu. */
static void derivatives(nh_linearization *l)
{
    nh_dag *d = l->dag;
    size_t m = l->m, k = l->k;
    nh_ex *balance = take(l, m + k), *kept = balance + m;
    for (size_t i = 0; i < m; i++) {
        balance[i] = l->h[i];
        for (size_t j = 0; j < m; j++) balance[i] = nh_add(d, balance[i], nh_mul(d, l->K[i * m + j], l->a[j]));
        for (size_t c = 0; c < k; c++) balance[i] = nh_add(d, balance[i], nh_mul(d, l->F[c * m + i], l->mu[c]));
    }
    for (size_t c = 0; c < k; c++) {
        kept[c] = l->g[c];
        for (size_t j = 0; j < m; j++) kept[c] = nh_add(d, kept[c], nh_mul(d, l->F[c * m + j], l->a[j]));
    }
    l->B = take(l, k * m), l->d_q = take(l, m * m), l->d_v = take(l, m * m), l->c_q = take(l, k * m);
    l->c_v = take(l, k * m);
    jacobian(l, k, l->f, l->q, l->B);
    jacobian(l, m, balance, l->q, l->d_q);
    jacobian(l, m, balance, l->v, l->d_v);
    jacobian(l, k, kept, l->q, l->c_q);
    jacobian(l, k, kept, l->v, l->c_v);
    l->wall = take(l, NH_MOST_WALLS);
    nh_ex *in = take(l, 2 * m);
    memcpy(in, l->q, m * sizeof *in);
    memcpy(in + m, l->v, m * sizeof *in);
    l->walls = nh_walls_between(d, m + k, balance, 2 * m, in, l->wall);
}

nh_linearization *nh_linearization_create(nh_system *system)
{
    nh_arena *arena = nh_arena_create();
    nh_linearization *l = nh_arena_alloc(arena, sizeof *l);
    *l = (nh_linearization){
        .system = system, .dag = system->dag, .arena = arena, .m = system->coordinates, .k = system->constraints};
    l->q = take(l, l->m), l->v = take(l, l->m), l->a = take(l, l->m), l->mu = take(l, l->k);
    for (size_t i = 0; i < l->m; i++) {
        l->q[i] = system->coordinate[i].q;
        l->v[i] = system->coordinate[i].v;
        l->a[i] = nh_symbol_fresh(l->dag, nh_arena_printf(arena, "%s''", system->coordinate[i].name));
    }
    for (size_t c = 0; c < l->k; c++) l->mu[c] = nh_symbol_fresh(l->dag, nh_arena_printf(arena, "mu_%zu", c + 1));
    terms(l);
    derivatives(l);
    return l;
}

void nh_linearization_free(nh_linearization *l)
{
    if (l) nh_arena_free(l->arena);
}

/* ---- the closed rest ---- */

/* Leaves out coordinates whose columns vanish in all rows that are left. */
static void close_equations(const nh_linear_work *w, nh_linear_equations *e)
{
    double scale = nh_linear_largest(w->A);
    for (size_t i = 0; i < e->s + e->n; i++) e->closed[i] = true;
    for (bool found = true; found;) {
        found = false;
        for (size_t j = 0; j < e->s; j++) {
            bool needed = !e->closed[j];
            for (size_t i = 0; i < e->s + e->n && !needed; i++)
                needed = e->closed[i] && !nh_linear_vanishes(arb_mat_entry(w->A, i, j), scale);
            if (needed) continue;
            e->closed[j] = false;
            found = true;
        }
    }
    for (size_t i = 0; i < e->s + e->n; i++) e->size += e->closed[i];
}

/* The rows and columns of A that are left, size x size. */
static void closed_matrix(const nh_linear_work *w, const nh_linear_equations *e, arb_mat_t out)
{
    size_t row = 0;
    arb_mat_init(out, (slong)e->size, (slong)e->size);
    for (size_t i = 0; i < e->s + e->n; i++) {
        if (!e->closed[i]) continue;
        size_t column = 0;
        for (size_t j = 0; j < e->s + e->n; j++)
            if (e->closed[j]) arb_set(arb_mat_entry(out, row, column++), arb_mat_entry(w->A, i, j));
        row++;
    }
}

/* The rate of entry i of (x, w). */
static arb_srcptr rate(const nh_linear_work *w, const nh_linear_equations *e, size_t i)
{
    return i < e->s ? w->v + e->position[i] : w->a + e->velocity[i - e->s];
}

/* The largest rate among (x, w) that are left: 0 of a steady motion. */
static double largest_rate(const nh_linear_work *w, const nh_linear_equations *e)
{
    double largest = 0;
    for (size_t i = 0; i < e->s + e->n; i++)
        if (e->closed[i] && !nh_linear_vanishes(rate(w, e, i), 1))
            largest = fmax(largest, fabs(arf_get_d(arb_midref(rate(w, e, i)), ARF_RND_NEAR)));
    return largest;
}

/* Another state of a steady motion: time and the coordinates that are left out move on by tau. */
static bool move_on(nh_linear_work *w, const nh_linear_equations *e, const arb_srcptr q, double tau)
{
    size_t m = w->l->m;
    bool *free = nh_alloc_array(m + 1, sizeof *free);
    double step;
    arb_t t;
    arb_init(t);
    arb_set_d(t, tau);
    arb_add(w->t, w->begin, t, w->bits);
    nh_ball_set_arb(w->ball, w->l->system->t, w->t);
    for (size_t i = 0; i < m; i++) free[i] = true;
    for (size_t i = 0; i < e->s; i++) free[e->position[i]] = !e->closed[i];
    for (size_t i = 0; i < m; i++) {
        arb_set(w->q + i, q + i);
        if (free[i]) arb_addmul(w->q + i, t, w->v + i, w->bits);
        arb_get_mid_arb(w->q + i, w->q + i);
    }
    arb_clear(t);
    bool good = nh_linear_positions(w, free, &step) && nh_linear_dependent_velocities(w);
    nh_free(free);
    return good;
}

/* Is the closed part of A another one there, or are its rates? */
static bool changed(nh_linear_work *w, const nh_linear_equations *e, const arb_mat_t at_first)
{
    static const double least = 1e-25;
    nh_error ignored = {0};
    arb_mat_t here;
    if (!nh_linear_matrices(w, &ignored)) return false;
    closed_matrix(w, e, here);
    double scale = nh_linear_largest(at_first);
    arb_mat_sub(here, here, at_first, w->bits);
    bool other = nh_linear_largest(here) > least * scale || largest_rate(w, e) > least;
    arb_mat_clear(here);
    return other;
}

/* Compares with the states of the motion at two other times, of both signs and without a common period. */
static bool changes(nh_linear_work *w, const nh_linear_equations *e, const arb_mat_t at_first)
{
    static const double times[] = {0.375, -1.125};
    size_t m = w->l->m;
    bool other = false;
    arb_ptr q = _arb_vec_init((slong)m), v = _arb_vec_init((slong)m);
    _arb_vec_set(q, w->q, (slong)m);
    _arb_vec_set(v, w->v, (slong)m);
    for (size_t i = 0; i < 2 && !other; i++) {
        _arb_vec_set(w->v, v, (slong)m);
        other = move_on(w, e, q, times[i]) && changed(w, e, at_first);
    }
    _arb_vec_clear(v, (slong)m);
    _arb_vec_clear(q, (slong)m);
    return other;
}

/* ---- the answer ---- */

static double *doubles(size_t count) { return nh_alloc_array(count + 1, sizeof(double)); }

/* The mid-points of A, row by row, and what balls and rounding to double add to the error. */
static double *numbers(nh_linear_equations *e, const arb_mat_t A)
{
    size_t rows = (size_t)arb_mat_nrows(A), columns = (size_t)arb_mat_ncols(A);
    double *out = doubles(rows * columns), scale = nh_linear_largest(A);
    for (size_t i = 0; i < rows * columns; i++) {
        arb_srcptr x = arb_mat_entry(A, i / columns, i % columns);
        if (!nh_linear_vanishes(x, scale)) out[i] = arf_get_d(arb_midref(x), ARF_RND_NEAR);
        e->error = fmax(e->error, mag_get_d(arb_radref(x)) + ldexp(fabs(out[i]), -DBL_MANT_DIG));
    }
    return out;
}

static double *vector(size_t count, arb_srcptr x)
{
    double *out = doubles(count);
    for (size_t i = 0; i < count; i++)
        if (!nh_linear_vanishes(x + i, 1)) out[i] = arf_get_d(arb_midref(x + i), ARF_RND_NEAR);
    return out;
}

static void fill(const nh_linear_work *w, nh_linear_equations *e)
{
    size_t m = e->m = w->l->m, k = e->k = w->l->k;
    e->n = w->n, e->s = w->s;
    e->velocity = nh_alloc_array(e->n + 1, sizeof *e->velocity);
    e->position = nh_alloc_array(e->s + 1, sizeof *e->position);
    memcpy(e->velocity, w->dependent + k, e->n * sizeof *e->velocity);
    memcpy(e->position, w->fixed + (m - e->s), e->s * sizeof *e->position);
    e->t = arf_get_d(arb_midref(w->begin), ARF_RND_NEAR);
    e->q = vector(m, w->q), e->v = vector(m, w->v), e->a = vector(m, w->a);
    e->M = numbers(e, w->M), e->C = numbers(e, w->C), e->N = numbers(e, w->N), e->A = numbers(e, w->A);
    e->R = numbers(e, w->R), e->S = numbers(e, w->S), e->T = numbers(e, w->T);
    e->closed = nh_alloc_array(e->s + e->n + 1, sizeof *e->closed);
    e->eigenvalue = nh_alloc_array(e->s + e->n + 1, sizeof *e->eigenvalue);
}

/* What is closed, its eigenvalues, whether the motion is steady, and whether the answer is the same at its other
 * states. */
static void decide(nh_linear_work *w, nh_linear_equations *e)
{
    arb_mat_t closed;
    close_equations(w, e);
    closed_matrix(w, e, closed);
    e->eigenvalues = nh_ball_spectrum(closed, w->bits, e->eigenvalue);
    e->residual = largest_rate(w, e);
    for (size_t i = 0; i < e->m; i++) e->moves |= e->residual == 0 && e->v[i] != 0;
    e->changes = changes(w, e, closed);
    arb_mat_clear(closed);
}

static void set_parameters(nh_linear_work *w, const double *parameter)
{
    for (size_t i = 0; i < w->l->system->parameters; i++) {
        nh_num x = nh_num_decimal(parameter[i]);
        nh_ex symbol = w->l->system->parameter[i].symbol;
        if (nh_num_short(x)) nh_ball_set_ratio(w->ball, symbol, x.p, x.q);
        else nh_ball_set_double(w->ball, symbol, parameter[i]);
    }
}

static void work_clear(nh_linear_work *w)
{
    slong m = (slong)w->l->m;
    arb_clear(w->t);
    arb_clear(w->begin);
    arb_mat_struct *const all[] = {w->R, w->S, w->T, w->M, w->C, w->N, w->A};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_clear(all[i]);
    _arb_vec_clear(w->q, m);
    _arb_vec_clear(w->v, m);
    _arb_vec_clear(w->a, m);
    nh_free(w->dependent);
    nh_free(w->fixed);
    nh_ball_free(w->ball);
}

/* The bits follow from the size of the matrix whose eigenvalues are enclosed. */
nh_linear_equations *nh_linearization_at(nh_linearization *l, const double *parameter, const nh_linear_state *state,
                                         nh_error *error)
{
    size_t m = l->m;
    nh_linear_equations *e = NULL;
    nh_linear_work w = {.l = l,
                        .bits = nh_ball_spectrum_bits(2 * m - l->k),
                        .q = _arb_vec_init((slong)m),
                        .v = _arb_vec_init((slong)m),
                        .a = _arb_vec_init((slong)m),
                        .dependent = nh_alloc_array(m + l->k + 1, sizeof *w.dependent),
                        .fixed = nh_alloc_array(m + 1, sizeof *w.fixed)};
    arb_mat_struct *const all[] = {w.R, w.S, w.T, w.M, w.C, w.N, w.A};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) arb_mat_init(all[i], 0, 0);
    arb_init(w.t);
    arb_init(w.begin);
    w.ball = nh_ball_create(l->dag, w.bits);
    set_parameters(&w, parameter);
    if (nh_linear_start(&w, state, error) && nh_linear_matrices(&w, error)) {
        e = nh_alloc(sizeof *e);
        fill(&w, e);
        decide(&w, e);
    }
    work_clear(&w);
    if (e && nh_interrupted()) {
        nh_linear_equations_free(e);
        e = NULL;
        nh_fail_ended(error, "while the equations were linearised");
    }
    return e;
}

void nh_linear_equations_free(nh_linear_equations *e)
{
    if (!e) return;
    void *const all[] = {e->velocity, e->position, e->q, e->v, e->a, e->M,      e->C,
                         e->N,        e->A,        e->R, e->S, e->T, e->closed, e->eigenvalue};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) nh_free(all[i]);
    nh_free(e);
}
