/* arkode: motions of z' = f(t, z) by ARKODE's Runge-Kutta pairs: explicit ones, and one with a diagonally implicit,
 * L-stable, stiffly accurate method for stiff equations.  Steps end at the output times: the interpolation of the pairs
 * has a lower order than their steps.  Guards are not watched.  [Hindmarsh2005] */
#ifndef NH_ARKODE_H
#define NH_ARKODE_H

#include "motion/motion.h"

typedef enum { NH_DORMAND_PRINCE_5, NH_VERNER_6, NH_FEHLBERG_8, NH_ESDIRK_5 } nh_arkode_method;

/* Integrates as nh_flow does, by the pair of this name. */
nh_motion *nh_arkode(nh_arkode_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                     const double *times, const nh_flow_options *options, nh_error *error);

#endif
