/* regular: has every independent velocity inertia?
 *
 * The equations of motion determine the accelerations only where the mass matrix on the constraint submanifold is regular:
 *
 *     M = R^T K R,   K_rs = d^2 L / dv^r dv^s,   R = d rho / dw          [docs/method.md, sec. 2]
 *
 * It is evaluated at the probes of the chart, so that a singular Lagrangian is refused before anything is simplified. */
#ifndef NH_REGULAR_H
#define NH_REGULAR_H

#include "geometry/model.h"

/* Of a model, bare or not: false, with the directions that have no inertia, where M is singular at every probe. */
bool nh_model_regular(const nh_model *model, nh_error *error);
/* Says so; returns false. */
bool nh_model_singular(const nh_model *model, nh_error *error);

#endif
