/* automatic: a motion by the method that suits it: an explicit Runge-Kutta pair of order 8, or CVODE BDF where the
 * equations are stiff.
 *
 * Equations are stiff for this purpose when BDF needs far less counted work (base/effort.h) to the end than the pair,
 * which steps as short as stability demands. Nothing is timed, so the choice is the same on every machine and under any
 * load. */
#ifndef NH_AUTOMATIC_H
#define NH_AUTOMATIC_H

#include "motion/method.h"

/* Work of a motion by the pair in units of base/effort.h from which on BDF is tried, and how many times less work BDF
   must need. */
static const double nh_automatic_quick = 1e8, nh_automatic_faster = 20;

/* Integrates as nh_method_flow does; guards end the motion.  Writes the method of the returned motion to *used unless
 * that is NULL. */
nh_motion *nh_automatic(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                        const nh_flow_options *options, const nh_method **used, nh_error *error);

/* The same by the given method, or by the automatic choice where it is NULL. */
nh_motion *nh_automatic_or(const nh_method *method, const nh_flow_problem *problem, const double *initial, size_t count,
                           const double *times, const nh_flow_options *options, const nh_method **used,
                           nh_error *error);

#endif
