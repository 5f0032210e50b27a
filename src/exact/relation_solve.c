/* The null vector of a sparse matrix over K, the field of the constant kernels (relation_solve.h), in phases:
 *
 *    1. rank        at random points modulo primes (relation_rows.c): no null vector, one with its support, or several
 *    2. rows        n - 1 independent rows on the support, the sparsest
 *    3. eliminate   fraction-free: row_i := a row_i - b row_p over gcd(a, b), each row made primitive at once
 *    4. back        row_p c_p = -sum_j row_j c_j, from the last pivot to the first
 *    5. polish      no denominators, no common factor, roots included
 *    6. verify      sum_j c_j N_j = 0 in the field: all rows, not only those that were chosen
 *
 * What holds at a point modulo a prime is a guess only, until phase 6; that the rank is full there is a proof. */
#include "exact/relation_solve.h"

#include <string.h>

#include "exact/normal_quotient_internal.h"
#include "exact/relation_rows.h"
#include "graph/num.h"

enum { points = 2 };
static const double gcd_pairs = 1e6;

/* ---- polynomials as quotients ---- */

/* A new quotient, which is not shared yet. */
static nh_quotient *polynomial(nh_quotient_field *f, const fmpz_mpoly_t p)
{
    nh_quotient *q = (nh_quotient *)nh_quotient_number(f, nh_num_int(0));
    fmpz_mpoly_set(q->num, p, f->ctx);
    return q;
}

bool nh_relation_is_polynomial(const nh_quotient_field *field, const nh_quotient *q)
{
    return fmpz_mpoly_is_fmpz(q->den, field->ctx);
}

static bool fine(const nh_quotient_field *f) { return nh_quotient_field_state_of(f) == NH_FIELD_FINE; }

static void check(nh_quotient_field *f, const fmpz_mpoly_t p)
{
    if ((double)p->length > f->max_terms) nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
}

/* g = gcd(a, b), or 1 where that is long: a fraction that is not cancelled is still correct. */
static void gcd(nh_quotient_field *f, fmpz_mpoly_t g, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    double pairs = (double)a->length * (double)b->length;
    if ((f->work += pairs) > f->max_work) nh_quotient_field_break(f, NH_FIELD_TOO_LARGE);
    if (pairs > gcd_pairs || !fine(f) || !nh_quotient_field_gcd(f, g, a, b)) fmpz_mpoly_one(g, f->ctx);
}

/* l = lcm of the denominators; returns whether it is 1. */
static bool common_denominator(nh_quotient_field *f, size_t n, const nh_quotient *const *q, fmpz_mpoly_t l)
{
    fmpz_mpoly_t g;
    fmpz_mpoly_init(g, f->ctx);
    fmpz_mpoly_one(l, f->ctx);
    for (size_t j = 0; j < n && fine(f); j++) {
        if (fmpz_mpoly_is_one(q[j]->den, f->ctx)) continue;
        gcd(f, g, l, q[j]->den);
        fmpz_mpoly_divexact(g, q[j]->den, g, f->ctx);
        fmpz_mpoly_mul(l, l, g, f->ctx);
        check(f, l);
    }
    fmpz_mpoly_clear(g, f->ctx);
    return fmpz_mpoly_is_one(l, f->ctx);
}

/* Reducing a product by r^2 = a/b brings back denominators, but only in generators before r. */
bool nh_relation_clear_denominators(nh_quotient_field *field, size_t n, const nh_quotient **q)
{
    fmpz_mpoly_t l, factor;
    bool done = false;
    fmpz_mpoly_init(l, field->ctx);
    fmpz_mpoly_init(factor, field->ctx);
    for (size_t round = 0; round < field->relations + 2 && fine(field); round++) {
        if ((done = common_denominator(field, n, q, l))) break;
        for (size_t j = 0; j < n && fine(field); j++) {
            fmpz_mpoly_divexact(factor, l, q[j]->den, field->ctx);
            q[j] = nh_quotient_mul(field, polynomial(field, q[j]->num), polynomial(field, factor));
        }
    }
    fmpz_mpoly_clear(l, field->ctx);
    fmpz_mpoly_clear(factor, field->ctx);
    if (!done) nh_quotient_field_break(field, NH_FIELD_TOO_LARGE);
    return done && fine(field);
}

