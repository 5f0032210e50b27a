/* svg: plots with axes, ticks and a legend as stand-alone SVG elements.
 *
 * The colours are those of Okabe and Ito, which colour-blind readers can distinguish; lines also differ by their
 * dashes.  What is not finite interrupts a line.  Text is escaped.  Classes let a page change the colours of axes and
 * text; without a style sheet they are grey. */
#ifndef NH_SVG_H
#define NH_SVG_H

#include <stdbool.h>

#include "base/text.h"
#include "document/perspective.h"

typedef struct {
    const char *name;
    size_t count;
    const double *x, *y;         /* x[i * x_stride], y[i * y_stride] */
    size_t x_stride, y_stride;
    bool dots, marks;            /* points instead of a line; points on the line */
    const double *heading;       /* NULL, or an angle per point with y_stride: marks show it at equal steps */
} nh_curve;

/* Rectangles around the points of a grid. */
typedef struct {
    size_t across, up;
    const double *x, *y;         /* `across` and `up` of them, ascending */
    char (*fill)[8];             /* "#0072B2", or "": none; fill[i * up + j] at (x[i], y[j]) */
} nh_cells;

typedef struct {
    const char *id, *title, *description, *x_label, *y_label;
    bool log_x, log_y, equal;    /* equal: both axes have one scale */
    double floor;                /* with a logarithmic axis: smaller values are shown there */
    const double *also_x, *also_y; /* two values each that the axes hold, too: plots beside one another; or NULL */
    bool fan;                    /* many curves of one quantity: thin, in one colour, without a legend */
    bool timed;                  /* x is the time: a page may move a cursor along it */
    bool path;                   /* points follow one another at equal times: drawn without corners, as with `equal` */
    size_t curves;
    const nh_curve *curve;
    const nh_cells *cells;       /* under the curves; or NULL */
    const nh_view *view;         /* bodies in space at time number `at` instead of curves, cells and axes; or NULL */
    size_t at;
} nh_plot;

/* The colour of curve number k. */
const char *nh_svg_colour(size_t k);

void nh_svg_plot(const nh_plot *plot, nh_text *out);
/* The pieces alone, as a group. */
void nh_svg_picture(const nh_picture *picture, nh_text *out);
/* Does this text begin as the plot with that id does? */
bool nh_svg_is_plot(const char *text, const char *id);

/* The range of what is finite; false when there is none. */
bool nh_svg_range(size_t count, const double *value, size_t stride, double *low, double *high);

#endif
