/* One motion of a model, in the first formulation that reaches the end (trajectory.h):
 *
 *      asked for the smallest:    the closed subsystem, with all currents, then without those that fail
 *          |  none, or it fails
 *      asked for other velocities:  the equations of another model of the same system
 *          |  no, or that chart ends on the way
 *      own velocities             z' = (rho, a) of the model
 *          |  the chart ends on the way, or becomes steep; or it does not hold at the start
 *      all coordinates            (q, v) by the bordered system [K F^T; F 0]
 *
 * Events, impulses and singular places are watched in the coordinates of whichever formulation runs. The values that
 * are wanted are computed from its states at the outputs. */
#include "motion/automatic.h"
#include "motion/integrators.h"
#include "motion/singular_start.h"
#include "motion/singular_terms.h"
#include "motion/trajectory.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <stdint.h>
#include <string.h>

#include "base/clock.h"
#include "base/progress.h"
#include "graph/print.h"
#include "graph/terms.h"
#include "motion/sizes.h"
#include "motion/table_end.h"

/* The largest |z| along a motion; of states that are zero all along it, their size by sizes.h.  States of a chart that
 * breaks down have no such size. */
static void sizes_of_states(nh_dynamics *dynamics, const nh_motion *motion, double *large)
{
    const nh_model *model = nh_dynamics_model(dynamics);
    size_t states = motion->size, count = motion->count;
    nh_flow_problem problem = nh_dynamics_problem(dynamics);
    nh_sizes sizes;
    bool known = states == problem.size &&
                 nh_sizes_begin(&sizes, &problem, 1, motion->state, motion->time[0], motion->time[count - 1]);
    for (size_t j = 0; j < states; j++) large[j] = known ? sizes.size[j] : 0;
    if (states == problem.size) nh_sizes_clear(&sizes);
    for (size_t i = 0; i < count * states; i++) large[i % states] = fmax(large[i % states], fabs(motion->state[i]));
    for (size_t j = 0; j < model->m; j++) /* turns of an angle do not make it larger */
        if (model->system->coordinate[j].type == NH_ANGLE) large[j] = fmin(large[j], 1);
}

bool nh_trajectory_sizes(nh_dynamics *dynamics, const nh_motion *motion, size_t n, const nh_ex *e, double *size)
{
    static const double part = 1e-6; /* part of a state's size: the change is of first order, and far above rounding */
    size_t states = motion->size, count = motion->count;
    double *value = nh_alloc_array(2 * count * n + 1, sizeof *value),
           *moved = nh_alloc_array((count + 1) * states, sizeof *moved), *large = moved + count * states;
    nh_motion beside = *motion;
    uint64_t random = 0x9e3779b97f4a7c15u;
    sizes_of_states(dynamics, motion, large);
    for (size_t i = 0; i < count * states; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        moved[i] = motion->state[i] + (random >> 63 ? part : -part) * large[i % states];
    }
    beside.state = moved;
    memset(size, 0, n * sizeof *size);
    bool good = nh_along(dynamics, motion, n, e, value), also = nh_along(dynamics, &beside, n, e, value + count * n);
    for (size_t i = 0; i < count * n && good; i++) {
        double change = also ? fabs(value[count * n + i] - value[i]) / part : 0;
        if (isfinite(value[i]))
            size[i % n] = fmax(size[i % n], isfinite(change) ? fmax(fabs(value[i]), change) : fabs(value[i]));
    }
    nh_free(moved);
    nh_free(value);
    return good;
}

/* The chart's point of a state of the subsystem; what the subsystem does not have is not read. */
static bool point_of_scene(void *context, double t, const double *z, double *point)
{
    return nh_closed_subsystem_point(context, t, z, point);
}

