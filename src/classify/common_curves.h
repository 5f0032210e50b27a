/* common_curves: the common zeros of polynomials in two variables modulo a prime: curves, and points.
 *
 * Curves are the zeros of the greatest common divisor.  With it divided out, every isolated zero has its mu among the
 * roots of the resultants of random combinations; a root common to two resultants belongs to a common zero, or to one
 * at infinity, except by a coincidence of the random numbers. */
#ifndef NH_COMMON_CURVES_H
#define NH_COMMON_CURVES_H

#include "classify/compression.h"

/* All monic (in the highest power of lambda, and there in the highest power of mu) and squarefree. */
typedef struct {
    nh_residue_surface special, degenerate;
    nh_residue_polynomial across; /* in mu */
} nh_common_curves;

/* Common zeros of all of `polynomial` are special; those common to all of `singular` are degenerate instead.  False:
 * the deadline is over. */
bool nh_common_curves_find(nh_prime field, size_t polynomials, const nh_residue_surface *polynomial, size_t singulars,
                           const nh_residue_surface *singular, nh_common_curves *out);
void nh_common_curves_clear(nh_common_curves *curves);

/* The product x y; its coefficients are on the heap. */
nh_residue_surface nh_residue_surface_times(nh_prime field, const nh_residue_surface *x, const nh_residue_surface *y);

#endif
