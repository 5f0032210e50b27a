/* linear_motion_internal: a block of linear equations, and what its size makes of it. */
#ifndef NH_LINEAR_MOTION_INTERNAL_H
#define NH_LINEAR_MOTION_INTERNAL_H

#include "search/stage_solver.h"

enum { NH_LINEAR_MOTION_DRIVES = 12 /* functions of t in b and its derivatives */ };

typedef struct {
    nh_stage_solver *x;
    size_t size;       /* of z: */
    size_t places;     /* positions, and behind them velocities */
    nh_ex *z, *entry;  /* entry[i + j size]: A; 0 (the number) where there is none */
    nh_ex *b;          /* z' at z = 0 */
    size_t *block;     /* per variable: the first of its block */
    size_t count, *of; /* the variables of the present block */
    size_t drives;     /* 1 and the functions of t that terms of b and of its derivatives are multiples of */
    nh_ex drive[NH_LINEAR_MOTION_DRIVES];
    size_t forms; /* invariant quadratic forms of the present block */
    bool turns;   /* of the present rate: its imaginary part is meant */
} nh_linear_motion_block;

/* For z of this size, with nothing in it yet; nh_linear_motion_clear frees it. */
nh_linear_motion_block nh_linear_motion_create(nh_stage_solver *solver, size_t size, size_t places);
void nh_linear_motion_clear(nh_linear_motion_block *linear);
/* Sets the drives by b; false where they are too many. */
bool nh_linear_motion_drives(nh_linear_motion_block *linear);
/* Searches the currents of z' = A z + b, one block of A after another. */
void nh_linear_motion_solve(nh_linear_motion_block *linear);
/* Is z_i, a place, the integral of z_j alone: z_i' = z_j?  Writes j. */
bool nh_linear_motion_velocity(const nh_linear_motion_block *linear, size_t i, size_t *j);

/* exp(-re t) {cos(im t), sin(im t)}, or without the waves; their number. */
size_t nh_linear_motion_waves(nh_dag *dag, nh_ex t, nh_ex re, nh_ex im, nh_ex out[2]);
/* The currents in which these functions of t are the coefficients of the block's states; their number. */
size_t nh_linear_motion_solutions(const nh_linear_motion_block *block, size_t functions, const nh_ex *function);
/* Of a block of two, the functions of t that belong to lambda = T/2 +- sqrt(T^2/4 - D), with the trace T and the
 * determinant D; their number. */
size_t nh_linear_motion_waves_of_two(const nh_linear_motion_block *block, bool turns, nh_ex out[2]);
/* The block as two coordinates and their velocities; false where it is nothing of the kind. */
bool nh_linear_motion_complex_pair(const nh_linear_motion_block *block, nh_complex_pair *out);

#endif
