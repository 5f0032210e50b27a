#include "document/benchmark.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/escape.h"
#include "base/json.h"
#include "document/benchmark_internal.h"
#include "document/screen.h"

const double nh_benchmark_goal[NH_BENCHMARK_GOALS] = {1e-3, 1e-6, 1e-9, 1e-12};

size_t nh_benchmark_warnings(const nh_benchmark *c, const char *out[NH_BENCHMARK_WARNINGS])
{
    size_t n = 0;
    if (c->shortened) out[n++] = "the time was shortened until two methods reached its end and agreed";
    if (c->doubtful)
        out[n++] = "no two methods agree on this motion, so that errors say little and nothing is called accurate; an "
                   "earlier --until may help";
    return n;
}

/* The words of the judge without their comma. */
const char *nh_benchmark_order_why(const nh_benchmark_order *o)
{
    const char *why = nh_judge_order_why(o->judged.reason);
    return why + strspn(why, ", ");
}

void nh_benchmark_put_reference(const nh_benchmark *c, nh_text *out)
{
    if (!c->count) {
        nh_text_add(out, c->fits ? "No motion was compared: the discrete problem alone was asked for."
                                 : "No motion was compared: a map alone was asked for.");
        return;
    }
    nh_text_addf(
        out,
        "One motion, t = %.6g to %.6g. Reference: %s; %s agrees to %.1g, so that smaller errors (the grey band) are "
        "not told apart from it. Times are those of this machine; evaluations are the same on every one.",
        c->begin, c->end, c->reference, c->second, c->agreement);
}

/* "midpoint, order 2: observed 0.6, because .."; the names of some methods end with their order; the first formulation
 * is not named. */
static void put_order(const nh_benchmark *c, const nh_benchmark_order *o, nh_text *out)
{
    nh_text_add(out, o->method);
    if (!strstr(o->method, ", order ")) nh_text_addf(out, ", order %d", o->order);
    if (strcmp(o->formulation, c->item[0].formulation)) nh_text_addf(out, ", in %s", o->formulation);
    nh_text_addf(out, ": observed %.2g%s.", o->judged.observed, nh_judge_order_why(o->judged.reason));
}

bool nh_benchmark_put_orders(const nh_benchmark *c, size_t most, nh_text *out)
{
    size_t told = 0, others = 0;
    for (size_t i = 0; i < c->orders; i++) {
        const nh_benchmark_order *o = &c->order[i];
        if (o->judged.reason == NH_ORDER_EXPECTED) continue;
        if (told == most) {
            others++;
            continue;
        }
        if (told++) nh_text_add(out, " ");
        put_order(c, o, out);
    }
    if (others) nh_text_addf(out, " And %zu more.", others);
    return told > 0;
}

const char *nh_fitted_word(const nh_fitted *m)
{
    if (m->undecided) return "undecided";
    if (m->dimension > m->wanted) return "too many";
    if (m->dimension < m->wanted) return "too few";
    return m->right ? "accurate" : "inexact";
}

const nh_run_record *nh_benchmark_fastest(const nh_benchmark *c, size_t from, size_t to, double below, bool reduced)
{
    const nh_run_record *best = NULL;
    for (size_t i = from; i < to; i++) {
        const nh_run_record *m = &c->item[i];
        if (m->status <= (reduced ? NH_FLAGGED : NH_ACCURATE) && (reduced || !m->reduced) && m->error <= below &&
            (!best || m->seconds < best->seconds))
            best = m;
    }
    return best;
}

/* ---- a table for other programs ---- */

static void put_field(nh_text *out, double value)
{
    char text[40];
    nh_text_number(value, text, sizeof text);
    nh_text_addf(out, ",%s", isfinite(value) ? text : "");
}

