/* A motion with an estimated error below eps (accuracy.h): which method, and at which tolerance.
 *
 *      take_given     a plan that is known from motions like this one          |
 *      choose         race: rk8pd up to `quick`, else CVODE BDF where that     |  first run at tau_1
 *                     needs `faster` times less; then pilot runs of others     |
 *                                                                              v
 *      tighten        run 1    run 2    run 3 ..                   tau_1 > tau_2 > tau_3 ..
 *                         \    /   \    /                          odd runs from a state perturbed by 1 part in 10^15
 *                          d_1      d_2                            differences at the outputs, the largest
 *
 *                     exponent p = log(d_1/d_2)/log(tau_1/tau_2)   within [0.2, 0.9]
 *                     estimate   = d (tau_fine/tau_coarse)^p       accepted below eps/2
 *
 *      confirm        where it is doubtful: a second method at tighter and tighter tolerances, until it agrees to eps
 *
 *      the motion     from the unperturbed state
 *
 * Of methods with fixed steps the tolerance stands for the number n of steps between outputs, and ratios of errors
 * are (n_1/n_2)^order. All limits are counted work (base/effort.h). A plan that comes from elsewhere and fails here
 * is dropped, and the motion computed without it. */
#include "motion/accuracy_internal.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"

enum { most_confirmations = 5 };
static const char *const explicit_pair[2] = {"GSL rk8pd", "ARKODE Fehlberg"}, *const implicit_pair[2] = {
                                                                                  "CVODE BDF", "ARKODE ESDIRK"};
static const double loosest = nh_accuracy_loosest, tightest = nh_accuracy_tightest, step = nh_accuracy_step;
/* range of the measured exponent with which the differences of runs fall */
static const double least_exponent = 0.2, most_exponent = 0.9;
/* Units of base/effort.h.  A first run above `quick` is compared with CVODE BDF, which takes over where it needs
 * `faster` times less work. */
static const double quick = 1e8, faster = 20;
/* the work of a first run, as a multiple of the measured work; `quick` is always allowed */
static const double patience = 10;
/* other methods are measured for a motion that needs so much work by the method of the first run, */
static const double worthwhile = 5e7;
static const double pilot_share = 0.25; /* and they may take so large a part of that work */
/* with more motions like this one: the least work of one motion that is worth measuring, and how many of them count */
static const double shortest = 5e5, most_times = 16;
static const double more_steps = 0.8; /* greatest (n1/n2)^order from one number n1 of fixed steps to the next, n2 */

/* The length of the motion. */
static double span_of(const nh_trajectory_request *q) { return fabs(q->times[q->count - 1] - q->times[0]); }

/* The longest time between outputs. */
static double spacing_of(const nh_trajectory_request *q)
{
    double longest = 0;
    for (size_t i = 1; i < q->count; i++) longest = fmax(longest, fabs(q->times[i] - q->times[i - 1]));
    return longest;
}

/* Has the plan's method fixed steps? */
static bool fixed(const nh_accuracy_search *s) { return s->way && s->way->method->order; }

/* The number of steps between two outputs, of a method with fixed steps, whose steps end at the outputs. */
static double steps_at(const nh_accuracy_search *s, double tolerance)
{
    return fmax(1, ceil(spacing_of(s->request) / nh_integration_plan_setting(s->way, tolerance) * (1 - 1e-9)));
}

/* The factor by which the errors of a run fall: the ratio of the tolerances, or that of the steps to the order of the
 * method. */
static double ratio_of(const nh_accuracy_search *s, double coarse, double fine)
{
    return fixed(s) ? pow(steps_at(s, coarse) / steps_at(s, fine), s->way->method->order) : fine / coarse;
}

/* The next tolerance; of a method with fixed steps one that gives more steps. */
static double tighter(const nh_accuracy_search *s, double coarse, double part)
{
    double fine = fmax(tightest, coarse * part);
    while (fixed(s) && fine > tightest && ratio_of(s, coarse, fine) > more_steps) fine = fmax(tightest, fine * step);
    return fine;
}

/* The initial state, slightly perturbed. */
static nh_state disturbed(const nh_trajectory_request *q, double *q_and_v)
{
    size_t m = q->model->m;
    nh_state out = *q->initial;
    memcpy(q_and_v, out.q, m * sizeof *q_and_v);
    memcpy(q_and_v + m, out.v, m * sizeof *q_and_v);
    nh_accuracy_disturb(2 * m, q_and_v, q_and_v);
    out.q = q_and_v;
    out.v = q_and_v + m;
    return out;
}

