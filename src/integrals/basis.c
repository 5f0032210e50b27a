/* basis: which columns of a sampled matrix are independent.
 *
 *     equilibrate          columns of norm 1; constant ones are marked by scale 0 [VanDerSluis1969]
 *     already_independent  a well conditioned triangle is taken as it is
 *     keep_independent     otherwise Gram-Schmidt, twice, column by column:
 *                             rest |(1 - Q Q^T) b| < rank          dependent on those before it: dropped
 *                             1/|row i of R^-1| < rank            column i lies in the span of all others: dropped
 *
 * [GolubVanLoan2013] */
#include "integrals/basis.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

/* scale_j = |b_j|, or 0 when that is below trivial * size_j (constant) or the column is empty.  Lists the others in
 * basis->column and returns how many they are. */
static size_t equilibrate(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, const double *size,
                          double trivial)
{
    size_t count = 0;
    for (size_t j = 0; j < columns; j++) {
        double length = nh_norm(rows, b + j * ld);
        bool constant = length == 0 || (size && length <= trivial * size[j]);
        basis->scale[j] = constant ? 0 : length;
        if (!constant) basis->column[count++] = j;
    }
    return count;
}

/* Adds column `kept` of R^-1.  The distance of each column from the span of all others, 1 / |row i of R^-1|, falls with
 * it.  (A slowly growing dependence, cos x = T_0 + T_2 + ..., leaves no small pivot.) square[i]: |row i of R^-1|^2;
 * returns the column with the largest. */
static size_t watch_rows(size_t kept, const double *r, size_t ld, double *inverse, double *square)
{
    size_t worst = kept;
    double rest = r[kept + kept * ld], *y = inverse + kept * ld;
    memcpy(y, r + kept * ld, kept * sizeof *y);
    if (kept) nh_solve_triangle(kept, 1, r, ld, y, kept);
    y[kept] = 1;
    square[kept] = 0;
    for (size_t i = 0; i <= kept; i++) {
        y[i] /= rest;
        square[i] += y[i] * y[i];
        if (square[i] > square[worst]) worst = i;
    }
    return worst;
}

/* The squares of the rows of the first `kept` columns of R^-1, summed in the same order as before. */
static void sum_rows(size_t kept, size_t ld, const double *inverse, double *square)
{
    memset(square, 0, kept * sizeof *square);
    for (size_t j = 0; j < kept; j++)
        for (size_t i = 0; i <= j; i++) square[i] += inverse[i + j * ld] * inverse[i + j * ld];
}

/* Gram-Schmidt, twice because of rounding, in the given order: a column that depends on those before it is dropped, so
 * that the caller's order (simplest first) decides which of dependent columns stay.  A column that depends on the
 * others far more than any later one does is dropped too, and what came after it is done again without it.
 * unit: rows x available, the columns listed in basis->column, which becomes the list of those that are kept; r
 * receives the triangle with leading dimension `available`. */
static void keep_independent(nh_basis *basis, size_t rows, size_t available, const double *unit, double *r, double rank)
{
    double *q = nh_alloc_array(rows * available, sizeof *q), *h = nh_alloc_array(2 * available, sizeof *h),
           *square = h + available, *shadow = nh_alloc_array(rows, sizeof *shadow),
           *inverse = nh_alloc_array(available * available, sizeof *inverse);
    size_t kept = 0, *from = nh_alloc_array(available, sizeof *from);
    bool *intruder = nh_alloc_array(available, sizeof *intruder);
    for (size_t j = 0; j < available; j++) {
        if (intruder[j]) continue;
        double *x = q + kept * rows, *column = r + kept * available;
        memcpy(x, unit + j * rows, rows * sizeof *x);
        memset(column, 0, available * sizeof *column);
        for (int pass = 0; pass < 2 && kept; pass++) {
            nh_multiply(1, kept, rows, x, q, h);
            nh_multiply(rows, 1, kept, q, h, shadow);
            for (size_t i = 0; i < rows; i++) x[i] -= shadow[i];
            for (size_t i = 0; i < kept; i++) column[i] += h[i];
        }
        double rest = kept < rows ? nh_norm(rows, x) : 0;
        if (rest < rank) {
            basis->largest_dropped = fmax(basis->largest_dropped, rest);
            continue;
        }
        column[kept] = rest;
        for (size_t i = 0; i < rows; i++) x[i] /= rest;
        from[kept] = j;
        size_t worst = watch_rows(kept, r, available, inverse, square);
        if (sqrt(square[worst]) * rank > 1) {
            basis->largest_dropped = fmax(basis->largest_dropped, 1 / sqrt(square[worst]));
            intruder[from[worst]] = true;
            j = from[kept = worst];
            sum_rows(kept, available, inverse, square);
        } else kept++;
    }
    basis->smallest_kept = 1;
    for (size_t i = 0; i < kept; i++) {
        basis->smallest_kept = fmin(basis->smallest_kept, r[i + i * available]);
        basis->column[i] = basis->column[from[i]];
    }
    basis->count = kept;
    nh_free(intruder);
    nh_free(from);
    nh_free(inverse);
    nh_free(shadow);
    nh_free(h);
    nh_free(q);
}

