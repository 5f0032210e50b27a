/* The integrators compared, as a document. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"

enum { most_lines = 35 }; /* colours times dashes */

static bool same_line(const nh_run_record *a, const nh_run_record *b) { return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation); }

static bool shown(const nh_run_record *m) { return m->status <= NH_FLAGGED && isfinite(m->error) && m->seconds > 0; }

/* ---- the answer ---- */

static const char *set_by(const nh_run_record *m) { return isnan(m->step) ? "tolerance" : "step"; }

static double set_to(const nh_run_record *m) { return isnan(m->step) ? m->tolerance : m->step; }

static void answer(nh_pen *p, const nh_benchmark *c)
{
    const nh_run_record *best = nh_benchmark_fastest(c, 0, c->count, 1e-6, false);
    nh_pen_open(p, NH_PEN_ANSWER, best ? "found" : "undecided", NULL);
    if (best) nh_pen_say(p, "Fastest below an error of a millionth: %s in {%s}.", best->method, best->formulation);
    else nh_pen_say(p, "No method came below an error of a millionth.");
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_pen_words(p, "One motion, t = %.6g to %.6g, by every integrator in every formulation, measured on this machine. Reference: {%s}; {%s} agrees to %.1g, "
                 "so that smaller errors mean nothing.", c->begin, c->end, c->reference, c->second, c->agreement);
    const char *warning[NH_BENCHMARK_WARNINGS];
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_pen_warning(p, warning[i]);
    if (c->partial) nh_pen_warning(p, "the budget ended before every method had all its runs; --budget allows more");
}

static void fastest(nh_pen *p, const nh_benchmark *c)
{
    nh_pen_table(p, "The fastest below an error of ...", "error below|method|formulation|set to|error|drift|seconds|evaluations");
    for (size_t i = 0; i < NH_BENCHMARK_GOALS; i++) {
        char goal[24];
        const nh_run_record *m = nh_benchmark_fastest(c, 0, c->count, nh_benchmark_goal[i], false);
        snprintf(goal, sizeof goal, "10^(%.0f)", log10(nh_benchmark_goal[i]));
        if (m)
            nh_pen_row(p, "#<%s>|%s|{%s}|%s %.3g|%.2g|%.2g|%.3g|%.10g", goal, m->method, m->formulation, set_by(m), set_to(m), m->error, m->worst_drift,
                       m->seconds, (double)m->evaluations);
    }
    nh_pen_table_end(p);
    for (size_t i = 0; i < c->refused; i++) nh_pen_words(p, "Not used, %s.", c->refusal[i]);
}

/* ---- time against error ---- */

static void flush(nh_pen *p, const char *formulation, size_t n, const nh_curve *curve)
{
    char title[200], caption[300];
    if (!n) return;
    snprintf(title, sizeof title, "Time against error, %.120s", formulation);
    snprintf(caption, sizeof caption, "Seconds against error, %.120s. Down and to the left is better; each line is one method from loose to tight.",
             formulation);
    nh_plot plot = {.title = title, .description = "Both axes are logarithmic", .x_label = "error, relative", .y_label = "seconds", .log_x = true,
                    .log_y = true, .floor = 1e-17, .curves = n, .curve = curve};
    nh_pen_plot(p, &plot, caption);
}

/* One plot per formulation, one line per method. */
static void plots(nh_pen *p, const nh_benchmark *c)
{
    double *x = nh_alloc_array(2 * c->count + 1, sizeof *x), *y = x + c->count;
    nh_curve curve[most_lines];
    size_t n = 0;
    for (size_t i = 0, next; i < c->count; i = next) {
        size_t points = 0;
        for (next = i; next < c->count && same_line(&c->item[i], &c->item[next]); next++) {
            const nh_run_record *m = &c->item[next];
            if (!shown(m)) continue;
            x[i + points] = fmax(m->error, fmax(c->agreement, 1e-16));
            y[i + points++] = m->seconds;
        }
        if (points) curve[n++] = (nh_curve){.name = c->item[i].method, .count = points, .x = x + i, .x_stride = 1, .y = y + i, .y_stride = 1, .marks = true};
        bool last = next == c->count || strcmp(c->item[i].formulation, c->item[next].formulation);
        if (!last && n < most_lines) continue;
        flush(p, c->item[i].formulation, n, curve);
        n = 0;
    }
    nh_free(x);
}

