#include "motion/accuracy_measure.h"

#include <math.h>

#include "graph/terms.h"
#include "motion/vanishing.h"

void nh_accuracy_disturb(size_t n, const double *from, double *to)
{
    uint64_t random = 0x9e3779b97f4a7c15u;
    for (size_t i = 0; i < n; i++) {
        random = random * 6364136223846793005u + 1442695040888963407u;
        to[i] = from[i] * (random >> 63 ? 1 + nh_accuracy_disturbance : 1 - nh_accuracy_disturbance);
    }
}

double nh_accuracy_difference(size_t count, size_t n, const double *a, const double *b, const double *floor,
                              size_t *which)
{
    double worst = 0;
    for (size_t k = 0; k < n; k++) {
        double scale = floor ? floor[k] : 0, d = 0;
        for (size_t i = 0; i < count; i++) {
            double x = a[i * n + k], y = b[i * n + k];
            if (!isfinite(x) && !isfinite(y)) continue;
            if (!isfinite(x) || !isfinite(y)) return *which = k, INFINITY;
            scale = fmax(scale, fabs(x));
            d = fmax(d, fabs(x - y));
        }
        if (d > 0 && !(d / scale <= worst)) worst = d / scale, *which = k;
    }
    return worst;
}

bool nh_accuracy_zeros(const nh_trajectory_request *q, double *floor)
{
    const nh_model *model = q->model;
    double *z = nh_alloc_array(model->m + model->n + 1, sizeof *z);
    bool *zero = nh_alloc_array(q->n + 1, sizeof *zero);
    nh_dynamics *d = nh_dynamics_create(model);
    nh_vanishing *v = nh_vanishing_create(model, q->n, q->e);
    nh_error ignored;
    nh_error_clear(&ignored);
    bool good = nh_dynamics_start(d, q->initial, q->project, z, &ignored);
    if (good) nh_vanishing_test(v, z, zero);
    for (size_t k = 0; k < q->n; k++) floor[k] = good && zero[k] ? INFINITY : 0;
    nh_vanishing_free(v);
    nh_dynamics_free(d);
    nh_free(zero);
    nh_free(z);
    return good;
}

void nh_accuracy_between(const nh_trajectory_request *request, double *floor)
{
    enum { few = 64, places = 257 };
    static const double loose = 1e-6;
    nh_trajectory_request q = *request;
    nh_options options = *request->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (q.count < 2 || q.count >= few) return;
    double *times = nh_alloc_array(places, sizeof *times), begin = q.times[0], span = q.times[q.count - 1] - begin;
    for (size_t i = 0; i < places; i++) times[i] = begin + span * (double)i / (places - 1);
    options.tolerance = loose;
    q.options = &options, q.method = NULL, q.step = 0;
    q.count = places, q.times = times, q.events = q.impulses = 0;
    nh_trajectory *t = nh_trajectory_create(&q, &ignored);
    for (size_t i = 0; t && i < q.n * t->motion->count; i++)
        if (isfinite(t->value[i])) floor[i % q.n] = fmax(floor[i % q.n], fabs(t->value[i]));
    nh_trajectory_free(t);
    nh_free(times);
}

void nh_accuracy_terms(const nh_trajectory_request *q, const nh_trajectory *t, double *floor)
{
    if (!q->by_terms || !t || t->scene) return;
    nh_dynamics *d = nh_dynamics_create(q->model);
    for (size_t k = 0; k < q->n; k++) {
        if (!q->by_terms[k]) continue;
        nh_ex *e;
        size_t n = nh_terms_of(q->model->dag, q->e[k], &e);
        double *value = nh_alloc_array(n * t->motion->count + 1, sizeof *value);
        bool good = nh_along(d, t->motion, n, e, value);
        for (size_t i = 0; i < n * t->motion->count && good; i++)
            if (isfinite(value[i])) floor[k] = fmax(floor[k], fabs(value[i]));
        nh_free(value);
        nh_free(e);
    }
    nh_dynamics_free(d);
}

/* The largest of the terms of one expression, along a motion that is computed for it at low accuracy: the given motion
 * may lack states on which the terms depend. */
static double terms_alone(const nh_trajectory_request *request, nh_ex one)
{
    static const double loose = 1e-6;
    nh_ex *e;
    nh_trajectory_request q = *request;
    nh_options options = *request->options;
    nh_error ignored;
    double largest = 0;
    nh_error_clear(&ignored);
    options.tolerance = loose;
    q.options = &options;
    q.n = nh_terms_of(q.model->dag, one, &e);
    q.e = e;
    nh_trajectory *t = nh_trajectory_create(&q, &ignored);
    for (size_t i = 0; t && i < q.n * t->motion->count; i++)
        if (isfinite(t->value[i])) largest = fmax(largest, fabs(t->value[i]));
    nh_trajectory_free(t);
    nh_free(e);
    return largest;
}

bool nh_accuracy_cancels(const nh_trajectory_request *q, const nh_trajectory *t, size_t k, double *size)
{
    static const double much = 1e3;
    *size = 0;
    for (size_t i = 0; i < t->motion->count; i++) *size = fmax(*size, fabs(t->value[i * q->n + k]));
    return terms_alone(q, q->e[k]) > much * *size;
}
