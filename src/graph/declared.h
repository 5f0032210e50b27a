/* declared: functions of one argument that a file declares, as a potential V(r) or a field f(t).
 *
 * A function with a value is replaced by it wherever it is called.  One without is unspecified: the node NH_UNSPECIFIED
 * with the arguments f (its number), n (the order of the derivative) and x, whose derivative with respect to x is the
 * node with n + 1.  No relation between these holds for every function, so that a statement is true for all of them iff
 * it holds with V(x), V'(x), V''(x), .. as independent numbers for each value of x: so proofs draw power series
 * (exact/jet_point.h).  Samples and motions need some function: a stand-in (evaluate/named_value.c). */
#ifndef NH_DECLARED_H
#define NH_DECLARED_H

#include "graph/expr.h"

enum { NH_DECLARED_PRIMES = 8 }; /* the highest derivative that can be written */

/* Declares a function; its number counts from 0.  The name is copied. */
size_t nh_declared_add(nh_dag *dag, const char *name);
/* Gives it a value, an expression of the symbol `variable`, before it is called: `value` has NH_DECLARED_PRIMES + 1
   derivatives from the order 0 on. */
void nh_declared_give(nh_dag *dag, size_t f, nh_ex variable, const nh_ex *value);
/* The number of the function of this name; false: there is none. */
bool nh_declared_find(const nh_dag *dag, const char *name, size_t *f);
/* Its n-th derivative at x; of one with a value up to the order NH_DECLARED_PRIMES. */
nh_ex nh_declared_call(nh_dag *dag, size_t f, size_t n, nh_ex x);
/* How an unspecified call is written before its argument: "V", "V'", "V''"; returns the order of the derivative. */
size_t nh_declared_name(const nh_dag *dag, nh_ex call, const char **name);
/* Declares the functions of another graph, without their values. */
void nh_declared_names(nh_dag *dag, const nh_dag *from);
/* The name of a function without a value, or NULL. */
const char *nh_declared_unspecified(const nh_dag *dag);

#endif
