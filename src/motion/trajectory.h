/* trajectory: one motion of a model, in a formulation that reaches the end, with the values of expressions
   along it. */
#ifndef NH_TRAJECTORY_H
#define NH_TRAJECTORY_H

#include "base/option.h"
#include "motion/method.h"
#include "motion/along.h"
#include "motion/closed_subsystem.h"

/* The formulation in the model's own velocities, as reports name it. */
#define NH_ON_SUBMANIFOLD "equations of motion on the constraint submanifold"

enum { NH_TRAJECTORY_MACHINE = 320 };

/* The equations of a motion. */
typedef enum {
    /* those on the constraint submanifold, of the model; all coordinates where its chart breaks down on the way */
    NH_OWN_VELOCITIES,
    NH_OTHER_VELOCITIES, /* those of another model of the same system, in other velocities */
    NH_ALL_COORDINATES   /* the bordered system from the start */
} nh_velocities;

/* A zero along the motion that is recorded, or that ends it. */
typedef struct {
    nh_ex e;       /* of the chart */
    int direction; /* +1 rising along t, -1 falling, 0 both */
    bool stop;
} nh_event;

typedef struct {
    const nh_model *model;
    const nh_state *initial;
    size_t count; /* number of output times */
    const double *times;
    const nh_options *options; /* tolerance, absolute, steps, compile */
    size_t n;
    const nh_ex *e; /* expressions of the chart that are wanted along the motion; n may be 0 */
    /* n, or NULL: their errors are relative to the largest of their terms, with an accuracy (accuracy.h) */
    const bool *by_terms;
    size_t events; /* events to be recorded (motion.h) */
    const nh_event *event;
    /* functions of t and q: at their zeros the motion has an impulse that its equations do not determine, and ends
     * (integrals/region.h) */
    size_t impulses;
    const nh_ex *impulse;
    bool smallest; /* integrate only the closed subsystem for `e` and the events */
    /* expressions of the chart that are known to be conserved: they may determine states of the subsystem */
    size_t currents;
    const nh_ex *current;
    /* replace velocities that violate the constraints by the nearest that satisfy them */
    bool project;
    const nh_method *method;  /* NULL: automatic choice (automatic.h) */
    double step;              /* of methods with a fixed step, which solve the model's own equations for all states */
    nh_programs *programs;    /* programs of the model for these methods; NULL: made for this motion */
    nh_velocities velocities; /* used where possible; otherwise the model's own */
    const nh_model *other;    /* for NH_OTHER_VELOCITIES */
    double max_seconds;       /* time limit (base/clock.h); 0: none; a motion that takes longer is not complete */
    double max_effort;        /* the same in units of base/effort.h, of each attempt at the motion; 0: none */
} nh_trajectory_request;

/* A request for a thread's own use: its models are copies on a graph of their own (nh_model_copy), so that other
 * threads can compute motions of the same models at the same time.  It borrows the rest of the request, and must be
 * freed after all that was computed by it. */
typedef struct {
    nh_trajectory_request request;
    nh_dag *dag;
    nh_model *model, *other; /* other: NULL where the request has none */
} nh_trajectory_own;
nh_trajectory_own nh_trajectory_own_create(const nh_trajectory_request *request);
void nh_trajectory_own_free(nh_trajectory_own *own);

typedef struct {
    nh_motion *motion; /* states (q, w), (q, v), or the kept states of the subsystem */
    const char *method, *formulation;
    double *value;                       /* count x n, row by row: value[i * n + k] */
    double *event_value;                 /* the same at the events: motion->events x n */
    nh_closed_subsystem *scene;          /* NULL: all states were integrated */
    char machine[NH_TRAJECTORY_MACHINE]; /* how the equations were evaluated, in words */
} nh_trajectory;

/* The motion in the chart, or in all coordinates where the chart breaks down on the way.  NULL with a message when
 * nothing could be computed.  The caller frees it. */
nh_trajectory *nh_trajectory_create(const nh_trajectory_request *request, nh_error *error);
void nh_trajectory_free(nh_trajectory *trajectory);

/* ---- parts, also for the validation ---- */

/* The size of each expression along a motion: the larger of |e| and of its first-order change when each state changes
 * by its own largest value, with a random sign.  So an expression that is zero up to rounding is as large as its
 * terms. */
bool nh_trajectory_sizes(nh_dynamics *dynamics, const nh_motion *motion, size_t n, const nh_ex *e, double *size);

/* Where does a chart of coordinate velocities lose digits?  One flag per output, which the caller frees (nh_free);
 * *any: at some output. */
bool *nh_steep_points(nh_dynamics *dynamics, const nh_motion *motion, bool *any);
/* The same from `count` rows of n slopes, which the factors free of their units. */
bool *nh_steep_entries(size_t count, size_t n, const double *R, const double *factor, bool *any);

/* The motion in all coordinates, from (q, v) of 2m entries, with accelerations from the bordered system; it keeps the
 * constraints.  `method` NULL: the one that
 * suits (automatic.h), *used where `used` is not NULL.  `machine`: NH_TRAJECTORY_MACHINE bytes for how the equations
 * were evaluated, or NULL. */
nh_motion *nh_motion_everywhere(nh_dynamics *dynamics, const nh_method *method, const double *initial, size_t count,
                                const double *times, const nh_flow_options *options, char *machine,
                                const nh_method **used, nh_error *error);

/* Does the chart's pivot change sign on the way from z0 at times[0] to times[1]?  CVODE and the automatic choice (NULL)
 * watch it, other methods step over it: call this before another method runs. */
bool nh_meets_pivot(nh_dynamics *dynamics, const nh_method *method, const double *z0, const double times[2],
                    const nh_flow_options *options);

/* Can the chart be replaced by all coordinates?  One of quasi-velocities must be known by its inverse. */
bool nh_may_leave_chart(const nh_model *model);

#endif
