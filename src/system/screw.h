/* screw: rigid displacements, twists, wrenches and inertias whose entries are expressions.
 *
 * A pose (R, p) of a frame B in a frame A takes the coordinates of a point in B to those in A: x -> R x + p.  A twist
 * (v, w) is the velocity of a frame's origin and its angular velocity, in that frame: the body twist of
 * [ChhabraEmami2014, sec. 4], (v, omega) in this order.  A wrench (p, L) is a momentum or a force and its moment about
 * the origin of the frame in which it is written.
 *
 * Entries are simplified as long as they are short; what is long is left as the shared graph that it is, so that chains
 * of many bodies stay small. */
#ifndef NH_SCREW_H
#define NH_SCREW_H

#include "graph/expr.h"

typedef struct {
    nh_ex R[9], p[3]; /* rotation, row-major: R[3*i + j]; origin */
} nh_pose;

typedef struct {
    nh_ex v[3], w[3];
} nh_twist;

typedef struct {
    nh_ex p[3], L[3];
} nh_wrench;

/* Of bodies that move as one: mass, first moment (mass times centre of mass) and moment of inertia about the origin of
   the frame. */
typedef struct {
    nh_ex m, h[3], I[9];
} nh_inertia;

/* e in its simplest form when it is short, else e. */
nh_ex nh_tidy(nh_dag *dag, nh_ex e);

/* Vectors: a.b, a x b, sum_i R_ij x_j (or R_ji for the transpose). */
nh_ex nh_dot(nh_dag *dag, const nh_ex a[3], const nh_ex b[3]);
void nh_cross(nh_dag *dag, const nh_ex a[3], const nh_ex b[3], nh_ex out[3]);
void nh_rotate(nh_dag *dag, const nh_ex R[9], bool transposed, const nh_ex x[3], nh_ex out[3]);

nh_pose nh_pose_identity(nh_dag *dag);
/* A turn by `angle` about the unit vector u through the origin; a shift by d. */
nh_pose nh_pose_turn(nh_dag *dag, const nh_ex u[3], nh_ex angle);
nh_pose nh_pose_shift(nh_dag *dag, const nh_ex d[3]);
nh_pose nh_pose_product(nh_dag *dag, const nh_pose *a, const nh_pose *b);
void nh_pose_point(nh_dag *dag, const nh_pose *a, const nh_ex x[3], nh_ex out[3]);
/* The pose of b's frame in a's frame, both given in the same third one. */
nh_pose nh_pose_between(nh_dag *dag, const nh_pose *a, const nh_pose *b);

/* Ad of the inverse of a: the twist, known in the outer frame, of the inner one that moves with it. */
nh_twist nh_twist_inwards(nh_dag *dag, const nh_pose *a, const nh_twist *t);
/* The dual: a wrench of the inner frame in the outer one.  And an inertia: Ad(a)^-T I Ad(a)^-1. */
nh_wrench nh_wrench_outwards(nh_dag *dag, const nh_pose *a, const nh_wrench *f);
nh_inertia nh_inertia_outwards(nh_dag *dag, const nh_pose *a, const nh_inertia *c);
nh_inertia nh_inertia_sum(nh_dag *dag, const nh_inertia *a, const nh_inertia *b);
/* Momentum p = m v + w x h, L = h x v + I w. */
nh_wrench nh_inertia_momentum(nh_dag *dag, const nh_inertia *c, const nh_twist *t);
/* v.p + w.L */
nh_ex nh_pairing(nh_dag *dag, const nh_twist *t, const nh_wrench *f);

#endif
