/* sample_grid: the kinds of sample grids, and the nodes of those that are products of nodes in one variable.
 *
 * Tensor: the zeros of Chebyshev's polynomial T_k, cos((2 i + 1) pi/(2 k)), in each of d variables: k^d points.
 * Sparse [Smolyak1963], [NovakRitter1996]: the extrema of Chebyshev's polynomials are nested, 1, 3, 5, 9, 17, .. of
 * them; level i adds s_0 = 1, s_1 = 2, s_i = 2^(i-1) nodes, and the grid of level l is the union of the products of
 * what the levels i_1 + .. + i_d <= l add: sum of s_(i_1) .. s_(i_d) points. */
#ifndef NH_SAMPLE_GRID_H
#define NH_SAMPLE_GRID_H

#include "base/error.h"
#include "base/memory.h"

typedef enum {
    NH_GRID_SOBOL,
    NH_GRID_HALTON,
    NH_GRID_TENSOR,
    NH_GRID_SPARSE,
    NH_GRID_MOTION,
    NH_GRID_FILE
} nh_grid_kind;

enum { NH_GRID_MOST_TENSOR = 4 }; /* variables of a tensor grid */

/* "sobol", .., "file". */
const char *nh_sample_grid_word(nh_grid_kind kind);
/* The kind that a word names; one that ends in .csv is a file of points.  False with a suggestion. */
bool nh_sample_grid_kind(const char *word, nh_grid_kind *kind, nh_error *error);

/* The number of points of a tensor grid (`level` nodes in each variable, from 1) or a sparse one (level from 0);
 * SIZE_MAX where it exceeds what memory holds. */
size_t nh_sample_grid_count(nh_grid_kind kind, size_t dimension, size_t level);
/* Its points in [-1, 1]^dimension, one after another; the caller frees them. */
double *nh_sample_grid_nodes(nh_grid_kind kind, size_t dimension, size_t level);

#endif
