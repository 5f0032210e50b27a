/* benchmark_fit: the discrete problem.  The null space of the sampled equations for the polynomials of degree 1, 2, 3,
 * ... in the chart's velocities, in the sines and cosines of the angles and in the other coordinates on which the
 * equations of motion depend, over
 *
 *     samples x columns x basis (monomials, Chebyshev) x route (current, symmetry) x solver (generalized, plain SVD):
 *
 * time, gap, dimension, and how far the known currents are from the space that was found, at points that the fit has
 * not seen. */
#include <float.h>
#include <math.h>
#include <string.h>

#include "base/clock.h"
#include "base/progress.h"
#include "integrals/echelon.h"
#include "integrals/rows.h"
#include "commands/benchmark_fit.h"
#include "commands/benchmark_internal.h"
#include "graph/function.h"
#include "graph/node.h"
#include "search/grid.h"
#include "search/spans.h"

enum {
    most_levels = 6,
    densities = 5,
    usual_first = 1,
    usual_end = 4,
    ways = 8,
    heldout_points = 400,
    most_field_columns = 400,
    most_repeats = 5
};
enum { other_grids = 3 };
static const nh_grid_kind other_grid[other_grids] = {NH_GRID_HALTON, NH_GRID_TENSOR, NH_GRID_SPARSE};
/* sample points per column: all of them where the discrete problem alone is asked for */
static const double density[densities] = {1.1, 1.5, 4, 10, 25};
static const double in_span = 1e-10; /* distance of a known current from all columns, at rounding */
static const double enough_seconds = 0.02;

typedef struct {
    nh_benchmark_work *c;
    nh_model *model;
    nh_options options;
    const nh_grid *grid;
    nh_points *ranges, *heldout;
    nh_ansatz *cheb, *raw;
    size_t known;  /* known currents in the span of the ansatz */
    double *value; /* their values at the held-out points, heldout x known */
    double deadline;
    size_t degree, first, end; /* those of the densities that are tried */
    size_t wanted[2];          /* dimension by route: the columns of the symmetry route span more */
} fit;

/* ---- one ansatz, in two bases ---- */

/* The printed terms, one column for each: monomials, without scaling. */
static nh_ansatz *raw_ansatz(fit *f, nh_error *error)
{
    nh_family terms = {.kind = NH_TERMS, .terms = f->cheb->terms, .term = f->cheb->term};
    return nh_ansatz_create(f->model, f->ranges, 1, &terms, (size_t)f->options.columns, error);
}

static void columns_of(const nh_ansatz *a, nh_ex *out)
{
    for (size_t j = 0; j < a->columns; j++) out[j] = nh_ansatz_column(a, j);
}

/* Which of the known currents are combinations of the columns. */
static void find_known(fit *f)
{
    const nh_reference_solution *y = &f->c->solution;
    size_t n = f->cheb->columns, rows = f->heldout->count;
    nh_ex *e = nh_alloc_array(n + 1, sizeof *e);
    double *one = nh_alloc_array(n * n + 1, sizeof *one), unit = 1;
    columns_of(f->cheb, e);
    for (size_t j = 0; j < n; j++) one[j + j * n] = 1;
    double *all = nh_span_values(f->model, f->heldout, n, e, n, one);
    f->value = nh_alloc_array(rows * (y->currents + 1), sizeof *f->value);
    f->known = 0;
    for (size_t k = 0; k < y->currents && n < rows; k++) {
        double *phi = nh_span_values(f->model, f->heldout, 1, &y->current[k], 1, &unit);
        if (nh_span_distance(rows, n, all, 1, phi) < in_span)
            memcpy(f->value + rows * f->known++, phi, rows * sizeof *phi);
        nh_free(phi);
    }
    nh_free(all);
    nh_free(one);
    nh_free(e);
}

/* ---- one method ---- */

typedef struct {
    nh_nullspace *space;
    size_t columns;
    nh_ex *e; /* the current of each column */
    double seconds;
} solved;

