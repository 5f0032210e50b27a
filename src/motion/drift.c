#include "motion/drift.h"

#include <float.h>
#include <math.h>

#include "graph/terms.h"
#include "integrals/exact_points.h"
#include "motion/trajectory.h"

/* Number of outputs before the motion leaves this interval of a variable. */
static size_t outputs_between(const nh_model *model, const nh_motion *motion, nh_ex variable, double low, double high)
{
    bool of_time = variable == model->system->t;
    for (size_t s = of_time ? model->m - 1 : 0; s < model->m; s++)
        for (size_t i = 0; (of_time || model->system->coordinate[s].q == variable) && i < motion->count; i++) {
            double x = of_time ? motion->time[i] : motion->state[i * motion->size + s];
            if (x < low || x > high) return i;
        }
    return motion->count;
}

/* Number of outputs before the motion leaves the interval of current k. */
static size_t outputs_inside(const nh_drift_question *q, const nh_motion *motion, size_t k)
{
    const nh_valid *v = q->valid ? &q->valid[k] : NULL;
    if (!v || !v->variable) return motion->count;
    return outputs_between(nh_dynamics_model(q->dynamics), motion, v->variable, v->low, v->high);
}

/* The change of a current along a motion in doubles, with its formula evaluated to many digits; NAN: not known. */
static double change_by_balls(const nh_model *model, const nh_motion *motion, const bool *steep, size_t inside,
                              nh_ex phi)
{
    enum { bits = 256 };
    const nh_chart *c = model->chart;
    double first = NAN, worst = 0;
    if (c->implicit || motion->size != model->m + model->n) return NAN;
    nh_ball *ball = nh_ball_create(model->dag, bits);
    nh_exact_parameters(model, ball);
    for (size_t i = 0; i < inside && !isnan(worst); i++) {
        double value, radius;
        if (steep[i]) continue;
        nh_ball_set_double(ball, c->symbol[0], motion->time[i]);
        for (size_t s = 0; s < motion->size; s++)
            nh_ball_set_double(ball, c->symbol[1 + s], motion->state[i * motion->size + s]);
        bool good = nh_ball_value(ball, phi, &value, &radius);
        if (isnan(first)) first = value;
        worst = good ? fmax(worst, fabs(value - first) + radius) : NAN;
    }
    nh_ball_free(ball);
    return worst;
}

/* A change larger than the error of the motion explains may be rounding within the formula, as of atanh near 1. */
static void look_closer(const nh_drift_question *q, const nh_motion *motion, const bool *steep, size_t inside, size_t k,
                        size_t which, nh_drift *d)
{
    static const double much = 10;
    double loose = d->drift[which];
    if (loose <= q->options->drift * q->tolerance[which]) return;
    double closer =
        change_by_balls(nh_dynamics_model(q->dynamics), motion, steep, inside, q->current[k]) / fmax(d->scale, DBL_MIN);
    if (!(closer * much < loose)) return;
    d->drift[which] = closer;
    if (which + 1 == NH_DRIFT_RUNS) d->in_doubles = loose;
}

/* Each current and, for its scale, its terms. */
void nh_drift_measure(const nh_drift_question *q, const nh_motion *motion, size_t which, nh_drift *out)
{
    bool any, *steep = nh_steep_points(q->dynamics, motion, &any);
    for (size_t k = 0; k < q->currents; k++) {
        nh_ex *e;
        size_t per = nh_terms_of(nh_dynamics_model(q->dynamics)->dag, q->current[k], &e);
        double *value = nh_alloc_array(per * motion->count, sizeof *value);
        nh_drift *d = &out[k];
        double scale = 0, worst = 0, first = NAN;
        size_t inside = outputs_inside(q, motion, k);
        bool good = nh_along(q->dynamics, motion, per, e, value);
        d->until = inside ? motion->time[inside - 1] : q->begin;
        for (size_t i = 0; i < inside && good; i++) {
            if (steep[i] || isnan(value[i * per])) continue; /* it is real on a part of the motion only */
            if (isnan(first)) first = value[i * per];
            for (size_t j = 0; j < per; j++) scale = fmax(scale, fabs(value[i * per + j]));
            worst = fmax(worst, fabs(value[i * per] - first));
            good = isfinite(worst) && isfinite(scale);
        }
        d->scale = scale;
        d->drift[which] = !good ? INFINITY : isnan(first) ? NAN : worst / fmax(scale, DBL_MIN);
        if (isfinite(scale) && !isnan(first)) look_closer(q, motion, steep, inside, k, which, d);
        nh_free(value);
        nh_free(e);
    }
    nh_free(steep);
}

/* The tolerance bounds the error of one step.  The sum over all steps, and its growth along the motion, may be hundreds
 * of tolerances.  That error falls with the tolerance; a change of the current itself does not. */
void nh_drift_judge(size_t count, const double *tolerance, const nh_options *options, nh_drift *drift)
{
    for (size_t k = 0; k < count; k++) {
        nh_drift *d = &drift[k];
        double tight = d->drift[NH_DRIFT_RUNS - 1], loose = d->drift[0];
        double floor = 1e3 * DBL_EPSILON; /* rounding of thousands of steps */
        d->small = tight <= options->drift * tolerance[NH_DRIFT_RUNS - 1];
        d->falls = tight <= floor || (tight < loose / 5 && loose < 1);
        d->explained = isnan(tight) || d->small || (d->falls && tight < d->drift[NH_DRIFT_RUNS - 2] / 5);
    }
}
