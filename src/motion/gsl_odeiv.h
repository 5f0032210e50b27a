/* gsl_odeiv: motions of z' = f(t, z) by GSL's steppers: Runge-Kutta pairs of order 8 (Prince-Dormand) and 5 (Fehlberg),
 * and Adams's method with fixed-point iteration in Nordsieck form.  No Jacobian is needed; guards are not watched.
 *
 * A shorter step of the same method gives the states between two steps of a one-step method, so that output times do
 * not change the motion; Adams's method steps to every output time.
 * [Galassi2009] */
#ifndef NH_GSL_ODEIV_H
#define NH_GSL_ODEIV_H

#include "motion/motion.h"

/* Its methods: identifier, the name in GSL. */
#define NH_GSL_ODEIV_TABLE(X)                                                                                          \
    X(NH_RK8PD, rk8pd)                                                                                                 \
    X(NH_RKF45, rkf45)                                                                                                 \
    X(NH_MSADAMS, msadams)
typedef enum {
#define X(method, name) method,
    NH_GSL_ODEIV_TABLE(X)
#undef X
} nh_gsl_odeiv_method;

/* Integrates as nh_flow does. */
nh_motion *nh_gsl_odeiv(nh_gsl_odeiv_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                        const double *times, const nh_flow_options *options, nh_error *error);

#endif
