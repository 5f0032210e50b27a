/* The integrators compared, as a page. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"
#include "document/html_internal.h"

enum { most_lines = 35 }; /* colours times dashes */

static bool same_line(const nh_run_record *a, const nh_run_record *b) { return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation); }

static bool shown(const nh_run_record *m) { return m->status <= NH_FLAGGED && isfinite(m->error) && m->seconds > 0; }

/* ---- the answer ---- */

static void step_or_tolerance(nh_html_writer *w, const nh_run_record *m)
{
    nh_html_add(w, isnan(m->step) ? "tolerance " : "step ");
    nh_html_number(w, isnan(m->step) ? m->tolerance : m->step, 3);
}

/* Settings and results of a run, as cells of its row. */
static void set_to(nh_html_writer *w, const nh_run_record *m)
{
    nh_html_tagged(w, "td", m->method);
    nh_html_add(w, "<td>");
    nh_html_chart_name(w, m->formulation);
    nh_html_add(w, "</td><td>");
    step_or_tolerance(w, m);
    nh_html_add(w, "</td>");
}

static void measured(nh_html_writer *w, const nh_run_record *m)
{
    nh_html_cell(w, m->error, 2);
    nh_html_cell(w, m->worst_drift, 2);
    nh_html_cell(w, m->seconds, 3);
    nh_html_cell(w, (double)m->evaluations, 10);
}

static void best_line(nh_html_writer *w, const nh_run_record *m, const char *goal)
{
    nh_text_addf(w->out, "<tr><th scope=\"row\">%s</th>", goal);
    set_to(w, m);
    measured(w, m);
    nh_html_add(w, "</tr>\n");
}

static void answer(nh_html_writer *w, const nh_benchmark *c)
{
    const nh_run_record *best = nh_benchmark_fastest(c, 0, c->count, 1e-6, false);
    nh_html_add(w, best ? "<p class=\"answer found\">Fastest below an error of a millionth: " : "<p class=\"answer undecided\">No method came below an error of a millionth");
    if (best) {
        nh_html_text(w, best->method);
        nh_html_add(w, " in ");
        nh_html_chart_name(w, best->formulation);
    }
    nh_html_add(w, ".</p>\n<p>One motion, t = ");
    nh_html_number(w, c->begin, 6);
    nh_html_add(w, " to ");
    nh_html_number(w, c->end, 6);
    nh_html_add(w, ", by every integrator in every formulation, measured on this machine. Reference: ");
    nh_html_chart_name(w, c->reference);
    nh_html_add(w, "; ");
    nh_html_chart_name(w, c->second);
    nh_html_add(w, " agrees to ");
    nh_html_number(w, c->agreement, 1);
    nh_html_add(w, ", so that smaller errors mean nothing.</p>\n");
    const char *warning[NH_BENCHMARK_WARNINGS];
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_html_warning(w, warning[i]);
    if (c->partial) nh_html_warning(w, "the budget ended before every method had all its runs; --budget allows more");
}

static void fastest(nh_html_writer *w, const nh_benchmark *c)
{
    static const struct {
        double below;
        const char *text;
    } goal[] = {{1e-3, "10<sup>\u22123</sup>"}, {1e-6, "10<sup>\u22126</sup>"}, {1e-9, "10<sup>\u22129</sup>"}, {1e-12, "10<sup>\u221212</sup>"}};
    nh_html_table(w, "The fastest below an error of ...", "error below|method|formulation|set to|error|drift|seconds|evaluations");
    for (size_t g = 0; g < sizeof goal / sizeof *goal; g++) {
        const nh_run_record *m = nh_benchmark_fastest(c, 0, c->count, goal[g].below, false);
        if (m) best_line(w, m, goal[g].text);
    }
    nh_html_table_end(w);
    for (size_t i = 0; i < c->refused; i++) {
        nh_html_add(w, "<p>Not used, ");
        nh_html_text(w, c->refusal[i]);
        nh_html_add(w, ".</p>\n");
    }
}

/* ---- time against error ---- */

static void flush(nh_html_writer *w, const char *formulation, size_t n, const nh_curve *curve)
{
    char title[200], caption[300];
    if (!n) return;
    snprintf(title, sizeof title, "Time against error, %.120s", formulation);
    snprintf(caption, sizeof caption, "Seconds against error, %.120s. Down and to the left is better; each line is one method from loose to tight.", formulation);
    nh_plot plot = {.title = title, .description = "Both axes are logarithmic", .x_label = "error, relative", .y_label = "seconds", .log_x = true, .log_y = true, .floor = 1e-17, .curves = n, .curve = curve};
    nh_html_figure(w, &plot, caption);
}

