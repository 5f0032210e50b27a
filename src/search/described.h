/* described: the description of a current: simplest multiple, meaning, formula. */
#ifndef NH_DESCRIBED_H
#define NH_DESCRIBED_H

#include "search/current_checker.h"

/* Normalise a current, so that the simplest component of its symmetry has the coefficient one; fill in whether it is
 * local (many-valued on an angle), what it means and its form in velocities. */
void nh_described_fill(nh_current_checker *bench, nh_current *found);

/* found->phi in the coordinates' velocities, where the chart allows that; without the unknown branch of a constraint
   that is not linear. */
void nh_current_in_velocities(const nh_current_checker *bench, nh_current *found);

#endif
