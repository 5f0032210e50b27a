/* integration_plan: a method with its equations, and the measured cost and error of a run on a piece of the motion. */
#ifndef NH_INTEGRATION_PLAN_H
#define NH_INTEGRATION_PLAN_H

#include "motion/trajectory.h"

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

#endif
