/* linear_motion_internal: a block of linear equations, and what its size makes of it. */
#ifndef NH_LINEAR_MOTION_INTERNAL_H
#define NH_LINEAR_MOTION_INTERNAL_H

#include "search/stage_solver.h"

enum { NH_LINEAR_MOTION_DRIVES = 12 /* functions of t in b and its derivatives */ };

typedef struct {
    nh_stage_solver *x;
    size_t size;       /* of z */
    nh_ex *z, *entry;  /* entry[i + j size]: A; 0 (the number) where there is none */
    nh_ex *b;          /* z' at z = 0 */
    size_t *block;     /* per variable: the first of its block */
    size_t count, *of; /* the variables of the present block */
    size_t drives;     /* 1 and the functions of t that terms of b and of its derivatives are multiples of */
    nh_ex drive[NH_LINEAR_MOTION_DRIVES];
    size_t forms;      /* invariant quadratic forms of the present block */
    bool turns;        /* of the present rate: its imaginary part is meant */
} nh_linear_motion_block;

/* exp(-re t) {cos(im t), sin(im t)}, or without the waves; their number. */
size_t nh_linear_motion_waves(nh_dag *dag, nh_ex t, nh_ex re, nh_ex im, nh_ex out[2]);
/* A block of two: lambda = T/2 +- sqrt(T^2/4 - D) with the trace T and the determinant D. */
nh_driven_pair nh_linear_motion_pair(const nh_linear_motion_block *block, bool turns);
size_t nh_linear_motion_waves_of_two(const nh_linear_motion_block *block, const nh_driven_pair *pair, nh_ex out[2]);
/* The block as two coordinates and their velocities; false where it is nothing of the kind. */
bool nh_linear_motion_complex_pair(const nh_linear_motion_block *block, nh_complex_pair *out);

#endif
