/* The loop that all integrators share: nh_motion_run drives a stepper from step to step.
 *
 *      may_go_on     limits of steps, of work, of time; a motion without hope to arrive ends early
 *      advance       one step of the integrator, or its failure
 *      watch_step    events and singular places inside the step
 *      store         outputs up to the new time, from the states inside the step
 *      stuck?        time that does not move, or hardly does
 *
 * An event that stops the motion is its last output; of a singular place only what lies before it is kept. */
#include "motion/stepping.h"

#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/effort.h"
#include "base/linalg.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "motion/events.h"
#include "motion/singular.h"

static const double default_max_steps = 1e7;
/* part of the whole time: a motion that advances less in NH_ADVANCE_AFTER steps does not reach its end */
static const double least_advance = 1e-10;
/* such spans in a row that are allowed: steps are short near the zero of a velocity whose size is not known yet */
enum { most_slow = 200 };
/* A motion that may end early is looked at after each such part of its limit of work: where the work that is left
 * suffices for less than such a part of the time that is left, at the pace of the last part, it ends.  (The equations
 * of a ball that has reached the apex of a cone change at every step, for ever.) */
static const double pace_part = 1.0 / 32, pace_hopeless = 1.0 / 64;
enum { pace_steps = 1000 }; /* at least so many are looked at: the first steps of a motion are short */

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

/* Reports how far a long motion has come. */
static void tell(const nh_motion *motion, size_t count, const double *times)
{
    enum { steps_between_words = 2048 };
    double span = times[count - 1] - times[0];
    if (motion->steps > 0 && motion->steps % steps_between_words == 0 && span != 0 && !nh_parallel_worker())
        nh_progress("a motion", (motion->end_time - times[0]) / span);
}

/* Says what interrupted the motion: a signal, the limit of time or that of memory. */
static void note_end(nh_motion *motion)
{
    char words[80];
    nh_ended_words(words, sizeof words);
    nh_motion_note(motion, "%s at t = %.10g", words, motion->end_time);
}

/* How far a motion gets with a part of its work. */
typedef struct {
    double begin, seen; /* units of work before the motion, and when it was looked at last */
    double time, last;  /* where it was then, and where it ends */
    size_t steps;       /* that it had made then */
} pace;

/* Would the work that is left not suffice by far? */
static bool hopeless(pace *p, const nh_motion *motion, double effort)
{
    double used = nh_effort() - p->seen, now = motion->end_time;
    if (used < effort * pace_part || motion->steps - p->steps < pace_steps) return false;
    double left = effort - (nh_effort() - p->begin), reached = fabs(now - p->time) * left / used;
    *p = (pace){p->begin, nh_effort(), now, p->last, motion->steps};
    return reached < pace_hopeless * fabs(p->last - now);
}

/* Whether the motion may take another step. */
static bool may_go_on(nh_motion *motion, const nh_flow_options *options, pace *p)
{
    if (options->early && options->effort > 0 && hopeless(p, motion, options->effort)) {
        nh_motion_note(motion,
                       "the motion hardly advances at t = %.10g: the limit of %.2g counted operations would be reached "
                       "long before its end",
                       motion->end_time, options->effort);
        motion->limited = true;
        return false;
    }
    if (options->effort > 0 && nh_effort() - p->begin > options->effort) {
        nh_motion_note(motion, "the limit of %.2g counted operations was reached at t = %.10g", options->effort,
                       motion->end_time);
        motion->limited = true;
        return false;
    }
    double limit = options->max_steps > 0 ? options->max_steps : default_max_steps;
    bool cancelled =
        options->cancelled && options->cancelled(options->cancel_context); /* the call may compute for a while */
    if (nh_interrupted()) note_end(motion);
    else if (cancelled) nh_motion_note(motion, "cancelled at t = %.10g", motion->end_time);
    else if ((double)motion->steps >= limit) {
        motion->limited = true;
        nh_motion_note(motion, "the limit of %g steps was reached at t = %.10g; allow more steps or a larger tolerance",
                       limit, motion->end_time);
    } else return true;
    return false;
}

static void keep_end_state(nh_motion *motion, double *work, const nh_stepper *stepper)
{
    if (stepper->state(motion->end_time, work, stepper->context) && nh_all_finite(motion->size, work))
        memcpy(motion->end_state, work, motion->size * sizeof *work);
}

