#include "motion/ensemble_accuracy.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/effort.h"
#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "motion/vanishing.h"

/* part of the members that may be computed alone; with more of them the tolerance of all is tightened */
static const double most_left = 0.05;
static const double most_step = 1e-5; /* smallest factor from one tolerance to the next */

static const double passes = 2.3;     /* cost of all runs of an ensemble, relative to that of the first */
static const double slower = 10;      /* a member may take up to this many times the work of the first */
static const double most_told = 1000; /* reports give no larger ratio */
enum { samples = 2 };                 /* members beside the first that are computed alone to measure their cost */

/* A member alone. */
typedef struct {
    bool done, held, reached; /* reached: the end */
    long evaluations;
    double effort, seconds, estimate;
    char why[400];
} loner;

typedef struct {
    const nh_trajectory_request *request;
    nh_trajectory_request own;     /* with the model that the pilot runs derived */
    size_t members, threads, size; /* size: of a state (q, w) */
    const double *initial;
    double eps;
    nh_ensemble_accuracy *out;
    double *floor; /* per member and value: the least scales (accuracy.h) */
    /* per member: the difference of the last two runs, and the estimated error of the tighter one */
    double *off, *estimate;
    nh_integration_plan usual; /* plan of the first member */
    nh_integration_plans ways; /* for members alone: the plan of the first member, or the given plans */
    loner *one;                /* per member */
    size_t *alone;             /* members to be computed alone */
    nh_ensemble *e;
    bool scaled; /* `floor` contains the terms of the first member */
} search;

static nh_ensemble *run(search *s, double tolerance, bool disturb, nh_error *error)
{
    nh_trajectory_request q = *s->request;
    nh_options options = *q.options;
    size_t numbers = s->members * s->size;
    double *start = nh_alloc_array(numbers + 1, sizeof *start);
    if (disturb) nh_accuracy_disturb(numbers, s->initial, start);
    else memcpy(start, s->initial, numbers * sizeof *start);
    options.tolerance = tolerance;
    q.options = &options;
    nh_ensemble *e = nh_ensemble_create(&q, s->members, start, s->threads, error);
    nh_free(start);
    if (!e) return NULL;
    s->out->runs++;
    s->out->evaluations += e->evaluations;
    s->out->seconds += e->seconds;
    return e;
}

/* Has the member reached the end? */
static bool arrived(const nh_ensemble *e, size_t member)
{
    const double *last = e->value + ((member + 1) * e->count - 1) * e->n;
    for (size_t k = 0; k < e->n; k++)
        if (isfinite(last[k])) return true;
    return e->n == 0;
}

static void compare(search *s, const nh_ensemble *a, const nh_ensemble *b, double ratio)
{
    for (size_t j = 0; j < s->members; j++) {
        size_t at = j * b->count * b->n, which = 0;
        s->off[j] = arrived(a, j) && arrived(b, j) ? nh_accuracy_difference(b->count, b->n, a->value + at,
                                                                            b->value + at, s->floor + j * b->n, &which)
                                                   : INFINITY;
        s->estimate[j] = s->off[j] * pow(ratio, nh_accuracy_exponent);
    }
}

/* `coarse`: the tolerance of the looser run. */
static bool accepted(const search *s, size_t j, double coarse)
{
    double far = s->out->runs > 2 ? nh_accuracy_far : nh_accuracy_alike;
    return s->estimate[j] < s->eps / 2 && s->off[j] < far * s->eps && s->off[j] < nh_accuracy_amplified * coarse;
}

static size_t left_over(const search *s, double coarse)
{
    size_t left = 0;
    for (size_t j = 0; j < s->members; j++) left += !accepted(s, j, coarse);
    return left;
}

/* The estimate exceeded only by the part most_left of the members. */
static double usual_estimate(const search *s)
{
    double *sorted = nh_alloc_array(s->members + 1, sizeof *sorted);
    memcpy(sorted, s->estimate, s->members * sizeof *sorted);
    gsl_sort(sorted, 1, s->members);
    double out = sorted[(size_t)((1 - most_left) * (double)(s->members - 1))];
    nh_free(sorted);
    return out;
}

static double first_tolerance(const search *s)
{
    return fmin(fmax(nh_accuracy_first * s->eps, 10 * nh_accuracy_tightest), nh_accuracy_loosest);
}

/* The tightest run, from the members' own starts; *coarse: the tolerance of the one that it was compared with.
   `first`: the first run, where there was one. */
