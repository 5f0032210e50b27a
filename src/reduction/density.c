#include "reduction/density.h"

#include <math.h>
#include <string.h>

#include "expr/diff.h"
#include "expr/normal.h"
#include "expr/solve.h"
#include "noether/recognise.h"

enum { most_factors = 40, most_seen = 3000, most_places = 16, largest_denominator = 12 };

typedef struct {
    const nh_slice *s;
    nh_dag *d;
    size_t n, factors, seen;
    nh_ex factor[most_factors], node[most_seen];
} search;

static bool moves(const search *s, nh_ex e)
{
    for (size_t i = 0; i < s->n; i++)
        if (nh_depends(s->d, e, s->s->x[i])) return true;
    return false;
}

static void offer(search *s, nh_ex e)
{
    for (size_t i = 0; i < s->factors; i++)
        if (s->factor[i] == e) return;
    if (s->factors < most_factors && moves(s, e)) s->factor[s->factors++] = e;
}

/* Sums, functions and coordinates inside an expression. */
static void walk(search *s, nh_ex e)
{
    for (size_t i = 0; i < s->seen; i++)
        if (s->node[i] == e) return;
    if (s->seen == most_seen || !moves(s, e)) return;
    s->node[s->seen++] = e;
    if (nh_kind_of(s->d, e) != NH_PRODUCT) offer(s, e);
    for (size_t i = 0; i < nh_arity(s->d, e); i++) walk(s, nh_child(s->d, e, i));
}

/* det K by cofactors of the first row; for at most four rows. */
static nh_ex determinant(nh_dag *d, size_t n, const nh_ex *K)
{
    if (n == 0) return nh_int(d, 1);
    nh_ex sum = nh_int(d, 0), *minor = nh_alloc_array(n * n, sizeof *minor);
    for (size_t j = 0; j < n; j++) {
        for (size_t r = 1; r < n; r++)
            for (size_t c = 0, at = 0; c < n; c++)
                if (c != j) minor[(r - 1) * (n - 1) + at++] = K[r * n + c];
        nh_ex term = nh_is_zero(d, K[j]) ? K[j] : nh_mul(d, K[j], determinant(d, n - 1, minor));
        sum = j % 2 ? nh_sub(d, sum, term) : nh_add(d, sum, term);
    }
    nh_free(minor);
    return sum;
}

/* -Theta_j = -(K^-1)^il U_lij as expressions. */
static bool minus_theta(const search *s, const nh_ex *K, const nh_ex *U, nh_ex *out)
{
    size_t n = s->n;
    nh_dag *d = s->d;
    nh_ex *b = nh_alloc_array(n + 1, sizeof *b);
    nh_lu *lu = nh_lu_create(d, n, K, nh_slice_pivot_score, (void *)s->s, NULL);
    for (size_t j = 0; j < n && lu; j++) {
        out[j] = nh_int(d, 0);
        for (size_t i = 0; i < n; i++) {
            for (size_t l = 0; l < n; l++) b[l] = U[(l * n + i) * n + j];
            nh_lu_solve(lu, b, b);
            out[j] = nh_sub(d, out[j], b[i]);
        }
    }
    bool good = lu != NULL;
    nh_lu_free(lu);
    nh_free(b);
    return good;
}

/* Least squares for one or two of the columns; the largest residual, relative. */
static double fit(size_t rows, const double *a, const double *b, const double *want, double *c)
{
    double aa = 0, ab = 0, bb = 0, aw = 0, bw = 0, off = 0, size = 0;
    for (size_t i = 0; i < rows; i++) {
        double y = b ? b[i] : 0;
        aa += a[i] * a[i], ab += a[i] * y, bb += y * y, aw += a[i] * want[i], bw += y * want[i];
    }
    double det = b ? aa * bb - ab * ab : aa;
    if (!(det > 1e-10 * (b ? aa * bb : aa))) return INFINITY;
    c[0] = b ? (aw * bb - bw * ab) / det : aw / det;
    c[1] = b ? (bw * aa - aw * ab) / det : 0;
    for (size_t i = 0; i < rows; i++) {
        off = fmax(off, fabs(c[0] * a[i] + (b ? c[1] * b[i] : 0) - want[i]));
        size = fmax(size, fabs(want[i]));
    }
    return off / (size > 0 ? size : 1);
}

