/* missing: construction of integrals that the count predicts beyond the currents found.
 *
 * The integrals polynomial in the velocities are counted (count/count.h); where more of them may exist than are
 * proved, their power series say of which terms they consist (count/construct.h), and a stage with these terms
 * alone looks for them as any other: coefficients over the parameters, proof, field. Currents that are certified only
 * give way to proved ones. */
#ifndef NH_MISSING_H
#define NH_MISSING_H

#include "search/stage_solver.h"

/* Counts the integrals, and constructs those that are missing.  result->search must not be known before. */
void nh_missing_find(nh_stage_solver *solver);

/* An antiderivative along a coordinate times integrals that the construction found as functions of the currents: what
 * would be a series has a name then.  Has it found something? */
bool nh_missing_primitives(nh_stage_solver *solver);

/* Names the further integrals, after the currents have their names, and finds the polynomial relations among all. */
void nh_missing_name_further(nh_analysis *result);

/* Fills result->completeness.  Without a search no degrees are counted beyond the first one that misses some, unless
 * the user asks for one. */
void nh_missing_count(nh_analysis *result, bool searched);

#endif
