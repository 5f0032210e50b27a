/* simulate: one motion, with everything that is known along it. */
#ifndef NH_SIMULATE_H
#define NH_SIMULATE_H

#include "motion/drift.h"
#include "study/analysis.h"

typedef struct {
    const char *system_path, *analysis_path; /* analysis may be NULL: its initial state, time and watched quantities are used */
    size_t settings;
    const nh_setting *setting;
    nh_chart_choice chart;
    const char *initial;                     /* "phi=0, omega=2", or NULL */
    bool until_given, tolerance_given, project; /* project: velocities that violate the constraints are moved onto them */
    double step;                             /* output spacing; 0: a hundredth of the time */
    nh_options options;
} nh_simulate_request;

typedef enum { NH_COLUMN_STATE, NH_COLUMN_CURRENT, NH_COLUMN_MULTIPLIER, NH_COLUMN_ENERGY, NH_COLUMN_WATCH } nh_column_kind;

typedef struct {
    const char *name;
    nh_column_kind kind;
    nh_ex value;
} nh_simulated;

typedef struct {
    nh_arena *arena;
    nh_system *system;
    nh_analysis *analysis;
    nh_model *model;
    const char *formulation;
    size_t columns;
    nh_simulated *column;
    nh_motion *motion;
    double *value;        /* motion->count x columns, row by row */
    double tolerance;
} nh_simulation;

/* "phi=0, omega=2" as the initial state of an analysis file (to be resolved with a model). */
nh_analysis *nh_simulate_initial(nh_arena *arena, const char *initial, nh_error *error);

nh_simulation *nh_simulate(const nh_simulate_request *request, nh_error *error);
void nh_simulation_free(nh_simulation *simulation);

#endif
