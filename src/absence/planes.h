/* planes: motions of one coordinate that leave all other letters of a shape at rest. */
#ifndef NH_ABSENCE_PLANES_H
#define NH_ABSENCE_PLANES_H

#include "absence/closed_shape.h"
#include "absence/curve_field.h"

/* The letters are z = T y + c with T a matrix of rationals: y[0] the moving coordinate, y[1] the velocity that moves
 * it, y[2..] normal, 0 on the plane.  T is a permutation but where x = y or x = -y is a plane. */
typedef struct {
    nh_ex *y;          /* symbols of the new letters; y[0] keeps the coordinate's symbol where it can */
    nh_ex *letter;     /* each old letter in terms of y */
    nh_ex *rate;       /* of y */
    nh_ex moving_rate; /* of y[0] on the plane: alpha(y[0]) y[1] */
    bool angle;        /* of y[0] */
    /* sqrt(y^2) is y on one plane, -y on another: where roots that are rational on the plane are positive */
    nh_curve_side side;
    bool generic;      /* the plane is invariant for all values of the parameters, not only for those given */
    const char *words; /* "x = 0", "theta = pi/2", "y = x"; with roots "x = 0, y > 0" */
} nh_plane;

/* All planes that zero tests find, in a fixed order; in the arena. */
size_t nh_planes_find(nh_arena *arena, const nh_closed_shape *shape, nh_plane **out);

#endif
