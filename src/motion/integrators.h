/* integrators: motions of z' = f(t, z), one function for each library or family of methods; method.h lists them. */
#ifndef NH_INTEGRATORS_H
#define NH_INTEGRATORS_H

#include "geometry/model.h"

#include <stdbool.h>
#include <stddef.h>
#include "motion/motion.h"

/* The functions of a model that methods with a fixed step evaluate, each compiled at its first use and kept
 * for every later run.  Derivatives are exact, by z = (q, w), column-major.  For models without implicit velocities. */

typedef enum {
    NH_PROGRAM_RATE,     /* f (size) */
    NH_PROGRAM_FLOW,     /* f (size), df/dz (size x size) */
    NH_PROGRAM_MOMENTUM, /* rho, p, c = dL/dq + Q (m each), R (m x n, row-major), and d/dz of (rho, p, c) (3m x size) */
    NH_PROGRAM_PAIR,     /* R (m x n), M (n x n), G (n x n), row-major */
    NH_PROGRAM_GRADIENT, /* dE/dz (size), E, Gamma(E) */
    NH_PROGRAMS
} nh_program;

typedef struct nh_programs nh_programs;
/* Each program is compiled when it is first evaluated.  Keeps the model, which has to outlive it; the caller frees
 * it. */
nh_programs *nh_programs_create(const nh_model *model);
void nh_programs_free(nh_programs *programs);
const nh_model *nh_programs_model(const nh_programs *programs);

/* Values at (t, z), until the same program is evaluated again. */
const double *nh_programs_at(nh_programs *programs, nh_program which, double t, const double *z);
/* f (size), as a right-hand side of motion.h; the context is an nh_programs. */
bool nh_programs_rate(double t, const double *z, double *rate, void *programs);
/* The compiled program over points (t, q, w), for callers that evaluate it in other arithmetic. */
const nh_tape *nh_programs_tape(nh_programs *programs, nh_program which);
/* The fastest rate as a frequency: the largest |f_j| divided by the largest value that the chart allows z_j. */
double nh_programs_pace(const nh_model *model, const double *f);
/* Numbers of evaluations and of compiled programs so far. */
long nh_programs_evaluations(const nh_programs *programs);
size_t nh_programs_compiled(const nh_programs *programs);

/* ---- integrators ---- */

/* By CVODE [Hindmarsh2005], with dense output, events and a report of the reason when a motion ends early.
 *
 * Integrate from (times[0], initial) and report at times[0..count-1] (monotonic).  A motion that ends early is returned
 * with complete == false and a note; NULL only when nothing could be started (error says why). */
nh_motion *nh_cvode(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                    const nh_flow_options *options, nh_error *error);

/* Motions of z' = f(t, z) by ARKODE's Runge-Kutta pairs: explicit ones, and one with a diagonally implicit,
 * L-stable, stiffly accurate method for stiff equations.  Steps end at the output times: the interpolation of the pairs
 * has a lower order than their steps.  Guards are not watched.  [Hindmarsh2005] */

typedef enum { NH_DORMAND_PRINCE_5, NH_VERNER_6, NH_FEHLBERG_8, NH_ESDIRK_5 } nh_arkode_method;

/* Integrates as nh_flow does, by the pair of this name. */
nh_motion *nh_arkode(nh_arkode_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                     const double *times, const nh_flow_options *options, nh_error *error);

/* Motions of z' = f(t, z) by GSL's steppers: Runge-Kutta pairs of order 8 (Prince-Dormand) and 5 (Fehlberg),
 * and Adams's method with fixed-point iteration in Nordsieck form.  No Jacobian is needed; guards are not watched.
 *
 * A shorter step of the same method gives the states between two steps of a one-step method, so that output times do
 * not change the motion; Adams's method steps to every output time.
 * [Galassi2009] */

/* Its methods: identifier, the name in GSL. */
#define NH_GSL_ODEIV_TABLE(X)                                                                                          \
    X(NH_RK8PD, rk8pd)                                                                                                 \
    X(NH_RKF45, rkf45)                                                                                                 \
    X(NH_MSADAMS, msadams)
typedef enum {
#define X(method, name) method,
    NH_GSL_ODEIV_TABLE(X)
#undef X
} nh_gsl_odeiv_method;

/* Integrates as nh_flow does. */
nh_motion *nh_gsl_odeiv(nh_gsl_odeiv_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                        const double *times, const nh_flow_options *options, nh_error *error);

