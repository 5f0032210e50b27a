/* total_derivative: a Lagrangian without the total derivatives that stand in it.
 *
 *     L - dF/dt,   dF/dt = F_t + F_s v^s
 *
 * has the equations of L.  Of the terms of L that are at most linear in the velocities the coefficients dL/dv^s are
 * integrated, term by term; F is taken away only where every term of dF/dt is one of these, so that gauges of a
 * magnetic field stay as they were chosen.  What is read off
 * the form of a Lagrangian (words, forces) is read off this one. */
#ifndef NH_TOTAL_DERIVATIVE_H
#define NH_TOTAL_DERIVATIVE_H

#include "geometry/model.h"

/* L itself where nothing is found. */
nh_ex nh_total_derivative_removed(const nh_model *model);

#endif
