#include "noether/refine.h"

#include <math.h>

#include "expr/ball_fit.h"
#include "noether/exact.h"

enum { spare_rows = 8, heldout_points = 4, most_tries = 4 };

/* The normal equations halve the digits: twice the bits. */
static nh_ball *ball_for(const nh_model *o, const nh_options *options) { return nh_ball_create(o->dag, 2 * (long)options->bits); }

static bool feed(const nh_model *o, nh_ball *ball, nh_ball_fit *fit, size_t rows, uint64_t *state)
{
    size_t added = 0;
    for (size_t tries = 0; tries < most_tries * rows + 40 && added < rows; tries++)
        if (nh_exact_point(o, ball, state) && nh_ball_fit_add(fit)) added++;
    return added == rows && nh_ball_fit_solve(fit);
}

static double check(const nh_model *o, nh_ball *ball, nh_ball_fit *fit, uint64_t *state, const nh_options *options)
{
    double digits = options->bits * log10(2);
    size_t seen = 0;
    for (size_t tries = 0; tries < most_tries * heldout_points + 40 && seen < heldout_points; tries++) {
        double ratio;
        if (!nh_exact_point(o, ball, state) || !nh_ball_fit_residual(fit, &ratio)) continue;
        digits = fmin(digits, fmax(0, -ratio));
        seen++;
    }
    return seen == heldout_points ? digits : -1;
}

double nh_refine(const nh_model *o, size_t n, const nh_ex *term, const bool *fixed, double *coefficient, double rows, const nh_options *options)
{
    nh_ex *rate = nh_alloc_array(n + 1, sizeof *rate);
    size_t unknowns = 0;
    uint64_t state = (uint64_t)options->seed + 313;
    bool exact = true;
    for (size_t j = 0; j < n; j++) {
        rate[j] = nh_exact_values(o, nh_model_gamma(o, term[j]));
        unknowns += !fixed[j];
        exact &= !nh_is_inexact(o->dag, rate[j]);
    }
    if (!exact) { /* rounded numbers bound the digits from the start: nothing would be decided */
        nh_free(rate);
        return -1;
    }
    nh_ball *ball = ball_for(o, options);
    nh_ball_fit *fit = nh_ball_fit_create(ball, n, rate, fixed, coefficient);
    bool solved = feed(o, ball, fit, (size_t)ceil(rows * (double)unknowns) + spare_rows, &state);
    double digits = solved ? check(o, ball, fit, &state, options) : -1;
    for (size_t j = 0; j < n && digits >= 0; j++)
        if (!fixed[j]) coefficient[j] = nh_ball_fit_coefficient(fit, j);
    nh_ball_fit_free(fit);
    nh_ball_free(ball);
    nh_free(rate);
    return digits;
}
