/* affine_field: a current's field where it is affine in the coordinates and t.
 *
 *     Y_j(Phi) = M_ij zeta^i,   zeta^i = c_0 + c_1 t + c_s q^s + d_s t q^s
 *
 * Turns and translations of whole systems have such fields, and centres of mass, however long M^-1 is. */
#ifndef NH_AFFINE_FIELD_H
#define NH_AFFINE_FIELD_H

#include "base/option.h"
#include "geometry/model.h"

/* zeta (n) with short fractions as coefficients, by its values at points, for the parameters' given values.  A guess:
 * the equation above and that of Noether remain to be checked.  False: there is none. */
bool nh_affine_field(const nh_model *model, nh_ex phi, const nh_options *options, nh_ex *zeta);

#endif