void nh_benchmark_csv(const nh_benchmark *c, nh_text *out)
{
    nh_text_add(out, "method,formulation,tolerance,step,error,drift,seconds,evaluations,order,observed_order,status,"
                     "reduced,front,note,seconds_low,seconds_high,repeats,floor,below_floor,front_evaluations\n");
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        const double number[] = {m->tolerance,
                                 m->step,
                                 m->error,
                                 m->worst_drift,
                                 m->seconds,
                                 (double)m->evaluations,
                                 m->order ? m->order : NAN,
                                 m->observed_order};
        nh_escape_csv(m->method, out);
        nh_text_add(out, ",");
        nh_escape_csv(m->formulation, out);
        for (size_t k = 0; k < sizeof number / sizeof *number; k++) put_field(out, number[k]);
        nh_text_addf(out, ",%s,%d,%d,", nh_run_record_status_json(m->status), m->reduced, m->front);
        if (m->note && m->note[0]) nh_escape_csv(m->note, out);
        put_field(out, m->seconds_low);
        put_field(out, m->seconds_high);
        nh_text_addf(out, ",%zu", m->repeats);
        put_field(out, m->floor);
        nh_text_addf(out, ",%d,%d\n", m->below_floor, m->front_evaluations);
    }
}

/* ---- JSON ---- */

static void put_item(const nh_benchmark *c, const nh_run_record *m, nh_json *list)
{
    nh_json *item = nh_json_add_object(list);
    nh_json_put_text(item, "method", m->method);
    nh_json_put_text(item, "formulation", m->formulation);
    nh_json_put_number(item, "tolerance", m->tolerance);
    nh_json_put_number(item, "step", m->step);
    nh_json_put_number(item, "error", m->error);
    nh_json_put_number(item, "drift", m->worst_drift);
    nh_json *drifts = nh_json_put_object(item, "drifts");
    for (size_t k = 0; k < c->currents && m->drift && isfinite(m->error); k++)
        if (!isnan(m->drift[k])) nh_json_put_number(drifts, c->current[k], m->drift[k]);
    nh_json_put_number(item, "seconds", m->seconds);
    nh_json_put_number(item, "seconds_low", m->seconds_low);
    nh_json_put_number(item, "seconds_high", m->seconds_high);
    nh_json_put_number(item, "repeats", (double)m->repeats);
    nh_json_put_number(item, "evaluations", (double)m->evaluations);
    nh_json_put_number(item, "floor", m->floor);
    nh_json_put_bool(item, "below_floor", m->below_floor);
    nh_json_put_number(item, "order", m->order ? m->order : NAN);
    nh_json_put_number(item, "observed_order", m->observed_order);
    nh_json_put_text(item, "status", nh_run_record_status_json(m->status));
    nh_json_put_bool(item, "reduced", m->reduced);
    nh_json_put_bool(item, "front", m->front);
    nh_json_put_bool(item, "front_evaluations", m->front_evaluations);
    nh_json_put_text(item, "note", m->note ? m->note : "");
}

static void put_orders(const nh_benchmark *c, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "orders");
    for (size_t i = 0; i < c->orders; i++) {
        const nh_benchmark_order *o = &c->order[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_text(item, "method", o->method);
        nh_json_put_text(item, "formulation", o->formulation);
        nh_json_put_number(item, "order", o->order);
        nh_json_put_number(item, "observed", o->judged.observed);
        nh_json_put_bool(item, "as_expected", o->judged.reason == NH_ORDER_EXPECTED);
        nh_json_put_text(item, "why", nh_benchmark_order_why(o));
    }
}

