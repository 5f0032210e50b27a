/* compression: where a matrix with two parameters loses rank, as common zeros of determinants.
 *
 * For a matrix A(lambda, mu) of generic rank R and random constant L (R x rows) and C (columns x R), det(L A C)
 * vanishes wherever the rank of A is below R; elsewhere two of them have no common zero, except at points that depend
 * on the random choices and differ from one choice to the next. */
#ifndef NH_COMPRESSION_H
#define NH_COMPRESSION_H

#include "classify/staircase.h"

/* The generic rank R of the matrices, at random residues. */
size_t nh_compression_rank(const nh_staircase_matrices *matrices, nh_prime field);

/* The determinant of one compression; each seed chooses another one.  False: the deadline is over. */
bool nh_compression_determinant(const nh_staircase_matrices *matrices, nh_prime field, size_t rank, uint64_t seed,
                                nh_residue_polynomial *out);

#endif
