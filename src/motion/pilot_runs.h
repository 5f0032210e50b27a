/* pilot_runs: a small benchmark on a piece of one motion, before the rest of it is computed.
 *
 * The caller gives the beginning of the piece; its length is such that the best method so far needs a small part of the
 * budget, in counted work (base/effort.h).  A run of that method at a tolerance a hundred times tighter is the
 * reference.  Every other method runs a few times, at the tolerance (or step) at which its error is expected to be eps
 * at the end of the whole motion, and with at most a few times the work of the best so far.  Errors are taken to grow
 * in proportion to time, as those of regular motions do; they only rank methods; accuracy.h checks the chosen one. */
#ifndef NH_PILOT_RUNS_H
#define NH_PILOT_RUNS_H

#include "motion/integration_plan.h"

enum { NH_PILOT_RUNS_WAYS = 32 };

typedef struct {
    double eps;
    const nh_method *best; /* the best plan so far, in the model's own velocities */
    double effort;         /* units of base/effort.h that this plan takes for the whole motion */
    double budget;         /* units of all pilot runs, with deriving the functions of methods with fixed steps */
    bool plain;            /* only the model's own velocities and methods with error control */
    const double *floor;   /* least scales of what is wanted (nh_accuracy_difference) */
} nh_pilot_runs_terms;

typedef struct {
    size_t count; /* plans that were measured, below eps or not; 0: there was no reference */
    nh_integration_plan way[NH_PILOT_RUNS_WAYS];
    size_t tried; /* methods in velocities */
    double part;  /* of the motion */
    long evaluations;
    double effort, seconds; /* of all pilot runs: units of base/effort.h, and time by the clock */
} nh_pilot_runs;

/* `from`: a state of the motion between its ends, or the initial one. */
void nh_pilot_runs_make(const nh_trajectory_request *request, const nh_state *from, const nh_pilot_runs_terms *terms,
                        nh_pilot_runs *out);

/* The cheapest plan below eps, if it saves work relative to the best known one.  Where none does: the best known one
 * itself, or NULL when `done`, that is when one of its runs has been made. */
nh_integration_plan_choice nh_pilot_runs_choose(const nh_pilot_runs *runs, const nh_method *best, double eps,
                                                const nh_integration_plan_limits *limits, bool done);

#endif
