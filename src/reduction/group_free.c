/* group_free: subgroups that act freely, and normalisers, among combinations of the generators (group.h). */
#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "reduction/group.h"
#include "reduction/subspace.h"

typedef struct {
    const nh_group *g;
    const nh_options *options;
    size_t d, best;
    double *base, *t, *kept; /* d x d: a candidate, the same with ideals, the best one so far */
} search;

/* Brings n columns of t to echelon form with short binary fractions; false where they are dependent, or there are other
 * numbers: sums would not be exact. */
static bool tidy(size_t d, size_t n, double *t)
{
    static const double small = 1e-8, parts = 16;
    nh_column_echelon(d, n, small, t);
    for (size_t i = 0; i < n * d; i++) {
        double nearest = round(t[i] * parts) / parts;
        if (!(fabs(t[i] - nearest) <= small)) return false;
        t[i] = nearest;
    }
    for (size_t j = 0; j < n; j++)
        if (nh_largest(d, t + j * d) == 0) return false;
    return true;
}

/* Keeps the n columns of t if they span a larger subalgebra that acts freely. */
static void try_columns(search *s, size_t n)
{
    nh_action sub;
    if (n <= s->best || n > s->g->action.orbit || !tidy(s->d, n, s->t)) return;
    nh_action_sub(&sub, &s->g->action, n, s->t, s->options);
    bool good = sub.closes && sub.free;
    for (size_t a = 0; a < n; a++) good &= sub.generator[a].invariant;
    nh_action_clear(&sub);
    if (!good) return;
    s->best = n;
    memcpy(s->kept, s->t, s->d * n * sizeof *s->t);
}

/* n columns of the base with sums of ideals: SO(3) of SO(3) x SO(3) on a sphere of dimension three. */
static void with_ideals(search *s, size_t base)
{
    enum { most = 8 };
    const nh_algebra_report *r = &s->g->report;
    size_t pieces = r->pieces < most ? r->pieces : most;
    for (size_t set = 0; set < (size_t)1 << pieces; set++) {
        size_t n = base;
        for (size_t i = 0; i < pieces; i++)
            if (set >> i & 1) n += r->piece[i].dimension;
        if (n <= s->best || n > s->g->action.orbit) continue;
        memcpy(s->t, s->base, base * s->d * sizeof *s->t);
        n = base;
        for (size_t i = 0; i < pieces; i++)
            if (set >> i & 1) {
                memcpy(s->t + n * s->d, r->piece[i].basis, r->piece[i].dimension * s->d * sizeof *s->t);
                n += r->piece[i].dimension;
            }
        try_columns(s, n);
    }
}

/* A generator x with the fields y that ad_x stretches, [x, y] = l y with l > 0: of the isometries of a hyperbolic space
 * these act simply transitively (Iwasawa). */
static void try_stretched(search *s)
{
    static const double small = 1e-8;
    size_t d = s->d;
    double *ad = nh_alloc_array(3 * d * d + 3 * d + 1, sizeof *ad), *copy = ad + d * d, *basis = copy + d * d,
           *re = basis + d * d, *im = re + d, *x = im + d;
    for (size_t a = 0; a < d; a++) {
        size_t n = 1;
        for (size_t i = 0; i < d; i++) x[i] = i == a;
        nh_algebra_ad(&s->g->action.algebra, x, ad);
        memcpy(copy, ad, d * d * sizeof *ad);
        if (!nh_eigen(d, copy, re, im, NULL)) continue;
        double size = nh_largest(d * d, ad);
        memcpy(s->base, x, d * sizeof *x);
        for (size_t k = 0; k < d; k++) {
            bool again = false;
            for (size_t j = 0; j < k; j++) again |= fabs(re[j] - re[k]) <= small * size;
            if (again || !(re[k] > small * size) || fabs(im[k]) > small * size) continue;
            memcpy(copy, ad, d * d * sizeof *ad);
            for (size_t i = 0; i < d; i++) copy[i * (d + 1)] -= re[k];
            size_t more = nh_kernel(d, d, copy, small * size, basis, NULL, NULL);
            if (n + more > d) break;
            memcpy(s->base + n * d, basis, more * d * sizeof *basis);
            n += more;
        }
        if (n > 1) with_ideals(s, n);
    }
    nh_free(ad);
}

