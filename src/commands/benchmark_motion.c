/* benchmark_motion: one motion of a comparison, computed by a candidate, with its error, drifts, time and status. */
#include <math.h>

#include "base/clock.h"
#include "base/progress.h"
#include "commands/benchmark_internal.h"

static bool late(void *context) { return nh_interrupted() || nh_clock() > ((nh_benchmark_work *)context)->deadline; }

/* A limit of steps gives the same result on a busy machine. */
static double most_steps(const nh_benchmark_work *c) { return c->once ? c->options.robustness_steps : 1e8; }

bool nh_benchmark_work_out_of_time(nh_benchmark_work *c, const nh_motion *motion)
{
    return late(c) || nh_clock() > c->deadline || (c->once && (double)motion->steps >= most_steps(c)) ||
           (c->effort > 0 && motion->effort >= c->effort);
}

static nh_motion *integrate(nh_benchmark_work *c, const nh_candidate_run *k, double tolerance, double step,
                            nh_error *error)
{
    nh_formulation *f = &c->formulation[k->formulation];
    nh_flow_options how = {.rtol = tolerance,
                           .step = step,
                           .scale = f->scale,
                           .max_steps = most_steps(c),
                           .effort = c->effort,
                           .cancelled = late,
                           .cancel_context = c};
    const double *times = c->solution.times;
    if (!k->method) {
        nh_chetaev_problem problem = nh_bordered_problem(f->bordered);
        problem.holds = k->index == 2;
        nh_chetaev_motion *full = nh_chetaev(&problem, f->z0, NH_BENCHMARK_OUTPUTS, times, &how, error);
        nh_motion *motion = full ? full->motion : NULL;
        if (full) full->motion = NULL;
        nh_chetaev_motion_free(full);
        return motion;
    }
    if (k->method->order)
        return nh_method_steps(k->method, f->programs, f->z0, NH_BENCHMARK_OUTPUTS, times, &how, error);
    nh_projection *p = k->projected ? nh_projection_create(f->model, c->held_currents, c->held, times[0],
                                                           times[NH_BENCHMARK_OUTPUTS - 1], f->z0)
                                    : NULL;
    if (p) how.after = nh_projection_apply;
    how.after_context = p;
    nh_motion *motion = nh_method_flow(k->method, &f->problem, f->z0, NH_BENCHMARK_OUTPUTS, times, &how, error);
    if (motion && p) motion->evaluations += nh_projection_evaluations(p);
    nh_projection_free(p);
    return motion;
}

/* Does the chart end on the way?  Most integrators step across its end unnoticed; CVODE watches the pivot. */
bool nh_formulation_breaks_down(nh_formulation *f, const nh_motion *motion)
{
    bool any = motion->guard_hit >= 0;
    if (f->model && !any) nh_free(nh_steep_points(f->dynamics, motion, &any));
    return any || f->breaks;
}

static nh_run_record_status status_of(const nh_options *o, const nh_run_record *m, bool complete, bool cancelled,
                                      bool guarded)
{
    if (!complete) return guarded ? NH_DETECTED : cancelled ? NH_TIMEOUT : NH_FAILED;
    bool wrong = isnan(m->tolerance) ? !(m->error <= o->benchmark_fixed)
                                     : !(m->error <= fmax(o->benchmark_error, o->benchmark_far * m->tolerance));
    if (guarded) return wrong ? NH_DETECTED : NH_FLAGGED;
    return wrong ? NH_UNDETECTED : NH_ACCURATE;
}

