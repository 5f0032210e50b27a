/* The full motion from a reduced one (reconstruct.h): the reduced state, the group's coordinates and the place
 * together.
 *
 *      state of one part:   [ x (n) | p (r) | t (d) | q (m) ]           t: factors of g since the last restart
 *
 *      part 1 --guard of M--> factors kept, t = 0 --> part 2 --guard of the chart--> another chart of the atlas --> ..
 *                                                                      |
 *         nothing regular at the end of the part: back to the last output, a chart made for that place
 *
 *      outputs: q from the place in the state, or moved by the kept factors, flow after flow */
#include "reduction/reconstruct.h"

#include "motion/automatic.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/group_flow.h"
#include "reduction/reach.h"
#include "reduction/subspace.h"

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

/* The motion that is being computed. */
typedef struct {
    nh_group_flow f;
    nh_flows *flows;
    nh_atlas *atlas;                  /* NULL: a single chart */
    double *factor;                   /* of finished parts: d numbers each, the first one outermost */
    size_t count, capacity, failures; /* number of new charts for the same output */
    double *state, *left, *least;
    nh_reconstruction *out;
} course;

/* The place in Q of a state. */
static bool place_of(const course *c, const double *z, double *q)
{
    const nh_group_flow *f = &c->f;
    if (f->direct) {
        memcpy(q, z + f->inner + f->d, f->m * sizeof *q);
        return true;
    }
    nh_slice_place(f->chart->slice, z, q);
    bool good = move(c->flows, f->d, z + f->inner, q);
    for (size_t i = c->count; i-- > 0 && good;) good = move(c->flows, f->d, c->factor + i * f->d, q);
    return good;
}

/* Copies the outputs of a part of the motion, from output `from` on, and their places. */
static bool store(course *c, const nh_motion *motion, size_t from)
{
    nh_group_flow *f = &c->f;
    nh_reconstruction *out = c->out;
    bool good = true;
    for (size_t i = from; i < motion->count && good; i++) {
        const double *z = motion->state + i * motion->size;
        size_t at = out->count;
        out->time[at] = motion->time[i];
        nh_reduced_flow_time(f->chart->flow, motion->time[i]);
        memcpy(out->z + at * f->inner, z, f->inner * sizeof *z);
        if (!nh_reduced_flow_at(f->chart->flow, z, NULL, NULL, f->d ? out->zeta + at * f->d : NULL, out->energy + at))
            return false;
        out->energy_size[at] = fmax(nh_reduced_flow_energy_size(f->chart->flow), at ? out->energy_size[at - 1] : 0);
        if (f->group) good = place_of(c, z, out->q + at * out->m);
        out->count += good;
    }
    return good;
}

/* Stores the factors of g; the next part starts from the identity. */
static void keep_factors(course *c, const double *t)
{
    nh_group_flow *f = &c->f;
    nh_grow(&c->factor, &c->capacity, (c->count + 1) * f->d, sizeof *c->factor);
    memcpy(c->factor + c->count++ * f->d, t, f->d * sizeof *t);
    nh_group_flow_factors(f, t);
    nh_multiply(f->d, f->d, f->d, f->before, f->P, f->next);
    memcpy(f->before, f->next, f->d * f->d * sizeof *f->before);
}

static void limit_guards(course *c, const double *x)
{
    static const double part = 0.5, most = 0.1; /* part of the present values of the guards */
    if (c->atlas) nh_reduced_flow_limit(c->f.chart->flow, x, part, most);
}

/* The rest of the state for the inner one: g = identity, and the place where that is integrated. */
static void begin_stretch(course *c, const double *place)
{
    nh_group_flow *f = &c->f;
    if (f->group) memset(c->state + f->inner, 0, f->d * sizeof *c->state);
    if (f->direct) memcpy(c->state + f->inner + f->d, place, f->m * sizeof *c->state);
    limit_guards(c, c->state);
}

/* From a state to a chart that is regular there: known or new after a guard, made for this place (`renew`, counted in
   c->failures) where the equations could not be integrated. */
