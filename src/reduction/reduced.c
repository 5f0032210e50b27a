#include "reduction/reduced.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/terms.h"
#include "reduction/subspace.h"

void nh_reduced_init(nh_reduced *o, const nh_kinetic *k, size_t n, const nh_ex *x, size_t r, size_t d)
{
    nh_arena *arena = k->arena;
    *o = (nh_reduced){.kinetic = k, .n = n, .r = r, .d = d};
    nh_ex *all = nh_arena_alloc(arena, (2 * n + 2 * r + r * r + d + 1) * sizeof *all);
    o->momentum = nh_arena_alloc(arena, (r + 1) * sizeof *o->momentum);
    o->x = all;
    o->w = o->x + n;
    o->M = o->w + r;
    o->dx = o->M + r * r;
    o->F = o->dx + n;
    o->zeta = o->F + r;
    memcpy(o->x, x, n * sizeof *x);
    for (size_t i = 0; i < 2 * n + 2 * r + r * r + d - n; i++) all[n + i] = nh_int(k->dag, 0);
    o->energy = nh_int(k->dag, 0);
    o->conservative = true;
}

static void guard_create(nh_guard *g, nh_arena *arena, size_t rows, size_t columns)
{
    *g = (nh_guard){.rows = rows, .columns = columns};
    g->e = nh_arena_alloc(arena, (rows * columns + 1) * sizeof *g->e);
    g->chosen = nh_arena_alloc(arena, (rows + 1) * sizeof *g->chosen);
    g->unit = nh_arena_alloc(arena, (columns + 1) * sizeof *g->unit);
}

/* sqrt(K_jj) at the best sample point to the given power: the unit of a coordinate or of a component in the frame. */
static void guard_units(nh_guard *g, const nh_kinetic *k, const nh_ex *K, double power)
{
    double *value = nh_alloc_array(g->columns * g->columns + 1, sizeof *value);
    nh_kinetic_values(k, g->columns * g->columns, K, k->place, value);
    for (size_t j = 0; j < g->columns; j++) {
        double square = value[j * (g->columns + 1)];
        g->unit[j] = isfinite(square) && square > 0 ? pow(square, power / 2) : 1;
    }
    nh_free(value);
}

void nh_reduced_guard_slice(nh_reduced *o, const nh_slice *s)
{
    nh_guard *g = &o->guard[1];
    guard_create(g, o->kinetic->arena, s->d, s->m);
    for (size_t a = 0; a < s->d; a++)
        for (size_t i = 0; i < s->m; i++) g->e[a * s->m + i] = s->E[i * s->d + a];
    memcpy(g->chosen, s->along, s->d * sizeof *s->along);
    guard_units(g, s->kinetic, s->kinetic->K, 1);
}

void nh_reduced_guard_constraints(nh_reduced *o, const nh_slice *s, const size_t *columns)
{
    nh_guard *g = &o->guard[0];
    guard_create(g, o->kinetic->arena, s->f, s->m);
    memcpy(g->e, s->omega, s->f * s->m * sizeof *s->omega);
    memcpy(g->chosen, columns, s->f * sizeof *columns);
    guard_units(g, s->kinetic, s->K, -1);
}

/* ---- the equations on the slice ---- */

