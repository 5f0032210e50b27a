#include "reduction/reduced_check.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"

/* u = (x', zeta), n + d values, at z, and its rate by differences of fourth order along the equations; a step changes z
 * by this part of 1 + |z|. */
static bool rates(nh_reduced_flow *flow, const nh_reduced *o, const double *z, double part, double *u, double *slope)
{
    static const double weight[] = {1, -8, 0, 8, -1};
    size_t size = o->n + o->r, all = o->n + o->d;
    double *rate = nh_alloc_array(4 * size + o->d + 1, sizeof *rate), *at = rate + size, *other = at + size,
           *zeta = other + size, h = 0;
    bool good = nh_reduced_flow_at(flow, z, rate, NULL, zeta, NULL);
    memcpy(u, rate, o->n * sizeof *u);
    memcpy(u + o->n, zeta, o->d * sizeof *u);
    for (size_t i = 0; i < size; i++) h = fmax(h, fabs(rate[i]) / (1 + fabs(z[i])));
    h = part / (1 + h);
    memset(slope, 0, all * sizeof *slope);
    for (int step = -2; step <= 2 && good; step++) {
        if (!step) continue;
        for (size_t i = 0; i < size; i++) at[i] = z[i] + step * h * rate[i];
        good = nh_reduced_flow_at(flow, at, other, NULL, zeta, NULL);
        for (size_t i = 0; i < all; i++)
            slope[i] += weight[step + 2] * (i < o->n ? other[i] : zeta[i - o->n]) / (12 * h);
    }
    good = good && nh_all_finite(all, u) && nh_all_finite(all, slope);
    nh_free(rate);
    return good;
}

typedef struct {
    const nh_slice *s;
    nh_tape *tape; /* K_ii, e_a, d_r e_a, then omega and b */
    nh_tape_work *work;
    double *e, *q, *v, *a, *terms, *want;
} bench;

static void open_bench(bench *b, const nh_slice *s)
{
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m, d = s->d, f = s->f, n = 0, total = m + m * d * (1 + m) + f * m + f;
    nh_ex *e = nh_alloc_array(total, sizeof *e);
    for (size_t i = 0; i < m; i++) e[n++] = k->K[i * (m + 1)];
    for (size_t i = 0; i < d * m; i++) e[n++] = s->action->generator[i / m].component[i % m];
    for (size_t i = 0; i < d * m; i++)
        for (size_t r = 0; r < m; r++) e[n++] = nh_diff(k->dag, e[m + i], k->q[r]);
    memcpy(e + n, k->omega, f * m * sizeof *e);
    memcpy(e + n + f * m, k->b, f * sizeof *e);
    *b = (bench){.s = s, .tape = nh_kinetic_tape(k, total, e), .e = nh_alloc_array(total + 5 * m, sizeof(double))};
    b->work = nh_tape_work_create(b->tape);
    b->q = b->e + total, b->v = b->q + m, b->a = b->v + m, b->terms = b->a + m, b->want = b->terms + m;
    nh_free(e);
}

/* v = Fr u, and v' in a with the sums of the moduli of its terms. */
static void lift(bench *b, const double *u, const double *slope)
{
    const nh_slice *s = b->s;
    size_t m = s->m, n = s->n, d = s->d;
    const double *E = b->e + m, *dE = E + m * d, *zeta = u + n;
    memset(b->v, 0, 3 * m * sizeof *b->v);
    for (size_t i = 0; i < n; i++) {
        b->v[s->shape[i]] = u[i];
        b->a[s->shape[i]] = slope[i];
        b->terms[s->shape[i]] = fabs(slope[i]);
    }
    for (size_t i = 0; i < m * d; i++) b->v[i % m] += E[i] * zeta[i / m];
    for (size_t i = 0; i < m * d; i++) {
        double along = E[i] * slope[n + i / m];
        for (size_t j = 0; j < n; j++) along += zeta[i / m] * u[j] * dE[i * m + s->shape[j]];
        for (size_t r = 0; r < m; r++) along += zeta[i / m] * b->v[r] * dE[i * m + r];
        b->a[i % m] += along;
        b->terms[i % m] += fabs(along);
    }
}

