/* terms: what an expression is the sum of, for the size that it would have if nothing in it cancelled. */
#ifndef NH_TERMS_H
#define NH_TERMS_H

#include "graph/dag.h"

/* The expression itself, then its terms: those of a sum, also under a common factor.  Their number; the caller frees
   *out. */
size_t nh_terms_of(nh_dag *dag, nh_ex e, nh_ex **out);

/* The sum of the moduli of the terms of a sum (not below a common factor): e is small when it is small relative to
   this. */
nh_ex nh_terms_moduli(nh_dag *dag, nh_ex e);

/* The same within sums below factors and in whole powers of sums, too: the size of what cancels in e, wherever it
   stands. */
nh_ex nh_terms_uncancelled(nh_dag *dag, nh_ex e);

/* Whole powers that all terms of a sum have in common: sin^2 of sin^2 + 3 sin^4; 1 where there are none. */
nh_ex nh_terms_common(nh_dag *dag, nh_ex sum);

#endif
