#include "motion/integrators.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>

#include "base/effort.h"
#include "base/memory.h"
#include "motion/wall_steps.h"
#include "motion/sizes.h"
#include "motion/stepping.h"

static const double part_across = 1e-3; /* the error that a step across a kink may have, as a part of the tolerance */

typedef struct {
    const nh_flow_problem *problem;
    const nh_flow_options *options;
    gsl_odeiv2_system system;
    gsl_odeiv2_driver *driver;
    /* the shorter step that gives a state inside the last one; NULL: steps end at the output times */
    gsl_odeiv2_step *between;
    const double *times;
    size_t count;
    double h, before, now;      /* next step; times before and after the last one */
    double *state, *old, *work; /* now; before the last step */
    nh_guards guards;
    nh_wall_steps walls;
    double apace; /* the step before a wall was approached; 0: none is */
    nh_sizes sizes;
    double rtol, each; /* each: units of effort of a stage, with its sums of n numbers */
    long evaluations;
} explicit_work;

/* ---- error control ----
 *
 * GSL's own, with D_i = rtol |z_i| and the sizes' part of it (sizes.h), which changes along the motion; GSL's takes
 * scales that do not.  With r = max_i |e_i|/D_i and a method of order q the next step is 0.9 h r^(-1/q) where r > 1.1,
 * at least h/5, and 0.9 h r^(-1/(q+1)) where r < 1/2, at most 5 h. */

typedef struct {
    const explicit_work *work;
} control_state;

static void *control_alloc(void) { return nh_alloc(sizeof(control_state)); }
static void control_free(void *state) { nh_free(state); }

static int control_init(void *state, double absolute, double relative, double of_state, double of_rate)
{
    (void)state, (void)absolute, (void)relative, (void)of_state, (void)of_rate;
    return GSL_SUCCESS;
}

static double allowed(const explicit_work *work, size_t i, double z)
{
    return work->rtol * fabs(z) + nh_sizes_absolute(&work->sizes, work->rtol, i);
}

static int control_adjust(void *state, size_t n, unsigned int order, const double *z, const double *error,
                          const double *rate, double *h)
{
    static const double safety = 0.9, too_large = 1.1, small = 0.5, most = 5;
    (void)rate;
    double worst = 0, before = *h;
    for (size_t i = 0; i < n; i++) {
        double r = fabs(error[i]) / allowed(((control_state *)state)->work, i, z[i]);
        if (!(r <= worst)) worst = r; /* also where the error is not a number */
    }
    if (!(worst <= too_large)) {
        *h = before * fmax(safety / pow(worst, 1.0 / order), 1 / most);
        return GSL_ODEIV_HADJ_DEC;
    }
    if (!(worst < small)) return GSL_ODEIV_HADJ_NIL;
    *h = before * fmax(1, fmin(safety / pow(fmax(worst, DBL_MIN), 1.0 / (order + 1.0)), most));
    return GSL_ODEIV_HADJ_INC;
}

static int control_level(void *state, double z, double rate, double h, size_t i, double *level)
{
    (void)rate, (void)h;
    *level = allowed(((control_state *)state)->work, i, z);
    return GSL_SUCCESS;
}

static int control_set_driver(void *state, const gsl_odeiv2_driver *driver)
{
    (void)state, (void)driver;
    return GSL_SUCCESS;
}

static const gsl_odeiv2_control_type control_type = {"sizes",       control_alloc,      control_init, control_adjust,
                                                     control_level, control_set_driver, control_free};

/* Makes a driver that has this control instead of its own. */
static gsl_odeiv2_driver *driver_of(explicit_work *work, const gsl_odeiv2_step_type *type)
{
    gsl_odeiv2_driver *driver =
        nh_memory_got(gsl_odeiv2_driver_alloc_y_new(&work->system, type, work->h, work->rtol, work->rtol));
    gsl_odeiv2_control *own = nh_memory_got(gsl_odeiv2_control_alloc(&control_type));
    ((control_state *)own->state)->work = work;
    gsl_odeiv2_control_free(driver->c);
    driver->c = own;
    gsl_odeiv2_control_set_driver(own, driver);
    return driver;
}

