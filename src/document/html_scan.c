/* A scan as a page: what jumps, and where; curves over one parameter, maps over two. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "document/html_internal.h"
#include "document/scan.h"

enum { most_classes = 6 };

static void answer(nh_html_writer *w, const nh_scan *x)
{
    size_t sure = 0;
    for (size_t i = 0; i < x->specials; i++) sure += x->special[i].confirmed;
    nh_text_addf(w->out, "<p class=\"answer %s\">", x->partial ? "undecided" : "found");
    if (x->partial) nh_html_add(w, "Not finished: the same command continues. ");
    nh_html_count(w, sure);
    nh_html_add(w, sure == 1 ? " confirmed special value, " : " confirmed special values, ");
    nh_html_count(w, x->specials - sure);
    nh_html_add(w, " that are not confirmed, from ");
    nh_html_count(w, x->points);
    nh_html_add(w, " points.</p>\n<p>");
    nh_html_text(w, nh_scan_caution);
    nh_html_add(w, "</p>\n");
}

static void specials(nh_html_writer *w, const nh_scan *x)
{
    nh_html_add(w, "<section id=\"special\"><h2>Special values</h2>\n");
    if (!x->specials) nh_html_add(w, "<p>None was found.</p>\n");
    if (x->specials) nh_html_table(w, "Where numbers jump", "where|what");
    for (size_t i = 0; i < x->specials; i++) {
        if (!nh_scan_alike(x, i)) continue;
        nh_html_add(w, "<tr><td>");
        nh_html_text(w, nh_scan_where(x, i));
        nh_html_add(w, "</td><td>");
        nh_html_text(w, nh_scan_what(x, &x->special[i]));
        nh_html_add(w, "</td></tr>\n");
    }
    if (x->specials) nh_html_table_end(w);
    nh_html_add(w, "</section>\n");
}

/* ---- over one parameter ---- */

static double *along(const nh_scan *x, size_t axis)
{
    double *out = nh_arena_alloc(x->arena, (x->axis[axis].count + 1) * sizeof *out);
    for (size_t i = 0; i < x->axis[axis].count; i++) out[i] = x->axis[axis].value[i].value;
    return out;
}

/* Number k of every point; from NH_SCAN_MOST_NUMBERS on the singular values. */
static double *column(const nh_scan *x, size_t k)
{
    double *out = nh_arena_alloc(x->arena, (x->points + 1) * sizeof *out);
    for (size_t i = 0; i < x->points; i++) {
        const nh_scan_row *r = &x->row[i];
        out[i] = !r->done ? NAN : k < NH_SCAN_MOST_NUMBERS ? r->number[k] : nh_scan_sigma(x, i, k - NH_SCAN_MOST_NUMBERS);
    }
    return out;
}

static void curves(nh_html_writer *w, const nh_scan *x)
{
    nh_curve curve[NH_SCAN_MOST_NUMBERS + NH_SCAN_MOST_SPACES];
    size_t n = 0, count = x->axis[0].count;
    double *at = along(x, 0);
    bool shown = x->points < 200;
    for (size_t k = 0; k < x->source->count; k++)
        curve[n++] = (nh_curve){.name = x->source->name[k], .count = count, .x = at, .y = column(x, k), .x_stride = 1, .y_stride = 1, .marks = shown};
    nh_plot plot = {.title = "Numbers over the parameter", .description = "Each number at the points of the grid", .x_label = x->axis[0].name,
                    .y_label = n == 1 ? x->source->name[0] : "number", .curves = n, .curve = curve};
    nh_html_figure(w, &plot, "Numbers over the parameter. Lines join the points of the grid.");
    n = 0;
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k])
            curve[n++] = (nh_curve){.name = nh_arena_printf(x->arena, "%zu", k + 1), .count = count, .x = at, .y = column(x, NH_SCAN_MOST_NUMBERS + k), .x_stride = 1, .y_stride = 1};
    plot = (nh_plot){.title = "Smallest singular values over the parameter", .description = "A dip to zero is a value with one more current", .x_label = x->axis[0].name,
                     .y_label = "singular value", .log_y = true, .floor = 1e-12, .curves = n, .curve = curve};
    if (n) nh_html_figure(w, &plot, "Smallest generalized singular value of each ansatz space that does not vanish everywhere. A dip to zero is a value with one more current.");
}

/* ---- over two ---- */

/* The points of special values that are sure, or the others. */
static size_t marks(const nh_scan *x, bool sure, double *at, double *up)
{
    size_t n = 0;
    for (size_t i = 0; i < x->specials; i++) {
        const nh_scan_special *s = &x->special[i];
        if ((s->confirmed || s->kind == NH_SCAN_STEP) != sure) continue;
        at[n] = s->axis == 0 ? s->value : nh_scan_at(x, s->place, 0)->value;
        up[n++] = s->axis == 1 ? s->value : nh_scan_at(x, s->place, 1)->value;
    }
    return n;
}

static size_t class_of(double value, double *class, size_t *classes)
{
    size_t k = 0;
    while (k < *classes && class[k] != value) k++;
    if (k == *classes && k < most_classes) class[(*classes)++] = value;
    return k < most_classes ? k : most_classes - 1;
}

