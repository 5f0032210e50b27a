/* assembly: see assembly.h. */
#include "motion/assembly.h"

#include <math.h>
#include <string.h>

#include "base/linalg.h"
#include "geometry/bordered.h"
#include "graph/diff.h"
#include "graph/terms.h"
#include "system/bodies.h"
#include "system/sample.h"

enum { most_steps = 60, most_tries = 16 };
static const double satisfied = 1e-11; /* relative, as `values` says */

struct nh_assembly {
    const nh_model *model;
    nh_arena *arena;
    size_t count, m;
    const char **words;
    nh_tape *tape; /* e, the sums of the moduli of their terms, de_k/dq_j at [2 count + k + j*count] */
    nh_tape_work *work;
    double *in, *out, *unit;
    /* of one search: q0, the free coordinates, and W with W W^T = K^-1 of these (free x free) */
    double *from, *root;
    size_t *index, free;
};

/* ---- the equations ---- */

static size_t equations(const nh_model *model, nh_arena *arena, nh_ex *e, const char **words)
{
    const nh_system *system = model->system;
    size_t n = 0;
    for (size_t a = 0; a < system->constraints; a++)
        if (system->constraint[a].position) words[n] = system->constraint[a].text, e[n++] = system->constraint[a].level;
    for (size_t i = 0; system->chain && i < system->chain->wheels; i++) {
        const nh_wheel *w = &system->chain->wheel[i];
        bool moves = false;
        if (w->kind != NH_WHEEL_ROLLING) continue;
        nh_ex height = nh_tidy(model->dag, nh_wheel_height(system->chain, model->dag, w));
        for (size_t j = 0; j < model->m; j++) moves |= nh_depends(model->dag, height, system->coordinate[j].q);
        if (!moves) continue;
        words[n] = nh_arena_printf(arena, "the contact of the wheel `%s`", system->chain->body[w->body].name);
        e[n++] = height;
    }
    return n;
}

nh_assembly *nh_assembly_create(const nh_model *model)
{
    const nh_system *system = model->system;
    size_t m = model->m, most = system->constraints + (system->chain ? system->chain->wheels : 0);
    nh_arena *arena = nh_arena_create();
    nh_assembly *a = nh_arena_alloc(arena, sizeof *a);
    nh_ex *e = nh_arena_alloc(arena, (most + 1) * (m + 2) * sizeof *e),
          *in = nh_arena_alloc(arena, (m + 1) * sizeof *in);
    *a = (nh_assembly){.model = model, .arena = arena, .m = m};
    a->words = nh_arena_alloc(arena, (most + 1) * sizeof *a->words);
    size_t n = a->count = equations(model, arena, e, a->words);
    if (!n) {
        nh_arena_free(arena);
        return NULL;
    }
    in[0] = system->t;
    for (size_t j = 0; j < m; j++) in[1 + j] = system->coordinate[j].q;
    for (size_t k = 0; k < n; k++) {
        e[n + k] = nh_terms_moduli(model->dag, e[k]);
        for (size_t j = 0; j < m; j++) e[2 * n + k + j * n] = nh_diff(model->dag, e[k], in[1 + j]);
    }
    a->tape = nh_tape_create(model->dag, m + 1, in, n * (m + 2), e, system->parameters, model->parameter,
                             model->parameter_value);
    a->work = nh_tape_work_create(a->tape);
    a->in = nh_arena_alloc(arena, (m + 1) * sizeof *a->in);
    a->out = nh_arena_alloc(arena, n * (m + 2) * sizeof *a->out);
    a->unit = nh_arena_alloc(arena, m * sizeof *a->unit);
    for (size_t j = 0; j < m; j++) a->unit[j] = nh_chart_unit(system, j);
    a->from = nh_arena_alloc(arena, m * sizeof *a->from);
    a->root = nh_arena_alloc(arena, m * m * sizeof *a->root);
    a->index = nh_arena_alloc(arena, m * sizeof *a->index);
    return a;
}

void nh_assembly_free(nh_assembly *a)
{
    if (!a) return;
    nh_tape_work_free(a->work);
    nh_tape_free(a->tape);
    nh_arena_free(a->arena);
}

