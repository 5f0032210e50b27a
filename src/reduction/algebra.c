#include "reduction/algebra.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "base/memory.h"
#include "reduction/subspace.h"

nh_algebra nh_algebra_create(size_t d) { return (nh_algebra){d, nh_alloc_array(d * d * d + 1, sizeof(double))}; }

void nh_algebra_clear(nh_algebra *g)
{
    nh_free(g->c);
    *g = (nh_algebra){0};
}

void nh_algebra_ad(const nh_algebra *g, const double *x, double *out)
{
    size_t d = g->d;
    memset(out, 0, d * d * sizeof *out);
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d && x[a] != 0; b++)
            for (size_t k = 0; k < d; k++) out[k + b * d] += x[a] * g->c[(a * d + b) * d + k];
}

void nh_algebra_bracket(const nh_algebra *g, const double *x, const double *y, double *out)
{
    size_t d = g->d;
    for (size_t k = 0; k < d; k++) out[k] = 0;
    for (size_t a = 0; a < d; a++)
        for (size_t b = 0; b < d; b++)
            for (size_t k = 0; k < d; k++) out[k] += g->c[(a * d + b) * d + k] * x[a] * y[b];
}

void nh_algebra_coad(const nh_algebra *g, const double *x, const double *mu, double *out)
{
    size_t d = g->d;
    for (size_t b = 0; b < d; b++) {
        out[b] = 0;
        for (size_t a = 0; a < d; a++)
            for (size_t k = 0; k < d; k++) out[b] += g->c[(a * d + b) * d + k] * x[a] * mu[k];
    }
}

nh_algebra nh_algebra_change(const nh_algebra *g, size_t r, const double *t, double *off)
{
    size_t d = g->d;
    nh_algebra out = nh_algebra_create(r);
    double *all = nh_alloc_array(d * r * r + 1, sizeof *all), worst;
    for (size_t a = 0; a < r; a++)
        for (size_t b = 0; b < r; b++) nh_algebra_bracket(g, t + a * d, t + b * d, all + (a * r + b) * d);
    worst = nh_coordinates(d, r, t, r * r, all, out.c);
    if (off) *off = r ? worst : 0;
    nh_free(all);
    return out;
}

size_t nh_algebra_centre(const nh_algebra *g, double small, double *out)
{
    size_t d = g->d; /* rows (b, k): sum_a x^a C_ab^k = 0 */
    double *rows = nh_alloc_array(d * d * d + 1, sizeof *rows);
    for (size_t a = 0; a < d; a++) memcpy(rows + a * d * d, g->c + a * d * d, d * d * sizeof *rows);
    size_t n = nh_kernel(d * d, d, rows, small * fmax(nh_largest(d * d * d, g->c), 1e-300), out, NULL, NULL);
    nh_free(rows);
    return n;
}

size_t nh_algebra_brackets(const nh_algebra *g, size_t r, const double *u, size_t s, const double *w, double small,
                           double *out)
{
    size_t d = g->d;
    double *all = nh_alloc_array(d * r * s + 1, sizeof *all);
    for (size_t a = 0; a < r; a++)
        for (size_t b = 0; b < s; b++) nh_algebra_bracket(g, u + a * d, w + b * d, all + (a * s + b) * d);
    size_t n = nh_span(d, r * s, all, small * fmax(nh_largest(d * d * d, g->c), 1e-300), out);
    nh_free(all);
    return n;
}

void nh_algebra_killing(const nh_algebra *g, double *out)
{
    size_t d = g->d;
    for (size_t i = 0; i < d; i++)
        for (size_t j = 0; j < d; j++) {
            out[i + j * d] = 0;
            for (size_t a = 0; a < d; a++)
                for (size_t b = 0; b < d; b++) out[i + j * d] += g->c[(i * d + a) * d + b] * g->c[(j * d + b) * d + a];
        }
}

double nh_algebra_ideal(const nh_algebra *g, size_t r, const double *u)
{
    size_t d = g->d;
    double *all = nh_alloc_array(2 * d * d * r + d + 1, sizeof *all), *x = all + d * d * r, *unit = x + d * d * r,
           worst;
    for (size_t a = 0; a < d; a++) {
        for (size_t i = 0; i < d; i++) unit[i] = i == a;
        for (size_t b = 0; b < r; b++) nh_algebra_bracket(g, unit, u + b * d, all + (a * r + b) * d);
    }
    worst = nh_coordinates(d, r, u, d * r, all, x);
    nh_free(all);
    return r ? worst : 0;
}

void nh_algebra_balance(const nh_algebra *g, double *t)
{
    static const double dependent = 1e-10;
    size_t d = g->d, n = 0, rows = d * d * d + d;
    double *a = nh_alloc_array(rows * d + rows + 1, sizeof *a), *b = a + rows * d;
    for (size_t i = 0; i < d * d * d; i++) { /* log |c| + tau_a + tau_b - tau_k = 0 */
        if (g->c[i] == 0) continue;
        a[n + i / d / d * rows] += 1;
        a[n + i / d % d * rows] += 1;
        a[n + i % d * rows] -= 1;
        b[n++] = -log(fabs(g->c[i]));
    }
    bool good = n && nh_least_squares(rows, d, a, 1, b, rows, dependent) >= 0;
    for (size_t i = 0; i < d; i++) t[i] = good ? exp(b[i]) : 1;
    nh_free(a);
}
