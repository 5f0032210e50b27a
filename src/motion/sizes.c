/* How large states are (sizes.h), in this order at the start of a motion:
 *
 *      1. tau := the whole time; shorter, until rates change by no more than their own size within tau (sizes_within):
 *             z --tau f(z)--> z_1 --tau f(z_1)--> z_2 ..     Picard: each state that a state moves gets a size, too
 *      2. a smaller tau for the sizes, then the rounding of the rates from their third differences along a line
 *      3. states whose rates are drowned by rounding move nothing
 *      4. states without any size: what the others can make of them within tau
 *
 * Along the motion the sizes follow the largest |z_i|. */
#include "motion/sizes.h"

#include <float.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { POINTS = 10, THIRDS = POINTS - 3 }; /* of a line, and third differences along it */
enum { most_shorter = 60, least_levels = 4, most_levels = 64, between_measures = 32 };
static const double shorter = 0.25; /* factor from one tau that is tried to the next */
static const double within = 0.25;  /* part of the tau that is found, which is used */
/* From one state of a line to the next, as a part of the sizes: far more than a rounding, and so short that rates bend
 * by less than their rounding.  The noise is at most so many times less than third differences. */
static const double apart = 0x1p-27, noise = 1.5;
static const double disturbance = 4; /* roundings of each state, whose effect on the rates is measured */
/* a state has no digits if its rounding in a step is a larger part of its size */
static const double drowned = 1e-3;
/* Rounding may take this part of the tolerance; or it may be what so many times tau make of it, because the steps of
 * implicit methods can be far longer than tau. */
static const double rest = 0.1, several = 4;
/* A state that was once so many times its rounding has digits.  Near a place where the formulas lose theirs its error
 * stays below such a part of its size. */
static const double distinct = 1e9, most_noise = 1e-9;
static const double grown = 1e3; /* a size that grows so much in one step of the iteration is not known yet */
/* size of a state that nothing moves so far, as a part of the smallest size */
static const double nothing = 1e-6;

static bool rate_at(nh_sizes *s, double t, const double *z, double *rate)
{
    s->evaluations++;
    return s->problem->rate(t, z, rate, s->problem->context) && nh_all_finite(s->problem->size, rate);
}

static double middle_of(size_t count, double *values)
{
    gsl_sort(values, 1, count);
    return values[(count - 1) / 2];
}

/* Rounding of the rates, the largest so far: their change by rounding of states of these sizes, and what third
 * differences along a short line say about the rounding inside their evaluation (More and Wild 2011, SIAM Journal on
 * Scientific Computing 33, 1292: computational noise).  Neither is seen in states that differ by single roundings: a
 * difference of large terms is a multiple of their last digit.  A kink or a jump on the line changes two or three of
 * the differences, and not their median.  The time moves as well: functions of time alone have their rounding, too. */
static void measure_rounding(nh_sizes *s, double t, double tau, const double *z, const double *size, double *rounding)
{
    size_t n = s->problem->size;
    double *moved = s->work + 3 * n, *f = s->line, slope[POINTS - 1], third[THIRDS];
    uint64_t random = 0x9e3779b97f4a7c15u + (uint64_t)s->followed;
    for (int k = 0; k < POINTS; k++) {
        uint64_t same = random;
        for (size_t i = 0; i < n; i++) {
            same = same * 6364136223846793005u + 1442695040888963407u;
            /* unequal changes: equal ones of several states may be a symmetry */
            moved[i] = z[i] + k * apart * size[i] * ((double)(int64_t)same * 0x1p-63);
        }
        if (!rate_at(s, t + k * apart * tau, moved, f + (size_t)k * n)) return;
    }
    for (size_t i = 0; i < n; i++) {
        const double *at = f + i;
        for (int k = 0; k + 1 < POINTS; k++, at += n) slope[k] = at[n] - at[0];
        for (int k = 0; k < THIRDS; k++) third[k] = fabs(slope[k + 2] - 2 * slope[k + 1] + slope[k]);
        for (int k = 0; k + 1 < POINTS; k++) slope[k] = fabs(slope[k]);
        double linear = middle_of(POINTS - 1, slope), bent = middle_of(THIRDS, third);
        rounding[i] = fmax(rounding[i], fmax(linear * (disturbance * DBL_EPSILON / apart), bent / noise));
    }
}

/* A state whose rate grows so much is zero for the moment, if rounding is what it has. */
static bool suspect(double own, double tau, double rate) { return grown * own < fabs(tau * rate); }

