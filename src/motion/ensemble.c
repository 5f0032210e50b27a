/* Batches that step together (the steps: ensemble.h), then the members that were left out, alone. */
#include "motion/ensemble.h"

#include <float.h>
#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "base/effort.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "motion/sizes.h"
#include "motion/integrators.h"
#include "motion/turns.h"
#include "system/sample.h"

enum { lanes = NH_ENSEMBLE_BATCH, first_steps = 20 }; /* first_steps: too few to extrapolate the work of the others */
static const double safety = 0.9, most_growth = 5, least_growth = 0.2; /* factors of the step */
/* units of effort of a step, and of a sum with one number of one member */
static const double step_units = 500, sum_units = 0.3;
static const double order = 8;
/* a member that needs so many times smaller steps than its batch is computed alone */
static const double too_slow = 20;

typedef struct {
    const nh_trajectory_request *request;
    nh_ensemble *out;
    const double *initial;
    nh_tableau tableau;
    nh_tape *values;
    nh_dynamics *watched; /* of a chart whose pivot is watched; else NULL */
    bool *alone;
    long *evaluations;   /* per batch */
    double begun, limit; /* units of effort of this thread; the limit may be INFINITY */
    double *reached;     /* per batch, the time that it reached; NULL: not wanted */
} plan;

/* One batch: arrays of `lanes` values, state after state. */
typedef struct {
    const plan *p;
    size_t first, members, kept, width;
    nh_tape_work *rate, *values;
    double *z, *stage, *k, *next, *error, *fixed; /* kept x lanes; k: stages of it; fixed: width x lanes */
    const double **in;                            /* width: where the tape reads */
    double **out;                                 /* kept: where it writes */
    double *lane_error;
    bool *alive;
    double t, h;
    nh_sizes sizes;        /* sizes of all states in all lanes, as of one large motion */
    double *allowed;       /* allowed absolute errors: kept x lanes */
    nh_dynamics *dynamics; /* shares plan.watched */
    double *pivot, *whole;
} batch;

/* ---- one batch ---- */

/* k = f(t, z) of the kept states in all lanes. */
static void rates(batch *b, double t, const double *z, double *k)
{
    const nh_closed_subsystem *s = b->p->out->scene;
    for (size_t l = 0; l < lanes; l++) b->fixed[l] = t;
    for (size_t i = 0; i < b->kept; i++) b->in[1 + s->state[i]] = z + i * lanes;
    for (size_t i = 0; i < b->kept; i++) b->out[i] = k + i * lanes;
    nh_tape_eval_batch(s->rate, b->rate, lanes, b->in, b->out);
}

/* Tries a step; returns the largest error of the members that are still in the batch. */
static double try_step(batch *b)
{
    const nh_tableau *r = &b->p->tableau;
    const nh_options *o = b->p->request->options;
    size_t count = b->kept * lanes;
    for (int i = 0; i < r->stages; i++) {
        nh_tableau_add(count, i, r->a[i], b->h, b->k, count, b->z, b->stage);
        rates(b, b->t + r->c[i] * b->h, b->stage, b->k + (size_t)i * count);
    }
    nh_tableau_add(count, r->stages, r->b, b->h, b->k, count, b->z, b->next);
    memset(b->stage, 0, count * sizeof *b->stage);
    nh_tableau_add(count, r->stages, r->e, b->h, b->k, count, b->stage, b->error);
    for (size_t i = 0; i < count; i++) b->allowed[i] = nh_sizes_absolute(&b->sizes, o->tolerance, i);
    nh_tableau_error(b->kept, lanes, o->tolerance, b->allowed, b->error, b->z, b->next, b->lane_error);
    double worst = 0;
    for (size_t l = 0; l < b->members; l++)
        if (b->alive[l]) worst = fmax(worst, isfinite(b->lane_error[l]) ? b->lane_error[l] : INFINITY);
    return worst;
}

/* The member will be computed alone. */
static void leave_out(batch *b, size_t lane)
{
    b->alive[lane] = false;
    b->p->alone[b->first + lane] = true;
    /* any values at which the equations can be evaluated */
    for (size_t i = 0; i < b->kept; i++) b->z[i * lanes + lane] = b->z[i * lanes];
}

