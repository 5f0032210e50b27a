/* For the files that lift numbers from their residues. */
#ifndef NH_SPECIAL_VALUES_INTERNAL_H
#define NH_SPECIAL_VALUES_INTERNAL_H

#include <flint/fmpq.h>

#include "exact/residue.h"

/* Rational numbers from their residues modulo all primes but the last, which has to agree, times their common
 * denominator.  residue[i][k] is that of number k modulo prime i.  _fmpz_vec_clear(.., count); NULL: one does not
 * agree. */
fmpz *nh_special_lift_numbers(size_t primes, const nh_prime *prime, size_t count, const nh_residue *const *residue);

#endif
