/* declared: functions that a file declares, as a potential V(r) or a field f(t).
 *
 * A function with a value is replaced by it wherever it is called.  One without is unspecified: the node
 * NH_UNSPECIFIED with the arguments f (its number), n (the order of the derivative) and x, whose derivative with
 * respect to x is the node with n + 1.  No relation between these holds for every function, so that a statement is
 * true for all of them iff it holds with V(x), V'(x), V''(x), .. as independent numbers for each value of x: so proofs
 * draw power series (exact/jet_point.h).  Samples and motions need some function: a stand-in (evaluate/named_value.c).
 *
 * A function of one variable or two that interpolates a table is the node NH_TABLE with the arguments f, n, x, y: the
 * derivative of order n % NH_SPLINE_ORDERS in x and n / NH_SPLINE_ORDERS in y (of one variable y is 0).  It has values
 * in doubles and no formula: balls and power series do not know it. */
#ifndef NH_DECLARED_H
#define NH_DECLARED_H

#include "base/spline.h"
#include "base/text.h"
#include "graph/expr.h"

enum { NH_DECLARED_PRIMES = 8 }; /* the highest derivative that can be written */

/* Declares a function; its number counts from 0.  The name is copied. */
size_t nh_declared_add(nh_dag *dag, const char *name);
/* Gives it a value, an expression of the symbol `variable`, before it is called: `value` has NH_DECLARED_PRIMES + 1
   derivatives from the order 0 on. */
void nh_declared_give(nh_dag *dag, size_t f, nh_ex variable, const nh_ex *value);
/* The number of the function of this name; false: there is none. */
bool nh_declared_find(const nh_dag *dag, const char *name, size_t *f);
/* The name of the function f; NULL: there are not so many. */
const char *nh_declared_function(const nh_dag *dag, size_t f);
/* Its n-th derivative at x; of one with a value up to the order NH_DECLARED_PRIMES. */
nh_ex nh_declared_call(nh_dag *dag, size_t f, size_t n, nh_ex x);
/* Of any call: writes how a declared function stands before its arguments, V, V', V'', of a table of two variables V,
 * V_x, V_xy, and returns where these begin among those of the node; 0 for functions of the language.  And where they
 * end. */
size_t nh_declared_put(const nh_dag *dag, nh_ex call, nh_text *out);
size_t nh_declared_arguments(const nh_dag *dag, nh_ex call);

/* Makes it the function of a table, whose variables have these names in the table; both outlive the graph. */
void nh_declared_give_table(nh_dag *dag, size_t f, const nh_spline *table, const char *const *letters);
/* The table of a function, or NULL. */
const nh_spline *nh_declared_table(const nh_dag *dag, size_t f);
/* The tables of all functions, NULL for those that have none; NULL: no function has one.  The caller frees the list. */
const nh_spline **nh_declared_tables(const nh_dag *dag);
/* The name of a function of a table, or NULL; the largest error of all (spline.h). */
const char *nh_declared_has_table(const nh_dag *dag);
double nh_declared_table_error(const nh_dag *dag);
/* A table's derivative of the order n, as above; y: 0 in one variable. */
nh_ex nh_declared_call_table(nh_dag *dag, size_t f, size_t n, nh_ex x, nh_ex y);
/* The derivative of such a node with respect to its argument i. */
nh_ex nh_declared_table_rate(nh_dag *dag, nh_ex e, size_t i);
/* Is `word` such a name, V_x or V_xy, of a function of two variables?  Then the function and n. */
bool nh_declared_find_partial(const nh_dag *dag, const char *word, size_t *f, size_t *n);

/* Declares the functions of another graph, with their tables and without their values. */
void nh_declared_names(nh_dag *dag, const nh_dag *from);
/* The name of a function without a value, or NULL. */
const char *nh_declared_unspecified(const nh_dag *dag);

#endif
