/* noether_equation: Noether's equation of a current, in all coordinates.
 *
 *     Phi = xi^s dL/dv^s + G,   xi^s = R^s_i zeta^i(t, q):
 *
 *     dPhi/dt = xi^s dL/dq^s + (dxi^s/dt) dL/dv^s + xi^s Q_s + dG/dt
 *
 * on the constraint submanifold, because the constraints do no work along xi.  The right side, with d/dt = d/dt + v^s
 * d/dq^s, contains no accelerations, and the constraints have not been put in: where L is invariant it is short,
 * however long the equations of motion are. */
#ifndef NH_NOETHER_EQUATION_H
#define NH_NOETHER_EQUATION_H

#include "geometry/model.h"

/* The right side, in t, q and the coordinates' velocities, of a current with Y_j(Phi) = M_ij zeta^i.  False: xi depends
 * on velocities, or something is too long. */
bool nh_noether_equation(const nh_model *model, nh_ex phi, const nh_ex *zeta, nh_ex *out);

#endif
