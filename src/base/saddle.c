#include "base/saddle.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"

/* The power of two nearest to 1/sqrt(x) or below; 1 where x is not positive and finite. */
static double root_scale(double x)
{
    int power;
    if (!(x > 0 && isfinite(x))) return 1;
    bool exact = frexp(x, &power) == 0.5; /* 2^(power - 1) */
    return ldexp(1, -(int)ceil((power - exact) / 2.0));
}
static double scale(double x) { return x > 0 && isfinite(x) ? ldexp(1, -ilogb(x)) : 1; }

static double row_size(size_t m, const double *K, const double *s, size_t i)
{
    double most = 0;
    for (size_t j = 0; j < m; j++) most = fmax(most, s[i] * fabs(K[i + j * m]) * s[j]);
    return most;
}

/* From the diagonal, beyond which a positive matrix has nothing larger; rows of others are brought to the size one
   together.  0 for empty rows. */
static void scale_metric(size_t m, const double *K, double *s)
{
    enum { sweeps = 8 }; /* each takes at least the root of what is amiss */
    for (size_t i = 0; i < m; i++) s[i] = root_scale(K[i * (m + 1)]);
    for (int sweep = 0, changed = 1; sweep < sweeps && changed; sweep++) {
        changed = 0;
        for (size_t i = 0; i < m; i++) {
            double size = row_size(m, K, s, i), before = s[i];
            if (size > 2 || !(K[i * (m + 1)] > 0)) s[i] *= root_scale(size);
            if (size == 0) s[i] = 0;
            changed |= s[i] != before;
        }
    }
}

/* Rows of the border from the columns that have a scale, and columns that have none from the border. */
static void scale_border(size_t m, size_t k, const double *F, double *s, double *e)
{
    for (size_t c = 0; c < k; c++) {
        double most = 0, bare = 0;
        for (size_t j = 0; j < m; j++)
            most = fmax(most, fabs(F[c + j * k]) * s[j]), bare = fmax(bare, fabs(F[c + j * k]));
        e[c] = scale(most > 0 ? most : bare);
    }
    for (size_t j = 0; j < m; j++) {
        double most = 0;
        for (size_t c = 0; c < k && s[j] == 0; c++) most = fmax(most, fabs(F[c + j * k]) * e[c]);
        if (s[j] == 0) s[j] = scale(most);
    }
}

size_t nh_saddle_work(size_t m, size_t k) { return (m + k) * (m + k + 4) + 1; }

typedef struct {
    size_t m, k, columns;
    const double *K, *F, *h, *g;
    double *matrix, *right, *s, *e;
} saddle;

static void fill(const saddle *x)
{
    size_t m = x->m, k = x->k, n = m + k;
    memset(x->matrix, 0, n * n * sizeof *x->matrix);
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < m; i++) x->matrix[i + j * n] = x->s[i] * x->K[i + j * m] * x->s[j];
        for (size_t c = 0; c < k; c++)
            x->matrix[m + c + j * n] = x->matrix[j + (m + c) * n] = x->e[c] * x->F[c + j * k] * x->s[j];
    }
    for (size_t r = 0; r < x->columns; r++) {
        for (size_t j = 0; j < m; j++) x->right[j + r * n] = -x->h[j + r * m] * x->s[j];
        for (size_t c = 0; c < k; c++) x->right[m + c + r * n] = -x->g[c + r * k] * x->e[c];
    }
}

/* Is a pivot of the LU factors zero but for rounding? */
static bool pivot_vanishes(const saddle *x)
{
    static const double rounding = 1e-14;
    size_t n = x->m + x->k;
    double least = INFINITY, most = 0;
    for (size_t i = 0; i < n; i++) {
        double pivot = fabs(x->matrix[i + i * n]);
        least = fmin(least, pivot), most = fmax(most, pivot);
    }
    return least < rounding * most;
}

/* Rows of F that depend on each other: the shortest solution, by singular values.  False where the right-hand side does
 * not agree with them, or a vector of the kernel has a part in a. */
static bool shortest(const saddle *x)
{
    static const double zero = 1e-13, agree = 1e-9;
    size_t m = x->m, n = m + x->k;
    fill(x);
    double *sigma = nh_alloc_array(n + 2 * n * n + n + 1, sizeof *sigma), *u = sigma + n, *vt = u + n * n,
           *y = vt + n * n;
    bool good = nh_svd(n, n, x->matrix, sigma, u, vt);
    for (size_t r = 0; r < x->columns && good; r++) {
        double *right = x->right + r * n, size = nh_norm(n, right);
        memset(y, 0, n * sizeof *y);
        for (size_t i = 0; i < n; i++) {
            double along = 0, moves = 0;
            for (size_t j = 0; j < n; j++) along += u[j + i * n] * right[j];
            for (size_t j = 0; j < m; j++) moves = hypot(moves, vt[i + j * n]);
            if (sigma[i] > zero * sigma[0])
                for (size_t j = 0; j < n; j++) y[j] += vt[i + j * n] * along / sigma[i];
            else good = good && moves < agree && fabs(along) <= agree * size;
        }
        memcpy(right, y, n * sizeof *y);
    }
    nh_free(sigma);
    return good;
}

/* Where all coefficients of a constraint vanish, it has a singular point, and says nothing about the accelerations. */
static bool has_empty_row(const saddle *x)
{
    for (size_t c = 0; c < x->k; c++) {
        bool empty = true;
        for (size_t j = 0; j < x->m; j++) empty = empty && x->F[c + j * x->k] == 0;
        if (empty) return true;
    }
    return false;
}

static bool solve(saddle *x, double *rcond, double *work)
{
    size_t m = x->m, k = x->k, n = m + k;
    x->matrix = work, x->right = work + n * n, x->s = x->right + 2 * n, x->e = x->s + m;
    if (rcond) *rcond = 0;
    if (!nh_all_finite(m * m, x->K) || !nh_all_finite(k * m, x->F)) return false;
    scale_metric(m, x->K, x->s);
    scale_border(m, k, x->F, x->s, x->e);
    fill(x);
    bool good = nh_solve(n, x->matrix, x->columns, x->right, rcond);
    if (!k || (good && !pivot_vanishes(x))) return good;
    return !has_empty_row(x) && shortest(x);
}

bool nh_saddle_solve(size_t m, size_t k, const double *K, const double *F, const double *h, const double *g, double *a,
                     double *mu, double *rcond, double *work)
{
    saddle x = {.m = m, .k = k, .columns = 1, .K = K, .F = F, .h = h, .g = g};
    if (!solve(&x, rcond, work)) return false;
    for (size_t j = 0; j < m; j++) a[j] = x.right[j] * x.s[j];
    for (size_t c = 0; c < k && mu; c++) mu[c] = x.right[m + c] * x.e[c];
    return nh_all_finite(m, a) && (!mu || nh_all_finite(k, mu));
}

bool nh_saddle_solve_two(size_t m, size_t k, const double *K, const double *F, const double *h, const double *g,
                         double *a, double *work)
{
    saddle x = {.m = m, .k = k, .columns = 2, .K = K, .F = F, .h = h, .g = g};
    if (!solve(&x, NULL, work)) return false;
    for (size_t j = 0; j < 2 * m; j++) a[j] = x.right[j % m + j / m * (m + k)] * x.s[j % m];
    return nh_all_finite(2 * m, a);
}
