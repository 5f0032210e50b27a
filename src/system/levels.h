/* levels: have the constraints between positions a point in common?
 *
 * x^2 + y^2 = -1 has a time derivative like any other constraint, and no point.  Emptiness is proved by intervals
 * over all of space where that suffices (sums of even powers); otherwise damped Gauss-Newton steps from many places,
 * far out of the sampling domain too, look for a point. */
#ifndef NH_LEVELS_H
#define NH_LEVELS_H

#include "system/system.h"

/* Refuses a system without a point; the message names the constraint and says what was tried. */
bool nh_levels_check(nh_system *system, uint64_t seed, nh_error *error);

#endif
