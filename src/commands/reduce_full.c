/* reduce_full: the full motion with which reduced ones are compared, and its error. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands/reduce_internal.h"
#include "motion/automatic.h"
#include "motion/singular_start.h"
#include "motion/turns.h"

/* The sizes to which differences are relative.  All angles have one size together, and so have the other coordinates,
 * whose errors rotations mix: the largest of them, or the largest as the metric compares them, sqrt(K_rr / K_ss)
 * size_r, where that is smaller (a light body beside a heavy one).  Lengths that are zero up to rounding are compared
 * with a part of the radius of gyration, sqrt(K_aa / K_ss). */
typedef struct {
    double angles, lengths, metric, gyration;
} yardsticks;

static yardsticks yardsticks_of(const nh_kinetic *k, const double *K, const double *size)
{
    yardsticks y = {.angles = 1};
    for (size_t s = 0; s < k->m; s++) {
        double unit = sqrt(fmax(K[s * (k->m + 1)], 0));
        if (k->angle[s]) {
            y.angles = fmax(y.angles, 1 + size[s]);
            y.gyration = fmax(y.gyration, unit);
        } else {
            y.lengths = fmax(y.lengths, size[s]);
            y.metric = fmax(y.metric, unit * size[s]);
        }
    }
    return y;
}

/* The size of a coordinate with this unit of inertia. */
static double size_by_unit(const yardsticks *y, bool angle, double unit)
{
    if (!(unit > 0)) return y->lengths > 0 ? y->lengths : 1; /* it has no inertia */
    /* part of the radius of gyration: for smaller sizes, differences of 1e-13 of that radius would count */
    static const double rounding = 1e-6;
    double size = angle ? y->angles : fmax(fmin(y->lengths, y->metric / unit), rounding * y->gyration / unit);
    return size > 0 ? size : 1; /* all is zero: there is no size */
}

/* The metric at a place, 1 where there is none. */
static double *metric_at(const nh_kinetic *k, const double *q)
{
    size_t m = k->m;
    double *K = nh_alloc_array(m * m + 1, sizeof *K);
    if (k->quadratic && k->autonomous) nh_kinetic_values(k, m * m, k->K, q, K);
    else
        for (size_t s = 0; s < m; s++) K[s * (m + 1)] = 1;
    return K;
}

static void grow(const nh_kinetic *k, const double *q, double *size)
{
    for (size_t s = 0; s < k->m; s++) size[s] = fmax(size[s], fabs(q[s]));
}

/* The distance of two places: angles modulo 2 pi, relative to the sizes that coordinates have had, measured by the
 * metric with unit diagonal.  Near a pole of the coordinates large differences of two angles may mean nearly the same
 * place, and only the metric tells. */
static double distance(const nh_kinetic *k, const double *a, const double *b, const double *size)
{
    static const double turn = 6.283185307179586;
    size_t m = k->m;
    double *K = metric_at(k, b), *off = nh_alloc_array(m + 1, sizeof *off), square = 0;
    yardsticks y = yardsticks_of(k, K, size);
    for (size_t s = 0; s < m; s++) {
        double unit = sqrt(fmax(K[s * (m + 1)], 0));
        off[s] = a[s] - b[s];
        if (k->angle[s]) off[s] -= turn * round(off[s] / turn);
        off[s] = unit > 0 ? off[s] / unit / size_by_unit(&y, k->angle[s], unit) : 0;
    }
    for (size_t i = 0; i < m * m; i++) square += K[i] * off[i / m] * off[i % m];
    nh_free(K);
    nh_free(off);
    return isfinite(square) ? sqrt(fmax(square, 0)) : INFINITY;
}

size_t nh_reduction_reliable(const nh_kinetic *k, size_t count, const double *a, size_t a_stride, const double *b,
                             size_t b_stride, double allowed, double *farthest)
{
    double *size = nh_alloc_array(2 * k->m + 1, sizeof *size), *own = size + k->m;
    size_t n = count;
    *farthest = 0;
    for (size_t i = 0; i < count; i++) {
        /* a motion may start from zeros */
        for (size_t next = i; next < count && next <= i + 1; next++) grow(k, b + next * b_stride, size);
        memcpy(own, a + i * a_stride, k->m * sizeof *own);
        nh_turns_nearest(k->model->system, b + i * b_stride, own, NULL);
        double off = distance(k, own, b + i * b_stride, size);
        if (!(off <= allowed) && i < n) n = i;
        *farthest = fmax(*farthest, off);
    }
    nh_free(size);
    return n;
}

