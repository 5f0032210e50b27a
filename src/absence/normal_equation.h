/* normal_equation: the linear equation of motions near those of a plane, at one level of the energy, without the
 * directions that known integrals hold. */
#ifndef NH_NORMAL_EQUATION_H
#define NH_NORMAL_EQUATION_H

#include "absence/linear_equation.h"
#include "absence/planes.h"

typedef struct {
    const nh_plane *plane;
    const char *obstacle; /* why there is no equation, in words; or NULL */
    nh_ex level;          /* the rational value of the integral that determines the curve */
    const char *curve;    /* "x'^2 = 2/7 - x^2" at the level */
    nh_ex square;         /* its right side, if there is a curve */
    const char *variable; /* "y", "tan(theta/2)" */
    /* all letters are algebraic functions on the curve, and the integrals used, or all of them, have one value */
    bool single_valued, all_single_valued;
    bool all_algebraic; /* no integral contains an exponential, or a hyperbolic function */
    bool periodic;      /* the moving coordinate is an angle: integrals have period 2 pi in it */
    bool generic;       /* plane, integrals used and their number hold for all values of the parameters */
    size_t known;       /* integrals used, independent along the curve (the energy included): r */
    size_t *used;       /* their indices among those given; first the one that determines the curve */
    size_t unused;      /* given, with a differential along the curve that depends on those used, or has no value in its
                           * field */
    size_t dimension;   /* d = letters - 1 - known */
    size_t blocks;
    nh_linear_equation *block; /* the graded pieces of a triangular form; the sizes add to d, or to 2 d */
    bool doubled;              /* the coefficients are not rational: the equation beside its conjugate */
    bool triangular;           /* pieces of a triangular form, not a direct sum */
} nh_normal_equation;

/* Integrals that are single-valued near the curve and contain letters of the shape only: expressions in the chart.
 * `generic[i]`: it holds for all values of the parameters. */
typedef struct {
    size_t count;
    const nh_ex *integral;
    const bool *generic;
    size_t energy; /* the index of the one that determines the curve, or count: none */
} nh_known_integrals;

/* What an orbit of dimension `orbit` of the blocks' group says of the equation's own: at least so large a dimension. */
size_t nh_normal_equation_orbit(const nh_normal_equation *equation, size_t orbit);

/* The equation at the n-th level that is tried (n = 0, 1, ..); the caller clears it by nh_normal_equation_clear. */
nh_normal_equation *nh_normal_equation_of(nh_arena *arena, const nh_closed_shape *shape, const nh_plane *plane,
                                          const nh_known_integrals *known, size_t n);
void nh_normal_equation_clear(nh_normal_equation *equation); /* block is NULL then; their number stays */
/* Have both the same blocks, with as many integrals?  Planes that a reflection of the system exchanges often do. */
bool nh_normal_equation_equal(const nh_normal_equation *a, const nh_normal_equation *b);

#endif
