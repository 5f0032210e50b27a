/* fingerprint: a number by which equal expressions are recognised again, in another run and another graph.
 *
 * The expressions are evaluated in the field of 2^61 - 1 elements, each symbol at a place that its position chooses: what is algebraically equal,
 * however it is written (expanded or factored, in any order), has the same value, and what is not almost surely another [Schwartz1980].  A root or
 * a function of something is a place of its own, chosen by the value of that something. */
#ifndef NH_FINGERPRINT_H
#define NH_FINGERPRINT_H

#include "expr/dag.h"

/* Of n expressions in their order.  The symbols `in` count by their position alone, the symbols `fixed` by their values, others by their names. */
uint64_t nh_fingerprint(const nh_dag *dag, size_t n, const nh_ex *e, size_t n_in, const nh_ex *in, size_t n_fixed, const nh_ex *fixed, const double *value);

#endif
