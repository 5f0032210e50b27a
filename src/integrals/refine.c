/* refine: coefficients of currents with hundreds of bits.
 *
 *     feed_points     rows Gamma(b_j)(z), n + spare of them, at exact points z
 *     ball_fit        the null space of their normal matrix in balls; vectors in echelon form
 *     check_points    digits to which each vector cancels at points that the fit has not seen
 *     nh_refine_numbers  the same with d/dtheta of the rates as further columns: Newton's steps for numbers in terms */
#include "integrals/refine.h"

#include <math.h>
#include <string.h>

#include "base/progress.h"
#include "exact/ball_fit.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/num.h"
#include "graph/symbolise_decimals.h"
#include "integrals/exact_points.h"

enum { spare_rows = 8, heldout_points = 4, most_tries = 4, most_steps = 16 };
/* largest relative change of a number that doubles gave; digits beyond the wanted ones */
static const double first_step = 1e-6, spare_digits = 20;

/* as a part of the digits to which a rate cancels: a smaller coefficient is zero up to rounding */
static const double believed = 0.75;

/* The normal equations halve the digits: twice the bits. */
static nh_ball *ball_for(const nh_model *model, const nh_options *options)
{
    return nh_ball_create(model->dag, 2 * (long)options->bits);
}

static bool feed_points(const nh_model *model, nh_ball *ball, nh_ball_fit *fit, size_t rows, uint64_t *state)
{
    size_t added = 0;
    for (size_t tries = 0; tries < most_tries * rows + 40 && added < rows && !nh_late(); tries++)
        if (nh_exact_point(model, ball, state) && nh_ball_fit_add(fit)) added++;
    return added == rows;
}

