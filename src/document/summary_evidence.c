#include <math.h>

#include "graph/print.h"
#include "document/summary_internal.h"

/* ---- evidence ---- */

static void spectrum_line(nh_summary_writer *w, const char *name, const nh_spectrum *s)
{
    if (!s->done) return;
    nh_text_addf(w->out, "  %-15s %zu columns (%zu independent), %zu rows: ", name, s->columns, s->rank, s->rows);
    if (s->rank == 0) nh_text_add(w->out, "no column varies on the samples\n");
    else if (s->dimension == 0) nh_text_addf(w->out, "no null value; the smallest of the spectrum is %.2g\n", s->spectrum[0]);
    else {
        nh_text_addf(w->out, "%zu null value%s up to %.1e", s->dimension, s->dimension == 1 ? "" : "s", s->spectrum[s->dimension - 1]);
        if (s->dimension < s->rank) nh_text_addf(w->out, ", then %.2g: gap %.0e\n", s->spectrum[s->dimension], s->gap);
        else nh_text_add(w->out, ", and nothing else\n");
    }
}

enum { bar_heights = 8, few_bars = 64, bars_per_line = 72, name_width = 18 };

/* A bar between two powers of ten. */
static const char *bar(double value, double lowest, double top)
{
    static const char *const bars[bar_heights] = {"\u2581", "\u2582", "\u2583", "\u2584", "\u2585", "\u2586", "\u2587", "\u2588"};
    double part = (log10(fmax(value, 1e-300)) - lowest) / (top - lowest);
    return bars[(int)fmin(bar_heights - 1, fmax(0, floor(part * bar_heights)))];
}

/* One bar per value, by its logarithm from rounding to the largest: the smallest ones on one line, or all. */
static void bars(nh_summary_writer *w, const nh_spectrum *s, bool all)
{
    static const double lowest = -17; /* decades */
    double top = s->rank ? log10(fmax(s->spectrum[s->rank - 1], 1e-16)) : 0;
    size_t n = all || s->rank < few_bars ? s->rank : few_bars, per_line = all ? bars_per_line : few_bars;
    int indent = all ? 4 : name_width;
    for (size_t i = 0; i < n; i++) {
        bool ends = i % per_line == per_line - 1 || i + 1 == n;
        nh_text_addf(w->out, "%*s%s%s", i % per_line ? 0 : indent, "", bar(s->spectrum[i], lowest, top), !ends ? "" : n < s->rank ? " ...\n" : "\n");
    }
}

/* How far a current is from its first value, in its own size: the largest of each part of the time. */
static void drift_over_time(nh_summary_writer *w, const nh_validation *v, size_t k)
{
    enum { parts = 24 };
    static const double lowest = -16, top = 0;
    const nh_drift *d = &v->current[k];
    size_t column = 0, seen = 0;
    while (column < v->watches && (w->r->tracks.track[column].kind != NH_TRACK_CURRENT || seen++ < k)) column++;
    if (column == v->watches || v->count < 2 || !(d->scale > 0)) return;
    nh_text_add(w->out, "   ");
    for (size_t p = 0; p < parts && p < v->count; p++) {
        size_t n = parts < v->count ? parts : v->count, from = p * v->count / n, to = (p + 1) * v->count / n;
        double most = 0;
        for (size_t i = from; i < to; i++) most = fmax(most, fabs(v->watch[i * v->watches + column] - v->watch[column]) / d->scale);
        nh_text_add(w->out, bar(most, lowest, top));
    }
}

/* As bars, and with --verbose all the numbers, ascending. */
static void spectrum_values(nh_summary_writer *w, const nh_spectrum *s)
{
    enum { per_line = 10 };
    if (!s->done || s->rank < 2) return;
    bars(w, s, w->style.verbose);
    if (!w->style.verbose) return;
    for (size_t i = 0; i < s->rank; i++) nh_text_addf(w->out, "%s%9.1e%s", i % per_line ? "" : "    ", s->spectrum[i], i % per_line == per_line - 1 || i + 1 == s->rank ? "\n" : "");
}

static void unknowns(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    if (!r->hits) return;
    nh_text_add(w->out, "  unknown         ");
    for (size_t j = 0; j < r->hits->unknowns; j++) {
        const nh_unknown *u = &r->analysis->unknown[j];
        nh_text_addf(w->out, "%s%s in [%g, %g]", j ? ", " : "", nh_name_of(r->model->dag, u->symbol), u->low, u->high);
    }
    if (r->specials == 0) nh_text_addf(w->out, ": no value gives a current (smallest singular value %.1e)", r->hits->best);
    for (size_t k = 0; k < r->specials; k++) {
        const nh_special *s = &r->special[k];
        nh_text_add(w->out, k ? ";" : ":");
        for (size_t j = 0; j < r->hits->unknowns; j++) {
            nh_text_addf(w->out, " %s = ", nh_name_of(r->model->dag, r->analysis->unknown[j].symbol));
            if (s->recognised[j]) nh_print(r->model->dag, s->recognised[j], w->out);
            nh_text_addf(w->out, "%s%.15g", s->recognised[j] ? " = " : "", s->value[j]);
        }
        if (s->hit->by_pencil && s->hit->by_search) nh_text_addf(w->out, " (eigenvalue pencil and NLopt agree to %.0e)", fmax(s->hit->difference, 1e-16));
        else nh_text_addf(w->out, " (by %s)", s->hit->by_pencil ? "eigenvalue pencil" : "NLopt");
    }
    nh_text_add(w->out, "\n");
}

