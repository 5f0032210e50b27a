/* dimension: do the terms of a system have one unit?
 *
 * Symbols have the units that the file gives: parameters and coordinates their own, a coordinate of type length metres
 * of unknown scale, an angle 1, a velocity that of its coordinate by time.  A symbol without a unit may have any unit,
 * and so may all that contains it; so may a number that is added.  A number as a factor has none.  Compared are the
 * terms of a sum, the two sides of a constraint, arguments of functions and exponents with 1, and a generalized force
 * with the Lagrangian's unit by that of its coordinate.  Systems of bodies and joints are not compared: numbers stand
 * for masses and lengths there. */
#ifndef NH_DIMENSION_H
#define NH_DIMENSION_H

#include "system/system.h"

/* Writes a sentence about each part of the system in which units do not agree, in memory of the system; returns how
 * many. */
size_t nh_dimension_check(nh_system *system, const char ***out);

#endif
