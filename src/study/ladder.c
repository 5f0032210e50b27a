#include "study/ladder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "expr/normal.h"
#include "noether/pencil.h"
#include "study/naming.h"
#include "study/stages.h"

enum { range_points = 256, least_points = 256, most_tested = 60, most_kappa = 16, most_values = 24, most_factors = 10, short_factor = 14 };
static const double points_per_column = 2.5;

typedef struct {
    nh_result *r;
    nh_workbench *bench;
    nh_dictionary words;
    nh_points *ranges;
    size_t factors;    /* simple currents, dependent ones too: factors of later stages */
    nh_ex factor[most_factors];
    double start;
} climber;

static double seconds(void)
{
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* ---- which candidates are new ---- */

static nh_ex rough(const nh_model *o, const nh_candidate *c)
{
    nh_ex e = nh_int(o->dag, 0);
    for (size_t j = 0; j < c->count; j++) e = nh_add(o->dag, e, nh_mul(o->dag, nh_real(o->dag, c->coefficient[j]), c->term[j]));
    return e;
}

static void keep_factor(climber *x, nh_ex phi)
{
    if (x->factors == most_factors || nh_complexity(x->r->model->dag, phi) > short_factor) return;
    for (size_t i = 0; i < x->factors; i++)
        if (x->factor[i] == phi) return;
    x->factor[x->factors++] = phi;
}

/* Gradients against those of the known currents decide; candidates come simplest first. */
static size_t add_new(climber *x, nh_candidates *list, const nh_points *fit, bool certain)
{
    nh_result *r = x->r;
    size_t known = r->count, n = list->count < most_tested ? list->count : most_tested, before = r->independent;
    nh_ex *phi = nh_alloc_array(known + n + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(known + n + 1, sizeof *kind);
    for (size_t k = 0; k < known; k++) phi[k] = r->found[k].phi;
    for (size_t k = 0; k < n; k++) phi[known + k] = rough(r->model, &list->candidate[k]);
    nh_independence_test(r->model, x->bench->generic, known + n, phi, r->options.sure, r->options.doubt, kind, NULL);
    for (size_t k = 0; k < n && r->independent < r->local_maximum; k++) {
        nh_candidate *c = &list->candidate[k];
        if (kind[known + k] == NH_INDEPENDENT && nh_currents_add(x->bench, c, fit, certain)) {
            r->independent++;
            keep_factor(x, r->found[r->count - 1].phi);
        } else if (c->count == 1 && kind[known + k] == NH_DEPENDENT) {
            keep_factor(x, c->term[0]);
        }
    }
    nh_free(kind);
    nh_free(phi);
    return r->independent - before;
}

/* ---- one stage ---- */

static nh_tried *note_stage(climber *x, const char *name)
{
    nh_result *r = x->r;
    enum { most_stages = 64 };
    if (!r->stage) r->stage = nh_arena_alloc(r->arena, most_stages * sizeof *r->stage);
    if (r->stages == most_stages) r->stages--;
    r->stage[r->stages] = (nh_tried){.name = nh_arena_strdup(r->arena, name)};
    return &r->stage[r->stages++];
}

static void keep_spectrum(nh_result *r, const nh_nullspace *s, bool found)
{
    bool better = !r->current.done || found || (r->count == 0 && s->columns > r->current.columns);
    if (better) r->current = nh_spectrum_of(r->arena, s);
}

static void run_stage(climber *x, const char *name, size_t families, const nh_family *family)
{
    nh_result *r = x->r;
    nh_error trouble;
    nh_error_clear(&trouble);
    if (families == 0) return;
    nh_tried *note = note_stage(x, name);
    double start = seconds();
    nh_ansatz *a = nh_ansatz_create(r->model, x->ranges, families, family, (size_t)r->options.stage_columns, &trouble);
    if (!a) {
        note->skipped = true;
        return;
    }
    size_t count = (size_t)fmax(least_points, points_per_column * (double)a->columns);
    nh_points *fit = nh_points_create(r->model, count, 1, (uint64_t)r->options.seed + r->stages, &trouble);
    nh_equations *equations = nh_equations_create(a->columns);
    nh_rows *rows = nh_rows_create(r->model, a, 0, NULL);
    nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
    if (fit) nh_rows_current(rows, fit, NULL, equations);
    nh_nullspace *s = fit ? nh_nullspace_solve(equations, &limits, &trouble) : NULL;
    note->columns = a->columns;
    if (s) {
        note->dimension = s->dimension;
        note->gap = s->gap;
        note->undecided = s->verdict == NH_UNDECIDED;
        r->samples = fit->count > r->samples ? fit->count : r->samples;
        r->rejected += fit->tried - fit->count;
        nh_candidates *list = nh_echelon(r->model, fit, a, s, &r->options);
        note->found = add_new(x, list, fit, s->likely == s->dimension);
        keep_spectrum(r, s, note->found > 0);
        nh_candidates_free(list);
    }
    note->seconds = seconds() - start;
    nh_nullspace_free(s);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_points_free(fit);
    nh_ansatz_free(a);
}

/* ---- exponentials and waves with unknown rates: exp(-lambda t) f, exp(-lambda q) f ---- */

typedef struct {
    climber *x;
    const nh_ansatz *base;
    nh_ex q; /* t or a coordinate */
    bool periodic, imaginary;
} rate_context;

/* |Im| or Re of the pencil's eigenvalues, each once. */
static size_t rates(const nh_model *o, const rate_context *c, double *re, double *im, size_t most)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    const nh_points *points = c->x->ranges;
    size_t n = c->base->columns, count = 0;
    double *A = nh_alloc_array(points->count * n + 1, sizeof *A), *B = nh_alloc_array(points->count * n + 1, sizeof *B);
    nh_nullspace_options limits = nh_nullspace_options_from(&c->x->r->options);
    nh_rows_pencil(o, c->base, nh_model_gamma(o, c->q), points, A, B);
    nh_pencil *p = nh_pencil_solve(points->count, n, A, B, &limits, c->x->r->options.split, &ignored);
    for (size_t k = 0; p && k < p->dimension && count < most; k++) {
        double x = p->re[k], y = p->im[k];
        if (y < 0 || p->residual[k] > 1e-9) continue;
        if (c->periodic) y = fabs(y - round(y)); /* whole harmonics are in the base: nu, 1 - nu, 1 + nu, ... are one rate */
        bool old = fabs(x) + fabs(y) < 1e-6;
        for (size_t j = 0; j < count && !old; j++) old = fabs(re[j] - x) + fabs(im[j] - y) < 1e-7 * (fabs(re[j]) + fabs(im[j]));
        if (old) continue;
        re[count] = x;
        im[count++] = y;
    }
    nh_pencil_free(p);
    nh_free(B);
    nh_free(A);
    return count;
}

static bool follow(const nh_model *changed, double near, double *value, void *context)
{
    rate_context *c = context;
    double re[most_values], im[most_values], best = HUGE_VAL;
    size_t n = rates(changed, c, re, im, most_values);
    for (size_t i = 0; i < n; i++)
        for (int turn = 0; turn < (c->imaginary && c->periodic ? 2 : 1); turn++) { /* nu may have crossed 1/2, where it was folded */
            double v = !c->imaginary ? re[i] : turn ? 1 - im[i] : im[i];
            if (fabs(v - near) >= best) continue;
            best = fabs(v - near);
            *value = v;
        }
    return n > 0 && best < 0.5 * fabs(near);
}

static nh_ex named(rate_context *c, double value, bool imaginary)
{
    const nh_result *r = c->x->r;
    c->imaginary = imaginary;
    if (fabs(value) < 1e-9) return 0; /* node 0 is the number 0 */
    nh_ex e = nh_name_value(r->model, value, follow, c, r->options.recognise, (uint64_t)r->options.seed);
    return e ? e : nh_real(r->model->dag, value);
}

/* f times exp(-re q) {cos(im q), sin(im q)} for every rate. */
static size_t wave_terms(rate_context *c, size_t n, const double *re, const double *im, nh_ex *out)
{
    nh_dag *d = c->x->r->model->dag;
    size_t count = 0;
    for (size_t k = 0; k < n; k++) {
        bool waves = fabs(im[k]) > 1e-9 * fabs(re[k]), decays = fabs(re[k]) > 1e-9 * fabs(im[k]);
        nh_ex decay = decays ? nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, named(c, re[k], false), c->q))) : nh_int(d, 1);
        nh_ex angle = waves ? nh_mul(d, named(c, im[k], true), c->q) : 0;
        if (!waves) out[count++] = decay;
        else {
            out[count++] = nh_mul(d, decay, nh_call(d, NH_COS, angle));
            out[count++] = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
        }
    }
    return count;
}

