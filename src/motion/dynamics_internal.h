/* dynamics_internal: shared by dynamics.c and dynamics_start.c. */
#ifndef NH_DYNAMICS_INTERNAL_H
#define NH_DYNAMICS_INTERNAL_H

#include "motion/dynamics.h"

typedef struct nh_start nh_start; /* the constraints at a state, in all coordinates */

struct nh_dynamics {
    const nh_model *model;
    size_t m, n, size, width;
    nh_tape *rate, *jacobian, *velocity; /* jacobian: NULL where it is long; velocity: rho and R */
    nh_tape_work *rate_work, *jacobian_work, *velocity_work;
    double *point, *out, *dense;
    nh_tape *constraint; /* df^a/dv^s (k x m, row-major), of constraints without poles; NULL: no pivot to watch */
    nh_tape_work *constraint_work;
    double *slope; /* values of these derivatives, and the k x k part of the dependent velocities */
    double least;  /* the pivot at which the chart ends; it has the sign of the pivot at the start */
    size_t walls;  /* number of walls of the rates (exact/walls.h) */
    nh_tape *wall; /* NULL: there are none */
    nh_tape_work *wall_work;
    double patience;
    bool shares;     /* another nh_dynamics owns the tapes */
    nh_start *start; /* made for the first start */
};

void nh_dynamics_start_free(nh_start *start);

/* Values of n expressions of (t, q, v), and of quasi-velocities, which are taken as zero, at a state. */
void nh_singular_start_values(const nh_model *model, const nh_state *state, size_t n, const nh_ex *e, double *value);

/* rho and R of a model (R column-major, m x n), as functions of the chart's point. */
nh_tape *nh_dynamics_velocity_tape(const nh_model *model);

/* The largest |F_a R_i| / (|F_a| |R_i|): zero but for rounding where the formulas of the chart hold.  F: k x m, R: m x
 * n, both column-major. */
double nh_dynamics_digits_lost(const nh_model *model, const double *F, const double *R);
#define NH_CHART_DIGITS 1e-8 /* beyond it the formulas of a chart do not hold */

#endif
