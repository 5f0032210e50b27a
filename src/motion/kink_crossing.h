/* kink_crossing: how a multistep method crosses a kink (kinks.h): a one-step method computes the motion from before the
   step to behind the wall. */
#ifndef NH_KINK_CROSSING_H
#define NH_KINK_CROSSING_H

#include "motion/kinks.h"

/* A step of a method with many steps behind it. */
typedef struct {
    double before, now;
    const double *old; /* the state before it */
    const nh_sizes *sizes;
    double rtol;
    size_t count; /* the wanted times */
    const double *times;
    const nh_event_watch *watch; /* of the motion */
} nh_kink_crossing;

/* The motion from before the step to behind a wall in it, by a one-step method, at the wanted times and at its end.
 * NULL: there was no wall in the step.  The caller frees it. */
nh_motion *nh_kink_crossing_make(nh_kinks *kinks, const nh_flow_problem *problem, const nh_kink_crossing *leap,
                                 nh_inside *state, void *context, nh_motion *motion);

/* The state of such a motion at one of its times. */
bool nh_kink_crossing_state(const nh_motion *across, double time, double *state);

#endif
