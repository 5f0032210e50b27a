/* unknowns: values of theta (frequencies inside of the ansatz) at which the null space grows.
 *
 *     1  pencil    for one unknown in a Fourier family: candidates nu as eigenvalues (pencil.h)
 *     2  generic   the null dimension at random theta: values above `generic` are hits
 *     3  search    sigma(theta), the singular value number `generic`, is followed to all its minima
 *
 *        sigma  |\      /\    /\      sigma has a V at a hit: simplex methods go down it to rounding;
 *               | \    /  \  /  \     a smooth minimum that stays above rounding is none
 *               |  \  /    \/    \_
 *               |___\/_____________
 *                 hit               theta
 *     4  hits      minima and candidates whose null dimension is larger; equal ones are joined
 *
 * [docs/method.md, sec. 4; search: RinnooyKanTimmer1987, KucherenkoSytsko2005, subplex: Rowan1990] */
#include "integrals/unknowns.h"

#include <float.h>
#include <math.h>
#include <nlopt.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "base/parallel.h"
#include "base/progress.h"
#include "graph/dag.h"
#include "integrals/pencil.h"
#include "system/sample.h"

enum { most_basins = 12, most_polished = 8, generic_probes = 3, search_rows = 40 };

/* ---- the pencil ---- */

/* Split a family into its one Fourier part with the unknown as frequency, and the rest. */
static bool split_family(const nh_model *model, const nh_family *f, nh_ex unknown, const nh_family **wave,
                         nh_family *rest, nh_family *rest_parts)
{
    static const nh_family one = {.kind = NH_TERMS};
    *wave = NULL;
    *rest = one;
    if (f->kind == NH_FOURIER && f->frequency == unknown) *wave = f;
    if (f->kind != NH_FAMILY_PRODUCT) return *wave != NULL;
    size_t n = 0;
    for (size_t i = 0; i < f->parts; i++) {
        const nh_family *p = &f->part[i];
        bool is_wave = p->kind == NH_FOURIER && p->frequency == unknown && !*wave;
        if (is_wave) *wave = p;
        else if (nh_family_contains(model, p, unknown)) return false;
        else rest_parts[n++] = *p;
    }
    *rest = (nh_family){.kind = NH_FAMILY_PRODUCT, .parts = n, .part = rest_parts};
    return *wave != NULL;
}

/* value[0..count-1] stays in ascending order; a value that is there to 7 digits is not added again.  The new count. */
static size_t add_value(double *value, size_t count, size_t most, double x)
{
    for (size_t i = 0; i < count; i++)
        if (fabs(value[i] - x) <= 1e-7 * fabs(x)) return count;
    if (count == most) return count;
    size_t at = count;
    for (; at > 0 && value[at - 1] > x; at--) value[at] = value[at - 1];
    value[at] = x;
    return count + 1;
}

/* Eigenvalues i mu of Gamma f = lambda Gamma(q) f belong to exp(-i mu q) f: nu = |mu| / harmonic. */
static size_t pencil_of(const nh_model *model, const nh_points *points, const nh_family *wave, const nh_family *rest,
                        const nh_unknown *u, const nh_options *options, size_t count, size_t most, double *value)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_ex one = nh_int(model->dag, 1);
    nh_family family = *rest;
    if (family.kind == NH_TERMS || family.parts == 0) family = (nh_family){.kind = NH_TERMS, .terms = 1, .term = &one};
    nh_ansatz *a = nh_ansatz_create(model, points, 1, &family, (size_t)options->columns, &ignored);
    if (!a) return count;
    double *A = nh_alloc_array(points->count * a->columns + 1, sizeof *A),
           *B = nh_alloc_array(points->count * a->columns + 1, sizeof *B);
    nh_nullspace_options limits = nh_nullspace_options_from(options);
    for (size_t i = 0; i < wave->in_count; i++) {
        nh_rows_pencil(model, a, nh_model_gamma(model, wave->in[i]), points, A, B);
        nh_pencil *p = nh_pencil_solve(points->count, a->columns, A, B, &limits, options->split, &ignored);
        for (size_t k = 0; p && k < p->dimension; k++) {
            if (fabs(p->re[k]) > 1e-6 * fabs(p->im[k])) continue;
            for (size_t h = 1; h <= wave->degree; h++) {
                double nu = fabs(p->im[k]) / (double)h;
                if (nu >= u->low && nu <= u->high) count = add_value(value, count, most, nu);
            }
        }
        nh_pencil_free(p);
    }
    nh_free(B);
    nh_free(A);
    nh_ansatz_free(a);
    return count;
}

