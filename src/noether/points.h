/* points: samples of the constraint submanifold, in blocks that tapes can run over.
 *
 * Points where the chart, the equations of motion or a guard expression degenerate are rejected and counted. */
#ifndef NH_POINTS_H
#define NH_POINTS_H

#include "geometry/model.h"

typedef struct {
    size_t count, width;      /* width = model->width */
    double **column;          /* column[j][p]: coordinate j of (t, q, w, u) at point p; rows padded to whole batches */
    double *weight;           /* per point: 1 / (1 + max|a| + max|v|), so that equations are relative to the local speed */
    size_t tried, not_finite, not_solved, degenerate; /* rejections by reason */
} nh_points;

/* `stretch` widens the velocities' box (held-out points use 1.7).  NULL with a message when too few points are usable. */
nh_points *nh_points_create(const nh_model *model, size_t count, double stretch, uint64_t seed, nh_error *error);
void nh_points_free(nh_points *points);

/* Run a tape (inputs: the model's symbols) over all points: out[k][p].  `out` rows must hold points->count values. */
void nh_points_run(const nh_points *points, const nh_tape *tape, double *const *out);

/* The same for a list of expressions, into one block value[k * count + p]. */
void nh_points_evaluate(const nh_points *points, const nh_model *model, size_t n, const nh_ex *e, double *value);

#endif
