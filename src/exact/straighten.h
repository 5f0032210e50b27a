/* straighten: a linear change of variables that turns sums of symbols into symbols.
 *
 *     sin(x - y)^-2 + sin(y - z)^-2 + sin(x - z)^-2   becomes   sin(x)^-2 + sin(y)^-2 + sin(x + y)^-2
 *
 * Forces among bodies depend on differences of coordinates; when these are split into single coordinates, their sines
 * and denominators become long polynomials.  An invertible linear change of variables preserves identities, and linear
 * relations with constant coefficients. */
#ifndef NH_STRAIGHTEN_H
#define NH_STRAIGHTEN_H

#include "graph/expr.h"

/* Rewrites the n expressions in place, where at least three sums of symbols are arguments of sines, cosines or
 * exponentials, or stand in denominators; `constants` are not replaced.  False: nothing is changed. */
bool nh_straighten(nh_dag *dag, size_t n, nh_ex *e, size_t constants, const nh_ex *constant);

#endif
