/* For the files that lift numbers from their residues. */
#ifndef NH_SPECIAL_VALUES_INTERNAL_H
#define NH_SPECIAL_VALUES_INTERNAL_H

#include <flint/fmpq.h>

#include "exact/residue.h"

/* Rational numbers from their residues modulo all primes but the last, which has to confirm them, times their common
 * denominator. residue[i][k] is the residue of number k modulo prime i.  The caller frees the vector by
 * _fmpz_vec_clear(.., count); NULL: a number was not confirmed. */
fmpz *nh_special_lift_numbers(size_t primes, const nh_prime *prime, size_t count, const nh_residue *const *residue);

#endif
