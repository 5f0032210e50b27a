/* sparse_pencil: what a sparse linear system with one or two parameters says about single unknowns, used up before
 * anything is dense.
 *
 * A pivot must not depend on the parameters. Its row, or its column, has to be free of them too: then the rest has the
 * same powers of the parameters, and loses rank at the same values. Pivots are taken where they fill in little
 * (Markowitz's product of row and column counts). */
#ifndef NH_SPARSE_PENCIL_H
#define NH_SPARSE_PENCIL_H

#include "exact/residue.h"

/* value times a power of the parameters in a row and a column; several for one place are added. Power i + (degree + 1)
 * j is that of lambda^i mu^j. */
typedef struct {
    uint32_t row, column, power;
    nh_residue value;
} nh_sparse_entry;

typedef struct {
    size_t rows, columns, degree, entries, capacity;
    nh_sparse_entry *entry;
    size_t second;           /* degree in mu; 0 where there is none */
    size_t pivots;           /* of a reduced one: how many were used up */
} nh_sparse_pencil;

/* The linear system reduced: one entry for each place and power, rows and columns renumbered. With one parameter it has
 * companion variables (staircase.h), and powers 0 and 1; with two the powers that it had. */
nh_sparse_pencil nh_sparse_pencil_reduce(const nh_sparse_pencil *pencil, nh_prime field);

#endif