/* Is what the suspects have no more than the rounding of the other states makes of them? */
static bool are_zero(nh_sizes *s, double t, double tau, const double *z, const double *to, const double *rate)
{
    size_t n = s->problem->size;
    double *size = nh_alloc_array(2 * n, sizeof *size), *rounding = size + n;
    bool all = true;
    for (size_t i = 0; i < n; i++) size[i] = suspect(s->size[i], tau, rate[i]) ? 0 : s->size[i];
    measure_rounding(s, t, tau, z, size, rounding);
    measure_rounding(s, t + tau, tau, to, size, rounding);
    for (size_t i = 0; i < n; i++)
        if (suspect(s->size[i], tau, rate[i])) all &= drowned * s->size[i] <= fabs(tau) * rounding[i];
    nh_free(size);
    return all;
}

/* Rates of states that are zero so far are zero, too, where rounding is what they have. */
static void clear_drowned(nh_sizes *s, double t, double tau, const double *z, double *rate)
{
    size_t n = s->problem->size;
    double *size = nh_alloc_array(2 * n, sizeof *size), *rounding = size + n;
    bool any = false;
    for (size_t i = 0; i < n; i++) {
        any |= s->size[i] == 0 && rate[i] != 0;
        size[i] = fmax(s->size[i], fabs(tau * rate[i]));
    }
    if (any) measure_rounding(s, t, tau, z, size, rounding);
    for (size_t i = 0; i < n && any; i++)
        if (s->size[i] == 0 && drowned * fabs(rate[i]) <= rounding[i]) rate[i] = 0;
    nh_free(size);
}

/* One step of Picard's iteration: replaces the rates f by those at z + tau f, and enlarges the sizes by them.  False:
 * they are not defined, or differ from f by more than the sizes allow. */
static bool moves_on(nh_sizes *s, double t, double tau, const double *z, double *f, bool *more)
{
    size_t n = s->problem->size;
    double *to = s->work + n, *rate = s->work + 2 * n;
    bool any = false;
    for (size_t i = 0; i < n; i++) to[i] = z[i] + tau * f[i];
    if (!rate_at(s, t + tau, to, rate)) return false;
    clear_drowned(s, t + tau, tau, to, rate);
    for (size_t i = 0; i < n; i++) {
        bool known = fabs(z[i]) + fabs(tau * s->start[i]) > s->size[i] / grown; /* or it moved only with the others */
        if (s->size[i] == 0 || fabs(tau * (rate[i] - f[i])) <= (known ? 1 : several) * s->size[i]) continue;
        if (!suspect(s->size[i], tau, rate[i])) return false;
        any = true;
    }
    if (any && !are_zero(s, t, tau, z, to, rate)) return false;
    for (size_t i = 0; i < n; i++) {
        double size = fmax(s->size[i], fabs(tau * rate[i]));
        *more |= size > grown * s->size[i];
        s->size[i] = size;
    }
    memcpy(f, rate, n * sizeof *f);
    return true;
}

/* Sizes by the motion within tau from z, where the rates are f: states that move, then states that are moved by these.
 * False: tau is too long. */
static bool sizes_within(nh_sizes *s, double t, double tau, const double *z, const double *f)
{
    size_t n = s->problem->size;
    bool good = true, more = true;
    memcpy(s->work, f, n * sizeof *f);
    for (size_t i = 0; i < n; i++) s->size[i] = fmax(fabs(z[i]), s->least ? s->least[i] : 0);
    clear_drowned(s, t, tau, z, s->work);
    for (size_t i = 0; i < n; i++) s->size[i] = fmax(s->size[i], fabs(tau * s->work[i]));
    for (int level = 0; level < most_levels && more && good; level++) {
        more = level + 1 < least_levels;
        good = moves_on(s, t, tau, z, s->work, &more);
    }
    return good;
}

static void allocate(nh_sizes *s, const nh_flow_problem *problem)
{
    *s = (nh_sizes){.problem = problem, .size = nh_alloc_array((13 + POINTS) * problem->size, sizeof *s->size)};
    s->rounding = s->size + problem->size;
    s->reach = s->rounding + problem->size;
    s->work = s->reach + problem->size;
    s->start = s->work + 8 * problem->size;
    s->normal = s->start + problem->size;
    s->line = s->normal + problem->size;
}

/* Measures rounding with what the states can be: where the sizes of the others make more of a state within tau, its
 * error is that of its rate, and an error of all rates that depend on it.  At the start that holds for all states,
 * which may be far smaller than their sizes; later for those that lost digits so. */
static void measure(nh_sizes *s, double t, const double *z, double least)
{
    measure_rounding(s, t, s->tau, z, s->reach, s->rounding);
    for (size_t i = 0; i < s->problem->size; i++) {
        double made = s->pace * s->rounding[i];
        s->reach[i] = fmax(s->reach[i], made > least * s->size[i] ? made / (disturbance * DBL_EPSILON) : s->size[i]);
    }
}

