/* simulate: one motion with states, energy, currents, multipliers and observables. */
#ifndef NH_SIMULATE_H
#define NH_SIMULATE_H

#include "motion/validation.h"
#include "motion/ensemble_accuracy.h"
#include "commands/choice.h"
#include "problem/observables.h"

/* A motion of a table. */
typedef struct {
    const char *initial, *from; /* as behind --initial, or NULL; file and line */
    const char *name;           /* its cells: "omega = 1, k = 2" */
    size_t settings;
    nh_setting *setting;        /* of the columns that are parameters */
} nh_simulate_row;

typedef struct {
    size_t count, parameters;   /* rows; columns that are parameters: the same in every row */
    nh_simulate_row *row;
} nh_simulate_rows;

/* An expression whose zeros along the motion are recorded, or end it. */
typedef struct {
    const char *name; /* as it was typed, without the words behind it */
    bool section;     /* of --section: the last one */
    nh_event event;
} nh_simulated_event;

typedef struct {
    /* analysis may be NULL: its initial state, time and watched quantities are used */
    const char *system_path, *analysis_path;
    size_t settings;
    const nh_setting *setting;
    nh_chart_choice chart;
    /* "phi=0, omega=2", or NULL: that of the analysis file, else a state on the constraints */
    const char *initial;
    const char *from;                        /* where that is written, for messages; NULL: --initial */
    const char *watch;                       /* "y, T = m/2*v^2": only these, by the smallest model for them; or NULL */
    const char *event;   /* "y = 0, falling, stop; phi'": zeros that are recorded, or end the motion; or NULL */
    const char *section; /* "x, rising": a Poincare section; or NULL */
    const char *axes;    /* "y, y'": the columns of the picture; NULL: chosen */
    bool scene;                              /* the same with what the analysis file watches */
    bool draw;                               /* follow what is drawn, too (one motion with all columns) */
    /* project: velocities that violate the constraints are moved onto them */
    bool until_given, tolerance_given, project;
    double step;                             /* output spacing; 0: a hundredth of the time */
    const nh_method *method;                 /* NULL: the one that suits, or with an accuracy the cheapest */
    size_t methods;                          /* of a comparison: only these; 0: all */
    const nh_method *const *only;
    /* the error that is allowed in what is printed; 0: options.tolerance, unchecked */
    double accuracy;
    size_t ensemble;                         /* members; 0: one motion */
    const nh_simulate_rows *table;           /* their initial states; NULL: around the given one */
    /* of their initial states about the given one, relative to max(|z_i|, 1) */
    double spread;
    nh_options options;
} nh_simulate_request;

enum { NH_AXIS_TIME = -1 }; /* the time instead of a column */

struct nh_simulation {
    nh_arena *arena;
    nh_system *system;
    nh_analysis_file *analysis;
    nh_model *model;
    const char *method, *formulation;
    const char *scene;    /* the smallest model in words; NULL: all states were integrated */
    /* no initial state was given: the one that was chosen, as it is written behind --initial; NULL */
    const char *begin;
    /* the initial position violates a constraint between positions: which, and by how much; NULL */
    const char *astray;
    const char *idle;     /* parameters and bodies without influence on what is watched, in words; empty: all matter */
    bool compared;        /* the whole model was integrated too, because the motion is short */
    /* the least times of both, and how far what is watched is off, relative to its size along the motion */
    double scene_seconds, whole_seconds, whole_difference;
    long whole_evaluations;
    nh_observables columns;    /* with the drawing only where it was asked for, at the end */
    size_t events;             /* those of --event, then that of --section */
    nh_simulated_event *event;
    bool has_section;
    bool has_axes;        /* of --axes */
    int axis[2];          /* columns of the picture; of a section, of --axes, or of several motions */
    const nh_simulate_rows *table; /* of the request */
    nh_motion *motion;    /* its states are those of the scene, where there is one */
    double *value;        /* motion->count x columns.count, row by row */
    nh_programs *programs; /* of a method with fixed steps */
    nh_trajectory *trajectory; /* owns the last two */
    double tolerance;
    nh_ensemble *ensemble;     /* instead of motion, value and trajectory; NULL: one motion */
    bool checked, held;        /* an accuracy is requested; it was reached */
    const char *why;           /* then: by what, or why not */
    nh_choice ways;            /* with an accuracy: from what it was chosen */
    double deriving;           /* units of effort that the model took */
    nh_accuracy accuracy;                 /* of the one motion */
    nh_ensemble_accuracy accuracy_of_all; /* of the ensemble */
};

/* A file of comma-separated values with a line of names: coordinates, velocities (x' or x_dot) and parameters. */
bool nh_simulate_rows_read(nh_arena *arena, const nh_simulate_request *request, const char *path,
                           nh_simulate_rows *rows, nh_error *error);

/* An error without a place is that of this row. */
void nh_simulate_row_blame(const nh_simulate_row *row, nh_error *error);

nh_simulation *nh_simulation_create(const nh_simulate_request *request, nh_error *error);
/* "phi=0, omega=2" as the initial state of an analysis file (to be resolved with a model).  `from`: where it is
   written, for messages; NULL: --initial. */
nh_analysis_file *nh_simulate_initial(const char *from, const char *initial, nh_error *error);

/* Are both columns positions of one kind of unit, so that a picture of one against the other has one scale? */
bool nh_simulation_is_path(const nh_simulation *simulation, size_t x, size_t y);

/* The first part of it, into a simulation that has an arena and nothing else: system, analysis, model, tolerance, the
 * initial state (one on the constraints where none is given) and the final time.  Also on failure:
 * nh_simulation_free. */
bool nh_simulate_read(nh_simulation *simulation, const nh_simulate_request *request, nh_state *initial, double *until,
                      nh_error *error);

#endif
