#include "reduction/reduced_check.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"

/* u = (x', zeta), n + d values, at z. */
static bool velocities(nh_reduced_flow *flow, const nh_reduced *o, const double *z, double *u)
{
    double *rate = nh_alloc_array(o->n + o->r + o->d + 1, sizeof *rate), *zeta = rate + o->n + o->r;
    bool good = nh_reduced_flow_at(flow, z, rate, NULL, zeta, NULL);
    memcpy(u, rate, o->n * sizeof *u);
    memcpy(u + o->n, zeta, o->d * sizeof *u);
    good = good && nh_all_finite(o->n + o->d, u);
    nh_free(rate);
    return good;
}

/* Its rate, by differences of fourth order along the equations, h apart in time. */
static bool rates(nh_reduced_flow *flow, const nh_reduced *o, const double *z, double h, double *slope)
{
    static const double weight[] = {1, -8, 0, 8, -1};
    size_t size = o->n + o->r, all = o->n + o->d;
    double *rate = nh_alloc_array(2 * size + all + 1, sizeof *rate), *at = rate + size, *u = at + size;
    bool good = nh_reduced_flow_at(flow, z, rate, NULL, NULL, NULL);
    memset(slope, 0, all * sizeof *slope);
    for (int step = -2; step <= 2 && good; step++) {
        if (!step) continue;
        for (size_t i = 0; i < size; i++) at[i] = z[i] + step * h * rate[i];
        good = velocities(flow, o, at, u);
        for (size_t i = 0; i < all; i++) slope[i] += weight[step + 2] * u[i] / (12 * h);
    }
    nh_free(rate);
    return good && nh_all_finite(all, slope);
}

