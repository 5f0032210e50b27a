/* All relations sum_j c_j e_ij = 0 of columns of expressions (relation_space.h).
 *
 *                       column j
 *                +---------------------+
 *     row i      | coefficients 0..N   |      along x_k(s) = random series: (rows (N + 1)) x columns residues,
 *                | of e_ij(s)          |      rank r <= the true rank, so columns - r >= the number of relations
 *                +---------------------+
 *
 *     reduced echelon form: columns with pivots p_1 .. p_r, and free ones f
 *     for each f:   c_f = 1,  c_(p_k) = -row_k,f       which columns take part, and the residues of the coefficients
 *
 * For each f the coefficients are read as small fractions from their residues; where this is no relation, they are
 * searched among functions of the parameters, from one equation: the sum of all rows, each times a symbol of its own.
 * Both are checked in every row (`holds`). */
#include "exact/relation_space.h"

#include <string.h>

#include "base/progress.h"
#include "exact/form.h"
#include "exact/jet_eval.h"
#include "exact/jet_independent.h"
#include "exact/normal.h"
#include "exact/relation.h"
#include "exact/residue_matrix.h"
#include "graph/dag.h"
#include "graph/node.h"

enum {
    canonical_length = 2000,
    beyond = 24,
    beyond_few = 8,
    longest = 250,
    most_points = 200,
    largest_fraction = 2000
};

typedef struct {
    const nh_relation_columns *q;
    nh_dag *d;
    nh_prime field;
    nh_jet_point *point;
    nh_ex *entry;       /* canonical */
    nh_residue *matrix; /* reduced */
    size_t rank, *pivot;
} problem;

/* ---- the rank along a curve ---- */

/* The symbols that are no variables. */
static size_t constants_of(const problem *x, nh_ex **out)
{
    NH_LIST(symbol);
    size_t count = 0, room = 0;
    *out = NULL;
    for (size_t e = 0; e < x->q->columns * x->q->rows; e++) {
        size_t n = nh_symbols_in(x->d, x->entry[e], &symbol);
        for (size_t i = 0; i < n; i++) {
            bool known = false;
            for (size_t k = 0; k < x->q->variables && !known; k++) known = x->q->variable[k] == symbol[i];
            for (size_t k = 0; k < count && !known; k++) known = (*out)[k] == symbol[i];
            if (known) continue;
            nh_grow(out, &room, count + 1, sizeof **out);
            (*out)[count++] = symbol[i];
        }
    }
    return count;
}

/* All entries as series along a random curve. */
static bool evaluate(problem *x, const nh_jet_ring *ring, uint64_t seed, size_t constants, const nh_ex *constant,
                     nh_residue *out)
{
    uint64_t random = seed + 4711;
    nh_jet_point_choose(x->point, x->field, seed);
    nh_jet_eval *v = nh_jet_eval_create(x->point, ring);
    nh_residue *series = nh_alloc_array(ring->size, sizeof *series);
    for (size_t k = 0; k < constants; k++) {
        nh_jet_constant(ring, nh_residue_random(x->field, &random), series);
        nh_jet_eval_set(v, constant[k], series, false);
    }
    for (size_t k = 0; k < x->q->variables; k++) {
        for (size_t e = 0; e < ring->size; e++) series[e] = nh_residue_random(x->field, &random);
        nh_jet_eval_set(v, x->q->variable[k], series, false);
    }
    bool good = nh_jet_eval_all(v, x->q->columns * x->q->rows, x->entry, out);
    nh_free(series);
    nh_jet_eval_free(v);
    return good;
}

/* Column j, row (i, e): the coefficient e of entry i. */
static void fill(problem *x, const nh_jet_ring *ring, const nh_residue *value)
{
    size_t rows = x->q->rows, columns = x->q->columns;
    for (size_t j = 0; j < columns; j++)
        for (size_t i = 0; i < rows; i++)
            for (size_t e = 0; e < ring->size; e++)
                x->matrix[(i * ring->size + e) * columns + j] = value[(j * rows + i) * ring->size + e];
}

/* matrix (rows (order + 1)) x columns, reduced; rank and pivots. */
static bool find_rank(problem *x, size_t order)
{
    size_t rows = x->q->rows, columns = x->q->columns, one = 1;
    x->field = nh_jet_point_prime(x->point, 1);
    nh_jet_ring *ring = nh_jet_ring_create(x->field, 1, &one, order);
    nh_ex *constant;
    size_t constants = constants_of(x, &constant), total = rows * ring->size;
    nh_residue *value = nh_alloc_array(columns * total + 1, sizeof *value);
    bool good = false;
    for (uint64_t seed = 1; seed <= most_points && !good; seed++)
        good = evaluate(x, ring, seed, constants, constant, value);
    if (good) {
        x->matrix = nh_alloc_array(columns * total + 1, sizeof *x->matrix);
        x->pivot = nh_alloc_array(columns + total + 1, sizeof *x->pivot);
        fill(x, ring, value);
        x->rank = nh_residue_matrix_echelon(x->field, total, columns, columns, x->matrix, x->pivot);
    }
    nh_free(value);
    nh_free(constant);
    nh_jet_ring_free(ring);
    return good;
}

/* ---- one relation ---- */

/* sum_j c_j e_ij = 0 in every row, as normal forms. */
static bool holds(const problem *x, const nh_ex *c)
{
    for (size_t i = 0; i < x->q->rows; i++) {
        nh_ex sum = nh_int(x->d, 0);
        for (size_t j = 0; j < x->q->columns; j++)
            if (!nh_is_zero(x->d, c[j])) sum = nh_add(x->d, sum, nh_mul(x->d, c[j], x->q->entry[j * x->q->rows + i]));
        if (!nh_is_zero(x->d, sum) && nh_normal_is_zero(x->d, sum, x->q->max_terms) != NH_ZERO) return false;
    }
    return true;
}

