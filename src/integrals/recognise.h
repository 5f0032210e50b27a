/* recognise: exact forms of numbers.
 *
 * A ratio of small whole numbers; or, from values at several parameter sets, a product of powers of parameters with a
 * rational factor: log|c| is linear in the exponents, so that a least-squares fit finds them and further sets confirm
 * it. */
#ifndef NH_RECOGNISE_H
#define NH_RECOGNISE_H

#include "graph/expr.h"

/* value = p/q with q <= most within the relative `tolerance`?  */
bool nh_recognise_ratio(double value, int64_t most, double tolerance, nh_num *out);

/* value = r or sqrt(r) with a simple rational r; the expression, or false. */
bool nh_recognise_number(nh_dag *dag, double value, double tolerance, nh_ex *out);

/* c[s] = r prod_i p_i^(e_i) for all `sets` (each p[s*n + i] > 0 in modulus), e_i multiples of 1/2.  `symbol` are the
 * p_i. Needs sets >= n + 2.  False when no such monomial fits every set. */
bool nh_recognise_monomial(nh_dag *dag, size_t sets, size_t n, const nh_ex *symbol, const double *p, const double *c,
                           double tolerance, nh_ex *out);

#endif
