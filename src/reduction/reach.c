/* reach: moves positions and velocities along the orbits of a group (reach.h). */
#include "reduction/reach.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "graph/diff.h"
#include "reduction/runge.h"

typedef struct {
    size_t m;
    nh_tape *tape;
    nh_tape_work *work;
} push;

static bool push_rate(double t, const double *z, double *rate, void *context)
{
    (void)t;
    push *p = context;
    nh_tape_eval(p->tape, p->work, z, rate);
    return true;
}

/* q' = X, v' = dX v. */
bool nh_action_push(const nh_action *g, size_t a, double time, double *z)
{
    static const double tolerance = 1e-14, largest = 1e12;
    const nh_kinetic *k = g->kinetic;
    size_t m = k->m;
    nh_ex *in = nh_alloc_array(4 * m, sizeof *in), *out = in + 2 * m;
    memcpy(in, k->q, m * sizeof *in);
    memcpy(in + m, k->v, m * sizeof *in);
    memcpy(out, g->generator[a].component, m * sizeof *out);
    for (size_t s = 0; s < m; s++) out[m + s] = nh_diff_along(k->dag, out[s], m, k->q, k->v);
    push p = {.m = m,
              .tape = nh_tape_create(k->dag, 2 * m, in, 2 * m, out, k->model->system->parameters, k->model->parameter,
                                     k->model->parameter_value)};
    p.work = nh_tape_work_create(p.tape);
    bool good = nh_runge_sized(2 * m, push_rate, &p, 0, time, tolerance, largest, z);
    nh_tape_work_free(p.work);
    nh_tape_free(p.tape);
    nh_free(in);
    return good;
}

/* dt with y + dt^a e_a^y = y0; the size of y - y0, relative to the largest that coordinates of the orbit have had on
   the way (angles: 1 + size). */
static double newton(const nh_slice *s, const double *q, double *size, double *dt)
{
    static const double turn = 6.283185307179586;
    size_t m = s->m, d = s->d;
    double *E = nh_alloc_array(m * d + d * d + 1, sizeof *E), *minor = E + m * d, off = 0;
    nh_action_values(s->action, q, E);
    for (size_t i = 0; i < d; i++) {
        dt[i] = s->y0[i] - q[s->along[i]];
        if (s->kinetic->periodic[s->along[i]]) dt[i] -= turn * round(dt[i] / turn);
        size[i] = fmax(size[i], fabs(q[s->along[i]]));
        if (dt[i] != 0) off = fmax(off, fabs(dt[i]) / (size[i] + (s->kinetic->angle[s->along[i]] ? 1 : 0)));
        for (size_t a = 0; a < d; a++) minor[i + a * d] = E[s->along[i] + a * m];
    }
    bool good = nh_solve(d, minor, 1, dt, NULL);
    nh_free(E);
    return good ? off : INFINITY;
}

/* Of constant components: a step may be of any length. */
static bool translation(const nh_action *g, size_t a)
{
    const nh_kinetic *k = g->kinetic;
    bool constant = true;
    for (size_t s = 0; s < k->m; s++)
        for (size_t j = 0; j < k->m; j++) constant &= !nh_depends(k->dag, g->generator[a].component[s], k->q[j]);
    return constant;
}

size_t nh_slice_reach(const nh_slice *s, double *q, double *v, double *moved)
{
    enum { most = NH_REACH_MOST };
    static const double there = 1e-13, longest = 0.8;
    size_t m = s->m, d = s->d, count = 0;
    double *z = nh_alloc_array(2 * m + 2 * d + 1, sizeof *z), *dt = z + 2 * m, *size = dt + d;
    bool good = d > 0, arrived = false;
    memcpy(z, q, m * sizeof *z);
    memcpy(z + m, v, m * sizeof *z);
    for (size_t i = 0; i < d; i++) size[i] = fabs(s->y0[i]);
    for (size_t round = 0; round < most && good && !arrived; round++) {
        double off = newton(s, z, size, dt);
        arrived = off <= there;
        good = isfinite(off);
        for (size_t a = 0; a < d && good && !arrived; a++) { /* one after the other: to first order the steps add up */
            double step = translation(s->action, a) ? dt[a] : fmax(-longest, fmin(longest, dt[a]));
            if (step == 0) continue;
            good = count < most && nh_action_push(s->action, a, step, z);
            if (!good) break;
            memset(moved + count * d, 0, d * sizeof *moved);
            moved[count++ * d + a] = -step;
        }
    }
    if (arrived) {
        memcpy(q, z, m * sizeof *q);
        memcpy(v, z + m, m * sizeof *v);
        for (size_t a = 0; a < d; a++) q[s->along[a]] = s->y0[a];
    }
    nh_free(z);
    return arrived ? count : SIZE_MAX;
}
