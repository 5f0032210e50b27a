/* symmetry_count: the number of local symmetries, modulo a prime.
 *
 * The equations of jets.h, in power series.  From a random point q0 modulo a prime, at which all functions are random
 * too (jet_point.h), the 1-jets (xi, B) with (L_xi K)(q0) = 0 are transported along q0 + s (X + u Y), X and Y random,
 * as series in s and, to first order, in u.  They belong to symmetries only if for every ray
 *
 *     d_u xi = s B Y,   d_u B = s (derivative of B along Y)  at u = 0       [transport does not depend on the way]
 *     xi(V) = 0,  L_xi a = 0,  (L_xi omega)(X) = 0 for X in D,  ..          [jet_conditions.h]
 *
 * in every power of s.  The rank of these rows modulo the prime is a lower bound of the rank for the given values of
 * the parameters: there are at most as many symmetries as columns less this rank.  No number is rounded, so a coupling
 * of 1e-12 counts as one of 1 does. */
#ifndef NH_SYMMETRY_COUNT_H
#define NH_SYMMETRY_COUNT_H

#include "reduction/kinetic.h"

typedef struct {
    const char *obstacle;                                      /* why nothing is known, or NULL */
    size_t of_metric, of_potential, of_constraints, dimension; /* upper bounds, as in nh_jets */
    size_t orbit;                                              /* rank of the xi */
} nh_symmetry_count;

/* Needs kinetic->countable. */
nh_symmetry_count nh_symmetry_count_of(const nh_kinetic *kinetic);

#endif
