/* normal: expressions as quotients of multivariate polynomials over algebraically related kernels.
 *
 * Kernels are the symbols and the functions sin(a), cos(a), exp(a), log(a), roots, ...; each carries its relation
 * (s^2 + c^2 - 1, r^n - a, e(a) e(-a) = 1).  Sums and integer multiples inside sin, cos, exp are expanded, tan is
 * sin/cos, so that identities among them are seen.  The polynomial arithmetic and gcd are FLINT's.
 *
 * A zero normal form is a proof that the expression vanishes identically (wherever it is defined).  A non-zero one
 * proves nothing when kernels are related in a way that is not known here: that is for ball.h. */
#ifndef NH_NORMAL_H
#define NH_NORMAL_H

#include "graph/expr.h"
#include "graph/measure.h"

/* NH_ZERO: proved, wherever e is defined.  NH_NONZERO: a value differs from 0, which is a proof; or the form is not 0,
 * or e has no form, as 1/0 has none, which are none. */
typedef enum { NH_ZERO, NH_NONZERO, NH_TOO_LARGE } nh_zero_verdict;

/* Is e identically zero?  `max_terms` bounds the size of intermediate polynomials (0: the default of 20000).  Where the
 * form is long, a rigorous value at one place that is not zero says no. */
nh_zero_verdict nh_normal_is_zero(nh_dag *dag, nh_ex e, size_t max_terms);

/* The simplest equal expression that was found: the reduced quotient, with sin^2 or cos^2 eliminated, numerator and
 * denominator factored where that is shorter; e itself when nothing is simpler or the size bound is reached.  Never
 * longer than e, by nh_complexity. */
nh_ex nh_simplify(nh_dag *dag, nh_ex e);

/* The length up to which entries of n equations are simplified: many equations have many entries, and zeros among them
 * are short. 0: the limit of nh_simplify_short. */
size_t nh_simplify_longest(size_t n);
/* The same, but e itself when it is longer than `most` (nh_complexity): a long expression is often small as a shared
 * graph, like the equations of a chain of bodies, and a normal form shares nothing. 0: the limit for the equations of a
 * system. */
nh_ex nh_simplify_short(nh_dag *dag, nh_ex e, size_t most);

/* A polynomial in kernels with the zeros of e and without poles: the numerator of its normal form (tan(x) - y gives
 * sin(x) - y*cos(x)); e itself when the size bound is reached. */
nh_ex nh_numerator(nh_dag *dag, nh_ex e);

/* The reduced quotient written out as a sum: the same for all expressions that are equal by the known relations of
 * kernels, however they were written; e itself when the size bound is reached. */
nh_ex nh_canonical_sum(nh_dag *dag, nh_ex e);

/* The sign of its leading coefficient, which distinguishes e from -e; 1 when the size bound is reached. */
int nh_canonical_sign(nh_dag *dag, nh_ex e);

/* An equal expression with canonical arguments of functions, radicands and exponents, so that equal ones are the same
   node. */
nh_ex nh_canonical(nh_dag *dag, nh_ex e, size_t max_terms);

/* Declares symbol^order = value, by which normal forms reduce from then on.  The value is a quotient of polynomials in
 * symbols, sines and the like, and in lower powers of the symbol itself; its other symbols have no relations, or
 * relations that were declared before.  A zero normal form is then a proof wherever this relation holds: on all
 * branches of a constraint that is a polynomial in the symbol.  Declare it before the symbol is used. */
void nh_relate(nh_dag *dag, nh_ex symbol, unsigned order, nh_ex value);

#endif