/* One motion at one tolerance, with at most so many units of effort (0: no limit), which are added up; NULL where it
 * could not begin. */
static nh_trajectory *run(nh_accuracy_search *s, const nh_method *method, double tolerance, bool disturb,
                          double max_effort, nh_error *error)
{
    nh_trajectory_request q = *s->request;
    nh_options options = *q.options;
    double *work = nh_alloc_array(2 * q.model->m, sizeof *work);
    nh_state start = disturbed(&q, work);
    if (disturb) q.initial = &start;
    options.tolerance = tolerance;
    q.options = &options;
    q.method = method;
    q.max_effort = max_effort;
    if (s->way && method == s->way->method) {
        q.velocities = s->way->velocities;
        q.programs = s->programs;
        if (fixed(s)) q.step = spacing_of(&q) / steps_at(s, tolerance);
    }
    nh_trajectory *t = nh_trajectory_create(&q, error);
    nh_free(work);
    s->out->runs++;
    if (t) {
        s->out->evaluations += t->motion->evaluations;
        s->out->effort += t->motion->effort;
        s->out->seconds += t->motion->seconds;
    }
    if (t && t->motion->complete && !s->measured_terms)
        nh_accuracy_terms(s->request, t, s->floor), s->measured_terms = true;
    return t;
}

/* The difference of two motions; INFINITY when one of them did not reach its end. */
static double difference(const nh_accuracy_search *s, const nh_trajectory *a, const nh_trajectory *b)
{
    if (!a || !b || !a->motion->complete || !b->motion->complete) return INFINITY;
    return nh_accuracy_difference(a->motion->count, s->request->n, a->value, b->value, s->floor, &s->out->quantity);
}

static double between(double x, double low, double high) { return fmax(low, fmin(high, x)); }

static void take(nh_accuracy_search *s, const char *const pair[2])
{
    for (int i = 0; i < 2; i++) s->method[i] = nh_method_find(pair[i]);
}

static bool complete(const nh_trajectory *t) { return t && t->motion->complete; }

/* Units that a run would have needed to reach its end. */
static double whole(const nh_trajectory_request *q, const nh_trajectory *t)
{
    double begin = q->times[0], done = t ? (t->motion->end_time - begin) / (q->times[q->count - 1] - begin) : 0;
    return t ? t->motion->effort / fmax(done, 1e-6) : INFINITY;
}

/* After an interruption: the run that came farther. */
static nh_trajectory *farther(nh_trajectory *a, nh_trajectory *b)
{
    bool first = a && (!b || a->motion->count >= b->motion->count);
    nh_trajectory_free(first ? b : a);
    return first ? a : b;
}

/* The method that confirms another one when no second one was measured.  It is of the same kind, because a motion that
 * is stiff for one explicit method is stiff for all. */
static const nh_method *other_of(const nh_method *method)
{
    bool implicit = method->family == NH_METHOD_CVODE || method == nh_method_find(implicit_pair[1]);
    const char *const *pair = implicit ? implicit_pair : explicit_pair;
    return nh_method_find(pair[method == nh_method_find(pair[0])]);
}

/* The first run of an integration plan; NULL when it does not reach the end with so much effort. */
static nh_trajectory *take_way(nh_accuracy_search *s, const nh_integration_plan_choice *choice, double effort,
                               double *tolerance)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    s->way = choice->way;
    s->method[0] = choice->way->method;
    s->method[1] = choice->second ? choice->second : other_of(s->method[0]);
    if (fixed(s) && !s->programs) s->programs = nh_programs_create(s->request->model);
    if (fixed(s) && nh_method_refused(s->method[0], s->programs)) return NULL;
    double setting = fixed(s) ? s->eps : between(nh_integration_plan_setting(s->way, s->eps), 10 * tightest, loosest);
    nh_trajectory *t = run(s, s->method[0], setting, true, effort, &ignored);
    if (complete(t) || (t && nh_interrupted())) {
        s->doubtful = nh_integration_plan_doubtful(s->method[0]);
        s->out->measured = true;
        s->out->other = choice->other ? choice->other->method : NULL;
        s->out->next = choice->next;
        *tolerance = setting;
        return t;
    }
    nh_trajectory_free(t);
    return NULL;
}

