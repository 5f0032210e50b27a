/* robustness_fit: the discrete problem where it is hardly determined.  Samples that crowd in a corner of the domain,
 * samples with noise, a column that nearly depends on others, and two frequencies that nearly coincide; by both routes
 * and by both solvers.
 *
 * The correct dimension is that of the generalized solver from many points of the whole domain, with the column far
 * from the others and the frequencies far apart.  Safeguards: the spectrum's own verdict (undecided, a gap above
 * rounding, a rank in doubt), fewer independent columns than elsewhere, a null vector that is not conserved at points
 * over the whole domain, and a known current that is missing. */
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "base/linalg.h"
#include "integrals/echelon.h"
#include "integrals/rows.h"
#include "commands/benchmark_fit.h"
#include "search/spans.h"
#include "commands/robustness_internal.h"
#include "graph/dag.h"
#include "graph/function.h"

enum { levels = 6, most_ways = 4, most_field_columns = 400, truth_density = 10, density = 4, most_degree = 4 };
static const double radius[levels] = {1, 0.1, 1e-2, 1e-3, 1e-4, 1e-5},
                    noise[levels] = {0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3},
                    apart[levels] = {0.1, 1e-3, 1e-6, 1e-9, 1e-12, 1e-15};
static const double far_apart = 0.37;
/* largest rate at held-out points, relative to the variation, of a conserved function whose coefficients have about ten
 * digits */
static const double conserved = 1e-6;
static const double in_span = 1e-10, constant = 1e-9;
static const char *const way_name[most_ways] = {"current, generalized", "current, plain SVD", "symmetry, generalized",
                                                "symmetry, plain SVD"};

typedef struct {
    nh_robustness_work *w;
    const nh_benchmark_work *plain;
    nh_model *model;
    nh_nullspace_options limits;
    nh_points *points, *many, *heldout; /* of the whole domain */
    size_t letters, columns;
    nh_ex *letter, *e; /* the polynomials */
    uint64_t state;    /* state of the random numbers of the noise */
} fit;

/* One method for one ansatz. */
typedef struct {
    size_t columns;
    nh_ex *e; /* the current of each column */
    nh_nullspace *space;
    char why[120]; /* the reason why there is no null space */
} solved;

static double chance(fit *f)
{
    f->state = f->state * 6364136223846793005ULL + 1442695040888963407ULL;
    return (double)(f->state >> 11) / 4503599627370496.0 - 1;
}

static void solved_clear(solved *s)
{
    nh_free(s->e);
    nh_nullspace_free(s->space);
}

/* w Gamma(e_j) and e_j at the points, count x n each. */
static void evaluate(const fit *f, const nh_points *points, size_t n, const nh_ex *e, double *rate, double *value)
{
    nh_ex *gamma = nh_alloc_array(n + 1, sizeof *gamma);
    for (size_t j = 0; j < n; j++) gamma[j] = nh_model_gamma(f->model, e[j]);
    nh_points_evaluate(points, f->model, n, gamma, rate);
    nh_points_evaluate(points, f->model, n, e, value);
    for (size_t j = 0; j < n; j++)
        for (size_t p = 0; p < points->count; p++) rate[j * points->count + p] *= points->weight[p];
    nh_free(gamma);
}

static void blur(fit *f, size_t rows, double *column, double size)
{
    double largest = 0;
    for (size_t p = 0; p < rows; p++) largest = fmax(largest, fabs(column[p]));
    for (size_t p = 0; p < rows; p++) column[p] += size * largest * chance(f);
}

static void add_current_rows(fit *f, const nh_points *points, size_t n, const nh_ex *e, double size,
                             nh_equations *equations)
{
    size_t rows = points->count;
    double *rate = nh_alloc_array(2 * rows * n + 1, sizeof *rate), *value = rate + rows * n;
    evaluate(f, points, n, e, rate, value);
    for (size_t j = 0; j < 2 * n && size > 0; j++) blur(f, rows, rate + j * rows, size);
    nh_equations_add(equations, rows, rate, rows);
    nh_equations_add_values(equations, rows, value, rows);
    nh_free(rate);
}

