/* The integrators compared, as a document. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/memory.h"
#include "document/benchmark.h"
#include "document/benchmark_internal.h"
#include "document/screen.h"

static bool same_line(const nh_run_record *a, const nh_run_record *b)
{
    return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation);
}

/* ---- the answer ---- */

/* A map alone, without a comparison of methods. */
static void answer_of_maps(nh_pen *p, const nh_benchmark *c, const nh_robustness *s)
{
    size_t all = 0;
    for (size_t k = 0; k < NH_RUN_STATUSES; k++) all += s->count[k];
    nh_pen_open(p, NH_PEN_ANSWER, s->count[NH_UNDETECTED] ? "undecided" : "found", NULL);
    nh_pen_say(p, "Of %zu runs %zu are accurate, %zu of them flagged, and %zu are not accurate without a warning.", all,
               s->count[NH_ACCURATE] + s->count[NH_FLAGGED], s->count[NH_FLAGGED], s->count[NH_UNDETECTED]);
    nh_pen_close(p, NH_PEN_ANSWER);
    nh_pen_words(p, "Motions from t = %.6g, as long as the map says or to t = %.6g.", c->begin, c->end);
}

/* The best solution of each degree, with what rounding lets expect. */
static void answer_of_fit(nh_pen *p, const nh_benchmark *c)
{
    const nh_fitted *best = NULL;
    for (size_t i = 0; i < c->fits; i++)
        if (c->fit[i].right && isfinite(c->fit[i].error) && (!best || c->fit[i].error < best->error)) best = &c->fit[i];
    nh_pen_open(p, NH_PEN_ANSWER, best ? "found" : "undecided", NULL);
    if (best)
        nh_pen_say(p, "The known currents are within %.1g of the space that is found, at points that no fit has seen.",
                   best->error);
    else nh_pen_say(p, "No known current is a combination of the functions that were tried.");
    nh_pen_close(p, NH_PEN_ANSWER);
}

static void degrees(nh_pen *p, const nh_benchmark *c)
{
    nh_pen_table(p, "One row for each degree", "degree|functions|samples|solved by|error|expected|seconds");
    for (size_t i = 0, next; i < c->fits; i = next) {
        const nh_fitted *best = NULL;
        for (next = i; next < c->fits && c->fit[next].degree == c->fit[i].degree; next++) {
            const nh_fitted *m = &c->fit[next];
            if (m->right && isfinite(m->error) && (!best || m->error < best->error)) best = m;
        }
        if (best)
            nh_pen_row(p, "%zu|%zu|%zu|%s, %s route|%.1g|%.1g|%.2g", best->degree, best->functions, best->samples,
                       best->basis, best->route, best->error, best->expected, best->seconds);
    }
    nh_pen_table_end(p);
    nh_pen_words(p, "Error: distance of the known currents from the space; expected: what rounding leaves of it.");
}

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
    nh_pen_say(p, ", %.3g seconds", m->seconds);
    if (isfinite(m->seconds_low)) nh_pen_say(p, " (quartiles %.3g to %.3g)", m->seconds_low, m->seconds_high);
    nh_pen_say(p, ", %.10g evaluations%s", (double)m->evaluations,
               m->below_floor ? ", not told apart from the reference" : "");
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

/* What was never begun says least. */
static bool worse(nh_run_record_status a, nh_run_record_status b)
{
    return a != NH_NOT_RUN && (b == NH_NOT_RUN || a > b);
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
        if (c->item[i].status >= NH_FLAGGED && (!last || worse(c->item[i].status, last->status))) last = &c->item[i];
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

static void put_order(nh_pen *p, const nh_benchmark *c, const nh_benchmark_order *o)
{
    bool any = false;
    nh_pen_open(p, NH_PEN_ROW, NULL, NULL);
    nh_pen_cell(p, NH_PEN_ROW_HEAD, "%s", o->method);
    nh_pen_cell(p, NH_PEN_CELL, "{%s}", o->formulation);
    nh_pen_cell(p, NH_PEN_CELL, "%.10g", (double)o->order);
    nh_pen_cell(p, NH_PEN_CELL, "%.3g", o->judged.observed);
    if (p->ink->brief) {
        nh_pen_close(p, NH_PEN_ROW);
        return;
    }
    nh_pen_open(p, NH_PEN_CELL, NULL, NULL);
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (strcmp(m->method, o->method) || strcmp(m->formulation, o->formulation) || isnan(m->observed_order))
            continue;
        nh_pen_say(p, any ? ", %.3g" : "%.3g", m->observed_order);
        any = true;
    }
    nh_pen_close(p, NH_PEN_CELL);
    nh_pen_cell(p, NH_PEN_CELL, "%s", nh_benchmark_order_why(o));
    nh_pen_close(p, NH_PEN_ROW);
}

