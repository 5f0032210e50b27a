/* normal_equation_internal: what the sources of normal_equation.c share. */
#ifndef NH_NORMAL_EQUATION_INTERNAL_H
#define NH_NORMAL_EQUATION_INTERNAL_H

#include "absence/curve_value.h"
#include "absence/normal_equation.h"

/* The work on one plane at one level.  K: the field of the curve. */
typedef struct {
    nh_arena *arena;
    nh_dag *dag;
    const nh_closed_shape *shape;
    const nh_plane *plane;
    const nh_known_integrals *known;
    nh_normal_equation *out;
    nh_ex *integral;   /* known->count, in the letters of the plane, at the parameters' values */
    size_t determines; /* the integral that determines the curve */
    nh_curve_field field;
    nh_curve_place place;
    size_t normals;            /* letters - 2 */
    nh_curve_element rate;     /* of x, or of tan(x/2) */
    nh_curve_element *block;   /* normals x normals: d xi/dt = block xi */
    size_t held;               /* covectors of integrals, reduced */
    nh_curve_element *held_by; /* held x normals: 1 at its pivot, 0 at those of others */
    size_t *pivot;
    size_t free, *kept; /* the normal letters that are no pivots */
} nh_normal_work;

/* The level, the field and the texts of the curve; false with an obstacle. */
bool nh_normal_equation_curve(nh_normal_work *work, size_t n);
/* The normal block, and covectors of integrals that reduce it. */
bool nh_normal_equation_reduced(nh_normal_work *work);
/* Rational coefficients, and blocks. */
void nh_normal_equation_rational(nh_normal_work *work);
/* false, with the obstacle noted. */
bool nh_normal_equation_refuse(nh_normal_work *work, const char *why);

#endif