/* One plot per formulation, one line per method. */
static void plots(nh_html_writer *w, const nh_benchmark *c)
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
        flush(w, c->item[i].formulation, n, curve);
        n = 0;
    }
    nh_free(x);
}

static void all_runs(nh_html_writer *w, const nh_benchmark *c)
{
    nh_html_add(w, "<details><summary>All runs</summary>\n");
    nh_html_table(w, "All runs", "method|formulation|set to|status|error|drift|seconds|evaluations|note");
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        nh_html_add(w, "<tr>");
        set_to(w, m);
        nh_text_addf(w->out, "<td class=\"%s\">%s</td>", nh_run_record_status_name(m->status), nh_run_record_status_name(m->status));
        measured(w, m);
        nh_html_tagged(w, "td", m->note ? m->note : "");
        nh_html_add(w, "</tr>\n");
    }
    nh_html_table_end(w);
    nh_html_add(w, "</details>\n");
}

static void derivatives(nh_html_writer *w, const nh_benchmark *c)
{
    if (!c->derivatives) return;
    nh_html_table(w, "One Jacobian of the equations of motion", "by|seconds|evaluations|off by");
    for (size_t i = 0; i < c->derivatives; i++) {
        const nh_derivative *d = &c->derivative[i];
        if (!isfinite(d->seconds)) continue;
        nh_html_add(w, "<tr>");
        nh_html_tagged(w, "td", d->method);
        nh_html_cell(w, d->seconds, 3);
        nh_html_cell(w, (double)d->evaluations, 10);
        nh_html_cell(w, d->error, 1);
        nh_html_add(w, "</tr>\n");
    }
    nh_html_table_end(w);
}

/* ---- the discrete problem ---- */

static bool same_way(const nh_fitted *a, const nh_fitted *b) { return !strcmp(a->basis, b->basis) && !strcmp(a->route, b->route) && !strcmp(a->solver, b->solver); }

/* One plot per size of the ansatz; one line per way to solve it, over the samples. */
static void fit_plot(nh_html_writer *w, const nh_benchmark *c, size_t first, size_t last)
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
    if (n) nh_html_figure(w, &plot, caption);
    nh_free(x);
}

static void fit_row(nh_html_writer *w, const nh_fitted *m)
{
    nh_html_add(w, "<tr>");
    nh_html_cell(w, (double)m->functions, 10);
    nh_html_cell(w, (double)m->columns, 10);
    nh_html_cell(w, (double)m->samples, 10);
    nh_html_tagged(w, "td", m->basis);
    nh_html_tagged(w, "td", m->route);
    nh_html_tagged(w, "td", m->solver);
    nh_html_cell(w, (double)m->dimension, 10);
    nh_html_cell(w, m->gap, 2);
    nh_html_cell(w, m->error, 2);
    nh_html_cell(w, m->seconds, 3);
    nh_html_tagged(w, "td", nh_fitted_word(m));
    nh_html_add(w, "</tr>\n");
}

static void discrete(nh_html_writer *w, const nh_benchmark *c)
{
    if (!c->fits) return;
    nh_html_add(w, "<section id=\"discrete\"><h2>The discrete problem</h2>\n<p>The linear problem by which <code>analyze</code> finds currents, of polynomials in velocities, sines, cosines and coordinates, "
                   "solved in several ways: by how far the known currents are from its null space, and how long it takes. Down and to the left is better.</p>\n");
    for (size_t i = 0, next; i < c->fits; i = next) {
        for (next = i; next < c->fits && c->fit[next].functions == c->fit[i].functions;) next++;
        fit_plot(w, c, i, next);
    }
    nh_html_add(w, "<details><summary>All solutions</summary>\n");
    nh_html_table(w, "All solutions", "functions|columns|samples|basis|route|solver|null values|gap|error|seconds|result");
    for (size_t i = 0; i < c->fits; i++) fit_row(w, &c->fit[i]);
    nh_html_table_end(w);
    nh_html_add(w, "</details>\n</section>\n");
}

/* ---- stability maps ---- */

/* A cell with what its safeguard says, or why it failed, where the pointer rests on it. */
static void stability_cell(nh_html_writer *w, const nh_robustness_cell *cell)
{
    nh_text_addf(w->out, "<td class=\"%s\"", nh_run_record_status_name(cell->status));
    if (cell->note && cell->note[0]) {
        nh_html_add(w, " title=\"");
        nh_html_text(w, cell->note);
        nh_html_add(w, "\"");
    }
    nh_text_addf(w->out, ">%s</td>", nh_run_record_status_name(cell->status));
}

