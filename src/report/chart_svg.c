/* chart_svg: the comparison as a drawing, logarithmic on both axes: error to the left is better, time below is better. */
#include <math.h>
#include <string.h>

#include "report/chart.h"
#include "report/svg.h"

enum { wide = 1000, high = 560, left = 70, right = 330, top = 48, bottom = 56, line_height = 17, shades = 12 };
static const char *const colour[shades] = {"#1b6ca8", "#d1495b", "#2e933c", "#8e5ea2", "#c77c02", "#00798c",
                                           "#7a4419", "#e05780", "#4f5d75", "#6a994e", "#b23a48", "#3d348b"};

typedef struct {
    const nh_comparison *c;
    nh_text *out;
    double x0, x1, y0, y1; /* decades */
} drawing;

static bool shown(const nh_measured *m) { return m->status <= NH_WARNED && isfinite(m->error) && m->seconds > 0; }
/* An error below the reference's own is drawn at it. */
static double error_of(const drawing *d, const nh_measured *m) { return log10(fmax(fmax(m->error, d->c->agreement), 1e-16)); }
static double x_of(const drawing *d, double decade) { return left + (decade - d->x0) / (d->x1 - d->x0) * (wide - left - right); }
static double y_of(const drawing *d, double decade) { return high - bottom - (decade - d->y0) / (d->y1 - d->y0) * (high - top - bottom); }

static void limits(drawing *d)
{
    d->x0 = d->y0 = INFINITY;
    d->x1 = d->y1 = -INFINITY;
    for (size_t i = 0; i < d->c->count; i++) {
        const nh_measured *m = &d->c->item[i];
        if (!shown(m)) continue;
        double x = error_of(d, m), y = log10(m->seconds);
        d->x0 = fmin(d->x0, floor(x)), d->x1 = fmax(d->x1, ceil(x));
        d->y0 = fmin(d->y0, floor(y)), d->y1 = fmax(d->y1, ceil(y));
    }
    if (!(d->x0 < d->x1)) d->x0 = isfinite(d->x0) ? d->x0 - 1 : -16, d->x1 = d->x0 + 1;
    if (!(d->y0 < d->y1)) d->y0 = isfinite(d->y0) ? d->y0 - 1 : -6, d->y1 = d->y0 + 1;
}

static void power(nh_text *out, int decade) { nh_text_addf(out, "10<tspan dy=\"-5\" font-size=\"9\">%d</tspan>", decade); }