static nh_ensemble *tighten(search *s, nh_ensemble *first, double *coarse, nh_error *error)
{
    double fine = first_tolerance(s);
    bool clean = false;
    nh_ensemble *a = first ? first : run(s, fine, true, error);
    s->out->tolerance = fine;
    for (int i = 1; a && i < NH_ACCURACY_RUNS && !nh_interrupted(); i++) {
        *coarse = fine;
        fine = fmax(
            nh_accuracy_tightest,
            fine * (i == 1 ? nh_accuracy_step
                           : fmin(nh_accuracy_step, fmax(most_step, pow(s->eps / (4 * usual_estimate(s)), 1.25)))));
        nh_ensemble *b = run(s, fine, clean, error);
        if (!b) break;
        compare(s, a, b, fine / *coarse);
        nh_ensemble_free(a);
        a = b;
        s->out->tolerance = fine;
        clean = !clean;
        if ((double)left_over(s, *coarse) <= most_left * (double)s->members || fine <= nh_accuracy_tightest) break;
    }
    if (!a || clean || nh_interrupted()) return a;
    nh_ensemble *b = run(s, fine, false, error);
    if (!b) return a;
    nh_ensemble_free(a);
    return b;
}

/* ---- least scales ---- */

static void find_zeros(search *s)
{
    const nh_trajectory_request *q = s->request;
    nh_vanishing *v = nh_vanishing_create(q->model, q->n, q->e);
    bool *zero = nh_alloc_array(q->n + 1, sizeof *zero);
    for (size_t j = 0; j < s->members; j++) {
        nh_vanishing_test(v, s->initial + j * s->size, zero);
        for (size_t k = 0; k < q->n; k++) s->floor[j * q->n + k] = zero[k] ? INFINITY : 0;
    }
    nh_free(zero);
    nh_vanishing_free(v);
}

/* Floors for sums that may cancel, from the motion of the first member. */
static void share_terms(search *s, const nh_trajectory_request *q, const nh_trajectory *t)
{
    double *terms = nh_alloc_array(q->n + 1, sizeof *terms);
    nh_accuracy_terms(q, t, terms);
    for (size_t j = 0; j < s->members; j++)
        for (size_t k = 0; k < q->n; k++) s->floor[j * q->n + k] = fmax(s->floor[j * q->n + k], terms[k]);
    s->scaled = true;
    nh_free(terms);
}

/* ---- members alone ---- */

/* Computes a member by the method and at the tolerance that it needs, into its place; *a says how.  Where it does not
 * reach the end but the batch did, the values of the batch stay. */
static void compute_alone(search *s, const nh_trajectory_request *request, size_t member,
                          const nh_integration_plans *ways, nh_accuracy *a)
{
    const nh_model *model = request->model;
    nh_ensemble *e = s->e;
    loner *l = &s->one[member];
    size_t each = e->count * e->n;
    double *z = nh_alloc_array(2 * model->m, sizeof *z), *target = e->value + member * each;
    nh_dynamics *d = nh_dynamics_create(model);
    nh_motion start = {.count = 1,
                       .size = s->size,
                       .time = (double *)request->times,
                       .state = (double *)s->initial + member * s->size};
    nh_state state = {.t = request->times[0], .q = z, .v = z + model->m};
    nh_trajectory_request q = *request;
    nh_error error;
    nh_error_clear(&error);
    memcpy(z, start.state, model->m * sizeof *z);
    q.initial = &state;
    nh_trajectory *t = nh_dynamics_velocities(d, start.time[0], start.state, z + model->m)
                           ? nh_trajectory_accurate(&q, s->eps, ways, a, &error)
                           : NULL;
    if (!s->scaled) share_terms(s, &q, t);
    size_t reached = t ? t->motion->count : 0;
    bool before = arrived(e, member);
    for (size_t i = 0; i < each && (reached == e->count || !before); i++)
        target[i] = i < reached * e->n ? t->value[i] : NAN;
    *l = (loner){.done = true,
                 .held = a->held,
                 .reached = reached == e->count,
                 .evaluations = a->evaluations,
                 .effort = a->effort,
                 .seconds = a->seconds,
                 .estimate = a->estimate};
    snprintf(l->why, sizeof l->why, "%.399s", t ? a->why : error.what);
    nh_trajectory_free(t);
    nh_dynamics_free(d);
    nh_free(z);
}

