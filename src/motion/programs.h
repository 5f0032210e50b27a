/* programs: the functions of a model that methods with a fixed step evaluate, each compiled at its first use and kept
 * for every later run.  Derivatives are exact, by z = (q, w), column-major.  For models without implicit velocities. */
#ifndef NH_PROGRAMS_H
#define NH_PROGRAMS_H

#include "geometry/model.h"

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

#endif
