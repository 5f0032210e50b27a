/* The integrators compared, as a document. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"
#include "document/screen.h"

enum { most_lines = 35 }; /* colours, times dashes */

static bool same_line(const nh_run_record *a, const nh_run_record *b)
{
    return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation);
}

static bool shown(const nh_run_record *m) { return m->status <= NH_FLAGGED && isfinite(m->error) && m->seconds > 0; }

/* ---- the answer ---- */

static void answer(nh_pen *p, const nh_benchmark *c)
{
    const nh_run_record *best = nh_benchmark_fastest(c, 0, c->count, 1e-6, false);
    nh_pen_open(p, NH_PEN_ANSWER, best ? "found" : "undecided", NULL);
    if (best) nh_pen_say(p, "Fastest with an error below a millionth: %s in {%s}.", best->method, best->formulation);
    else nh_pen_say(p, "No method came below an error of a millionth.");
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_pen_words(p, "One motion, t = %.6g to %.6g, by %s in every formulation, measured on this machine.", c->begin,
                 c->end, c->methods ? "the integrators that were asked for" : "every integrator");
    nh_pen_words(p, "Reference: {%s}; {%s} agrees to %.1g, so that errors below that cannot be measured.", c->reference,
                 c->second, c->agreement);
    const char *warning[NH_BENCHMARK_WARNINGS];
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_pen_warning(p, warning[i]);
    if (c->partial) nh_pen_warning(p, "the budget ended before every method had all its runs; --budget allows more");
}

/* The time and the error of a run; `each`: with the drift of every current. */
static void put_run(nh_pen *p, const nh_benchmark *c, const nh_run_record *m, bool each)
{
    nh_pen_say(p, "%s %.3g: error %.1g", nh_run_record_set_by(m), nh_run_record_set_to(m), m->error);
    for (size_t k = 0; each && k < c->currents && m->drift && isfinite(m->error); k++)
        if (!isnan(m->drift[k])) nh_pen_say(p, ", drift of <%s> %.1g", c->current[k], m->drift[k]);
    if (!each && isfinite(m->worst_drift)) nh_pen_say(p, ", drift %.1g", m->worst_drift);
    nh_pen_say(p, ", %.3g seconds, %.10g evaluations", m->seconds, (double)m->evaluations);
}

static void fastest(nh_pen *p, const nh_benchmark *c)
{
    bool reduced = false;
    nh_pen_heading(p, "Fastest method for each accuracy");
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < NH_BENCHMARK_GOALS; i++) {
        char goal[24];
        const nh_run_record *m = nh_benchmark_fastest(c, 0, c->count, nh_benchmark_goal[i], false);
        if (!m) continue;
        snprintf(goal, sizeof goal, p->ink->brief ? "%.0e" : "below %.0e", nh_benchmark_goal[i]);
        nh_pen_fact_begin(p, goal);
        nh_pen_say(p, "%s in {%s}, ", m->method, m->formulation);
        put_run(p, c, m, false);
        nh_pen_say(p, "%s", nh_benchmark_goal[i] < c->agreement ? " (further than the reference is confirmed)" : "");
        nh_pen_close(p, NH_PEN_FACT);
    }
    if (c->currents) {
        nh_pen_fact_begin(p, "currents watched");
        for (size_t k = 0; k < c->currents; k++) nh_pen_say(p, k ? ", <%s>" : "<%s>", c->current[k]);
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
    for (size_t i = 0; i < c->count; i++) reduced |= c->item[i].reduced;
    if (reduced)
        nh_pen_words(p,
                     "Reduced equations (the group divided out) compute shape and momenta only, and are left out here; "
                     "errors are those of their own states.");
    for (size_t i = 0; i < c->refused; i++) nh_pen_words(p, "Not used, %s.", c->refusal[i]);
}

/* The index behind the last run of this method and formulation. */
static size_t line_end(const nh_benchmark *c, size_t from)
{
    size_t next = from + 1;
    while (next < c->count && same_line(&c->item[from], &c->item[next])) next++;
    return next;
}

