/* constraint_integrals: currents that the constraints alone keep constant.
 *
 * A current Phi(t, q) satisfies X_0(Phi) = 0 for all velocities, hence X_i(Phi) = 0: it belongs to the constraints,
 * whatever the Lagrangian is, and is a hidden holonomic constraint Phi = const.  How many there are is known from the
 * growth vector (geometry/distribution.h); they are looked for in an ansatz of their own, which contains no velocities,
 * and among all currents.  [docs/method.md, sec. 2] */
#ifndef NH_CONSTRAINT_INTEGRALS_H
#define NH_CONSTRAINT_INTEGRALS_H

#include "search/stage_solver.h"

/* The first stages of a search, where functions are known to exist: polynomials, waves of the angles and the system's
   own functions, times positions. */
void nh_integrals_find(nh_stage_solver *solver);

/* After the search: fills result->integral, and the meaning of the currents concerned. */
void nh_integrals_of_constraints(nh_analysis *result);

#endif
