/* independence: which currents are functions of the others.
 *
 * The gradient of each on the submanifold, in units of the sampling box, projected off the gradients of those accepted
 * before it, at generic points: the median of the remaining fraction decides.  A gradient that is rounding against what
 * the function is summed from (below eps/doubt of it) is none: so (R - r)/sqrt((R - r)^2), constant wherever it is
 * smooth, is distinguished from a current.  Products of currents are not used: they would need degrees of their own.
 * Only points count at which every accepted function has a value: log(w) and log(-w), which are never both real, are
 * doubtful. */
#ifndef NH_INDEPENDENCE_H
#define NH_INDEPENDENCE_H

#include "integrals/points.h"

typedef enum { NH_INDEPENDENT, NH_DEPENDENT, NH_CONSTANT, NH_DOUBTFUL } nh_independence;

/* Classify phi[0..n-1] in the given order.  `sure` and `doubt`: remaining fractions above `sure` are independent
 * (1e-2), below `doubt` dependent (1e-6), among those that are `exact` (n; NULL: none is) below 1e-14: their numbers
 * were not fitted, nor recognised from a fit.  Between, ball arithmetic decides (gradient_rank.h), and what it cannot
 * evaluate is doubtful: not used against later ones.  `fraction` (n, may be NULL) gets the medians. */
void nh_independence_test(const nh_model *model, const nh_points *points, size_t n, const nh_ex *phi, const bool *exact,
                          double sure, double doubt, nh_independence *out, double *fraction);

#endif
