/* staircase: at which values of a parameter does a linear system modulo a prime lose rank?
 *
 * For A(lambda) = A_0 + lambda A_1 + .. + lambda^D A_D, with companion variables y_i = lambda y_(i-1) where D > 1, the
 * pencil A + lambda E is reduced to its regular part (Kronecker's form, by the staircase algorithm [VanDooren1979] over
 * a finite field):
 *
 *     rows      echelon form of [E | A]: rows without a part in E are constant equations, whose pivots are substituted
 *     columns   the same for the transposes
 *
 * until E is square and invertible. Then chi = det(lambda + E^-1 A) is the product of the finite elementary divisors:
 * rank A(lambda) is that of almost all values exactly where chi(lambda) is not zero.
 *
 * With two parameters the same steps for [.. | A_01 | A_10 | A_00] leave small matrices with the same loss of rank.
 * For their generic rank R and random constant L (R x rows) and C (columns x R), det(L A C) vanishes wherever the rank
 * of A is below R; elsewhere two of these compressions have no common zero, except at points that depend on the random
 * choices and differ from one choice to the next. */
#ifndef NH_STAIRCASE_H
#define NH_STAIRCASE_H

#include "exact/residue.h"

/* Sparse elimination of a linear system with one or two parameters, before dense algebra is used.
 *
 * A pivot must not depend on the parameters, and its row or its column must not either: then the remaining system has
 * the same powers of the parameters and loses rank at the same values.  Pivots are chosen by Markowitz's product of row
 * and column counts, so that they fill in little. */

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

/* ---- staircase ---- */

enum { NH_MOST_PARAMETERS = 3 };

/* sum of coefficient[(k * (degree[1] + 1) + j) * (degree[0] + 1) + i] lambda^i mu^j nu^k modulo a prime; a parameter
 * that does not occur has degree 0.  The coefficients are on the heap. */
typedef struct {
    size_t degree[NH_MOST_PARAMETERS];
    nh_residue *coefficient;
} nh_residue_polynomial;

/* chi(lambda), monic, and the generic nullity: the columns less the rank for almost all values.  Takes at most
 * `products` products of residues, which becomes what is left, negative when it did not suffice.  Returns false then,
 * and after the deadline (base/progress.h). */
bool nh_staircase(const nh_sparse_pencil *pencil, nh_prime field, double *products, nh_residue_polynomial *chi,
                  size_t *nullity);

/* For two parameters: the remaining matrices, by powers, then rows, then columns; on the heap. */
typedef struct {
    size_t degree, second, rows, columns; /* degrees in lambda and in mu */
    nh_residue *entry;
} nh_staircase_matrices;
nh_staircase_matrices nh_staircase_reduce(const nh_sparse_pencil *pencil, nh_prime field, double *products);

/* The generic rank R of the matrices, at random residues. */
size_t nh_staircase_generic_rank(const nh_staircase_matrices *matrices, nh_prime field);
/* The determinant of one compression, of degree R times that of the matrices; each seed chooses another one.  False:
 * the deadline is over. */
bool nh_staircase_determinant(const nh_staircase_matrices *matrices, nh_prime field, size_t rank, uint64_t seed,
                              nh_residue_polynomial *out);

/* The rank at one value of the only parameter. */
size_t nh_staircase_rank(const nh_sparse_pencil *pencil, nh_prime field, nh_residue lambda);

#endif
