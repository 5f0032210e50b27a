#include "document/svg_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "document/polyline.h"
#include "document/typeset.h"

enum { legend_row = 18, colours = 7, most_points = 801 };

static const char *const colour[colours] = {"#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                            "#E69F00", "#56B4E9", "#7A7A7A"};
static const char *const dashes[] = {"none", "7 3", "2 3", "9 3 2 3", "14 4"};

bool nh_svg_at(const nh_svg_canvas *c, const nh_curve *f, size_t i, double *x, double *y)
{
    double v = f->y[i * f->y_stride];
    if (!isfinite(v) || !isfinite(f->x[i * f->x_stride])) return false;
    double u = f->x[i * f->x_stride];
    *x = nh_svg_place(&c->x, c->plot->log_x ? fmax(u, c->x.low) : u);
    *y = nh_svg_place(&c->y, c->plot->log_y ? fmax(v, c->y.low) : v);
    return true;
}

static void dots(const nh_svg_canvas *c, const nh_curve *f, size_t k)
{
    double x, y;
    for (size_t i = 0; i < f->count && c->plot->fan; i++)
        if (nh_svg_at(c, f, i, &x, &y))
            nh_text_addf(c->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"1.1\" fill=\"%s\"/>", x, y, colour[k % colours]);
    for (size_t i = 0; i < f->count && !c->plot->fan; i++)
        if (nh_svg_at(c, f, i, &x, &y))
            nh_text_addf(c->out,
                         "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.4\"/>", x,
                         y, k % 2 ? "4.6" : "2.6", k % 2 ? "none" : colour[k % colours], colour[k % colours]);
}

/* Triangles that point along the heading. */
static void headings(const nh_svg_canvas *c, const nh_curve *f, size_t k)
{
    enum { marks = 16, size = 9 };
    double x, y;
    size_t step = f->count / marks + 1;
    for (size_t i = 0; i < f->count; i += step) {
        double angle = f->heading[i * f->y_stride], a = size * cos(angle), b = -size * sin(angle);
        if (!nh_svg_at(c, f, i, &x, &y) || !isfinite(angle)) continue;
        nh_text_addf(c->out, "<path fill=\"%s\" d=\"M%.1f %.1fL%.1f %.1fL%.1f %.1fZ\"/>", colour[k % colours], x + a,
                     y + b, x - a / 2 + b / 2, y - b / 2 - a / 2, x - a / 2 - b / 2, y - b / 2 + a / 2);
    }
}

/* A path in the plane through points at equal time steps: a cubic in time between them (Catmull and Rom's), because
 * corners would be an artefact of the drawing. */
static void smooth(const nh_svg_canvas *c, const nh_curve *f)
{
    double p[4][2] = {{0}};
    for (size_t i = 0; i + 1 < f->count; i++) {
        bool on = true, first = i == 0, last = i + 2 == f->count, known;
        for (size_t j = 0; j < 4; j++) {
            size_t at = i + j - (j > 0 || !first); /* the ends count twice */
            if (j == 3 && last) at = i + 1;
            known = nh_svg_at(c, f, at, &p[j][0], &p[j][1]);
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

static void curve(const nh_svg_canvas *c, const nh_curve *f, size_t k)
{
    double x, y;
    bool thin = f->count > most_points;
    if (c->plot->fan) k = 0;
    nh_text_addf(
        c->out,
        "<path fill=\"none\" stroke=\"%s\" stroke-width=\"%s\" stroke-linejoin=\"round\" stroke-dasharray=\"%s\" d=\"",
        colour[k % colours],
        c->plot->fan ? "0.9\" stroke-opacity=\"0.5"
        : f->style   ? "1.2\" stroke-opacity=\"0.55"
                     : "1.8",
        dashes[f->style ? 0 : k % (sizeof dashes / sizeof *dashes)]);
    nh_polyline p = {.out = c->out};
    bool cubic = (c->plot->equal || c->plot->path) && !thin && f->count > 3;
    if (cubic) smooth(c, f);
    for (size_t i = 0; i < f->count && !cubic; i++)
        if (!nh_svg_at(c, f, i, &x, &y)) nh_polyline_end(&p);
        else nh_polyline_to(&p, x, y);
    nh_polyline_end(&p);
    nh_text_add(c->out, "\"/>");
    if (f->heading) headings(c, f, k);
    if (f->style) nh_svg_marks(c, f, k);
    else if (f->marks) dots(c, f, k);
}

/* A cell extends from halfway to the point before to halfway to the next one. */
static double edge(const double *at, size_t n, size_t i, double low, double high)
{
    return i == 0 ? low : i == n ? high : 0.5 * (at[i - 1] + at[i]);
}

static void cells(const nh_svg_canvas *c, const nh_cells *g)
{
    for (size_t i = 0; i < g->across; i++)
        for (size_t j = 0; j < g->up; j++) {
            const char *fill = g->fill[i * g->up + j];
            double x0 = nh_svg_place(&c->x, edge(g->x, g->across, i, c->x.low, c->x.high)),
                   x1 = nh_svg_place(&c->x, edge(g->x, g->across, i + 1, c->x.low, c->x.high));
            double y0 = nh_svg_place(&c->y, edge(g->y, g->up, j + 1, c->y.low, c->y.high)),
                   y1 = nh_svg_place(&c->y, edge(g->y, g->up, j, c->y.low, c->y.high));
            if (fill[0])
                nh_text_addf(
                    c->out,
                    "<rect x=\"%.1f\" y=\"%.1f\" width=\"%.1f\" height=\"%.1f\" fill=\"%s\" fill-opacity=\"0.6\"/>", x0,
                    y0, x1 - x0, y1 - y0, fill);
        }
}

const char *nh_svg_colour(size_t k) { return colour[k % colours]; }

/* Room for a name in letters of 17 pixels, as on a phone; in a drawing, which no style sheet enlarges, of 13. */
static double written(const char *name, bool drawing)
{
    const double letter = drawing ? 7 : 9.2, capital = drawing ? 2.4 : 3.2; /* how much wider that is */
    double wide = letter * (double)nh_text_width(name);
    for (const char *c = name; *c; c++)
        if (*c >= 'A' && *c <= 'Z') wide += capital;
    return wide;
}

/* The sign of a curve beside its name. */
static void sign(const nh_svg_canvas *c, const nh_curve *f, size_t k, double x, double y)
{
    const char *shade = colour[k % colours];
    if (f->dots && !f->style) {
        nh_text_addf(c->out,
                     "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\" fill=\"%s\" stroke=\"%s\" stroke-width=\"1.4\"/>",
                     x + 11, y - 4, k % 2 ? "4.6" : "2.6", k % 2 ? "none" : shade, shade);
        return;
    }
    nh_text_addf(c->out, "<line x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"%s\" stroke-width=\"%s\" ", x,
                 y - 4, x + 24, y - 4, f->front || f->expected ? "#808080" : shade,
                 f->front   ? "8\" stroke-opacity=\"0.3"
                 : f->style ? "1.2\" stroke-opacity=\"0.55"
                            : "1.8");
    nh_text_addf(c->out, "stroke-dasharray=\"%s\"/>",
                 dashes[f->expected ? 1
                        : f->style  ? 0
                                    : k % (sizeof dashes / sizeof *dashes)]);
    if (f->style && !f->front && !f->expected) nh_svg_mark(c, k, x + 12, y - 4);
}

/* Rows of names above the plot; returns their height.  With `draw` false nothing is drawn. */
static double legend(const nh_svg_canvas *c, bool draw)
{
    double x = NH_SVG_LEFT, y = legend_row;
    if (c->plot->curves < 2 || c->plot->fan) return 0;
    for (size_t i = 0, k = 0; i < c->plot->curves; i++) {
        const nh_curve *f = &c->plot->curve[i];
        if (f->faint) continue;
        nh_text plain;
        nh_text_init(&plain);
        nh_typeset_plain(f->name, &plain);
        double room = 40 + written(nh_text_string(&plain), c->wide > NH_SVG_WIDTH);
        nh_text_clear(&plain);
        if (x + room > c->wide - NH_SVG_RIGHT && x > NH_SVG_LEFT) x = NH_SVG_LEFT, y += legend_row;
        if (draw) {
            sign(c, f, k, x, y);
            nh_svg_named(c, x + 28, y, "start", "legend", f->name);
        }
        x += room;
        k += !f->front && !f->expected;
    }
    return y;
}

double nh_svg_legend(const nh_plot *p, double wide, nh_text *out)
{
    const nh_svg_canvas c = {.plot = p, .out = out, .wide = wide};
    return legend(&c, true);
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

static void head(const nh_svg_canvas *c)
{
    const nh_plot *p = c->plot;
    begin(p->id, c->out);
    nh_text_addf(c->out, " viewBox=\"0 0 %d %.0f\" width=\"%d\" height=\"%.0f\"", NH_SVG_WIDTH, c->height, NH_SVG_WIDTH,
                 c->height);
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

static void bodies(nh_svg_canvas *c)
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
    nh_svg_label(c, beside, v->high - above, "start", "tick", pitch);
    nh_text_add(c->out, "</svg>\n");
}

void nh_svg_plot(const nh_plot *p, nh_text *out)
{
    nh_svg_canvas c = {.plot = p, .out = out, .wide = NH_SVG_WIDTH};
    if (p->view) {
        bodies(&c);
        return;
    }
    c.legend = p->bare ? 0 : legend(&c, false);
    nh_svg_axes(&c);
    head(&c);
    if (!p->bare) legend(&c, true);
    if (p->cells) cells(&c, p->cells);
    nh_svg_shade(&c);
    nh_svg_axes_draw(&c);
    for (size_t i = 0; i < p->curves; i++)
        if (p->curve[i].faint) nh_svg_faint(&c, &p->curve[i]);
        else if (p->curve[i].front || p->curve[i].expected) nh_svg_front(&c, &p->curve[i]);
    for (size_t i = 0, k = 0; i < p->curves; i++) {
        if (p->curve[i].faint || p->curve[i].front || p->curve[i].expected) continue;
        if (p->curve[i].dots && p->curve[i].style) nh_svg_marks(&c, &p->curve[i], k);
        else if (p->curve[i].dots) dots(&c, &p->curve[i], k);
        else curve(&c, &p->curve[i], k);
        k++;
    }
    if (p->timed)
        nh_text_addf(out,
                     "<line class=\"now\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\" stroke=\"#D55E00\" "
                     "visibility=\"hidden\"/>",
                     c.x.from, c.y.from, c.x.from, c.y.to);
    nh_text_add(out, "</svg>\n");
}
