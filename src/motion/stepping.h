/* stepping: steps of any integrator, with outputs, events and limits. */
#ifndef NH_STEPPING_H
#define NH_STEPPING_H

#include "motion/motion.h"

/* Evaluates the right-hand side at the start: a motion that cannot begin is an error (NH_NUMERIC), one that ends early
 * is not. */
bool nh_motion_check_start(const nh_flow_problem *problem, double t, const double *initial, nh_error *error);

/* Makes steps until all times are reached, or something ends the motion early. */
void nh_motion_run(nh_motion *motion, size_t count, const double *times, const nh_flow_options *options,
                   const nh_stepper *stepper);

/* Guard functions along a one-step method, which has no root finding.
 *
 * A step in which a guard changes its sign is undone, and the way to the change is halved until it is short.  So every
 * state comes from steps whose errors are controlled, none is interpolated, and the motion ends before the change. */

typedef enum { NH_GUARD_KEPT, NH_GUARD_BACK, NH_GUARD_END, NH_GUARD_TURN } nh_guard_verdict;

typedef struct {
    const nh_flow_problem *problem;
    double *value, *sign; /* of each guard: its value now, and at the start; NULL: nothing is watched */
    /* the longest step that is allowed (INFINITY: any); a way that is no longer is not halved */
    double longest, least;
} nh_guards;

/* For a motion from z at times[0] to times[count - 1]; nothing is watched unless options->guarded is set. */
void nh_guards_begin(nh_guards *guards, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                     size_t count, const double *times);
void nh_guards_clear(nh_guards *guards);
/* A step led from `before` to the state z at `now`.  KEPT: go on.  BACK: undo it, and make none that is longer than
 * guards->longest.  END: undo it, and the motion ends there (the note names the guard).  TURN: the motion ends behind
 * it. */
nh_guard_verdict nh_guards_judge(nh_guards *guards, double before, double now, const double *z, nh_motion *motion);

#endif
