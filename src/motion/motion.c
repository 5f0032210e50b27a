/* motion: what all integrators share: checks, output, limits. */
#include "motion/motion.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/effort.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "base/text.h"

/* CVODE and IDA refuse to work below some 10 roundings; the error stops falling well before. */
static const double smallest_rtol = 1e-14;
static const double default_max_steps = 1e7;
static const double least_advance = 1e-10; /* of the whole time, in NH_ADVANCE_AFTER steps: no motion gets to its end so; */
enum { most_slow = 200 };                  /* but through a zero of a velocity whose size is not yet known, after as many times as many steps */

static bool check_times(size_t count, const double *times, nh_error *error)
{
    if (count == 0)
        return nh_fail(error, NH_INPUT, "", "a motion needs at least one output time");
    if (!nh_all_finite(count, times))
        return nh_fail(error, NH_INPUT, "", "an output time is not a finite number");
    bool backward = times[count - 1] < times[0];
    for (size_t i = 1; i < count; i++)
        if (backward ? times[i] > times[i - 1] : times[i] < times[i - 1]) {
            char digits[2][32];
            for (size_t k = 0; k < 2; k++) nh_text_number(times[i - k], digits[k], sizeof digits[k]);
            return nh_fail(error, NH_INPUT, "", "the output times must all rise or all fall, but time %zu is %s after %s",
                           i + 1, digits[0], digits[1]);
        }
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
    nh_motion_note(motion, "the relative tolerance %g is below rounding error; %g was used", options->rtol, smallest_rtol);
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
    bool cancelled = options->cancelled && options->cancelled(options->cancel_context); /* this may compute for a while */
    if (nh_interrupted())
        nh_motion_note(motion, "interrupted at t = %.10g", motion->end_time);
    else if (cancelled)
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
    double mark = motion->end_time, least = least_advance * fabs(times[count - 1] - times[0]);
    for (int stuck = 0, slow = 0; step == NH_STEP_ON && motion->count < count && may_go_on(motion, options, before);) {
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
        if (motion->steps % NH_ADVANCE_AFTER == 0) {
            slow = fabs(time - mark) < least ? slow + 1 : 0;
            mark = time;
        }
        if (stuck == NH_STUCK_AFTER || slow == most_slow) {
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
