/* pilot_runs: a small benchmark on a piece of one motion, before the rest of it is computed.
 *
 * The caller gives the beginning of the piece; its length is such that the best method so far needs a small part of the
 * budget, in counted work (base/effort.h).  A run of that method at a tolerance a hundred times tighter is the
 * reference.  Every other method runs a few times, at the tolerance (or step) at which its error is expected to be eps
 * at the end of the whole motion, and with at most a few times the work of the best so far.  Errors are taken to grow
 * in proportion to time, as those of regular motions do; they only rank methods; accuracy.h checks the chosen one. */
#ifndef NH_PILOT_RUNS_H
#define NH_PILOT_RUNS_H

#include "motion/trajectory.h"

/* A method with its equations, and the measured cost and error of a run on a piece of the motion. */

typedef struct {
    const nh_method *method;
    nh_velocities velocities;
    double tolerance, step; /* of the measured run; one of them is NAN */
    double error;           /* measured error, at least the error of the reference */
    double effort;          /* units of base/effort.h per unit of time of the motion */
} nh_integration_plan;

/* Must another method confirm it?  A multistep or an implicit method can damp what grows. */
bool nh_integration_plan_doubtful(const nh_method *method);

/* The plans that a request allows. */
typedef struct {
    bool scene;     /* only the equations in the model's own velocities, by methods with error control */
    bool other;     /* also equations in other velocities */
    double spacing; /* distance of the outputs, at which fixed steps end: longer steps are of no use */
} nh_integration_plan_limits;

typedef struct {
    const nh_integration_plan *way; /* NULL: none was measured below eps */
    /* the plan that confirms it where it is doubtful: the cheapest other one with error control; NULL: none was
     * measured */
    const nh_method *second;
    /* the cheapest by another method or in other equations; NULL: none was measured below eps */
    const nh_integration_plan *other;
    double next; /* cost of `other` relative to that of `way`; NAN: there is none */
} nh_integration_plan_choice;

/* The cost of a motion with an accuracy, per unit of time: two runs, and the confirmation where it is doubtful. */
double nh_integration_plan_cost(size_t n, const nh_integration_plan *way, double eps, const nh_integration_plan *of);

/* The cheapest run whose error was below eps, with the cost of its confirmation. */
nh_integration_plan_choice nh_integration_plan_cheapest(size_t n, const nh_integration_plan *way, double eps,
                                                        const nh_integration_plan_limits *limits);

/* The tolerance or step at which the error is expected to be `error`, from the run that was measured. */
double nh_integration_plan_setting(const nh_integration_plan *way, double error);

/* ---- pilot runs ---- */

enum { NH_PILOT_RUNS_WAYS = 32 };

typedef struct {
    double eps;
    const nh_method *best; /* the best plan so far, in the model's own velocities */
    double effort;         /* units of base/effort.h that this plan takes for the whole motion */
    double budget;         /* units of all pilot runs, with deriving the functions of methods with fixed steps */
    bool plain;            /* only the model's own velocities and methods with error control */
    const double *floor;   /* least scales of what is wanted (nh_accuracy_difference) */
} nh_pilot_runs_terms;

typedef struct {
    size_t count; /* plans that were measured, below eps or not; 0: there was no reference */
    nh_integration_plan way[NH_PILOT_RUNS_WAYS];
    size_t tried; /* methods in velocities */
    double part;  /* of the motion */
    long evaluations;
    double effort, seconds; /* of all pilot runs: units of base/effort.h, and time by the clock */
} nh_pilot_runs;

/* `from`: a state of the motion between its ends, or the initial one. */
void nh_pilot_runs_make(const nh_trajectory_request *request, const nh_state *from, const nh_pilot_runs_terms *terms,
                        nh_pilot_runs *out);

/* The cheapest plan below eps, if it saves work relative to the best known one.  Where none does: the best known one
 * itself, or NULL when `done`, that is when one of its runs has been made. */
nh_integration_plan_choice nh_pilot_runs_choose(const nh_pilot_runs *runs, const nh_method *best, double eps,
                                                const nh_integration_plan_limits *limits, bool done);

#endif
