/* described: the description of a current: simplest multiple, meaning, formula. */
#ifndef NH_DESCRIBED_H
#define NH_DESCRIBED_H

#include "search/current_checker.h"

/* Normalise a current, so that the simplest component of its symmetry has the coefficient one; fill in whether it is
 * local (many-valued on an angle), what it means and its form in velocities. */
void nh_described_fill(nh_current_checker *bench, nh_current *found);

/* Currents that are multiples of known ones to which the system's file gives a symbol: they come first, in the file's
 * order, and have the file's sign and factor, so that a report can be read beside its source. */
void nh_described_by_source(nh_current_checker *bench);

/* found->phi in the coordinates' velocities, where the chart allows that; without the unknown branch of a constraint
   that is not linear. */
void nh_current_in_velocities(const nh_current_checker *bench, nh_current *found);

#endif
