/* flow: see flow.h.  The first half is common to all integrators (checks, output, limits), the second half is CVODE's.
 *
 * CVODE is driven step by step and the output times are interpolated in each step: so the limit of steps is exact, a
 * cancellation is seen after every step, and the choice of output times does not change the motion. */
#include "motion/flow.h"

#include <float.h>
#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/clock.h"
#include "base/effort.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "motion/sizes.h"
#include "motion/sundials.h"

/* CVODE and IDA refuse to work below some 10 roundings; the error stops falling well before. */
static const double smallest_rtol = 1e-14;
static const double default_max_steps = 1e7;

/* ---- common to all integrators ---- */

static bool check_times(size_t count, const double *times, nh_error *error)
{
    if (count == 0)
        return nh_fail(error, NH_INPUT, "", "a motion needs at least one output time");
    if (!nh_all_finite(count, times))
        return nh_fail(error, NH_INPUT, "", "an output time is not a finite number");
    bool backward = times[count - 1] < times[0];
    for (size_t i = 1; i < count; i++)
        if (backward ? times[i] > times[i - 1] : times[i] < times[i - 1])
            return nh_fail(error, NH_INPUT, "", "the output times must all rise or all fall, but time %zu is %.17g after %.17g",
                           i + 1, times[i], times[i - 1]);
    return true;
}

static bool check_values(size_t given, const double *initial, const nh_flow_options *options, nh_error *error)
{
    if (given == 0)
        return nh_fail(error, NH_INPUT, "", "a motion needs at least one state");
    if (!(options->rtol > 0 && isfinite(options->rtol)))
        return nh_fail(error, NH_INPUT, "", "the relative tolerance must be a positive number, not %g", options->rtol);
    for (size_t i = 0; i < given; i++) {
        if (!isfinite(initial[i]))
            return nh_fail(error, NH_NUMERIC, "", "the initial value of state %zu is not a finite number", i + 1);
        if (options->scale && !(options->scale[i] > 0 && isfinite(options->scale[i])))
            return nh_fail(error, NH_INPUT, "", "the scale of state %zu must be a positive number, not %g", i + 1,
                           options->scale[i]);
    }
    return true;
}

nh_motion *nh_motion_start(size_t size, size_t given, const double *initial, size_t count, const double *times,
                           const nh_flow_options *options, nh_error *error)
{
    if (!check_times(count, times, error) || !check_values(given, initial, options, error))
        return NULL;
    nh_motion *motion = nh_alloc(sizeof *motion);
    motion->size = size;
    motion->time = nh_alloc_array(count, sizeof *motion->time);
    motion->state = nh_alloc_array(count, size * sizeof *motion->state);
    motion->end_state = nh_alloc_array(size, sizeof *motion->end_state);
    motion->guard_hit = -1;
    motion->end_time = times[0];
    memcpy(motion->end_state, initial, given * sizeof *initial);
    for (; motion->count < count && times[motion->count] == times[0]; motion->count++) {
        motion->time[motion->count] = times[0];
        memcpy(motion->state + motion->count * size, initial, given * sizeof *initial);
    }
    motion->complete = motion->count == count;
    return motion;
}

void nh_motion_free(nh_motion *motion)
{
    if (!motion)
        return;
    nh_free(motion->time);
    nh_free(motion->state);
    nh_free(motion->end_state);
    nh_free(motion);
}

void nh_motion_note(nh_motion *motion, const char *format, ...)
{
    size_t used = strlen(motion->note);
    if (used > 0 && used + 2 < sizeof motion->note)
        used += (size_t)snprintf(motion->note + used, sizeof motion->note - used, "; ");
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(motion->note + used, sizeof motion->note - used, format, arguments);
    va_end(arguments);
}

