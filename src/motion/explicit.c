#include "motion/explicit.h"

#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/memory.h"
#include "motion/guards.h"

typedef struct {
    const nh_flow_problem *problem;
    const nh_flow_options *options;
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver;
    gsl_odeiv2_step *between; /* the shorter step that reads a state inside the last one; NULL: steps end at the output times */
    const double *times;
    size_t count;
    double h, before, now;     /* next step; times before and after the last one */
    double *state, *old, *work; /* now; before the last step */
    nh_guards guards;
    long evaluations;
} explicit_work;

static int call_rate(double t, const double *z, double *rate, void *context)
{
    explicit_work *work = context;
    work->evaluations++;
    if (!work->problem->rate(t, z, rate, work->problem->context)) return GSL_FAILURE; /* a smaller step is tried */
    for (size_t i = 0; i < work->problem->size; i++)
        if (!isfinite(rate[i])) return GSL_FAILURE;
    return GSL_SUCCESS;
}

static bool changed_after(const explicit_work *work, double t, double *z)
{
    return !work->options->after || work->options->after(t, z, work->options->after_context);
}

/* Back to before the last step, where a guard has changed its sign over it. */
static nh_step go_back(explicit_work *work, nh_guard_verdict verdict, double *time)
{
    memcpy(work->state, work->old, work->problem->size * sizeof *work->state);
    *time = work->now = work->before;
    gsl_odeiv2_evolve_reset(work->driver->e);
    gsl_odeiv2_step_reset(work->driver->s);
    return verdict == NH_GUARD_END ? NH_STEP_LAST : NH_STEP_ON;
}

static nh_step explicit_advance(double *time, nh_motion *motion, void *context)
{
    explicit_work *work = context;
    double target = work->times[work->between ? work->count - 1 : motion->count];
    size_t size = work->problem->size;
    if (fabs(work->h) > work->guards.longest) work->h = copysign(work->guards.longest, work->h);
    double wanted = work->h;
    work->before = *time;
    memcpy(work->old, work->state, size * sizeof *work->old);
    int flag = gsl_odeiv2_evolve_apply(work->driver->e, work->driver->c, work->driver->s, &work->system, time, target, &work->h, work->state);
    motion->evaluations = work->evaluations;
    work->now = *time;
    bool last = *time == work->times[work->count - 1];
    nh_guard_verdict verdict = flag == GSL_SUCCESS ? nh_guards_judge(&work->guards, work->before, *time, work->state, motion) : NH_GUARD_KEPT;
    if (verdict != NH_GUARD_KEPT) return go_back(work, verdict, time);
    if (*time == target && fabs(work->h) < fabs(wanted)) work->h = wanted; /* it was cut to end there */
    if (flag == GSL_SUCCESS && work->options->after) {
        if (!changed_after(work, *time, work->state)) {
            nh_motion_note(motion, "the state could not be projected near t = %.10g", *time);
            return NH_STEP_FAILED;
        }
        gsl_odeiv2_evolve_reset(work->driver->e);
    }
    if (flag == GSL_SUCCESS) return last ? NH_STEP_LAST : NH_STEP_ON;
    nh_motion_note(motion, "no step near t = %.10g is small enough, or the right-hand side cannot be evaluated there", *time);
    return NH_STEP_FAILED;
}

/* Steps end at the output times. */
static bool explicit_state(double time, double *state, void *context)
{
    explicit_work *work = context;
    (void)time;
    memcpy(state, work->state, work->problem->size * sizeof *state);
    return true;
}

/* At the end of the last step that is the state itself; before it, a shorter step from its beginning. */
static bool between_state(double time, double *state, void *context)
{
    explicit_work *work = context;
    size_t size = work->problem->size;
    memcpy(state, time == work->now ? work->state : work->old, size * sizeof *state);
    if (time == work->now || time == work->before) return true;
    int flag = gsl_odeiv2_step_apply(work->between, work->before, time - work->before, state, work->work, NULL, NULL, &work->system);
    return flag == GSL_SUCCESS && changed_after(work, time, state);
}

static void explicit_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the time no longer moves near t = %.10g: the solution is singular there", motion->end_time);
}

/* A first step that changes the state by a hundredth of its size; the error control takes it from there. */
static double first_step(explicit_work *work, double span)
{
    double size = 0, speed = 0;
    if (!work->problem->rate(work->times[0], work->state, work->work, work->problem->context)) return 0;
    work->evaluations++;
    for (size_t i = 0; i < work->problem->size; i++) {
        double scale = work->options->scale ? work->options->scale[i] : 1;
        size = fmax(size, fmax(fabs(work->state[i]), scale));
        speed = fmax(speed, fabs(work->work[i]));
    }
    double h = speed > 0 ? fmin(0.01 * size / speed, fabs(span)) : fabs(span) * 0.01;
    return span < 0 ? -h : h;
}

static bool set_up(explicit_work *work, nh_explicit_method method, double rtol)
{
    static const gsl_odeiv2_step_type *const *const types[] = {&gsl_odeiv2_step_rk8pd, &gsl_odeiv2_step_rkf45, &gsl_odeiv2_step_msadams};
    size_t size = work->problem->size;
    double *scale = nh_alloc_array(size, sizeof *scale);
    for (size_t i = 0; i < size; i++) scale[i] = work->options->scale ? work->options->scale[i] : 1;
    gsl_set_error_handler_off();
    work->h = first_step(work, work->times[work->count - 1] - work->times[0]);
    /* atol_i = rtol * scale_i; GSL adds the relative part itself */
    if (work->h != 0) work->driver = gsl_odeiv2_driver_alloc_scaled_new(&work->system, *types[method], work->h, rtol, rtol, 1, 0, scale);
    if (work->driver && method != NH_MSADAMS) work->between = gsl_odeiv2_step_alloc(*types[method], size);
    nh_free(scale);
    return work->driver != NULL;
}

nh_motion *nh_explicit(nh_explicit_method method, const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                       const nh_flow_options *options, nh_error *error)
{
    size_t size = problem->size;
    nh_motion *motion = nh_motion_start(size, size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    explicit_work work = {.problem = problem, .options = options, .times = times, .count = count};
    work.system = (gsl_odeiv2_system){.function = call_rate, .dimension = size, .params = &work};
    work.state = nh_alloc_array(3 * size, sizeof *work.state);
    work.old = work.state + size;
    work.work = work.old + size;
    memcpy(work.state, initial, size * sizeof *initial);
    nh_guards_begin(&work.guards, problem, options, initial, count, times);
    bool good = set_up(&work, method, nh_motion_rtol(motion, options));
    if (good) {
        nh_stepper stepper = {.context = &work, .advance = explicit_advance, .state = work.between ? between_state : explicit_state, .stuck = explicit_stuck};
        nh_motion_run(motion, count, times, options, &stepper);
        motion->evaluations = work.evaluations;
    } else {
        nh_fail(error, NH_NUMERIC, "", "the right-hand side cannot be evaluated at the initial state (t = %.10g)", times[0]);
        nh_motion_free(motion);
        motion = NULL;
    }
    if (work.between) gsl_odeiv2_step_free(work.between);
    if (work.driver) gsl_odeiv2_driver_free(work.driver);
    nh_guards_clear(&work.guards);
    nh_free(work.state);
    return motion;
}
