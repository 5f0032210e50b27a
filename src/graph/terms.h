/* terms: the terms of a sum, and the size that it would have if nothing in it cancelled. */
#ifndef NH_TERMS_H
#define NH_TERMS_H

#include "graph/expr.h"

/* Writes the expression itself, then its terms: those of a sum, also under a common factor.  Returns their number; the
 * caller frees *out. */
size_t nh_terms_of(nh_dag *dag, nh_ex e, nh_ex **out);

/* The sum of the absolute values of the terms of a sum (not below a common factor): e is small when it is small
 * relative to this. */
nh_ex nh_terms_moduli(nh_dag *dag, nh_ex e);

/* The same, also within sums below factors and in whole powers of sums: the size of what cancels in e, at any depth. */
nh_ex nh_terms_uncancelled(nh_dag *dag, nh_ex e);

/* The whole powers that all terms of a sum have in common: sin^2 for sin^2 + 3 sin^4; 1 where there are none. */
nh_ex nh_terms_common(nh_dag *dag, nh_ex sum);

#endif