/* Is an entry of R steep that depends on kept states alone?  The others do not occur in the equations of these. */
static bool scene_is_steep(const nh_closed_subsystem *s, nh_closed_subsystem_run *run, const nh_motion *motion)
{
    const nh_model *model = s->model;
    if (model->chart->quasi || model->chart->regular || !model->k || s->smooth) return false;
    nh_ex *e = nh_alloc_array(model->m * model->n + 1, sizeof *e);
    double *factor = nh_alloc_array(model->m * model->n + 1, sizeof *factor);
    size_t n = 0;
    nh_chart_slopes(model->chart, factor);
    for (size_t i = 0; i < model->m * model->n; i++) {
        bool known = true;
        for (size_t j = s->kept; j < s->states; j++)
            known &= !nh_depends(model->dag, model->R[i], model->chart->symbol[1 + s->state[j]]);
        if (known) factor[n] = factor[i], e[n++] = model->R[i];
    }
    double *R = nh_alloc_array(n * motion->count + 1, sizeof *R);
    nh_along_values *entries = nh_along_values_create(model, point_of_scene, run, n, e);
    bool any = false, good = nh_along_values_outputs(entries, motion, R);
    if (good) nh_free(nh_steep_entries(motion->count, n, R, factor, &any));
    nh_along_values_free(entries);
    nh_free(R);
    nh_free(factor);
    nh_free(e);
    return any || !good;
}

/* ---- one motion ---- */

typedef struct {
    const nh_trajectory_request *q;
    nh_dynamics *dynamics;
    nh_trajectory *out;
    const nh_method *method; /* NULL: automatic */
    const nh_method *used;   /* of the last motion */
    double *z0, *y0;         /* (q, w) and (q, v) at the start */
    nh_clock_limit time_limit;
    nh_flow_options how;
    bool leave; /* the chart ends on the way */
    nh_event_watch watch;
    nh_ex *watched;               /* the events' expressions and the sizes of their terms */
    nh_dynamics *other;           /* of the model in other velocities, */
    nh_closed_subsystem_run *run; /* of the scene */
    nh_singular_of_model *singular;
} job;

static bool late(void *context) { return nh_interrupted() || nh_clock_limit_reached(*(const nh_clock_limit *)context); }

bool nh_meets_pivot(nh_dynamics *dynamics, const nh_method *method, const double *z0, const double times[2],
                    const nh_flow_options *options)
{
    static const double loose = 1e-7;
    nh_flow_problem problem = nh_dynamics_problem(dynamics);
    nh_flow_options how = *options;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!method || method->family == NH_METHOD_CVODE || problem.guards <= problem.turns ||
        !nh_may_leave_chart(nh_dynamics_model(dynamics)))
        return false;
    how.method = NH_ADAMS;
    how.rtol = fmax(how.rtol, loose);
    nh_motion *motion = nh_cvode(&problem, z0, 2, times, &how, &ignored);
    bool met = motion && motion->guard_hit >= 0;
    nh_motion_free(motion);
    return met;
}

/* How the equations were evaluated. */
static void say_machine(job *j, const char *words)
{
    snprintf(j->out->machine, sizeof j->out->machine, "%s", words ? words : "interpreted");
}

/* ---- events ---- */

/* The watched expressions and the sizes of their terms. */
static bool value_of_watch(double t, const double *z, double *value, void *context)
{
    return nh_along_values_at(context, t, z, value);
}

/* From now on motions watch for the events, with these expressions (NULL: for none). */
static void watch(job *j, nh_along_values *values)
{
    nh_along_values_free(j->watch.context);
    j->watch.context = values;
    j->how.watch = values ? &j->watch : NULL;
}

/* ---- places where the equations determine no acceleration ---- */

static nh_along_values *in_chart(size_t n, const nh_ex *e, void *context)
{
    return nh_along_values_of(((job *)context)->dynamics, false, n, e);
}

static nh_along_values *in_coordinates(size_t n, const nh_ex *e, void *context)
{
    return nh_along_values_of(((job *)context)->dynamics, true, n, e);
}

static nh_along_values *by_other(size_t n, const nh_ex *e, void *context)
{
    const job *j = context;
    return nh_along_values_by_other(j->q->model, j->other, n, e);
}

