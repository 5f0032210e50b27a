#include "motion/integrators.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <arkode/arkode_arkstep.h>
#include <arkode/arkode_butcher_dirk.h>
#include <arkode/arkode_butcher_erk.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include "base/effort.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "motion/wall_steps.h"
#include "motion/sizes.h"
#include "motion/sundials.h"
#include "motion/stepping.h"

/* These functions are common to all steppers since ARKODE 6.1, which comes with SUNDIALS 7.1. */
#if NH_SUNDIALS_SINCE(7, 1)
#define set_stop_time ARKodeSetStopTime
#define evolve ARKodeEvolve
#define set_user_data ARKodeSetUserData
#define tolerances ARKodeWFtolerances
#define free_memory ARKodeFree
#define set_most_fails ARKodeSetMaxErrTestFails
#define reset ARKodeReset
#define solve_by ARKodeSetLinearSolver
#define set_jacobian ARKodeSetJacFn
#define jacobians_of ARKodeGetNumJacEvals
#define deduce_rates ARKodeSetDeduceImplicitRhs
#define newton_part ARKodeSetNonlinConvCoef
#define set_up_every ARKodeSetLSetupFrequency
#define jacobian_of_every ARKodeSetJacEvalFrequency
#else
#define set_stop_time ARKStepSetStopTime
#define evolve ARKStepEvolve
#define set_user_data ARKStepSetUserData
#define tolerances ARKStepWFtolerances
#define free_memory ARKStepFree
#define set_most_fails ARKStepSetMaxErrTestFails
#define reset ARKStepReset
#define solve_by ARKStepSetLinearSolver
#define set_jacobian ARKStepSetJacFn
#define jacobians_of ARKStepGetNumJacEvals
#define deduce_rates ARKStepSetDeduceImplicitRhs
#define newton_part ARKStepSetNonlinConvCoef
#define set_up_every ARKStepSetLSetupFrequency
#define jacobian_of_every ARKStepSetJacEvalFrequency
#endif

/* failures of the error test in one step: at the edge of its stability a pair shortens its step often and by little */
enum { most_fails = 100 };
static const double newton = 0.01; /* how exactly the equations of a step are solved, as a part of the tolerance */
/* the error that a step across a kink may have, as a part of the tolerance: above the error of the solver */
static const double part_across = 1e-3, part_across_implicit = 0.1;

typedef struct {
    const nh_flow_problem *problem;
    nh_sundials sundials;
    void *arkode;
    const nh_flow_options *options;
    N_Vector state;
    double before, now; /* times of `old` and `state` */
    nh_sizes sizes;
    double rtol;
    SUNMatrix matrix; /* of implicit steps */
    SUNLinearSolver solver;
    const double *times;
    size_t count;
    nh_guards guards;
    nh_wall_steps walls;
    double *old; /* the state before the last step, where guards are watched */
    double each; /* units of effort of a right-hand side, with the sums that belong to it */
    long evaluations;
} pairs_work;

/* Units of effort (base/effort.h) of a step, of a stage, and of a stage per number of the state; then the same of
 * implicit methods with their linear equations, whose matrix is factored once per step. */
static const double step_units[] = {600, 3400}, stage_units[] = {100, 150}, stage_vectors[] = {10, 40}, flop = 1.4;

static int call_rate(sunrealtype t, N_Vector state, N_Vector rate, void *user)
{
    pairs_work *work = user;
    work->evaluations++;
    nh_effort_add(work->each);
    /* not where differences across a wall form derivatives */
    if (!work->solver || work->problem->jacobian) nh_wall_steps_see(&work->walls, t, NV_DATA_S(state));
    bool good = work->problem->rate(t, NV_DATA_S(state), NV_DATA_S(rate), work->problem->context);
    for (size_t i = 0; i < work->problem->size && good; i++) good = isfinite(NV_DATA_S(rate)[i]);
    return good ? 0 : 1; /* "recoverable": ARKODE tries a smaller step */
}

static int call_weight(N_Vector state, N_Vector weight, void *user)
{
    const pairs_work *work = user;
    for (size_t i = 0; i < work->problem->size; i++) NV_DATA_S(weight)
    [i] = 1 / (work->rtol * fabs(NV_DATA_S(state)[i]) + nh_sizes_absolute(&work->sizes, work->rtol, i));
    return nh_all_finite(work->problem->size, NV_DATA_S(weight)) ? 0 : -1;
}

/* SUNDIALS' dense matrices are stored by columns without gaps, as motion.h requires. */
static int call_jacobian(sunrealtype t, N_Vector state, N_Vector rate, SUNMatrix matrix, void *user, N_Vector a,
                         N_Vector b, N_Vector c)
{
    (void)rate, (void)a, (void)b, (void)c;
    pairs_work *work = user;
    size_t size = work->problem->size;
    bool good = work->problem->jacobian(t, NV_DATA_S(state), SM_DATA_D(matrix), work->problem->context);
    for (size_t i = 0; i < size * size && good; i++) good = isfinite(SM_DATA_D(matrix)[i]);
    return good ? 0 : 1;
}