static bool solve(fit *f, const nh_points *points, size_t n, const nh_ex *e, int way, double size, solved *s)
{
    bool symmetry = way & 2, plain = way & 1;
    nh_field_column *column = NULL;
    nh_error error;
    nh_error_clear(&error);
    *s = (solved){
        .columns = n, .e = nh_alloc_array(n + 1, sizeof *s->e), .why = "the symmetry route has too many columns"};
    memcpy(s->e, e, n * sizeof *e);
    if (symmetry) {
        s->columns = nh_rows_field_columns(f->model, n, e, &column);
        if (!s->columns || s->columns > most_field_columns || points->count * (f->model->n + 1) < s->columns + 16)
            return false;
        nh_free(s->e);
        s->e = nh_alloc_array(s->columns + 1, sizeof *s->e);
        for (size_t j = 0; j < s->columns; j++) s->e[j] = nh_rows_field_current(f->model, &column[j]);
    }
    nh_equations *equations = nh_equations_create(s->columns, 1);
    if (symmetry) nh_rows_symmetry(f->model, s->columns, column, points, equations);
    else add_current_rows(f, points, n, e, size, equations);
    s->space =
        plain ? nh_nullspace_plain(equations, &f->limits, &error) : nh_nullspace_solve(equations, &f->limits, &error);
    nh_equations_free(equations);
    snprintf(s->why, sizeof s->why, "%.119s", error.what);
    return s->space != NULL;
}

/* ---- safeguards ---- */

/* The number of null vectors that are not conserved, or are constant, at points that the fit has not used; and the
 * largest rate relative to the variation. */
static size_t refuted(const fit *f, const solved *s, double *worst)
{
    size_t rows = f->heldout->count, n = s->columns, k = s->space->dimension, bad = 0;
    double *rate = nh_alloc_array(2 * rows * n + 1, sizeof *rate), *value = rate + rows * n,
           *r = nh_alloc_array(2 * rows * k + 1, sizeof *r), *v = r + rows * k;
    evaluate(f, f->heldout, n, s->e, rate, value);
    nh_multiply(rows, k, n, rate, s->space->vector, r);
    nh_multiply(rows, k, n, value, s->space->vector, v);
    for (size_t j = 0; j < k; j++) {
        double mean = 0, vary = 0, rest = 0, size = 0;
        for (size_t p = 0; p < rows; p++) mean += v[p + j * rows] / (double)rows;
        for (size_t p = 0; p < rows; p++) {
            vary += (v[p + j * rows] - mean) * (v[p + j * rows] - mean);
            size += v[p + j * rows] * v[p + j * rows];
            rest += r[p + j * rows] * r[p + j * rows];
        }
        if (vary > 0) *worst = fmax(*worst, sqrt(rest / vary));
        bad += !(sqrt(rest) <= conserved * sqrt(vary) && sqrt(vary) > constant * sqrt(size));
    }
    nh_free(r);
    nh_free(rate);
    return bad;
}

/* Is a combination of the null vectors nearly constant elsewhere?  Then one of them is no current but a linear
 * dependence of the columns. */
static bool hardly_vary(const fit *f, const solved *s)
{
    size_t rows = f->heldout->count, k = s->space->dimension;
    double *v = nh_span_values(f->model, f->heldout, s->columns, s->e, k, s->space->vector),
           *sigma = nh_alloc_array(k + 1, sizeof *sigma);
    bool bad = k > 0 && (!nh_svd(rows, k, v, sigma, NULL, NULL) || !(sigma[k - 1] > conserved * sigma[0]));
    nh_free(sigma);
    nh_free(v);
    return bad;
}

/* The largest distance from the null space of a known current that the columns span; NAN: there is none. */
static double missing(const fit *f, const solved *s)
{
    size_t n = s->columns, rows = f->heldout->count;
    double *one = nh_alloc_array(n * n + 1, sizeof *one), unit = 1, worst = NAN;
    for (size_t j = 0; j < n; j++) one[j + j * n] = 1;
    double *all = nh_span_values(f->model, f->heldout, n, s->e, n, one),
           *found = nh_span_values(f->model, f->heldout, n, s->e, s->space->dimension, s->space->vector);
    for (size_t k = 0; k < f->plain->solution.currents && n < rows; k++) {
        double *phi = nh_span_values(f->model, f->heldout, 1, &f->plain->solution.current[k], 1, &unit);
        if (nh_span_distance(rows, n, all, 1, phi) < in_span)
            worst = fmax(isnan(worst) ? 0 : worst, nh_span_distance(rows, s->space->dimension, found, 1, phi));
        nh_free(phi);
    }
    nh_free(found);
    nh_free(all);
    nh_free(one);
    return worst;
}