void nh_reduction_first_sizes(const nh_kinetic *k, size_t count, const double *a, size_t stride, double *size)
{
    size_t m = k->m;
    double *K = metric_at(k, a), *so_far = nh_alloc_array(m + 1, sizeof *so_far);
    /* the same condition as in nh_reduction_reliable */
    for (size_t i = 0; i < count && i < 2; i++) grow(k, a + i * stride, so_far);
    yardsticks y = yardsticks_of(k, K, so_far);
    for (size_t s = 0; s < m; s++) size[s] = size_by_unit(&y, k->angle[s], sqrt(fmax(K[s * (m + 1)], 0)));
    nh_free(so_far);
    nh_free(K);
}

static size_t reliable(const nh_kinetic *k, const nh_motion *a, const nh_motion *b, double allowed, double *farthest)
{
    return nh_reduction_reliable(k, a->count < b->count ? a->count : b->count, a->state, a->size, b->state, b->size,
                                 allowed, farthest);
}

/* ---- the full motion ---- */

/* By the given method, or by a suitable one (NULL). */
static nh_motion *full_by(nh_reduction_bench *b, const nh_method *method, double rtol, size_t outputs,
                          const nh_method **used, nh_error *error)
{
    nh_reduction *r = b->r;
    size_t m = r->kinetic->m;
    nh_bordered *bordered = nh_bordered_create(r->model);
    nh_flow_problem problem = nh_bordered_flow(bordered);
    nh_flow_options options = {.method = NH_ADAMS,
                               .absolute = nh_reduction_absolute(r),
                               .rtol = rtol,
                               .max_steps = fmin(r->options.steps, NH_REDUCTION_STEPS)};
    double *z = nh_alloc_array(2 * m, sizeof *z);
    memcpy(z, r->initial.q, m * sizeof *z);
    memcpy(z + m, r->initial.v, m * sizeof *z);
    nh_motion *motion = nh_automatic_or(method, &problem, z, outputs, b->times, &options, used, error);
    nh_bordered_free(bordered);
    nh_free(z);
    return motion;
}

/* Two motions with different tolerances; they agree at the first `reached` outputs. */
typedef struct {
    const nh_method *method;
    nh_motion *coarse, *fine;
    double tolerance, finest;
    size_t reached;
    double off;
} pair;

static void judge(nh_reduction_bench *b, pair *p)
{
    p->reached = reliable(b->r->kinetic, p->coarse, p->fine, NH_REDUCTION_ALLOWED * b->r->options.tolerance, &p->off);
}

/* Where no method can be chosen; r->full.why holds the reason. */
static void take_usual(nh_reduction *r, const pair *p, bool held)
{
    nh_reduction_choice *c = &r->full;
    char reason[sizeof c->why];
    snprintf(reason, sizeof reason, "%s", c->why);
    r->full_formulation = "all coordinates, accelerations from the bordered system";
    *c = (nh_reduction_choice){.method = p->method->name,
                               .tolerance = p->tolerance,
                               .step = NAN,
                               .error = p->off,
                               .evaluations = p->coarse->evaluations,
                               .seconds = p->coarse->seconds,
                               .times = NAN,
                               .runs = 2,
                               .held = held};
    snprintf(c->why, sizeof c->why, "%s at tolerance %.1e; none is chosen because %.400s", c->method, p->tolerance,
             reason);
}

/* Stores the motion and its error in the reduction. */
static void take(nh_reduction_bench *b, const pair *p)
{
    nh_reduction *r = b->r;
    size_t m = r->kinetic->m;
    const nh_motion *fine = p->fine;
    r->full_seconds = p->coarse->seconds;
    b->reached = p->reached;
    b->method = p->method;
    b->finest = p->finest;
    r->full_reached = b->times[b->reached ? b->reached - 1 : 0];
    if (b->reached < fine->count)
        nh_reduction_warn(r,
                          "the full motion is accurate only up to t = %.4g: it approaches a singularity of the "
                          "coordinates there, or it is chaotic",
                          r->full_reached);
    b->full = nh_arena_alloc(r->arena, NH_REDUCTION_OUTPUTS * m * sizeof *b->full);
    for (size_t i = 0; i < fine->count; i++) memcpy(b->full + i * m, fine->state + i * fine->size, m * sizeof *b->full);
}

