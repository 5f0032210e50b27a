/* refine: a candidate's coefficients with hundreds of bits.
 *
 *     Gamma(sum_j c_j b_j) = 0,   c_pivot = 1,   by least squares at exact points in ball arithmetic
 *
 * A true current cancels at points that the fit has not seen to as many digits as there are; a combination that is only nearly conserved
 * cancels to the 13 that made it look true in doubles. */
#ifndef NH_REFINE_H
#define NH_REFINE_H

#include "base/option.h"
#include "geometry/model.h"

/* The digits to which the rate of the refined combination cancels, least over held-out points, at most what the fit could give; negative when
 * it could not be computed.  fixed[j]: the coefficient stays; coefficient[] gets the others, rounded.  `rows`: equations per unknown, 1 where
 * the combination is thought exact, more where it is a truncated series. */
double nh_refine(const nh_model *model, size_t n, const nh_ex *term, const bool *fixed, double *coefficient, double rows,
                 const nh_options *options);

#endif
