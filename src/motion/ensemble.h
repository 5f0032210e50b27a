/* ensemble: the same model from many initial states at once.
 *
 * Members are integrated in batches that take common steps, by an explicit Runge-Kutta pair of order 8 (Prince and
 * Dormand) whose right-hand side is evaluated for the whole batch at once; the member that needs the smallest step
 * decides it.  The coefficients are read from GSL's own stepper.  A member that cannot continue (a singularity, the
 * end of a chart) or that slows its batch is computed alone afterwards, in all coordinates if necessary.  Batches and
 * members alone go to several threads; the results do not depend on how many.  Each result is that of a motion of its
 * own to the tolerance.
 *
 *               lane  0    1    2   ..  127            a batch: kept x lanes numbers, common t and h
 *      state 0      [ z    z    z        z  ]          one instruction of the program works on a whole row
 *      state 1      [ z    z    z        z  ]
 *
 *      worst error of the lanes <= 1    the step is taken; the next by worst^(-1/8), between 1/5 and 5 times
 *      otherwise                        lanes far above the median error leave, or h gets smaller
 *      h too small                      lanes without finite values leave
 *
 * A lane that leaves keeps values at which the program can be evaluated, and no longer counts. [Galassi2009] */
#ifndef NH_ENSEMBLE_H
#define NH_ENSEMBLE_H

#include "motion/trajectory.h"

enum { NH_ENSEMBLE_BATCH = 128 }; /* members of a batch */

typedef struct {
    size_t members, count, n;
    double *time; /* count */
    /* value[(member * count + i) * n + k]: expression k at output i; NAN where a member did not come so far */
    double *value;
    nh_closed_subsystem *scene; /* the closed subsystem that was integrated; owned */
    size_t alone, incomplete;   /* members that were computed alone; that did not reach the end */
    long evaluations;           /* of the right-hand side, per member and stage */
    double seconds;             /* of the integration, without preparations */
    char note[256];             /* reason why the first incomplete member ended */
} nh_ensemble;

/* `request`: as for one trajectory; method and smallest are ignored. initial: members x (m + n) values (q, w) at
 * times[0].  The caller frees the result.  NULL with an error where there is no member or no output. */
nh_ensemble *nh_ensemble_create(const nh_trajectory_request *request, size_t members, const double *initial,
                                size_t threads, nh_error *error);
void nh_ensemble_free(nh_ensemble *ensemble);
/* An ensemble whose values are all NAN, to be filled by the caller. */
nh_ensemble *nh_ensemble_empty(const nh_trajectory_request *request, size_t members, nh_error *error);

/* What a batch costs. */
typedef struct {
    size_t members, left; /* members of the first batch; how many of them would have to be computed alone */
    /* units of base/effort.h for `part` of the motion; INFINITY: such equations cannot be computed in batches */
    double effort;
    double part;
    long evaluations;
} nh_trial;

/* The first batch with at most so much effort: the motions of its members, NAN for those left out.  NULL when it needed
 * more, or would by extrapolation, or cannot be computed. */
nh_ensemble *nh_ensemble_try(const nh_trajectory_request *request, size_t members, const double *initial, double effort,
                             nh_trial *trial);

/* members x (m + n) values: the first is z0, the others lie around it within spread * max(|z0_i|, 1) in every state. */
void nh_ensemble_states(size_t size, const double *z0, size_t members, double spread, uint64_t seed, double *initial);

#endif
