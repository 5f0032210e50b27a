/* motion: motions of z' = f(t, z): problems, options, results, and the common part of all integrators.
 *
 * The right-hand side comes as a callback, so this module does not depend on mechanics.  Tolerances: relative rtol and
 * absolute atol_i, a part of the largest size that the state has had (sizes.h), or rtol * scale_i.  Roots of guard
 * functions are events: a chart's pivot that changes sign stops the integration there (integrators step over chart
 * singularities without any failure flag). */
#ifndef NH_MOTION_H
#define NH_MOTION_H

#include <stdbool.h>
#include <stddef.h>

#include "base/error.h"

typedef enum { NH_ADAMS, NH_BDF } nh_flow_method;

/* Functions whose zeros along a motion are wanted (events.h). */
typedef struct {
    size_t count;
    /* Writes their values and, after these, the sizes of their terms: 2 count numbers. */
    bool (*value)(double t, const double *z, double *value, void *context);
    void *context;
    const int *direction; /* count: +1 rising along t, -1 falling, 0 both */
    const bool *stop;     /* count: the motion ends at the first zero of this function */
    double tolerance;     /* relative to the sizes: a smaller value has no sign */
    double begin;         /* beginning of the whole motion: a zero there is recorded, and does not end the motion */
} nh_event_watch;

typedef struct {
    double time;
    size_t which;  /* function */
    int direction; /* +1, -1 */
} nh_event_found;

typedef struct {
    size_t size;
    void *context;
    /* z' into rate; false when it cannot be computed there (not finite). */
    bool (*rate)(double t, const double *z, double *rate, void *context);
    /* d rate_i / d z_j into jacobian[i + j*size]; may be NULL. */
    bool (*jacobian)(double t, const double *z, double *jacobian, void *context);
    size_t guards;
    /* Guard functions: a change of sign ends the motion.  May be NULL when guards is 0. */
    bool (*guard)(double t, const double *z, double *value, void *context);
    /* of the guards, the last ones: there the state is described anew by `renew`, and the motion goes on (turns.h) */
    size_t turns;
    bool (*renew)(double *z, void *context);
    bool own_guards; /* in parts of such a motion: the other guards end it */
    size_t walls;
    /* Functions that change their sign where the rates have a kink or a jump: steps end there (wall_steps.h).  May be
       NULL when walls is 0. */
    bool (*wall)(double t, const double *z, double *value, void *context);
} nh_flow_problem;

/* Places where the equations determine no acceleration (singular.h). */
typedef struct nh_singular_watch nh_singular_watch;

typedef struct {
    nh_flow_method method;
    double rtol;
    /* below this part of the largest size that a state has had, its error is absolute: rtol * absolute * size */
    double absolute;
    const double *least; /* size entries: the least size of each state; NULL: sizes come from the motion alone */
    /* size entries: the absolute error is rtol * scale[i]; NULL with absolute == 0: all scales are 1 */
    const double *scale;
    double max_steps;                 /* largest number of steps; 0: the default of 1e7 */
    double effort;                    /* largest work in units of base/effort.h; 0: no limit */
    bool early;                       /* a motion for which it will not suffice by far ends before it is spent */
    bool (*cancelled)(void *context); /* called between steps: true ends the motion; may be NULL */
    void *cancel_context;
    double step; /* the step of methods with a fixed step */
    /* Called after every step of a one-step method with the new state, which it may change (a projection); false: it
     * failed. */
    bool (*after)(double t, double *z, void *context);
    void *after_context;
    const nh_event_watch *watch; /* NULL: nothing is watched */
    nh_singular_watch *singular; /* singular places end the motion; NULL: it is not watched for them */
    /* guards end the motions of one-step methods, too (safeguards.h); they always end those of CVODE */
    bool guarded;
    double whole; /* length of the whole motion that this one is a part of; 0: it is no part */
} nh_flow_options;

typedef struct {
    size_t count; /* output points reached (the first is the initial state) */
    size_t size;
    double *time;    /* count */
    double *state;   /* count x size, row by row: state[i*size + j] */
    bool complete;   /* all wanted times were reached, or a zero at which it was to stop */
    bool limited;    /* it ended early at the limit of steps or of counted work */
    bool singular;   /* it ended where the equations of motion determine no acceleration (singular.h) */
    long guard_hit;  /* index of the guard that ended it, or -1 */
    double end_time; /* where it ended */
    /* size: the state there; at a guard it is past the last output, and the next chart starts from it */
    double *end_state;
    long evaluations, steps, jacobians;
    double effort; /* units of base/effort.h that it took */
    /* by the clock, and those for which its thread computed, to which other programs add nothing: for reports only */
    double seconds, processor;
    size_t events; /* zeros of the watched functions, in the order of the motion */
    nh_event_found *event;
    double *event_state; /* events x size */
    /* the motion stopped at the last zero, which is the last output as well; then it is complete */
    bool stopped;
    size_t smooth;   /* rows before the state is described anew for the first time (turns.h); 0: all */
    double searched; /* up to this time a part of the integrator has recorded the zeros already (NAN: nowhere) */
    char note[256];  /* remarks in sentences, such as why the motion ended early */
} nh_motion;

/* Frees a motion with its states, events and end state; NULL is allowed. */
void nh_motion_free(nh_motion *motion);

/* ---- for the integrators of this folder ---- */

typedef enum { NH_STEP_ON, NH_STEP_LAST, NH_STEP_FAILED } nh_step;

typedef struct {
    void *context;
    /* Makes one step; *time is the time after it.  LAST: the final time or a guard is reached.  A failure writes its
     * note. */
    nh_step (*advance)(double *time, nh_motion *motion, void *context);
    /* The state at a time inside the last step; false when there is none. */
    bool (*state)(double time, double *state, void *context);
    /* NULL: `state` gives the states inside the last step as well.  Otherwise the rates, from which these are computed
     * where they are wanted. */
    bool (*rate)(double t, const double *z, double *rate, void *rate_context);
    void *rate_context;
    bool dense;         /* `state` gives such states, too, but each costs a step */
    double step_effort; /* units of one step, beside the right-hand sides and the effort that is counted elsewhere */
    /* Writes the note: the last NH_STUCK_AFTER steps did not move the time, or very many hardly did. */
    void (*stuck)(nh_motion *motion, void *context);
} nh_stepper;

enum { NH_STUCK_AFTER = 100, NH_ADVANCE_AFTER = 1000 };

/* A motion that holds its initial state, of which `given` values are known.  NULL when the times, these values or the
 * options (with `given` scales) are not valid.  The caller frees it. */
nh_motion *nh_motion_start(size_t size, size_t given, const double *initial, size_t count, const double *times,
                           const nh_flow_options *options, nh_error *error);
/* rtol, raised to what double precision allows (the note says so). */
double nh_motion_rtol(nh_motion *motion, const nh_flow_options *options);
/* Adds a sentence to the note. */
void nh_motion_note(nh_motion *motion, const char *format, ...) __attribute__((format(printf, 2, 3)));

#endif
