#include "search/search.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/parallel.h"
#include "search/spans.h"

/* A fit of fields has about n + 1 times as many columns as one of currents, each an expression of its own: beyond this
 * number it is omitted, and the result says so. */
enum { most_columns = 400 };

static nh_nullspace *solve(nh_analysis *result, size_t n, const nh_field_column *column, const nh_points *points,
                           nh_error *error)
{
    nh_equations *equations = nh_equations_create(n, nh_threads(result->question->options.threads));
    nh_rows_symmetry(result->question->model, n, column, points, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&result->question->options);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, error);
    nh_equations_free(equations);
    return s;
}

/* The distance of the currents found directly from those of the symmetries found, as spaces of values at the points,
 * both ways. */
static void compare(nh_analysis *result, const nh_ansatz *a, const nh_points *points, const nh_nullspace *current,
                    const nh_nullspace *symmetry, const nh_field_column *column)
{
    nh_model *model = result->question->model;
    nh_ex *phi = nh_alloc_array(a->columns + 1, sizeof *phi),
          *field = nh_alloc_array(symmetry->columns + 1, sizeof *field);
    for (size_t j = 0; j < a->columns; j++) phi[j] = nh_ansatz_column(a, j);
    for (size_t j = 0; j < symmetry->columns; j++) field[j] = nh_rows_field_current(model, &column[j]);
    double *x = nh_span_values(model, points, a->columns, phi, current->dimension, current->vector);
    double *y = nh_span_values(model, points, symmetry->columns, field, symmetry->dimension, symmetry->vector);
    double forward = nh_span_distance(points->count, current->dimension, x, symmetry->dimension, y);
    double back = nh_span_distance(points->count, symmetry->dimension, y, current->dimension, x);
    result->routes_compared = true;
    result->routes_angle = fmax(forward, back);
    result->routes_agree =
        current->dimension == symmetry->dimension && result->routes_angle <= result->question->options.agreement;
    nh_free(y);
    nh_free(x);
    nh_free(field);
    nh_free(phi);
}

/* The components of the fields of the ansatz' currents, each a column; 0: they are too many. */
static size_t columns_of(const nh_analysis *result, const nh_ansatz *a, nh_field_column **column)
{
    const nh_model *model = result->question->model;
    if (a->columns * (model->n + 1) > most_columns) return 0;
    nh_ex *b = nh_alloc_array(a->columns + 1, sizeof *b);
    for (size_t j = 0; j < a->columns; j++) b[j] = nh_ansatz_column(a, j);
    size_t n = nh_rows_field_columns(model, a->columns, b, column);
    nh_free(b);
    return n;
}

/* ---- fields by themselves ---- */

static const double rounding = 1e-9; /* of a column that depends on others, relative to its size */

/* Values of expressions at the points, centred; points x n (nh_free). */
static double *centred(const nh_model *model, const nh_points *points, size_t n, const nh_ex *e)
{
    size_t count = points->count;
    double *value = nh_alloc_array(n * count + 1, sizeof *value);
    nh_points_evaluate(points, model, n, e, value);
    for (size_t j = 0; j < n; j++) {
        double mean = 0, *at = value + j * count;
        for (size_t p = 0; p < count; p++) mean += at[p] / (double)count;
        for (size_t p = 0; p < count; p++) at[p] -= mean;
    }
    return value;
}

/* Which of n columns depend on those before them, by Gram-Schmidt.  Returns how many do not; their values are put one
 * after another at the head of `kept`. */
static size_t independent_columns(size_t count, size_t n, const double *value, bool *dropped, double *kept)
{
    double *unit = nh_alloc_array(count * n + 1, sizeof *unit);
    size_t rank = 0;
    for (size_t j = 0; j < n; j++) {
        double *own = unit + rank * count, before = nh_norm(count, value + j * count);
        memcpy(own, value + j * count, count * sizeof *own);
        for (size_t again = 0; again < 2; again++)
            for (size_t i = 0; i < rank; i++) {
                double dot = 0;
                for (size_t p = 0; p < count; p++) dot += unit[i * count + p] * own[p];
                for (size_t p = 0; p < count; p++) own[p] -= dot * unit[i * count + p];
            }
        double norm = nh_norm(count, own);
        dropped[j] = !(norm > rounding * before);
        if (dropped[j]) continue;
        for (size_t p = 0; p < count; p++) own[p] /= norm;
        memcpy(kept + rank++ * count, value + j * count, count * sizeof *kept);
    }
    nh_free(unit);
    return rank;
}