/* Divides q by the polynomial factor that all have in common; q has no denominators. */
static void take_common_factor(nh_quotient_field *f, size_t n, const nh_quotient **q)
{
    fmpz_mpoly_t g;
    fmpz_mpoly_init(g, f->ctx);
    for (size_t j = 0; j < n && !fmpz_mpoly_is_one(g, f->ctx); j++) gcd(f, g, g, q[j]->num);
    if (n && fmpz_sgn(q[0]->num->coeffs) < 0) fmpz_mpoly_neg(g, g, f->ctx);
    for (size_t j = 0; j < n && !fmpz_mpoly_is_one(g, f->ctx); j++) {
        nh_quotient *divided = polynomial(f, q[j]->num);
        fmpz_mpoly_divexact(divided->num, divided->num, g, f->ctx);
        q[j] = divided;
    }
    fmpz_mpoly_clear(g, f->ctx);
}

bool nh_relation_make_primitive(nh_quotient_field *f, size_t n, const nh_quotient **q)
{
    if (!nh_relation_clear_denominators(f, n, q)) return false;
    take_common_factor(f, n, q);
    return fine(f);
}

/* ---- elimination over K ---- */

/* The equations that are not used yet, `rows` of them, in n unknowns; NULL is zero. */
typedef struct {
    nh_quotient_field *field;
    size_t n, rows;
    const nh_quotient **entry;
    size_t *pivot; /* pivot columns of the used rows, in the order of use: the first `used` */
    size_t used;
} matrix;

/* Row i of n entries. */
static const nh_quotient **row_of(matrix *m, size_t i) { return m->entry + i * m->n; }

/* The number of entries of row i, and of the terms of their numerators. */
static void weight_of(matrix *m, size_t i, size_t *columns, size_t *terms)
{
    *columns = *terms = 0;
    for (size_t j = 0; j < m->n; j++) {
        const nh_quotient *a = row_of(m, i)[j];
        if (!a) continue;
        ++*columns;
        *terms += nh_quotient_terms(a);
    }
}

/* Moves the sparsest remaining row to the next place. */
static void select_row(matrix *m)
{
    size_t best = m->used, fewest = SIZE_MAX, shortest = SIZE_MAX;
    for (size_t i = m->used; i < m->rows; i++) {
        size_t columns, terms;
        weight_of(m, i, &columns, &terms);
        if (columns > fewest || (columns == fewest && terms >= shortest)) continue;
        best = i;
        fewest = columns;
        shortest = terms;
    }
    for (size_t j = 0; j < m->n; j++) {
        const nh_quotient *a = row_of(m, best)[j];
        row_of(m, best)[j] = row_of(m, m->used)[j];
        row_of(m, m->used)[j] = a;
    }
}

/* The column of a row that fills in least: it is in few other rows, then its entry is short; the width when the row is
 * zero. */
static size_t select_column(matrix *m)
{
    size_t best = m->n, fewest = SIZE_MAX, shortest = SIZE_MAX;
    for (size_t j = 0; j < m->n; j++) {
        const nh_quotient *a = row_of(m, m->used)[j];
        if (!a) continue;
        size_t others = 0;
        for (size_t i = m->used + 1; i < m->rows; i++) others += row_of(m, i)[j] != NULL;
        if (others > fewest || (others == fewest && nh_quotient_terms(a) >= shortest)) continue;
        best = j;
        fewest = others;
        shortest = nh_quotient_terms(a);
    }
    return best;
}

/* The same for a sparse vector. */
static bool make_sparse_primitive(nh_quotient_field *f, size_t n, const nh_quotient **a)
{
    const nh_quotient **dense = nh_alloc_array(n, sizeof *dense);
    size_t count = 0, k = 0;
    for (size_t j = 0; j < n; j++)
        if (a[j]) dense[count++] = a[j];
    bool good = nh_relation_make_primitive(f, count, dense);
    for (size_t j = 0; j < n; j++)
        if (a[j]) a[j] = dense[k++];
    nh_free(dense);
    return good;
}

/* a b + c d, where NULL is zero */
static const nh_quotient *combine(nh_quotient_field *f, const nh_quotient *a, const nh_quotient *b,
                                  const nh_quotient *c, const nh_quotient *d)
{
    const nh_quotient *sum = a && b ? nh_quotient_mul(f, a, b) : NULL;
    if (c && d) {
        const nh_quotient *product = nh_quotient_mul(f, c, d);
        sum = sum ? nh_quotient_add(f, sum, product) : product;
    }
    return sum && nh_quotient_is_zero(f, sum) ? NULL : sum;
}