static const char *guard_of(fit *f, const solved *s, size_t rank, double *error)
{
    nh_arena *arena = f->w->out->arena;
    const nh_nullspace *n = s->space;
    double rate = 0, lost = missing(f, s);
    size_t bad = refuted(f, s, &rate);
    *error = fmax(rate, isnan(lost) ? 0 : lost);
    if (bad)
        return nh_arena_printf(arena, "%zu of %zu null vectors are not conserved, or constant, elsewhere in the domain",
                               bad, n->dimension);
    if (hardly_vary(f, s)) return "null vectors that depend on each other elsewhere in the domain";
    if (n->verdict == NH_UNDECIDED) return "the spectrum does not decide";
    if (n->likely > n->dimension) return "a wide gap above values that are not at rounding";
    if (n->rank_in_doubt) return "it is in doubt how many columns are independent";
    if (n->rank < rank) return nh_arena_printf(arena, "%zu independent columns, %zu elsewhere", n->rank, rank);
    if (lost > conserved) return "a known current is missing";
    return NULL;
}

/* ---- maps ---- */

typedef struct {
    size_t rank, dimension;
    bool known;
} truth;

static truth truth_of(fit *f, size_t n, const nh_ex *e, int way)
{
    solved s;
    truth t = {.known = solve(f, f->many, n, e, way & 2, 0, &s)};
    if (t.known) t.rank = s.space->rank, t.dimension = s.space->dimension, t.known = s.space->verdict != NH_UNDECIDED;
    solved_clear(&s);
    return t;
}

static void fill(fit *f, const truth *t, const nh_points *points, size_t n, const nh_ex *e, int way, double size,
                 nh_robustness_cell *cell)
{
    solved s;
    bool good = solve(f, points, n, e, way, size, &s);
    cell->status = NH_FAILED;
    cell->note = nh_arena_strdup(f->w->out->arena, s.why);
    if (good && !t->known) cell->note = "its dimension is not known";
    if (good && t->known) {
        const char *guard = guard_of(f, &s, t->rank, &cell->error);
        bool right = s.space->dimension == t->dimension;
        cell->status = right ? guard ? NH_FLAGGED : NH_ACCURATE : guard ? NH_DETECTED : NH_UNDETECTED;
        cell->note = nh_arena_printf(f->w->out->arena, "%zu found, %zu are there%s%s", s.space->dimension, t->dimension,
                                     guard ? ": " : "", guard ? guard : "");
    }
    solved_clear(&s);
}

static nh_robustness_map *open_map(fit *f, const char *name, const char *axis, const double *at, int ways)
{
    nh_robustness_map *map = nh_robustness_add_map(f->w, name, axis, levels, (size_t)ways);
    for (size_t i = 0; i < map->cells; i++)
        map->cell[i] = (nh_robustness_cell){.at = at[i / (size_t)ways],
                                            .method = way_name[i % (size_t)ways],
                                            .error = NAN,
                                            .drift = NAN,
                                            .status = NH_NOT_RUN,
                                            .note = nh_robustness_no_time};
    return map;
}

static bool late(const fit *f) { return nh_robustness_late(f->w); }

/* Moves the sample points towards one of them until this part of their distance is left; the equations hold at the new
 * points, too. */
static nh_points *crowded(const fit *f, double part)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_points *points =
        nh_points_create(f->model, f->points->count, 1, (uint64_t)f->w->request->options.seed, &ignored);
    for (size_t j = 0; points && j < points->width; j++) {
        double middle = points->column[j][0];
        for (size_t p = 0; p < points->count; p++)
            points->column[j][p] = middle + part * (points->column[j][p] - middle);
    }
    return points;
}

static void map_crowded(fit *f)
{
    nh_robustness_map *map = open_map(f, "clustered samples", "part of the domain", radius, most_ways);
    for (int way = 0; way < most_ways; way++) {
        truth t = truth_of(f, f->columns, f->e, way);
        for (size_t i = 0; i < levels && !late(f); i++) {
            nh_points *points = crowded(f, radius[i]);
            if (points) fill(f, &t, points, f->columns, f->e, way, 0, &map->cell[i * most_ways + (size_t)way]);
            nh_points_free(points);
        }
    }
}

static void map_noisy(fit *f)
{
    enum { ways = 2 };
    nh_robustness_map *map = open_map(f, "noisy samples", "noise, relative", noise, ways);
    for (int way = 0; way < ways; way++) {
        truth t = truth_of(f, f->columns, f->e, way);
        for (size_t i = 0; i < levels && !late(f); i++)
            fill(f, &t, f->points, f->columns, f->e, way, noise[i], &map->cell[i * ways + (size_t)way]);
    }
}

