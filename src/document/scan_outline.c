/* A scan as a document: the special values; curves over one parameter, maps over two. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/scan.h"
#include "document/screen.h"

enum { most_classes = 6 };

static const char caution[] =
    "A scan is a search by numbers: it can miss values between two points, and conserved quantities outside its ansatz "
    "spaces. nhsym classify excludes values by proof where the parameter allows it.";

/* ---- words ---- */

static bool alike(const nh_scan_special *a, const nh_scan_special *b)
{
    return a->axis == b->axis && a->exact && b->exact && !strcmp(a->exact, b->exact) && a->confirmed == b->confirmed &&
           a->generic == b->generic && a->number[0] == b->number[0];
}

/* If this is the first special value with its exact value, numbers and direction: how many such are listed; otherwise
 * 0. */
static size_t count_alike(const nh_scan *x, size_t special)
{
    size_t n = 0;
    for (size_t i = 0; i < x->specials; i++) {
        if (i != special && !alike(&x->special[i], &x->special[special])) continue;
        if (i < special) return 0;
        n++;
    }
    return n;
}

/* "k = 2", "k = sqrt(3) = 1.7320508", with the other parameters of the grid, or for how many of their values; in the
 * scan's arena. */
static const char *where(const nh_scan *x, size_t special)
{
    const nh_scan_special *s = &x->special[special];
    nh_text text;
    size_t lines = count_alike(x, special);
    nh_text_init(&text);
    if (!s->exact) nh_text_addf(&text, "%s = %.10g", x->axis[s->axis].name, s->value);
    else if (strspn(s->exact, "-0123456789/") == strlen(s->exact))
        nh_text_addf(&text, "%s = %s", x->axis[s->axis].name, s->exact);
    else nh_text_addf(&text, "%s = %s = %.10g", x->axis[s->axis].name, s->exact, s->value);
    for (size_t a = 0; a < x->axes && lines < 2; a++)
        if (a != s->axis) nh_text_addf(&text, ", %s = %s", x->axis[a].name, nh_scan_at(x, s->place, a)->text);
    if (lines > 1) nh_text_addf(&text, ", for %zu of the other values", lines);
    const char *out = nh_arena_strdup(x->arena, nh_text_string(&text));
    nh_text_clear(&text);
    return out;
}

/* What changes at a special value, in a sentence. */
static const char *what(const nh_scan *x, const nh_scan_special *s)
{
    const char *name = x->source->name[0];
    double here = s->number[0];
    if (s->kind == NH_SCAN_STEP && isfinite(here))
        return nh_arena_printf(x->arena, "%s is %g below, %g there and %g above", name, s->below, here, s->above);
    if (s->kind == NH_SCAN_STEP)
        return nh_arena_printf(x->arena, "%s is %g below and %g above; %s", name, s->below, s->above, s->why);
    if (s->confirmed)
        return nh_arena_printf(x->arena, "%s is %g instead of %g: confirmed with the exact value", name, here,
                               s->generic);
    if (s->space)
        return nh_arena_printf(x->arena, "not confirmed: one more current in the space `%s`, but %s", s->space, s->why);
    return nh_arena_printf(x->arena, "not confirmed: %s", s->why);
}

/* ---- numbers ---- */

/* "2 at 60 points, 3 at 1" */
static void counts(const nh_scan *x, size_t number, nh_text *out)
{
    double *value = nh_alloc_array(x->points + 1, sizeof *value);
    size_t *times = nh_alloc_array(x->points + 1, sizeof *times), n = 0, missing = 0;
    enum { most = 12 };
    for (size_t i = 0; i < x->points; i++) {
        double v = x->row[i].done ? x->row[i].number[number] : NAN;
        size_t k = 0;
        if (!isfinite(v)) {
            missing++;
            continue;
        }
        while (k < n && value[k] != v) k++;
        if (k == n) value[n++] = v;
        times[k]++;
    }
    if (n > most) {
        double low = INFINITY, high = -INFINITY;
        for (size_t k = 0; k < n; k++) low = fmin(low, value[k]), high = fmax(high, value[k]);
        nh_text_addf(out, "from %.6g to %.6g", low, high);
    }
    for (size_t k = 0; k < n && n <= most; k++)
        nh_text_addf(out, "%s%.6g at %zu point%s", k ? ", " : "", value[k], times[k], times[k] == 1 ? "" : "s");
    if (missing) nh_text_addf(out, "%snone at %zu point%s", n ? ", " : "", missing, missing == 1 ? "" : "s");
    nh_free(value);
    nh_free(times);
}

