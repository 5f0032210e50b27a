/* benchmark_plots: work against accuracy as plots, the same for motions, reduced equations and the discrete problem,
 * and for page, LaTeX and drawing: at most six curves each, the front of all, and the rest of the points faint. */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"

static const double least_error = 1e-17; /* is drawn there */
static const double near_floor = 1e-3;   /* the floor is shown where it is so near to the errors */
static const double never = 1e9;         /* a curve without points comes last */
enum { most_points = 16 };

/* One run, of whatever kind; work[k] is NAN where panel k does not show it. */
typedef struct {
    size_t line; /* which curve it belongs to */
    double error, floor, expected, work[NH_BENCHMARK_PANELS], low, high;
    bool counts; /* it may be on the front */
    bool front[NH_BENCHMARK_PANELS];
} sample;

typedef struct {
    nh_arena *arena;
    size_t panels, lines, samples;
    const char **name; /* of each line */
    sample *sample;
    const char *error_label, *work_label[NH_BENCHMARK_PANELS];
    bool across; /* the work is drawn across, the error up, as for convergence */
} pool;

static void judge(pool *p)
{
    nh_judge_point *point = nh_alloc_array(p->samples + 1, sizeof *point);
    for (size_t k = 0; k < p->panels; k++) {
        for (size_t i = 0; i < p->samples; i++) {
            const sample *s = &p->sample[i];
            point[i] = (nh_judge_point){s->error, s->floor, s->work[k], s->counts && isfinite(s->work[k]), false};
        }
        nh_judge_front(p->samples, point);
        for (size_t i = 0; i < p->samples; i++) p->sample[i].front[k] = point[i].front;
    }
    nh_free(point);
}

/* ---- which six ---- */

/* By how many powers of ten the best run that is as accurate is cheaper; the mean over a line's runs. */
static double excess_of(const pool *p, size_t line, size_t panel)
{
    double sum = 0;
    size_t n = 0;
    for (size_t i = 0; i < p->samples; i++) {
        const sample *s = &p->sample[i];
        double best = s->work[panel];
        if (s->line != line || !isfinite(best)) continue;
        for (size_t j = 0; j < p->samples; j++)
            if (p->sample[j].counts && fmax(p->sample[j].error, p->sample[j].floor) <= fmax(s->error, s->floor))
                best = fmin(best, p->sample[j].work[panel]);
        sum += log10(s->work[panel] / best);
        n++;
    }
    return n ? sum / (double)n : never;
}

/* First the lines with points on a front, by their number, those of the first panel twice; then those nearest to the
 * front of the last panel, whose work is a count where there is one, so that the choice is the same on every machine. */
static void rank_of(const pool *p, double *rank)
{
    for (size_t line = 0; line < p->lines; line++) {
        size_t on = 0;
        for (size_t i = 0; i < p->samples; i++)
            for (size_t k = 0; k < p->panels; k++)
                if (p->sample[i].line == line && p->sample[i].front[k]) on += k == 0 ? 2 : 1;
        rank[line] = excess_of(p, line, p->panels - 1) - (double)on;
    }
}

/* chosen[k] = line, in the order of the lines; returns their number. */
static size_t choose(const pool *p, size_t chosen[NH_BENCHMARK_CURVES])
{
    double *rank = nh_alloc_array(p->lines + 1, sizeof *rank);
    size_t n = 0;
    rank_of(p, rank);
    for (size_t line = 0; line < p->lines; line++) {
        size_t before = 0;
        for (size_t o = 0; o < p->lines; o++) before += rank[o] < rank[line] || (rank[o] == rank[line] && o < line);
        if (before < NH_BENCHMARK_CURVES && rank[line] < never / 2) chosen[n++] = line;
    }
    nh_free(rank);
    return n;
}

/* ---- curves ---- */

static nh_curve begun(nh_arena *arena, const char *name, size_t room)
{
    double *x = nh_arena_alloc(arena, 4 * (room + 1) * sizeof *x);
    nh_mark_style *style = nh_arena_alloc(arena, (room + 1) * sizeof *style);
    return (nh_curve){.name = name,
                      .x = x,
                      .y = x + room + 1,
                      .low = x + 2 * (room + 1),
                      .high = x + 3 * (room + 1),
                      .style = style,
                      .x_stride = 1,
                      .y_stride = 1};
}

