/* points: where the equations are taken. [docs/method.md, sec. 4, "Samples"]
 *
 *     nh_sampler_next      a Sobol point in the box [Sobol1967]: of (t, q, w), or of (t, q, v) in a natural sampling
 *     project              natural: v -> the nearest allowed velocities, rho(w) = v by Gauss-Newton
 *     nh_chart_complete    implicit velocities u by Newton
 *     accept               finite?  |v|, |a| of usual size?  |R| below 1/pivot?  -> weight unit/(1 + |a| + |v|)
 *     add_beyond           only |R| too large: (t, q, v) on the constraints, with v' from the multiplier form */
#include "integrals/points.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/linalg.h"
#include "geometry/bordered.h"
#include "system/sample.h"

enum { most_tries_per_point = 40 };

/* Room for `count` points of `width` columns, padded to whole batches. */
static nh_points *empty(size_t count, size_t width)
{
    nh_points *p = nh_alloc(sizeof *p);
    size_t padded = (count + NH_BATCH - 1) / NH_BATCH * NH_BATCH;
    *p = (nh_points){.width = width,
                     .column = nh_alloc_array(width, sizeof *p->column),
                     .weight = nh_alloc_array(padded + 1, sizeof *p->weight)};
    for (size_t j = 0; j < width; j++) p->column[j] = nh_alloc_array(padded + 1, sizeof **p->column);
    return p;
}

void nh_points_free(nh_points *points)
{
    if (!points) return;
    nh_points_free(points->beyond);
    for (size_t j = 0; j < points->width; j++) nh_free(points->column[j]);
    nh_free(points->column);
    nh_free(points->weight);
    nh_free(points);
}

size_t nh_points_equations(const nh_points *points)
{
    return points->count + (points->beyond ? points->beyond->count : 0);
}

/* Run a tape (inputs: the model's symbols) over all points: out[k][p].  `out` rows must hold points->count values. */
static void run(const nh_points *points, const nh_tape *tape, double *const *out)
{
    nh_tape_work *work = nh_tape_work_create(tape);
    size_t n_out = nh_tape_outputs(tape);
    const double **in = nh_alloc_array(points->width, sizeof *in);
    double **to = nh_alloc_array(n_out + 1, sizeof *to);
    nh_work_add(NH_WORK_VALUE, (double)points->count * (double)nh_tape_length(tape));
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
    run(points, tape, out);
    nh_free(out);
    nh_tape_free(tape);
}

/* A point is too near a singularity for doubles where velocities or accelerations are so many times larger than in the
 * box. */
static const double too_fast = 1e8, usual = 1.5;

/* The range of a velocity that the system's author gives, relative to its default range; 0: none is given. */
static double given_speed(const nh_model *model, nh_ex symbol)
{
    const nh_system *system = model->system;
    double reach = 0;
    for (size_t k = 0; k < system->intervals; k++)
        if (system->interval[k].symbol == symbol)
            reach = fmax(fabs(system->interval[k].low), fabs(system->interval[k].high)) / usual;
    return isfinite(reach) ? reach : 0;
}

/* The units of velocities: speed[s] for v^s, then for w_i; the returned rate is that of their changes per unit of time.
 * Where the author gives no range of a velocity, its unit is the one in which the coordinate crosses its interval as
 * fast as the fastest one crosses its own. */
static double speeds_of(const nh_model *model, double *speed)
{
    const nh_chart *c = model->chart;
    const nh_coordinate *q = model->system->coordinate;
    double rate = 0, *own = speed + model->m;
    for (size_t s = 0; s < model->m; s++)
        rate = fmax(rate, given_speed(model, q[s].v) / nh_chart_unit(model->system, s));
    for (size_t i = 0; i < model->n && c->quasi; i++) rate = fmax(rate, given_speed(model, c->w[i]));
    if (!(rate > 0)) rate = 1;
    for (size_t s = 0; s < model->m; s++) {
        double given = given_speed(model, q[s].v);
        speed[s] = given > 0 ? given : rate * nh_chart_unit(model->system, s);
    }
    for (size_t i = 0; i < model->n; i++) {
        double given = given_speed(model, c->w[i]);
        own[i] = !c->quasi ? speed[c->free[i]] : given > 0 ? given : rate;
    }
    return rate;
}

