/* resonance: how many integrals a vector field can have near a point where it rests.
 *
 *     X(0) = 0,  A = DX(0) with the eigenvalues lambda_1 .. lambda_n
 *     at most n - dim_Q span(lambda) - j independent integrals are quotients of analytic functions at 0;
 *     j = 1 if A is not diagonalizable, else 0
 *
 * dim_Q span(lambda) is at least the dimension over F_p of the span of the roots of the characteristic polynomial in
 * F_(p^d), for each prime p that does not divide the leading coefficient of the primitive polynomial over Z: the
 * relations of the eigenvalues with whole coefficients are a saturated lattice, so that reduction keeps its rank.
 * [docs/method.md, "No other integral"] */
#ifndef NH_RESONANCE_H
#define NH_RESONANCE_H

#include <flint/fmpq_mat.h>

#include "absence/closed_shape.h"

typedef struct {
    const char *point;      /* "theta = 0, omega = 0": where the shape rests; NULL: of a matrix */
    bool steady;            /* a velocity is not 0 there: it rests while coordinates that are left out move */
    const nh_ex *value;     /* of the shape's letters there; NULL: of a matrix */
    const char *polynomial; /* characteristic, of the linear equations there: "lambda^3 - lambda - 1" */
    size_t letters;         /* n */
    size_t span;            /* at least the dimension over Q of the span of the eigenvalues */
    bool diagonalizable;    /* false: proved that it is not */
    size_t at_most;         /* independent integrals */
    ulong prime;            /* that shows it; 0: rational eigenvalues and square roots show more than any prime */
    bool divergence;        /* div X is not 0 there: no measure with a positive density of class C^1 exists near it */
} nh_resonance;

/* At most n - span - j integrals near 0 of x' = A x + ..; in the arena. */
nh_resonance *nh_resonance_of(nh_arena *arena, const fmpq_mat_t matrix);
/* At the states that zero tests find where all rates vanish and are analytic: coordinates 0, angles also pi, pi/2 and
 * -pi/2, velocities 0, or one of them 1 (a steady motion); parameters at their given values.  The strongest first;
 * without those that say nothing and those with equal linear equations.  The list is in the arena; returns its
 * length. */
size_t nh_resonance_find(nh_arena *arena, const nh_closed_shape *shape, nh_resonance ***out);

#endif
