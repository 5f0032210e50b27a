/* events: zeros of given functions along a motion, by any integrator.
 *
 * After every step the functions are sampled along it (sign_changes.h), and each zero between two samples of different
 * signs is found by Brent's method (that of GSL) on the states that the integrator gives inside its step.  One that
 * gives none is completed by a step of GSL's pair of order 8 from the beginning of its own, whose distance from the
 * integrator's state at the end is spread over the step, so that the states are continuous.
 *
 * A function is zero where it is below the tolerance of the watch, relative to its terms: a sign that is no larger says
 * nothing.  A touch without a change of sign is no zero that is found, nor is a jump from one sign to the other. */
#ifndef NH_EVENTS_H
#define NH_EVENTS_H

#include "motion/motion.h"

typedef struct nh_event_search nh_event_search;

/* Along the motion whose initial state is in motion->end_state at motion->end_time.  NULL when the options watch for
   nothing. */
nh_event_search *nh_event_search_create(const nh_motion *motion, const nh_flow_options *options,
                                        const nh_stepper *stepper);
void nh_event_search_free(nh_event_search *search);

/* The last step ended at `now`.  True: the motion stops at a zero in it, the last one that is recorded. */
bool nh_event_search_step(nh_event_search *search, double now, nh_motion *motion);
/* After the last step: what was not found goes into the note. */
void nh_event_search_end(const nh_event_search *search, nh_motion *motion);

/* Append those of a part of the motion. */
void nh_events_append(nh_motion *motion, const nh_motion *part);

#endif
