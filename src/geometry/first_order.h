/* first_order: Lagrangians that are linear in all velocities, as those of point vortices and guiding centres.
 *
 *     L = a_i q_i' - H:   omega_ij q_j' = dH/dq_i + da_i/dt - Q_i,   omega_ij = da_j/dq_i - da_i/dq_j
 *
 * No velocity has inertia: the state is q alone.  The program takes such equations as constraints beside one coordinate
 * that moves by itself; what stays constant are then integrals of these constraints. */
#ifndef NH_FIRST_ORDER_H
#define NH_FIRST_ORDER_H

#include "geometry/model.h"

/* Refuses such a Lagrangian, without constraints, with the constraints to write instead where they are short.  True,
 * without an error: the Lagrangian is of another kind. */
bool nh_first_order_refuse(const nh_model *model, nh_error *error);

#endif
