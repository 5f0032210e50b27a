/* noether_equation: Noether's equation of a current, in all coordinates.
 *
 *     Phi = xi^s p_s - tau (p_s v^s - L) + G,   p_s = dL/dv^s,   xi^s - tau v^s = R^s_i zeta^i:
 *
 *     dPhi/dt = xi^s dL/dq^s + (dxi^s/dt) p_s + tau dL/dt + (xi^s - tau v^s) Q_s + dG/dt
 *
 * on the constraint submanifold, with xi and G of t and q and a number tau, because the constraints do no work along
 * xi - tau v.  The right side contains no accelerations, and the constraints have not been put in: where L is invariant
 * it is short, however long the equations of motion are. */
#ifndef NH_NOETHER_EQUATION_H
#define NH_NOETHER_EQUATION_H

#include "geometry/model.h"

/* The right side, in t, q and the coordinates' velocities, of a current with Y_j(Phi) = M_ij zeta^i.  False: there are
 * no such xi and tau, or something is too long. */
bool nh_noether_equation(const nh_model *model, nh_ex phi, const nh_ex *zeta, nh_ex *out);

#endif
