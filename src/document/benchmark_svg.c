/* benchmark_svg: the comparison as a drawing, logarithmic on both axes: error to the left is better, time below is
 * better.  One panel for the motions, one for the discrete problem; a list of its series by group stands beside each,
 * and a line under the points shows the front of the best runs (in the second panel one for each number of
 * functions). */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "base/memory.h"
#include "document/benchmark.h"

enum {
    wide = 1060,
    left = 70,
    right = 390,
    top = 56,
    bottom = 56,
    least_height = 300,
    line_height = 16,
    shades = 20,
    dashes = 6,
    most_letters = 52
};
static const char *const colour[shades] = {"#1b6ca8", "#d1495b", "#2e933c", "#8e5ea2", "#c77c02", "#00798c", "#7a4419",
                                           "#e05780", "#4f5d75", "#6a994e", "#b23a48", "#3d348b", "#f08a24", "#17a398",
                                           "#9c6644", "#5e60ce", "#386641", "#a4133c", "#577590", "#222222"};
static const char *const dash[dashes] = {"none", "7 3", "2 3", "9 3 2 3", "4 2", "1 2"};

typedef struct {
    double error, seconds; /* not finite: not drawn */
    bool front, hollow;    /* hollow: flagged */
    const char *note;
} mark;

typedef struct {
    const char *name, *group;
    size_t count;
    mark *mark;
} series;

typedef struct {
    nh_text *out;
    nh_arena *arena;
    const char *title, *across, *key; /* key: the meaning of its signs */
    size_t count;
    series *series;
    bool by_group;         /* one front for each group */
    int y, tall;           /* upper edge and height of the panel */
    double x0, x1, y0, y1; /* decades */
} panel;

static bool shown(const mark *m) { return isfinite(m->error) && m->seconds > 0 && isfinite(m->seconds); }
static double x_of(const panel *d, double decade)
{
    return left + (decade - d->x0) / (d->x1 - d->x0) * (wide - left - right);
}
static double y_of(const panel *d, double decade)
{
    return d->y + d->tall - bottom - (decade - d->y0) / (d->y1 - d->y0) * (d->tall - top - bottom);
}
static double across(const panel *d, const mark *m) { return x_of(d, log10(m->error)); }
static double up(const panel *d, const mark *m) { return y_of(d, log10(m->seconds)); }

/* Shortens a text to so many characters, the last of them points. */
static void escaped(nh_text *out, const char *text, size_t most)
{
    size_t letters = 0, bytes = 0, all = nh_text_width(text);
    nh_text part;
    nh_text_init(&part);
    for (; text[bytes] && (all <= most || letters + 3 < most || ((unsigned char)text[bytes] & 0xC0) == 0x80); bytes++)
        letters += ((unsigned char)text[bytes + 1] & 0xC0) != 0x80;
    nh_text_add_n(&part, text, bytes);
    nh_escape_xml(nh_text_string(&part), out);
    if (text[bytes]) nh_text_add(out, "...");
    nh_text_clear(&part);
}

/* ---- one panel ---- */

static void limits(panel *d)
{
    d->x0 = d->y0 = INFINITY;
    d->x1 = d->y1 = -INFINITY;
    for (size_t s = 0; s < d->count; s++)
        for (size_t i = 0; i < d->series[s].count; i++) {
            const mark *m = &d->series[s].mark[i];
            if (!shown(m)) continue;
            double x = log10(m->error), y = log10(m->seconds);
            d->x0 = fmin(d->x0, floor(x)), d->x1 = fmax(d->x1, ceil(x));
            d->y0 = fmin(d->y0, floor(y)), d->y1 = fmax(d->y1, ceil(y));
        }
    if (!(d->x0 < d->x1)) d->x0 = isfinite(d->x0) ? d->x0 - 1 : -16, d->x1 = d->x0 + 1;
    if (!(d->y0 < d->y1)) d->y0 = isfinite(d->y0) ? d->y0 - 1 : -6, d->y1 = d->y0 + 1;
}

static void power(nh_text *out, int decade)
{
    nh_text_addf(out, "10<tspan dy=\"-5\" font-size=\"9\">%d</tspan>", decade);
}

