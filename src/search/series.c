/* The staged search for coefficient functions without closed form: integrals/function_series.h, for the words and the
 * variables that make sense. */
#include <float.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/clock.h"
#include "graph/dag.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/print.h"
#include "integrals/function_series.h"
#include "integrals/named_coefficients.h"
#include "search/stage_solver.h"

enum { most_words = 32, near_points = 24 };

typedef struct {
    nh_stage_solver *x;
    nh_ex variable;
    size_t words;
    nh_ex word[most_words];
    bool full;            /* more series were found than there is room for */
    const char *equation; /* the equation of coefficients without a name, or NULL */
} problem;

static void put(problem *p, nh_ex e)
{
    for (size_t i = 0; i < p->words; i++)
        if (p->word[i] == e) return;
    if (p->words == most_words) p->full = true;
    else p->word[p->words++] = e;
}

static void put_all(problem *p, size_t n, const nh_ex *e)
{
    for (size_t i = 0; i < n; i++) put(p, e[i]);
}

static void put_squares(problem *p, size_t n, const nh_ex *e)
{
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j <= i; j++) put(p, nh_mul(p->x->r->question->model->dag, e[i], e[j]));
}

/* ---- from functions to currents ---- */

/* A dependent velocity stands for itself. */
static nh_ex shown(const nh_model *model, nh_ex word)
{
    for (size_t s = 0; s < model->m; s++)
        if (word == model->rho[s]) return model->system->coordinate[s].v;
    return word;
}

/* The current as doubles can use it: without coefficients of the series below rounding. */
static nh_ex expression_of(const problem *p, const nh_series_space *space, size_t k, nh_series *series)
{
    nh_dag *d = p->x->r->question->model->dag;
    size_t rows = space->degree + 1;
    const double *c = space->coefficient + k * space->words * rows;
    double largest = 0;
    nh_ex *T = nh_alloc_array(rows, sizeof *T), phi = nh_int(d, 0);
    nh_series_polynomials(d, p->variable, space->low, space->high, space->degree, T);
    for (size_t j = 0; j < space->words * rows; j++) largest = fmax(largest, fabs(c[j]) * space->size[j / rows]);
    for (size_t i = 0; i < space->words; i++) {
        nh_ex f = nh_int(d, 0);
        for (size_t j = 0; j < rows; j++) {
            if (fabs(c[i * rows + j]) * space->size[i] < DBL_EPSILON / 2 * largest) continue;
            if (j > series->degree) series->degree = j;
            f = nh_add(d, f, nh_mul(d, nh_real(d, c[i * rows + j]), T[j]));
        }
        if (nh_is_zero(d, f)) continue;
        memcpy(series->coefficient + series->words * rows, c + i * rows, rows * sizeof *c);
        series->word[series->words++] = shown(p->x->r->question->model, space->word[i]);
        phi = nh_add(d, phi, nh_mul(d, space->word[i], f));
    }
    nh_free(T);
    return phi;
}

/* "x at t = 0" */
static const char *meaning_of(const problem *p, const nh_series_space *space, size_t k)
{
    nh_analysis *r = p->x->r;
    if (space->alone[k] == space->words) return "";
    char *word = nh_print_string(r->question->model->dag, space->word[space->alone[k]]);
    const char *text =
        nh_arena_printf(r->arena, "%s at %s = %.6g", word, nh_name_of(r->question->model->dag, p->variable), space->at);
    nh_free(word);
    return text;
}

/* Adds the solutions as currents, and returns how many were new. */
static size_t keep(problem *p, const nh_series_space *space)
{
    nh_analysis *result = p->x->r;
    size_t n = space->words * (space->degree + 1), added = 0;
    for (size_t k = 0; k < space->count && result->list->independent < result->question->local_maximum; k++) {
        nh_series *series = nh_arena_alloc(result->arena, sizeof *series);
        *series = (nh_series){.variable = p->variable,
                              .low = space->low,
                              .high = space->high,
                              .word = nh_arena_alloc(result->arena, space->words * sizeof(nh_ex)),
                              .coefficient = nh_arena_alloc(result->arena, n * sizeof(double)),
                              .stride = space->degree + 1,
                              .equation = p->equation};
        const char *meaning = p->variable == result->question->system->t ? meaning_of(p, space, k) : NULL;
        added +=
            nh_currents_add_series(p->x->bench, expression_of(p, space, k, series), series, space->digits[k], meaning);
    }
    return added;
}

/* Does it contain a current that is not known?  This is tested near the middle of the interval, because continuing the
 * functions costs much. */