/* At each place an elimination of its own, with common columns: a is places x f rows of m, column by column. */
static void choose_independent(const nh_slice *s, size_t places, double *a, size_t *independent)
{
    /* a component of the group is eliminated unless one of the shape is so many times better */
    static const double group_first = 4;
    size_t m = s->m, f = s->f, rows = places * f, count = 0;
    bool *taken = nh_alloc_array(m, sizeof *taken);
    for (size_t step = 0; step < f; step++) {
        size_t best = m;
        double most = 0;
        for (size_t j = 0; j < m; j++) {
            double least = INFINITY;
            for (size_t p = 0; p < places; p++) {
                double size = 0;
                for (size_t i = step; i < f; i++) size = fmax(size, fabs(a[p * f + i + j * rows]));
                least = fmin(least, size);
            }
            if (j >= s->n) least *= group_first;
            if (!taken[j] && least > most) most = least, best = j;
        }
        if (best == m) break;
        taken[best] = true;
        for (size_t p = 0; p < places; p++) {
            double *b = a + p * f;
            size_t pivot = step;
            for (size_t i = step; i < f; i++)
                if (fabs(b[i + best * rows]) > fabs(b[pivot + best * rows])) pivot = i;
            for (size_t j = 0; j < m; j++) {
                double x = b[step + j * rows];
                b[step + j * rows] = b[pivot + j * rows];
                b[pivot + j * rows] = x;
            }
            for (size_t i = step + 1; i < f; i++) {
                double factor = b[i + best * rows] / b[step + best * rows];
                for (size_t j = 0; j < m; j++) b[i + j * rows] -= factor * b[step + j * rows];
            }
        }
    }
    for (size_t j = 0; j < m; j++)
        if (!taken[j] && count < m - f) independent[count++] = j;
    nh_free(taken);
}

void nh_reduced_independent(const nh_slice *s, size_t *independent)
{
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m, f = s->f, places = k->places < 6 ? k->places : 6, rows = places * f;
    double *a = nh_alloc_array(rows * m + 1, sizeof *a), *value = nh_alloc_array(f * m + 1, sizeof *value);
    for (size_t p = 0; p < places && f; p++) {
        nh_kinetic_values(k, f * m, s->omega, k->place + p * m, value);
        for (size_t i = 0; i < f; i++)
            for (size_t j = 0; j < m; j++) a[p * f + i + j * rows] = value[i * m + j];
    }
    choose_independent(s, places, a, independent);
    nh_free(a);
    nh_free(value);
}

void nh_reduced_independent_at(const nh_slice *s, const double *q, size_t *independent)
{
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m, f = s->f;
    double *a = nh_alloc_array(f * m + 1, sizeof *a), *value = nh_alloc_array(f * m + m * m + 1, sizeof *value),
           *K = value + f * m;
    if (f) nh_kinetic_values(k, f * m, s->omega, q, value);
    nh_kinetic_values(k, m * m, s->K, q, K);
    for (size_t i = 0; i < f; i++)
        for (size_t j = 0; j < m; j++)
            a[i + j * f] = value[i * m + j] / (K[j * (m + 1)] > 0 ? sqrt(K[j * (m + 1)]) : 1);
    choose_independent(s, 1, a, independent);
    nh_free(a);
    nh_free(value);
}

/* ---- motions ---- */

struct nh_reduced_flow {
    const nh_reduced *o;
    /* M(x); x', F, zeta, energy of (x, w); matrices that must stay regular; the energy with its terms */
    nh_tape *mass, *rest, *guard, *size;
    nh_tape_work *mass_work, *rest_work, *guard_work, *size_work;
    size_t terms;
    double *M, *in, *out, *regular, *term, time;
    double sign[2], limit[2], fixed[2];
    bool constant[2]; /* a guard that does not depend on x */
};

static bool is_constant(const nh_reduced *o, const nh_guard *g)
{
    for (size_t j = 0; j < g->rows * g->columns; j++)
        for (size_t i = 0; i < o->n; i++)
            if (nh_depends(o->kinetic->dag, g->e[j], o->x[i])) return false;
    return true;
}

static void guard_tape(nh_reduced_flow *f)
{
    const nh_reduced *o = f->o;
    const nh_model *y = o->kinetic->model;
    size_t first = o->guard[0].rows * o->guard[0].columns, total = first + o->guard[1].rows * o->guard[1].columns;
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    if (first) memcpy(e, o->guard[0].e, first * sizeof *e);
    if (total > first) memcpy(e + first, o->guard[1].e, (total - first) * sizeof *e);
    f->guard =
        nh_tape_create(o->kinetic->dag, o->n, o->x, total, e, y->system->parameters, y->parameter, y->parameter_value);
    f->guard_work = nh_tape_work_create(f->guard);
    f->regular = nh_alloc_array(total + 1, sizeof *f->regular);
    f->sign[0] = f->sign[1] = 1;
    for (int i = 0; i < 2; i++) f->constant[i] = is_constant(o, &o->guard[i]);
    nh_free(e);
}

