/* For the files that lift numbers from their residues. */
#ifndef NH_SPECIAL_VALUES_INTERNAL_H
#define NH_SPECIAL_VALUES_INTERNAL_H

#include <flint/fmpq.h>

#include "exact/residue.h"

/* A rational number from its residues modulo all primes but the last, which has to agree. */
bool nh_special_reconstruct(size_t primes, const nh_prime *prime, const nh_residue *residue, fmpq_t out);

#endif
