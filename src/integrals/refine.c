#include "integrals/refine.h"

#include <math.h>

#include "base/progress.h"
#include "exact/ball_fit.h"
#include "exact/normal.h"
#include "integrals/exact_points.h"

enum { spare_rows = 8, heldout_points = 4, most_tries = 4 };

/* as a part of the digits to which a rate cancels: a smaller coefficient is zero up to rounding */
static const double believed = 0.75;

/* The normal equations halve the digits: twice the bits. */
static nh_ball *ball_for(const nh_model *o, const nh_options *options)
{
    return nh_ball_create(o->dag, 2 * (long)options->bits);
}

static bool feed(const nh_model *o, nh_ball *ball, nh_ball_fit *fit, size_t rows, uint64_t *state)
{
    size_t added = 0;
    for (size_t tries = 0; tries < most_tries * rows + 40 && added < rows && !nh_late(); tries++)
        if (nh_exact_point(o, ball, state) && nh_ball_fit_add(fit)) added++;
    return added == rows;
}

/* Writes digits[k] of every vector; false when it has no points. */
static bool check(const nh_model *o, nh_ball *ball, nh_ball_fit *fit, uint64_t *state, const nh_options *options,
                  nh_refined *out)
{
    size_t seen = 0;
    for (size_t k = 0; k < out->count; k++) out->digits[k] = options->bits * log10(2);
    for (size_t tries = 0; tries < most_tries * heldout_points + 40 && seen < heldout_points; tries++) {
        bool usable = nh_exact_point(o, ball, state);
        for (size_t k = 0; k < out->count && usable; k++) {
            double ratio;
            usable = nh_ball_fit_residual(fit, k, &ratio);
            if (usable) out->digits[k] = fmin(out->digits[k], fmax(0, -ratio));
        }
        seen += usable;
    }
    return seen == heldout_points;
}

/* The terms' rates; false when one contains rounded numbers: these limit the digits from the start, so that nothing
 * could be decided. */
static bool rates(const nh_model *o, size_t n, const nh_ex *term, nh_ex *rate)
{
    bool exact = true;
    for (size_t j = 0; j < n && exact; j++) {
        rate[j] = nh_model_values(o, nh_model_gamma(o, term[j]));
        exact = nh_is_exact(o->dag, rate[j]);
    }
    return exact;
}

static nh_refined run(const nh_model *o, nh_ball *ball, nh_ball_fit *fit, size_t n, const nh_options *options)
{
    nh_refined out = {0};
    uint64_t state = (uint64_t)options->seed + 313;
    bool fed = feed(o, ball, fit, n + spare_rows, &state);
    if (fed) out.count = nh_ball_fit_solve(fit, options->digits, true);
    out.coefficient = nh_alloc_array(n * out.count + 1, sizeof *out.coefficient);
    out.digits = nh_alloc_array(out.count + 1, sizeof *out.digits);
    if (!check(o, ball, fit, &state, options, &out)) out.count = 0;
    for (size_t k = 0; k < out.count; k++) {
        double *c = out.coefficient + k * n, largest = 0;
        for (size_t j = 0; j < n; j++) largest = fmax(largest, fabs(c[j] = nh_ball_fit_coefficient(fit, k, j)));
        for (size_t j = 0; j < n; j++)
            if (fabs(c[j]) < largest * pow(10, -believed * out.digits[k])) c[j] = 0;
    }
    nh_ball_fit_free(fit);
    nh_ball_free(ball);
    return out;
}

nh_refined nh_refine(const nh_model *o, size_t n, const nh_ex *term, const bool *leading, const nh_options *options)
{
    nh_refined out = {0};
    nh_ex *rate = nh_alloc_array(n + 1, sizeof *rate);
    if (rates(o, n, term, rate)) {
        nh_ball *ball = ball_for(o, options);
        out = run(o, ball, nh_ball_fit_create(ball, n, rate, leading), n, options);
    }
    nh_free(rate);
    return out;
}

void nh_refined_clear(nh_refined *r)
{
    nh_free(r->coefficient);
    nh_free(r->digits);
    *r = (nh_refined){0};
}
