/* relation_unknown: numbers for which expressions are linearly related, as expressions of the parameters.
 *
 *     sum_j c_j e_j = 0    identically,   e_j with unknown constants x_1 .. x_k,   c_j in Q(parameters, x)
 *
 * For any values of the unknowns there is no such relation; at values of which doubles are known there is one.  Every
 * monomial in what is no constant gives a row a_i(p, x) of a linear system for the c_j.  n - 1 rows that are
 * independent at the point give c(p, x); what the other rows leave, R_i(p, x) = sum_j a_ij c_j, vanishes there, and the
 * x are the common zeros of the R_i (common_zero.h). */
#ifndef NH_RELATION_UNKNOWN_H
#define NH_RELATION_UNKNOWN_H

#include "graph/expr.h"

enum { NH_MOST_UNKNOWN = 3 };

typedef struct {
    nh_dag *dag;
    size_t parameters;
    const nh_ex *parameter;
    const double *parameter_value;
    size_t unknowns; /* 1 to NH_MOST_UNKNOWN */
    const nh_ex *unknown;
    const double *value;
    size_t max_terms;
} nh_unknown_numbers;

/* x[k]: the unknowns, a proposal which the relation itself must confirm.  c: the relation at the point, without zeros.
 */
bool nh_relation_unknown(const nh_unknown_numbers *numbers, size_t n, const nh_ex *e, const double *c, nh_ex *x);

#endif