static void stages(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    for (size_t i = 0; i < r->stages; i++) {
        const nh_stage_record *s = &r->stage[i];
        if (s->skipped) nh_text_addf(w->out, "    %-80s too large: %s\n", s->name, nh_limit_words(r->arena, &s->limit));
        else {
            nh_text_addf(w->out, "    %-80s %4zu columns", s->name, s->columns);
            if (s->sectors > 1) nh_text_addf(w->out, " in %zu sectors", s->sectors);
            nh_text_addf(w->out, ", null %zu%s, new %zu\n", s->dimension, s->undecided ? " (undecided)" : "", s->found);
        }
    }
}

void nh_summary_evidence(nh_summary_writer *w)
{
    const nh_analysis *r = w->r;
    nh_summary_heading(w, "How it was found");
    nh_text_addf(w->out, "  ansatz          %s\n  samples         %zu points", r->ansatz_note, r->samples);
    if (r->beyond) nh_text_addf(w->out, " and %zu where the chart breaks down", r->beyond);
    nh_text_addf(w->out, ", %zu rejected\n", r->rejected);
    stages(w);
    unknowns(w);
    spectrum_line(w, "current route", &r->current);
    spectrum_values(w, &r->current);
    spectrum_line(w, "symmetry route", &r->symmetry);
    spectrum_values(w, &r->symmetry);
    if (r->routes_compared)
        nh_text_addf(w->out, "  the two routes %s: angle %.0e between the spaces found\n", r->routes_agree ? "agree" : "DISAGREE", fmax(r->routes_angle, 1e-16));
    if (r->counted_space.compared)
        nh_text_addf(w->out, "  the current route %s with the count of degree %zu: angle %.0e to the products of the currents\n", r->counted_space.agrees ? "agrees" : "DISAGREES",
                     r->counted_space.degree, fmax(r->counted_space.angle, 1e-16));
}

/* The watched quantities at a few times. */
static void watched(nh_summary_writer *w, const nh_validation *v)
{
    enum { rows = 5 };
    size_t first = w->r->tracks.count;
    while (first > 0 && w->r->tracks.track[first - 1].kind == NH_TRACK_WATCH) first--;
    if (first == v->watches || v->count < rows) return;
    nh_text_addf(w->out, "  %10s", "t");
    for (size_t j = first; j < v->watches; j++) nh_text_addf(w->out, "%14s", v->watch_name[j]);
    for (size_t i = 0; i < rows; i++) {
        size_t at = i * (v->count - 1) / (rows - 1);
        nh_text_addf(w->out, "\n  %10.4g", v->time[at]);
        for (size_t j = first; j < v->watches; j++) nh_text_addf(w->out, "%14.8g", v->watch[at * v->watches + j]);
    }
    nh_text_add(w->out, "\n");
}

void nh_summary_motion(nh_summary_writer *w)
{
    const nh_validation *v = w->r->validation;
    if (!v) return;
    nh_summary_heading(w, "Checked along a motion");
    nh_text_addf(w->out, "  %s in %s, t = %g to %.6g, %ld evaluations\n", v->method, v->chart, v->begin, v->end, v->evaluations);
    if (v->checked) nh_text_addf(w->out, "  %s\n", v->accuracy.why);
    if (!isnan(v->crossing))
        nh_text_addf(w->out, "  the chart of %s breaks down at t = %.4g; the chart of this motion is regular there\n", v->crossing_chart, v->crossing);
    if (v->currents) {
        nh_text_addf(w->out, "  drift at tolerance%10.0e%10.0e%10.0e   over time, from 1e-16 to 1\n", v->tolerance[0], v->tolerance[1], v->tolerance[2]);
        for (size_t k = 0; k < v->currents; k++) {
            const nh_drift *d = &v->current[k];
            nh_text_addf(w->out, "  %-18s%10.1e%10.1e%10.1e", w->r->found[k].name, d->drift[0], d->drift[1], d->drift[2]);
            drift_over_time(w, v, k);
            if (d->until < v->end - 1e-9 * fabs(v->end) && w->r->found[k].series) nh_text_addf(w->out, "  (to t = %.4g, where the motion leaves its interval)", d->until);
            nh_text_add(w->out, "\n");
        }
    }
    watched(w, v);
    if (v->scene)
        nh_text_addf(w->out, "  scene: %s\n         the same values to %.0e, %ld evaluations\n", v->scene, v->scene_difference, v->scene_evaluations);
    if (v->multiplier_form)
        nh_text_addf(w->out, "  multiplier form (%s): states agree to %.0e", v->multiplier_method, v->state_difference);
    if (v->multiplier_form && w->r->model->system->constraints)
        nh_text_addf(w->out, ", multipliers to %.0e, constraints hold to %.0e", v->multiplier_difference, v->violation);
    if (v->multiplier_form) nh_text_add(w->out, "\n");
    if (v->multistep) nh_text_addf(w->out, "  CVODE Adams: states agree to %.0e\n", v->multistep_difference);
}