/* The coefficients as fractions, where all of them are small. */
static bool by_fractions(const problem *x, size_t n, const size_t *column, const nh_residue *value, nh_ex *c)
{
    int64_t num, den;
    for (size_t k = 0; k < n; k++) {
        if (!nh_residue_fraction(x->field, value[k], largest_fraction, &num, &den)) return false;
        c[column[k]] = nh_ratio(x->d, num, den);
    }
    return holds(x, c);
}

/* The coefficients as functions of the parameters: from all rows at once, each multiplied by a factor of its own that
 * has no relations. */
static bool by_parameters(const problem *x, size_t n, const size_t *column, nh_ex *c)
{
    size_t rows = x->q->rows;
    nh_ex *whole = nh_alloc_array(2 * n, sizeof *whole), *found = whole + n, *mark = nh_alloc_array(rows, sizeof *mark);
    for (size_t i = 0; i < rows; i++) mark[i] = nh_symbol_fresh(x->d, "a row");
    for (size_t k = 0; k < n; k++) {
        whole[k] = nh_int(x->d, 0);
        for (size_t i = 0; i < rows; i++)
            whole[k] = nh_add(x->d, whole[k], nh_mul(x->d, mark[i], x->q->entry[column[k] * rows + i]));
    }
    bool good = nh_relation_find(x->d, n, whole, x->q->parameters, x->q->parameter, x->q->max_terms, found) ==
                    NH_RELATION_UNIQUE &&
                !nh_is_zero(x->d, found[n - 1]);
    for (size_t k = 0; k < n && good; k++) c[column[k]] = nh_simplify(x->d, nh_div(x->d, found[k], found[n - 1]));
    nh_free(mark);
    nh_free(whole);
    return good && holds(x, c);
}

/* c_free = 1, c_pivot = -row_free. */
static bool relation(const problem *x, size_t free_column, nh_ex *c)
{
    size_t columns = x->q->columns, n = 0, *column = nh_alloc_array(columns + 1, sizeof *column);
    nh_residue *value = nh_alloc_array(columns + 1, sizeof *value);
    for (size_t j = 0; j < columns; j++) c[j] = nh_int(x->d, 0);
    for (size_t i = 0; i < x->rank; i++) {
        nh_residue a = x->matrix[i * columns + free_column];
        if (!a) continue;
        column[n] = x->pivot[i];
        value[n++] = nh_residue_negative(x->field, a);
    }
    column[n] = free_column;
    value[n++] = 1;
    bool good = by_fractions(x, n, column, value, c);
    for (size_t j = 0; j < columns && !good; j++) c[j] = nh_int(x->d, 0);
    good = good || by_parameters(x, n, column, c);
    nh_free(value);
    nh_free(column);
    return good;
}

/* ---- the whole ---- */

static void solve(problem *x, nh_arena *arena, nh_relation_space *out)
{
    size_t columns = x->q->columns;
    bool *pivots = nh_alloc_array(columns + 1, sizeof *pivots);
    for (size_t i = 0; i < x->rank; i++) pivots[x->pivot[i]] = true;
    out->bound = columns - x->rank;
    out->coefficient = nh_arena_alloc(arena, (out->bound * columns + 1) * sizeof *out->coefficient);
    for (size_t j = 0; j < columns && !nh_late(); j++)
        if (!pivots[j] && relation(x, j, out->coefficient + out->proved * columns)) out->proved++;
    nh_free(pivots);
}

/* The rank, by series up to this order; an obstacle otherwise, or NULL. */
static const char *open_problem(problem *x, const nh_relation_columns *q, size_t order)
{
    size_t total = q->columns * q->rows;
    *x = (problem){
        .q = q, .d = q->dag, .point = nh_jet_point_create(q->dag), .entry = nh_alloc_array(total + 1, sizeof(nh_ex))};
    nh_forms forms;
    nh_forms_init(&forms, q->dag, false, canonical_length);
    for (size_t e = 0; e < total; e++) x->entry[e] = nh_form_rewrite(&forms, q->entry[e]);
    nh_forms_clear(&forms);
    if (!nh_jet_point_register(x->point, total, x->entry)) return x->point->obstacle;
    const char *related = nh_jet_point_related(x->point);
    if (related) return related;
    return find_rank(x, order) ? NULL : "no regular point was found";
}

static void close_problem(problem *x)
{
    nh_free(x->matrix);
    nh_free(x->pivot);
    nh_free(x->entry);
    nh_jet_point_free(x->point);
}

nh_relation_last nh_relation_space_last(const nh_relation_columns *q, bool *support)
{
    problem x;
    size_t n = q->columns;
    bool known = !open_problem(&x, q, n / q->rows + beyond_few),
         free = known && x.rank > 0 && x.pivot[x.rank - 1] == n - 1;
    for (size_t j = 0; j < n && known; j++) support[j] = j == n - 1;
    for (size_t i = 0; i < x.rank && known && !free; i++) support[x.pivot[i]] = x.matrix[i * n + n - 1] != 0;
    close_problem(&x);
    return !known ? NH_LAST_UNKNOWN : free ? NH_LAST_IS_FREE : NH_LAST_IS_COMBINED;
}

nh_relation_space *nh_relation_space_of(nh_arena *arena, const nh_relation_columns *q)
{
    nh_relation_space *out = nh_arena_alloc(arena, sizeof *out);
    problem x;
    size_t order = 2 * q->columns / q->rows + beyond;
    *out = (nh_relation_space){.obstacle = open_problem(&x, q, order < longest ? order : longest)};
    if (!out->obstacle) solve(&x, arena, out);
    close_problem(&x);
    return out;
}
