#include "motion/kink_crossing.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"
#include "motion/events.h"
#include "motion/gsl_odeiv.h"

/* in units of `least`: a one-step method goes at least so far behind a wall, and as far as its way to the wall was */
static const double few = 64;

/* The beginning of the step, the wanted times in it, and its end. */
static size_t times_of(const nh_kink_crossing *l, double end, double *times)
{
    size_t n = 0;
    bool backward = end < l->before;
    times[n++] = l->before;
    for (size_t i = 0; i < l->count; i++)
        if (backward ? l->times[i] < l->before && l->times[i] > end : l->times[i] > l->before && l->times[i] < end)
            times[n++] = l->times[i];
    times[n++] = end;
    return n;
}

static nh_motion *by_one_step_method(const nh_kinks *k, const nh_flow_problem *p, const nh_kink_crossing *l, double end)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    double *times = nh_alloc_array(l->count + 2, sizeof *times), *scale = nh_alloc_array(k->change.size, sizeof *scale);
    for (size_t i = 0; i < k->change.size; i++) scale[i] = nh_sizes_absolute(l->sizes, l->rtol, i) / l->rtol;
    nh_flow_options options = {.rtol = l->rtol,
                               .scale = scale,
                               .watch = l->watch,
                               .guarded = true,
                               .whole = k->span,
                               .cancelled = nh_interrupted_callback};
    size_t count = times_of(l, end, times);
    /* an implicit method would solve its stages too inexactly to approach a wall */
    nh_motion *motion = nh_gsl_odeiv(NH_RK8PD, p, l->old, count, times, &options, &ignored);
    nh_free(scale);
    nh_free(times);
    return motion;
}

nh_motion *nh_kink_crossing_make(nh_kinks *k, const nh_flow_problem *p, const nh_kink_crossing *l, nh_inside *state,
                                 void *context, nh_motion *motion)
{
    if (!k->change.count || l->now == l->before) return NULL;
    double at = nh_kinks_first(k, l->before, l->now, state, context), last = l->times[l->count - 1];
    if (isnan(at)) return NULL;
    double end = at + copysign(fmax(fabs(at - l->before), few * k->least), l->now - l->before);
    if (fabs(end - l->before) > fabs(last - l->before)) end = last;
    nh_motion *across = by_one_step_method(k, p, l, end);
    if (!across) return NULL;
    if (!across->complete || across->note[0]) nh_motion_note(motion, "%s", across->note);
    motion->guard_hit = across->guard_hit;
    motion->limited = across->limited;
    nh_events_append(motion, across);
    motion->searched = across->end_time;
    motion->stopped = across->stopped;
    memcpy(k->change.z, across->end_state, k->change.size * sizeof *k->change.z);
    nh_kinks_go_over(k, across->end_time, motion);
    return across;
}

bool nh_kink_crossing_state(const nh_motion *across, double time, double *state)
{
    for (size_t i = 0; i < across->count; i++)
        if (across->time[i] == time)
            return memcpy(state, across->state + i * across->size, across->size * sizeof *state), true;
    return false;
}
