/* Plots for pgfplots: the document contains the data, and TeX draws them. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/tex_internal.h"

enum { most_points = 201, most_of_path = 601, marks = 16 };

/* The colours of Okabe and Ito, as in svg.c; lines also differ by their dashes. */
static const char *const styles[] = {"nhblue, solid",
                                     "nhred, dashed",
                                     "nhgreen, densely dotted",
                                     "nhpink, dash dot",
                                     "nhorange, loosely dashed",
                                     "nhsky, densely dashed",
                                     "gray, dash dot dot"};
enum { style_count = sizeof styles / sizeof *styles };
static const char *const shapes[] = {"*", "square*", "triangle*", "diamond*", "triangle*, mark options={rotate=180}",
                                     "x"};
enum { shape_count = sizeof shapes / sizeof *shapes };

static void coordinate(nh_tex_writer *w, double value)
{
    if (isfinite(value)) nh_text_addf(w->out, "%.6g", value);
    else nh_tex_add(w, "nan");
}

static void headings(nh_tex_writer *w, const nh_curve *f)
{
    size_t step = f->count / marks + 1;
    for (size_t i = 0; i < f->count; i += step) {
        double x = f->x[i * f->x_stride], y = f->y[i * f->y_stride],
               angle = f->heading[i * f->y_stride] * 180 / 3.14159265358979323846;
        if (!isfinite(x) || !isfinite(y) || !isfinite(angle)) continue;
        nh_text_addf(w->out, "\\draw[nhblue, -latex] (axis cs:%.6g,%.6g) -- ++(%.2f:9pt);\n", x, y, fmod(angle, 360));
    }
}

static void legend(nh_tex_writer *w, const nh_plot *p, const nh_curve *f)
{
    if (p->curves < 2) return;
    nh_tex_add(w, "\\addlegendentry{");
    nh_tex_name(w, f->name);
    nh_tex_add(w, "}\n");
}

/* Names in one row (-1), or as many in each row as the width of a page has room for. */
static int legend_columns(const nh_plot *p)
{
    enum { letters = 95, sign = 6 }; /* letters in a row of \footnotesize; width of the line before a name */
    size_t all = 0, longest = 0;
    for (size_t k = 0; k < p->curves; k++) {
        size_t length = strlen(p->curve[k].name) + sign;
        all += length;
        if (length > longest) longest = length;
    }
    return all <= letters ? -1 : longest < letters ? (int)(letters / longest) : 1;
}

/* The middle between this point of a grid and the one before, or the same distance beyond its ends. */
static double edge(const double *at, size_t count, size_t i)
{
    if (count < 2) return at[0] + (i ? 0.5 : -0.5);
    if (i == 0) return at[0] - (at[1] - at[0]) / 2;
    return i == count ? at[i - 1] + (at[i - 1] - at[i - 2]) / 2 : (at[i - 1] + at[i]) / 2;
}

/* The colours of the page, #rrggbb. */
static void cells(nh_tex_writer *w, const nh_cells *c)
{
    for (size_t i = 0; i < c->across; i++)
        for (size_t j = 0; j < c->up; j++) {
            unsigned red, green, blue;
            if (sscanf(c->fill[i * c->up + j], "#%2x%2x%2x", &red, &green, &blue) != 3) continue;
            nh_text_addf(
                w->out,
                "\\fill[fill={rgb,255:red,%u;green,%u;blue,%u}] (axis cs:%.6g,%.6g) rectangle (axis cs:%.6g,%.6g);\n",
                red, green, blue, edge(c->x, c->across, i), edge(c->y, c->up, j), edge(c->x, c->across, i + 1),
                edge(c->y, c->up, j + 1));
        }
}

