#include "search/stage_solver.h"

#include <math.h>
#include <string.h>

#include "base/budget.h"
#include "base/clock.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "exact/antiderivative.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/node.h"
#include "graph/num.h"
#include "integrals/fixed.h"
#include "integrals/prove.h"
#include "search/other_values.h"

enum { range_points = 256, range_points_each = 10, least_points = 256, least_tested = 60 };
static const double points_per_column = 2.5;

bool nh_stage_solver_begin(nh_stage_solver *x, nh_analysis *r, nh_error *error)
{
    size_t points = range_points_each * r->model->m;
    *x = (nh_stage_solver){.r = r, .counted.r = r};
    x->ranges =
        nh_points_create(r->model, points > range_points ? points : range_points, 1, (uint64_t)r->options.seed, error);
    x->bench = x->ranges ? nh_current_checker_create(r, error) : NULL;
    if (!x->bench) nh_stage_solver_end(x);
    return x->bench != NULL;
}

void nh_stage_solver_end(nh_stage_solver *x)
{
    nh_current_checker_free(x->bench);
    nh_reflections_free(x->reflections);
    nh_points_free(x->ranges);
    *x = (nh_stage_solver){0};
}

/* ---- which candidates are new ---- */

static nh_ex rough(const nh_model *o, const nh_candidate *c)
{
    nh_ex e = nh_int(o->dag, 0);
    for (size_t j = 0; j < c->count; j++)
        e = nh_add(o->dag, e, nh_mul(o->dag, nh_real(o->dag, c->coefficient[j]), c->term[j]));
    return e;
}

static size_t most_tested(const nh_analysis *r)
{
    return least_tested > r->local_maximum ? least_tested : r->local_maximum;
}

/* Compares gradients with those of the known currents; candidates come simplest first. kind[k] of candidate k; returns
 * how many are new. */
static size_t compare(nh_stage_solver *x, nh_candidates *list, nh_independence *kind)
{
    nh_analysis *r = x->r;
    size_t known = r->count, most = most_tested(r), n = list->count < most ? list->count : most, fresh = 0;
    nh_ex *phi = nh_alloc_array(known + n + 1, sizeof *phi);
    nh_independence *all = nh_alloc_array(known + n + 1, sizeof *all);
    bool *exact = nh_alloc_array(known + n + 1, sizeof *exact);
    nh_currents_list(r, phi, exact);
    for (size_t k = 0; k < n; k++) {
        phi[known + k] = rough(r->model, &list->candidate[k]);
        exact[known + k] = list->candidate[k].count == 1;
    }
    nh_independence_test(r->model, x->bench->generic, known + n, phi, exact, r->options.sure, r->options.doubt, all,
                         NULL);
    for (size_t k = 0; k < n; k++) {
        kind[k] = all[known + k];
        fresh += kind[k] == NH_INDEPENDENT;
    }
    list->count = n;
    nh_free(exact);
    nh_free(all);
    nh_free(phi);
    return fresh;
}

bool nh_stage_solver_done(const nh_stage_solver *x)
{
    return x->r->independent >= x->r->local_maximum || nh_budget_spent() || nh_late();
}

/* ---- one stage ---- */

nh_stage_record *nh_stage_solver_note(nh_stage_solver *x, const char *name)
{
    nh_analysis *r = x->r;
    if (r->stages == r->stage_capacity) { /* no note is being written while the next one is made */
        nh_stage_record *old = r->stage;
        r->stage_capacity = 2 * r->stage_capacity + 64;
        r->stage = nh_arena_alloc(r->arena, r->stage_capacity * sizeof *r->stage);
        if (r->stages) memcpy(r->stage, old, r->stages * sizeof *old);
    }
    r->stage[r->stages] = (nh_stage_record){.name = nh_arena_strdup(r->arena, name)};
    return &r->stage[r->stages++];
}

/* The spectrum that is reported: of the last stage that found something, else of the largest. */
static void keep_spectrum(nh_stage_solver *x, const nh_nullspace *s, bool found)
{
    nh_analysis *r = x->r;
    bool alone = r->current.columns < 3 && s->columns >= 3; /* the energy alone: one value shows no gap */
    bool better = !r->current.done || found || alone || (r->count == 0 && s->columns > r->current.columns);
    if (better) r->current = nh_spectrum_of(r->arena, s);
}

