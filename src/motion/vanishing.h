/* vanishing: quantities that vanish along a whole motion, for which no relative error exists.
 *
 * The largest set C of states is sought that stay what they are at the start whatever the others do: their rates vanish
 * at states of the chart (its probes) in which C has its initial values.  A quantity vanishes along the motion if it
 * does so at all these states.  To vanish is to be no larger than rounding makes it there: a quantity that is 1e-12 of
 * the terms that it is made of is small, and not zero.  [the states with these values of C are an invariant set] */
#ifndef NH_VANISHING_H
#define NH_VANISHING_H

#include "motion/dynamics.h"

typedef struct nh_vanishing nh_vanishing;

/* For n expressions of the chart. */
nh_vanishing *nh_vanishing_create(const nh_model *model, size_t n, const nh_ex *e);
void nh_vanishing_free(nh_vanishing *vanishing);

/* Along the motion from the state z = (q, w): n flags into zero.  None is set where that cannot be decided. */
void nh_vanishing_test(nh_vanishing *vanishing, const double *z, bool *zero);

#endif
