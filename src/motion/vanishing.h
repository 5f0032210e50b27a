/* vanishing: quantities that vanish along a whole motion, for which no relative error exists.
 *
 * The largest set C of states is sought that keep their initial values whatever the others do: their rates vanish at
 * states of the chart (its probes) in which C has its initial values.  So the states with these values of C are an
 * invariant set.  A quantity vanishes along the motion if it vanishes at all these states, that is if it is no larger
 * there than rounding makes it: a quantity that is 1e-12 of its terms is small, and not zero. */
#ifndef NH_VANISHING_H
#define NH_VANISHING_H

#include "motion/dynamics.h"

typedef struct nh_vanishing nh_vanishing;

/* For n expressions of the chart.  Keeps the model, which has to outlive it; the caller frees it. */
nh_vanishing *nh_vanishing_create(const nh_model *model, size_t n, const nh_ex *e);
void nh_vanishing_free(nh_vanishing *vanishing);

/* Along the motion from the state z = (q, w): n flags into zero.  None is set where that cannot be decided. */
void nh_vanishing_test(nh_vanishing *vanishing, const double *z, bool *zero);

#endif
