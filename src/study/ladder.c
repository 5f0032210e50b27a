#include "study/ladder.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#include "expr/normal.h"
#include "noether/pencil.h"
#include "noether/sectors.h"
#include "study/naming.h"
#include "study/stages.h"

enum { range_points = 256, least_points = 256, most_tested = 60, most_kappa = 16, most_values = 24, most_factors = 10, short_factor = 14 };
static const double points_per_column = 2.5;

typedef struct {
    nh_result *r;
    nh_workbench *bench;
    nh_dictionary words;
    nh_points *ranges;
    nh_reflections *reflections; /* found when a stage is large */
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

/* Gradients against those of the known currents; candidates come simplest first.  kind[k] of candidate k; returns how many are new. */
static size_t compare(climber *x, nh_candidates *list, nh_independence *kind)
{
    nh_result *r = x->r;
    size_t known = r->count, n = list->count < most_tested ? list->count : most_tested, fresh = 0;
    nh_ex *phi = nh_alloc_array(known + n + 1, sizeof *phi);
    nh_independence *all = nh_alloc_array(known + n + 1, sizeof *all);
    for (size_t k = 0; k < known; k++) phi[k] = r->found[k].phi;
    for (size_t k = 0; k < n; k++) phi[known + k] = rough(r->model, &list->candidate[k]);
    nh_independence_test(r->model, x->bench->generic, known + n, phi, r->options.sure, r->options.doubt, all, NULL);
    for (size_t k = 0; k < n; k++) {
        kind[k] = all[known + k];
        fresh += kind[k] == NH_INDEPENDENT;
    }
    list->count = n;
    nh_free(all);
    nh_free(phi);
    return fresh;
}

static bool done(const climber *x)
{
    return x->r->independent >= x->r->local_maximum || seconds() - x->start > x->r->options.max_seconds;
}

/* Certificates of vectors that are only likely are dear and mostly refused: the time limit ends them too, and leaves the question open. */
static size_t add_new(climber *x, nh_candidates *list, const nh_points *fit, bool certain)
{
    nh_result *r = x->r;
    size_t before = r->independent;
    nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
    compare(x, list, kind);
    for (size_t k = 0; k < list->count && r->independent < r->local_maximum; k++) {
        nh_candidate *c = &list->candidate[k];
        if (!certain && done(x)) {
            r->open += kind[k] == NH_INDEPENDENT;
            continue;
        }
        if (kind[k] == NH_INDEPENDENT && nh_currents_add(x->bench, c, fit, certain)) {
            r->independent++;
            keep_factor(x, r->found[r->count - 1].phi);
        } else if (c->count == 1 && kind[k] == NH_DEPENDENT) {
            keep_factor(x, c->term[0]);
        }
    }
    r->independent += nh_currents_join(x->bench, fit);
    nh_free(kind);
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

/* A stage's linear problem, solved. */
typedef struct {
    nh_ansatz *ansatz;
    nh_points *fit;
    nh_nullspace *nullspace; /* NULL when something went wrong */
    size_t sectors;
} solved;

static nh_sectors split(climber *x, nh_ansatz *a)
{
    nh_result *r = x->r;
    bool large = a->columns > (size_t)r->options.split_columns;
    nh_reflections none = {0};
    if (large && !x->reflections) x->reflections = nh_reflections_find(r->model, x->ranges);
    return nh_sectors_split(r->model, large ? x->reflections : &none, x->ranges, a);
}

/* Columns are limited by the largest part, and by what can be held at all. */
static solved solve_stage(climber *x, size_t families, const nh_family *family)
{
    nh_result *r = x->r;
    nh_error ignored;
    nh_error_clear(&ignored);
    solved s = {.ansatz = nh_ansatz_create(r->model, x->ranges, families, family, (size_t)r->options.columns, &ignored)};
    if (!s.ansatz) return s;
    nh_sectors sectors = split(x, s.ansatz);
    s.sectors = sectors.count;
    if (sectors.largest > (size_t)r->options.stage_columns) {
        nh_ansatz_free(s.ansatz);
        s.ansatz = NULL;
    } else if (sectors.count) {
        size_t count = (size_t)fmax(least_points, points_per_column * (double)sectors.largest);
        nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
        s.fit = nh_points_create(r->model, count, 1, (uint64_t)r->options.seed + r->stages, &ignored);
        if (s.fit) s.nullspace = nh_sectors_solve(r->model, s.ansatz, &sectors, s.fit, &limits, (size_t)r->options.threads, &ignored);
    }
    nh_sectors_clear(&sectors);
    return s;
}

static void clear_stage(solved *s)
{
    nh_nullspace_free(s->nullspace);
    nh_points_free(s->fit);
    nh_ansatz_free(s->ansatz);
}

/* Would this stage give anything new? */
static bool promising(climber *x, size_t families, const nh_family *family)
{
    solved s = solve_stage(x, families, family);
    bool fresh = false;
    if (s.nullspace && s.nullspace->likely) {
        nh_candidates *list = nh_echelon(x->r->model, s.fit, s.ansatz, s.nullspace, s.nullspace->likely, &x->r->options);
        nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
        fresh = compare(x, list, kind) > 0;
        nh_free(kind);
        nh_candidates_free(list);
    }
    clear_stage(&s);
    return fresh;
}

/* The first `count` null vectors, turned into what is new in them. */
static size_t harvest(climber *x, const solved *s, size_t count, bool certain)
{
    nh_candidates *list = nh_echelon(x->r->model, s->fit, s->ansatz, s->nullspace, count, &x->r->options);
    size_t found = add_new(x, list, s->fit, certain);
    nh_candidates_free(list);
    return found;
}

static void run_stage(climber *x, const char *name, size_t families, const nh_family *family)
{
    nh_result *r = x->r;
    if (families == 0) return;
    double start = seconds();
    nh_tried *note = note_stage(x, name);
    solved s = solve_stage(x, families, family);
    note->skipped = !s.ansatz;
    note->columns = s.ansatz ? s.ansatz->columns : 0;
    note->sectors = s.sectors;
    if (s.nullspace) {
        note->dimension = s.nullspace->dimension;
        note->gap = s.nullspace->gap;
        note->undecided = s.nullspace->likely > s.nullspace->dimension;
        r->samples = s.fit->count > r->samples ? s.fit->count : r->samples;
        r->rejected += s.fit->tried - s.fit->count;
        note->found = harvest(x, &s, s.nullspace->dimension, true);
        if (s.nullspace->likely > s.nullspace->dimension) note->found += harvest(x, &s, s.nullspace->likely, false);
        keep_spectrum(r, s.nullspace, note->found > 0);
    }
    note->seconds = seconds() - start;
    clear_stage(&s);
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

/* The rate as an expression of the parameters; just as a number while it is only tried. */
static nh_ex rate_of(rate_context *c, double value, bool imaginary, bool trial)
{
    const nh_result *r = c->x->r;
    c->imaginary = imaginary;
    if (fabs(value) < 1e-9) return 0; /* node 0 is the number 0 */
    nh_ex e = trial ? 0 : nh_name_value(r->model, value, follow, c, r->options.recognise, (uint64_t)r->options.seed);
    return e ? e : nh_real(r->model->dag, value);
}

/* exp(-re q) {cos(im q), sin(im q)} for every rate. */
static size_t wave_terms(rate_context *c, size_t n, const double *re, const double *im, bool trial, nh_ex *out)
{
    nh_dag *d = c->x->r->model->dag;
    size_t count = 0;
    for (size_t k = 0; k < n; k++) {
        bool waves = fabs(im[k]) > 1e-9 * fabs(re[k]), decays = fabs(re[k]) > 1e-9 * fabs(im[k]);
        nh_ex decay = decays ? nh_call(d, NH_EXP, nh_neg(d, nh_mul(d, rate_of(c, re[k], false, trial), c->q))) : nh_int(d, 1);
        nh_ex angle = waves ? nh_mul(d, rate_of(c, im[k], true, trial), c->q) : 0;
        if (!waves) out[count++] = decay;
        else {
            out[count++] = nh_mul(d, decay, nh_call(d, NH_COS, angle));
            out[count++] = nh_mul(d, decay, nh_call(d, NH_SIN, angle));
        }
    }
    return count;
}

/* The base times the waves; with the base itself only where it is everything of degree one (smooth functions on a small interval are nearly
 * dependent, so that nothing unnecessary should be there). */
static size_t wave_families(climber *x, const nh_family *base, size_t which, size_t terms, const nh_ex *wave, nh_family *out)
{
    nh_family *part = nh_arena_alloc(x->r->arena, 2 * sizeof *part);
    part[0] = *base;
    part[1] = (nh_family){.kind = NH_TERMS, .terms = terms, .term = wave};
    out[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    out[1] = *base;
    return which == NH_PENCIL_BASES - 1 ? 2 : 1;
}

/* Returns whether something new was found. */
static bool pencil_stage(climber *x, nh_ex q, const char *name, size_t which)
{
    enum { most_rates = 4 };
    nh_result *r = x->r;
    nh_error ignored;
    nh_error_clear(&ignored);
    size_t before = r->independent;
    nh_family base = nh_stage_pencil_base(r->arena, r->model, &x->words, which), family[2];
    nh_ansatz *a = nh_ansatz_create(r->model, x->ranges, 1, &base, range_points / 2 - 2, &ignored);
    if (!a) return false;
    rate_context c = {.x = x, .base = a, .q = q};
    for (size_t i = 0; i < x->words.waves; i++) c.periodic |= x->words.wave[i] == q;
    double re[most_values], im[most_values];
    size_t n = rates(r->model, &c, re, im, most_values);
    if (n > most_rates) n = most_rates;
    nh_ex *wave = nh_arena_alloc(r->arena, (2 * n + 1) * sizeof *wave);
    size_t terms = wave_terms(&c, n, re, im, true, wave);
    if (terms && promising(x, wave_families(x, &base, which, terms, wave, family), family)) {
        char text[120];
        snprintf(text, sizeof text, "exponentials and waves in %s with rates found by the pencil", name);
        wave_terms(&c, n, re, im, false, wave);
        run_stage(x, text, wave_families(x, &base, which, terms, wave, family), family);
    }
    nh_ansatz_free(a);
    return r->independent > before;
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

/* The energy and each momentum alone: nothing nearly dependent beside them can take their place. */
static void single_stages(climber *x)
{
    nh_result *r = x->r;
    for (size_t i = 0; i <= x->words.momenta && !done(x); i++) {
        nh_ex *e = nh_arena_alloc(r->arena, sizeof *e);
        nh_family *all = nh_arena_alloc(r->arena, sizeof *all);
        *e = i == 0 ? r->model->E : x->words.momentum[i - 1];
        *all = (nh_family){.kind = NH_TERMS, .terms = 1, .term = e};
        if (promising(x, 1, all)) run_stage(x, i == 0 ? "energy" : "a momentum", 1, all);
    }
}

/* Each of the system's functions alone: many at once are nearly dependent on a small interval. */
static void function_stages(climber *x)
{
    nh_result *r = x->r;
    size_t n = x->words.velocities + x->words.forms;
    nh_ex *linear = nh_arena_alloc(r->arena, (n + 1) * sizeof *linear);
    memcpy(linear, x->words.velocity, x->words.velocities * sizeof *linear);
    memcpy(linear + x->words.velocities, x->words.form, x->words.forms * sizeof *linear);
    for (size_t i = 0; i < x->words.atoms && !done(x); i++) {
        nh_family *part = nh_arena_alloc(r->arena, 2 * sizeof *part), *all = nh_arena_alloc(r->arena, sizeof *all);
        part[0] = (nh_family){.kind = NH_TERMS, .terms = n, .term = linear};
        part[1] = (nh_family){.kind = NH_TERMS, .terms = 1, .term = &x->words.atom[i]};
        all[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
        if (promising(x, 1, all)) run_stage(x, "velocities and forms times one function", 1, all);
    }
}

/* The smallest base that gives something new is enough for a coordinate: larger ones only obscure what it found. */
static void all_pencils(climber *x)
{
    const nh_model *o = x->r->model;
    for (size_t i = 0; i <= o->m; i++) {
        nh_ex q = i == 0 ? o->system->t : o->system->coordinate[i - 1].q;
        for (size_t base = 0; base < NH_PENCIL_BASES && !done(x); base++)
            if (pencil_stage(x, q, nh_name_of(o->dag, q), base)) break;
    }
}

bool nh_ladder_climb(nh_result *r, nh_error *error)
{
    enum { pencils_after = 2, known_after = 5 };
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
    single_stages(&x);
    for (size_t i = 0; !done(&x) && nh_stage_at(r->arena, r->model, &x.words, i, &stage); i++) {
        run_stage(&x, stage.name, stage.families, stage.family);
        if (i + 1 == pencils_after) all_pencils(&x);
        if (i + 1 == known_after) function_stages(&x);
        if (i + 1 == known_after && !done(&x)) known_stage(&x);
    }
    if (seconds() - x.start > r->options.max_seconds) {
        r->partial = true;
        nh_result_warn(r, "the time limit of %g s ended the search; --max-seconds raises it", r->options.max_seconds);
    }
    nh_currents_finish(x.bench);
    nh_workbench_free(x.bench);
    nh_reflections_free(x.reflections);
    nh_points_free(x.ranges);
    return true;
}
