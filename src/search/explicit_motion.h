/* explicit_motion: motions as formulas, by solving one equation after another.
 *
 * The motions are the integral curves of Gamma.  With one of the states (t, q, w) as their parameter s, another state u
 * obeys
 *
 *     du/ds = Gamma(u)/Gamma(s)
 *
 * A current gives u where it is linear, or quadratic, in u.  Where du/ds = A(s) u + B(s), with what is known of the
 * other states put in,
 *
 *     u = (c + int mu B ds)/mu,   mu = exp(-int A ds)
 *
 * and c, written in the states, is a current.  So one state follows after another, as far as the antiderivatives
 * (exact/antiderivative.h) have closed forms.  Where nothing else is left, an integral without closed form gets a name:
 * it is 0 where the motion starts, and constants that stand beside it come from the state there. */
#ifndef NH_EXPLICIT_MOTION_H
#define NH_EXPLICIT_MOTION_H

#include "base/option.h"
#include "integrals/points.h"

typedef struct {
    nh_ex symbol, value; /* C1; its value in the states */
    /* by an integration; else it is a current that was known, or one that a known current determines */
    bool integrated;
    bool at_start; /* its value is that of the state where the integrals are 0 */
} nh_motion_constant;

/* A root of a function of the parameter and constants: symbol^2 = square; the symbol's value in the states has the
   right sign. */
typedef struct {
    nh_ex symbol, square, value;
} nh_motion_root;

/* d symbol/ds = integrand, a function of s, constants, roots and earlier integrals. */
typedef struct {
    nh_ex symbol, integrand;
} nh_motion_integral;

/* search/motion_series.h */
struct nh_motion_series;

typedef struct nh_explicit_motion {
    size_t states, parameter, known; /* known: how many states are, with the parameter */
    const nh_ex *state;              /* t, q, w */
    /* in the parameter, the constants, the roots and the integrals; 0, the number, for those that are not known */
    const nh_ex *value;
    const bool *is_known;
    size_t constants, roots, integrals;
    nh_motion_constant *constant;
    nh_motion_root *root;
    nh_motion_integral *integral;
    bool proved; /* the known values satisfy the equations of motion, by differentiation and normal forms */
    const struct nh_motion_series *series; /* of the integrals, along the checked motion; NULL: none */
    const nh_ex *fixed;                    /* which parameters have their values (integrals/fixed.h); NULL: none */
    const char *region; /* where the constants are constant (integrals/region.h); NULL: along every motion */
} nh_explicit_motion;

/* What is known of expressions from other motions of the same model: currents are mostly the same ones. */
typedef struct {
    size_t count, capacity;
    struct nh_explicit_form **form; /* in the heap, what it points to in the arena */
} nh_explicit_forms;

void nh_explicit_forms_clear(nh_explicit_forms *forms);

/* What the motions are solved from. */
typedef struct {
    const nh_points *points; /* signs are those there */
    const nh_ex *fixed;      /* as in the result */
    size_t currents;         /* of the chart, that may be used */
    const nh_ex *current;
    bool linear;                     /* without roots and without integrals that have no closed form */
    const nh_explicit_motion *rival; /* a motion that needs more such integrals is of no use; NULL: none */
    bool combined; /* with combined coordinates (search/combined_coordinates.h), NULL where there are none */
    const nh_options *options;
    nh_explicit_forms *forms; /* of all requests with this arena */
} nh_explicit_request;

/* With this state as parameter.  With combined coordinates the constants alone are of use: `value` is in them.  NULL
 * where Gamma does not move the state.  In the arena. */
nh_explicit_motion *nh_explicit_motion_along(nh_arena *arena, const nh_model *model, const nh_explicit_request *request,
                                             size_t parameter);

#endif
