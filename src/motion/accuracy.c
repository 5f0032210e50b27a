#include "motion/accuracy.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"

enum { most_runs = 7, most_confirmations = 5 };
static const char *const explicit_pair[2] = {"GSL rk8pd", "ARKODE Fehlberg"}, *const multistep_pair[2] = {"CVODE BDF", "CVODE Adams"};
static const double loosest = 1e-5, tightest = 1e-14;
static const double first_part = 3;       /* of eps: the first tolerance */
static const double usual_exponent = 0.7, least_exponent = 0.2, most_exponent = 0.9; /* with which differences fall */
static const double step = 0.1;           /* at most, from one tolerance to the next */
static const double disturbance = 1e-15;  /* relative, of the start of every second run: what rounding errors grow to is then seen in the differences */
static const double amplified = 1e3;      /* an error so many times the tolerance is confirmed by another method */
static const double quick = 0.25, faster = 20; /* a first run that takes longer than these seconds is compared with CVODE BDF, which must be so many times faster */

typedef struct {
    const nh_trajectory_request *request;
    double eps;
    nh_accuracy *out;
    const nh_method *method[2];
    bool doubtful; /* another method is to confirm */
} search;

/* The start, every number of it moved by the part `disturbance` up or down. */
static nh_state disturbed(const nh_trajectory_request *q, double *q_and_v)
{
    size_t m = q->model->m;
    uint64_t random = 0x9e3779b97f4a7c15u;
    nh_state out = *q->initial;
    for (size_t i = 0; i < 2 * m; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        q_and_v[i] = (i < m ? out.q[i] : out.v[i - m]) * (random >> 63 ? 1 + disturbance : 1 - disturbance);
    }
    out.q = q_and_v;
    out.v = q_and_v + m;
    return out;
}

static nh_trajectory *run(search *s, const nh_method *method, double tolerance, bool disturb, double max_seconds, nh_error *error)
{
    nh_trajectory_request q = *s->request;
    nh_options options = *q.options;
    double *work = nh_alloc_array(2 * q.model->m, sizeof *work);
    nh_state start = disturbed(&q, work);
    if (disturb) q.initial = &start;
    options.tolerance = tolerance;
    q.options = &options;
    q.method = method;
    q.max_seconds = max_seconds;
    nh_trajectory *t = nh_trajectory_create(&q, error);
    nh_free(work);
    s->out->runs++;
    if (t) {
        s->out->evaluations += t->motion->evaluations;
        s->out->seconds += t->motion->seconds;
    }
    return t;
}

/* The largest difference, each expression relative to its largest value; infinity when one motion did not reach its end.  What is undefined
 * in both (a current outside its domain) does not count. */
static double difference(const search *s, const nh_trajectory *a, const nh_trajectory *b)
{
    size_t n = s->request->n;
    double worst = 0;
    if (!a || !b || !a->motion->complete || !b->motion->complete) return INFINITY;
    for (size_t k = 0; k < n; k++) {
        double scale = s->request->options->absolute, d = 0;
        for (size_t i = 0; i < a->motion->count; i++) {
            double x = a->value[i * n + k], y = b->value[i * n + k];
            if (!isfinite(x) && !isfinite(y)) continue;
            if (!isfinite(x) || !isfinite(y)) return INFINITY;
            scale = fmax(scale, fabs(x));
            d = fmax(d, fabs(x - y));
        }
        if (d / scale > worst) worst = d / scale, s->out->quantity = k;
    }
    return worst;
}

static double between(double x, double low, double high) { return fmax(low, fmin(high, x)); }

static void take(search *s, const char *const pair[2])
{
    for (int i = 0; i < 2; i++) s->method[i] = nh_method_find(pair[i]);
}

static bool complete(const nh_trajectory *t) { return t && t->motion->complete; }

/* Seconds that a run would have taken to its end. */
static double whole(const nh_trajectory_request *q, const nh_trajectory *t)
{
    double begin = q->times[0], done = t ? (t->motion->end_time - begin) / (q->times[q->count - 1] - begin) : 0;
    return t ? t->motion->seconds / fmax(done, 1e-6) : INFINITY;
}

/* After an interruption: the one that came farther. */
static nh_trajectory *farther(nh_trajectory *a, nh_trajectory *b)
{
    bool first = a && (!b || a->motion->count >= b->motion->count);
    nh_trajectory_free(first ? b : a);
    return first ? a : b;
}

/* The pair of methods, and the first run. */
static nh_trajectory *choose(search *s, double tolerance, nh_error *error)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    take(s, explicit_pair);
    nh_trajectory *t = run(s, s->method[0], tolerance, true, quick, &ignored);
    if (complete(t) || (t && nh_interrupted())) return t;
    take(s, multistep_pair);
    nh_trajectory *other = run(s, s->method[0], tolerance, true, between(whole(s->request, t) / faster, 1e-3, 1e6), &ignored);
    s->doubtful = complete(other); /* implicit methods can damp what grows: always confirmed */
    if (s->doubtful || nh_interrupted()) return farther(other, t);
    nh_trajectory_free(other);
    take(s, explicit_pair);
    other = run(s, s->method[0], tolerance, true, s->request->max_seconds, t ? &ignored : error);
    if (other && !nh_interrupted()) {
        nh_trajectory_free(t);
        return other;
    }
    return farther(other, t);
}

