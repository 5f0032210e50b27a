/* wall_steps: steps that end where the equations of motion have a kink or a jump.
 *
 * Between two walls (exact/walls.h) the right-hand side is smooth, and the error control of an integrator is reliable.
 * Across a wall it is not: where the force is constant on both sides steps become so long that they skip a whole
 * excursion to the other side without a visible error.  So the functions of the walls are sampled inside each step
 * (sign_changes.h), and the first change of a sign is found.
 *
 * A step over a wall is taken back. A one-step method goes back to the beginning of the step and approaches the wall by
 * steps of which no stage is behind it; only one as short as the rounding of the time leads across.  A method with many
 * steps behind it leaves that to a one-step method, and starts again behind the wall. */
#ifndef NH_WALL_STEPS_H
#define NH_WALL_STEPS_H

#include "motion/sign_changes.h"
#include "motion/sizes.h"

typedef struct {
    nh_sign_changes change; /* of the functions of the walls */
    double *ends;           /* of a one-step method: states and rates at both ends of the step */
    double longest;         /* for a one-step method: the longest step that is allowed now (INFINITY: any) */
    double least;           /* a step this short may cross a wall */
    /* where its step begins, and the first time in it at which the rates were evaluated behind a wall (INFINITY:
     * never) */
    double from, seen;
    double span, last; /* length of the whole motion; time of the last `many`th crossing */
    bool held;         /* the motion cannot leave a wall */
    long crossed;
} nh_wall_steps;

/* Prepares for a motion from z at times[0] to times[count - 1]. */
void nh_wall_steps_begin(nh_wall_steps *steps, const nh_flow_problem *problem, const double *z, size_t count,
                         const double *times);
/* A step so short that what happens in it is below the allowed error, or below the error of solving for stages, may
 * cross a wall. */
void nh_wall_steps_coarser(nh_wall_steps *steps, double time);
void nh_wall_steps_clear(nh_wall_steps *steps);

typedef enum { NH_WALL_NONE, NH_WALL_BACK, NH_WALL_CROSSED, NH_WALL_END } nh_wall_verdict;

/* A one-step method calls this when it evaluates the rates at (t, z). */
void nh_wall_steps_see(nh_wall_steps *steps, double t, const double *z);

/* A one-step method went from `old` at `before` to `z` at `now`.  NONE: there was no wall.  BACK: undo the step,
 * and make none that is longer than steps->longest.  CROSSED: go on, without the history of earlier steps.  END: the
 * motion cannot leave the wall, and ends (the note says so). */
nh_wall_verdict nh_wall_steps_judge(nh_wall_steps *steps, const nh_flow_problem *problem, double before,
                                    const double *old, double now, const double *z, nh_motion *motion);

/* The first time in a step at which a wall is crossed (NAN: none); `state` gives the states inside of it. */
double nh_wall_steps_first(nh_wall_steps *steps, double before, double now, nh_inside *state, void *context);
/* From now on the motion is behind the wall, at the state in steps->change.z. */
void nh_wall_steps_go_over(nh_wall_steps *steps, double t, nh_motion *motion);

#endif
