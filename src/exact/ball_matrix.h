/* ball_matrix: eigenvalues of a matrix of constants, each enclosed. */
#ifndef NH_BALL_MATRIX_H
#define NH_BALL_MATRIX_H

#include "exact/ball.h"
#include "exact/ball_arb.h"

/* The n solutions of det(K - lambda M) = 0, for n x n matrices row by row: their square roots re + i im, each with an
 * error of `error` at most.  False unless all are proved to be different from each other and from zero, or where an
 * entry has no value in the ball. */
bool nh_ball_eigenvalue_roots(nh_ball *ball, size_t n, const nh_ex *M, const nh_ex *K, double *re, double *im,
                              double *error);

/* Approximate eigenvalues re + i im of the n x n matrix A, row by row.  A multiple one, which rounding splits by a root
 * of its size, is the mean of its parts, which it does not move.  False, with re and im as they were, where an entry
 * has no value in the ball. */
bool nh_ball_eigenvalues(nh_ball *ball, size_t n, const nh_ex *A, double *re, double *im);

/* Is a row of values linearly independent of the rows before it?  By elimination in ball arithmetic: the
 * remainder of the row then has rigorous bounds. */

/* Rows of `width` expressions, each multiplied by scale[column].  Writes log10 of a lower and an upper bound for the
 * remainder of the last row, relative to its largest entry: a finite lower bound proves that the rank grows.  False
 * where something is not finite, the earlier rows are not known to be independent, or the row vanishes. */
bool nh_ball_rank_left(nh_ball *ball, size_t rows, size_t width, const nh_ex *e, const double *scale,
                       double *log10_lower, double *log10_upper);

/* All eigenvalues of a matrix of balls, multiple and defective ones too, each enclosed. */

/* `times` eigenvalues, counted with multiplicity, lie within `radius` of a number that re and im round to doubles, and
 * within `error` of re + i im as 15 digits write them.  im is exactly 0 where a single eigenvalue is real. */
typedef struct {
    double re, im, radius, error;
    size_t times;
} nh_eigenvalue;

/* Bits with which the eigenvalues of an n x n matrix are enclosed, however defective it is. */
long nh_ball_spectrum_bits(size_t n);

/* The eigenvalues of the square matrix A, at most n of them, by descending real part, then by descending imaginary
 * part; they are written to out.  Returns their number; 0 where no enclosure is found. */
size_t nh_ball_spectrum(const arb_mat_t A, long bits, nh_eigenvalue *out);

#endif