static void do_alone(size_t index, void *context)
{
    search *s = context;
    nh_accuracy a = {.held = false};
    nh_progress("members alone", (double)index / (double)s->members);
    if (s->one[s->alone[index]].done || nh_interrupted()) return;
    nh_trajectory_own own = nh_trajectory_own_create(s->request);
    compute_alone(s, &own.request, s->alone[index], &s->ways, &a);
    nh_trajectory_own_free(&own);
}

/* Computes `n` members of the list; then collects their results in the order of the list. */
static void go_alone(search *s, size_t n)
{
    nh_ensemble_accuracy *out = s->out;
    bool *before = nh_alloc_array(n + 1, sizeof *before);
    for (size_t i = 0; i < n; i++) before[i] = !s->one[s->alone[i]].done && arrived(s->e, s->alone[i]);
    nh_parallel(n, s->threads, do_alone, s);
    for (size_t i = 0; i < n; i++) {
        const loner *l = &s->one[s->alone[i]];
        if (!l->done) continue;
        if (l->reached && !before[i] && s->e->incomplete) s->e->incomplete--;
        if (!l->held && !out->unsure++) snprintf(out->why, sizeof out->why, "member %zu: %.400s", s->alone[i], l->why);
        if (l->held && out->all_alone) out->estimate = fmax(out->estimate, l->estimate);
        out->evaluations += l->evaluations;
        out->seconds += l->seconds;
        out->alone++;
        if (out->all_alone) s->e->alone++, s->e->evaluations += l->evaluations, s->e->seconds += l->seconds;
    }
    nh_free(before);
}

/* ---- together or alone? ---- */

/* Units of effort that a single member needs with the plan of the first member; INFINITY
 * where that plan misses the accuracy. */
static double cost_alone(search *s, const nh_integration_plans *ways)
{
    nh_accuracy a = {.held = false};
    nh_ensemble_accuracy *out = s->out;
    nh_integration_plans all = *ways;
    all.more = (double)(s->members - 1);
    compute_alone(s, s->request, 0, &all, &a);
    if (!a.held || nh_interrupted()) return INFINITY;
    out->way = a.way;
    out->choice = a.choice;
    s->usual = a.way;
    s->usual.effort = slower * a.way.effort;
    s->ways = (nh_integration_plans){.count = 1, .way = &s->usual};
    if (a.way.velocities == NH_OTHER_VELOCITIES && !s->own.other) s->own.other = ways->derive(ways->context, INFINITY);
    double begin = nh_effort();
    size_t n = s->members - 1 < samples ? s->members - 1 : samples;
    for (size_t i = 1; i <= n && !nh_interrupted(); i++) compute_alone(s, s->request, i, &s->ways, &a);
    return n ? (nh_effort() - begin) / (double)n : a.effort;
}

/* Is it cheaper to compute all members alone?  *first: the first run of the ensemble in batches, where one was made to
 * measure its cost. */
static bool cheaper_alone(search *s, double each, nh_ensemble **first)
{
    nh_trajectory_request q = *s->request;
    nh_options options = *q.options;
    double *start = nh_alloc_array(s->members * s->size + 1, sizeof *start), all;
    nh_trial trial;
    nh_accuracy_disturb(s->members * s->size, s->initial, start);
    options.tolerance = first_tolerance(s);
    q.options = &options;
    all = each * (double)(s->members < NH_ENSEMBLE_BATCH ? s->members : NH_ENSEMBLE_BATCH);
    nh_ensemble *e = nh_ensemble_try(&q, s->members, start, all / passes, &trial);
    nh_free(start);
    s->out->evaluations += trial.evaluations;
    double together =
        e ? passes * trial.effort + (double)trial.left * each : passes * trial.effort / fmax(trial.part, 1e-6);
    s->out->ratio = all / together;
    bool whole = e && e->members == s->members && !trial.left;
    if (whole && together < all) {
        *first = e;
        s->out->runs++;
        s->out->seconds += e->seconds;
    } else {
        nh_ensemble_free(e);
    }
    return !(together < all) && !nh_interrupted();
}

