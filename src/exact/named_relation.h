/* named_relation: the relations between named functions of one argument whose
 * orders differ by whole numbers, and between two solutions of one equation:
 *
 *     J_(n+1) = (n/x) J_n - J_n',      J_n Y_n' - J_n' Y_n = 2/(pi x)
 *
 * With these every function of such a family is a combination of one of them
 * and its derivative, whose orders lie in (0, 1], or in (n - 1, n] with a
 * symbol n.  The incomplete beta function, 2F1(a, b; a + 1; x), has an equation
 * of first order [DLMF 8.17.7, 15.5.3]:
 *
 *     x f' = a ((1 - x)^(-b) - f) */
#ifndef NH_NAMED_RELATION_H
#define NH_NAMED_RELATION_H

#include "graph/expr.h"

/* One step: expresses e, a call with canonical arguments, by functions whose orders are nearer to that interval, or by
 * the first of two solutions.  False: there is no step. */
bool nh_named_relation_step(nh_dag *dag, nh_ex e, nh_ex *out);

/* f' = *constant + *factor f by the argument *place, for incomplete beta functions and incomplete elliptic integrals.
 * False: f is no such function. */
bool nh_named_relation_first_order(nh_dag *dag, nh_ex f, size_t *place, nh_ex *constant, nh_ex *factor);

#endif
