/* Zeros of functions g_i(t, z) along a motion, step by step (events.h):
 *
 *        before                near        far                 now
 *          |--------------------|-----+-----|-------------------|          one step of the integrator
 *                               |     |     |
 *       1. sign_changes.c:      |   root    |    the first part on which some g_i changes its sign, once
 *       2. solve:               g < 0    g > 0   Brent's method there, on the states inside the step
 *       3. jumps:          |g| at root -+ near against |g| at root -+ far: a zero is small near the root, a jump is not
 *       4. record time, direction, state; in the order of time; at a function that stops, the motion ends
 *       5. go on at `far`
 *
 * A function that is zero at the beginning has no side; when it gets one, its zero at the beginning is recorded with
 * that direction. */
#include "motion/events.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include <gsl/gsl_errno.h>
#include <gsl/gsl_roots.h>

#include "base/memory.h"
#include "motion/sign_changes.h"

enum { most_iterations = 100 };
static const double roundings = 4; /* length of the final interval around a zero, in roundings of the time */
/* distances from a zero at which a function must be much larger: in final intervals, */
static const double far_off = 1e3;
static const double distant = 1e-4; /* and as a part of the step */
/* nearer to an end of the step, in final intervals, a jump cannot be told from a zero */
static const double few = 100;
/* a value is zero up to rounding within so many tolerances, or as this part of another one */
static const double slack = 10, small_part = 1e-6;
static const double most_jump = 0.5; /* next to a jump a value is a larger part of that farther off */

struct nh_event_search {
    const nh_event_watch *watch;
    nh_inside_step *inside;
    nh_sign_changes change;
    double *raw;        /* values and sizes at one more time, 2 count */
    bool *pending;      /* per function: it was zero at the beginning of the whole motion, and has had no sign since */
    bool *lacks;        /* per function: it had no value somewhere since its last change of sign */
    double before, now; /* ends of the last step */
    double *first, *at; /* the initial state of the motion; values and floors */
    size_t which;       /* the function whose zero is wanted */
    double jumped, lost,
        unknown; /* times of a jump, of a function that changes too often, and of one without values; or NAN */
};

/* ---- values ---- */

/* The values, and what the tolerance allows them to be off. */
static bool values_and_floors(double t, const double *z, double *value, void *context)
{
    nh_event_search *c = context;
    size_t n = c->watch->count;
    if (!c->watch->value(t, z, value, c->watch->context)) return false;
    for (size_t i = 0; i < n; i++) {
        value[n + i] *= c->watch->tolerance;
        if (!isnan(value[i])) continue;
        c->lacks[i] = true;
        if (isnan(c->unknown)) c->unknown = t;
    }
    return true;
}

/* g_which at a time inside of the step; NAN where it has no value. */
static double value_of_one(double t, void *context)
{
    nh_event_search *c = context;
    bool good =
        nh_inside_step_state(t, c->change.z, c->inside) && c->watch->value(t, c->change.z, c->raw, c->watch->context);
    return good ? c->raw[c->which] : NAN;
}

/* ---- zeros ---- */

/* Near a zero a function is far smaller than at some distance; near a jump or a pole it is not. */
static bool jumps(nh_event_search *c, double root, double width)
{
    double low = fmin(c->before, c->now), high = fmax(c->before, c->now),
           away = fmax(far_off * width, distant * (high - low));
    double left = fmax(root - away, low), right = fmin(root + away, high);
    if (root - left < few * width || right - root < few * width)
        return false; /* at an end of the step this cannot be decided */
    return fabs(value_of_one(root - width, c)) > most_jump * fabs(value_of_one(left, c)) &&
           fabs(value_of_one(root + width, c)) > most_jump * fabs(value_of_one(right, c));
}

/* What Brent's method finds between two times: a zero, a jump, or nothing, as where the function has no value. */
typedef enum { ZERO_FOUND, JUMP_FOUND, NOTHING_FOUND } outcome;