size_t nh_unknowns_pencil(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                          const nh_unknown *u, const nh_options *options, size_t most, double *value, bool *applied)
{
    size_t count = 0;
    *applied = false;
    for (size_t i = 0; i < families; i++) {
        const nh_family *wave;
        nh_family rest, *parts = nh_alloc_array(family[i].parts + 1, sizeof *parts);
        if (split_family(model, &family[i], u->symbol, &wave, &rest, parts)) {
            *applied = true;
            count = pencil_of(model, points, wave, &rest, u, options, count, most, value);
        }
        nh_free(parts);
    }
    return count;
}

/* ---- the objective: the first generalized singular value that is not null everywhere ---- */

typedef struct {
    size_t n;
    const nh_unknown *unknown;
    const nh_points *points;
    nh_ansatz *ansatz;
    nh_rows *rows;
    nh_equations *equations;
    nh_nullspace_options limits;
    size_t generic;
    nlopt_opt running;
    long evaluations;
    double *seen; /* evaluations x (n + 1): theta, value */
    size_t seen_capacity;
} objective;

/* log10 would not be smooth near a hit; sigma itself has a V there, which simplex methods follow down to rounding. */
static double sigma_at(objective *o, const double *theta, size_t index, size_t *dimension)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_equations_reset(o->equations);
    nh_rows_current(o->rows, o->points, theta, o->equations);
    nh_nullspace *s = nh_nullspace_solve(o->equations, &o->limits, &ignored);
    double value = s && index < s->rank ? s->spectrum[index] : HUGE_VAL;
    if (dimension) *dimension = s ? s->dimension : 0;
    nh_nullspace_free(s);
    return value;
}

/* NLopt's objective: sigma at theta (n values).  Every evaluation is remembered in `seen`. */
static double evaluate(unsigned n, const double *theta, double *gradient, void *context)
{
    objective *o = context;
    (void)gradient;
    if (nh_interrupted()) {
        if (o->running) nlopt_force_stop(o->running);
        return HUGE_VAL;
    }
    for (unsigned i = 0; i < n; i++)
        if (!isfinite(theta[i])) { /* NLopt may not return at all on NaN */
            if (o->running) nlopt_force_stop(o->running);
            return HUGE_VAL;
        }
    double value = sigma_at(o, theta, o->generic, NULL);
    if (!isfinite(value)) value = 1e30;
    nh_grow(&o->seen, &o->seen_capacity, (size_t)(o->evaluations + 1) * (n + 1), sizeof *o->seen);
    double *row = o->seen + (size_t)o->evaluations++ * (n + 1);
    memcpy(row, theta, n * sizeof *row);
    row[n] = value;
    return value;
}

/* The least null dimension at random values: what is null for almost every theta. */
static void generic_dimension(objective *o, uint64_t seed)
{
    double *theta = nh_alloc_array(o->n + 1, sizeof *theta);
    uint64_t state = seed + 11;
    o->generic = SIZE_MAX;
    for (int k = 0; k < generic_probes; k++) {
        size_t dimension;
        for (size_t i = 0; i < o->n; i++)
            theta[i] = o->unknown[i].low + (o->unknown[i].high - o->unknown[i].low) * nh_random(&state);
        sigma_at(o, theta, 0, &dimension);
        if (dimension < o->generic) o->generic = dimension;
    }
    nh_free(theta);
}