/* Values at q: the largest |e| relative to its terms and to its change by the units of the coordinates; INFINITY where
 * it is not finite. */
static double values(nh_assembly *a, double t, const double *q)
{
    double worst = 0;
    a->in[0] = t;
    memcpy(a->in + 1, q, a->m * sizeof *q);
    nh_tape_eval(a->tape, a->work, a->in, a->out);
    if (!nh_all_finite(a->count * (a->m + 2), a->out)) return INFINITY;
    for (size_t k = 0; k < a->count; k++) {
        double terms = a->out[a->count + k];
        for (size_t j = 0; j < a->m; j++) terms += fabs(a->out[2 * a->count + k + j * a->count]) * a->unit[j];
        worst = fmax(worst, terms > 0 ? fabs(a->out[k]) / terms : 0);
    }
    return worst;
}

const char *nh_assembly_violated(nh_assembly *a, double t, const double *q, double *value, double *distance)
{
    static const double small = 1e-6;
    size_t n = a->count;
    values(a, t, q);
    for (size_t k = 0; k < n; k++) {
        double slope = 0, size = a->out[n + k];
        for (size_t j = 0; j < a->m; j++) {
            double d = a->out[2 * n + k + j * n];
            slope = hypot(slope, d), size += fabs(d * q[j]);
        }
        if (!(fabs(a->out[k]) > small * size)) continue;
        *value = a->out[k];
        *distance = fabs(a->out[k]) / slope;
        return a->words[k];
    }
    return NULL;
}

/* ---- one search ---- */

/* W of the free coordinates: from the metric at q0, whose zeros get a small value; without one, the units. */
static bool metric_root(nh_assembly *a, double t, const double *q0)
{
    static const double least = 1e-9;
    const nh_model *model = a->model;
    size_t m = a->m, k = model->k, f = a->free;
    nh_bordered *b = nh_bordered_create(model);
    double *all = nh_alloc_array(m * m + 3 * m + k * m + 2 * k + 1, sizeof *all), *h = all + m * m, *zero = h + m,
           *F = zero + m, *g = F + k * m, *level = g + k;
    double *sub = nh_alloc_array(2 * f * f + f + 1, sizeof *sub), *left = sub + f * f, *singular = left + f * f;
    bool known = nh_bordered_terms(b, t, q0, zero, all, h, F, g, level);
    for (size_t i = 0; i < f; i++)
        for (size_t j = 0; j < f; j++) {
            double unit = a->unit[a->index[i]];
            sub[i + j * f] = known ? all[a->index[i] + a->index[j] * m] : i == j ? 1 / (unit * unit) : 0;
        }
    bool good = nh_svd(f, f, sub, singular, left, NULL) && singular[0] > 0;
    for (size_t j = 0; good && j < f; j++)
        for (size_t i = 0; i < f; i++)
            a->root[i + j * f] = left[i + j * f] / sqrt(fmax(singular[j], least * singular[0]));
    nh_bordered_free(b);
    nh_free(sub);
    nh_free(all);
    return good;
}

/* The step of least norm with J step = right (count values), into all coordinates.  The values at the position are
 * known. */
static bool least_step(const nh_assembly *a, const double *right, double *step)
{
    static const double rank = 1e-9;
    size_t n = a->count, f = a->free, tall = n > f ? n : f;
    double *A = nh_alloc_array(n * f + tall + 1, sizeof *A), *b = A + n * f;
    for (size_t k = 0; k < n; k++) {
        double size = 0;
        for (size_t j = 0; j < f; j++) {
            for (size_t i = 0; i < f; i++) A[k + j * n] += a->out[2 * n + k + a->index[i] * n] * a->root[i + j * f];
            size = hypot(size, A[k + j * n]);
        }
        for (size_t j = 0; j < f && size > 0; j++) A[k + j * n] /= size;
        b[k] = size > 0 ? right[k] / size : 0;
    }
    bool good = nh_least_squares(n, f, A, 1, b, tall, rank) >= 0;
    memset(step, 0, a->m * sizeof *step);
    for (size_t i = 0; good && i < f; i++)
        for (size_t j = 0; j < f; j++) step[a->index[i]] += a->root[i + j * f] * b[j];
    nh_free(A);
    return good && nh_all_finite(a->m, step);
}

