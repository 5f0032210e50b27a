/* coefficients: from fitted numbers to exact ones, or to as many digits as a decision needs.
 *
 * First a fit in ball arithmetic, which distinguishes a true current from one that is only nearly conserved; then
 * exact relations of the terms' rates over the field of the parameters; over the rationals at the parameters' values;
 * simple numbers.  [docs/method.md, sec. 4, "Refinement" and "Exact coefficients"] */
#ifndef NH_COEFFICIENTS_H
#define NH_COEFFICIENTS_H

#include "search/analysis.h"

/* The current as an expression.  Sets found->exact where its coefficients are exact, ->refined to the digits to which
 * they cancel, and the claim to what is known of it. */
nh_ex nh_coefficients_assemble(const nh_model *model, nh_candidate *candidate, const nh_options *options,
                               nh_current *found, nh_claim *claim);

/* Call after the proof: where that was undecided, the refined digits are the certificate. */
void nh_coefficients_certify(const nh_options *options, nh_current *found);

/* Proved, or certified to the required digits. */
bool nh_coefficients_certain(const nh_current *found, const nh_options *options);

/* Is it refuted: the refined combination does not cancel, and all numbers in it are exact? */
bool nh_coefficients_refuted(const nh_current *found, const nh_options *options);

#endif