/* Accelerations and velocities decide whether a point is usable: everything else consists of the same parts. */
typedef struct {
    const nh_model *o;
    nh_tape *tape; /* rho (m), R (m x n, column-major), a (n), Lbar */
    nh_tape_work *work;
    double *out, *dense, *slope; /* slope: m x n, by which R is a number without units */
    double *speed, rate;         /* speeds_of */
    /* Unit of time, about 1/rate, so that a small rate is small in any unit.  A power of 1024, by which no digit is
     * lost. */
    double unit;
    double steepest; /* largest |R| that is accepted in a chart of coordinate velocities: 1 / pivot */
} guard;

/* One tape of what decides: rho (m), R (m x n), a (n), Lbar. */
static guard guard_create(const nh_model *model, double pivot)
{
    size_t m = model->m, n = model->n, total = m + m * n + n;
    nh_ex *e = nh_alloc_array(total + 1, sizeof *e);
    memcpy(e, model->rho, m * sizeof *e);
    e[total] = model->Lbar;
    for (size_t i = 0; i < n; i++)
        for (size_t s = 0; s < m; s++) e[m + s + i * m] = model->R[s * n + i];
    memcpy(e + m + m * n, model->a, n * sizeof *e);
    guard g = {.o = model,
               .tape = nh_model_tape(model, total + 1, e),
               .out = nh_alloc_array(total + 1, sizeof(double)),
               .dense = nh_alloc_array(2 * m * n + 2 * (m + n) + 1, sizeof(double)),
               .steepest = model->chart->quasi ? INFINITY : 1 / pivot};
    g.work = nh_tape_work_create(g.tape);
    g.slope = g.dense + m * n + m + n;
    nh_chart_slopes(model->chart, g.slope);
    g.speed = g.slope + m * n;
    g.rate = speeds_of(model, g.speed);
    g.unit = exp2(-10 * round(log2(g.rate) / 10));
    nh_free(e);
    return g;
}

static void guard_clear(guard *g)
{
    nh_tape_work_free(g->work);
    nh_tape_free(g->tape);
    nh_free(g->out);
    nh_free(g->dense);
}

/* The velocities nearest to v that the constraints allow: Gauss-Newton on rho(w) = v (one step when rho is affine). */
static bool project(guard *g, double *z, const double *v)
{
    enum { most_steps = 12 };
    size_t m = g->o->m, n = g->o->n;
    double *R = g->dense, *b = R + m * n;
    for (int step = 0; step < most_steps; step++) {
        double size = 0;
        nh_tape_eval(g->tape, g->work, z, g->out);
        for (size_t i = 0; i < m + m * n; i++)
            if (!isfinite(g->out[i])) return false;
        memcpy(R, g->out + m, m * n * sizeof *R);
        for (size_t s = 0; s < m; s++) b[s] = v[s] - g->out[s];
        if (nh_least_squares(m, n, R, 1, b, m, 1e-12) < 0) return false;
        for (size_t i = 0; i < n; i++) {
            z[1 + m + i] += b[i];
            size = fmax(size, fabs(b[i]) / g->speed[m + i]);
        }
        if (size < 1e-9) break;
    }
    return true;
}

/* Weight of a point, or 0 to reject it; *steepness gets |R| where everything is finite, else 0. */
static double accept(guard *g, const double *z, nh_points *p, double *steepness)
{
    *steepness = 0;
    size_t m = g->o->m, n = g->o->n;
    double fast = 0, steep = 0, strong = 0;
    nh_tape_eval(g->tape, g->work, z, g->out);
    for (size_t i = 0; i <= m + m * n + n; i++) {
        if (!isfinite(g->out[i])) {
            p->not_finite++;
            return 0;
        }
        if (i == m + m * n + n) break; /* Lbar needs only to exist */
        double *largest = i < m ? &fast : i < m + m * n ? &steep : &strong, size = fabs(g->out[i]);
        if (largest == &fast) size /= g->speed[i];
        else if (largest == &steep) size *= g->slope[(i - m) % m * n + (i - m) / m];
        else size /= g->speed[i - m * n] * g->rate;
        *largest = fmax(*largest, size);
    }
    *steepness = steep;
    if (fast < too_fast && strong < too_fast && steep < g->steepest) return g->unit / (1 + strong + fast);
    p->degenerate++;
    return 0;
}