static void bounds(const objective *o, nlopt_opt opt)
{
    double *low = nh_alloc_array(2 * o->n, sizeof *low), *high = low + o->n;
    for (size_t i = 0; i < o->n; i++) {
        low[i] = o->unknown[i].low;
        high[i] = o->unknown[i].high;
    }
    nlopt_set_lower_bounds(opt, low);
    nlopt_set_upper_bounds(opt, high);
    nh_free(low);
}

static void optimise(nlopt_opt opt, double *theta, double *value)
{
    if (nlopt_optimize(opt, theta, value) == NLOPT_OUT_OF_MEMORY) nh_memory_ended(0);
}

/* Multi-level single linkage; every evaluation is remembered, so that all basins are seen, not only the best one. */
static void search(objective *o, const nh_options *options)
{
    unsigned n = (unsigned)o->n;
    nlopt_opt global = nh_memory_got(nlopt_create(NLOPT_GN_MLSL_LDS, n));
    nlopt_opt local = nh_memory_got(nlopt_create(NLOPT_LN_SBPLX, n));
    double *theta = nh_alloc_array(o->n, sizeof *theta), value;
    for (size_t i = 0; i < o->n; i++) theta[i] = (o->unknown[i].low + o->unknown[i].high) / 2;
    nlopt_srand((unsigned long)options->seed);
    nlopt_set_xtol_rel(local, 1e-3);
    nlopt_set_maxeval(local, 60);
    bounds(o, global);
    nlopt_set_local_optimizer(global, local);
    nlopt_set_min_objective(global, evaluate, o);
    nlopt_set_maxeval(global, (int)(options->evaluations * (double)o->n)); /* MLSL never stops by itself */
    nlopt_set_population(global, 16 * n);
    o->running = global;
    optimise(global, theta, &value);
    o->running = NULL;
    nlopt_destroy(local);
    nlopt_destroy(global);
    nh_free(theta);
}

/* Follows one minimum down to rounding, or until it proves to be none: near a hit sigma falls in proportion to the
 * distance.  NLopt's return codes are not trusted: the point is evaluated again. */
static double polish(objective *o, double *theta, double width)
{
    static const double progress = 0.1;
    unsigned n = (unsigned)o->n;
    double value = evaluate(n, theta, NULL, o), found, before = value;
    for (int round = 0; round < 4 && (round == 0 || value < progress * before); round++, width *= 1e-3) {
        before = value;
        nlopt_opt opt = nh_memory_got(nlopt_create(NLOPT_LN_SBPLX, n));
        double *best = nh_alloc_array(o->n, sizeof *best), *step = nh_alloc_array(o->n, sizeof *step);
        memcpy(best, theta, o->n * sizeof *best);
        for (size_t i = 0; i < o->n; i++) step[i] = width * (o->unknown[i].high - o->unknown[i].low);
        bounds(o, opt);
        nlopt_set_min_objective(opt, evaluate, o);
        nlopt_set_initial_step(opt, step);
        nlopt_set_xtol_rel(opt, DBL_EPSILON);
        nlopt_set_maxeval(opt, 30 * (int)n);
        o->running = opt;
        optimise(opt, best, &found);
        o->running = NULL;
        found = evaluate(n, best, NULL, o);
        if (found < value) {
            value = found;
            memcpy(theta, best, o->n * sizeof *best);
        }
        nlopt_destroy(opt);
        nh_free(step);
        nh_free(best);
    }
    return value;
}

/* In the largest part of an interval. */
static double distance(const objective *o, const double *a, const double *b)
{
    double d = 0;
    for (size_t i = 0; i < o->n; i++) d = fmax(d, fabs(a[i] - b[i]) / (o->unknown[i].high - o->unknown[i].low));
    return d;
}

