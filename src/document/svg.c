#include "document/svg.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "document/polyline.h"
#include "document/typeset.h"

enum {
    width = 640,
    height = 300,
    left = 74,
    right = 22,
    top = 12,
    bottom = 46,
    legend_row = 18,
    colours = 7,
    most_ticks = 6,
    most_points = 801
};

static const char *const colour[colours] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                            "#E69F00", "#56B4E9", "#7A7A7A"};
static const char *const dashes[] = {"none", "7 3", "2 3", "9 3 2 3", "14 4"};

/* One axis: maps values to pixels. */
typedef struct {
    double low, high, from, to;
    bool logarithmic;
} axis;

typedef struct {
    const nh_plot *plot;
    nh_text *out;
    axis x, y;
    double legend, height;
} canvas;

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

static double place(const axis *a, double v)
{
    double low = a->logarithmic ? log10(a->low) : a->low, high = a->logarithmic ? log10(a->high) : a->high;
    return a->from + (a->to - a->from) * ((a->logarithmic ? log10(v) : v) - low) / (high - low);
}

/* ---- ranges and ticks ---- */

/* A step of 1, 2 or 5 times a power of ten that gives at most so many ticks. */
static double tick_step(double span, int most)
{
    double raw = span / most, power = pow(10, floor(log10(raw))), part = raw / power;
    return power * (part <= 1 ? 1 : part <= 2 ? 2 : part <= 5 ? 5 : 10);
}

static void widen(axis *a)
{
    double size = fmax(fabs(a->low), fabs(a->high)), span = a->high - a->low;
    if (!(span > 1e-5 * size)) span = size > 0 ? 0.1 * size : 1;
    else span = 0.05 * span;
    a->low -= span;
    a->high += span;
}

static void whole_decades(axis *a, double floor_value)
{
    a->logarithmic = true;
    a->low = pow(10, floor(log10(fmax(a->low, floor_value)) - 0.2));
    a->high = pow(10, ceil(log10(fmax(a->high, 10 * floor_value)) + 0.2));
}

static void hold(axis *a, const double *also)
{
    for (size_t k = 0; also && k < 2; k++) {
        a->low = fmin(a->low, also[k]);
        a->high = fmax(a->high, also[k]);
    }
}

static void ranges(canvas *c)
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
    if (!any) c->x = (axis){0, 1, 0, 0, false}, c->y = c->x;
    hold(&c->x, p->also_x);
    hold(&c->y, p->also_y);
    if (p->log_x) whole_decades(&c->x, p->floor);
    else if (!p->timed || !(c->x.high > c->x.low)) widen(&c->x);
    if (p->log_y) whole_decades(&c->y, p->floor);
    else widen(&c->y);
}

/* Gives both axes one scale: the range of one of them is enlarged. */
static void equalise(canvas *c)
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
static double tall(const canvas *c)
{
    double wide = width - left - right, wanted = wide * (c->y.high - c->y.low) / (c->x.high - c->x.low);
    return fmax(0.95 * height, fmin(1.5 * height, wanted + top + bottom));
}

static void part(const canvas *c, const char *text, size_t length)
{
    nh_text piece;
    nh_text_init(&piece);
    nh_text_add_n(&piece, text, length);
    nh_escape_xml(nh_text_string(&piece), c->out);
    nh_text_clear(&piece);
}

/* The index of p_phi as a letter, too. */
static void subscript(const canvas *c, const char *text, size_t length)
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

