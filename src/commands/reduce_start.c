/* reduce_start: the initial state of the motions that `reduce` compares. */
#include <string.h>

#include "base/linalg.h"
#include "commands/reduce_internal.h"
#include "commands/simulate.h"
#include "geometry/bordered.h"
#include "geometry/model.h"

/* Metric lengths of coordinates, by which their velocities compare; all 1 where there is no metric. */
static void metric_units(const nh_kinetic *k, const double *q, double *unit)
{
    size_t m = k->m;
    double *K = nh_alloc_array(m * m + 1, sizeof *K);
    bool metric = k->metric && k->autonomous;
    if (metric) nh_kinetic_values(k, m * m, k->K, q, K);
    for (size_t s = 0; s < m; s++) unit[s] = metric && K[s * (m + 1)] > 0 ? sqrt(K[s * (m + 1)]) : 1;
    nh_free(K);
}

/* An upper bound of omega(v) + b for velocities of this size: |b| + |omega| |v|, lengths by the metric's diagonal
 * (Cauchy and Schwarz). */
static double largest_value(size_t m, const double *unit, const double *omega, double b, const double *v)
{
    double form = 0, speed = 0;
    for (size_t s = 0; s < m; s++) form = hypot(form, omega[s] / unit[s]), speed = hypot(speed, unit[s] * v[s]);
    return fabs(b) + form * speed;
}

/* Change the velocities that are not `fixed` (NULL: none is) as little as possible, by the metric's diagonal, so that
 * they satisfy the constraints; returns the largest remaining omega^A(v) + b^A, relative to its upper bound for
 * velocities of this size. */
static double satisfy(const nh_kinetic *k, const double *q, const bool *fixed, double *v)
{
    size_t m = k->m, f = k->f, ld = m > f ? m : f;
    double *a = nh_alloc_array(f * m + ld + 1, sizeof *a), *b = a + f * m, left = 0;
    double *omega = nh_alloc_array(f * m + 1, sizeof *omega);
    double *offset = nh_alloc_array(f + m + 1, sizeof *offset), *unit = offset + f;
    metric_units(k, q, unit);
    if (f) nh_kinetic_values(k, f * m, k->omega, q, omega);
    if (f) nh_kinetic_values(k, f, k->b, q, offset);
    for (size_t i = 0; i < f; i++) {
        double size = 0;
        for (size_t s = 0; s < m; s++) size = hypot(size, omega[i * m + s] / unit[s]);
        if (size > 0) b[i] = offset[i] /= size;
        for (size_t s = 0; s < m && size > 0; s++) {
            omega[i * m + s] /= size;
            a[i + s * f] = fixed && fixed[s] ? 0 : omega[i * m + s] / unit[s];
            b[i] += omega[i * m + s] * v[s];
        }
    }
    if (f && nh_least_squares(f, m, a, 1, b, ld, 1e-13) >= 0)
        for (size_t s = 0; s < m; s++)
            if (!fixed || !fixed[s]) v[s] -= b[s] / unit[s];
    for (size_t i = 0; i < f; i++) {
        double rest = offset[i];
        for (size_t s = 0; s < m; s++) rest += omega[i * m + s] * v[s];
        if (rest != 0) left = fmax(left, fabs(rest) / largest_value(m, unit, omega + i * m, offset[i], v));
    }
    nh_free(a);
    nh_free(omega);
    nh_free(offset);
    return left;
}

static bool none_near(nh_error *error)
{
    return nh_fail(error, NH_NUMERIC, "", "no velocities near the initial ones satisfy the constraints");
}

static bool velocities(nh_reduction *r, const nh_request *q, const bool *given, nh_error *error)
{
    static const double allowed = 1e-9;
    bool *all = nh_arena_alloc(r->arena, r->kinetic->m * sizeof *all);
    for (size_t s = 0; s < r->kinetic->m; s++) all[s] = true;
    double left = satisfy(r->kinetic, r->initial.q, given ? given : all, r->initial.v);
    if (left <= allowed) return true;
    if (q->project) return satisfy(r->kinetic, r->initial.q, NULL, r->initial.v) <= allowed || none_near(error);
    nh_fail(error, NH_USAGE, "", "the initial velocities violate the constraints: the residual is %.3g of their size",
            left);
    return nh_error_hint(error, "omit velocities that the constraints determine, or use --project, "
                                "which takes the nearest allowed velocities");
}

