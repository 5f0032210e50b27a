/* force_potential: the potential of forces that the system's file gives as forces.
 *
 *     Q_i = dU/dq^i,   that is   dQ_i/dq^j = dQ_j/dq^i:   E - U is constant where E is without them
 *
 * U need not be single-valued: a force around a point, (-y, x)/(x^2 + y^2), has the angle.  Dry friction has a
 * potential for each direction of the motion, in which sign(x') is constant. */
#ifndef NH_FORCE_POTENTIAL_H
#define NH_FORCE_POTENTIAL_H

#include "integrals/points.h"

/* U in the model's graph; 0: the forces have none, or no closed form is found.  The points show the signs of functions
   on which the form depends; NULL: none is known.  `max_terms`: of polynomials. */
nh_ex nh_force_potential(const nh_model *model, const nh_points *points, size_t max_terms);
/* The same of a form in the coordinates, `form` (m): F with dF/dq^i = form_i. */
nh_ex nh_force_potential_of(const nh_model *model, const nh_points *points, size_t max_terms, const nh_ex *form);

#endif