static nh_sectors split(nh_stage_solver *x, nh_ansatz *a)
{
    nh_analysis *r = x->r;
    bool large = a->columns > (size_t)r->options.split_columns;
    nh_reflections none = {0};
    if (large && !x->reflections) x->reflections = nh_reflections_find(r->model, x->ranges);
    return nh_sectors_split(r->model, large ? x->reflections : &none, x->ranges, a);
}

/* The work of the null spaces of the parts: both triangles, then two decompositions of each. */
static double dense_work(const nh_sectors *sectors, size_t points)
{
    static const double decompositions = 16;
    double sum = 0;
    for (size_t i = 0; i < sectors->count; i++) {
        double c = (double)(sectors->first[i + 1] - sectors->first[i]);
        sum += c * c * (2 * (double)points + decompositions * c);
    }
    return sum;
}

/* A stage is solved completely or not at all. */
static nh_limit limit_of(const nh_stage_solver *x, const nh_sectors *sectors, size_t points)
{
    static const double room = 1.2;
    const nh_options *options = &x->r->options;
    double work = dense_work(sectors, points);
    if (!x->wide && sectors->largest > (size_t)options->stage_columns)
        return (nh_limit){"stage_columns", (double)sectors->largest};
    if (!nh_budget_allows(NH_WORK_DENSE, work))
        return (nh_limit){"work", ceil(room * (nh_budget_used() + nh_work_millions(NH_WORK_DENSE, work)))};
    return (nh_limit){0};
}

static size_t points_for(const nh_sectors *sectors)
{
    return (size_t)fmax(least_points, points_per_column * (double)sectors->largest);
}

/* The number of columns is limited, in all and in the largest part. */
nh_solved nh_stage_solver_solve(nh_stage_solver *x, size_t families, const nh_family *family)
{
    nh_analysis *r = x->r;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_solved s = {.ansatz =
                       nh_ansatz_create(r->model, x->ranges, families, family, (size_t)r->options.columns, &ignored)};
    if (!s.ansatz) {
        s.limit = (nh_limit){"columns", nh_ansatz_size(families, family)};
        return s;
    }
    nh_sectors sectors = split(x, s.ansatz);
    size_t count = points_for(&sectors);
    s.sectors = sectors.count;
    s.limit = limit_of(x, &sectors, count);
    if (s.limit.option) {
        nh_ansatz_free(s.ansatz);
        s.ansatz = NULL;
    } else if (sectors.count) {
        nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
        s.fit = nh_points_cover(r->model, count, (uint64_t)r->options.seed + r->stages, &ignored);
        if (s.fit)
            s.nullspace = nh_sectors_solve(r->model, s.ansatz, &sectors, s.fit, &limits, nh_threads(r->options.threads),
                                           &ignored);
    }
    nh_sectors_clear(&sectors);
    return s;
}

void nh_solved_clear(nh_solved *s)
{
    nh_nullspace_free(s->nullspace);
    nh_points_free(s->fit);
    nh_ansatz_free(s->ansatz);
}

size_t nh_stage_solver_news(nh_stage_solver *x, size_t families, const nh_family *family, double *worst)
{
    if (nh_counted_superfluous(&x->counted, families, family, false)) return 0;
    nh_solved s = nh_stage_solver_solve(x, families, family);
    size_t fresh = 0;
    if (worst) *worst = s.nullspace && s.nullspace->likely ? s.nullspace->spectrum[s.nullspace->likely - 1] : 0;
    if (s.nullspace && s.nullspace->likely) {
        nh_candidates *list =
            nh_echelon(x->r->model, s.fit, s.ansatz, s.nullspace, s.nullspace->likely, &x->r->options);
        nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
        fresh = compare(x, list, kind);
        nh_free(kind);
        nh_candidates_free(list);
    }
    nh_solved_clear(&s);
    return fresh;
}

bool nh_stage_solver_promising(nh_stage_solver *x, size_t families, const nh_family *family)
{
    return nh_stage_solver_news(x, families, family, NULL) > 0;
}

/* The null space of the stage where the parameters have other values. */
static void solve_elsewhere(nh_stage_solver *x, const nh_solved *s, size_t pivots, const nh_ex *pivot,
                            nh_other_values *other)
{
    const nh_analysis *r = x->r;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!nh_other_values_begin(r->model, other)) return;
    nh_sectors sectors = split(x, s->ansatz); /* in the order in which it is */
    size_t count = points_for(&sectors);
    nh_nullspace_options limits = nh_nullspace_options_from(&r->options);
    nh_nullspace *nullspace = NULL;
    if (sectors.count && !limit_of(x, &sectors, count).option)
        other->points = nh_points_create(&other->model, count, 1, (uint64_t)r->options.seed + r->stages, &ignored);
    if (other->points)
        nullspace = nh_sectors_solve(&other->model, s->ansatz, &sectors, other->points, &limits,
                                     nh_threads(r->options.threads), &ignored);
    if (nullspace) nh_other_values_take(other, s->ansatz, nullspace, pivots, pivot, &r->options);
    nh_nullspace_free(nullspace);
    nh_sectors_clear(&sectors);
}

