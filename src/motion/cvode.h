/* cvode: motions of z' = f(t, z) by CVODE, with dense output, events and a report of the reason when a motion ends
 * early.
 *
 * Reference: [Hindmarsh2005]. */
#ifndef NH_CVODE_H
#define NH_CVODE_H

#include "motion/motion.h"

/* Integrate from (times[0], initial) and report at times[0..count-1] (monotonic).  A motion that ends early is returned
 * with complete == false and a note; NULL only when nothing could be started (error says why). */
nh_motion *nh_cvode(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                    const nh_flow_options *options, nh_error *error);

#endif
