/* ensemble_accuracy: an ensemble with estimated errors below the requested accuracy, member by member.
 *
 * The first member determines the best method for one motion (accuracy.h), two more members its cost; the first batch
 * may use as much work as its members would need alone.  The cheaper of the two is used: on stiff motions, where
 * another method is so much better than the batches' pair of order 8 that one by one is faster, and in small
 * ensembles, each member alone by that way, at the tolerance that it needs.  Otherwise the whole ensemble runs at
 * ever tighter tolerances, as one motion does, until nearly every member is accepted; the members that are not, or
 * whose errors are a thousand times the tolerance, are computed alone.  Costs are counted work (base/effort.h), not
 * time: nothing depends on the number of threads. */
#ifndef NH_ENSEMBLE_ACCURACY_H
#define NH_ENSEMBLE_ACCURACY_H

#include "motion/accuracy.h"
#include "motion/ensemble.h"

typedef struct {
    bool held; /* all members have the accuracy */
    /* the largest estimate of the members that were accepted, at the tolerance of the batches */
    double wanted, estimate, tolerance;
    bool all_alone;            /* all were computed alone, by `way`; the tolerance is that of the first member */
    nh_integration_plan way;   /* plan of the first member alone; its method is NULL where that failed */
    nh_accuracy_choice choice; /* origin of that plan */
    double ratio;              /* counted work of all members alone to that in batches; 0: not known */
    size_t alone, unsure;      /* members that were computed alone; members that do not have the accuracy */
    int runs;                  /* of the whole ensemble */
    long evaluations;          /* of all runs */
    double seconds;
    char why[512];
} nh_ensemble_accuracy;

/* As nh_ensemble_create; `ways` as in nh_trajectory_accurate. */
nh_ensemble *nh_ensemble_accurate(const nh_trajectory_request *request, size_t members, const double *initial,
                                  size_t threads, double eps, const nh_integration_plans *ways,
                                  nh_ensemble_accuracy *accuracy, nh_error *error);

#endif
