/* The first part of a step on which a function changes its sign (sign_changes.h).
 *
 *      begin                                        end
 *        o--o---o---x-o-----o-----o--x--o---o----o--o          o: Chebyshev points, x: checks of the interpolation
 *
 *      for each function        HAS_NONE   |c_0| > sum |c_k|, with the errors: no zero
 *                               HAS_ONE    |c_1| > sum k^2 |c_k|: monotonic, the ends show whether there is a zero
 *                               TOUCHES    it stays near its floor: it has no sign to change
 *                               OPEN       anything else
 *      one is OPEN: halve, and look at the left half first; otherwise compare the signs at the ends */
#include "motion/sign_changes.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { degree = 8, points = degree + 1, checks = 2, last = 4, most_depth = 44, most_samples = 1 << 14 };
static const double roundings = 64; /* of the time: the least length of a part; of a value: its error */
/* where the interpolation is checked: irrational, so that no oscillation repeats at them */
static const double place[checks] = {-0.6180339887498949, 0.2679491924311227};
/* of an interpolation: its error in units of its largest last coefficient; where that is a larger part of all, a kink
 * may hide, and the function must be far from 0 to have no zero */
static const double safety = 8, smooth = 1e-3, far_off = 2;

void nh_sign_changes_open(nh_sign_changes *c)
{
    c->doubtful = NAN;
    if (!c->count) return;
    size_t values = 2 * c->count;
    c->side = nh_alloc_array(c->count + (1 + points + checks) * values + c->size, sizeof *c->side);
    c->sample = c->side + c->count;
    c->probe = c->sample + (points + checks) * values;
    c->z = c->probe + values;
}

void nh_sign_changes_clear(nh_sign_changes *c)
{
    nh_free(c->side);
    c->side = NULL;
}

int nh_sign_changes_sign(const nh_sign_changes *c, const double *value, size_t i)
{
    return (value[i] > value[c->count + i]) - (value[i] < -value[c->count + i]);
}

void nh_sign_changes_take_sides(nh_sign_changes *c, double t, const double *z)
{
    memset(c->probe, 0, 2 * c->count * sizeof *c->probe);
    if (!c->value(t, z, c->probe, c->context)) return;
    for (size_t i = 0; i < c->count; i++) c->side[i] = nh_sign_changes_sign(c, c->probe, i);
}

bool nh_sign_changes_at(nh_sign_changes *c, double t, double *value)
{
    c->samples++;
    memset(value, 0, 2 * c->count * sizeof *value);
    return c->inside(t, c->z, c->inside_context) && c->value(t, c->z, value, c->context) &&
           nh_all_finite(c->count, value);
}

bool nh_sign_changes_crossed(nh_sign_changes *c, const double *value)
{
    for (size_t i = 0; i < c->count; i++) {
        int sign = nh_sign_changes_sign(c, value, i);
        if (c->side[i] == 0) c->side[i] = sign;
        if (sign * c->side[i] < 0) return true;
    }
    return false;
}

/* ---- one function on a part of the step ---- */

/* The coefficients c_k of the interpolation at x_j = -cos(pi j/degree). */
static void coefficients(const double *value, double *c)
{
    for (int k = 0; k <= degree; k++) {
        double sum = 0;
        for (int j = 0; j <= degree; j++) {
            double weight = j == 0 || j == degree ? 0.5 : 1;
            sum += weight * value[j] * cos(M_PI * k * (degree - j) / degree);
        }
        c[k] = sum * (k == 0 || k == degree ? 1.0 : 2.0) / degree;
    }
}

/* sum_k c_k T_k(x) by Clenshaw's recurrence. */
static double interpolated(const double *c, double x)
{
    double b[2] = {0, 0};
    for (int k = degree; k > 0; k--) {
        double next = c[k] + 2 * x * b[0] - b[1];
        b[1] = b[0], b[0] = next;
    }
    return c[0] + x * b[0] - b[1];
}

typedef enum { HAS_NONE, HAS_ONE, OPEN, TOUCHES } verdict;

/* How many zeros: none, one at most, not known yet, or not to be known: it stays near its floor. */
static verdict judge(const nh_sign_changes *s, size_t i)
{
    double value[points], c[points], largest = 0, floor = 0, rest = 0, bend = 0, off = 0;
    for (int j = 0; j < points + checks; j++) {
        const double *at = s->sample + (size_t)j * 2 * s->count;
        if (j < points) value[j] = at[i];
        largest = fmax(largest, fabs(at[i]));
        floor = fmax(floor, at[s->count + i]);
    }
    coefficients(value, c);
    for (int k = 1; k <= degree; k++) rest += fabs(c[k]);
    for (int k = 2; k <= degree; k++) bend += k * k * fabs(c[k]);
    for (int j = 0; j < checks; j++)
        off = fmax(off, fabs(interpolated(c, place[j]) - s->sample[(size_t)(points + j) * 2 * s->count + i]));
    double rounding = roundings * DBL_EPSILON * largest;
    for (int k = degree - last + 1; k <= degree; k++) off = fmax(off, fabs(c[k]));
    /* a kink near an end of the part hides below the floor only */
    bool resolved = off <= smooth * rest + rounding, flat = floor == 0 || off <= floor + rounding;
    off = safety * off + rounding;
    if (fabs(c[0]) > (resolved ? rest : far_off * rest) + off + floor) return HAS_NONE;
    if (flat && fabs(c[1]) > bend + degree * degree * off) return HAS_ONE;
    return largest > 2 * (floor + rounding) ? OPEN : TOUCHES;
}

/* ---- the parts of a step ---- */

/* Values and floors of all functions at the points and the checks: (points + checks) x 2 count. */
static bool take_samples(nh_sign_changes *c, double begin, double end)
{
    for (int j = 0; j < points + checks; j++) {
        double x = j < points ? -cos(M_PI * j / degree) : place[j - points];
        double t = j == 0 ? begin : j == degree ? end : begin + (end - begin) * (1 + x) / 2;
        if (!nh_sign_changes_at(c, t, c->sample + (size_t)j * 2 * c->count)) return false;
    }
    return true;
}

/* Searches a part and its halves in the order of the motion; near and far are the ends of the part with the change. */
static bool scan(nh_sign_changes *c, double begin, double end, int depth, double *near, double *far)
{
    double least = roundings * DBL_EPSILON * fmax(fabs(begin), fabs(end));
    if (c->samples > most_samples) c->exhausted = true;
    if (c->exhausted || begin == end || !take_samples(c, begin, end)) return false;
    bool open = false, divisible = depth < most_depth && fabs(end - begin) > least;
    for (size_t i = 0; i < c->count && divisible; i++) {
        verdict v = judge(c, i);
        open |= v == OPEN;
        if (v == TOUCHES && c->side[i] != 0 && isnan(c->doubtful)) c->doubtful = begin + (end - begin) / 2;
    }
    if (open) {
        double middle = begin + (end - begin) / 2;
        return scan(c, begin, middle, depth + 1, near, far) || scan(c, middle, end, depth + 1, near, far);
    }
    *near = begin, *far = end;
    return nh_sign_changes_crossed(c, c->sample + degree * 2 * c->count);
}

bool nh_sign_changes_first(nh_sign_changes *c, double before, double now, double *near, double *far)
{
    c->samples = 0;
    c->exhausted = false;
    return scan(c, before, now, 0, near, far);
}
