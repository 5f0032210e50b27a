#include "search/other_values.h"

#include <math.h>
#include <stdlib.h>

#include "graph/dag.h"
#include "integrals/fixed.h"

/* Values of two digits between 1.1 and 1.4 times the given ones, with different factors: relations that hold by chance
 * at the given values do not hold there. */
static double *values_nearby(const nh_model *model)
{
    enum { factors = 7 };
    static const int percent[factors] = {113, 137, 119, 131, 127, 109, 139};
    size_t n = model->system->parameters;
    double *value = nh_arena_alloc(model->arena, (n + 1) * sizeof *value);
    for (size_t i = 0; i < n; i++) {
        double x = model->parameter_value[i] == 0 ? 1 : model->parameter_value[i];
        int place = (int)floor(log10(fabs(x))) - 2;
        double unit = pow(10, abs(place)), digits = round(x * percent[i % factors] / 100 * pow(10, -place));
        digits += (double)(i / factors);
        /* the quotient of two whole numbers rounds to the same double as the decimal */
        value[i] = place < 0 ? digits / unit : digits * unit;
    }
    return value;
}

bool nh_other_values_begin(const nh_model *model, nh_other_values *other)
{
    *other = (nh_other_values){.tried = true};
    /* tapes that solve for implicit velocities are bound already */
    if (model->chart->implicit) return false;
    other->model = *model;
    other->model.parameter_value = values_nearby(model);
    return true;
}

void nh_other_values_take(nh_other_values *other, const nh_ansatz *ansatz, const nh_nullspace *nullspace, size_t pivots,
                          const nh_ex *pivot, const nh_options *options)
{
    size_t n = nullspace->dimension;
    if (n == 0) return;
    other->simplest = nh_echelon(&other->model, other->points, ansatz, nullspace, n, options);
    other->with_pivots =
        nh_echelon_with_pivots(&other->model, other->points, ansatz, nullspace, n, pivots, pivot, options);
}

void nh_other_values_clear(nh_other_values *other)
{
    nh_candidates_free(other->simplest);
    nh_candidates_free(other->with_pivots);
    nh_points_free(other->points);
    *other = (nh_other_values){0};
}

/* The sum of the terms with these coefficients; false where at the given values one has none, or all are zero. */
static bool sum_of(const nh_model *model, size_t n, const nh_ex *term, const nh_ex *coefficient, nh_ex *phi)
{
    double *value = nh_alloc_array(n + 1, sizeof *value);
    bool finite = true, any = false;
    nh_tape_constants(model->dag, n, coefficient, model->system->parameters, model->parameter, model->parameter_value,
                      value);
    *phi = nh_int(model->dag, 0);
    for (size_t j = 0; j < n; j++) {
        finite = finite && isfinite(value[j]);
        any = any || value[j] != 0;
        *phi = nh_add(model->dag, *phi, nh_mul(model->dag, coefficient[j], term[j]));
    }
    nh_free(value);
    return finite && any;
}

/* The vector as a current for all values; false where it is none. */
static bool current_of(const nh_model *model, const nh_other_values *other, nh_candidate *c, const nh_options *options,
                       nh_ex *phi)
{
    nh_echelon_refine(&other->model, other->points, c, options);
    nh_ex *rate = nh_alloc_array(2 * c->count + 1, sizeof *rate), *coefficient = rate + c->count;
    for (size_t j = 0; j < c->count; j++) rate[j] = nh_model_gamma(model, c->term[j]);
    bool good = nh_fixed_relation_of_symbols(&other->model, c->count, rate, c->coefficient, options, coefficient) &&
                sum_of(model, c->count, c->term, coefficient, phi);
    nh_free(rate);
    return good;
}

bool nh_other_values_exchange(nh_current_checker *checker, nh_other_values *other, nh_ex pivot)
{
    const nh_analysis *result = checker->result;
    nh_ex phi;
    bool exchanged = false;
    for (int i = 0; i < 2 && !exchanged; i++) {
        nh_candidates *list = i == 0 ? other->simplest : other->with_pivots;
        for (size_t k = 0; list && k < list->count && !exchanged; k++) {
            nh_candidate *c = &list->candidate[k];
            if (i == 1 && c->term[c->pivot] != pivot) continue;
            if (current_of(result->question->model, other, c, &result->question->options, &phi))
                exchanged = nh_currents_exchange_last(checker, phi);
        }
    }
    return exchanged;
}