static void all_runs(nh_pen *p, const nh_benchmark *c)
{
    nh_pen_open(p, NH_PEN_FOLD, NULL, "All runs");
    nh_pen_table(p, "All runs", "method|formulation|set to|status|error|drift|seconds|evaluations|note");
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        nh_pen_row(p, "%s|{%s}|%s %.3g|!%s|%.2g|%.2g|%.3g|%.10g|%s", m->method, m->formulation, set_by(m), set_to(m), nh_run_record_status_name(m->status),
                   m->error, m->worst_drift, m->seconds, (double)m->evaluations, m->note ? m->note : "");
    }
    nh_pen_table_end(p);
    nh_pen_close(p, NH_PEN_FOLD);
}

static void derivatives(nh_pen *p, const nh_benchmark *c)
{
    if (!c->derivatives) return;
    nh_pen_table(p, "One Jacobian of the equations of motion", "by|seconds|evaluations|off by");
    for (size_t i = 0; i < c->derivatives; i++) {
        const nh_derivative *d = &c->derivative[i];
        if (isfinite(d->seconds)) nh_pen_row(p, "%s|%.3g|%.10g|%.1g", d->method, d->seconds, (double)d->evaluations, d->error);
    }
    nh_pen_table_end(p);
}

/* ---- the discrete problem ---- */

static bool same_way(const nh_fitted *a, const nh_fitted *b) { return !strcmp(a->basis, b->basis) && !strcmp(a->route, b->route) && !strcmp(a->solver, b->solver); }

/* One plot per size of the ansatz; one line per way to solve it, over the samples. */
static void fit_plot(nh_pen *p, const nh_benchmark *c, size_t first, size_t last)
{
    enum { most = 12 };
    size_t n = 0, room = last - first;
    double *x = nh_alloc_array(2 * most * room + 1, sizeof *x);
    char name[most][120], title[120], caption[240];
    nh_curve curve[most];
    for (size_t i = first; i < last && n < most; i++) {
        bool told = false;
        for (size_t j = first; j < i; j++) told |= same_way(&c->fit[i], &c->fit[j]);
        double *at = x + 2 * n * room, *y = at + room;
        size_t count = 0;
        for (size_t j = i; j < last && !told; j++)
            if (same_way(&c->fit[i], &c->fit[j]) && c->fit[j].right && isfinite(c->fit[j].error)) at[count] = fmax(c->fit[j].error, 1e-17), y[count++] = c->fit[j].seconds;
        if (!count) continue;
        snprintf(name[n], sizeof *name, "%.30s, %.30s, %.30s", c->fit[i].basis, c->fit[i].route, c->fit[i].solver);
        curve[n] = (nh_curve){.name = name[n], .count = count, .x = at, .x_stride = 1, .y = y, .y_stride = 1, .marks = true};
        n++;
    }
    snprintf(title, sizeof title, "Time against error, %zu functions", c->fit[first].functions);
    nh_plot plot = {.title = title, .description = "Both axes are logarithmic", .x_label = "distance of the known currents from the null space", .y_label = "seconds", .log_x = true, .log_y = true, .floor = 1e-18, .curves = n, .curve = curve};
    snprintf(caption, sizeof caption, "%s. Each line is one way to solve it, with few to many samples.", title);
    if (n) nh_pen_plot(p, &plot, caption);
    nh_free(x);
}

static void discrete(nh_pen *p, const nh_benchmark *c)
{
    if (!c->fits) return;
    nh_pen_section(p, "discrete", "The discrete problem");
    nh_pen_words(p, "The linear problem by which nhsym analyze finds currents, of polynomials in velocities, sines, cosines and coordinates, solved in several ways: "
                 "by how far the known currents are from its null space, and how long it takes. Down and to the left is better.");
    for (size_t i = 0, next; i < c->fits; i = next) {
        for (next = i; next < c->fits && c->fit[next].functions == c->fit[i].functions;) next++;
        fit_plot(p, c, i, next);
    }
    nh_pen_open(p, NH_PEN_FOLD, NULL, "All solutions");
    nh_pen_table(p, "All solutions", "functions|columns|samples|basis|route|solver|null values|gap|error|seconds|result");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_pen_row(p, "%zu|%zu|%zu|%s|%s|%s|%zu|%.2g|%.2g|%.3g|%s", m->functions, m->columns, m->samples, m->basis, m->route, m->solver, m->dimension, m->gap,
                   m->error, m->seconds, nh_fitted_word(m));
    }
    nh_pen_table_end(p);
    nh_pen_close(p, NH_PEN_FOLD);
}

