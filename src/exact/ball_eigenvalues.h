/* ball_eigenvalues: eigenvalues of a matrix of constants, each enclosed. */
#ifndef NH_BALL_EIGENVALUES_H
#define NH_BALL_EIGENVALUES_H

#include "exact/ball.h"

/* The n solutions of det(K - lambda M) = 0, for n x n matrices row by row: their square roots re + i im, each with an
 * error of `error` at most.  False unless all are proved to be different from each other and from zero, or where an
 * entry has no value in the ball. */
bool nh_ball_eigenvalue_roots(nh_ball *ball, size_t n, const nh_ex *M, const nh_ex *K, double *re, double *im,
                              double *error);

/* Approximate eigenvalues re + i im of the n x n matrix A, row by row.  A multiple one, which rounding splits by a root
 * of its size, is the mean of its parts, which it does not move.  False, with re and im as they were, where an entry
 * has no value in the ball. */
bool nh_ball_eigenvalues(nh_ball *ball, size_t n, const nh_ex *A, double *re, double *im);

#endif
