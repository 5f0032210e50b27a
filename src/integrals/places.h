/* places: sums of positions and t that a system shows, as X = x - a cos(t) or Y = y + c z^2.
 *
 * In coordinates that hide a symmetry its field has them as components: X d/dy - Y d/dx. */
#ifndef NH_PLACES_H
#define NH_PLACES_H

#include "geometry/model.h"

enum { NH_MOST_PLACES = 6 };

/* Sums in the Lagrangian and the constraints that have no velocities and are not linear in t and the positions, shorter
 * ones first where they are parts of longer ones; returns their number. */
size_t nh_places_of(const nh_model *model, nh_ex out[NH_MOST_PLACES]);

#endif
