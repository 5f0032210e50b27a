/* fraction: a fraction from its residues. */
#ifndef NH_FRACTION_H
#define NH_FRACTION_H

#include <flint/fmpq.h>

#include "exact/residue.h"

/* The fraction with these residues modulo all but the last of the primes, at least two, whose top and bottom are below
 * the root of half their product.  False: there is none, or it has not the residue modulo the last prime. */
bool nh_fraction_of(size_t primes, const nh_prime *prime, const nh_residue *residue, fmpq_t out);

#endif
