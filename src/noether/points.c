#include "noether/points.h"

#include <math.h>
#include <string.h>

#include "system/sample.h"

enum { most_tries_per_point = 40 };

static nh_points *empty(size_t count, size_t width)
{
    nh_points *p = nh_alloc(sizeof *p);
    size_t padded = (count + NH_BATCH - 1) / NH_BATCH * NH_BATCH;
    *p = (nh_points){.width = width, .column = nh_alloc_array(width, sizeof *p->column), .weight = nh_alloc_array(padded + 1, sizeof *p->weight)};
    for (size_t j = 0; j < width; j++) p->column[j] = nh_alloc_array(padded + 1, sizeof **p->column);
    return p;
}

void nh_points_free(nh_points *points)
{
    if (!points) return;
    for (size_t j = 0; j < points->width; j++) nh_free(points->column[j]);
    nh_free(points->column);
    nh_free(points->weight);
    nh_free(points);
}

void nh_points_run(const nh_points *points, const nh_tape *tape, double *const *out)
{
    nh_tape_work *work = nh_tape_work_create(tape);
    size_t n_out = nh_tape_outputs(tape);
    const double **in = nh_alloc_array(points->width, sizeof *in);
    double **to = nh_alloc_array(n_out + 1, sizeof *to);
    for (size_t start = 0; start < points->count; start += NH_BATCH) {
        size_t left = points->count - start;
        for (size_t j = 0; j < points->width; j++) in[j] = points->column[j] + start;
        for (size_t k = 0; k < n_out; k++) to[k] = out[k] + start;
        nh_tape_eval_batch(tape, work, left < NH_BATCH ? left : NH_BATCH, in, to);
    }
    nh_free(to);
    nh_free(in);
    nh_tape_work_free(work);
}

void nh_points_evaluate(const nh_points *points, const nh_model *model, size_t n, const nh_ex *e, double *value)
{
    nh_tape *tape = nh_model_tape(model, n, e);
    double **out = nh_alloc_array(n + 1, sizeof *out);
    for (size_t k = 0; k < n; k++) out[k] = value + k * points->count;
    nh_points_run(points, tape, out);
    nh_free(out);
    nh_tape_free(tape);
}

/* The accelerations and velocities decide what is usable: everything else is made of the same parts. */
typedef struct {
    nh_tape *tape;
    nh_tape_work *work;
    double *out;
    size_t n;
} guard;

static guard guard_create(const nh_model *o)
{
    size_t n = o->n + o->m + 1;
    nh_ex *e = nh_alloc_array(n, sizeof *e);
    memcpy(e, o->a, o->n * sizeof *e);
    memcpy(e + o->n, o->rho, o->m * sizeof *e);
    e[n - 1] = o->Lbar;
    guard g = {.tape = nh_model_tape(o, n, e), .out = nh_alloc_array(n, sizeof(double)), .n = n};
    g.work = nh_tape_work_create(g.tape);
    nh_free(e);
    return g;
}

static void guard_clear(guard *g)
{
    nh_tape_work_free(g->work);
    nh_tape_free(g->tape);
    nh_free(g->out);
}

/* Weight of a point, or 0 to reject it. */
static double accept(guard *g, const nh_model *o, const double *z, nh_points *p)
{
    static const double too_fast = 1e8; /* nearer to a singularity than doubles can use */
    double size = 0;
    nh_tape_eval(g->tape, g->work, z, g->out);
    for (size_t i = 0; i < g->n; i++) {
        if (!isfinite(g->out[i])) {
            p->not_finite++;
            return 0;
        }
        if (i < o->n + o->m) size = fmax(size, fabs(g->out[i]));
    }
    if (size < too_fast) return 1 / (1 + size);
    p->degenerate++;
    return 0;
}

static void stretched_box(const nh_model *o, double stretch, double *low, double *high)
{
    const nh_chart *c = o->chart;
    for (size_t i = 0; i < o->width; i++) {
        double middle = (c->low[i] + c->high[i]) / 2, half = (c->high[i] - c->low[i]) / 2;
        if (i > o->m) half *= stretch;
        low[i] = middle - half;
        high[i] = middle + half;
    }
}

nh_points *nh_points_create(const nh_model *o, size_t count, double stretch, uint64_t seed, nh_error *error)
{
    nh_points *p = empty(count, o->width);
    double *low = nh_alloc_array(3 * o->width, sizeof *low), *high = low + o->width, *z = high + o->width;
    stretched_box(o, stretch, low, high);
    nh_sampler *sampler = nh_sampler_create(o->width, low, high, seed);
    guard g = guard_create(o);
    for (size_t most = most_tries_per_point * count + 200; p->count < count && p->tried < most; p->tried++) {
        nh_sampler_next(sampler, z);
        if (!nh_chart_complete(o->chart, z)) {
            p->not_solved++;
            continue;
        }
        double weight = accept(&g, o, z, p);
        if (weight == 0) continue;
        for (size_t j = 0; j < o->width; j++) p->column[j][p->count] = z[j];
        p->weight[p->count++] = weight;
    }
    guard_clear(&g);
    nh_sampler_free(sampler);
    nh_free(low);
    if (p->count == count) return p;
    nh_fail(error, NH_NUMERIC, "", "only %zu of %zu sample points were usable (%zu not finite, %zu without a solution of the constraints, %zu near a singularity)",
            p->count, p->tried, p->not_finite, p->not_solved, p->degenerate);
    nh_error_hint(error, "give a `domain:` on which the Lagrangian and the constraints are defined");
    nh_points_free(p);
    return NULL;
}
