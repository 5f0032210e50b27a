/* shape: what an analysis file asks to be drawn (docs/formats.md): `scene: {draw: [{wheel: [x, y, phi, r]}, ...]}`. */
#ifndef NH_SHAPE_H
#define NH_SHAPE_H

#include "expr/dag.h"

enum { NH_SHAPE_NUMBERS = 4 };

/* point: x, y; arrow: x, y, heading; disc: x, y, radius; wheel, seen from above: x, y, heading, radius; segment: x1, y1, x2, y2. */
typedef enum { NH_SHAPE_POINT, NH_SHAPE_ARROW, NH_SHAPE_DISC, NH_SHAPE_WHEEL, NH_SHAPE_SEGMENT, NH_SHAPE_KINDS } nh_shape_kind;

typedef struct {
    nh_shape_kind kind;
    nh_ex value[NH_SHAPE_NUMBERS]; /* as many as nh_shape_numbers says */
} nh_shape;

const char *nh_shape_name(nh_shape_kind kind);
size_t nh_shape_numbers(nh_shape_kind kind);

#endif