static nh_along_values *by_scene(size_t n, const nh_ex *e, void *context)
{
    const job *j = context;
    return nh_along_values_create(j->q->model, point_of_scene, j->run, n, e);
}

/* From now on singular places end the motions (`make` NULL: they do not), as far as the known states show them. */
static void watch_singular(job *j, const bool *known, nh_along_values *make(size_t n, const nh_ex *e, void *context))
{
    nh_singular_of_model_free(j->singular);
    bool chart = make == in_chart || make == by_scene;
    j->singular = make ? nh_singular_of_model_create(j->q->model, chart, known, make, j) : NULL;
    j->how.singular = nh_singular_of_model_watch(j->singular);
}

static void watch_singular_of_scene(job *j, const nh_closed_subsystem *s)
{
    bool *known = nh_alloc_array(s->states + 1, sizeof *known);
    for (size_t i = 0; i < s->kept + s->levels; i++) known[s->state[i]] = true;
    watch_singular(j, known, by_scene);
    nh_free(known);
}

static void open_watch(job *j)
{
    const nh_trajectory_request *q = j->q;
    int *direction = nh_alloc_array(q->events + 1, sizeof *direction);
    bool *stop = nh_alloc_array(q->events + 1, sizeof *stop);
    j->watched = nh_alloc_array(q->n + 2 * q->events + 1, sizeof *j->watched);
    for (size_t i = 0; i < q->events; i++) {
        j->watched[i] = q->event[i].e;
        j->watched[q->events + i] = nh_terms_uncancelled(q->model->dag, q->event[i].e);
        direction[i] = q->event[i].direction;
        stop[i] = q->event[i].stop;
    }
    j->watch = (nh_event_watch){.count = q->events,
                                .value = value_of_watch,
                                .direction = direction,
                                .stop = stop,
                                .tolerance = q->options->tolerance,
                                .begin = q->times[0]};
}

static void close_watch(job *j)
{
    watch(j, NULL);
    watch_singular(j, NULL, NULL);
    nh_free((int *)j->watch.direction);
    nh_free((bool *)j->watch.stop);
    nh_free(j->watched);
}

/* Writes the wanted values along the motion and at its events; frees the expressions. */
static bool take_values(job *j, nh_along_values *values, const nh_motion *motion)
{
    nh_free(j->out->event_value);
    j->out->event_value = nh_alloc_array(motion->events * j->q->n + 1, sizeof *j->out->event_value);
    bool good = nh_along_values_outputs(values, motion, j->out->value) &&
                nh_along_values_events(values, motion, j->out->event_value);
    nh_along_values_free(values);
    return good;
}

/* Does the pivot change its sign before the last output? */
static bool meets_pivot(job *j, nh_dynamics *dynamics, const double *z0)
{
    const double ends[2] = {j->q->times[0], j->q->times[j->q->count - 1]};
    return nh_meets_pivot(dynamics, j->method, z0, ends, &j->how);
}

/* Orientations are described anew along a motion of all states only. */
static bool turns(const nh_closed_subsystem *s)
{
    for (size_t i = 0; i < s->kept + s->levels; i++)
        if (s->state[i] < s->model->m && nh_orientation_of(s->model->system, s->state[i])) return true;
    return false;
}

/* The motion of the subsystem's states.  Where it cannot be used, *failed is the index of the current that did not
 * determine its state, or of the last one in use; -1: none. */
