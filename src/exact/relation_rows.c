/* The equations of a relation: N_j = sum_m a_mj m gives, for each monomial m in the variable kernels, one row of a_mj
 * in K.
 *
 *               column  N_1     N_2     N_3         terms sorted by monomial, then column: a row is a stretch
 *      row  x^2 y      2 m        .     -k          [first, last) of the list, and an entry a stretch of a row
 *           x y          .      k^2      m          (nothing is stored for zeros)
 *           1            1       -m       .
 *
 * The rank over K is that at a random point of the parameters modulo a prime, or larger. A point has to satisfy the
 * relations of the constant kernels (r^n = A/B, sin^2 + cos^2 = 1): free ones get random residues, roots are taken
 * modulo the prime, and a point without a root is given up for another. Rows enter the elimination sparsest first,
 * because those that are chosen are the system that is solved over K afterwards. */
#include "exact/relation_rows.h"

#include <stdlib.h>
#include <string.h>

#include "base/budget.h"
#include "exact/normal_quotient_internal.h"
#include "graph/num.h"

#include <flint/nmod.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <flint/nmod_vec.h>
#include <flint/ulong_extras.h>

/* Random values have their roots with probability about 1/2 each: enough attempts for a dozen roots. */
enum { most_attempts = 20000 };

/* ---- equations ---- */

/* The terms of N_column; each keeps the exponents of the variable generators only (`width` of them). */
static void read_terms(nh_relation_rows *r, size_t column)
{
    nh_quotient_field *f = r->system->field;
    const fmpz_mpoly_struct *p = r->system->value[column]->num;
    for (slong i = 0; i < p->length; i++) {
        uint32_t *monomial = r->exponent + r->terms * r->width;
        size_t used = 0;
        fmpz_mpoly_get_term_exp_ui(f->exponent, p, i, f->ctx);
        for (slong g = 0; g < f->generators; g++)
            if (!r->system->constant[g]) monomial[used++] = (uint32_t)f->exponent[g];
        r->term[r->terms++] = (nh_relation_term){.column = column, .index = i, .monomial = monomial};
    }
}

static int by_monomial(const void *left, const void *right, void *width)
{
    const nh_relation_term *a = left, *b = right;
    for (size_t i = 0; i < *(const size_t *)width; i++)
        if (a->monomial[i] != b->monomial[i]) return a->monomial[i] < b->monomial[i] ? -1 : 1;
    if (a->column != b->column) return a->column < b->column ? -1 : 1;
    return a->index < b->index ? -1 : a->index > b->index;
}

void nh_relation_rows_init(nh_relation_rows *rows, const nh_relation_system *system)
{
    size_t terms = 0, generators = (size_t)system->field->generators;
    *rows = (nh_relation_rows){.system = system, .prime = (uint64_t)1 << 60};
    for (size_t g = 0; g < generators; g++) rows->width += !system->constant[g];
    for (size_t j = 0; j < system->n; j++) terms += (size_t)system->value[j]->num->length;
    rows->exponent = nh_alloc_array(terms * rows->width + 1, sizeof *rows->exponent);
    rows->term = nh_alloc_array(terms + 1, sizeof *rows->term);
    rows->row = nh_alloc_array(terms + 1, sizeof *rows->row);
    rows->value = nh_alloc_array(generators, sizeof *rows->value);
    for (size_t j = 0; j < system->n; j++) read_terms(rows, j);
    qsort_r(rows->term, terms, sizeof *rows->term, by_monomial, &rows->width);
    for (size_t i = 0; i < terms; i++) {
        const uint32_t *m = rows->term[i].monomial;
        bool same = i && !memcmp(m, rows->term[i - 1].monomial, rows->width * sizeof *m);
        if (!same) rows->row[rows->rows++].first = i;
        rows->row[rows->rows - 1].last = i + 1;
    }
}

void nh_relation_rows_clear(nh_relation_rows *rows)
{
    nh_free(rows->exponent);
    nh_free(rows->term);
    nh_free(rows->row);
    nh_free(rows->value);
    *rows = (nh_relation_rows){0};
}

/* The terms are in the order of the polynomial, and stay so when the variables that they share are dropped. */
const nh_quotient *nh_relation_rows_entry(const nh_relation_rows *rows, size_t row, size_t column)
{
    nh_quotient_field *f = rows->system->field;
    nh_quotient *q = NULL;
    fmpz_t c;
    fmpz_init(c);
    for (size_t i = rows->row[row].first; i < rows->row[row].last; i++) {
        const nh_relation_term *t = &rows->term[i];
        if (t->column != column) continue;
        if (!q) q = (nh_quotient *)nh_quotient_number(f, nh_num_int(0)); /* new, and not shared yet */
        const fmpz_mpoly_struct *p = rows->system->value[column]->num;
        fmpz_mpoly_get_term_exp_ui(f->exponent, p, t->index, f->ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, t->index, f->ctx);
        for (slong g = 0; g < f->generators; g++)
            if (!rows->system->constant[g]) f->exponent[g] = 0;
        fmpz_mpoly_push_term_fmpz_ui(q->num, c, f->exponent, f->ctx);
    }
    fmpz_clear(c);
    return q;
}