static void axes(drawing *d)
{
    for (double x = d->x0; x <= d->x1 + 0.5; x++) {
        nh_text_addf(d->out, "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/>\n", x_of(d, x), x_of(d, x), top, high - bottom);
        if ((int)(x - d->x0) % 2) continue;
        nh_text_addf(d->out, "<text text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">", x_of(d, x), high - bottom + 18);
        power(d->out, (int)x);
        nh_text_add(d->out, "</text>\n");
    }
    for (double y = d->y0; y <= d->y1 + 0.5; y++) {
        nh_text_addf(d->out, "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/>\n<text text-anchor=\"end\" x=\"%d\" y=\"%.1f\">", left, wide - right,
                     y_of(d, y), y_of(d, y), left - 8, y_of(d, y) + 4);
        power(d->out, (int)y);
        nh_text_add(d->out, "</text>\n");
    }
    nh_text_addf(d->out, "<text text-anchor=\"middle\" x=\"%d\" y=\"%d\">error, relative</text>\n", (left + wide - right) / 2, high - 14);
    nh_text_addf(d->out, "<text text-anchor=\"middle\" transform=\"translate(18 %d) rotate(-90)\">seconds</text>\n", (top + high - bottom) / 2);
}

/* Runs from..to-1 as a line with points, and its name at the right. */
static void put_series(drawing *d, size_t from, size_t to, size_t index)
{
    const nh_measured *first = &d->c->item[from];
    const char *shade = colour[index % shades], *dash = index >= 2 * shades ? "2 3" : index >= shades ? "7 3" : "none";
    nh_text_addf(d->out, "<g stroke=\"%s\" fill=\"%s\">\n<polyline fill=\"none\" stroke-width=\"1.4\" stroke-dasharray=\"%s\" points=\"", shade, shade, dash);
    for (size_t i = from; i < to; i++)
        if (shown(&d->c->item[i])) nh_text_addf(d->out, "%.1f,%.1f ", x_of(d, error_of(d, &d->c->item[i])), y_of(d, log10(d->c->item[i].seconds)));
    nh_text_add(d->out, "\"/>\n");
    for (size_t i = from; i < to; i++) {
        const nh_measured *m = &d->c->item[i];
        if (!shown(m)) continue;
        nh_text_addf(d->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"><title>", x_of(d, error_of(d, m)), y_of(d, log10(m->seconds)), m->front ? "4.2" : "2.4");
        nh_svg_escape(m->method, d->out);
        nh_text_addf(d->out, ", %s %.3g: error %.1e, %.3g s, %ld evaluations</title></circle>\n", isnan(m->step) ? "tolerance" : "step", isnan(m->step) ? m->tolerance : m->step,
                     m->error, m->seconds, m->evaluations);
    }
    double y = top + 6 + line_height * (double)index;
    nh_text_addf(d->out, "<line x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\" stroke-width=\"2\" stroke-dasharray=\"%s\"/></g>\n<text x=\"%d\" y=\"%.1f\">", wide - right + 14,
                 wide - right + 38, y - 4, y - 4, dash, wide - right + 44, y);
    nh_svg_escape(first->method, d->out);
    if (strcmp(first->formulation, d->c->item[0].formulation)) {
        nh_text_add(d->out, ", ");
        nh_svg_escape(first->formulation, d->out);
    }
    nh_text_add(d->out, "</text>\n");
}

/* Stairs under which nothing was measured: from the smallest error to the largest. */
static void put_front(drawing *d)
{
    nh_text_add(d->out, "<polyline class=\"front\" points=\"");
    double done = -INFINITY;
    for (;;) {
        const nh_measured *next = NULL;
        for (size_t i = 0; i < d->c->count; i++) {
            const nh_measured *m = &d->c->item[i];
            if (shown(m) && m->front && m->error > done && (!next || m->error < next->error)) next = m;
        }
        if (!next) break;
        done = next->error;
        nh_text_addf(d->out, "%.1f,%.1f ", x_of(d, error_of(d, next)), y_of(d, log10(next->seconds)));
    }
    nh_text_add(d->out, "\"/>\n");
}

void nh_comparison_svg(const nh_comparison *c, nh_text *out)
{
    drawing d = {.c = c, .out = out};
    size_t index = 0, lines = 0;
    for (size_t i = 0; i < c->count; i++) lines += i == 0 || strcmp(c->item[i].method, c->item[i - 1].method) || strcmp(c->item[i].formulation, c->item[i - 1].formulation);
    int tall = top + 20 + line_height * (int)lines > high ? top + 20 + line_height * (int)lines : high;
    limits(&d);
    nh_text_addf(out, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"12\">\n"
                      "<style>.grid{stroke:#ddd}.front{fill:none;stroke:#000;stroke-opacity:.18;stroke-width:9;stroke-linejoin:round;stroke-linecap:round}</style>\n"
                      "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n<text x=\"%d\" y=\"26\" font-size=\"15\">", wide, tall, wide, tall, left);
    nh_svg_escape(c->question->system->title ? c->question->system->title : c->question->system->name, out);
    nh_text_addf(out, ", t = %g to %g: time against error</text>\n", c->begin, c->end);
    axes(&d);
    put_front(&d);
    for (size_t i = 0, next; i < c->count; i = next) {
        for (next = i + 1; next < c->count && !strcmp(c->item[i].method, c->item[next].method) && !strcmp(c->item[i].formulation, c->item[next].formulation);) next++;
        put_series(&d, i, next, index++);
    }
    nh_text_add(out, "</svg>\n");
}
