/* refine: currents among given terms, with hundreds of bits.
 *
 *     Gamma(sum_j c_j b_j) = 0   by least squares at exact points in ball arithmetic   [ball_fit.h]
 *
 * A true current cancels at points that the fit has not seen to as many digits as there are; a combination that is only nearly conserved
 * cancels to the 13 that made it look true in doubles. */
#ifndef NH_REFINE_H
#define NH_REFINE_H

#include "base/option.h"
#include "geometry/model.h"

typedef struct {
    size_t count;        /* true currents, or 1 and the one that is nearest to it; 0: nothing could be decided */
    double *coefficient; /* n x count, rounded; each has one leading coefficient that is not zero where the others' are */
    double *digits;      /* per vector: to which its rate cancels at held-out points */
} nh_refined;

/* leading[j]: the terms whose coefficients fix a vector (the pivots of an echelon form).  `rows`: equations per unknown, 1 where the
 * combination is thought exact, more where it is a truncated series. */
nh_refined nh_refine(const nh_model *model, size_t n, const nh_ex *term, const bool *leading, double rows, const nh_options *options);
/* The same for the terms word[i] T_k(s), k = 0..degree, at index i (degree + 1) + k. */
nh_refined nh_refine_series(const nh_model *model, size_t words, const nh_ex *word, nh_ex s, size_t degree, const bool *leading, double rows,
                            const nh_options *options);
void nh_refined_clear(nh_refined *refined);

#endif
