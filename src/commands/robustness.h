/* robustness: what the integrators do where methods fail.  Maps over one thing that is made worse, with one cell per
 * value and method:
 *
 *     accurate    within the accuracy, and no safeguard triggered
 *     flagged     within it, and a safeguard triggered
 *     detected    not within it, and a safeguard says so
 *     failed      the integrator gave up, or the model is refused, with a reason
 *     timeout     begun, and neither within its time
 *     undetected  not within the accuracy, and no safeguard triggered
 *     not run     the method refuses this system, or the budget was used up before
 *
 * Safeguards: the pivot of the chart, the drift of every known current, and a second run at a tenth of the tolerance.
 *
 * Maps: the time, ten to a thousand times longer, also by methods with a fixed step; the size below which errors count
 * as absolute, wrong by powers of ten, which is what badly scaled units do; every parameter, made small and large
 * (masses and lengths that vanish, stiffness); every angle of the initial state, turned once around, in the chart of
 * coordinate velocities; those that the system file names (`robustness`); and the discrete problem where it is hardly
 * determined (robustness_fit.c).  A motion that needs more than options.robustness_steps is out of time: a count, so
 * that a map is the same on a busy machine. */
#ifndef NH_ROBUSTNESS_H
#define NH_ROBUSTNESS_H

#include "commands/benchmark.h"

typedef struct {
    double at, second_at; /* values on the axes; the second is 0 where there is none */
    const char *method;
    nh_run_record_status status;
    /* error: NAN where there is no reference or no result.  For the discrete problem: rate of the null vectors, and
     * distance of known currents from their span, at other points. */
    double error;
    /* largest drift of a known current, NAN where none is known */
    double drift;
    const char *note; /* which safeguard triggered, or why the run failed */
} nh_robustness_cell;

typedef struct {
    const char *name, *axis, *second_axis; /* second_axis: NULL when there is only one */
    size_t methods, cells;                 /* cells: value by value, `methods` each */
    nh_robustness_cell *cell;
} nh_robustness_map;

typedef struct nh_robustness {
    nh_arena *arena;
    double tolerance, accuracy; /* of every run; and the error that counts as accurate */
    size_t maps;
    nh_robustness_map *map;
    size_t count[NH_RUN_STATUSES]; /* number of cells per status */
} nh_robustness;

/* `over`: "NAME=LOW:HIGH" or "NAME=LOW:HIGH:VALUES", or two of them with a comma between: one map over these
 * parameters, numbers of the initial state or options instead of all others; or the name of a map of the system file;
 * or "samples", the maps of the discrete problem; NULL: all.  `budget`: seconds for all, HUGE_VAL: only steps are
 * counted.  NULL with a message when the system itself cannot be read.  The tolerance of every run and the error that
 * counts as accurate are request->options.robustness_tolerance and robustness_error. */
nh_robustness *nh_robustness_create(const nh_request *request, const char *over, double budget, nh_error *error);
void nh_robustness_free(nh_robustness *maps);

/* A comparison of methods that includes these maps, each for half of the seconds; with `over` that map alone, without
 * the comparison, which is not what was asked.  0: 5 s for the methods, and the maps are limited by steps, so that they
 * are the same on a busy machine.  After an interruption there may be no maps. */
nh_benchmark *nh_robustness_benchmark(const nh_request *request, const char *over, double seconds, nh_error *error);

#endif
