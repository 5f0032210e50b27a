#include "search/motion_series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "exact/ball_series.h"
#include "integrals/exact_points.h"

enum { most_defined = 16, tries = 50, bits = 128 };

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

static bool take_all(nh_ball_series *series, const nh_explicit_motion *m, nh_motion_series *out)
{
    bool fine = true;
    for (size_t j = 0; j < m->integrals && fine; j++) {
        nh_motion_series_of_one *s = &out->integral[j];
        s->symbol = m->integral[j].symbol;
        fine = nh_ball_series_take(series, s->symbol, NH_MOTION_SERIES_TERMS, out->half, s->coefficient, &s->bound) &&
               sharp(s, out->half);
    }
    return fine;
}

nh_motion_series *nh_motion_series_from(nh_arena *arena, const nh_model *o, const nh_explicit_motion *m,
                                        const double *z, double reach)
{
    nh_ball_defined define[most_defined];
    nh_motion_series *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_motion_series){.start = z[m->parameter], .half = reach > 0 ? reach : 1, .integrals = m->integrals};
    out->integral = nh_arena_alloc(arena, (m->integrals + 1) * sizeof *out->integral);
    nh_ball *ball = at_start(o, m, z);
    nh_ex parameter = m->state[m->parameter];
    nh_ball_series *series = nh_ball_series_create(o->dag, ball, parameter, list(m, define), define);
    static const double shorter = 0.7;
    bool found = false;
    for (int i = 0; i < tries && !found; i++) {
        found = take_all(series, m, out);
        if (!found) out->half *= shorter;
    }
    nh_ball_series_free(series);
    nh_ball_free(ball);
    for (size_t j = 0; j < m->integrals && found; j++) out->integral[j].bound = upwards(out->integral[j].bound);
    return found ? out : NULL;
}

void nh_motion_series_add(nh_analysis *r)
{
    const nh_validation *v = r->validation;
    const nh_explicit_motion *m = r->motion;
    size_t width = r->model->m + r->model->n;
    if (!m || !m->integrals || !v || !v->count) return;
    double *z = nh_arena_alloc(r->arena, (1 + width) * sizeof *z), reach = 0;
    z[0] = v->time[0];
    memcpy(z + 1, v->state, width * sizeof *z);
    for (size_t i = 0; i < v->count; i++) {
        double s = m->parameter ? v->state[i * width + m->parameter - 1] : v->time[i];
        if (isfinite(s)) reach = fmax(reach, fabs(s - z[m->parameter]));
    }
    nh_explicit_motion *own = nh_arena_alloc(r->arena, sizeof *own);
    *own = *m;
    own->series = nh_motion_series_from(r->arena, r->model, m, z, reach);
    r->motion = own;
}
