/* benchmark_internal: formulations of one motion, and the judgement of a computed motion. */
#ifndef NH_BENCHMARK_INTERNAL_H
#define NH_BENCHMARK_INTERNAL_H

#include "motion/method.h"
#include "motion/projection.h"
#include "reduction/reduced.h"
#include "commands/benchmark.h"
#include "commands/reduce.h"
#include "search/grid.h"

enum {
    NH_BENCHMARK_OUTPUTS = 9,
    NH_BENCHMARK_LEVELS = 5,
    NH_BENCHMARK_FORMULATIONS = 3,
    NH_CHART_REDUCED = 4,
    NH_BENCHMARK_CANDIDATES = 64
};

typedef struct {
    const char *name;
    nh_model *model; /* NULL: all coordinates (q, v) */
    nh_dynamics *dynamics;
    nh_bordered *bordered;
    nh_programs *programs; /* of the model: for methods with a fixed step, compiled once for all runs */
    size_t size;
    double *z0, *scale;
    nh_flow_problem problem;
    bool breaks;              /* the chart ends on the way */
    nh_reduced_flow *reduced; /* reduced equations in (x, p), which have a reference of their own; NULL: not reduced */
    double *reference, *reference_scale, agreement; /* outputs x size; size; error of the reference, by two methods */
} nh_formulation;

/* The reference of every run: (q, v) at the output times, scales, and the currents as functions of (t, q, v). */
typedef struct {
    const nh_model *model;
    double times[NH_BENCHMARK_OUTPUTS], *state, *scale; /* outputs x 2m; 2m */
    size_t currents;
    const char **name;
    nh_ex *current; /* in the model's chart */
    nh_tape *tape;  /* currents, then d current_k / d y_j, over (t, q, v) */
    double *current_scale, *current_start;
} nh_reference_solution;

/* The formulation in a model's chart.  False when the initial state is refused. */
bool nh_formulation_open(nh_formulation *f, nh_model *model, const nh_state *initial, bool project, double absolute,
                         nh_arena *arena, nh_error *error);
/* The formulation in all coordinates, from the initial state of a formulation in a chart. */
bool nh_formulation_open_all(nh_formulation *f, nh_formulation *chart, double t, nh_arena *arena, nh_error *error);
void nh_formulation_close(nh_formulation *f);

/* Writes (q, v) of a motion of this formulation at its outputs into y (count x 2m); false where they cannot be
 * computed. */
bool nh_formulation_states(nh_formulation *f, const nh_motion *motion, double *y);

/* The currents that the system file knows and that are conserved, and the energy if it is.  Writes the names of those
 * that are not conserved, and returns their number (room for all known ones). */
size_t nh_reference_solution_currents(nh_reference_solution *y, nh_arena *arena, const char **varying);
/* The scales of the currents; called when the reference states are known. */
void nh_reference_solution_scales(nh_reference_solution *y, nh_arena *arena, double least);
void nh_reference_solution_close(nh_reference_solution *y);
/* The largest error over the first `count` outputs, and the drift of each current. */
double nh_reference_solution_error(const nh_reference_solution *y, size_t count, const double *states);
void nh_reference_solution_drifts(const nh_reference_solution *y, size_t count, const double *states, double *drift);

/* Compares exact derivatives and differences, in a chart. */
void nh_benchmark_derivatives(const nh_formulation *f, nh_benchmark *out);

/* For a motion in reduced equations: the largest error in (x, p), and the drift of the energy. */
double nh_reduced_error(const nh_formulation *f, const nh_motion *motion);
double nh_reduced_drift(nh_formulation *f, const nh_motion *motion);

/* A closed form of the system file at the output times. */
typedef struct {
    const nh_known_motion *motion;
    bool whole; /* it gives all coordinates */
    /* outputs x 2m, as in a reference solution; only the coordinates that it gives, and their velocities */
    double *state;
} nh_known_motions;

/* ---- one motion, ready to be computed by any method ---- */

typedef struct {
    const nh_method *method; /* NULL: multipliers by IDA */
    int index;               /* of the equations that IDA solves: 1 or 2 */
    size_t formulation;
    bool projected;
    double last; /* seconds of its last run with all repetitions */
    bool given_up;
} nh_candidate_run;