double nh_motion_rtol(nh_motion *motion, const nh_flow_options *options)
{
    if (options->rtol >= smallest_rtol)
        return options->rtol;
    nh_motion_note(motion, "a relative tolerance of %g is below rounding, %g was used", options->rtol, smallest_rtol);
    return smallest_rtol;
}

/* Output at the wanted times up to `now`; false when a state there is not finite. */
static bool store_reached(nh_motion *motion, size_t count, const double *times, double now, const nh_stepper *stepper)
{
    bool backward = times[count - 1] < times[0];
    while (motion->count < count && (backward ? times[motion->count] >= now : times[motion->count] <= now)) {
        double wanted = times[motion->count], *row = motion->state + motion->count * motion->size;
        if (!stepper->state(wanted, row, stepper->context) || !nh_all_finite(motion->size, row)) {
            nh_motion_note(motion, "the state is not finite at t = %.10g", wanted);
            return false;
        }
        motion->time[motion->count++] = wanted;
    }
    return true;
}

/* How far a long motion has come. */
static void tell(const nh_motion *motion, size_t count, const double *times)
{
    enum { steps_between_words = 2048 };
    double span = times[count - 1] - times[0];
    if (motion->steps > 0 && motion->steps % steps_between_words == 0 && span != 0 && !nh_in_turns()) nh_progress("a motion", (motion->end_time - times[0]) / span);
}

/* Whether the motion may take another step. */
static bool may_go_on(nh_motion *motion, const nh_flow_options *options, double begin)
{
    if (options->effort > 0 && nh_effort() - begin > options->effort) {
        nh_motion_note(motion, "the limit of %.2g counted operations was reached at t = %.10g", options->effort, motion->end_time);
        return false;
    }
    double limit = options->max_steps > 0 ? options->max_steps : default_max_steps;
    if (nh_interrupted())
        nh_motion_note(motion, "interrupted at t = %.10g", motion->end_time);
    else if (options->cancelled && options->cancelled(options->cancel_context))
        nh_motion_note(motion, "cancelled at t = %.10g", motion->end_time);
    else if ((double)motion->steps >= limit)
        nh_motion_note(motion, "the limit of %g steps was reached at t = %.10g; allow more steps or a larger tolerance", limit,
                       motion->end_time);
    else
        return true;
    return false;
}

static void keep_end_state(nh_motion *motion, double *work, const nh_stepper *stepper)
{
    if (stepper->state(motion->end_time, work, stepper->context) && nh_all_finite(motion->size, work))
        memcpy(motion->end_state, work, motion->size * sizeof *work);
}

void nh_motion_run(nh_motion *motion, size_t count, const double *times, const nh_flow_options *options,
                   const nh_stepper *stepper)
{
    double begin = nh_clock(), before = nh_effort();
    double *work = nh_alloc_array(motion->size, sizeof *work);
    nh_step step = NH_STEP_ON;
    bool given = nh_turn_give(); /* steps evaluate tapes, and touch no expressions */
    for (int stuck = 0; step == NH_STEP_ON && motion->count < count && may_go_on(motion, options, before);) {
        double time = motion->end_time;
        tell(motion, count, times);
        step = stepper->advance(&time, motion, stepper->context);
        if (step == NH_STEP_FAILED)
            break;
        motion->steps++;
        nh_effort_add(stepper->step_effort);
        stuck = time == motion->end_time ? stuck + 1 : 0;
        motion->end_time = time;
        if (!store_reached(motion, count, times, time, stepper))
            break;
        if (stuck == NH_STUCK_AFTER) {
            stepper->stuck(motion, stepper->context);
            break;
        }
    }
    if (motion->steps > 0)
        keep_end_state(motion, work, stepper);
    if (given)
        nh_turn_take();
    motion->complete = motion->count == count;
    nh_free(work);
    motion->seconds = nh_clock() - begin;
    motion->effort = nh_effort() - before;
}