size_t nh_group_free_basis(const nh_group *g, const nh_options *options, double *t)
{
    size_t d = g->action.d, *index = nh_alloc_array(d + 1, sizeof *index);
    double *base = nh_alloc_array(2 * d * d + 1, sizeof *base);
    search s = {g, options, d, nh_group_free_subset(g, options, index), base, base + d * d, t};
    memset(t, 0, d * d * sizeof *t);
    for (size_t i = 0; i < s.best; i++) t[index[i] + i * d] = 1;
    if (s.best < g->action.orbit && !g->missing && g->action.closes) {
        with_ideals(&s, 0);
        try_stretched(&s);
    }
    nh_free(base);
    nh_free(index);
    return s.best;
}

/* t: combinations of the generators `other` (d - count of them). */
static size_t normaliser(const nh_algebra *g, size_t count, const size_t *subset, size_t n, const size_t *other,
                         double *kernel)
{
    static const double small = 1e-9;
    size_t d = g->d, rows = count * d;
    double *a = nh_alloc_array(rows * n + 1, sizeof *a);
    for (size_t i = 0; i < count; i++)
        for (size_t k = 0; k < n; k++) /* the part of [x, subset[i]] along other[k] */
            for (size_t j = 0; j < n; j++) a[i * d + k + j * rows] = g->c[(other[j] * d + subset[i]) * d + other[k]];
    size_t found = nh_kernel(rows, n, a, small, kernel, NULL, NULL);
    if (!tidy(n, found, kernel)) { /* those that normalise it by themselves */
        memset(kernel, 0, n * n * sizeof *kernel);
        found = 0;
        for (size_t j = 0; j < n; j++)
            if (nh_largest(rows, a + j * rows) == 0) kernel[j + n * found++] = 1;
    }
    nh_free(a);
    return found;
}

size_t nh_group_normaliser(const nh_algebra *g, size_t count, const size_t *subset, double *t)
{
    size_t d = g->d, n = 0, *other = nh_alloc_array(d + 1, sizeof *other);
    for (size_t a = 0; a < d; a++) {
        bool inside = false;
        for (size_t i = 0; i < count; i++) inside |= subset[i] == a;
        if (!inside) other[n++] = a;
    }
    double *kernel = nh_alloc_array(n * n + 1, sizeof *kernel);
    size_t found = normaliser(g, count, subset, n, other, kernel);
    memset(t, 0, d * d * sizeof *t);
    for (size_t c = 0; c < found; c++)
        for (size_t j = 0; j < n; j++) t[other[j] + c * d] = kernel[j + c * n];
    nh_free(kernel);
    nh_free(other);
    return found;
}

size_t nh_group_normaliser_of(const nh_algebra *g, size_t count, const double *s, double *t)
{
    static const double small = 1e-9;
    size_t d = g->d, n = count, *subset = nh_alloc_array(d + 1, sizeof *subset);
    double *basis = nh_alloc_array(3 * d * d + d + 1, sizeof *basis), *in = basis + d * d, *u = in + d * d + d;
    memcpy(basis, s, count * d * sizeof *basis);
    for (size_t a = 0; a < d && n < d; a++) { /* completed by unit vectors */
        memset(basis + n * d, 0, d * sizeof *basis);
        basis[n * d + a] = 1;
        n += nh_span(d, n + 1, basis, small, u) == n + 1;
    }
    for (size_t i = 0; i < count; i++) subset[i] = i;
    nh_algebra changed = nh_algebra_change(g, d, basis, NULL);
    size_t found = nh_group_normaliser(&changed, count, subset, in);
    memset(t, 0, d * d * sizeof *t);
    nh_multiply(d, found, d, basis, in, t);
    nh_algebra_clear(&changed);
    nh_free(basis);
    nh_free(subset);
    return found;
}