static void pencil_stage(climber *x, nh_ex q, const char *name)
{
    enum { most_rates = 4 };
    nh_result *r = x->r;
    nh_error trouble;
    nh_error_clear(&trouble);
    nh_family base = nh_stage_pencil_base(r->arena, r->model, &x->words);
    nh_ansatz *a = nh_ansatz_create(r->model, x->ranges, 1, &base, range_points / 2 - 2, &trouble);
    if (!a) return;
    rate_context c = {.x = x, .base = a, .q = q};
    for (size_t i = 0; i < x->words.waves; i++) c.periodic |= x->words.wave[i] == q;
    double re[most_values], im[most_values];
    size_t n = rates(r->model, &c, re, im, most_values);
    if (n > most_rates) n = most_rates;
    nh_ex *wave = nh_arena_alloc(r->arena, (2 * n + 1) * sizeof *wave);
    size_t terms = wave_terms(&c, n, re, im, wave);
    nh_ansatz_free(a);
    if (terms == 0) return;
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *both = nh_arena_alloc(r->arena, 2 * sizeof *both);
    part[0] = base;
    part[1] = (nh_family){.kind = NH_TERMS, .terms = terms, .term = wave};
    both[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    both[1] = base;
    char text[120];
    snprintf(text, sizeof text, "exponentials and waves in %s with rates found by the pencil", name);
    run_stage(x, text, 2, both);
}

/* Currents found so far as factors: Phi times 1, t, positions and the system's functions. */
static void known_stage(climber *x)
{
    nh_result *r = x->r;
    nh_ex *f = nh_arena_alloc(r->arena, (2 + x->words.positions + x->words.atoms + x->words.potentials) * sizeof *f);
    size_t m = 0;
    f[m++] = nh_int(r->model->dag, 1);
    f[m++] = r->system->t;
    for (size_t i = 0; i < x->words.positions; i++) f[m++] = x->words.position[i];
    for (size_t i = 0; i < x->words.atoms; i++) f[m++] = x->words.atom[i];
    for (size_t i = 0; i < x->words.potentials; i++) f[m++] = x->words.potential[i];
    if (x->factors < 2) return;
    nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *both = nh_arena_alloc(r->arena, sizeof *both);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = x->factors, .term = x->factor};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = m, .term = f};
    both[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    run_stage(x, "currents found so far times t, positions and the system's functions", 1, both);
}