/* A comparison of methods in progress; it owns `out` until that is handed over. */
typedef struct {
    nh_benchmark *out;
    const nh_model *model;
    nh_model *other;
    nh_state initial;
    nh_reference_solution solution;
    size_t formulations, candidates, refusals; /* refusals: the capacity of out->refusal */
    /* formulations; the reduced ones come last */
    nh_formulation formulation[NH_BENCHMARK_FORMULATIONS + NH_CHART_REDUCED];
    nh_reduction *reduction;
    size_t closed_count;
    nh_known_motions *closed; /* those that apply to this initial state; true or not */
    size_t held_currents;     /* currents that a projection preserves */
    nh_ex *held;
    nh_candidate_run candidate[NH_BENCHMARK_CANDIDATES];
    nh_run_record *grid; /* candidates x levels */
    double begun, budget, deadline, absolute;
    /* limit of effort of a motion that decides what is compared, in place of the deadline: the same on every machine;
     * 0: the deadline */
    double effort;
    nh_options options;
    bool project, once;         /* the time does not matter; steps are limited instead */
    bool fit_alone, every_grid; /* the discrete problem alone, with more numbers of samples; on all kinds of grids */
    size_t reached;             /* outputs of the longest run of the reference */
    bool hurried;               /* the reference ran out of time */
} nh_benchmark_work;

/* Opens the system, formulations and charts of a request; close it also on failure (and free `out`). */
bool nh_benchmark_work_open(nh_benchmark_work *bench, const nh_request *request, double budget, nh_error *error);
/* The same without repetitions, with at most options.robustness_steps steps per motion, one coordinate of the initial
 * state changed, and velocities that satisfy the constraints there. */
bool nh_benchmark_work_open_once(nh_benchmark_work *bench, const nh_request *request, size_t coordinate, double turn,
                                 double budget, nh_error *error);
void nh_benchmark_work_close(nh_benchmark_work *bench);
/* The reference: in the chart; in all coordinates where the chart breaks down or the two methods disagree. */
bool nh_benchmark_work_reference(nh_benchmark_work *bench, nh_error *error);
/* Goes on without a reference: errors are then infinite, drifts those from the initial state. */
void nh_benchmark_work_no_reference(nh_benchmark_work *bench);
/* Adds a candidate; or a method that is not used, with the reason. */
void nh_benchmark_work_add(nh_benchmark_work *bench, const nh_method *method, size_t formulation);
void nh_benchmark_work_refuse(nh_benchmark_work *bench, const char *method, const char *why);
/* Runs one motion. */
void nh_benchmark_work_measure(nh_benchmark_work *bench, nh_candidate_run *candidate, double tolerance, double step,
                               nh_run_record *measured);
/* The record of a motion that is not run. */
void nh_benchmark_work_leave_out(nh_benchmark_work *bench, const nh_candidate_run *candidate, double tolerance,
                                 double step, const char *why, nh_run_record *measured);
/* Runs it again, for its time alone. */
void nh_benchmark_work_repeat(nh_benchmark_work *bench, const nh_candidate_run *candidate, nh_run_record *measured);
/* All candidates at all levels, and again for their times while the budget lasts; then what is said of them. */
void nh_benchmark_work_measure_all(nh_benchmark_work *bench);
/* Runs one motion that decides what is compared: it is limited by counted work, which corresponds to a part of the
 * budget.  NULL: the method refuses it. */
nh_motion *nh_benchmark_work_counted(nh_benchmark_work *bench, const nh_candidate_run *candidate, double tolerance,
                                     double part);
/* Did this or another limit end the motion?  The other one: does the chart end along it? */
bool nh_benchmark_work_out_of_time(nh_benchmark_work *bench, const nh_motion *motion);
bool nh_formulation_breaks_down(nh_formulation *f, const nh_motion *motion);
/* Runs the discrete problem on this grid, in about so many seconds. */
void nh_benchmark_fit(nh_benchmark_work *bench, const nh_grid *grid, double seconds);

/* Reads the closed forms of the system file that apply to the initial state. */
void nh_known_motions_open(nh_benchmark_work *bench);
/* The largest difference of one from these states, relative to their scales, and where it is (an index into them). */
double nh_closed_off(nh_benchmark_work *bench, const nh_known_motions *closed, double *states, size_t *worst);
/* Takes a closed form as the reference where it agrees with the present one; the others are refused. */
void nh_known_motions_use(nh_benchmark_work *bench);

/* Adds the stages of the system's reduction as further formulations, where there is time for it. */
void nh_benchmark_reduced(nh_benchmark_work *bench, const nh_request *request);

#endif
