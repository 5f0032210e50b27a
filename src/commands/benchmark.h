/* benchmark: speed against accuracy.  One motion of one system by every integrator in every formulation, at several
 * tolerances or steps, measured now on this machine: error against a reference, drift of every known current, time,
 * evaluations.
 *
 * The reference is a Runge-Kutta motion of order 8 at the smallest tolerance; a second method at a tight tolerance says
 * how far it can be trusted.  Errors are the largest over output times, coordinates and velocities, relative to the
 * largest value of each along the motion. */
#ifndef NH_BENCHMARK_H
#define NH_BENCHMARK_H

#include "commands/benchmark_judge.h"
#include "commands/simulate.h"

/* TIMEOUT: begun, and ended by a limit; NOT_RUN: never begun. */
typedef enum {
    NH_ACCURATE,
    NH_FLAGGED,
    NH_DETECTED,
    NH_FAILED,
    NH_TIMEOUT,
    NH_UNDETECTED,
    NH_NOT_RUN,
    NH_RUN_STATUSES
} nh_run_record_status;

enum { NH_BENCHMARK_REPEATS = 7 };

typedef struct {
    const char *method, *formulation;
    double tolerance, step;    /* one of them is NAN */
    double error, worst_drift; /* NAN where they are not known */
    double *drift;             /* drift of each current */
    /* median and quartiles of the processor times of the repetitions, without preparation; quartiles of fewer than
     * three: NAN */
    double seconds, seconds_low, seconds_high;
    size_t repeats;
    double time[NH_BENCHMARK_REPEATS]; /* seconds of each */
    long evaluations;
    double floor; /* what the reference is known to; an error up to it is not told apart from the reference */
    bool below_floor;
    /* for a method with fixed step: its theoretical order, else 0; and the order observed between this step and the
     * larger one before, NAN where the errors do not show it */
    int order;
    double observed_order;
    nh_run_record_status status;
    /* a run of reduced equations, which compute less: the error is that of its own states, and it does not count for
     * `front` */
    bool reduced;
    /* no measured run is both faster, or of fewer evaluations, and more accurate */
    bool front, front_evaluations;
    const char *note; /* why it failed, or empty */
} nh_run_record;

/* The order of convergence of one method of fixed steps in one formulation. */
typedef struct {
    const char *method, *formulation;
    int order; /* of its theory */
    nh_judge_order judged;
} nh_benchmark_order;

/* The Jacobian of the equations of motion at the chart's probes. */
typedef struct {
    const char *method;
    /* the largest difference from the exact Jacobian, relative to its largest entry (or 1); NAN where none could be
     * computed */
    double error;
    double seconds;   /* of one Jacobian: the median of many */
    long evaluations; /* evaluations of the right-hand side (of the exact derivatives: 1) */
} nh_derivative;

/* The null space of the sampled equations, computed by one method. */
typedef struct {
    /* degree of the polynomials; number of functions of the ansatz; of columns of the matrix (more in the symmetry
     * route); of points */
    size_t degree, functions, columns, samples;
    const char *grid, *basis, *route, *solver;
    /* number of independent columns; dimension of the null space; the same by the most careful method */
    size_t rank, dimension, wanted;
    double gap; /* gap of the spectrum above the null values */
    /* distance of the known currents from the null space, at points that were not used; NAN: none is in the span */
    double error;
    /* what rounding lets expect of it: epsilon sigma_max / sigma of the first value that is not null, by Wedin's
     * theorem about the angle of singular subspaces; NAN: there is none */
    double expected;
    /* for rows and solution, without sampling: median and quartiles as of a run */
    double seconds, seconds_low, seconds_high;
    size_t repeats;
    bool good, undecided, right, front;
} nh_fitted;

struct nh_benchmark {
    nh_arena *arena;
    nh_simulation *question; /* owns system, model and analysis file */
    size_t methods;          /* limits the comparison to these methods; 0: all */
    const nh_method *const *only;
    /* robustness maps, or NULL; in an arena of their own, which nh_benchmark_free frees */
    const struct nh_robustness *maps;
    nh_arena *of_maps;
    double begin, end;
    const char *reference, *second;
    double agreement; /* largest difference of the two references: smaller errors mean nothing */
    size_t currents;
    const char **current; /* names */
    size_t count, capacity;
    nh_run_record *item; /* ordered by method and formulation, the loosest tolerance first */
    size_t orders;
    nh_benchmark_order *order; /* those that were observed */
    size_t derivatives;
    nh_derivative *derivative;
    size_t fits;
    nh_fitted *fit;    /* ordered by number of functions and of samples */
    bool fits_partial; /* there was no time for all of them */
    size_t refused;
    const char **refusal; /* "energy-preserving: it would converge ..." */
    bool partial;         /* the budget ended it */
    /* the two references do not agree well enough (options.benchmark_trusted): errors then say little, and no run
     * counts as accurate */
    bool doubtful;
    bool shortened; /* the motion did not reach the default final time, and a shorter one was taken */
};

/* Compares the integrators; the caller frees the result.  `budget`: seconds for the measurements.  NULL with a message
 * when no motion can be computed. */
nh_benchmark *nh_benchmark_run(const nh_request *request, double budget, nh_error *error);
/* Its reference alone: no run. */
nh_benchmark *nh_benchmark_reference(const nh_request *request, double budget, nh_error *error);
void nh_benchmark_free(nh_benchmark *comparison);

/* The word of text and page, and that of JSON, which is older and stays for the scripts that read it. */
const char *nh_run_record_status_name(nh_run_record_status status);
const char *nh_run_record_status_json(nh_run_record_status status);

#endif
