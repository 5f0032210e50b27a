#include "motion/sizes.h"

#include <float.h>
#include <math.h>
#include <stdint.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { most_shorter = 60, most_levels = 8, between_measures = 32 };
static const double shorter = 0.25;          /* factor from one tau that is tried to the next */
static const double within = 0.25;           /* part of the tau that is found, which is used */
static const double disturbance = 4;         /* roundings of each state, whose effect on the rates is measured */
/* a state has no digits if its rounding in a step is a larger part of its size; the part of the tolerance that the
 * rounding of another state may be */
static const double drowned = 1e-3, rest = 0.1;
/* size of a state that nothing moves so far, as a part of the smallest size */
static const double nothing = 1e-6;

static bool rate_at(nh_sizes *s, double t, const double *z, double *rate)
{
    s->evaluations++;
    return s->problem->rate(t, z, rate, s->problem->context) && nh_all_finite(s->problem->size, rate);
}

/* Writes z + tau f to `to`, and the rates there; false: they are not defined, or differ too much from f. */
static bool step_is_short(nh_sizes *s, double t, double tau, const double *z, const double *f, double *to, double *rate)
{
    for (size_t i = 0; i < s->problem->size; i++) to[i] = z[i] + tau * f[i];
    if (!rate_at(s, t + tau, to, rate)) return false;
    for (size_t i = 0; i < s->problem->size; i++) {
        double own = fmax(fmax(fabs(z[i]), fabs(tau * f[i])), s->least ? s->least[i] : 0);
        if (own > 0 && !(fabs(tau * (rate[i] - f[i])) <= own)) return false;
    }
    return true;
}

static void enlarge(nh_sizes *s, double tau, const double *f)
{
    for (size_t i = 0; i < s->problem->size; i++) s->size[i] = fmax(s->size[i], fabs(tau * f[i]));
}

/* The change of the rates by rounding of the states, the largest so far. */
static void measure_rounding(nh_sizes *s, double t, const double *z)
{
    size_t n = s->problem->size;
    double *moved = s->work, *f = s->work + n, *g = s->work + 2 * n;
    uint64_t random = 0x9e3779b97f4a7c15u;
    for (size_t i = 0; i < n; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        double change = disturbance * DBL_EPSILON * s->size[i];
        moved[i] = z[i] + (random >> 63 ? change : -change);
    }
    if (!rate_at(s, t, z, f) || !rate_at(s, t, moved, g)) return;
    for (size_t i = 0; i < n; i++) s->rounding[i] = fmax(s->rounding[i], fabs(g[i] - f[i]));
}

static void allocate(nh_sizes *s, const nh_flow_problem *problem)
{
    *s = (nh_sizes){.problem = problem, .size = nh_alloc_array(5 * problem->size, sizeof *s->size)};
    s->rounding = s->size + problem->size;
    s->work = s->rounding + problem->size;
}

/* Sizes of states that are still zero: as large as the others can make them within tau; of those that nothing moves,
 * small relative to all others. */
static void fill(nh_sizes *s, double t, const double *z)
{
    double least = INFINITY;
    measure_rounding(s, t, z);
    for (size_t i = 0; i < s->problem->size; i++) {
        if (!(s->size[i] > 0)) s->size[i] = s->tau * s->rounding[i] / (disturbance * DBL_EPSILON);
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
    double *f = s->work, *to = s->work + n, *rate = s->work + 2 * n, tau = end - begin;
    for (size_t i = 0; i < n; i++) s->size[i] = fmax(fabs(z[i]), least ? least[i] : 0);
    if (!rate_at(s, begin, z, f)) return false;
    bool is_short = false;
    for (int i = 0; i < most_shorter && !(is_short = step_is_short(s, begin, tau, z, f, to, rate)); i++) tau *= shorter;
    tau *= within;
    s->tau = s->step = fabs(tau);
    enlarge(s, tau, f);
    bool more = is_short;
    /* Picard's iteration: states that move, then states that are moved by these */
    for (int level = 0; level < most_levels && more; level++) {
        for (size_t i = 0; i < n; i++) to[i] = z[i] + tau * f[i];
        if (!rate_at(s, begin + tau, to, rate)) break;
        more = false;
        for (size_t i = 0; i < n; i++) more |= !(s->size[i] > 0) && rate[i] != 0;
        enlarge(s, tau, rate);
        memcpy(f, rate, n * sizeof *f);
    }
    fill(s, begin, z);
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
    if (++s->followed % between_measures == 0) measure_rounding(s, t, z);
}

double nh_sizes_absolute(const nh_sizes *s, double rtol, size_t i)
{
    double own = rtol * s->part * s->size[i], rounding = s->step * s->rounding[i];
    if (rounding < drowned * s->size[i]) rounding = fmin(rounding, rest * rtol * s->size[i]);
    return fmax(own, rounding);
}

bool nh_sizes_open(nh_sizes *s, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                   size_t count, const double *times)
{
    if (options->scale || !(options->absolute > 0)) return nh_sizes_given(s, problem, options->scale), true;
    return begin_sizes(s, problem, options->absolute, options->least, z, times[0], times[count - 1]);
}