static void put_map(nh_html_writer *w, const nh_scan *x, const nh_cells *cells, size_t curves_before, nh_curve *curve, const char *title, const char *caption)
{
    double *at = nh_arena_alloc(x->arena, 4 * (x->specials + 1) * sizeof *at), *up = at + x->specials + 1;
    size_t n = curves_before, sure = marks(x, true, at, up);
    if (n % 2 && sure) n++, curve[n - 1] = (nh_curve){.name = ""}; /* an even one is filled */
    if (sure) curve[n++] = (nh_curve){.name = "special values", .count = sure, .x = at, .y = up, .x_stride = 1, .y_stride = 1, .dots = true};
    nh_plot plot = {.title = title, .description = caption, .x_label = x->axis[0].name, .y_label = x->axis[1].name, .curves = n, .curve = curve, .cells = cells};
    nh_html_figure(w, &plot, caption);
}

static void map_of_leading(nh_html_writer *w, const nh_scan *x, nh_cells *cells)
{
    double class[most_classes] = {0}, *value = column(x, 0);
    size_t classes = 0;
    nh_curve curve[most_classes + 4];
    for (size_t i = 0; i < x->points; i++) {
        cells->fill[i][0] = 0;
        if (isfinite(value[i])) snprintf(cells->fill[i], 8, "%s", nh_svg_colour(class_of(value[i], class, &classes)));
    }
    for (size_t k = 0; k < classes; k++)
        curve[k] = (nh_curve){.name = nh_arena_printf(x->arena, "%s = %g%s", x->source->name[0], class[k], k + 1 == most_classes ? " or others" : ""), .dots = true};
    put_map(w, x, cells, classes, curve, "The leading number over both parameters", "The leading number over both parameters; special values as points.");
}

/* Of all spaces; INFINITY: not known. */
static double smallest_at(const nh_scan *x, size_t point)
{
    double least = INFINITY;
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k]) least = fmin(least, nh_scan_sigma(x, point, k));
    return least;
}

/* Dark where it is small, black where one more vanishes. */
static void map_of_singular_values(nh_html_writer *w, const nh_scan *x, nh_cells *cells)
{
    double low = INFINITY, high = 0;
    nh_curve curve[4];
    for (size_t i = 0; i < x->points; i++) {
        double least = smallest_at(x, i);
        if (!isfinite(least) || least == 0) continue;
        low = fmin(low, least);
        high = fmax(high, least);
    }
    for (size_t i = 0; i < x->points; i++) {
        double least = smallest_at(x, i);
        unsigned char shade = least == 0 ? 0 : high > low ? (unsigned char)(230 * log(fmin(least, high) / low) / log(high / low)) : 230;
        if (isfinite(least)) snprintf(cells->fill[i], 8, "#%02x%02x%02x", shade, shade, shade);
        else cells->fill[i][0] = 0;
    }
    if (high > 0) put_map(w, x, cells, 0, curve, "The smallest singular value over both parameters", "The smallest of the singular values over both parameters, on a logarithmic scale: dark is small.");
}

static void maps(nh_html_writer *w, const nh_scan *x)
{
    nh_cells cells = {.across = x->axis[0].count, .up = x->axis[1].count, .x = along(x, 0), .y = along(x, 1)};
    cells.fill = nh_arena_alloc(x->arena, (x->points + 1) * sizeof *cells.fill);
    map_of_leading(w, x, &cells);
    map_of_singular_values(w, x, &cells);
}

/* ---- the page ---- */

static void spaces(nh_html_writer *w, const nh_scan *x)
{
    nh_html_add(w, "<section id=\"spaces\"><h2>Ansatz spaces</h2>\n");
    nh_html_table(w, "Whose smallest singular values were followed", "number|functions|space");
    for (size_t k = 0; k < x->spaces; k++) {
        if (!x->columns[k]) continue;
        nh_html_add(w, "<tr><td>");
        nh_html_count(w, k + 1);
        nh_html_add(w, "</td><td>");
        nh_html_count(w, x->columns[k]);
        nh_html_add(w, "</td><td>");
        nh_html_text(w, x->space[k]);
        nh_html_add(w, "</td></tr>\n");
    }
    nh_html_table_end(w);
    nh_html_add(w, "</section>\n");
}

void nh_html_scan(const nh_scan *x, const nh_run *run, nh_text *out)
{
    nh_html_writer w = {.out = out, .system = x->system, .dag = x->system->dag, .shown = run->shown, .written = INFINITY};
    bool curved = x->axes == 1 && x->axis[0].ascending, mapped = x->axes == 2 && x->axis[0].ascending && x->axis[1].ascending, fitted = false;
    for (size_t k = 0; k < x->spaces; k++) fitted |= x->columns[k] > 0;
    nh_html_begin(&w, "a scan");
    answer(&w, x);
    nh_html_links(&w, fitted ? "special|Special values|figures|Figures|spaces|Ansatz spaces|repeat|Repeat it" : "special|Special values|figures|Figures|repeat|Repeat it");
    specials(&w, x);
    nh_html_add(&w, "<section id=\"figures\"><h2>Figures</h2>\n");
    if (curved) curves(&w, x);
    else if (mapped) maps(&w, x);
    else nh_html_add(&w, "<p>Curves are drawn over one parameter, maps over two, both with ascending values. The values at all points are in scan.csv.</p>\n");
    nh_html_add(&w, "</section>\n");
    if (fitted) spaces(&w, x);
    nh_html_repeat(&w, run);
    nh_html_end(&w);
}
