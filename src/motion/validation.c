/* A motion and what confirms it (validation.h; docs/method.md, sec. 6):
 *
 *      chart's equations     at three tolerances, with which the drift of a true current falls, not that of a false one
 *           |
 *           +-- multiplier form (IDA)      all coordinates: states, and mu against the formula of the model
 *           +-- CVODE Adams                the same states by a multistep method
 *           +-- the other chart's pivot    where coordinate velocities would cease to determine the motion
 *           +-- the closed subsystem       the watched values from fewer states
 *
 * Each computation may use the same part of the whole work. A comparison is relative to the size that the compared
 * number has along the motion. */
#include "motion/validation.h"

#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/budget.h"
#include "base/linalg.h"
#include "base/progress.h"
#include "graph/node.h"
#include "motion/automatic.h"
#include "motion/singular_start.h"
#include "motion/singular_terms.h"
#include "motion/sizes.h"
#include "motion/table_end.h"
#include "motion/turns.h"

typedef struct {
    const nh_model *model;
    nh_dynamics *dynamics;
    nh_validation *out;
    const nh_options *options;
    size_t outputs;
    double *times, *z0, *y0; /* z0: (q, w), y0: (q, v) at the start */
    size_t watches;
    const nh_observable *watch;
    const nh_valid *valid;
    const nh_method *method; /* NULL: automatic choice */
    bool everywhere;         /* the chart breaks down on the way: the motion is integrated in all coordinates */
    size_t currents;
    const nh_ex *current; /* of the chart */
} run;

/* Each motion of the check may use the same part of the whole work: in units of base/effort.h, and for multistep
 * methods also in steps, which evaluate the equations about twice each and compute a new Jacobian now and then. */
enum { all_motions = NH_DRIFT_RUNS + 2 };

static double most_effort(const run *r) { return 1e6 * r->options->check_work / all_motions; }

/* The same limit as a number of steps of a multistep method. */
static double most_steps(const run *r)
{
    enum { evaluations = 3, least = 1000 };
    double each = nh_work_millions(NH_WORK_VALUE, evaluations * (double)nh_dynamics_length(r->dynamics));
    return fmin(r->options->steps, fmax(least, floor(r->options->check_work / all_motions / each)));
}

/* ---- the multiplier form ---- */

/* Scales of q and v (2 m), and of the reactions (m).  Within tau, the time in which the rates change by about their own
 * size, a velocity makes a coordinate at least tau |v| large, and a momentum needs a force |p|/tau to change. */
typedef struct {
    double *state, *force;
} sizes_of_all;

static sizes_of_all measure_sizes(run *r, const nh_motion *motion)
{
    const nh_model *model = r->model;
    size_t m = model->m;
    sizes_of_all all = {.state = nh_alloc_array(4 * m + 1, sizeof(double))};
    double *momentum = all.state + 3 * m;
    all.force = all.state + 2 * m;
    nh_flow_problem problem = nh_dynamics_problem(r->dynamics);
    nh_sizes sizes;
    bool known = nh_sizes_begin(&sizes, &problem, 1, r->z0, r->times[0], r->times[r->outputs - 1]);
    double tau = known ? sizes.tau : fabs(r->times[r->outputs - 1] - r->times[0]);
    nh_trajectory_sizes(r->dynamics, motion, m, model->rho, all.state + m);
    nh_trajectory_sizes(r->dynamics, motion, m, model->reaction, all.force);
    nh_trajectory_sizes(r->dynamics, motion, m, model->p, momentum);
    for (size_t s = 0; s < m; s++) {
        double q = fmax(sizes.size[s], tau * all.state[m + s]);
        for (size_t i = 0; i < motion->count; i++) q = fmax(q, fabs(motion->state[i * motion->size + s]));
        all.state[s] = q > 0 ? q : 1; /* its size is not known */
        all.state[m + s] = fmax(all.state[m + s], DBL_EPSILON * all.state[s] / tau);
        if (tau > 0) all.force[s] = fmax(all.force[s], momentum[s] / tau);
    }
    nh_sizes_clear(&sizes);
    return all;
}

/* difference|/size, 0/0 = 0. */
static double beside(double difference, double size) { return difference != 0 ? fabs(difference) / size : 0; }

/* Positions, velocities and multipliers of the two motions at each output; the largest differences, relative to
 * sizes. */
