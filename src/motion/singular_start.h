/* singular_start: why no motion starts from a state. */
#ifndef NH_SINGULAR_START_H
#define NH_SINGULAR_START_H

#include "motion/dynamics.h"

/* Replaces a numerical error at the start of a motion by its reason, with the coordinates that cause it: a position
 * constraint that does not hold, a divisor or a root that vanishes, a mass matrix or constraints without a solution.
 * Does not change the error where none of these is found. */
void nh_singular_start_explain(const nh_model *model, const nh_state *state, nh_error *error);

#endif
