/* Steps that end at walls (wall_steps.h).
 *
 *         before          wall            now
 *           |--------------|---------------|          1. the first wall in the step, by signs inside
 *           |------x                                  2. one-step methods: undo it, and step to just before the wall,
 *                  |----x                                 each time by all but a thousandth of the way
 *                       |-x                           3. a step as short as the rounding of time leads across
 *                         ||---> longer again
 *
 * A method with many steps behind it hands this to a one-step method, and starts anew behind the wall. */
#include "motion/wall_steps.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum { many = 20, most_halvings = 200 };
static const double roundings = 16; /* of the time: `least` is so long at least */
static const double nearer = 1e-3;  /* part of the way to a wall that a step towards it leaves */
/* part of the whole motion: a motion with `many` crossings in less time cannot leave the wall */
static const double no_time = 1e-6;

void nh_wall_steps_begin(nh_wall_steps *k, const nh_flow_problem *p, const double *z, size_t count, const double *times)
{
    double begin = times[0], end = times[count - 1];
    *k = (nh_wall_steps){.change = {.count = p->walls, .size = p->size, .value = p->wall, .context = p->context},
                         .longest = INFINITY,
                         .last = NAN,
                         .span = fabs(end - begin),
                         .from = begin,
                         .seen = INFINITY};
    k->least = roundings * DBL_EPSILON * fmax(fabs(begin), fabs(end));
    if (!p->walls) return;
    nh_sign_changes_open(&k->change);
    k->ends = nh_alloc_array(4 * p->size, sizeof *k->ends);
    nh_sign_changes_take_sides(&k->change, begin, z);
}

void nh_wall_steps_coarser(nh_wall_steps *k, double time) { k->least = fmax(k->least, time); }

void nh_wall_steps_clear(nh_wall_steps *k)
{
    nh_sign_changes_clear(&k->change);
    nh_free(k->ends);
    k->ends = NULL;
}

/* ---- the first wall within a step ---- */

/* From a time on this side and one behind a wall: the first time behind it, to rounding. */
static double bisect(nh_sign_changes *c, double near, double far)
{
    for (int i = 0; i < most_halvings; i++) {
        double middle = near + (far - near) / 2;
        if (middle == near || middle == far || !nh_sign_changes_at(c, middle, c->probe)) break;
        if (nh_sign_changes_crossed(c, c->probe)) far = middle;
        else near = middle;
    }
    return far;
}

/* From now on the motion is behind the wall, at the state k->change.z. */
void nh_wall_steps_go_over(nh_wall_steps *k, double t, nh_motion *motion)
{
    k->crossed++;
    nh_sign_changes_take_sides(&k->change, t, k->change.z);
    k->longest = INFINITY;
    if (k->crossed % many) return;
    bool held = fabs(t - k->last) <= no_time * k->span;
    k->last = t;
    if (!held) return;
    k->held = true;
    nh_motion_note(motion,
                   "near t = %.10g the motion reaches a kink of its equations, and both sides lead back to it: the "
                   "equations do not determine the continuation",
                   t);
}

/* Does the step end exactly on a wall? */
static bool ends_on_wall(nh_sign_changes *c, double t)
{
    bool on = false;
    if (!nh_sign_changes_at(c, t, c->probe)) return false;
    for (size_t i = 0; i < c->count; i++) on |= c->probe[i] == 0 && c->side[i] != 0;
    return on;
}

double nh_wall_steps_first(nh_wall_steps *k, double before, double now, nh_inside *state, void *context)
{
    nh_sign_changes *c = &k->change;
    double near, far;
    c->inside = state;
    c->inside_context = context;
    if (nh_sign_changes_first(c, before, now, &near, &far)) return bisect(c, near, far);
    return ends_on_wall(c, now) ? now : NAN;
}

/* ---- one-step methods ---- */

typedef struct {
    const nh_wall_steps *k;
    double before, now;
} segment;

/* Hermite's cubic through the ends of a step. */
static bool between(double t, double *z, void *context)
{
    const segment *s = context;
    size_t n = s->k->change.size;
    const double *z0 = s->k->ends, *z1 = z0 + n, *f0 = z1 + n, *f1 = f0 + n;
    double h = s->now - s->before, x = (t - s->before) / h, y = 1 - x;
    for (size_t i = 0; i < n; i++)
        z[i] = y * y * (1 + 2 * x) * z0[i] + x * x * (1 + 2 * y) * z1[i] + h * x * y * (y * f0[i] - x * f1[i]);
    return true;
}

void nh_wall_steps_see(nh_wall_steps *k, double t, const double *z)
{
    if (!k->change.count || !k->change.value(t, z, k->change.probe, k->change.context)) return;
    for (size_t i = 0; i < k->change.count; i++)
        if (k->change.probe[i] * k->change.side[i] < 0 && !(fabs(t - k->from) > fabs(k->seen - k->from))) k->seen = t;
}

/* The longest next step: to the wall that the ends of the step show, or half as long where the method evaluated the
 * rates behind a wall that they do not show. */
static double way_to_wall(const nh_wall_steps *k, double at, double way)
{
    if (isnan(at)) return way / 2;
    double to = fabs(at - k->from);
    return to <= k->least ? k->least : to - fmax(nearer * to, k->least / 4);
}

nh_wall_verdict nh_wall_steps_judge(nh_wall_steps *k, const nh_flow_problem *p, double before, const double *old,
                                    double now, const double *z, nh_motion *motion)
{
    if (!k->change.count || now == before) return NH_WALL_NONE;
    size_t n = k->change.size;
    memcpy(k->ends, old, n * sizeof *old);
    memcpy(k->ends + n, z, n * sizeof *z);
    bool good = p->rate(before, old, k->ends + 2 * n, p->context) && p->rate(now, z, k->ends + 3 * n, p->context);
    segment s = {k, before, now};
    double at = good ? nh_wall_steps_first(k, before, now, between, &s) : NAN, way = fabs(now - before);
    if (!good) { /* exactly on a wall, where rates may be undefined: end before it, or a little behind it */
        k->longest = way > 2 * k->least ? way / 2 : 1.5 * way;
        k->seen = INFINITY;
        return NH_WALL_BACK;
    }
    bool seen = fabs(k->seen - before) <= way;
    k->from = now;
    k->seen = INFINITY;
    if (isnan(at) && !seen) {
        k->longest = INFINITY;
        return NH_WALL_NONE;
    }
    if (way > 2 * k->least) {
        k->from = before;
        k->longest = way_to_wall(k, at, way);
        return NH_WALL_BACK;
    }
    memcpy(k->change.z, z, n * sizeof *z);
    nh_wall_steps_go_over(k, now, motion);
    return k->held ? NH_WALL_END : NH_WALL_CROSSED;
}