static outcome solve(nh_event_search *c, double near, double far, double *root)
{
    gsl_function f = {.function = value_of_one, .params = c};
    double at_near = value_of_one(near, c), at_far = value_of_one(far, c), low = fmin(near, far),
           high = fmax(near, far);
    *root = fabs(at_near) < fabs(at_far) ? near : far;
    if (!(at_near * at_far < 0)) { /* one of them is zero up to rounding, or the sign changed where there is no value */
        if (!c->lacks[c->which]) return ZERO_FOUND;
        double floor = slack * c->watch->tolerance * c->raw[c->watch->count + c->which],
               rounding = small_part * fmax(fabs(at_near), fabs(at_far));
        return fmin(fabs(at_near), fabs(at_far)) <= fmax(floor, rounding) ? ZERO_FOUND : NOTHING_FOUND;
    }
    gsl_root_fsolver *solver = nh_memory_got(gsl_root_fsolver_alloc(gsl_root_fsolver_brent));
    double enough = roundings * DBL_EPSILON * fmax(fabs(low), fabs(high));
    bool good = gsl_root_fsolver_set(solver, &f, low, high) == GSL_SUCCESS, found = false;
    for (int i = 0; i < most_iterations && good && !found; i++) {
        good = gsl_root_fsolver_iterate(solver) == GSL_SUCCESS;
        if (good) *root = gsl_root_fsolver_root(solver);
        double width = gsl_root_fsolver_x_upper(solver) - gsl_root_fsolver_x_lower(solver);
        found = width <= enough || value_of_one(*root, c) == 0;
    }
    gsl_root_fsolver_free(solver);
    return !found ? NOTHING_FOUND : jumps(c, *root, enough) ? JUMP_FOUND : ZERO_FOUND;
}

/* Adds a zero with its state; room for 8, then doubled. */
static void append(nh_motion *motion, double time, size_t which, int direction, const double *state)
{
    size_t n = motion->events, size = motion->size, room = 8;
    while (room < n) room *= 2;
    if (n == 0 || n == room) { /* all places are used */
        room = n ? 2 * n : room;
        nh_event_found *all = nh_alloc_array(room, sizeof *all);
        double *states = nh_alloc_array(room, size * sizeof *states);
        if (n)
            memcpy(all, motion->event, n * sizeof *all), memcpy(states, motion->event_state, n * size * sizeof *states);
        nh_free(motion->event);
        nh_free(motion->event_state);
        motion->event = all;
        motion->event_state = states;
    }
    motion->event[n] = (nh_event_found){time, which, direction};
    memcpy(motion->event_state + n * size, state, size * sizeof *state);
    motion->events++;
}

/* Moves the last zero before those that are later on the way from `begin`. */
static void put_in_order(nh_motion *motion, double begin, size_t from)
{
    size_t size = motion->size;
    for (size_t k = motion->events - 1;
         k > from && fabs(motion->event[k].time - begin) < fabs(motion->event[k - 1].time - begin); k--) {
        nh_event_found swap = motion->event[k];
        motion->event[k] = motion->event[k - 1];
        motion->event[k - 1] = swap;
        for (size_t i = 0; i < size; i++) {
            double one = motion->event_state[k * size + i];
            motion->event_state[k * size + i] = motion->event_state[(k - 1) * size + i];
            motion->event_state[(k - 1) * size + i] = one;
        }
    }
}

void nh_events_append(nh_motion *motion, const nh_motion *part)
{
    for (size_t k = 0; k < part->events; k++)
        append(motion, part->event[k].time, part->event[k].which, part->event[k].direction,
               part->event_state + k * part->size);
}

static bool is_wanted(const nh_event_search *c, size_t which, int direction)
{
    return c->watch->direction[which] == 0 || c->watch->direction[which] == direction;
}

/* A function that was zero at the beginning and has a sign now: its zero at the beginning is recorded, with the
 * direction of this sign. */
static void settle_beginning(nh_event_search *c, nh_motion *motion)
{
    int way = c->now < c->before ? -1 : 1;
    for (size_t i = 0; i < c->watch->count; i++) {
        if (!c->pending[i] || c->change.side[i] == 0) continue;
        int direction = (c->change.side[i] > 0 ? 1 : -1) * way;
        c->pending[i] = false;
        if (!is_wanted(c, i, direction)) continue;
        append(motion, c->watch->begin, i, direction, c->first);
        put_in_order(motion, c->watch->begin, 0);
    }
}

