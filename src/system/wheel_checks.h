/* wheel_checks: notes on wheels that surely are not meant so. */
#ifndef NH_WHEEL_CHECKS_H
#define NH_WHEEL_CHECKS_H

#include "system/system.h"

/* Wheels that do not touch their surface wherever the system is, and wheels whose inertia is not round about the axle
 * about which they turn, with the values of the parameters.  At most two texts in the system's memory; returns how
 * many. */
size_t nh_wheel_checks(const nh_system *system, const char *out[2]);

#endif