static bool in_scene_of(job *j, size_t currents, const nh_ex *current, long *failed, nh_error *error)
{
    size_t events = j->q->events;
    nh_ex *e = nh_alloc_array(j->q->n + events + 1, sizeof *e);
    if (j->q->n) memcpy(e, j->q->e, j->q->n * sizeof *e);
    memcpy(e + j->q->n, j->watched, events * sizeof *e);
    nh_closed_subsystem *s = j->out->scene =
        nh_closed_subsystem_create(j->q->model, j->q->n + events, e, currents, current);
    nh_free(e);
    nh_closed_subsystem_run *run = nh_closed_subsystem_run_create(s, j->q->times[0], j->z0);
    if (events) watch(j, nh_along_values_create(j->q->model, point_of_scene, run, 2 * events, j->watched));
    j->run = run;
    watch_singular_of_scene(j, s);
    nh_flow_problem whole = nh_dynamics_problem(j->dynamics), problem = nh_closed_subsystem_problem(run, &whole);
    double *small = nh_alloc_array(s->kept + 1, sizeof *small);
    for (size_t i = 0; i < s->kept; i++) small[i] = j->z0[s->state[i]];
    nh_closed_subsystem_run_jit(run, j->q->options->compile);
    bool starts = s->kept && nh_closed_subsystem_run_failed(run) < 0 && (s->smooth || !j->leave) && !turns(s);
    nh_motion *motion =
        starts ? nh_automatic_or(j->method, &problem, small, j->q->count, j->q->times, &j->how, &j->used, error) : NULL;
    bool good = motion && !(nh_may_leave_chart(j->q->model) &&
                            ((!s->smooth && !motion->complete) || scene_is_steep(s, run, motion)));
    if (good) good = take_values(j, nh_along_values_create(j->q->model, point_of_scene, run, j->q->n, j->q->e), motion);
    if (good && s->levels) good = motion->complete;
    *failed = -1;
    if (!good && s->levels) {
        long level = nh_closed_subsystem_run_failed(run);
        if (level < 0) level = (long)s->levels - 1;
        for (size_t k = 0; k < currents; k++)
            if (current[k] == s->graph.level[level].current) *failed = (long)k;
    }
    j->out->motion = motion;
    watch(j, NULL);
    watch_singular(j, NULL, NULL);
    say_machine(j, nh_closed_subsystem_run_words(run));
    nh_free(small);
    nh_closed_subsystem_run_free(run);
    if (good) return true;
    nh_motion_free(motion);
    nh_closed_subsystem_free(s);
    j->out->motion = NULL;
    j->out->scene = NULL;
    return false;
}

/* Uses all currents first; then without those that cease to determine their state on the way. */
static bool in_scene(job *j, nh_error *error)
{
    const nh_trajectory_request *q = j->q;
    nh_ex *current = nh_alloc_array(q->currents + q->model->m + 1, sizeof *current);
    size_t n = nh_dependency_graph_cyclic(q->model, current);
    for (size_t k = 0; k < q->currents; k++)
        if (nh_dependency_graph_conserved(q->model, q->current[k])) current[n++] = q->current[k];
    bool good = false;
    for (long failed = 0; failed >= 0 && !good;) {
        good = in_scene_of(j, n, current, &failed, error);
        if (!good && failed >= 0)
            memmove(current + failed, current + failed + 1, (--n - (size_t)failed) * sizeof *current);
    }
    nh_free(current);
    return good;
}

static bool fixed_steps(const job *j) { return j->method && j->method->order; }

/* The model's own equations by the method of the request. */
static nh_motion *in_own_velocities(job *j, nh_error *error)
{
    const nh_trajectory_request *q = j->q;
    nh_flow_problem problem = nh_dynamics_problem(j->dynamics);
    if (q->events) watch(j, nh_along_values_of(j->dynamics, false, 2 * q->events, j->watched));
    watch_singular(j, NULL, in_chart);
    if (!fixed_steps(j))
        return nh_automatic_or(j->method, &problem, j->z0, q->count, q->times, &j->how, &j->used, error);
    nh_programs *own = q->programs ? NULL : nh_programs_create(q->model);
    nh_motion *motion = nh_method_steps(j->method, own ? own : q->programs, j->z0, q->count, q->times, &j->how, error);
    nh_programs_free(own);
    return motion;
}

/* By the equations of the other model, unless its chart breaks down on the way; the values are those in all
 * coordinates. */