/* The polynomials, and one of them plus a small multiple of a function that is no polynomial. */
static size_t with_neighbour(fit *f, double part, nh_ex *e)
{
    nh_dag *d = f->model->dag;
    nh_ex sum =
        nh_add(d, nh_mul(d, nh_real(d, 0.83), f->letter[0]), nh_mul(d, nh_real(d, 0.29), f->letter[f->letters - 1]));
    memcpy(e, f->e, f->columns * sizeof *e);
    e[f->columns] = nh_add(d, f->e[f->columns - 1],
                           nh_mul(d, nh_real(d, part), nh_call(d, NH_SIN, nh_add(d, sum, nh_real(d, 0.41)))));
    return f->columns + 1;
}

/* The velocities times 1 and sines and cosines of two frequencies; 0 without an angle. */
static size_t with_frequencies(fit *f, double part, nh_ex *e)
{
    const nh_model *model = f->model;
    nh_dag *d = model->dag;
    size_t n = 0, wave = 0;
    while (wave < model->m && !nh_fit_is_wave(model, model->system->coordinate[wave].q)) wave++;
    if (wave == model->m) return 0;
    nh_ex q = model->system->coordinate[wave].q, other = nh_mul(d, nh_real(d, 1 + part), q);
    nh_ex factor[] = {nh_int(d, 1), nh_call(d, NH_SIN, q), nh_call(d, NH_COS, q), nh_call(d, NH_SIN, other),
                      nh_call(d, NH_COS, other)};
    for (size_t i = 0; i < model->n; i++)
        for (size_t k = 0; k < sizeof factor / sizeof *factor; k++) e[n++] = nh_mul(d, model->chart->w[i], factor[k]);
    return n;
}

static void map_apart(fit *f, const char *name, const char *axis, size_t (*ansatz)(fit *, double, nh_ex *))
{
    nh_ex *e = nh_alloc_array(f->columns + 5 * f->model->n + 2, sizeof *e);
    size_t n = ansatz(f, far_apart, e);
    nh_robustness_map *map = n ? open_map(f, name, axis, apart, most_ways) : NULL;
    for (int way = 0; way < most_ways && map; way++) {
        n = ansatz(f, far_apart, e);
        truth t = truth_of(f, n, e, way);
        for (size_t i = 0; i < levels && !late(f); i++) {
            n = ansatz(f, apart[i], e);
            fill(f, &t, f->points, n, e, way, 0, &map->cell[i * most_ways + (size_t)way]);
        }
    }
    nh_free(e);
}

/* The polynomials of the highest degree of which there are not too many. */
static bool choose_polynomials(fit *f, nh_error *error)
{
    size_t most = (size_t)f->w->request->options.robustness_columns;
    f->letter = nh_alloc_array(3 * f->model->m + 1, sizeof *f->letter);
    f->letters = nh_fit_letters(f->model, f->letter);
    for (size_t degree = most_degree; degree > 0; degree--) {
        nh_family family = {.kind = NH_POLYNOMIAL, .in = f->letter, .in_count = f->letters, .degree = degree};
        nh_ansatz *a = nh_ansatz_create(f->model, f->heldout, 1, &family, most, error);
        if (!a) continue;
        f->columns = a->columns;
        f->e = nh_alloc_array(a->columns + 1, sizeof *f->e);
        for (size_t j = 0; j < a->columns; j++) f->e[j] = nh_ansatz_column(a, j);
        nh_ansatz_free(a);
        return true;
    }
    return false;
}

void nh_robustness_fits(nh_robustness_work *w, const nh_benchmark_work *plain)
{
    const nh_options *o = &w->request->options;
    uint64_t seed = (uint64_t)o->seed;
    size_t most = (size_t)o->robustness_columns + 1;
    nh_error ignored;
    nh_error_clear(&ignored);
    fit f = {.w = w,
             .plain = plain,
             .model = plain->out->question->model,
             .limits = nh_nullspace_options_from(o),
             .state = 88172645463325252u};
    if (f.model->chart->implicit) return; /* velocities that are solved for cannot be moved freely */
    f.heldout = nh_points_create(f.model, density * most, 1, seed + 77, &ignored);
    f.points = nh_points_create(f.model, density * most + 16, 1, seed, &ignored);
    f.many = nh_points_create(f.model, truth_density * most + 16, 1, seed + 5, &ignored);
    if (f.heldout && f.points && f.many && choose_polynomials(&f, &ignored)) {
        map_crowded(&f);
        map_noisy(&f);
        map_apart(&f, "ansatz at the edge of dependence", "part of a column that is not spanned", with_neighbour);
        map_apart(&f, "frequencies that nearly coincide", "difference of two frequencies", with_frequencies);
    }
    nh_free(f.e);
    nh_free(f.letter);
    nh_points_free(f.points);
    nh_points_free(f.many);
    nh_points_free(f.heldout);
}
