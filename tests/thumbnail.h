/* thumbnail: a motion as a small picture: paths, and the system at their end. */
#ifndef NH_TESTS_THUMBNAIL_H
#define NH_TESTS_THUMBNAIL_H

#include <math.h>
#include <stdlib.h>

#include "base/escape.h"
#include "base/memory.h"
#include "document/polyline.h"
#include "document/svg.h"
#include "document/time_series.h"

enum { thumbnail_wide = 240, thumbnail_high = 150, margin = 14, colours = 6 };

static const char *const colour[colours] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9"};

typedef struct {
    const nh_time_series *course;
    nh_text *out;
    size_t count;       /* times that are shown */
    double x, y, scale; /* the middle, and pixels per unit */
} portrait;

static inline double value(const portrait *p, size_t shape, size_t number, size_t i)
{
    const nh_line *line = nh_time_series_shape(p->course, shape, number);
    return line->value[i * line->stride];
}

static inline double across(const portrait *p, double x) { return thumbnail_wide / 2 + p->scale * (x - p->x); }
static inline double up(const portrait *p, double y) { return thumbnail_high / 2 - p->scale * (y - p->y); }

static inline void widen(double low[2], double high_end[2], double x, double y)
{
    if (!isfinite(x) || !isfinite(y)) return;
    low[0] = fmin(low[0], x), high_end[0] = fmax(high_end[0], x);
    low[1] = fmin(low[1], y), high_end[1] = fmax(high_end[1], y);
}

static inline int ascending(const void *a, const void *b)
{
    return (*(const double *)a > *(const double *)b) - (*(const double *)a < *(const double *)b);
}

/* A motion that runs away is shown until it is far from where it mostly is. */
static inline size_t until_far(const portrait *p)
{
    enum { far = 12 };
    const nh_time_series *c = p->course;
    double *away = nh_alloc_array(2 * c->count + 1, sizeof *away), *sorted = away + c->count;
    for (size_t s = 0; s < c->shapes; s++)
        for (size_t i = 0; i < c->count; i++)
            for (size_t n = nh_shape_in_space(c->shape[s].kind) ? 3 : 2; n-- > 0;)
                away[i] = fmax(away[i], fabs(value(p, s, n, i) - value(p, s, n, 0)));
    for (size_t i = 0; i < c->count; i++) sorted[i] = away[i];
    qsort(sorted, c->count, sizeof *sorted, ascending);
    size_t n = 1;
    while (n < c->count && away[n] <= far * sorted[c->count / 2]) n++;
    nh_free(away);
    return n;
}

/* Everything at these times must find room; a disc with its rim. */
static inline bool fit(portrait *p)
{
    const nh_time_series *c = p->course;
    double low[2] = {INFINITY, INFINITY}, top[2] = {-INFINITY, -INFINITY};
    for (size_t s = 0; s < c->shapes; s++)
        for (size_t i = 0; i < p->count; i++) {
            nh_shape_kind kind = c->shape[s].kind;
            double x = value(p, s, 0, i), y = value(p, s, 1, i),
                   r = kind == NH_SHAPE_DISC    ? fabs(value(p, s, 2, i))
                       : kind == NH_SHAPE_WHEEL ? fabs(value(p, s, 3, i))
                                                : 0;
            widen(low, top, x - r, y - r);
            widen(low, top, x + r, y + r);
            if (kind == NH_SHAPE_SEGMENT) widen(low, top, value(p, s, 2, i), value(p, s, 3, i));
        }
    if (!(top[0] >= low[0])) return false;
    double span = fmax(top[0] - low[0], top[1] - low[1]), least = span > 0 ? span / 50 : 1;
    p->x = (low[0] + top[0]) / 2;
    p->y = (low[1] + top[1]) / 2;
    p->scale =
        fmin((thumbnail_wide - 2 * margin) / fmax(top[0] - low[0], least), (thumbnail_high - 2 * margin) / fmax(top[1] - low[1], least));
    return true;
}

/* The path of a shape; of a segment's middle. A motion is given at many times: the points that lie on a line are left
   out. */