/* ---- steps ---- */

/* Units of effort (base/effort.h), by method: of a step, of a stage, and of a stage per number of the state. */
static const double step_units[] = {130, 0, 200}, stage_units[] = {20, 35, 40}, stage_vectors[] = {0.7, 1.3, 9};

static int call_rate(double t, const double *z, double *rate, void *context)
{
    explicit_work *work = context;
    work->evaluations++;
    nh_effort_add(work->each);
    nh_wall_steps_see(&work->walls, t, z);
    if (!work->problem->rate(t, z, rate, work->problem->context)) return GSL_FAILURE; /* a smaller step is tried */
    for (size_t i = 0; i < work->problem->size; i++)
        if (!isfinite(rate[i])) return GSL_FAILURE;
    return GSL_SUCCESS;
}

static bool rate_of_problem(double t, const double *z, double *rate, void *context)
{
    return call_rate(t, z, rate, context) == GSL_SUCCESS;
}

static bool changed_after(const explicit_work *work, double t, double *z)
{
    return !work->options->after || work->options->after(t, z, work->options->after_context);
}

static void forget(explicit_work *work)
{
    gsl_odeiv2_evolve_reset(work->driver->e);
    gsl_odeiv2_step_reset(work->driver->s);
}

/* Goes back to before the last step, where a guard has changed its sign in it. */
static nh_step go_back(explicit_work *work, nh_guard_verdict verdict, double *time)
{
    memcpy(work->state, work->old, work->problem->size * sizeof *work->state);
    *time = work->now = work->before;
    forget(work);
    return verdict == NH_GUARD_END ? NH_STEP_LAST : NH_STEP_ON;
}

/* Was there a wall in the last step?  True: the step is undone.  Behind a wall the steps become as long again as they
 * were before it. */
static bool back_from_wall(explicit_work *work, nh_motion *motion, double *time)
{
    nh_wall_verdict verdict =
        nh_wall_steps_judge(&work->walls, work->problem, work->before, work->old, work->now, work->state, motion);
    if (verdict == NH_WALL_BACK) {
        if (work->apace == 0) work->apace = work->now - work->before;
        go_back(work, NH_GUARD_BACK, time);
        return true;
    }
    if (work->apace != 0 && isinf(work->walls.longest)) work->h = work->apace, work->apace = 0;
    if (verdict == NH_WALL_CROSSED) forget(work);
    return false;
}

static nh_step explicit_advance(double *time, nh_motion *motion, void *context)
{
    explicit_work *work = context;
    double target = work->times[work->between ? work->count - 1 : motion->count];
    size_t size = work->problem->size;
    double longest = fmin(work->guards.longest, work->walls.longest);
    if (fabs(work->h) > longest) work->h = copysign(longest, work->h);
    double wanted = work->h;
    work->before = *time;
    memcpy(work->old, work->state, size * sizeof *work->old);
    int flag = gsl_odeiv2_evolve_apply(work->driver->e, work->driver->c, work->driver->s, &work->system, time, target,
                                       &work->h, work->state);
    motion->evaluations = work->evaluations + work->sizes.evaluations;
    work->now = *time;
    bool last = *time == work->times[work->count - 1];
    nh_guard_verdict verdict =
        flag == GSL_SUCCESS ? nh_guards_judge(&work->guards, work->before, *time, work->state, motion) : NH_GUARD_KEPT;
    if (verdict == NH_GUARD_TURN) last = true;
    else if (verdict != NH_GUARD_KEPT) return go_back(work, verdict, time);
    if (*time == target && fabs(work->h) < fabs(wanted)) work->h = wanted; /* the step was cut to end there */
    if (flag == GSL_SUCCESS && back_from_wall(work, motion, time)) return NH_STEP_ON;
    if (work->walls.held) return NH_STEP_FAILED;
    if (flag == GSL_SUCCESS && work->options->after) {
        if (!changed_after(work, *time, work->state)) {
            nh_motion_note(motion, "the state could not be projected near t = %.10g", *time);
            return NH_STEP_FAILED;
        }
        gsl_odeiv2_evolve_reset(work->driver->e);
    }
    if (flag == GSL_SUCCESS) {
        nh_sizes_follow(&work->sizes, *time, work->state);
        return last ? NH_STEP_LAST : NH_STEP_ON;
    }
    nh_motion_note(motion, "no step is small enough near t = %.10g, or the right-hand side cannot be evaluated there",
                   *time);
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
    int flag = gsl_odeiv2_step_apply(work->between, work->before, time - work->before, state, work->work, NULL, NULL,
                                     &work->system);
    return flag == GSL_SUCCESS && changed_after(work, time, state);
}