static const char *reason(const nh_scan *x)
{
    for (size_t i = 0; i < x->points; i++)
        if (x->row[i].done && x->row[i].why) return x->row[i].why;
    return NULL;
}

static void numbers(nh_pen *p, const nh_scan *x)
{
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "Numbers of `%s` over ", x->source->of);
    for (size_t a = 0; a < x->axes; a++) {
        const nh_scan_axis *q = &x->axis[a];
        nh_pen_say(p, "%s", a ? ", " : "");
        nh_pen_say(p, "<%s> = %s .. %s (%zu)", q->name, q->value[0].text, q->value[q->count - 1].text, q->count);
    }
    nh_pen_say(p, ".");
    nh_pen_close(p, NH_PEN_WORDS);
    if (x->chunked) return;
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < x->source->count; i++) {
        nh_text text;
        nh_text_init(&text);
        counts(x, i, &text);
        nh_pen_fact(p, x->source->name[i], "%s", nh_text_string(&text));
        nh_text_clear(&text);
    }
    if (reason(x)) nh_pen_fact(p, "at some points", "%s", reason(x));
    nh_pen_close(p, NH_PEN_FACTS);
}

/* ---- special values ---- */

static void put_answer(const nh_scan *x, nh_text *out)
{
    size_t sure = 0;
    for (size_t i = 0; i < x->specials; i++) sure += x->special[i].confirmed;
    if (x->chunked)
        nh_text_addf(out,
                     "This part: %zu of %zu units are finished. When all parts are, the same command without "
                     "--chunk writes the result.",
                     x->finished, x->units);
    else if (x->partial && x->finished < x->units)
        nh_text_addf(out, "Not finished: %zu of %zu units. The same command continues. ", x->finished, x->units);
    else if (x->partial)
        nh_text_addf(out, "Not finished: %zu jumps remain to be examined. The same command continues. ", x->unrefined);
    if (!x->chunked)
        nh_text_addf(out, "%zu confirmed special value%s, %zu not confirmed, from %zu point%s.", sure,
                     sure == 1 ? "" : "s", x->specials - sure, x->points, x->points == 1 ? "" : "s");
}

static void answer(nh_pen *p, const nh_scan *x)
{
    nh_text text;
    nh_text_init(&text);
    put_answer(x, &text);
    nh_pen_open(p, NH_PEN_ANSWER, x->partial || x->chunked ? "undecided" : "found", NULL);
    nh_pen_say(p, "%s", nh_text_string(&text));
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_text_clear(&text);
}

/* The confirmed special values, or the others. */
static void list(nh_pen *p, const nh_scan *x, bool sure)
{
    bool begun = false;
    for (size_t i = 0; i < x->specials; i++) {
        const nh_scan_special *s = &x->special[i];
        if ((s->confirmed || s->kind == NH_SCAN_STEP) != sure || !count_alike(x, i)) continue;
        if (!begun && !sure) nh_pen_heading(p, "Perhaps special");
        if (!begun) nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
        begun = true;
        nh_pen_fact(p, where(x, i), "%s", what(x, s));
    }
    if (begun) nh_pen_close(p, NH_PEN_FACTS);
}

static void specials(nh_pen *p, const nh_scan *x)
{
    nh_pen_section(p, "special", "Special values");
    if (!x->specials && !x->partial) nh_pen_words(p, "None was found.");
    list(p, x, true);
    list(p, x, false);
    nh_pen_words(p, "%s", caution);
}

/* ---- over one parameter ---- */

static double *along(const nh_scan *x, size_t axis)
{
    double *out = nh_arena_alloc(x->arena, (x->axis[axis].count + 1) * sizeof *out);
    for (size_t i = 0; i < x->axis[axis].count; i++) out[i] = x->axis[axis].value[i].value;
    return out;
}

/* Number k at every point; from NH_SCAN_MOST_NUMBERS on, the singular values. */
static double *column(const nh_scan *x, size_t k)
{
    double *out = nh_arena_alloc(x->arena, (x->points + 1) * sizeof *out);
    for (size_t i = 0; i < x->points; i++) {
        const nh_scan_row *r = &x->row[i];
        out[i] = !r->done                   ? NAN
                 : k < NH_SCAN_MOST_NUMBERS ? r->number[k]
                                            : nh_scan_sigma(x, i, k - NH_SCAN_MOST_NUMBERS);
    }
    return out;
}