/* b is a triangle, and every column has a large distance from the span of the others (1/|row i of R^-1|): then it is
 * the answer.  Gram-Schmidt, which is slower than the whole QR at a thousand columns, would change nothing. */
static bool already_independent(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, double rank)
{
    size_t n = basis->count;
    double safe = sqrt(rank), least = 1;
    if (n != columns || n != rows) return false;
    for (size_t j = 0; j < n; j++) {
        for (size_t i = j + 1; i < n; i++)
            if (b[i + j * ld] != 0) return false;
        least = fmin(least, fabs(b[j + j * ld]) / basis->scale[j]);
    }
    if (!(least > safe)) return false;
    double *r = nh_alloc_array(n * n, sizeof *r), *inverse = nh_alloc_array(n * n, sizeof *inverse), apart = 1;
    nh_basis_gather(basis, n, b, ld, r);
    for (size_t j = 0; j < n; j++) inverse[j + j * n] = 1;
    nh_solve_triangle(n, n, r, n, inverse, n);
    for (size_t i = 0; i < n; i++) {
        double square = 0;
        for (size_t j = i; j < n; j++) square += inverse[i + j * n] * inverse[i + j * n];
        apart = fmin(apart, 1 / sqrt(square));
    }
    nh_free(inverse);
    if (apart > safe) {
        basis->r = r;
        basis->smallest_kept = least;
        return true;
    }
    nh_free(r);
    return false;
}

/* The independent columns of those listed in basis->column, with their triangle; false where one is not finite. */
static bool choose_columns(nh_basis *basis, size_t rows, size_t available, const double *b, size_t ld, double rank)
{
    double *unit = nh_alloc_array(rows * available, sizeof *unit), *r = NULL;
    nh_basis_gather(basis, rows, b, ld, unit);
    bool good = isfinite(nh_norm(rows * available, unit));
    if (good) {
        r = nh_alloc_array(available * available, sizeof *r);
        keep_independent(basis, rows, available, unit, r, rank);
        basis->r = nh_alloc_array(basis->count * basis->count + 1, sizeof(double));
        for (size_t j = 0; j < basis->count; j++)
            memcpy(basis->r + j * basis->count, r + j * available, (j + 1) * sizeof *r);
    }
    nh_free(r);
    nh_free(unit);
    return good;
}

bool nh_basis_init(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, const double *size,
                   const nh_nullspace_options *options, nh_error *error)
{
    *basis = (nh_basis){0};
    basis->scale = nh_alloc_array(columns, sizeof(double));
    basis->column = nh_alloc_array(columns, sizeof(size_t));
    size_t available = equilibrate(basis, rows, columns, b, ld, size, options->trivial);
    if (available == 0) return true;
    basis->count = available;
    if (already_independent(basis, rows, columns, b, ld, options->rank)) return true;
    if (choose_columns(basis, rows, available, b, ld, options->rank)) return true;
    nh_basis_clear(basis);
    return nh_fail(error, NH_NUMERIC, "",
                   "the columns of the ansatz are too large to be compared (overflow in the QR)");
}

void nh_basis_clear(nh_basis *basis)
{
    nh_free(basis->column);
    nh_free(basis->r);
    nh_free(basis->scale);
    *basis = (nh_basis){0};
}

void nh_basis_gather(const nh_basis *basis, size_t rows, const double *a, size_t ld, double *out)
{
    for (size_t j = 0; j < basis->count; j++) {
        size_t from = basis->column[j];
        for (size_t i = 0; i < rows; i++) out[i + j * rows] = a[i + from * ld] / basis->scale[from];
    }
}

void nh_basis_expand(const nh_basis *basis, size_t columns, size_t count_of_x, double *x, double *c)
{
    nh_solve_triangle(basis->count, count_of_x, basis->r, basis->count, x, basis->count);
    memset(c, 0, columns * count_of_x * sizeof *c);
    for (size_t k = 0; k < count_of_x; k++)
        for (size_t j = 0; j < basis->count; j++) {
            size_t to = basis->column[j];
            c[to + k * columns] = x[j + k * basis->count] / basis->scale[to];
        }
}
