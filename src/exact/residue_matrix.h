/* residue_matrix: dense linear algebra modulo a prime of 31 bits.  Matrices lie row by row. */
#ifndef NH_RESIDUE_MATRIX_H
#define NH_RESIDUE_MATRIX_H

#include "exact/residue.h"

/* out = a b  (m x k times k x n); `out` is neither of them. */
void nh_residue_matrix_multiply(nh_prime field, size_t m, size_t k, size_t n, const nh_residue *a, const nh_residue *b,
                                nh_residue *out);

/* Brings the first `within` columns to reduced echelon form in place, by operations on whole rows: rows with a pivot
 * first; pivot[i] is the column of the leading 1 of row i.  Returns how many there are; `pivot` has room for the least
 * of both sizes. */
size_t nh_residue_matrix_echelon(nh_prime field, size_t rows, size_t columns, size_t within, nh_residue *a,
                                 size_t *pivot);

/* Only the pivots, for two thirds of the work: the first columns that are linearly independent.  Returns how many there
 * are; the matrix is destroyed. */
size_t nh_residue_matrix_pivots(nh_prime field, size_t rows, size_t columns, nh_residue *a, size_t *pivot);

/* The rank; the matrix is destroyed. */
size_t nh_residue_matrix_rank(nh_prime field, size_t rows, size_t columns, nh_residue *a);

#endif
