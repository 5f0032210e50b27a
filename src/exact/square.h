/* square: square factors below roots. */
#ifndef NH_SQUARE_H
#define NH_SQUARE_H

#include "graph/expr.h"

/* Splits e = outside^2 * inside, where `inside` is a polynomial without square factors, as far as its written factors
 * show.  False: e has roots as factors, or a number that is not a rational of 64 bits. */
bool nh_square_split(nh_dag *dag, nh_ex e, nh_ex *outside, nh_ex *inside);

/* The same of e = N/D, which may be written as a sum, y^2/x^2 + 1: `inside` is that of N D. */
bool nh_square_split_quotient(nh_dag *dag, nh_ex e, nh_ex *outside, nh_ex *inside);

/* e with sqrt(u^2 v w) as u sqrt(v) sqrt(w), wherever the signs of the factors are known: `sign` gives 1, -1, or 0
 * where it changes.  Radicands longer than `most_length` stay. */
nh_ex nh_square_roots(nh_dag *dag, nh_ex e, size_t most_length, int (*sign)(void *context, nh_ex e), void *context);

#endif