/* u = b/g, v = -a/g with g = gcd(a, b): a u + b v = 0 */
static void balance(nh_quotient_field *f, const nh_quotient *a, const nh_quotient *b, const nh_quotient **u,
                    const nh_quotient **v)
{
    nh_quotient *left = polynomial(f, b->num), *right = polynomial(f, a->num);
    fmpz_mpoly_t g;
    fmpz_mpoly_init(g, f->ctx);
    gcd(f, g, a->num, b->num);
    fmpz_mpoly_divexact(left->num, left->num, g, f->ctx);
    fmpz_mpoly_divexact(right->num, right->num, g, f->ctx);
    fmpz_mpoly_neg(right->num, right->num, f->ctx);
    fmpz_mpoly_clear(g, f->ctx);
    *u = left;
    *v = right;
}

/* Eliminates the pivot's column from the later rows by cross multiplication; the common factor of a row is divided out
 * at once, so that entries are never longer than minors of the matrix. */
static bool eliminate_next(matrix *m)
{
    nh_quotient_field *f = m->field;
    select_row(m);
    size_t p = select_column(m);
    if (p == m->n) return false;
    const nh_quotient **row = row_of(m, m->used), *u, *v;
    for (size_t i = m->used + 1; i < m->rows && fine(f); i++) {
        const nh_quotient **other = row_of(m, i);
        if (!other[p]) continue;
        balance(f, other[p], row[p], &u, &v);
        for (size_t j = 0; j < m->n && fine(f); j++) other[j] = j == p ? NULL : combine(f, u, other[j], v, row[j]);
        if (!fine(f) || !make_sparse_primitive(f, m->n, other)) return false;
    }
    m->pivot[m->used++] = p;
    return fine(f);
}

/* Solves row_p c_p = -sum_j row_j c_j from the last row to the first; the column without pivot starts with c = 1. */
static bool substitute_back(matrix *m, const nh_quotient **c)
{
    nh_quotient_field *f = m->field;
    bool *pivots = nh_alloc_array(m->n, sizeof *pivots);
    for (size_t i = 0; i < m->rows; i++) pivots[m->pivot[i]] = true;
    for (size_t j = 0; j < m->n; j++) c[j] = pivots[j] ? NULL : nh_quotient_number(f, nh_num_int(1));
    nh_free(pivots);
    for (size_t i = m->rows; i-- > 0 && fine(f);) {
        const nh_quotient **row = row_of(m, i), *sum = NULL, *one = nh_quotient_number(f, nh_num_int(1)), *scale, *own;
        size_t p = m->pivot[i];
        for (size_t j = 0; j < m->n; j++) sum = combine(f, sum, one, row[j], c[j]); /* c_p is still NULL */
        if (!sum || !fine(f)) return false; /* the support holds only the nonzero entries */
        const nh_quotient *both[2] = {sum, row[p]};
        if (!nh_relation_clear_denominators(f, 2, both)) return false;
        balance(f, both[0], both[1], &scale, &own);
        for (size_t j = 0; j < m->n; j++)
            if (c[j]) c[j] = nh_quotient_mul(f, c[j], scale);
        c[p] = own;
        if (!fine(f) || !make_sparse_primitive(f, m->n, c)) return false;
    }
    return fine(f);
}

/* ---- the simplest multiple of the vector ---- */

/* The terms of all entries, which polish makes few. */
static double length_of(const nh_quotient_field *f, size_t n, const nh_quotient *const *q)
{
    double length = 0;
    for (size_t j = 0; j < n; j++)
        length += (double)nh_quotient_terms(q[j]) + (double)fmpz_mpoly_total_degree_si(q[j]->num, f->ctx);
    return length;
}

static bool has_relations(const nh_quotient_field *f, size_t n, const nh_quotient *const *q)
{
    for (size_t j = 0; j < n; j++)
        for (size_t i = 0; i < f->relations; i++)
            if (nh_quotient_has(f, q[j], (size_t)f->relation[i].generator)) return true;
    return false;
}

/* (r, r^2) is (1, r): with roots a common factor may be hidden, and is found by dividing by one entry after the
 * other. */
static bool polish(nh_quotient_field *f, size_t n, const nh_quotient **c)
{
    const nh_quotient **raw = nh_alloc_array(n, sizeof *raw), **trial = nh_alloc_array(n, sizeof *trial);
    memcpy(raw, c, n * sizeof *c);
    bool good = nh_relation_make_primitive(f, n, c);
    bool hidden = good && has_relations(f, n, c);
    for (size_t pivot = 0; pivot < n && hidden && fine(f); pivot++) {
        const nh_quotient *inverse = nh_quotient_rationalise(f, nh_quotient_inv(f, raw[pivot]));
        for (size_t j = 0; j < n; j++) trial[j] = nh_quotient_rationalise(f, nh_quotient_mul(f, raw[j], inverse));
        if (nh_relation_make_primitive(f, n, trial) && length_of(f, n, trial) < length_of(f, n, c))
            memcpy(c, trial, n * sizeof *c);
    }
    nh_free(raw);
    nh_free(trial);
    return good && fine(f);
}

