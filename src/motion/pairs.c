#include "motion/pairs.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include <arkode/arkode_butcher_erk.h>
#include <arkode/arkode_erkstep.h>
#include <nvector/nvector_serial.h>

#include "base/memory.h"

typedef struct {
    const nh_flow_problem *problem;
    SUNContext sundials;
    void *arkode;
    N_Vector state, tolerance;
    const double *times;
    size_t count;
    long evaluations;
    char message[200];
} pairs_work;

static int call_rate(realtype t, N_Vector state, N_Vector rate, void *user)
{
    pairs_work *work = user;
    work->evaluations++;
    bool good = work->problem->rate(t, NV_DATA_S(state), NV_DATA_S(rate), work->problem->context);
    for (size_t i = 0; i < work->problem->size && good; i++) good = isfinite(NV_DATA_S(rate)[i]);
    return good ? 0 : 1; /* "recoverable": a smaller step is tried */
}

static void keep_message(int code, const char *module, const char *function, char *message, void *user)
{
    (void)module, (void)function;
    pairs_work *work = user;
    if (code < 0) snprintf(work->message, sizeof work->message, "%s", message);
}

static nh_step pairs_advance(double *time, nh_motion *motion, void *context)
{
    pairs_work *work = context;
    double target = work->times[motion->count];
    int flag = ERKStepSetStopTime(work->arkode, target);
    if (flag >= 0) flag = ERKStepEvolve(work->arkode, target, work->state, time, ARK_ONE_STEP);
    motion->evaluations = work->evaluations;
    if (flag == ARK_TSTOP_RETURN) *time = target;
    if (flag >= 0) return *time == work->times[work->count - 1] ? NH_STEP_LAST : NH_STEP_ON;
    nh_motion_note(motion, "the integrator stopped near t = %.10g: %s", motion->end_time, work->message);
    return NH_STEP_FAILED;
}

static bool pairs_state(double time, double *state, void *context)
{
    pairs_work *work = context;
    (void)time;
    memcpy(state, NV_DATA_S(work->state), work->problem->size * sizeof *state);
    return true;
}

static void pairs_stuck(nh_motion *motion, void *context)
{
    (void)context;
    nh_motion_note(motion, "the time no longer moves near t = %.10g: the solution is singular there", motion->end_time);
}

static bool set_up(pairs_work *work, nh_pairs_method method, const double *initial, double rtol, const double *scale)
{
    static const ARKODE_ERKTableID tables[] = {ARKODE_DORMAND_PRINCE_7_4_5, ARKODE_VERNER_8_5_6, ARKODE_FEHLBERG_13_7_8};
    sunindextype size = (sunindextype)work->problem->size;
    if (SUNContext_Create(NULL, &work->sundials) != 0) return false;
    work->state = N_VNew_Serial(size, work->sundials);
    work->tolerance = N_VNew_Serial(size, work->sundials);
    if (!work->state || !work->tolerance) return false;
    for (sunindextype i = 0; i < size; i++) {
        NV_DATA_S(work->state)[i] = initial[i];
        NV_DATA_S(work->tolerance)[i] = rtol * (scale ? scale[i] : 1);
    }
    work->arkode = ERKStepCreate(call_rate, work->times[0], work->state, work->sundials);
    return work->arkode && ERKStepSetErrHandlerFn(work->arkode, keep_message, work) == ARK_SUCCESS &&
           ERKStepSetUserData(work->arkode, work) == ARK_SUCCESS && ERKStepSetTableNum(work->arkode, tables[method]) == ARK_SUCCESS &&
           ERKStepSVtolerances(work->arkode, rtol, work->tolerance) == ARK_SUCCESS;
}

nh_motion *nh_pairs(nh_pairs_method method, const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                    const nh_flow_options *options, nh_error *error)
{
    nh_motion *motion = nh_motion_start(problem->size, problem->size, initial, count, times, options, error);
    if (!motion || motion->complete) return motion;
    pairs_work work = {.problem = problem, .times = times, .count = count};
    if (set_up(&work, method, initial, nh_motion_rtol(motion, options), options->scale)) {
        nh_stepper stepper = {.context = &work, .advance = pairs_advance, .state = pairs_state, .stuck = pairs_stuck};
        nh_motion_run(motion, count, times, options, &stepper);
    } else {
        nh_fail(error, NH_NUMERIC, "", "the integrator cannot be set up: %s", work.message[0] ? work.message : "out of memory");
        nh_motion_free(motion);
        motion = NULL;
    }
    if (work.arkode) ERKStepFree(&work.arkode);
    if (work.state) N_VDestroy(work.state);
    if (work.tolerance) N_VDestroy(work.tolerance);
    SUNContext_Free(&work.sundials);
    return motion;
}