static void judge(nh_benchmark_work *c, const nh_candidate_run *k, nh_motion *motion, nh_run_record *m)
{
    nh_formulation *f = &c->formulation[k->formulation];
    size_t n = c->solution.currents;
    double *states = nh_alloc_array(NH_BENCHMARK_OUTPUTS * 2 * c->model->m, sizeof *states);
    m->drift = nh_arena_alloc(c->out->arena, (n + 1) * sizeof *m->drift);
    m->evaluations = motion->evaluations;
    bool good = f->reduced || nh_formulation_states(f, motion, states);
    if (motion->complete && f->reduced) {
        m->error = nh_reduced_error(f, motion);
        for (size_t i = 0; i < n; i++)
            m->drift[i] = c->solution.current[i] == c->model->E ? (m->worst_drift = nh_reduced_drift(f, motion)) : NAN;
    } else if (motion->complete && good) {
        m->error = nh_reference_solution_error(&c->solution, motion->count, states);
        nh_reference_solution_drifts(&c->solution, motion->count, states, m->drift);
        m->worst_drift = n ? 0 : NAN;
        for (size_t i = 0; i < n; i++) m->worst_drift = fmax(m->worst_drift, m->drift[i]);
    }
    bool steep = nh_formulation_breaks_down(f, motion), doubtful = c->out->doubtful && !f->reduced;
    m->status = status_of(&c->options, m, motion->complete && good, nh_benchmark_work_out_of_time(c, motion),
                          steep || doubtful);
    m->note = nh_arena_strdup(c->out->arena, motion->note[0] ? motion->note
                                             : steep         ? "the chart breaks down on the way"
                                             : doubtful      ? "no two methods agree on this motion"
                                                             : "");
    nh_free(states);
}

static nh_run_record begun(const nh_benchmark_work *c, const nh_candidate_run *k, double tolerance, double step)
{
    const nh_formulation *f = &c->formulation[k->formulation];
    return (nh_run_record){.method = !k->method     ? k->index == 2 ? "IDA, index 2" : "IDA, index 1"
                                     : k->projected ? nh_arena_printf(c->out->arena, "%s, projected", k->method->name)
                                                    : k->method->name,
                           .formulation = k->method ? f->name : "all coordinates, multipliers",
                           .order = k->method ? k->method->order : 0,
                           .observed_order = NAN,
                           .tolerance = tolerance,
                           .step = step,
                           .reduced = f->reduced != NULL,
                           .floor = f->reduced ? f->agreement : c->out->agreement,
                           .error = NAN,
                           .worst_drift = NAN,
                           .seconds = NAN,
                           .seconds_low = NAN,
                           .seconds_high = NAN,
                           .note = "",
                           .status = NH_FAILED};
}

void nh_benchmark_work_leave_out(nh_benchmark_work *c, const nh_candidate_run *k, double tolerance, double step,
                                 const char *why, nh_run_record *m)
{
    *m = begun(c, k, tolerance, step);
    m->status = NH_NOT_RUN;
    m->note = why;
}

static double set_deadline(nh_benchmark_work *c)
{
    double now = nh_clock(), left = c->begun + c->budget - now;
    c->deadline = now + fmax(left / 4, 0.01);
    return now;
}

void nh_benchmark_work_measure(nh_benchmark_work *c, nh_candidate_run *k, double tolerance, double step,
                               nh_run_record *m)
{
    nh_error error;
    nh_error_clear(&error);
    double begin = set_deadline(c);
    *m = begun(c, k, tolerance, step);
    nh_progress(m->method, (begin - c->begun) / c->budget);
    nh_motion *motion = integrate(c, k, tolerance, step, &error);
    if (motion) {
        judge(c, k, motion, m);
        m->seconds = m->time[m->repeats++] = motion->processor;
        m->below_floor = nh_judge_below(m->error, m->floor);
    } else {
        m->note = nh_arena_strdup(c->out->arena, error.what);
    }
    nh_motion_free(motion);
    k->last = nh_clock() - begin;
    k->given_up = m->status == NH_TIMEOUT; /* a smaller step or tolerance may still succeed after a failure */
}

void nh_benchmark_work_repeat(nh_benchmark_work *c, const nh_candidate_run *k, nh_run_record *m)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    set_deadline(c);
    nh_motion *motion = integrate(c, k, m->tolerance, m->step, &ignored);
    if (motion && motion->complete) m->time[m->repeats++] = motion->processor;
    nh_motion_free(motion);
}

static const double units = 1e9; /* units of effort per second */

/* A motion that decides what is compared is limited by counted work, which corresponds to a part of the budget on an
 * ordinary machine.  A cell of a map is limited by steps, and by a deadline where the maps have a budget. */
nh_motion *nh_benchmark_work_counted(nh_benchmark_work *c, const nh_candidate_run *k, double tolerance, double part)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    c->deadline = c->once ? nh_clock() + part * c->budget : INFINITY;
    c->effort = c->once ? 0 : part * c->budget * units;
    return integrate(c, k, tolerance, 0, &ignored);
}
