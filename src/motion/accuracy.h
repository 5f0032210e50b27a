/* accuracy: a motion whose error is measured to be below what was asked for, or a plain statement that it is not.
 *
 * 1. The method is an explicit pair of order 8; where that is slow and CVODE BDF much faster, as on stiff motions, CVODE BDF.
 * 2. It runs at ever tighter tolerances tau.  With d the difference of two successive runs and p the exponent with which differences fall
 *    (0.7 until two differences are known, then measured, within [0.2, 0.9]) the error of the tighter one is about d (tau2/tau1)^p. It is
 *    accepted when that is below eps/2 and d is below 30 eps; otherwise the next tolerance follows from the estimate.  Every second run starts beside
 *    the start by a part 1e-15 of each number, so that the differences also show what rounding errors grow to.
 * 3. Where the method is implicit, or an error is a thousand times the tolerance, another method must agree to eps, at a tolerance tightened
 *    until it does: step halving alone can be deceived where a motion is unstable.
 *
 * No run is extrapolated in time. Errors are those of the wanted expressions, each relative to its largest value along the motion. */
#ifndef NH_ACCURACY_H
#define NH_ACCURACY_H

#include "motion/trajectory.h"

typedef struct {
    bool held;
    double wanted, estimate, tolerance; /* of the motion that is returned */
    const char *second;                 /* the method that confirms; NULL: there was no doubt */
    double difference;                  /* from it; INFINITY when there was none, or it could not compute the motion */
    size_t quantity;                    /* the wanted expression that is least certain */
    int runs;
    long evaluations;                   /* of all runs */
    double seconds;                     /* of all runs, without preparations */
    char why[320];                      /* the choice, or what failed, in words */
} nh_accuracy;

/* The trajectory of the tightest run, also when the accuracy was not reached (held == false).  request->n must not be 0. */
nh_trajectory *nh_trajectory_accurate(const nh_trajectory_request *request, double eps, nh_accuracy *accuracy, nh_error *error);

#endif
