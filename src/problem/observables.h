/* observables: quantities along a motion, for reports: states, energy, currents, multipliers, observables, and the
   picture. */
#ifndef NH_OBSERVABLES_H
#define NH_OBSERVABLES_H

#include "problem/analysis_file.h"

typedef enum {
    NH_TRACK_STATE,
    NH_TRACK_CURRENT,
    NH_TRACK_MULTIPLIER,
    NH_TRACK_ENERGY,
    NH_TRACK_WATCH,
    NH_TRACK_SHAPE
} nh_track_kind;

/* A quantity that is followed. */
typedef struct {
    const char *name;
    nh_track_kind kind;
    nh_ex value; /* in the chart */
} nh_track;

typedef struct {
    nh_arena *arena;
    const nh_model *model;
    size_t count, capacity;
    nh_track *track;
    size_t shapes;
    const nh_shape *shape; /* what is drawn; its numbers are the tracks of that kind, in order */
    const char *drawing;   /* whose drawing it is, in words: "as in the analysis file"; NULL: there is none */
} nh_observables;

/* An empty list that lives in the arena. */
nh_observables nh_observables_create(nh_arena *arena, const nh_model *model);
void nh_observables_add(nh_observables *tracks, const char *name, nh_track_kind kind, nh_ex value);
/* Adds the coordinates, then their velocities, then quasi-velocities, where the chart has them. */
void nh_observables_add_states(nh_observables *tracks);
/* Adds what the analysis file watches (NULL: nothing). */
void nh_observables_add_watches(nh_observables *tracks, const nh_analysis_file *analysis);
/* Adds the drawing: of the analysis file, else of the system, else that of drawing.h. */
void nh_observables_add_drawing(nh_observables *tracks, const nh_analysis_file *analysis);

#endif
