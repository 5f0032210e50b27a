/* measure: how long an expression looks, how deep it is, which numbers it holds, which of two comes first. */
#ifndef NH_MEASURE_H
#define NH_MEASURE_H

#include "graph/dag.h"

/* How long e looks on paper: about the number of symbols, numbers and operators when it is printed. */
size_t nh_complexity(const nh_dag *dag, nh_ex e);

/* Is that at most `most`?  Without a look at the rest of what is longer. */
bool nh_complexity_within(const nh_dag *dag, nh_ex e, size_t most);

/* An order of expressions that depends on what they are and on the order of their symbols' declaration, not on which
 * was made first: negative where a comes before b, 0 for equal ones.  Short ones come first, then those with earlier
 * symbols; of long ones no more is compared. */
int nh_complexity_order(const nh_dag *dag, nh_ex a, nh_ex b);

/* How many functions, and powers of sums, stand inside of each other at most; whatever was named by a definition
   counts. */
size_t nh_nesting(const nh_dag *dag, nh_ex e);

/* Is every number in e a rational?  Is it one of 64 bits, which can be printed as such?  Where an expression has longer
 * ones while its source has none, it is no simpler form. */
bool nh_is_exact(const nh_dag *dag, nh_ex e);
bool nh_is_short(const nh_dag *dag, nh_ex e);

#endif
