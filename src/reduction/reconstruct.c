#include "reduction/reconstruct.h"

#include <math.h>
#include <stdio.h>

#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/subspace.h"

typedef struct {
    const nh_reduced *o;
    const nh_slice *slice;
    nh_reduced_flow *flow;
    size_t inner, d;
    double *ad;                     /* d matrices d x d */
    bool *acts;                     /* ad_a is not zero */
    double *M, *P, *E, *next, *zeta; /* work */
    bool direct;                    /* the place itself is integrated beside (x, p, t) */
    nh_tape *field;                 /* generators at a place */
    nh_tape_work *field_work;
    double *e, *before, *spatial;   /* their values; Ad of the factors kept; g' g^-1 */
} group_flow;

/* Where the generators do not depend on the shape coordinates, T g d/dx^i = d/dx^i, and the place follows the equation
 *     q' = x'^i d/dx^i + (Ad_g zeta)^a e_a(q),
 * which stays on the path of the motion: the flows of the factors take another one, round a pole of the coordinates perhaps. */
static bool independent_of_shape(const nh_slice *s)
{
    const nh_kinetic *k = s->kinetic;
    for (size_t a = 0; a < s->d; a++)
        for (size_t r = 0; r < s->m; r++)
            for (size_t i = 0; i < s->n; i++)
                if (nh_depends(k->dag, s->action->generator[a].component[r], s->x[i])) return false;
    return true;
}

/* M(t) into f->M and Ad_g into f->P. */
static void second_kind(group_flow *f, const double *t)
{
    size_t d = f->d;
    for (size_t i = 0; i < d * d; i++) f->P[i] = i % (d + 1) == 0;
    for (size_t a = 0; a < d; a++) {
        memcpy(f->M + a * d, f->P + a * d, d * sizeof *f->M);
        if (!f->acts[a] || t[a] == 0) continue;
        for (size_t i = 0; i < d * d; i++) f->next[i] = t[a] * f->ad[a * d * d + i];
        nh_matrix_exp(d, f->next, f->E);
        nh_multiply(d, d, d, f->P, f->E, f->next);
        memcpy(f->P, f->next, d * d * sizeof *f->P);
    }
}

/* rate holds x' and, from `inner` on, Ad_h zeta of the factor in hand. */
static void place_rate(group_flow *f, const double *q, double *rate)
{
    const nh_slice *s = f->slice;
    double *out = rate + f->inner + f->d;
    nh_multiply(f->d, 1, f->d, f->before, rate + f->inner, f->spatial);
    nh_tape_eval(f->field, f->field_work, q, f->e);
    memset(out, 0, s->m * sizeof *out);
    for (size_t i = 0; i < s->n; i++) out[s->shape[i]] = rate[i];
    for (size_t a = 0; a < f->d; a++)
        for (size_t r = 0; r < s->m; r++) out[r] += f->spatial[a] * f->e[r + a * s->m];
}

static bool rate_of(double time, const double *z, double *rate, void *context)
{
    (void)time;
    group_flow *f = context;
    size_t d = f->d;
    if (!nh_reduced_flow_at(f->flow, z, rate, NULL, f->zeta, NULL)) return false;
    second_kind(f, z + f->inner);
   
    nh_multiply(d, 1, d, f->P, f->zeta, rate + f->inner);
    if (f->direct) place_rate(f, z + f->inner + d, rate);
    return d == 0 || nh_solve(d, f->M, 1, rate + f->inner, NULL);
}

/* What must stay regular in the reduced equations, and sigma_min / sigma_max of M, above what is tolerated. */
static bool guard_of(double time, const double *z, double *value, void *context)
{
    (void)time;
    static const double least = 0.1;
    group_flow *f = context;
    double *s = f->zeta;
    if (!nh_reduced_flow_guards(f->flow, z, value)) return false;
    if (!f->d) return true;
    second_kind(f, z + f->inner);
    nh_singular_values(f->d, f->d, f->M, s);
    value[2] = s[0] > 0 ? s[f->d - 1] / s[0] - least : -1;
    return isfinite(value[2]);
}