/* Where several parameters need their values: is it enough that they are related? */
static void relate(nh_stage_solver *x, const nh_solved *s, nh_candidate *c, nh_ex pivot, bool certain)
{
    nh_analysis *r = x->r;
    const nh_proof *proof = &r->found[r->count - 1].proof;
    size_t values = 0;
    for (size_t i = 0; i < r->model->system->parameters && proof->fixed; i++)
        values += nh_fixed_has(r->model, proof->fixed, i);
    if (values < 2) return;
    c->by_values = false;
    c->pivot = 0;
    c->term[0] = pivot;
    nh_currents_add_again(x->bench, c, s->fit, certain);
}

/* A current that holds at the given values of the parameters only, while another one holds for all: the latter is
 * taken.  False: there is none. */
static bool exchange(nh_stage_solver *x, const nh_solved *s, size_t pivots, const nh_ex *pivot, nh_ex own,
                     nh_other_values *other)
{
    const nh_analysis *r = x->r;
    const nh_proof *proof = &r->found[r->count - 1].proof;
    bool exchanged = true;
    if (!proof->proved || proof->all_parameters || r->model->system->parameters == 0) return true;
    if (!other->tried) solve_elsewhere(x, s, pivots, pivot, other);
    nh_other_values_exchange(x->bench, other, own, &exchanged);
    return exchanged;
}

static nh_ex *pivots_of(const nh_candidates *list)
{
    nh_ex *pivot = nh_alloc_array(list->count + 1, sizeof *pivot);
    for (size_t k = 0; k < list->count; k++) pivot[k] = list->candidate[k].term[list->candidate[k].pivot];
    return pivot;
}

/* Certificates of vectors that are only likely cost much and mostly fail: the limit of work ends them too, and the
 * question stays open. */
static size_t add_new(nh_stage_solver *x, nh_candidates *list, const nh_solved *s, bool certain)
{
    nh_analysis *r = x->r;
    size_t before = r->independent, pivots = list->count;
    nh_ex *pivot = pivots_of(list);
    nh_other_values other = {0};
    nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
    compare(x, list, kind);
    for (size_t k = 0; k < list->count && r->independent < r->local_maximum; k++) {
        nh_candidate *c = &list->candidate[k];
        if (!certain && nh_stage_solver_done(x)) {
            r->open += kind[k] == NH_INDEPENDENT;
            continue;
        }
        c->by_values = c->only_new = true;
        if (kind[k] == NH_INDEPENDENT && nh_currents_add(x->bench, c, s->fit, certain)) {
            if (!exchange(x, s, pivots, pivot, pivot[k], &other)) relate(x, s, c, pivot[k], certain);
        }
    }
    nh_currents_join(x->bench, s->fit);
    nh_free(kind);
    nh_free(pivot);
    nh_other_values_clear(&other);
    /* a series may seem independent of currents found after it */
    if (r->independent >= r->local_maximum) nh_currents_recount(x->bench);
    return r->independent > before ? r->independent - before : 0;
}

/* Turns the first `count` null vectors into the new currents in them. */
static size_t harvest(nh_stage_solver *x, const nh_solved *s, size_t count, bool certain)
{
    nh_candidates *list = nh_echelon(x->r->model, s->fit, s->ansatz, s->nullspace, count, &x->r->options);
    size_t found = add_new(x, list, s, certain);
    nh_candidates_free(list);
    return found;
}