/* A method: its times for each error, and the worst status of its runs. */
static void put_times(nh_pen *p, const nh_benchmark *c, size_t from, size_t to)
{
    const nh_run_record *last = NULL;
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", c->item[from].method);
    for (size_t i = 0; i < NH_BENCHMARK_GOALS; i++) {
        const nh_run_record *m = nh_benchmark_fastest(c, from, to, nh_benchmark_goal[i], true);
        nh_pen_cell(p, NH_PEN_CELL, "%.2g", m ? m->seconds : NAN);
    }
    for (size_t i = from; i < to; i++)
        if (c->item[i].status >= NH_FLAGGED && !(last && last->status == NH_UNDETECTED)) last = &c->item[i];
    if (last) {
        nh_pen_open(p, NH_PEN_KIND, nh_run_record_status_name(last->status), NULL);
        nh_pen_say(p, "%s", nh_run_record_status_name(last->status));
        nh_pen_close(p, NH_PEN_KIND);
    } else {
        nh_pen_cell(p, NH_PEN_CELL, "%s", "");
    }
    nh_pen_close(p, NH_PEN_ROW);
}

static void times(nh_pen *p, const nh_benchmark *c)
{
    const char *formulation = "";
    nh_text heads;
    nh_text_init(&heads);
    nh_text_add(&heads, "method");
    for (size_t i = 0; i < NH_BENCHMARK_GOALS; i++) nh_text_addf(&heads, "|#%.0e", nh_benchmark_goal[i]);
    nh_text_add(&heads, "|others");
    nh_pen_open(p, NH_PEN_FOLD, NULL, "Time to reach a given accuracy");
    nh_pen_words(p, "Seconds until the error is below the head of the column, and what happened to other "
                    "runs of the method.");
    for (size_t i = 0, next; i < c->count; i = next) {
        next = line_end(c, i);
        if (strcmp(formulation, c->item[i].formulation)) {
            if (i) nh_pen_table_end(p);
            nh_pen_table(p, formulation = c->item[i].formulation, nh_text_string(&heads));
        }
        put_times(p, c, i, next);
    }
    if (c->count) nh_pen_table_end(p);
    nh_pen_close(p, NH_PEN_FOLD);
    nh_text_clear(&heads);
}

/* ---- the order of convergence ---- */

static void put_orders(nh_pen *p, const nh_benchmark *c, size_t from, size_t to)
{
    const nh_run_record *first = &c->item[from];
    bool any = false;
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", first->method);
    nh_pen_cell(p, NH_PEN_CELL, "{%s}", first->formulation);
    nh_pen_cell(p, NH_PEN_CELL, "%.10g", (double)first->order);
    nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
    for (size_t i = from; i < to; i++)
        if (isfinite(c->item[i].observed_order)) {
            nh_pen_say(p, any ? ", %.3g" : "%.3g", c->item[i].observed_order);
            any = true;
        }
    nh_pen_close(p, NH_PEN_CELL);
    nh_pen_close(p, NH_PEN_ROW);
}

/* For methods with a fixed step, some of whose errors are above the error of the reference. */
static void orders(nh_pen *p, const nh_benchmark *c)
{
    bool begun = false;
    for (size_t i = 0, next; i < c->count; i = next) {
        bool any = false;
        next = line_end(c, i);
        for (size_t j = i; j < next; j++) any |= isfinite(c->item[j].observed_order);
        if (!any) continue;
        if (!begun) nh_pen_table(p, "Order of convergence", "method|formulation|by theory|observed, step by step");
        begun = true;
        put_orders(p, c, i, next);
    }
    if (!begun) return;
    nh_pen_table_end(p);
    nh_pen_words(p, "Observed: log(e/e') / log(h/h') of the errors e, e' with two successive steps h > h'.");
}

/* ---- time against error ---- */

/* Plots that are compared get the same axes. */
typedef struct {
    double x[2], y[2];
} ranges;

static const ranges no_range = {{INFINITY, -INFINITY}, {INFINITY, -INFINITY}};

static void hold(double range[2], double value)
{
    range[0] = fmin(range[0], value);
    range[1] = fmax(range[1], value);
}

static void flush(nh_pen *p, const char *formulation, size_t n, const nh_curve *curve, const ranges *all)
{
    char title[200], caption[300];
    if (!n) return;
    snprintf(title, sizeof title, "Time against error, %.120s", formulation);
    snprintf(
        caption, sizeof caption,
        "Seconds against error, %.120s. Down and to the left is better; each line is one method from loose to tight.",
        formulation);
    nh_plot plot = {.title = title,
                    .description = "Both axes are logarithmic",
                    .x_label = "error, relative",
                    .y_label = "seconds",
                    .log_x = true,
                    .log_y = true,
                    .floor = 1e-17,
                    .also_x = all->x,
                    .also_y = all->y,
                    .curves = n,
                    .curve = curve};
    nh_pen_plot(p, &plot, caption);
}

