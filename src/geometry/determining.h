/* determining: the equations that decide whether a Chetaev field is a constraint symmetry, as linear combinations of
 * unknown functions.
 *
 * For Z = Z^0 X_0 + zeta^i X_i + W^i Y_i, in coordinate velocities Z^l = zeta^l + w^l Z^0 [CechMusilova2014, eq.
 * 14-19]:
 *
 *     (17) X_0(Phi) + A_i zeta^i = 0
 *     (18) X_l(Phi) - A_l Z^0 + G_il zeta^i + M_il W^i = 0
 *     (19) Y_l(Phi) - M_il zeta^i = 0
 *
 * and, with Phi = Lbar Z^0 + pbar_i zeta^i expanded,
 *
 *     (14) (Lbar - pbar_i w^i) X_0(Z^0) + pbar_i X_0(Z^i) + C_i Z^i + (X_0(Lbar) - w^i C_i) Z^0 = 0,              C_i =
 *          X_0(pbar_i) + A_i
 *     (15) the same with X_l for X_0, C_i = X_l(pbar_i) + G_il, - A_l Z^0 + M_il W^i
 *     (16) the same with Y_l for X_0, C_i = Y_l(pbar_i) - M_il, - pbar_l Z^0
 *
 * In quasi-velocities (14)-(16) stand in zeta instead of Z^l: then the terms with w^i, and - pbar_l Z^0, are not
 * there. */
#ifndef NH_DETERMINING_H
#define NH_DETERMINING_H

#include "geometry/model.h"

typedef enum { NH_DETERMINING_PLAIN, NH_DETERMINING_X0, NH_DETERMINING_X, NH_DETERMINING_Y } nh_determining_operator;
typedef enum {
    NH_DETERMINING_Z0,
    NH_DETERMINING_Z,
    NH_DETERMINING_ZETA,
    NH_DETERMINING_W,
    NH_DETERMINING_PHI
} nh_determining_unknown;

/* coefficient * operator(unknown) */
typedef struct {
    nh_ex coefficient;
    nh_determining_operator along;
    size_t direction; /* of X and Y */
    nh_determining_unknown of;
    size_t index; /* of Z, zeta and W */
} nh_determining_term;

typedef struct {
    int number;       /* 14 to 19 */
    size_t direction; /* l; of (14) and (17) none */
    size_t terms;
    nh_determining_term *term;
} nh_determining_equation;

typedef struct {
    const nh_model *model;
    bool by_Z;    /* in Z^l; else in zeta */
    size_t count; /* 2 + 4n */
    nh_determining_equation *equation;
} nh_determining;

/* The equations of a model, in the arena. */
nh_determining *nh_determining_of(nh_arena *arena, const nh_model *model);

#endif