static void put_fits(const nh_benchmark *c, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "discrete");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "degree", (double)m->degree);
        nh_json_put_number(item, "functions", (double)m->functions);
        nh_json_put_number(item, "columns", (double)m->columns);
        nh_json_put_number(item, "samples", (double)m->samples);
        nh_json_put_text(item, "grid", m->grid);
        nh_json_put_text(item, "basis", m->basis);
        nh_json_put_text(item, "route", m->route);
        nh_json_put_text(item, "solver", m->solver);
        nh_json_put_number(item, "rank", (double)m->rank);
        nh_json_put_number(item, "dimension", (double)m->dimension);
        nh_json_put_number(item, "wanted", (double)m->wanted);
        nh_json_put_number(item, "gap", m->gap);
        nh_json_put_number(item, "error", m->error);
        nh_json_put_number(item, "expected", m->expected);
        nh_json_put_number(item, "seconds", m->seconds);
        nh_json_put_number(item, "seconds_low", m->seconds_low);
        nh_json_put_number(item, "seconds_high", m->seconds_high);
        nh_json_put_number(item, "repeats", (double)m->repeats);
        const char *word = nh_fitted_word(m);
        nh_json_put_text(item, "status", !strcmp(word, "accurate") ? "right" : word);
        nh_json_put_bool(item, "front", m->front);
    }
}

static void put_map(const nh_robustness_map *map, nh_json *list)
{
    nh_json *item = nh_json_add_object(list);
    nh_json_put_text(item, "name", map->name);
    nh_json *axes = nh_json_put_array(item, "axes");
    nh_json_add_text(axes, map->axis);
    if (map->second_axis) nh_json_add_text(axes, map->second_axis);
    nh_json *cells = nh_json_put_array(item, "cells");
    for (size_t i = 0; i < map->cells; i++) {
        nh_json *cell = nh_json_add_object(cells);
        nh_json_put_numbers(cell, "at", map->second_axis ? 2 : 1, (double[]){map->cell[i].at, map->cell[i].second_at},
                            1);
        nh_json_put_text(cell, "method", map->cell[i].method);
        nh_json_put_text(cell, "status", nh_run_record_status_json(map->cell[i].status));
        nh_json_put_number(cell, "error", map->cell[i].error);
        nh_json_put_number(cell, "drift", map->cell[i].drift);
        nh_json_put_text(cell, "note", map->cell[i].note ? map->cell[i].note : "");
    }
}

char *nh_benchmark_json(const nh_benchmark *c, const nh_robustness *s, const nh_run *run)
{
    nh_json *root = nh_json_object();
    nh_json_put_number(root, "schema", 1);
    nh_json_put_text(root, "version", NH_VERSION);
    nh_json_put_text(root, "system", c->question->system->name);
    nh_json_put_number(root, "begin", c->begin);
    nh_json_put_number(root, "end", c->end);
    nh_json *reference = nh_json_put_object(root, "reference");
    nh_json_put_text(reference, "method", c->reference);
    nh_json_put_text(reference, "second", c->second);
    nh_json_put_number(reference, "agreement", c->agreement);
    nh_json_put_numbers(root, "goals", NH_BENCHMARK_GOALS, nh_benchmark_goal, 1);
    nh_json *motion = nh_json_put_array(root, "motion");
    for (size_t i = 0; i < c->count; i++) put_item(c, &c->item[i], motion);
    put_orders(c, root);
    nh_json *derivatives = nh_json_put_array(root, "derivatives");
    for (size_t i = 0; i < c->derivatives; i++) {
        nh_json *item = nh_json_add_object(derivatives);
        nh_json_put_text(item, "method", c->derivative[i].method);
        nh_json_put_number(item, "error", c->derivative[i].error);
        nh_json_put_number(item, "seconds", c->derivative[i].seconds);
        nh_json_put_number(item, "evaluations", (double)c->derivative[i].evaluations);
    }
    put_fits(c, root);
    nh_json *refused = nh_json_put_array(root, "refused");
    for (size_t i = 0; i < c->refused; i++) nh_json_add_text(refused, c->refusal[i]);
    nh_json_put_bool(root, "partial", c->partial);
    if (s) {
        nh_json *robustness = nh_json_put_object(root, "robustness");
        nh_json_put_number(robustness, "tolerance", s->tolerance);
        nh_json_put_number(robustness, "accuracy", s->accuracy);
    }
    nh_json *maps = nh_json_put_array(root, "stress"); /* the older word, for scripts that read it */
    for (size_t i = 0; s && i < s->maps; i++) put_map(&s->map[i], maps);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    const char *warning[NH_BENCHMARK_WARNINGS];
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_json_add_text(warnings, warning[i]);
    if (run) nh_run_json(run, c->question->system, root);
    return nh_json_finish(root);
}