static bool in_other_velocities(job *j, nh_error *error)
{
    const nh_trajectory_request *q = j->q;
    nh_dynamics *other = j->other = nh_dynamics_create(q->other);
    nh_flow_problem problem = nh_dynamics_problem(other);
    double *z0 = nh_alloc_array(q->other->m + q->other->n + 1, sizeof *z0);
    nh_dynamics_jit(other, q->options->compile);
    bool starts = nh_dynamics_start(other, q->initial, q->project, z0, error);
    if (starts) nh_dynamics_end_early(other, q->times[0], z0), starts = !meets_pivot(j, other, z0);
    if (q->events) watch(j, nh_along_values_by_other(q->model, other, 2 * q->events, j->watched));
    watch_singular(j, NULL, by_other);
    nh_motion *motion =
        starts ? nh_automatic_or(j->method, &problem, z0, q->count, q->times, &j->how, &j->used, error) : NULL;
    watch(j, NULL);
    watch_singular(j, NULL, NULL);
    bool steep = false;
    if (motion) nh_free(nh_steep_points(other, motion, &steep));
    bool good = motion && motion->complete && !steep && nh_motion_to_coordinates(other, motion);
    if (good) {
        j->out->motion = motion;
        j->out->formulation = q->other->chart->quasi ? NH_ON_SUBMANIFOLD ", in quasi-velocities"
                                                     : NH_ON_SUBMANIFOLD ", in coordinate velocities";
        say_machine(j, nh_dynamics_words(other));
        take_values(j, nh_along_values_of(j->dynamics, true, q->n, q->e), motion);
    } else {
        nh_motion_free(motion);
    }
    nh_free(z0);
    nh_dynamics_free(other);
    return good;
}

/* Did the limit of work end the motion? */
static bool spent_all(const nh_trajectory_request *q, const nh_motion *motion)
{
    return !motion->complete && q->max_effort > 0 && motion->effort > q->max_effort;
}

/* The motion in own velocities, or in all coordinates where these end on the way, and its values. */
static void in_all_states(job *j, nh_error *error)
{
    const nh_trajectory_request *q = j->q;
    nh_motion *motion = j->leave ? NULL : in_own_velocities(j, error);
    say_machine(j, nh_dynamics_words(j->dynamics));
    bool any = j->leave;
    if (motion) nh_free(nh_steep_points(j->dynamics, motion, &any));
    bool out_of_time = late(&j->time_limit) || (motion && spent_all(q, motion));
    if (j->leave || (motion && nh_may_leave_chart(q->model) && (any || !motion->complete) && !out_of_time)) {
        nh_motion_free(motion);
        if (q->events) watch(j, nh_along_values_of(j->dynamics, true, 2 * q->events, j->watched));
        watch_singular(j, NULL, in_coordinates);
        j->out->formulation = "all coordinates, accelerations from the bordered system";
        motion = nh_motion_everywhere(j->dynamics, fixed_steps(j) ? NULL : j->method, j->y0, q->count, q->times,
                                      &j->how, j->out->machine, &j->used, error);
    }
    j->out->motion = motion;
    if (motion)
        take_values(j, nh_along_values_of(j->dynamics, motion->size > q->model->m + q->model->n, q->n, q->e), motion);
}

/* Adds the places of impulses, as events that end the motion, after the events of the request. */
static nh_event *with_impulses(const nh_trajectory_request *q)
{
    nh_event *event = nh_alloc_array(q->events + q->impulses + 1, sizeof *event);
    if (q->events) memcpy(event, q->event, q->events * sizeof *event);
    for (size_t i = 0; i < q->impulses; i++) event[q->events + i] = (nh_event){q->impulse[i], 0, true};
    return event;
}

/* At an impulse the motion has no state that belongs to one of the sides, and it did not end on request. */
static void end_at_impulse(nh_motion *motion, const nh_trajectory_request *q)
{
    const nh_event_found *last = motion && motion->stopped ? &motion->event[motion->events - 1] : NULL;
    if (!last || last->which < q->events) return;
    char *wall = nh_print_string(q->model->dag, q->impulse[last->which - q->events]);
    nh_motion_note(motion,
                   "at t = %.10g it reaches %.100s = 0, where it has an impulse that the equations of motion do not "
                   "determine",
                   last->time, wall);
    nh_free(wall);
    if (motion->count > 1 && motion->time[motion->count - 1] == last->time) motion->count--;
    motion->events--;
    motion->stopped = motion->complete = false;
}

