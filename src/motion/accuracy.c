#include "motion/accuracy.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/progress.h"

enum { pilots = 3, most_runs = 7, most_confirmations = 5 };
static const char *const pilot_name[pilots] = {"CVODE BDF", "CVODE Adams", "GSL rk8pd"};
static const double loosest = 1e-4, tightest = 1e-14;
static const double first_exponent = 0.7, least_exponent = 0.2, most_exponent = 0.9;
static const double patience = 8, least_patience = 0.05; /* a pilot may take so many times what the fastest took, and at least these seconds */

typedef struct {
    const nh_trajectory_request *request;
    double eps;
    nh_accuracy *out;
    const nh_method *method[pilots]; /* fastest first */
    double seconds[pilots];
} search;

static nh_trajectory *run(search *s, const nh_method *method, double tolerance, double max_seconds, nh_error *error)
{
    nh_trajectory_request q = *s->request;
    nh_options options = *q.options;
    options.tolerance = tolerance;
    q.options = &options;
    q.method = method;
    q.max_seconds = max_seconds;
    nh_trajectory *t = nh_trajectory_create(&q, error);
    s->out->runs++;
    if (t) s->out->evaluations += t->motion->evaluations;
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
        worst = fmax(worst, d / scale);
    }
    return worst;
}

/* Time all methods at a loose tolerance and sort them; those that do not finish go last. */
static void race(search *s, double tolerance)
{
    double best = INFINITY;
    nh_error ignored;
    for (int i = 0; i < pilots; i++) {
        nh_error_clear(&ignored);
        const nh_method *method = nh_method_find(pilot_name[i]);
        nh_trajectory *t = run(s, method, tolerance, isfinite(best) ? fmax(patience * best, least_patience) : 0, &ignored);
        double seconds = t && t->motion->complete ? t->motion->seconds : INFINITY;
        int at = i;
        for (; at > 0 && s->seconds[at - 1] > seconds; at--) {
            s->seconds[at] = s->seconds[at - 1];
            s->method[at] = s->method[at - 1];
        }
        s->seconds[at] = seconds;
        s->method[at] = method;
        best = fmin(best, seconds);
        nh_trajectory_free(t);
    }
}

static double between(double x, double low, double high) { return fmax(low, fmin(high, x)); }

/* Tighten until the estimate is below eps/2; the last trajectory. */
static nh_trajectory *tighten(search *s, nh_error *error)
{
    double eps = s->eps, coarse = fmax(fmin(eps, loosest), 10 * tightest), fine = coarse / 10, last_difference = INFINITY, last_fine = 0, exponent = first_exponent;
    nh_trajectory *a = run(s, s->method[0], coarse, 0, error), *b = NULL;
    s->out->estimate = INFINITY;
    s->out->tolerance = coarse;
    for (int i = 1; a && i < most_runs; i++) {
        fine = fmax(fine, tightest);
        b = run(s, s->method[0], fine, 0, error);
        if (!b) break;
        if (nh_interrupted() && b->motion->count <= a->motion->count) { /* the coarser one came farther */
            nh_trajectory_free(b);
            break;
        }
        double d = difference(s, a, b), estimate;
        if (last_fine > 0 && d > 0 && isfinite(last_difference)) exponent = between(log(last_difference / d) / log(last_fine / fine), least_exponent, most_exponent);
        estimate = d * pow(fine / coarse, exponent);
        nh_trajectory_free(a);
        a = b;
        s->out->estimate = estimate;
        s->out->tolerance = fine;
        if (!isfinite(d) || (estimate < eps / 2 && d < 30 * eps) || fine <= tightest) break;
        last_difference = d;
        last_fine = fine;
        coarse = fine;
        fine *= between(pow(eps / (4 * estimate), 1.25), 1e-5, 0.1);
    }
    return a;
}

/* Another method at ever tighter tolerances until it agrees. */
static void confirm(search *s, const nh_trajectory *t)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    s->out->difference = INFINITY;
    for (int k = 1; k < pilots && !s->out->second; k++)
        if (isfinite(s->seconds[k])) s->out->second = s->method[k]->name;
    if (!s->out->second) return;
    double tolerance = s->out->tolerance;
    for (int i = 0; i < most_confirmations && (i == 0 || tolerance > tightest) && !(s->out->difference < s->eps); i++) {
        tolerance = fmax(tolerance / (i == 0 ? 3 : 30), tightest);
        nh_trajectory *other = run(s, nh_method_find(s->out->second), tolerance, 0, &ignored);
        s->out->difference = fmin(s->out->difference, difference(s, t, other));
        nh_trajectory_free(other);
    }
}

static void explain(search *s, const nh_trajectory *t)
{
    nh_accuracy *a = s->out;
    size_t size = sizeof a->why;
    bool estimated = a->estimate < s->eps / 2;
    if (a->held)
        snprintf(a->why, size, "%s at tolerance %.1e, the fastest of %d at a loose one; estimated error %.1e, %s agrees to %.1e", t->method, a->tolerance, pilots,
                 a->estimate, a->second, a->difference);
    else if (!t->motion->complete)
        snprintf(a->why, size, "the accuracy %.1e was not reached: the motion ended at t = %.6g", s->eps, t->motion->end_time);
    else if (!estimated)
        snprintf(a->why, size, "the accuracy %.1e was not reached: %s at tolerance %.1e has an estimated error of %.1e", s->eps, t->method, a->tolerance, a->estimate);
    else if (!a->second)
        snprintf(a->why, size, "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but no other method could compute the motion", s->eps, t->method, a->estimate);
    else
        snprintf(a->why, size, "the accuracy %.1e was not confirmed: %s estimates an error of %.1e, but %s differs by %.1e", s->eps, t->method, a->estimate, a->second,
                 a->difference);
}

nh_trajectory *nh_trajectory_accurate(const nh_trajectory_request *request, double eps, nh_accuracy *accuracy, nh_error *error)
{
    *accuracy = (nh_accuracy){.wanted = eps, .estimate = INFINITY, .difference = INFINITY};
    search s = {.request = request, .eps = eps, .out = accuracy};
    race(&s, fmax(fmin(eps, loosest), 10 * tightest));
    nh_trajectory *t = tighten(&s, error);
    if (!t) return NULL;
    if (accuracy->estimate < eps / 2) confirm(&s, t);
    accuracy->held = accuracy->estimate < eps / 2 && accuracy->difference < eps;
    explain(&s, t);
    return t;
}
