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

/* A mark is filled, or pale, or hollow: not told apart from the reference. */
typedef enum { NH_MARK_FULL, NH_MARK_PALE, NH_MARK_HOLLOW } nh_mark_style;

typedef struct {
    const char *name;
    size_t count;
    const double *x, *y; /* x[i * x_stride], y[i * y_stride] */
    size_t x_stride, y_stride;
    bool dots, marks;      /* points instead of a line; points on the line */
    const double *heading; /* NULL, or an angle per point with y_stride, which marks at equal steps show */
    /* Of a comparison.  `style`: how the mark of each point is drawn, in a shape of its own for every curve, with `dots`
     * without a line; `low`, `high`: the spread of each y; NULL: none.  `faint`: small grey points without a
     * name, behind the others; `front`: a broad line behind them; `expected`: a dashed grey line. */
    const nh_mark_style *style;
    const double *low, *high;
    bool faint, front, expected;
} nh_curve;

/* Rectangles around the points of a grid. */
typedef struct {
    size_t across, up;
    const double *x, *y; /* `across` and `up` values, ascending */
    char (*fill)[8];     /* "#0072B2", or "": none; fill[i * up + j] at (x[i], y[j]) */
} nh_cells;

typedef struct {
    const char *id, *title, *description, *x_label, *y_label;
    bool log_x, log_y, equal; /* equal: both axes have one scale */
    double floor;             /* with a logarithmic axis: smaller values are drawn there */
    /* what lies left of this value of x is shaded, with this name; 0: nothing */
    double shaded;
    const char *shaded_name;
    double tall; /* height in pixels; 0: as usual */
    bool close;  /* logarithmic axes end near the content, not at powers of ten */
    bool bare;   /* a part of a drawing: without the names of the curves above it, and with the drawing's letters */
    /* two values each that the axes must include, too: for plots side by side; or NULL */
    const double *also_x, *also_y;
    bool fan;   /* many curves of one quantity: thin, in one colour, without a legend */
    bool timed; /* x is the time: a page may move a cursor along it */
    /* points follow each other at equal times: drawn without corners, like those with `equal` */
    bool path;
    size_t curves;
    const nh_curve *curve;
    const nh_cells *cells; /* below the curves; or NULL */
    const nh_view *view;   /* bodies in space at time number `at` instead of curves, cells and axes; or NULL */
    size_t at;
} nh_plot;

/* The colour of curve number k. */
const char *nh_svg_colour(size_t k);

/* The names of the curves in rows of so many pixels; returns their height. */
double nh_svg_legend(const nh_plot *plot, double wide, nh_text *out);
/* Adds the plot as an SVG element. */
void nh_svg_plot(const nh_plot *plot, nh_text *out);
/* The contents alone, as a group. */
void nh_svg_picture(const nh_picture *picture, nh_text *out);
/* Does this text begin like the plot with that id? */
bool nh_svg_is_plot(const char *text, const char *id);

/* The range of the finite values; false when there are none. */
bool nh_svg_range(size_t count, const double *value, size_t stride, double *low, double *high);

#endif
