/* density: closed forms of invariant measures of reduced Chaplygin systems [BorisovMamaev2008].
 *
 * exp(sigma(x)) dx dp is invariant when d_j sigma = -Theta_j (chaplygin.h).  sigma is sought as c_1 log F_1 + c_2 log
 * F_2 with rational c: F are sums, functions and coordinates that occur in Khat, and the determinant of Khat. */
#ifndef NH_DENSITY_H
#define NH_DENSITY_H

#include "integrals/prove.h"
#include "reduction/chaplygin.h"

/* The density exp(sigma), up to a constant factor, as a function of the slice's x; K (n x n), U (n x n x n) as for
 * nh_chaplygin_measure_of, of a slice whose entries are exact.  False where none of this form is found.  Of several
 * that fit, one that holds for all parameters is taken.  `proof`: of the equation; without one it holds to rounding at
 * the sample points. */
bool nh_density_find(const nh_slice *slice, const nh_ex *K, const nh_ex *U, const nh_options *options, nh_ex *density,
                     nh_proof *proof);

#endif