/* Records all zeros between near and far, in order, up to the first that stops the motion, and updates the sides. */
static bool take_zeros(nh_event_search *c, double near, double far, nh_motion *motion)
{
    nh_sign_changes *s = &c->change;
    size_t from = motion->events;
    int way = c->now < c->before ? -1 : 1;
    double *at = c->at, root;
    if (!nh_sign_changes_at(s, far, at)) return false;
    for (size_t i = 0; i < s->count; i++) {
        int sign = nh_sign_changes_sign(s, at, i), direction = sign * way;
        if (!(sign * s->side[i] < 0)) continue;
        s->side[i] = sign;
        c->which = i;
        outcome what = solve(c, near, far, &root);
        c->lacks[i] = false;
        if (what == JUMP_FOUND) c->jumped = root;
        if (what == NOTHING_FOUND && isnan(c->unknown)) c->unknown = root;
        if (what != ZERO_FOUND) continue;
        if (!is_wanted(c, i, direction) || !nh_inside_step_state(root, s->z, c->inside)) continue;
        append(motion, root, i, direction, s->z);
        put_in_order(motion, c->watch->begin, from);
    }
    for (size_t k = from; k < motion->events; k++)
        if (c->watch->stop[motion->event[k].which]) return motion->events = k + 1, true;
    return false;
}

bool nh_event_search_step(nh_event_search *c, nh_motion *motion)
{
    nh_sign_changes *s = &c->change;
    double near, far, from = c->before = nh_inside_step_begin(c->inside), now = c->now = nh_inside_step_end(c->inside);
    bool stop = motion->stopped;
    if (stop) return stop;
    if (motion->searched == now) {
        if (nh_inside_step_state(now, s->z, c->inside)) nh_sign_changes_take_sides(s, now, s->z);
    } else
        while (!stop && from != now && nh_sign_changes_first(s, from, now, &near, &far)) {
            stop = take_zeros(c, near, far, motion);
            from = far;
        }
    if (s->exhausted && isnan(c->lost)) c->lost = from;
    settle_beginning(c, motion);
    return stop;
}

void nh_event_search_end(const nh_event_search *c, nh_motion *motion)
{
    bool zero = false;
    for (size_t i = 0; i < c->watch->count; i++) zero |= c->pending[i];
    if (zero)
        nh_motion_note(motion,
                       "an expression is zero along the whole motion, within the tolerance: it has no single zeros");
    if (!isnan(c->jumped))
        nh_motion_note(motion, "an expression jumps from one sign to the other at t = %.10g: this is no event",
                       c->jumped);
    if (!isnan(c->lost))
        nh_motion_note(motion,
                       "an expression changes too fast near t = %.10g: events may be missing; use a smaller tolerance",
                       c->lost);
    if (!isnan(c->change.doubtful))
        nh_motion_note(motion,
                       "an expression comes within the tolerance of 0 near t = %.10g: whether it crosses 0 and returns "
                       "there is not decided; use a smaller tolerance",
                       c->change.doubtful);
    if (!isnan(c->unknown))
        nh_motion_note(motion, "an expression has no value near t = %.10g: events may be missing", c->unknown);
}

nh_event_search *nh_event_search_create(const nh_motion *motion, const nh_flow_options *options, nh_inside_step *inside)
{
    const nh_event_watch *watch = options->watch;
    if (!watch || !watch->count) return NULL;
    size_t size = motion->size, n = watch->count;
    nh_event_search *c = nh_alloc(sizeof *c);
    *c = (nh_event_search){.watch = watch,
                           .inside = inside,
                           .before = motion->end_time,
                           .now = motion->end_time,
                           .jumped = NAN,
                           .lost = NAN,
                           .unknown = NAN};
    c->change = (nh_sign_changes){.count = n,
                                  .size = size,
                                  .value = values_and_floors,
                                  .context = c,
                                  .inside = nh_inside_step_dense,
                                  .inside_context = inside};
    c->raw = nh_alloc_array(2 * n, sizeof *c->raw);
    c->pending = nh_alloc_array(n, sizeof *c->pending);
    c->lacks = nh_alloc_array(n, sizeof *c->lacks);
    c->first = nh_alloc_array(size + 2 * n, sizeof *c->first);
    c->at = c->first + size;
    memcpy(c->first, motion->end_state, size * sizeof *c->first);
    nh_sign_changes_open(&c->change);
    nh_sign_changes_take_sides(&c->change, c->before, c->first);
    for (size_t i = 0; i < n; i++) c->pending[i] = c->change.side[i] == 0 && c->before == watch->begin;
    return c;
}

void nh_event_search_free(nh_event_search *c)
{
    if (!c) return;
    nh_sign_changes_clear(&c->change);
    nh_free(c->raw);
    nh_free(c->lacks);
    nh_free(c->pending);
    nh_free(c->first);
    nh_free(c);
}