/* A curve of a comparison, with its marks and spreads; or what lies behind. */
static void compared(nh_tex_writer *w, const nh_plot *p, const nh_curve *f, size_t k)
{
    const char *colour = styles[k % style_count];
    if (f->faint) nh_tex_add(w, "\\addplot[gray, only marks, mark=*, mark size=0.6pt, opacity=0.4, forget plot");
    else if (f->front) nh_tex_add(w, "\\addplot[gray, line width=4pt, opacity=0.3, line join=round");
    else if (f->expected) nh_tex_add(w, "\\addplot[gray, dashed");
    else
        nh_text_addf(w->out, "\\addplot[%.*s, thin, %smark=%s, mark size=1.7pt", (int)strcspn(colour, ","), colour,
                     f->dots ? "only marks, " : "", shapes[k % shape_count]);
    nh_tex_add(w, "] coordinates {");
    for (size_t i = 0; i < f->count; i++) nh_text_addf(w->out, "%s(%.6g,%.6g)", i % 8 ? " " : "\n", f->x[i], f->y[i]);
    nh_tex_add(w, "};\n");
    if (!f->faint) legend(w, p, f);
    for (size_t i = 0; i < f->count && !f->faint && !f->front && !f->expected; i++)
        if (isfinite(f->low[i]) && isfinite(f->high[i]))
            nh_text_addf(w->out, "\\draw[%.*s, thin, |-|] (axis cs:%.6g,%.6g) -- (axis cs:%.6g,%.6g);\n",
                         (int)strcspn(colour, ","), colour, f->x[i], f->low[i], f->x[i], f->high[i]);
}

static void shade(nh_tex_writer *w, const nh_plot *p)
{
    if (p->shaded > 0)
        nh_text_addf(w->out,
                     "\\fill[gray, opacity=0.16] (rel axis cs:0,0) rectangle ({axis cs:%.6g,1}|-{rel axis cs:0,1});\n",
                     p->shaded);
}

static void curve(nh_tex_writer *w, const nh_plot *p, const nh_curve *f, size_t k)
{
    if (f->style) {
        compared(w, p, f, k);
        return;
    }
    if (!f->count) { /* the name of a colour */
        if (f->name[0])
            nh_text_addf(w->out, "\\addlegendimage{%s, only marks, mark=square*}\n", styles[k % style_count]),
                legend(w, p, f);
        return;
    }
    size_t most = p->equal ? most_of_path : most_points, step = (f->count + most - 2) / (most - 1);
    if (step == 0) step = 1;
    nh_text_addf(w->out,
                 f->dots ? "\\addplot[%s, only marks, mark=%s, mark size=1.4pt] coordinates {"
                         : "\\addplot[%s, thick%s] coordinates {",
                 styles[k % style_count],
                 f->dots    ? k % 2 ? "o" : "*"
                 : p->equal ? ", smooth"
                            : "");
    for (size_t n = 0; f->count && n <= (f->count - 2 + step) / step; n++) { /* the last point, too */
        size_t i = n * step < f->count ? n * step : f->count - 1;
        double y = f->y[i * f->y_stride];
        nh_tex_add(w, n % 8 ? " (" : "\n(");
        coordinate(w, f->x[i * f->x_stride]);
        nh_tex_add(w, ",");
        coordinate(w, p->log_y && isfinite(y) ? fmax(y, p->floor) : y);
        nh_tex_add(w, ")");
    }
    nh_tex_add(w, "};\n");
    legend(w, p, f);
    if (f->heading) headings(w, f);
}

/* A quantity that is constant up to rounding needs a wider range. */
static void range(nh_tex_writer *w, const nh_plot *p, bool vertical)
{
    double low = INFINITY, high = -INFINITY;
    for (size_t k = 0; k < p->curves; k++) {
        const nh_curve *f = &p->curve[k];
        double a, b;
        if (!nh_svg_range(f->count, vertical ? f->y : f->x, vertical ? f->y_stride : f->x_stride, &a, &b)) continue;
        low = fmin(low, a);
        high = fmax(high, b);
    }
    const double *also = vertical ? p->also_y : p->also_x;
    if (also) low = fmin(low, also[0]), high = fmax(high, also[1]);
    double size = fmax(fabs(low), fabs(high));
    if (!also && (!isfinite(size) || high - low > 1e-4 * size)) return;
    if (also && (vertical ? p->log_y : p->log_x)) {
        nh_text_addf(w->out, ", %cmin=%.6g, %cmax=%.6g", vertical ? 'y' : 'x', low / 2, vertical ? 'y' : 'x', 2 * high);
        return;
    }
    double span = size > 0 ? 0.1 * size : 1;
    nh_text_addf(w->out, ", %cmin=%.6g, %cmax=%.6g", vertical ? 'y' : 'x', low - span, vertical ? 'y' : 'x',
                 high + span);
}

static void rgb(nh_tex_writer *w, const char *key, int colour)
{
    nh_text_addf(w->out, "%s={rgb,255:red,%d;green,%d;blue,%d}", key, colour >> 16 & 0xFF, colour >> 8 & 0xFF,
                 colour & 0xFF);
}