/* Completes velocities that were not given, for constraints of any kind: dependent velocities of the chart follow from
 * the constraints, on its branch, the others are zero, as in `simulate`; where that is not possible, all of them are
 * changed as little as possible from those of a sample point. */
static void fill(nh_reduction *r, nh_bordered *b, const bool *given)
{
    const nh_chart *c = r->model->chart;
    size_t m = r->kinetic->m;
    double *v = nh_alloc_array(m + 1, sizeof *v);
    bool *fixed = nh_alloc_array(m + 1, sizeof *fixed), found = false;
    for (size_t attempt = c->quasi ? 1 : 0; attempt < 2 && !found; attempt++) {
        for (size_t s = 0; s < m; s++) {
            bool dependent = attempt == 1;
            for (size_t a = 0; a < r->model->k && !dependent; a++) dependent = c->dependent[a] == s;
            fixed[s] = given[s] || !dependent;
            v[s] = given[s] ? r->initial.v[s] : dependent ? r->kinetic->speed[s] : 0;
        }
        found = nh_bordered_project(b, 0, r->initial.q, fixed, v);
    }
    if (found) memcpy(r->initial.v, v, m * sizeof *v);
    nh_free(v);
    nh_free(fixed);
}

/* The same for constraints of any kind: moves to the nearest velocities that satisfy them, without changing given ones
 * noticeably. */
static bool project(nh_reduction *r, const nh_request *q, const bool *given, nh_error *error)
{
    static const double allowed = 1e-9;
    size_t m = r->kinetic->m;
    double *v = nh_alloc_array(2 * m + 1, sizeof *v), *unit = v + m, off = 0, speed = 0;
    metric_units(r->kinetic, r->initial.q, unit);
    nh_bordered *b = nh_bordered_create(r->model);
    if (given) fill(r, b, given);
    memcpy(v, r->initial.v, m * sizeof *v);
    bool found = nh_bordered_project(b, 0, r->initial.q, NULL, r->initial.v);
    for (size_t s = 0; s < m; s++) {
        speed = hypot(speed, unit[s] * v[s]);
        if (!given || given[s]) off = hypot(off, unit[s] * (v[s] - r->initial.v[s]));
    }
    if (speed > 0) off /= speed;
    nh_bordered_free(b);
    nh_free(v);
    if (!found) return none_near(error);
    if (off <= allowed || q->project) return true;
    nh_fail(error, NH_USAGE, "",
            "the initial velocities violate the constraints: the distance to the nearest allowed velocities is "
            "%.3g of their size",
            off);
    return nh_error_hint(error, "give other values, or use --project, which takes these velocities");
}

/* Motions of the reduced equations and of the full ones are compared from t = 0 on. */
static bool begins_at_zero(const nh_state *initial, nh_error *error)
{
    if (initial->t == 0) return true;
    nh_fail(error, NH_USAGE, "", "--initial: reduce computes motions from t = 0 on, not from t = %g", initial->t);
    return nh_error_hint(error, "leave t out, or write t + %g for t in the system file", initial->t);
}

bool nh_reduction_initial(nh_reduction *r, const nh_request *q, nh_error *error)
{
    size_t m = r->kinetic->m;
    r->initial.q = nh_arena_alloc(r->arena, m * sizeof(double));
    r->initial.v = nh_arena_alloc(r->arena, m * sizeof(double));
    memcpy(r->initial.q, r->kinetic->place, m * sizeof(double));
    memcpy(r->initial.v, r->kinetic->speed, m * sizeof(double));
    if (!q->initial) return true;
    nh_analysis_file *own = nh_simulate_initial(NULL, q->initial, error);
    bool good = own && nh_analysis_file_resolve(own, r->model, error) && begins_at_zero(&own->initial, error);
    if (good) {
        memcpy(r->initial.q, own->initial.q, m * sizeof(double));
        memcpy(r->initial.v, own->initial.v, m * sizeof(double));
        if (r->kinetic->affine && r->kinetic->autonomous) good = velocities(r, q, own->initial.given, error);
        else if (r->kinetic->f) good = project(r, q, own->initial.given, error);
    }
    nh_analysis_file_free(own);
    return good;
}