static void axes(panel *d)
{
    int foot = d->y + d->tall - bottom;
    for (double x = d->x0; x <= d->x1 + 0.5; x++) {
        nh_text_addf(d->out, "<line class=\"grid\" x1=\"%.1f\" x2=\"%.1f\" y1=\"%d\" y2=\"%d\"/>\n", x_of(d, x),
                     x_of(d, x), d->y + top, foot);
        if ((int)(x - d->x0) % 2) continue;
        nh_text_addf(d->out, "<text text-anchor=\"middle\" x=\"%.1f\" y=\"%d\">", x_of(d, x), foot + 18);
        power(d->out, (int)x);
        nh_text_add(d->out, "</text>\n");
    }
    for (double y = d->y0; y <= d->y1 + 0.5; y++) {
        nh_text_addf(d->out,
                     "<line class=\"grid\" x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\"/>\n<text text-anchor=\"end\" "
                     "x=\"%d\" y=\"%.1f\">",
                     left, wide - right, y_of(d, y), y_of(d, y), left - 8, y_of(d, y) + 4);
        power(d->out, (int)y);
        nh_text_add(d->out, "</text>\n");
    }
    nh_text_addf(d->out, "<text x=\"%d\" y=\"%d\" font-size=\"15\">", left, d->y + 30);
    escaped(d->out, d->title, 120);
    nh_text_addf(d->out, "</text>\n<text text-anchor=\"middle\" x=\"%d\" y=\"%d\">%s</text>\n",
                 (left + wide - right) / 2, foot + 40, d->across);
    nh_text_addf(d->out, "<text x=\"%d\" y=\"%d\" font-size=\"11\" fill=\"#555\">%s</text>\n", left, d->y + 46, d->key);
    nh_text_addf(d->out, "<text text-anchor=\"middle\" transform=\"translate(18 %d) rotate(-90)\">seconds</text>\n",
                 d->y + (top + d->tall - bottom) / 2);
}

/* A line with points, and its name at the right end. */
static void put_series(panel *d, const series *s, const char *shade, const char *dashed, double y)
{
    nh_text_addf(
        d->out,
        "<g stroke=\"%s\" fill=\"%s\">\n<polyline fill=\"none\" stroke-width=\"1.4\" stroke-dasharray=\"%s\" points=\"",
        shade, shade, dashed);
    for (size_t i = 0; i < s->count; i++)
        if (shown(&s->mark[i])) nh_text_addf(d->out, "%.1f,%.1f ", across(d, &s->mark[i]), up(d, &s->mark[i]));
    nh_text_add(d->out, "\"/>\n");
    for (size_t i = 0; i < s->count; i++) {
        const mark *m = &s->mark[i];
        if (!shown(m)) continue;
        nh_text_addf(d->out, "<circle cx=\"%.1f\" cy=\"%.1f\" r=\"%s\"%s><title>", across(d, m), up(d, m),
                     m->front ? "4.2" : "2.4", m->hollow ? " fill=\"#fff\"" : "");
        escaped(d->out, m->note, 300);
        nh_text_add(d->out, "</title></circle>\n");
    }
    bool any = false;
    for (size_t i = 0; i < s->count; i++) any |= shown(&s->mark[i]);
    nh_text_addf(d->out,
                 "<line x1=\"%d\" x2=\"%d\" y1=\"%.1f\" y2=\"%.1f\" stroke-width=\"2\" "
                 "stroke-dasharray=\"%s\"/></g>\n<text x=\"%d\" y=\"%.1f\"%s>",
                 wide - right + 22, wide - right + 46, y - 4, y - 4, dashed, wide - right + 52, y,
                 any ? "" : " fill=\"#aaa\"");
    escaped(d->out, s->name, most_letters);
    nh_text_add(d->out, "</text>\n");
}

/* The front as stairs over the series from..to-1, from the smallest error to the largest: no run lies below it. */
static void put_front(panel *d, size_t from, size_t to)
{
    nh_text_add(d->out, "<polyline class=\"front\" points=\"");
    for (double done = -INFINITY;;) {
        const mark *next = NULL;
        for (size_t s = from; s < to; s++)
            for (size_t i = 0; i < d->series[s].count; i++) {
                const mark *m = &d->series[s].mark[i];
                if (shown(m) && m->front && m->error > done && (!next || m->error < next->error)) next = m;
            }
        if (!next) break;
        done = next->error;
        nh_text_addf(d->out, "%.1f,%.1f ", across(d, next), up(d, next));
    }
    nh_text_add(d->out, "\"/>\n");
}

static void put_fronts(panel *d)
{
    for (size_t s = 0, next; s < d->count; s = next) {
        for (next = s; next < d->count && (!d->by_group || !strcmp(d->series[next].group, d->series[s].group));) next++;
        put_front(d, s, next);
    }
}

/* The number of lines of the list beside it: one per series and one per group. */
static size_t lines_of(const panel *d)
{
    size_t lines = d->count;
    for (size_t s = 0; s < d->count; s++) lines += s == 0 || strcmp(d->series[s].group, d->series[s - 1].group);
    return lines;
}

