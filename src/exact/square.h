/* square: square factors below roots. */
#ifndef NH_SQUARE_H
#define NH_SQUARE_H

#include "graph/dag.h"

/* e = outside^2 * inside, the inside a polynomial without square factors, as far as the factors that e is written in
   show.  False: it has roots already. */
bool nh_square_split(nh_dag *dag, nh_ex e, nh_ex *outside, nh_ex *inside);

/* e with sqrt(u^2 v w) as u sqrt(v) sqrt(w), wherever the signs of the factors are known: `sign` gives 1, -1, or 0
 * where it changes.  Radicands longer than `most_length` stay. */
nh_ex nh_square_roots(nh_dag *dag, nh_ex e, size_t most_length, int (*sign)(void *context, nh_ex e), void *context);

#endif