/* ---- the first screen ---- */

const char *nh_run_record_set_by(const nh_run_record *m) { return isnan(m->step) ? "tolerance" : "step"; }

double nh_run_record_set_to(const nh_run_record *m) { return isnan(m->step) ? m->tolerance : m->step; }

static void headline(const nh_benchmark *c, bool colour, nh_text *out)
{
    const nh_run_record *best = nh_benchmark_fastest(c, 0, c->count, 1e-6, false);
    nh_text words;
    nh_text_init(&words);
    if (best)
        nh_text_addf(&words, "Fastest with an error below a millionth: %s, %.2g seconds (median).", best->method,
                     best->seconds);
    else nh_text_add(&words, "No method came below an error of a millionth.");
    nh_text_addf(&words,
                 " One motion, t = %.6g to %.6g, measured on this machine; errors below %.1g cannot be "
                 "measured.",
                 c->begin, c->end, c->agreement);
    nh_screen_begin(out, colour, c->question->system, NULL, &words);
}

static void fastest(const nh_benchmark *c, nh_text *out)
{
    size_t told = 0;
    for (size_t i = 0; i < NH_BENCHMARK_GOALS; i++) {
        const nh_run_record *m = nh_benchmark_fastest(c, 0, c->count, nh_benchmark_goal[i], false);
        char set[40];
        if (!m) continue;
        if (!told++)
            nh_text_addf(out, "\n%-13s%-30s%-19s%-9s%s\n", "error below", "fastest method", "set to", "seconds",
                         "drift");
        snprintf(set, sizeof set, "%s %.3g", nh_run_record_set_by(m), nh_run_record_set_to(m));
        nh_text_addf(out, "%-13.0e%-30.29s%-19s%-9.2g", nh_benchmark_goal[i], m->method, set, m->seconds);
        if (isfinite(m->worst_drift)) nh_text_addf(out, "%.1g", m->worst_drift);
        else nh_text_add(out, "-");
        nh_text_add(out, "\n");
    }
    if (told && c->currents) {
        nh_text words;
        nh_text_init(&words);
        nh_text_add(&words, "Drift: the largest change of a conserved quantity (");
        for (size_t k = 0; k < c->currents; k++) nh_text_addf(&words, "%s%s", k ? ", " : "", c->current[k]);
        nh_text_add(&words, "), relative to its terms.");
        nh_screen_say(out, 0, &words);
    }
}

/* How many runs each method that fails has, by what happened. */
static void failures(const nh_benchmark *c, nh_text *out)
{
    size_t n[NH_RUN_STATUSES] = {0};
    nh_text words;
    nh_text_init(&words);
    for (size_t i = 0; i < c->count; i++) n[c->item[i].status]++;
    nh_text_addf(&words, "%zu runs: ", c->count);
    for (size_t k = 0, told = 0; k < NH_RUN_STATUSES; k++)
        if (n[k]) nh_text_addf(&words, "%s%zu %s", told++ ? ", " : "", n[k], nh_run_record_status_name(k));
    nh_text_add(&words, ". ");
    if (n[NH_FLAGGED] + n[NH_DETECTED])
        nh_text_add(&words, "Flagged: accurate, but a check warned; detected: not accurate, and a check said so. ");
    if (n[NH_UNDETECTED]) nh_text_add(&words, "Undetected: not accurate, and no check said so. ");
    if (n[NH_NOT_RUN]) nh_text_add(&words, "Not run: the budget was used up, or the run before it had no time. ");
    nh_text_add(out, "\n");
    nh_screen_say(out, 0, &words);
}

