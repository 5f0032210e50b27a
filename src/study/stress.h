/* stress: what the integrators do where methods fail.  Maps over one thing that is made worse, with one cell per value and method:
 *
 *     right     within the accuracy, and no guard complains
 *     warned    within it, but a guard complains
 *     caught    not within it, and a guard says so
 *     failed    the integrator gave up, or the model is refused, with a reason
 *     timeout   neither within its time
 *     wrong     not within the accuracy, and nothing says so
 *
 * Guards: the pivot of the chart, the drift of every known current, and a second run at a tenth of the tolerance.
 *
 * Maps: the time, ten to a thousand times longer; the size below which errors count as absolute, wrong by powers of ten, which is what badly
 * scaled units do; every parameter, made small and large (masses and lengths that vanish, stiffness); every angle of the initial state, turned once
 * around, in the chart of coordinate velocities. */
#ifndef NH_STRESS_H
#define NH_STRESS_H

#include "study/chart.h"

typedef struct {
    double at, second_at; /* on the axes; the second 0 where there is none */
    const char *method;
    nh_measured_status status;
    double error;      /* NAN where there is no reference or no result */
    const char *note;  /* which guard, or why it failed */
} nh_stress_cell;

typedef struct {
    const char *name, *axis, *second_axis; /* second_axis: NULL when there is one only */
    size_t methods, cells; /* cells: value by value, `methods` each */
    nh_stress_cell *cell;
} nh_stress_map;

typedef struct {
    nh_arena *arena;
    double tolerance, accuracy; /* of every run; what counts as right */
    size_t maps;
    nh_stress_map *map;
    size_t count[NH_WRONG + 1]; /* cells per status */
} nh_stress;

/* `over`: "NAME=LOW:HIGH" or "NAME=LOW:HIGH:VALUES", or two of them with a comma between: one map over these parameters, numbers of the initial state or
 * options instead of all others; NULL: all others.  `budget`: seconds for all.  NULL with a message when the system itself cannot be read.  The tolerance of
 * every run and the error that counts as right are request->options.stress_tolerance and stress_error. */
nh_stress *nh_stress_create(const nh_simulate_request *request, const char *over, double budget, nh_error *error);
void nh_stress_free(nh_stress *stress);

#endif
