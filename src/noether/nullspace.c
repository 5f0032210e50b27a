/* nullspace: see the header. */
#include "noether/nullspace.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

enum { CHUNK = 64 }; /* rows of B that get their leading 1 at a time */

/* ---- collecting rows ---- */

struct nh_equations {
    size_t columns;
    nh_qr *residuals; /* A */
    nh_qr *values;    /* [1 B] */
    double *chunk;    /* CHUNK x (1 + columns) */
    const char *bad;  /* what was not finite, or NULL */
    size_t bad_column;
    bool *left_out;   /* per column that was not finite somewhere; NULL: such a column is an error */
};

nh_equations *nh_equations_create(size_t columns)
{
    nh_equations *equations = nh_alloc(sizeof *equations);
    equations->columns = columns;
    equations->residuals = nh_qr_create(columns);
    equations->values = nh_qr_create(columns + 1);
    equations->chunk = nh_alloc_array(CHUNK * (columns + 1), sizeof(double));
    return equations;
}

void nh_equations_reset(nh_equations *equations)
{
    nh_qr_reset(equations->residuals);
    nh_qr_reset(equations->values);
    equations->bad = NULL;
    if (equations->left_out) memset(equations->left_out, 0, equations->columns * sizeof *equations->left_out);
}

void nh_equations_leave_out(nh_equations *equations)
{
    if (!equations->left_out) equations->left_out = nh_alloc_array(equations->columns + 1, sizeof *equations->left_out);
}

void nh_equations_free(nh_equations *equations)
{
    if (!equations)
        return;
    nh_qr_free(equations->residuals);
    nh_qr_free(equations->values);
    nh_free(equations->chunk);
    nh_free(equations->left_out);
    nh_free(equations);
}

/* Note the first column that is not finite, or leave out every such one; false when there is an error, now or before. */
static bool check_finite(nh_equations *equations, const char *what, size_t rows, double *block, size_t ld)
{
    for (size_t j = 0; j < equations->columns && !equations->bad; j++) {
        double sum = 0;
        for (size_t i = 0; i < rows; i++)
            sum += block[i + j * ld] - block[i + j * ld]; /* 0, or NaN for a NaN or an infinity */
        if (sum == 0) continue;
        if (equations->left_out) {
            equations->left_out[j] = true;
            memset(block + j * ld, 0, rows * sizeof *block);
            continue;
        }
        equations->bad = what;
        equations->bad_column = j;
    }
    return !equations->bad;
}

void nh_equations_add(nh_equations *equations, size_t rows, double *a, size_t ld)
{
    if (check_finite(equations, "the equations", rows, a, ld))
        nh_qr_add(equations->residuals, rows, a, ld);
}

void nh_equations_add_values(nh_equations *equations, size_t rows, double *b, size_t ld)
{
    if (!check_finite(equations, "the values", rows, b, ld))
        return;
    for (size_t done = 0; done < rows; done += CHUNK) {
        size_t take = rows - done < CHUNK ? rows - done : CHUNK;
        for (size_t j = 0; j < equations->columns; j++)
            memcpy(equations->chunk + (j + 1) * CHUNK, b + done + j * ld, take * sizeof *b);
        /* the column of ones must survive: the contract lets nh_qr_add overwrite it */
        for (size_t i = 0; i < take; i++)
            equations->chunk[i] = 1;
        nh_qr_add(equations->values, take, equations->chunk, CHUNK);
    }
}

/* ---- independent columns ---- */

/* Euclidean norm, safe against overflow. */
static double norm(size_t count, const double *x)
{
    double largest = 0, sum = 0;
    for (size_t i = 0; i < count; i++)
        largest = fmax(largest, fabs(x[i]));
    if (largest == 0)
        return 0;
    for (size_t i = 0; i < count; i++)
        sum += x[i] / largest * (x[i] / largest);
    return largest * sqrt(sum);
}

/* scale_j = |b_j|, or 0 when that is below trivial * size_j (constant) or the column is empty.  Lists the others in
 * basis->column and returns how many they are. */
static size_t equilibrate(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, const double *size,
                          double trivial)
{
    size_t count = 0;
    for (size_t j = 0; j < columns; j++) {
        double length = norm(rows, b + j * ld);
        bool constant = length == 0 || (size && length <= trivial * size[j]);
        basis->scale[j] = constant ? 0 : length;
        if (!constant)
            basis->column[count++] = j;
    }
    return count;
}

