#include "base/spline.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_interp.h>
#include <math.h>
#include <string.h>

/* ---- slopes at nodes ---- */

/* Of n values f[i * stride] over x, into slope[i * stride]. */
static void slopes(bool akima, size_t n, const double *x, size_t stride, const double *f, double *slope)
{
    double *line = nh_alloc_array(n, sizeof *line);
    for (size_t i = 0; i < n; i++) line[i] = f[i * stride];
    gsl_interp *spline = nh_memory_got(gsl_interp_alloc(akima ? gsl_interp_akima : gsl_interp_cspline, n));
    bool good = gsl_interp_init(spline, x, line, n) == GSL_SUCCESS;
    for (size_t i = 0; i < n; i++) slope[i * stride] = good ? gsl_interp_eval_deriv(spline, x, line, x[i], NULL) : NAN;
    gsl_interp_free(spline);
    nh_free(line);
}

static double *slopes_of(nh_arena *arena, bool akima, const nh_spline *s, const double *f, bool along_x)
{
    double *out = nh_arena_alloc(arena, s->nx * s->ny * sizeof *out);
    for (size_t j = 0; along_x && j < s->ny; j++) slopes(akima, s->nx, s->x, s->ny, f + j, out + j);
    for (size_t i = 0; !along_x && i < s->nx; i++) slopes(akima, s->ny, s->y, 1, f + i * s->ny, out + i * s->ny);
    return out;
}

static double *copy(nh_arena *arena, size_t n, const double *from)
{
    double *out = nh_arena_alloc(arena, n * sizeof *out);
    return memcpy(out, from, n * sizeof *out);
}

/* ---- its own error ---- */

/* Adds up the squares of the slopes along a line, and of their differences from those of the line without every second
 * node, between these. */
static void compare(bool akima, size_t n, const double *x, size_t stride, const double *f, const double *slope,
                    double *off, double *all)
{
    size_t half = (n + 1) / 2;
    if (half < NH_SPLINE_LEAST) return;
    double *node = nh_alloc_array(3 * half, sizeof *node), *value = node + half, *coarse = value + half;
    for (size_t i = 0; i < half; i++) node[i] = x[2 * i], value[i] = f[2 * i * stride];
    slopes(akima, half, node, 1, value, coarse);
    for (size_t i = 0; i < half; i++) {
        *off += pow(coarse[i] - slope[2 * i * stride], 2);
        *all += pow(slope[2 * i * stride], 2);
    }
    nh_free(node);
}

/* NaN where the table has too few nodes to tell. */
static double error_of(bool akima, const nh_spline *s)
{
    double off = 0, all = 0;
    for (size_t j = 0; j < s->ny; j++) compare(akima, s->nx, s->x, s->ny, s->f + j, s->fx + j, &off, &all);
    for (size_t i = 0; s->y && i < s->nx; i++)
        compare(akima, s->ny, s->y, 1, s->f + i * s->ny, s->fy + i * s->ny, &off, &all);
    return all > 0 ? sqrt(off / all) : off > 0 ? INFINITY : NAN;
}

nh_spline *nh_spline_create(nh_arena *arena, bool akima, size_t nx, const double *x, size_t ny, const double *y,
                            const double *f)
{
    gsl_set_error_handler_off(); /* GSL's default handler aborts */
    nh_spline *s = nh_arena_alloc(arena, sizeof *s);
    *s = (nh_spline){.nx = nx, .ny = ny, .x = copy(arena, nx, x), .y = y ? copy(arena, ny, y) : NULL};
    s->f = copy(arena, nx * ny, f);
    s->fx = slopes_of(arena, akima, s, s->f, true);
    if (y) s->fy = slopes_of(arena, akima, s, s->f, false);
    if (y) s->fxy = slopes_of(arena, akima, s, s->fy, true);
    s->error = error_of(akima, s);
    return s;
}

/* ---- values ---- */

/* The cell in which x lies; false: outside. */
static bool cell(size_t n, const double *node, double x, size_t *out)
{
    if (!(x >= node[0] && x <= node[n - 1])) return false;
    size_t low = 0, high = n - 1;
    while (high - low > 1) {
        size_t middle = (low + high) / 2;
        *(x < node[middle] ? &high : &low) = middle;
    }
    *out = low;
    return true;
}

/* The derivatives of order `order` with respect to x of Hermite's four polynomials at u, in a cell of this width: of
 * the value at its begin, its end, of the slope at its begin, its end. */
static void hermite(unsigned order, double u, double width, double *w)
{
    const double polynomial[4][4] = {{1, 0, -3, 2}, {0, 0, 3, -2}, {0, 1, -2, 1}, {0, 0, -1, 1}};
    for (int k = 0; k < 4; k++) {
        double sum = 0;
        for (unsigned p = NH_SPLINE_ORDERS; p-- > order;) {
            double factor = polynomial[k][p];
            for (unsigned d = 0; d < order; d++) factor *= p - d;
            sum = sum * u + factor;
        }
        w[k] = sum / pow(width, order) * (k < 2 ? 1 : width);
    }
}

double nh_spline_value(const nh_spline *s, unsigned i, unsigned j, double x, double y)
{
    size_t a, b = 0, n = s->ny;
    double p[4], q[4] = {1, 0, 0, 0}, sum = 0;
    if (!cell(s->nx, s->x, x, &a) || (s->y && !cell(s->ny, s->y, y, &b))) return NAN;
    if (i >= NH_SPLINE_ORDERS || j >= (s->y ? NH_SPLINE_ORDERS : 1)) return 0;
    hermite(i, (x - s->x[a]) / (s->x[a + 1] - s->x[a]), s->x[a + 1] - s->x[a], p);
    if (s->y) hermite(j, (y - s->y[b]) / (s->y[b + 1] - s->y[b]), s->y[b + 1] - s->y[b], q);
    for (size_t k = 0; k < 2; k++)
        for (size_t l = 0; l < (s->y ? 2u : 1u); l++) {
            size_t at = (a + k) * n + b + l;
            sum += (p[k] * s->f[at] + p[2 + k] * s->fx[at]) * q[l];
            if (s->y) sum += (p[k] * s->fy[at] + p[2 + k] * s->fxy[at]) * q[2 + l];
        }
    return sum;
}
