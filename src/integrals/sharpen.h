/* sharpen: numbers inside of the terms of a current (an unknown frequency in cos(nu t)) with many digits.
 *
 * The pencil and the search give them as doubles, which bounds the digits of every certificate.  With theta the numbers
 * and c the coefficients,
 *
 *     sum_j c_j Gamma(b_j) + sum_i dtheta_i sum_j c_j d/dtheta_i Gamma(b_j) = 0
 *
 * is linear in the new c and in dtheta: a step of Newton's method by least squares at exact points [ball_fit.h].  The
 * old c in the second sum are doubles, so that a step gains as many digits as a double has. */
#ifndef NH_SHARPEN_H
#define NH_SHARPEN_H

#include "base/option.h"
#include "geometry/model.h"

/* Replaces inexact numbers in term[0..n-1] by long rationals; pivot: a term whose coefficient is not zero.  False, and
 * nothing is changed, where there are none, too many, or the steps do not become smaller. */
bool nh_sharpen(const nh_model *model, size_t n, nh_ex *term, const double *coefficient, size_t pivot,
                const nh_options *options);

#endif
