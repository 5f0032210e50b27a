/* projected_points: points of the constraint submanifold by coordinate velocities instead of a chart's.
 *
 * A chart has positions at which its velocities end: with x z' = y x' and the chart (y', z') x' = x z'/y, and at y = 0
 * all motions have z' = 0.  Lines of constant z' do not lead there.  The velocity v that is nearest to a given one
 * among those that the constraints allow does: v is smooth wherever the constraints are independent, and the chart's w
 * follow from it. */
#ifndef NH_PROJECTED_POINTS_H
#define NH_PROJECTED_POINTS_H

#include "exact/ball.h"
#include "geometry/model.h"

typedef struct nh_projector nh_projector;

/* For points in balls.  The ball has the parameters; it and the model must outlive the projector, which the caller
 * frees.  NULL where the chart's velocities are the coordinates' own, and no constraint binds them. */
nh_projector *nh_projector_create(const nh_model *model, nh_ball *ball);
void nh_projector_free(nh_projector *projector);

/* z = (t, q, w, u) at the position (t, q) that `position` begins with, with the allowed velocity nearest to v (m), in
 * doubles.  False where the iteration fails. */
bool nh_projected_point(nh_projector *projector, const double *position, const double *v, double *z);
/* The same, with the digits of the ball until w and u are rounded: small velocities keep their digits.  False also
 * where v is not on the chart's branch. */
bool nh_projected_exact_point(nh_projector *projector, const double *position, const double *v, double *z);

#endif
