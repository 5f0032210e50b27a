/* scaling: linear fields that multiply the equations of motion by constants.
 *
 *     S = sum_k (kappa_k q_k + mu_k) d/dq_k + sum_i sigma_i w_i d/dw_i,    [S, Gamma] = -tau Gamma:
 *     S(rho^s) = (kappa_s - tau) rho^s,  S(M_ij) = (e - sigma_i - sigma_j) M_ij,  S(A_i) = (e - sigma_i - tau) A_i
 *
 * with some e.  Integrals polynomial in the velocities are sums of such with S(Phi) = lambda Phi, as far as the matrix
 * of S on them is diagonal: a term f(q) w^alpha of one has S(f) = (lambda - sigma . alpha) f. */
#ifndef NH_SCALING_H
#define NH_SCALING_H

#include "count/count_internal.h"
#include "count/jet_equations.h"

typedef struct {
    size_t count, coordinates, n, width; /* scalings; numbers in each */
    nh_num *number; /* count x width: kappa, mu (coordinates each), sigma (n), and what else there is */
} nh_scalings;

/* The scalings for which every one of these functions of the coordinates has S(f) = beta f with a constant beta.
 * Functions that would leave none are not heeded: nh_scaling_weights tells which.  Coordinates among the functions are
 * not shifted.  count is 0 where there are no scalings or their numbers are no short fractions; nh_scaling_clear.  The
 * equations stand at another point afterwards. */
nh_scalings nh_scaling_find(nh_jet_equations *equations, size_t functions, const nh_ex *function);
void nh_scaling_clear(nh_scalings *scalings);

/* A combination of the scalings modulo the prime, with random factors: it has different weights where one of them
 * has.  `width` residues; false where the prime divides a denominator. */
bool nh_scaling_combine(const nh_scalings *scalings, nh_prime field, nh_residue *out);

/* beta for each of these functions, and whether it is constant: `scaling` is a combination.  The equations stand at
 * another point afterwards. */
void nh_scaling_weights(nh_jet_equations *equations, const nh_residue *scaling, nh_prime field, size_t functions,
                        const nh_ex *function, nh_residue *weight, bool *constant);

/* What a symmetry does to the solutions of Gamma(Phi) = 0.
 *
 *     S = sum_k s_k(q) d/dq_k + sum_i sigma_i w_i d/dw_i,    [S, Gamma] = -tau Gamma,  tau constant,
 *
 * maps integrals to integrals and keeps their degree in the velocities, so that its values on the solutions are
 * combinations of them. */

/* Writes the N x N matrix of S, row by row, into out: S of solution j is the sum of out[i N + j] times solution i.
 * `along`: s_k as series, one after another for all coordinates; `factor`: sigma . alpha for each monomial, or NULL.
 * The solutions need all of their coefficients.  False where the series are too short to tell the solutions apart, or
 * S leads out of their span.  *work grows by the products of residues. */
bool nh_solution_matrix(const nh_counter *counter, const nh_count_series *series, const nh_graded_count *solutions,
                        const nh_residue *along, const nh_residue *factor, nh_residue *out, double *work);

#endif
