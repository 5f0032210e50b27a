#include "study/routes.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"

/* The symmetry route has about n + 1 times as many columns, each an expression of its own: beyond this it is left out, and said. */
enum { most_columns = 400 };

/* Values of `n` combinations (vector: terms x n) of expressions at the points, each centred and of norm 1; points x n. */
static double *combinations(const nh_model *o, const nh_points *points, size_t terms, const nh_ex *e, size_t n, const double *vector)
{
    size_t count = points->count;
    double *value = nh_alloc_array(terms * count + 1, sizeof *value), *out = nh_alloc_array(count * n + 1, sizeof *out);
    nh_points_evaluate(points, o, terms, e, value);
    nh_multiply(count, n, terms, value, vector, out);
    nh_free(value);
    for (size_t k = 0; k < n; k++) {
        double mean = 0, norm = 0, *x = out + k * count;
        for (size_t p = 0; p < count; p++) mean += x[p] / (double)count;
        for (size_t p = 0; p < count; p++) norm += (x[p] - mean) * (x[p] - mean);
        for (size_t p = 0; p < count; p++) x[p] = norm > 0 ? (x[p] - mean) / sqrt(norm) : 0;
    }
    return out;
}

/* Largest distance of the columns of b from the span of those of a. */
static double distance(size_t rows, size_t na, const double *a, size_t nb, const double *b)
{
    double worst = 0;
    if (na == 0) return nb ? 1 : 0;
    double *A = nh_alloc_array(rows * na, sizeof *A), *x = nh_alloc_array(rows, sizeof *x);
    for (size_t k = 0; k < nb; k++) {
        memcpy(A, a, rows * na * sizeof *A);
        memcpy(x, b + k * rows, rows * sizeof *x);
        if (nh_least_squares(rows, na, A, 1, x, rows, 1e-12) < 0) return 1;
        double rest = 0;
        for (size_t p = 0; p < rows; p++) {
            double r = b[p + k * rows];
            for (size_t j = 0; j < na; j++) r -= a[p + j * rows] * x[j];
            rest += r * r;
        }
        worst = fmax(worst, sqrt(rest));
    }
    nh_free(x);
    nh_free(A);
    return worst;
}

static nh_nullspace *solve(nh_result *r, size_t n, const nh_field_column *column, const nh_points *points, nh_error *error)
{
    nh_equations *equations = nh_equations_create(n);
    nh_rows_symmetry(r->model, n, column, points, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, error);
    nh_equations_free(equations);
    return s;
}

static void compare(nh_result *r, const nh_ansatz *a, const nh_points *points, const nh_nullspace *current, const nh_nullspace *symmetry,
                    const nh_field_column *column)
{
    nh_ex *phi = nh_alloc_array(a->columns + 1, sizeof *phi), *field = nh_alloc_array(symmetry->columns + 1, sizeof *field);
    for (size_t j = 0; j < a->columns; j++) phi[j] = nh_ansatz_column(a, j);
    for (size_t j = 0; j < symmetry->columns; j++) field[j] = nh_rows_field_current(r->model, &column[j]);
    double *x = combinations(r->model, points, a->columns, phi, current->dimension, current->vector);
    double *y = combinations(r->model, points, symmetry->columns, field, symmetry->dimension, symmetry->vector);
    double forward = distance(points->count, current->dimension, x, symmetry->dimension, y);
    double back = distance(points->count, symmetry->dimension, y, current->dimension, x);
    r->routes_compared = true;
    r->routes_angle = fmax(forward, back);
    r->routes_agree = current->dimension == symmetry->dimension && r->routes_angle <= r->options.agreement;
    nh_free(y);
    nh_free(x);
    nh_free(field);
    nh_free(phi);
}

void nh_routes_compare(nh_result *r, const nh_ansatz *a, const nh_points *points, const nh_nullspace *current)
{
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_ex *b = nh_alloc_array(a->columns + 1, sizeof *b);
    for (size_t j = 0; j < a->columns; j++) b[j] = nh_ansatz_column(a, j);
    nh_field_column *column;
    size_t n = a->columns * (r->model->n + 1) <= most_columns ? nh_rows_field_columns(r->model, a->columns, b, &column) : 0;
    nh_free(b);
    if (n == 0) {
        nh_result_warn(r, "the symmetry route was left out: the ansatz is too large for it; the fields were computed from the currents");
        return;
    }
    nh_nullspace *s = solve(r, n, column, points, &trouble);
    if (!s) {
        nh_result_warn(r, "the symmetry route failed: %s", trouble.what);
        return;
    }
    r->symmetry = nh_spectrum_of(r->arena, s);
    compare(r, a, points, current, s, column);
    nh_nullspace_free(s);
    if (!r->routes_agree)
        nh_result_warn(r, "the two routes disagree: dimensions %zu and %zu, angle %.1e", r->current.dimension, r->symmetry.dimension, r->routes_angle);
}
