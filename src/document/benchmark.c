#include "document/benchmark.h"
#include "document/benchmark_internal.h"

#include <math.h>
#include <string.h>

#include "base/escape.h"
#include "base/json.h"

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
                     "reduced,front,note\n");
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
        nh_text_add(out, "\n");
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
    nh_json_put_number(item, "evaluations", (double)m->evaluations);
    nh_json_put_number(item, "order", m->order ? m->order : NAN);
    nh_json_put_number(item, "observed_order", m->observed_order);
    nh_json_put_text(item, "status", nh_run_record_status_json(m->status));
    nh_json_put_bool(item, "reduced", m->reduced);
    nh_json_put_bool(item, "front", m->front);
    nh_json_put_text(item, "note", m->note ? m->note : "");
}

static void put_fits(const nh_benchmark *c, nh_json *root)
{
    nh_json *list = nh_json_put_array(root, "discrete");
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        nh_json *item = nh_json_add_object(list);
        nh_json_put_number(item, "functions", (double)m->functions);
        nh_json_put_number(item, "columns", (double)m->columns);
        nh_json_put_number(item, "samples", (double)m->samples);
        nh_json_put_text(item, "basis", m->basis);
        nh_json_put_text(item, "route", m->route);
        nh_json_put_text(item, "solver", m->solver);
        nh_json_put_number(item, "rank", (double)m->rank);
        nh_json_put_number(item, "dimension", (double)m->dimension);
        nh_json_put_number(item, "wanted", (double)m->wanted);
        nh_json_put_number(item, "gap", m->gap);
        nh_json_put_number(item, "error", m->error);
        nh_json_put_number(item, "seconds", m->seconds);
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
