/* validation: are the currents constant along a motion, and is the motion accurate?
 *
 * The equations of motion are integrated at three tolerances: a true current's drift falls with the tolerance, a false
 * one's does not. The same motion in all coordinates with Chetaev multipliers gives a second opinion on the states, and
 * its multipliers are compared with the formula of the model.  CVODE Adams gives another one, in the same states.
 * [docs/method.md, sec. 6] */
#ifndef NH_VALIDATION_H
#define NH_VALIDATION_H

#include "base/option.h"
#include "motion/accuracy.h"
#include "motion/drift.h"

/* Two computations of one motion agree when their states differ by at most this part of their sizes. */
#define NH_MOTIONS_APART 0.01

typedef struct {
    nh_arena *arena;
    const char *method, *multiplier_method, *chart;
    bool checked; /* an accuracy was requested */
    nh_accuracy accuracy;
    double tolerance[NH_DRIFT_RUNS], begin, end;
    size_t currents;
    nh_drift *current;
    size_t count, size;                /* of the tightest run */
    double *time, *state, *multiplier; /* count; count x (m + n); count x k by the formula */
    long evaluations, steps;
    bool complete;
    char note[400];       /* room for the note of a motion and the words before it */
    bool multiplier_form; /* was the multiplier form integrated? */
    double state_difference, multiplier_difference, violation; /* relative to sizes along the motion */
    /* was the motion computed once more by CVODE Adams, which is independent of an explicit pair? */
    bool multistep;
    double multistep_difference; /* of its states, relative to sizes along the motion */
    double crossing;             /* first time at which another chart's pivot changes sign; NAN: never */
    const char *crossing_chart;
    size_t watches;
    const char **watch_name;
    double *watch; /* count x watches, along the tightest run */
    /* the closed subsystem for the watched expressions, in words; NULL: nothing is watched, or it could not be
     * integrated */
    const char *scene;
    double scene_difference; /* of the watched values, relative to their sizes along the motion */
    long scene_evaluations;
} nh_validation;

typedef struct {
    const char *name;
    nh_ex value;
    bool asked;    /* given by the user: the subsystem is made for it */
    bool by_terms; /* a sum that may cancel (nh_trajectory_request) */
} nh_observable;

typedef struct {
    /* other: a second chart whose pivot is watched (its independent velocities as functions of this chart's); or
       NULL */
    const nh_model *model, *other;
    size_t currents;
    const nh_ex *current;
    const nh_valid *valid; /* `currents` intervals, or NULL */
    size_t watches;
    const nh_observable *watch;
    const nh_state *initial;
    double until;
    size_t outputs;
    const nh_options *options;
    /* wanted accuracy of the states and of the watched expressions along the tightest run, whose method and tolerance
     * are chosen for it (accuracy.h). 0: the automatic choice (automatic.h), at the tolerance of the options */
    double accuracy;
    /* with an accuracy: the plans that may be used; only methods with error control, in the model's own velocities */
    const nh_integration_plans *ways;
} nh_validation_request;

/* Integrates the motion at the three tolerances and compares it.  The caller frees the result.  NULL with an error
 * where no velocities satisfy the constraints at the initial state, or no motion can be computed; one that ends
 * early is described by `complete`, `end` and `note`. */
nh_validation *nh_validate(const nh_validation_request *request, nh_error *error);
void nh_validation_free(nh_validation *validation);

#endif