/* The chosen columns' minor over the root of the sum of the squares of all minors. */
static double guard_value(const nh_guard *g, double *value)
{
    for (size_t i = 0; i < g->rows * g->columns; i++) value[i] *= g->unit[i % g->columns];
    return g->rows ? nh_relative_minor(g->rows, g->columns, value, g->chosen) : 1;
}

static bool plain_guards(nh_reduced_flow *f, const double *x, double value[2])
{
    const nh_guard *g = f->o->guard;
    if (!(f->fixed[0] != 0 && f->fixed[1] != 0)) nh_tape_eval(f->guard, f->guard_work, x, f->regular);
    for (int i = 0; i < 2; i++) {
        value[i] = f->fixed[i] != 0 ? f->fixed[i] : guard_value(&g[i], f->regular + (i ? g[0].rows * g[0].columns : 0));
        if (f->constant[i]) f->fixed[i] = value[i];
    }
    return isfinite(value[0]) && isfinite(value[1]);
}

bool nh_reduced_flow_guards(nh_reduced_flow *f, const double *x, double value[2])
{
    bool good = plain_guards(f, x, value);
    for (int i = 0; i < 2; i++) value[i] = f->sign[i] * value[i] - f->limit[i];
    return good;
}

bool nh_reduced_flow_dependent(nh_reduced_flow *f, const double *x)
{
    static const double small = 1e-5;
    const nh_guard *g = &f->o->guard[0];
    size_t rows = g->rows, columns = g->columns;
    if (rows < 2) return false;
    double *a = nh_alloc_array(rows * columns + columns + 1, sizeof *a), *s = a + rows * columns;
    nh_tape_eval(f->guard, f->guard_work, x, f->regular);
    for (size_t i = 0; i < rows; i++) {
        double size = 0;
        for (size_t j = 0; j < columns; j++) size = hypot(size, f->regular[i * columns + j] * g->unit[j]);
        for (size_t j = 0; j < columns; j++)
            a[i + j * rows] = size > 0 ? f->regular[i * columns + j] * g->unit[j] / size : 0;
    }
    bool good = isfinite(nh_largest(rows * columns, a));
    if (good) nh_singular_values(rows, columns, a, s);
    bool dependent = good && s[rows - 1] <= small * s[0];
    nh_free(a);
    return dependent;
}

double nh_reduced_flow_limit(nh_reduced_flow *f, const double *x, double part, double most)
{
    double value[2];
    if (!plain_guards(f, x, value)) return 0;
    for (int i = 0; i < 2; i++) {
        f->sign[i] = value[i] < 0 ? -1 : 1;
        f->limit[i] = fmin(part * fabs(value[i]), most);
    }
    return fmin(fabs(value[0]), fabs(value[1]));
}

static bool guards_of(double t, const double *z, double *value, void *context)
{
    (void)t;
    return nh_reduced_flow_guards(context, z, value);
}

nh_reduced_flow *nh_reduced_flow_create(const nh_reduced *o)
{
    const nh_model *y = o->kinetic->model;
    size_t n = o->n, r = o->r, total = n + r + o->d + 1, p = y->system->parameters;
    nh_reduced_flow *f = nh_alloc(sizeof *f);
    nh_ex *in = nh_alloc_array(n + r + 2, sizeof *in), *e = nh_alloc_array(total, sizeof *e);
    *f = (nh_reduced_flow){.o = o,
                           .M = nh_alloc_array(r * r + 1, sizeof(double)),
                           .in = nh_alloc_array(n + r + 2, sizeof(double)),
                           .out = nh_alloc_array(total, sizeof(double))};
    memcpy(in, o->x, n * sizeof *in);
    memcpy(in + n, o->w, r * sizeof *in);
    if (o->timed) in[n + r] = o->t;
    memcpy(e, o->dx, n * sizeof *e);
    memcpy(e + n, o->F, r * sizeof *e);
    memcpy(e + n + r, o->zeta, o->d * sizeof *e);
    e[total - 1] = o->energy;
    f->mass = nh_tape_create(o->kinetic->dag, n, in, r * r, o->M, p, y->parameter, y->parameter_value);
    f->rest = nh_tape_create(o->kinetic->dag, n + r + o->timed, in, total, e, p, y->parameter, y->parameter_value);
    nh_ex *term;
    f->terms = nh_terms_of(o->kinetic->dag, o->energy, &term);
    f->size =
        nh_tape_create(o->kinetic->dag, n + r + o->timed, in, f->terms, term, p, y->parameter, y->parameter_value);
    f->size_work = nh_tape_work_create(f->size);
    f->term = nh_alloc_array(f->terms + 1, sizeof *f->term);
    nh_free(term);
    f->mass_work = nh_tape_work_create(f->mass);
    f->rest_work = nh_tape_work_create(f->rest);
    guard_tape(f);
    nh_free(in);
    nh_free(e);
    return f;
}

