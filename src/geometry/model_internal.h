/* model_internal: the frame of a model's configuration space in which its equations are written (Hamel's equations).
 *
 * Fields e_a, one for each coordinate, and their dual forms beta^a: of an orientation (system/orientation.h) those of
 * its angular velocities, of any other coordinate d/dq^a.  With the rates u^a along them and p_a = dL/du^a,
 *
 *     theta = p_a beta^a,   dtheta = dp_a ^ beta^a + p_a dbeta^a,
 *     dbeta^a(e_b, e_c) = -C^a_bc,   [e_b, e_c] = C^a_bc e_a,
 *
 * so that the matrices of docs/method.md, sec. 2, keep their form, with one more term p_a dbeta^a. */
#ifndef NH_MODEL_INTERNAL_H
#define NH_MODEL_INTERNAL_H

#include "geometry/model.h"

/* Does the model have a frame beside its coordinates?  Sets up rho and R along it (model->frame_rho, frame_R, frame_p:
 * else those of the coordinates). */
void nh_frame_open(nh_model *model);
/* The symbol of the rate along e_a in nh_system.framed. */
nh_ex nh_frame_rate(const nh_model *model, size_t a);
/* The Lagrangian in these rates. */
nh_ex nh_frame_lagrangian(const nh_model *model);
/* An expression in these rates, composed with the chart. */
nh_ex nh_frame_compose(const nh_model *model, nh_ex e);
/* Sum over s of e_a^s c_s: a covector of the coordinates along e_a. */
nh_ex nh_frame_along(const nh_model *model, size_t a, const nh_ex *c);
/* The covector c_a of the frame in coordinates: out_s = beta^a_s c_a (m; in place of c is not allowed). */
void nh_frame_covector(const nh_model *model, const nh_ex *c, nh_ex *out);
/* p_a dbeta^a(x, y) for rates x and y along the frame (every stride-th of an array). */
nh_ex nh_frame_turn(const nh_model *model, const nh_ex *x, size_t x_stride, const nh_ex *y, size_t y_stride);
/* The same for x = e_s and y = rho. */
nh_ex nh_frame_turn_along(const nh_model *model, size_t s);
/* df^a/du of the constraint a along e_b, composed. */
nh_ex nh_frame_slope(const nh_model *model, size_t a, size_t b);

#endif