static void compare(run *r, nh_bordered *bordered, const nh_motion *reduced, const nh_chetaev_motion *full,
                    const sizes_of_all *sizes)
{
    const nh_model *model = r->model;
    nh_validation *v = r->out;
    size_t m = model->m, count = full->motion->count;
    if (reduced->count < count) count = reduced->count;
    nh_motion head = *reduced;
    head.count = count;
    double *velocity = nh_alloc_array(count * m + 1, sizeof *velocity),
           *reaction = nh_alloc_array(count * m + 1, sizeof *reaction);
    double *force = nh_alloc_array(m + 1, sizeof *force);
    bool good = nh_along(r->dynamics, &head, m, model->rho, velocity) &&
                nh_along(r->dynamics, &head, m, model->reaction, reaction);
    for (size_t i = 0; i < count && good; i++) {
        const double *z = reduced->state + i * reduced->size, *y = full->motion->state + i * full->motion->size;
        bool forced = nh_bordered_force(bordered, full->motion->time[i], y, y + m, y + 2 * m, force);
        for (size_t s = 0; s < m; s++) {
            double c = -reaction[i * m + s];
            v->state_difference = fmax(v->state_difference, beside(z[s] - y[s], sizes->state[s]));
            v->state_difference =
                fmax(v->state_difference, beside(velocity[i * m + s] - y[m + s], sizes->state[m + s]));
            if (forced && isfinite(c))
                v->multiplier_difference = fmax(v->multiplier_difference, beside(c - force[s], sizes->force[s]));
        }
    }
    nh_free(force);
    nh_free(reaction);
    nh_free(velocity);
}

static void multiplier_form(run *r, const nh_state *initial, const nh_motion *reduced, const sizes_of_all *sizes)
{
    const nh_model *model = r->model;
    nh_validation *v = r->out;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_bordered *b = nh_bordered_create(model);
    nh_chetaev_problem problem = nh_bordered_problem(b);
    double *y = nh_alloc_array(2 * model->m, sizeof *y);
    memcpy(y, initial->q, model->m * sizeof *y);
    nh_motion first = *reduced;
    first.count = 1;
    bool good = nh_along(r->dynamics, &first, model->m, model->rho, y + model->m);
    /* this only confirms a motion: near a pole of the coordinates it may need millions of steps */
    double enough = fmin(20000, 2000 + 20 * (double)reduced->steps);
    nh_flow_options options = {.rtol = v->tolerance[NH_DRIFT_RUNS - 1],
                               .scale = sizes->state,
                               .max_steps = fmin(enough, most_steps(r)),
                               .cancelled = nh_interrupted_callback};
    size_t rows = reduced->smooth ? reduced->smooth : reduced->count;
    nh_chetaev_motion *full = good ? nh_chetaev(&problem, y, rows, reduced->time, &options, &ignored) : NULL;
    if (full && full->motion->count > 1) {
        v->multiplier_form = true;
        v->violation = full->violation;
        compare(r, b, reduced, full, sizes);
        if (!full->motion->complete && (double)full->motion->steps >= options.max_steps)
            snprintf(v->note, sizeof v->note,
                     "the multiplier form was compared only up to t = %.4g, which it reaches in %.0f steps",
                     full->motion->end_time, options.max_steps);
        else if (!full->motion->complete)
            snprintf(v->note, sizeof v->note, "the multiplier form was compared only up to t = %.4g: %s",
                     full->motion->end_time, full->motion->note);
        else if (v->state_difference > NH_MOTIONS_APART && !v->note[0])
            snprintf(v->note, sizeof v->note,
                     "the multiplier form gives a different motion: states differ by %.2g; errors grow along this "
                     "motion, or it passes a state at which the equations do not determine it",
                     v->state_difference);
        else if (rows < reduced->count && !v->note[0])
            snprintf(v->note, sizeof v->note,
                     "the multiplier form was compared up to t = %.4g, where the coordinates of an orientation become "
                     "their shadow",
                     reduced->time[rows - 1]);
    } else {
        snprintf(v->note, sizeof v->note, "the multiplier form could not be integrated: %.180s",
                 full ? full->motion->note : ignored.what);
    }
    nh_chetaev_motion_free(full);
    nh_free(y);
    nh_bordered_free(b);
}

/* ---- a multistep method ---- */

/* Those of run number `which`, at its tolerance. */
static nh_flow_options options_of(const run *r, size_t which)
{
    return (nh_flow_options){.method = NH_ADAMS,
                             .rtol = r->out->tolerance[which],
                             .absolute = fmax(r->options->absolute, DBL_MIN),
                             .max_steps = r->options->steps,
                             .effort = most_effort(r),
                             .early = true,
                             .cancelled = nh_interrupted_callback};
}

static nh_along_values *along(size_t n, const nh_ex *e, void *context)
{
    const run *r = context;
    return nh_along_values_of(r->dynamics, r->everywhere, n, e);
}

