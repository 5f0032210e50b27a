#include "motion/pilot_runs.h"

#include <math.h>

static const double exponent = 0.9; /* largest exponent with which errors are expected to fall with the tolerance */

bool nh_integration_plan_doubtful(const nh_method *method)
{
    bool one_step = (method->family == NH_METHOD_ARKODE && method->kind != NH_ESDIRK_5) ||
                    (method->family == NH_METHOD_GSL_ODEIV && method->kind != NH_MSADAMS);
    return !one_step;
}

static bool usable(const nh_integration_plan *w, const nh_integration_plan_limits *l)
{
    bool fixed = w->method->order > 0;
    if (l->scene && (fixed || w->velocities != NH_OWN_VELOCITIES)) return false;
    if (w->velocities == NH_OTHER_VELOCITIES && !l->other) return false;
    if (fixed && (w->velocities != NH_OWN_VELOCITIES || w->step > l->spacing)) return false;
    return true;
}

/* The cheapest other method with error control that reached eps in the model's own equations. */
static const nh_integration_plan *second_of(size_t n, const nh_integration_plan *way, double eps,
                                            const nh_method *first)
{
    const nh_integration_plan *best = NULL;
    for (size_t i = 0; i < n; i++) {
        const nh_integration_plan *w = &way[i];
        if (w->method != first && !w->method->order && w->velocities == NH_OWN_VELOCITIES && w->error < eps &&
            (!best || w->effort < best->effort))
            best = w;
    }
    return best;
}

/* Two runs, of which the tighter one is used, and a third where another method confirms it. */
double nh_integration_plan_cost(size_t n, const nh_integration_plan *way, double eps, const nh_integration_plan *w)
{
    const nh_integration_plan *second =
        nh_integration_plan_doubtful(w->method) ? second_of(n, way, eps, w->method) : NULL;
    return 2 * w->effort + (second ? second->effort : nh_integration_plan_doubtful(w->method) ? 2 * w->effort : 0);
}

nh_integration_plan_choice nh_integration_plan_cheapest(size_t n, const nh_integration_plan *way, double eps,
                                                        const nh_integration_plan_limits *limits)
{
    nh_integration_plan_choice out = {.next = NAN};
    double least = INFINITY, other = INFINITY;
    for (size_t i = 0; i < n; i++) {
        if (!usable(&way[i], limits) || !(way[i].error < eps)) continue;
        double cost = nh_integration_plan_cost(n, way, eps, &way[i]);
        if (cost < least) least = cost, out.way = &way[i];
    }
    for (size_t i = 0; i < n && out.way; i++) {
        bool another = way[i].method != out.way->method || way[i].velocities != out.way->velocities;
        if (!another || !usable(&way[i], limits) || !(way[i].error < eps)) continue;
        double cost = nh_integration_plan_cost(n, way, eps, &way[i]);
        if (cost < other) other = cost, out.other = &way[i];
    }
    if (isfinite(other)) out.next = other / least;
    const nh_integration_plan *second = out.way ? second_of(n, way, eps, out.way->method) : NULL;
    if (second) out.second = second->method;
    return out;
}

double nh_integration_plan_setting(const nh_integration_plan *w, double error)
{
    double ratio = error / w->error;
    return w->method->order ? w->step * pow(ratio, 1.0 / w->method->order) : w->tolerance * pow(ratio, 1 / exponent);
}
