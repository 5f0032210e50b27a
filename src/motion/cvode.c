/* cvode: CVODE's part of motion.h.
 *
 * CVODE is driven step by step and the output times are interpolated in each step: so the limit of steps is exact, a
 * cancellation is seen after every step, and the choice of output times does not change the motion. */
#include "motion/integrators.h"

#include <math.h>
#include <string.h>

#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/effort.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "base/progress.h"
#include "motion/events.h"
#include "motion/wall_steps.h"
#include "motion/sizes.h"
#include "motion/sundials.h"
#include "motion/stepping.h"

enum { most_fails = 40 }; /* failures of the error test in one step: at a jump the step is shortened many times */

/* ---- CVODE ----
 *
 * Newton's iteration with a dense matrix for both methods, also for Adams.  The sleigh (k = 2, rtol 1e-10) takes
 *                 Newton                        fixed-point iteration
 *     T = 10      0.42 ms, 258 rates, 9e-10     0.62 ms, 460 rates, 8e-11
 *     T = 1000    1.1 ms, 820 rates, 2e-9       51 ms, 37577 rates, 9e-11
 * because the fixed-point iteration limits the steps once the motion has become steady. */

/* Units of effort: of a step; of a right-hand side with its iteration, and the same per number of the state; of
 * factoring the matrix of the linear equations. */
static const double cvode_step = 800, cvode_rate = 80, cvode_vectors = 90, cvode_flop = 0.3, cvode_factor = 100;

typedef struct {
    const nh_flow_problem *problem;
    const nh_flow_options *options;
    nh_sundials sundials;
    void *cvode;
    /* the current state; the state at a time in the last step, from whose end the next one begins */
    N_Vector state, inside;
    nh_sizes sizes;
    nh_wall_steps walls;
    /* across a wall: the motion of the last step by a one-step method, behind which the next step starts anew; else
     * NULL */
    nh_motion *across;
    double *old; /* the state before a step */
    size_t count;
    const double *times;
    SUNMatrix matrix;
    SUNLinearSolver solver;
    int *root;   /* per guard: +1 rising, -1 falling, 0 none */
    double stop; /* the last wanted time */
    double rtol;
    double each; /* units of effort of a right-hand side, with the solution of the linear equations */
    long evaluations, jacobians, set_ups;
    const char *failed; /* the function that could not be computed in the last steps, or NULL; at which time and step */
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
    if (problem->rate(t, NV_DATA_S(state), NV_DATA_S(rate), problem->context) &&
        nh_all_finite(problem->size, NV_DATA_S(rate)))
        return 0;
    return not_computed(work, "right-hand side", t);
}

/* SUNDIALS' dense matrices are stored by columns without gaps, as motion.h requires. */
static int call_jacobian(sunrealtype t, N_Vector state, N_Vector rate, SUNMatrix matrix, void *user, N_Vector work1,
                         N_Vector work2, N_Vector work3)
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
    for (size_t i = 0; i < work->problem->size; i++) NV_DATA_S(weight)
    [i] = 1 / (work->rtol * fabs(NV_DATA_S(state)[i]) + nh_sizes_absolute(&work->sizes, work->rtol, i));
    return nh_all_finite(work->problem->size, NV_DATA_S(weight)) ? 0 : -1;
}

static int call_guard(sunrealtype t, N_Vector state, sunrealtype *value, void *user)
{
    cvode_work *work = user;
    const nh_flow_problem *problem = work->problem;
    if (problem->guard(t, NV_DATA_S(state), value, problem->context) && nh_all_finite(problem->guards, value)) return 0;
    return not_computed(work, "guard", t);
}

/* CVODE prints its messages unless it has a handler; warnings (positive codes) are left out of the note. */
static void explain(int flag, const cvode_work *work, nh_motion *motion)
{
    double t = motion->end_time;
    if (work->failed && flag != CV_TOO_MUCH_ACC)
        nh_motion_note(motion,
                       "the %s cannot be evaluated near t = %.10g: the motion leaves its domain or meets a singularity "
                       "there; use other coordinates or stop earlier",
                       work->failed, work->failed_at);
    else if (flag == CV_TOO_MUCH_ACC)
        nh_motion_note(motion, "double precision cannot reach the tolerance %g near t = %.10g; use a larger tolerance",
                       work->rtol, t);
    else if (flag == CV_ERR_FAILURE)
        nh_motion_note(
            motion,
            "no step near t = %.10g is small enough for the tolerance %g: the solution may jump or be singular there; "
            "use other coordinates or a larger tolerance",
            t, work->rtol);
    else if (flag == CV_CONV_FAILURE || flag == CV_LSETUP_FAIL || flag == CV_LSOLVE_FAIL)
        nh_motion_note(
            motion,
            "the equations of an implicit step cannot be solved near t = %.10g: the right-hand side changes too "
            "fast there or its Jacobian is wrong; try the other method",
            t);
    else if (flag == CV_TOO_CLOSE)
        nh_motion_note(motion, "the times are too close together for double precision near t = %.10g", t);
    else nh_motion_note(motion, "the integrator stopped near t = %.10g: %s", t, work->sundials.message);
}

