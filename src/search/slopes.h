/* slopes: two velocities whose accelerations depend on these two only, by their quotient. */
#ifndef NH_SLOPES_H
#define NH_SLOPES_H

#include "search/stage_solver.h"

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
