/* stage_solver: one stage from its families to new currents.
 *
 *     families
 *        |  nh_ansatz_create, nh_sectors_split       columns; too many: the stage is left out, and the note says why
 *        |  nh_points_cover, nh_sectors_solve        2.5 points per column of the largest part; null space
 *        v
 *     null vectors: certain ones, then likely ones
 *        |  nh_echelon                               readable candidates, simplest first
 *        |  compare                                  which are independent of the currents known?
 *        |  nh_currents_add                          exact coefficients, proof, region (currents.c)
 *        v
 *     new currents, and one nh_stage_record for the list of stages
 *
 * Work is counted before it is begun: a stage is solved completely or not at all. */
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
#include "search/current_list.h"
#include "search/grid.h"
#include "search/other_values.h"
#include "search/search.h"

enum { range_points = 256, range_points_each = 10, least_points = 256, least_tested = 60 };
static const double points_per_column = 2.5;

bool nh_stage_solver_begin(nh_stage_solver *solver, nh_analysis *result, nh_error *error)
{
    size_t points = range_points_each * result->question->model->m;
    *solver = (nh_stage_solver){.r = result, .counted.r = result};
    solver->ranges = nh_points_create(result->question->model, points > range_points ? points : range_points, 1,
                                      (uint64_t)result->question->options.seed, error);
    solver->bench = solver->ranges ? nh_current_checker_create(result, error) : NULL;
    if (!solver->bench) nh_stage_solver_end(solver);
    return solver->bench != NULL;
}

void nh_stage_solver_end(nh_stage_solver *solver)
{
    nh_current_checker_free(solver->bench);
    nh_reflections_free(solver->reflections);
    nh_points_free(solver->ranges);
    *solver = (nh_stage_solver){0};
}

/* ---- which candidates are new ---- */

/* The candidate with its fitted numbers. */
static nh_ex rough(const nh_model *model, const nh_candidate *c)
{
    nh_ex e = nh_int(model->dag, 0);
    for (size_t j = 0; j < c->count; j++)
        e = nh_add(model->dag, e, nh_mul(model->dag, nh_real(model->dag, c->coefficient[j]), c->term[j]));
    return e;
}

/* So many candidates are compared at most: no more can be independent. */
static size_t most_tested(const nh_analysis *result)
{
    return least_tested > result->question->local_maximum ? least_tested : result->question->local_maximum;
}

/* Compares gradients with those of the known currents; candidates come simplest first. kind[k] of candidate k; returns
 * how many are new. */