static void explicit_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the steps vanish near t = %.10g: none is as exact as the tolerance there",
                   motion->end_time);
}

/* A first step that changes the state by a hundredth of its size; the error control takes it from there. */
static double first_step(explicit_work *work, double span)
{
    double size = 0, speed = 0;
    if (work->sizes.tau > 0) return copysign(fmin(0.1 * work->sizes.tau, fabs(span)), span);
    if (!work->problem->rate(work->times[0], work->state, work->work, work->problem->context)) return 0;
    work->evaluations++;
    for (size_t i = 0; i < work->problem->size; i++) {
        size = fmax(size, fmax(fabs(work->state[i]), work->sizes.size[i]));
        speed = fmax(speed, fabs(work->work[i]));
    }
    double h = speed > 0 ? fmin(0.01 * size / speed, fabs(span)) : fabs(span) * 0.01;
    return span < 0 ? -h : h;
}

static bool set_up(explicit_work *work, nh_gsl_odeiv_method method)
{
    static const gsl_odeiv2_step_type *const *const types[] = {
#define X(kind, name) &gsl_odeiv2_step_##name,
        NH_GSL_ODEIV_TABLE(X)
#undef X
    };
    size_t size = work->problem->size;
    gsl_set_error_handler_off();
    if (!nh_sizes_open(&work->sizes, work->problem, work->options, work->state, work->count, work->times)) return false;
    work->evaluations += work->sizes.evaluations, work->sizes.evaluations = 0;
    work->h = first_step(work, work->times[work->count - 1] - work->times[0]);
    if (work->h != 0) work->driver = driver_of(work, *types[method]);
    if (work->driver && method != NH_MSADAMS)
        work->between = nh_memory_got(gsl_odeiv2_step_alloc(*types[method], size));
    return work->driver != NULL;
}

nh_motion *nh_gsl_odeiv(nh_gsl_odeiv_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                        const double *times, const nh_flow_options *options, nh_error *error)
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
    nh_wall_steps_begin(&work.walls, problem, initial, count, times);
    work.walls.span = fmax(work.walls.span, options->whole);
    work.rtol = nh_motion_rtol(motion, options);
    work.each = stage_units[method] + stage_vectors[method] * (double)size;
    bool good = set_up(&work, method);
    nh_wall_steps_coarser(&work.walls, part_across * work.rtol * work.sizes.tau);
    if (good) {
        nh_stepper stepper = {.context = &work,
                              .advance = explicit_advance,
                              .state = work.between ? between_state : explicit_state,
                              .stuck = explicit_stuck,
                              .step_effort = step_units[method],
                              .rate = rate_of_problem,
                              .dense = work.between != NULL,
                              .rate_context = &work};
        nh_motion_run(motion, count, times, options, &stepper);
        motion->evaluations = work.evaluations + work.sizes.evaluations;
    } else {
        nh_fail(error, NH_NUMERIC, "", "the right-hand side cannot be evaluated at the initial state (t = %.10g)",
                times[0]);
        nh_motion_free(motion);
        motion = NULL;
    }
    if (work.between) gsl_odeiv2_step_free(work.between);
    if (work.driver) gsl_odeiv2_driver_free(work.driver);
    nh_guards_clear(&work.guards);
    nh_wall_steps_clear(&work.walls);
    nh_sizes_clear(&work.sizes);
    nh_free(work.state);
    return motion;
}
