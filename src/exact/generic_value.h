/* generic_value: does an expression vanish identically?  For expressions that are too long for a normal form.
 *
 * It is evaluated at a point modulo a prime (jet_point.h), with all symbols at random residues.  If the value is not
 * zero, the expression is not zero for almost all values of its symbols, parameters among them.  This is a proof,
 * because it is checked that functions satisfy no other relations than those that the point satisfies.  Roots of
 * squares, which have one sign here and another there, are taken with both: what is said holds for all of them. */
#ifndef NH_GENERIC_VALUE_H
#define NH_GENERIC_VALUE_H

#include "exact/jet_ring.h"
#include "graph/expr.h"

/* Is one of n expressions not identically zero in these variables and all other symbols?  False: not known. */
bool nh_generic_nonzero(nh_dag *dag, size_t n, const nh_ex *e, size_t variables, const nh_ex *variable);

/* The rank of a matrix of expressions (row by row) at random residues of all symbols, modulo two primes: a lower bound
 * of the rank at almost all values, which almost all residues reach.  False: not known, some entry has no residues. */
bool nh_generic_rank(nh_dag *dag, size_t rows, size_t columns, const nh_ex *e, size_t *rank);

/* The n expressions as series to order 2 in these variables at a random point modulo each of two primes: what vanishes
 * at both does so identically but for an unlikely accident, what does not is proved.  `read` takes them, one series
 * after another, which it may change; it returns false where the point is not regular, so that another one is tried.
 * False: not known. */
typedef bool nh_generic_read(const nh_jet_ring *ring, nh_residue *series, void *context);
bool nh_generic_series(nh_dag *dag, size_t n, const nh_ex *e, size_t variables, const nh_ex *variable,
                       nh_generic_read *read, void *context);

#endif
