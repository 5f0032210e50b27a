#include "integrals/exact_points.h"

#include <math.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "graph/num.h"
#include "system/sample.h"

/* Solves for the implicit velocities to the ball's precision: the chord iteration u := u - J^-1 f(u) with J^-1 from
 * doubles gains about 15 digits a step. */
static void refine_implicit(const nh_model *model, nh_ball *ball, const double *z)
{
    nh_dag *d = model->dag;
    const nh_chart *c = model->chart;
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
        /* a symbol, not a number: a double would be multiplied into f's exact coefficients */
        for (size_t j = 0; j < k; j++) {
            nh_ex entry = nh_symbol_fresh(d, "J");
            nh_ball_set_double(ball, entry, inverse[i + j * k]);
            next[i] = nh_sub(d, next[i], nh_mul(d, entry, nh_model_values(model, c->residual[j])));
        }
    }
    for (int step = 0; step < 3 + nh_ball_bits(ball) / 40 && regular; step++) {
        for (size_t i = 0; i < k; i++) nh_ball_set_expression(ball, fresh[i], next[i]);
        for (size_t i = 0; i < k; i++) nh_ball_set_expression(ball, c->u[i], fresh[i]);
    }
    nh_tape_work_free(work);
    nh_free(next);
    nh_free(fresh);
    nh_free(inverse);
    nh_free(out);
}

/* A short rational near x, p/q with steps of less than a thousandth of the interval, so that points differ however
 * small it is; where that does not fit into 64 bits, the double itself, which is also a rational.  Returns the
 * value. */
static double set_near(nh_ball *ball, nh_ex symbol, double x, double span)
{
    enum { grid = 997 };
    static const double most = 9e15;
    double q = grid;
    while (q * span < grid && q < most / 10) q *= 10;
    double p = round(x * q);
    if (fabs(p) < most && q * span >= grid) {
        nh_ball_set_ratio(ball, symbol, (int64_t)p, (int64_t)q);
        return p / q;
    }
    nh_ball_set_double(ball, symbol, x);
    return x;
}

/* Solves for the implicit velocities; the explicit symbols are set. */
static bool complete(const nh_model *model, nh_ball *ball, double *z)
{
    bool usable = nh_chart_complete(model->chart, z);
    for (size_t j = model->width - model->chart->implicit; j < model->width; j++)
        nh_ball_set_double(ball, model->chart->symbol[j], z[j]);
    if (usable && model->chart->implicit) refine_implicit(model, ball, z);
    return usable;
}

bool nh_exact_point(const nh_model *model, nh_ball *ball, uint64_t *state)
{
    double *z = nh_alloc_array(model->width, sizeof *z);
    size_t explicit_width = model->width - model->chart->implicit;
    for (size_t j = 0; j < model->width; j++) {
        double span = model->chart->high[j] - model->chart->low[j];
        z[j] = model->chart->low[j] + span * nh_random(state);
        if (j < explicit_width) z[j] = set_near(ball, model->chart->symbol[j], z[j], span);
    }
    bool usable = complete(model, ball, z);
    nh_free(z);
    return usable;
}

bool nh_exact_at(const nh_model *model, nh_ball *ball, double *z)
{
    for (size_t j = 0; j < model->width - model->chart->implicit; j++)
        nh_ball_set_double(ball, model->chart->symbol[j], z[j]);
    return complete(model, ball, z);
}

void nh_exact_parameters(const nh_model *model, nh_ball *ball)
{
    for (size_t i = 0; i < model->system->parameters; i++) {
        nh_num value = nh_num_decimal(model->parameter_value[i]);
        if (nh_num_short(value)) nh_ball_set_ratio(ball, model->parameter[i], value.p, value.q);
        else nh_ball_set_double(ball, model->parameter[i], model->parameter_value[i]);
    }
}
