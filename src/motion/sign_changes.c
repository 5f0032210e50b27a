#include "motion/sign_changes.h"

#include <float.h>
#include <math.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { points = 9, most_depth = 40, most_samples = 4096 };
/* how well samples must predict each other, as a part of the range of a function in a step */
static const double resolved_to = 0.1;
static const double rounding = 1e-12; /* the same, as a part of its size */
static const double roundings = 64;   /* least distance of samples, in roundings of the time */

void nh_sign_changes_open(nh_sign_changes *c)
{
    if (!c->count) return;
    c->side = nh_alloc_array((2 + points) * c->count + c->size, sizeof *c->side);
    c->sample = c->side + c->count;
    c->probe = c->sample + points * c->count;
    c->z = c->probe + c->count;
}

void nh_sign_changes_clear(nh_sign_changes *c)
{
    nh_free(c->side);
    c->side = NULL;
}

void nh_sign_changes_take_sides(nh_sign_changes *c, double t, const double *z)
{
    if (!c->value(t, z, c->probe, c->context)) return;
    for (size_t i = 0; i < c->count; i++) c->side[i] = (c->probe[i] > 0) - (c->probe[i] < 0);
}

bool nh_sign_changes_at(nh_sign_changes *c, double t, double *value)
{
    c->samples++;
    return c->inside(t, c->z, c->inside_context) && c->value(t, c->z, value, c->context) &&
           nh_all_finite(c->count, value);
}

bool nh_sign_changes_crossed(nh_sign_changes *c, const double *value)
{
    for (size_t i = 0; i < c->count; i++) {
        if (c->side[i] == 0) c->side[i] = (value[i] > 0) - (value[i] < 0);
        if (value[i] * c->side[i] < 0) return true;
    }
    return false;
}

/* Do cubics through every second sample predict the samples between them? */
static bool is_resolved(const nh_sign_changes *c, size_t which)
{
    double g[points], low = INFINITY, high = -INFINITY;
    for (size_t j = 0; j < points; j++) {
        g[j] = c->sample[j * c->count + which];
        low = fmin(low, g[j]);
        high = fmax(high, g[j]);
    }
    double enough = resolved_to * (high - low) + rounding * fmax(fabs(low), fabs(high));
    for (int j = 1; j < points; j += 2) {
        int a = j < 3 ? 0 : j > 5 ? 2 : j - 3;
        const double *x = g + a;
        double told = j < 3   ? (5 * x[0] + 15 * x[2] - 5 * x[4] + x[6]) / 16
                      : j > 5 ? (x[0] - 5 * x[2] + 15 * x[4] + 5 * x[6]) / 16
                              : (9 * (x[2] + x[4]) - x[0] - x[6]) / 16;
        if (!(fabs(told - g[j]) <= enough)) return false;
    }
    return true;
}

/* Where the parabola through three samples of one sign comes nearest to zero between them, as a part of the way from
 * the first to the last; NAN: at one of their ends. */
static double nearest(double a, double b, double c)
{
    double bend = a - 2 * b + c, at = 0.5 + (a - c) / (4 * bend);
    return a * b > 0 && b * c > 0 && fabs(b) <= fabs(a) && fabs(b) <= fabs(c) && at > 0 && at < 1 ? at : NAN;
}

/* The same between begin and begin + 2 width, with three values there: does the function cross zero and return around
 * the middle?  A time beyond zero; NAN: none. */
