/* combined_coordinates: coordinates that occur in the equations of motion only in one combination.
 *
 * Where the equations of motion do not change along a translation v = d/dq_k - r d/dq_i with a constant r, they depend
 * on q_i and q_k through z = q_i + r q_k only: two bodies on a line, with a force that depends on x - y; a wave, with
 * one that depends on x - c t.  With z instead of q_i the equations do not depend on q_k, and each contains fewer
 * states (explicit_motion.h).  The time may be one of the two, as q_k. */
#ifndef NH_COMBINED_COORDINATES_H
#define NH_COMBINED_COORDINATES_H

#include "geometry/model.h"

/* The symbol of the state that a combined coordinate replaces stands for it: q_i = z - sum of r_k q_k. */
typedef struct {
    size_t count;
    size_t *state; /* the replaced states, as indices into t, q, w */
    nh_ex *symbol;
    nh_ex *combined;          /* z in the states */
    nh_ex *state_in_combined; /* q_i in z and the others */
    nh_ex *rate;              /* of all states t, q, w, with the combined coordinates */
} nh_combined_coordinates;

/* With these rates of the states t, q, w of the chart.  In the arena; NULL: there are none. */
const nh_combined_coordinates *nh_combined_coordinates_of(nh_arena *arena, const nh_model *model, const nh_ex *rate);

/* An expression in the states, with the combined coordinates; and back. */
nh_ex nh_combined_coordinates_in(const nh_combined_coordinates *combined, nh_dag *dag, nh_ex e);
nh_ex nh_combined_coordinates_out(const nh_combined_coordinates *combined, nh_dag *dag, nh_ex e);

#endif