static nh_integration_plan_limits limits_of(const nh_accuracy_search *s)
{
    return (nh_integration_plan_limits){
        .scene = s->request->smallest, .other = s->request->other != NULL, .spacing = spacing_of(s->request)};
}

/* The run of a given plan; NULL when none was given, or it does not reach the end with about the work that it needed
 * when it was measured. */
static nh_trajectory *take_given(nh_accuracy_search *s, double *tolerance)
{
    nh_integration_plan_limits limits = limits_of(s);
    nh_integration_plan_choice choice = nh_integration_plan_cheapest(s->ways->count, s->ways->way, s->eps, &limits);
    if (!choice.way) return NULL;
    s->out->choice = NH_CHOICE_GIVEN;
    return take_way(s, &choice, fmax(quick, patience * choice.way->effort * span_of(s->request)), tolerance);
}

/* Chooses the pair of methods, and makes the first run: by the explicit pair, and where that does not reach the end
 * within `quick`, by the implicit pair with far less work.  Where neither reaches the end the explicit pair is used. */
static nh_trajectory *race(nh_accuracy_search *s, double tolerance)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    take(s, explicit_pair);
    nh_trajectory *t = run(s, s->method[0], tolerance, true, quick, &ignored);
    s->stopped = t && !complete(t) && t->motion->effort > quick;
    if (complete(t) || (t && nh_interrupted())) return t;
    take(s, implicit_pair);
    nh_trajectory *other =
        run(s, s->method[0], tolerance, true, between(whole(s->request, t) / faster, 1e6, 1e15), &ignored);
    s->doubtful = complete(other); /* implicit methods can damp what grows: another method always confirms them */
    if (s->doubtful || nh_interrupted()) return farther(other, t);
    nh_trajectory_free(other);
    take(s, explicit_pair);
    return t;
}

/* A state in the middle of the computed part, from which a piece is typical of the whole motion. q_and_v: 2m values. */
static nh_state state_on_the_way(const nh_accuracy_search *s, const nh_trajectory *t, double *q_and_v)
{
    const nh_model *model = s->request->model;
    nh_motion *m = t->motion;
    size_t middle = m->count / 2;
    nh_state at = *s->request->initial;
    nh_motion one = {.count = 1,
                     .size = m->size,
                     .time = m->complete ? m->time + middle : &m->end_time,
                     .state = m->complete ? m->state + middle * m->size : m->end_state};
    if (t->scene) return at;
    nh_dynamics *d = nh_dynamics_create(model);
    bool good = nh_states_in_coordinates(d, &one, q_and_v);
    for (size_t i = 0; i < 2 * model->m; i++) good = good && isfinite(q_and_v[i]);
    nh_dynamics_free(d);
    return good ? (nh_state){.t = one.time[0], .q = q_and_v, .v = q_and_v + model->m} : at;
}

/* Measures other methods on a piece of the motion of the first run, t; returns the first run of one that saves work, or
 * NULL. */
static nh_trajectory *take_surveyed(nh_accuracy_search *s, const nh_trajectory *t, double *tolerance)
{
    if (!s->ways->pilot || !t || !(complete(t) || s->stopped)) return NULL;
    s->first = whole(s->request, t);
    if (s->first * (1 + s->ways->more) < worthwhile || s->first < shortest)
        return s->out->choice = NH_CHOICE_SHORT, NULL;
    double *work = nh_alloc_array(2 * s->request->model->m + 1, sizeof *work);
    nh_state at = state_on_the_way(s, t, work);
    nh_pilot_runs_terms terms = {.eps = s->eps,
                                 .best = s->method[0],
                                 .effort = s->first,
                                 .budget = pilot_share * s->first * between(s->ways->more, 1, most_times),
                                 .plain = s->ways->plain,
                                 .floor = s->floor};
    const nh_model *other = s->ways->derive && !s->ways->plain && !s->request->smallest
                                ? s->ways->derive(s->ways->context, terms.budget)
                                : NULL;
    if (other) s->own.other = other;
    nh_pilot_runs_make(s->request, &at, &terms, &s->pilot);
    nh_free(work);
    s->out->choice = NH_CHOICE_PILOT;
    s->out->evaluations += s->pilot.evaluations;
    s->out->effort += s->pilot.effort;
    s->out->seconds += s->pilot.seconds;
    nh_integration_plan_limits limits = limits_of(s);
    nh_integration_plan_choice choice =
        nh_pilot_runs_choose(&s->pilot, s->method[0], s->eps, &limits, complete(t) && !(s->ways->more > 0));
    if (!choice.way || nh_interrupted()) return NULL;
    const nh_method *winner[2] = {s->method[0], s->method[1]};
    nh_trajectory *found = take_way(
        s, &choice, fmax(quick, fmin(2 * s->first, patience * choice.way->effort * span_of(s->request))), tolerance);
    if (!found) s->way = NULL, s->method[0] = winner[0], s->method[1] = winner[1];
    return found;
}