/* Leaves out members whose error is so far above the median that they would delay the others. */
static bool leave_out_the_slow(batch *b)
{
    double sorted[lanes];
    size_t n = 0;
    bool any = false;
    for (size_t l = 0; l < b->members; l++)
        if (b->alive[l] && isfinite(b->lane_error[l])) sorted[n++] = b->lane_error[l];
    gsl_sort(sorted, 1, n);
    double limit = n ? fmax(sorted[n / 2], DBL_MIN) * pow(too_slow, order) : 0;
    for (size_t l = 0; l < b->members; l++)
        if (b->alive[l] && b->lane_error[l] > 1 && b->lane_error[l] > limit) {
            leave_out(b, l);
            any = true;
        }
    return any;
}

static bool leave_out_the_undefined(batch *b)
{
    bool any = false;
    for (size_t l = 0; l < b->members; l++)
        if (b->alive[l] && !isfinite(b->lane_error[l])) {
            leave_out(b, l);
            any = true;
        }
    return any;
}

/* A chart of coordinate velocities ends where its pivot changes sign. */
static void watch_pivots(batch *b)
{
    const nh_closed_subsystem *s = b->p->out->scene;
    if (!b->dynamics) return;
    nh_flow_problem problem = nh_dynamics_problem(b->dynamics);
    for (size_t l = 0; l < b->members; l++) {
        if (!b->alive[l]) continue;
        memcpy(b->whole, b->p->initial + (b->first + l) * s->states, s->states * sizeof *b->whole);
        for (size_t i = 0; i < b->kept; i++) b->whole[s->state[i]] = b->z[i * lanes + l];
        double now;
        if (!problem.guard(b->t, b->whole, &now, problem.context) || now * b->pivot[l] < 0 || fabs(now) < 0.1)
            leave_out(b, l);
        b->pivot[l] = now;
    }
}

/* A member whose orientation comes to its shadow goes on alone. */
static void watch_turns(batch *b)
{
    const nh_closed_subsystem *s = b->p->out->scene;
    for (size_t l = 0; l < b->members && s->model->system->orientations; l++) {
        for (size_t i = 0; i < b->kept; i++) b->whole[s->state[i]] = b->z[i * lanes + l];
        if (b->alive[l] && nh_turns_renew(s->model->system, b->whole, NULL)) leave_out(b, l);
    }
}

/* The wanted values of all lanes at this output. */
static void store(batch *b, size_t output)
{
    nh_ensemble *e = b->p->out;
    const nh_closed_subsystem *s = e->scene;
    double *to[64], *buffer = nh_alloc_array(e->n * lanes + 1, sizeof *buffer);
    double **rows = e->n > 64 ? nh_alloc_array(e->n, sizeof *rows) : to;
    for (size_t k = 0; k < e->n; k++) rows[k] = buffer + k * lanes;
    for (size_t l = 0; l < lanes; l++) b->fixed[l] = b->t;
    for (size_t i = 0; i < b->kept; i++) b->in[1 + s->state[i]] = b->z + i * lanes;
    if (e->n) nh_tape_eval_batch(b->p->values, b->values, lanes, b->in, rows);
    for (size_t l = 0; l < b->members; l++)
        for (size_t k = 0; k < e->n; k++) e->value[((b->first + l) * e->count + output) * e->n + k] = rows[k][l];
    if (rows != to) nh_free(rows);
    nh_free(buffer);
}

/* Has the work passed its limit, or will it clearly? */
static bool late(const batch *b, long steps)
{
    const plan *p = b->p;
    if (!(p->limit < INFINITY)) return false;
    double spent = nh_effort() - p->begun, begin = p->request->times[0],
           part = (b->t - begin) / (p->request->times[p->request->count - 1] - begin);
    if (steps < first_steps) return spent > p->limit;
    return spent > p->limit || (spent > p->limit / 4 && spent > 2 * part * p->limit) ||
           (spent > p->limit / 16 && spent > 4 * part * p->limit);
}

