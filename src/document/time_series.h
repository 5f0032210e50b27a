/* time_series: one motion of an analysis or a simulation for documents: quantities over common times, and a drawing. */
#ifndef NH_TIME_SERIES_H
#define NH_TIME_SERIES_H

#include "base/json.h"
#include "search/analysis.h"
#include "commands/simulate.h"

typedef struct {
    const char *name;
    nh_track_kind kind;
    const double *value; /* value[i * stride] at time[i] */
    size_t stride;
} nh_line;

typedef struct {
    const nh_model *model;
    size_t count;
    const double *time;
    size_t lines;
    nh_line *line;
    size_t shapes;
    const nh_shape *shape; /* the numbers of a shape are the lines of its kind, in order */
    const char *drawing;   /* the subject of the drawing, in words */
    bool drifts_elsewhere; /* the document says beside each current how far it drifts */
} nh_time_series;

/* NULL when there is no motion.  The result or the simulation keeps the numbers. */
nh_time_series *nh_time_series_of_analysis(const nh_analysis *result);
nh_time_series *nh_time_series_of_simulation(const nh_simulation *simulation);
void nh_time_series_free(nh_time_series *course);

/* Number j of shape i. */
const nh_line *nh_time_series_shape(const nh_time_series *course, size_t i, size_t j);

/* The lines of one kind as {name: [numbers]}; the drawing as [{kind, a, b, ...}]. */
nh_json *nh_time_series_json(const nh_time_series *course, nh_json *to, const char *key, nh_track_kind kind);
void nh_time_series_json_drawing(const nh_time_series *course, nh_json *to);

#endif
