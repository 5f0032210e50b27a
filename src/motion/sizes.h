/* sizes: how large each state of a motion has been so far, for errors that are relative to it, in whatever units the
 * states are measured.
 *
 * The error that a step may make in state i is rtol (|z_i| + part s_i), with s_i the largest |z_i| so far: beside the
 * size that a state has had, an error where it passes through zero says little; and a state that is 1e-12 now and grows
 * to 1 later must be right to its digits now.  A motion may start from zeros.  So s_i begins as the change of the state
 * within tau, the time in which the right-hand side changes by about its own size:
 *
 *     s_i = max(|z_i|, tau |f_i(t, z)|, tau |f_i(t + tau, z + tau f)|, ..),    tau |f_i(t + tau, z + tau f) - f_i(t,
 *     z)| <= max(|z_i|, tau |f_i|) for all i.
 *
 * and so on along Picard's iteration, as far as it moves states that were zero.  Nothing in it depends on units.
 *
 * A state that is zero but for rounding (v cos(pi/2), a link that hangs on others) has no digits to be kept.  Rounding
 * of the rates is measured along a short line (measure_rounding in sizes.c); what it makes of a state in a step is
 * always allowed, and a rate that it drowns moves nothing at the start. */
#ifndef NH_SIZES_H
#define NH_SIZES_H

#include "motion/motion.h"

typedef struct {
    const nh_flow_problem *problem;
    double part;             /* nh_flow_options.absolute */
    double *size, *rounding; /* of each state, and of its rate */
    double *reach;           /* what the sizes of the others can make of each state within tau */
    double *work, *start;    /* start: the rates there */
    double *normal;          /* 1: the state has been far larger than its rounding; 0 otherwise */
    double *line;            /* rates along a short line */
    const double *least;     /* nh_flow_options.least */
    double tau;              /* the time in which the right-hand side changes by about its own size at the start */
    double pace;             /* at most tau: not longer than the fast times of a stiff system, either */
    double step;             /* the last one */
    double last;             /* time of the last state */
    long followed, evaluations;
} nh_sizes;

/* Determines the sizes at the start of a motion.  False when the right-hand side cannot be evaluated there. */
bool nh_sizes_begin(nh_sizes *sizes, const nh_flow_problem *problem, double part, const double *z, double begin,
                    double end);
/* Uses given sizes instead (nh_flow_options.scale; NULL: all 1). */
void nh_sizes_given(nh_sizes *sizes, const nh_flow_problem *problem, const double *scale);
void nh_sizes_clear(nh_sizes *sizes);

/* Call after a step that led to z at time t. */
void nh_sizes_follow(nh_sizes *sizes, double t, const double *z);

/* The absolute error that a step may make in state i, whatever its value is now. */
double nh_sizes_absolute(const nh_sizes *sizes, double rtol, size_t i);

/* nh_sizes_begin or nh_sizes_given, as the options say. */
bool nh_sizes_open(nh_sizes *sizes, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                   size_t count, const double *times);

#endif
