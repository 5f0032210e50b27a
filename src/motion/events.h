/* events: zeros of given functions along a motion, by any integrator.
 *
 * After every step it is divided into parts on which each function has one zero at most (sign_changes.h), and each zero
 * between two ends of different signs is found by Brent's method (that of GSL) on the states inside the step
 * (inside_step.h).
 *
 * A function counts as zero where it is below the tolerance of the watch, relative to its terms: the sign of a smaller
 * value is not known.  A zero at which the function does not change its sign is not found, and a jump from one sign to
 * the other is no zero. */
#ifndef NH_EVENTS_H
#define NH_EVENTS_H

#include "motion/inside_step.h"

typedef struct nh_event_search nh_event_search;

/* For the motion whose initial state is in motion->end_state at motion->end_time.  NULL when the options watch for
 * nothing. */
nh_event_search *nh_event_search_create(const nh_motion *motion, const nh_flow_options *options,
                                        nh_inside_step *inside);
void nh_event_search_free(nh_event_search *search);

/* Searches the last step.  True: the motion stops at a zero in it, which is the last recorded one. */
bool nh_event_search_step(nh_event_search *search, nh_motion *motion);
/* Call after the last step: writes to the note why zeros may be missing. */
void nh_event_search_end(const nh_event_search *search, nh_motion *motion);

/* Appends the zeros of a part of the motion. */
void nh_events_append(nh_motion *motion, const nh_motion *part);

#endif
