/* motion: what all integrators share: checks, output, limits. */
#include "motion/motion.h"

#include <math.h>
#include <stdarg.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/text.h"

/* CVODE and IDA refuse tolerances below some 10 roundings; the error stops falling well before. */
static const double smallest_rtol = 1e-14;

static bool check_times(size_t count, const double *times, nh_error *error)
{
    if (count == 0) return nh_fail(error, NH_INPUT, "", "a motion needs at least one output time");
    if (!nh_all_finite(count, times)) return nh_fail(error, NH_INPUT, "", "an output time is not a finite number");
    bool backward = times[count - 1] < times[0];
    for (size_t i = 1; i < count; i++)
        if (backward ? times[i] > times[i - 1] : times[i] < times[i - 1]) {
            char digits[2][32];
            for (size_t k = 0; k < 2; k++) nh_text_number(times[i - k], digits[k], sizeof digits[k]);
            return nh_fail(error, NH_INPUT, "",
                           "the output times must all rise or all fall, but time %zu is %s after %s", i + 1, digits[0],
                           digits[1]);
        }
    return true;
}

static bool check_values(size_t given, const double *initial, const nh_flow_options *options, nh_error *error)
{
    if (given == 0) return nh_fail(error, NH_INPUT, "", "a motion needs at least one state");
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
    if (!check_times(count, times, error) || !check_values(given, initial, options, error)) return NULL;
    nh_motion *motion = nh_alloc(sizeof *motion);
    motion->size = size;
    motion->time = nh_alloc_array(count, sizeof *motion->time);
    motion->state = nh_alloc_array(count, size * sizeof *motion->state);
    motion->end_state = nh_alloc_array(size, sizeof *motion->end_state);
    motion->guard_hit = -1;
    motion->searched = NAN;
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
    if (!motion) return;
    nh_free(motion->time);
    nh_free(motion->state);
    nh_free(motion->end_state);
    nh_free(motion->event);
    nh_free(motion->event_state);
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
    if (options->rtol >= smallest_rtol) return options->rtol;
    nh_motion_note(motion, "the relative tolerance %g is below rounding error; %g was used", options->rtol,
                   smallest_rtol);
    return smallest_rtol;
}
