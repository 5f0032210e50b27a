/* continued: a current with roots of squares, continued through the zeros of these squares.
 *
 * z' sqrt(x^2/y^2 + 1) is constant on each side of y = 0 and changes its sign there.  With the square taken out of the
 * root it is z' sqrt(x^2 + y^2)/y: the same function on one side, up to the sign that the root has there, and an
 * analytic one through the wall, so that it is a current on both sides if it is one on either, as long as the equations
 * of motion go through as well. */
#ifndef NH_CONTINUED_H
#define NH_CONTINUED_H

#include "geometry/model.h"

/* phi with sqrt(u^2 v) as u sqrt(v) or -u sqrt(v), whichever it is in the sampling box; phi itself where no root has a
   square in it. */
nh_ex nh_continued_roots(const nh_model *model, nh_ex phi, uint64_t seed);

/* phi with -atan(1/u), which is smooth where u is infinite, in the place of every atan(u): they differ by pi/2 on one
   side and by -pi/2 on the other.  phi itself where there is no arctangent. */
nh_ex nh_continued_arctangents(const nh_model *model, nh_ex phi);

/* phi = r + c atan(A/B), where c is a constant of the motion, as sin(r/c + atan(A/B)) times S, or alone where S is not
   constant: A cos(r/c) + B sin(r/c), which goes on however often the angle turns round.  S^2 = A^2 + B^2; phi itself
   where it has another number of arctangents. */
nh_ex nh_continued_turns(const nh_model *model, nh_ex phi);

#endif