/* It ends where the equations of motion determine no acceleration, as in `simulate`. */
static nh_motion *motion_by(run *r, const nh_method *method, nh_flow_options options, const nh_method **used,
                            nh_error *error)
{
    nh_flow_problem problem = nh_dynamics_problem(r->dynamics);
    nh_singular_of_model *singular = nh_singular_of_model_create(r->model, !r->everywhere, NULL, along, r);
    options.singular = nh_singular_of_model_watch(singular);
    nh_motion *motion =
        r->everywhere
            ? nh_motion_everywhere(r->dynamics, method, r->y0, r->outputs, r->times, &options, NULL, used, error)
            : nh_automatic_or(method, &problem, r->z0, r->outputs, r->times, &options, used, error);
    nh_singular_of_model_free(singular);
    nh_table_end_explain(r->model, motion);
    return motion;
}

/* Computes the motion once more by CVODE Adams, unless that computed it first; compares coordinates and coordinate
 * velocities as far as both motions go. */
static void multistep(run *r, const nh_motion *motion, const sizes_of_all *sizes)
{
    const nh_method *adams = nh_method_find("CVODE Adams");
    size_t states = 2 * r->model->m;
    nh_validation *v = r->out;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!strcmp(v->method, adams->name)) return;
    nh_flow_options options = options_of(r, NH_DRIFT_RUNS - 1);
    options.max_steps = most_steps(r);
    nh_motion *other = motion_by(r, adams, options, NULL, &ignored);
    size_t count = other ? (other->count < motion->count ? other->count : motion->count) : 0;
    double *own = nh_alloc_array(2 * motion->count * states + 1, sizeof *own), *its = own + motion->count * states;
    nh_motion head = *motion;
    head.count = count;
    if (other) other->count = count;
    v->multistep = count > 1 && nh_states_in_coordinates(r->dynamics, &head, own) &&
                   nh_states_in_coordinates(r->dynamics, other, its);
    for (size_t i = 0; i < count && v->multistep; i++)
        nh_turns_nearest(r->model->system, own + i * states, its + i * states, its + i * states + r->model->m);
    for (size_t i = 0; i < count * states && v->multistep; i++)
        v->multistep_difference = fmax(v->multistep_difference, beside(own[i] - its[i], sizes->state[i % states]));
    nh_free(own);
    nh_motion_free(other);
}

/* ---- the other chart's pivot ---- */

/* det d(independent coordinate velocities)/dw changes sign where the coordinate chart breaks down. */
static void watch_pivot(run *r, const nh_model *other, const nh_motion *motion)
{
    const nh_model *model = r->model;
    size_t n = model->n, row = 0;
    if (!other || other->chart->quasi || !model->chart->quasi) return;
    nh_ex *e = nh_alloc_array(n * n + 1, sizeof *e);
    for (size_t s = 0; s < model->m; s++)
        for (size_t i = 0; i < n; i++)
            if (other->chart->w[i] == model->system->coordinate[s].v) {
                for (size_t j = 0; j < n; j++) e[row + j * n] = model->R[s * n + j];
                row++;
            }
    double *value = nh_alloc_array(motion->count * n * n + 1, sizeof *value), last = 0;
    bool good = row == n && nh_along(r->dynamics, motion, n * n, e, value);
    for (size_t i = 0; i < motion->count && good; i++) {
        double det = nh_determinant(n, value + i * n * n);
        if (last * det < 0 && isnan(r->out->crossing)) {
            double t0 = motion->time[i - 1], t1 = motion->time[i];
            r->out->crossing = t0 + (t1 - t0) * last / (last - det);
            r->out->crossing_chart = nh_arena_strdup(r->out->arena, other->chart->name);
        }
        last = det;
    }
    nh_free(value);
    nh_free(e);
}

/* ---- the closed subsystem ---- */

