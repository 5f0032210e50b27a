/* echelon: readable vectors of a null space. [docs/method.md, sec. 4, "Canonical form"]
 *
 *     make_table     vectors in terms, each row times the size of its term over the samples: terms x dimension
 *     reduce         reduced echelon form; the most complex terms become pivots, so that the rest is simple
 *     candidate_of   the terms above the option `support`, the pivot with coefficient 1
 *     refine         the support is fitted alone; where it does not satisfy the equations, smaller terms come back */
#include "integrals/echelon.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "exact/normal.h"

nh_nullspace_options nh_nullspace_options_from(const nh_options *o)
{
    return (nh_nullspace_options){o->rank, o->zero, o->undecided, o->gap, o->steepest, o->likely, o->trivial};
}

/* The null space of explicit terms alone. NULL on failure. */
static nh_nullspace *echelon_of_terms(const nh_model *model, const nh_points *points, size_t n, const nh_ex *term,
                                      const nh_options *options, nh_error *error)
{
    nh_family family = {.kind = NH_TERMS, .terms = n, .term = term};
    nh_ansatz *a = nh_ansatz_create(model, points, 1, &family, n, error);
    if (!a) return NULL;
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_rows *rows = nh_rows_create(model, a, 0, NULL);
    nh_rows_current(rows, points, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(options);
    nh_nullspace *nullspace = nh_nullspace_solve(equations, &limits, error);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_ansatz_free(a);
    return nullspace;
}

/* ---- the echelon form ---- */

typedef struct {
    size_t terms, dimension;
    double *v;     /* terms x dimension, each row scaled by its term's size */
    double *size;  /* of the terms over the samples */
    size_t *order; /* terms, most complex first */
    size_t *pivot; /* per vector */
} table;

/* Root mean square of each term about its mean. */
static void term_sizes(const nh_model *model, const nh_points *points, const nh_ansatz *a, double *size)
{
    double *value = nh_alloc_array(a->terms * points->count + 1, sizeof *value);
    nh_points_evaluate(points, model, a->terms, a->term, value);
    for (size_t j = 0; j < a->terms; j++) {
        double mean = 0, square = 0;
        for (size_t p = 0; p < points->count; p++) mean += value[j * points->count + p] / (double)points->count;
        for (size_t p = 0; p < points->count; p++) square += pow(value[j * points->count + p] - mean, 2);
        size[j] = sqrt(square / (double)points->count);
        if (!isfinite(size[j])) size[j] = 0;
    }
    nh_free(value);
}

typedef struct {
    size_t index, complexity;
} ranked;

static int most_complex_first(const void *a, const void *b)
{
    const ranked *x = a, *y = b;
    if (x->complexity != y->complexity) return x->complexity < y->complexity ? 1 : -1;
    return x->index < y->index ? 1 : -1;
}

static bool is_among(size_t n, const nh_ex *e, nh_ex x)
{
    for (size_t i = 0; i < n; i++)
        if (e[i] == x) return true;
    return false;
}

/* Chooses the wanted pivots before all others. */
static void order_terms(const nh_ansatz *a, size_t pivots, const nh_ex *pivot, size_t *order)
{
    enum { before_all = 1 << 30 };
    ranked *r = nh_alloc_array(a->terms + 1, sizeof *r);
    for (size_t j = 0; j < a->terms; j++)
        r[j] = (ranked){j, nh_complexity(a->dag, a->term[j]) + (is_among(pivots, pivot, a->term[j]) ? before_all : 0)};
    qsort(r, a->terms, sizeof *r, most_complex_first);
    for (size_t j = 0; j < a->terms; j++) order[j] = r[j].index;
    nh_free(r);
}

/* The column with the largest entry in row `term` among the vectors without a pivot. */
static size_t best_vector(const table *t, size_t term, size_t done, double *largest)
{
    size_t best = done;
    *largest = 0;
    for (size_t k = done; k < t->dimension; k++) {
        double x = fabs(t->v[term + k * t->terms]);
        if (x <= *largest) continue;
        *largest = x;
        best = k;
    }
    return best;
}

/* Exchanges the vectors a and b. */
static void swap_vectors(table *t, size_t a, size_t b)
{
    for (size_t j = 0; j < t->terms && a != b; j++) {
        double x = t->v[j + a * t->terms];
        t->v[j + a * t->terms] = t->v[j + b * t->terms];
        t->v[j + b * t->terms] = x;
    }
}

/* Vector p becomes 1 in this row, all others 0. */
static void clear_row(table *t, size_t term, size_t pivot_vector)
{
    double *p = t->v + pivot_vector * t->terms, scale = p[term];
    for (size_t j = 0; j < t->terms; j++) p[j] /= scale;
    for (size_t k = 0; k < t->dimension; k++) {
        double *x = t->v + k * t->terms, f = x[term];
        if (k == pivot_vector || f == 0) continue;
        for (size_t j = 0; j < t->terms; j++) x[j] -= f * p[j];
        x[term] = 0;
    }
}

/* Vectors are normalised to largest entry 1, so that a pivot is compared with the entries of its own vector. */
static void normalise(table *t, size_t from)
{
    for (size_t k = from; k < t->dimension; k++) {
        double largest = 0, *x = t->v + k * t->terms;
        for (size_t j = 0; j < t->terms; j++) largest = fmax(largest, fabs(x[j]));
        for (size_t j = 0; j < t->terms && largest > 0; j++) x[j] /= largest;
    }
}

static void reduce(table *t, double small)
{
    size_t done = 0;
    for (size_t i = 0; i < t->terms && done < t->dimension; i++) {
        double largest;
        size_t term = t->order[i];
        normalise(t, done);
        size_t k = best_vector(t, term, done, &largest);
        /* no pivot, but the entry stays: the last coefficients of a Chebyshev series are small */
        if (largest < small) continue;
        swap_vectors(t, done, k);
        clear_row(t, term, done);
        t->pivot[done++] = term;
    }
    t->dimension = done;
}

/* The null vectors in terms instead of columns, each entry times the size of its term, reduced: terms x count. */
static table make_table(const nh_model *model, const nh_points *points, const nh_ansatz *a, const nh_nullspace *n,
                        size_t count, size_t pivots, const nh_ex *pivot, double small)
{
    table t = {.terms = a->terms, .dimension = count};
    t.v = nh_alloc_array(t.terms * t.dimension + 1, sizeof *t.v);
    t.size = nh_alloc_array(t.terms + 1, sizeof *t.size);
    t.order = nh_alloc_array(t.terms + 1, sizeof *t.order);
    t.pivot = nh_alloc_array(t.dimension + 1, sizeof *t.pivot);
    term_sizes(model, points, a, t.size);
    order_terms(a, pivots, pivot, t.order);
    for (size_t k = 0; k < t.dimension; k++)
        for (size_t c = 0; c < a->columns; c++) {
            double x = n->vector[c + k * n->columns];
            for (size_t j = 0; j < t.terms && x != 0; j++)
                t.v[j + k * t.terms] += a->to_term[j + c * t.terms] * x * t.size[j];
        }
    reduce(&t, small);
    return t;
}

static void table_clear(table *t)
{
    nh_free(t->v);
    nh_free(t->size);
    nh_free(t->order);
    nh_free(t->pivot);
}

/* ---- supports ---- */

static void *take(nh_candidates *list, size_t count, size_t size)
{
    return nh_arena_alloc(list->arena, (count + 1) * size);
}

/* The terms above a cut, scaled so that the pivot has coefficient 1. */
static void select_support(nh_candidate *c, double cut)
{
    double unit = 1;
    nh_ex pivot = c->term[c->pivot];
    c->count = 0;
    for (size_t j = 0; j < c->all; j++) {
        if (c->all_size[j] < cut) continue;
        if (c->all_term[j] == pivot) {
            c->pivot = c->count;
            unit = c->all_coefficient[j];
        }
        c->coefficient[c->count] = c->all_coefficient[j];
        c->term[c->count++] = c->all_term[j];
    }
    for (size_t j = 0; j < c->count; j++) c->coefficient[j] /= unit;
}

/* Row k of the table as a candidate: all its terms, the simplest first, and those of them that make it up
 * (select_support). */
static nh_candidate candidate_of(nh_candidates *list, const nh_ansatz *a, const table *t, size_t k, double cut,
                                 double accepted)
{
    const double *v = t->v + k * t->terms;
    nh_candidate c = {.accepted = accepted};
    c.term = take(list, t->terms, sizeof *c.term);
    c.coefficient = take(list, t->terms, sizeof *c.coefficient);
    c.all_term = take(list, t->terms, sizeof *c.all_term);
    c.all_coefficient = take(list, t->terms, sizeof *c.all_coefficient);
    c.all_size = take(list, t->terms, sizeof *c.all_size);
    for (size_t i = 0; i < t->terms; i++) {
        size_t j = t->order[t->terms - 1 - i]; /* simplest first */
        if (v[j] == 0 || t->size[j] == 0) continue;
        c.all_term[c.all] = a->term[j];
        c.all_coefficient[c.all] = v[j] / t->size[j];
        c.all_size[c.all++] = fabs(v[j]);
    }
    c.term[0] = a->term[t->pivot[k]];
    select_support(&c, cut);
    return c;
}

/* Fit the support alone.  False when it does not satisfy the equations well enough. */
static bool refit(const nh_model *model, const nh_points *points, nh_candidate *c, const nh_options *options)
{
    nh_error ignored;
    nh_error_clear(&ignored);
    nh_nullspace *fit = echelon_of_terms(model, points, c->count, c->term, options, &ignored);
    if (!fit) return false;
    bool good = fit->rank > 0 && fit->spectrum[0] <= c->accepted;
    c->quotient = fit->rank ? fit->spectrum[0] : INFINITY;
    c->refitted = fit->dimension == 1 && fit->vector[c->pivot] != 0;
    for (size_t j = 0; j < c->count && c->refitted; j++) c->coefficient[j] = fit->vector[j] / fit->vector[c->pivot];
    nh_nullspace_free(fit);
    return good;
}

void nh_echelon_refine(const nh_model *model, const nh_points *points, nh_candidate *c, const nh_options *options)
{
    const double cuts[] = {options->support, 1e-3 * options->support, 1e-6 * options->support, 0};
    for (size_t i = 0; i < sizeof cuts / sizeof *cuts; i++) {
        select_support(c, cuts[i]);
        if (refit(model, points, c, options) || c->count == c->all) break; /* lower cuts leave all terms, too */
    }
}

static size_t candidate_complexity(const nh_dag *dag, const nh_candidate *c)
{
    size_t sum = 0;
    for (size_t i = 0; i < c->count; i++) sum += 1 + nh_complexity(dag, c->term[i]);
    return sum;
}

nh_candidates *nh_echelon(const nh_model *model, const nh_points *points, const nh_ansatz *ansatz,
                          const nh_nullspace *nullspace, size_t count, const nh_options *options)
{
    return nh_echelon_with_pivots(model, points, ansatz, nullspace, count, 0, NULL, options);
}

nh_candidates *nh_echelon_with_pivots(const nh_model *model, const nh_points *points, const nh_ansatz *ansatz,
                                      const nh_nullspace *nullspace, size_t count, size_t pivots, const nh_ex *pivot,
                                      const nh_options *options)
{
    table t = make_table(model, points, ansatz, nullspace, count, pivots, pivot, options->support);
    nh_candidates *list = nh_alloc(sizeof *list);
    list->arena = nh_arena_create();
    list->candidate = take(list, t.dimension, sizeof *list->candidate);
    double accepted = options->zero * DBL_EPSILON * fmax(1, fmin(options->steepest, nullspace->next_left_scale));
    for (size_t k = 0; k < t.dimension; k++) {
        nh_candidate c = candidate_of(list, ansatz, &t, k, options->support, accepted);
        size_t at = list->count++, own = candidate_complexity(model->dag, &c);
        for (; at > 0 && candidate_complexity(model->dag, &list->candidate[at - 1]) > own; at--)
            list->candidate[at] = list->candidate[at - 1];
        list->candidate[at] = c;
    }
    table_clear(&t);
    return list;
}

void nh_candidates_free(nh_candidates *candidates)
{
    if (!candidates) return;
    nh_arena_free(candidates->arena);
    nh_free(candidates);
}