/* ---- CVODE ----
 *
 * Newton's iteration with a dense matrix for both methods, also for Adams.  The sleigh (k = 2, rtol 1e-10) takes
 *                 Newton                        fixed-point iteration
 *     T = 10      0.42 ms, 258 rates, 9e-10     0.62 ms, 460 rates, 8e-11
 *     T = 1000    1.1 ms, 820 rates, 2e-9       51 ms, 37577 rates, 9e-11
 * because the fixed-point iteration limits the steps once the motion has become steady. */

/* Units of effort: of a step; of a right-hand side with its iteration, and the same per number of the state; of the factors of the linear equations. */
static const double cvode_step = 800, cvode_rate = 80, cvode_vectors = 90, cvode_flop = 0.3, cvode_factor = 100;

typedef struct {
    const nh_flow_problem *problem;
    nh_sundials sundials;
    void *cvode;
    N_Vector state;
    nh_sizes sizes;
    SUNMatrix matrix;
    SUNLinearSolver solver;
    int *root;   /* per guard: +1 rising, -1 falling, 0 none */
    double stop; /* the last wanted time */
    double rtol;
    double each; /* units of effort of a right-hand side, with the solution of the linear equations */
    long evaluations, jacobians, set_ups;
    const char *failed; /* what the callbacks could not compute in the last steps, or NULL; at which time and step */
    double failed_at;
    long step, failed_step;
} cvode_work;

static int not_computed(cvode_work *work, const char *what, double t)
{
    work->failed = what;
    work->failed_at = t;
    work->failed_step = work->step;
    return 1; /* "recoverable": CVODE tries a smaller step */
}

static int call_rate(sunrealtype t, N_Vector state, N_Vector rate, void *user)
{
    cvode_work *work = user;
    const nh_flow_problem *problem = work->problem;
    work->evaluations++;
    nh_effort_add(work->each);
    if (problem->rate(t, NV_DATA_S(state), NV_DATA_S(rate), problem->context) && nh_all_finite(problem->size, NV_DATA_S(rate)))
        return 0;
    return not_computed(work, "right-hand side", t);
}

/* SUNDIALS' dense matrices are stored by columns without gaps, as flow.h wants them. */
static int call_jacobian(sunrealtype t, N_Vector state, N_Vector rate, SUNMatrix matrix, void *user, N_Vector work1, N_Vector work2,
                         N_Vector work3)
{
    (void)rate, (void)work1, (void)work2, (void)work3;
    cvode_work *work = user;
    const nh_flow_problem *problem = work->problem;
    if (problem->jacobian(t, NV_DATA_S(state), SM_DATA_D(matrix), problem->context) &&
        nh_all_finite(problem->size * problem->size, SM_DATA_D(matrix)))
        return 0;
    return not_computed(work, "Jacobian of the right-hand side", t);
}

static int call_weight(N_Vector state, N_Vector weight, void *user)
{
    const cvode_work *work = user;
    for (size_t i = 0; i < work->problem->size; i++)
        NV_DATA_S(weight)[i] = 1 / (work->rtol * fabs(NV_DATA_S(state)[i]) + nh_sizes_absolute(&work->sizes, work->rtol, i));
    return nh_all_finite(work->problem->size, NV_DATA_S(weight)) ? 0 : -1;
}

static int call_guard(sunrealtype t, N_Vector state, sunrealtype *value, void *user)
{
    cvode_work *work = user;
    const nh_flow_problem *problem = work->problem;
    if (problem->guard(t, NV_DATA_S(state), value, problem->context) && nh_all_finite(problem->guards, value))
        return 0;
    return not_computed(work, "guard", t);
}