static bool fresh(const problem *p, const nh_series_search *s)
{
    const nh_analysis *result = p->x->r;
    nh_points *points = nh_series_points(s, near_points);
    if (!points) return true;
    size_t known = result->list->count, n = known + nh_series_count(s);
    nh_ex *phi = nh_alloc_array(n + 1, sizeof *phi);
    nh_independence *kind = nh_alloc_array(n + 1, sizeof *kind);
    bool news = false;
    for (size_t k = 0; k < n; k++) phi[k] = k < known ? result->list->found[k].phi : nh_series_near(s, k - known);
    nh_independence_test(result->question->model, points, n, phi, NULL, result->question->options.sure,
                         result->question->options.doubt, kind, NULL);
    for (size_t k = known; k < n; k++) news |= kind[k] == NH_INDEPENDENT || kind[k] == NH_DOUBTFUL;
    nh_free(kind);
    nh_free(phi);
    nh_points_free(points);
    return news;
}

/* Without an interval from the user a series in t extends to the end of the motions. */
static double end_of_time(const nh_stage_solver *solver)
{
    const nh_system *system = solver->r->question->system;
    for (size_t i = 0; i < system->intervals; i++)
        if (system->interval[i].symbol == system->t) return -INFINITY;
    return solver->r->question->options.until;
}

/* Coefficients that have names, proved before the series are tried: by equations of second, then of third order. */
static void named(problem *p, const char *what)
{
    nh_analysis *result = p->x->r;
    nh_ex *phi = nh_arena_alloc(result->arena, NH_MOST_NAMED * sizeof *phi);
    nh_family *family = nh_arena_alloc(result->arena, sizeof *family);
    nh_family words = {.kind = NH_TERMS, .terms = p->words, .term = p->word};
    p->equation = NULL;
    if (p->full || result->question->options.named == 0 || nh_stage_solver_done(p->x)) return;
    if (nh_counted_superfluous(&p->x->counted, 1, &words, p->variable == result->question->system->t)) return;
    size_t n = nh_named_coefficients(result->question->model, p->variable, p->words, p->word, p->x->words.forms,
                                     p->x->words.form, result->arena, phi, &p->equation);
    if (!n) return;
    *family = (nh_family){.kind = NH_TERMS, .terms = n, .term = phi};
    const char *name = nh_arena_printf(result->arena, "%s with coefficients that are named functions of %s", what,
                                       nh_name_of(result->question->model->dag, p->variable));
    nh_stage_solver_stage(p->x, name, 1, family);
    /* in doubles a function that grows by many powers of ten hides behind one that does not */
    for (size_t k = 0; k < n && !nh_stage_solver_done(p->x); k++) nh_stage_solver_certify(p->x, phi[k], name);
}

static void series(problem *p, const char *what)
{
    nh_analysis *result = p->x->r;
    nh_model *model = result->question->model;
    char name[120];
    double start = nh_clock();
    nh_series_space space;
    nh_family words = {.kind = NH_TERMS, .terms = p->words, .term = p->word};
    if (!p->x->series || p->full || nh_stage_solver_done(p->x)) return;
    if (nh_declared_unspecified(model->dag)) return; /* a series would be that of its stand-in */
    if (nh_counted_superfluous(&p->x->counted, 1, &words, p->variable == result->question->system->t)) return;
    snprintf(name, sizeof name, "%s with coefficients that are series in %s", what,
             nh_name_of(model->dag, p->variable));
    nh_series_search *s = nh_series_open(model, p->variable, p->words, p->word, &result->question->options);
    bool news = nh_series_count(s) && fresh(p, s);
    nh_stage_record *note = nh_stage_solver_note(p->x, name);
    note->columns = nh_series_words(s);
    note->sectors = 1;
    note->dimension = nh_series_count(s);
    if (news) {
        bool reached = nh_series_extend(s, -INFINITY, result->arena, &space);
        /* to the end of the motions, if that is not too far */
        nh_series_space longer;
        double end = p->variable == result->question->system->t ? end_of_time(p->x) : -INFINITY;
        if (reached && end > space.high && nh_series_extend(s, end, result->arena, &longer)) space = longer;
        if (reached) note->found = keep(p, &space);
        else note->undecided = true;
    }
    nh_series_close(s);
    note->seconds = nh_clock() - start;
}