static double excursion(nh_sign_changes *c, size_t which, double begin, double width, double first, double middle,
                        double last)
{
    static const double shorter = 0.25; /* the next time, as a part of the way from the middle to an end */
    for (int i = 0; i < c->closer; i++) {
        double part = nearest(first, middle, last), at = begin + 2 * part * width;
        if (isnan(part) || !nh_sign_changes_at(c, at, c->probe)) return NAN;
        if (nh_sign_changes_crossed(c, c->probe)) return at;
        if (i + 1 == c->closer) return NAN;
        middle = c->probe[which];
        width = copysign(fmin(shorter * fabs(width), fmin(fabs(at - begin), fabs(begin + 2 * width - at))), width);
        begin = at - width;
        if (!(fabs(width) > 0) || !nh_sign_changes_at(c, begin, c->probe)) return NAN;
        if (nh_sign_changes_crossed(c, c->probe)) return begin;
        first = c->probe[which];
        if (!nh_sign_changes_at(c, begin + 2 * width, c->probe)) return NAN;
        if (nh_sign_changes_crossed(c, c->probe)) return begin + 2 * width;
        last = c->probe[which];
    }
    return NAN;
}

/* Samples j - 1 and j are on this side: does the function cross to the other side and return around sample j? */
static double touched(nh_sign_changes *c, double begin, double width, size_t j)
{
    for (size_t i = 0; i < c->count && j + 1 < points; i++) {
        const double *g = c->sample + (j - 1) * c->count + i;
        double at = excursion(c, i, begin + ((double)j - 1) * width, width, g[0], g[c->count], g[2 * c->count]);
        if (!isnan(at)) return at;
    }
    return NAN;
}

/* Do cubics predict the values between samples, too?  Samples at equal distances can show a fast oscillation as a slow
 * one. */
static bool is_foretold(nh_sign_changes *c, double begin, double width)
{
    static const double odd =
        /* parts of the way to the next sample: irrational, so that no oscillation repeats at them */
        0.3819660112501051;
    for (int a = 1; a < points - 3; a += 3) {
        if (!nh_sign_changes_at(c, begin + (a + 1 + odd) * width, c->probe)) return false;
        for (size_t i = 0; i < c->count; i++) {
            double g[4], x = odd, low = INFINITY, high = -INFINITY;
            for (int j = 0; j < 4; j++) {
                g[j] = c->sample[(size_t)(a + j) * c->count + i];
                low = fmin(low, g[j]);
                high = fmax(high, g[j]);
            }
            double told = -x * (x - 1) * (x - 2) / 6 * g[0] + (x + 1) * (x - 1) * (x - 2) / 2 * g[1] -
                          (x + 1) * x * (x - 2) / 2 * g[2] + (x + 1) * x * (x - 1) / 6 * g[3];
            if (!(fabs(told - c->probe[i]) <= resolved_to * (high - low) + rounding * fmax(fabs(low), fabs(high))))
                return false;
        }
    }
    return true;
}

static bool scan(nh_sign_changes *c, double begin, double end, int depth, double *near, double *far)
{
    double width = (end - begin) / (points - 1), least = roundings * DBL_EPSILON * fmax(fabs(begin), fabs(end));
    if (c->samples > most_samples) c->exhausted = true;
    if (c->exhausted || !(fabs(width) > 0)) return false;
    for (size_t j = 0; j < points; j++)
        if (!nh_sign_changes_at(c, j + 1 < points ? begin + (double)j * width : end, c->sample + j * c->count))
            return false;
    bool resolved = true, divisible = depth < most_depth && fabs(width) > least;
    for (size_t i = 0; i < c->count && divisible; i++) resolved = resolved && is_resolved(c, i);
    if (divisible && (!resolved || !is_foretold(c, begin, width))) {
        double middle = begin + (end - begin) / 2;
        return scan(c, begin, middle, depth + 1, near, far) || scan(c, middle, end, depth + 1, near, far);
    }
    /* at the beginning the function is on this side, also where rounding hides that */
    for (size_t j = 1; j < points; j++) {
        double at = begin + (double)j * width;
        *near = at - width, *far = j + 1 < points ? at : end;
        if (nh_sign_changes_crossed(c, c->sample + j * c->count)) return true;
        double beyond = touched(c, begin, width, j);
        if (!isnan(beyond)) return *far = beyond, true;
    }
    return false;
}

bool nh_sign_changes_first(nh_sign_changes *c, double before, double now, double *near, double *far)
{
    c->samples = 0;
    c->exhausted = false;
    return scan(c, before, now, 0, near, far);
}
