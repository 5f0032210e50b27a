/* missing: construction of integrals that the count predicts beyond the currents found.
 *
 * The integrals polynomial in the velocities are counted (count/count.h); where more of them may exist than are
 * proved, their power series say of which terms they consist (count/construct.h), and a stage with these terms
 * alone looks for them as any other: coefficients over the parameters, proof, field. Currents that are certified only
 * give way to proved ones. */
#ifndef NH_MISSING_H
#define NH_MISSING_H

#include "search/currents.h"

/* Fill result->completeness; with `construct`, look for what is missing, and count again.  Without it no degrees are
 * counted beyond the first one that misses some, unless the user asks for one. */
void nh_missing_count(nh_analysis *result, bool construct);

#endif
