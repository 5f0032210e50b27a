/* subspace: spans, null spaces and complements of small dense matrices, with absolute thresholds.
 *
 * Matrices are column-major.  A threshold is absolute because the callers scale their rows to size one: divided by the
 * largest singular value, a matrix that is all rounding would seem to have full rank. */
#ifndef NH_SUBSPACE_H
#define NH_SUBSPACE_H

#include <stdbool.h>
#include <stddef.h>

/* Orthonormal basis of the span of the columns of a (m x n, left alone) into out (m x min(m, n)); returns its
 * dimension.  Singular values up to `small` count as zero. */
size_t nh_span(size_t m, size_t n, const double *a, double small, double *out);

/* Orthonormal basis of { x: a x = 0 } into out (n x n); returns its dimension.  *last_null and *first_other (may be
 * NULL) get the singular values on both sides of the cut (0 and infinity where there is none). */
size_t nh_kernel(size_t m, size_t n, const double *a, double small, double *out, double *last_null,
                 double *first_other);

/* The same of the given dimension: that of the smallest singular values. */
size_t nh_kernel_of_dimension(size_t m, size_t n, const double *a, size_t dimension, double *out, double *last_null,
                              double *first_other);

/* All n singular values of a (m x n), descending; missing ones (m < n) are 0. */
void nh_singular_values(size_t m, size_t n, const double *a, double *s);

/* The vectors of a (m x n) with their part in the span of the orthonormal columns u (m x r) taken away. */
void nh_project_off(size_t m, size_t n, double *a, size_t r, const double *u);

/* x (r x n) with u x = a in the least-squares sense for any independent columns u (m x r); returns the largest |u x -
   a|. */
double nh_coordinates(size_t m, size_t r, const double *u, size_t n, const double *a, double *x);

/* c (m x n) = a b, a is m x k; and the largest modulus of n numbers. */
double nh_largest(size_t n, const double *a);

/* n independent columns of length d in reduced echelon form (first entries as pivots); what is within `small` of a
   whole number becomes that. */
void nh_column_echelon(size_t d, size_t n, double small, double *c);

/* det of the chosen columns (`rows` of them) of a (rows x columns, row-major) over sqrt(det(a a^T)), which is the root
 * of the sum of the squares of all such minors: 0 singular, 1 the only one that is not. */
double nh_relative_minor(size_t rows, size_t columns, const double *a, const size_t *chosen);

/* exp(a) of an n x n matrix, by scaling and squaring of the Taylor series. */
void nh_matrix_exp(size_t n, const double *a, double *out);

#endif
