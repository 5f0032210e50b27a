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

#include "graph/dag.h"
#include "graph/measure.h"

typedef enum { NH_ZERO, NH_NONZERO, NH_TOO_LARGE } nh_zero_verdict;

/* Is e identically zero?  `max_terms` bounds the size of intermediate polynomials (0: the default of 20000). */
nh_zero_verdict nh_normal_is_zero(nh_dag *dag, nh_ex e, size_t max_terms);

/* An equal expression that is the simplest found: the reduced quotient, with sin^2 or cos^2 eliminated, numerator
 * and denominator factored where that is shorter; e itself when nothing is simpler or the size bound is met.
 * Never larger, by nh_complexity, than e. */
nh_ex nh_simplify(nh_dag *dag, nh_ex e);

/* How long an entry of n equations may be to be simplified: entries of many equations are many, and zeros among them
   are short.  0: as nh_simplify_short has it. */
size_t nh_simplify_longest(size_t n);
/* The same, but e itself when it is longer than `most` (nh_complexity): what is large is often small as a shared graph,
 * like the equations of a chain of bodies, and what comes out of the normal form shares nothing.  0: the limit for the
 * equations of a system. */
nh_ex nh_simplify_short(nh_dag *dag, nh_ex e, size_t most);

/* A polynomial in kernels with the zeros of e and no poles: the numerator of its normal form (tan(x) - y gives
 * sin(x) - y*cos(x)); e itself when the size bound is met. */
nh_ex nh_numerator(nh_dag *dag, nh_ex e);

/* The reduced quotient written out as a sum: the same for all expressions that are equal by what kernels are known to
 * satisfy, however they were written; e itself when the size bound is met. */
nh_ex nh_canonical_sum(nh_dag *dag, nh_ex e);

/* The sign of its leading coefficient, which distinguishes e from -e; 1 when the size bound is met. */
int nh_canonical_sign(nh_dag *dag, nh_ex e);

/* An equal expression with canonical arguments of functions, radicands and exponents, so that equal ones are the same
   node. */
nh_ex nh_canonical(nh_dag *dag, nh_ex e, size_t max_terms);

/* From now on normal forms reduce by symbol^order = value.  The value is a quotient of polynomials in symbols, sines
 * and the like, and in lower powers of the symbol itself; its other symbols satisfy nothing, or something that was said
 * before.  A zero normal form is then a proof wherever this relation holds: on all branches of a constraint that is a
 * polynomial in the symbol.  Say it before the symbol is used. */
void nh_relate(nh_dag *dag, nh_ex symbol, unsigned order, nh_ex value);

/* Give back what FLINT and Arb keep for their next use; call it last. */
void nh_normal_cleanup(void);

#endif
