/* dimension: do the terms of a system have one unit?
 *
 * Symbols have the units that the file gives: parameters and coordinates their own, a coordinate of type length metres
 * of unknown scale, an angle 1, a velocity that of its coordinate by time. A symbol without a unit may have any, and so
 * has all that contains it; so has a number that is added. As a factor a number has none. What is compared: the terms
 * of a sum, the two sides of a constraint, arguments of functions and exponents with 1, and a generalized force with
 * the Lagrangian's unit by that of its coordinate. Systems that bodies and joints define are left alone: numbers stand
 * there for masses and lengths. */
#ifndef NH_DIMENSION_H
#define NH_DIMENSION_H

#include "system/system.h"

/* A sentence for the user about each part of the system in which units do not agree, in memory of the system; at most
   as many as there are parts. */
size_t nh_dimension_check(nh_system *system, const char ***out);

#endif
