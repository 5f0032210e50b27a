#include "search/search.h"

#include <math.h>
#include <string.h>

#include "base/parallel.h"
#include "search/spans.h"

/* The symmetry route has about n + 1 times as many columns, each an expression of its own: beyond this number it is
 * omitted, and the result says so. */
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

void nh_routes_compare(nh_analysis *result, const nh_ansatz *a, const nh_points *points, const nh_nullspace *current)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_ex *b = nh_alloc_array(a->columns + 1, sizeof *b);
    for (size_t j = 0; j < a->columns; j++) b[j] = nh_ansatz_column(a, j);
    nh_field_column *column;
    size_t n = a->columns * (result->question->model->n + 1) <= most_columns
                   ? nh_rows_field_columns(result->question->model, a->columns, b, &column)
                   : 0;
    nh_free(b);
    if (a->columns == 0) return; /* no value of the unknowns: nothing to compare */
    if (n == 0) {
        nh_analysis_warn(
            result, "the symmetry route was skipped: the ansatz is too large; the symmetries follow from the currents");
        return;
    }
    nh_nullspace *s = solve(result, n, column, points, &trouble);
    if (!s) {
        nh_analysis_warn(result, "the symmetry route failed: %s", trouble.what);
        return;
    }
    result->symmetry = nh_spectrum_of(result->arena, s);
    compare(result, a, points, current, s, column);
    nh_nullspace_free(s);
    if (!result->routes_agree)
        nh_analysis_warn(result, "the two routes disagree: dimensions %zu and %zu, angle %.1e",
                         result->current.dimension, result->symmetry.dimension, result->routes_angle);
}
