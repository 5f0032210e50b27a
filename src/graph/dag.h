/* dag: graphs of expressions (expr.h), and the expressions that are made in them. */
#ifndef NH_DAG_H
#define NH_DAG_H

#include "graph/expr.h"

/* A graph with the numbers 0 and 1; nh_dag_free frees it with all its nodes. */
nh_dag *nh_dag_create(void);
/* A graph with the same expressions under the same numbers, in which other ones can be made without a change of `dag`:
 * so threads derive further expressions at the same time, each in a copy.  `dag` has to outlive it; the caller frees
 * it. */
nh_dag *nh_dag_copy(const nh_dag *dag);
/* Replaces n expressions of a copy of `dag` by the same ones in `dag`.  Symbols that were made in the copy are new
 * ones. */
void nh_dag_bring(nh_dag *dag, const nh_dag *copy, size_t n, nh_ex *e);
void nh_dag_free(nh_dag *dag);
size_t nh_dag_size(const nh_dag *dag); /* number of nodes made so far; indices are below it */

/* Constructors.  Equal results have equal indices; the graph owns all nodes until nh_dag_free. */
nh_ex nh_number(nh_dag *dag, nh_num value);
nh_ex nh_int(nh_dag *dag, int64_t value);
nh_ex nh_ratio(nh_dag *dag, int64_t p, int64_t q);
nh_ex nh_real(nh_dag *dag, double value);
nh_ex nh_symbol(nh_dag *dag, const char *name); /* the symbol of that name, made when new */
/* A symbol of its own that prints as `name` but is not found by that name (implicit velocities, names of currents). */
nh_ex nh_symbol_fresh(nh_dag *dag, const char *name);
bool nh_symbol_find(const nh_dag *dag, const char *name, nh_ex *out);
nh_ex nh_add(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_sub(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_mul(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_div(nh_dag *dag, nh_ex a, nh_ex b);
nh_ex nh_neg(nh_dag *dag, nh_ex a);
nh_ex nh_pow(nh_dag *dag, nh_ex base, nh_ex exponent);
nh_ex nh_powi(nh_dag *dag, nh_ex base, int64_t exponent);
nh_ex nh_sqrt(nh_dag *dag, nh_ex a);
/* Is it tan((2 k + 1) pi/2), which has no value, but whose reciprocal is 0? */
bool nh_is_infinite_tangent(nh_dag *dag, nh_ex e);
/* Is a = rest + c pi, where sin(c pi) and cos(c pi) are numbers or half a root? */
bool nh_split_turn(nh_dag *dag, nh_ex a, nh_ex *rest, nh_ex *sine, nh_ex *cosine);
/* sum_i coefficient[i] * term[i] */
nh_ex nh_linear(nh_dag *dag, size_t n, const nh_num *coefficient, const nh_ex *term);
nh_ex nh_product(nh_dag *dag, size_t n, const nh_ex *factor);

/* e with from[i] replaced by to[i], all at once. */
nh_ex nh_substitute(nh_dag *dag, nh_ex e, size_t n, const nh_ex *from, const nh_ex *to);
/* e with by(context, call) for each function call in it, all at once; a call for which that is 0 stays. */
nh_ex nh_substitute_calls(nh_dag *dag, nh_ex e, nh_ex (*by)(void *context, nh_ex call), void *context);

/* e with every half power of `base` written in `root`: base^(p/2) becomes root^p.  For base = root^2, and root of one
   sign. */
nh_ex nh_substitute_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root);
/* The same of base^(p/(2 q)), which becomes root^(p/q), for a positive root. */
nh_ex nh_substitute_positive_root(nh_dag *dag, nh_ex e, nh_ex base, nh_ex root);

#endif
