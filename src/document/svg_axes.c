/* The axes of a plot: their ranges, their place, their ticks and labels. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "document/svg_internal.h"
#include "document/typeset.h"

enum { height = 300, top = 12, bottom = 46, most_ticks = 6 };

bool nh_svg_range(size_t count, const double *value, size_t stride, double *low, double *high)
{
    bool any = false;
    for (size_t i = 0; i < count; i++) {
        double v = value[i * stride];
        if (!isfinite(v)) continue;
        *low = any ? fmin(*low, v) : v;
        *high = any ? fmax(*high, v) : v;
        any = true;
    }
    return any;
}

double nh_svg_place(const nh_svg_axis *a, double v)
{
    double low = a->logarithmic ? log10(a->low) : a->low, high = a->logarithmic ? log10(a->high) : a->high;
    return a->from + (a->to - a->from) * ((a->logarithmic ? log10(v) : v) - low) / (high - low);
}

/* A step of 1, 2 or 5 times a power of ten that gives at most so many ticks. */
static double tick_step(double span, int most)
{
    double raw = span / most, power = pow(10, floor(log10(raw))), part = raw / power;
    return power * (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10);
}

static void widen(nh_svg_axis *a)
{
    double size = fmax(fabs(a->low), fabs(a->high)), span = a->high - a->low;
    if (!(span > 1e-5 * size)) span = size > 0 ? 0.1 * size : 1;
    else span = 0.05 * span;
    a->low -= span;
    a->high += span;
}

static void whole_decades(nh_svg_axis *a, double floor_value)
{
    a->logarithmic = true;
    a->low = pow(10, floor(log10(fmax(a->low, floor_value)) - 0.2));
    a->high = pow(10, ceil(log10(fmax(a->high, 10 * floor_value)) + 0.2));
}

/* A little beyond the content. */
static void close_decades(nh_svg_axis *a, double floor_value)
{
    static const double beyond = 1.7;
    a->logarithmic = true;
    a->low = fmax(a->low, floor_value) / beyond;
    a->high = fmax(a->high, floor_value) * beyond;
}

static void hold(nh_svg_axis *a, const double *also)
{
    for (size_t k = 0; also && k < 2; k++) {
        a->low = fmin(a->low, also[k]);
        a->high = fmax(a->high, also[k]);
    }
}

static void ranges(nh_svg_canvas *c)
{
    const nh_plot *p = c->plot;
    bool any = false;
    for (size_t k = 0; k < p->curves; k++) {
        const nh_curve *f = &p->curve[k];
        double x0, x1, y0, y1;
        if (!nh_svg_range(f->count, f->x, f->x_stride, &x0, &x1) ||
            !nh_svg_range(f->count, f->y, f->y_stride, &y0, &y1))
            continue;
        c->x.low = any ? fmin(c->x.low, x0) : x0;
        c->x.high = any ? fmax(c->x.high, x1) : x1;
        c->y.low = any ? fmin(c->y.low, y0) : y0;
        c->y.high = any ? fmax(c->y.high, y1) : y1;
        any = true;
    }
    if (p->cells) {
        nh_svg_range(p->cells->across, p->cells->x, 1, &c->x.low, &c->x.high);
        nh_svg_range(p->cells->up, p->cells->y, 1, &c->y.low, &c->y.high);
        any = true;
    }
    if (!any) c->x = (nh_svg_axis){0, 1, 0, 0, false}, c->y = c->x;
    hold(&c->x, p->also_x);
    hold(&c->y, p->also_y);
    void (*const logarithmic)(nh_svg_axis *, double) = p->close ? close_decades : whole_decades;
    if (p->log_x) logarithmic(&c->x, p->floor);
    else if (!p->timed || !(c->x.high > c->x.low)) widen(&c->x);
    if (p->log_y) logarithmic(&c->y, p->floor);
    else widen(&c->y);
}

