/* dependence: quadratic relations between a dependent current and the others. */
#ifndef NH_DEPENDENCE_H
#define NH_DEPENDENCE_H

#include "search/analysis.h"

/* For every dependent current look for a polynomial relation of degree two with the independent ones before it; sets `relation`. */
void nh_dependence_relations(nh_analysis *result);

#endif
