/* constants: the structure constants of an action as expressions of the parameters.
 *
 *     [e_a, e_b] + C_ab^k e_k = 0,     C in Q(parameters)
 *
 * They are known in doubles, at the parameters' values.  Where the fields have parameters the numbers are kept only if
 * the relation holds with the parameters as symbols; else it is solved with these. */
#ifndef NH_CONSTANTS_H
#define NH_CONSTANTS_H

#include "reduction/invariance.h"

/* constant: d x d x d, from the numbers c; bracket: d x d x m components of [e_a, e_b]. */
void nh_constants_find(const nh_kinetic *kinetic, size_t d, const nh_generator *generator, const double *c,
                       const nh_ex *bracket, const nh_options *options, nh_ex *constant);

#endif
