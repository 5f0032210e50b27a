/* benchmark: speed against accuracy.  One motion of one system by every integrator in every formulation, at several
 * tolerances or steps, measured now on this machine: error against a reference, drift of every known current, time,
 * evaluations.
 *
 * The reference is a Runge-Kutta motion of order 8 at the smallest tolerance; a second method at a tight tolerance says
 * how far it can be trusted.  Errors are the largest over output times, coordinates and velocities, relative to the
 * largest value of each along the motion. */
#ifndef NH_BENCHMARK_H
#define NH_BENCHMARK_H

#include "commands/simulate.h"

typedef enum { NH_ACCURATE, NH_FLAGGED, NH_DETECTED, NH_FAILED, NH_TIMEOUT, NH_UNDETECTED } nh_run_record_status;

typedef struct {
    const char *method, *formulation;
    double tolerance, step;      /* one of them is NAN */
    double error, worst_drift;   /* NAN where there is none */
    double *drift;               /* per current */
    double seconds;              /* the least of some repetitions, without preparations */
    long evaluations;
    /* of a method with a fixed step: its order by theory, else 0; and as observed between this step and the larger one
       before, NAN where the errors do not tell */
    int order;
    double observed_order;
    nh_run_record_status status;
    /* of reduced equations, which compute less: errors are of their own states, and it does not count below */
    bool reduced;
    bool front;                  /* nothing measured is both faster and more accurate */
    const char *note;            /* why it failed, or empty */
} nh_run_record;

/* The Jacobian of the equations of motion at the chart's probes. */
typedef struct {
    const char *method;
    /* the largest difference from the exact one, relative to its largest entry (or 1); NAN where none could be
       computed */
    double error;
    double seconds;   /* of one Jacobian */
    long evaluations; /* of the right-hand side (of the exact derivatives: 1) */
} nh_derivative;

/* The null space of the sampled equations, solved in one way. */
typedef struct {
    size_t functions, columns, samples; /* of the ansatz; of the matrix (the symmetry route has more); points */
    const char *basis, *route, *solver;
    size_t rank, dimension, wanted; /* independent columns; of the null space; the same by the most careful way */
    double gap;                  /* of the spectrum after the null values */
    /* distance of the known currents from the space, at points not used; NAN: none is in the span */
    double error;
    double seconds;              /* rows and solution, without sampling */
    bool good, undecided, right, front;
} nh_fitted;

struct nh_benchmark {
    nh_arena *arena;
    nh_simulation *question;     /* system, model, analysis */
    size_t methods;              /* only these were wanted; 0: all */
    const nh_method *const *only;
    /* of where methods fail, or NULL; in an arena of its own, which nh_benchmark_free frees */
    const struct nh_robustness *maps;
    nh_arena *of_maps;
    double begin, end;
    const char *reference, *second;
    double agreement;            /* of these two: smaller errors mean nothing */
    size_t currents;
    const char **current;        /* names */
    size_t count, capacity;
    nh_run_record *item;           /* by method and formulation, loosest first */
    size_t derivatives;
    nh_derivative *derivative;
    size_t fits;
    nh_fitted *fit;              /* by functions and samples */
    bool fits_partial;           /* there was no time for more of them */
    size_t refused;
    const char **refusal;        /* "energy-preserving: it would converge ..." */
    bool partial;                /* the budget ended it */
    /* they do not agree well enough for it to be a reference (options.benchmark_trusted): errors then say little, and
       nothing is accurate */
    bool doubtful;
    bool shortened;              /* the motion did not reach the time that was meant, and nobody had chosen that */
};

/* `budget`: seconds for the measurements.  NULL with a message when no motion can be computed at all. */
nh_benchmark *nh_benchmark_run(const nh_simulate_request *request, double budget, nh_error *error);
void nh_benchmark_free(nh_benchmark *comparison);

/* The word of text and page, and that of JSON, which is older and stays for the scripts that read it. */
const char *nh_run_record_status_name(nh_run_record_status status);
const char *nh_run_record_status_json(nh_run_record_status status);

#endif
