/* submanifold: the forms and matrices of a constrained system that its model does not hold.
 *
 * In a chart of coordinate velocities, with the dependent velocities y'^a = g^a(t, q, w) [CechMusilova2014, sec. 2.3]:
 *
 *     phi^a   = dy^a - g^a_l dq^l - (g^a - g^a_l w^l) dt          annihilates the canonical distribution      (eq. 6)
 *     Lbar_a  = dL/dy'^a,   eps'_l(g^a) = X_l(g^a) - X_0(g^a_l)
 *     eps_l(Lbar) = X_l(Lbar) - X_0(pbar_l) - Y_r(pbar_l) w'^r,   eps_l(g^a) = eps'_l(g^a) - g^a_lr w'^r     (eq. 8)
 *     Abar_l = eps'_l(Lbar) - Lbar_a eps'_l(g^a),   Bbar_ls = -Y_s(pbar_l) + Lbar_a g^a_ls                   (eq. 9)
 *
 * and in all velocities v, before the constraints are imposed [CechMusilova2014, eq. 3 and 10]:
 *
 *     A_s = dL/dq^s + Q_s - (d/dt + v^r d/dq^r) dL/dv^s,   B_sr = -d2L/dv^s dv^r,   A_s + B_sr v'^r = mu_a df^a/dv^s
 *
 * Without constraints there are no forms. */
#ifndef NH_SUBMANIFOLD_H
#define NH_SUBMANIFOLD_H

#include "geometry/model.h"

typedef struct {
    const nh_model *model;
    bool normal;            /* a chart of coordinate velocities, with constraints: g, Lbar_a and eps' are there */
    nh_ex *form;            /* k x (1 + m): phi^a = form_0 dt + form_s dq^s */
    nh_ex *across;          /* k x m: fields V_a with phi^b(V_a) = delta */
    nh_ex *slope;           /* k x n: g^a_l */
    nh_ex *turn;            /* k x n: eps'_l(g^a) */
    nh_ex *bend;            /* k x n x n: g^a_ls */
    nh_ex *force;           /* n: eps'_l(Lbar) */
    nh_ex *inertia;         /* n x n: Y_s(pbar_l) */
    nh_ex *inverse;         /* n x n: the inverse of Bbar = -M */
    nh_ex *free_A, *free_B; /* m; m x m: A_s and B_sr in all velocities */
    nh_ex *f_v;             /* k x m: df^a/dv^s of the constraints as they were written, in all velocities */
} nh_submanifold;

/* All of them, in the arena.  `dependent`: the k coordinates whose velocities normalise the forms; NULL: those of the
 * chart, or none. */
nh_submanifold *nh_submanifold_of(nh_arena *arena, const nh_model *model, const size_t *dependent);

/* The force of the constraints, read as inertial forces.
 *
 * By Chetaev's equations mu_a df^a/dv^s = A_s + B_sr v'^r (submanifold.h).  Along a length s each part has a name
 * [CechMusilova2014, eq. 46]:
 *
 *     Euler force          B_sr v'^r            r an angle
 *     translational force  B_sr v'^r            r a length
 *     centrifugal force    A_s, quadratic in the rates of angles
 *     Coriolis force       A_s, a rate of an angle times one of a length
 *     further terms        A_s, quadratic in the rates of lengths, or linear in velocities (they vanish in Cartesian
 *                          coordinates at rest)
 *     applied force        A_s, the rest
 *
 * It splits where every coordinate is an angle or a length and A_s - Q_s is at most quadratic in the velocities. */

typedef enum {
    NH_INERTIAL_CENTRIFUGAL,
    NH_INERTIAL_CORIOLIS,
    NH_INERTIAL_FURTHER,
    NH_INERTIAL_APPLIED,
    NH_INERTIAL_PARTS
} nh_inertial_part;

typedef struct {
    const nh_submanifold *of;
    /* m x NH_INERTIAL_PARTS, nothing for angles; the first two kinds hold the coefficients B of the submanifold */
    nh_ex *part;
} nh_inertial;

/* NULL: the force does not split or is too long, there are no constraints or no lengths, or a coordinate is neither a
 * length nor an angle. */
nh_inertial *nh_inertial_of(nh_arena *arena, const nh_submanifold *submanifold);

#endif