static bool change_chart(course *c, const double *z, bool renew, double *place)
{
    static const double lost = 1e-4; /* no chart is regular there */
    nh_group_flow *f = &c->f;
    double *q = nh_alloc_array(2 * f->m + f->inner + f->d + 1, sizeof *q), *v = q + f->m, *next = v + f->m,
           *moved = next + f->inner, value[2];
    nh_error trouble = {0};
    bool good = nh_chart_leave(f->chart, z, q, v), placed = f->group && good && place_of(c, z, place);
    const nh_reduced_chart *chart = !good ? NULL
                                    : renew
                                        ? nh_atlas_renew(c->atlas, f->chart, c->failures, q, v, moved, next, &trouble)
                                        : nh_atlas_at(c->atlas, q, v, next, &trouble);
    nh_error_clear(&trouble);
    if (chart) nh_reduced_flow_limit(chart->flow, next, 0, 0);
    good = chart && nh_reduced_flow_guards(chart->flow, next, value) && value[0] > lost && value[1] > lost;
    if (good) {
        c->out->charts += chart != f->chart;
        if (c->out->charts == 1 && chart != f->chart) c->out->first_chart = c->out->count;
        if (f->group) keep_factors(c, z + f->inner);
        if (f->group && renew) keep_factors(c, moved);
        nh_group_flow_chart(f, chart);
        f->direct &= placed;
        memcpy(c->state, next, f->inner * sizeof *next);
    }
    nh_free(q);
    return good;
}

/* Continues from the last output in a chart that is made for it. */
static bool renew_chart(course *c, const nh_motion *motion, double *place)
{
    size_t last = motion->count - 1;
    c->left[0] = motion->time[last];
    return change_chart(c, motion->state + last * motion->size, true, place);
}

/* After a part that a guard has ended: continues from there; where that fails, or the equations could not be
 * integrated, from the last output. */
static bool go_on(course *c, const nh_motion *motion, bool renew)
{
    nh_group_flow *f = &c->f;
    double *place = nh_alloc_array(f->m + 1, sizeof *place);
    bool good = false;
    c->left[0] = motion->end_time;
    if (motion->guard_hit == 2) {
        keep_factors(c, motion->end_state + f->inner);
        memcpy(c->state, motion->end_state, f->inner * sizeof *c->state);
        if (f->direct) memcpy(place, motion->end_state + f->inner + f->d, f->m * sizeof *place);
        c->out->restarts++;
        good = true;
    } else if (motion->guard_hit >= 0) {
        good = change_chart(c, motion->end_state, false, place);
    }
    if (!good && renew) good = renew_chart(c, motion, place);
    if (good) begin_stretch(c, place);
    nh_free(place);
    return good;
}

/* The note: why the motion ended, in words. */
static void explain(course *c, const nh_motion *motion, bool found, const double *times)
{
    nh_reconstruction *out = c->out;
    out->dependent = !motion->complete && nh_reduced_flow_dependent(c->f.chart->flow, motion->end_state);
    if (out->dependent)
        snprintf(out->note, sizeof out->note,
                 "the constraints become dependent at t = %.6g: beyond that the motion is not determined",
                 motion->end_time);
    else if (!found)
        snprintf(out->note, sizeof out->note,
                 "the flows of the generators meet a singularity of the coordinates at t = %.4g", times[out->count]);
    else if (motion->guard_hit >= 0)
        snprintf(out->note, sizeof out->note, "%s singular at t = %.6g",
                 motion->guard_hit == 0 ? "the constraints on the orbits become" : "the slice becomes",
                 motion->end_time);
    else snprintf(out->note, sizeof out->note, "%s", motion->note);
}

/* May a new chart be made for the last output?  Not again after several ones without another output. */
static bool may_renew(course *c, const nh_motion *motion)
{
    enum { most_failures = 6 };
    if (motion->complete || motion->guard_hit == 2 || !c->atlas) return false;
    c->failures = motion->count > 1 ? 0 : c->failures + 1;
    return c->failures < most_failures;
}

/* Least sizes of the states: of x and of the place those of coordinates; of the group's coordinates the change that
 * moves the place by as much, s_a = min_s size_s / |e_a^s|; of momenta none. */