static void group_flow_init(group_flow *f, const nh_reduced *o, const nh_slice *slice)
{
    const nh_algebra *g = &slice->action->algebra;
    size_t d = g->d;
    *f = (group_flow){.o = o, .slice = slice, .flow = nh_reduced_flow_create(o), .inner = o->n + o->r, .d = d};
    f->ad = nh_alloc_array(d * d * d + 4 * d * d + d + 1, sizeof *f->ad);
    f->M = f->ad + d * d * d;
    f->P = f->M + d * d;
    f->E = f->P + d * d;
    f->next = f->E + d * d;
    f->zeta = f->next + d * d;
    f->acts = nh_alloc_array(d + 1, sizeof *f->acts);
    for (size_t a = 0; a < d; a++) {
        for (size_t i = 0; i < d; i++) f->zeta[i] = i == a;
        nh_algebra_ad(g, f->zeta, f->ad + a * d * d);
        f->acts[a] = nh_largest(d * d, f->ad + a * d * d) > 0;
    }
    size_t m = slice->m;
    nh_ex *e = nh_alloc_array(m * d + 1, sizeof *e);
    for (size_t a = 0; a < d; a++) memcpy(e + a * m, slice->action->generator[a].component, m * sizeof *e);
    f->direct = independent_of_shape(slice);
    f->field = nh_kinetic_tape(slice->kinetic, m * d, e);
    f->field_work = nh_tape_work_create(f->field);
    f->e = nh_alloc_array(m * d + d * d + d + 1, sizeof *f->e);
    f->before = f->e + m * d;
    f->spatial = f->before + d * d;
    for (size_t i = 0; i < d * d; i++) f->before[i] = i % (d + 1) == 0;
    nh_free(e);
}

static void group_flow_clear(group_flow *f)
{
    nh_reduced_flow_free(f->flow);
    nh_tape_work_free(f->field_work);
    nh_tape_free(f->field);
    nh_free(f->e);
    nh_free(f->ad);
    nh_free(f->acts);
}

/* q := exp(t_1 e_1) ... exp(t_d e_d) q: the last factor first. */
static bool move(nh_flows *flows, size_t d, const double *t, double *q)
{
    double *c = nh_alloc_array(d + 1, sizeof *c);
    bool good = true;
    for (size_t a = d; a-- > 0 && good;) {
        c[a] = 1;
        good = nh_flows_move(flows, c, t[a], q);
        c[a] = 0;
    }
    nh_free(c);
    return good;
}

typedef struct {
    double *factor; /* finished stretches: d numbers each, the first one outermost */
    size_t count, capacity;
} stretches;

static bool place_of(const group_flow *f, nh_flows *flows, const stretches *done, const double *z, double *q)
{
    if (f->direct) {
        memcpy(q, z + f->inner + f->d, f->slice->m * sizeof *q);
        return true;
    }
    nh_slice_place(f->slice, z, q);
    bool good = move(flows, f->d, z + f->inner, q);
    for (size_t i = done->count; i-- > 0 && good;) good = move(flows, f->d, done->factor + i * f->d, q);
    return good;
}

/* Copy what a stretch of the motion reached, from its output `from` on; the places of its points. */
static bool store(group_flow *f, nh_flows *flows, const stretches *done, const nh_motion *motion, size_t from, nh_reconstruction *out)
{
    bool good = true;
    for (size_t i = from; i < motion->count && good; i++) {
        const double *z = motion->state + i * motion->size;
        size_t at = out->count;
        out->time[at] = motion->time[i];
        memcpy(out->z + at * f->inner, z, f->inner * sizeof *z);
        if (!nh_reduced_flow_at(f->flow, z, NULL, NULL, f->d ? out->zeta + at * f->d : NULL, NULL)) return false;
        good = place_of(f, flows, done, z, out->q + at * out->m);
        out->count += good;
    }
    return good;
}