static int by_value(const void *a, const void *b, void *context)
{
    size_t n = *(const size_t *)context;
    double x = ((const double *)a)[n], y = ((const double *)b)[n];
    return (x > y) - (x < y);
}

/* The lowest points seen that are not near a lower one. */
static size_t basins(objective *o, double near, double *out)
{
    size_t count = 0, row = o->n + 1, total = (size_t)o->evaluations;
    double *sorted = nh_alloc_array(total * row + 1, sizeof *sorted);
    memcpy(sorted, o->seen, total * row * sizeof *sorted);
    qsort_r(sorted, total, row * sizeof *sorted, by_value, &o->n);
    for (size_t i = 0; i < total && count < most_basins; i++) {
        bool fresh = true;
        for (size_t j = 0; j < count && fresh; j++) fresh = distance(o, sorted + i * row, out + j * o->n) > near;
        if (fresh) memcpy(out + count++ * o->n, sorted + i * row, o->n * sizeof *out);
    }
    nh_free(sorted);
    return count;
}

/* ---- hits ---- */

/* A hit that is there gets the better value, and says by which ways it was found; hits ascend in the first unknown. */
static void add_hit(nh_hits *h, const objective *o, const double *theta, double quotient, size_t dimension, bool pencil)
{
    for (size_t i = 0; i < h->count; i++) {
        if (distance(o, h->hit[i].value, theta) > 1e-6) continue;
        double d = 0;
        for (size_t j = 0; j < o->n; j++)
            d = fmax(d, fabs(h->hit[i].value[j] - theta[j]) / fmax(fabs(theta[j]), 1e-300));
        h->hit[i].difference = fmax(h->hit[i].difference, d);
        h->hit[i].by_pencil |= pencil;
        h->hit[i].by_search |= !pencil;
        if (quotient < h->hit[i].quotient) {
            h->hit[i].quotient = quotient;
            memcpy(h->hit[i].value, theta, o->n * sizeof *theta);
        }
        return;
    }
    if (h->count == most_basins) return;
    double *value = nh_arena_alloc(h->arena, o->n * sizeof *value);
    memcpy(value, theta, o->n * sizeof *value);
    size_t at = h->count++;
    for (; at > 0 && h->hit[at - 1].value[0] > theta[0]; at--) h->hit[at] = h->hit[at - 1];
    h->hit[at] = (nh_hit){
        .value = value, .quotient = quotient, .dimension = dimension, .by_pencil = pencil, .by_search = !pencil};
}

/* theta is a hit where more is null than for generic values. */
static void consider(nh_hits *h, objective *o, const double *theta, bool pencil)
{
    size_t dimension;
    double value = sigma_at(o, theta, o->generic, &dimension);
    if (dimension > o->generic) add_hit(h, o, theta, value, dimension, pencil);
    if (value < h->best) h->best = value;
}

/* Only the families with an unknown enter the search: the others are null or not for every theta. */
static bool open_objective(objective *o, const nh_model *model, size_t families, const nh_family *family,
                           const nh_options *options, nh_error *error)
{
    nh_family *with = nh_alloc_array(families + 1, sizeof *with);
    nh_ex *symbol = nh_alloc_array(o->n + 1, sizeof *symbol);
    size_t count = 0;
    for (size_t i = 0; i < families; i++) {
        bool contains = false;
        for (size_t j = 0; j < o->n; j++) contains |= nh_family_contains(model, &family[i], o->unknown[j].symbol);
        if (contains) with[count++] = family[i];
    }
    for (size_t j = 0; j < o->n; j++) symbol[j] = o->unknown[j].symbol;
    o->ansatz = nh_ansatz_create(model, o->points, count, with, (size_t)options->columns, error);
    if (o->ansatz) {
        o->rows = nh_rows_create(model, o->ansatz, o->n, symbol);
        o->equations = nh_equations_create(o->ansatz->columns, nh_threads(options->threads));
    }
    nh_free(symbol);
    nh_free(with);
    return o->ansatz != NULL;
}