void nh_stage_solver_stage(nh_stage_solver *x, const char *name, size_t families, const nh_family *family)
{
    nh_progress(name, nh_budget_part());
    nh_analysis *r = x->r;
    if (families == 0 || nh_counted_superfluous(&x->counted, families, family, false)) return;
    double start = nh_clock();
    nh_stage_record *note = nh_stage_solver_note(x, name);
    nh_solved s = nh_stage_solver_solve(x, families, family);
    note->skipped = !s.ansatz;
    note->limit = s.limit;
    note->columns = s.ansatz ? s.ansatz->columns : 0;
    note->sectors = s.sectors;
    if (s.nullspace) {
        note->dimension = s.nullspace->dimension;
        note->gap = s.nullspace->gap;
        r->samples = s.fit->count > r->samples ? s.fit->count : r->samples;
        r->beyond += nh_points_equations(s.fit) - s.fit->count;
        r->rejected += s.fit->tried - nh_points_equations(s.fit);
        note->found = harvest(x, &s, s.nullspace->dimension, true);
        if (s.nullspace->likely > s.nullspace->dimension) {
            /* rounding decides how many of them are certain, but not what they are */
            size_t open = r->open, refuted = x->bench->refuted, likely = s.nullspace->likely;
            note->found += harvest(x, &s, likely, false);
            note->undecided = r->open > open || likely > most_tested(r);
            refuted = x->bench->refuted - refuted;
            if (!note->undecided && refuted < likely - note->dimension) note->dimension = likely - refuted;
        }
        keep_spectrum(x, s.nullspace, note->found > 0);
    }
    note->seconds = nh_clock() - start;
    nh_solved_clear(&s);
}

/* With all coefficients, as a candidate. */
static nh_candidate *candidate_of(nh_stage_solver *x, size_t n, const nh_ex *term, const nh_num *coefficient)
{
    nh_arena *arena = x->r->arena;
    nh_candidate *c = nh_arena_alloc(arena, sizeof *c);
    *c = (nh_candidate){.count = n, .refitted = true, .all = n};
    c->term = nh_arena_alloc(arena, n * sizeof *c->term);
    c->all_term = nh_arena_alloc(arena, n * sizeof *c->term);
    c->coefficient = nh_arena_alloc(arena, n * sizeof *c->coefficient);
    c->all_coefficient = nh_arena_alloc(arena, n * sizeof *c->coefficient);
    c->all_size = nh_arena_alloc(arena, n * sizeof *c->all_size);
    for (size_t j = 0; j < n; j++) {
        c->term[j] = c->all_term[j] = term[j];
        c->coefficient[j] = c->all_coefficient[j] = nh_num_value(coefficient[j]);
        c->all_size[j] = 1;
    }
    return c;
}

size_t nh_stage_solver_certify(nh_stage_solver *x, nh_ex e, const char *name)
{
    nh_analysis *r = x->r;
    nh_num one = nh_num_int(1);
    if (nh_kind_of(r->model->dag, e) == NH_NUMBER || nh_currents_known(x->bench, e, true)) return 0;
    if (nh_prove_digits(r->model, e, &r->options) < r->options.digits) return 0;
    nh_stage_record *note = nh_stage_solver_note(x, name);
    note->columns = 1;
    note->sectors = 1;
    note->found = nh_currents_add(x->bench, candidate_of(x, 1, &e, &one), x->ranges, false);
    note->dimension = note->found;
    return note->found;
}

void nh_stage_solver_certify_each(nh_stage_solver *x, size_t n, const nh_ex *e, const char *name)
{
    nh_analysis *r = x->r;
    nh_num one = nh_num_int(1);
    nh_progress(name, nh_budget_part());
    double start = nh_clock();
    nh_candidates list = {.count = n, .candidate = nh_alloc_array(n + 1, sizeof *list.candidate)};
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    for (size_t k = 0; k < n; k++) list.candidate[k] = *candidate_of(x, 1, &e[k], &one);
    compare(x, &list, kind);
    nh_stage_record note = {.name = nh_arena_strdup(r->arena, name), .columns = n, .sectors = n, .dimension = n};
    for (size_t k = 0; k < list.count && !nh_stage_solver_done(x); k++) {
        bool added = kind[k] == NH_INDEPENDENT && nh_currents_add(x->bench, &list.candidate[k], x->ranges, false);
        note.found += added;
    }
    note.seconds = nh_clock() - start;
    *nh_stage_solver_note(x, name) = note;
    nh_free(kind);
    nh_free(list.candidate);
}

/* ---- integrals ---- */

static int sign_of(void *context, nh_ex e) { return nh_model_sign(context, e); }

bool nh_stage_solver_integral(const nh_stage_solver *x, nh_ex variable, nh_ex f, bool elliptic, nh_ex *F)
{
    nh_model *o = x->r->model;
    nh_integration in = {.dag = o->dag,
                         .x = variable,
                         .constants = o->system->parameters,
                         .constant = o->parameter,
                         .max_terms = (size_t)x->r->options.proof_terms,
                         .elliptic = elliptic,
                         .sign = sign_of,
                         .context = o};
    return nh_antiderivative(&in, f, F);
}