/* The outputs before the zero at which the motion stops, and that zero as the last one. */
static void stop_at_zero(nh_motion *motion, size_t count, const double *times, const nh_stepper *stepper)
{
    size_t last = motion->events - 1, size = motion->size;
    double time = motion->event[last].time;
    const double *state = motion->event_state + last * size;
    motion->stopped = store_reached(motion, count, times, time, stepper);
    if (motion->stopped && motion->count < count && motion->time[motion->count - 1] != time) {
        motion->time[motion->count] = time;
        memcpy(motion->state + motion->count++ * size, state, size * sizeof *state);
    }
    motion->end_time = time;
    memcpy(motion->end_state, state, size * sizeof *state);
}

/* What is watched along a motion. */
typedef struct {
    nh_inside_step *inside; /* NULL: for nothing */
    nh_event_search *events;
    nh_singular_watch *singular;
    double rtol;
} watched;

static watched begin_to_watch(const nh_motion *motion, const nh_flow_options *options, const nh_stepper *stepper)
{
    watched w = {.singular = options->singular, .rtol = options->rtol};
    if (!options->watch && !options->singular) return w;
    w.inside = nh_inside_step_create(motion, stepper);
    w.events = nh_event_search_create(motion, options, w.inside);
    return w;
}

static void end_watching(watched *w, nh_motion *motion)
{
    if (w->events) nh_event_search_end(w->events, motion);
    nh_event_search_free(w->events);
    nh_inside_step_free(w->inside);
}

/* Looks at the last step.  *singular: the time at which the equations determine no acceleration, or NAN. True: the
 * motion stops at an event before it. */
static bool watch_step(watched *w, double time, double last, nh_motion *motion, double *singular)
{
    if (!w->inside || !nh_inside_step_take(w->inside, time)) return false;
    double begin = nh_inside_step_begin(w->inside);
    if (w->singular) *singular = nh_singular_watch_step(w->singular, w->inside, w->rtol);
    if (fabs(*singular - begin) > fabs(last - begin)) *singular = NAN; /* integrators step over the last time */
    size_t before = motion->events;
    bool stop = w->events && nh_event_search_step(w->events, motion);
    if (isnan(*singular)) return stop;
    while (motion->events > before && fabs(motion->event[motion->events - 1].time - begin) > fabs(*singular - begin))
        motion->events--, stop = false;
    if (stop) *singular = NAN;
    return stop;
}

/* The integrator cannot go on: the note says where a singular place is the reason. */
static void tell_singular(const watched *w, nh_motion *motion)
{
    if (w->singular && nh_singular_watch_end(w->singular, w->inside))
        nh_motion_note(motion, "near there %s", nh_singular_watch_words(w->singular));
}

/* Keeps the outputs before the time at which the equations determine no acceleration. */
static void end_at_singular(nh_motion *motion, size_t count, const double *times, double at, const watched *w,
                            const nh_stepper *stepper)
{
    static const double near = 1e-7; /* part of the whole time: values this near are those of the place itself */
    double before = at - near * (times[count - 1] - times[0]);
    store_reached(motion, count, times, before, stepper);
    motion->end_time = at;
    motion->singular = true;
    nh_motion_note(motion, "at t = %.10g %s%s: the equations of motion determine no acceleration there", at,
                   nh_singular_watch_words(w->singular),
                   nh_singular_watch_close(w->singular) ? ", as far as the errors of the motion tell" : "");
}