static void least_sizes(const course *c, const double *place, double *least)
{
    const nh_group_flow *f = &c->f;
    const nh_slice *s = f->chart->slice;
    double *q = nh_alloc_array(f->m + 1, sizeof *q), *group = least + f->inner;
    memset(least, 0, nh_group_flow_size(f) * sizeof *least);
    for (size_t i = 0; i < s->n; i++) least[i] = place[s->shape[i]];
    if (f->group && place_of(c, c->state, q)) {
        nh_tape_eval(f->field, f->field_work, q, f->e);
        for (size_t a = 0; a < f->d; a++) {
            double most = 0;
            for (size_t r = 0; r < f->m; r++) most = fmax(most, fabs(f->e[r + a * f->m]) / place[r]);
            group[a] = most > 0 && isfinite(most) ? 1 / most : 0;
        }
    }
    if (f->group && f->direct) memcpy(group + f->d, place, f->m * sizeof *place);
    nh_free(q);
}

/* All parts up to the last output, or until no chart continues. */
static bool run(course *c, size_t count, const double *times, const nh_reconstruct_how *how, nh_error *error)
{
    enum { most_stretches = 10000 };
    const nh_method *method = how->method;
    /* one-step methods of low order take more and shorter steps */
    double patience = !method || method->family == NH_METHOD_CVODE ? 3000 : 30000;
    nh_reconstruction *out = c->out;
    nh_group_flow *f = &c->f;
    size_t stretches = 0;
    memcpy(c->left, times, count * sizeof *times);
    for (; !out->complete && stretches < most_stretches; stretches++) {
        double steps = how->steps - (double)out->steps;
        nh_flow_options o = {.rtol = how->tolerance,
                             .max_steps = fmax(c->atlas && c->failures < 5 ? fmin(steps, patience) : steps, 1),
                             .absolute = how->absolute,
                             .guarded = true};
        if (how->effort > 0) o.effort = fmax(how->effort - out->effort, 1);
        nh_flow_problem problem = {.size = nh_group_flow_size(f),
                                   .context = f,
                                   .rate = nh_group_flow_rate,
                                   .guards = 2 + (f->d > 0 && f->group),
                                   .guard = nh_group_flow_guard};
        if (how->place) {
            least_sizes(c, how->place, c->least);
            o.least = c->least;
        }
        size_t n = count - out->count, first = stretches > 0; /* a later part begins where the last one ended */
        if (first) memcpy(c->left + 1, times + out->count, n * sizeof *times);
        nh_motion *motion = nh_automatic_or(method, &problem, c->state, n + first, c->left, &o, NULL, error);
        if (!motion) return false;
        out->evaluations += motion->evaluations;
        out->steps += motion->steps;
        out->effort += motion->effort;
        out->seconds += motion->seconds;
        bool found = store(c, motion, first), late = how->effort > 0 && out->effort >= how->effort;
        out->complete = motion->complete && found;
        bool renew = may_renew(c, motion);
        /* a guard met at once is met again */
        bool guarded = motion->guard_hit >= 0 && motion->end_time != c->left[0] && (c->atlas || motion->guard_hit == 2);
        bool on = !out->complete && found && (double)out->steps < how->steps && !late && (guarded || renew) &&
                  go_on(c, motion, renew);
        if (!out->complete && !on) explain(c, motion, found, times);
        nh_motion_free(motion);
        if (!out->complete && !on) break;
    }
    if (!out->charts) out->first_chart = out->count;
    return true;
}

/* The start of a motion: on the chart, with the place itself and the moves that lead there from the chart's slice. */
typedef struct {
    const nh_reduced_chart *chart;
    const double *z, *q;
    size_t moves;
    const double *moved;
} beginning;

