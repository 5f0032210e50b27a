/* shown_coordinates: coordinates that the system shows, and the momenta that belong to them.
 *
 * Where L is written by X = x - c y^2, the field of a turn is X d/dY - Y d/dX of the coordinates (X, Y), whose
 * components in (x, y) are not in the span of what is seen; nor is its momentum X P_Y - Y P_X in the span of X p_y, ..:
 *
 *     P_i = p_k dq^k/du^i,   p = dL/dv,   u = (X, y, ..)
 */
#ifndef NH_SHOWN_COORDINATES_H
#define NH_SHOWN_COORDINATES_H

#include "geometry/model.h"

/* u[s], for m coordinates: a place (places.h) over its slope along q^s, where that is a number, or q^s; P[s] on the
 * submanifold, of L without total derivatives.  False where no place is a coordinate, or P are the momenta of q, or
 * q(u) is not found. */
bool nh_shown_coordinates(const nh_model *model, size_t places, const nh_ex *place, nh_ex *u, nh_ex *P);

/* What the components of fields that are affine in u have in q beside t and the places: dq^k/du^i times 1, t and u,
 * where it is no number; at most so many.  Returns their number. */
size_t nh_shown_components(const nh_model *model, size_t places, const nh_ex *place, size_t most, nh_ex *out);

/* Sums of positions and t that a system shows, as X = x - a cos(t) or Y = y + c z^2.
 *
 * In coordinates that hide a symmetry its field has them as components: X d/dy - Y d/dx. */

enum { NH_MOST_PLACES = 6 };

/* Sums in the Lagrangian and the constraints that have no velocities and are not linear in t and the positions, shorter
 * ones first where they are parts of longer ones; returns their number. */
size_t nh_shown_places(const nh_model *model, nh_ex out[NH_MOST_PLACES]);

#endif
