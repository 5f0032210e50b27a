/* stepping: steps of any integrator, with outputs, events and limits. */
#ifndef NH_STEPPING_H
#define NH_STEPPING_H

#include "motion/motion.h"

/* Evaluates the right-hand side at the start: a motion that cannot begin is an error (NH_NUMERIC), one that ends early
 * is not. */
bool nh_motion_check_start(const nh_flow_problem *problem, double t, const double *initial, nh_error *error);

/* Makes steps until all times are reached, or something ends the motion early. */
void nh_motion_run(nh_motion *motion, size_t count, const double *times, const nh_flow_options *options,
                   const nh_stepper *stepper);

#endif
