#include "integrals/independence.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "integrals/gradient_rank.h"

enum { levels = 4 };

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double median(size_t n, double *x)
{
    if (n == 0) return NAN;
    qsort(x, n, sizeof *x, ascending);
    return x[n / 2];
}

/* The size of the terms of e, to first order in their rounding: a sum of sizes, and b^x with size(b) |b|^(x-1). */
static nh_ex size_of(nh_dag *d, nh_ex e, int depth)
{
    nh_kind kind = nh_kind_of(d, e);
    if (depth == 0 || (kind != NH_SUM && kind != NH_PRODUCT)) return nh_call(d, NH_ABS, e);
    nh_ex size = nh_call(d, NH_ABS, nh_number(d, nh_constant_of(d, e)));
    for (size_t i = 0; i < nh_arity(d, e); i++) {
        nh_ex child = nh_child(d, e, i), own = size_of(d, child, depth - 1);
        if (kind == NH_SUM)
            size = nh_add(d, size, nh_mul(d, nh_call(d, NH_ABS, nh_number(d, nh_coefficient_of(d, e, i))), own));
        else
            size = nh_product(
                d, 3,
                (nh_ex[]){size, own,
                          nh_call(d, NH_ABS, nh_pow(d, child, nh_sub(d, nh_exponent_of(d, e, i), nh_int(d, 1))))});
    }
    return size;
}

/* Gradients d phi / d z_j over (t, q, w), times the half width of the sampling box in z_j, so that units do not matter;
 * implicit velocities are followed by the rules of diff.h. After them the sizes of what each phi is summed from. */
static double *gradients(const nh_model *model, const nh_points *points, size_t n, const nh_ex *phi, size_t width)
{
    nh_ex *e = nh_alloc_array(n * (width + 1) + 1, sizeof *e);
    for (size_t k = 0; k < n; k++)
        for (size_t j = 0; j < width; j++) e[k * width + j] = nh_diff(model->dag, phi[k], model->chart->symbol[j]);
    for (size_t k = 0; k < n; k++) e[n * width + k] = size_of(model->dag, phi[k], levels);
    double *value = nh_alloc_array(n * (width + 1) * points->count + 1, sizeof *value);
    nh_points_evaluate(points, model, n * (width + 1), e, value);
    for (size_t k = 0; k < n * width; k++) {
        double span = (model->chart->high[k % width] - model->chart->low[k % width]) / 2;
        for (size_t p = 0; p < points->count; p++) value[k * points->count + p] *= span;
    }
    nh_free(e);
    return value;
}

typedef struct {
    size_t width, points, accepted;
    double *basis; /* per point: accepted orthonormal gradients */
    bool *without; /* per point: an accepted function has no value there, so that it says nothing of others */
} frame;

enum { NO_VALUE = -2, NO_GRADIENT = -1 };

/* Removes the accepted directions (twice, because of rounding); returns the remaining part of |g|, or NO_GRADIENT when
 * g is not above `noise`, or NO_VALUE. */
static double remaining(const frame *f, size_t point, double *g, double noise)
{
    double before = 0, after = 0;
    const double *basis = f->basis + point * f->width * f->width;
    for (size_t j = 0; j < f->width; j++) before += g[j] * g[j];
    before = sqrt(before);
    if (!isfinite(before) || !isfinite(noise) || f->without[point]) return NO_VALUE;
    if (!(before > noise)) return NO_GRADIENT;
    for (int pass = 0; pass < 2; pass++)
        for (size_t k = 0; k < f->accepted; k++) {
            double dot = 0;
            for (size_t j = 0; j < f->width; j++) dot += g[j] * basis[k * f->width + j];
            for (size_t j = 0; j < f->width; j++) g[j] -= dot * basis[k * f->width + j];
        }
    for (size_t j = 0; j < f->width; j++) after += g[j] * g[j];
    return sqrt(after) / before;
}

