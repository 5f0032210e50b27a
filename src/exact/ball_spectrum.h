/* ball_spectrum: all eigenvalues of a matrix of balls, multiple and defective ones too, each enclosed. */
#ifndef NH_BALL_SPECTRUM_H
#define NH_BALL_SPECTRUM_H

#include "exact/ball_arb.h"

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
