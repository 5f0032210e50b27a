/* pencil: see the header.
 *
 * Nothing of the size of Q is formed.  One QR of the rows [B A] gives
 *
 *     [ R11 R12 ]    B = Q R11,   Q^T A = R12,   (1 - Q Q^T) A = Q' R22,
 *     [  0  R22 ]
 *
 * so that K = R12 R11^-1 and, but for the orthonormal Q', rest = R22 R11^-1.
 *
 *     header          here
 *     R               basis.r (after equilibration and pivoting)
 *     K, rest         work.k, work.rest
 *     V               work.v, an orthonormal basis as columns */
#include "integrals/pencil.h"

#include <float.h>
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

typedef struct {
    size_t rows, columns;
    const double *a, *b; /* borrows the caller's */
    nh_basis basis;
    size_t n;         /* independent columns */
    double *k, *rest; /* n x n */
    double null;      /* singular values up to this count as zero */
    size_t dimension;
    double *v; /* n x dimension */
    double *h; /* dimension x dimension: V^T K V */
} work;

static double *new_matrix(size_t rows, size_t columns) { return nh_alloc_array(rows * columns, sizeof(double)); }

static bool failed(nh_error *error)
{
    return nh_fail(error, NH_NUMERIC, "", "the pencil: a singular value or eigenvalue iteration failed");
}

/* ---- the matrices ---- */

static bool check_column(const char *what, size_t j, size_t rows, const double *x, nh_error *error)
{
    double sum = 0;
    for (size_t i = 0; i < rows; i++) sum += x[i] - x[i]; /* 0, or NaN for a NaN or an infinity */
    return sum == 0 ||
           nh_fail(error, NH_NUMERIC, "", "column %zu of the pencil is not finite in %s at some sample point", j, what);
}

/* With fewer than two rows per column, rest would have a null space whatever the columns are. */
static bool check_input(const work *w, nh_error *error)
{
    if (w->rows < 2 * w->columns) {
        nh_fail(error, NH_NUMERIC, "",
                "%zu equations do not determine the frequencies of %zu columns; at least %zu are needed", w->rows,
                w->columns, 2 * w->columns);
        return nh_error_hint(error, "take more sample points (2.5 per column are usual)");
    }
    for (size_t j = 0; j < w->columns; j++)
        if (!check_column("the derivatives", j, w->rows, w->a + j * w->rows, error) ||
            !check_column("the values", j, w->rows, w->b + j * w->rows, error))
            return false;
    return true;
}

/* t (2 columns x 2 columns) := triangle of [B A]. */
static void triangle_of_both(const work *w, double *t)
{
    enum { CHUNK = 64 };
    nh_qr *qr = nh_qr_create(2 * w->columns, 1);
    double *chunk = new_matrix(CHUNK, 2 * w->columns);
    for (size_t done = 0; done < w->rows; done += CHUNK) {
        size_t take = w->rows - done < CHUNK ? w->rows - done : CHUNK;
        for (size_t j = 0; j < w->columns; j++) {
            memcpy(chunk + j * CHUNK, w->b + done + j * w->rows, take * sizeof *chunk);
            memcpy(chunk + (w->columns + j) * CHUNK, w->a + done + j * w->rows, take * sizeof *chunk);
        }
        nh_qr_add(qr, take, chunk, CHUNK);
    }
    nh_qr_triangle(qr, t);
    nh_qr_free(qr);
    nh_free(chunk);
}

/* The same for the independent columns only, in equilibrated units: s (2n x 2n) := triangle of [B A] D^-1 P. */
static void triangle_of_basis(const work *w, const double *t, double *s)
{
    size_t height = 2 * w->columns;
    double *kept = new_matrix(height, 2 * w->n);
    nh_basis_gather(&w->basis, height, t, height, kept);
    nh_basis_gather(&w->basis, height, t + height * w->columns, height, kept + height * w->n);
    nh_qr *qr = nh_qr_create(2 * w->n, 1);
    nh_qr_add(qr, height, kept, height);
    nh_qr_triangle(qr, s);
    nh_qr_free(qr);
    nh_free(kept);
}

