/* sparse_pencil: what a sparse linear system with a parameter says about single unknowns, used up before anything is
 * dense.
 *
 * A pivot must not depend on lambda. Its row, or its column, has to be free of lambda too: then the rest stays linear
 * in lambda, and has the same finite elementary divisors. Pivots are taken where they fill in little (Markowitz's
 * product of row and column counts). */
#ifndef NH_SPARSE_PENCIL_H
#define NH_SPARSE_PENCIL_H

#include "exact/residue.h"

/* value lambda^power in a row and a column; several for one place are added. */
typedef struct {
    uint32_t row, column, power;
    nh_residue value;
} nh_sparse_entry;

typedef struct {
    size_t rows, columns, degree, entries, capacity;
    nh_sparse_entry *entry;
} nh_sparse_pencil;

/* The linear system with companion variables (staircase.h), reduced: entries of powers 0 and 1, one for each place and
 * power, rows and columns renumbered. */
nh_sparse_pencil nh_sparse_pencil_reduce(const nh_sparse_pencil *pencil, nh_prime field);

#endif