static void explain(search *s)
{
    nh_ensemble_accuracy *a = s->out;
    size_t size = sizeof a->why;
    char first[sizeof a->why], how[96] = "";
    snprintf(first, sizeof first, "%s", a->why);
    if (a->all_alone && isnan(a->way.step))
        snprintf(how, sizeof how, "each alone by %s at tolerance %.1e or below", a->way.method->name, a->tolerance);
    else if (a->all_alone)
        snprintf(how, sizeof how, "each alone by %s with steps of %.2g or less", a->way.method->name, a->way.step);
    else snprintf(how, sizeof how, "in batches at tolerance %.1e", a->tolerance);
    if (nh_interrupted())
        snprintf(a->why, size, "interrupted before the accuracy %.1e was reached by all members", a->wanted);
    else if (a->unsure)
        snprintf(a->why, size, "the accuracy %.1e was not reached by %zu of %zu members; %.380s", a->wanted, a->unsure,
                 s->members, first);
    else if (a->alone && !a->all_alone)
        snprintf(a->why, size, "%s, estimated errors at most %.1e, %zu of %zu members alone", how, a->estimate,
                 a->alone, s->members);
    else snprintf(a->why, size, "%s, estimated errors at most %.1e", how, a->estimate);
    size_t used = strlen(a->why);
    if (nh_interrupted() || a->unsure || !(a->ratio > 0)) return;
    if (a->all_alone && 1 / a->ratio > most_told)
        snprintf(a->why + used, size - used, "; in batches they would need more than %g times as much counted work",
                 most_told);
    else if (a->all_alone)
        snprintf(a->why + used, size - used, "; in batches they would need about %.2g times as much counted work",
                 1 / a->ratio);
    else
        snprintf(a->why + used, size - used, "; each alone (%s) would need about %.2g times as much counted work",
                 a->way.method->name, a->ratio);
}

/* Computes the members in batches, and alone those that are not accepted there. */
static nh_ensemble *go_together(search *s, nh_ensemble *first, nh_error *error)
{
    double coarse = 0;
    size_t n = 0;
    for (size_t j = 0; j < s->members; j++) s->out->evaluations += s->one[j].evaluations;
    s->e = tighten(s, first, &coarse, error);
    for (size_t j = 0; s->e && j < s->members && !nh_interrupted(); j++) {
        s->one[j].done = false;
        if (accepted(s, j, coarse)) s->out->estimate = fmax(s->out->estimate, s->estimate[j]);
        else s->alone[n++] = j;
    }
    if (n) go_alone(s, n);
    return s->e;
}

static nh_ensemble *go_each(search *s)
{
    s->out->tolerance = s->out->way.tolerance;
    s->e->incomplete = s->members;
    for (size_t j = 0; j < s->members; j++) s->alone[j] = j;
    go_alone(s, s->members);
    if (s->e->incomplete)
        snprintf(s->e->note, sizeof s->e->note, "%.200s", nh_interrupted() ? "interrupted" : s->out->why);
    return s->e;
}

nh_ensemble *nh_ensemble_accurate(const nh_trajectory_request *request, size_t members, const double *initial,
                                  size_t threads, double eps, const nh_integration_plans *ways,
                                  nh_ensemble_accuracy *accuracy, nh_error *error)
{
    static const nh_integration_plans none = {.count = 0};
    if (!ways) ways = &none;
    *accuracy = (nh_ensemble_accuracy){.wanted = eps};
    search s = {.own = *request,
                .members = members,
                .threads = threads,
                .size = request->model->m + request->model->n,
                .initial = initial,
                .eps = eps,
                .out = accuracy};
    s.request = &s.own;
    s.ways = (nh_integration_plans){.count = ways->count, .way = ways->way};
    s.e = nh_ensemble_empty(request, members, error);
    if (!s.e) return NULL;
    s.off = nh_alloc_array(2 * members + 1, sizeof *s.off);
    s.estimate = s.off + members;
    s.floor = nh_alloc_array(members * request->n + 1, sizeof *s.floor);
    find_zeros(&s);
    s.one = nh_alloc_array(members, sizeof *s.one);
    s.alone = nh_alloc_array(members, sizeof *s.alone);
    for (size_t j = 0; j < members; j++) s.off[j] = s.estimate[j] = INFINITY;
    nh_ensemble *first = NULL;
    double each = cost_alone(&s, ways);
    accuracy->all_alone = isfinite(each) && cheaper_alone(&s, each, &first);
    if (!accuracy->all_alone) nh_ensemble_free(s.e);
    nh_ensemble *e = accuracy->all_alone ? go_each(&s) : go_together(&s, first, error);
    if (e) explain(&s);
    accuracy->held = e && !accuracy->unsure && !nh_interrupted();
    nh_free(s.off);
    nh_free(s.floor);
    nh_free(s.one);
    nh_free(s.alone);
    return e;
}