/* ---- where methods fail ---- */

/* A table: the first quantity downwards, across it the methods, or for one method the second quantity. */
static void map_of(nh_pen *p, const nh_robustness_map *map, size_t first, size_t step, size_t across, const char *caption, const char *corner)
{
    const nh_robustness_cell *cell = map->cell + first;
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, corner);
    for (size_t j = 0; j < across; j++) {
        if (map->second_axis) nh_text_addf(&heads, "|%.4g", cell[j * step].second_at);
        else nh_text_addf(&heads, "|%s", cell[j].method);
    }
    nh_pen_table(p, caption, nh_text_string(&heads));
    nh_text_clear(&heads);
    for (size_t j = 0; j * step < map->cells; j++) {
        const nh_robustness_cell *at = &cell[j * step];
        if (j % across == 0) {
            if (j) nh_pen_close(p, NH_PEN_ROW);
            nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
            nh_pen_open(p, NH_PEN_ROW_HEAD, NULL, NULL);
            nh_pen_say(p, "%.4g", at->at);
            nh_pen_close(p, NH_PEN_ROW_HEAD);
        }
        nh_pen_open(p, NH_PEN_KIND, nh_run_record_status_name(at->status), at->note);
        nh_pen_say(p, "%s", nh_run_record_status_name(at->status));
        nh_pen_close(p, NH_PEN_KIND);
    }
    if (map->cells) nh_pen_close(p, NH_PEN_ROW);
    nh_pen_table_end(p);
}

static void map_table(nh_pen *p, const nh_robustness_map *map)
{
    char caption[300], corner[200];
    size_t values = map->cells / map->methods, across = 1;
    if (!map->second_axis) {
        map_of(p, map, 0, 1, map->methods, map->name, map->axis);
        return;
    }
    while (across < values && map->cell[across * map->methods].at == map->cell[0].at) across++;
    snprintf(corner, sizeof corner, "%.90s \u2193  %.90s \u2192", map->axis, map->second_axis);
    for (size_t j = 0; j < map->methods; j++) {
        snprintf(caption, sizeof caption, "%.200s: %.80s", map->name, map->cell[j].method);
        map_of(p, map, j, map->methods, across, caption, corner);
    }
}

static void robustness(nh_pen *p, const nh_robustness *s)
{
    if (!s) return;
    nh_pen_section(p, "robustness", "Where methods fail");
    nh_pen_words(p, "Accurate; flagged: accurate, and a safeguard triggered; detected: not accurate, and a safeguard says so; "
                 "failed: ended early, with a reason; timeout; undetected: not accurate, and no safeguard triggered.");
    for (size_t i = 0; i < s->maps; i++) map_table(p, &s->map[i]);
}

void nh_benchmark_write(const nh_benchmark *c, const nh_robustness *s, const nh_run *run, nh_pen_style style, nh_text *out)
{
    const nh_simulation *q = c->question;
    nh_pen pen, *p = &pen;
    char sections[200];
    if (style.form == NH_PEN_TEXT) {
        nh_benchmark_text(c, style.verbose, out);
        if (s) nh_robustness_text(s, style.verbose, out);
        return;
    }
    nh_pen_subject subject = {.system = q->system, .analysis = q->analysis, .dag = q->model->dag, .shown = run->shown};
    nh_pen_begin(p, style, &subject, "integrators compared", out);
    answer(p, c);
    snprintf(sections, sizeof sections, "methods|Methods|%s%ssystem|System|words|Words|repeat|Repeat it", c->fits ? "discrete|The discrete problem|" : "",
             s ? "robustness|Where they fail|" : "");
    p->ink->links(p->to, sections);
    nh_pen_section(p, "methods", "Methods");
    fastest(p, c);
    plots(p, c);
    derivatives(p, c);
    all_runs(p, c);
    discrete(p, c);
    robustness(p, s);
    nh_pen_system(p, NULL, NULL);
    nh_pen_glossary(p, "accurate, flagged, detected, undetected, timeout, drift");
    nh_pen_end(p, run);
}
