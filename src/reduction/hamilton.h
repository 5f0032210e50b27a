/* hamilton: Hamilton's form of a reduced stage, with momenta as variables.
 *
 *     x' = dH/dp,     p_i' = -dH/dx^i + Ups_ij x'^j            Ups_ij = -Ups_ji, linear in the momenta
 *
 * First stage [ChhabraEmami2014, eq. 2.11]:  H = 1/2 p Khat^-1 p + V,  Ups_ij = U_kij x'^k (chaplygin.h).
 *
 * Second stage [ChhabraEmami2014, eq. 2.19], of an abelian group N with generators e_a: m_a are constants,
 *
 *     H = 1/2 p Kt^-1 p + 1/2 m I^-1 m + V,     v = dH/dm = I^-1 m
 *     Ups_ij = U(h_k x'^k + e_a v^a; h_i, h_j) + v^a U(h_i; e_a, h_j) + m_a Bv^a_ij,    h_i = d_i - Av^a_i e_a
 *
 * where U(l; i, j) = U_lij.  The force on h_i has the part U(w; h_i, e_a) v^a, w = h_j x'^j + e_b v^b; by condition
 * (ii) U(l; e_a, j) is antisymmetric in l and j, so that it is v^a U(h_i; e_a, w), in which the e_b v^b cancel.
 * For other groups the equations have m([Av_i, v]) more, and m moves: they are not given here. */
#ifndef NH_HAMILTON_H
#define NH_HAMILTON_H

#include "reduction/second.h"

typedef struct {
    nh_dag *dag;
    size_t n, d;    /* shape coordinates; constant momenta of the group */
    const nh_ex *x; /* n */
    nh_ex *p, *m;   /* n, d: symbols, which print as the stage's momenta do */
    nh_ex H;        /* of x, p, m: a sum of squares, with the determinant of a pair */
    nh_ex *speed;   /* n: dH/dp */
    nh_ex *U;       /* n x n x (n + d): Ups_ij = U[(k*n + i)*n + j] times x'^k, or m_(k-n) */
    nh_ex *form;    /* n x n: Ups_ij of x, p, m */
    nh_ex *rate;    /* n: p_i' */
} nh_hamilton;

/* 1/2 y K^-1 y for a symmetric n x n matrix and n expressions y, without an explicit inverse where that is shorter: one
 * after another, y_i^2 / 2 K_ii is split off and y_j - K_ij y_i / K_ii takes the place of y_j.  0: K is singular. */
nh_ex nh_hamilton_quadratic(nh_dag *dag, size_t n, const nh_ex *K, const nh_ex *y);

/* False (and nothing is made) where the stage has forces, affine constraints, or a group that is not abelian. */
bool nh_hamilton_of_first(nh_hamilton *out, nh_arena *arena, const nh_chaplygin *first);
bool nh_hamilton_of_second(nh_hamilton *out, nh_arena *arena, const nh_second *second);

#endif
