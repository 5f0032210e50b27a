/* pencil: unknown frequencies as an eigenvalue problem.
 *
 * For a factor kappa (1, q', Gamma(Q)/Q) look for f in the span of columns b_j with Gamma(f) = lambda kappa f: then
 * exp(-lambda t) f, exp(-lambda q) f, Q^-lambda f are integrals.  With A: rows of Gamma(b_j), B: rows of kappa b_j,
 * B P = Q R (dependent columns dropped), K = Q^T A R^-1 and rest P = (1 - Q Q^T) A R^-1, the combinations are the
 * largest K-invariant subspace V of null(P), and lambda the eigenvalues of V^T K V.  A real pair exp(-+ i nu q) means
 * cos(nu q), sin(nu q) with nu = |Im lambda|. */
#ifndef NH_PENCIL_H
#define NH_PENCIL_H

#include <stdbool.h>
#include <stddef.h>

#include "integrals/nullspace.h"

typedef struct {
    size_t dimension; /* of V */
    /* eigenvalues lambda; complex ones as adjacent conjugate pairs, positive imaginary part first */
    double *re, *im;
    double *vector_re, *vector_im; /* columns x dimension: f = sum_j (re + i im) b_j, largest entry of modulus 1 */
    double *residual;              /* |A f - lambda B f| / |B f| of each */
    size_t columns;
} nh_pencil;

/* a, b: rows x columns, column-major, leading dimension rows; both are overwritten.  Eigenvalues below `split` in
 * modulus relative to the scale are split Jordan blocks at zero and are left out (1e-4). */
nh_pencil *nh_pencil_solve(size_t rows, size_t columns, double *a, double *b, const nh_nullspace_options *options,
                           double split, nh_error *error);
void nh_pencil_free(nh_pencil *pencil);

#endif