/* In E_T the T becomes an index. */
static void label(const canvas *c, double x, double y, const char *anchor, const char *class, const char *text)
{
    static const char alphanumeric[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789";
    const char *bar = strchr(text, '_');
    size_t index = bar && bar > text ? strspn(bar + 1, alphanumeric) : 0;
    nh_text_addf(c->out,
                 "<text class=\"%s\" x=\"%.1f\" y=\"%.1f\" text-anchor=\"%s\" font-size=\"12\" fill=\"#808080\" "
                 "font-family=\"sans-serif\">",
                 class, x, y, anchor);
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
static void named(const canvas *c, double x, double y, const char *anchor, const char *class, const char *name)
{
    nh_text plain;
    nh_text_init(&plain);
    nh_typeset_plain(name, &plain);
    label(c, x, y, anchor, class, nh_text_string(&plain));
    nh_text_clear(&plain);
}

static void line(const canvas *c, double x1, double y1, double x2, double y2, const char *class)
{
    nh_text_addf(
        c->out,
        "<line class=\"%s\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#808080\" stroke-opacity=\"%s\"/>",
        class, x1, y1, x2, y2, strcmp(class, "grid") ? "1" : "0.25");
}

static void tick(const canvas *c, bool vertical, double v, const char *text)
{
    double at = place(vertical ? &c->y : &c->x, v);
    if (vertical) {
        line(c, c->x.from, at, c->x.to, at, "grid");
        label(c, c->x.from - 6, at + 4, "end", "tick", text);
    } else {
        line(c, at, c->y.from, at, c->y.to, "grid");
        label(c, at, c->y.from + 16, "middle", "tick", text);
    }
}

static void linear_ticks(const canvas *c, bool vertical)
{
    const axis *a = vertical ? &c->y : &c->x;
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

static void decades(const canvas *c, bool vertical)
{
    const axis *a = vertical ? &c->y : &c->x;
    double first = ceil(log10(a->low) - 1e-9), last = floor(log10(a->high) + 1e-9),
           step = fmax(1, ceil((last - first) / (vertical ? most_ticks : most_ticks + 2)));
    for (double e = first; e <= last; e += step) {
        char text[40];
        power_of_ten((int)e, text, sizeof text);
        tick(c, vertical, pow(10, e), text);
    }
}

/* ---- curves ---- */

static bool visible(const canvas *c, const nh_curve *f, size_t i, double *x, double *y)
{
    double v = f->y[i * f->y_stride];
    if (!isfinite(v) || !isfinite(f->x[i * f->x_stride])) return false;
    double u = f->x[i * f->x_stride];
    *x = place(&c->x, c->plot->log_x ? fmax(u, c->x.low) : u);
    *y = place(&c->y, c->plot->log_y ? fmax(v, c->y.low) : v);
    return true;
}

static void dots(const canvas *c, const nh_curve *f, size_t k)
{
    double x, y;
    for (size_t i = 0; i < f->count && c->plot->fan; i++)
        if (visible(c, f, i, &x, &y))
            nh_text_addf(c->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"1.1\" fill=\"%s\"/>", x, y, colour[k % colours]);
    for (size_t i = 0; i < f->count && !c->plot->fan; i++)
        if (visible(c, f, i, &x, &y))
            nh_text_addf(c->out,
                         "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.4\"/>", x,
                         y, k % 2 ? "4.6" : "2.6", k % 2 ? "none" : colour[k % colours], colour[k % colours]);
}

/* Triangles that point along the heading. */
static void headings(const canvas *c, const nh_curve *f, size_t k)
{
    enum { marks = 16, size = 9 };
    double x, y;
    size_t step = f->count / marks + 1;
    for (size_t i = 0; i < f->count; i += step) {
        double angle = f->heading[i * f->y_stride], a = size * cos(angle), b = -size * sin(angle);
        if (!visible(c, f, i, &x, &y) || !isfinite(angle)) continue;
        nh_text_addf(c->out, "<path fill=\"%s\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"/>", colour[k % colours], x + a,
                     y + b, x - a / 2 + b / 2, y - b / 2 - a / 2, x - a / 2 - b / 2, y - b / 2 + a / 2);
    }
}

/* A path in the plane through points at equal time steps: a cubic in time between them (Catmull and Rom's), because
 * corners would be an artefact of the drawing. */
static void smooth(const canvas *c, const nh_curve *f)
{
    double p[4][2] = {{0}};
    for (size_t i = 0; i + 1 < f->count; i++) {
        bool on = true, first = i == 0, last = i + 2 == f->count, known;
        for (size_t j = 0; j < 4; j++) {
            size_t at = i + j - (j > 0 || !first); /* the ends count twice */
            if (j == 3 && last) at = i + 1;
            known = visible(c, f, at, &p[j][0], &p[j][1]);
            if (!known && (j == 1 || j == 2)) on = false;
            if (!known && j == 3) p[3][0] = p[2][0], p[3][1] = p[2][1];
            if (!known && j == 0) first = true;
        }
        if (!on) continue;
        if (first) p[0][0] = p[1][0], p[0][1] = p[1][1];
        if (first) nh_text_addf(c->out, "M%.1f %.1f", p[1][0], p[1][1]);
        nh_text_addf(c->out, "C%.1f %.1f %.1f %.1f %.1f %.1f", p[1][0] + (p[2][0] - p[0][0]) / 6,
                     p[1][1] + (p[2][1] - p[0][1]) / 6, p[2][0] - (p[3][0] - p[1][0]) / 6,
                     p[2][1] - (p[3][1] - p[1][1]) / 6, p[2][0], p[2][1]);
    }
}

static void curve(const canvas *c, const nh_curve *f, size_t k)
{
    double x, y;
    bool thin = f->count > most_points;
    if (c->plot->fan) k = 0;
    nh_text_addf(
        c->out,
        "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-linejoin=\"round\" stroke-dasharray=\"%s\" d=\"",
        colour[k % colours], c->plot->fan ? "0.9\" stroke-opacity=\"0.5" : "1.8",
        dashes[k % (sizeof dashes / sizeof *dashes)]);
    nh_polyline p = {.out = c->out};
    bool cubic = (c->plot->equal || c->plot->path) && !thin && f->count > 3;
    if (cubic) smooth(c, f);
    for (size_t i = 0; i < f->count && !cubic; i++)
        if (!visible(c, f, i, &x, &y)) nh_polyline_end(&p);
        else if (thin) nh_polyline_to(&p, x, y);
        else nh_polyline_write(&p, x, y);
    nh_polyline_end(&p);
    nh_text_add(c->out, "\"/>");
    if (f->heading) headings(c, f, k);
    if (f->marks) dots(c, f, k);
}

/* A cell extends from halfway to the point before to halfway to the next one. */
static double edge(const double *at, size_t n, size_t i, double low, double high)
{
    return i == 0 ? low : i == n ? high : 0.5 * (at[i - 1] + at[i]);
}

static void cells(const canvas *c, const nh_cells *g)
{
    for (size_t i = 0; i < g->across; i++)
        for (size_t j = 0; j < g->up; j++) {
            const char *fill = g->fill[i * g->up + j];
            double x0 = place(&c->x, edge(g->x, g->across, i, c->x.low, c->x.high)),
                   x1 = place(&c->x, edge(g->x, g->across, i + 1, c->x.low, c->x.high));
            double y0 = place(&c->y, edge(g->y, g->up, j + 1, c->y.low, c->y.high)),
                   y1 = place(&c->y, edge(g->y, g->up, j, c->y.low, c->y.high));
            if (fill[0])
                nh_text_addf(
                    c->out,
                    "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.6\"/>", x0,
                    y0, x1 - x0, y1 - y0, fill);
        }
}

const char *nh_svg_colour(size_t k) { return colour[k % colours]; }

/* Room for a name in letters of 17 pixels, as on a phone. */
static double written(const char *name)
{
    static const double letter = 9.2, capital = 3.2; /* how much wider that is */
    double wide = letter * (double)nh_text_width(name);
    for (const char *c = name; *c; c++)
        if (*c >= 'A' && *c <= 'Z') wide += capital;
    return wide;
}

/* Rows of names above the plot; returns their height.  With `draw` false nothing is drawn. */
static double legend(const canvas *c, bool draw)
{
    double x = left, y = legend_row;
    if (c->plot->curves < 2 || c->plot->fan) return 0;
    for (size_t k = 0; k < c->plot->curves; k++) {
        nh_text plain;
        nh_text_init(&plain);
        nh_typeset_plain(c->plot->curve[k].name, &plain);
        double room = 40 + written(nh_text_string(&plain));
        nh_text_clear(&plain);
        if (x + room > width - right && x > left) x = left, y += legend_row;
        if (draw) {
            bool is_dots = c->plot->curve[k].dots;
            if (is_dots)
                nh_text_addf(
                    c->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.4\"/>",
                    x + 11, y - 4, k % 2 ? "4.6" : "2.6", k % 2 ? "none" : colour[k % colours], colour[k % colours]);
            else
                nh_text_addf(c->out,
                             "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"1.8\" "
                             "stroke-dasharray=\"%s\"/>",
                             x, y - 4, x + 24, y - 4, colour[k % colours],
                             dashes[k % (sizeof dashes / sizeof *dashes)]);
            named(c, x + 28, y, "start", "legend", c->plot->curve[k].name);
        }
        x += room;
    }
    return y;
}

static void begin(const char *id, nh_text *out)
{
    nh_text_addf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"plot\" id=\"%s\" role=\"img\" aria-labelledby=\"%s-t %s-d\"",
        id, id, id);
}

bool nh_svg_is_plot(const char *text, const char *id)
{
    nh_text head;
    nh_text_init(&head);
    begin(id, &head);
    bool same = !strncmp(text, nh_text_string(&head), head.length);
    nh_text_clear(&head);
    return same;
}

static void head(const canvas *c)
{
    const nh_plot *p = c->plot;
    begin(p->id, c->out);
    nh_text_addf(c->out, " viewBox=\"0 0 %d %.0f\" width=\"%d\" height=\"%.0f\"", width, c->height, width, c->height);
    if (p->timed)
        nh_text_addf(c->out, " data-t0=\"%.9g\" data-t1=\"%.9g\" data-x0=\"%.1f\" data-x1=\"%.1f\"", c->x.low,
                     c->x.high, c->x.from, c->x.to);
    nh_text_addf(c->out, "><title id=\"%s-t\">", p->id);
    nh_escape_xml(p->title, c->out);
    nh_text_addf(c->out, "</title><desc id=\"%s-d\">", p->id);
    nh_escape_xml(p->description, c->out);
    nh_text_add(c->out, "</desc>");
}

static void stroke(const nh_piece *e, nh_text *out)
{
    if (e->fill < 0) nh_text_add(out, "fill=\"none\"");
    else nh_text_addf(out, "fill=\"#%06X\" fill-opacity=\"%.3g\"", (unsigned)e->fill, e->fill_opacity);
    nh_text_addf(out, " stroke=\"#%06X\" stroke-width=\"%.3g\"", (unsigned)e->stroke, e->width);
    if (e->stroke_opacity < 1) nh_text_addf(out, " stroke-opacity=\"%.3g\"", e->stroke_opacity);
}

static bool inked_alike(const nh_piece *a, const nh_piece *b)
{
    return a->fill < 0 && b->fill < 0 && a->stroke == b->stroke && a->stroke_opacity == b->stroke_opacity &&
           a->width == b->width && a->depth == b->depth;
}

void nh_svg_picture(const nh_picture *p, nh_text *out)
{
    nh_text_add(out, "<g stroke-linejoin=\"round\" stroke-linecap=\"round\">");
    for (size_t k = 0; k < p->count; k++) {
        const nh_piece *e = &p->piece[k];
        if (k == 0 || !inked_alike(&p->piece[k - 1], e)) {
            nh_text_add(out, k ? "\"/>\n<path " : "<path ");
            stroke(e, out);
            nh_text_add(out, " d=\"");
        }
        nh_polyline line = {.out = out};
        for (size_t i = e->first; i < e->first + e->points; i++)
            if (e->closed) nh_polyline_write(&line, p->point[2 * i], p->point[2 * i + 1]);
            else nh_polyline_to(&line, p->point[2 * i], p->point[2 * i + 1]);
        nh_polyline_end(&line);
        if (e->closed) nh_text_add(out, "Z");
    }
    nh_text_add(out, p->count ? "\"/></g>\n" : "</g>\n");
}

static void bodies(canvas *c)
{
    enum { beside = 12, above = 10 };
    const nh_view *v = c->plot->view;
    nh_picture picture = {0};
    char pitch[80];
    c->height = v->high;
    head(c);
    nh_view_draw(v, c->plot->at, &picture);
    nh_svg_picture(&picture, c->out);
    nh_picture_clear(&picture);
    snprintf(pitch, sizeof pitch, "squares of %.2g", v->pitch);
    label(c, beside, v->high - above, "start", "tick", pitch);
    nh_text_add(c->out, "</svg>\n");
}

void nh_svg_plot(const nh_plot *p, nh_text *out)
{
    canvas c = {.plot = p, .out = out};
    if (p->view) {
        bodies(&c);
        return;
    }
    ranges(&c);
    c.legend = legend(&c, false);
    c.height = c.legend + (p->equal ? tall(&c) : height);
    c.x.from = left;
    c.x.to = width - right;
    c.y.from = c.height - bottom;
    c.y.to = c.legend + top;
    if (p->equal) equalise(&c);
    head(&c);
    legend(&c, true);
    if (p->cells) cells(&c, p->cells);
    if (p->log_x) decades(&c, false);
    else linear_ticks(&c, false);
    if (p->log_y) decades(&c, true);
    else linear_ticks(&c, true);
    line(&c, c.x.from, c.y.from, c.x.to, c.y.from, "axis");
    line(&c, c.x.from, c.y.from, c.x.from, c.y.to, "axis");
    named(&c, (c.x.from + c.x.to) / 2, c.height - 10, "middle", "label", p->x_label);
    nh_text_addf(out, "<g transform=\"translate(14 %.1f) rotate(-90)\">", (c.y.from + c.y.to) / 2);
    named(&c, 0, 0, "middle", "label", p->y_label);
    nh_text_add(out, "</g>");
    for (size_t k = 0; k < p->curves; k++)
        if (p->curve[k].dots) dots(&c, &p->curve[k], k);
        else curve(&c, &p->curve[k], k);
    if (p->timed)
        nh_text_addf(out,
                     "<line class=\"now\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#D55E00\" "
                     "visibility=\"hidden\"/>",
                     c.x.from, c.y.from, c.x.from, c.y.to);
    nh_text_add(out, "</svg>\n");
}
