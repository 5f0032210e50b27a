#include "integrals/sharpen.h"

#include <math.h>
#include <string.h>

#include "exact/ball_fit.h"
#include "graph/diff.h"
#include "graph/symbolise_decimals.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/num.h"
#include "integrals/exact_points.h"

enum { most_steps = 16, spare_rows = 8, most_tries = 4 };
/* largest relative change of a number that doubles gave; digits beyond the wanted ones */
static const double first_step = 1e-6, spare_digits = 20;

typedef struct {
    const nh_model *o;
    const nh_options *options;
    size_t n, pivot;
    nh_ex *term, *rate; /* lifted */
    double *c;
    nh_lifted theta;
    nh_num value[NH_MOST_LIFTED];
} problem;

/* Gamma(b_j), then its derivatives by each number. */
static void columns(const problem *p, nh_ex *e)
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

static bool feed(const problem *p, nh_ball *ball, nh_ball_fit *fit, size_t rows)
{
    uint64_t state = (uint64_t)p->options->seed + 717;
    size_t added = 0;
    for (size_t i = 0; i < p->theta.count; i++)
        nh_ball_set_expression(ball, p->theta.symbol[i], nh_number(p->o->dag, p->value[i]));
    for (size_t tries = 0; tries < most_tries * rows + 40 && added < rows; tries++)
        if (nh_exact_point(p->o, ball, &state) && nh_ball_fit_add(fit)) added++;
    return added == rows;
}

/* The largest relative change of a number; infinite when the step failed. */
static double step(problem *p)
{
    size_t all = p->n + p->theta.count;
    nh_ex *e = nh_alloc_array(all + 1, sizeof *e);
    bool *leading = nh_alloc_array(all + 1, sizeof *leading);
    columns(p, e);
    leading[p->pivot] = true;
    nh_ball *ball = nh_ball_create(p->o->dag, 2 * (long)p->options->bits); /* the normal equations halve the digits */
    nh_ball_fit *fit = nh_ball_fit_create(ball, all, e, leading);
    double largest = INFINITY;
    if (feed(p, ball, fit, all + spare_rows) && nh_ball_fit_solve(fit, p->options->digits, true) > 0) {
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

static bool prepare(problem *p, const nh_ex *term)
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

static bool solve(problem *p)
{
    double wanted = pow(10, -p->options->digits - spare_digits), last = first_step;
    for (int i = 0; i < most_steps; i++) {
        double change = step(p);
        if (!(change < last)) return false;
        if (change < wanted) return true;
        last = change;
    }
    return false;
}

bool nh_sharpen(const nh_model *o, size_t n, nh_ex *term, const double *coefficient, size_t pivot,
                const nh_options *options)
{
    nh_dag *d = o->dag;
    problem p = {.o = o, .options = options, .n = n, .pivot = pivot};
    p.term = nh_alloc_array(n + 1, sizeof *p.term);
    p.rate = nh_alloc_array(n + 1, sizeof *p.rate);
    p.c = nh_alloc_array(n + 1, sizeof *p.c);
    memcpy(p.c, coefficient, n * sizeof *p.c);
    bool good = prepare(&p, term) && solve(&p);
    nh_ex sharp[NH_MOST_LIFTED];
    for (size_t i = 0; i < p.theta.count && good; i++) sharp[i] = nh_number(d, p.value[i]);
    for (size_t j = 0; j < n && good; j++) term[j] = nh_substitute(d, p.term[j], p.theta.count, p.theta.symbol, sharp);
    nh_free(p.c);
    nh_free(p.rate);
    nh_free(p.term);
    return good;
}
