/* inside_step: states inside the last step of any integrator.
 *
 * An integrator with cheap dense output gives them itself.  For one that has none, a step of GSL's pair of order 8 from
 * the beginning of its step computes them.  The difference from the integrator's state at the end is distributed over
 * the step, so that the states are continuous. */
#ifndef NH_INSIDE_STEP_H
#define NH_INSIDE_STEP_H

#include "motion/motion.h"

typedef struct nh_inside_step nh_inside_step;

/* For the steps of `stepper`, whose motion is at motion->end_time now.  Keeps the stepper, which has to outlive it; the
 * caller frees it. */
nh_inside_step *nh_inside_step_create(const nh_motion *motion, const nh_stepper *stepper);
void nh_inside_step_free(nh_inside_step *inside);

/* Call when the last step led to `now`.  False: the time did not move, or the integrator has no state there. */
bool nh_inside_step_take(nh_inside_step *inside, double now);
/* The times at which it began and ended; both the same before the first step. */
double nh_inside_step_begin(const nh_inside_step *inside);
double nh_inside_step_end(const nh_inside_step *inside);
size_t nh_inside_step_size(const nh_inside_step *inside); /* number of entries of a state */

/* The state at a time of this step (an nh_inside of sign_changes.h; the context is the nh_inside_step). */
bool nh_inside_step_state(double time, double *state, void *inside);

/* The same; for an integrator whose states inside a step cost a step, by the polynomial of degree 9 through the states
 * and rates at five places: as exact as the steps, and cheap where many are wanted. */
bool nh_inside_step_dense(double time, double *state, void *inside);

/* The same by Hermite's cubic through both ends, which is less exact and far cheaper still. */
bool nh_inside_step_sketch(double time, double *state, void *inside);

#endif