/* Null vectors of fields as combinations of independent currents: those of different components may be equal. */
static void write_in_currents(const nh_model *model, const nh_points *points, const nh_ex *phi, const nh_ansatz *a,
                              nh_nullspace *s)
{
    size_t count = points->count, n = a->columns, d = s->likely;
    nh_ex *column = nh_alloc_array(n + 1, sizeof *column);
    for (size_t j = 0; j < n; j++) column[j] = nh_ansatz_column(a, j);
    double *field = centred(model, points, s->columns, phi), *value = centred(model, points, n, column),
           *kept = nh_alloc_array(count * n + 1, sizeof *kept), *right = nh_alloc_array(count * d + 1, sizeof *right),
           *vector = nh_alloc_array(n * d + 1, sizeof *vector);
    bool *dropped = nh_alloc_array(n + 1, sizeof *dropped);
    size_t rank = independent_columns(count, n, value, dropped, kept);
    for (size_t k = 0; k < d; k++)
        for (size_t j = 0; j < s->columns; j++)
            for (size_t p = 0; p < count; p++)
                right[k * count + p] += s->vector[k * s->columns + j] * field[j * count + p];
    nh_least_squares(count, rank, kept, d, right, count, rounding);
    for (size_t k = 0; k < d; k++)
        for (size_t j = 0, i = 0; j < n; j++)
            if (!dropped[j]) vector[k * n + j] = right[k * count + i++];
    nh_free(s->vector);
    nh_free(s->dropped);
    s->vector = vector;
    s->dropped = dropped;
    s->columns = n;
    nh_free(right);
    nh_free(kept);
    nh_free(value);
    nh_free(field);
    nh_free(column);
}

nh_nullspace *nh_routes_fields(nh_analysis *result, const nh_ansatz *a, const nh_points *points, nh_ansatz **currents,
                               nh_error *error)
{
    const nh_model *model = result->question->model;
    nh_field_column *column;
    size_t n = columns_of(result, a, &column);
    if (n == 0) {
        nh_fail(error, NH_USAGE, "",
                "the ansatz is too large for a fit of fields: %zu columns with %zu components each", a->columns,
                model->n + 1);
        nh_error_hint(error, "there may be %d in all; `--route currents` fits currents", most_columns);
        return NULL;
    }
    nh_nullspace *s = solve(result, n, column, points, error);
    if (!s) return NULL;
    result->symmetry = nh_spectrum_of(result->arena, s);
    nh_ex *phi = nh_alloc_array(n + 1, sizeof *phi);
    for (size_t j = 0; j < n; j++) phi[j] = nh_rows_field_current(model, &column[j]);
    nh_family family = {.kind = NH_TERMS, .terms = n, .term = phi};
    *currents = nh_ansatz_create(model, points, 1, &family, n, error);
    if (*currents) write_in_currents(model, points, phi, *currents, s);
    nh_free(phi);
    if (*currents) return s;
    nh_nullspace_free(s);
    return NULL;
}

/* ---- both ---- */

void nh_routes_compare(nh_analysis *result, const nh_ansatz *a, const nh_points *points, const nh_nullspace *current)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_field_column *column;
    size_t n = columns_of(result, a, &column);
    if (a->columns == 0) return; /* no value of the unknowns: nothing to compare */
    if (n == 0) {
        nh_analysis_warn(
            result, "no fields were fitted: the ansatz is too large for that; the symmetries follow from the currents");
        return;
    }
    nh_nullspace *s = solve(result, n, column, points, &trouble);
    if (!s) {
        nh_analysis_warn(result, "the fit of fields failed: %s", trouble.what);
        return;
    }
    result->symmetry = nh_spectrum_of(result->arena, s);
    compare(result, a, points, current, s, column);
    nh_nullspace_free(s);
    if (!result->routes_agree)
        nh_analysis_warn(result, "the fits of currents and of fields disagree: dimensions %zu and %zu, angle %.1e",
                         result->current.dimension, result->symmetry.dimension, result->routes_angle);
}