/* Integrates to `target`; false when no step is small enough. */
static bool go_to(batch *b, double target, long *steps)
{
    const nh_options *o = b->p->request->options;
    while (b->t != target) {
        if (nh_interrupted() || late(b, *steps)) return false;
        double wanted = b->h, left = target - b->t;
        bool last = fabs(b->h) >= fabs(left) * (1 - 1e-12);
        if (last) b->h = left;
        double worst = try_step(b);
        b->p->evaluations[b->first / lanes] += b->p->tableau.stages;
        nh_effort_add(step_units + sum_units * (double)(b->p->tableau.stages * b->p->tableau.stages) / 2 *
                                       (double)(b->kept * lanes));
        double growth = worst > 0 && isfinite(worst)
                            ? fmin(most_growth, fmax(least_growth, safety * pow(worst, -1 / order)))
                        : isfinite(worst) ? most_growth
                                          : least_growth;
        if (worst <= 1) {
            b->t = last ? target : b->t + b->h;
            double *swap = b->z;
            b->z = b->next;
            b->next = swap;
            nh_sizes_follow(&b->sizes, b->t, b->z);
            b->h = last ? (fabs(b->h * growth) > fabs(wanted) ? b->h * growth : wanted) : b->h * growth;
            watch_pivots(b);
            watch_turns(b);
        } else {
            if (leave_out_the_slow(b)) growth = 1;
            b->h *= growth;
            if (fabs(b->h) < 16 * DBL_EPSILON * fabs(b->t) + DBL_MIN ||
                (fabs(b->h) < 1e-12 * fabs(target - b->p->request->times[0]) && !isfinite(worst))) {
                if (!leave_out_the_undefined(b)) return false;
                b->h = wanted;
            }
        }
        if ((double)++*steps > o->steps || nh_interrupted()) return false;
    }
    return true;
}

/* Memory and initial states of batch `index`. */
static void open_batch(batch *b, const plan *p, size_t index)
{
    const nh_closed_subsystem *s = p->out->scene;
    const nh_model *model = p->request->model;
    size_t count = s->kept * lanes;
    *b = (batch){.p = p, .first = index * lanes, .kept = s->kept, .width = model->width, .t = p->request->times[0]};
    b->members = p->out->members - b->first < lanes ? p->out->members - b->first : lanes;
    b->rate = nh_tape_work_create(s->rate);
    b->values = nh_tape_work_create(p->values);
    b->z = nh_alloc_array(count * 5 + (size_t)p->tableau.stages * count, sizeof *b->z);
    b->next = b->z + count, b->stage = b->next + count, b->error = b->stage + count, b->allowed = b->error + count,
    b->k = b->allowed + count;
    b->fixed = nh_alloc_array(b->width * lanes, sizeof *b->fixed);
    b->in = nh_alloc_array(b->width, sizeof *b->in);
    b->out = nh_alloc_array(s->kept, sizeof *b->out);
    b->lane_error = nh_alloc_array(3 * lanes, sizeof *b->lane_error);
    b->pivot = b->lane_error + lanes;
    b->whole = nh_alloc_array(s->states, sizeof *b->whole);
    b->alive = nh_alloc_array(lanes, sizeof *b->alive);
    for (size_t i = 0; i < b->width; i++) b->in[i] = b->fixed + i * lanes;
    for (size_t l = 0; l < lanes; l++) {
        /* empty lanes repeat the first */
        const double *from = p->initial + (b->first + (l < b->members ? l : 0)) * s->states;
        for (size_t i = 0; i < s->states; i++) b->fixed[(1 + i) * lanes + l] = from[i];
        for (size_t i = 0; i < s->kept; i++) b->z[i * lanes + l] = from[s->state[i]];
        b->alive[l] = l < b->members;
    }
}

static bool rates_of_all(double t, const double *z, double *rate, void *context)
{
    return rates(context, t, z, rate), true;
}

static void close_batch(batch *b, double *block)
{
    nh_sizes_clear(&b->sizes);
    nh_tape_work_free(b->rate);
    nh_tape_work_free(b->values);
    nh_free(block);
    nh_free(b->fixed);
    nh_free(b->in);
    nh_free(b->out);
    nh_free(b->lane_error);
    nh_free(b->whole);
    nh_free(b->alive);
    nh_dynamics_free(b->dynamics);
}

/* The values of the member are unknown from this output on. */
static void unknown_from(const plan *p, size_t member, size_t output)
{
    const nh_ensemble *e = p->out;
    for (size_t i = output * e->n; i < e->count * e->n; i++) e->value[member * e->count * e->n + i] = NAN;
}

static void do_batch(size_t index, void *context)
{
    const plan *p = context;
    batch b;
    open_batch(&b, p, index);
    double *block = b.z, span = p->request->times[p->out->count - 1] - b.t;
    long steps = 0;
    if (p->watched) {
        b.dynamics = nh_dynamics_share(p->watched);
        for (size_t l = 0; l < lanes; l++) b.pivot[l] = 0;
        watch_pivots(&b);
    }
    b.h = span / 1000;
    nh_flow_problem all = {.size = b.kept * lanes, .context = &b, .rate = rates_of_all};
    /* a member has no rates there, and will be left out */
    if (!nh_sizes_begin(&b.sizes, &all, fmax(p->request->options->absolute, DBL_MIN), b.z, b.t, b.t + span)) {
        nh_sizes_clear(&b.sizes);
        nh_sizes_given(&b.sizes, &all, NULL);
    }
    for (size_t i = 0; i < p->out->count; i++) {
        if (!go_to(&b, p->request->times[i], &steps)) {
            for (size_t l = 0; l < b.members; l++) {
                if (!b.alive[l]) continue;
                if (nh_interrupted()) unknown_from(p, b.first + l, i);
                else leave_out(&b, l);
            }
            break;
        }
        store(&b, i);
    }
    if (p->reached) p->reached[index] = b.t;
    close_batch(&b, block);
}