/* Largest singular value of the rows x columns matrix m, which is kept. */
static bool spectral_norm(size_t rows, size_t columns, const double *m, double *norm)
{
    double *copy = new_matrix(rows, columns), *s = new_matrix(columns, 1);
    memcpy(copy, m, rows * columns * sizeof *copy);
    bool ok = nh_svd(rows, columns, copy, s, NULL, NULL);
    *norm = columns ? s[0] : 0;
    nh_free(copy);
    nh_free(s);
    return ok;
}

/* K and rest, and from |A R^-1| the bound below which a value counts as zero.  It is the upper end of the undecided
 * band: errors of K grow on the way to V, and a frequency found here is only proposed; an ordinary null space
 * decides. */
static bool reduce(work *w, const nh_nullspace_options *options, nh_error *error)
{
    double *t = new_matrix(2 * w->columns, 2 * w->columns), *s = NULL, *quotient = NULL;
    triangle_of_both(w, t);
    bool ok = nh_basis_init(&w->basis, w->columns, w->columns, t, 2 * w->columns, NULL, options, error);
    size_t n = w->n = w->basis.count;
    if (ok && n > 0) {
        s = new_matrix(2 * n, 2 * n);
        triangle_of_basis(w, t, s);
        quotient = s + 2 * n * n;      /* [R12; R22] */
        for (size_t j = 0; j < n; j++) /* the same triangle, with the signs that Q has here */
            memcpy(w->basis.r + j * n, s + j * 2 * n, n * sizeof *s);
        nh_solve_triangle_right(2 * n, n, w->basis.r, n, quotient);
        double norm;
        ok = spectral_norm(2 * n, n, quotient, &norm) || failed(error);
        w->null = options->undecided * options->zero * DBL_EPSILON * fmax(1, norm);
        w->k = new_matrix(n, n);
        w->rest = new_matrix(n, n);
        for (size_t j = 0; j < n; j++) {
            memcpy(w->k + j * n, quotient + j * 2 * n, n * sizeof *s);
            memcpy(w->rest + j * n, quotient + n + j * 2 * n, n * sizeof *s);
        }
    }
    nh_free(t);
    nh_free(s);
    return ok;
}

/* ---- the invariant subspace ---- */

/* Replace V by V Y. */
static void restrict_to(work *w, size_t dimension, const double *y)
{
    double *v = new_matrix(w->n, dimension);
    nh_multiply(w->n, dimension, w->dimension, w->v, y, v);
    nh_free(w->v);
    w->v = v;
    w->dimension = dimension;
}

/* V := V null(m), where m (n x dimension) is overwritten. */
static bool restrict_to_null(work *w, double *m)
{
    size_t d = w->dimension, kept = 0;
    double *s = new_matrix(d, 1), *vt = new_matrix(d, d), *y = new_matrix(d, d);
    bool ok = nh_svd(w->n, d, m, s, NULL, vt);
    for (size_t j = 0; j < d && ok; j++)
        if (s[j] <= w->null) {
            for (size_t i = 0; i < d; i++) y[i + kept * d] = vt[j + i * d];
            kept++;
        }
    if (ok) restrict_to(w, kept, y);
    nh_free(s);
    nh_free(vt);
    nh_free(y);
    return ok;
}

/* c (p x q) := x^T z with x: n x p, z: n x q. */
static void multiply_transposed(size_t n, size_t p, size_t q, const double *x, const double *z, double *c)
{
    double *xt = new_matrix(p, n);
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < p; j++) xt[j + i * p] = x[i + j * n];
    nh_multiply(p, q, n, xt, z, c);
    nh_free(xt);
}