static void curves(nh_pen *p, const nh_scan *x)
{
    nh_curve curve[NH_SCAN_MOST_NUMBERS + NH_SCAN_MOST_SPACES];
    size_t n = 0, count = x->axis[0].count;
    double *at = along(x, 0);
    bool shown = x->points < 200;
    for (size_t k = 0; k < x->source->count; k++)
        curve[n++] = (nh_curve){.name = x->source->name[k],
                                .count = count,
                                .x = at,
                                .y = column(x, k),
                                .x_stride = 1,
                                .y_stride = 1,
                                .marks = shown};
    nh_plot plot = {.title = "Numbers over the parameter",
                    .description = "Each number at the points of the grid",
                    .x_label = x->axis[0].name,
                    .y_label = n == 1 ? x->source->name[0] : "number",
                    .curves = n,
                    .curve = curve};
    nh_pen_plot(p, &plot, "Numbers over the parameter. Lines join the points of the grid.");
    n = 0;
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k])
            curve[n++] = (nh_curve){.name = nh_arena_printf(x->arena, "%zu", k + 1),
                                    .count = count,
                                    .x = at,
                                    .y = column(x, NH_SCAN_MOST_NUMBERS + k),
                                    .x_stride = 1,
                                    .y_stride = 1};
    plot = (nh_plot){.title = "Smallest singular values over the parameter",
                     .description = "A dip to zero is a value with one more current",
                     .x_label = x->axis[0].name,
                     .y_label = "singular value",
                     .log_y = true,
                     .floor = 1e-12,
                     .curves = n,
                     .curve = curve};
    if (n)
        nh_pen_plot(p, &plot,
                    "Smallest generalized singular value of each ansatz space that does not vanish everywhere. A dip "
                    "to zero is a value with one more current.");
}

/* ---- over two ---- */

/* The places of confirmed special values, or of the others. */
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

static void put_map(nh_pen *p, const nh_scan *x, const nh_cells *cells, size_t curves_before, nh_curve *curve,
                    const char *title, const char *caption)
{
    double *at = nh_arena_alloc(x->arena, 4 * (x->specials + 1) * sizeof *at), *up = at + x->specials + 1;
    size_t n = curves_before, sure = marks(x, true, at, up);
    if (n % 2 && sure) n++, curve[n - 1] = (nh_curve){.name = ""}; /* a marker with an even index is filled */
    if (sure)
        curve[n++] = (nh_curve){
            .name = "special values", .count = sure, .x = at, .y = up, .x_stride = 1, .y_stride = 1, .dots = true};
    nh_plot plot = {.title = title,
                    .description = caption,
                    .x_label = x->axis[0].name,
                    .y_label = x->axis[1].name,
                    .curves = n,
                    .curve = curve,
                    .cells = cells};
    nh_pen_plot(p, &plot, caption);
}

static void map_of_leading(nh_pen *p, const nh_scan *x, nh_cells *cells)
{
    double class[most_classes] = {0}, *value = column(x, 0);
    size_t classes = 0;
    nh_curve curve[most_classes + 4];
    for (size_t i = 0; i < x->points; i++) {
        cells->fill[i][0] = 0;
        if (isfinite(value[i])) snprintf(cells->fill[i], 8, "%s", nh_svg_colour(class_of(value[i], class, &classes)));
    }
    for (size_t k = 0; k < classes; k++)
        curve[k] = (nh_curve){.name = nh_arena_printf(x->arena, "%s = %g%s", x->source->name[0], class[k],
                                                      k + 1 == most_classes ? " or others" : ""),
                              .dots = true};
    put_map(p, x, cells, classes, curve, "The leading number over both parameters",
            "The leading number over both parameters; special values as points.");
}

/* The smallest of all spaces; INFINITY: not known. */
static double smallest_at(const nh_scan *x, size_t point)
{
    double least = INFINITY;
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k]) least = fmin(least, nh_scan_sigma(x, point, k));
    return least;
}

/* Dark where it is small, black where one more singular value vanishes. */
static void map_of_singular_values(nh_pen *p, const nh_scan *x, nh_cells *cells)
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
        unsigned char shade = least == 0   ? 0
                              : high > low ? (unsigned char)(230 * log(fmin(least, high) / low) / log(high / low))
                                           : 230;
        if (isfinite(least)) snprintf(cells->fill[i], 8, "#%02x%02x%02x", shade, shade, shade);
        else cells->fill[i][0] = 0;
    }
    if (high > 0)
        put_map(p, x, cells, 0, curve, "The smallest singular value over both parameters",
                "The smallest of the singular values over both parameters, on a logarithmic scale: dark is small.");
}