static void put(nh_curve *f, const pool *p, const sample *s, size_t panel)
{
    if (!isfinite(s->work[panel])) return;
    size_t i = f->count++;
    bool spread = panel == 0 && !p->across;
    double error = fmax(s->error, least_error);
    ((double *)f->x)[i] = p->across ? s->work[panel] : error;
    ((double *)f->y)[i] = p->across ? error : s->work[panel];
    ((double *)f->low)[i] = spread ? s->low : NAN;
    ((double *)f->high)[i] = spread ? s->high : NAN;
    ((nh_mark_style *)f->style)[i] = nh_judge_below(s->error, s->floor) ? NH_MARK_HOLLOW
                                     : s->front[panel]                  ? NH_MARK_FULL
                                                                        : NH_MARK_PALE;
}

static int by_error(const void *a, const void *b)
{
    const sample *s = *(const sample *const *)a, *t = *(const sample *const *)b;
    return (s->error > t->error) - (s->error < t->error);
}

static nh_curve front_of(const pool *p, size_t panel)
{
    const sample **on = nh_alloc_array(p->samples + 1, sizeof *on);
    size_t n = 0;
    for (size_t i = 0; i < p->samples; i++)
        if (p->sample[i].front[panel]) on[n++] = &p->sample[i];
    qsort(on, n, sizeof *on, by_error);
    nh_curve f = begun(p->arena, "best of these", n);
    f.front = true;
    for (size_t i = 0; i < n; i++) put(&f, p, on[i], panel);
    nh_free(on);
    return f;
}

/* What is expected of the first line that is shown. */
static nh_curve expected(const pool *p, size_t panel, size_t line)
{
    nh_curve f = begun(p->arena, "expected", p->samples);
    f.expected = true;
    for (size_t i = 0; i < p->samples; i++) {
        sample s = p->sample[i];
        s.error = s.expected;
        if (s.line == line && s.expected > 0) put(&f, p, &s, panel);
    }
    return f;
}

static bool is_chosen(size_t n, const size_t *chosen, size_t line)
{
    bool any = false;
    for (size_t k = 0; k < n; k++) any |= chosen[k] == line;
    return any;
}

static size_t curves_of(const pool *p, size_t panel, size_t n, const size_t *chosen, nh_curve *curve)
{
    size_t curves = 0;
    curve[curves++] = front_of(p, panel);
    for (size_t k = 0; k < n; k++) {
        nh_curve f = begun(p->arena, p->name[chosen[k]], p->samples);
        for (size_t i = 0; i < p->samples; i++)
            if (p->sample[i].line == chosen[k]) put(&f, p, &p->sample[i], panel);
        f.dots = p->across && panel == 1; /* its points have several degrees and numbers of samples */
        curve[curves++] = f;
    }
    nh_curve rest = begun(p->arena, "", p->samples);
    rest.faint = true;
    for (size_t i = 0; i < p->samples; i++)
        if (!is_chosen(n, chosen, p->sample[i].line)) put(&rest, p, &p->sample[i], panel);
    if (rest.count) curve[curves++] = rest;
    if (p->across && n && panel != 1) curve[curves++] = expected(p, panel, chosen[0]);
    return curves;
}

