/* accuracy_measure: the distance of two runs of a motion, and the perturbed start of the second run (accuracy.h). */
#ifndef NH_ACCURACY_MEASURE_H
#define NH_ACCURACY_MEASURE_H

#include "motion/trajectory.h"

/* How the error of a motion is judged by two runs of it. */
enum { NH_ACCURACY_RUNS = 7 };                 /* at most */
static const double nh_accuracy_loosest = 1e-5, nh_accuracy_tightest = 1e-14, /* tolerances */
    nh_accuracy_first = 3,                     /* parts of eps: the first tolerance */
    nh_accuracy_step = 0.1,                    /* from one tolerance to the next, at most */
    nh_accuracy_exponent = 0.7,                /* with which differences fall, until it is measured */
    /* in eps: two runs may differ so much where the tighter one is accepted; */
    nh_accuracy_far = 30,
    /* the first two so much: steps so large that errors do not fall yet can make both err alike */
    nh_accuracy_alike = 0.1,
    /* relative, of the start of every second run: what rounding errors grow to is then seen in the differences */
    nh_accuracy_disturbance = 1e-15,
    nh_accuracy_amplified = 1e3;               /* an error so many times the tolerance is confirmed by another method */

/* The largest difference of n values at `count` outputs (row by row), each relative to its largest value, or to
 * floor[k] where that is larger (NULL: all 0); *which: the value that differs most.  What is undefined in both does not
 * count; in one of them: INFINITY. */
double nh_accuracy_difference(size_t count, size_t n, const double *a, const double *b, const double *floor,
                              size_t *which);

/* The least scales of the wanted expressions: INFINITY for those that are zero along the motion (vanishing.h), 0 for
   others.  False: there is no motion. */
bool nh_accuracy_zeros(const nh_trajectory_request *request, double *floor);
/* For those of request->by_terms, the largest of their terms along a motion: larger floors. */
void nh_accuracy_terms(const nh_trajectory_request *request, const nh_trajectory *along, double *floor);

/* Is the wanted expression number k much smaller along the motion than its terms?  *size: its own. */
bool nh_accuracy_cancels(const nh_trajectory_request *request, const nh_trajectory *along, size_t k, double *size);

/* n values, each moved by the part nh_accuracy_disturbance up or down. */
void nh_accuracy_disturb(size_t n, const double *from, double *to);

#endif