static bool assemble_and_solve(fit *f, const nh_ansatz *a, const nh_points *points, bool symmetry, bool plain,
                               solved *s)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_nullspace_options limits = nh_nullspace_options_from(&f->options);
    nh_field_column *column = NULL;
    s->e = nh_alloc_array(a->columns + 1, sizeof *s->e);
    columns_of(a, s->e);
    s->columns = a->columns;
    if (symmetry) {
        s->columns = a->columns * (f->model->n + 1) <= most_field_columns
                         ? nh_rows_field_columns(f->model, a->columns, s->e, &column)
                         : 0;
        if (!s->columns || points->count * (f->model->n + 1) < s->columns + 16) return false;
    }
    double begin = nh_clock_of_process();
    nh_equations *equations = nh_equations_create(s->columns, 1);
    if (symmetry) {
        nh_rows_symmetry(f->model, s->columns, column, points, equations);
    } else {
        nh_rows *rows = nh_rows_create(f->model, a, 0, NULL);
        nh_rows_current(rows, points, NULL, equations);
        nh_rows_free(rows);
    }
    s->space =
        plain ? nh_nullspace_plain(equations, &limits, &ignored) : nh_nullspace_solve(equations, &limits, &ignored);
    s->seconds = nh_clock_of_process() - begin;
    nh_equations_free(equations);
    if (symmetry) {
        nh_free(s->e);
        s->e = nh_alloc_array(s->columns + 1, sizeof *s->e);
        for (size_t j = 0; j < s->columns; j++) s->e[j] = nh_rows_field_current(f->model, &column[j]);
    }
    return s->space != NULL;
}

static void judge(fit *f, const solved *s, nh_fitted *out)
{
    const nh_nullspace *n = s->space;
    out->columns = n->columns;
    out->rank = n->rank;
    out->dimension = n->dimension;
    out->gap = n->gap;
    if (n->dimension && n->dimension < n->rank)
        out->expected = DBL_EPSILON * n->next_left_scale / n->spectrum[n->dimension];
    out->undecided = n->verdict == NH_UNDECIDED;
    double *found = nh_span_values(f->model, f->heldout, s->columns, s->e, n->dimension, n->vector);
    out->error = f->known ? nh_span_distance(f->heldout->count, n->dimension, found, f->known, f->value) : NAN;
    nh_free(found);
}

static void measure(fit *f, size_t points_wanted, bool chebyshev, bool symmetry, bool plain, nh_fitted *out)
{
    const nh_ansatz *a = chebyshev ? f->cheb : f->raw;
    nh_error ignored;
    nh_error_clear(&ignored);
    uint64_t seed = (uint64_t)f->options.seed;
    nh_points *points = f->grid->kind == NH_GRID_SOBOL
                            ? nh_points_create(f->model, points_wanted, 1, seed, &ignored)
                            : nh_grid_points(f->model, &f->options, f->grid, points_wanted, seed, &ignored);
    double begin = nh_clock();
    *out = (nh_fitted){.degree = f->degree,
                       .functions = a->columns,
                       .samples = points ? points->count : points_wanted,
                       .grid = nh_sample_grid_word(f->grid->kind),
                       .basis = chebyshev ? "Chebyshev" : "monomials",
                       .route = symmetry ? "symmetry" : "current",
                       .solver = plain ? "plain SVD" : "generalized",
                       .error = NAN,
                       .expected = NAN};
    double time[most_repeats];
    for (int i = 0; points && i < most_repeats && !nh_interrupted() && (i == 0 || nh_clock() - begin < enough_seconds);
         i++) {
        solved s = {0};
        bool good = assemble_and_solve(f, a, points, symmetry, plain, &s);
        if (good && i == 0) judge(f, &s, out);
        if (good) time[out->repeats++] = s.seconds;
        out->good |= good;
        nh_free(s.e);
        nh_nullspace_free(s.space);
        if (!good) break;
    }
    nh_points_free(points);
    nh_judge_spread s = nh_judge_spread_of(out->repeats, time);
    out->seconds = s.median, out->seconds_low = s.low, out->seconds_high = s.high;
}

/* ---- all of it ---- */

/* The most careful method of each route gives the dimension: Chebyshev polynomials, generalized, most points. */
static bool past(const fit *f) { return nh_interrupted() || nh_clock() >= f->deadline; }

/* One solution, kept where it is good; `careful`: it decides which dimension the route wants. */
static void keep(fit *f, size_t points, int way, bool careful, bool known[2])
{
    nh_benchmark *out = f->c->out;
    nh_fitted *m = &out->fit[out->fits];
    bool symmetry = way & 4;
    measure(f, points, !(way & 1), symmetry, way & 2, m);
    if (!m->good) return;
    out->fits++;
    if (careful) f->wanted[symmetry] = m->dimension, known[symmetry] = true;
    m->wanted = f->wanted[symmetry];
    m->right = known[symmetry] && !m->undecided && m->dimension == m->wanted && !(m->error > f->options.agreement);
}

/* The other grids, by the most careful method of each route. */
static void on_other_grids(fit *f, size_t points, bool known[2])
{
    const nh_grid *own = f->grid;
    for (size_t g = 0; g < other_grids; g++)
        for (int way = 0; way < ways && !past(f); way += 4) {
            nh_grid other = {.kind = other_grid[g]};
            f->grid = &other;
            if (way == 0 || known[1]) keep(f, points, way, false, known);
        }
    f->grid = own;
}

