/* centre_of_mass: where all masses are along a coordinate, without bodies being named.
 *
 *     p_s = K_sr v^r = dF/dt,   F = K_ss q^s + ..,   K_ss a constant
 *
 * With the coordinate s as a displacement of the whole, K_ss is the whole's mass and F/K_ss its centre's coordinate. */
#ifndef NH_CENTRE_OF_MASS_H
#define NH_CENTRE_OF_MASS_H

#include "geometry/model.h"

typedef struct {
    size_t s;      /* the coordinate */
    nh_ex mass, F; /* K_ss */
} nh_centre_of_mass;

/* Those with an F that is no linear function of the coordinates; `out` has room for m.  None where the velocities are
 * constrained or replaced.  `max_terms`: of polynomials. */
size_t nh_centre_of_mass_find(const nh_model *model, size_t max_terms, nh_centre_of_mass *out);

#endif