static void maps(nh_pen *p, const nh_scan *x)
{
    nh_cells cells = {.across = x->axis[0].count, .up = x->axis[1].count, .x = along(x, 0), .y = along(x, 1)};
    cells.fill = nh_arena_alloc(x->arena, (x->points + 1) * sizeof *cells.fill);
    map_of_leading(p, x, &cells);
    map_of_singular_values(p, x, &cells);
}

/* ---- the document ---- */

static void figures(nh_pen *p, const nh_scan *x)
{
    if (p->ink->brief) return;
    nh_pen_section(p, "figures", "Figures");
    if (x->axes == 1 && x->axis[0].ascending) curves(p, x);
    else if (x->axes == 2 && x->axis[0].ascending && x->axis[1].ascending) maps(p, x);
    else
        nh_pen_words(p, "Curves are drawn over one parameter, maps over two, both with ascending values. The values at "
                        "all points are in scan.csv.");
}

static void spaces(nh_pen *p, const nh_scan *x)
{
    nh_pen_section(p, "spaces", "Ansatz spaces");
    nh_pen_table(p, "Ansatz spaces whose smallest singular values were followed", "number|functions|space");
    for (size_t k = 0; k < x->spaces; k++)
        if (x->columns[k]) nh_pen_row(p, "%zu|%zu|%s", k + 1, x->columns[k], x->space[k]);
    nh_pen_table_end(p);
}

/* ---- the first screen ---- */

/* Confirmed values, then the others, as many as there is room for. */
static size_t put_specials(const nh_scan *x, bool sure, size_t tail, nh_text *out)
{
    size_t left = 0;
    for (size_t i = 0; i < x->specials; i++) {
        const nh_scan_special *s = &x->special[i];
        if ((s->confirmed || s->kind == NH_SCAN_STEP) != sure || !count_alike(x, i)) continue;
        nh_text block;
        nh_text_init(&block);
        nh_screen_paragraph(2, 2 + NH_SCREEN_HANG,
                            nh_arena_printf(x->arena, "%s%s: %s", sure ? "" : "perhaps ", where(x, i), what(x, s)),
                            &block);
        left += !nh_screen_fit(out, &block, tail);
    }
    return left;
}

static void first_screen(const nh_scan *x, bool colour, nh_text *out)
{
    const char *open[3] = {NULL};
    nh_text words;
    nh_text_init(&words);
    for (size_t a = 0; a < x->axes && a < 3; a++) open[a] = x->axis[a].name;
    put_answer(x, &words);
    nh_screen_begin(out, colour, x->system, open, &words);
    size_t tail = 7 + 2 * x->source->count, left = 0;
    if (!x->chunked) {
        nh_text_add(out, x->specials ? "\n" : "");
        left = put_specials(x, true, tail, out);
        left += put_specials(x, false, tail, out);
        if (left) nh_text_addf(out, "  %zu more (--details)\n", left);
        nh_text_add(out, "\n");
        for (size_t i = 0; i < x->source->count; i++) {
            const char *name = x->source->name[i];
            bool counted = !strcmp(x->source->of, "count");
            nh_text_addf(&words, "%s%s: ", name,
                         counted && !strcmp(name, "dimension")     ? " (conserved polynomials, with 1)"
                         : counted && !strcmp(name, "independent") ? " (independent ones of these)"
                                                                   : "");
            counts(x, i, &words);
            nh_screen_say(out, 0, &words);
        }
        nh_text_add(&words, caution);
        nh_screen_say(out, 0, &words);
    }
    nh_screen_more(out, "the grid, and the spaces that were searched", NULL);
}

void nh_scan_write(const nh_scan *x, const nh_run *run, nh_pen_style style, nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        first_screen(x, style.colour, out);
        return;
    }
    nh_pen pen, *p = &pen;
    bool fitted = false;
    nh_pen_subject subject = {.system = x->system, .dag = x->system->dag, .shown = run->shown};
    for (size_t k = 0; k < x->spaces; k++) fitted |= x->columns[k] > 0;
    nh_pen_begin(p, style, &subject, "a scan", out);
    answer(p, x);
    p->ink->links(p->to, fitted ? "special|Special values|figures|Figures|spaces|Ansatz spaces|repeat|Repeat it"
                                : "special|Special values|figures|Figures|repeat|Repeat it");
    numbers(p, x);
    if (!x->chunked) {
        specials(p, x);
        figures(p, x);
        if (fitted) spaces(p, x);
    }
    nh_pen_end(p, run);
}
