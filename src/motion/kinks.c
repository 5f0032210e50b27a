#include "motion/kinks.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/progress.h"

enum { points = 9, most_depth = 40, most_samples = 4096, many = 20, most_halvings = 200 };
static const double resolved_to = 0.1;    /* of the range of a wall's function in a step: how well its samples foretell each other */
static const double rounding = 1e-12;     /* of its size */
static const double roundings = 16;       /* of the time, in `least` */
static const double nearer = 1e-3;        /* of the way to a wall is left by a step towards it */
static const double no_time = 1e-6;       /* of the whole motion: so many crossings in less would be more than there can be steps */

static void take_sides(nh_kinks *k, double t, const double *z)
{
    if (!k->wall(t, z, k->probe, k->context)) return;
    for (size_t i = 0; i < k->walls; i++) k->side[i] = (k->probe[i] > 0) - (k->probe[i] < 0);
}

/* Of states with `size` entries, and walls that are functions of the first of them. */
static void watch(nh_kinks *k, size_t walls, bool (*wall)(double, const double *, double *, void *), void *context, size_t size, const double *z, const double ends[2])
{
    *k = (nh_kinks){.walls = walls, .size = size, .wall = wall, .context = context, .longest = INFINITY, .last = NAN, .span = fabs(ends[1] - ends[0]), .from = ends[0], .seen = INFINITY};
    k->least = roundings * DBL_EPSILON * fmax(fabs(ends[0]), fabs(ends[1]));
    if (!walls) return;
    k->side = nh_alloc_array((2 + points) * walls + 5 * size, sizeof *k->side);
    k->sample = k->side + walls;
    k->probe = k->sample + points * walls;
    k->z = k->probe + walls;
    k->ends = k->z + size;
    take_sides(k, ends[0], z);
}

void nh_kinks_begin(nh_kinks *k, const nh_flow_problem *p, const double *z, size_t count, const double *times)
{
    watch(k, p->walls, p->wall, p->context, p->size, z, (double[]){times[0], times[count - 1]});
}

void nh_kinks_coarser(nh_kinks *k, double time) { k->least = fmax(k->least, time); }

void nh_kinks_clear(nh_kinks *k)
{
    nh_free(k->side);
    k->side = NULL;
}

/* ---- the first wall within a step ---- */

typedef struct {
    nh_kinks *k;
    nh_inside *state;
    void *context;
} look;

static bool walls_at(look *l, double t, double *value)
{
    l->k->samples++;
    return l->state(t, l->k->z, l->context) && l->k->wall(t, l->k->z, value, l->k->context) && nh_all_finite(l->k->walls, value);
}

/* Is a wall behind?  A side that is not known yet becomes the one on which the motion is. */
static bool crossed(nh_kinks *k, const double *value)
{
    for (size_t i = 0; i < k->walls; i++) {
        if (k->side[i] == 0) k->side[i] = (value[i] > 0) - (value[i] < 0);
        if (value[i] * k->side[i] < 0) return true;
    }
    return false;
}

/* Do cubics through every other sample foretell those between them? */
static bool is_resolved(const nh_kinks *k, size_t wall)
{
    double g[points], low = INFINITY, high = -INFINITY;
    for (size_t j = 0; j < points; j++) {
        g[j] = k->sample[j * k->walls + wall];
        low = fmin(low, g[j]);
        high = fmax(high, g[j]);
    }
    double enough = resolved_to * (high - low) + rounding * fmax(fabs(low), fabs(high));
    for (int j = 1; j < points; j += 2) {
        int a = j < 3 ? 0 : j > 5 ? 2 : j - 3;
        const double *x = g + a;
        double told = j < 3 ? (5 * x[0] + 15 * x[2] - 5 * x[4] + x[6]) / 16 : j > 5 ? (x[0] - 5 * x[2] + 15 * x[4] + 5 * x[6]) / 16 : (9 * (x[2] + x[4]) - x[0] - x[6]) / 16;
        if (!(fabs(told - g[j]) <= enough)) return false;
    }
    return true;
}

/* Between a time on this side and one behind a wall: the first behind it, to rounding. */
static double bisect(look *l, double near, double far)
{
    for (int i = 0; i < most_halvings; i++) {
        double middle = near + (far - near) / 2;
        if (middle == near || middle == far || !walls_at(l, middle, l->k->probe)) break;
        if (crossed(l->k, l->k->probe)) far = middle;
        else near = middle;
    }
    return far;
}

/* Where the parabola through three samples of one sign comes nearest to zero between them: in parts of the way from the first to the last; NAN: at their ends. */
static double nearest(double a, double b, double c)
{
    double bend = a - 2 * b + c, at = 0.5 + (a - c) / (4 * bend);
    return a * b > 0 && b * c > 0 && fabs(b) <= fabs(a) && fabs(b) <= fabs(c) && at > 0 && at < 1 ? at : NAN;
}

static double scan(look *l, double begin, double end, int depth);

static double scan_halves(look *l, double begin, double end, int depth)
{
    double middle = begin + (end - begin) / 2, found = scan(l, begin, middle, depth + 1);
    return isnan(found) ? scan(l, middle, end, depth + 1) : found;
}

