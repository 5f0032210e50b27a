#include "reduction/subspace.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

/* a with rows of zeros below, so that it has at least n of them: then all right singular vectors come out. */
static double *padded(size_t m, size_t n, const double *a, size_t *rows)
{
    *rows = m < n ? n : m;
    double *b = nh_alloc_array(*rows * n + 1, sizeof *b);
    for (size_t j = 0; j < n; j++)
        if (m) memcpy(b + j * *rows, a + j * m, m * sizeof *b);
    return b;
}

void nh_singular_values(size_t m, size_t n, const double *a, double *s)
{
    size_t rows;
    double *b = padded(m, n, a, &rows);
    if (!n || !nh_svd(rows, n, b, s, NULL, NULL))
        for (size_t j = 0; j < n; j++) s[j] = 0;
    nh_free(b);
}

size_t nh_span(size_t m, size_t n, const double *a, double small, double *out)
{
    size_t rank = 0, least = m < n ? m : n;
    if (!least) return 0;
    double *b = nh_alloc_array(m * n, sizeof *b), *s = nh_alloc_array(least, sizeof *s),
           *u = nh_alloc_array(m * least, sizeof *u);
    memcpy(b, a, m * n * sizeof *b);
    if (nh_svd(m, n, b, s, u, NULL))
        while (rank < least && s[rank] > small) rank++;
    memcpy(out, u, m * rank * sizeof *out);
    nh_free(b);
    nh_free(s);
    nh_free(u);
    return rank;
}

/* At most `most` dimensions, singular values up to `small`. */
static size_t kernel(size_t m, size_t n, const double *a, double small, size_t most, double *out, double *last_null,
                     double *first_other)
{
    size_t rows, rank = 0;
    if (last_null) *last_null = 0;
    if (first_other) *first_other = INFINITY;
    if (!n) return 0;
    double *b = padded(m, n, a, &rows), *s = nh_alloc_array(n, sizeof *s), *vt = nh_alloc_array(n * n, sizeof *vt);
    bool good = nh_svd(rows, n, b, s, NULL, vt);
    while (good && rank < n && (s[rank] > small || n - rank > most)) rank++;
    for (size_t j = rank; good && j < n; j++)
        for (size_t i = 0; i < n; i++) out[i + (j - rank) * n] = vt[j + i * n];
    if (good && rank < n && last_null) *last_null = s[rank];
    if (good && rank > 0 && first_other) *first_other = s[rank - 1];
    nh_free(b);
    nh_free(s);
    nh_free(vt);
    return good ? n - rank : 0;
}

size_t nh_kernel(size_t m, size_t n, const double *a, double small, double *out, double *last_null, double *first_other)
{
    return kernel(m, n, a, small, n, out, last_null, first_other);
}

size_t nh_kernel_of_dimension(size_t m, size_t n, const double *a, size_t dimension, double *out, double *last_null,
                              double *first_other)
{
    return kernel(m, n, a, INFINITY, dimension, out, last_null, first_other);
}

void nh_project_off(size_t m, size_t n, double *a, size_t r, const double *u)
{
    for (size_t j = 0; j < n; j++)
        for (size_t k = 0; k < r; k++) {
            double dot = 0;
            for (size_t i = 0; i < m; i++) dot += u[i + k * m] * a[i + j * m];
            for (size_t i = 0; i < m; i++) a[i + j * m] -= dot * u[i + k * m];
        }
}

double nh_coordinates(size_t m, size_t r, const double *u, size_t n, const double *a, double *x)
{
    size_t ld = m > r ? m : r;
    double worst = 0, *c = nh_alloc_array(m * r + 1, sizeof *c), *b = nh_alloc_array(ld * n + 1, sizeof *b);
    if (m > 0 && r > 0) memcpy(c, u, m * r * sizeof *c);
    for (size_t j = 0; j < n; j++)
        if (m) memcpy(b + j * ld, a + j * m, m * sizeof *b);
    if (r && n && m && nh_least_squares(m, r, c, n, b, ld, 1e-13) < 0) worst = INFINITY;
    for (size_t j = 0; j < n; j++)
        if (r) memcpy(x + j * r, b + j * ld, r * sizeof *x);
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < m; i++) {
            double rest = a[i + j * m];
            for (size_t k = 0; k < r; k++) rest -= u[i + k * m] * x[k + j * r];
            worst = fmax(worst, fabs(rest));
        }
    nh_free(c);
    nh_free(b);
    return worst;
}

double nh_largest(size_t n, const double *a)
{
    double most = 0;
    for (size_t i = 0; i < n; i++) most = fmax(most, fabs(a[i]));
    return most;
}

void nh_column_echelon(size_t d, size_t n, double small, double *c)
{
    size_t rank = 0;
    for (size_t j = 0; j < d && rank < n; j++) {
        size_t best = rank;
        for (size_t r = rank; r < n; r++)
            if (fabs(c[j + r * d]) > fabs(c[j + best * d])) best = r;
        if (fabs(c[j + best * d]) <= small) continue;
        for (size_t i = 0; i < d; i++) {
            double x = c[i + best * d];
            c[i + best * d] = c[i + rank * d];
            c[i + rank * d] = x;
        }
        double pivot = c[j + rank * d];
        for (size_t i = 0; i < d; i++) c[i + rank * d] /= pivot;
        for (size_t r = 0; r < n; r++) {
            double factor = c[j + r * d];
            for (size_t i = 0; i < d && r != rank; i++) c[i + r * d] -= factor * c[i + rank * d];
        }
        rank++;
    }
    for (size_t i = 0; i < n * d; i++)
        if (fabs(c[i] - round(c[i])) < small) c[i] = round(c[i]);
}

double nh_relative_minor(size_t rows, size_t columns, const double *a, const size_t *chosen)
{
    double *minor = nh_alloc_array(2 * rows * rows + 1, sizeof *minor), *gram = minor + rows * rows;
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < rows; j++) {
            minor[i + j * rows] = a[i * columns + chosen[j]];
            for (size_t c = 0; c < columns; c++) gram[i + j * rows] += a[i * columns + c] * a[j * columns + c];
        }
    double all = nh_determinant(rows, gram), one = nh_determinant(rows, minor);
    nh_free(minor);
    return all > 0 ? one / sqrt(all) : 0;
}

void nh_matrix_exp(size_t n, const double *a, double *out)
{
    enum { terms = 20 }; /* 0.5^20/20! is far below rounding */
    double *x = nh_alloc_array(3 * n * n + 1, sizeof *x), *power = x + n * n, *next = power + n * n, norm = 0;
    int halvings = 0;
    for (size_t i = 0; i < n; i++) {
        double row = 0;
        for (size_t j = 0; j < n; j++) row += fabs(a[i + j * n]);
        norm = fmax(norm, row);
    }
    if (norm > 0.5 && isfinite(norm)) halvings = (int)ceil(log2(norm)) + 1;
    for (size_t i = 0; i < n * n; i++) {
        x[i] = ldexp(a[i], -halvings);
        out[i] = power[i] = i % (n + 1) == 0;
    }
    for (int k = 1; k <= terms; k++) {
        nh_multiply(n, n, n, power, x, next);
        for (size_t i = 0; i < n * n; i++) out[i] += power[i] = next[i] / k;
    }
    for (; halvings > 0; halvings--) {
        nh_multiply(n, n, n, out, out, next);
        memcpy(out, next, n * n * sizeof *out);
    }
    nh_free(x);
}