/* ---- members alone ---- */

/* Each member writes to its own place: the result does not depend on the assignment to threads. */
typedef struct {
    size_t member, reached;
    bool done;
    long evaluations;
    char note[200];
} loner;

typedef struct {
    const plan *p;
    loner *one;
} loners;

static void compute_alone(const plan *p, const nh_trajectory_request *request, loner *l)
{
    const nh_ensemble *e = p->out;
    const nh_model *model = request->model;
    if (nh_interrupted()) return unknown_from(p, l->member, 0);
    size_t each = e->count * e->n;
    double *z = nh_alloc_array(2 * model->m, sizeof *z), *v = z + model->m, *target = e->value + l->member * each;
    nh_dynamics *d = nh_dynamics_create(model);
    nh_motion start = {.count = 1,
                       .size = model->m + model->n,
                       .time = (double *)p->request->times,
                       .state = (double *)p->initial + l->member * (model->m + model->n)};
    nh_trajectory_request q = *request;
    nh_state state = {.t = q.times[0], .q = z, .v = v};
    nh_error error;
    nh_error_clear(&error);
    memcpy(z, start.state, model->m * sizeof *z);
    q.initial = &state;
    q.method = NULL;
    /* finding the smallest model again takes longer than the motion, and most members are here because a chart ends */
    q.smallest = false;
    nh_trajectory *t = nh_dynamics_velocities(d, q.times[0], start.state, v) ? nh_trajectory_create(&q, &error) : NULL;
    l->done = true;
    l->reached = t ? t->motion->count : 0;
    if (t) l->evaluations = t->motion->evaluations;
    for (size_t i = 0; i < each; i++) target[i] = i < l->reached * e->n ? t->value[i] : NAN;
    if (l->reached < e->count) snprintf(l->note, sizeof l->note, "%.199s", t ? t->motion->note : error.what);
    nh_trajectory_free(t);
    nh_dynamics_free(d);
    nh_free(z);
}

static void do_alone(size_t index, void *context)
{
    const loners *left = context;
    nh_trajectory_own own = nh_trajectory_own_create(left->p->request);
    compute_alone(left->p, &own.request, &left->one[1 + index]);
    nh_trajectory_own_free(&own);
}

static void count_interrupted(nh_ensemble *e)
{
    size_t each = e->count * e->n;
    e->incomplete = 0;
    for (size_t i = 0; i < e->members && each; i++) e->incomplete += isnan(e->value[(i + 1) * each - 1]) != 0;
    nh_ended_words(e->note, sizeof e->note);
}

/* Computes alone the members that were left out, or all members. */
static void go_alone(plan *p, bool all, size_t threads)
{
    nh_ensemble *e = p->out;
    loners left = {.p = p, .one = nh_alloc_array(e->members, sizeof *left.one)};
    size_t n = 0;
    for (size_t i = 0; i < e->members; i++)
        if (all || p->alone[i]) left.one[n++].member = i;
    /* the others find in their copies of the graph what this one derives */
    if (n) compute_alone(p, p->request, left.one);
    if (n > 1) nh_parallel(n - 1, threads, do_alone, &left);
    for (size_t i = 0; i < n; i++) {
        const loner *l = &left.one[i];
        e->alone += l->done;
        e->evaluations += l->evaluations;
        if (l->done && l->reached < e->count && !e->incomplete++)
            snprintf(e->note, sizeof e->note, "member %zu: %s", l->member, l->note);
    }
    nh_free(left.one);
}

/* ---- all ---- */

