/* diff: exact derivatives, memoised over the whole graph.
 *
 * A symbol may be implicit: a velocity u that a constraint f(z, u) = 0 determines.  Its rules du/dz are expressions
 * in z and u; derivatives follow them by the chain rule, so that everything built on top stays exact. */
#ifndef NH_DIFF_H
#define NH_DIFF_H

#include "graph/expr.h"

/* d e / d x for a symbol x. */
nh_ex nh_diff(nh_dag *dag, nh_ex e, nh_ex x);

/* Defines d u / d x = value for the symbols u and x.  Must precede any derivative of an expression in u. */
void nh_diff_rule(nh_dag *dag, nh_ex u, nh_ex x, nh_ex value);

/* All derivatives d e / d symbol[i] at once, by accumulation from e downwards: together they are only a few times as
 * large as e, where n calls of nh_diff may give n times as much.  For symbols without rules. */
void nh_gradient(nh_dag *dag, nh_ex e, size_t n, const nh_ex *symbol, nh_ex *out);

/* sum_i component[i] d e / d symbol[i]: the derivative of e along a field. */
nh_ex nh_diff_along(nh_dag *dag, nh_ex e, size_t n, const nh_ex *symbol, const nh_ex *component);

#endif
