/* currents: from null vectors to currents a person can read, each checked in every way this program knows. */
#ifndef NH_CURRENTS_H
#define NH_CURRENTS_H

#include "study/result.h"

/* Turn the candidates into result->found: coefficients recognised, normalised, proved, held out, classified, made independent. */
bool nh_currents_build(nh_result *result, const nh_candidates *candidates, nh_error *error);

#endif
