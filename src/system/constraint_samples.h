/* constraint_samples: points (t, q, q') that satisfy the constraints, and the rank of the constraints at these
   points. */
#ifndef NH_CONSTRAINT_SAMPLES_H
#define NH_CONSTRAINT_SAMPLES_H

#include "evaluate/tape.h"
#include "system/system.h"

typedef struct {
    nh_system *system;
    size_t m, k, width; /* width = 1 + 2 m */
    nh_tape *tape;      /* f (k) and F = df/dv (k x m, row-major) as functions of (t, q, v) */
    nh_tape_work *work;
    double *out;
    double *point; /* count x width */
    double *F;     /* count x (k m), column-major k x m */
    double *unit;  /* m: nh_chart_unit of each coordinate */
    double *speed; /* m: half the width of the velocity's */
    double *size;  /* k: the largest |df/dv| speed at points that need not satisfy the constraints */
    size_t count;
    uint64_t seed;
    bool entire;  /* the constraints have no singular points */
    bool written; /* with the parameters at the values of the file */
} nh_constraint_samples;

/* Points for the first `constraints` of the system. */
void nh_constraint_samples_init(nh_constraint_samples *c, nh_system *system, size_t constraints, uint64_t seed);
/* For all constraints, with the parameters at the values of the file; false where these are the values in use. */
bool nh_constraint_samples_init_written(nh_constraint_samples *c, nh_system *system, uint64_t seed);
void nh_constraint_samples_clear(nh_constraint_samples *c);

/* The rank of df/dv of the first `rows` constraints by these velocities (NULL: by all m; index
 * m: the constraints at rest) at almost all positions and
 * times, modulo two primes and so without rounding.  False: not known, because a constraint is not linear in the
 * velocities, or an entry has no residues. */
bool nh_constraint_samples_rank(const nh_constraint_samples *c, size_t rows, size_t columns, const size_t *column,
                                size_t *rank);
/* Refuses constraints that depend on each other, contradict each other or leave no freedom; the message names the
 * constraint and the rank. */
bool nh_constraint_samples_check_rank(const nh_constraint_samples *c, uint64_t seed, nh_error *error);

#endif