/* Does the smallest model give the same values of the observables? */
static void smallest_model(run *r, const nh_state *initial, const nh_motion *motion, const nh_ex *watched)
{
    nh_validation *v = r->out;
    size_t n = 0, *column = nh_arena_alloc(v->arena, (r->watches + 1) * sizeof *column);
    nh_ex *asked = nh_arena_alloc(v->arena, (r->watches + 1) * sizeof *asked);
    for (size_t j = 0; j < r->watches; j++) {
        if (!r->watch[j].asked) continue;
        column[n] = j;
        asked[n++] = watched[j];
    }
    if (n == 0) return;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_options options = *r->options;
    options.tolerance = v->tolerance[NH_DRIFT_RUNS - 1];
    nh_trajectory_request q = {.model = r->model,
                               .initial = initial,
                               .count = v->count,
                               .times = v->time,
                               .options = &options,
                               .n = n,
                               .e = asked,
                               .smallest = true,
                               .currents = r->currents,
                               .current = r->current};
    nh_trajectory *t = nh_trajectory_create(&q, &ignored);
    if (t && t->scene && t->motion->complete) {
        nh_text words;
        nh_text_init(&words);
        nh_closed_subsystem_words(t->scene, &words);
        v->scene = nh_arena_strdup(v->arena, nh_text_string(&words));
        v->scene_evaluations = t->motion->evaluations;
        double *size = nh_alloc_array(n, sizeof *size);
        nh_trajectory_sizes(r->dynamics, motion, n, asked, size);
        for (size_t i = 0; i < v->count * n; i++) {
            double full = v->watch[i / n * r->watches + column[i % n]];
            if (isfinite(full))
                v->scene_difference = fmax(v->scene_difference, beside(t->value[i] - full, size[i % n]));
        }
        nh_free(size);
        nh_text_clear(&words);
    }
    nh_trajectory_free(t);
}

/* ---- all runs ---- */

/* Copies the tightest run and its multipliers into the result. */
static void keep(run *r, const nh_state *initial, const nh_motion *motion)
{
    nh_validation *v = r->out;
    const nh_model *model = r->model;
    v->count = motion->count;
    v->size = motion->size;
    v->time = nh_arena_alloc(v->arena, motion->count * sizeof *v->time);
    v->state = nh_arena_alloc(v->arena, motion->count * motion->size * sizeof *v->state);
    v->multiplier = nh_arena_alloc(v->arena, (motion->count * model->k + 1) * sizeof *v->multiplier);
    memcpy(v->time, motion->time, motion->count * sizeof *v->time);
    memcpy(v->state, motion->state, motion->count * motion->size * sizeof *v->state);
    if (model->k) nh_along(r->dynamics, motion, model->k, model->mu, v->multiplier);
    v->watches = r->watches;
    v->watch_name = nh_arena_alloc(v->arena, (r->watches + 1) * sizeof *v->watch_name);
    v->watch = nh_arena_alloc(v->arena, (r->watches * motion->count + 1) * sizeof *v->watch);
    nh_ex *e = nh_alloc_array(r->watches + 1, sizeof *e);
    for (size_t i = 0; i < r->watches; i++) {
        v->watch_name[i] = nh_arena_strdup(v->arena, r->watch[i].name);
        e[i] = r->watch[i].value;
    }
    if (r->watches) nh_along(r->dynamics, motion, r->watches, e, v->watch);
    if (r->watches && !r->everywhere && motion->complete) smallest_model(r, initial, motion, e);
    nh_free(e);
    v->evaluations = motion->evaluations;
    v->steps = motion->steps;
    v->complete = motion->complete;
    v->end = motion->end_time;
    if (!motion->complete)
        snprintf(v->note, sizeof v->note, "the test motion ends at t = %.4g: %.200s", motion->end_time, motion->note);
}

/* Confirms the tightest run by independent computations. */
static void compare_with_others(run *r, const nh_validation_request *q, const nh_motion *motion)
{
    sizes_of_all sizes = measure_sizes(r, motion);
    watch_pivot(r, q->other, motion);
    multiplier_form(r, q->initial, motion, &sizes);
    multistep(r, motion, &sizes);
    nh_free(sizes.state);
}

static bool all_runs(run *r, const nh_validation_request *q, nh_error *error)
{
    for (size_t i = 0; i < NH_DRIFT_RUNS; i++) {
        const nh_method *used = NULL;
        nh_flow_options options = options_of(r, i);
        if (i == 0 &&
            nh_meets_pivot(r->dynamics, r->method, r->z0, (double[]){r->times[0], r->times[r->outputs - 1]}, &options))
            r->everywhere = true;
        nh_motion *motion = motion_by(r, r->method, options, &used, error);
        if (!motion) return false;
        bool steep;
        nh_free(nh_steep_points(r->dynamics, motion, &steep));
        if (!r->everywhere && (steep || !motion->complete) && nh_may_leave_chart(r->model)) {
            r->everywhere = true; /* begin again, in a formulation that is regular there */
            nh_motion_free(motion);
            return all_runs(r, q, error);
        }
        if (r->everywhere) r->out->chart = "all coordinates (the chart breaks down on the way)";
        r->out->method = used->name;
        nh_drift_measure(&(nh_drift_question){r->dynamics, r->options, r->out->begin, r->out->tolerance, q->currents,
                                              q->current, r->valid},
                         motion, i, r->out->current);
        if (i == NH_DRIFT_RUNS - 1) {
            keep(r, q->initial, motion);
            compare_with_others(r, q, motion);
        }
        nh_motion_free(motion);
    }
    return true;
}