/* Column `kept` of R has come: with it the distance of each column from the span of all others, 1 / |row i of R^-1|, falls.  (A slowly
 * growing dependence, cos x = T_0 + T_2 + ..., leaves no small pivot.)  square[i]: |row i of R^-1|^2; returns the column with the largest. */
static size_t watch_rows(size_t kept, const double *r, size_t ld, double *square, double *y)
{
    size_t worst = kept;
    double rest = r[kept + kept * ld];
    memcpy(y, r + kept * ld, kept * sizeof *y);
    if (kept) nh_solve_triangle(kept, 1, r, ld, y, kept);
    square[kept] = 1 / (rest * rest);
    for (size_t i = 0; i < kept; i++) {
        square[i] += y[i] / rest * (y[i] / rest);
        if (square[i] > square[worst]) worst = i;
    }
    return worst;
}

/* Gram-Schmidt, twice for round-off, in the given order: a column that depends on those before it is dropped, so that the caller's
 * order (simplest first) decides which of dependent columns stay.  q: rows x available, unit columns; overwritten by the orthonormal ones
 * that are kept.  r gets the triangle with leading dimension `available`.  Returns a column that must go first because, much more than any
 * later one, it depends on the others; `available` when there is none. */
static size_t keep_independent(nh_basis *basis, size_t rows, size_t available, double *q, double *r, double rank)
{
    double *h = nh_alloc_array(2 * available, sizeof *h), *square = h + available, *shadow = nh_alloc_array(rows + available, sizeof *shadow);
    size_t kept = 0, *from = nh_alloc_array(available, sizeof *from), intruder = available;
    basis->smallest_kept = 1;
    for (size_t j = 0; j < available && intruder == available; j++) {
        double *x = q + j * rows, *column = r + kept * available;
        memset(column, 0, available * sizeof *column);
        for (int pass = 0; pass < 2 && kept; pass++) {
            nh_multiply(1, kept, rows, x, q, h);
            nh_multiply(rows, 1, kept, q, h, shadow);
            for (size_t i = 0; i < rows; i++) x[i] -= shadow[i];
            for (size_t i = 0; i < kept; i++) column[i] += h[i];
        }
        double rest = kept < rows ? norm(rows, x) : 0;
        if (rest < rank) {
            basis->largest_dropped = fmax(basis->largest_dropped, rest);
            continue;
        }
        basis->smallest_kept = fmin(basis->smallest_kept, rest);
        column[kept] = rest;
        for (size_t i = 0; i < rows; i++) q[i + kept * rows] = x[i] / rest;
        from[kept] = j;
        size_t worst = watch_rows(kept, r, available, square, shadow);
        if (sqrt(square[worst]) * rank > 1) {
            basis->largest_dropped = fmax(basis->largest_dropped, 1 / sqrt(square[worst]));
            intruder = from[worst];
        }
        basis->column[kept++] = basis->column[j];
    }
    basis->count = kept;
    nh_free(from);
    nh_free(shadow);
    nh_free(h);
    return intruder;
}

/* b is a triangle, and every column keeps a good part of itself apart from all others (1/|row i of R^-1|): then it is the answer, and
 * Gram-Schmidt, which is slower than the whole QR at a thousand columns, has nothing to add. */
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

/* The independent columns of those listed in basis->column, with their triangle. */
static bool choose_columns(nh_basis *basis, size_t rows, size_t available, const double *b, size_t ld, double rank)
{
    double *q = nh_alloc_array(rows * available, sizeof *q), *r = nh_alloc_array(available * available, sizeof *r);
    size_t *candidate = nh_alloc_array(available, sizeof *candidate), intruder = 0;
    memcpy(candidate, basis->column, available * sizeof *candidate);
    for (bool again = true; again && available > 0;) {
        memcpy(basis->column, candidate, available * sizeof *candidate);
        basis->count = available;
        nh_basis_gather(basis, rows, b, ld, q);
        if (!isfinite(norm(rows * available, q))) break;
        intruder = keep_independent(basis, rows, available, q, r, rank);
        again = intruder < available;
        if (!again) break;
        memmove(candidate + intruder, candidate + intruder + 1, (available - intruder - 1) * sizeof *candidate);
        available--;
    }
    bool good = intruder == available && available > 0;
    basis->r = nh_alloc_array(basis->count * basis->count + 1, sizeof(double));
    for (size_t j = 0; j < basis->count && good; j++) memcpy(basis->r + j * basis->count, r + j * available, (j + 1) * sizeof *r);
    nh_free(candidate);
    nh_free(q);
    nh_free(r);
    return good;
}

