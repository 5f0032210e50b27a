#include "document/benchmark.h"
#include "document/benchmark_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/json.h"
#include "base/memory.h"

const double nh_benchmark_goal[NH_BENCHMARK_GOALS] = {1e-3, 1e-6, 1e-9, 1e-12};

static bool same_line(const nh_run_record *a, const nh_run_record *b) { return !strcmp(a->method, b->method) && !strcmp(a->formulation, b->formulation); }

static void time_text(double seconds, char out[16])
{
    double us = 1e6 * seconds;
    snprintf(out, 16, us < 9.95 ? "%.1f" : "%.0f", us);
}

size_t nh_benchmark_warnings(const nh_benchmark *c, const char *out[NH_BENCHMARK_WARNINGS])
{
    size_t n = 0;
    if (c->shortened) out[n++] = "the time was shortened until two methods reached its end and agreed";
    if (c->doubtful) out[n++] = "no two methods agree on this motion, so that errors say little and nothing is called accurate; an earlier --until may help";
    return n;
}

/* ---- text ---- */

const nh_run_record *nh_benchmark_fastest(const nh_benchmark *c, size_t from, size_t to, double below, bool reduced)
{
    const nh_run_record *best = NULL;
    for (size_t i = from; i < to; i++) {
        const nh_run_record *m = &c->item[i];
        if (m->status <= (reduced ? NH_FLAGGED : NH_ACCURATE) && (reduced || !m->reduced) && m->error <= below && (!best || m->seconds < best->seconds)) best = m;
    }
    return best;
}

static void put_line(const nh_benchmark *c, size_t from, size_t to, nh_text *out)
{
    nh_text_addf(out, "    %-30s", c->item[from].method);
    for (int g = 0; g < NH_BENCHMARK_GOALS; g++) {
        const nh_run_record *m = nh_benchmark_fastest(c, from, to, nh_benchmark_goal[g], true);
        char us[16], cell[48];
        if (m) {
            time_text(m->seconds, us);
            snprintf(cell, sizeof cell, "%s (%ld)", us, m->evaluations);
        }
        nh_text_addf(out, "%18s", m ? cell : "-");
    }
    const nh_run_record *last = NULL;
    for (size_t i = from; i < to; i++)
        if (c->item[i].status >= NH_FLAGGED && !(last && last->status == NH_UNDETECTED)) last = &c->item[i];
    if (last) nh_text_addf(out, "   %s", nh_run_record_status_name(last->status));
    nh_text_add(out, "\n");
}

static void put_lines(const nh_benchmark *c, nh_text *out)
{
    const char *formulation = "";
    for (size_t i = 0, next; i < c->count; i = next) {
        for (next = i; next < c->count && same_line(&c->item[i], &c->item[next]);) next++;
        if (strcmp(formulation, c->item[i].formulation)) nh_text_addf(out, "  %s\n", formulation = c->item[i].formulation);
        put_line(c, i, next, out);
    }
}

static void put_run(const nh_benchmark *c, const nh_run_record *m, nh_text *out)
{
    char us[16];
    time_text(m->seconds, us);
    nh_text_addf(out, "  %-30s %-36s ", m->method, m->formulation);
    if (isnan(m->step)) nh_text_addf(out, "tolerance %-8.0e", m->tolerance);
    else nh_text_addf(out, "step %-13.3g", m->step);
    nh_text_addf(out, " %-10s", nh_run_record_status_name(m->status));
    if (isfinite(m->error)) nh_text_addf(out, " error %-9.1e", m->error);
    for (size_t k = 0; k < c->currents && m->drift && isfinite(m->error); k++)
        if (!isnan(m->drift[k])) nh_text_addf(out, " %s %.0e", c->current[k], m->drift[k]);
    nh_text_addf(out, " %s us %ld%s", isfinite(m->seconds) ? us : "-", m->evaluations, m->front ? " *" : "");
    if (m->note && m->note[0]) nh_text_addf(out, "  %s", m->note);
    nh_text_add(out, "\n");
}

static void put_front(const nh_benchmark *c, nh_text *out)
{
    for (int g = 0; g < NH_BENCHMARK_GOALS; g++) {
        const nh_run_record *m = nh_benchmark_fastest(c, 0, c->count, nh_benchmark_goal[g], false);
        if (!m) continue;
        char us[16];
        time_text(m->seconds, us);
        nh_text_addf(out, "  below %.0e: %s in %s, ", nh_benchmark_goal[g], m->method, m->formulation);
        if (isnan(m->step)) nh_text_addf(out, "tolerance %.0e", m->tolerance);
        else nh_text_addf(out, "step %.3g", m->step);
        nh_text_addf(out, ": error %.0e", m->error);
        if (isfinite(m->worst_drift)) nh_text_addf(out, ", drift %.0e", m->worst_drift);
        nh_text_addf(out, ", %s us, %ld evaluations%s\n", us, m->evaluations, nh_benchmark_goal[g] < c->agreement ? " (further than the reference is confirmed)" : "");
    }
}

