/* stepping: steps of any integrator, with outputs, events and limits. */
#ifndef NH_STEPPING_H
#define NH_STEPPING_H

#include "motion/motion.h"

/* Step until all times are reached, or something ends the motion early. */
void nh_motion_run(nh_motion *motion, size_t count, const double *times, const nh_flow_options *options,
                   const nh_stepper *stepper);

#endif
