/* jet_independent: do the functions at a point satisfy no other relations than those that the point keeps?
 *
 * A choice of residues (jet_point.h) is a homomorphism from the functions that stand in the expressions, and ranks and
 * values modulo a prime prove something, when this is so.  Roots and transcendental functions are adjoined one after
 * another, those that stand inside of others first:
 *
 *     roots of even order    over the field K of what was adjoined before: residues of the radicands at points of K,
 *                            modulo any primes, of which each is a square or none.  Where these patterns of signs
 *                            have full rank over the field of two elements, no product of radicands is a square in K
 *     roots of odd order     unique modulo the prime, hence what they have to be
 *     exp, sin, cos, log, .. the atoms of either kind are linearly independent over Q as series [Ax1971]
 *
 * docs/method.md, section 10, has the lemma and its proof. */
#ifndef NH_JET_INDEPENDENT_H
#define NH_JET_INDEPENDENT_H

#include "exact/jet_point.h"

/* Writes why relations between the kernels may be missed, or NULL: then there are none, and this is proved.  A
 * sentence's part, static.  The point must have been registered; its values are forgotten. */
const char *nh_jet_point_related(nh_jet_point *point);

#endif
