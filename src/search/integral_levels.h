/* integral_levels: the system on the levels of its linear integrals.
 *
 * A motion on which P(q, q') is constant stays on the level P = c by itself.  So the system with the further constraint
 * P = c has the same motions there: the multiplier vanishes.  With c as a parameter this is an affine constraint, and
 * what depends on P in the equations of motion becomes constant: a blade that turns at a constant rate has linear
 * equations with constant coefficients in its own frame.  What is constant on all levels, for all c, is a current of
 * the system with P for c.  [docs/method.md, sec. 4] */
#ifndef NH_INTEGRAL_LEVELS_H
#define NH_INTEGRAL_LEVELS_H

#include "search/stage_solver.h"

/* Looks for linear motions on the levels of the linear integrals that are found and proved for all parameters. */
void nh_integral_levels_search(nh_stage_solver *solver);

#endif
