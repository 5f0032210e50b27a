/* sectors: the ansatz in parts by parity, and their null spaces as one. [docs/method.md, sec. 4, "Sectors"]
 *
 *     all_parities    key[j]: bit b says whether column j is odd under reflection b
 *     split           columns sorted by key: first[s] .. first[s + 1] - 1 is sector s
 *     solve_sector    one null space each, in parallel
 *     merge           spectra merged; a vector has its entries in the rows of its sector and 0 elsewhere
 *
 *                columns     sector 0    sector 1    sector 2
 *         vectors          [   *      |     0     |     0    ]
 *                          [   0      |     *     |     0    ]
 *                          [   0      |     0     |     *    ] */
#include "integrals/reflection.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/parallel.h"

enum { parity_points = 8, most_generators = 12 };

/* ---- parities ---- */

typedef struct {
    const nh_model *o;
    const nh_ansatz *a;
    nh_tape *tape; /* the factors' values */
    nh_tape_work *work;
    size_t points;
    double *z, *here, *there, *image;
} mirror;

static mirror mirror_create(const nh_model *model, const nh_ansatz *a, const nh_points *points)
{
    mirror m = {.o = model,
                .a = a,
                .tape = nh_model_tape(model, a->factors, a->factor),
                .points = points->count < parity_points ? points->count : parity_points};
    m.work = nh_tape_work_create(m.tape);
    m.z = nh_alloc_array(m.points * model->width + 1, sizeof *m.z);
    m.here = nh_alloc_array(m.points * a->factors + 1, sizeof *m.here);
    m.there = nh_alloc_array(a->factors + 1, sizeof *m.there);
    m.image = nh_alloc_array(model->width, sizeof *m.image);
    for (size_t p = 0; p < m.points; p++) {
        for (size_t j = 0; j < model->width; j++) m.z[p * model->width + j] = points->column[j][p];
        nh_tape_eval(m.tape, m.work, m.z + p * model->width, m.here + p * a->factors);
    }
    return m;
}

static void mirror_clear(mirror *m)
{
    nh_tape_work_free(m->work);
    nh_tape_free(m->tape);
    nh_free(m->z);
    nh_free(m->here);
    nh_free(m->there);
    nh_free(m->image);
}

/* parity[i] of factor i: +1, -1, or 0 for neither. */
static void factor_parities(mirror *m, const nh_reflection *r, signed char *parity)
{
    size_t n = m->a->factors;
    for (size_t i = 0; i < n; i++) parity[i] = 2; /* not known yet */
    for (size_t p = 0; p < m->points; p++) {
        nh_reflect(r, m->o->width, m->z + p * m->o->width, m->image);
        nh_tape_eval(m->tape, m->work, m->image, m->there);
        for (size_t i = 0; i < n; i++) {
            double a = m->here[p * n + i], b = m->there[i], size = fabs(a) + fabs(b);
            bool even = fabs(a - b) <= 1e-10 * size, odd = fabs(a + b) <= 1e-10 * size;
            signed char here = !isfinite(size) ? 0 : even && odd ? 2 : even ? 1 : odd ? -1 : 0;
            if (here == 2 || parity[i] == 0) continue;
            parity[i] = parity[i] == 2 || parity[i] == here ? here : 0;
        }
    }
    for (size_t i = 0; i < n; i++)
        if (parity[i] == 2) parity[i] = 1;
}

/* Does every column have a parity?  Then bit `bit` of key[j] says whether column j is odd. */
static bool column_parities(mirror *m, const nh_reflection *r, size_t bit, uint32_t *key)
{
    const nh_ansatz *a = m->a;
    signed char *parity = nh_alloc_array(a->factors + 1, sizeof *parity);
    bool pure = true;
    factor_parities(m, r, parity);
    for (size_t j = 0; j < a->columns && pure; j++)
        for (size_t i = 0; i < a->column[j].count; i++) pure &= parity[a->column[j].factor[i]] != 0;
    for (size_t j = 0; j < a->columns && pure; j++) {
        int sign = 1;
        for (size_t i = 0; i < a->column[j].count; i++) sign *= parity[a->column[j].factor[i]];
        if (sign < 0) key[j] |= 1u << bit;
    }
    nh_free(parity);
    return pure;
}

