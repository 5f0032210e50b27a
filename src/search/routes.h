/* routes: the symmetry route beside the current route, and whether they agree. */
#ifndef NH_ROUTES_H
#define NH_ROUTES_H

#include "search/analysis.h"

/* Fit (Z^0, zeta) in the span of the fields of the ansatz' currents, and compare the spaces of currents found:
 * result->symmetry, routes_agree, routes_angle (the sine of the largest angle between them over the sample points). */
void nh_routes_compare(nh_analysis *result, const nh_ansatz *ansatz, const nh_points *points,
                       const nh_nullspace *current);

#endif
