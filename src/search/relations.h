/* relations: polynomial relations among integrals that are polynomials in the velocities. */
#ifndef NH_RELATIONS_H
#define NH_RELATIONS_H

#include "search/analysis.h"

/* Among the currents and the further integrals: which products are related is seen modulo a prime (count/count.h),
 * the coefficients are exact, over the parameters.  Fills result->relation. */
void nh_relations_find(nh_analysis *result);

#endif