static void hold(double range[2], double value)
{
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

/* The ranges of error and work that a plot must hold, so that plots of different parts of `all` can be compared; the
 * floor, too, where it is near. */
static double *ranges_of(const pool *all, size_t panel, double floor, double **of_work)
{
    double *error = nh_arena_alloc(all->arena, 4 * sizeof *error), *work = error + 2;
    error[0] = work[0] = INFINITY, error[1] = work[1] = -INFINITY;
    for (size_t i = 0; i < all->samples; i++)
        if (isfinite(all->sample[i].work[panel])) {
            hold(error, fmax(all->sample[i].error, least_error));
            hold(work, all->sample[i].work[panel]);
        }
    if (floor >= near_floor * error[0]) hold(error, floor);
    *of_work = work;
    return error;
}

static nh_plot panel_of(const pool *p, const pool *all, size_t panel, size_t n, const size_t *chosen, const char *title)
{
    nh_curve *curve = nh_arena_alloc(p->arena, (NH_BENCHMARK_CURVES + 3) * sizeof *curve);
    size_t curves = curves_of(p, panel, n, chosen, curve);
    double floor = INFINITY, *work;
    for (size_t i = 0; i < p->samples; i++) floor = fmin(floor, p->sample[i].floor);
    double *error = ranges_of(all, panel, floor, &work);
    return (nh_plot){.title = title,
                     .description = "Both axes are logarithmic",
                     .x_label = p->across ? p->work_label[panel] : p->error_label,
                     .y_label = p->across ? p->error_label : p->work_label[panel],
                     .log_x = true,
                     .log_y = true,
                     .floor = least_error,
                     .shaded = p->across ? 0 : floor,
                     .shaded_name = "not told from the reference",
                     .also_x = p->across ? work : error,
                     .also_y = p->across ? error : work,
                     .tall = 340,
                     .close = true,
                     .curves = curves,
                     .curve = curve};
}

static bool plot(pool *p, const pool *all, const char *title, const char *caption, nh_benchmark_row *out)
{
    size_t chosen[NH_BENCHMARK_CURVES];
    if (!p->samples) return false;
    judge(p);
    size_t n = choose(p, chosen);
    *out = (nh_benchmark_row){.title = title, .caption = caption, .fit = p->across, .panels = p->panels};
    for (size_t k = 0; k < p->panels; k++) out->panel[k] = panel_of(p, all, k, n, chosen, title);
    for (size_t line = 0; line < p->lines; line++) out->others += !is_chosen(n, chosen, line);
    if (out->others)
        out->caption = nh_arena_printf(p->arena, "%s Small grey points: %zu further curve%s.", caption, out->others,
                                       out->others == 1 ? "" : "s");
    return true;
}

/* ---- motions and reduced equations ---- */

typedef bool (*kind)(const nh_run_record *m);
static bool whole(const nh_run_record *m) { return !m->reduced; }
static bool stepping(const nh_run_record *m) { return !m->reduced && m->order > 0; }
static bool reduced(const nh_run_record *m) { return m->reduced; }

static bool same_line(const nh_run_record *a, const nh_run_record *b)
{
    return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation);
}

/* Runs of a kind; `main`: the formulation that is not named, because the title names it. */
static pool runs(const nh_benchmark *c, nh_arena *arena, kind is, const char *main)
{
    pool p = {.arena = arena,
              .panels = 2,
              .error_label = "error, relative",
              .work_label = {"seconds", "evaluations of the right-hand side"}};
    p.name = nh_arena_alloc(arena, (c->count + 1) * sizeof *p.name);
    p.sample = nh_arena_alloc(arena, (c->count + 1) * sizeof *p.sample);
    const nh_run_record *last = NULL;
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (!is(m) || m->status > NH_FLAGGED || !isfinite(m->error) || !(m->seconds > 0) || m->evaluations <= 0)
            continue;
        if (!last || !same_line(last, m))
            p.name[p.lines++] = main && !strcmp(m->formulation, main)
                                    ? m->method
                                    : nh_arena_printf(arena, "%s: %s", m->method, m->formulation);
        last = m;
        p.sample[p.samples++] = (sample){.line = p.lines - 1,
                                         .error = m->error,
                                         .floor = m->floor,
                                         .work = {m->seconds, (double)m->evaluations},
                                         .low = m->seconds_low,
                                         .high = m->seconds_high,
                                         .counts = m->status == NH_ACCURATE};
    }
    return p;
}

/* ---- the discrete problem ---- */

/* The largest number of samples of its degree. */
static bool is_densest(const nh_benchmark *c, const nh_fitted *m)
{
    for (size_t i = 0; i < c->fits; i++)
        if (c->fit[i].degree == m->degree && c->fit[i].samples > m->samples) return false;
    return true;
}