/* The box of (t, q, w, u), or, natural, of (t, q, q'). */
static void stretched_box(const nh_model *model, bool natural, double stretch, double *low, double *high)
{
    const nh_chart *c = model->chart;
    size_t dimension = natural ? 1 + 2 * model->m : model->width;
    for (size_t i = 0; i < dimension; i++) {
        double a = i < model->width ? c->low[i] : 0, b = i < model->width ? c->high[i] : 0;
        if (natural && i > model->m) nh_chart_range(c, model->system->coordinate[i - 1 - model->m].v, &a, &b);
        double middle = (a + b) / 2, half = (b - a) / 2 * (i > model->m ? stretch : 1);
        low[i] = middle - half;
        high[i] = middle + half;
    }
}

/* ---- beyond the chart ---- */

/* A point (t, q, v) near a zero of the chart's pivot: v is moved onto the constraints, and the multiplier form gives
 * v'.  A function of the chart may have poles of the pivot there, whose rates cancel and leave errors of 1/pivot^2
 * roundings: the weight allows for it. */
static void add_beyond(nh_points *p, const nh_model *model, nh_bordered *b, double t, const double *q, double *v,
                       double steepness, const guard *g)
{
    static const double too_steep = 1e6;
    size_t m = model->m, n = model->n, width = model->width, at = p->beyond->count;
    double fast = 0, *rate = nh_alloc_array(m, sizeof *rate);
    bool good = steepness > g->steepest && steepness < too_steep && nh_bordered_project(b, t, q, NULL, v) &&
                nh_bordered_accelerations(b, t, q, v, rate);
    for (size_t s = 0; s < m && good; s++) fast = fmax(fast, fmax(fabs(v[s]), fabs(rate[s]) / g->rate) / g->speed[s]);
    if (good && fast < too_fast) {
        double **to = p->beyond->column;
        to[0][at] = t;
        for (size_t s = 0; s < m; s++) to[1 + s][at] = q[s];
        for (size_t i = 0; i < n; i++) to[1 + m + i][at] = v[model->chart->free[i]];
        for (size_t s = 0; s < m; s++) to[width + s][at] = v[s];
        for (size_t i = 0; i < n; i++) to[width + m + i][at] = rate[model->chart->free[i]];
        p->beyond->weight[p->beyond->count++] = g->unit * pow(g->steepest / steepness, 2) / (1 + fast);
    }
    nh_free(rate);
}

/* ---- sampling ---- */

/* Moves velocities in the box onto the constraints, where the chart leaves them a choice. */
static bool is_natural(const nh_model *model)
{
    return !model->chart->quasi && model->k > 0 && model->chart->implicit == 0;
}

typedef struct {
    const nh_model *o;
    bool natural; /* the points are (t, q, v): moved to allowed velocities */
    guard guard;
    nh_bordered *bordered; /* NULL: points beyond the chart are not wanted, or none was found yet */
    bool cover;   /* not of one branch of a quadratic constraint: all coordinates do not tell it from the other */
    size_t count; /* wanted number of points, and room for points beyond the chart */
    double *z, *v, *low, *high;
} sampling;

