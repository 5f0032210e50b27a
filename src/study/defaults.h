/* defaults: what the program chooses when the user says nothing. */
#ifndef NH_DEFAULTS_H
#define NH_DEFAULTS_H

#include "study/result.h"

/* An ansatz from the coordinates' types: polynomials of degree 2 in the chart's velocities, times first harmonics of the angles and powers
 * up to 2 of the lengths; with one unknown frequency for every angle that the equations of motion do not contain. */
void nh_defaults_ansatz(nh_result *result, size_t *families, nh_family **family);

/* A generic initial state on the constraint submanifold. */
bool nh_defaults_initial(nh_result *result, nh_state *state, nh_error *error);

#endif