/* A motion is not known more accurately than two references agree. */
static double known_error(const nh_benchmark *c, const nh_run_record *m)
{
    static const double least = 1e-16;
    return fmax(m->error, fmax(c->agreement, least));
}

/* One plot per formulation, one line per method. */
static void plots(nh_pen *p, const nh_benchmark *c)
{
    if (p->ink->brief) return;
    double *x = nh_alloc_array(2 * c->count + 1, sizeof *x), *y = x + c->count;
    nh_curve curve[most_lines];
    ranges all = no_range;
    size_t n = 0;
    for (size_t i = 0; i < c->count; i++) {
        if (!shown(&c->item[i])) continue;
        hold(all.x, known_error(c, &c->item[i]));
        hold(all.y, c->item[i].seconds);
    }
    for (size_t i = 0, next; i < c->count; i = next) {
        size_t points = 0;
        next = line_end(c, i);
        for (size_t j = i; j < next; j++) {
            const nh_run_record *m = &c->item[j];
            if (!shown(m)) continue;
            x[i + points] = known_error(c, m);
            y[i + points++] = m->seconds;
        }
        if (points)
            curve[n++] = (nh_curve){.name = c->item[i].method,
                                    .count = points,
                                    .x = x + i,
                                    .x_stride = 1,
                                    .y = y + i,
                                    .y_stride = 1,
                                    .marks = true};
        bool last = next == c->count || strcmp(c->item[i].formulation, c->item[next].formulation);
        if (!last && n < most_lines) continue;
        flush(p, c->item[i].formulation, n, curve, &all);
        n = 0;
    }
    nh_free(x);
}

static void all_runs_brief(nh_pen *p, const nh_benchmark *c)
{
    const char *formulation = "";
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (strcmp(formulation, m->formulation)) {
            if (i) nh_pen_close(p, NH_PEN_FACTS);
            else nh_pen_heading(p, "All runs (* no other one is both faster and more accurate)");
            nh_pen_words(p, "{%s}", formulation = m->formulation);
            nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
        }
        nh_pen_fact_begin(p, m->method);
        nh_pen_say(p, "%s%s, ", nh_run_record_status_name(m->status), m->front ? " *" : "");
        put_run(p, c, m, true);
        nh_pen_say(p, m->note && m->note[0] ? "; %s" : "%s", m->note ? m->note : "");
        nh_pen_close(p, NH_PEN_FACT);
    }
    if (*formulation) nh_pen_close(p, NH_PEN_FACTS);
}

static void all_runs(nh_pen *p, const nh_benchmark *c)
{
    if (p->ink->brief) {
        all_runs_brief(p, c);
        return;
    }
    nh_pen_open(p, NH_PEN_FOLD, NULL, "All runs");
    nh_pen_table(p, "All runs", "method|formulation|set to|status|error|drift|seconds|evaluations|note");
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        nh_pen_row(p, "%s|{%s}|%s %.3g|!%s|%.2g|%.2g|%.3g|%.10g|%s", m->method, m->formulation, nh_run_record_set_by(m),
                   nh_run_record_set_to(m), nh_run_record_status_name(m->status), m->error, m->worst_drift, m->seconds,
                   (double)m->evaluations, m->note ? m->note : "");
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
        if (isfinite(d->seconds))
            nh_pen_row(p, "%s|%.3g|%.10g|%.1g", d->method, d->seconds, (double)d->evaluations, d->error);
    }
    nh_pen_table_end(p);
}

/* ---- the discrete problem ---- */

static bool same_way(const nh_fitted *a, const nh_fitted *b)
{
    return !strcmp(a->basis, b->basis) && !strcmp(a->route, b->route) && !strcmp(a->solver, b->solver);
}

static const double least_distance = 1e-17;

static bool solved(const nh_fitted *m) { return m->right && isfinite(m->error); }

