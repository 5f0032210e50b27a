/* ensemble_accuracy: an ensemble whose errors are measured to be below what was asked for, member by member.
 *
 * The whole ensemble runs at ever tighter tolerances, as one motion does (accuracy.h), until nearly every member is accepted; the members that are not,
 * or whose errors are a thousand times the tolerance, are computed alone, each by the method and at the tolerance that it needs. */
#ifndef NH_ENSEMBLE_ACCURACY_H
#define NH_ENSEMBLE_ACCURACY_H

#include "motion/accuracy.h"
#include "motion/ensemble.h"

typedef struct {
    bool held;                  /* by all members */
    double wanted, estimate, tolerance; /* the largest estimate of the members that were accepted, at the tolerance of the batches */
    size_t alone, unsure;       /* members that were computed alone for it; that did not reach it all the same */
    int runs;                   /* of the whole ensemble */
    long evaluations;           /* of all runs */
    double seconds;
    char why[512];
} nh_ensemble_accuracy;

/* As nh_ensemble_create, and nh_trajectory_accurate for `way`. */
nh_ensemble *nh_ensemble_accurate(const nh_trajectory_request *request, size_t members, const double *initial, size_t threads, double eps, size_t ways, const nh_way *way,
                                  nh_ensemble_accuracy *accuracy, nh_error *error);

#endif
