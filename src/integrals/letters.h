/* letters: numbers inside of terms as expressions of the parameters.
 *
 *     Phi = sum_j c_j b_j(x),   b_j: exp(x t) v, cos(x q) v, Q^x v, ..
 *
 * Rates, frequencies and exponents are found as numbers.  With a symbol for each number there is a relation of the
 * Gamma(b_j) over the field of the parameters only where the symbols satisfy polynomial equations; these are solved
 * (relation_unknown.h), and what comes out is believed when the relation holds with it. */
#ifndef NH_LETTERS_H
#define NH_LETTERS_H

#include "graph/symbolise_decimals.h"
#include "integrals/fixed.h"

/* Positive numbers, and the names for them. */
typedef struct {
    size_t count;
    double value[NH_MOST_LIFTED];
    nh_ex name[NH_MOST_LIFTED];
} nh_letters;

/* The relation among Gamma(term), `coefficient` at the parameters' values, with the numbers in the terms named; on
 * success they stand in term[], and the relation's coefficients in out[]. */
nh_fixed nh_letters_relation(const nh_model *model, size_t n, nh_ex *term, const double *coefficient,
                             const nh_options *options, nh_ex *out, nh_letters *letters);

#endif