static nh_trajectory *make(const nh_trajectory_request *q, nh_error *error);

nh_trajectory *nh_trajectory_create(const nh_trajectory_request *given, nh_error *error)
{
    if (!given->impulses) {
        nh_trajectory *plain = make(given, error);
        if (plain && !plain->scene) nh_table_end_explain(given->model, plain->motion);
        return plain;
    }
    nh_trajectory_request q = *given;
    nh_event *event = with_impulses(given);
    q.event = event, q.events += q.impulses, q.impulses = 0;
    nh_trajectory *out = make(&q, error);
    if (out) end_at_impulse(out->motion, given);
    nh_free(event);
    return out;
}

static nh_trajectory *make(const nh_trajectory_request *q, nh_error *error)
{
    size_t size = q->model->m + q->model->n;
    nh_trajectory *out = nh_alloc(sizeof *out);
    *out = (nh_trajectory){.formulation = NH_ON_SUBMANIFOLD,
                           .value = nh_alloc_array(q->n * q->count + 1, sizeof *out->value)};
    job j = {.q = q,
             .dynamics = nh_dynamics_create(q->model),
             .out = out,
             .z0 = nh_alloc_array(size + 1, sizeof *j.z0),
             .y0 = nh_alloc_array(2 * q->model->m + 1, sizeof *j.y0),
             .method = q->method,
             .used = q->method,
             .time_limit = nh_clock_limit_in(q->max_seconds > 0 ? q->max_seconds : INFINITY)};
    nh_dynamics_jit(j.dynamics, q->options->compile);
    j.how = (nh_flow_options){.method = NH_ADAMS,
                              .rtol = q->options->tolerance,
                              .absolute = fmax(q->options->absolute, DBL_MIN),
                              .max_steps = q->options->steps,
                              .effort = q->max_effort};
    j.how.step = q->step;
    j.how.cancelled = late;
    j.how.cancel_context = &j.time_limit;
    open_watch(&j);
    nh_error ignored;
    nh_error_clear(&ignored);
    double *v0 = j.y0 + q->model->m;
    if (nh_dynamics_start_all(j.dynamics, q->initial, q->project, j.z0, v0, error)) {
        memcpy(j.y0, j.z0, q->model->m * sizeof *j.y0);
        nh_dynamics_end_early(j.dynamics, q->times[0], j.z0);
        bool other =
            q->velocities == NH_OTHER_VELOCITIES && q->other && !fixed_steps(&j) && nh_may_leave_chart(q->model);
        j.leave = (q->velocities == NH_ALL_COORDINATES && nh_may_leave_chart(q->model)) ||
                  !nh_dynamics_holds(j.dynamics, q->times[0], j.z0, v0) || meets_pivot(&j, j.dynamics, j.z0);
        bool scene = q->smallest && !fixed_steps(&j);
        if (!(scene && in_scene(&j, &ignored)) && !(other && in_other_velocities(&j, &ignored)))
            in_all_states(&j, error);
    }
    close_watch(&j);
    nh_dynamics_free(j.dynamics);
    nh_free(j.z0);
    nh_free(j.y0);
    if (j.used) out->method = j.used->name;
    if (out->motion) return out;
    nh_singular_start_explain(q->model, q->initial, error);
    nh_trajectory_free(out);
    return NULL;
}

void nh_trajectory_free(nh_trajectory *trajectory)
{
    if (!trajectory) return;
    nh_motion_free(trajectory->motion);
    nh_closed_subsystem_free(trajectory->scene);
    nh_free(trajectory->value);
    nh_free(trajectory->event_value);
    nh_free(trajectory);
}
