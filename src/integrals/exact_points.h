/* exact_points: points of the constraint submanifold with many digits, for ball arithmetic. */
#ifndef NH_EXACT_POINTS_H
#define NH_EXACT_POINTS_H

#include "exact/ball.h"
#include "geometry/model.h"

/* Set the ball's symbols (t, q, w, u) to a random point with short rational coordinates; implicit velocities are solved
 * for with the ball's precision.  False when the constraints have no solution there.  `state` is that of nh_random. */
bool nh_exact_point(const nh_model *model, nh_ball *ball, uint64_t *state);

/* The same at the point (t, q, w) that begins z; its implicit velocities, which start Newton's iteration, also get
   their values in z. */
bool nh_exact_at(const nh_model *model, nh_ball *ball, double *z);

/* Set the ball's parameters to their given values, for expressions that keep them as symbols. */
void nh_exact_parameters(const nh_model *model, nh_ball *ball);

#endif