/* Gives both axes one scale: the range of one of them is enlarged. */
static void equalise(nh_svg_canvas *c)
{
    double sx = (c->x.high - c->x.low) / (c->x.to - c->x.from), sy = (c->y.high - c->y.low) / (c->y.from - c->y.to),
           s = fmax(sx, sy);
    double x = (c->x.low + c->x.high) / 2, y = (c->y.low + c->y.high) / 2, half_x = s * (c->x.to - c->x.from) / 2,
           half_y = s * (c->y.from - c->y.to) / 2;
    c->x.low = x - half_x;
    c->x.high = x + half_x;
    c->y.low = y - half_y;
    c->y.high = y + half_y;
}

/* The height of a plot with equal scales: that of its content, within bounds. */
static double tall(const nh_svg_canvas *c)
{
    double wide = NH_SVG_WIDTH - NH_SVG_LEFT - NH_SVG_RIGHT,
           wanted = wide * (c->y.high - c->y.low) / (c->x.high - c->x.low);
    return fmax(0.95 * height, fmin(1.5 * height, wanted + top + bottom));
}

static void part(const nh_svg_canvas *c, const char *text, size_t length)
{
    nh_text piece;
    nh_text_init(&piece);
    nh_text_add_n(&piece, text, length);
    nh_escape_xml(nh_text_string(&piece), c->out);
    nh_text_clear(&piece);
}

/* The index of p_phi as a letter, too. */
static void subscript(const nh_svg_canvas *c, const char *text, size_t length)
{
    nh_text name, plain;
    nh_text_init(&name);
    nh_text_init(&plain);
    nh_text_add_n(&name, text, length);
    nh_typeset_plain(nh_text_string(&name), &plain);
    nh_escape_xml(nh_text_string(&plain), c->out);
    nh_text_clear(&plain);
    nh_text_clear(&name);
}

/* In E_T the T becomes an index, in wheel_left_joint left_joint. */
void nh_svg_label(const nh_svg_canvas *c, double x, double y, const char *anchor, const char *class, const char *text)
{
    static const char of_names[] = "_abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    const char *bar = strchr(text, '_');
    size_t index = bar && bar > text ? strspn(bar + 1, of_names) : 0;
    static const char alone[] = " font-size=\"12\" fill=\"#808080\" font-family=\"sans-serif\"";
    nh_text_addf(c->out, "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\"%s>", class, x, y, anchor,
                 c->plot->bare ? "" : alone);
    part(c, text, index ? (size_t)(bar - text) : strlen(text));
    if (index) {
        nh_text_add(c->out, "<tspan dy=\"0.3em\" font-size=\"75%\">");
        subscript(c, bar + 1, index);
        nh_text_add(c->out, "</tspan>");
        if (bar[1 + index]) nh_text_add(c->out, "<tspan dy=\"-0.225em\">");
        part(c, bar + 1 + index, strlen(bar + 1 + index));
        if (bar[1 + index]) nh_text_add(c->out, "</tspan>");
    }
    nh_text_add(c->out, "</text>");
}

/* The same with Greek letters for their names. */
void nh_svg_named(const nh_svg_canvas *c, double x, double y, const char *anchor, const char *class, const char *name)
{
    nh_text plain;
    nh_text_init(&plain);
    nh_typeset_plain(name, &plain);
    nh_svg_label(c, x, y, anchor, class, nh_text_string(&plain));
    nh_text_clear(&plain);
}

static void line(const nh_svg_canvas *c, double x1, double y1, double x2, double y2, const char *class)
{
    nh_text_addf(
        c->out,
        "<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#808080\" stroke-opacity=\"%s\"/>",
        class, x1, y1, x2, y2, strcmp(class, "grid") ? "1" : "0.25");
}

static void tick(const nh_svg_canvas *c, bool vertical, double v, const char *text)
{
    double at = nh_svg_place(vertical ? &c->y : &c->x, v);
    if (vertical) {
        line(c, c->x.from, at, c->x.to, at, "grid");
        nh_svg_label(c, c->x.from - 6, at + 4, "end", "tick", text);
    } else {
        line(c, at, c->y.from, at, c->y.to, "grid");
        nh_svg_label(c, at, c->y.from + 16, "middle", "tick", text);
    }
}

