#include "noether/prove.h"

#include <math.h>

#include "base/linalg.h"
#include "expr/ball.h"
#include "expr/diff.h"
#include "expr/normal.h"
#include "system/sample.h"

enum { wanted_points = 4, most_tries = 40, double_digits = 12 };

static nh_ex with_values(const nh_model *o, nh_ex e)
{
    size_t n = o->system->parameters;
    nh_ex *value = nh_alloc_array(n + 1, sizeof *value);
    for (size_t i = 0; i < n; i++) {
        double x = o->parameter_value[i];
        int64_t scale = 1;
        while (scale < 1000000000 && x * (double)scale != round(x * (double)scale)) scale *= 10;
        bool decimal = fabs(x * (double)scale - round(x * (double)scale)) == 0 && fabs(x) * (double)scale < 9e15;
        value[i] = decimal ? nh_ratio(o->dag, (int64_t)round(x * (double)scale), scale) : nh_real(o->dag, x);
    }
    e = nh_substitute(o->dag, e, n, o->parameter, value);
    nh_free(value);
    return e;
}

/* The implicit velocities to the ball's precision: chord iteration u := u - J^-1 f(u) with J^-1 from doubles gains about 15 digits a step. */
static void refine_implicit(const nh_model *o, nh_ball *ball, const double *z, const nh_options *options)
{
    nh_dag *d = o->dag;
    const nh_chart *c = o->chart;
    size_t k = c->implicit;
    double *out = nh_alloc_array(k + k * k, sizeof *out), *inverse = nh_alloc_array(k * k, sizeof *inverse);
    nh_ex *fresh = nh_alloc_array(k, sizeof *fresh), *next = nh_alloc_array(k, sizeof *next);
    nh_tape_work *work = nh_tape_work_create(c->newton);
    nh_tape_eval(c->newton, work, z, out);
    for (size_t i = 0; i < k; i++) inverse[i + i * k] = 1;
    bool regular = nh_solve(k, out + k, k, inverse, NULL);
    for (size_t i = 0; i < k && regular; i++) {
        fresh[i] = nh_symbol_fresh(d, "u");
        next[i] = c->u[i];
        for (size_t j = 0; j < k; j++) { /* a symbol, not a number: a double would be multiplied into f's exact coefficients */
            nh_ex entry = nh_symbol_fresh(d, "J");
            nh_ball_set_double(ball, entry, inverse[i + j * k]);
            next[i] = nh_sub(d, next[i], nh_mul(d, entry, with_values(o, c->residual[j])));
        }
    }
    for (int step = 0; step < 3 + options->bits / 40 && regular; step++) {
        for (size_t i = 0; i < k; i++) nh_ball_set_expression(ball, fresh[i], next[i]);
        for (size_t i = 0; i < k; i++) nh_ball_set_expression(ball, c->u[i], fresh[i]);
    }
    nh_tape_work_free(work);
    nh_free(next);
    nh_free(fresh);
    nh_free(inverse);
    nh_free(out);
}

/* A random point with short rational coordinates. */
static void set_point(const nh_model *o, nh_ball *ball, uint64_t *state, const nh_options *options, bool *usable)
{
    enum { grid = 997 };
    double *z = nh_alloc_array(o->width, sizeof *z);
    size_t explicit_width = o->width - o->chart->implicit;
    for (size_t j = 0; j < o->width; j++) {
        double span = o->chart->high[j] - o->chart->low[j], x = o->chart->low[j] + span * nh_random(state);
        int64_t p = (int64_t)round(x * grid);
        z[j] = (double)p / grid;
        if (j < explicit_width) nh_ball_set_ratio(ball, o->chart->symbol[j], p, grid);
    }
    *usable = nh_chart_complete(o->chart, z);
    for (size_t j = explicit_width; j < o->width; j++) nh_ball_set_double(ball, o->chart->symbol[j], z[j]);
    if (*usable && o->chart->implicit) refine_implicit(o, ball, z, options);
    nh_free(z);
}

static void cancel(const nh_model *o, size_t n, const nh_ex *term, const nh_options *options, nh_proof *proof)
{
    nh_ball *ball = nh_ball_create(o->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 77;
    double least = INFINITY;
    for (int tries = 0; tries < most_tries && proof->points < wanted_points; tries++) {
        bool usable;
        double log10_ratio;
        set_point(o, ball, &state, options, &usable);
        if (!usable || !nh_ball_relative_sum(ball, n, term, &log10_ratio)) continue;
        least = fmin(least, -log10_ratio);
        proof->points++;
    }
    nh_ball_free(ball);
    double most = options->bits * log10(2);
    proof->digits = proof->points == 0 ? 0 : fmax(0, fmin(least, most));
}

nh_proof nh_prove_zero(const nh_model *o, size_t n, const nh_ex *term, bool parameters_free, const nh_options *options)
{
    nh_proof proof = {0};
    nh_dag *d = o->dag;
    nh_ex sum = nh_int(d, 0), *valued = nh_alloc_array(n + 1, sizeof *valued);
    for (size_t i = 0; i < n; i++) sum = nh_add(d, sum, term[i]);
    size_t limit = (size_t)options->proof_terms;
    if (parameters_free && o->chart->implicit == 0) proof.all_parameters = nh_normal_is_zero(d, sum, limit) == NH_ZERO;
    proof.proved = proof.all_parameters || nh_normal_is_zero(d, with_values(o, sum), limit) == NH_ZERO;
    bool exact = true;
    for (size_t i = 0; i < n; i++) {
        valued[i] = with_values(o, term[i]);
        exact = exact && nh_is_exact(d, valued[i]);
    }
    cancel(o, n, valued, options, &proof);
    double doubt = options->digits / 2; /* numbers too long for exact rationals were rounded to doubles when the rate was formed */
    if (!exact && doubt > double_digits) doubt = double_digits;
    proof.refuted = !proof.proved && proof.points > 0 && proof.digits < doubt;
    nh_free(valued);
    return proof;
}

nh_proof nh_prove_current(const nh_model *o, nh_ex phi, bool parameters_free, const nh_options *options)
{
    nh_dag *d = o->dag;
    size_t n = 1 + o->m + o->n;
    nh_ex *term = nh_alloc_array(n, sizeof *term);
    term[0] = nh_diff(d, phi, o->system->t);
    for (size_t s = 0; s < o->m; s++) term[1 + s] = nh_mul(d, o->rho[s], nh_diff(d, phi, o->system->coordinate[s].q));
    for (size_t i = 0; i < o->n; i++) term[1 + o->m + i] = nh_mul(d, o->a[i], nh_model_Y(o, i, phi));
    nh_proof proof = nh_prove_zero(o, n, term, parameters_free, options);
    nh_free(term);
    return proof;
}
