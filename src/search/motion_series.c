#include "search/motion_series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact/ball_series.h"
#include "integrals/exact_points.h"

enum { most_defined = 16, tries = 50, most_links = 48, bits = 128 }; /* most_links: on either side of the start */

/* States, parameters, constants and roots at the start; integrals are 0 there. */
static nh_ball *at_start(const nh_model *o, const nh_explicit_motion *m, const double *z)
{
    nh_ball *ball = nh_ball_create(o->dag, bits);
    nh_exact_parameters(o, ball);
    for (size_t i = 0; i < m->states; i++) nh_ball_set_double(ball, m->state[i], z[i]);
    for (size_t j = 0; j < m->integrals; j++) nh_ball_set_ratio(ball, m->integral[j].symbol, 0, 1);
    for (size_t j = 0; j < m->constants; j++) nh_ball_set_expression(ball, m->constant[j].symbol, m->constant[j].value);
    for (size_t j = 0; j < m->roots; j++) nh_ball_set_expression(ball, m->root[j].symbol, m->root[j].value);
    return ball;
}

static size_t list(const nh_explicit_motion *m, nh_ball_defined *out)
{
    size_t n = 0;
    for (size_t j = 0; j < m->roots && n < most_defined; j++)
        out[n++] = (nh_ball_defined){m->root[j].symbol, m->root[j].square, false};
    for (size_t j = 0; j < m->integrals && n < most_defined; j++)
        out[n++] = (nh_ball_defined){m->integral[j].symbol, m->integral[j].integrand, true};
    return n;
}

/* Is the bound small beside the largest term? */
static bool sharp(const nh_motion_series_of_one *s, double half)
{
    static const double part = 1e-12;
    double size = 0;
    for (size_t k = 0; k < NH_MOTION_SERIES_TERMS; k++)
        size = fmax(size, fabs(s->coefficient[k]) * pow(half, (double)k));
    return s->bound <= part * size;
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

/* The series about the centre, where the ball stands. */
static bool take_all(nh_ball_series *series, const nh_explicit_motion *m, nh_motion_series_link *out)
{
    bool fine = true;
    for (size_t j = 0; j < m->integrals && fine; j++) {
        nh_motion_series_of_one *s = &out->integral[j];
        s->symbol = m->integral[j].symbol;
        fine = nh_ball_series_take(series, s->symbol, NH_MOTION_SERIES_TERMS, out->half, s->coefficient, &s->bound) &&
               sharp(s, out->half);
    }
    for (size_t j = 0; j < m->integrals && fine; j++) out->integral[j].bound = upwards(out->integral[j].bound);
    return fine;
}

/* The largest interval beside `edge` on this side, or about it (side = 0), no longer than 2 half. */
static bool next_link(nh_ball_series *series, const nh_explicit_motion *m, double edge, int side,
                      nh_motion_series_link *out)
{
    static const double shorter = 0.7;
    bool found = false;
    for (int i = 0; i < tries && !found; i++) {
        out->centre = edge + side * out->half;
        found = (!side || nh_ball_series_move(series, out->centre)) && take_all(series, m, out);
        if (!found) out->half *= shorter;
    }
    return found;
}

/* On one side of the start, as far as `to`: the number of intervals.  They end where they are short beside the way. */
static size_t chain(nh_arena *arena, nh_ball_series *series, const nh_explicit_motion *m,
                    const nh_motion_series_link *first, int side, double to, nh_motion_series_link *out)
{
    static const double longer = 1.5, short_of_all = 1e-3;
    double edge = first->centre + side * first->half, half = first->half, whole = fabs(to - first->centre);
    size_t n = 0;
    while (n < most_links && side * (to - edge) > 0) {
        nh_motion_series_link *l = &out[n];
        l->half = fmin(longer * half, fabs(to - edge) / 2);
        l->integral = nh_arena_alloc(arena, (m->integrals + 1) * sizeof *l->integral);
        bool last = l->half < longer * half;
        if (!next_link(series, m, edge, side, l)) break;
        n++;
        half = l->half;
        edge = last && l->half >= fabs(to - edge) / 2 ? to : l->centre + side * half;
        if (half < short_of_all * whole) break;
    }
    return n;
}

/* Those below in reverse, the first, those above. */
static void join(nh_motion_series *out, size_t below, const nh_motion_series_link *down,
                 const nh_motion_series_link *first, size_t above, const nh_motion_series_link *up)
{
    for (size_t i = 0; i < below; i++) out->link[i] = down[below - 1 - i];
    out->first = below;
    out->link[below] = *first;
    for (size_t i = 0; i < above; i++) out->link[below + 1 + i] = up[i];
    out->links = below + 1 + above;
}

nh_motion_series *nh_motion_series_from(nh_arena *arena, const nh_model *o, const nh_explicit_motion *m,
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
    for (int side = 0; side < 2 && found; side++) {
        nh_ball *ball = at_start(o, m, z);
        nh_ball_series *series = nh_ball_series_create(o->dag, ball, parameter, defined, define);
        beside[side] = nh_arena_alloc(arena, most_links * sizeof *beside[side]);
        if (side == 0) found = next_link(series, m, start, 0, &first);
        if (found) links[side] = chain(arena, series, m, &first, side ? 1 : -1, side ? high : low, beside[side]);
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

void nh_motion_series_add(nh_analysis *r)
{
    const nh_validation *v = r->validation;
    const nh_explicit_motion *m = r->motion;
    size_t width = r->model->m + r->model->n;
    if (!m || !m->integrals || !v || !v->count) return;
    double *z = nh_arena_alloc(r->arena, (1 + width) * sizeof *z);
    z[0] = v->time[0];
    memcpy(z + 1, v->state, width * sizeof *z);
    double low = z[m->parameter], high = low;
    for (size_t i = 0; i < v->count; i++) {
        double s = m->parameter ? v->state[i * width + m->parameter - 1] : v->time[i];
        if (isfinite(s)) low = fmin(low, s), high = fmax(high, s);
    }
    nh_explicit_motion *own = nh_arena_alloc(r->arena, sizeof *own);
    *own = *m;
    own->series = nh_motion_series_from(r->arena, r->model, m, z, low, high);
    r->motion = own;
}
