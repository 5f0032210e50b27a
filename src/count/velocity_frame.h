/* velocity_frame: velocities f_i w_i that are nearly orthonormal.
 *
 *     M_ii = f_i^2 times what is no square
 *
 * In polar coordinates these are r' and r theta'.  Coefficients of integrals are simpler in them than in w: r^6
 * theta'^6 is a constant times (r theta')^6. */
#ifndef NH_VELOCITY_FRAME_H
#define NH_VELOCITY_FRAME_H

#include "count/graded_solver.h"
#include "count/jet_equations.h"

typedef struct {
    size_t n;
    bool trivial;         /* all factors are 1 */
    nh_ex *shown, *value; /* f_i: with parameters as symbols, and as it is evaluated */
} nh_velocity_frame;

/* The factors are registered for evaluation: choose a point afterwards. */
nh_velocity_frame nh_velocity_frame_of(nh_jet_equations *equations);
void nh_velocity_frame_clear(nh_velocity_frame *frame);

/* The product w^alpha in these velocities. */
nh_ex nh_velocity_frame_monomial(const nh_velocity_frame *frame, const nh_jet_equations *equations,
                                 const uint8_t *alpha);

/* Rewrites the series of solutions from coefficients of w^alpha to coefficients in the frame.  False: another point is
 * needed. */
bool nh_velocity_frame_apply(const nh_velocity_frame *frame, nh_jet_equations *equations, const nh_jet_ring *ring,
                             const nh_residue *coordinate, nh_graded_count *solutions, double *work);

#endif
