/* shape: the shapes of the picture of a system in motion (docs/formats.md): `draw: [{wheel: [x, y, phi, r]}, ...]`, in
   a system file or an analysis file. */
#ifndef NH_SHAPE_H
#define NH_SHAPE_H

#include "graph/expr.h"
#include "system/deck.h"
#include "system/screw.h"

enum { NH_SHAPE_NUMBERS = 12 };

/* In a plane: point: x, y; arrow: x, y, heading; disc: x, y, radius; wheel, seen from above: x, y, heading, radius;
 * segment: x1, y1, x2, y2. In space, the centre and sizes, then the first two axes of the body: ball: radius; cylinder:
 * radius, height along the third axis; box: edges. rod: its two ends. */
typedef enum {
    NH_SHAPE_POINT,
    NH_SHAPE_ARROW,
    NH_SHAPE_DISC,
    NH_SHAPE_WHEEL,
    NH_SHAPE_SEGMENT,
    NH_SHAPE_BALL,
    NH_SHAPE_CYLINDER,
    NH_SHAPE_BOX,
    NH_SHAPE_ROD,
    NH_SHAPE_KINDS
} nh_shape_kind;

typedef struct {
    nh_shape_kind kind;
    const char *name;              /* for the legend, or NULL */
    bool flat;                     /* only in the plane: it stands there for shapes that are drawn in space */
    nh_ex value[NH_SHAPE_NUMBERS]; /* as many as nh_shape_numbers says */
} nh_shape;

const char *nh_shape_name(nh_shape_kind kind);
size_t nh_shape_numbers(nh_shape_kind kind);
bool nh_shape_in_space(nh_shape_kind kind);

/* A body in space: its sizes, and the pose of its own frame with the origin at its centre. */
nh_shape nh_shape_solid(nh_shape_kind kind, const char *name, const nh_pose *pose, const nh_ex *size);

/* One entry {kind: [expressions], name: ...} of a list `draw`; of a body in space with `turn: [z: angle, ...]`.
 * `parse` reads each expression, with its own message where it cannot. */
typedef bool nh_shape_parse(void *context, const nh_deck_node *node, nh_ex *out);
bool nh_shape_read(const nh_deck *deck, const nh_deck_node *node, nh_dag *dag, nh_shape_parse *parse, void *context,
                   nh_shape *out, nh_error *error);

#endif
