/* points: samples of the constraint submanifold, in blocks that tapes can run over.
 *
 * Points where the equations of motion or a guard expression degenerate are rejected and counted.  Where only the chart
 * does, because a pivot of its elimination is near zero, the multiplier form takes over (geometry/bordered.h): there q'
 * and w' are values, not formulas. */
#ifndef NH_POINTS_H
#define NH_POINTS_H

#include "geometry/model.h"

typedef struct nh_points nh_points;
struct nh_points {
    size_t count, width; /* width = model->width */
    double **column;     /* column[j][p]: coordinate j of (t, q, w, u) at point p; rows padded to whole batches */
    /* per point: 1 / (1 + max|a| + max|v|), without units, so that equations are relative to the local speed */
    double *weight;
    size_t tried, not_finite, not_solved, degenerate; /* rejections by reason */
    /* points near where the chart breaks down; width + m + n columns: (t, q, w), q', w'; NULL: none */
    nh_points *beyond;
};

/* `stretch` widens the velocities' box (held-out points use 1.7).  NULL with a message when too few points are
   usable. */
nh_points *nh_points_create(const nh_model *model, size_t count, double stretch, uint64_t seed, nh_error *error);
/* The same with the points beyond the chart, as many as the sampling meets on the way. */
nh_points *nh_points_cover(const nh_model *model, size_t count, uint64_t seed, nh_error *error);
/* Those of the given points that are usable, which may be none: `rows` times (t, q, w, u), where u is where Newton's
 * method begins, or, with `velocities`, (t, q, v), which are moved to the nearest allowed velocities. */
nh_points *nh_points_given(const nh_model *model, size_t rows, bool velocities, const double *row);
/* Are velocities of all coordinates drawn for the model, and moved onto its constraints? */
bool nh_points_natural(const nh_model *model);
/* The box of (t, q, w, u) or, with `velocities`, of (t, q, v). */
void nh_points_box(const nh_model *model, bool velocities, double *low, double *high);
void nh_points_free(nh_points *points);
/* The number of points, including those beyond the chart. */
size_t nh_points_equations(const nh_points *points);

/* The values of n expressions in the model's symbols at all points, value[k * count + p]; not those beyond the chart.
 */
void nh_points_evaluate(const nh_points *points, const nh_model *model, size_t n, const nh_ex *e, double *value);

#endif