/* The time in which a coordinate changes by its size. */
static double time_of(size_t m, const double *size, const double *v)
{
    double time = INFINITY;
    for (size_t i = 0; i < m; i++)
        if (v[i] != 0) time = fmin(time, size[i] / fabs(v[i]));
    return isfinite(time) ? time : 1;
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

static double unit_of(const bench *b, size_t i) { return b->e[i] != 0 ? sqrt(fabs(b->e[i])) : 1; }

/* The largest residual of omega v + b = 0, of linear and affine constraints, relative to |omega| |v| + |b| in the units
 * of the metric: a sum of terms that are rounding is rounding. */
static double off_constraints(const bench *b)
{
    const nh_slice *s = b->s;
    size_t m = s->m;
    const double *omega = b->e + m + m * s->d * (1 + m), *drift = omega + s->f * m;
    double worst = 0, speed = 0;
    for (size_t j = 0; j < m; j++) speed = hypot(speed, unit_of(b, j) * b->v[j]);
    for (size_t i = 0; i < s->f && s->kinetic->affine; i++) {
        double sum = drift[i], length = 0;
        for (size_t j = 0; j < m; j++) {
            sum += omega[i * m + j] * b->v[j];
            length = hypot(length, omega[i * m + j] / unit_of(b, j));
        }
        double size = length * speed + fabs(drift[i]);
        worst = fmax(worst, size > 0 ? fabs(sum) / size : 0);
    }
    return worst;
}

/* The difference at a state, relative to its terms; negative where it cannot be evaluated. */
static double at_state(bench *b, const double *u, const double *slope, nh_accelerations *accelerations, void *context)
{
    size_t m = b->s->m;
    double off = 0, size = 0;
    lift(b, u, slope);
    if (!nh_all_finite(m, b->a) || !accelerations(context, b->q, b->v, b->want)) return -1;
    for (size_t i = 0; i < m; i++) {
        double unit = unit_of(b, i);
        off = hypot(off, unit * (b->a[i] - b->want[i]));
        size = hypot(size, unit * (b->terms[i] + fabs(b->want[i]) + fabs(b->v[i])));
    }
    return fmax(off_constraints(b), size > 0 ? off / size : 0);
}

/* Velocities w of the size of the sampled ones. */
static void choose_velocities(const bench *b, const nh_reduced *o, size_t p, const double *speed, double *w)
{
    const nh_slice *s = b->s;
    size_t m = s->m;
    double *v = nh_alloc_array(2 * m + 1, sizeof *v), *u = v + m;
    for (size_t i = 0; i < m; i++) v[i] = cos(1.7 * (double)(p + 1) + 2.3 * (double)i) * speed[i];
    bool good = nh_slice_components(s, b->q, v, u);
    for (size_t i = 0; i < o->r; i++) {
        w[i] = good && o->r == m ? u[i] : cos(1.7 * (double)(p + 1) + 2.3 * (double)i);
        for (size_t j = 0; j < m && good; j++)
            if ((j < o->n ? o->dx[j] : o->zeta[j - o->n]) == o->w[i]) w[i] = u[j];
    }
    nh_free(v);
}

/* Of a state z of the slice at b->q; infinite where it cannot be evaluated. */
static double difference_at(bench *b, nh_reduced_flow *flow, const nh_reduced *o, const double *z, const double *size,
                            nh_accelerations *accelerations, void *context)
{
    static const double part[] = {0.001, 0.0001}; /* rounding prefers the first, nearby poles the second */
    size_t m = b->s->m;
    double *u = nh_alloc_array(2 * m + 1, sizeof *u), *slope = u + m, best = INFINITY;
    if (velocities(flow, o, z, u)) {
        nh_tape_eval(b->tape, b->work, b->q, b->e);
        lift(b, u, slope); /* for v */
        double time = time_of(m, size, b->v);
        for (size_t i = 0; i < sizeof part / sizeof *part; i++) {
            double here =
                rates(flow, o, z, part[i] * time, slope) ? at_state(b, u, slope, accelerations, context) : INFINITY;
            if (here >= 0 && here < best) best = here;
        }
    }
    nh_free(u);
    return best;
}

double nh_reduced_difference(const nh_reduced *o, const nh_slice *s, nh_accelerations *accelerations, void *context,
                             size_t *states)
{
    enum { trials = 8 };
    static const double far_enough = 0.05; /* of the guards, from where the slice or its connection ends */
    const nh_kinetic *k = s->kinetic;
    size_t m = s->m;
    double *x = nh_alloc_array(2 * (o->n + o->r) + 2 * m + 1, sizeof *x), *w = x + o->n, *z = w + o->r,
           *size = z + o->n + o->r, *speed = size + m, worst = 0;
    nh_reduced_flow *flow = nh_reduced_flow_create(o);
    bench b;
    open_bench(&b, s);
    nh_kinetic_sizes(k, k->places, size);
    for (size_t i = 0; i < k->places * m && k->speed; i++) speed[i % m] = fmax(speed[i % m], fabs(k->speed[i]));
    for (size_t i = 0; i < m; i++) speed[i] = speed[i] > 0 ? speed[i] : 1;
    *states = 0;
    for (size_t p = 0; *states < trials && p < k->places; p++) {
        double guard[2];
        for (size_t i = 0; i < o->n; i++) x[i] = k->place[p * m + s->shape[i]];
        nh_slice_place(s, x, b.q);
        choose_velocities(&b, o, p, speed, w);
        bool good = nh_reduced_flow_guards(flow, x, guard) && fmin(fabs(guard[0]), fabs(guard[1])) >= far_enough &&
                    nh_reduced_start(o, x, w, z);
        double off = good ? difference_at(&b, flow, o, z, size, accelerations, context) : INFINITY;
        if (!isfinite(off)) continue;
        (*states)++;
        worst = fmax(worst, off);
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
    double *z, *u, *size;
};

nh_reduced_shape *nh_reduced_shape_create(const nh_reduced *o)
{
    nh_reduced_shape *s = nh_alloc(sizeof *s);
    *s = (nh_reduced_shape){.reduced = o,
                            .flow = nh_reduced_flow_create(o),
                            .z = nh_alloc_array(4 * (o->n + o->r + o->d) + o->kinetic->m + 1, sizeof *s->z)};
    s->u = s->z + o->n + o->r;
    s->size = s->z + 4 * (o->n + o->r + o->d);
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
    double *size = s->u + 2 * (o->n + o->d), *slope = s->u + o->n + o->d;
    nh_kinetic_sizes(o->kinetic, o->kinetic->places, s->size);
    for (size_t i = 0; i < o->n; i++)
        for (size_t j = 0; j < o->kinetic->m; j++)
            if (o->kinetic->q[j] == o->x[i]) size[i] = s->size[j];
    bool good = nh_reduced_start(o, x, v, s->z) && rates(s->flow, o, s->z, part * time_of(o->n, size, v), slope);
    if (good) memcpy(acceleration, slope, o->n * sizeof *acceleration);
    return good;
}