/* h := V^T K V and leak := K V - V h, the part of K V outside of V. */
static void project(work *w, double *leak)
{
    size_t n = w->n, d = w->dimension;
    nh_free(w->h);
    w->h = new_matrix(d, d);
    nh_multiply(n, d, n, w->k, w->v, leak);
    multiply_transposed(n, d, d, w->v, leak, w->h);
    double *inside = new_matrix(n, d);
    nh_multiply(n, d, d, w->v, w->h, inside);
    for (size_t i = 0; i < n * d; i++) leak[i] -= inside[i];
    nh_free(inside);
}

/* V := null(rest), then V := {v in V: K v in V} until it stays. */
static bool invariant_subspace(work *w)
{
    size_t n = w->n;
    w->v = new_matrix(n, n);
    w->dimension = n;
    for (size_t i = 0; i < n; i++) w->v[i + i * n] = 1;
    double *m = new_matrix(n, n);
    memcpy(m, w->rest, n * n * sizeof *m);
    bool ok = restrict_to_null(w, m);
    for (size_t before = n + 1; ok && w->dimension > 0 && w->dimension < before;) {
        before = w->dimension;
        project(w, m);
        ok = restrict_to_null(w, m);
    }
    nh_free(m);
    return ok;
}

/* Takes out eigenvalue 0 with all its Jordan blocks (integrals, and polynomials in t or q that an ordinary stage finds)
 * by rank decisions, V := V range(H) until the rank is full: a block of size m would split into eigenvalues of size
 * eps^(1/m), which no threshold tells from a frequency. */
static bool remove_zero(work *w)
{
    bool ok = true;
    for (size_t before = w->dimension + 1; ok && w->dimension > 0 && w->dimension < before;) {
        size_t d = before = w->dimension, kept = 0;
        double *leak = new_matrix(w->n, d), *u = new_matrix(d, d), *s = new_matrix(d, 1);
        project(w, leak);
        ok = nh_svd(d, d, w->h, s, u, NULL);
        while (ok && kept < d && s[kept] > w->null) kept++;
        if (ok) restrict_to(w, kept, u);
        nh_free(leak);
        nh_free(u);
        nh_free(s);
    }
    return ok;
}

/* ---- eigenpairs ---- */

/* Column `to` of the result := x + i y (or its conjugate) with the largest entry 1. */
static void store_vector(nh_pencil *pencil, size_t to, const double *x, const double *y)
{
    size_t n = pencil->columns, largest = 0;
    for (size_t i = 1; i < n; i++)
        if (hypot(x[i], y[i]) > hypot(x[largest], y[largest])) largest = i;
    double modulus = hypot(x[largest], y[largest]), c = x[largest] / modulus, s = y[largest] / modulus;
    for (size_t i = 0; i < n; i++) { /* (x + i y) (c - i s) / modulus */
        pencil->vector_re[i + to * n] = (x[i] * c + y[i] * s) / modulus;
        pencil->vector_im[i + to * n] = (y[i] * c - x[i] * s) / modulus;
    }
}

/* LAPACK stores the vectors of a conjugate pair j, j+1 as real part, imaginary part; the first has im > 0. */
static void store_pairs(nh_pencil *pencil, size_t count, const double *re, const double *im, double smallest, double *c)
{
    size_t n = pencil->columns;
    double *none = new_matrix(n, 1), *minus = new_matrix(n, 1);
    for (size_t j = 0; j < count; j++) {
        if (hypot(re[j], im[j]) <= smallest) continue;
        size_t to = pencil->dimension++;
        pencil->re[to] = re[j];
        pencil->im[to] = im[j];
        const double *x = c + (im[j] < 0 ? j - 1 : j) * n, *y = im[j] == 0 ? none : x + n;
        for (size_t i = 0; i < n && im[j] < 0; i++) minus[i] = -y[i];
        store_vector(pencil, to, x, im[j] < 0 ? minus : y);
    }
    nh_free(none);
    nh_free(minus);
}