/* CVODE prints unless it has a handler; warnings (positive codes) tell nothing that the note needs. */
static void explain(int flag, const cvode_work *work, nh_motion *motion)
{
    double t = motion->end_time;
    if (work->failed && flag != CV_TOO_MUCH_ACC)
        nh_motion_note(motion, "the %s cannot be evaluated near t = %.10g: the motion leaves its domain or meets a singularity "
                       "there; use other coordinates or stop earlier", work->failed, work->failed_at);
    else if (flag == CV_TOO_MUCH_ACC)
        nh_motion_note(motion, "the tolerance %g asks for more than double precision gives near t = %.10g; use a larger one",
                       work->rtol, t);
    else if (flag == CV_ERR_FAILURE)
        nh_motion_note(motion, "no step near t = %.10g is small enough for the tolerance %g: the solution jumps or is singular there; "
                       "use other coordinates or a larger tolerance", t, work->rtol);
    else if (flag == CV_CONV_FAILURE || flag == CV_LSETUP_FAIL || flag == CV_LSOLVE_FAIL)
        nh_motion_note(motion, "the equations of an implicit step cannot be solved near t = %.10g: the right-hand side changes too "
                       "fast there or its Jacobian is wrong; try the other method", t);
    else if (flag == CV_TOO_CLOSE)
        nh_motion_note(motion, "the times are too close together for double precision near t = %.10g", t);
    else
        nh_motion_note(motion, "the integrator stopped near t = %.10g: %s", t, work->sundials.message);
}

/* CVODE reports a sign change, or a guard that is exactly zero at the end of a step; both end the chart. */
static nh_step end_at_guard(double t, nh_motion *motion, cvode_work *work)
{
    int flag = CVodeGetRootInfo(work->cvode, work->root);
    size_t guard = 0;
    while (flag == CV_SUCCESS && guard < work->problem->guards && work->root[guard] == 0)
        guard++;
    if (guard == work->problem->guards)
        return NH_STEP_ON;
    motion->guard_hit = (long)guard;
    nh_motion_note(motion, "guard %zu %s through zero at t = %.10g", guard + 1, work->root[guard] > 0 ? "rises" : "falls", t);
    return NH_STEP_LAST;
}

/* The factorisations since the last look. */
static void count_set_ups(cvode_work *work)
{
    long now = 0;
    double n = (double)work->problem->size;
    CVodeGetNumLinSolvSetups(work->cvode, &now);
    nh_effort_add((double)(now - work->set_ups) * (cvode_factor + cvode_flop * n * n * n));
    work->set_ups = now;
}

static nh_step cvode_advance(double *time, nh_motion *motion, void *context)
{
    cvode_work *work = context;
    work->step = motion->steps;
    if (work->step > work->failed_step + NH_STUCK_AFTER) /* so many good steps since: no longer of interest */
        work->failed = NULL;
    int flag = CVode(work->cvode, work->stop, work->state, time, CV_ONE_STEP);
    motion->evaluations = work->evaluations;
    CVodeGetNumJacEvals(work->cvode, &motion->jacobians);
    count_set_ups(work);
    if (flag >= 0)
        nh_sizes_follow(&work->sizes, *time, NV_DATA_S(work->state));
    if (flag == CV_ROOT_RETURN)
        return end_at_guard(*time, motion, work);
    if (flag >= 0)
        return flag == CV_TSTOP_RETURN ? NH_STEP_LAST : NH_STEP_ON;
    explain(flag, work, motion);
    return NH_STEP_FAILED;
}

static bool cvode_state(double time, double *state, void *context)
{
    cvode_work *work = context;
    if (CVodeGetDky(work->cvode, time, 0, work->state) != CV_SUCCESS)
        return false;
    memcpy(state, NV_DATA_S(work->state), work->problem->size * sizeof *state);
    return true;
}

static void cvode_stuck(nh_motion *motion, void *context)
{
    explain(CV_ERR_FAILURE, context, motion);
}