/* Closed forms should be found first: the same words with harmonics of q and the system's functions. */
static void closed_forms(problem *p)
{
    nh_stage_solver *solver = p->x;
    nh_dag *d = solver->r->question->model->dag;
    nh_ex *f = nh_arena_alloc(solver->r->arena, (6 + solver->words.atoms) * sizeof *f),
          *word = nh_arena_alloc(solver->r->arena, (p->words + 1) * sizeof *word);
    size_t n = 0;
    f[n++] = nh_int(d, 1);
    if (!solver->words.waves) f[n++] = p->variable;
    for (int k = 1; k <= 2 && solver->words.waves; k++) {
        nh_ex angle = nh_mul(d, nh_int(d, k), p->variable);
        f[n++] = nh_call(d, NH_COS, angle);
        f[n++] = nh_call(d, NH_SIN, angle);
    }
    for (size_t i = 0; i < solver->words.atoms; i++) f[n++] = solver->words.atom[i];
    memcpy(word, p->word, p->words * sizeof *word);
    nh_family *part = nh_arena_alloc(solver->r->arena, 2 * sizeof *part),
              *both = nh_arena_alloc(solver->r->arena, sizeof *both);
    part[0] = (nh_family){.kind = NH_TERMS, .terms = p->words, .term = word};
    part[1] = (nh_family){.kind = NH_TERMS, .terms = n, .term = f};
    both[0] = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = 2, .part = part};
    nh_stage_solver_stage(solver, "squares of velocities times harmonics and functions of the shape", 1, both);
}

/* Velocities with functions of one coordinate, whatever the chart: one that needs other coordinates too may have been
 * chosen. */
static void linear_in(nh_stage_solver *solver, nh_ex q)
{
    const nh_model *model = solver->r->question->model;
    problem p = {.x = solver, .variable = q};
    put_all(&p, model->n, model->chart->w);
    if (solver->words.shapes > 1) put_all(&p, model->m, model->rho);
    /* with friction, currents have terms that depend on position alone */
    if (model->system->has_forces) put(&p, nh_int(model->dag, 1));
    named(&p, "velocities");
    series(&p, "velocities");
}

/* Functions of one coordinate q make sense where the equations of motion depend on no other: then 1, w and w w are
 * closed under Gamma.  A power series continued past a kink or a
 * jump of the equations of motion is no current behind it. */
static void in_one(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    if (solver->words.shapes != 1 || model->chart->implicit || nh_counted_has_walls(model)) return;
    linear_in(solver, solver->words.shape[0]);
    problem p = {.x = solver, .variable = solver->words.shape[0]};
    put(&p, nh_int(model->dag, 1));
    put_squares(&p, model->n, model->chart->w);
    if (p.full || nh_stage_solver_done(solver)) return;
    closed_forms(&p);
    named(&p, "squares of velocities");
    series(&p, "squares of velocities");
}

/* Velocities with functions of one coordinate q, and the others times a linear current: where dx/dt = c f(q) dq/dt with
 * constants c and c' = g(q) dq/dt, x c' - c F(q) is constant.  Only where the count misses linear integrals. */
static void of_positions(nh_stage_solver *solver)
{
    const nh_completeness *count = &solver->r->completeness[NH_COMPLETE_IN_COORDINATES];
    if (!count->counted || count->missing_at != 1 || !count->missing) return;
    enum { most_currents = 2 };
    const nh_analysis *result = solver->r;
    const nh_current_list *list = result->list;
    const nh_model *model = result->question->model;
    nh_ex q = solver->words.shapes == 1 ? solver->words.shape[0] : 0;
    problem p = {.x = solver, .variable = q};
    size_t currents = 0;
    if (solver->words.shapes != 1 || model->chart->implicit || nh_counted_has_walls(model) ||
        nh_stage_solver_done(solver))
        return;
    put_all(&p, model->n, model->chart->w);
    for (size_t k = 0; k < list->count && currents < most_currents; k++) {
        nh_ex c = list->found[k].phi;
        bool linear = list->found[k].proof.proved && !nh_depends(model->dag, c, model->system->t) &&
                      nh_counted_degree_of(model, c) == 1;
        for (size_t s = 0; s < model->m; s++) {
            nh_ex position = model->system->coordinate[s].q;
            linear = linear && (position == q || !nh_depends(model->dag, c, position));
        }
        currents += linear;
        for (size_t s = 0; s < model->m && linear; s++)
            if (model->system->coordinate[s].q != q) put(&p, nh_mul(model->dag, model->system->coordinate[s].q, c));
    }
    if (currents) series(&p, "velocities, and positions times currents,");
}

/* Velocities and positions times the rate of q: Killing fields of plane waves are translations with functions of the
   wave's phase. */
