/* closed_shape: the equations that are left when coordinates on which nothing else depends are left out. */
#ifndef NH_CLOSED_SHAPE_H
#define NH_CLOSED_SHAPE_H

#include "geometry/model.h"

typedef struct {
    const nh_model *model;
    size_t count, coordinates; /* letters: first the coordinates that are kept, then all independent velocities */
    nh_ex *letter, *rate;      /* rate: along Gamma, parameters as symbols */
    bool *angle;               /* the equations have period 2 pi in it, and know it by sines and cosines only */
    size_t left;
    nh_ex *left_out;      /* coordinates */
    const char *obstacle; /* why nothing can be said of this system, or NULL: explicit time, tables, .. */
} nh_closed_shape;

/* In the arena. */
nh_closed_shape *nh_closed_shape_of(nh_arena *arena, const nh_model *model);

#endif
