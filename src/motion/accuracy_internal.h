/* accuracy_internal: what the search for an accurate motion knows, for its words. */
#ifndef NH_ACCURACY_INTERNAL_H
#define NH_ACCURACY_INTERNAL_H

#include "motion/accuracy.h"

typedef struct {
    const nh_trajectory_request *request;
    const nh_integration_plans *ways;
    double eps;
    nh_accuracy *out;
    /* the plan that was given, or measured and chosen; NULL: there is none, or it failed for this motion */
    const nh_integration_plan *way;
    nh_pilot_runs pilot;
    nh_trajectory_request own; /* with the model that the pilot runs derived */
    double first;              /* units of the whole motion by the method of the first run */
    nh_programs *programs;     /* for methods with a fixed step */
    double *floor;             /* least scales of the wanted expressions */
    bool measured_terms;       /* `floor` contains the terms of sums that may cancel */
    const nh_method *method[2];
    bool doubtful; /* another method must confirm the result */
    bool stopped;  /* the first run ended at its limit of work */
} nh_accuracy_search;

/* " in all coordinates", for example; empty for the model's own velocities. */
const char *nh_accuracy_where(const nh_integration_plan *way);

/* Writes into accuracy->why how the motion was computed, and where it was reached, why in this way. */
void nh_accuracy_explain(nh_accuracy_search *search, const nh_trajectory *t);

#endif