static void affine_in(nh_stage_solver *solver, nh_ex q)
{
    const nh_model *model = solver->r->question->model;
    problem p = {.x = solver, .variable = q};
    put_all(&p, model->n, model->chart->w);
    put_all(&p, solver->words.positions, solver->words.position);
    named(&p, "velocities and their products with positions");
}

static void in_each(nh_stage_solver *solver)
{
    enum { most_shapes = 3 };
    if (solver->words.shapes < 2 || solver->words.shapes > most_shapes || solver->r->question->model->chart->implicit ||
        nh_counted_has_walls(solver->r->question->model))
        return;
    for (size_t i = 0; i < solver->words.shapes; i++) linear_in(solver, solver->words.shape[i]);
    for (size_t i = 0; i < solver->words.shapes; i++) affine_in(solver, solver->words.shape[i]);
}

/* Does the motion depend on t otherwise than through its state? */
static bool driven(const nh_model *model)
{
    bool depends = false;
    for (size_t i = 0; i < model->n; i++) depends |= nh_depends(model->dag, model->a[i], model->system->t);
    for (size_t s = 0; s < model->m; s++) depends |= nh_depends(model->dag, model->rho[s], model->system->t);
    return depends;
}

/* Components of vectors in polar coordinates: lengths, and the velocities in which the kinetic energy is a sum of
 * squares, times first harmonics. */
static void put_polar(problem *p)
{
    const nh_model *model = p->x->r->question->model;
    const nh_dictionary *w = &p->x->words;
    nh_dag *d = model->dag;
    p->words = 0;
    p->full = false;
    nh_ex *wave = nh_arena_alloc(p->x->r->arena, (3 * model->m + 1) * sizeof *wave);
    size_t waves = 0;
    for (size_t s = 0; s < model->m; s++) {
        if (model->system->coordinate[s].type != NH_ANGLE) continue;
        wave[waves++] = nh_call(d, NH_COS, model->system->coordinate[s].q);
        wave[waves++] = nh_call(d, NH_SIN, model->system->coordinate[s].q);
    }
    for (size_t i = 0; i < waves; i++) {
        for (size_t j = 0; j < w->lengths; j++) put(p, nh_mul(d, w->length[j], wave[i]));
        for (size_t j = 0; j < w->frames; j++) put(p, nh_mul(d, w->frame[j], wave[i]));
    }
}

/* Functions of t: where the equations are linear these give all currents. */
static void in_time(nh_stage_solver *solver)
{
    const nh_model *model = solver->r->question->model;
    nh_ex one = nh_int(model->dag, 1);
    if (nh_stage_solver_done(solver) || model->chart->implicit || !driven(model) || nh_counted_has_walls(model)) return;
    problem p = {.x = solver, .variable = model->system->t};
    put_all(&p, solver->words.positions, solver->words.position);
    put_all(&p, model->n, model->chart->w);
    put(&p, one);
    put_all(&p, solver->words.momenta, solver->words.momentum);
    p.full &= solver->words.positions + model->n >= most_words; /* momenta only as far as there is room */
    named(&p, "positions, velocities and momenta");
    series(&p, "positions, velocities and momenta");
    put_polar(&p);
    p.equation = NULL;
    if (p.words) series(&p, "lengths and the frame of the kinetic energy times first harmonics");
    p.words = 0;
    p.full = false;
    nh_ex *linear = nh_arena_alloc(solver->r->arena, (solver->words.positions + model->n + 1) * sizeof *linear);
    memcpy(linear, solver->words.position, solver->words.positions * sizeof *linear);
    memcpy(linear + solver->words.positions, model->chart->w, model->n * sizeof *linear);
    put_squares(&p, solver->words.positions + model->n, linear);
    put_all(&p, solver->words.positions + model->n, linear);
    put_all(&p, solver->words.potentials, solver->words.potential);
    put_all(&p, solver->words.atoms, solver->words.atom);
    put(&p, one);
    named(&p, "their squares and the system's functions");
    series(&p, "their squares and the system's functions");
}

static void all(nh_stage_solver *solver, bool series_too)
{
    solver->series = series_too;
    if (!nh_stage_solver_done(solver)) in_one(solver);
    in_time(solver);
    if (!nh_stage_solver_done(solver)) in_each(solver);
    if (series_too) of_positions(solver);
}

void nh_stage_solver_named(nh_stage_solver *solver) { all(solver, false); }

void nh_stage_solver_series(nh_stage_solver *solver) { all(solver, true); }
