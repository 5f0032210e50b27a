#include "motion/ensemble_accuracy.h"

#include <gsl/gsl_sort.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"

static const double most_left = 0.05; /* of the members: so many may be computed alone rather than all at a smaller tolerance */
static const double most_step = 1e-5; /* from one tolerance to the next */

typedef struct {
    const nh_trajectory_request *request;
    size_t members, threads, size; /* size: of a state (q, w) */
    const double *initial;
    double eps;
    nh_ensemble_accuracy *out;
    double *off, *estimate; /* per member: the difference of the last two runs, and what it says of the tighter one */
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

/* Has the member come to its end? */
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
        s->off[j] = arrived(a, j) && arrived(b, j) ? nh_accuracy_difference(b->count, b->n, a->value + at, b->value + at, s->request->options->absolute, &which) : INFINITY;
        s->estimate[j] = s->off[j] * pow(ratio, nh_accuracy_exponent);
    }
}

/* `coarse`: the tolerance of the looser run. */
static bool accepted(const search *s, size_t j, double coarse)
{
    double far = s->out->runs > 2 ? nh_accuracy_far : 1;
    return s->estimate[j] < s->eps / 2 && s->off[j] < far * s->eps && s->off[j] < nh_accuracy_amplified * coarse;
}

static size_t left_over(const search *s, double coarse)
{
    size_t left = 0;
    for (size_t j = 0; j < s->members; j++) left += !accepted(s, j, coarse);
    return left;
}

/* The estimate that all but those exceed which may be left over. */
static double usual_estimate(const search *s)
{
    double *sorted = nh_alloc_array(s->members + 1, sizeof *sorted);
    memcpy(sorted, s->estimate, s->members * sizeof *sorted);
    gsl_sort(sorted, 1, s->members);
    double out = sorted[(size_t)((1 - most_left) * (double)(s->members - 1))];
    nh_free(sorted);
    return out;
}

/* The tightest run, from the members' own starts; *coarse: the tolerance of the one that it was compared with. */
static nh_ensemble *tighten(search *s, double *coarse, nh_error *error)
{
    double fine = fmin(fmax(nh_accuracy_first * s->eps, 10 * nh_accuracy_tightest), nh_accuracy_loosest);
    bool clean = false;
    nh_ensemble *a = run(s, fine, true, error);
    s->out->tolerance = fine;
    for (int i = 1; a && i < NH_ACCURACY_RUNS && !nh_interrupted(); i++) {
        *coarse = fine;
        fine = fmax(nh_accuracy_tightest, fine * (i == 1 ? nh_accuracy_step : fmin(nh_accuracy_step, fmax(most_step, pow(s->eps / (4 * usual_estimate(s)), 1.25)))));
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

/* One member by the method and at the tolerance that it needs. */
static void do_alone(search *s, nh_ensemble *e, size_t member, size_t ways, const nh_way *way)
{
    const nh_model *o = s->request->model;
    size_t each = e->count * e->n;
    double *z = nh_alloc_array(2 * o->m, sizeof *z), *target = e->value + member * each;
    nh_dynamics *d = nh_dynamics_create(o);
    nh_motion start = {.count = 1, .size = s->size, .time = (double *)s->request->times, .state = (double *)s->initial + member * s->size};
    nh_state state = {.t = s->request->times[0], .q = z, .v = z + o->m};
    nh_trajectory_request q = *s->request;
    nh_accuracy a = {.held = false};
    nh_error error;
    nh_error_clear(&error);
    memcpy(z, start.state, o->m * sizeof *z);
    q.initial = &state;
    nh_trajectory *t = nh_along(d, &start, o->m, o->rho, z + o->m) ? nh_trajectory_accurate(&q, s->eps, ways, way, &a, &error) : NULL;
    size_t reached = t ? t->motion->count : 0;
    bool before = arrived(e, member);
    for (size_t i = 0; i < each && (reached == e->count || !before); i++) target[i] = i < reached * e->n ? t->value[i] : NAN;
    if (reached == e->count && !before) e->incomplete--;
    if (!a.held && !s->out->unsure++) snprintf(s->out->why, sizeof s->out->why, "member %zu: %.400s", member, t ? a.why : error.what);
    s->out->evaluations += a.evaluations;
    s->out->seconds += a.seconds;
    s->out->alone++;
    nh_trajectory_free(t);
    nh_dynamics_free(d);
    nh_free(z);
}

static void explain(search *s)
{
    nh_ensemble_accuracy *a = s->out;
    char first[sizeof a->why];
    snprintf(first, sizeof first, "%s", a->why);
    if (nh_interrupted()) snprintf(a->why, sizeof a->why, "interrupted before the accuracy %.1e was reached by all members", a->wanted);
    else if (a->unsure) snprintf(a->why, sizeof a->why, "the accuracy %.1e was not reached by %zu of %zu members; %.380s", a->wanted, a->unsure, s->members, first);
    else if (a->alone) snprintf(a->why, sizeof a->why, "in batches at tolerance %.1e, estimated errors at most %.1e, %zu of %zu members alone", a->tolerance, a->estimate, a->alone, s->members);
    else snprintf(a->why, sizeof a->why, "in batches at tolerance %.1e, estimated errors at most %.1e", a->tolerance, a->estimate);
}

nh_ensemble *nh_ensemble_accurate(const nh_trajectory_request *request, size_t members, const double *initial, size_t threads, double eps, size_t ways, const nh_way *way,
                                  nh_ensemble_accuracy *accuracy, nh_error *error)
{
    *accuracy = (nh_ensemble_accuracy){.wanted = eps};
    search s = {.request = request, .members = members, .threads = threads, .size = request->model->m + request->model->n, .initial = initial, .eps = eps, .out = accuracy};
    s.off = nh_alloc_array(2 * members + 1, sizeof *s.off);
    s.estimate = s.off + members;
    for (size_t j = 0; j < members; j++) s.off[j] = s.estimate[j] = INFINITY;
    double coarse = 0;
    nh_ensemble *e = tighten(&s, &coarse, error);
    for (size_t j = 0; e && j < members && !nh_interrupted(); j++) {
        if (accepted(&s, j, coarse)) accuracy->estimate = fmax(accuracy->estimate, s.estimate[j]);
        else do_alone(&s, e, j, ways, way);
    }
    if (e) explain(&s);
    accuracy->held = e && !accuracy->unsure && !nh_interrupted();
    nh_free(s.off);
    return e;
}
