/* simulate_internal: declarations for simulate.c and simulate_many.c. */
#ifndef NH_SIMULATE_INTERNAL_H
#define NH_SIMULATE_INTERNAL_H

#include "commands/simulate.h"

/* The text that `write` makes of a closed subsystem, in the simulation's memory. */
const char *nh_simulate_words(nh_simulation *s, const nh_closed_subsystem *scene,
                              void (*write)(const nh_closed_subsystem *scene, nh_text *out));

/* Adds --event, --section and --axes, after the columns. */
bool nh_simulate_events(nh_simulation *s, const nh_request *request, nh_error *error);

/* Computes an ensemble instead of the one motion that `motion` describes. */
bool nh_simulate_many(nh_simulation *s, const nh_request *request, const nh_trajectory_request *motion,
                      nh_error *error);

/* The state (q, w) of a row, which begins at the given time. */
bool nh_simulate_row_start(nh_simulation *s, const nh_simulate_row *row, nh_dynamics *dynamics, double time,
                           bool project, double *z, nh_error *error);

/* Moves a position to the nearest one that satisfies the constraints between positions and lets wheels touch their
 * surface; positions that are given (initial->placed) move only where the others cannot do it alone.  Sets
 * s->assembled. */
void nh_simulate_assemble(nh_simulation *s, nh_state *initial);
/* The constraint between positions that the initial position violates, and by how much, in the simulation's memory;
 * NULL: none. */
const char *nh_simulate_violation(const nh_simulation *s, const nh_state *initial, bool projected);

#endif