static bool open_plan(plan *p, const nh_trajectory_request *q, nh_ensemble *e, const double *initial)
{
    *p = (plan){
        .request = q, .out = e, .initial = initial, .values = nh_model_tape(q->model, q->n, q->e), .limit = INFINITY};
    p->evaluations = nh_alloc_array((e->members + lanes - 1) / lanes, sizeof *p->evaluations);
    p->alone = nh_alloc_array(e->members, sizeof *p->alone);
    bool together = !e->scene->implicit && !e->scene->walls && !q->impulses && e->scene->kept &&
                    /* members cross walls at different times */ nh_tableau_rk8pd(&p->tableau);
    if (together && nh_dynamics_watched(q->model) && !e->scene->smooth) p->watched = nh_dynamics_create(q->model);
    return together;
}

static void close_plan(plan *p)
{
    nh_free(p->alone);
    nh_free(p->evaluations);
    nh_tape_free(p->values);
    nh_dynamics_free(p->watched);
}

nh_ensemble *nh_ensemble_empty(const nh_trajectory_request *q, size_t members, nh_error *error)
{
    if (members == 0 || q->count == 0)
        return nh_fail(error, NH_USAGE, "", "an ensemble needs at least one member and one output time"), NULL;
    nh_ensemble *e = nh_alloc(sizeof *e);
    *e = (nh_ensemble){.members = members,
                       .count = q->count,
                       .n = q->n,
                       .scene = nh_closed_subsystem_create(q->model, q->n, q->e, 0, NULL)};
    e->time = nh_alloc_array(q->count, sizeof *e->time);
    memcpy(e->time, q->times, q->count * sizeof *e->time);
    e->value = nh_alloc_array(members * q->count, (q->n ? q->n : 1) * sizeof *e->value);
    for (size_t i = 0; i < members * q->count * q->n; i++) e->value[i] = NAN;
    return e;
}

nh_ensemble *nh_ensemble_create(const nh_trajectory_request *q, size_t members, const double *initial, size_t threads,
                                nh_error *error)
{
    nh_ensemble *e = nh_ensemble_empty(q, members, error);
    plan p;
    if (!e) return NULL;
    bool together = open_plan(&p, q, e, initial);
    double begin = nh_clock();
    size_t batches = (members + lanes - 1) / lanes;
    if (together) nh_parallel(batches, threads, do_batch, &p);
    for (size_t i = 0; i < batches; i++) e->evaluations += p.evaluations[i] * lanes;
    go_alone(&p, !together, threads);
    if (nh_interrupted()) count_interrupted(e);
    e->seconds = nh_clock() - begin;
    close_plan(&p);
    return e;
}

nh_ensemble *nh_ensemble_try(const nh_trajectory_request *q, size_t members, const double *initial, double effort,
                             nh_trial *trial)
{
    nh_error ignored = {0};
    plan p;
    double begin = nh_effort(), clock = nh_clock(), reached = q->times[0], span = q->times[q->count - 1] - q->times[0];
    nh_ensemble *e = nh_ensemble_empty(q, members < lanes ? members : lanes, &ignored);
    *trial = (nh_trial){.effort = 0};
    if (!e) return NULL;
    bool together = open_plan(&p, q, e, initial);
    p.begun = begin;
    p.limit = effort;
    p.reached = &reached;
    if (together) do_batch(0, &p);
    trial->members = e->members;
    trial->evaluations = p.evaluations[0] * lanes;
    trial->part = (reached - q->times[0]) / span;
    bool complete = together && reached == q->times[q->count - 1] && !nh_interrupted();
    for (size_t i = 0; i < e->members; i++)
        if (p.alone[i]) trial->left++, unknown_from(&p, i, 0);
    trial->effort = together ? nh_effort() - begin : INFINITY;
    if (complete) e->seconds = nh_clock() - clock, e->evaluations = trial->evaluations;
    close_plan(&p);
    if (complete) return e;
    nh_ensemble_free(e);
    return NULL;
}

void nh_ensemble_free(nh_ensemble *e)
{
    if (!e) return;
    nh_closed_subsystem_free(e->scene);
    nh_free(e->time);
    nh_free(e->value);
    nh_free(e);
}

void nh_ensemble_states(size_t size, const double *z0, size_t members, double spread, uint64_t seed, double *initial)
{
    double *low = nh_alloc_array(2 * size, sizeof *low), *high = low + size;
    for (size_t i = 0; i < size; i++) {
        double reach = spread * fmax(fabs(z0[i]), 1);
        low[i] = z0[i] - reach;
        high[i] = z0[i] + reach;
    }
    nh_sampler *sampler = nh_sampler_create(size, low, high, seed);
    memcpy(initial, z0, size * sizeof *initial);
    for (size_t k = 1; k < members; k++) nh_sampler_next(sampler, initial + k * size);
    nh_sampler_free(sampler);
    nh_free(low);
}
