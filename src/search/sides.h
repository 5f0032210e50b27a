/* sides: equations with |u| and sign(u), on the sides of u = 0. */
#ifndef NH_SIDES_H
#define NH_SIDES_H

#include "search/other_system.h"
#include "search/stage_solver.h"

/* Searches the system in which sign(u) is a parameter s, and |u| is s u: it has no kinks.  What is constant there for
 * all s is constant on each side of u = 0 with s = sign(u), and becomes a current of the solver's analysis where it can
 * be certified. */
void nh_sides_search(nh_stage_solver *solver, nh_whole_search *search);

#endif
