/* gradient_rank: does a current's gradient lie in the span of others' gradients?  Decided in ball arithmetic at random
 * exact points of the constraint submanifold.
 *
 * Where what is left of it excludes zero at one point, it is independent, and that is a proof for the given
 * parameters: no relation between functions is assumed.  Where it contains zero at every point, within many digits,
 * it depends on the others as far as these digits go.  Numbers in a current that were fitted (they are no rationals)
 * are wrong in their last digits, and what is left has to be larger than these. */
#ifndef NH_GRADIENT_RANK_H
#define NH_GRADIENT_RANK_H

#include "base/option.h"
#include "geometry/model.h"

typedef enum { NH_RANK_UNDECIDED, NH_RANK_GROWS, NH_RANK_STAYS } nh_rank_answer;

typedef struct {
    nh_rank_answer answer;
    bool proved;   /* the rank grows, by a ball that excludes zero, and the currents are exact */
    double digits; /* the rank stays: digits to which nothing is left, least over the points */
} nh_rank;

/* phi[0..n-1] are independent (or n is 0): is phi[n] independent of them?  `doubt`: with fitted numbers, what is
 * left below this part is nothing. */
nh_rank nh_rank_decide(const nh_model *model, size_t n, const nh_ex *phi, double doubt);

#endif
