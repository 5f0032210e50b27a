/* svg_internal: what the parts of a plot share. */
#ifndef NH_SVG_INTERNAL_H
#define NH_SVG_INTERNAL_H

#include "document/svg.h"

/* Pixels: the width of a plot, and the margins beside its axes. */
enum { NH_SVG_WIDTH = 640, NH_SVG_LEFT = 74, NH_SVG_RIGHT = 22 };

/* One axis: maps the values low..high to the pixels from..to. */
typedef struct {
    double low, high, from, to;
    bool logarithmic;
} nh_svg_axis;

typedef struct {
    const nh_plot *plot;
    nh_text *out;
    nh_svg_axis x, y;
    double wide;           /* of the rows of names */
    double legend, height; /* of the rows of names above the axes, and of the whole, in pixels */
} nh_svg_canvas;

/* The pixel of a value. */
double nh_svg_place(const nh_svg_axis *axis, double value);

/* A text, in which the T of E_T becomes an index; the second writes Greek letters for their names, too. */
void nh_svg_label(const nh_svg_canvas *canvas, double x, double y, const char *anchor, const char *css,
                  const char *text);
void nh_svg_named(const nh_svg_canvas *canvas, double x, double y, const char *anchor, const char *css,
                  const char *name);

/* The curves of a comparison: the mark of curve number k, its spreads, the front and what lies behind. */
void nh_svg_mark(const nh_svg_canvas *canvas, size_t k, double x, double y);
void nh_svg_marks(const nh_svg_canvas *canvas, const nh_curve *curve, size_t k);
void nh_svg_faint(const nh_svg_canvas *canvas, const nh_curve *curve);
void nh_svg_front(const nh_svg_canvas *canvas, const nh_curve *curve);
void nh_svg_shade(const nh_svg_canvas *canvas);
/* Its place in pixels; false: it has none. */
bool nh_svg_at(const nh_svg_canvas *canvas, const nh_curve *curve, size_t i, double *x, double *y);

/* Sets the ranges of the axes by the content, and their place below the legend. */
void nh_svg_axes(nh_svg_canvas *canvas);
void nh_svg_axes_draw(const nh_svg_canvas *canvas);

#endif