static bool is_known(const nh_fitted *m) { return m->right && isfinite(m->error) && m->seconds > 0; }

static bool one_grid(const nh_benchmark *c)
{
    for (size_t i = 1; i < c->fits; i++)
        if (strcmp(c->fit[i].grid, c->fit[0].grid)) return false;
    return true;
}

/* How many numbers of samples there are with this degree; those of one number stand together. */
static size_t numbers_of_samples(const nh_benchmark *c, size_t degree)
{
    size_t n = 0, last = 0;
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        if (!is_known(m) || m->degree != degree || m->samples == last) continue;
        last = m->samples;
        n++;
    }
    return n;
}

/* One line per grid and way to solve it.  Against the number of functions the solutions with the most samples are
 * shown, against the time all, against the number of samples, where there are enough of them, those of the largest
 * degree. */
static pool fits(const nh_benchmark *c, nh_arena *arena)
{
    enum { enough = 4 };
    pool p = {.arena = arena,
              .panels = 2,
              .across = true,
              .error_label = "distance of the known currents",
              .work_label = {"functions of the ansatz, with the most samples", "seconds",
                             "sample points, with the most functions"}};
    size_t largest = 0;
    bool one = one_grid(c);
    p.name = nh_arena_alloc(arena, (c->fits + 1) * sizeof *p.name);
    p.sample = nh_arena_alloc(arena, (c->fits + 1) * sizeof *p.sample);
    for (size_t i = 0; i < c->fits; i++)
        if (c->fit[i].degree > largest && numbers_of_samples(c, c->fit[i].degree) >= enough) largest = c->fit[i].degree;
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        if (!is_known(m)) continue;
        const char *way = nh_arena_printf(arena, "%s, %s route, %s", m->basis, m->route, m->solver);
        const char *name = one ? way : nh_arena_printf(arena, "%s: %s", m->grid, way);
        size_t line = 0;
        while (line < p.lines && strcmp(p.name[line], name)) line++;
        if (line == p.lines) p.name[p.lines++] = name;
        p.sample[p.samples++] = (sample){.line = line,
                                         .error = m->error,
                                         .expected = m->expected,
                                         .work = {is_densest(c, m) ? (double)m->functions : NAN, m->seconds,
                                                  m->degree == largest ? (double)m->samples : NAN},
                                         .counts = true};
    }
    if (largest) p.panels = 3;
    return p;
}

/* ---- all rows ---- */

size_t nh_benchmark_rows(const nh_benchmark *c, nh_arena *arena, nh_benchmark_row out[NH_BENCHMARK_ROWS])
{
    static const char marks[] = "Full: no other run is both cheaper and more accurate; pale: one is; hollow: an error "
                                "within that of the reference. Bars: quartiles of repeated runs.";
    const char *main = c->count ? c->item[0].formulation : "";
    size_t n = 0;
    pool all = runs(c, arena, whole, main), p;
    n += plot(&all, &all, nh_arena_printf(arena, "All methods, in %s where no other is named", main), marks, &out[n]);
    p = runs(c, arena, stepping, main);
    nh_text orders;
    nh_text_init(&orders);
    nh_benchmark_put_orders(c, 3, &orders);
    n += plot(&p, &all, nh_arena_printf(arena, "Methods with a fixed step, in %s where no other is named", main),
              nh_arena_printf(arena, "%s %s", marks, nh_text_string(&orders)), &out[n]);
    nh_text_clear(&orders);
    p = runs(c, arena, reduced, NULL);
    p.error_label = "error of the reduced states, relative";
    n += plot(&p, &p, "Equations reduced by a symmetry group", marks, &out[n]);
    p = fits(c, arena);
    n += plot(
        &p, &p, "The discrete problem: how far the known currents are from the space that is found",
        "Full: no other solution is both cheaper and nearer; pale: one is. Expected (dashed): what rounding leaves, "
        "epsilon times the largest over the first singular value that is not null.",
        &out[n]);
    return n;
}
