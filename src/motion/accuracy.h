/* accuracy: a motion with an estimated error below the requested accuracy, or a statement that it was not reached.
 *
 * 1. The method is an explicit pair of order 8; where that needs much work and CVODE BDF much less, as on stiff
 *    motions, CVODE BDF.  Where the motion needs so much by it that a choice can pay, other methods are then measured
 *    on a piece of the motion (pilot_runs.h), with a part of that work, and the cheapest takes over if it saves work
 *    from there on.  Work is counted (base/effort.h), not timed: the same motion is computed in the same way
 *    everywhere.  A caller may also give the methods to choose from.
 * 2. It runs at ever tighter tolerances tau (a method with fixed steps: with ever more steps, tau being the error that
 *    is expected of them).  With d the difference of two successive runs and p the exponent with which differences fall
 *    (0.7 until two differences are known, then measured, within [0.2, 0.9]) the error of the tighter one is about d
 *    (tau2/tau1)^p. It is accepted when that is below eps/2 and d is below 30 eps, of the first two runs below eps/10
 *    (they may err alike); otherwise the next tolerance follows from the estimate.  Every second run perturbs the
 *    initial state by 1e-15, relative, so that the differences also show the growth of rounding errors.
 * 3. Where the method is implicit, or an error is a thousand times the tolerance, another method must agree to eps, at
 *    a tolerance tightened until it does: step halving alone can be deceived where a motion is unstable.
 *
 * No run is extrapolated in time. Errors are those of the wanted expressions, each relative to its largest value along
 * the motion, however small that is; those of currents and energies, which are sums that may cancel, relative to the
 * largest of their terms.  What is zero along the motion (vanishing.h) has no error. */
#ifndef NH_ACCURACY_H
#define NH_ACCURACY_H

#include "motion/accuracy_measure.h"
#include "motion/pilot_runs.h"

/* Origin of the method: a first run chose between an explicit and an implicit pair of methods; the caller gave it; it
 * was measured for this motion; the first run chose it, because the motion is too short to measure anything. */
typedef enum { NH_CHOICE_RACE, NH_CHOICE_GIVEN, NH_CHOICE_PILOT, NH_CHOICE_SHORT } nh_accuracy_choice;

/* The integration plans that may be used. */
typedef struct {
    size_t count; /* plans by which a motion like this one was computed */
    const nh_integration_plan *way;
    bool pilot; /* where none of these is good enough, other methods may be measured */
    /* number of further motions that will use the plan of this one: measuring then saves so many times more */
    double more;
    /* pilot runs measure only methods with error control, in the model's own velocities */
    bool plain;
    void *context;
    /* Derives the model in other velocities, where that costs at most so many units of effort; else NULL. May be
     * NULL. */
    const nh_model *(*derive)(void *context, double effort);
} nh_integration_plans;

typedef struct {
    bool held;
    /* tolerance and step of the returned motion: one of them is NAN */
    double wanted, estimate, tolerance, step;
    nh_accuracy_choice choice;
    bool measured;          /* the method is the cheapest of the measured ones */
    const nh_method *other; /* if measured: the method of the second cheapest; NULL: there is none */
    double next;            /* and its work relative to that of the cheapest; NAN */
    const char *second;     /* the method that confirms the result; NULL: there was no doubt */
    /* of the confirming run; INFINITY when there was none, or it could not compute the motion */
    double difference;
    size_t quantity; /* index of the wanted expression with the largest estimated error */
    double size;     /* the largest value of this expression along the motion */
    int runs;
    long evaluations; /* of all runs, pilot runs included */
    double effort;    /* units of base/effort.h of all runs */
    double seconds;   /* of all runs, by the clock: for reports only */
    /* the plan of the returned motion, with its measured cost and its estimated error */
    nh_integration_plan way;
    char why[512]; /* the choice, or what failed, as a sentence */
} nh_accuracy;

/* The trajectory of the tightest run, also when the accuracy was not reached (held == false).  request->n must not be
 * 0.  `ways` NULL: the race decides. */
nh_trajectory *nh_trajectory_accurate(const nh_trajectory_request *request, double eps,
                                      const nh_integration_plans *ways, nh_accuracy *accuracy, nh_error *error);

#endif
