/* solution_matrix: what a symmetry does to the solutions of Gamma(Phi) = 0.
 *
 *     S = sum_k s_k(q) d/dq_k + sum_i sigma_i w_i d/dw_i,    [S, Gamma] = -tau Gamma,  tau constant,
 *
 * maps integrals to integrals and keeps their degree in the velocities, so that its values on the solutions are
 * combinations of them. */
#ifndef NH_SOLUTION_MATRIX_H
#define NH_SOLUTION_MATRIX_H

#include "count/count_internal.h"

/* Writes the N x N matrix of S, row by row, into out: S of solution j is the sum of out[i N + j] times solution i.
 * `along`: s_k as series, one after another for all coordinates; `factor`: sigma . alpha for each monomial, or NULL.
 * The solutions need all of their coefficients.  False where the series are too short to tell the solutions apart, or
 * S leads out of their span.  *work grows by the products of residues. */
bool nh_solution_matrix(const nh_counter *counter, const nh_count_series *series, const nh_graded_count *solutions,
                        const nh_residue *along, const nh_residue *factor, nh_residue *out, double *work);

#endif
