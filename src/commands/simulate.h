/* simulate: one motion with states, energy, currents, multipliers and observables. */
#ifndef NH_SIMULATE_H
#define NH_SIMULATE_H

#include "motion/validation.h"
#include "motion/ensemble_accuracy.h"
#include "commands/choice.h"
#include "commands/request.h"
#include "problem/observables.h"

/* A motion of a table. */
typedef struct {
    const char *initial, *from; /* as after --initial, or NULL; file and line */
    const char *name;           /* the values of its cells: "omega = 1, k = 2" */
    size_t settings;
    nh_setting *setting; /* values of the columns that are parameters */
} nh_simulate_row;

typedef struct nh_simulate_rows {
    size_t count, parameters; /* rows; columns that are parameters: the same in every row */
    nh_simulate_row *row;
} nh_simulate_rows;

/* An expression whose zeros along the motion are recorded, or end it. */
typedef struct {
    const char *name; /* as the user typed it, without the words behind it */
    bool section;     /* is it that of --section?  This is the last one */
    nh_event event;
} nh_simulated_event;

enum { NH_AXIS_TIME = -1 }; /* the time instead of a column */

struct nh_simulation {
    nh_arena *arena;
    nh_system *system;
    nh_analysis_file *analysis;
    nh_model *model;
    const char *method, *formulation;
    const char *scene; /* the smallest model in words; NULL: all states were integrated */
    /* the initial state that was chosen where none was given, as after --initial; NULL: it was given */
    const char *begin;
    /* which constraint between positions the initial position violates, and by how much; NULL: none */
    const char *violation;
    const char *assembled; /* how --project has moved the initial position, in words; NULL: it has not */
    /* where the velocities under `dependent:` are not determined at the start: which were taken; or NULL */
    const char *chosen;
    /* parameters and bodies without influence on the observables, in words; empty: all of them have */
    const char *idle;
    bool compared; /* the whole model was integrated too, because the motion is short */
    /* the least times of both, and the largest difference of the observables, relative to their size along the
     * motion */
    double scene_seconds, whole_seconds, whole_difference;
    long whole_evaluations;
    nh_observables columns; /* the drawing only if it was requested, at the end */
    size_t events;          /* those of --event, then that of --section */
    nh_simulated_event *event;
    bool has_section;
    bool has_axes;                 /* of --axes */
    int axis[2];                   /* columns of the picture; of a section, of --axes, or of several motions */
    const nh_simulate_rows *table; /* of the request */
    nh_motion *motion;             /* its states are those of the closed subsystem, where there is one */
    double *value;                 /* motion->count x columns.count, row by row */
    nh_programs *programs;         /* for a method with fixed steps */
    nh_trajectory *trajectory;     /* owns the last two */
    nh_trajectory *drawn;          /* the same motion with more outputs, for pictures; NULL: the table has enough */
    double tolerance, fixed_step;  /* fixed_step: of a method that has one; 0: steps follow the tolerance */
    nh_ensemble *ensemble;         /* an ensemble instead of motion, value and trajectory; NULL: one motion */
    bool checked, held;            /* an accuracy was requested; it was reached */
    const char *why;               /* then: by which method, or why not */
    nh_choice ways;                /* with an accuracy: the candidates */
    double deriving;               /* units of effort for the derivation of the model */
    nh_accuracy accuracy;          /* error of the one motion */
    nh_ensemble_accuracy accuracy_of_all; /* errors of the ensemble */
};

/* A file of comma-separated values with a line of names: coordinates, velocities (x' or x_dot) and parameters. */
bool nh_simulate_rows_read(nh_arena *arena, const nh_request *request, const char *path, nh_simulate_rows *rows,
                           nh_error *error);

/* Gives an error without a place the place of this row. */
void nh_simulate_row_blame(const nh_simulate_row *row, nh_error *error);

/* Computes the motion of a request; the caller frees it.  NULL with a message. */
nh_simulation *nh_simulation_create(const nh_request *request, nh_error *error);
/* Reads "phi=0, omega=2" as the initial state of an analysis file (to be resolved with a model).  `from`: its place,
 * for messages; NULL: --initial. */
nh_analysis_file *nh_simulate_initial(const char *from, const char *initial, nh_error *error);

/* The motion that pictures show. */
const nh_trajectory *nh_simulation_drawn(const nh_simulation *simulation);
/* Are both columns positions of one kind of unit, so that a picture of one against the other has one scale? */
bool nh_simulation_is_path(const nh_simulation *simulation, size_t x, size_t y);

/* The first part of a simulation, for a record that has an arena and nothing else: system, analysis, model, tolerance,
 * the initial state (one that satisfies the constraints where none is given) and the final time.  Call
 * nh_simulation_free in any case. */
bool nh_simulate_read(nh_simulation *simulation, const nh_request *request, nh_state *initial, double *until,
                      nh_error *error);

#endif