/* For methods with a fixed step. */
static void orders(nh_pen *p, const nh_benchmark *c)
{
    if (!c->orders) return;
    nh_pen_table(p, "Order of convergence",
                 p->ink->brief ? "method|formulation|by theory|observed"
                               : "method|formulation|by theory|observed|step by step|remark");
    for (size_t i = 0; i < c->orders; i++) put_order(p, c, &c->order[i]);
    nh_pen_table_end(p);
    nh_pen_words(p,
                 "Observed: log(e/e') / log(h/h') of the errors e, e' with the two smallest steps h > h' whose errors "
                 "are told from the reference and from rounding.");
    nh_text words;
    nh_text_init(&words);
    if (nh_benchmark_put_orders(c, 8, &words)) nh_pen_words(p, "%s", nh_text_string(&words));
    nh_text_clear(&words);
}

/* ---- work against error ---- */

/* "Seconds against error: .." */
static const char *caption_of(const nh_benchmark *c, const nh_benchmark_row *row, size_t panel)
{
    const nh_plot *plot = &row->panel[panel];
    const char *y = plot->y_label, *x = plot->x_label;
    return nh_arena_printf(c->arena, "%c%s against %.*s%s%s.%s%s", y[0] - 'a' + 'A', y + 1, (int)strcspn(x, ","), x,
                           row->fit ? "" : ": ", row->fit ? "" : row->title, panel ? "" : " ",
                           panel ? "" : row->caption);
}

static void plots(nh_pen *p, const nh_benchmark *c, bool fit)
{
    nh_benchmark_row row[NH_BENCHMARK_ROWS];
    if (p->ink->brief) return;
    size_t rows = nh_benchmark_rows(c, c->arena, row);
    for (size_t i = 0; i < rows; i++)
        for (size_t k = 0; k < row[i].panels && row[i].fit == fit; k++)
            nh_pen_plot(p, &row[i].panel[k], caption_of(c, &row[i], k));
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
    nh_pen_table(p, "All runs", "method|formulation|set to|status|error|drift|seconds, quartiles|evaluations|note");
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        nh_pen_row(p, "%s|{%s}|%s %.3g|!%s|%.2g|%.2g|%.3g, %.2g to %.2g|%.10g|%s", m->method, m->formulation,
                   nh_run_record_set_by(m), nh_run_record_set_to(m), nh_run_record_status_name(m->status), m->error,
                   m->worst_drift, m->seconds, m->seconds_low, m->seconds_high, (double)m->evaluations,
                   m->below_floor        ? "not told apart from the reference"
                   : m->note && *m->note ? m->note
                                         : "");
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
    plots(p, c, true);
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

/* What was asked for, without the rest: a map, or the discrete problem. */
static void write_part(nh_pen *p, const nh_benchmark *c, const nh_robustness *s, bool all)
{
    if (s) {
        answer_of_maps(p, c, s);
        p->ink->links(p->to, "robustness|Where they fail|system|System|words|Words|repeat|Repeat it");
        nh_benchmark_write_robustness(p, s);
        return;
    }
    answer_of_fit(p, c);
    p->ink->links(p->to, "degrees|By degree|discrete|The discrete problem|system|System|words|Words|repeat|Repeat it");
    nh_pen_section(p, "degrees", "The best solution of each degree");
    degrees(p, c);
    if (all) discrete(p, c);
}

static void write_all(nh_pen *p, const nh_benchmark *c, const nh_robustness *s)
{
    char sections[200];
    answer(p, c);
    snprintf(sections, sizeof sections, "methods|Methods|%s%ssystem|System|words|Words|repeat|Repeat it",
             c->fits ? "discrete|The discrete problem|" : "", s ? "robustness|Where they fail|" : "");
    p->ink->links(p->to, sections);
    nh_pen_section(p, "methods", "Methods");
    times(p, c);
    fastest(p, c);
    plots(p, c, false);
    orders(p, c);
    derivatives(p, c);
    all_runs(p, c);
    discrete(p, c);
    nh_benchmark_write_robustness(p, s);
}

void nh_benchmark_write(const nh_benchmark *c, const nh_robustness *s, const nh_run *run, nh_pen_style style,
                        nh_text *out)
{
    bool part = !c->count && (s || c->fits), screen = nh_screen_is_wanted(style);
    if (screen && !part) {
        nh_benchmark_write_answer(c, s, style.colour, out);
        return;
    }
    const nh_simulation *q = c->question;
    nh_pen pen, *p = &pen;
    nh_pen_subject subject = {.system = q->system, .analysis = q->analysis, .dag = q->model->dag, .shown = run->shown};
    nh_pen_begin(p, style, &subject,
                 !part ? "integrators compared"
                 : s   ? "where methods fail"
                       : "the discrete problem",
                 out);
    if (part) write_part(p, c, s, !screen);
    else write_all(p, c, s);
    if (!screen) {
        nh_pen_system(p, NULL, NULL);
        nh_pen_glossary(p, part ? "accurate, flagged, detected, undetected, timeout, not run"
                                : "accurate, flagged, detected, undetected, timeout, not run, drift");
    }
    nh_pen_end(p, run);
}
