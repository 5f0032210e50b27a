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
/* The same with the coordinates on which n functions of the chart depend, such as the energy of a falling body. */
nh_closed_shape *nh_closed_shape_keeping(nh_arena *arena, const nh_model *model, size_t n, const nh_ex *function);

/* Do n expressions contain the symbol in sines, cosines and tangents of whole multiples of it only, or not at all? */
bool nh_closed_shape_periodic(nh_dag *dag, size_t n, const nh_ex *e, nh_ex symbol);

#endif
