#include "reduction/relative.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "integrals/basis.h"
#include "integrals/echelon.h"
#include "reduction/subspace.h"

static double *next_row(double **block, size_t *count, size_t *capacity, size_t n)
{
    nh_grow(block, capacity, (*count + 1) * n, sizeof **block);
    double *row = *block + (*count)++ * n;
    memset(row, 0, n * sizeof *row);
    return row;
}

double *nh_relative_condition(nh_relative *r) { return next_row(&r->a, &r->conditions, &r->room, r->columns); }
double *nh_relative_value(nh_relative *r) { return next_row(&r->b, &r->values, &r->space, r->columns); }

bool nh_relative_wants_more(const nh_relative *r)
{
    return r->conditions < 3 * r->columns + 40 || r->values < 2 * r->columns + 40;
}

void nh_relative_clear(nh_relative *r)
{
    nh_free(r->a);
    nh_free(r->b);
    *r = (nh_relative){0};
}

static double *columns_of(size_t rows, size_t n, const double *row)
{
    double *a = nh_alloc_array(rows * n + 1, sizeof *a);
    for (size_t i = 0; i < rows; i++)
        for (size_t j = 0; j < n; j++) a[i + j * rows] = row[i * n + j];
    return a;
}

void nh_relative_sizes(const nh_relative *r, double *size)
{
    for (size_t j = 0; j < r->columns; j++) {
        double sum = 0;
        for (size_t i = 0; i < r->values; i++) sum += r->b[i * r->columns + j] * r->b[i * r->columns + j];
        size[j] = sqrt(sum / (double)(r->values + 1));
    }
}

double *nh_relative_null(const nh_relative *r, const nh_options *options, size_t *count, double *last_null,
                         double *first_other, nh_error *error)
{
    nh_basis basis;
    nh_nullspace_options o = nh_nullspace_options_from(options);
    size_t columns = r->columns, rows = r->conditions;
    double *vector = NULL;
    *count = 0;
    if (!r->values) {
        nh_fail(error, NH_NUMERIC, "", "the conditions of symmetries cannot be evaluated at any sample point");
        nh_error_hint(error, "give a domain without singularities of the coordinates");
        return NULL;
    }
    double *a = columns_of(rows, columns, r->a), *b = columns_of(r->values, columns, r->b);
    if (nh_basis_init(&basis, r->values, columns, b, r->values, NULL, &o, error)) {
        size_t n = basis.count;
        double *kept = nh_alloc_array(rows * n + 1, sizeof *kept), *kernel = nh_alloc_array(n * n + 1, sizeof *kernel);
        nh_basis_gather(&basis, rows, a, rows, kept);
        if (n) nh_solve_triangle_right(rows, n, basis.r, n, kept);
        /* per row of A and B alike */
        for (size_t i = 0; i < rows * n; i++) kept[i] *= sqrt((double)r->values / (double)(rows + 1));
        *count = nh_kernel(rows, n, kept, options->group, kernel, last_null, first_other);
        vector = nh_alloc_array(columns * *count + 1, sizeof *vector);
        if (*count) nh_basis_expand(&basis, columns, *count, kernel, vector);
        nh_free(kept);
        nh_free(kernel);
        nh_basis_clear(&basis);
    }
    nh_free(a);
    nh_free(b);
    return vector;
}

static double entry(const double *v, const double *size, size_t j) { return fabs(v[j]) * (size ? size[j] : 1); }

static double largest_entry(size_t n, const double *v, const double *size)
{
    double most = 0;
    for (size_t j = 0; j < n; j++) most = fmax(most, entry(v, size, j));
    return most;
}

static void exchange(size_t n, double *v, double *w)
{
    for (size_t i = 0; i < n; i++) {
        double x = v[i];
        v[i] = w[i];
        w[i] = x;
    }
}

void nh_relative_echelon(size_t n, size_t count, const size_t *order, const double *size, double *v)
{
    /* nearly dependent columns are mostly rounding errors: they give no pivot */
    static const double small = 1e-6, pivotal = 1e-3;
    size_t rank = 0;
    for (size_t at = n; at-- > 0 && rank < count;) {
        size_t j = order[at], best = rank;
        for (size_t r = rank; r < count; r++)
            if (fabs(v[j + r * n]) > fabs(v[j + best * n])) best = r;
        if (!(entry(v + best * n, size, j) > pivotal * largest_entry(n, v + best * n, size))) continue;
        if (best != rank) exchange(n, v + best * n, v + rank * n);
        double pivot = v[j + rank * n];
        for (size_t i = 0; i < n; i++) v[i + rank * n] /= pivot;
        for (size_t r = 0; r < count; r++) {
            double factor = v[j + r * n];
            if (r == rank || factor == 0) continue;
            for (size_t i = 0; i < n; i++) v[i + r * n] -= factor * v[i + rank * n];
        }
        rank++;
    }
    for (size_t r = 0; r < count; r++) {
        double whole = largest_entry(n, v + r * n, size);
        for (size_t i = 0; i < n; i++)
            if (entry(v + r * n, size, i) <= small * whole) v[i + r * n] = 0;
    }
}
