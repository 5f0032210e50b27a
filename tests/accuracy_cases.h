/* accuracy_cases: motions of the shipped systems from starts and over times that nothing was tuned with; for bench_accuracy, which prints a table, and
 * test_accuracy, which takes a sample.
 *
 * The truth is a Runge-Kutta motion of order 8 at the smallest tolerance, if another pair agrees with it to a tenth of what is asked for. */
#ifndef NH_TESTS_ACCURACY_CASES_H
#define NH_TESTS_ACCURACY_CASES_H

#include <math.h>
#include <string.h>

#include "motion/accuracy.h"

enum { accuracy_outputs = 6, accuracy_starts = 6, accuracy_times = 3, first_start = 2, accuracy_asked = 8, cheap_methods = 3 };

typedef struct {
    const nh_model *model;
    nh_state initial;
    double until, eps;
    nh_accuracy a;
    bool complete, known, wrong; /* known: there is a truth */
    double error;                /* of the motion that is returned; NAN where there is no truth */
    long least_evaluations;      /* of the cheapest run that suffices; 0: none does */
    double least_effort, least_seconds;
} accuracy_case;

static inline nh_trajectory *accuracy_run(const accuracy_case *c, const char *method, double tolerance, bool search, nh_accuracy *a)
{
    double times[accuracy_outputs];
    nh_options options;
    nh_error error;
    nh_options_default(&options);
    nh_error_clear(&error);
    options.tolerance = tolerance;
    options.steps = 1e6;
    for (int i = 0; i < accuracy_outputs; i++) times[i] = c->initial.t + c->until * i / (accuracy_outputs - 1);
    nh_trajectory_request q = {.model = c->model, .initial = &c->initial, .count = accuracy_outputs, .times = times, .options = &options, .n = c->model->m, .e = c->model->rho,
                               .max_seconds = 3, .method = search ? NULL : nh_method_find(method)};
    nh_integration_plans ways = {.pilot = true};
    return search ? nh_trajectory_accurate(&q, c->eps, &ways, a, &error) : nh_trajectory_create(&q, &error);
}

/* The largest difference, each expression relative to its largest value; as motion/accuracy.c defines it.  What is zero along the motion is left out. */
static inline double accuracy_difference(const accuracy_case *c, const nh_trajectory *a, const nh_trajectory *b)
{
    size_t n = c->model->m;
    double worst = 0, floor[64];
    nh_trajectory_request q = {.model = c->model, .initial = &c->initial, .n = n, .e = c->model->rho};
    if (!a || !b || !a->motion->complete || !b->motion->complete || n > 64 || !nh_accuracy_zeros(&q, floor)) return INFINITY;
    for (size_t k = 0; k < n; k++) {
        double scale = floor[k], d = 0;
        for (size_t i = 0; i < accuracy_outputs; i++) {
            scale = fmax(scale, fabs(b->value[i * n + k]));
            d = fmax(d, fabs(a->value[i * n + k] - b->value[i * n + k]));
        }
        if (d > 0) worst = fmax(worst, d / scale);
    }
    return worst;
}

static inline void cheapest(accuracy_case *c, const nh_trajectory *truth)
{
    static const char *const names[cheap_methods] = {"GSL rk8pd", "GSL rkf45", "CVODE Adams"};
    c->least_effort = c->least_seconds = INFINITY;
    for (int i = 0; i < cheap_methods; i++)
        for (double tolerance = fmin(1e-2, 10 * c->eps), good = 0; tolerance > 1e-14 && !good; tolerance /= 3) {
            nh_trajectory *t = accuracy_run(c, names[i], tolerance, false, NULL);
            good = accuracy_difference(c, t, truth) < c->eps;
            if (good && (!c->least_evaluations || t->motion->evaluations < c->least_evaluations)) c->least_evaluations = t->motion->evaluations;
            if (good) c->least_effort = fmin(c->least_effort, t->motion->effort), c->least_seconds = fmin(c->least_seconds, t->motion->seconds);
            nh_trajectory_free(t);
        }
}

/* Everything of c but the model, the start, the time and eps. */
static inline void accuracy_try(accuracy_case *c, bool compare)
{
    nh_trajectory *t = accuracy_run(c, NULL, 1e-10, true, &c->a);
    nh_trajectory *truth = accuracy_run(c, "GSL rk8pd", 1e-14, false, NULL), *second = accuracy_run(c, "ARKODE Fehlberg", 1e-14, false, NULL);
    c->complete = t && t->motion->complete;
    c->known = accuracy_difference(c, second, truth) < c->eps / 10;
    c->error = c->known ? accuracy_difference(c, t, truth) : NAN;
    c->wrong = c->a.held && c->known && !(c->error < c->eps);
    if (compare && c->known && c->a.held) cheapest(c, truth);
    nh_trajectory_free(t);
    nh_trajectory_free(truth);
    nh_trajectory_free(second);
}

/* The start and time number `index` of the system number `system`; false when there are not so many.  q and v: m values each. */
static inline bool accuracy_start(accuracy_case *c, const nh_model *o, size_t system, size_t index, double *q, double *v)
{
    static const double times[accuracy_times] = {3.7, 12.9, 47};
    const nh_chart *chart = o->chart;
    if (first_start + index >= chart->probes) return false;
    const double *point = chart->probe + (first_start + index) * chart->width;
    nh_tape *tape = nh_model_tape(o, o->m, o->rho);
    nh_tape_work *work = nh_tape_work_create(tape);
    *c = (accuracy_case){.model = o, .until = times[index % accuracy_times], .eps = pow(10, -4 - (double)((3 * system + 5 * index) % accuracy_asked)), .initial = {.t = point[0], .q = q, .v = v}};
    memcpy(q, point + 1, o->m * sizeof *q);
    nh_tape_eval(tape, work, point, v);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return true;
}

#endif