/* One colour per name, one dash per group. */
static void put_panel(panel *d)
{
    size_t line = 0, group = 0;
    axes(d);
    put_fronts(d);
    for (size_t s = 0; s < d->count; s++) {
        const series *k = &d->series[s];
        size_t name = 0, seen = 0;
        if (s == 0 || strcmp(k->group, d->series[s - 1].group)) {
            group += s > 0;
            nh_text_addf(d->out, "<text x=\"%d\" y=\"%d\" font-weight=\"bold\">", wide - right + 14,
                         d->y + top + 6 + line_height * (int)line++);
            escaped(d->out, k->group, most_letters);
            nh_text_add(d->out, "</text>\n");
        }
        /* number of names before this one's first occurrence */
        for (size_t i = 0; strcmp(d->series[i].name, k->name); i++) {
            bool first = true;
            for (size_t j = 0; j < i; j++) first &= strcmp(d->series[j].name, d->series[i].name) != 0;
            seen += first;
        }
        name = seen % shades;
        put_series(d, k, colour[name], dash[group % dashes], d->y + top + 6 + line_height * (int)line++);
    }
}

/* ---- the two panels ---- */

/* The runs of one method in one formulation; an error below that of the reference is drawn at the latter. */
static void motions(panel *d, const nh_benchmark *c)
{
    d->series = nh_arena_alloc(d->arena, (c->count + 1) * sizeof *d->series);
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        series *s = &d->series[d->count ? d->count - 1 : 0];
        if (!d->count || strcmp(s->name, m->method) || strcmp(s->group, m->formulation)) {
            s = &d->series[d->count++];
            *s = (series){m->method, m->formulation, 0, nh_arena_alloc(d->arena, (c->count + 1) * sizeof *s->mark)};
        }
        bool good = m->status <= NH_FLAGGED && isfinite(m->error);
        char note[400];
        snprintf(note, sizeof note, "%s, %s %.3g: error %.1e, %.3g s, %ld evaluations", m->method,
                 isnan(m->step) ? "tolerance" : "step", isnan(m->step) ? m->tolerance : m->step, m->error, m->seconds,
                 m->evaluations);
        s->mark[s->count++] = (mark){good ? fmax(fmax(m->error, c->agreement), 1e-16) : NAN, m->seconds, m->front,
                                     m->status == NH_FLAGGED, nh_arena_strdup(d->arena, note)};
    }
}

/* For each number of functions the methods for them. */
static void fits(panel *d, const nh_benchmark *c)
{
    d->series = nh_arena_alloc(d->arena, (c->fits + 1) * sizeof *d->series);
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        const char *name = nh_arena_printf(d->arena, "%s, %s route, %s", m->basis, m->route, m->solver);
        const char *group = nh_arena_printf(d->arena, "%zu functions", m->functions);
        if (!isfinite(m->error)) continue;
        series *s = NULL;
        for (size_t k = 0; k < d->count; k++)
            if (!strcmp(d->series[k].name, name) && !strcmp(d->series[k].group, group)) s = &d->series[k];
        if (!s) {
            s = &d->series[d->count++];
            *s = (series){name, group, 0, nh_arena_alloc(d->arena, (c->fits + 1) * sizeof *s->mark)};
        }
        s->mark[s->count++] = (mark){
            m->right ? fmax(m->error, 1e-17) : NAN, m->seconds, m->front, false,
            nh_arena_printf(d->arena, "%s, %zu samples: %zu of %zu currents, gap %.0e, error %.1e, %.3g s", name,
                            m->samples, m->dimension, m->wanted, isfinite(m->gap) ? m->gap : 0, m->error, m->seconds)};
    }
}

void nh_benchmark_svg(const nh_benchmark *c, nh_text *out)
{
    nh_arena *arena = nh_arena_create();
    const nh_system *system = c->question->system;
    const char *name = system->title ? system->title : system->name;
    panel part[2] = {
        {.out = out,
         .arena = arena,
         .across = "error, relative",
         .key = "thick: nothing that is accurate and computes all is both faster and more exact; hollow: flagged; grey "
                "names: never accurate",
         .title = nh_arena_printf(arena, "%s, t = %g to %g: time against error", name, c->begin, c->end)},
        {.out = out,
         .arena = arena,
         .by_group = true,
         .across = "distance of the known currents from the null space",
         .key = "thick: no other of as many functions is both faster and more exact; grey names: never accurate",
         .title = "The discrete problem: time against error"}};
    motions(&part[0], c);
    fits(&part[1], c);
    int y = 0;
    for (int i = 0; i < 2; i++) {
        int list = top + 30 + line_height * (int)lines_of(&part[i]);
        part[i].y = y;
        part[i].tall = list > least_height ? list : least_height;
        if (part[i].count || i == 0) y += part[i].tall;
        limits(&part[i]);
    }
    nh_text_addf(
        out,
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %d %d\" font-family=\"sans-serif\" font-size=\"12\">\n"
        "<style>.grid{stroke:#ddd}.front{fill:none;stroke:#000;stroke-opacity:.18;stroke-width:9;stroke-linejoin:round;"
        "stroke-linecap:round}</style>\n"
        "<rect width=\"%d\" height=\"%d\" fill=\"#fff\"/>\n",
        wide, y, wide, y);
    put_panel(&part[0]);
    if (part[1].count) put_panel(&part[1]);
    nh_text_add(out, "</svg>\n");
    nh_arena_free(arena);
}
