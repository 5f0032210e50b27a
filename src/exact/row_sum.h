/* row_sum: sums of multiples of rows, modulo a prime of 31 bits: most of the time of dense linear algebra. */
#ifndef NH_ROW_SUM_H
#define NH_ROW_SUM_H

#include "exact/residue.h"

/* y += sum over t < count of factor_t row_t, componentwise, of n residues each. */
void nh_row_sum_add(nh_prime field, size_t n, nh_residue *y, size_t count, const nh_residue *factor,
                    const nh_residue *const *row);

#endif
