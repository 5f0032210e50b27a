/* The curves of a comparison: marks of different shapes, spreads, the front of the best, what lies behind, and the part
 * of the axis that says nothing. */
#include <math.h>

#include "document/polyline.h"
#include "document/svg_internal.h"

enum { shapes = 6 };

/* Shapes of about the same area: the place of their first point, and the rest of their outline. */
static const struct {
    double x, y;
    const char *outline;
} shape[shapes] = {
    {-4, 0, "a4 4 0 1 0 8 0a4 4 0 1 0-8 0z"},
    {-3.6, -3.6, "h7.2v7.2h-7.2z"},
    {0, -4.8, "l4.7 8.4h-9.4z"},
    {0, -5.2, "l5.2 5.2l-5.2 5.2l-5.2-5.2z"},
    {0, 4.8, "l4.7-8.4h-9.4z"},
    {-4.4, -2.2, "l2.2-2.2l2.2 2.2l2.2-2.2l2.2 2.2l-2.2 2.2l2.2 2.2l-2.2 2.2l-2.2-2.2l-2.2 2.2l-2.2-2.2l2.2-2.2z"}};

static void outline(const nh_svg_canvas *c, size_t k, double x, double y)
{
    nh_text_addf(c->out, "M%.1f %.1f%s", x + shape[k % shapes].x, y + shape[k % shapes].y, shape[k % shapes].outline);
}

static void ink(const nh_svg_canvas *c, size_t k, nh_mark_style style)
{
    const char *shade = nh_svg_colour(k);
    nh_text_addf(c->out, "<path fill=\"%s\"", style == NH_MARK_HOLLOW ? "#fff" : shade);
    if (style == NH_MARK_HOLLOW) nh_text_addf(c->out, " stroke=\"%s\" stroke-width=\"1.2\"", shade);
    if (style == NH_MARK_PALE) nh_text_add(c->out, " fill-opacity=\"0.4\"");
    nh_text_add(c->out, " d=\"");
}

void nh_svg_mark(const nh_svg_canvas *c, size_t k, double x, double y)
{
    ink(c, k, NH_MARK_FULL);
    outline(c, k, x, y);
    nh_text_add(c->out, "\"/>");
}

static double within(const nh_svg_axis *a, double pixel)
{
    return fmin(fmax(pixel, fmin(a->from, a->to)), fmax(a->from, a->to));
}

static void spread(const nh_svg_canvas *c, const nh_curve *f, size_t i, double x)
{
    double low = f->low[i * f->y_stride], high = f->high[i * f->y_stride];
    if (!isfinite(low) || !isfinite(high) || !(low > 0)) return;
    double y0 = within(&c->y, nh_svg_place(&c->y, low)), y1 = within(&c->y, nh_svg_place(&c->y, high));
    if (y0 - y1 >= 1) nh_text_addf(c->out, "M%.1f %.1fV%.1fM%.1f %.1fh6M%.1f %.1fh6", x, y0, y1, x - 3, y0, x - 3, y1);
}

void nh_svg_marks(const nh_svg_canvas *c, const nh_curve *f, size_t k)
{
    double x, y;
    nh_text_addf(c->out, "<path fill=\"none\" stroke=\"%s\" d=\"", nh_svg_colour(k));
    for (size_t i = 0; i < f->count && f->low && f->high; i++)
        if (nh_svg_at(c, f, i, &x, &y)) spread(c, f, i, x);
    nh_text_add(c->out, "\"/>");
    for (int style = NH_MARK_FULL; style <= NH_MARK_HOLLOW; style++) {
        ink(c, k, (nh_mark_style)style);
        for (size_t i = 0; i < f->count; i++)
            if (f->style[i] == (nh_mark_style)style && nh_svg_at(c, f, i, &x, &y)) outline(c, k, x, y);
        nh_text_add(c->out, "\"/>");
    }
}

void nh_svg_faint(const nh_svg_canvas *c, const nh_curve *f)
{
    double x, y;
    nh_text_add(c->out, "<path fill=\"none\" stroke=\"#808080\" stroke-opacity=\"0.4\" stroke-width=\"3.4\" "
                        "stroke-linecap=\"round\" d=\"");
    for (size_t i = 0; i < f->count; i++)
        if (nh_svg_at(c, f, i, &x, &y)) nh_text_addf(c->out, "M%.1f %.1fh0", x, y);
    nh_text_add(c->out, "\"/>");
}

void nh_svg_front(const nh_svg_canvas *c, const nh_curve *f)
{
    double x, y;
    nh_polyline p = {.out = c->out};
    nh_text_addf(c->out, "<path fill=\"none\" stroke=\"#808080\" %s stroke-linejoin=\"round\" d=\"",
                 f->front ? "stroke-opacity=\"0.3\" stroke-width=\"8\" stroke-linecap=\"round\""
                          : "stroke-width=\"1.4\" stroke-dasharray=\"7 3\"");
    for (size_t i = 0; i < f->count; i++)
        if (nh_svg_at(c, f, i, &x, &y)) nh_polyline_write(&p, x, y);
    nh_polyline_end(&p);
    nh_text_add(c->out, "\"/>");
}

/* From the left end of the axis to `shaded`, with its name along the edge. */
void nh_svg_shade(const nh_svg_canvas *c)
{
    const nh_plot *p = c->plot;
    if (!(p->shaded > 0 && p->shaded > c->x.low)) return;
    double x = within(&c->x, nh_svg_place(&c->x, p->shaded));
    nh_text_addf(c->out,
                 "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"#808080\" "
                 "fill-opacity=\"0.16\"/>",
                 c->x.from, c->y.to, x - c->x.from, c->y.from - c->y.to);
    nh_text_addf(c->out, "<g transform=\"translate(%.1f %.1f) rotate(-90)\">", x - 5, c->y.to + 6);
    nh_svg_named(c, 0, 0, "end", "tick", p->shaded_name);
    nh_text_add(c->out, "</g>");
}