static void piece(nh_tex_writer *w, const nh_picture *picture, const nh_piece *e)
{
    static const double nearest = 3; /* pixels between two points of a long line */
    double last[2] = {0, 0};
    bool filled = e->fill >= 0;
    nh_tex_add(w, "\\path[");
    if (filled) rgb(w, "fill", e->fill), nh_text_addf(w->out, ", fill opacity=%.3g, ", e->fill_opacity);
    rgb(w, "draw", e->stroke);
    nh_text_addf(w->out, ", draw opacity=%.3g, line width=%.3gpt] ", e->stroke_opacity, e->width / 2);
    for (size_t i = e->first; i < e->first + e->points; i++) {
        const double *at = picture->point + 2 * i;
        bool end = i == e->first || i + 1 == e->first + e->points;
        if (!end && !filled && hypot(at[0] - last[0], at[1] - last[1]) < nearest) continue;
        nh_text_addf(w->out, "%s(%.1f,%.1f)", i > e->first ? "--" : "", at[0], at[1]);
        last[0] = at[0];
        last[1] = at[1];
    }
    nh_tex_add(w, e->closed ? "--cycle;\n" : ";\n");
}

/* As wide as the text; the pixels of the picture go down. */
static void bodies(nh_tex_writer *w, const nh_plot *p, const char *caption)
{
    nh_picture picture = {0};
    nh_view_draw(p->view, p->at, &picture);
    nh_text_addf(w->out,
                 "\\begin{center}\n\\begin{tikzpicture}[x={(%.6f\\linewidth,0)}, y={(0,-%.6f\\linewidth)}, line "
                 "join=round, line cap=round]\n\\clip (0,0) rectangle (%g,%g);\n",
                 0.9 / p->view->wide, 0.9 / p->view->wide, p->view->wide, p->view->high);
    for (size_t k = 0; k < picture.count; k++) piece(w, &picture, &picture.piece[k]);
    nh_picture_clear(&picture);
    nh_tex_add(w, "\\end{tikzpicture}\n\n{\\small ");
    nh_tex_words(w, caption);
    nh_tex_add(w, "}\n\\end{center}\n");
}

void nh_tex_plot(nh_tex_writer *w, const nh_plot *p, const char *caption)
{
    if (p->view) {
        bodies(w, p, caption);
        return;
    }
    nh_text_addf(w->out,
                 "\\begin{center}\n\\begin{tikzpicture}\n\\begin{axis}[width=0.92\\linewidth, height=%s, xlabel={",
                 p->equal ? "0.6\\linewidth" : "5.2cm");
    nh_tex_name(w, p->x_label);
    nh_tex_add(w, "}, ylabel={");
    nh_tex_name(w, p->y_label);
    nh_tex_add(w, "}, grid=major, grid style={gray!25}, unbounded coords=jump, label style={font=\\small}, tick label "
                  "style={font=\\footnotesize}");
    nh_text_addf(w->out,
                 ", legend columns=%d, legend cell align=left, legend style={draw=none, font=\\footnotesize, "
                 "at={(0.5,1.03)}, anchor=south, /tikz/every even column/.append style={column sep=1em}}",
                 legend_columns(p));
    if (p->log_x) nh_tex_add(w, ", xmode=log");
    if (p->log_y) nh_tex_add(w, ", ymode=log");
    if (p->equal) nh_tex_add(w, ", axis equal");
    if (p->timed) nh_tex_add(w, ", enlarge x limits=false");
    if (p->cells)
        nh_text_addf(w->out, ", xmin=%.6g, xmax=%.6g, ymin=%.6g, ymax=%.6g", edge(p->cells->x, p->cells->across, 0),
                     edge(p->cells->x, p->cells->across, p->cells->across), edge(p->cells->y, p->cells->up, 0),
                     edge(p->cells->y, p->cells->up, p->cells->up));
    else if (!p->log_x || p->also_x) range(w, p, false);
    if ((!p->log_y || p->also_y) && !p->cells) range(w, p, true);
    nh_tex_add(w, "]\n");
    if (p->cells) cells(w, p->cells);
    shade(w, p);
    for (size_t i = 0, k = 0; i < p->curves; i++) {
        curve(w, p, &p->curve[i], k);
        k += !p->curve[i].faint && !p->curve[i].front && !p->curve[i].expected;
    }
    nh_tex_add(w, "\\end{axis}\n\\end{tikzpicture}\n\n{\\small ");
    nh_tex_words(w, caption);
    nh_tex_add(w, "}\n\\end{center}\n");
}