/* Samples j - 1 and j are on this side: is there an excursion beyond the wall around sample j? */
static double touched(look *l, double begin, double width, size_t j)
{
    nh_kinks *k = l->k;
    for (size_t i = 0; i < k->walls && j + 1 < points; i++) {
        const double *g = k->sample + (j - 1) * k->walls + i;
        double part = nearest(g[0], g[k->walls], g[2 * k->walls]), at = begin + ((double)j - 1 + 2 * part) * width;
        if (!isnan(part) && walls_at(l, at, k->probe) && crossed(k, k->probe)) return at;
    }
    return NAN;
}

static double scan(look *l, double begin, double end, int depth)
{
    nh_kinks *k = l->k;
    double width = (end - begin) / (points - 1);
    if (k->samples > most_samples || !(fabs(width) > 0)) return NAN;
    for (size_t j = 0; j < points; j++)
        if (!walls_at(l, j + 1 < points ? begin + (double)j * width : end, k->sample + j * k->walls)) return NAN;
    for (size_t i = 0; i < k->walls && depth < most_depth; i++)
        if (!is_resolved(k, i)) return scan_halves(l, begin, end, depth);
    for (size_t j = 1; j < points; j++) { /* at the beginning it is on this side, where rounding may not show that */
        double at = begin + (double)j * width;
        if (crossed(k, k->sample + j * k->walls)) return bisect(l, at - width, j + 1 < points ? at : end);
        double far = touched(l, begin, width, j);
        if (!isnan(far)) return bisect(l, at - width, far);
    }
    return NAN;
}

/* From now on the motion is behind the wall, at the state in k->z. */
void nh_kinks_go_over(nh_kinks *k, double t, nh_motion *motion)
{
    k->crossed++;
    take_sides(k, t, k->z);
    k->longest = INFINITY;
    if (k->crossed % many) return;
    bool held = fabs(t - k->last) <= no_time * k->span;
    k->last = t;
    if (!held) return;
    k->held = true;
    nh_motion_note(motion, "near t = %.10g the motion reaches a kink of its equations, and both sides lead back to it: the equations do not determine the continuation", t);
}

/* Does the step end exactly on a wall? */
static bool ends_on_wall(nh_kinks *k, double t, look *l)
{
    bool on = false;
    if (!walls_at(l, t, k->probe)) return false;
    for (size_t i = 0; i < k->walls; i++) on |= k->probe[i] == 0 && k->side[i] != 0;
    return on;
}

double nh_kinks_first(nh_kinks *k, double before, double now, nh_inside *state, void *context)
{
    look l = {k, state, context};
    k->samples = 0;
    double at = scan(&l, before, now, 0);
    return isnan(at) && ends_on_wall(k, now, &l) ? now : at;
}

/* ---- one-step methods ---- */

typedef struct {
    const nh_kinks *k;
    double before, now;
} segment;

/* Hermite's cubic through the ends of a step. */
static bool between(double t, double *z, void *context)
{
    const segment *s = context;
    size_t n = s->k->size;
    const double *z0 = s->k->ends, *z1 = z0 + n, *f0 = z1 + n, *f1 = f0 + n;
    double h = s->now - s->before, x = (t - s->before) / h, y = 1 - x;
    for (size_t i = 0; i < n; i++) z[i] = y * y * (1 + 2 * x) * z0[i] + x * x * (1 + 2 * y) * z1[i] + h * x * y * (y * f0[i] - x * f1[i]);
    return true;
}

void nh_kinks_see(nh_kinks *k, double t, const double *z)
{
    if (!k->walls || !k->wall(t, z, k->probe, k->context)) return;
    for (size_t i = 0; i < k->walls; i++)
        if (k->probe[i] * k->side[i] < 0 && !(fabs(t - k->from) > fabs(k->seen - k->from))) k->seen = t;
}

/* How far a step may go: to the wall that its ends show, or half as far where the method saw one that they do not. */
static double way_to_wall(const nh_kinks *k, double at, double way)
{
    if (isnan(at)) return way / 2;
    double to = fabs(at - k->from);
    return to <= k->least ? k->least : to - fmax(nearer * to, k->least / 4);
}

nh_kink_verdict nh_kinks_judge(nh_kinks *k, const nh_flow_problem *p, double before, const double *old, double now, const double *z, nh_motion *motion)
{
    if (!k->walls || now == before) return NH_KINK_NONE;
    size_t n = k->size;
    memcpy(k->ends, old, n * sizeof *old);
    memcpy(k->ends + n, z, n * sizeof *z);
    bool good = p->rate(before, old, k->ends + 2 * n, p->context) && p->rate(now, z, k->ends + 3 * n, p->context);
    segment s = {k, before, now};
    double at = good ? nh_kinks_first(k, before, now, between, &s) : NAN, way = fabs(now - before);
    if (!good) { /* exactly on a wall, where there may be no rates: fall short of it, or go a little further */
        k->longest = way > 2 * k->least ? way / 2 : 1.5 * way;
        k->seen = INFINITY;
        return NH_KINK_BACK;
    }
    bool seen = fabs(k->seen - before) <= way;
    k->from = now;
    k->seen = INFINITY;
    if (isnan(at) && !seen) {
        k->longest = INFINITY;
        return NH_KINK_NONE;
    }
    if (way > 2 * k->least) {
        k->from = before;
        k->longest = way_to_wall(k, at, way);
        return NH_KINK_BACK;
    }
    memcpy(k->z, z, n * sizeof *z);
    nh_kinks_go_over(k, now, motion);
    return k->held ? NH_KINK_END : NH_KINK_CROSSED;
}
