/* nullspace: min |A c| / |B c| in three steps. [docs/method.md, eq. 13]
 *
 *     rows arrive           A: residuals (rows x columns), B: values; each kept as the triangle of its QR [Demmel2012]
 *     independent_values    B - mean = Q R D P^T over the columns that vary and are independent (basis.h)
 *     quotient              singular values of A D^-1 P R^-1, ascending: sigma_1 <= .. <= sigma_k
 *     decide                which of them are null, and whether a gap separates them
 *
 *        sigma    0 ........ null bound ........ undecided ........................ largest
 *                 |  FOUND      |     UNDECIDED      |       not conserved        |
 *
 * A vector x of the quotient is c = D^-1 P R^-1 x, with |B c| = 1. */
#include "integrals/nullspace.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "base/progress.h"

enum { CHUNK = 64 }; /* rows of B that receive their leading 1 together */

/* ---- collecting rows ---- */

struct nh_equations {
    size_t columns;
    nh_qr *residuals; /* A */
    nh_qr *values;    /* [1 B] */
    double *chunk;    /* CHUNK x (1 + columns) */
    const char *bad;  /* name of the values that were not finite, or NULL */
    size_t bad_column;
    bool *left_out; /* per column that was not finite somewhere; NULL: such a column is an error */
};

nh_equations *nh_equations_create(size_t columns, size_t threads)
{
    nh_equations *equations = nh_alloc(sizeof *equations);
    equations->columns = columns;
    equations->residuals = nh_qr_create(columns, threads);
    equations->values = nh_qr_create(columns + 1, threads);
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
    if (!equations) return;
    nh_qr_free(equations->residuals);
    nh_qr_free(equations->values);
    nh_free(equations->chunk);
    nh_free(equations->left_out);
    nh_free(equations);
}

/* Note the first column that is not finite, or leave out every such one; false when there is an error, now or
   before. */
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
    if (check_finite(equations, "the equations", rows, a, ld)) nh_qr_add(equations->residuals, rows, a, ld);
}

void nh_equations_add_values(nh_equations *equations, size_t rows, double *b, size_t ld)
{
    if (!check_finite(equations, "the values", rows, b, ld)) return;
    for (size_t done = 0; done < rows; done += CHUNK) {
        size_t take = rows - done < CHUNK ? rows - done : CHUNK;
        for (size_t j = 0; j < equations->columns; j++)
            memcpy(equations->chunk + (j + 1) * CHUNK, b + done + j * ld, take * sizeof *b);
        /* the column of ones must survive: the contract lets nh_qr_add overwrite it */
        for (size_t i = 0; i < take; i++) equations->chunk[i] = 1;
        nh_qr_add(equations->values, take, equations->chunk, CHUNK);
    }
}

/* ---- the variation of the values ---- */

/* The triangle of [1 B] is
 *
 *     [ sqrt(N)  sqrt(N) mean ]
 *     [    0          R_B     ]    with R_B^T R_B = (B - mean)^T (B - mean),
 *
 * so that |R_B e_j| is the variation of column j and the norm of the whole column its size. */
