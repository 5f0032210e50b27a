/* defaults: the default ansatz, samples and motion. */
#ifndef NH_DEFAULTS_H
#define NH_DEFAULTS_H

#include "search/analysis.h"

/* A generic initial state on the constraint submanifold. */
bool nh_defaults_initial(nh_analysis *result, nh_state *state, nh_error *error);

#endif
