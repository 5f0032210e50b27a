/* currents: from null vectors to currents a person can read, each checked in every way this program knows. */
#ifndef NH_CURRENTS_H
#define NH_CURRENTS_H

#include "study/result.h"

/* What all currents of one result are checked with. */
typedef struct {
    nh_result *result;
    nh_points *heldout, *generic; /* points that no fit has seen */
    nh_ex *inverse;               /* the chart's velocities in coordinate velocities */
    bool invertible;
} nh_workbench;

nh_workbench *nh_workbench_create(nh_result *result, nh_error *error);
void nh_workbench_free(nh_workbench *bench);

/* Refine a candidate, recognise its coefficients, normalise, prove, hold out and classify it; append it to result->found unless it turns
 * out not to be conserved (then a warning says so).  `fit`: the points of its null space; `certain`: the null space was; otherwise
 * only a certificate makes it a current, and nothing is said without. */
bool nh_currents_add(nh_workbench *bench, nh_candidate *candidate, const nh_points *fit, bool certain);

/* Order, name and relate what was found. */
void nh_currents_finish(nh_workbench *bench);

#endif