/* CVODE reports a sign change, or a guard that is exactly zero at the end of a step; both end the chart. */
static nh_step end_at_guard(double t, nh_motion *motion, cvode_work *work)
{
    int flag = CVodeGetRootInfo(work->cvode, work->root);
    size_t guard = 0;
    while (flag == CV_SUCCESS && guard < work->problem->guards && work->root[guard] == 0) guard++;
    if (guard == work->problem->guards) return NH_STEP_ON;
    motion->guard_hit = (long)guard;
    nh_motion_note(motion, "safeguard %zu %s through zero at t = %.10g", guard + 1,
                   work->root[guard] > 0 ? "rises" : "falls", t);
    return NH_STEP_LAST;
}

/* The number of factorisations since the last call. */
static void count_set_ups(cvode_work *work)
{
    long now = 0;
    double n = (double)work->problem->size;
    CVodeGetNumLinSolvSetups(work->cvode, &now);
    nh_effort_add((double)(now - work->set_ups) * (cvode_factor + cvode_flop * n * n * n));
    work->set_ups = now;
}

static bool cvode_state(double time, double *state, void *context)
{
    cvode_work *work = context;
    for (size_t i = 0; work->across && i < work->across->count; i++)
        if (work->across->time[i] == time)
            return memcpy(state, work->across->state + i * work->across->size, work->across->size * sizeof *state);
    if (work->across) return false;
    if (CVodeGetDky(work->cvode, time, 0, work->inside) != CV_SUCCESS) return false;
    memcpy(state, NV_DATA_S(work->inside), work->problem->size * sizeof *state);
    return true;
}

/* ---- across a wall (wall_steps.h): a one-step method leads from before the step to behind the wall ---- */

/* in units of `least`: a one-step method goes at least so far behind a wall, and as far as its way to the wall was */
static const double few = 64;

/* The beginning of the step, the wanted times in it, and its end. */
static size_t times_across(const cvode_work *work, double before, double end, double *times)
{
    size_t n = 0;
    bool backward = end < before;
    times[n++] = before;
    for (size_t i = 0; i < work->count; i++)
        if (backward ? work->times[i] < before && work->times[i] > end
                     : work->times[i] > before && work->times[i] < end)
            times[n++] = work->times[i];
    times[n++] = end;
    return n;
}

static nh_motion *by_one_step_method(const cvode_work *work, double before, double end)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    size_t size = work->problem->size;
    double *times = nh_alloc_array(work->count + 2 + size, sizeof *times), *scale = times + work->count + 2;
    for (size_t i = 0; i < size; i++) scale[i] = nh_sizes_absolute(&work->sizes, work->rtol, i) / work->rtol;
    nh_flow_options options = {.rtol = work->rtol,
                               .scale = scale,
                               .watch = work->options->watch,
                               .guarded = true,
                               .whole = work->walls.span,
                               .cancelled = nh_interrupted_callback};
    size_t count = times_across(work, before, end, times);
    /* an implicit method would solve its stages too inexactly to approach a wall */
    nh_motion *motion = nh_gsl_odeiv(NH_RK8PD, work->problem, work->old, count, times, &options, &ignored);
    nh_free(times);
    return motion;
}

/* The motion from before the last step to behind a wall in it, at the wanted times and at its end.  NULL: there was no
 * wall in the step. */
static nh_motion *cross_wall(cvode_work *work, double before, double now, nh_motion *motion)
{
    nh_wall_steps *k = &work->walls;
    if (!k->change.count || now == before) return NULL;
    double at = nh_wall_steps_first(k, before, now, cvode_state, work);
    if (isnan(at)) return NULL;
    double end = at + copysign(fmax(fabs(at - before), few * k->least), now - before);
    if (fabs(end - before) > fabs(work->stop - before)) end = work->stop;
    nh_motion *across = by_one_step_method(work, before, end);
    if (!across) return NULL;
    if (!across->complete || across->note[0]) nh_motion_note(motion, "%s", across->note);
    motion->guard_hit = across->guard_hit;
    motion->limited = across->limited;
    nh_events_append(motion, across);
    motion->searched = across->end_time;
    motion->stopped = across->stopped;
    memcpy(k->change.z, across->end_state, k->change.size * sizeof *k->change.z);
    nh_wall_steps_go_over(k, across->end_time, motion);
    return across;
}

