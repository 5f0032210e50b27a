/* reduced_check: reduced equations, as they are printed, against the accelerations of the system that they reduce.
 *
 * At a state (x, w) of the slice, u = (x', zeta) and its rate u' along the reduced equations give
 *
 *     v = Fr u,      v' = Fr u' + zeta^a (x'^i d_i e_a + v^r d_r e_a)        [quotient.h]
 *
 * which must be the true accelerations at (sigma(x), v), and v must satisfy the constraints. */
#ifndef NH_REDUCED_CHECK_H
#define NH_REDUCED_CHECK_H

#include "reduction/reduced.h"

/* v' (m) at a place and a velocity; false where it cannot be computed. */
typedef bool nh_accelerations(void *context, const double *q, const double *v, double *acceleration);

/* The largest difference over states of the slice, relative to the terms; infinite where no state can be evaluated.
 * *states: how many there were. */
double nh_reduced_difference(const nh_reduced *reduced, const nh_slice *slice, nh_accelerations *accelerations,
                             void *context, size_t *states);

/* x'' of a system that was reduced to these equations, with x' as its velocities w. */
typedef struct nh_reduced_shape nh_reduced_shape;
nh_reduced_shape *nh_reduced_shape_create(const nh_reduced *reduced);
void nh_reduced_shape_free(nh_reduced_shape *shape);
bool nh_reduced_shape_accelerations(void *shape, const double *x, const double *v, double *acceleration);

#endif