/* ---- the whole ---- */

/* The vector on the support, compact. */
static bool solve_support(nh_relation_rows *rows, const size_t *column, size_t n, const size_t *chosen,
                          const nh_quotient **c)
{
    matrix m = {.field = rows->system->field, .n = n, .rows = n - 1};
    m.entry = nh_alloc_array(n * n, sizeof *m.entry);
    m.pivot = nh_alloc_array(n, sizeof *m.pivot);
    for (size_t i = 0; i < m.rows; i++)
        for (size_t j = 0; j < n; j++) row_of(&m, i)[j] = nh_relation_rows_entry(rows, chosen[i], column[j]);
    bool good = true;
    for (size_t i = 0; i < m.rows && good; i++) good = make_sparse_primitive(m.field, n, row_of(&m, i));
    while (good && m.used < m.rows) good = eliminate_next(&m);
    good = good && substitute_back(&m, c) && polish(m.field, n, c);
    nh_free(m.entry);
    nh_free(m.pivot);
    return good;
}

bool nh_relation_solve_rows(nh_relation_rows *rows, const size_t *chosen, const nh_quotient **c)
{
    size_t n = rows->system->n, *column = nh_alloc_array(n + 1, sizeof *column);
    for (size_t j = 0; j < n; j++) column[j] = j;
    bool good = solve_support(rows, column, n, chosen, c);
    nh_free(column);
    return good;
}

/* sum_j c_j N_j = 0 */
static bool verify(const nh_relation_system *s, const nh_quotient *const *c)
{
    nh_quotient_field *f = s->field;
    const nh_quotient *sum = nh_quotient_number(f, nh_num_int(0));
    for (size_t j = 0; j < s->n && fine(f); j++)
        if (c[j]) sum = nh_quotient_add(f, sum, nh_quotient_mul(f, c[j], s->value[j]));
    return fine(f) && nh_quotient_is_zero(f, sum);
}

/* At some point the rank is one less than the unknowns: a relation that is found is the only one. */
static bool solve_unique(nh_relation_rows *rows, bool *support, size_t *chosen, const nh_quotient **c)
{
    const nh_relation_system *s = rows->system;
    size_t n = 0, *column = nh_alloc_array(s->n, sizeof *column);
    const nh_quotient **compact = nh_alloc_array(s->n, sizeof *compact);
    for (size_t j = 0; j < s->n; j++)
        if (support[j]) column[n++] = j;
    bool good =
        nh_relation_rows_rank(rows, support, chosen) == n - 1 && solve_support(rows, column, n, chosen, compact);
    for (size_t j = 0; j < s->n; j++) c[j] = NULL;
    for (size_t j = 0; j < n && good; j++) c[column[j]] = compact[j];
    nh_free(column);
    nh_free(compact);
    return good && verify(s, c);
}

/* The rank at a point is never above the true one: full rank and, once there is a relation, one less are certain.  A
 * lower rank is accepted when two points agree. */
nh_relation_verdict nh_relation_solve(const nh_relation_system *system, const nh_quotient **c)
{
    size_t n = system->n, several = 0, *chosen = nh_alloc_array(n + 1, sizeof *chosen);
    bool *support = nh_alloc_array(n, sizeof *support);
    nh_relation_verdict verdict = NH_RELATION_TOO_LARGE;
    nh_relation_rows rows;
    nh_relation_rows_init(&rows, system);
    for (int i = 0; i < points && verdict == NH_RELATION_TOO_LARGE && fine(system->field); i++) {
        if (!nh_relation_rows_choose_point(&rows)) break;
        memset(support, 1, n * sizeof *support);
        size_t rank = nh_relation_rows_rank(&rows, support, chosen);
        if (rank == n) verdict = NH_RELATION_NONE;
        else if (rank + 1 < n && ++several == points) verdict = NH_RELATION_SEVERAL;
        else if (rank + 1 == n && solve_unique(&rows, support, chosen, c)) verdict = NH_RELATION_UNIQUE;
    }
    nh_relation_rows_clear(&rows);
    nh_free(support);
    nh_free(chosen);
    return verdict;
}
