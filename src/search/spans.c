#include "search/spans.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"

double *nh_span_values(const nh_model *model, const nh_points *points, size_t terms, const nh_ex *e, size_t n,
                       const double *vector)
{
    size_t count = points->count;
    double *value = nh_alloc_array(terms * count + 1, sizeof *value), *out = nh_alloc_array(count * n + 1, sizeof *out);
    nh_points_evaluate(points, model, terms, e, value);
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

double nh_span_distance(size_t rows, size_t na, const double *a, size_t nb, const double *b)
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
