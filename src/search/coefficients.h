/* coefficients: from fitted numbers to exact ones, or to as many digits as decide.
 *
 * First a fit in ball arithmetic, which tells a true current from one that is only nearly conserved; then exact
 * relations of the terms' rates over the field of the parameters; over the rationals at the parameters' values; simple
 * numbers.   [docs/method.md, sec. 6] */
#ifndef NH_COEFFICIENTS_H
#define NH_COEFFICIENTS_H

#include "search/analysis.h"

/* The current as an expression; found->exact says whether its coefficients are, ->refined how far they cancel, the
   claim what is known of it. */
nh_ex nh_coefficients_assemble(const nh_model *model, nh_candidate *candidate, const nh_options *options,
                               nh_current *found, nh_claim *claim);

/* After the proof: where that left the question open the refined digits are the certificate. */
void nh_coefficients_certify(const nh_options *options, nh_current *found);

/* Proved, or certified to the required digits. */
bool nh_coefficients_certain(const nh_current *found, const nh_options *options);

/* Decided the other way: the refined combination does not cancel, and nothing in it is inexact. */
bool nh_coefficients_refuted(const nh_current *found, const nh_options *options);

#endif