static void measure_level(fit *f)
{
    nh_benchmark *out = f->c->out;
    size_t n = f->cheb->columns;
    bool known[2] = {false, false};
    for (size_t d = f->end; d-- > f->first;) {
        size_t points = (size_t)ceil(density[d] * (double)n) + 16;
        for (int way = 0; way < ways && !past(f); way++) {
            if ((way & 4) && d + 1 < f->end && !known[1]) continue; /* too large for this route */
            keep(f, points, way, d + 1 == f->end && !(way & 3), known);
        }
        if (f->c->every_grid) on_other_grids(f, points, known);
    }
    out->fits_partial |= past(f);
}

static void mark_front(nh_benchmark *out)
{
    for (size_t i = 0; i < out->fits; i++) {
        nh_fitted *m = &out->fit[i];
        m->front = m->right && isfinite(m->error);
        for (size_t j = 0; j < out->fits && m->front; j++) {
            const nh_fitted *o = &out->fit[j];
            if (o->functions == m->functions && o->right && o->seconds <= m->seconds && o->error <= m->error &&
                (o->seconds < m->seconds || o->error < m->error))
                m->front = false;
        }
    }
}

bool nh_fit_is_wave(const nh_model *model, nh_ex q)
{
    NH_LIST(call);
    for (size_t i = 0; i < model->m + model->n; i++) {
        size_t n = nh_functions_in(model->dag, i < model->m ? model->rho[i] : model->a[i - model->m], &call);
        for (size_t k = 0; k < n; k++) {
            nh_function f = nh_function_of(model->dag, call[k]);
            if ((f == NH_SIN || f == NH_COS || f == NH_TAN) && nh_depends(model->dag, call[k], q)) return true;
        }
    }
    return false;
}

size_t nh_fit_letters(const nh_model *model, nh_ex *out)
{
    size_t n = 0;
    for (size_t i = 0; i < model->n; i++) out[n++] = model->chart->w[i];
    for (size_t s = 0; s < model->m; s++) {
        nh_ex q = model->system->coordinate[s].q;
        bool occurs = false;
        for (size_t i = 0; i < model->m + model->n && !occurs; i++)
            occurs = nh_depends(model->dag, i < model->m ? model->rho[i] : model->a[i - model->m], q);
        if (!occurs) continue;
        bool wave = nh_fit_is_wave(model, q);
        if (wave) out[n++] = nh_call(model->dag, NH_SIN, q);
        out[n++] = wave ? nh_call(model->dag, NH_COS, q) : q;
    }
    return n;
}

/* Polynomials of this degree; false when there are too many. */
static bool measure_degree(fit *f, size_t letters, const nh_ex *letter, size_t degree)
{
    nh_family family = {.kind = NH_POLYNOMIAL, .in = letter, .in_count = letters, .degree = degree};
    nh_error ignored;
    nh_error_clear(&ignored);
    f->cheb = nh_ansatz_create(f->model, f->ranges, 1, &family, (size_t)f->options.benchmark_columns, &ignored);
    f->raw = f->cheb ? raw_ansatz(f, &ignored) : NULL;
    bool good = f->raw != NULL;
    if (good) {
        find_known(f);
        measure_level(f);
        nh_free(f->value);
    }
    nh_ansatz_free(f->raw);
    nh_ansatz_free(f->cheb);
    return good;
}

void nh_benchmark_fit(nh_benchmark_work *c, const nh_grid *grid, double seconds)
{
    nh_benchmark *out = c->out;
    nh_error ignored;
    nh_error_clear(&ignored);
    fit f = {
        .c = c, .model = out->question->model, .options = c->options, .grid = grid, .deadline = nh_clock() + seconds};
    uint64_t seed = (uint64_t)f.options.seed;
    f.first = c->fit_alone ? 0 : usual_first;
    f.end = c->fit_alone ? densities : usual_end;
    nh_ex *letter = nh_alloc_array(3 * f.model->m + 1, sizeof *letter);
    size_t letters = nh_fit_letters(f.model, letter);
    out->fit = nh_arena_alloc(out->arena, (most_levels * densities * (ways + 2 * other_grids) + 1) * sizeof *out->fit);
    f.ranges = nh_points_create(f.model, heldout_points, 1, seed, &ignored);
    f.heldout = nh_points_create(f.model, 2 * (size_t)f.options.benchmark_columns, 1, seed + 77, &ignored);
    for (size_t degree = 1; f.ranges && f.heldout && degree <= most_levels && !past(&f); degree++)
        if (f.degree = degree, !measure_degree(&f, letters, letter, degree)) break;
    mark_front(out);
    nh_points_free(f.ranges);
    nh_points_free(f.heldout);
    nh_free(letter);
}
