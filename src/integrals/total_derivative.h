/* total_derivative: a Lagrangian without the total derivatives that stand in it.
 *
 *     L - dF/dt,   dF/dt = F_t + F_s v^s
 *
 * has the equations of L.  F is a sum of integrals of terms of the coefficients dL/dv^s; it is taken away only where
 * every term of dF/dt is a term of L, so that gauges of a magnetic field stay as they were chosen.  What is read off
 * the form of a Lagrangian (words, forces) is read off this one. */
#ifndef NH_TOTAL_DERIVATIVE_H
#define NH_TOTAL_DERIVATIVE_H

#include "geometry/model.h"

/* L itself where nothing is found, or where it is not quadratic in the velocities. */
nh_ex nh_total_derivative_removed(const nh_model *model);

#endif