/* Where no plan was given: chooses the pair of methods, and returns the first run. */
static nh_trajectory *choose(nh_accuracy_search *s, double *tolerance, nh_error *error)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    s->way = NULL;
    s->out->choice = NH_CHOICE_RACE;
    nh_trajectory *t = race(s, *tolerance);
    if (t && nh_interrupted()) return t;
    nh_trajectory *other = take_surveyed(s, t, tolerance);
    if (!other && complete(t)) return t;
    if (!other) other = run(s, s->method[0], *tolerance, true, 0, t ? &ignored : error);
    if (other && !nh_interrupted()) {
        nh_trajectory_free(t);
        return other;
    }
    return farther(other, t);
}

/* The motion from the unperturbed initial state, where it can be computed. */
static nh_trajectory *undisturbed(nh_accuracy_search *s, nh_trajectory *a)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_trajectory *b = run(s, s->method[0], s->out->tolerance, false, 0, &ignored);
    if (!b || nh_interrupted()) return farther(a, b);
    s->out->estimate = fmax(s->out->estimate, difference(s, a, b));
    nh_trajectory_free(a);
    return b;
}

/* Tightens the tolerance until the estimate is below eps/2; returns the last trajectory. */
static nh_trajectory *tighten(nh_accuracy_search *s, nh_error *error)
{
    double eps = s->eps, coarse = between(nh_accuracy_first * eps, 10 * tightest, loosest), last_difference = 0,
           last_ratio = 0, exponent = nh_accuracy_exponent;
    nh_trajectory *a = take_given(s, &coarse);
    if (!a) a = choose(s, &coarse, error);
    double fine = tighter(s, coarse, step);
    nh_error ignored;
    nh_error_clear(&ignored);
    bool clean = false;
    s->out->tolerance = coarse;
    for (int i = 1; complete(a) && i < NH_ACCURACY_RUNS; i++) {
        nh_trajectory *b = run(s, s->method[0], fine, clean, 0, &ignored);
        if (nh_interrupted()) {
            nh_trajectory_free(b); /* the coarser one is complete */
            break;
        }
        double d = difference(s, a, b), ratio = ratio_of(s, coarse, fine);
        if (last_difference > 0 && d > 0)
            exponent = between(log(last_difference / d) / log(1 / last_ratio), least_exponent, most_exponent);
        if (b) {
            nh_trajectory_free(a);
            a = b;
            clean = !clean;
            s->out->tolerance = fine;
        }
        s->out->estimate = d * pow(ratio, exponent);
        s->doubtful |= d > nh_accuracy_amplified * coarse;
        if (!isfinite(d) || (s->out->estimate < eps / 2 && d < (i == 1 ? nh_accuracy_alike : nh_accuracy_far) * eps) ||
            fine <= tightest)
            break;
        last_difference = d;
        last_ratio = ratio;
        coarse = fine;
        fine = tighter(s, coarse, between(pow(eps / (4 * s->out->estimate), 1.25), 1e-5, step));
        /* at this tolerance the motion is long enough for measurements, as it was not at the first one */
        bool longer = s->out->choice == NH_CHOICE_SHORT && complete(a) && a->motion->effort > worthwhile;
        nh_trajectory *other = longer ? take_surveyed(s, a, &coarse) : NULL;
        if (!other) continue;
        nh_trajectory_free(a);
        a = other;
        clean = false;
        last_difference = 0;
        s->out->tolerance = coarse;
        fine = tighter(s, coarse, step);
    }
    return a && !clean && !nh_interrupted() ? undisturbed(s, a) : a;
}

