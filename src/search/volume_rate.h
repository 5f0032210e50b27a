/* volume_rate: the rate at which the flow of the equations of motion changes volumes.
 *
 *     div Gamma = d rho^s/dq^s + d a^i/dw^i
 *
 * in the coordinates and velocities of the chart.  Where it is the rate of a function Q of the coordinates, exp(-Q) is
 * the density of an invariant measure, and products of powers of exp(Q) with other functions are often conserved: of a
 * wheeled cart w exp(k (psi1 + psi2)), in a direction in which no single coordinate grows [BorisovMamaev2008]. */
#ifndef NH_VOLUME_RATE_H
#define NH_VOLUME_RATE_H

#include "integrals/dictionary.h"

/* Q as a sum of coordinates and logarithms of lengths, with coefficients that are functions of the parameters; 0 where
   div Gamma = 0 or no such sum is found.  `max_terms`: of polynomials. */
nh_ex nh_volume_rate_potential(const nh_model *model, const nh_dictionary *words, size_t max_terms);

#endif
