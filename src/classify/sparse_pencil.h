/* sparse_pencil: sparse elimination of a linear system with one or two parameters, before dense algebra is used.
 *
 * A pivot must not depend on the parameters, and its row or its column must not either: then the remaining system has
 * the same powers of the parameters and loses rank at the same values.  Pivots are chosen by Markowitz's product of row
 * and column counts, so that they fill in little. */
#ifndef NH_SPARSE_PENCIL_H
#define NH_SPARSE_PENCIL_H

#include "exact/residue.h"

/* `value` times power i + (degree + 1) j of the parameters, lambda^i mu^j, in one row and column; several entries for
 * one place are added. */
typedef struct {
    uint32_t row, column, power;
    nh_residue value;
} nh_sparse_entry;

typedef struct {
    size_t rows, columns, degree, entries, capacity;
    nh_sparse_entry *entry;
    size_t second; /* degree in mu; 0 where there is none */
    size_t pivots; /* of a reduced pencil: the number of pivots that were eliminated */
} nh_sparse_pencil;

/* Eliminates.  The result has one entry for each place and power, on the heap, with rows and columns renumbered.  With
 * one parameter it has companion variables (staircase.h) and powers 0 and 1; with two the powers of `pencil`. */
nh_sparse_pencil nh_sparse_pencil_reduce(const nh_sparse_pencil *pencil, nh_prime field);

#endif
