/* relation_express: one expression as a linear combination of others.
 *
 *     e_(n-1) = sum_j c_j e_j,   j < n - 1,   c_j in Q(parameters) */
#ifndef NH_RELATION_EXPRESS_H
#define NH_RELATION_EXPRESS_H

#include "graph/expr.h"

/* Expresses the last of n expressions by those before it, which need not be independent: the first ones possible are
 * used.  `parameter`, max_terms: as for nh_relation_find.  False where there is no such relation, or it is too
 * large. */
bool nh_relation_express(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                         size_t max_terms, nh_ex *coefficient);

#endif
