/* linear_family: at which values of a parameter does a linear system of partial differential equations have more
 * solutions?
 *
 *     sum over a, k of L_eak(q) d_k u_a  +  sum over a of N_ea(q) u_a = 0,     e = 1, .., equations
 *
 * for unknown functions u_a of coordinates q, with coefficients rational in the parameter. Taylor coefficients of u up
 * to an order r meet the equations up to the order r - 1: a linear system A(lambda), whose kernel projects to the
 * derivatives of u up to the order s = `low` at the point. P(lambda) = n_low - rank A + rank A_high, where the columns
 * of A_high are those of higher derivatives, is the dimension of this projection, and an upper bound for that of the
 * solutions' derivatives up to the order s. Where chi(lambda) is not zero (staircase.h) P is at most what it is for
 * almost all values: rank A is the full one, and rank A_high at most that [docs/method.md, sec. 11].
 *
 * Without coefficients (NULL) the equations are those for the density of an invariant measure. With G = Q Gamma, G =
 * w^i G_i + G_0 + rates d/dw, the measure u(q) dq dw is invariant under Gamma when (u/Q) G has no divergence:
 *
 *     G_i^k d_k u + (d_k G_i^k + (d rate^l/d w^l)_i) u = 0    for every i, and the part without velocities */
#ifndef NH_LINEAR_FAMILY_H
#define NH_LINEAR_FAMILY_H

#include "geometry/model.h"

enum { NH_LINEAR_MOST_LEVELS = 8 };

typedef struct {
    size_t unknowns;
    /* the equations of each level: the first level[i].equations of all */
    size_t levels, equations[NH_LINEAR_MOST_LEVELS];
    size_t known;     /* independent solutions for every value; SIZE_MAX: unknown */
    size_t low;       /* s */
    size_t step;      /* brackets of this length of fields in the equations span everything */
    size_t variables; /* q: symbols */
    const nh_ex *variable;
    const nh_ex *coefficient; /* of the last level: (e * unknowns + a) * (variables + 1) + k, N behind the L; or NULL */
    size_t n;                 /* where a determinant vanishes for some value the equations mean nothing: */
    const nh_ex *mass;        /* n x n */
} nh_linear_family;

#endif