static nh_step pairs_advance(double *time, nh_motion *motion, void *context)
{
    pairs_work *work = context;
    double target = work->times[motion->count], before = *time;
    size_t bytes = work->problem->size * sizeof *work->old;
    double longest = fmin(work->guards.longest, work->walls.longest);
    if (fabs(target - before) > longest) target = before + copysign(longest, target - before);
    memcpy(work->old, NV_DATA_S(work->state), bytes);
    int flag = set_stop_time(work->arkode, target);
    if (flag >= 0) flag = evolve(work->arkode, target, work->state, time, ARK_ONE_STEP);
    motion->evaluations = work->evaluations + work->sizes.evaluations;
    if (work->solver) jacobians_of(work->arkode, &motion->jacobians);
    if (flag == ARK_TSTOP_RETURN) *time = target;
    work->before = before, work->now = *time;
    nh_guard_verdict verdict =
        flag >= 0 ? nh_guards_judge(&work->guards, before, *time, NV_DATA_S(work->state), motion) : NH_GUARD_KEPT;
    nh_wall_verdict wall =
        flag >= 0 && (verdict == NH_GUARD_KEPT || verdict == NH_GUARD_TURN)
            ? nh_wall_steps_judge(&work->walls, work->problem, before, work->old, *time, NV_DATA_S(work->state), motion)
            : NH_WALL_NONE;
    if (wall == NH_WALL_BACK) verdict = NH_GUARD_BACK;
    if (wall == NH_WALL_CROSSED) flag = reset(work->arkode, *time, work->state);
    if (verdict != NH_GUARD_KEPT && verdict != NH_GUARD_TURN) {
        memcpy(NV_DATA_S(work->state), work->old, bytes);
        work->now = *time = before;
        flag = reset(work->arkode, before, work->state);
        if (flag >= 0) return verdict == NH_GUARD_END ? NH_STEP_LAST : NH_STEP_ON;
    }
    if (flag >= 0) nh_sizes_follow(&work->sizes, *time, NV_DATA_S(work->state));
    if (wall == NH_WALL_END) return NH_STEP_FAILED;
    bool last = verdict == NH_GUARD_TURN || *time == work->times[work->count - 1];
    if (flag >= 0) return last ? NH_STEP_LAST : NH_STEP_ON;
    nh_motion_note(motion, "the integrator stopped near t = %.10g: %s", motion->end_time, work->sundials.message);
    return NH_STEP_FAILED;
}

/* Inside the last implicit step, where events are looked for: a motion of its own from the beginning of the step
 * (ARKODE interpolates long steps badly), with the errors that the step may make: a state that is zero there has no
 * size by itself. */
static bool state_inside(pairs_work *work, double time, double *state)
{
    const double times[2] = {work->before, time};
    nh_flow_options options = *work->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    double *scale = nh_alloc_array(work->problem->size + 1, sizeof *scale);
    for (size_t i = 0; i < work->problem->size; i++)
        scale[i] = nh_sizes_absolute(&work->sizes, work->rtol, i) / work->rtol;
    options.watch = NULL, options.singular = NULL, options.scale = scale;
    nh_motion *motion = nh_arkode(NH_ESDIRK_5, work->problem, work->old, 2, times, &options, &ignored);
    bool good = motion && motion->complete;
    if (good) memcpy(state, motion->state + work->problem->size, work->problem->size * sizeof *state);
    if (motion) work->evaluations += motion->evaluations;
    nh_motion_free(motion);
    nh_free(scale);
    return good;
}

/* Steps end at the output times. */
static bool pairs_state(double time, double *state, void *context)
{
    pairs_work *work = context;
    if (work->solver && time != work->now) return state_inside(work, time, state);
    memcpy(state, NV_DATA_S(work->state), work->problem->size * sizeof *state);
    return true;
}

static bool rate_of_problem(double t, const double *z, double *rate, void *context)
{
    pairs_work *work = context;
    work->evaluations++;
    nh_effort_add(work->each);
    return work->problem->rate(t, z, rate, work->problem->context);
}

static void pairs_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the steps vanish near t = %.10g: none is as exact as the tolerance there",
                   motion->end_time);
}

/* Newton's iteration with a dense matrix, made anew for every step.  With an old matrix the steps after a short one,
 * such as those that end at the output times, passed unsolved (tests/test_method.c, stiff motion: off by 0.2 at 1e-6).
 * Rates are deduced from the solution: evaluated there they would have its error times the stiffness. */