void nh_reduced_flow_free(nh_reduced_flow *f)
{
    if (!f) return;
    nh_tape_work_free(f->size_work);
    nh_tape_free(f->size);
    nh_free(f->term);
    nh_tape_work_free(f->mass_work);
    nh_tape_work_free(f->rest_work);
    nh_tape_free(f->mass);
    nh_tape_free(f->rest);
    nh_tape_work_free(f->guard_work);
    nh_tape_free(f->guard);
    nh_free(f->regular);
    nh_free(f->M);
    nh_free(f->in);
    nh_free(f->out);
    nh_free(f);
}

bool nh_reduced_flow_at(nh_reduced_flow *f, const double *z, double *rate, double *w, double *zeta, double *energy)
{
    size_t n = f->o->n, r = f->o->r, d = f->o->d;
    memcpy(f->in, z, (n + r) * sizeof *z);
    nh_tape_eval(f->mass, f->mass_work, f->in, f->M);
    f->in[n + r] = f->time;
    if (!f->o->plain && !nh_solve(r, f->M, 1, f->in + n, NULL)) return false;
    nh_tape_eval(f->rest, f->rest_work, f->in, f->out);
    if (f->o->force && rate && !f->o->force(f->o->context, f->time, z, f->in + n, f->out + n)) return false;
    for (size_t i = 0; i < n + r + d; i++)
        if (!isfinite(f->out[i])) return false;
    if (rate) memcpy(rate, f->out, (n + r) * sizeof *rate);
    if (w) memcpy(w, f->in + n, r * sizeof *w);
    if (zeta && d) memcpy(zeta, f->out + n + r, d * sizeof *zeta);
    if (energy) *energy = f->out[n + r + d];
    return true;
}

double nh_reduced_flow_energy_size(nh_reduced_flow *f)
{
    double most = 0;
    nh_tape_eval(f->size, f->size_work, f->in, f->term);
    for (size_t i = 0; i < f->terms; i++) most = fmax(most, fabs(f->term[i]));
    return most;
}

void nh_reduced_flow_time(nh_reduced_flow *f, double t) { f->time = t; }

static bool rate_of(double t, const double *z, double *rate, void *context)
{
    nh_reduced_flow_time(context, t);
    return nh_reduced_flow_at(context, z, rate, NULL, NULL, NULL);
}

nh_flow_problem nh_reduced_flow_problem(nh_reduced_flow *f)
{
    return (nh_flow_problem){.size = f->o->n + f->o->r, .context = f, .rate = rate_of, .guards = 2, .guard = guards_of};
}

bool nh_reduced_start(const nh_reduced *o, const double *x, const double *w, double *z)
{
    nh_reduced_flow *f = nh_reduced_flow_create(o);
    memcpy(z, x, o->n * sizeof *z);
    nh_tape_eval(f->mass, f->mass_work, x, f->M);
    bool good = true;
    for (size_t i = 0; i < o->r; i++) {
        double sum = 0;
        for (size_t j = 0; j < o->r; j++) sum += f->M[i * o->r + j] * w[j];
        z[o->n + i] = sum;
        good &= isfinite(sum);
    }
    nh_reduced_flow_free(f);
    return good;
}