/* The full motion with the tolerance of the reduced ones, and again with a smaller one, as reference.  Errors add up
 * along a motion: all motions are computed with a hundredth of the requested tolerance, or less where the full motion
 * shows that this does not suffice. */
static bool full_motion(nh_reduction_bench *b, nh_error *error)
{
    static const double part = 0.01, least = 3e-13, aim = 10; /* aim: in tolerances */
    nh_reduction *r = b->r;
    b->rtol = fmax(r->options.tolerance * part, least);
    pair p = {.finest = 1e-13};
    p.coarse = full_by(b, NULL, b->rtol, NH_REDUCTION_OUTPUTS, &p.method, error);
    const nh_motion *coarse = p.coarse;
    /* a motion that ends early, with smaller and smaller steps, is not followed to its end a second time */
    size_t outputs = coarse && !coarse->complete && coarse->guard_hit < 0 && coarse->count > 1 ? coarse->count
                                                                                               : NH_REDUCTION_OUTPUTS;
    const char *ended =
        outputs < NH_REDUCTION_OUTPUTS
            ? nh_arena_printf(r->arena, "the full motion ended at t = %.4g: %s", coarse->end_time, coarse->note)
            : NULL;
    p.fine = coarse ? full_by(b, p.method, p.finest, outputs, NULL, error) : NULL;
    if (p.fine) reliable(r->kinetic, p.coarse, p.fine, INFINITY, &p.off);
    if (p.fine && p.off > aim * r->options.tolerance && b->rtol > least) {
        b->rtol = fmax(b->rtol * aim * r->options.tolerance / p.off, least);
        nh_motion_free(p.coarse);
        p.coarse = full_by(b, p.method, b->rtol, outputs, NULL, error);
    }
    if (p.coarse && p.fine) {
        p.tolerance = b->rtol;
        judge(b, &p);
        take(b, &p);
        if (ended) nh_reduction_warn(r, "%s", ended);
        else if (!p.fine->complete)
            nh_reduction_warn(r, "the full motion ended at t = %.4g: %s", p.fine->end_time, p.fine->note);
    }
    if (b->full && r->wanted > 0) take_usual(r, &p, b->reached == NH_REDUCTION_OUTPUTS);
    nh_motion_free(p.coarse);
    nh_motion_free(p.fine);
    return b->full != NULL;
}

bool nh_reduction_full_motion(nh_reduction_bench *b, nh_error *error)
{
    if ((b->r->wanted > 0 && nh_reduction_full_accurate(b)) || full_motion(b, error)) return true;
    if (error && error->code != NH_OK) nh_singular_start_explain(b->r->model, &b->r->initial, error);
    return false;
}

/* The same errors made at other places of the motion: their effect at the outputs shows how accurately a motion in all
 * coordinates is known, whatever its sensitivity. */
double nh_reduction_unsure(nh_reduction_bench *b)
{
    static const double finest = 1e-13, coarser[] = {2, 5};
    const nh_kinetic *k = b->r->kinetic;
    if (b->unsure > 0) return b->unsure;
    for (size_t t = 0; t < sizeof coarser / sizeof *coarser; t++) {
        nh_error ignored = {0};
        nh_motion *other = full_by(b, b->method, coarser[t] * fmax(b->finest, finest), b->reached, NULL, &ignored);
        double off = 0;
        if (other)
            nh_reduction_reliable(k, b->reached < other->count ? b->reached : other->count, other->state, other->size,
                                  b->full, k->m, INFINITY, &off);
        b->unsure = fmax(b->unsure, off);
        nh_motion_free(other);
        nh_error_clear(&ignored);
    }
    return b->unsure = fmin(b->unsure, NH_REDUCTION_ALLOWED * b->r->options.tolerance);
}
