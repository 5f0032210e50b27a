/* The first screen of a benchmark: the fastest method for each accuracy, and where methods fail. */
#include <math.h>
#include <stdio.h>

#include "document/benchmark.h"
#include "document/benchmark_internal.h"
#include "document/screen.h"

const char *nh_run_record_set_by(const nh_run_record *m) { return isnan(m->step) ? "tolerance" : "step"; }

double nh_run_record_set_to(const nh_run_record *m) { return isnan(m->step) ? m->tolerance : m->step; }

static void headline(const nh_benchmark *c, bool colour, nh_text *out)
{
    const nh_run_record *best = nh_benchmark_fastest(c, 0, c->count, 1e-6, false);
    nh_text words;
    nh_text_init(&words);
    if (best)
        nh_text_addf(&words, "Fastest with an error below a millionth: %s, %.2g seconds.", best->method, best->seconds);
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
    size_t n[NH_UNDETECTED + 1] = {0};
    nh_text words;
    nh_text_init(&words);
    for (size_t i = 0; i < c->count; i++) n[c->item[i].status]++;
    nh_text_addf(&words, "%zu runs: ", c->count);
    for (size_t k = 0, told = 0; k <= NH_UNDETECTED; k++)
        if (n[k]) nh_text_addf(&words, "%s%zu %s", told++ ? ", " : "", n[k], nh_run_record_status_name(k));
    nh_text_add(&words, ". ");
    if (n[NH_FLAGGED] + n[NH_DETECTED])
        nh_text_add(&words, "Flagged: accurate, but a check warned; detected: not accurate, and a check said so. ");
    if (n[NH_UNDETECTED]) nh_text_add(&words, "Undetected: not accurate, and no check said so. ");
    nh_text_add(out, "\n");
    nh_screen_say(out, 0, &words);
}

static void where_they_fail(const nh_robustness *s, nh_text *out)
{
    nh_text words;
    nh_text_init(&words);
    if (!s) return;
    nh_text_addf(&words, "Made worse in %zu way%s, at tolerance %.1g:", s->maps, s->maps == 1 ? "" : "s", s->tolerance);
    for (size_t k = 0; k <= NH_UNDETECTED; k++)
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
    where_they_fail(s, out);
    for (size_t i = 0, n = nh_benchmark_warnings(c, warning); i < n; i++)
        nh_screen_paragraph(0, 2, nh_arena_printf(c->arena, "Warning: %s", warning[i]), out);
    if (c->partial)
        nh_screen_paragraph(
            0, 2, "Warning: the budget ended before every method had all its runs; --budget allows more", out);
    nh_screen_more(out, "all methods and runs, orders, derivatives, where methods fail",
                   "--svg FILE  time against error");
}