void nh_benchmark_text(const nh_benchmark *c, bool verbose, nh_text *out)
{
    nh_text_addf(out, "%s: a motion from t = %g to %g\n", c->question->system->title ? c->question->system->title : c->question->system->name, c->begin, c->end);
    const char *warning[NH_BENCHMARK_WARNINGS];
    nh_text_addf(out, "Reference: %s; %s agrees to %.0e\n", c->reference, c->second, c->agreement);
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_text_addf(out, "warning: %s\n", warning[i]);
    nh_text_add(out, "\nMicroseconds (evaluations) to an error below");
    nh_text_addf(out, "\n%34s", "");
    for (int g = 0; g < NH_BENCHMARK_GOALS; g++) nh_text_addf(out, "%18.0e", nh_benchmark_goal[g]);
    nh_text_add(out, "\n");
    put_lines(c, out);
    nh_text_add(out, "\nFastest\n");
    put_front(c, out);
    if (c->currents) {
        nh_text_add(out, "  currents watched: ");
        for (size_t k = 0; k < c->currents; k++) nh_text_addf(out, "%s%s", k ? ", " : "", c->current[k]);
        nh_text_add(out, "\n");
    }
    for (size_t i = 0; i < c->refused; i++) nh_text_addf(out, "  not used, %s\n", c->refusal[i]);
    bool reduced = false;
    for (size_t i = 0; i < c->count; i++) reduced |= c->item[i].reduced;
    if (reduced) nh_text_add(out, "  reduced equations (the group divided out) compute shape and momenta only, and are left out here; errors are those of their own states\n");
    if (c->partial) nh_text_add(out, "  the budget ended before every method had all its runs; --budget allows more\n");
    if (c->derivatives) nh_text_add(out, "\nDerivatives: one Jacobian of the equations of motion\n");
    for (size_t i = 0; i < c->derivatives; i++) {
        const nh_derivative *d = &c->derivative[i];
        char us[16];
        time_text(d->seconds, us);
        if (isfinite(d->seconds)) nh_text_addf(out, "    %-34s%10s us %6ld evaluations   off by %.0e\n", d->method, us, d->evaluations, d->error);
    }
    nh_fits_text(c, verbose, out);
    if (verbose) nh_text_add(out, "\nAll runs (* nothing is both faster and more accurate)\n");
    for (size_t i = 0; i < c->count && verbose; i++) put_run(c, &c->item[i], out);
}

/* ---- robustness ---- */

static void put_at(const nh_robustness_map *map, const nh_robustness_cell *cell, char *out, size_t size)
{
    if (map->second_axis) snprintf(out, size, "%.4g, %.4g", cell->at, cell->second_at);
    else snprintf(out, size, "%.6g", cell->at);
}

void nh_robustness_text(const nh_robustness *s, bool verbose, nh_text *out)
{
    nh_text_addf(out, "\nRobustness at tolerance %.0e: an error below %.0e is accurate\n", s->tolerance, s->accuracy);
    for (size_t i = 0; i < s->maps; i++) {
        const nh_robustness_map *map = &s->map[i];
        nh_text_addf(out, "\n  %s\n  %14s", map->name, "");
        for (size_t j = 0; j < map->methods; j++) nh_text_addf(out, "%23s", map->cell[j].method);
        for (size_t j = 0; j < map->cells; j++) {
            char at[40];
            put_at(map, &map->cell[j], at, sizeof at);
            if (j % map->methods == 0) nh_text_addf(out, "\n  %14s", at);
            nh_text_addf(out, "%23s", nh_run_record_status_name(map->cell[j].status));
        }
        nh_text_add(out, "\n");
        for (size_t j = 0; j < map->cells && verbose; j++) {
            char at[40];
            put_at(map, &map->cell[j], at, sizeof at);
            if (map->cell[j].note && map->cell[j].note[0])
                nh_text_addf(out, "    %s, %s: %s: %s\n", at, map->cell[j].method, nh_run_record_status_name(map->cell[j].status), map->cell[j].note);
        }
    }
    nh_text_add(out, "\n  in all:");
    for (int k = 0; k <= NH_UNDETECTED; k++) nh_text_addf(out, "%s %zu %s", k ? "," : "", s->count[k], nh_run_record_status_name((nh_run_record_status)k));
    nh_text_add(out, "\n");
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
    nh_json_put_text(item, "status", nh_run_record_status_json(m->status));
    nh_json_put_bool(item, "reduced", m->reduced);
    nh_json_put_bool(item, "front", m->front);
    nh_json_put_text(item, "note", m->note ? m->note : "");
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
        nh_json_put_numbers(cell, "at", map->second_axis ? 2 : 1, (double[]){map->cell[i].at, map->cell[i].second_at}, 1);
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
    nh_fits_json(c, root);
    nh_json *refused = nh_json_put_array(root, "refused");
    for (size_t i = 0; i < c->refused; i++) nh_json_add_text(refused, c->refusal[i]);
    nh_json_put_bool(root, "partial", c->partial);
    nh_json *maps = nh_json_put_array(root, "stress"); /* the older word, for the scripts that read it */
    for (size_t i = 0; s && i < s->maps; i++) put_map(&s->map[i], maps);
    nh_json *warnings = nh_json_put_array(root, "warnings");
    const char *warning[NH_BENCHMARK_WARNINGS];
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++) nh_json_add_text(warnings, warning[i]);
    if (run) nh_run_json(run, c->question->system, root);
    return nh_json_finish(root);
}