/* Which states have digits now; what a state is expected to become says nothing. */
static void note_normal(nh_sizes *s, const double *z)
{
    for (size_t i = 0; i < s->problem->size; i++)
        if (fabs(z[i]) > distinct * s->pace * s->rounding[i]) s->normal[i] = 1;
}

/* The time, at most tau, in which no state that is not zero at the start could change by more than its size: on the
 * slow manifold of a stiff system tau is far longer than its fast times. */
static double pace_of(const nh_sizes *s, const double *z)
{
    double pace = s->tau;
    for (size_t i = 0; i < s->problem->size; i++)
        if (grown * fabs(z[i]) > s->size[i])
            pace = fmin(pace, disturbance * DBL_EPSILON * s->size[i] / s->rounding[i]); /* not by infinity, nor NAN */
    return pace;
}

/* Sizes of states that are still zero: as large as the others can make them within tau; of those that nothing moves,
 * small relative to all others. */
static void fill(nh_sizes *s)
{
    double least = INFINITY;
    for (size_t i = 0; i < s->problem->size; i++) {
        if (!(s->size[i] > 0)) s->size[i] = s->reach[i];
        if (s->size[i] > 0) least = fmin(least, s->size[i]);
    }
    if (isinf(least)) least = 1;
    for (size_t i = 0; i < s->problem->size; i++)
        if (!(s->size[i] > 0)) s->size[i] = nothing * least;
}

/* Raises the sizes to `least` (NULL: they come from the motion alone). */
static bool begin_sizes(nh_sizes *s, const nh_flow_problem *problem, double part, const double *least, const double *z,
                        double begin, double end)
{
    size_t n = problem->size;
    allocate(s, problem);
    s->part = part;
    s->least = least;
    s->last = begin;
    double *f = s->start, *to = s->work + n, tau = end - begin;
    if (!rate_at(s, begin, z, f)) return false;
    for (int i = 0; i < most_shorter && !sizes_within(s, begin, tau, z, f); i++) tau *= shorter;
    tau *= within;
    s->tau = s->step = fabs(tau);
    sizes_within(s, begin, tau, z, f);
    /* where nothing is zero for the moment, the rates have the rounding that they will have */
    for (size_t i = 0; i < n; i++) to[i] = z[i] + tau * s->work[i];
    memcpy(s->reach, s->size, n * sizeof *s->reach);
    measure_rounding(s, begin + tau, tau, to, s->size, s->rounding);
    s->pace = pace_of(s, z);
    for (int level = 0; level < least_levels; level++) measure(s, begin + tau, to, 0);
    fill(s);
    note_normal(s, z);
    return true;
}

bool nh_sizes_begin(nh_sizes *s, const nh_flow_problem *problem, double part, const double *z, double begin, double end)
{
    return begin_sizes(s, problem, part, NULL, z, begin, end);
}

void nh_sizes_given(nh_sizes *s, const nh_flow_problem *problem, const double *scale)
{
    allocate(s, problem);
    s->part = 1;
    for (size_t i = 0; i < problem->size; i++) s->size[i] = scale ? scale[i] : 1;
}

void nh_sizes_clear(nh_sizes *s)
{
    nh_free(s->size);
    s->size = NULL;
}

void nh_sizes_follow(nh_sizes *s, double t, const double *z)
{
    if (!(s->tau > 0)) return; /* the sizes are given */
    s->step = fabs(t - s->last);
    s->last = t;
    for (size_t i = 0; i < s->problem->size; i++)
        if (fabs(z[i]) > s->size[i]) s->size[i] = fabs(z[i]); /* false also for NAN */
    s->followed++;
    if (s->followed % between_measures == 0 || (s->followed & (s->followed - 1)) == 0) {
        measure(s, t, z, drowned);
        note_normal(s, z);
    }
}

double nh_sizes_absolute(const nh_sizes *s, double rtol, size_t i)
{
    double own = rtol * s->part * s->size[i], rounding = several * s->step * s->rounding[i];
    double noise_of = several * s->pace * s->rounding[i];
    if (s->normal[i] > 0) noise_of = fmin(noise_of, most_noise * s->size[i]);
    if (s->normal[i] > 0 || rounding < drowned * s->size[i])
        rounding = fmin(rounding, fmax(rest * rtol * s->size[i], noise_of));
    return fmax(own, rounding);
}

bool nh_sizes_open(nh_sizes *s, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                   size_t count, const double *times)
{
    if (options->scale || !(options->absolute > 0)) return nh_sizes_given(s, problem, options->scale), true;
    return begin_sizes(s, problem, options->absolute, options->least, z, times[0], times[count - 1]);
}
