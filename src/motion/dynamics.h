/* dynamics: a model's equations of motion as problems for the integrators, and initial states. */
#ifndef NH_DYNAMICS_H
#define NH_DYNAMICS_H

#include "geometry/bordered.h"
#include "motion/chetaev.h"

/* A position and velocity in coordinates. */
typedef struct {
    double t;
    double *q, *v; /* m entries each */
    bool *given;   /* of each velocity: was it given?  The constraints determine the others.  NULL: all were given */
    bool *placed;  /* of each position: was it given?  NULL: none was */
} nh_state;

/* Equations of motion on the constraint submanifold: z = (q, w), z' = (rho, a), with their exact Jacobian.  The pivot
   of a chart of coordinate velocities is a guard. */
typedef struct nh_dynamics nh_dynamics;
/* Keeps the model, which has to outlive it.  The caller frees it. */
nh_dynamics *nh_dynamics_create(const nh_model *model);
/* Uses the programs of another one, which has to outlive it: for another thread.  The caller frees it. */
nh_dynamics *nh_dynamics_share(const nh_dynamics *other);
void nh_dynamics_free(nh_dynamics *dynamics);
/* The problem for the integrators; its context is the nh_dynamics, which one thread uses at a time. */
nh_flow_problem nh_dynamics_problem(nh_dynamics *dynamics);
/* Are differences cheaper than an exact Jacobian, for rates of so many instructions in so many states? */
bool nh_dynamics_differences(size_t length, size_t size);
/* Long motions are continued in machine code (nh_tape_jit).  The words say whether they are; NULL: nothing was
 * tried. */
void nh_dynamics_jit(nh_dynamics *dynamics, double patience);
double nh_dynamics_patience(const nh_dynamics *dynamics);
const char *nh_dynamics_words(const nh_dynamics *dynamics);
/* Instructions of one evaluation of the equations of motion. */
size_t nh_dynamics_length(const nh_dynamics *dynamics);
/* From now on the chart ends where its pivot falls to a small part of its value at (t, z): near a zero of the pivot
 * errors of the states may reverse a motion. */
void nh_dynamics_end_early(nh_dynamics *dynamics, double t, const double *z);
/* Does the model's chart have a pivot to watch? */
bool nh_dynamics_watched(const nh_model *model);
const nh_model *nh_dynamics_model(const nh_dynamics *dynamics);

/* (q, w) of a state, z of m + n entries.  Velocities that are given are kept; the others follow from the constraints in
 * all coordinates (of least norm where these leave a choice, by the diagonal of the kinetic energy), in charts of
 * quasi-velocities and of implicit ones by Gauss-Newton on rho(t, q, w) = v.  Refuses velocities off the constraints,
 * saying by how much, unless `project` is set, which takes the nearest.  nh_dynamics_start_all also writes v (m). */
bool nh_dynamics_start(nh_dynamics *dynamics, const nh_state *state, bool project, double *z, nh_error *error);
bool nh_dynamics_start_all(nh_dynamics *dynamics, const nh_state *state, bool project, double *z, double *v,
                           nh_error *error);
/* v (m) at z = (q, w), dependent velocities from the constraints.  False where w does not determine them. */
bool nh_dynamics_velocities(nh_dynamics *dynamics, double t, const double *z, double *v);
/* Are the chart's formulas regular at z, where the velocities are v? */
bool nh_dynamics_holds(nh_dynamics *dynamics, double t, const double *z, const double *v);

/* Does the state lie on the other branch of a quadratic constraint than the chart?  Only velocities that are given say
   so. */
bool nh_dynamics_other_branch(const nh_model *model, const nh_state *state);

/* Do the formulas of the chart not hold at the state, whose velocities are completed to v (m)?  Writes the k dependent
 * coordinates that the constraints determine there: the chart's own, where only its formulas are singular. */
bool nh_dynamics_other_dependents(const nh_model *model, const nh_state *state, size_t *dependent, double *v);

/* The point (t, q, w, u) that belongs to (t, z); width entries.  False when the implicit velocities cannot be found. */
bool nh_dynamics_point(nh_dynamics *dynamics, double t, const double *z, double *point);

/* The multiplier form (geometry/bordered.h) as a problem with multipliers, and solved for the accelerations: (q, v)' =
 * (v, v'(t, q, v)), regular wherever the constraints are independent, whatever the charts do. */
nh_chetaev_problem nh_bordered_problem(nh_bordered *bordered);
nh_flow_problem nh_bordered_flow(nh_bordered *bordered);

#endif
