/* shape: the shapes of the picture of a system in motion (docs/formats.md): `draw: [{wheel: [x, y, phi, r]}, ...]`, in a system file or an analysis file. */
#ifndef NH_SHAPE_H
#define NH_SHAPE_H

#include "system/deck.h"
#include "graph/dag.h"

enum { NH_SHAPE_NUMBERS = 4 };

/* point: x, y; arrow: x, y, heading; disc: x, y, radius; wheel, seen from above: x, y, heading, radius; segment: x1, y1, x2, y2. */
typedef enum { NH_SHAPE_POINT, NH_SHAPE_ARROW, NH_SHAPE_DISC, NH_SHAPE_WHEEL, NH_SHAPE_SEGMENT, NH_SHAPE_KINDS } nh_shape_kind;

typedef struct {
    nh_shape_kind kind;
    const char *name;              /* for people, or NULL */
    nh_ex value[NH_SHAPE_NUMBERS]; /* as many as nh_shape_numbers says */
} nh_shape;

const char *nh_shape_name(nh_shape_kind kind);
size_t nh_shape_numbers(nh_shape_kind kind);

/* One entry {kind: [expressions], name: ...} of a list `draw`.  `parse` reads each expression, with its own message where it cannot. */
typedef bool nh_shape_parse(void *context, const nh_deck_node *node, nh_ex *out);
bool nh_shape_read(const nh_deck *deck, const nh_deck_node *node, nh_shape_parse *parse, void *context, nh_shape *out, nh_error *error);

#endif