/* Starts anew behind a wall: the last steps do not describe the motion there. */
static bool start_anew(cvode_work *work)
{
    double t = work->across->end_time;
    memcpy(NV_DATA_S(work->state), work->across->end_state, work->problem->size * sizeof(double));
    nh_motion_free(work->across);
    work->across = NULL;
    work->set_ups = 0;
    return CVodeReInit(work->cvode, t, work->state) == CV_SUCCESS &&
           CVodeSetStopTime(work->cvode, work->stop) == CV_SUCCESS;
}

static nh_step cvode_advance(double *time, nh_motion *motion, void *context)
{
    cvode_work *work = context;
    double before = *time;
    if (work->across && !start_anew(work)) {
        nh_motion_note(motion, "the integrator cannot start again at t = %.10g", before);
        return NH_STEP_FAILED;
    }
    memcpy(work->old, NV_DATA_S(work->state), work->problem->size * sizeof *work->old);
    work->step = motion->steps;
    if (work->step > work->failed_step + NH_STUCK_AFTER) /* after so many good steps the message is outdated */
        work->failed = NULL;
    int flag = CVode(work->cvode, work->stop, work->state, time, CV_ONE_STEP);
    motion->evaluations = work->evaluations + work->sizes.evaluations;
    CVodeGetNumJacEvals(work->cvode, &motion->jacobians);
    count_set_ups(work);
    if (flag >= 0) {
        nh_sizes_follow(&work->sizes, *time, NV_DATA_S(work->state));
        work->across = cross_wall(work, before, *time, motion);
    }
    if (work->across) {
        *time = work->across->end_time;
        work->evaluations += work->across->evaluations;
        motion->evaluations = work->evaluations + work->sizes.evaluations;
        return work->across->complete && !work->walls.held ? *time == work->stop ? NH_STEP_LAST : NH_STEP_ON
               : motion->guard_hit >= 0                    ? NH_STEP_LAST
                                                           : NH_STEP_FAILED;
    }
    if (flag == CV_ROOT_RETURN) return end_at_guard(*time, motion, work);
    if (flag >= 0) return flag == CV_TSTOP_RETURN ? NH_STEP_LAST : NH_STEP_ON;
    explain(flag, work, motion);
    return NH_STEP_FAILED;
}

static void cvode_stuck(nh_motion *motion, void *context) { explain(CV_ERR_FAILURE, context, motion); }

static bool create_objects(cvode_work *work, nh_flow_method method)
{
    sunindextype size = (sunindextype)work->problem->size;
    if (!nh_sundials_open(&work->sundials)) return false;
    work->state = N_VNew_Serial(size, work->sundials.context);
    work->matrix = SUNDenseMatrix(size, size, work->sundials.context);
    work->inside = work->state ? N_VClone(work->state) : NULL;
    if (!work->inside || !work->matrix) return false;
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
                CVodeSetMaxErrTestFails(work->cvode, most_fails) == CV_SUCCESS &&
                CVodeSetLinearSolver(work->cvode, work->solver, work->matrix) == CV_SUCCESS &&
                CVodeSetStopTime(work->cvode, work->stop) == CV_SUCCESS;
    if (good && problem->jacobian) good = CVodeSetJacFn(work->cvode, call_jacobian) == CV_SUCCESS;
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
    if (work->inside) N_VDestroy(work->inside);
    N_VDestroy(work->state);
    nh_sundials_close(&work->sundials);
    nh_free(work->root);
    nh_free(work->old);
    nh_motion_free(work->across);
    nh_sizes_clear(&work->sizes);
    nh_wall_steps_clear(&work->walls);
}

nh_motion *nh_cvode(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                    const nh_flow_options *options, nh_error *error)
{
    nh_motion *motion = nh_motion_start(problem->size, problem->size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    double n = (double)problem->size;
    cvode_work work = {.problem = problem,
                       .options = options,
                       .stop = times[count - 1],
                       .each = cvode_rate + cvode_vectors * n,
                       .count = count,
                       .times = times};
    bool good = nh_motion_check_start(problem, times[0], initial, error);
    if (!good) goto done;
    work.rtol = nh_motion_rtol(motion, options);
    work.root = nh_alloc_array(problem->guards, sizeof *work.root);
    work.old = nh_alloc_array(problem->size, sizeof *work.old);
    good = nh_sizes_open(&work.sizes, problem, options, initial, count, times);
    work.evaluations = work.sizes.evaluations, work.sizes.evaluations = 0;
    nh_wall_steps_begin(&work.walls, problem, initial, count, times);
    good = good && create_objects(&work, options->method) && set_up(&work, times[0], initial);
    if (!good) {
        nh_sundials_fail(&work.sundials, error);
        goto done;
    }
    nh_stepper stepper = {.context = &work,
                          .advance = cvode_advance,
                          .state = cvode_state,
                          .stuck = cvode_stuck,
                          .step_effort = cvode_step};
    nh_motion_run(motion, count, times, options, &stepper);
done:
    destroy_objects(&work);
    if (!good) {
        nh_motion_free(motion);
        motion = NULL;
    }
    return motion;
}
