/* midpoint: implicit methods with a fixed step for the motions of a model, in its chart's z = (q, w).
 *
 * Each step solves for the point zm = (qm, wm) half-way, at tm = t + h/2, by Newton's method with exact derivatives:
 *
 * MIDPOINT          2 (zm - z0) = h f(tm, zm),  z1 = 2 zm - z0.  Order 2, symmetric; conserves quadratic currents.
 *
 * LAGRANGE_DALEMBERT  discrete Lagrange-d'Alembert principle with L_d = h L((q0 + q1)/2, (q1 - q0)/h)
 *                     [CortesMartinez2001]:
 *                       2 (qm - q0) = h rho(qm, wm),   R(q0,w0)^T [ p(q0,w0) + h/2 c(qm,wm) - p(qm,wm) ] = 0,
 *                     with c = dL/dq + Q; then q1 = 2 qm - q0, and w1 from
 *                                                    R(q1,w1)^T [ p(qm,wm) + h/2 c(qm,wm) - p(q1,w1) ] = 0.
 *
 * ENERGY            the almost-Poisson pair q' = R u, M w' = G u - R^T dE/dq, M u = dE/dw with R, M, G at the midpoint
 *                     of z0, z1 and the mean of grad E over the segment between them
 *                     [McLachlanQuispelRobidoux1999]: conserves E exactly.
 *                     The pair equals the equations of motion for homogeneous constraints without forces only;
 *                     elsewhere it would converge to a wrong motion, so that it is compared with them at the chart's
 *                     probes, and refused.
 *
 * `composed` makes order 4 of any of them: five steps of s, s, 1-4s, s, s times h, s = 1/(4 - 4^(1/3)) 
 * [Suzuki1990]. */
#ifndef NH_MIDPOINT_H
#define NH_MIDPOINT_H

#include "motion/motion.h"
#include "motion/programs.h"

typedef enum { NH_MIDPOINT, NH_LAGRANGE_DALEMBERT, NH_ENERGY } nh_midpoint_rule;

/* NULL when the rule may be used with the model of these programs, otherwise why not. */
const char *nh_midpoint_refused(nh_programs *programs, nh_midpoint_rule rule);

/* Integrates as nh_flow does. options->step: the step, made a little smaller so that steps end at the output times. */
nh_motion *nh_midpoint(nh_programs *programs, nh_midpoint_rule rule, bool composed, const double *initial, size_t count,
                       const double *times, const nh_flow_options *options, nh_error *error);

#endif