/* Eigenvalues of H = V^T K V; those below split |H| are left out. */
static bool eigenpairs(nh_pencil *pencil, work *w, double split)
{
    size_t d = w->dimension, n = w->n;
    double *leak = new_matrix(n, d), *re = new_matrix(d, 1), *im = new_matrix(d, 1), *y = new_matrix(d, d);
    double *x = new_matrix(n, d), *c = new_matrix(w->columns, d), norm = 0;
    project(w, leak);
    bool ok = spectral_norm(d, d, w->h, &norm) && nh_eigen(d, w->h, re, im, y);
    if (ok) {
        nh_multiply(n, d, d, w->v, y, x);
        nh_basis_expand(&w->basis, w->columns, d, x, c);
        store_pairs(pencil, d, re, im, split * norm, c);
    }
    nh_free(leak);
    nh_free(re);
    nh_free(im);
    nh_free(y);
    nh_free(x);
    nh_free(c);
    return ok;
}

static double square(double x) { return x * x; }

/* residual = |A f - lambda B f| / |B f|, with (lr + i li)(br + i bi) written out. */
static void residuals(nh_pencil *pencil, const work *w)
{
    size_t rows = w->rows, d = pencil->dimension, n = w->columns;
    double *ar = new_matrix(rows, d), *ai = new_matrix(rows, d), *br = new_matrix(rows, d), *bi = new_matrix(rows, d);
    nh_multiply(rows, d, n, w->a, pencil->vector_re, ar);
    nh_multiply(rows, d, n, w->a, pencil->vector_im, ai);
    nh_multiply(rows, d, n, w->b, pencil->vector_re, br);
    nh_multiply(rows, d, n, w->b, pencil->vector_im, bi);
    for (size_t j = 0; j < d; j++) {
        double lr = pencil->re[j], li = pencil->im[j], above = 0, below = 0;
        for (size_t i = j * rows; i < (j + 1) * rows; i++) {
            above += square(ar[i] - lr * br[i] + li * bi[i]) + square(ai[i] - lr * bi[i] - li * br[i]);
            below += square(br[i]) + square(bi[i]);
        }
        pencil->residual[j] = sqrt(above / below);
    }
    nh_free(ar);
    nh_free(ai);
    nh_free(br);
    nh_free(bi);
}

static nh_pencil *create(size_t columns, size_t capacity)
{
    nh_pencil *pencil = nh_alloc(sizeof *pencil);
    pencil->columns = columns;
    pencil->re = new_matrix(capacity, 1);
    pencil->im = new_matrix(capacity, 1);
    pencil->residual = new_matrix(capacity, 1);
    pencil->vector_re = new_matrix(columns, capacity);
    pencil->vector_im = new_matrix(columns, capacity);
    return pencil;
}

static nh_pencil *solve(work *w, const nh_nullspace_options *options, double split, nh_error *error)
{
    if (!check_input(w, error) || !reduce(w, options, error)) return NULL;
    if (w->n > 0 && (!invariant_subspace(w) || !remove_zero(w))) {
        failed(error);
        return NULL;
    }
    nh_pencil *pencil = create(w->columns, w->dimension);
    if (w->dimension == 0 || eigenpairs(pencil, w, split)) {
        residuals(pencil, w);
        return pencil;
    }
    failed(error);
    nh_pencil_free(pencil);
    return NULL;
}

nh_pencil *nh_pencil_solve(size_t rows, size_t columns, double *a, double *b, const nh_nullspace_options *options,
                           double split, nh_error *error)
{
    work w = {.rows = rows, .columns = columns, .a = a, .b = b};
    nh_pencil *pencil = solve(&w, options, split, error);
    nh_basis_clear(&w.basis);
    nh_free(w.k);
    nh_free(w.rest);
    nh_free(w.v);
    nh_free(w.h);
    return pencil;
}

void nh_pencil_free(nh_pencil *pencil)
{
    if (!pencil) return;
    nh_free(pencil->re);
    nh_free(pencil->im);
    nh_free(pencil->vector_re);
    nh_free(pencil->vector_im);
    nh_free(pencil->residual);
    nh_free(pencil);
}
