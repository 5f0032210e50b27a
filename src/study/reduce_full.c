/* reduce_full: the full motion that reduced ones are compared with, and how well it is known. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "study/reduce_internal.h"

/* How far two places are apart: angles modulo 2 pi, relative to 1 + size, measured by the metric with unit diagonal.  Near a pole of the coordinates large
 * differences of two angles may mean nearly the same place, and only the metric tells. */
double nh_reduction_distance(const nh_kinetic *k, const double *a, const double *b)
{
    static const double turn = 6.283185307179586;
    size_t m = k->m;
    double *K = nh_alloc_array(m * m + 2 * m, sizeof *K), *off = K + m * m, *unit = off + m, size = 1, square = 0;
    if (k->quadratic && k->autonomous) nh_kinetic_values(k, m * m, k->K, b, K);
    else for (size_t s = 0; s < m; s++) K[s * (m + 1)] = 1;
    for (size_t s = 0; s < m; s++)
        if (k->angle[s]) size = fmax(size, 1 + fabs(b[s]));
    for (size_t s = 0; s < m; s++) {
        off[s] = a[s] - b[s];
        if (k->angle[s]) off[s] -= turn * round(off[s] / turn);
        off[s] /= k->angle[s] ? size : 1 + fabs(b[s]);
        unit[s] = K[s * (m + 1)] > 0 ? 1 / sqrt(K[s * (m + 1)]) : 0;
    }
    for (size_t i = 0; i < m * m; i++) square += K[i] * unit[i / m] * unit[i % m] * off[i / m] * off[i % m];
    nh_free(K);
    return isfinite(square) ? sqrt(fmax(square, 0)) : INFINITY;
}

size_t nh_reduction_reliable(const nh_kinetic *k, size_t count, const double *a, size_t a_stride, const double *b, size_t b_stride, double allowed, double *farthest)
{
    size_t n = count;
    *farthest = 0;
    for (size_t i = 0; i < count; i++) {
        double off = nh_reduction_distance(k, a + i * a_stride, b + i * b_stride);
        if (!(off <= allowed) && i < n) n = i;
        *farthest = fmax(*farthest, off);
    }
    return n;
}

static size_t reliable(const nh_kinetic *k, const nh_motion *a, const nh_motion *b, double allowed, double *farthest)
{
    return nh_reduction_reliable(k, a->count < b->count ? a->count : b->count, a->state, a->size, b->state, b->size, allowed, farthest);
}

/* ---- the full motion ---- */

static nh_motion *full_with(nh_reduction_bench *b, double rtol, size_t outputs, nh_error *error)
{
    nh_reduction *r = b->r;
    size_t m = r->kinetic->m;
    nh_bordered *bordered = nh_bordered_create(r->model);
    nh_flow_problem problem = nh_bordered_flow(bordered);
    nh_flow_options options = {.method = NH_ADAMS, .rtol = rtol, .max_steps = fmin(r->options.steps, NH_REDUCTION_STEPS)};
    double *z = nh_alloc_array(2 * m, sizeof *z);
    memcpy(z, r->initial.q, m * sizeof *z);
    memcpy(z + m, r->initial.v, m * sizeof *z);
    nh_motion *motion = nh_flow(&problem, z, outputs, b->times, &options, error);
    nh_bordered_free(bordered);
    nh_free(z);
    return motion;
}

/* Where no method can be chosen; r->full.why holds the reason. */
static void take_usual(nh_reduction *r, double tolerance, const nh_motion *motion, double error, bool held)
{
    nh_reduction_choice *c = &r->full;
    char reason[sizeof c->why];
    snprintf(reason, sizeof reason, "%s", c->why);
    r->full_formulation = "all coordinates, accelerations from the bordered system";
    *c = (nh_reduction_choice){.method = "CVODE Adams", .tolerance = tolerance, .step = NAN, .error = error, .evaluations = motion->evaluations, .seconds = motion->seconds, .times = NAN, .runs = 2, .held = held};
    snprintf(c->why, sizeof c->why, "CVODE Adams at tolerance %.1e; none is chosen because %.400s", tolerance, reason);
}

