/* resonance: how many integrals a vector field can have near a point where it rests. */
#ifndef NH_RESONANCE_H
#define NH_RESONANCE_H

#include <flint/fmpq_mat.h>

#include "absence/closed_shape.h"

typedef struct {
    const char *point;      /* "theta = 0, omega = 0": where the shape rests */
    const char *polynomial; /* characteristic, of the linear equations there */
    size_t letters;         /* n */
    size_t span;            /* at least the dimension over Q of the span of the eigenvalues */
    bool diagonalizable;    /* false: proved that it is not */
    size_t at_most;         /* independent integrals */
    ulong prime;
    bool divergence; /* div X is not 0 there: no measure with a positive density of class C^1 exists near it */
} nh_resonance;

/* At most n - span - j integrals near 0 of x' = A x + ..; in the arena. */
nh_resonance *nh_resonance_of(nh_arena *arena, const fmpq_mat_t matrix);
/* At the states of rest that zero tests find (0, pi/2, pi of angles, else 0); in the arena. */
size_t nh_resonance_find(nh_arena *arena, const nh_closed_shape *shape, nh_resonance ***out);

#endif
