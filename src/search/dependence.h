/* dependence: quadratic relations between a dependent current and the others; relations with the currents that the
 * system's file knows. */
#ifndef NH_DEPENDENCE_H
#define NH_DEPENDENCE_H

#include "search/analysis.h"

/* For every dependent current look for a polynomial relation of degree two with the independent ones before it; sets
   `relation`. */
void nh_dependence_relations(nh_analysis *result);

/* For every current without a meaning of its own: is it a combination with constant coefficients, or a multiple of the
 * product or quotient of two, of the first six currents of the list `known` in the system's file?  Sets `known`, where
 * an exact relation proves it. */
void nh_dependence_on_known(nh_analysis *result);

/* The expression, which the system file names, in terms of the first six independent currents found: such a
 * combination, multiple, or a quadratic relation, as "[energy] = -Phi1"; NULL: none was found. */
const char *nh_dependence_on_found(nh_analysis *result, const char *name, nh_ex phi);

#endif
