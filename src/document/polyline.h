/* polyline: a line through very many points as the data of an SVG path, without those that lie on it: no point left out
   is farther than a quarter of a pixel from the line drawn. */
#ifndef NH_POLYLINE_H
#define NH_POLYLINE_H

#include <stdbool.h>

#include "base/text.h"

/* Begins as {.out = text}. */
typedef struct {
    nh_text *out;
    bool on;
    size_t held;                              /* points since the last one written */
    /* the last written; the newest; the directions that pass all between, about `turn` */
    double last[2], next[2], low, high, turn;
} nh_polyline;

/* The next point, kept for certain; or kept where the line bends. */
void nh_polyline_write(nh_polyline *line, double x, double y);
void nh_polyline_to(nh_polyline *line, double x, double y);
/* The line ends here; the next point begins another one. */
void nh_polyline_end(nh_polyline *line);

#endif
