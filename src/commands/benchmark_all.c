/* benchmark_all: all methods in all formulations at all levels, repeated for their times, and what the numbers say.
 *
 * The first round goes level by level, so that a short budget still gives every method its runs at loose tolerances.
 * Further rounds, for which a part of the budget is kept, repeat what ended well, the short runs first.  The repetitions
 * of one run are thus spread over the time, and a burst of other work on the machine touches few of them. */
#include <math.h>

#include "base/clock.h"
#include "base/progress.h"
#include "commands/benchmark_internal.h"
#include "graph/function.h"
#include "graph/node.h"

enum { levels = NH_BENCHMARK_LEVELS, repeats_of_long_runs = 3 };
static const double tolerances[levels] = {1e-4, 1e-6, 1e-8, 1e-10, 1e-12};
static const double step_ratio = 4;          /* factor between fixed steps of consecutive levels */
static const double part_of_long_run = 2e-3; /* of the budget */

static const double part_for_repeats = 0.4; /* of the budget */

static double left(const nh_benchmark_work *c) { return c->begun + c->budget - nh_clock(); }

/* ---- runs ---- */

static void run(nh_benchmark_work *c, size_t i, size_t level)
{
    nh_candidate_run *k = &c->candidate[i];
    nh_run_record *m = &c->grid[i * levels + level];
    double span = fabs(c->out->end - c->out->begin), time = left(c) - part_for_repeats * c->budget;
    bool fixed = k->method && k->method->order, had = k->given_up;
    double tolerance = fixed ? NAN : tolerances[level],
           step = fixed ? span / (c->options.benchmark_steps * pow(step_ratio, (double)level)) : NAN;
    if (!had && (k->last * step_ratio > time / 2 || time <= 0)) c->out->partial = k->given_up = true;
    if (!k->given_up) nh_benchmark_work_measure(c, k, tolerance, step, m);
    else
        nh_benchmark_work_leave_out(c, k, tolerance, step,
                                    level && m[-1].status == NH_TIMEOUT ? "the run before it had no time"
                                    : had                               ? m[-1].note
                                                                        : "the budget had no time for it",
                                    m);
}

static bool ended_well(const nh_run_record *m) { return m->status <= NH_FLAGGED || m->status == NH_UNDETECTED; }

/* One more repetition of every short run, or of every long one. */
static void repeat(nh_benchmark_work *c, bool of_long)
{
    for (size_t level = 0; level < levels; level++)
        for (size_t i = 0; i < c->candidates; i++) {
            nh_run_record *m = &c->grid[i * levels + level];
            bool is_long = m->seconds > part_of_long_run * c->budget;
            if (ended_well(m) && is_long == of_long && m->seconds < left(c) / 4 && !nh_interrupted())
                nh_benchmark_work_repeat(c, &c->candidate[i], m);
        }
}

static void repeat_all(nh_benchmark_work *c)
{
    for (size_t round = 1; round < NH_BENCHMARK_REPEATS; round++) repeat(c, false);
    for (size_t round = 1; round < repeats_of_long_runs; round++) repeat(c, true);
}

/* ---- what they say ---- */

/* Does neither |x| nor sign(x) occur in the equations of motion? */
static bool is_smooth(const nh_model *model)
{
    NH_LIST(call);
    for (size_t i = 0; i < model->m + model->n; i++) {
        size_t n = nh_functions_in(model->dag, i < model->m ? model->rho[i] : model->a[i - model->m], &call);
        for (size_t k = 0; k < n; k++) {
            nh_function f = nh_function_of(model->dag, call[k]);
            if (f == NH_ABS || f == NH_SIGN) return false;
        }
    }
    return true;
}

/* log(e/e') / log(h/h').  NAN where an error is not above the error of the reference, or a larger step had no larger
 * one. */
static double observed_order(const nh_run_record *first, const nh_run_record *m)
{
    const nh_run_record *larger = m - 1;
    for (const nh_run_record *r = first; r < m; r++)
        if (r->error <= m->error) return NAN;
    bool tells = m->order && nh_judge_tells(larger->error, m->error, m->floor);
    return tells ? log(larger->error / m->error) / log(larger->step / m->step) : NAN;
}

static void judge_orders(nh_benchmark_work *c)
{
    nh_benchmark *out = c->out;
    bool smooth = is_smooth(c->model);
    out->order = nh_arena_alloc(out->arena, (c->candidates + 1) * sizeof *out->order);
    for (size_t i = 0; i < c->candidates; i++) {
        nh_run_record *m = &c->grid[i * levels];
        double step[levels], error[levels];
        for (size_t k = 0; k < levels; k++) {
            step[k] = m[k].step;
            error[k] = ended_well(&m[k]) && m[k].status != NH_FLAGGED ? m[k].error : NAN;
            if (k) m[k].observed_order = observed_order(m, &m[k]);
        }
        if (!m->order) continue;
        nh_judge_order o = nh_judge_order_of(m->order, smooth, out->end - out->begin, levels, step, error, m->floor);
        if (!isnan(o.observed))
            out->order[out->orders++] = (nh_benchmark_order){m->method, m->formulation, m->order, o};
    }
}

static void judge_times(nh_run_record *m)
{
    nh_judge_spread s = nh_judge_spread_of(m->repeats, m->time);
    m->seconds = s.median;
    m->seconds_low = s.low;
    m->seconds_high = s.high;
}

/* A flagged run is no recommendation, and reduced equations compute less. */
static void judge_fronts(nh_benchmark *out)
{
    nh_judge_point *p = nh_alloc_array(out->count + 1, sizeof *p);
    for (int by_work = 0; by_work < 2; by_work++) {
        for (size_t i = 0; i < out->count; i++) {
            const nh_run_record *m = &out->item[i];
            p[i] = (nh_judge_point){.error = m->error,
                                    .floor = m->floor,
                                    .work = by_work ? (double)m->evaluations : m->seconds,
                                    .counts = m->status == NH_ACCURATE && !m->reduced};
        }
        nh_judge_front(out->count, p);
        for (size_t i = 0; i < out->count; i++)
            *(by_work ? &out->item[i].front_evaluations : &out->item[i].front) = p[i].front;
    }
    nh_free(p);
}

void nh_benchmark_work_measure_all(nh_benchmark_work *c)
{
    nh_benchmark *out = c->out;
    c->grid = nh_arena_alloc(out->arena, (c->candidates * levels + 1) * sizeof *c->grid);
    for (size_t level = 0; level < levels; level++)
        for (size_t i = 0; i < c->candidates; i++) run(c, i, level);
    repeat_all(c);
    judge_orders(c);
    out->item = c->grid;
    out->count = c->candidates * levels;
    for (size_t i = 0; i < out->count; i++) judge_times(&out->item[i]);
    judge_fronts(out);
}
