/* measure: the printed length of an expression, its depth, the kinds of its numbers, and an order of expressions. */
#ifndef NH_MEASURE_H
#define NH_MEASURE_H

#include "graph/expr.h"

/* The printed length of e: about the number of symbols, numbers and operators. */
size_t nh_complexity(const nh_dag *dag, nh_ex e);

/* Is that at most `most`?  Stops as soon as e is known to be longer. */
bool nh_complexity_within(const nh_dag *dag, nh_ex e, size_t most);

/* An order of expressions that depends on their content and on the order of declaration of their symbols, not on which
 * was made first: negative where a comes before b, 0 for equal ones.  Short ones come first, then those with earlier
 * symbols; long ones are not compared further. */
int nh_complexity_order(const nh_dag *dag, nh_ex a, nh_ex b);

/* The largest number of functions, and powers of sums, inside of each other; definitions count as if they were written
 * out. */
size_t nh_nesting(const nh_dag *dag, nh_ex e);

/* nh_is_exact: is every number in e a rational? nh_is_short: is every number a rational of 64 bits, which can be
 * printed as such?  An expression with longer numbers than its source is no simpler form of it. */
bool nh_is_exact(const nh_dag *dag, nh_ex e);
bool nh_is_short(const nh_dag *dag, nh_ex e);

/* Is e made of sums and products of whole powers of these symbols, and of functions that are analytic everywhere? */
bool nh_is_entire(const nh_dag *dag, nh_ex e, size_t symbols, const nh_ex *symbol);

#endif
