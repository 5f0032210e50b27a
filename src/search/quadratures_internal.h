/* quadratures_internal: for the files of the stage. */
#ifndef NH_QUADRATURES_INTERNAL_H
#define NH_QUADRATURES_INTERNAL_H

#include "search/quadratures.h"

/* A constant of integration in a shorter form; `general`: it holds for all values of the parameters, and so does what
 * is returned.  If this changes the sign of its roots relative to those of the equations of motion, values of
 * parameters may be needed. */
nh_ex nh_quadratures_form(const nh_analysis *result, nh_ex value, bool general);

/* Is e conserved?  By its normal form. */
bool nh_quadratures_conserves(const nh_model *model, nh_ex e);

/* Replaces the energy among n currents by those energies of parts of the system that the other currents do not give;
 * `current` has room for one more per coordinate and velocity.  Returns how many there are then. */
size_t nh_quadratures_with_parts(const nh_analysis *result, const nh_points *points, size_t n, nh_ex *current);

#endif
