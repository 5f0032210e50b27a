/* turns: motions in coordinates that are described anew on the way.
 *
 * The coordinates s of an orientation grow beyond all bounds at a full turn; their shadow -s/(s.s) is the same rotation
 * and obeys the same equations (system/orientation.h).  The last `turns` guards of a problem are positive; where one of
 * them vanishes the motion's part ends, the state is described anew, and the next part begins. */
#ifndef NH_TURNS_H
#define NH_TURNS_H

#include "motion/motion.h"
#include "system/system.h"

/* 3 - s.s for each orientation of the system, of positions q. */
void nh_turns_guard(const nh_system *system, const double *q, double *value);
/* Replaces s by its shadow where that guard is not positive; v: the coordinates' velocities, or NULL.  True: it did. */
bool nh_turns_renew(const nh_system *system, double *q, double *v);

/* Of s and its shadow, the one that is nearer to that of `to`: for comparisons of two motions. */
void nh_turns_nearest(const nh_system *system, const double *to, double *q, double *v);

typedef nh_motion *nh_turns_part(const void *method, const nh_flow_problem *problem, const double *initial,
                                 size_t count, const double *times, const nh_flow_options *options, nh_error *error);
/* A motion in parts, each by `part`.  Its rows are described anew, too, where a guard is negative. */
nh_motion *nh_turns_flow(nh_turns_part *part, const void *method, const nh_flow_problem *problem, const double *initial,
                         size_t count, const double *times, const nh_flow_options *options, nh_error *error);

#endif