void nh_motion_run(nh_motion *motion, size_t count, const double *times, const nh_flow_options *options,
                   const nh_stepper *stepper)
{
    double begin = nh_clock(), computed = nh_clock_of_thread(), before = nh_effort();
    double *work = nh_alloc_array(motion->size, sizeof *work);
    watched w = begin_to_watch(motion, options, stepper);
    bool stop = false;
    double singular = NAN;
    nh_step step = NH_STEP_ON;
    double mark = motion->end_time, least = least_advance * fabs(times[count - 1] - times[0]);
    pace p = {before, before, mark, times[count - 1], 0};
    for (int stuck = 0, slow = 0; step == NH_STEP_ON && motion->count < count && may_go_on(motion, options, &p);) {
        double time = motion->end_time;
        tell(motion, count, times);
        step = stepper->advance(&time, motion, stepper->context);
        if (step == NH_STEP_FAILED) {
            tell_singular(&w, motion);
            break;
        }
        motion->steps++;
        nh_effort_add(stepper->step_effort);
        stuck = time == motion->end_time ? stuck + 1 : 0;
        motion->end_time = time;
        if ((stop = watch_step(&w, time, times[count - 1], motion, &singular)) || !isnan(singular)) break;
        if (!store_reached(motion, count, times, time, stepper)) break;
        if (motion->steps % NH_ADVANCE_AFTER == 0) {
            slow = fabs(time - mark) < least ? slow + 1 : 0;
            mark = time;
        }
        if (stuck == NH_STUCK_AFTER || slow == most_slow) {
            stepper->stuck(motion, stepper->context);
            tell_singular(&w, motion);
            break;
        }
    }
    if (stop) stop_at_zero(motion, count, times, stepper);
    if (!stop && !isnan(singular)) end_at_singular(motion, count, times, singular, &w, stepper);
    if (!stop && motion->steps > 0) keep_end_state(motion, work, stepper);
    end_watching(&w, motion);
    motion->complete = motion->count == count || motion->stopped;
    nh_free(work);
    motion->seconds = nh_clock() - begin;
    motion->processor = nh_clock_of_thread() - computed;
    motion->effort = nh_effort() - before;
}

bool nh_motion_check_start(const nh_flow_problem *problem, double t, const double *initial, nh_error *error)
{
    double *rate = nh_alloc_array(problem->size + 1, sizeof *rate);
    bool good = problem->rate(t, initial, rate, problem->context) && nh_all_finite(problem->size, rate);
    nh_free(rate);
    if (good) return true;
    nh_fail(error, NH_NUMERIC, "", "the right-hand side cannot be evaluated at the initial state (t = %.10g)", t);
    return nh_error_hint(error, "check the initial values, or use coordinates that are regular there");
}

/* ---- safeguards ---- */

void nh_guards_begin(nh_guards *g, const nh_flow_problem *problem, const nh_flow_options *options, const double *z,
                     size_t count, const double *times)
{
    static const double part = 1e-7; /* part of the whole motion */
    size_t n = problem->guards;
    *g = (nh_guards){.problem = problem, .longest = INFINITY, .least = part * fabs(times[count - 1] - times[0])};
    if (!options->guarded || !n) return;
    g->value = nh_alloc_array(2 * n, sizeof *g->value);
    g->sign = g->value + n;
    if (!problem->guard(times[0], z, g->sign, problem->context))
        for (size_t i = 0; i < n; i++) g->sign[i] = NAN; /* set by the first step */
}

void nh_guards_clear(nh_guards *g)
{
    nh_free(g->value);
    g->value = NULL;
}

/* The guard that has changed its sign, or cannot be computed; -1: none.  A guard that was zero at the start takes the
 * first sign that it has. */
static long changed(nh_guards *g, double t, const double *z)
{
    const nh_flow_problem *p = g->problem;
    bool good = p->guard(t, z, g->value, p->context);
    for (size_t i = p->turns && !p->own_guards ? p->guards - p->turns : 0; i < p->guards; i++) {
        if (!good || !isfinite(g->value[i])) return (long)i;
        if (!(fabs(g->sign[i]) > 0)) g->sign[i] = g->value[i];
        if (g->value[i] * g->sign[i] < 0 || (g->value[i] == 0 && g->sign[i] != 0)) return (long)i;
    }
    return -1;
}

nh_guard_verdict nh_guards_judge(nh_guards *g, double before, double now, const double *z, nh_motion *motion)
{
    if (!g->value) return NH_GUARD_KEPT;
    double way = fabs(now - before);
    long guard = changed(g, now, z);
    if (guard < 0) {
        /* there is no change any more, or it will be found again */
        if (g->longest <= g->least) g->longest = INFINITY;
        /* this was the first half of the way to the change */
        else if (way > 0.999 * g->longest) g->longest /= 2;
        return NH_GUARD_KEPT;
    }
    if (guard >= (long)(g->problem->guards - g->problem->turns) && isfinite(g->value[guard])) {
        motion->guard_hit = guard;
        return NH_GUARD_TURN;
    }
    g->longest = way / 2;
    if (way > g->least) return NH_GUARD_BACK;
    motion->guard_hit = guard;
    nh_motion_note(motion, "safeguard %ld goes through zero at t = %.10g", guard + 1, now);
    return NH_GUARD_END;
}
