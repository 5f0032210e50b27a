#include "motion/turns.h"

#include <math.h>
#include <string.h>

#include "base/memory.h"
#include "motion/events.h"

static const double farthest = 3; /* s.s: a turn by 240 degrees */

static double square_of(const double *s) { return s[0] * s[0] + s[1] * s[1] + s[2] * s[2]; }

void nh_turns_guard(const nh_system *system, const double *q, double *value)
{
    for (size_t i = 0; i < system->orientations; i++) value[i] = farthest - square_of(q + system->orientation[i].first);
}

/* s := -s/(s.s), and its rate. */
static void to_shadow(double *s, double *rate)
{
    double square = square_of(s), along = rate ? s[0] * rate[0] + s[1] * rate[1] + s[2] * rate[2] : 0;
    for (int k = 0; k < 3 && rate; k++) rate[k] = (2 * along * s[k] / square - rate[k]) / square;
    for (int k = 0; k < 3; k++) s[k] /= -square;
}

bool nh_turns_renew(const nh_system *system, double *q, double *v)
{
    bool any = false;
    for (size_t i = 0; i < system->orientations; i++) {
        size_t first = system->orientation[i].first;
        if (!(square_of(q + first) >= farthest)) continue;
        to_shadow(q + first, v ? v + first : NULL);
        any = true;
    }
    return any;
}

void nh_turns_nearest(const nh_system *system, const double *to, double *q, double *v)
{
    for (size_t i = 0; i < system->orientations; i++) {
        size_t first = system->orientation[i].first;
        double *s = q + first, square = square_of(s), here[3], there[3];
        for (size_t k = 0; k < 3; k++) {
            here[k] = s[k] - to[first + k];
            there[k] = -s[k] / square - to[first + k];
        }
        if (square_of(there) < square_of(here)) to_shadow(s, v ? v + first : NULL);
    }
}

/* Adds the rows, zeros and costs of the next part, whose first row is the last state of the motion. */
static void append(nh_motion *motion, const nh_motion *part)
{
    for (size_t i = motion->count ? 1 : 0; i < part->count; i++) {
        motion->time[motion->count] = part->time[i];
        memcpy(motion->state + motion->count++ * motion->size, part->state + i * part->size,
               part->size * sizeof *part->state);
    }
    nh_events_append(motion, part);
    motion->evaluations += part->evaluations;
    motion->steps += part->steps;
    motion->jacobians += part->jacobians;
    motion->effort += part->effort;
    motion->seconds += part->seconds;
    motion->processor += part->processor;
    motion->limited = part->limited;
    motion->singular = part->singular;
    motion->stopped = part->stopped;
    motion->guard_hit = part->guard_hit;
    motion->end_time = part->end_time;
    memcpy(motion->end_state, part->end_state, part->size * sizeof *part->end_state);
}

nh_motion *nh_turns_flow(nh_turns_part *run, const void *method, const nh_flow_problem *problem, const double *initial,
                         size_t count, const double *times, const nh_flow_options *options, nh_error *error)
{
    nh_flow_problem p = *problem;
    nh_flow_options o = *options;
    size_t own = problem->guards - problem->turns, size = problem->size;
    double *z = nh_alloc_array(size, sizeof *z), *left = nh_alloc_array(count + 1, sizeof *left);
    memcpy(z, initial, size * sizeof *z);
    problem->renew(z, problem->context);
    p.own_guards = options->guarded;
    o.guarded = true;
    nh_motion *motion = nh_motion_start(size, size, z, count, times, options, error);
    bool more = motion && motion->count < count;
    while (more) {
        size_t rest = count - motion->count;
        left[0] = motion->end_time;
        memcpy(left + 1, times + motion->count, rest * sizeof *left);
        nh_motion *part = run(method, &p, z, rest + 1, left, &o, error);
        if (!part && motion->steps == 0) {
            nh_motion_free(motion);
            motion = NULL;
            break;
        }
        if (!part) { /* what is there stays */
            nh_motion_note(motion, "%s", error->what);
            nh_error_clear(error);
            break;
        }
        size_t before = motion->count;
        bool ahead = part->end_time != motion->end_time;
        append(motion, part);
        bool turned = part->guard_hit >= (long)own;
        if (!turned && part->note[0]) nh_motion_note(motion, "%s", part->note);
        nh_motion_free(part);
        for (size_t i = before; i < motion->count; i++)
            if (problem->renew(motion->state + i * size, problem->context) && !motion->smooth) motion->smooth = i;
        more = turned && ahead && motion->count < count;
        if (turned && !motion->smooth) motion->smooth = motion->count;
        if (turned) motion->guard_hit = -1;
        memcpy(z, motion->end_state, size * sizeof *z);
        problem->renew(z, problem->context);
        memcpy(motion->end_state, z, size * sizeof *z);
        if (turned && !ahead) nh_motion_note(motion, "the motion does not advance at t = %.10g", motion->end_time);
        if (o.effort > 0) o.effort = fmax(options->effort - motion->effort, 1);
        if (more && options->max_steps > 0 && (double)motion->steps >= options->max_steps) {
            motion->limited = true, more = false;
            nh_motion_note(motion,
                           "the limit of %g steps was reached at t = %.10g; allow more steps or a larger tolerance",
                           options->max_steps, motion->end_time);
        }
    }
    if (motion) motion->complete = motion->count == count || motion->stopped;
    nh_free(z);
    nh_free(left);
    return motion;
}