/* Keep the factors of g; the next stretch starts from the identity. */
static void start_again(group_flow *f, const nh_motion *motion, stretches *done, double *state)
{
    nh_grow(&done->factor, &done->capacity, (done->count + 1) * f->d, sizeof *done->factor);
    memcpy(done->factor + done->count++ * f->d, motion->end_state + f->inner, f->d * sizeof *done->factor);
    second_kind(f, motion->end_state + f->inner);
    nh_multiply(f->d, f->d, f->d, f->before, f->P, f->next);
    memcpy(f->before, f->next, f->d * f->d * sizeof *f->before);
    memcpy(state, motion->end_state, motion->size * sizeof *state);
    memset(state + f->inner, 0, f->d * sizeof *state);
}

static bool run(group_flow *f, nh_flows *flows, const double *z, size_t count, const double *times, const nh_options *options, nh_reconstruction *out, nh_error *error)
{
    enum { most_stretches = 10000 };
    nh_flow_options flow_options = {.method = NH_ADAMS, .rtol = options->tolerance, .max_steps = options->steps};
    nh_flow_problem problem = {.size = f->inner + f->d + (f->direct ? f->slice->m : 0), .context = f, .rate = rate_of, .guards = 2 + (f->d > 0), .guard = guard_of};
    double *state = nh_alloc_array(problem.size, sizeof *state), *left = nh_alloc_array(count + 1, sizeof *left);
    stretches done = {0};
    bool good = true;
    memcpy(state, z, f->inner * sizeof *state);
    if (f->direct) nh_slice_place(f->slice, z, state + f->inner + f->d);
    memcpy(left, times, count * sizeof *left);
    while (good && !out->complete && done.count < most_stretches) {
        size_t n = count - out->count, first = out->count > 0 || done.count > 0; /* a later stretch begins where the last one ended */
        if (first) memcpy(left + 1, times + out->count, n * sizeof *left);
        nh_motion *motion = nh_flow(&problem, state, n + first, left, &flow_options, error);
        good = motion != NULL;
        if (!good) break;
        out->evaluations += motion->evaluations;
        out->steps += motion->steps;
        bool found = store(f, flows, &done, motion, first, out);
        out->complete = motion->complete && found;
        if (!found) snprintf(out->note, sizeof out->note, "the flows of the generators meet a singularity of the coordinates at t = %.4g", times[out->count]);
        else if (motion->guard_hit >= 0 && motion->guard_hit < 2)
            snprintf(out->note, sizeof out->note, "%s singular at t = %.6g", motion->guard_hit == 0 ? "the constraints on the orbits become" : "the slice becomes", motion->end_time);
        else if (!motion->complete && motion->guard_hit < 0) snprintf(out->note, sizeof out->note, "%s", motion->note);
        if (!found || (!motion->complete && motion->guard_hit < 2)) {
            nh_motion_free(motion);
            break;
        }
        if (!motion->complete) {
            start_again(f, motion, &done, state);
            left[0] = motion->end_time;
            out->restarts++;
        }
        nh_motion_free(motion);
    }
    nh_free(state);
    nh_free(left);
    nh_free(done.factor);
    return good;
}

nh_reconstruction *nh_reconstruct(const nh_reduced *o, const nh_slice *slice, const double *z, size_t count, const double *times, const nh_options *options,
                                  nh_error *error)
{
    group_flow f;
    nh_flows *flows = nh_flows_create(slice->action);
    nh_reconstruction *out = nh_alloc(sizeof *out);
    group_flow_init(&f, o, slice);
    *out = (nh_reconstruction){.m = slice->m, .size = f.inner};
    out->time = nh_alloc_array(count + 1, sizeof *out->time);
    out->q = nh_alloc_array(count * slice->m + 1, sizeof *out->q);
    out->z = nh_alloc_array(count * f.inner + 1, sizeof *out->z);
    out->zeta = nh_alloc_array(count * f.d + 1, sizeof *out->zeta);
    bool good = run(&f, flows, z, count, times, options, out, error);
    group_flow_clear(&f);
    nh_flows_free(flows);
    if (good) return out;
    nh_reconstruction_free(out);
    nh_fail(error, NH_NUMERIC, "", "the motion of the group could not be found again from the reduced one");
    return NULL;
}

void nh_reconstruction_free(nh_reconstruction *r)
{
    if (!r) return;
    nh_free(r->time);
    nh_free(r->q);
    nh_free(r->z);
    nh_free(r->zeta);
    nh_free(r);
}