/* Appends the point in z to the list; in a natural sampling z is (t, q, v). */
static void take(sampling *s, nh_points *p)
{
    const nh_model *model = s->o;
    size_t m = model->m;
    double steepness = 0, *z = s->z;
    if (s->natural) {
        const nh_chart *c = model->chart;
        memcpy(s->v, z + 1 + m, m * sizeof *s->v);
        for (size_t i = 0; i < model->n; i++) z[1 + m + i] = c->quasi ? 0 : s->v[c->free[i]];
        for (size_t i = 0; i < c->implicit; i++) z[1 + m + model->n + i] = s->v[c->dependent[i]];
        if (!c->implicit && !project(&s->guard, z, s->v)) {
            p->not_finite++;
            return;
        }
    }
    if (!nh_chart_complete(model->chart, z)) {
        p->not_solved++;
        return;
    }
    double weight = accept(&s->guard, z, p, &steepness);
    if (weight > 0) {
        for (size_t j = 0; j < model->width; j++) p->column[j][p->count] = z[j];
        p->weight[p->count++] = weight;
    } else if (s->cover && p->beyond->count < s->count) {
        if (!s->bordered) s->bordered = nh_bordered_create(model);
        add_beyond(p, model, s->bordered, z[0], z + 1, s->v, steepness, &s->guard);
    }
}

static void sampling_clear(sampling *s)
{
    guard_clear(&s->guard);
    nh_bordered_free(s->bordered);
    nh_free(s->low);
}

static sampling sampling_of(const nh_model *model, size_t count, bool velocities, bool cover)
{
    size_t room = 1 + 2 * model->m + model->width;
    sampling s = {.o = model,
                  .natural = velocities,
                  .guard = guard_create(model, nh_chart_least_pivot),
                  .cover = cover && is_natural(model) && velocities && !model->chart->branch,
                  .count = count};
    s.low = nh_alloc_array(4 * room, sizeof *s.low);
    s.high = s.low + room;
    s.z = s.high + room;
    s.v = s.z + room;
    return s;
}

static nh_points *list_of(const sampling *s)
{
    const nh_model *model = s->o;
    nh_points *p = empty(s->count, model->width);
    if (s->cover) p->beyond = empty(s->count, model->width + model->m + model->n);
    return p;
}

static void drop_empty_beyond(nh_points *p)
{
    if (!p->beyond || p->beyond->count) return;
    nh_points_free(p->beyond);
    p->beyond = NULL;
}

/* Takes points until `count` are usable, or 40 tries for each are used up. */
static nh_points *create(const nh_model *model, size_t count, double stretch, uint64_t seed, bool cover,
                         nh_error *error)
{
    sampling s = sampling_of(model, count, is_natural(model), cover);
    nh_points *p = list_of(&s);
    stretched_box(model, s.natural, stretch, s.low, s.high);
    nh_sampler *sampler = nh_sampler_create(s.natural ? 1 + 2 * model->m : model->width, s.low, s.high, seed);
    for (size_t most = most_tries_per_point * count + 200; p->count < count && p->tried < most; p->tried++) {
        nh_sampler_next(sampler, s.z);
        take(&s, p);
    }
    nh_sampler_free(sampler);
    sampling_clear(&s);
    drop_empty_beyond(p);
    if (p->count == count) return p;
    nh_fail(error, NH_NUMERIC, "",
            "only %zu of %zu sample points were usable (%zu not finite, %zu without a solution of the constraints, %zu "
            "near a singularity)",
            p->count, p->tried, p->not_finite, p->not_solved, p->degenerate);
    nh_error_hint(error, "give a `domain:` on which the Lagrangian and the constraints are defined");
    nh_points_free(p);
    return NULL;
}

nh_points *nh_points_given(const nh_model *model, size_t rows, bool velocities, const double *row)
{
    sampling s = sampling_of(model, rows, velocities, true);
    nh_points *p = list_of(&s);
    size_t width = velocities ? 1 + 2 * model->m : model->width;
    for (; p->tried < rows; p->tried++) {
        memcpy(s.z, row + p->tried * width, width * sizeof *s.z);
        take(&s, p);
    }
    sampling_clear(&s);
    drop_empty_beyond(p);
    return p;
}

bool nh_points_natural(const nh_model *model) { return is_natural(model); }

void nh_points_box(const nh_model *model, bool velocities, double *low, double *high)
{
    stretched_box(model, velocities, 1, low, high);
}

nh_points *nh_points_create(const nh_model *model, size_t count, double stretch, uint64_t seed, nh_error *error)
{
    return create(model, count, stretch, seed, false, error);
}

nh_points *nh_points_cover(const nh_model *model, size_t count, uint64_t seed, nh_error *error)
{
    return create(model, count, 1, seed, true, error);
}