static bool set_up_implicit(pairs_work *work)
{
    sunindextype size = (sunindextype)work->problem->size;
    work->matrix = SUNDenseMatrix(size, size, work->sundials.context);
    work->solver = work->matrix ? SUNLinSol_Dense(work->state, work->matrix, work->sundials.context) : NULL;
    return work->solver &&
           ARKStepSetTableNum(work->arkode, ARKODE_ESDIRK547L2SA2_7_4_5, ARKODE_ERK_NONE) == ARK_SUCCESS &&
           deduce_rates(work->arkode, 1) == ARK_SUCCESS && newton_part(work->arkode, newton) == ARK_SUCCESS &&
           set_up_every(work->arkode, 1) == ARK_SUCCESS &&
           solve_by(work->arkode, work->solver, work->matrix) == ARK_SUCCESS &&
           (!work->problem->jacobian || set_jacobian(work->arkode, call_jacobian) == ARK_SUCCESS) &&
           jacobian_of_every(work->arkode, 1) == ARK_SUCCESS;
}

static bool set_up(pairs_work *work, nh_arkode_method method, const double *initial, const nh_flow_options *options)
{
    static const ARKODE_ERKTableID tables[] = {ARKODE_DORMAND_PRINCE_7_4_5, ARKODE_VERNER_8_5_6,
                                               ARKODE_FEHLBERG_13_7_8};
    bool implicit = method == NH_ESDIRK_5;
    sunindextype size = (sunindextype)work->problem->size;
    if (!nh_sundials_open(&work->sundials)) return false;
    work->state = N_VNew_Serial(size, work->sundials.context);
    if (!work->state) return false;
    memcpy(NV_DATA_S(work->state), initial, work->problem->size * sizeof *initial);
    if (!nh_sizes_open(&work->sizes, work->problem, options, initial, work->count, work->times)) return false;
    work->evaluations += work->sizes.evaluations, work->sizes.evaluations = 0;
    work->arkode = ARKStepCreate(implicit ? NULL : call_rate, implicit ? call_rate : NULL, work->times[0], work->state,
                                 work->sundials.context);
    return work->arkode && nh_sundials_listen(ARKStep, work->arkode, &work->sundials) &&
           set_user_data(work->arkode, work) == ARK_SUCCESS &&
           (implicit ? set_up_implicit(work)
                     : ARKStepSetTableNum(work->arkode, ARKODE_DIRK_NONE, tables[method]) == ARK_SUCCESS) &&
           set_most_fails(work->arkode, most_fails) == ARK_SUCCESS &&
           tolerances(work->arkode, call_weight) == ARK_SUCCESS;
}

nh_motion *nh_arkode(nh_arkode_method method, const nh_flow_problem *problem, const double *initial, size_t count,
                     const double *times, const nh_flow_options *options, nh_error *error)
{
    nh_motion *motion = nh_motion_start(problem->size, problem->size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    if (!nh_motion_check_start(problem, times[0], initial, error)) {
        nh_motion_free(motion);
        return NULL;
    }
    pairs_work work = {.problem = problem,
                       .options = options,
                       .times = times,
                       .count = count,
                       .old = nh_alloc_array(problem->size + 1, sizeof *work.old)};
    nh_guards_begin(&work.guards, problem, options, initial, count, times);
    nh_wall_steps_begin(&work.walls, problem, initial, count, times);
    work.rtol = nh_motion_rtol(motion, options);
    bool implicit = method == NH_ESDIRK_5;
    double n = (double)problem->size;
    work.each = stage_units[implicit] + stage_vectors[implicit] * n;
    if (set_up(&work, method, initial, options)) {
        nh_stepper stepper = {.context = &work,
                              .advance = pairs_advance,
                              .state = pairs_state,
                              .stuck = pairs_stuck,
                              .step_effort = step_units[implicit] + (implicit ? flop * n * n * n : 0),
                              .rate = implicit ? NULL : rate_of_problem,
                              .rate_context = &work};
        nh_wall_steps_coarser(&work.walls,
                              (implicit ? part_across_implicit : part_across) * work.rtol * work.sizes.tau);
        nh_motion_run(motion, count, times, options, &stepper);
    } else {
        nh_sundials_fail(&work.sundials, error);
        nh_motion_free(motion);
        motion = NULL;
    }
    if (work.arkode) free_memory(&work.arkode);
    if (work.solver) SUNLinSolFree(work.solver);
    if (work.matrix) SUNMatDestroy(work.matrix);
    if (work.state) N_VDestroy(work.state);
    nh_sundials_close(&work.sundials);
    nh_guards_clear(&work.guards);
    nh_wall_steps_clear(&work.walls);
    nh_sizes_clear(&work.sizes);
    nh_free(work.old);
    return motion;
}
