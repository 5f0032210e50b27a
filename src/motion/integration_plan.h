/* integration_plan: a method with its equations, and the measured cost and error of a run on a piece of the motion. */
#ifndef NH_INTEGRATION_PLAN_H
#define NH_INTEGRATION_PLAN_H

#include "motion/trajectory.h"

typedef struct {
    const nh_method *method;
    nh_velocities velocities;
    double tolerance, step; /* of the run that was measured; one of them is NAN */
    double error;           /* that it had; not below what the reference could tell */
    double effort;          /* units of base/effort.h per unit of time of the motion */
} nh_integration_plan;

/* A multistep or an implicit method can damp what grows: another one is to confirm it. */
bool nh_integration_plan_doubtful(const nh_method *method);

/* What can be used with a request. */
typedef struct {
    bool scene;     /* only the equations of the model itself, by methods with error control */
    bool other;     /* other velocities, too */
    double spacing; /* of the outputs, at which fixed steps end: longer ones are of no use */
} nh_integration_plan_limits;

typedef struct {
    const nh_integration_plan *way;       /* NULL: none was measured below eps */
    /* that confirms it where it is doubtful: the cheapest other one with error control; NULL: none was measured */
    const nh_method *second;
    /* the cheapest by another method or in other equations; NULL: none was measured below eps */
    const nh_integration_plan *other;
    double next;             /* how many times as much that one costs; NAN: there is none */
} nh_integration_plan_choice;

/* What a run with an accuracy costs, per unit of time: two runs, and the confirmation where it is doubtful. */
double nh_integration_plan_cost(size_t n, const nh_integration_plan *way, double eps, const nh_integration_plan *of);

/* The cheapest run whose error was below eps, counted with its confirmation. */
nh_integration_plan_choice nh_integration_plan_cheapest(size_t n, const nh_integration_plan *way, double eps,
                                                        const nh_integration_plan_limits *limits);

/* The tolerance or step at which the error is expected to be `error`, from the run that was measured. */
double nh_integration_plan_setting(const nh_integration_plan *way, double error);

#endif