/* Chooses the method and the tolerance of the tightest run by the wanted accuracy of the states and of the watched
 * expressions.  False: no motion can be computed. */
static bool choose(run *r, const nh_validation_request *q, double *tolerance, nh_error *error)
{
    const nh_model *model = q->model;
    size_t states = model->m + model->n, n = states + q->watches;
    nh_ex *e = nh_alloc_array(n + 1, sizeof *e);
    memcpy(e, model->chart->symbol + 1, states * sizeof *e);
    bool *by_terms = nh_alloc_array(n + 1, sizeof *by_terms);
    for (size_t i = 0; i < q->watches; i++) {
        e[states + i] = q->watch[i].value;
        by_terms[states + i] = q->watch[i].by_terms;
    }
    nh_trajectory_request request = {.model = model,
                                     .initial = q->initial,
                                     .count = q->outputs,
                                     .times = r->times,
                                     .options = q->options,
                                     .n = n,
                                     .e = e,
                                     .by_terms = by_terms,
                                     .max_seconds = q->options->max_seconds};
    nh_trajectory *t = nh_trajectory_accurate(&request, q->accuracy, q->ways, &r->out->accuracy, error);
    nh_free(by_terms);
    if (!t) return nh_free(e), false;
    nh_accuracy *a = &r->out->accuracy;
    size_t k = a->quantity, used = strlen(a->why);
    if (!a->held)
        snprintf(a->why + used, sizeof a->why - used, "; `%s` is the least certain",
                 k < states ? nh_name_of(model->dag, e[k]) : q->watch[k - states].name);
    nh_free(e);
    r->method = nh_method_find(t->method);
    r->out->checked = true;
    *tolerance = a->tolerance;
    nh_trajectory_free(t);
    return true;
}

nh_validation *nh_validate(const nh_validation_request *q, nh_error *error)
{
    nh_arena *arena = nh_arena_create();
    nh_validation *v = nh_arena_alloc(arena, sizeof *v);
    const nh_model *model = q->model;
    size_t size = model->m + model->n;
    double tolerance = q->options->tolerance;
    *v = (nh_validation){.arena = arena,
                         .multiplier_method = "IDA, index 1",
                         .chart = nh_arena_strdup(arena, model->chart->name),
                         .begin = q->initial->t,
                         .end = q->until,
                         .currents = q->currents,
                         .current = nh_arena_alloc(arena, (q->currents + 1) * sizeof *v->current),
                         .crossing = NAN};
    run r = {.model = model,
             .dynamics = nh_dynamics_create(model),
             .out = v,
             .options = q->options,
             .outputs = q->outputs,
             .watches = q->watches,
             .watch = q->watch,
             .valid = q->valid,
             .currents = q->currents,
             .current = q->current};
    r.times = nh_alloc_array(q->outputs + 1, sizeof *r.times);
    r.z0 = nh_alloc_array(size + 1, sizeof *r.z0);
    r.y0 = nh_alloc_array(2 * model->m + 1, sizeof *r.y0);
    for (size_t i = 0; i < q->outputs; i++)
        r.times[i] = q->initial->t + (q->until - q->initial->t) * (double)i / (double)(q->outputs - 1);
    bool good = nh_dynamics_start_all(r.dynamics, q->initial, false, r.z0, r.y0 + model->m, error);
    memcpy(r.y0, r.z0, model->m * sizeof *r.y0);
    r.everywhere = good && !nh_dynamics_holds(r.dynamics, q->initial->t, r.z0, r.y0 + model->m);
    good = good && (!(q->accuracy > 0) || choose(&r, q, &tolerance, error));
    for (size_t i = 0; i < NH_DRIFT_RUNS; i++)
        v->tolerance[i] = fmin(1e-3, tolerance * pow(100, (double)(NH_DRIFT_RUNS - 1 - i)));
    good = good && all_runs(&r, q, error);
    if (good) nh_drift_judge(v->currents, v->tolerance, q->options, v->current);
    nh_dynamics_free(r.dynamics);
    nh_free(r.times);
    nh_free(r.z0);
    nh_free(r.y0);
    if (good) return v;
    nh_singular_start_explain(model, q->initial, error);
    nh_validation_free(v);
    return NULL;
}

void nh_validation_free(nh_validation *validation)
{
    if (validation) nh_arena_free(validation->arena);
}