/* The full motion with the tolerance of the reduced ones, and again with a smaller one, as reference.  Errors add up along a motion: the tolerance with which
 * all are computed is a hundredth of the one that is asked for, or less where the full motion shows that this would not do. */
static bool full_motion(nh_reduction_bench *b, nh_error *error)
{
    static const double part = 0.01, finest = 1e-14, least = 5e-14, aim = 10, allowed = NH_REDUCTION_ALLOWED; /* in tolerances */
    nh_reduction *r = b->r;
    size_t m = r->kinetic->m;
    b->rtol = fmax(r->options.tolerance * part, least);
    nh_motion *coarse = full_with(b, b->rtol, NH_REDUCTION_OUTPUTS, error);
    /* one that ends early, with steps that become smaller and smaller, is not brought to its end a second time */
    size_t outputs = coarse && !coarse->complete && coarse->guard_hit < 0 && coarse->count > 1 ? coarse->count : NH_REDUCTION_OUTPUTS;
    const char *ended = outputs < NH_REDUCTION_OUTPUTS ? nh_arena_printf(r->arena, "the full motion ended at t = %.4g: %s", coarse->end_time, coarse->note) : NULL;
    nh_motion *fine = coarse ? full_with(b, finest, outputs, error) : NULL;
    double off = 0;
    if (fine) reliable(r->kinetic, coarse, fine, INFINITY, &off);
    if (fine && off > aim * r->options.tolerance && b->rtol > least) {
        b->rtol = fmax(b->rtol * aim * r->options.tolerance / off, least);
        nh_motion_free(coarse);
        coarse = full_with(b, b->rtol, outputs, error);
    }
    if (coarse && fine) {
        r->full_seconds = coarse->seconds;
        b->reached = reliable(r->kinetic, coarse, fine, allowed * r->options.tolerance, &off);
        r->full_reached = b->times[b->reached ? b->reached - 1 : 0];
        if (b->reached < fine->count)
            nh_reduction_warn(r, "the full motion is known well enough up to t = %.4g only: there it comes too near to a singularity of the coordinates, or is chaotic", b->times[b->reached ? b->reached - 1 : 0]);
        b->full = nh_arena_alloc(r->arena, NH_REDUCTION_OUTPUTS * m * sizeof *b->full);
        for (size_t i = 0; i < fine->count; i++) memcpy(b->full + i * m, fine->state + i * fine->size, m * sizeof *b->full);
        if (ended) nh_reduction_warn(r, "%s", ended);
        else if (!fine->complete) nh_reduction_warn(r, "the full motion ended at t = %.4g: %s", fine->end_time, fine->note);
    }
    if (b->full && r->wanted > 0) take_usual(r, b->rtol, coarse, off, b->reached == NH_REDUCTION_OUTPUTS);
    nh_motion_free(coarse);
    nh_motion_free(fine);
    return b->full != NULL;
}

bool nh_reduction_full_motion(nh_reduction_bench *b, nh_error *error) { return (b->r->wanted > 0 && nh_reduction_full_accurate(b)) || full_motion(b, error); }

/* Errors of one size, made at other places of the motion: what remains of them at the outputs is how well a motion in all coordinates is known, whatever its sensitivity. */
double nh_reduction_unsure(nh_reduction_bench *b)
{
    static const double tolerances[] = {2e-14, 5e-14};
    const nh_kinetic *k = b->r->kinetic;
    if (b->unsure > 0) return b->unsure;
    for (size_t t = 0; t < sizeof tolerances / sizeof *tolerances; t++) {
        nh_error ignored = {0};
        nh_motion *other = full_with(b, tolerances[t], b->reached, &ignored);
        for (size_t i = 0; other && i < b->reached && i < other->count; i++) b->unsure = fmax(b->unsure, nh_reduction_distance(k, other->state + i * other->size, b->full + i * k->m));
        nh_motion_free(other);
        nh_error_clear(&ignored);
    }
    return b->unsure = fmin(b->unsure, NH_REDUCTION_ALLOWED * b->r->options.tolerance);
}