/* Runs the other method at tighter and tighter tolerances until it agrees. */
static void confirm(nh_accuracy_search *s, const nh_trajectory *t)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    double tolerance = s->out->tolerance;
    s->out->second = s->method[1]->name;
    for (int i = 0; i < most_confirmations && (i == 0 || tolerance > tightest) && !(s->out->difference < s->eps); i++) {
        /* a run that agrees is tight enough, whatever the first method needed */
        tolerance = i == 0 ? fmax(tolerance / 3, s->eps / 100) : fmax(tolerance / 30, tightest);
        nh_trajectory *other = run(s, s->method[1], tolerance, true, 0, &ignored);
        s->out->difference = fmin(s->out->difference, difference(s, t, other));
        nh_trajectory_free(other);
    }
}

/* Records how the motion was computed, so that others like it can be computed in the same way. */
static nh_integration_plan way_of(const nh_accuracy_search *s, const nh_trajectory *t)
{
    const nh_accuracy *a = s->out;
    nh_integration_plan w = {.method = s->method[0],
                             .velocities = s->way ? s->way->velocities : NH_OWN_VELOCITIES,
                             .tolerance = a->tolerance,
                             .step = NAN,
                             .error = a->estimate};
    if (w.method->order) w.step = a->step, w.tolerance = NAN;
    w.effort = fmax(t->motion->effort, 1) / span_of(s->request);
    return w;
}

/* The whole search, with the verdict in *accuracy and its reasons in words. */
static nh_trajectory *attempt(const nh_trajectory_request *request, double eps, const nh_integration_plans *ways,
                              nh_accuracy *accuracy, nh_error *error)
{
    static const nh_integration_plans none = {.count = 0};
    *accuracy = (nh_accuracy){.wanted = eps, .estimate = INFINITY, .difference = INFINITY, .step = NAN, .next = NAN};
    nh_accuracy_search s = {.ways = ways ? ways : &none, .own = *request, .eps = eps, .out = accuracy};
    s.request = &s.own;
    s.floor = nh_alloc_array(request->n + 1, sizeof *s.floor);
    nh_accuracy_zeros(request, s.floor);
    nh_accuracy_between(request, s.floor);
    nh_trajectory *t = tighten(&s, error);
    if (t) {
        bool good = t->motion->complete && isfinite(accuracy->estimate) && accuracy->estimate < eps / 2;
        if (good && s.doubtful && !nh_interrupted()) confirm(&s, t);
        accuracy->held = good && (!s.doubtful || accuracy->difference < eps);
        if (fixed(&s)) accuracy->step = spacing_of(request) / steps_at(&s, accuracy->tolerance);
        nh_accuracy_explain(&s, t);
        accuracy->way = way_of(&s, t);
        if (fixed(&s)) accuracy->tolerance = NAN;
    }
    nh_programs_free(s.programs);
    nh_free(s.floor);
    return t;
}

/* A plan that was given or measured comes from another motion, or from a piece of this one: where it fails here, the
 * motion is computed without it. */
nh_trajectory *nh_trajectory_accurate(const nh_trajectory_request *request, double eps,
                                      const nh_integration_plans *ways, nh_accuracy *accuracy, nh_error *error)
{
    nh_trajectory *t = attempt(request, eps, ways, accuracy, error);
    if (!t || accuracy->held || !accuracy->measured || nh_interrupted()) return t;
    nh_accuracy plain;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_trajectory *other = attempt(request, eps, NULL, &plain, &ignored);
    plain.runs += accuracy->runs;
    plain.evaluations += accuracy->evaluations;
    plain.effort += accuracy->effort;
    plain.seconds += accuracy->seconds;
    if (other && plain.held) {
        size_t used = strlen(plain.why);
        snprintf(plain.why + used, sizeof plain.why - used,
                 "; the method chosen first, %s%s, did not reach the accuracy", t->method,
                 nh_accuracy_where(&accuracy->way));
        *accuracy = plain;
        nh_trajectory_free(t);
        return other;
    }
    accuracy->runs = plain.runs;
    accuracy->evaluations = plain.evaluations;
    accuracy->effort = plain.effort;
    accuracy->seconds = plain.seconds;
    nh_trajectory_free(other);
    return t;
}
