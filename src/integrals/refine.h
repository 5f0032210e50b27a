/* refine: currents among given terms, with hundreds of bits.
 *
 *     Gamma(sum_j c_j b_j) = 0   by least squares at exact points in ball arithmetic   [ball_fit.h]
 *
 * A true current cancels at points that the fit has not seen to as many digits as there are; a combination that is only
 * nearly conserved cancels to the 13 that made it look true in doubles. */
#ifndef NH_REFINE_H
#define NH_REFINE_H

#include "base/option.h"
#include "geometry/model.h"

typedef struct {
    size_t count; /* true currents, or 1 and the one that is nearest to it; 0: nothing could be decided */
    /* n x count, rounded; each has one leading coefficient that is not zero where the others' are */
    double *coefficient;
    double *digits; /* per vector: digits to which its rate cancels at held-out points */
} nh_refined;

/* leading[j]: the terms whose coefficients fix a vector (the pivots of an echelon form). */
nh_refined nh_refine(const nh_model *model, size_t n, const nh_ex *term, const bool *leading,
                     const nh_options *options);
void nh_refined_clear(nh_refined *refined);

/* Numbers inside of terms (an unknown frequency in cos(nu t)), which the pencil and the search give as doubles, with
 * many digits.  With theta the numbers and c the coefficients,
 *
 *     sum_j c_j Gamma(b_j) + sum_i dtheta_i sum_j c_j d/dtheta_i Gamma(b_j) = 0
 *
 * is linear in the new c and in dtheta: a step of Newton's method by least squares.  The old c in the second sum are
 * doubles, so that a step gains as many digits as a double has.
 *
 * Replaces inexact numbers in term[0..n-1] by long rationals; pivot: a term whose coefficient is not zero.  False, and
 * nothing is changed, where there are none, too many, or the steps do not become smaller. */
bool nh_refine_numbers(const nh_model *model, size_t n, nh_ex *term, const double *coefficient, size_t pivot,
                       const nh_options *options);

#endif
