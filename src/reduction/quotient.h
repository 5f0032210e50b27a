/* quotient: the quotient of equations of motion by a symmetry group, for any constraints and any Lagrangian.
 *
 * In a chart (t, q, w) of the constraint submanifold, v = rho(t, q, w), the semispray is Gamma = d/dt + rho^s d/dq^s +
 * a^k d/dw^k, and the generators, prolonged, are e_a^s d/dq^s + eta_a^k d/dw^k with
 *
 *     (d rho^s/dw^k) eta_a^k = rho^r d_r e_a^s - e_a^r d_r rho^s
 *
 * Gamma commutes with these, so that Gamma - zeta^a e_a, with zeta such that it is tangent to the slice y = y0, is the
 * reduced field there:
 *
 *     e_a^y zeta^a = rho^y,      x' = rho^x - zeta^a e_a^x,      w' = a - zeta^a eta_a,      g' = g zeta
 *     [here]
 *
 * No connection, no momentum and no metric is used: nonlinear constraints, Lagrangians that are not quadratic, and
 * explicit time. */
#ifndef NH_QUOTIENT_H
#define NH_QUOTIENT_H

#include "reduction/momenta.h"
#include "reduction/reduced.h"

/* The same in the frame of the slice without any chart of velocities: q = sigma(x), v = Fr u, u = (x', zeta), v' = Fr
 * u' + x'^i d_i Fr u + zeta^a v^r d_r e_a, so that
 *
 *     Fr u' = v' - 2 zeta^a x'^i d_i e_a - zeta^a zeta^b e_b^r d_r e_a,         v' by the equations with multipliers
 *     (bordered.h)     [here]
 *
 * which holds wherever the constraints are independent.  `model` may be bare; the result keeps what it needs until it
 * is freed. */
typedef struct nh_frame_motion nh_frame_motion;
/* Never NULL; the caller frees it. */
nh_frame_motion *nh_frame_motion_create(nh_reduced *out, const nh_model *model, const nh_slice *slice);
void nh_frame_motion_free(nh_frame_motion *motion);

/* As equations with the mass matrix 1: p = w.  The model is that of the whole system (nh_model_create).  False with a
 * message where its chart is implicit, or the slice singular. */
bool nh_quotient_init(nh_reduced *out, const nh_model *model, const nh_slice *slice, nh_error *error);
/* The velocities w of a state; false with a message where the chart does not cover it. */
bool nh_quotient_velocities(const nh_model *model, double t, const double *q, const double *v, double *w,
                            nh_error *error);
/* Constant combinations c^a e_a . dL/dv that are conserved along Gamma. */
void nh_quotient_momenta(nh_momenta *out, const nh_model *model, const nh_action *action, const nh_options *options);

#endif