/* ---- a point ---- */

/* The constant part of a term at the point: its integer coefficient times powers of the constant generators. */
static ulong term_residue(nh_relation_rows *r, nmod_t mod, const fmpz_mpoly_struct *p, slong i)
{
    nh_quotient_field *f = r->system->field;
    fmpz_t c;
    fmpz_init(c);
    fmpz_mpoly_get_term_exp_ui(f->exponent, p, i, f->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(c, p, i, f->ctx);
    ulong v = fmpz_fdiv_ui(c, mod.n);
    fmpz_clear(c);
    for (slong g = 0; g < f->generators; g++)
        if (r->system->constant[g] && f->exponent[g])
            v = nmod_mul(v, nmod_pow_ui(r->value[g], f->exponent[g], mod), mod);
    return v;
}

static ulong residue(nh_relation_rows *r, nmod_t mod, const fmpz_mpoly_struct *p)
{
    ulong v = 0;
    for (slong i = 0; i < p->length; i++) v = nmod_add(v, term_residue(r, mod, p, i), mod);
    return v;
}

/* An x with x^order = a, if there is one. */
static bool modular_root(ulong a, ulong order, nmod_t mod, ulong *x)
{
    *x = a;
    if (order == 1 || a == 0) return true;
    if (order == 2) return (*x = n_sqrtmod(a, mod.n)) != 0;
    nmod_poly_t p;
    nmod_poly_factor_t roots;
    nmod_poly_init_mod(p, mod);
    nmod_poly_factor_init(roots);
    nmod_poly_set_coeff_ui(p, (slong)order, 1);
    nmod_poly_set_coeff_ui(p, 0, nmod_neg(a, mod));
    nmod_poly_roots(roots, p, 0);
    bool found = roots->num > 0;
    if (found) *x = nmod_neg(nmod_poly_get_coeff_ui(roots->p, 0), mod);
    nmod_poly_factor_clear(roots);
    nmod_poly_clear(p);
    return found;
}

/* The values of relations contain earlier generators only. */
static bool satisfy(nh_relation_rows *r, nmod_t mod)
{
    const nh_quotient_field *f = r->system->field;
    for (size_t i = 0; i < f->relations; i++) {
        const nh_relation *x = &f->relation[i];
        if (!r->system->constant[x->generator]) continue;
        ulong den = residue(r, mod, x->den), root;
        if (!den) return false;
        ulong a = nmod_mul(residue(r, mod, x->num), nmod_inv(den, mod), mod);
        if (!modular_root(a, x->order, mod, &root)) return false;
        r->value[x->generator] = root;
    }
    return true;
}

/* SplitMix64: the same numbers for the same system. */
static uint64_t next_random(nh_relation_rows *r)
{
    uint64_t z = r->random += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return z ^ z >> 31;
}

bool nh_relation_rows_choose_point(nh_relation_rows *rows)
{
    const nh_relation_system *s = rows->system;
    nmod_t mod;
    bool good = false;
    for (int attempt = 0; attempt < most_attempts && !good; attempt++) {
        rows->prime = n_nextprime(rows->prime, 0);
        nmod_init(&mod, rows->prime);
        for (slong g = 0; g < s->field->generators; g++) rows->value[g] = 1 + next_random(rows) % (rows->prime - 1);
        good = satisfy(rows, mod);
    }
    for (size_t i = 0; i < rows->terms && good; i++) {
        nh_relation_term *t = &rows->term[i];
        t->residue = term_residue(rows, mod, s->value[t->column]->num, t->index);
    }
    return good;
}

/* ---- rank ---- */

/* Rows in reduced echelon form. */
typedef struct {
    nmod_t mod;
    size_t n, rank;
    ulong *row;
    size_t *pivot;
} echelon;

static void subtract(echelon *e, ulong *from, ulong factor, const ulong *row)
{
    if (factor) _nmod_vec_scalar_addmul_nmod(from, row, (slong)e->n, nmod_neg(factor, e->mod), e->mod);
}

/* v, `width` residues, reduced by the rows before; if something remains, it becomes a row of the echelon form. */
static bool insert(echelon *e, ulong *v)
{
    nh_work_add(NH_WORK_RESIDUE, (double)e->rank * (double)e->n);
    for (size_t i = 0; i < e->rank; i++) subtract(e, v, v[e->pivot[i]], e->row + i * e->n);
    size_t p = 0;
    while (p < e->n && !v[p]) p++;
    if (p == e->n) return false;
    _nmod_vec_scalar_mul_nmod(v, v, (slong)e->n, nmod_inv(v[p], e->mod), e->mod);
    for (size_t i = 0; i < e->rank; i++) subtract(e, e->row + i * e->n, e->row[i * e->n + p], v);
    memcpy(e->row + e->rank * e->n, v, e->n * sizeof *v);
    e->pivot[e->rank++] = p;
    return true;
}

/* For each row: how many columns of the support it has, and how many terms. */
static void weigh(nh_relation_rows *r, const bool *support)
{
    for (size_t i = 0; i < r->rows; i++) {
        nh_relation_row *row = &r->row[i];
        size_t last = SIZE_MAX;
        row->columns = row->terms = 0;
        for (size_t t = row->first; t < row->last; t++) {
            size_t column = r->term[t].column;
            if (!support[column]) continue;
            row->terms++;
            row->columns += column != last;
            last = column;
        }
    }
}

static int by_weight(const void *left, const void *right)
{
    const nh_relation_row *a = left, *b = right;
    if (a->columns != b->columns) return a->columns < b->columns ? -1 : 1;
    if (a->terms != b->terms) return a->terms < b->terms ? -1 : 1;
    return a->first < b->first ? -1 : a->first > b->first;
}

/* The vector with c_f = 1 of a free column f is c_pivot = -row_f. */
static void narrow(const echelon *e, size_t free_column, bool *support)
{
    memset(support, 0, e->n * sizeof *support);
    for (size_t i = 0; i < e->rank; i++) support[e->pivot[i]] = e->row[i * e->n + free_column] != 0;
    support[free_column] = true;
}

static size_t count_columns(size_t n, const bool *support)
{
    size_t count = 0;
    for (size_t j = 0; j < n; j++) count += support[j];
    return count;
}

/* Takes the rows from the sparsest on, until there are as many as columns: which ones, and for each column whether it
 * has a pivot. */
static echelon reduce(nh_relation_rows *rows, const bool *support, size_t *chosen, bool *pivots)
{
    size_t n = rows->system->n, wanted = count_columns(n, support);
    echelon e = {
        .n = n, .row = nh_alloc_array((n + 1) * n, sizeof *e.row), .pivot = nh_alloc_array(n + 1, sizeof *e.pivot)};
    nmod_init(&e.mod, rows->prime);
    weigh(rows, support);
    qsort(rows->row, rows->rows, sizeof *rows->row, by_weight);
    for (size_t i = 0; i < rows->rows && e.rank < wanted; i++) {
        ulong *v = e.row + n * n; /* scratch */
        memset(v, 0, n * sizeof *v);
        for (size_t t = rows->row[i].first; t < rows->row[i].last; t++) {
            const nh_relation_term *x = &rows->term[t];
            if (support[x->column]) v[x->column] = nmod_add(v[x->column], x->residue, e.mod);
        }
        if (insert(&e, v)) chosen[e.rank - 1] = i;
    }
    for (size_t i = 0; i < e.rank; i++) pivots[e.pivot[i]] = true;
    return e;
}

static void finish(echelon *e, bool *pivots)
{
    nh_free(e->row);
    nh_free(e->pivot);
    nh_free(pivots);
}

size_t nh_relation_rows_rank(nh_relation_rows *rows, bool *support, size_t *chosen)
{
    size_t n = rows->system->n, wanted = count_columns(n, support), free_column = 0;
    bool *pivots = nh_alloc_array(n + 1, sizeof *pivots);
    echelon e = reduce(rows, support, chosen, pivots);
    if (e.rank + 1 == wanted) {
        while (pivots[free_column] || !support[free_column]) free_column++;
        narrow(&e, free_column, support);
    }
    finish(&e, pivots);
    return e.rank;
}

bool nh_relation_rows_last(nh_relation_rows *rows, bool *support)
{
    size_t n = rows->system->n, *chosen = nh_alloc_array(n + 1, sizeof *chosen);
    bool *pivots = nh_alloc_array(n + 1, sizeof *pivots);
    for (size_t j = 0; j < n; j++) support[j] = true;
    echelon e = reduce(rows, support, chosen, pivots);
    bool depends = !pivots[n - 1];
    if (depends) narrow(&e, n - 1, support);
    nh_free(chosen);
    finish(&e, pivots);
    return depends;
}