/* Parities under as many independent reflections as all columns have one for. */
static void all_parities(mirror *m, const nh_reflections *all, uint32_t *key)
{
    const nh_reflection *mixed[most_generators];
    size_t bits = 0, mixed_count = 0;
    for (size_t g = 0; g < all->count && g < most_generators; g++) {
        if (column_parities(m, &all->generator[g], bits, key)) bits++;
        else mixed[mixed_count++] = &all->generator[g];
    }
    for (size_t i = 0; i < mixed_count; i++)
        for (size_t j = i + 1; j < mixed_count && bits < 2 * most_generators; j++) {
            nh_reflection r = nh_reflections_product(all, mixed[i], mixed[j]);
            if (column_parities(m, &r, bits, key)) bits++;
        }
}

/* ---- the split ---- */

typedef struct {
    uint32_t key;
    size_t index;
} keyed;

static int by_key(const void *a, const void *b)
{
    const keyed *x = a, *y = b;
    if (x->key != y->key) return x->key < y->key ? -1 : 1;
    return x->index < y->index ? -1 : x->index > y->index;
}

/* Columns and the matrix to_term in this order. */
static void reorder(nh_ansatz *a, const keyed *order)
{
    nh_column *column = nh_arena_alloc(a->arena, (a->columns + 1) * sizeof *column);
    double *map = nh_arena_alloc(a->arena, (a->terms * a->columns + 1) * sizeof *map);
    for (size_t j = 0; j < a->columns; j++) {
        column[j] = a->column[order[j].index];
        memcpy(map + j * a->terms, a->to_term + order[j].index * a->terms, a->terms * sizeof *map);
    }
    a->column = column;
    a->to_term = map;
}

nh_sectors nh_sectors_split(const nh_model *model, const nh_reflections *reflections, const nh_points *points,
                            nh_ansatz *a)
{
    nh_sectors s = {.first = nh_alloc_array(a->columns + 2, sizeof *s.first)};
    uint32_t *key = nh_alloc_array(a->columns + 1, sizeof *key);
    keyed *order = nh_alloc_array(a->columns + 1, sizeof *order);
    mirror m = mirror_create(model, a, points);
    all_parities(&m, reflections, key);
    mirror_clear(&m);
    for (size_t j = 0; j < a->columns; j++) order[j] = (keyed){key[j], j};
    qsort(order, a->columns, sizeof *order, by_key);
    for (size_t j = 0; j < a->columns; j++)
        if (j == 0 || order[j].key != order[j - 1].key) s.first[s.count++] = j;
    s.first[s.count] = a->columns;
    for (size_t i = 0; i < s.count; i++)
        if (s.first[i + 1] - s.first[i] > s.largest) s.largest = s.first[i + 1] - s.first[i];
    if (s.count > 1) reorder(a, order);
    nh_free(order);
    nh_free(key);
    return s;
}

void nh_sectors_clear(nh_sectors *s)
{
    nh_free(s->first);
    *s = (nh_sectors){0};
}

/* ---- solving ---- */

typedef struct {
    const nh_sectors *sectors;
    const nh_nullspace_options *options;
    size_t equations, points, threads; /* threads: of one sector */
    double *a, *b;                     /* weighted rates, equations x columns; values, points x columns */
    nh_nullspace **part;
    nh_error *error; /* one per sector */
} task;

static void solve_sector(size_t s, void *context)
{
    task *t = context;
    size_t from = t->sectors->first[s], columns = t->sectors->first[s + 1] - from;
    nh_equations *equations = nh_equations_create(columns, t->threads);
    nh_equations_leave_out(equations);
    nh_equations_add(equations, t->equations, t->a + from * t->equations, t->equations);
    nh_equations_add_values(equations, t->points, t->b + from * t->points, t->points);
    t->part[s] = nh_nullspace_solve(equations, t->options, &t->error[s]);
    nh_equations_free(equations);
}

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

/* Vectors [from, to) of every sector, into the columns of the whole. */
static void place_vectors(const nh_sectors *s, nh_nullspace *const *part, bool certain, nh_nullspace *whole, size_t *at)
{
    for (size_t i = 0; i < s->count; i++) {
        const nh_nullspace *p = part[i];
        for (size_t k = certain ? 0 : p->dimension; k < (certain ? p->dimension : p->likely); k++)
            memcpy(whole->vector + (*at)++ * whole->columns + s->first[i], p->vector + k * p->columns,
                   p->columns * sizeof *p->vector);
    }
}

