/* relation: exact linear relations among expressions.
 *
 *     sum_j c_j e_j = 0    identically,   c_j in Q(parameters)
 *
 * The e_j are brought to a common denominator in the normal form of normal.h; every monomial in the kernels that are
 * not parameters gives one linear equation for the c_j over the field of rational functions of the parameters, solved
 * exactly. */
#ifndef NH_RELATION_H
#define NH_RELATION_H

#include "exact/relation_solve.h"

/* `parameter`: the symbols that count as constants (may be none: then the coefficients are rational numbers). */
nh_relation_verdict nh_relation_find(nh_dag *dag, size_t n, const nh_ex *e, size_t parameters, const nh_ex *parameter,
                                     size_t max_terms, nh_ex *coefficient);

#endif