static size_t compare(nh_stage_solver *solver, nh_candidates *list, nh_independence *kind)
{
    nh_analysis *result = solver->r;
    size_t known = result->list->count, most = most_tested(result), n = list->count < most ? list->count : most,
           fresh = 0;
    nh_ex *phi = nh_alloc_array(known + n + 1, sizeof *phi);
    nh_independence *all = nh_alloc_array(known + n + 1, sizeof *all);
    bool *exact = nh_alloc_array(known + n + 1, sizeof *exact);
    nh_current_list_formulas(result->list, phi, exact);
    for (size_t k = 0; k < n; k++) {
        phi[known + k] = rough(result->question->model, &list->candidate[k]);
        exact[known + k] = list->candidate[k].count == 1;
    }
    nh_independence_test(result->question->model, solver->bench->generic, known + n, phi, exact,
                         result->question->options.sure, result->question->options.doubt, all, NULL);
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

bool nh_stage_solver_done(const nh_stage_solver *solver)
{
    return solver->r->list->independent >= solver->r->question->local_maximum || nh_budget_spent() || nh_late();
}

/* ---- one stage ---- */

nh_stage_record *nh_stage_solver_note(nh_stage_solver *solver, const char *name)
{
    nh_analysis *result = solver->r;
    if (result->stages == result->stage_capacity) { /* no note is being written while the next one is made */
        nh_stage_record *old = result->stage;
        result->stage_capacity = 2 * result->stage_capacity + 64;
        result->stage = nh_arena_alloc(result->arena, result->stage_capacity * sizeof *result->stage);
        if (result->stages) memcpy(result->stage, old, result->stages * sizeof *old);
    }
    result->stage[result->stages] = (nh_stage_record){.name = nh_arena_strdup(result->arena, name)};
    return &result->stage[result->stages++];
}

/* The spectra that are reported: of the last stage that found something, else of the largest; of fields the first. */
static void keep_spectrum(nh_stage_solver *solver, const nh_nullspace *s, bool found)
{
    nh_analysis *r = solver->r;
    bool alone = r->current.columns < 3 && s->columns >= 3; /* the energy alone: one value shows no gap */
    if (solver->fields) {
        if (!r->symmetry.done || found) r->symmetry = nh_spectrum_of(r->arena, s);
        return;
    }
    bool better = !r->current.done || found || alone || (r->list->count == 0 && s->columns > r->current.columns);
    if (better) r->current = nh_spectrum_of(r->arena, s);
}

/* Parts by reflections where there are many columns; else one part. */
static nh_sectors split(nh_stage_solver *solver, nh_ansatz *a)
{
    nh_analysis *result = solver->r;
    bool large = a->columns > (size_t)result->question->options.split_columns;
    nh_reflections none = {0};
    if (large && !solver->reflections)
        solver->reflections = nh_reflections_find(result->question->model, solver->ranges);
    return nh_sectors_split(result->question->model, large ? solver->reflections : &none, solver->ranges, a);
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
static nh_limit limit_of(const nh_stage_solver *solver, const nh_sectors *sectors, size_t points)
{
    static const double room = 1.2;
    const nh_options *options = &solver->r->question->options;
    double work = dense_work(sectors, points);
    if (!solver->wide && sectors->largest > (size_t)options->stage_columns)
        return (nh_limit){"stage_columns", (double)sectors->largest};
    if (!nh_budget_allows(NH_WORK_DENSE, work))
        return (nh_limit){"work", ceil(room * (nh_budget_used() + nh_work_millions(NH_WORK_DENSE, work)))};
    return (nh_limit){0};
}

/* The number of sample points of a stage. */
static size_t points_for(const nh_sectors *sectors)
{
    return (size_t)fmax(least_points, points_per_column * (double)sectors->largest);
}

typedef struct {
    const nh_options *options;
    const nh_model *model;
    const nh_ansatz *ansatz;
    const nh_sectors *sectors;
    const nh_field_bases *fields; /* NULL: of currents */
} in_sectors;

static nh_nullspace *solve_sectors(void *context, const nh_points *points, nh_error *error)
{
    const in_sectors *p = context;
    nh_nullspace_options limits = nh_nullspace_options_from(p->options);
    return nh_sectors_solve(p->model, p->ansatz, p->sectors, p->fields, points, &limits,
                            nh_threads(p->options->threads), error);
}

/* The number of columns is limited, in all and in the largest part. */
nh_solved nh_stage_solver_solve(nh_stage_solver *solver, size_t families, const nh_family *family)
{
    nh_analysis *r = solver->r;
    nh_model *model = r->question->model;
    const nh_options *options = &r->question->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_solved s = {.ansatz =
                       nh_ansatz_create(model, solver->ranges, families, family, (size_t)options->columns, &ignored)};
    if (!s.ansatz) {
        s.limit = (nh_limit){"columns", nh_ansatz_size(families, family)};
        return s;
    }
    nh_sectors sectors = split(solver, s.ansatz);
    size_t count = points_for(&sectors);
    s.sectors = sectors.count;
    s.limit = limit_of(solver, &sectors, count);
    if (s.limit.option) {
        nh_ansatz_free(s.ansatz);
        s.ansatz = NULL;
    } else if (sectors.count) {
        in_sectors p = {options, model, s.ansatz, &sectors, solver->fields};
        r->grid.needed = 0;
        uint64_t seed = (uint64_t)options->seed + r->stages;
        /* grid and samples of an analysis with an ansatz are those of the ansatz */
        if (r->question->analysis && r->question->analysis->families) {
            s.fit = nh_points_cover(model, count, seed, &ignored);
            s.nullspace = s.fit ? solve_sectors(&p, s.fit, &ignored) : NULL;
        } else {
            s.nullspace = nh_grid_solve(r, s.ansatz, sectors.largest, (size_t)options->samples, count, seed,
                                        solve_sectors, &p, &s.fit, &ignored);
        }
        if (!s.nullspace && r->grid.needed) {
            s.limit = (nh_limit){"samples", (double)r->grid.needed};
            nh_ansatz_free(s.ansatz);
            s.ansatz = NULL;
        }
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

size_t nh_stage_solver_news(nh_stage_solver *solver, size_t families, const nh_family *family, double *worst)
{
    if (nh_counted_superfluous(&solver->counted, families, family, false)) return 0;
    nh_solved s = nh_stage_solver_solve(solver, families, family);
    size_t fresh = 0;
    if (worst) *worst = s.nullspace && s.nullspace->likely ? s.nullspace->spectrum[s.nullspace->likely - 1] : 0;
    if (s.nullspace && s.nullspace->likely) {
        nh_candidates *list = nh_echelon(solver->r->question->model, s.fit, s.ansatz, s.nullspace, s.nullspace->likely,
                                         &solver->r->question->options);
        nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
        fresh = compare(solver, list, kind);
        nh_free(kind);
        nh_candidates_free(list);
    }
    nh_solved_clear(&s);
    return fresh;
}

bool nh_stage_solver_promising(nh_stage_solver *solver, size_t families, const nh_family *family)
{
    return nh_stage_solver_news(solver, families, family, NULL) > 0;
}

/* The null space of the stage where the parameters have other values. */
static void solve_elsewhere(nh_stage_solver *solver, const nh_solved *s, size_t pivots, const nh_ex *pivot,
                            nh_other_values *other)
{
    const nh_analysis *r = solver->r;
    const nh_options *options = &r->question->options;
    nh_error ignored;
    nh_error_clear(&ignored);
    if (!nh_other_values_begin(r->question->model, other)) return;
    nh_sectors sectors = split(solver, s->ansatz); /* in the order in which it is */
    size_t count = points_for(&sectors);
    nh_nullspace_options limits = nh_nullspace_options_from(options);
    nh_nullspace *nullspace = NULL;
    if (sectors.count && !limit_of(solver, &sectors, count).option)
        other->points = nh_points_create(&other->model, count, 1, (uint64_t)options->seed + r->stages, &ignored);
    if (other->points)
        nullspace = nh_sectors_solve(&other->model, s->ansatz, &sectors, NULL, other->points, &limits,
                                     nh_threads(options->threads), &ignored);
    if (nullspace) nh_other_values_take(other, s->ansatz, nullspace, pivots, pivot, options);
    nh_nullspace_free(nullspace);
    nh_sectors_clear(&sectors);
}

/* Where several parameters need their values: is it enough that they are related? */
static void relate(nh_stage_solver *solver, const nh_solved *s, nh_candidate *c, nh_ex pivot, bool certain)
{
    nh_analysis *r = solver->r;
    const nh_proof *proof = &r->list->found[r->list->count - 1].proof;
    size_t values = 0;
    for (size_t i = 0; i < r->question->model->system->parameters && proof->fixed; i++)
        values += nh_fixed_has(r->question->model, proof->fixed, i);
    if (values < 2) return;
    c->by_values = false;
    c->pivot = 0;
    c->term[0] = pivot;
    nh_currents_add_again(solver->bench, c, s->fit, certain);
}

/* A current that holds at the given values of the parameters only, while another one holds for all: the latter is
 * taken.  False: there is none. */
static bool exchange(nh_stage_solver *solver, const nh_solved *s, size_t pivots, const nh_ex *pivot, nh_ex own,
                     nh_other_values *other)
{
    const nh_analysis *r = solver->r;
    const nh_proof *proof = &r->list->found[r->list->count - 1].proof;
    if (!proof->proved || proof->all_parameters || r->question->model->system->parameters == 0) return true;
    if (!other->tried) solve_elsewhere(solver, s, pivots, pivot, other);
    return nh_other_values_exchange(solver->bench, other, own);
}

static nh_ex *pivots_of(const nh_candidates *list)
{
    nh_ex *pivot = nh_alloc_array(list->count + 1, sizeof *pivot);
    for (size_t k = 0; k < list->count; k++) pivot[k] = list->candidate[k].term[list->candidate[k].pivot];
    return pivot;
}

/* Certificates of vectors that are only likely cost much and mostly fail: the limit of work ends them too, and the
 * question stays open. */
static size_t add_new(nh_stage_solver *solver, nh_candidates *list, const nh_solved *s, bool certain)
{
    nh_analysis *r = solver->r;
    size_t before = r->list->independent, pivots = list->count;
    nh_ex *pivot = pivots_of(list);
    nh_other_values other = {0};
    nh_independence *kind = nh_alloc_array(list->count + 1, sizeof *kind);
    compare(solver, list, kind);
    for (size_t k = 0; k < list->count && r->list->independent < r->question->local_maximum; k++) {
        nh_candidate *c = &list->candidate[k];
        if (!certain && nh_stage_solver_done(solver)) {
            r->open += kind[k] == NH_INDEPENDENT;
            continue;
        }
        c->by_values = c->only_new = true;
        if (kind[k] == NH_INDEPENDENT && nh_currents_add(solver->bench, c, s->fit, certain)) {
            if (!exchange(solver, s, pivots, pivot, pivot[k], &other)) relate(solver, s, c, pivot[k], certain);
        }
    }
    nh_currents_join(solver->bench, s->fit);
    nh_free(kind);
    nh_free(pivot);
    nh_other_values_clear(&other);
    /* a series may seem independent of currents found after it */
    if (r->list->independent >= r->question->local_maximum) nh_currents_recount(solver->bench);
    return r->list->independent > before ? r->list->independent - before : 0;
}

/* Turns the first `count` null vectors into the new currents in them. */
static size_t harvest(nh_stage_solver *solver, const nh_solved *s, size_t count, bool certain)
{
    nh_candidates *list =
        nh_echelon(solver->r->question->model, s->fit, s->ansatz, s->nullspace, count, &solver->r->question->options);
    size_t found = add_new(solver, list, s, certain);
    nh_candidates_free(list);
    return found;
}

void nh_stage_solver_stage(nh_stage_solver *solver, const char *name, size_t families, const nh_family *family)
{
    nh_progress(name, nh_budget_part());
    nh_analysis *result = solver->r;
    if (families == 0 || nh_counted_superfluous(&solver->counted, families, family, false)) return;
    double start = nh_clock();
    nh_stage_record *note = nh_stage_solver_note(solver, name);
    nh_solved s = nh_stage_solver_solve(solver, families, family);
    note->skipped = !s.ansatz;
    note->limit = s.limit;
    note->columns = s.ansatz ? s.ansatz->columns : 0;
    note->sectors = s.sectors;
    if (s.nullspace) {
        note->dimension = s.nullspace->dimension;
        note->gap = s.nullspace->gap;
        result->samples = s.fit->count > result->samples ? s.fit->count : result->samples;
        result->beyond += nh_points_equations(s.fit) - s.fit->count;
        result->rejected += s.fit->tried - nh_points_equations(s.fit);
        note->found = harvest(solver, &s, s.nullspace->dimension, true);
        if (s.nullspace->likely > s.nullspace->dimension) {
            /* rounding decides how many of them are certain, but not what they are */
            size_t open = result->open, refuted = solver->bench->refuted, likely = s.nullspace->likely;
            note->found += harvest(solver, &s, likely, false);
            note->undecided = result->open > open || likely > most_tested(result);
            refuted = solver->bench->refuted - refuted;
            if (!note->undecided && refuted < likely - note->dimension) note->dimension = likely - refuted;
        }
        keep_spectrum(solver, s.nullspace, note->found > 0);
        if (solver->fields && s.nullspace->likely == s.nullspace->dimension)
            nh_agreement_keep(result, families, family, s.ansatz, s.nullspace, true);
    }
    note->seconds = nh_clock() - start;
    nh_solved_clear(&s);
}

/* With all coefficients, as a candidate. */
static nh_candidate *candidate_of(nh_stage_solver *solver, size_t n, const nh_ex *term, const nh_num *coefficient)
{
    nh_arena *arena = solver->r->arena;
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

size_t nh_stage_solver_certify(nh_stage_solver *solver, nh_ex e, const char *name)
{
    nh_analysis *r = solver->r;
    nh_num one = nh_num_int(1);
    if (nh_kind_of(r->question->model->dag, e) == NH_NUMBER || nh_currents_known(solver->bench, e, true)) return 0;
    if (nh_prove_digits(r->question->model, e, &r->question->options) < r->question->options.digits) return 0;
    nh_stage_record *note = nh_stage_solver_note(solver, name);
    note->columns = 1;
    note->sectors = 1;
    note->found = nh_currents_add(solver->bench, candidate_of(solver, 1, &e, &one), solver->ranges, false);
    note->dimension = note->found;
    return note->found;
}

void nh_stage_solver_certify_each(nh_stage_solver *solver, size_t n, const nh_ex *e, const char *name)
{
    nh_analysis *r = solver->r;
    nh_num one = nh_num_int(1);
    nh_progress(name, nh_budget_part());
    double start = nh_clock();
    nh_candidates list = {.count = n, .candidate = nh_alloc_array(n + 1, sizeof *list.candidate)};
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    for (size_t k = 0; k < n; k++) list.candidate[k] = *candidate_of(solver, 1, &e[k], &one);
    compare(solver, &list, kind);
    nh_stage_record note = {.name = nh_arena_strdup(r->arena, name), .columns = n, .sectors = n, .dimension = n};
    for (size_t k = 0; k < list.count && !nh_stage_solver_done(solver); k++) {
        bool added =
            kind[k] == NH_INDEPENDENT && nh_currents_add(solver->bench, &list.candidate[k], solver->ranges, false);
        note.found += added;
    }
    note.seconds = nh_clock() - start;
    *nh_stage_solver_note(solver, name) = note;
    nh_free(kind);
    nh_free(list.candidate);
}

/* ---- integrals ---- */

static int sign_of(void *context, nh_ex e) { return nh_model_sign(context, e); }

bool nh_stage_solver_integral(const nh_stage_solver *solver, nh_ex variable, nh_ex f, bool elliptic, nh_ex *F)
{
    nh_model *model = solver->r->question->model;
    nh_integration in = {.dag = model->dag,
                         .x = variable,
                         .constants = model->system->parameters,
                         .constant = model->parameter,
                         .max_terms = (size_t)solver->r->question->options.proof_terms,
                         .elliptic = elliptic,
                         .sign = sign_of,
                         .context = model};
    return nh_antiderivative(&in, f, F);
}
