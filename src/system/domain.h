/* domain: the sampling domain of a system: intervals of its file, and defaults by the kind of coordinate. */
#ifndef NH_DOMAIN_H
#define NH_DOMAIN_H

#include "system/system.h"

/* The interval of t, a coordinate or a velocity. */
void nh_domain_range(const nh_system *system, nh_ex symbol, double *low, double *high);

#endif