static void put_orders_on_screen(const nh_benchmark *c, nh_text *out)
{
    nh_text words;
    nh_text_init(&words);
    nh_benchmark_put_orders(c, 1, &words);
    nh_screen_say(out, 0, &words);
}

static void where_they_fail(const nh_robustness *s, nh_text *out)
{
    nh_text words;
    nh_text_init(&words);
    if (!s) return;
    nh_text_addf(&words, "Made worse in %zu way%s, at tolerance %.1g:", s->maps, s->maps == 1 ? "" : "s", s->tolerance);
    for (size_t k = 0; k < NH_RUN_STATUSES; k++)
        nh_text_addf(&words, "%s %zu %s", k ? "," : "", s->count[k], nh_run_record_status_name(k));
    nh_text_add(&words, ".");
    nh_screen_say(out, 0, &words);
}

void nh_benchmark_write_answer(const nh_benchmark *c, const nh_robustness *s, bool colour, nh_text *out)
{
    const char *warning[NH_BENCHMARK_WARNINGS];
    headline(c, colour, out);
    fastest(c, out);
    failures(c, out);
    put_orders_on_screen(c, out);
    where_they_fail(s, out);
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++)
        nh_screen_paragraph(0, 2, nh_arena_printf(c->arena, "Warning: %s", warning[i]), out);
    if (c->partial)
        nh_screen_paragraph(
            0, 2, "Warning: the budget ended before every method had all its runs; --budget allows more", out);
    nh_screen_more(out, "all methods and runs, orders, derivatives, where methods fail",
                   "--svg FILE  seconds and evaluations against error");
}

/* ---- where methods fail ---- */

/* A table: the first quantity downwards, across it the methods, or for one method the second quantity. */
static void map_of(nh_pen *p, const nh_robustness_map *map, size_t first, size_t step, size_t across,
                   const char *caption, const char *corner)
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

/* The notes of cells, which a terminal's table does not show. */
static void put_notes(nh_pen *p, const nh_robustness_map *map)
{
    nh_pen_open(p, NH_PEN_FACTS, NULL, NULL);
    for (size_t i = 0; i < map->cells; i++) {
        const nh_robustness_cell *at = &map->cell[i];
        if (!at->note || !at->note[0]) continue;
        nh_pen_fact_begin(p, at->method);
        nh_pen_say(p, "at %.4g", at->at);
        if (map->second_axis) nh_pen_say(p, ", %.4g", at->second_at);
        nh_pen_say(p, " %s: %s", nh_run_record_status_name(at->status), at->note);
        nh_pen_close(p, NH_PEN_FACT);
    }
    nh_pen_close(p, NH_PEN_FACTS);
}

void nh_benchmark_write_robustness(nh_pen *p, const nh_robustness *s)
{
    if (!s) return;
    nh_pen_section(p, "robustness", "Where methods fail");
    nh_pen_words(
        p,
        "At tolerance %.1g; an error below %.1g is accurate. Flagged: accurate, and a safeguard triggered; "
        "detected: not accurate, and a safeguard says so; "
        "failed: ended early, with a reason; timeout: begun, and ended by a limit; undetected: not accurate, and no "
        "safeguard triggered; not run: refused by the method, or the budget was used up.",
        s->tolerance, s->accuracy);
    for (size_t i = 0; i < s->maps; i++) {
        map_table(p, &s->map[i]);
        if (p->ink->brief) put_notes(p, &s->map[i]);
    }
    if (!p->ink->brief) return; /* on a page each cell has its colour */
    nh_pen_open(p, NH_PEN_WORDS, NULL, NULL);
    nh_pen_say(p, "In all:");
    for (int k = 0; k < NH_RUN_STATUSES; k++)
        nh_pen_say(p, "%s %zu %s", k ? "," : "", s->count[k], nh_run_record_status_name((nh_run_record_status)k));
    nh_pen_close(p, NH_PEN_WORDS);
}