/* Implicit methods with a fixed step for the motions of a model, in its chart's z = (q, w).
 *
 * Each step solves for the point zm = (qm, wm) half-way, at tm = t + h/2, by Newton's method with exact derivatives:
 *
 * MIDPOINT          2 (zm - z0) = h f(tm, zm),  z1 = 2 zm - z0.  Order 2, symmetric; conserves quadratic currents.
 *
 * LAGRANGE_DALEMBERT  discrete Lagrange-d'Alembert principle with L_d = h L((q0 + q1)/2, (q1 - q0)/h)
 *                     [CortesMartinez2001]:
 *                       2 (qm - q0) = h rho(qm, wm),   R(q0,w0)^T [ p(q0,w0) + h/2 c(qm,wm) - p(qm,wm) ] = 0,
 *                     with c = dL/dq + Q; then q1 = 2 qm - q0, and w1 from
 *                                                    R(q1,w1)^T [ p(qm,wm) + h/2 c(qm,wm) - p(q1,w1) ] = 0.
 *
 * ENERGY            the almost-Poisson pair q' = R u, M w' = G u - R^T dE/dq, M u = dE/dw with R, M, G at the midpoint
 *                     of z0, z1 and the mean of grad E over the segment between them
 *                     [McLachlanQuispelRobidoux1999]: conserves E exactly.
 *                     The pair equals the equations of motion for homogeneous constraints without forces only;
 *                     elsewhere it would converge to a wrong motion, so that it is compared with them at the chart's
 *                     probes, and refused.
 *
 * `composed` makes order 4 of any of them: five steps of s, s, 1-4s, s, s times h, s = 1/(4 - 4^(1/3)) 
 * [Suzuki1990]. */

typedef enum { NH_MIDPOINT, NH_LAGRANGE_DALEMBERT, NH_ENERGY } nh_midpoint_rule;

/* NULL when the rule may be used with the model of these programs, otherwise why not. */
const char *nh_midpoint_refused(nh_programs *programs, nh_midpoint_rule rule);

/* Integrates as nh_flow does. options->step: the step, made a little smaller so that steps end at the output times. */
nh_motion *nh_midpoint(nh_programs *programs, nh_midpoint_rule rule, bool composed, const double *initial, size_t count,
                       const double *times, const nh_flow_options *options, nh_error *error);

/* Explicit Runge-Kutta methods with a fixed step that keep the energy [Ketcheson2019].
 *
 *     k_i = f(t + c_i h, z + h a_ij k_j),    d = b_i k_i,    z1 = z + g h d,    t1 = t + g h,    g near 1 with E(z1) =
 *     E(z at the start)
 *
 * With g h instead of h as the elapsed time the order of the method is unchanged.  The last step before an output is
 * repeated with another h until g h meets the time.  Where no g within a tenth of 1 keeps the energy, the step is
 * halved, at most three times. */

/* the classical method of order 4, and the pair of order 8 of tableau.h */
typedef enum { NH_RELAXATION_4, NH_RELAXATION_8 } nh_relaxation_rule;

/* NULL when the energy of the model is conserved and can be kept, otherwise why not. */
const char *nh_relaxation_refused(nh_programs *programs);

/* Integrates as nh_flow does. options->step: the step, made a little smaller so that steps end at the output times. */
nh_motion *nh_relaxation(nh_programs *programs, nh_relaxation_rule rule, const double *initial, size_t count,
                         const double *times, const nh_flow_options *options, nh_error *error);

/* The coefficients of GSL's explicit pair of order 8, read from the stepper itself, and its steps for many
   motions at once. */

enum { NH_MOST_STAGES = 16 };

typedef struct {
    int stages;
    double a[NH_MOST_STAGES][NH_MOST_STAGES], b[NH_MOST_STAGES], c[NH_MOST_STAGES];
    double e[NH_MOST_STAGES]; /* weights of the error estimate */
} nh_tableau;

/* Stage i: k_i = f(t + c_i h, z + h a_ij k_j);  the new state is z + h b_i k_i, its error h e_i k_i.  False when out of
   memory. */
bool nh_tableau_rk8pd(nh_tableau *tableau);

/* to = z + h (weight_j k_j summed over the stages), `count` numbers; k_j at k + j * stride. */
void nh_tableau_add(size_t count, int stages, const double *weight, double h, const double *k, size_t stride,
                    const double *z, double *to);

/* Of each lane, max_i |error_i| / (atol_i + rtol max(|z_i|, |next_i|)); state i of lane l at [i * lanes + l]. */
void nh_tableau_error(size_t kept, size_t lanes, double rtol, const double *atol, const double *error, const double *z,
                      const double *next, double *lane);

#endif