/* The first one or two factors that fit with rational exponents. */
static bool choose(const search *s, size_t rows, const double *column, const double *want, size_t *which, nh_num *power, double same)
{
    static const double fits = 1e-8;
    double c[2];
    for (size_t i = 0; i < s->factors; i++) {
        which[0] = which[1] = i;
        if (fit(rows, column + i * rows, NULL, want, c) < fits && nh_recognise_ratio(c[0], largest_denominator, 100 * same, &power[0])) return true;
    }
    for (size_t i = 0; i < s->factors; i++)
        for (size_t j = 0; j < i; j++) {
            which[0] = i, which[1] = j;
            if (fit(rows, column + i * rows, column + j * rows, want, c) < fits && nh_recognise_ratio(c[0], largest_denominator, 100 * same, &power[0]) &&
                nh_recognise_ratio(c[1], largest_denominator, 100 * same, &power[1]))
                return true;
        }
    return false;
}

/* d_j log F_k and -Theta_j at the sample points: rows (place, j), column by column; rows that are not finite are left out. */
static size_t sample(const search *s, const nh_ex *slope, double *column, double *want)
{
    const nh_kinetic *k = s->s->kinetic;
    size_t total = (s->factors + 1) * s->n, places = k->places < most_places ? k->places : most_places, rows = 0, all = places * s->n;
    double *value = nh_alloc_array(places * total + 1, sizeof *value);
    nh_kinetic_sample(k, total, slope, places, value);
    for (size_t p = 0; p < places; p++)
        for (size_t j = 0; j < s->n; j++) {
            const double *v = value + p * total;
            bool good = isfinite(v[s->factors * s->n + j]);
            for (size_t i = 0; i < s->factors; i++) good &= isfinite(v[i * s->n + j]);
            if (!good) continue;
            for (size_t i = 0; i < s->factors; i++) column[rows + i * all] = v[i * s->n + j];
            want[rows++] = v[s->factors * s->n + j];
        }
    for (size_t i = 1; i < s->factors; i++) memmove(column + i * rows, column + i * all, rows * sizeof *column);
    nh_free(value);
    return rows;
}

bool nh_density_find(const nh_slice *slice, const nh_ex *K, const nh_ex *U, const nh_options *options, nh_ex *density, bool *proved)
{
    search *s = nh_alloc(sizeof *s);
    size_t n = slice->n, which[2], most = (most_factors + 1) * n;
    nh_dag *d = slice->dag;
    *s = (search){.s = slice, .d = d, .n = n};
    nh_ex *slope = nh_alloc_array(most + n + 1, sizeof *slope), *theta = slope + most;
    double *column = nh_alloc_array(most_places * n * (most_factors + 1) + 1, sizeof *column), *want = column + most_places * n * most_factors;
    nh_num power[2];
    bool good = n > 0 && n <= 4 && slice->tidy && minus_theta(s, K, U, theta);
    nh_ex det = good ? nh_simplify(d, determinant(d, n, K)) : 0;
    if (good) offer(s, det);
    if (good) walk(s, det);
    if (good) walk(s, nh_simplify(d, nh_numerator(d, det)));
    for (size_t i = 0; i < n * n && good; i++) walk(s, K[i]);
    for (size_t i = 0; i < s->factors; i++)
        for (size_t j = 0; j < n; j++) slope[i * n + j] = nh_div(d, nh_diff(d, s->factor[i], slice->x[j]), s->factor[i]);
    if (good) memcpy(slope + s->factors * n, theta, n * sizeof *theta);
    size_t rows = good ? sample(s, slope, column, want) : 0;
    good = rows > 2 * n && choose(s, rows, column, want, which, power, options->same);
    size_t terms = good && which[0] != which[1] ? 2 : 1;
    if (good) *density = nh_int(d, 1), *proved = true;
    for (size_t t = 0; t < terms && good; t++) *density = nh_mul(d, *density, nh_pow(d, s->factor[which[t]], nh_number(d, power[t])));
    for (size_t j = 0; j < n && good && *proved; j++) {
        nh_ex e = nh_neg(d, theta[j]);
        for (size_t t = 0; t < terms; t++) e = nh_add(d, e, nh_mul(d, nh_number(d, power[t]), slope[which[t] * n + j]));
        *proved = nh_normal_is_zero(d, e, (size_t)options->proof_terms) == NH_ZERO;
    }
    nh_free(slope);
    nh_free(column);
    nh_free(s);
    return good;
}
