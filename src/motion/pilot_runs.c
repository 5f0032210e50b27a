/* Methods measured on a piece of a motion (pilot_runs.h), with a budget of counted work.
 *
 *      1. the piece       from a state on the way; so long that the best known method takes a share of the budget
 *      2. a reference     by the best method, far tighter than the error that is aimed at on the piece
 *      3. each candidate, in a fixed order, while the budget lasts:
 *             a first run at a guessed setting -> its error -> a second one at the setting that this error asks for
 *             stopped at twice the work of the best so far
 *      4. the choice      the cheapest with an error below the aim, its confirmation included, if it saves enough */
#include "motion/pilot_runs.h"

#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/effort.h"
#include "base/progress.h"
#include "motion/accuracy_measure.h"

enum { least_outputs = 9, most_outputs = 1000, most_runs = 3 };
/* length of the piece: the part of the budget that the best known plan takes for it; its largest part of the motion */
static const double share = 1.0 / 16, most_part = 0.25;
/* a run is stopped at so many times the work of the best so far, but not below least_effort */
static const double patience = 2, least_effort = 2e5;
/* error of the reference, as a part of the error that is aimed at; its least tolerance with CVODE */
static const double finer = 1e-2, finest_stiff = 1e-13;
static const double least_error = 3e-14; /* smallest error that can be aimed at */
/* an error below the aim by at most this factor is good: no further run */
static const double close = 30;
static const double safety = 3; /* further runs aim at the error divided by this */
/* units of a motion for which the functions of methods with fixed steps are worth deriving */
static const double long_motion = 1e9;

/* another plan than the best so far is chosen when it costs at most this part of it */
static const double gain = 0.7;

typedef struct {
    const char *method;
    nh_velocities velocities;
} candidate;

/* In the order in which they are tried: the last ones, which a short budget leaves out, are seldom the cheapest. */
static const candidate candidates[] = {
    {"GSL rk8pd", NH_OWN_VELOCITIES},           {"CVODE BDF", NH_OWN_VELOCITIES},
    {"ARKODE ESDIRK", NH_OWN_VELOCITIES},       {"CVODE Adams", NH_OWN_VELOCITIES},
    {"GSL rk8pd", NH_OTHER_VELOCITIES},         {"GSL rkf45", NH_OWN_VELOCITIES},
    {"ARKODE Verner", NH_OWN_VELOCITIES},       {"GSL rk8pd", NH_ALL_COORDINATES},
    {"ARKODE Fehlberg", NH_OWN_VELOCITIES},     {"CVODE BDF", NH_OTHER_VELOCITIES},
    {"CVODE Adams", NH_OTHER_VELOCITIES},       {"ARKODE Dormand-Prince", NH_OWN_VELOCITIES},
    {"relaxation, order 8", NH_OWN_VELOCITIES}, {"CVODE BDF", NH_ALL_COORDINATES},
    {"CVODE Adams", NH_ALL_COORDINATES},        {"GSL msadams", NH_OWN_VELOCITIES},
    {"ARKODE ESDIRK", NH_OTHER_VELOCITIES}};

typedef struct {
    const nh_trajectory_request *request;
    const nh_pilot_runs_terms *terms;
    nh_pilot_runs *out;
    nh_trajectory_request piece;
    nh_options options;
    nh_programs *programs;
    nh_trajectory *reference;
    double begun, length, whole, aim; /* aim: the error on the piece that becomes eps on the whole motion */
    double best;                      /* units for the piece, of the cheapest run that reached the aim */
    long steps;                       /* of the reference */
} pilot;

static double left(const pilot *s) { return s->begun + s->terms->budget - nh_effort(); }

/* One run of the piece with at most so much effort; NULL where it did not reach the end. */
static nh_trajectory *run(pilot *s, const nh_method *method, nh_velocities velocities, double setting, double effort)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    s->piece.method = method;
    s->piece.velocities = velocities;
    s->piece.programs = method->order ? s->programs : NULL;
    s->piece.step = method->order ? setting : 0;
    if (!method->order) s->options.tolerance = setting;
    s->piece.max_effort = fmax(fmin(effort, left(s)), 1);
    nh_trajectory *t = nh_trajectory_create(&s->piece, &ignored);
    if (t) s->out->evaluations += t->motion->evaluations;
    /* they could not be used */
    bool other = t && velocities == NH_OTHER_VELOCITIES && !strcmp(t->formulation, NH_ON_SUBMANIFOLD);
    if (t && t->motion->complete && !other && !nh_interrupted()) return t;
    nh_trajectory_free(t);
    return NULL;
}

/* The error of a run relative to the reference. */
static double error_of(const pilot *s, const nh_trajectory *t)
{
    size_t which;
    return nh_accuracy_difference(s->piece.count, s->piece.n, s->reference->value, t->value, s->terms->floor, &which);
}

/* Runs one method in some velocities, at the setting that its first run asks for. */
static void try_way(pilot *s, const nh_method *method, nh_velocities velocities)
{
    nh_integration_plan w = {.method = method, .velocities = velocities, .tolerance = NAN, .step = NAN};
    double setting = method->order ? s->length / (double)(s->steps + 1) : fmin(s->aim, nh_accuracy_loosest);
    double spacing = s->length / (double)(s->piece.count - 1);
    s->out->tried++;
    for (int i = 0; i < most_runs && s->out->count < NH_PILOT_RUNS_WAYS; i++) {
        if (method->order) setting = spacing / ceil(spacing / setting * (1 - 1e-9)); /* steps end at the outputs */
        nh_trajectory *t = run(s, method, velocities, setting, fmax(patience * s->best, least_effort));
        if (!t) return;
        *(method->order ? &w.step : &w.tolerance) = setting;
        double error = fmax(error_of(s, t), s->aim * finer), effort = fmax(t->motion->effort, 1);
        nh_trajectory_free(t);
        if (!isfinite(error)) return;
        w.error = error * s->whole / s->length;
        w.effort = effort / s->length;
        if (w.error < 1) s->out->way[s->out->count++] = w;
        if (error < s->aim) s->best = fmin(s->best, effort);
        if (error < s->aim && error > s->aim / close) return;
        double next = nh_integration_plan_setting(&w, s->terms->eps / safety);
        setting = method->order ? fmin(next, spacing) : fmax(nh_accuracy_tightest, fmin(next, nh_accuracy_loosest));
    }
}

