/* motion_series: a chain of intervals along the motion, each with a series about its centre. [docs/method.md, sec. 4]
 *
 *               side -1                first                 side +1
 *         ]---x---[]-----x-----[]--------0--------[]-----x-----[]--x--[        0: start, x: centres
 *
 *     next_link    the half width is shortened until the bound is below a part of the series
 *     chain        further intervals, the length by the bound before, to the end of the motion or of the tries
 *     move         from centre to centre as balls: their radii enter the next bounds (exact/ball_series.h) */
#include "search/motion_series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact/ball_series.h"
#include "integrals/exact_points.h"

/* most_links, most_tries: on each side of the start */
enum { most_defined = 16, most_links = 32, most_tries = 32, bits = 128 };

/* States, parameters, constants and roots at the start; integrals are 0 there. */
static nh_ball *at_start(const nh_model *model, const nh_explicit_motion *m, const double *z)
{
    nh_ball *ball = nh_ball_create(model->dag, bits);
    nh_exact_parameters(model, ball);
    for (size_t i = 0; i < m->states; i++) nh_ball_set_double(ball, m->state[i], z[i]);
    for (size_t j = 0; j < m->integrals; j++) nh_ball_set_ratio(ball, m->integral[j].symbol, 0, 1);
    for (size_t j = 0; j < m->constants; j++) nh_ball_set_expression(ball, m->constant[j].symbol, m->constant[j].value);
    for (size_t j = 0; j < m->roots; j++) nh_ball_set_expression(ball, m->root[j].symbol, m->root[j].value);
    return ball;
}

/* Roots and integrals by their defining equations. */
static size_t list(const nh_explicit_motion *m, nh_ball_defined *out)
{
    size_t n = 0;
    for (size_t j = 0; j < m->roots && n < most_defined; j++)
        out[n++] = (nh_ball_defined){m->root[j].symbol, m->root[j].square, false};
    for (size_t j = 0; j < m->integrals && n < most_defined; j++)
        out[n++] = (nh_ball_defined){m->integral[j].symbol, m->integral[j].integrand, true};
    return n;
}

/* A bound relative to what is allowed, a part of the largest term: at most 1 where it is small enough. */
static double excess(const nh_motion_series_of_one *s, double half)
{
    static const double part = 1e-12;
    double size = 0;
    for (size_t k = 0; k < NH_MOTION_SERIES_TERMS; k++)
        size = fmax(size, fabs(s->coefficient[k]) * pow(half, (double)k));
    return s->bound / (part * size);
}

/* To two digits, upwards. */
static double upwards(double bound)
{
    static const double more = 1.05;
    char text[32];
    double out = bound;
    for (double at = bound; out <= bound && at > 0; at *= more) {
        snprintf(text, sizeof text, "%.1e", at);
        out = strtod(text, NULL);
    }
    return out;
}

/* Rounded to so many digits, so that rounding in the motion, or in the kernels of another processor, does not change
 * the printed text.  `side`: not below x, not above x, or 0 for the nearest. */
static double rounded(double x, int digits, int side)
{
    static const double less_than_a_unit = 0.3;
    char text[32];
    double out = x;
    for (int k = 0; k == 0 || side * (x - out) > 0; k++) {
        snprintf(text, sizeof text, "%.*e", digits - 1, x + side * k * less_than_a_unit * fabs(x) * pow(10, -digits));
        out = strtod(text, NULL);
    }
    return out;
}

/* bounds include the rounding of coefficients, and lengths follow from bounds */
enum { digits_of_lengths = 2, digits_of_ends = 8, digits_of_states = 12 };

/* Data of every try of an interval. */
typedef struct {
    nh_ball_series *series;
    const nh_explicit_motion *m;
    nh_ex *symbol; /* the integrals, and room for the coefficients and bounds of all */
    double *coefficient, *bound;
    size_t tries; /* number of tries that are left */
} trial;

static trial trial_of(nh_arena *arena, nh_ball_series *series, const nh_explicit_motion *m)
{
    trial t = {.series = series, .m = m, .tries = most_tries};
    t.symbol = nh_arena_alloc(arena, (m->integrals + 1) * sizeof *t.symbol);
    t.coefficient = nh_arena_alloc(arena, (m->integrals + 1) * NH_MOTION_SERIES_TERMS * sizeof *t.coefficient);
    t.bound = nh_arena_alloc(arena, (m->integrals + 1) * sizeof *t.bound);
    for (size_t j = 0; j < m->integrals; j++) t.symbol[j] = m->integral[j].symbol;
    return t;
}

/* The series about the centre, at which the ball's symbols are; returns the largest excess of a bound, INFINITY without
 * bounds. */
static double take_all(const trial *t, nh_motion_series_link *out)
{
    double most = 0;
    if (!nh_ball_series_take(t->series, t->m->integrals, t->symbol, NH_MOTION_SERIES_TERMS, out->half, t->coefficient,
                             t->bound))
        return INFINITY;
    for (size_t j = 0; j < t->m->integrals; j++) {
        nh_motion_series_of_one *s = &out->integral[j];
        s->symbol = t->symbol[j];
        s->bound = t->bound[j];
        memcpy(s->coefficient, t->coefficient + j * NH_MOTION_SERIES_TERMS, sizeof s->coefficient);
        most = fmax(most, excess(s, out->half));
        s->bound = upwards(s->bound);
    }
    return most;
}

/* The length at which the bound would reach what is allowed: bounds grow like x^(terms), those of pieces faster. */
static double ideal(double half, double excess_there)
{
    static const double most = 2;
    return half * fmin(most, pow(excess_there, -1.0 / (NH_MOTION_SERIES_TERMS + 4)));
}

