/* straighten: another choice of variables, in which sums of symbols are symbols.
 *
 *     sin(x - y)^-2 + sin(y - z)^-2 + sin(x - z)^-2   becomes   sin(x)^-2 + sin(y)^-2 + sin(x + y)^-2
 *
 * Forces among bodies depend on differences of coordinates; cut into the single ones their sines and denominators are
 * long polynomials.  A linear change of variables that can be inverted keeps what vanishes identically, and linear
 * relations with constant coefficients. */
#ifndef NH_STRAIGHTEN_H
#define NH_STRAIGHTEN_H

#include "graph/dag.h"

/* The n expressions in place, where at least three sums of symbols are arguments of sines, cosines or exponentials, or
 * stand in denominators; `constants` are not replaced.  False: nothing is changed. */
bool nh_straighten(nh_dag *dag, size_t n, nh_ex *e, size_t constants, const nh_ex *constant);

#endif