static void head_cell(nh_html_writer *w, const char *text)
{
    nh_html_add(w, "<th scope=\"col\">");
    nh_html_text(w, text);
    nh_html_add(w, "</th>");
}

static void row_head(nh_html_writer *w, double at)
{
    nh_html_add(w, "<th scope=\"row\">");
    nh_html_number(w, at, 4);
    nh_html_add(w, "</th>");
}

/* Over one thing: its values downwards, methods across. */
static void line_map(nh_html_writer *w, const nh_robustness_map *map)
{
    nh_html_table(w, map->name, NULL);
    nh_html_add(w, "<tr>");
    head_cell(w, map->axis);
    for (size_t j = 0; j < map->methods; j++) head_cell(w, map->cell[j].method);
    for (size_t j = 0; j < map->cells; j++) {
        if (j % map->methods == 0) {
            nh_html_add(w, "</tr>\n<tr>");
            row_head(w, map->cell[j].at);
        }
        stability_cell(w, &map->cell[j]);
    }
    nh_html_add(w, "</tr>\n");
    nh_html_table_end(w);
}

/* Over two: the first downwards, the second across, a table per method. */
static void plane_map(nh_html_writer *w, const nh_robustness_map *map, size_t method)
{
    char caption[300], corner[200];
    size_t values = map->cells / map->methods, across = 1;
    const nh_robustness_cell *cell = map->cell + method;
    while (across < values && map->cell[across * map->methods].at == map->cell[0].at) across++;
    snprintf(caption, sizeof caption, "%.200s: %.80s", map->name, cell->method);
    snprintf(corner, sizeof corner, "%.90s \u2193  %.90s \u2192", map->axis, map->second_axis);
    nh_html_table(w, caption, NULL);
    nh_html_add(w, "<tr>");
    head_cell(w, corner);
    for (size_t j = 0; j < across; j++) {
        nh_html_add(w, "<th scope=\"col\">");
        nh_html_number(w, cell[j * map->methods].second_at, 4);
        nh_html_add(w, "</th>");
    }
    for (size_t j = 0; j < values; j++) {
        if (j % across == 0) {
            nh_html_add(w, "</tr>\n<tr>");
            row_head(w, cell[j * map->methods].at);
        }
        stability_cell(w, &cell[j * map->methods]);
    }
    nh_html_add(w, "</tr>\n");
    nh_html_table_end(w);
}

static void stability_map(nh_html_writer *w, const nh_robustness_map *map)
{
    if (!map->second_axis) line_map(w, map);
    for (size_t j = 0; map->second_axis && j < map->methods; j++) plane_map(w, map, j);
}

static void robustness(nh_html_writer *w, const nh_robustness *s)
{
    if (!s) return;
    nh_html_add(w, "<section id=\"robustness\"><h2>Where methods fail</h2>\n<p>Accurate; flagged: accurate, and a safeguard triggered; detected: not accurate, and a safeguard says so; "
                   "failed: ended early, with a reason; timeout; undetected: not accurate, and no safeguard triggered.</p>\n");
    for (size_t i = 0; i < s->maps; i++) stability_map(w, &s->map[i]);
    nh_html_add(w, "</section>\n");
}

void nh_html_benchmark(const nh_benchmark *c, const nh_robustness *s, const nh_run *run, nh_text *out)
{
    const nh_simulation *q = c->question;
    nh_html_writer w = {.out = out, .system = q->system, .analysis = q->analysis, .dag = q->model->dag, .shown = run->shown, .written = INFINITY};
    nh_html_begin(&w, "integrators compared");
    answer(&w, c);
    char sections[200];
    snprintf(sections, sizeof sections, "methods|Methods|%s%ssystem|System|words|Words|repeat|Repeat it", c->fits ? "discrete|The discrete problem|" : "", s ? "robustness|Where they fail|" : "");
    nh_html_links(&w, sections);
    nh_html_add(&w, "<section id=\"methods\"><h2>Methods</h2>\n");
    fastest(&w, c);
    plots(&w, c);
    derivatives(&w, c);
    all_runs(&w, c);
    nh_html_add(&w, "</section>\n");
    discrete(&w, c);
    robustness(&w, s);
    nh_html_add(&w, "<section id=\"system\"><h2>The system</h2>\n");
    nh_html_written(&w);
    nh_html_add(&w, "</section>\n");
    nh_html_words(&w, "accurate, flagged, detected, undetected, timeout, drift");
    nh_html_repeat(&w, run);
    nh_html_end(&w);
}
