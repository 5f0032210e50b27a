/* benchmark_derivatives: the Jacobian of the equations of motion, exact from the graph, by a complex step or by
 * differences of the right-hand side: what each costs, and how far it is off.  At the chart's probes; exact derivatives
 * are the reference. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/memory.h"
#include "evaluate/tape_complex.h"
#include "commands/benchmark_internal.h"

enum { exact_derivatives, complex_step, forward, central_differences, extrapolated, kinds };
enum { most_repeats = 100 };
static const char *const names[kinds] = {"exact, from the graph", "complex step", "forward differences",
                                         "central differences", "central differences, extrapolated"};
static const double tiny = 1e-100;         /* the complex step */
static const double enough_seconds = 2e-3; /* repetitions stop after so many seconds */

typedef struct {
    nh_flow_problem problem;
    size_t n;
    double *z, *low, *high, *coarse, *size;
    const nh_tape *tape; /* for the complex step; NULL where implicit velocities would have to be solved for */
    double complex *work, *in, *out;
    long evaluations;
} differences;

static bool rate_at(differences *d, double t, size_t j, double step, double *out)
{
    double kept = d->z[j];
    d->z[j] = kept + step;
    bool good = d->problem.rate(t, d->z, out, d->problem.context);
    d->z[j] = kept;
    d->evaluations++;
    return good;
}

/* (f(z + h) - f(z - h)) / 2h into `out`. */
static bool central(differences *d, double t, size_t j, double h, double *out)
{
    if (!rate_at(d, t, j, h, d->high) || !rate_at(d, t, j, -h, d->low)) return false;
    for (size_t i = 0; i < d->n; i++) out[i] = (d->high[i] - d->low[i]) / (2 * h);
    return true;
}

static bool by_complex_step(differences *d, double t, double *J)
{
    size_t n = d->n;
    d->in[0] = t;
    for (size_t j = 0; j < n; j++) d->in[1 + j] = d->z[j];
    for (size_t j = 0; j < n; j++) {
        d->in[1 + j] = CMPLX(d->z[j], tiny);
        nh_tape_eval_complex(d->tape, d->work, d->in, d->out);
        d->in[1 + j] = d->z[j];
        d->evaluations++;
        for (size_t i = 0; i < n; i++) J[i + j * n] = cimag(d->out[i]) / tiny;
        for (size_t i = 0; i < n; i++)
            if (!isfinite(J[i + j * n])) return false;
    }
    return true;
}

/* Steps near the best for errors of order 1, 2 and 4 and rounding: eps^(1/2), eps^(1/3), eps^(1/5), times the largest
   |z_j| of all points. */
static bool jacobian(differences *d, int kind, double t, double *J)
{
    size_t n = d->n;
    if (kind == exact_derivatives) return d->evaluations++, d->problem.jacobian(t, d->z, J, d->problem.context);
    if (kind == complex_step) return by_complex_step(d, t, J);
    if (kind == forward && !rate_at(d, t, 0, 0, d->low)) return false;
    for (size_t j = 0; j < n; j++) {
        double *column = J + j * n, h = d->size[j] * pow(DBL_EPSILON, kind == forward               ? 1.0 / 2
                                                                      : kind == central_differences ? 1.0 / 3
                                                                                                    : 1.0 / 5);
        if (kind == forward) {
            if (!rate_at(d, t, j, h, d->high)) return false;
            for (size_t i = 0; i < n; i++) column[i] = (d->high[i] - d->low[i]) / h;
        } else if (!central(d, t, j, h, column)) {
            return false;
        }
        if (kind != extrapolated) continue;
        if (!central(d, t, j, 2 * h, d->coarse)) return false;
        for (size_t i = 0; i < n; i++) column[i] = (4 * column[i] - d->coarse[i]) / 3;
    }
    return true;
}

static double largest_difference(size_t count, const double *a, const double *exact)
{
    double worst = 0, scale = DBL_MIN;
    for (size_t i = 0; i < count; i++) scale = fmax(scale, fabs(exact[i]));
    for (size_t i = 0; i < count; i++) worst = fmax(worst, fabs(a[i] - exact[i]) / scale);
    return worst;
}

/* Repeats one Jacobian; the seconds of each into time[*times]. */
static void repeat(differences *d, int kind, double t, double *J, double enough, double *time, size_t *times)
{
    double begin = nh_clock(), last = begin;
    for (int i = 0; i < most_repeats && last - begin < enough; i++) {
        jacobian(d, kind, t, J);
        double now = nh_clock();
        time[(*times)++] = now - last;
        last = now;
    }
}

static void measure(differences *d, const nh_chart *c, int kind, double *J, double *exact, nh_derivative *out)
{
    size_t n = d->n, times = 0;
    double *time = nh_alloc_array(most_repeats * c->probes + 1, sizeof *time);
    *out = (nh_derivative){.method = names[kind]};
    for (size_t p = 0; p < c->probes; p++) {
        const double *point = c->probe + p * c->width;
        memcpy(d->z, point + 1, n * sizeof *d->z);
        if (!jacobian(d, 0, point[0], exact)) continue;
        d->evaluations = 0;
        if (!jacobian(d, kind, point[0], J)) continue;
        out->evaluations = d->evaluations;
        out->error = fmax(out->error, largest_difference(n * n, J, exact));
        repeat(d, kind, point[0], J, enough_seconds / (double)c->probes, time, &times);
    }
    out->seconds = nh_judge_spread_of(times, time).median;
    if (!times) out->error = NAN;
    nh_free(time);
}

static void set_sizes(differences *d, const nh_chart *c)
{
    for (size_t p = 0; p < c->probes; p++)
        for (size_t j = 0; j < d->n; j++) d->size[j] = fmax(d->size[j], fabs(c->probe[p * c->width + 1 + j]));
    for (size_t j = 0; j < d->n; j++)
        if (!(d->size[j] > 0)) d->size[j] = 1;
}

void nh_benchmark_derivatives(const nh_formulation *f, nh_benchmark *out)
{
    size_t n = f->size;
    if (!f->model || !f->problem.jacobian) return;
    differences d = {.problem = f->problem, .n = n, .z = nh_alloc_array(5 * n, sizeof *d.z)};
    d.low = d.z + n, d.high = d.low + n, d.coarse = d.high + n, d.size = d.coarse + n;
    set_sizes(&d, f->model->chart);
    double *J = nh_alloc_array(2 * n * n, sizeof *J);
    d.in = nh_alloc_array(2 * n + 2, sizeof *d.in), d.out = d.in + n + 1;
    if (!f->model->chart->implicit) {
        d.tape = nh_programs_tape(f->programs, NH_PROGRAM_RATE);
        d.work = nh_tape_complex_create(d.tape);
    }
    out->derivative = nh_arena_alloc(out->arena, kinds * sizeof *out->derivative);
    for (int k = 0; k < kinds; k++)
        if (k != complex_step || d.tape)
            measure(&d, f->model->chart, k, J, J + n * n, &out->derivative[out->derivatives++]);
    nh_free(d.work);
    nh_free(d.in);
    nh_free(J);
    nh_free(d.z);
}