static void linear_ticks(const nh_svg_canvas *c, bool vertical)
{
    const nh_svg_axis *a = vertical ? &c->y : &c->x;
    double step = tick_step(a->high - a->low, vertical ? most_ticks : most_ticks + 2),
           first = ceil(a->low / step - 1e-9);
    if (!(fabs(first) < 1e9)) return;
    for (double i = first; i * step <= a->high + 1e-9 * step; i++) {
        char text[40];
        snprintf(text, sizeof text, "%.10g", i * step);
        if (strlen(text) > 9) snprintf(text, sizeof text, "%.6g", i * step);
        tick(c, vertical, i * step, i == 0 ? "0" : text);
    }
}

static void power_of_ten(int e, char *out, size_t size)
{
    static const char *const digit[] = {"\u2070", "\u00b9", "\u00b2", "\u00b3", "\u2074",
                                        "\u2075", "\u2076", "\u2077", "\u2078", "\u2079"};
    char digits[12];
    size_t at = (size_t)snprintf(out, size, e < 0 ? "10\u207b" : "10");
    snprintf(digits, sizeof digits, "%d", e < 0 ? -e : e);
    for (const char *c = digits; *c && at + 4 < size; c++)
        at += (size_t)snprintf(out + at, size - at, "%s", digit[*c - '0']);
}

static void decades(const nh_svg_canvas *c, bool vertical)
{
    const nh_svg_axis *a = vertical ? &c->y : &c->x;
    double first = ceil(log10(a->low) - 1e-9), last = floor(log10(a->high) + 1e-9),
           step = fmax(1, ceil((last - first) / (vertical ? most_ticks : most_ticks + 2)));
    for (double e = first; e <= last; e += step) {
        char text[40];
        power_of_ten((int)e, text, sizeof text);
        tick(c, vertical, pow(10, e), text);
    }
    if (last > first || !c->plot->close) return;
    for (double e = floor(log10(a->low)); e <= last + 1; e++) /* too few of them: between them, too */
        for (int part = 2; part <= 5; part += 3)
            if (part * pow(10, e) >= a->low && part * pow(10, e) <= a->high) {
                char text[60], power[40];
                power_of_ten((int)e, power, sizeof power);
                if (e >= 0 && e <= 3) snprintf(text, sizeof text, "%.0f", part * pow(10, e));
                else snprintf(text, sizeof text, "%d\u00b7%s", part, power);
                tick(c, vertical, part * pow(10, e), text);
            }
}

void nh_svg_axes(nh_svg_canvas *c)
{
    const nh_plot *p = c->plot;
    ranges(c);
    c->height = c->legend + (p->equal ? tall(c) : p->tall > 0 ? p->tall : height);
    c->x.from = NH_SVG_LEFT;
    c->x.to = NH_SVG_WIDTH - NH_SVG_RIGHT;
    c->y.from = c->height - bottom;
    c->y.to = c->legend + top;
    if (p->equal) equalise(c);
}

void nh_svg_axes_draw(const nh_svg_canvas *c)
{
    const nh_plot *p = c->plot;
    if (p->log_x) decades(c, false);
    else linear_ticks(c, false);
    if (p->log_y) decades(c, true);
    else linear_ticks(c, true);
    line(c, c->x.from, c->y.from, c->x.to, c->y.from, "axis");
    line(c, c->x.from, c->y.from, c->x.from, c->y.to, "axis");
    nh_svg_named(c, (c->x.from + c->x.to) / 2, c->height - 10, "middle", "label", p->x_label);
    nh_text_addf(c->out, "<g transform=\"translate(14 %.1f) rotate(-90)\">", (c->y.from + c->y.to) / 2);
    nh_svg_named(c, 0, 0, "middle", "label", p->y_label);
    nh_text_add(c->out, "</g>");
}
