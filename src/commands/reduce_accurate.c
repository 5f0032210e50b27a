/* reduce_accurate: the full motion with which reduced ones are compared, where an accuracy is requested.
 *
 * accuracy.h chooses its method, equations and tolerance.  Here the distance of places decides (reduce_full.c), which
 * is another norm: so the motion is computed once more with a much smaller tolerance, and is accepted where that moves
 * it by less than a quarter of the requested accuracy.  The finer of the two is the reference. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"
#include "motion/accuracy.h"
#include "commands/reduce_internal.h"

enum { most_attempts = 4 };
/* parts of the requested accuracy: for the full motion; for the tolerance of the check */
static const double share = 0.25, finer = 0.03, tightest = 1e-14;

/* Repeats the motion t with its method and equations.  The tolerance is `part` times as large; where the step is fixed,
 * the error of a step is. */
static nh_trajectory *once_more(const nh_trajectory_request *request, const nh_trajectory *t, const nh_accuracy *a,
                                double part)
{
    nh_trajectory_request q = *request;
    nh_options options = *q.options;
    nh_error ignored = {0};
    q.method = nh_method_find(t->method);
    q.velocities = strstr(t->formulation, "all coordinates") ? NH_ALL_COORDINATES : NH_OWN_VELOCITIES;
    q.options = &options;
    if (isnan(a->step)) options.tolerance = a->tolerance * part;
    else q.step = a->step * pow(part, 1.0 / q.method->order);
    nh_trajectory *out = nh_trajectory_create(&q, &ignored);
    nh_error_clear(&ignored);
    return out;
}

/* Where the tolerance cannot be smaller, a larger one measures the error, too. */
static double part_of(const nh_accuracy *a) { return isnan(a->step) && a->tolerance * finer < tightest ? 3 : finer; }

/* A quick motion is timed twice, and the smaller time is taken. */
static void time_again(const nh_trajectory_request *request, const nh_trajectory *t, const nh_accuracy *a,
                       nh_reduction_choice *c)
{
    static const double quick = 0.02;
    if (!(c->seconds < quick)) return;
    nh_trajectory *other = once_more(request, t, a, 1);
    if (other && other->motion->complete) c->seconds = fmin(c->seconds, other->motion->seconds);
    nh_trajectory_free(other);
}

static void explain(nh_reduction *r, const nh_accuracy *a)
{
    nh_reduction_choice *c = &r->full;
    const char *from = strchr(a->why, ';');
    char setting[60];
    if (isnan(c->step)) snprintf(setting, sizeof setting, "tolerance %.1e", c->tolerance);
    else snprintf(setting, sizeof setting, "steps of %.2g", c->step);
    if (c->held)
        snprintf(c->why, sizeof c->why, "%s at %s: error %.1e, measured against a tighter run%.300s", c->method,
                 setting, c->error, from ? from : "");
    else
        snprintf(c->why, sizeof c->why,
                 "the full motion is not known to %.1e: %s at %s is %.1e from a run at another tolerance",
                 share * r->wanted, c->method, setting, c->error);
}

/* Takes the finer of the two motions of one attempt as the reference. */
static void take(nh_reduction_bench *b, const nh_trajectory_request *request, const nh_trajectory *t,
                 const nh_trajectory *other, const nh_accuracy *a)
{
    nh_reduction *r = b->r;
    size_t m = r->kinetic->m;
    nh_reduction_choice *c = &r->full;
    int runs = c->runs;
    *c = (nh_reduction_choice){.method = t->method,
                               .tolerance = a->tolerance,
                               .step = a->step,
                               .evaluations = t->motion->evaluations,
                               .effort = t->motion->effort,
                               .seconds = t->motion->seconds,
                               .times = NAN,
                               .runs = runs};
    r->full_formulation = t->formulation;
    b->reached = nh_reduction_reliable(r->kinetic, NH_REDUCTION_OUTPUTS, t->value, m, other->value, m,
                                       share * r->wanted, &c->error);
    c->held = b->reached == NH_REDUCTION_OUTPUTS;
    memcpy(b->full, part_of(a) < 1 ? other->value : t->value, NH_REDUCTION_OUTPUTS * m * sizeof *b->full);
    if (c->held) time_again(request, t, a, c);
    explain(r, a);
}

static bool complete(const nh_trajectory *t) { return t && t->motion->complete; }

/* Reduces the error until the distance is small enough; false when there is no motion to the end. */
static bool attempts(nh_reduction_bench *b, const nh_trajectory_request *request)
{
    nh_reduction *r = b->r;
    double eps = share * r->wanted;
    bool some = false;
    nh_integration_plans ways = {.pilot = true};
    for (int i = 0; i < most_attempts && !r->full.held && !nh_interrupted(); i++) {
        nh_error trouble = {0};
        nh_accuracy a;
        nh_trajectory *t = nh_trajectory_accurate(request, eps, &ways, &a, &trouble),
                      *other = complete(t) ? once_more(request, t, &a, part_of(&a)) : NULL;
        r->full.runs += a.runs + 1;
        if (complete(other)) take(b, request, t, other, &a);
        else if (!some)
            snprintf(r->full.why, sizeof r->full.why, "%.400s",
                     !t             ? trouble.what
                     : !complete(t) ? t->motion->note
                     : other        ? other->motion->note
                                    : "a tighter motion could not be computed");
        some |= complete(other);
        eps = fmax(eps * fmax(fmin(share * r->wanted / (4 * r->full.error), 0.1), 1e-4), 1e-13);
        bool last = !complete(other) || (isnan(a.step) && a.tolerance <= 2 * tightest);
        nh_trajectory_free(t);
        nh_trajectory_free(other);
        nh_error_clear(&trouble);
        if (last) break;
    }
    return some;
}

bool nh_reduction_full_accurate(nh_reduction_bench *b)
{
    /* part of the requested accuracy: the tolerance of motions without a choice of method */
    static const double part = 1e-3, least = 5e-14;
    nh_reduction *r = b->r;
    nh_error trouble = {0};
    r->full = (nh_reduction_choice){.step = NAN, .times = NAN};
    if (!nh_reduction_whole_model(r, &trouble)) {
        snprintf(r->full.why, sizeof r->full.why, "%.400s", trouble.what);
        nh_error_clear(&trouble);
        return false;
    }
    size_t m = r->kinetic->m;
    nh_options options = r->options;
    options.steps = fmin(options.steps, NH_REDUCTION_STEPS);
    options.compile = 0; /* reduced motions are interpreted: so their times are comparable */
    nh_ex *place = nh_arena_alloc(r->arena, m * sizeof *place);
    for (size_t s = 0; s < m; s++) place[s] = r->whole->system->coordinate[s].q;
    nh_trajectory_request request = {.model = r->whole,
                                     .initial = &r->initial,
                                     .count = NH_REDUCTION_OUTPUTS,
                                     .times = b->times,
                                     .options = &options,
                                     .n = m,
                                     .e = place};
    b->full = nh_arena_alloc(r->arena, NH_REDUCTION_OUTPUTS * m * sizeof *b->full);
    if (!attempts(b, &request)) {
        b->full = NULL;
        return false;
    }
    b->rtol = fmax(part * r->wanted, least);
    r->full_seconds = r->full.seconds;
    r->full_reached = b->times[b->reached ? b->reached - 1 : 0];
    if (!r->full.held) nh_reduction_warn(r, "%s; it is accurate up to t = %.4g", r->full.why, r->full_reached);
    return true;
}
