/* polyline: writes a line through very many points as the data of an SVG path, without points that are nearly on it: no
 * point left out is farther than a quarter of a pixel from the drawn line. */
#ifndef NH_POLYLINE_H
#define NH_POLYLINE_H

#include <stdbool.h>

#include "base/text.h"

/* Begins as {.out = text}. */
typedef struct {
    nh_text *out;
    bool on;
    size_t held; /* number of points since the last one written */
    /* the last point written; the newest; the range of directions, about `turn`, that pass all points between */
    double last[2], next[2], low, high, turn;
} nh_polyline;

/* Adds a point that is certainly kept; or one that is kept where the line bends. */
void nh_polyline_write(nh_polyline *line, double x, double y);
void nh_polyline_to(nh_polyline *line, double x, double y);
/* Ends the line; the next point begins another one. */
void nh_polyline_end(nh_polyline *line);

#endif
