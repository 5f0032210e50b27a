/* events: zeros of given functions along a motion, by any integrator.
 *
 * After every step the functions are sampled along it (sign_changes.h), and each zero between two samples of different
 * signs is found by Brent's method (that of GSL) on the states inside the step (inside_step.h).
 *
 * A function is zero where it is below the tolerance of the watch, relative to its terms: a sign that is no larger says
 * nothing.  A touch without a change of sign is no zero that is found, nor is a jump from one sign to the other. */
#ifndef NH_EVENTS_H
#define NH_EVENTS_H

#include "motion/inside_step.h"

typedef struct nh_event_search nh_event_search;

/* Along the motion whose initial state is in motion->end_state at motion->end_time.  NULL when the options watch for
   nothing. */
nh_event_search *nh_event_search_create(const nh_motion *motion, const nh_flow_options *options,
                                        nh_inside_step *inside);
void nh_event_search_free(nh_event_search *search);

/* In the last step.  True: the motion stops at a zero in it, the last one that is recorded. */
bool nh_event_search_step(nh_event_search *search, nh_motion *motion);
/* After the last step: what was not found goes into the note. */
void nh_event_search_end(const nh_event_search *search, nh_motion *motion);

/* Append those of a part of the motion. */
void nh_events_append(nh_motion *motion, const nh_motion *part);

#endif
