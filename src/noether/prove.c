#include "noether/prove.h"

#include <math.h>

#include "expr/diff.h"
#include "expr/normal.h"
#include "noether/exact.h"

enum { wanted_points = 4, most_tries = 40, double_digits = 8 };

static void cancel(const nh_model *o, size_t n, const nh_ex *term, const nh_options *options, nh_proof *proof)
{
    nh_ball *ball = nh_ball_create(o->dag, (long)options->bits);
    uint64_t state = (uint64_t)options->seed + 77;
    double least = INFINITY;
    for (int tries = 0; tries < most_tries && proof->points < wanted_points; tries++) {
        double log10_ratio;
        if (!nh_exact_point(o, ball, &state) || !nh_ball_relative_sum(ball, n, term, &log10_ratio)) continue;
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
    proof.proved = proof.all_parameters || nh_normal_is_zero(d, nh_exact_values(o, sum), limit) == NH_ZERO;
    bool exact = true;
    for (size_t i = 0; i < n; i++) {
        valued[i] = nh_exact_values(o, term[i]);
        exact = exact && nh_is_exact(d, valued[i]);
    }
    cancel(o, n, valued, options, &proof);
    double doubt = options->digits / 2; /* numbers too long for exact rationals were rounded to doubles when the rate was formed */
    proof.rounded = !exact;
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
