/* accuracy_measure: the distance of two runs of a motion, and the perturbed start of the second run (accuracy.h). */
#ifndef NH_ACCURACY_MEASURE_H
#define NH_ACCURACY_MEASURE_H

#include "motion/trajectory.h"

/* How the error of a motion is judged by two runs of it. */
enum { NH_ACCURACY_RUNS = 7 }; /* largest number of runs */
static const double
    nh_accuracy_loosest = 1e-5,
    nh_accuracy_tightest = 1e-14, /* tolerances */
    nh_accuracy_first = 3,        /* the first tolerance, as a multiple of eps */
    nh_accuracy_step = 0.1,       /* largest factor from one tolerance to the next */
    nh_accuracy_exponent = 0.7,   /* the exponent with which differences fall, until it is measured */
    /* in eps: the largest difference of two runs at which the tighter one is accepted */
    nh_accuracy_far = 30,
    /* the same of the first two runs: where steps are so large that errors do not fall yet, both can err alike */
    nh_accuracy_alike = 0.1,
    /* relative perturbation of the initial state of every second run: the differences of runs then show how rounding
     * errors grow */
    nh_accuracy_disturbance = 1e-15,
    /* a difference above so many tolerances must be confirmed by another method */
    nh_accuracy_amplified = 1e3;

/* The largest difference of n values at `count` outputs (row by row), each relative to its largest value, or to
 * floor[k] where that is larger (NULL: all 0); *which: the value that differs most.  What is undefined in both does not
 * count; in one of them: INFINITY. */
double nh_accuracy_difference(size_t count, size_t n, const double *a, const double *b, const double *floor,
                              size_t *which);

/* The least scales of the wanted expressions: INFINITY for those that are zero along the motion (vanishing.h), 0 for
   others.  False: there is no motion. */
bool nh_accuracy_zeros(const nh_trajectory_request *request, double *floor);
/* Raises the floors to the largest values along the motion, where its outputs are few and may all be at zeros. */
void nh_accuracy_between(const nh_trajectory_request *request, double *floor);
/* Raises the floors of the expressions of request->by_terms to the largest of their terms along a motion. */
void nh_accuracy_terms(const nh_trajectory_request *request, const nh_trajectory *along, double *floor);

/* Is the wanted expression number k much smaller along the motion than its terms?  *size: its own. */
bool nh_accuracy_cancels(const nh_trajectory_request *request, const nh_trajectory *along, size_t k, double *size);

/* Copies n values, each changed by the relative part nh_accuracy_disturbance up or down. */
void nh_accuracy_disturb(size_t n, const double *from, double *to);

#endif
