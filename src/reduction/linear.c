/* Momenta with p_a' = x' N_a^b(x) p_b (linear.h): N from the second derivatives of p' by the velocities, N = b
 * M_GG^-1, with b_ab the coefficient of x' nu_b in p_a'; all other terms, in nu nu and x' x', must vanish at the
 * shapes of the sample points. The matrix Y(x) with dY/dx = N Y is integrated along a motion, and Y^-1 p has to stay.
 */
#include "reduction/linear.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "exact/normal.h"
#include "exact/solve.h"
#include "graph/dag.h"
#include "reduction/runge.h"
#include "reduction/subspace.h"

/* H_bc = d2 F / dw_b dw_c. */
static nh_ex second(nh_dag *d, const nh_reduced *o, nh_ex F, size_t b, size_t c)
{
    return nh_diff(d, nh_diff(d, F, o->w[b]), o->w[c]);
}

/* N = b M_GG^-1 row by row (M is symmetric: M_GG N^T = b^T), b_ab the coefficient of x' nu_b in p_a'; and the other
 * terms, which must vanish, relative to it. */
static bool coefficients(const nh_reduced *o, size_t shape, size_t g, const size_t *index, nh_ex *N, nh_ex *rest)
{
    nh_dag *d = o->kinetic->dag;
    size_t r = o->r, n = 0;
    nh_ex *M = nh_alloc_array(g * g + g + 1, sizeof *M), *b = M + g * g;
    for (size_t i = 0; i < g; i++)
        for (size_t j = 0; j < g; j++) M[i * g + j] = o->M[index[i] * r + index[j]];
    nh_lu *lu = nh_lu_create(d, g, M, nh_chart_pivot_score, o->kinetic->model->chart, NULL);
    for (size_t a = 0; a < g && lu; a++) {
        nh_ex F = o->F[index[a]], leftover = nh_mul(d, nh_ratio(d, 1, 2), second(d, o, F, shape, shape));
        for (size_t j = 0; j < g; j++) b[j] = second(d, o, F, shape, index[j]);
        nh_lu_solve(lu, b, b);
        for (size_t j = 0; j < g; j++) {
            N[a * g + j] = nh_simplify(d, b[j]);
            leftover = nh_sub(d, leftover, nh_mul(d, N[a * g + j], o->M[index[j] * r + shape]));
            for (size_t k = 0; k <= j; k++) rest[n++] = second(d, o, F, index[j], index[k]);
        }
        rest[n++] = leftover;
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(M);
    return good;
}

/* The largest part of p' other than N p x', relative to N and to a change of the momenta by their size within the size
 * l of x, in units in which M has diagonal one:
 *
 *     l |rest_ajk| sqrt(M_xx / (M_aa M_jj M_kk)) / (1 + l |N_ab| sqrt(M_bb / M_aa))
 *
 * At shapes of the sample points; coordinates of the group do not occur. */
static double off_linear(const nh_reduced *o, size_t shape, size_t g, const size_t *index, const nh_ex *N,
                         const nh_ex *rest)
{
    const nh_kinetic *k = o->kinetic;
    size_t places = k->places < 16 ? k->places : 16, rows = g * (g + 1) / 2 + 1, total = g * g + g * rows + g + 1,
           r = o->r;
    nh_ex *e = nh_alloc_array(total, sizeof *e), *M = e + g * g + g * rows;
    double *value = nh_alloc_array(places * total, sizeof *value), *length = nh_alloc_array(k->m + 1, sizeof *length),
           l = 1, of_N = 0, off = 0;
    memcpy(e, N, g * g * sizeof *e);
    memcpy(e + g * g, rest, g * rows * sizeof *e);
    for (size_t a = 0; a < g; a++) M[a] = o->M[index[a] * (r + 1)];
    M[g] = o->M[shape * (r + 1)];
    nh_kinetic_sample(k, total, e, places, value);
    nh_kinetic_sizes(k, places, length);
    if (!isfinite(nh_largest(places * total, value))) off = INFINITY;
    for (size_t s = 0; s < k->m; s++)
        if (k->q[s] == o->x[0]) l = length[s];
    for (size_t p = 0; p < places; p++) {
        const double *n = value + p * total, *at = n + g * g;
        double *unit = value + p * total + g * g + g * rows;
        for (size_t a = 0; a <= g; a++) unit[a] = unit[a] != 0 ? sqrt(fabs(unit[a])) : 1;
        for (size_t i = 0; i < g * g; i++) of_N = fmax(of_N, fabs(n[i]) * l * unit[i % g] / unit[i / g]);
        for (size_t a = 0; a < g; a++) {
            for (size_t j = 0; j < g; j++)
                for (size_t i = 0; i <= j; i++)
                    off = fmax(off, fabs(*at++) * l * unit[g] / (unit[a] * unit[j] * unit[i]));
            off = fmax(off, fabs(*at++) * l / (unit[a] * unit[g])); /* of x'^2 */
        }
    }
    nh_free(e);
    nh_free(value);
    nh_free(length);
    return off / (1 + of_N);
}

void nh_linear_momenta_find(nh_linear_momenta *out, const nh_reduced *o, const nh_options *options)
{
    nh_arena *arena = o->kinetic->arena;
    size_t r = o->r, shape = r, g = 0;
    *out = (nh_linear_momenta){.index = nh_arena_alloc(arena, (r + 1) * sizeof *out->index)};
    for (size_t i = 0; i < r; i++) {
        if (o->n == 1 && o->w[i] == o->dx[0]) shape = i;
        else out->index[g++] = i;
    }
    if (o->n != 1 || shape == r || g == 0) return;
    size_t rows = g * (g * (g + 1) / 2 + 1);
    nh_ex *rest = nh_alloc_array(rows + 1, sizeof *rest);
    out->N = nh_arena_alloc(arena, (g * g + 1) * sizeof *out->N);
    if (coefficients(o, shape, g, out->index, out->N, rest)) {
        size_t rank;
        out->off = off_linear(o, shape, g, out->index, out->N, rest);
        bool known = nh_kinetic_rank(o->kinetic, 1, rows, rest, &rank); /* what is not linear vanishes */
        if (known ? rank == 0 : out->off <= options->group) out->count = g;
    }
    nh_free(rest);
}

typedef struct {
    size_t g;
    nh_tape *tape;
    nh_tape_work *work;
    double *N;
} equation;

static bool rate_of(double x, const double *Y, double *rate, void *context)
{
    equation *q = context;
    size_t g = q->g;
    nh_tape_eval(q->tape, q->work, &x, q->N);
    for (size_t i = 0; i < g; i++)
        for (size_t j = 0; j < g; j++) {
            rate[i + j * g] = 0;
            for (size_t k = 0; k < g; k++) rate[i + j * g] += q->N[i * g + k] * Y[k + j * g];
        }
    return true;
}

double nh_linear_momenta_drift(const nh_linear_momenta *l, const nh_reduced *o, size_t count, const double *z)
{
    static const double tolerance = 1e-13, largest = 1e12;
    const nh_model *y = o->kinetic->model;
    size_t g = l->count, size = o->n + o->r;
    equation q = {
        g,
        nh_tape_create(o->kinetic->dag, 1, o->x, g * g, l->N, y->system->parameters, y->parameter, y->parameter_value),
        NULL, nh_alloc_array(g * g + 1, sizeof(double))};
    double *Y = nh_alloc_array(2 * g * g + 3 * g + 1, sizeof *Y), *copy = Y + g * g, *p = copy + g * g, *start = p + g,
           worst = 0, norm = 1e-300;
    q.work = nh_tape_work_create(q.tape);
    for (size_t i = 0; i < g * g; i++) Y[i] = i % (g + 1) == 0;
    for (size_t a = 0; a < g; a++) norm = fmax(norm, fabs(start[a] = z[o->n + l->index[a]]));
    bool good = true;
    for (size_t i = 1; i < count && good; i++) { /* from state to state, so that Y is followed along the motion */
        double from = z[(i - 1) * size], to = z[i * size];
        good = from == to || nh_runge(g * g, rate_of, &q, from, to, tolerance, largest, NULL, Y);
        memcpy(copy, Y, g * g * sizeof *copy);
        for (size_t a = 0; a < g; a++) p[a] = z[i * size + o->n + l->index[a]];
        good = good && nh_solve(g, copy, 1, p, NULL);
        for (size_t a = 0; a < g && good; a++) worst = fmax(worst, fabs(p[a] - start[a]) / norm);
    }
    nh_tape_work_free(q.work);
    nh_tape_free(q.tape);
    nh_free(q.N);
    nh_free(Y);
    return good ? worst : -1;
}