static bool create_objects(cvode_work *work, nh_flow_method method)
{
    sunindextype size = (sunindextype)work->problem->size;
    if (!nh_sundials_open(&work->sundials))
        return false;
    work->state = N_VNew_Serial(size, work->sundials.context);
    work->matrix = SUNDenseMatrix(size, size, work->sundials.context);
    if (!work->state || !work->matrix)
        return false;
    work->solver = SUNLinSol_Dense(work->state, work->matrix, work->sundials.context);
    work->cvode = CVodeCreate(method == NH_BDF ? CV_BDF : CV_ADAMS, work->sundials.context);
    return work->solver && work->cvode;
}

static bool set_up(cvode_work *work, double start, const double *initial)
{
    const nh_flow_problem *problem = work->problem;
    memcpy(NV_DATA_S(work->state), initial, problem->size * sizeof *initial);
    bool good = nh_sundials_listen(CVode, work->cvode, &work->sundials) &&
                CVodeInit(work->cvode, call_rate, start, work->state) == CV_SUCCESS &&
                CVodeSetUserData(work->cvode, work) == CV_SUCCESS &&
                CVodeWFtolerances(work->cvode, call_weight) == CV_SUCCESS &&
                CVodeSetLinearSolver(work->cvode, work->solver, work->matrix) == CV_SUCCESS &&
                CVodeSetStopTime(work->cvode, work->stop) == CV_SUCCESS;
    if (good && problem->jacobian)
        good = CVodeSetJacFn(work->cvode, call_jacobian) == CV_SUCCESS;
    if (good && problem->guards > 0)
        good = CVodeRootInit(work->cvode, (int)problem->guards, call_guard) == CV_SUCCESS &&
               CVodeSetNoInactiveRootWarn(work->cvode) == CV_SUCCESS;
    return good;
}

static void destroy_objects(cvode_work *work)
{
    CVodeFree(&work->cvode);
    SUNLinSolFree(work->solver);
    SUNMatDestroy(work->matrix);
    N_VDestroy(work->state);
    nh_sundials_close(&work->sundials);
    nh_free(work->root);
    nh_sizes_clear(&work->sizes);
}

/* The right-hand side at the start: a motion that cannot begin is an error, one that cannot go on is not. */
static bool check_start(const nh_flow_problem *problem, double t, const double *initial, nh_error *error)
{
    double *rate = nh_alloc_array(problem->size, sizeof *rate);
    bool good = problem->rate(t, initial, rate, problem->context) && nh_all_finite(problem->size, rate);
    nh_free(rate);
    if (good)
        return true;
    nh_fail(error, NH_NUMERIC, "", "the right-hand side cannot be evaluated at the initial state (t = %.10g)", t);
    return nh_error_hint(error, "check the initial values, or use coordinates that are regular there");
}

nh_motion *nh_flow(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                   const nh_flow_options *options, nh_error *error)
{
    nh_motion *motion = nh_motion_start(problem->size, problem->size, initial, count, times, options, error);
    if (!motion || motion->complete)
        return motion;
    double n = (double)problem->size;
    cvode_work work = {.problem = problem, .stop = times[count - 1], .each = cvode_rate + cvode_vectors * n};
    bool good = check_start(problem, times[0], initial, error);
    if (!good)
        goto done;
    work.rtol = nh_motion_rtol(motion, options);
    work.root = nh_alloc_array(problem->guards, sizeof *work.root);
    good = nh_sizes_open(&work.sizes, problem, options, initial, count, times);
    work.evaluations = work.sizes.evaluations;
    good = good && create_objects(&work, options->method) && set_up(&work, times[0], initial);
    if (!good) {
        nh_fail(error, NH_NUMERIC, "", "the integrator cannot be set up: %s", work.sundials.message[0] ? work.sundials.message : "out of memory");
        goto done;
    }
    nh_stepper stepper = {.context = &work, .advance = cvode_advance, .state = cvode_state, .stuck = cvode_stuck, .step_effort = cvode_step};
    nh_motion_run(motion, count, times, options, &stepper);
done:
    destroy_objects(&work);
    if (!good) {
        nh_motion_free(motion);
        motion = NULL;
    }
    return motion;
}