/* An interval beside `edge` on this side, or about it (side = 0), no longer than 2 half.  As in the step control of a
 * numerical integration the length follows from the bound of the try before: *best is the length for the next one. */
static bool next_link(trial *t, double edge, int side, nh_motion_series_link *out, double *best)
{
    static const double shorter = 0.7, shortest = 0.3;
    bool found = false;
    while (!found && t->tries) {
        t->tries--;
        out->centre = edge + side * out->half;
        double most = INFINITY;
        if (!side || nh_ball_series_move(t->series, out->centre, out->half / 2)) most = take_all(t, out);
        found = most <= 1;
        if (found) *best = ideal(out->half, most);
        else
            out->half = rounded(out->half * (isfinite(most) ? fmax(shortest, fmin(shorter, ideal(1, most))) : shorter),
                                digits_of_lengths, 0);
    }
    return found;
}

/* On one side of the start, as far as `to`: the number of intervals.  They end where they are short beside the way, and
 * after a number of tries.  Near a zero of a root each length is the same part of the one before. */
static size_t chain(nh_arena *arena, trial *t, const nh_motion_series_link *first, int side, double to, double best,
                    nh_motion_series_link *out)
{
    static const double safe = 0.9, short_of_all = 1.5e-3;
    double edge = first->centre + side * first->half, whole = fabs(to - first->centre), before = best;
    size_t n = 0;
    while (n < most_links && side * (to - edge) > 0) {
        nh_motion_series_link *l = &out[n];
        double half = rounded(safe * best * fmin(1, best / before), digits_of_lengths, 0), rest = fabs(to - edge) / 2;
        l->half = fmin(half, rest);
        l->integral = nh_arena_alloc(arena, (t->m->integrals + 1) * sizeof *l->integral);
        before = best;
        if (!next_link(t, edge, side, l, &best)) break;
        n++;
        edge = l->half >= rest ? to : l->centre + side * l->half;
        if (l->half < short_of_all * whole) break;
    }
    return n;
}

/* Joins the intervals: those below in reverse order, the first one, those above. */
static void join(nh_motion_series *out, size_t below, const nh_motion_series_link *down,
                 const nh_motion_series_link *first, size_t above, const nh_motion_series_link *up)
{
    for (size_t i = 0; i < below; i++) out->link[i] = down[below - 1 - i];
    out->first = below;
    out->link[below] = *first;
    for (size_t i = 0; i < above; i++) out->link[below + 1 + i] = up[i];
    out->links = below + 1 + above;
}

nh_motion_series *nh_motion_series_from(nh_arena *arena, const nh_model *model, const nh_explicit_motion *m,
                                        const double *z, double low, double high)
{
    nh_ball_defined define[most_defined];
    double start = z[m->parameter], reach = fmax(high - start, start - low);
    nh_motion_series *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_motion_series){.low = low, .high = high, .integrals = m->integrals};
    out->link = nh_arena_alloc(arena, (2 * most_links + 1) * sizeof *out->link);
    nh_motion_series_link *beside[2], first = {.half = reach > 0 ? reach : 1};
    first.integral = nh_arena_alloc(arena, (m->integrals + 1) * sizeof *first.integral);
    nh_ex parameter = m->state[m->parameter];
    size_t links[2] = {0}, defined = list(m, define);
    bool found = true;
    double best = 0;
    for (int side = 0; side < 2 && found; side++) {
        nh_ball *ball = at_start(model, m, z);
        nh_ball_series *series = nh_ball_series_create(model->dag, ball, parameter, defined, define);
        beside[side] = nh_arena_alloc(arena, most_links * sizeof *beside[side]);
        trial t = trial_of(arena, series, m);
        if (side == 0) found = next_link(&t, start, 0, &first, &best);
        if (found) links[side] = chain(arena, &t, &first, side ? 1 : -1, side ? high : low, best, beside[side]);
        nh_ball_series_free(series);
        nh_ball_free(ball);
    }
    if (found) join(out, links[0], beside[0], &first, links[1], beside[1]);
    return found ? out : NULL;
}

double nh_motion_series_begin(const nh_motion_series *s) { return s->link[0].centre - s->link[0].half; }

double nh_motion_series_end(const nh_motion_series *s)
{
    const nh_motion_series_link *last = &s->link[s->links - 1];
    return last->centre + last->half;
}

double nh_motion_series_value(const nh_motion_series_link *l, size_t j, double at)
{
    double sum = 0;
    for (size_t k = NH_MOTION_SERIES_TERMS; k-- > 0;) sum = sum * (at - l->centre) + l->integral[j].coefficient[k];
    return sum;
}

void nh_motion_series_add(nh_analysis *result)
{
    nh_model *model = result->question->model;
    const nh_validation *v = result->validation;
    const nh_explicit_motion *m = result->motion;
    size_t width = model->m + model->n;
    if (!m || !m->integrals || !v || !v->count) return;
    double *z = nh_arena_alloc(result->arena, (1 + width) * sizeof *z);
    z[0] = rounded(v->time[0], digits_of_states, 0);
    for (size_t j = 0; j < width; j++) z[1 + j] = rounded(v->state[j], digits_of_states, 0);
    double low = z[m->parameter], high = low;
    for (size_t i = 0; i < v->count; i++) {
        double s = m->parameter ? v->state[i * width + m->parameter - 1] : v->time[i];
        if (isfinite(s)) low = fmin(low, s), high = fmax(high, s);
    }
    low = rounded(low, digits_of_ends, -1);
    high = rounded(high, digits_of_ends, 1);
    nh_explicit_motion *own = nh_arena_alloc(result->arena, sizeof *own);
    *own = *m;
    own->series = nh_motion_series_from(result->arena, model, m, z, low, high);
    result->motion = own;
}