/* The null values of all sectors, ascending, then the others. */
static void merge_spectra(const nh_sectors *s, nh_nullspace *const *part, nh_nullspace *whole)
{
    size_t null = 0, rest = whole->dimension;
    for (size_t i = 0; i < s->count; i++)
        for (size_t j = 0; j < part[i]->rank; j++)
            whole->spectrum[j < part[i]->dimension ? null++ : rest++] = part[i]->spectrum[j];
    qsort(whole->spectrum, whole->dimension, sizeof(double), ascending);
    qsort(whole->spectrum + whole->dimension, whole->rank - whole->dimension, sizeof(double), ascending);
    bool both = whole->dimension > 0 && whole->dimension < whole->rank;
    whole->gap =
        both ? whole->spectrum[whole->dimension] / fmax(whole->spectrum[whole->dimension - 1], DBL_EPSILON) : INFINITY;
}

/* One null space from those of the sectors: ranks and dimensions add up, vectors are padded with zeros. */
static nh_nullspace *merge(const nh_sectors *s, nh_nullspace *const *part)
{
    nh_nullspace *whole = nh_alloc(sizeof *whole);
    *whole = (nh_nullspace){.columns = s->first[s->count], .rows = part[0]->rows, .smallest_kept = 1};
    bool undecided = false;
    for (size_t i = 0; i < s->count; i++) {
        const nh_nullspace *p = part[i];
        whole->rank += p->rank;
        whole->dimension += p->dimension;
        whole->likely += p->likely;
        whole->smallest_kept = fmin(whole->smallest_kept, p->rank ? p->smallest_kept : 1);
        whole->largest_dropped = fmax(whole->largest_dropped, p->largest_dropped);
        whole->rank_in_doubt |= p->rank_in_doubt;
        whole->next_left_scale = fmax(whole->next_left_scale, p->next_left_scale);
        undecided |= p->verdict == NH_UNDECIDED;
    }
    whole->verdict = undecided ? NH_UNDECIDED : whole->dimension ? NH_FOUND : NH_NONE;
    whole->spectrum = nh_alloc_array(whole->rank + 1, sizeof *whole->spectrum);
    whole->vector = nh_alloc_array(whole->columns * whole->likely + 1, sizeof *whole->vector);
    whole->dropped = nh_alloc_array(whole->columns + 1, sizeof *whole->dropped);
    for (size_t i = 0; i < s->count; i++)
        memcpy(whole->dropped + s->first[i], part[i]->dropped, part[i]->columns * sizeof *whole->dropped);
    size_t at = 0;
    place_vectors(s, part, true, whole, &at);
    place_vectors(s, part, false, whole, &at);
    merge_spectra(s, part, whole);
    return whole;
}

nh_nullspace *nh_sectors_solve(const nh_model *model, const nh_ansatz *a, const nh_sectors *sectors,
                               const nh_field_bases *fields, const nh_points *points,
                               const nh_nullspace_options *options, size_t threads, nh_error *error)
{
    size_t n = a->columns, count = sectors->count;
    task t = {.sectors = sectors,
              .options = options,
              .equations = fields ? nh_field_rows_equations(model, fields, points->count) : nh_points_equations(points),
              .points = points->count,
              .threads = count < threads ? threads / count : 1};
    t.a = nh_alloc_array(n * (t.equations + t.points) + 1, sizeof *t.a);
    t.b = t.a + n * t.equations;
    t.part = nh_alloc_array(count + 1, sizeof *t.part);
    t.error = nh_alloc_array(count + 1, sizeof *t.error);
    if (fields) nh_field_rows_all(model, fields, a, 0, points, t.a, t.b);
    else nh_rows_all(model, a, points, t.a, t.b);
    nh_parallel(count, threads, solve_sector, &t);
    nh_nullspace *whole = NULL;
    bool good = count > 0;
    for (size_t i = 0; i < count && good; i++) {
        good = t.part[i] != NULL;
        if (!good && error) *error = t.error[i];
    }
    if (good) whole = merge(sectors, t.part);
    for (size_t i = 0; i < count; i++) nh_nullspace_free(t.part[i]);
    nh_free(t.error);
    nh_free(t.part);
    nh_free(t.a);
    return whole;
}
