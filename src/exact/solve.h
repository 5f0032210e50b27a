/* solve: linear systems whose entries are expressions, by LU factorization in the graph.
 *
 * Only n^3/3 nodes are made, whatever the entries are.  Rows are exchanged by the caller's score of a pivot: for
 * instance its least absolute value over sample points. */
#ifndef NH_SOLVE_H
#define NH_SOLVE_H

#include "graph/expr.h"

/* The score of a pivot: how safe it is to divide by e; 0: e vanishes (somewhere, or identically). */
typedef double nh_pivot_score(void *context, nh_ex e);

typedef struct nh_lu nh_lu;

/* Factors the n x n matrix a (row-major: a[i*n + j]).  NULL when some column has no usable pivot; *rank (may be NULL)
 * is the number of columns that have one.  The caller frees the factors. */
nh_lu *nh_lu_create(nh_dag *dag, size_t n, const nh_ex *a, nh_pivot_score *score, void *context, size_t *rank);
/* The same factors, of which `copy` is a copy of the graph (nh_dag_copy). */
nh_lu *nh_lu_copy(const nh_lu *lu, nh_dag *copy);
void nh_lu_free(nh_lu *lu);

/* x := a^-1 b (x may be b). */
void nh_lu_solve(const nh_lu *lu, const nh_ex *b, nh_ex *x);

/* det a by cofactors of the first row, without denominators: n! nodes, for at most four rows. */
nh_ex nh_solve_determinant(nh_dag *dag, size_t n, const nh_ex *a);

#endif
