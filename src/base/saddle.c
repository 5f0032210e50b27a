#include "base/saddle.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"

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

size_t nh_saddle_work(size_t m, size_t k) { return (m + k) * (m + k + 2) + 1; }

bool nh_saddle_solve(size_t m, size_t k, const double *K, const double *F, const double *h, const double *g, double *a,
                     double *mu, double *rcond, double *work)
{
    size_t n = m + k;
    double *matrix = work, *right = matrix + n * n, *s = right + n, *e = s + m;
    if (rcond) *rcond = 0;
    if (!nh_all_finite(m * m, K) || !nh_all_finite(k * m, F)) return false;
    scale_metric(m, K, s);
    scale_border(m, k, F, s, e);
    memset(matrix, 0, n * n * sizeof *matrix);
    for (size_t j = 0; j < m; j++) {
        for (size_t i = 0; i < m; i++) matrix[i + j * n] = s[i] * K[i + j * m] * s[j];
        for (size_t c = 0; c < k; c++) matrix[m + c + j * n] = matrix[j + (m + c) * n] = e[c] * F[c + j * k] * s[j];
        right[j] = -h[j] * s[j];
    }
    for (size_t c = 0; c < k; c++) right[m + c] = -g[c] * e[c];
    if (!nh_solve(n, matrix, 1, right, rcond)) return false;
    for (size_t j = 0; j < m; j++) a[j] = right[j] * s[j];
    for (size_t c = 0; c < k && mu; c++) mu[c] = right[m + c] * e[c];
    return nh_all_finite(m, a) && (!mu || nh_all_finite(k, mu));
}