/* One plot per size of the ansatz, with one line per method, over the number of samples. */
static void fit_plot(nh_pen *p, const nh_benchmark *c, size_t first, size_t last, const ranges *all)
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
            if (same_way(&c->fit[i], &c->fit[j]) && solved(&c->fit[j]))
                at[count] = fmax(c->fit[j].error, least_distance), y[count++] = c->fit[j].seconds;
        if (!count) continue;
        snprintf(name[n], sizeof *name, "%.30s, %.30s, %.30s", c->fit[i].basis, c->fit[i].route, c->fit[i].solver);
        curve[n] =
            (nh_curve){.name = name[n], .count = count, .x = at, .x_stride = 1, .y = y, .y_stride = 1, .marks = true};
        n++;
    }
    snprintf(title, sizeof title, "Time against error, %zu functions", c->fit[first].functions);
    nh_plot plot = {.title = title,
                    .description = "Both axes are logarithmic",
                    .x_label = "distance of the known currents from the null space",
                    .y_label = "seconds",
                    .log_x = true,
                    .log_y = true,
                    .floor = 1e-18,
                    .also_x = all->x,
                    .also_y = all->y,
                    .curves = n,
                    .curve = curve};
    snprintf(caption, sizeof caption, "%s. Each line is one way to solve it, with few to many samples.", title);
    if (n) nh_pen_plot(p, &plot, caption);
    nh_free(x);
}

static void fits_brief(nh_pen *p, const nh_benchmark *c)
{
    nh_pen_table(p, "Solutions", "columns|samples|basis|route|solver|error|seconds|result");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_pen_row(p, "%zu|%zu|%s|%s|%s|%.1g|%.2g|%s%s", m->columns, m->samples, m->basis, m->route, m->solver,
                   m->error, m->seconds, nh_fitted_word(m), m->front ? " *" : "");
    }
    nh_pen_table_end(p);
    nh_pen_words(p, "* accurate, and no other of as many functions is both faster and more exact.");
    if (c->fits_partial) nh_pen_words(p, "There was no time for more functions; --budget allows more.");
}

static void discrete(nh_pen *p, const nh_benchmark *c)
{
    if (!c->fits) return;
    nh_pen_section(p, "discrete", "The discrete problem");
    nh_pen_words(p,
                 "The linear problem by which nhsym analyze finds currents, of polynomials in velocities, sines, "
                 "cosines and coordinates, solved in several ways: "
                 "by how far the known currents are from its null space, and how long it takes.%s",
                 p->ink->brief ? "" : " Down and to the left is better.");
    if (p->ink->brief) {
        fits_brief(p, c);
        return;
    }
    ranges all = no_range;
    for (size_t i = 0; i < c->fits; i++) {
        if (!solved(&c->fit[i])) continue;
        hold(all.x, fmax(c->fit[i].error, least_distance));
        hold(all.y, c->fit[i].seconds);
    }
    for (size_t i = 0, next; i < c->fits; i = next) {
        for (next = i; next < c->fits && c->fit[next].functions == c->fit[i].functions;) next++;
        fit_plot(p, c, i, next, &all);
    }
    nh_pen_open(p, NH_PEN_FOLD, NULL, "All solutions");
    nh_pen_table(p, "All solutions",
                 "functions|columns|samples|basis|route|solver|null values|gap|error|seconds|result");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_pen_row(p, "%zu|%zu|%zu|%s|%s|%s|%zu|%.2g|%.2g|%.3g|%s", m->functions, m->columns, m->samples, m->basis,
                   m->route, m->solver, m->dimension, m->gap, m->error, m->seconds, nh_fitted_word(m));
    }
    nh_pen_table_end(p);
    nh_pen_close(p, NH_PEN_FOLD);
}

void nh_benchmark_write(const nh_benchmark *c, const nh_robustness *s, const nh_run *run, nh_pen_style style,
                        nh_text *out)
{
    if (nh_screen_is_wanted(style)) {
        nh_benchmark_write_answer(c, s, style.colour, out);
        return;
    }
    const nh_simulation *q = c->question;
    nh_pen pen, *p = &pen;
    char sections[200];
    nh_pen_subject subject = {.system = q->system, .analysis = q->analysis, .dag = q->model->dag, .shown = run->shown};
    nh_pen_begin(p, style, &subject, "integrators compared", out);
    answer(p, c);
    snprintf(sections, sizeof sections, "methods|Methods|%s%ssystem|System|words|Words|repeat|Repeat it",
             c->fits ? "discrete|The discrete problem|" : "", s ? "robustness|Where they fail|" : "");
    p->ink->links(p->to, sections);
    nh_pen_section(p, "methods", "Methods");
    times(p, c);
    fastest(p, c);
    plots(p, c);
    orders(p, c);
    derivatives(p, c);
    all_runs(p, c);
    discrete(p, c);
    nh_benchmark_write_robustness(p, s);
    nh_pen_system(p, NULL, NULL);
    nh_pen_glossary(p, "accurate, flagged, detected, undetected, timeout, drift");
    nh_pen_end(p, run);
}
