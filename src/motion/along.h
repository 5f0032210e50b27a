/* along: expressions of a chart along motions of any formulation. */
#ifndef NH_ALONG_H
#define NH_ALONG_H

#include "motion/dynamics.h"
#include "motion/motion.h"

/* The point at which a compiled expression is evaluated, of the state z at t. */
typedef bool nh_to_point(void *context, double t, const double *z, double *point);

/* n expressions, compiled for states of one kind. */
typedef struct nh_along_values nh_along_values;
/* `place` gives points (t, q, w, u) of the model's chart; `context` must outlive the result. */
nh_along_values *nh_along_values_create(const nh_model *model, nh_to_point *place, void *context, size_t n,
                                        const nh_ex *e);
/* For states (q, w), or with `everywhere` (q, v), of the dynamics' model. */
nh_along_values *nh_along_values_of(nh_dynamics *dynamics, bool everywhere, size_t n, const nh_ex *e);
/* Expressions of `model` at states (q, w) of the other dynamics' model of the same system. */
nh_along_values *nh_along_values_by_other(const nh_model *model, nh_dynamics *other, size_t n, const nh_ex *e);
void nh_along_values_free(nh_along_values *values);
/* Into value (n); false where implicit velocities cannot be found. */
bool nh_along_values_at(nh_along_values *values, double t, const double *z, double *value);
/* value[i * n + k]: expression k at output i; false as above. */
bool nh_along_values_outputs(nh_along_values *values, const nh_motion *motion, double *value);
/* The same at the recorded zeros of the motion. */
bool nh_along_values_events(nh_along_values *values, const nh_motion *motion, double *value);

/* value[i * n + k]: expression k of the chart at output i of a motion in (q, w) or in (q, v).  False where implicit
   velocities cannot be found. */
bool nh_along(nh_dynamics *dynamics, const nh_motion *motion, size_t n, const nh_ex *e, double *value);

/* (q, v) at the outputs of a motion in (q, w), into states (motion->count x 2m).  False where implicit velocities
   cannot be found. */
bool nh_states_in_coordinates(nh_dynamics *dynamics, const nh_motion *motion, double *states);

/* The whole motion with its zeros and its end state, in (q, v) instead of (q, w). */
bool nh_motion_to_coordinates(nh_dynamics *dynamics, nh_motion *motion);

#endif
