/* relaxation: explicit Runge-Kutta methods with a fixed step that keep the energy [Ketcheson2019].
 *
 *     k_i = f(t + c_i h, z + h a_ij k_j),    d = b_i k_i,    z1 = z + g h d,    t1 = t + g h,    g near 1 with E(z1) =
 *     E(z at the start)
 *
 * With g h instead of h as the elapsed time the order of the method is unchanged.  The last step before an output is
 * repeated with another h until g h meets the time.  Where no g within a tenth of 1 keeps the energy, the step is
 * halved, at most three times. */
#ifndef NH_RELAXATION_H
#define NH_RELAXATION_H

#include "motion/motion.h"
#include "motion/programs.h"

/* the classical method of order 4, and the pair of order 8 of tableau.h */
typedef enum { NH_RELAXATION_4, NH_RELAXATION_8 } nh_relaxation_rule;

/* NULL when the energy of the model is conserved and can be kept, otherwise why not. */
const char *nh_relaxation_refused(nh_programs *programs);

/* Integrates as nh_flow does. options->step: the step, made a little smaller so that steps end at the output times. */
nh_motion *nh_relaxation(nh_programs *programs, nh_relaxation_rule rule, const double *initial, size_t count,
                         const double *times, const nh_flow_options *options, nh_error *error);

#endif
