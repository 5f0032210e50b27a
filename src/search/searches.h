/* searches: each looks for currents in one special way, besides the ansatz; rows of the table in staged_search.c. */
#ifndef NH_SEARCHES_H
#define NH_SEARCHES_H

#include "search/other_system.h"
#include "search/stage_solver.h"

/* Currents that the constraints alone keep constant.
 *
 * A current Phi(t, q) satisfies X_0(Phi) = 0 for all velocities, hence X_i(Phi) = 0: it belongs to the constraints,
 * whatever the Lagrangian is, and is a hidden holonomic constraint Phi = const.  How many there are is known from the
 * growth vector (geometry/distribution.h); they are looked for in an ansatz of their own, which contains no velocities,
 * and among all currents.  [docs/method.md, sec. 2] */

/* The first stages of a search, where functions are known to exist: polynomials, waves of the angles and the system's
   own functions, times positions. */
void nh_integrals_find(nh_stage_solver *solver);

/* After the search: fills result->integral, and the meaning of the currents concerned. */
void nh_integrals_of_constraints(nh_analysis *result);

/* Velocities along and across the headings of wheels and blades, for systems whose file has none.
 *
 * Constraints such as x' sin(phi) = y' cos(phi) do not depend on phi in
 *
 *     u = x' cos(phi) + y' sin(phi),   v = -x' sin(phi) + y' cos(phi)
 *
 * With such quasi-velocities equations are short that are long in x', and the first ones often depend on velocities
 * only. */

/* Integrates one equation after another in these velocities, with the currents found so far. */
void nh_frames_search(nh_stage_solver *solver);

/* The system on the levels of its linear integrals.
 *
 * A motion on which P(q, q') is constant stays on the level P = c by itself.  So the system with the further constraint
 * P = c has the same motions there: the multiplier vanishes.  With c as a parameter this is an affine constraint, and
 * what depends on P in the equations of motion becomes constant: a blade that turns at a constant rate has linear
 * equations with constant coefficients in its own frame.  What is constant on all levels, for all c, is a current of
 * the system with P for c.  [docs/method.md, sec. 4] */

/* Looks for linear motions on the levels of the linear integrals that are found and proved for all parameters. */
void nh_integral_levels_search(nh_stage_solver *solver);

/* Equations with |u| and sign(u), on the sides of u = 0. */

/* Searches the system in which sign(u) is a parameter s, and |u| is s u: it has no kinks.  What is constant there for
 * all s is constant on each side of u = 0 with s = sign(u), and becomes a current of the solver's analysis where it can
 * be certified. */
void nh_sides_search(nh_stage_solver *solver, nh_whole_search *search);

/* Two velocities whose accelerations depend on these two only, by their quotient. */

/* du/dt = F(u, v), dv/dt = G(u, v), p = v/u:
 *
 *     du/dp = R(u, p) = F u/(G - p F)
 *
 * Where R = A(p) u + B(p) u^(m+1), Bernoulli's equation, u^(-m) has a linear one:
 *
 *     mu u^(-m) + m int mu B dp,   mu = exp(m int A dp)
 *
 * is constant, and u exp(-int A dp) where B = 0. A projectile with the drag -k |v| v has such a current, its
 * hodograph. */
void nh_slopes_search(nh_stage_solver *solver);

#endif