/* Writes digits[k] of every vector; false when it has no points. */
static bool check_points(const nh_model *model, nh_ball *ball, nh_ball_fit *fit, uint64_t *state,
                         const nh_options *options, nh_refined *out)
{
    size_t seen = 0;
    for (size_t k = 0; k < out->count; k++) out->digits[k] = options->bits * log10(2);
    for (size_t tries = 0; tries < most_tries * heldout_points + 40 && seen < heldout_points; tries++) {
        bool usable = nh_exact_point(model, ball, state);
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
static bool exact_rates(const nh_model *model, size_t n, const nh_ex *term, nh_ex *rate)
{
    bool exact = true;
    for (size_t j = 0; j < n && exact; j++) {
        rate[j] = nh_model_values(model, nh_model_gamma(model, term[j]));
        exact = nh_is_exact(model->dag, rate[j]);
    }
    return exact;
}

/* Frees fit and ball.  A coefficient far below the digits of its vector is rounding, and becomes 0. */
static nh_refined fit_rates(const nh_model *model, nh_ball *ball, nh_ball_fit *fit, size_t n, const nh_options *options)
{
    nh_refined out = {0};
    uint64_t state = (uint64_t)options->seed + 313;
    bool fed = feed_points(model, ball, fit, n + spare_rows, &state);
    if (fed) out.count = nh_ball_fit_solve(fit, options->digits, true);
    out.coefficient = nh_alloc_array(n * out.count + 1, sizeof *out.coefficient);
    out.digits = nh_alloc_array(out.count + 1, sizeof *out.digits);
    if (!check_points(model, ball, fit, &state, options, &out)) out.count = 0;
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

nh_refined nh_refine(const nh_model *model, size_t n, const nh_ex *term, const bool *leading, const nh_options *options)
{
    nh_refined out = {0};
    nh_ex *rate = nh_alloc_array(n + 1, sizeof *rate);
    if (exact_rates(model, n, term, rate)) {
        nh_ball *ball = ball_for(model, options);
        out = fit_rates(model, ball, nh_ball_fit_create(ball, n, rate, leading), n, options);
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

/* ---- numbers inside of terms ---- */

typedef struct {
    const nh_model *o;
    const nh_options *options;
    size_t n, pivot;
    nh_ex *term, *rate; /* lifted */
    double *c;
    nh_lifted theta;
    nh_num value[NH_MOST_LIFTED];
} newton_problem;

/* Gamma(b_j), then its derivatives by each number. */
static void rates_and_slopes(const newton_problem *p, nh_ex *e)
{
    nh_dag *d = p->o->dag;
    memcpy(e, p->rate, p->n * sizeof *e);
    for (size_t i = 0; i < p->theta.count; i++) {
        e[p->n + i] = nh_int(d, 0);
        for (size_t j = 0; j < p->n; j++)
            e[p->n + i] =
                nh_add(d, e[p->n + i],
                       nh_mul(d, nh_number(d, nh_num_decimal(p->c[j])), nh_diff(d, p->rate[j], p->theta.symbol[i])));
    }
}

/* The largest relative change of a number; infinite when the step failed. */
static double newton_step(newton_problem *p)
{
    size_t all = p->n + p->theta.count;
    nh_ex *e = nh_alloc_array(all + 1, sizeof *e);
    bool *leading = nh_alloc_array(all + 1, sizeof *leading);
    rates_and_slopes(p, e);
    leading[p->pivot] = true;
    nh_ball *ball = ball_for(p->o, p->options);
    nh_ball_fit *fit = nh_ball_fit_create(ball, all, e, leading);
    uint64_t state = (uint64_t)p->options->seed + 717;
    for (size_t i = 0; i < p->theta.count; i++)
        nh_ball_set_expression(ball, p->theta.symbol[i], nh_number(p->o->dag, p->value[i]));
    double largest = INFINITY;
    if (feed_points(p->o, ball, fit, all + spare_rows, &state) &&
        nh_ball_fit_solve(fit, p->options->digits, true) > 0) {
        double unit = nh_ball_fit_coefficient(fit, 0, p->pivot);
        largest = 0;
        for (size_t j = 0; j < p->n; j++) p->c[j] = nh_ball_fit_coefficient(fit, 0, j) / unit;
        for (size_t i = 0; i < p->theta.count; i++) {
            double change = nh_ball_fit_coefficient(fit, 0, p->n + i) / unit;
            p->value[i] = nh_num_add(p->value[i], nh_num_decimal(change));
            largest = isfinite(change) ? fmax(largest, fabs(change) / p->theta.value[i]) : INFINITY;
        }
    }
    nh_ball_fit_free(fit);
    nh_ball_free(ball);
    nh_free(leading);
    nh_free(e);
    return largest;
}

/* Inexact numbers in the terms become the symbols theta; false where there are none, or the rates are not exact. */
static bool lift_numbers(newton_problem *p, const nh_ex *term)
{
    bool exact = true;
    for (size_t j = 0; j < p->n; j++) p->term[j] = nh_symbolise_decimals(p->o->dag, term[j], &p->theta);
    if (p->theta.count == 0 || p->theta.overflow) return false;
    for (size_t j = 0; j < p->n && exact; j++) {
        p->rate[j] = nh_model_values(p->o, nh_model_gamma(p->o, p->term[j]));
        exact = nh_is_exact(p->o->dag, p->rate[j]) && isfinite(p->c[j]);
    }
    for (size_t i = 0; i < p->theta.count; i++) p->value[i] = nh_num_decimal(p->theta.value[i]);
    return exact;
}

/* Every step has to be smaller than the one before, until the digits suffice. */
static bool iterate_steps(newton_problem *p)
{
    double wanted = pow(10, -p->options->digits - spare_digits), last = first_step;
    for (int i = 0; i < most_steps; i++) {
        double change = newton_step(p);
        if (!(change < last)) return false;
        if (change < wanted) return true;
        last = change;
    }
    return false;
}

bool nh_refine_numbers(const nh_model *model, size_t n, nh_ex *term, const double *coefficient, size_t pivot,
                       const nh_options *options)
{
    nh_dag *d = model->dag;
    newton_problem p = {.o = model, .options = options, .n = n, .pivot = pivot};
    p.term = nh_alloc_array(n + 1, sizeof *p.term);
    p.rate = nh_alloc_array(n + 1, sizeof *p.rate);
    p.c = nh_alloc_array(n + 1, sizeof *p.c);
    memcpy(p.c, coefficient, n * sizeof *p.c);
    bool good = lift_numbers(&p, term) && iterate_steps(&p);
    nh_ex sharp[NH_MOST_LIFTED];
    for (size_t i = 0; i < p.theta.count && good; i++) sharp[i] = nh_number(d, p.value[i]);
    for (size_t j = 0; j < n && good; j++) term[j] = nh_substitute(d, p.term[j], p.theta.count, p.theta.symbol, sharp);
    nh_free(p.c);
    nh_free(p.rate);
    nh_free(p.term);
    return good;
}