/* The motion from the start itself, if it can be had. */
static nh_trajectory *undisturbed(search *s, nh_trajectory *a)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_trajectory *b = run(s, s->method[0], s->out->tolerance, false, s->request->max_seconds, &ignored);
    if (!b || nh_interrupted()) return farther(a, b);
    s->out->estimate = fmax(s->out->estimate, difference(s, a, b));
    nh_trajectory_free(a);
    return b;
}

/* Tighten until the estimate is below eps/2; the last trajectory. */
static nh_trajectory *tighten(search *s, nh_error *error)
{
    double eps = s->eps, coarse = between(first_part * eps, 10 * tightest, loosest), fine = coarse * step, last_difference = 0, last_fine = 0, exponent = usual_exponent;
    nh_trajectory *a = choose(s, coarse, error);
    nh_error ignored;
    nh_error_clear(&ignored);
    bool clean = false;
    s->out->tolerance = coarse;
    for (int i = 1; complete(a) && i < most_runs; i++) {
        nh_trajectory *b = run(s, s->method[0], fine, clean, s->request->max_seconds, &ignored);
        if (nh_interrupted()) {
            nh_trajectory_free(b); /* the coarser one is complete */
            break;
        }
        double d = difference(s, a, b);
        if (last_difference > 0 && d > 0) exponent = between(log(last_difference / d) / log(last_fine / fine), least_exponent, most_exponent);
        if (b) {
            nh_trajectory_free(a);
            a = b;
            clean = !clean;
            s->out->tolerance = fine;
        }
        s->out->estimate = d * pow(fine / coarse, exponent);
        s->doubtful |= d > amplified * coarse;
        if (!isfinite(d) || (s->out->estimate < eps / 2 && d < 30 * eps) || fine <= tightest) break;
        last_difference = d;
        last_fine = fine;
        coarse = fine;
        fine = fmax(tightest, fine * between(pow(eps / (4 * s->out->estimate), 1.25), 1e-5, step));
    }
    return a && !clean && !nh_interrupted() ? undisturbed(s, a) : a;
}

/* The other method at ever tighter tolerances until it agrees. */
static void confirm(search *s, const nh_trajectory *t)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    double tolerance = s->out->tolerance;
    s->out->second = s->method[1]->name;
    for (int i = 0; i < most_confirmations && (i == 0 || tolerance > tightest) && !(s->out->difference < s->eps); i++) {
        tolerance = fmax(tolerance / (i == 0 ? 3 : 30), tightest);
        nh_trajectory *other = run(s, s->method[1], tolerance, true, s->request->max_seconds, &ignored);
        s->out->difference = fmin(s->out->difference, difference(s, t, other));
        nh_trajectory_free(other);
    }
}

static void explain(search *s, const nh_trajectory *t)
{
    nh_accuracy *a = s->out;
    size_t size = sizeof a->why;
    if (nh_interrupted() && !a->held)
        snprintf(a->why, size, "interrupted before the accuracy %.1e was reached: this is %s at tolerance %.1e, and its error is not known", s->eps, t->method, a->tolerance);
    else if (!t->motion->complete)
        snprintf(a->why, size, "the accuracy %.1e was not reached: the motion ended at t = %.6g", s->eps, t->motion->end_time);
    else if (!(a->estimate < s->eps / 2))
        snprintf(a->why, size, "the accuracy %.1e was not reached: %s at tolerance %.1e has an estimated error of %.1e", s->eps, t->method, a->tolerance, a->estimate);
    else if (!s->doubtful)
        snprintf(a->why, size, "%s at tolerance %.1e, estimated error %.1e", t->method, a->tolerance, a->estimate);
    else if (a->held)
        snprintf(a->why, size, "%s at tolerance %.1e, estimated error %.1e, %s agrees to %.1e", t->method, a->tolerance, a->estimate, a->second, a->difference);
    else if (!isfinite(a->difference))
        snprintf(a->why, size, "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but %s could not compute the motion", s->eps, t->method, a->estimate, a->second);
    else
        snprintf(a->why, size, "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but %s differs by %.1e", s->eps, t->method, a->estimate, a->second, a->difference);
}

nh_trajectory *nh_trajectory_accurate(const nh_trajectory_request *request, double eps, nh_accuracy *accuracy, nh_error *error)
{
    *accuracy = (nh_accuracy){.wanted = eps, .estimate = INFINITY, .difference = INFINITY};
    search s = {.request = request, .eps = eps, .out = accuracy};
    nh_trajectory *t = tighten(&s, error);
    if (!t) return NULL;
    bool good = t->motion->complete && isfinite(accuracy->estimate) && accuracy->estimate < eps / 2;
    if (good && s.doubtful && !nh_interrupted()) confirm(&s, t);
    accuracy->held = good && (!s.doubtful || accuracy->difference < eps);
    explain(&s, t);
    return t;
}