static bool done(const climber *x)
{
    return x->r->independent >= x->r->local_maximum || seconds() - x->start > x->r->options.max_seconds;
}

static void all_pencils(climber *x)
{
    const nh_model *o = x->r->model;
    if (!done(x)) pencil_stage(x, o->system->t, "t");
    for (size_t s = 0; s < o->m && !done(x); s++) pencil_stage(x, o->system->coordinate[s].q, o->system->coordinate[s].name);
}

bool nh_ladder_climb(nh_result *r, nh_error *error)
{
    enum { pencils_after = 2, known_after = 4 };
    climber x = {.r = r, .start = seconds()};
    x.ranges = nh_points_create(r->model, range_points, 1, (uint64_t)r->options.seed, error);
    if (!x.ranges) return false;
    x.bench = nh_workbench_create(r, error);
    if (!x.bench) {
        nh_points_free(x.ranges);
        return false;
    }
    x.words = nh_dictionary_of(r->model);
    nh_stage stage;
    for (size_t i = 0; !done(&x) && nh_stage_at(r->arena, r->model, &x.words, i, &stage); i++) {
        run_stage(&x, stage.name, stage.families, stage.family);
        if (i + 1 == pencils_after) all_pencils(&x);
        if (i + 1 == known_after && !done(&x)) known_stage(&x);
    }
    if (seconds() - x.start > r->options.max_seconds) {
        r->partial = true;
        nh_result_warn(r, "the time limit of %g s ended the search; --max-seconds raises it", r->options.max_seconds);
    }
    nh_currents_finish(x.bench);
    nh_workbench_free(x.bench);
    nh_points_free(x.ranges);
    return true;
}
