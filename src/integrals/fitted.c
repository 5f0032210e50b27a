#include "integrals/fitted.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/function.h"

static const double most_error = 1e-4, safety = 2, least_gap = 10;

static bool has_table(const nh_dag *dag, nh_ex e)
{
    NH_LIST(call);
    size_t n = nh_functions_in(dag, e, &call);
    bool found = false;
    for (size_t i = 0; i < n; i++) found |= nh_function_of(dag, call[i]) == NH_TABLE;
    return found;
}

bool nh_fitted_is(const nh_model *model)
{
    if (!nh_declared_has_table(model->dag)) return false;
    bool found = has_table(model->dag, model->Lbar);
    for (size_t s = 0; s < model->m && !found; s++) found = has_table(model->dag, model->rho[s]);
    for (size_t i = 0; i < model->n && !found; i++) found = has_table(model->dag, model->a[i]);
    return found;
}

void nh_fitted_options(const nh_model *model, nh_options *options)
{
    if (!nh_fitted_is(model)) return;
    double error = fmin(nh_declared_table_error(model->dag), most_error);
    options->likely = fmax(options->likely, error);
    options->heldout = fmax(options->heldout, error);
    options->gap = fmin(options->gap, least_gap);
}

double nh_fitted_digits(const nh_nullspace *s)
{
    if (!s->rank) return 0;
    double part = (double)s->rank / (double)s->rows, least = fmax(s->spectrum[0], DBL_EPSILON),
           next = s->rank > 1 ? s->spectrum[1] : INFINITY;
    if (!(part < 1) || !(next > least)) return 0;
    double error = safety * least * (1 + sqrt(part)) / sqrt(1 - part) / (next - least);
    return error < 1 ? floor(-log10(fmax(error, DBL_EPSILON))) : 0;
}

/* The coefficients of the terms that the null vector 0 of the ansatz gives, that of the pivot being 1. */
static bool coefficients(const nh_ansatz *a, const nh_nullspace *s, const nh_candidate *c, double *out)
{
    double pivot = 0;
    for (size_t j = 0; j < c->count; j++) {
        out[j] = 0;
        for (size_t t = 0; t < a->terms; t++)
            for (size_t k = 0; k < a->columns && a->term[t] == c->term[j]; k++)
                out[j] += a->to_term[t + k * a->terms] * s->vector[k];
        if (j == c->pivot) pivot = out[j];
    }
    for (size_t j = 0; j < c->count; j++) out[j] /= pivot;
    return pivot != 0 && isfinite(1 / pivot);
}

/* The largest difference of both, each times the root mean square of its term, relative to the largest such term. */
static double difference(const nh_model *model, const nh_points *points, const nh_candidate *c, const double *again)
{
    double worst = 0, largest = 0, *value = nh_alloc_array(c->count * points->count, sizeof *value);
    nh_points_evaluate(points, model, c->count, c->term, value);
    for (size_t j = 0; j < c->count; j++) {
        double square = 0;
        for (size_t p = 0; p < points->count; p++) square += pow(value[j * points->count + p], 2);
        double size = sqrt(square / (double)points->count);
        worst = fmax(worst, size * fabs(again[j] - c->coefficient[j]));
        largest = fmax(largest, size * fabs(c->coefficient[j]));
    }
    nh_free(value);
    return worst / largest;
}

double nh_fitted_again(const nh_model *model, const nh_points *points, const nh_candidate *c, const nh_options *options)
{
    if (c->count < 2) return INFINITY;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_family family = {.kind = NH_TERMS, .terms = c->count, .term = c->term};
    nh_ansatz *a = nh_ansatz_create(model, points, 1, &family, (size_t)options->columns, &ignored);
    if (!a) return 0;
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_rows *rows = nh_rows_create(model, a, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(options);
    limits.likely = INFINITY; /* the first vector is wanted in any case */
    limits.gap = 1;
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, &ignored);
    double digits = 0, *again = nh_alloc_array(c->count, sizeof *again);
    if (s && s->likely && coefficients(a, s, c, again)) {
        double apart = difference(model, points, c, again);
        digits = fmin(nh_fitted_digits(s), floor(-log10(fmax(apart, DBL_EPSILON))));
    }
    nh_free(again);
    nh_nullspace_free(s);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_ansatz_free(a);
    return fmax(digits, 0);
}
