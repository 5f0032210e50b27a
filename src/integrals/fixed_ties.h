/* fixed_ties: relations among the parameters that their given values satisfy.
 *
 *     p_j = p_i,    p_j = r p_i,    p_i = r prod_j p_j^(e_j)
 *
 * What holds at given values of several parameters often holds wherever these are related so: two oscillators have a
 * further integral for k = m w^2, not only at k = 18, m = 2, w = 3.  Relations are only proposed here, simple ones
 * first; a proof with p_i replaced decides. */
#ifndef NH_FIXED_TIES_H
#define NH_FIXED_TIES_H

#include "geometry/model.h"

enum { NH_MOST_TIES = 24 };

/* Each result is a list of what the parameters are replaced by (as nh_fixed, integrals/fixed.h), in the model's arena;
 * those of the n `fixed` ones that occur in no relation have their values.  Returns how many there are. */
size_t nh_fixed_ties(const nh_model *model, size_t n, const size_t *fixed, const nh_ex *out[NH_MOST_TIES]);

#endif