static void accept(frame *f, const double *rest)
{
    for (size_t p = 0; p < f->points; p++) {
        double size = 0, *to = f->basis + p * f->width * f->width + f->accepted * f->width;
        const double *g = rest + p * f->width;
        for (size_t j = 0; j < f->width; j++) size += g[j] * g[j];
        for (size_t j = 0; j < f->width; j++) to[j] = size > 0 && isfinite(size) ? g[j] / sqrt(size) : 0;
        f->without[p] |= !isfinite(size);
    }
    f->accepted++;
}

/* Is what is left below `doubt`, but more than rounding leaves, of currents without fitted numbers?  Where a light body
 * moves with a heavy one, energy and momentum differ by little. */
static bool is_small_only(const nh_model *model, size_t k, const nh_ex *phi, const bool *exact,
                          const nh_independence *kind, double left)
{
    static const double rounding = 1e-14;
    bool small = exact && left > rounding;
    for (size_t i = 0; i <= k && small; i++)
        if (i == k || kind[i] == NH_INDEPENDENT) small = exact[i] && nh_is_exact(model->dag, phi[i]);
    return small;
}

/* Decides about phi[k] against the accepted ones before it in ball arithmetic, where doubles leave it open. */
static nh_independence decide(const nh_model *model, size_t k, const nh_ex *phi, const nh_independence *kind,
                              double doubt)
{
    nh_ex *list = nh_alloc_array(k + 1, sizeof *list);
    size_t n = 0;
    for (size_t i = 0; i < k; i++)
        if (kind[i] == NH_INDEPENDENT) list[n++] = phi[i];
    list[n] = phi[k];
    nh_rank rank = nh_rank_decide(model, n, list, doubt);
    nh_free(list);
    return rank.answer == NH_RANK_GROWS ? NH_INDEPENDENT : rank.answer == NH_RANK_STAYS ? NH_DEPENDENT : NH_DOUBTFUL;
}

void nh_independence_test(const nh_model *model, const nh_points *points, size_t n, const nh_ex *phi, const bool *exact,
                          double sure, double doubt, nh_independence *out, double *fraction)
{
    size_t width = 1 + model->m + model->n, count = points->count;
    double *g = gradients(model, points, n, phi, width);
    frame f = {.width = width,
               .points = count,
               .basis = nh_alloc_array(count * width * width + 1, sizeof(double)),
               .without = nh_alloc_array(count + 1, sizeof(bool))};
    double *rest = nh_alloc_array(count * width + 1, sizeof *rest), *left = nh_alloc_array(count + 1, sizeof *left);
    for (size_t k = 0; k < n; k++) {
        size_t usable = 0, still = 0;
        for (size_t p = 0; p < count; p++) {
            for (size_t j = 0; j < width; j++) rest[p * width + j] = g[(k * width + j) * count + p];
            double noise = DBL_EPSILON / doubt * g[(n * width + k) * count + p],
                   r = remaining(&f, p, rest + p * width, noise);
            if (r >= 0) left[usable++] = r;
            else still += r == NO_GRADIENT;
        }
        double m = median(usable, left);
        if (fraction) fraction[k] = usable ? m : 0;
        bool known = usable + still > 0;
        out[k] = !known            ? NH_DOUBTFUL
                 : still >= usable ? NH_CONSTANT
                 : m > sure        ? NH_INDEPENDENT
                 : m < doubt       ? NH_DEPENDENT
                                   : NH_DOUBTFUL;
        if (out[k] == NH_DEPENDENT && is_small_only(model, k, phi, exact, out, m)) out[k] = NH_DOUBTFUL;
        if (out[k] == NH_DOUBTFUL) out[k] = decide(model, k, phi, out, doubt);
        if (out[k] == NH_INDEPENDENT && f.accepted < width) accept(&f, rest);
    }
    nh_free(left);
    nh_free(rest);
    nh_free(f.without);
    nh_free(f.basis);
    nh_free(g);
}