/* The largest residual of omega v + b = 0, of linear and affine constraints. */
static double off_constraints(const bench *b)
{
    const nh_slice *s = b->s;
    size_t m = s->m;
    const double *omega = b->e + m + m * s->d * (1 + m), *drift = omega + s->f * m;
    double worst = 0;
    for (size_t i = 0; i < s->f && s->kinetic->affine; i++) {
        double sum = drift[i], size = fabs(drift[i]);
        for (size_t j = 0; j < m; j++) sum += omega[i * m + j] * b->v[j], size += fabs(omega[i * m + j] * b->v[j]);
        worst = fmax(worst, size > 0 ? fabs(sum) / size : 0);
    }
    return worst;
}

/* The difference at a state, relative to its terms; negative where it cannot be evaluated. */
static double at_state(bench *b, const double *u, const double *slope, nh_accelerations *accelerations, void *context)
{
    size_t m = b->s->m;
    double off = 0, size = 0;
    nh_tape_eval(b->tape, b->work, b->q, b->e);
    lift(b, u, slope);
    if (!nh_all_finite(m, b->a) || !accelerations(context, b->q, b->v, b->want)) return -1;
    for (size_t i = 0; i < m; i++) {
        double unit = b->e[i] != 0 ? sqrt(fabs(b->e[i])) : 1;
        off = hypot(off, unit * (b->a[i] - b->want[i]));
        size = hypot(size, unit * (b->terms[i] + fabs(b->want[i]) + fabs(b->v[i])));
    }
    return fmax(off_constraints(b), size > 0 ? off / size : 0);
}

double nh_reduced_difference(const nh_reduced *o, const nh_slice *s, nh_accelerations *accelerations, void *context,
                             size_t *states)
{
    enum { trials = 8, steps = 2 };
    static const double part[steps] = {1e-3, 1e-4}; /* rounding prefers the first, nearby poles the second */
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m;
    double *x = nh_alloc_array(o->n + 2 * o->r + 2 * (o->n + o->r) + 2 * m + 1, sizeof *x), *w = x + o->n,
           *z = w + o->r, *u = z + o->n + o->r, *slope = u + m, worst = 0;
    nh_reduced_flow *flow = nh_reduced_flow_create(o);
    bench b;
    open_bench(&b, s);
    *states = 0;
    for (size_t p = 0; p < trials && p < k->places; p++) {
        double best = INFINITY;
        for (size_t i = 0; i < o->n; i++) x[i] = k->place[p * m + s->shape[i]];
        for (size_t i = 0; i < o->r; i++) w[i] = cos(1.7 * (double)(p + 1) + 2.3 * (double)i);
        nh_slice_place(s, x, b.q);
        for (int step = 0; step < steps && nh_reduced_start(o, x, w, z); step++) {
            double here = rates(flow, o, z, part[step], u, slope) ? at_state(&b, u, slope, accelerations, context) : -1;
            if (here >= 0 && here < best) best = here;
        }
        if (!isfinite(best)) continue;
        (*states)++;
        worst = fmax(worst, best);
    }
    nh_reduced_flow_free(flow);
    nh_tape_work_free(b.work);
    nh_tape_free(b.tape);
    nh_free(b.e);
    nh_free(x);
    return *states ? worst : INFINITY;
}

/* ---- of a system that is reduced itself ---- */

struct nh_reduced_shape {
    const nh_reduced *reduced;
    nh_reduced_flow *flow;
    double *z, *u;
};

nh_reduced_shape *nh_reduced_shape_create(const nh_reduced *o)
{
    nh_reduced_shape *s = nh_alloc(sizeof *s);
    *s = (nh_reduced_shape){.reduced = o,
                            .flow = nh_reduced_flow_create(o),
                            .z = nh_alloc_array(4 * (o->n + o->r + o->d) + 1, sizeof *s->z)};
    s->u = s->z + o->n + o->r;
    return s;
}

void nh_reduced_shape_free(nh_reduced_shape *s)
{
    if (!s) return;
    nh_reduced_flow_free(s->flow);
    nh_free(s->z);
    nh_free(s);
}

bool nh_reduced_shape_accelerations(void *shape, const double *x, const double *v, double *acceleration)
{
    nh_reduced_shape *s = shape;
    const nh_reduced *o = s->reduced;
    static const double part = 1e-3;
    double *slope = s->u + o->n + o->d;
    bool good = nh_reduced_start(o, x, v, s->z) && rates(s->flow, o, s->z, part, s->u, slope);
    if (good) memcpy(acceleration, slope, o->n * sizeof *acceleration);
    return good;
}