static bool open_piece(pilot *s, const nh_state *from, double **times)
{
    const nh_trajectory_request *q = s->request;
    double begin = q->times[0], end = q->times[q->count - 1],
           part = fmin(most_part, share * s->terms->budget / s->terms->effort);
    s->whole = fabs(end - begin);
    s->length = fmin(part * s->whole, fabs(end - from->t));
    double wanted = s->length * (double)q->count / s->whole;
    size_t count = (size_t)fmax(least_outputs, fmin(most_outputs, wanted));
    if (!(s->length > 1e-12 * fmax(fabs(begin), fabs(end)))) return false;
    *times = nh_alloc_array(count, sizeof **times);
    for (size_t i = 0; i < count; i++)
        (*times)[i] = from->t + copysign(s->length, end - begin) * (double)i / (double)(count - 1);
    s->options = *q->options;
    s->piece = *q;
    s->piece.initial = from;
    s->piece.count = count;
    s->piece.times = *times;
    s->piece.options = &s->options;
    s->piece.project = true; /* a state on the way violates the constraints by the error of the motion */
    s->aim = fmax(least_error, s->terms->eps * s->length / s->whole);
    s->out->part = s->length / s->whole;
    return true;
}

/* May the method be used with this model? */
static bool usable(pilot *s, const candidate *c, const nh_method *method)
{
    bool plain = s->terms->plain || s->request->smallest;
    if (plain && (method->order || c->velocities != NH_OWN_VELOCITIES)) return false;
    if (c->velocities == NH_OTHER_VELOCITIES && !s->request->other) return false;
    if (c->velocities == NH_ALL_COORDINATES && !nh_may_leave_chart(s->request->model)) return false;
    if (!method->order) return true;
    if (s->terms->effort < long_motion) return false;
    if (!s->programs) s->programs = nh_programs_create(s->request->model);
    return !nh_method_refused(method, s->programs);
}

static void try_all(pilot *s)
{
    const nh_method *best = s->terms->best;
    double finest = best->family == NH_METHOD_CVODE ? finest_stiff : nh_accuracy_tightest;
    s->reference =
        run(s, best, NH_OWN_VELOCITIES, fmax(finest, fmin(s->aim, nh_accuracy_loosest) * finer), s->terms->budget / 2);
    if (!s->reference) return;
    s->steps = s->reference->motion->steps;
    s->best = INFINITY;
    try_way(s, best, NH_OWN_VELOCITIES);
    s->best = fmin(s->best, s->reference->motion->effort);
    for (size_t i = 0; i < sizeof candidates / sizeof *candidates && left(s) > 0 && !nh_interrupted(); i++) {
        const nh_method *method = nh_method_find(candidates[i].method);
        bool first = method == best && candidates[i].velocities == NH_OWN_VELOCITIES;
        if (!first && usable(s, &candidates[i], method)) try_way(s, method, candidates[i].velocities);
    }
    nh_trajectory_free(s->reference);
    nh_programs_free(s->programs);
}

void nh_pilot_runs_make(const nh_trajectory_request *request, const nh_state *from, const nh_pilot_runs_terms *terms,
                        nh_pilot_runs *out)
{
    pilot s = {.request = request, .terms = terms, .out = out, .begun = nh_effort()};
    double begun = nh_clock();
    double *times = NULL;
    *out = (nh_pilot_runs){.count = 0};
    if (open_piece(&s, from, &times)) try_all(&s);
    nh_free(times);
    out->effort = nh_effort() - s.begun;
    out->seconds = nh_clock() - begun;
}

/* ---- the choice ---- */

/* The cheapest run of a method in the model's own velocities, or NULL. */
static const nh_integration_plan *way_of(const nh_pilot_runs *s, const nh_method *method, double eps)
{
    const nh_integration_plan *best = NULL;
    for (size_t i = 0; i < s->count; i++) {
        const nh_integration_plan *w = &s->way[i];
        if (w->method == method && w->velocities == NH_OWN_VELOCITIES && w->error < eps &&
            (!best || w->effort < best->effort))
            best = w;
    }
    return best;
}

nh_integration_plan_choice nh_pilot_runs_choose(const nh_pilot_runs *s, const nh_method *best, double eps,
                                                const nh_integration_plan_limits *limits, bool done)
{
    const nh_integration_plan *own = way_of(s, best, eps);
    nh_integration_plan_choice choice = nh_integration_plan_cheapest(s->count, s->way, eps, limits);
    if (!choice.way || !own) return choice;
    double cost = nh_integration_plan_cost(s->count, s->way, eps, choice.way),
           whole = nh_integration_plan_cost(s->count, s->way, eps, own);
    if (cost < gain * (whole - (done ? own->effort : 0))) return choice;
    if (choice.way->method != best) choice.next = fmax(1, cost / whole); /* so small a difference does not count */
    choice.way = done ? NULL : own;
    return choice;
}