bool nh_basis_init(nh_basis *basis, size_t rows, size_t columns, const double *b, size_t ld, const double *size,
                   const nh_nullspace_options *options, nh_error *error)
{
    *basis = (nh_basis){0};
    basis->scale = nh_alloc_array(columns, sizeof(double));
    basis->column = nh_alloc_array(columns, sizeof(size_t));
    size_t available = equilibrate(basis, rows, columns, b, ld, size, options->trivial);
    if (available == 0)
        return true;
    basis->count = available;
    if (already_independent(basis, rows, columns, b, ld, options->rank)) return true;
    if (choose_columns(basis, rows, available, b, ld, options->rank)) return true;
    nh_basis_clear(basis);
    return nh_fail(error, NH_NUMERIC, "", "the columns of the ansatz are too large to be compared (overflow in the QR)");
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
        for (size_t i = 0; i < rows; i++)
            out[i + j * rows] = a[i + from * ld] / basis->scale[from];
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

/* The triangle of [1 B] is
 *
 *     [ sqrt(N)  sqrt(N) mean ]
 *     [    0          R_B     ]    with R_B^T R_B = (B - mean)^T (B - mean),
 *
 * so that |R_B e_j| is the variation of column j and the norm of the whole column its size. */
static bool independent_values(nh_basis *basis, nh_equations *equations, const nh_nullspace_options *options, nh_error *error)
{
    size_t n = equations->columns;
    double *r = nh_alloc_array((n + 1) * (n + 1), sizeof *r);
    double *size = nh_alloc_array(n, sizeof *size);
    nh_qr_triangle(equations->values, r);
    for (size_t j = 0; j < n; j++) {
        if (equations->left_out && equations->left_out[j]) memset(r + (j + 1) * (n + 1), 0, (n + 1) * sizeof *r); /* as a column of zeros: dropped */
        size[j] = norm(n + 1, r + (j + 1) * (n + 1));
    }
    bool ok = nh_basis_init(basis, n, n, r + (n + 1) + 1, n + 1, size, options, error);
    nh_free(r);
    nh_free(size);
    return ok;
}

/* ---- the quotient ---- */

static bool check_input(const nh_equations *equations, nh_error *error)
{
    size_t n = equations->columns, of_a = nh_qr_rows(equations->residuals), of_b = nh_qr_rows(equations->values);
    if (equations->bad)
        return nh_fail(error, NH_NUMERIC, "", "column %zu of the ansatz is not finite in %s at some sample point",
                       equations->bad_column, equations->bad);
    if (n > 0 && (of_a < n || of_b < n + 1)) {
        nh_fail(error, NH_NUMERIC, "",
                "%zu equations and %zu values cannot decide about %zu columns; at least %zu and %zu are needed", of_a, of_b, n,
                n, n + 1);
        return nh_error_hint(error, "take more sample points (2.5 per column are usual)");
    }
    return true;
}

/* spectrum := singular values of A D^-1 P R^-1, ascending; v: the right vectors as columns, in the same order. */
static bool quotient(nh_equations *equations, const nh_basis *basis, double *spectrum, double *v, nh_error *error)
{
    size_t n = equations->columns, k = basis->count;
    double *triangle = nh_alloc_array(n * n, sizeof *triangle);
    double *a = nh_alloc_array(n * k, sizeof *a);
    double *s = nh_alloc_array(k, sizeof *s);
    double *vt = nh_alloc_array(k * k, sizeof *vt);
    nh_qr_triangle(equations->residuals, triangle);
    nh_basis_gather(basis, n, triangle, n, a);
    nh_solve_triangle_right(n, k, basis->r, k, a);
    bool ok = nh_svd(n, k, a, s, NULL, vt);
    for (size_t j = 0; j < k && ok; j++) {
        spectrum[j] = s[k - 1 - j];
        for (size_t i = 0; i < k; i++)
            v[i + j * k] = vt[(k - 1 - j) + i * k];
    }
    nh_free(triangle);
    nh_free(a);
    nh_free(s);
    nh_free(vt);
    return ok || nh_fail(error, NH_NUMERIC, "", "the singular value decomposition of %zu columns failed", k);
}

/*     null:       sigma <= zero eps max(1, min(sigma_max, steepest))
 *     undecided:  up to `undecided` times that, or a gap that is too shallow
 *
 * Normalising by sigma_max alone would miss a sector that holds nothing but integrals. */
static void decide(nh_nullspace *result, const nh_nullspace_options *options)
{
    size_t k = result->rank, null = 0;
    const double *sigma = result->spectrum;
    result->next_left_scale = k ? sigma[k - 1] : 0;
    double bound = options->zero * DBL_EPSILON * fmax(1, fmin(options->steepest, result->next_left_scale));
    while (null < k && sigma[null] <= bound)
        null++;
    size_t low = null; /* one past the undecided ones */
    while (low < k && sigma[low] <= options->undecided * bound)
        low++;
    result->dimension = null;
    result->gap = null > 0 && null < k ? sigma[null] / fmax(sigma[null - 1], DBL_EPSILON) : INFINITY;
    if (low > null || result->gap <= options->gap)
        result->verdict = NH_UNDECIDED;
    else
        result->verdict = null > 0 ? NH_FOUND : NH_NONE;
}

/* The widest gap after values that could still be null. */
static size_t likely_null(const nh_nullspace *result, const nh_nullspace_options *options)
{
    size_t best = result->dimension;
    double widest = options->gap * options->gap;
    for (size_t j = result->dimension; j + 1 < result->rank && result->spectrum[j] <= options->likely; j++) {
        double gap = result->spectrum[j + 1] / fmax(result->spectrum[j], DBL_EPSILON);
        if (gap <= widest) continue;
        widest = gap;
        best = j + 1;
    }
    return best;
}

/* The entry of largest modulus becomes positive. */
static void fix_sign(size_t n, double *c)
{
    size_t largest = 0;
    for (size_t i = 1; i < n; i++)
        if (fabs(c[i]) > fabs(c[largest]))
            largest = i;
    double sign = c[largest] < 0 ? -1 : 1;
    for (size_t i = 0; i < n; i++)
        c[i] = sign * c[i] + 0.0; /* + 0 turns -0 into 0 */
}

static void describe_basis(nh_nullspace *result, const nh_basis *basis, const nh_nullspace_options *options)
{
    for (size_t j = 0; j < result->columns; j++)
        result->dropped[j] = true;
    for (size_t j = 0; j < basis->count; j++)
        result->dropped[basis->column[j]] = false;
    result->rank = basis->count;
    result->smallest_kept = basis->smallest_kept;
    result->largest_dropped = basis->largest_dropped;
    result->rank_in_doubt = basis->smallest_kept < options->gap * basis->largest_dropped;
}

static bool solve(nh_nullspace *result, nh_equations *equations, const nh_basis *basis, const nh_nullspace_options *options,
                  nh_error *error)
{
    size_t k = basis->count;
    double *v = nh_alloc_array(k * k, sizeof *v);
    result->spectrum = nh_alloc_array(k, sizeof(double));
    bool ok = quotient(equations, basis, result->spectrum, v, error);
    if (ok) {
        decide(result, options);
        result->likely = likely_null(result, options);
        result->vector = nh_alloc_array(result->columns * result->likely, sizeof(double));
        nh_basis_expand(basis, result->columns, result->likely, v, result->vector);
        for (size_t j = 0; j < result->likely; j++)
            fix_sign(result->columns, result->vector + j * result->columns);
    }
    nh_free(v);
    return ok;
}

nh_nullspace *nh_nullspace_solve(nh_equations *equations, const nh_nullspace_options *options, nh_error *error)
{
    nh_basis basis;
    if (!check_input(equations, error) || !independent_values(&basis, equations, options, error))
        return NULL;
    nh_nullspace *result = nh_alloc(sizeof *result);
    result->columns = equations->columns;
    result->rows = nh_qr_rows(equations->residuals);
    result->dropped = nh_alloc_array(result->columns, sizeof(bool));
    describe_basis(result, &basis, options);
    bool ok = solve(result, equations, &basis, options, error);
    nh_basis_clear(&basis);
    if (ok)
        return result;
    nh_nullspace_free(result);
    return NULL;
}

void nh_nullspace_free(nh_nullspace *nullspace)
{
    if (!nullspace)
        return;
    nh_free(nullspace->spectrum);
    nh_free(nullspace->vector);
    nh_free(nullspace->dropped);
    nh_free(nullspace);
}