static inline void track(const portrait *p, size_t s)
{
    nh_polyline path = {.out = p->out};
    nh_text_addf(p->out, "<path fill=\"none\" stroke=\"%s\" stroke-width=\"1.2\" stroke-opacity=\"0.6\" d=\"",
                 colour[s % colours]);
    for (size_t i = 0; i < p->count; i++) {
        double x = value(p, s, 0, i), y = value(p, s, 1, i);
        if (p->course->shape[s].kind == NH_SHAPE_SEGMENT)
            x = (x + value(p, s, 2, i)) / 2, y = (y + value(p, s, 3, i)) / 2;
        x = across(p, x);
        y = up(p, y);
        if (isfinite(x) && isfinite(y)) nh_polyline_to(&path, x, y);
        else nh_polyline_end(&path);
    }
    nh_polyline_end(&path);
    nh_text_add(p->out, "\"/>\n");
}

static inline void line(const portrait *p, size_t s, double x1, double y1, double x2, double y2, double width)
{
    nh_text_addf(p->out,
                 "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%g\" "
                 "stroke-linecap=\"round\"/>\n",
                 across(p, x1), up(p, y1), across(p, x2), up(p, y2), colour[s % colours], width);
}

static inline void body(const portrait *p, size_t s)
{
    enum { dot = 3, nose = 16 };
    nh_shape_kind kind = p->course->shape[s].kind;
    double v[NH_SHAPE_NUMBERS];
    for (size_t j = 0; j < nh_shape_numbers(kind); j++) {
        v[j] = value(p, s, j, p->count - 1);
        if (!isfinite(v[j])) return;
    }
    if (kind == NH_SHAPE_SEGMENT) line(p, s, v[0], v[1], v[2], v[3], 2);
    if (kind == NH_SHAPE_WHEEL)
        line(p, s, v[0] - v[3] * cos(v[2]), v[1] - v[3] * sin(v[2]), v[0] + v[3] * cos(v[2]), v[1] + v[3] * sin(v[2]),
             4);
    if (kind == NH_SHAPE_ARROW)
        line(p, s, v[0], v[1], v[0] + nose / p->scale * cos(v[2]), v[1] + nose / p->scale * sin(v[2]), 2);
    if (kind == NH_SHAPE_POINT || kind == NH_SHAPE_ARROW)
        nh_text_addf(p->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%d\" fill=\"%s\"/>\n", across(p, v[0]), up(p, v[1]),
                     dot, colour[s % colours]);
    if (kind == NH_SHAPE_DISC)
        nh_text_addf(p->out,
                     "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%.1f\" fill=\"%s\" fill-opacity=\"0.15\" stroke=\"%s\"/>\n",
                     across(p, v[0]), up(p, v[1]), p->scale * fabs(v[2]), colour[s % colours], colour[s % colours]);
}

static inline void in_plane(const portrait *p)
{
    const nh_time_series *c = p->course;
    size_t segments = 0;
    for (size_t s = 0; s < c->shapes; s++) segments += c->shape[s].kind == NH_SHAPE_SEGMENT;
    for (size_t s = 0; s < c->shapes; s++) /* segments are rods between what moves; else they are the bodies */
        if (c->shape[s].kind != NH_SHAPE_SEGMENT || segments == c->shapes) track(p, s);
    for (size_t s = 0; s < c->shapes; s++) body(p, s);
}

static inline void in_space(const portrait *p, const nh_view *view)
{
    nh_picture picture = {0};
    nh_view_draw(view, p->count - 1, &picture);
    nh_svg_picture(&picture, p->out);
    nh_picture_clear(&picture);
}

/* A stand-alone SVG document of a few kilobytes, without axes, both on one scale; `title` is its text alternative.
   False when nothing is drawn. */
static inline bool thumbnail(const nh_time_series *c, const char *title, nh_text *out)
{
    portrait p = {.course = c, .out = out};
    p.count = until_far(&p);
    nh_view *view = nh_view_create(c, p.count, thumbnail_wide, thumbnail_high);
    if (!c->shapes || !(view || fit(&p))) return false;
    nh_text_addf(out,
                 "<svg xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" viewBox=\"0 0 %d %d\" width=\"%d\" "
                 "height=\"%d\"><title>",
                 thumbnail_wide, thumbnail_high, thumbnail_wide, thumbnail_high);
    nh_escape_xml(title, out);
    nh_text_addf(out, "</title>\n<rect width=\"%d\" height=\"%d\" rx=\"6\" fill=\"#fff\"/>\n", thumbnail_wide, thumbnail_high);
    if (view) in_space(&p, view);
    else in_plane(&p);
    nh_view_free(view);
    nh_text_add(out, "</svg>\n");
    return true;
}

#endif
