/* quadratures_internal: for the files of the stage. */
#ifndef NH_QUADRATURES_INTERNAL_H
#define NH_QUADRATURES_INTERNAL_H

#include "search/quadratures.h"

/* A constant of integration in a shorter form; `general`: it holds for all values of the parameters, and so does what
 * is returned.  If this changes the sign of its roots relative to those of the equations of motion, values of
 * parameters may be needed. */
nh_ex nh_quadratures_form(const nh_analysis *result, nh_ex value, bool general);

#endif