static bool independent_values(nh_basis *basis, nh_equations *equations, const nh_nullspace_options *options,
                               nh_error *error)
{
    size_t n = equations->columns;
    double *r = nh_alloc_array((n + 1) * (n + 1), sizeof *r);
    double *size = nh_alloc_array(n, sizeof *size);
    nh_qr_triangle(equations->values, r);
    for (size_t j = 0; j < n; j++) {
        /* as a column of zeros: dropped */
        if (equations->left_out && equations->left_out[j]) memset(r + (j + 1) * (n + 1), 0, (n + 1) * sizeof *r);
        size[j] = nh_norm(n + 1, r + (j + 1) * (n + 1));
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
    if (nh_late()) /* some rows are missing */
        return nh_fail_ended(error, "while %zu columns were compared", n);
    if (equations->bad)
        return nh_fail(error, NH_NUMERIC, "", "column %zu of the ansatz is not finite in %s at some sample point",
                       equations->bad_column, equations->bad);
    if (n > 0 && (of_a < n || of_b < n + 1)) {
        nh_fail(error, NH_NUMERIC, "",
                "%zu equations and %zu values cannot decide about %zu columns; at least %zu and %zu are needed", of_a,
                of_b, n, n, n + 1);
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
        for (size_t i = 0; i < k; i++) v[i + j * k] = vt[(k - 1 - j) + i * k];
    }
    nh_free(triangle);
    nh_free(a);
    nh_free(s);
    nh_free(vt);
    if (nh_interrupted()) return nh_fail_ended(error, "while %zu columns were compared", n);
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
    while (null < k && sigma[null] <= bound) null++;
    size_t low = null; /* one past the undecided ones */
    while (low < k && sigma[low] <= options->undecided * bound) low++;
    result->dimension = null;
    result->gap = null > 0 && null < k ? sigma[null] / fmax(sigma[null - 1], DBL_EPSILON) : INFINITY;
    if (low > null || result->gap <= options->gap) result->verdict = NH_UNDECIDED;
    else result->verdict = null > 0 ? NH_FOUND : NH_NONE;
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
        if (fabs(c[i]) > fabs(c[largest])) largest = i;
    double sign = c[largest] < 0 ? -1 : 1;
    for (size_t i = 0; i < n; i++) c[i] = sign * c[i] + 0.0; /* + 0 turns -0 into 0 */
}

static void describe_basis(nh_nullspace *result, const nh_basis *basis, const nh_nullspace_options *options)
{
    for (size_t j = 0; j < result->columns; j++) result->dropped[j] = true;
    for (size_t j = 0; j < basis->count; j++) result->dropped[basis->column[j]] = false;
    result->rank = basis->count;
    result->smallest_kept = basis->smallest_kept;
    result->largest_dropped = basis->largest_dropped;
    result->rank_in_doubt = basis->smallest_kept < options->gap * basis->largest_dropped;
}

static bool solve(nh_nullspace *result, nh_equations *equations, const nh_basis *basis,
                  const nh_nullspace_options *options, nh_error *error)
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
        for (size_t j = 0; j < result->likely; j++) fix_sign(result->columns, result->vector + j * result->columns);
    }
    nh_free(v);
    return ok;
}

/* The basis is cleared. */
static nh_nullspace *solve_in(nh_basis *basis, nh_equations *equations, const nh_nullspace_options *options,
                              nh_error *error)
{
    nh_nullspace *result = nh_alloc(sizeof *result);
    result->columns = equations->columns;
    result->rows = nh_qr_rows(equations->residuals);
    result->dropped = nh_alloc_array(result->columns, sizeof(bool));
    describe_basis(result, basis, options);
    bool ok = solve(result, equations, basis, options, error);
    nh_basis_clear(basis);
    if (ok) return result;
    nh_nullspace_free(result);
    return NULL;
}

nh_nullspace *nh_nullspace_solve(nh_equations *equations, const nh_nullspace_options *options, nh_error *error)
{
    nh_basis basis;
    if (!check_input(equations, error) || !independent_values(&basis, equations, options, error)) return NULL;
    return solve_in(&basis, equations, options, error);
}

/* All columns that vary, of norm one, and R = 1: nothing is known about their dependence. */
static void every_column(nh_basis *basis, nh_equations *equations, const nh_nullspace_options *options)
{
    size_t n = equations->columns;
    double *r = nh_alloc_array((n + 1) * (n + 1), sizeof *r);
    *basis = (nh_basis){.column = nh_alloc_array(n + 1, sizeof *basis->column),
                        .scale = nh_alloc_array(n + 1, sizeof *basis->scale),
                        .smallest_kept = 1};
    nh_qr_triangle(equations->values, r);
    for (size_t j = 0; j < n; j++) {
        double length = nh_norm(n, r + (j + 1) * (n + 1) + 1), size = nh_norm(n + 1, r + (j + 1) * (n + 1));
        if (length <= options->trivial * size) continue;
        basis->scale[j] = length;
        basis->column[basis->count++] = j;
    }
    basis->r = nh_alloc_array(basis->count * basis->count + 1, sizeof *basis->r);
    for (size_t j = 0; j < basis->count; j++) basis->r[j + j * basis->count] = 1;
    nh_free(r);
}

nh_nullspace *nh_nullspace_plain(nh_equations *equations, const nh_nullspace_options *options, nh_error *error)
{
    nh_basis basis;
    if (!check_input(equations, error)) return NULL;
    every_column(&basis, equations, options);
    return solve_in(&basis, equations, options, error);
}

void nh_nullspace_free(nh_nullspace *nullspace)
{
    if (!nullspace) return;
    nh_free(nullspace->spectrum);
    nh_free(nullspace->vector);
    nh_free(nullspace->dropped);
    nh_free(nullspace);
}