static nh_reconstruction *follow(nh_atlas *atlas, const beginning *at, bool group, size_t count, const double *times,
                                 const nh_reconstruct_how *how, nh_error *error)
{
    const nh_reduced_chart *chart = at->chart;
    const double *z = at->z, *q = at->q;
    const nh_slice *slice = chart->slice;
    size_t m = slice->m, inner = chart->reduced->n + chart->reduced->r;
    nh_reconstruction *out = nh_alloc(sizeof *out);
    *out = (nh_reconstruction){.m = m, .size = inner, .first = chart->reduced};
    course c = {.flows = nh_flows_create(slice->action), .atlas = atlas, .out = out};
    nh_group_flow_init(&c.f, slice->action, group);
    nh_group_flow_chart(&c.f, chart);
    c.state = nh_alloc_array(2 * (inner + c.f.d + m + 1), sizeof *c.state);
    c.least = c.state + inner + c.f.d + m + 1;
    c.left = nh_alloc_array(count + 2, sizeof *c.left);
    out->time = nh_alloc_array(count + 1, sizeof *out->time);
    out->q = group ? nh_alloc_array(count * m + 1, sizeof *out->q) : NULL;
    out->z = nh_alloc_array(count * inner + 1, sizeof *out->z);
    out->zeta = nh_alloc_array(count * c.f.d + 1, sizeof *out->zeta);
    out->energy = nh_alloc_array(2 * count + 2, sizeof *out->energy);
    out->energy_size = out->energy + count + 1;
    memcpy(c.state, z, inner * sizeof *z);
    for (size_t i = 0; i < at->moves && group; i++) keep_factors(&c, at->moved + i * c.f.d);
    begin_stretch(&c, q);
    bool good = run(&c, count, times, how, error);
    nh_group_flow_clear(&c.f);
    nh_flows_free(c.flows);
    nh_free(c.factor);
    nh_free(c.state);
    nh_free(c.left);
    if (good) return out;
    nh_reconstruction_free(out);
    nh_fail(error, NH_NUMERIC, "", "the group motion could not be reconstructed from the reduced motion");
    return NULL;
}

nh_reconstruction *nh_reconstruct(const nh_reduced *o, const nh_slice *slice, const double *z, size_t count,
                                  const double *times, const nh_reconstruct_how *how, nh_error *error)
{
    nh_reduced_chart chart = {.slice = slice, .reduced = o, .flow = nh_reduced_flow_create(o)};
    double *q = nh_alloc_array(slice->m, sizeof *q);
    nh_slice_place(slice, z, q);
    nh_reconstruction *out =
        follow(NULL, &(beginning){.chart = &chart, .z = z, .q = q}, true, count, times, how, error);
    nh_reduced_flow_free(chart.flow);
    nh_free(q);
    return out;
}

nh_reconstruction *nh_reconstruct_over(nh_atlas *atlas, const double *q, const double *v, bool group, size_t count,
                                       const double *times, const nh_reconstruct_how *how, nh_error *error)
{
    const nh_action *g = nh_atlas_action(atlas);
    const nh_slice *preferred = nh_atlas_preferred(atlas);
    size_t m = g->kinetic->m, moves = SIZE_MAX;
    double *z = nh_alloc_array(4 * m + NH_REACH_MOST * g->d + 1, sizeof *z), *place = z + 2 * m, *speed = place + m,
           *moved = speed + m;
    nh_error ignored = {0};
    memcpy(place, q, m * sizeof *q);
    memcpy(speed, v, m * sizeof *v);
    if (preferred) moves = nh_slice_reach(preferred, place, speed, moved);
    const nh_reduced_chart *chart = moves < SIZE_MAX ? nh_atlas_at(atlas, place, speed, z, &ignored) : NULL;
    if (!chart) moves = 0;
    if (!chart) chart = nh_atlas_at(atlas, q, v, z, error);
    nh_error_clear(&ignored);
    nh_reconstruction *out =
        chart ? follow(atlas, &(beginning){.chart = chart, .z = z, .q = q, .moves = moves, .moved = moved}, group,
                       count, times, how, error)
              : NULL;
    nh_free(z);
    return out;
}

void nh_reconstruction_free(nh_reconstruction *r)
{
    if (!r) return;
    nh_free(r->time);
    nh_free(r->q);
    nh_free(r->z);
    nh_free(r->zeta);
    nh_free(r->energy);
    nh_free(r);
}