/* Newton's method with steps that are halved until they help. */
static bool newton(nh_assembly *a, double t, double *q)
{
    size_t m = a->m, n = a->count;
    double *step = nh_alloc_array(2 * m + n, sizeof *step), *next = step + m, *right = next + m;
    double off = values(a, t, q);
    for (int i = 0; i < most_steps && off > 0 && isfinite(off); i++) {
        double part = 1, found = off;
        for (size_t k = 0; k < n; k++) right[k] = -a->out[k];
        if (!least_step(a, right, step)) break;
        for (; part > 1e-4; part /= 2) {
            for (size_t j = 0; j < m; j++) next[j] = q[j] + part * step[j];
            found = values(a, t, next);
            if (found < (1 - part / 4) * off) break;
        }
        if (!(found < off)) break;
        memcpy(q, next, m * sizeof *q);
        off = found;
    }
    off = values(a, t, q);
    nh_free(step);
    return off < satisfied;
}

/* (q - q0)^T K (q - q0) of the free coordinates, as |W^-1 (q - q0)|^2. */
static double distance(const nh_assembly *a, const double *q)
{
    size_t f = a->free;
    double sum = 0;
    for (size_t j = 0; j < f; j++) {
        double along = 0, size = 0; /* the columns of W are orthogonal */
        for (size_t i = 0; i < f; i++) {
            along += a->root[i + j * f] * (q[a->index[i]] - a->from[a->index[i]]);
            size += a->root[i + j * f] * a->root[i + j * f];
        }
        sum += along * along / (size * size);
    }
    return sum;
}

/* From a position that satisfies the equations to the nearest one; it stays where that does not converge. */
static void nearest(nh_assembly *a, double t, double *q)
{
    size_t m = a->m, n = a->count;
    double *next = nh_alloc_array(2 * m + n, sizeof *next), *step = next + m, *right = step + m;
    double before = distance(a, q);
    memcpy(next, q, m * sizeof *q);
    bool good = true;
    for (int i = 0; i < most_steps && good && values(a, t, next) < 1; i++) {
        for (size_t k = 0; k < n; k++) {
            right[k] = -a->out[k];
            for (size_t j = 0; j < m; j++) right[k] += a->out[2 * n + k + j * n] * (next[j] - a->from[j]);
        }
        good = least_step(a, right, step);
        for (size_t j = 0; j < m; j++) next[j] = a->from[j] + step[j];
    }
    if (good && newton(a, t, next) && distance(a, next) < before) memcpy(q, next, m * sizeof *q);
    nh_free(next);
}

bool nh_assembly_move(nh_assembly *a, double t, const bool *held, double *q)
{
    static const double widths[] = {0.03, 0.1, 0.3, 1};
    size_t m = a->m;
    uint64_t seed = 1;
    double least = INFINITY;
    double *best = nh_alloc_array(2 * m, sizeof *best), *at = best + m;
    memcpy(a->from, q, m * sizeof *q);
    a->free = 0;
    for (size_t j = 0; j < m; j++)
        if (!held || !held[j]) a->index[a->free++] = j;
    bool good = a->free && metric_root(a, t, q);
    for (int i = 0; good && i <= most_tries && !(i == 1 && least < INFINITY); i++) {
        memcpy(at, a->from, m * sizeof *at);
        for (size_t j = 0; i && j < a->free; j++)
            at[a->index[j]] += widths[(i - 1) / 4] * (2 * nh_random(&seed) - 1) * a->unit[a->index[j]];
        if (!newton(a, t, at)) continue;
        nearest(a, t, at);
        if (distance(a, at) >= least) continue;
        least = distance(a, at);
        memcpy(best, at, m * sizeof *at);
    }
    if (least < INFINITY) memcpy(q, best, m * sizeof *q);
    nh_free(best);
    return least < INFINITY;
}