static void close_objective(objective *o)
{
    nh_equations_free(o->equations);
    nh_rows_free(o->rows);
    nh_ansatz_free(o->ansatz);
    nh_free(o->seen);
}

bool nh_unknowns_scan(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                      const nh_unknown *unknown, const nh_options *options, size_t index, size_t count,
                      const double *theta, double *sigma, nh_error *error)
{
    objective o = {.n = 1, .unknown = unknown, .points = points, .limits = nh_nullspace_options_from(options)};
    bool good = open_objective(&o, model, families, family, options, error);
    for (size_t i = 0; i < count && good; i++) sigma[i] = nh_interrupted() ? NAN : sigma_at(&o, &theta[i], index, NULL);
    if (good) close_objective(&o);
    return good;
}

/* How many of the equal parts of the box hold an evaluation? */
static void count_parts(const objective *o, nh_hits *h)
{
    enum { most_parts = 1 << 12 };
    size_t all = 1;
    h->parts = (size_t)fmax(1, floor(pow(most_parts, 1.0 / (double)o->n)));
    for (size_t j = 0; j < o->n; j++) all *= h->parts;
    bool *seen = nh_alloc_array(all, sizeof *seen);
    for (size_t i = 0; i < (size_t)o->evaluations; i++) {
        size_t at = 0;
        for (size_t j = 0; j < o->n; j++) {
            const nh_unknown *u = &o->unknown[j];
            double part = (o->seen[i * (o->n + 1) + j] - u->low) / (u->high - u->low) * (double)h->parts;
            at = at * h->parts + (size_t)fmin(fmax(part, 0), (double)h->parts - 1);
        }
        h->visited += !seen[at];
        seen[at] = true;
    }
    nh_free(seen);
}

nh_hits *nh_unknowns_find(const nh_model *model, const nh_points *points, size_t families, const nh_family *family,
                          size_t unknowns, const nh_unknown *unknown, const nh_options *options, nh_error *error)
{
    objective o = {.n = unknowns, .unknown = unknown, .points = points, .limits = nh_nullspace_options_from(options)};
    if (!open_objective(&o, model, families, family, options, error)) return NULL;
    nh_arena *arena = nh_arena_create();
    nh_hits *h = nh_arena_alloc(arena, sizeof *h);
    *h = (nh_hits){.arena = arena,
                   .unknowns = unknowns,
                   .hit = nh_arena_alloc(arena, (most_basins + 1) * sizeof *h->hit),
                   .best = INFINITY};
    /* a search evaluates the ansatz thousands of times: three rows per column are enough to see a minimum */
    nh_points few = *points;
    if (few.count > search_rows && few.count > 3 * o.ansatz->columns)
        few.count = 3 * o.ansatz->columns > search_rows ? 3 * o.ansatz->columns : search_rows;
    few.beyond = NULL;
    o.points = &few;
    generic_dimension(&o, (uint64_t)options->seed);
    h->generic = o.generic;
    double *theta = nh_alloc_array(most_basins * unknowns, sizeof *theta);
    if (unknowns == 1) {
        size_t n = nh_unknowns_pencil(model, points, families, family, unknown, options, most_basins, theta,
                                      &h->pencil_applied);
        for (size_t i = 0; i < n; i++) consider(h, &o, theta + i, true);
    }
    search(&o, options);
    size_t n = basins(&o, 1e-2, theta);
    if (n > most_polished) n = most_polished;
    for (size_t i = 0; i < n; i++) {
        polish(&o, theta + i * unknowns, 1e-3);
        consider(h, &o, theta + i * unknowns, false);
    }
    h->evaluations = o.evaluations;
    count_parts(&o, h);
    nh_free(theta);
    close_objective(&o);
    return h;
}

void nh_hits_free(nh_hits *hits)
{
    if (hits) nh_arena_free(hits->arena);
}
