/* The staircase algorithm modulo a prime, with FLINT's echelon forms and characteristic polynomial. */
#include "integrals/staircase.h"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>

#include "base/memory.h"
#include "base/progress.h"
#include "integrals/sparse_pencil.h"

/* A + lambda E */
typedef struct {
    nmod_mat_t A, E;
} matrices;

static ulong prime_of(const matrices *m) { return m->A->mod.n; }

static void replace(matrices *m, nmod_mat_t A, nmod_mat_t E)
{
    nmod_mat_swap(m->A, A);
    nmod_mat_swap(m->E, E);
    nmod_mat_clear(A);
    nmod_mat_clear(E);
}

/* ---- the pencil as matrices ---- */

static void add_to(nmod_mat_t m, size_t row, size_t column, nh_residue value)
{
    nmod_mat_entry(m, row, column) = n_addmod(nmod_mat_entry(m, row, column), value, m->mod.n);
}

static void fill(const nh_sparse_pencil *p, nh_prime f, matrices *m)
{
    nmod_mat_init(m->A, (slong)p->rows, (slong)p->columns, f.p);
    nmod_mat_init(m->E, (slong)p->rows, (slong)p->columns, f.p);
    for (size_t k = 0; k < p->entries; k++)
        add_to(p->entry[k].power ? m->E : m->A, p->entry[k].row, p->entry[k].column, p->entry[k].value);
}

/* ---- constant equations ---- */

static bool row_is_zero(const nmod_mat_t m, slong row, slong from, slong to)
{
    for (slong j = from; j < to; j++)
        if (nmod_mat_entry(m, row, j)) return false;
    return true;
}

/* M := the columns `open` of M without what the constant equations C (reduced, with these pivots) replace. */
static void substitute_in(nmod_mat_t M, const nmod_mat_t C, slong pivots, const slong *pivot, slong opens,
                          const slong *open)
{
    ulong p = M->mod.n;
    slong rows = nmod_mat_nrows(M);
    nmod_mat_t out, of_pivots, rest, product;
    nmod_mat_init(out, rows, opens, p);
    nmod_mat_init(of_pivots, rows, pivots, p);
    nmod_mat_init(rest, pivots, opens, p);
    nmod_mat_init(product, rows, opens, p);
    for (slong i = 0; i < rows; i++) {
        for (slong j = 0; j < opens; j++) nmod_mat_entry(out, i, j) = nmod_mat_entry(M, i, open[j]);
        for (slong j = 0; j < pivots; j++) nmod_mat_entry(of_pivots, i, j) = nmod_mat_entry(M, i, pivot[j]);
    }
    for (slong i = 0; i < pivots; i++)
        for (slong j = 0; j < opens; j++) nmod_mat_entry(rest, i, j) = nmod_mat_entry(C, i, open[j]);
    if (rows && opens && pivots) {
        nmod_mat_mul(product, of_pivots, rest);
        nmod_mat_sub(out, out, product);
    }
    nmod_mat_swap(M, out);
    nmod_mat_clear(product);
    nmod_mat_clear(rest);
    nmod_mat_clear(of_pivots);
    nmod_mat_clear(out);
}

/* C y = 0, in reduced echelon form with `rank` rows: its pivots leave the pencil. */
static void use_constants(matrices *m, const nmod_mat_t C, slong rank)
{
    slong columns = nmod_mat_ncols(C), opens = 0;
    slong *pivot = nh_alloc_array((size_t)rank + 1, sizeof *pivot), *open = nh_alloc_array((size_t)columns + 1,
        sizeof *open);
    for (slong j = 0, i = 0; j < columns; j++) {
        if (i < rank && nmod_mat_entry(C, i, j)) pivot[i++] = j;
        else open[opens++] = j;
    }
    substitute_in(m->A, C, rank, pivot, opens, open);
    substitute_in(m->E, C, rank, pivot, opens, open);
    nh_free(open);
    nh_free(pivot);
}

static void copy_rows(nmod_mat_t to, const nmod_mat_t from, slong first, slong column)
{
    for (slong i = 0; i < nmod_mat_nrows(to); i++)
        for (slong j = 0; j < nmod_mat_ncols(to); j++)
            nmod_mat_entry(to, i, j) = nmod_mat_entry(from, first + i, column + j);
}

/* Equations without lambda as they stand: most of them, and sparse matrices stay small. */
static void constant_rows(matrices *m)
{
    slong rows = nmod_mat_nrows(m->A), columns = nmod_mat_ncols(m->A), constant = 0, other = 0;
    for (slong i = 0; i < rows; i++) constant += row_is_zero(m->E, i, 0, columns);
    nmod_mat_t C, A, E;
    nmod_mat_init(C, constant, columns, prime_of(m));
    nmod_mat_init(A, rows - constant, columns, prime_of(m));
    nmod_mat_init(E, rows - constant, columns, prime_of(m));
    constant = 0;
    for (slong i = 0; i < rows; i++) {
        bool is_constant = row_is_zero(m->E, i, 0, columns);
        for (slong j = 0; j < columns; j++) {
            nmod_mat_entry(is_constant ? C : A, is_constant ? constant : other, j) = nmod_mat_entry(m->A, i, j);
            if (!is_constant) nmod_mat_entry(E, other, j) = nmod_mat_entry(m->E, i, j);
        }
        constant += is_constant;
        other += !is_constant;
    }
    replace(m, A, E);
    slong rank = constant ? nmod_mat_rref(C) : 0;
    use_constants(m, C, rank);
    nmod_mat_clear(C);
}

/* Echelon form of [E | A]: independent rows, and constant equations, whose number is returned. */
static slong row_step(matrices *m)
{
    slong rows = nmod_mat_nrows(m->A), columns = nmod_mat_ncols(m->A), rank, moving = 0;
    if (!rows || !columns) return 0;
    nmod_mat_t W, A, E, C;
    nmod_mat_init(W, rows, 2 * columns, prime_of(m));
    for (slong i = 0; i < rows; i++)
        for (slong j = 0; j < columns; j++) {
            nmod_mat_entry(W, i, j) = nmod_mat_entry(m->E, i, j);
            nmod_mat_entry(W, i, columns + j) = nmod_mat_entry(m->A, i, j);
        }
    rank = nmod_mat_rref(W);
    while (moving < rank && !row_is_zero(W, moving, 0, columns)) moving++;
    nmod_mat_init(E, moving, columns, prime_of(m));
    nmod_mat_init(A, moving, columns, prime_of(m));
    nmod_mat_init(C, rank - moving, columns, prime_of(m));
    copy_rows(E, W, 0, 0);
    copy_rows(A, W, 0, columns);
    copy_rows(C, W, moving, columns);
    nmod_mat_clear(W);
    replace(m, A, E);
    use_constants(m, C, rank - moving);
    nmod_mat_clear(C);
    return rank - moving;
}

static void transpose(matrices *m)
{
    nmod_mat_t A, E;
    nmod_mat_init(A, nmod_mat_ncols(m->A), nmod_mat_nrows(m->A), prime_of(m));
    nmod_mat_init(E, nmod_mat_ncols(m->A), nmod_mat_nrows(m->A), prime_of(m));
    nmod_mat_transpose(A, m->A);
    nmod_mat_transpose(E, m->E);
    replace(m, A, E);
}

static void reduce(matrices *m)
{
    constant_rows(m);
    for (bool changed = true; changed && nmod_mat_nrows(m->A) && nmod_mat_ncols(m->A) && !nh_late();) {
        slong rows = nmod_mat_nrows(m->A), columns = nmod_mat_ncols(m->A);
        while (row_step(m) > 0) {}
        transpose(m);
        while (row_step(m) > 0) {}
        transpose(m);
        changed = nmod_mat_nrows(m->A) != rows || nmod_mat_ncols(m->A) != columns;
    }
}

/* ---- results ---- */

bool nh_staircase(const nh_sparse_pencil *p, nh_prime f, nh_residue_polynomial *out)
{
    matrices m;
    nmod_mat_t X;
    nmod_poly_t chi;
    nh_sparse_pencil small = nh_sparse_pencil_reduce(p, f);
    fill(&small, f, &m);
    nh_free(small.entry);
    reduce(&m);
    slong k = nmod_mat_ncols(m.A);
    bool none = !k || !nmod_mat_nrows(m.A), solved = !nh_late() && (none || nmod_mat_nrows(m.A) == k);
    nmod_poly_init(chi, f.p);
    nmod_poly_one(chi);
    if (solved && !none) {
        nmod_mat_init(X, k, k, f.p);
        solved = nmod_mat_solve(X, m.E, m.A);
        if (solved) nmod_mat_neg(X, X);
        if (solved) nmod_mat_charpoly(chi, X);
        nmod_mat_clear(X);
    }
    out->degree = (size_t)nmod_poly_degree(chi);
    out->coefficient = nh_alloc_array(out->degree + 1, sizeof *out->coefficient);
    for (size_t j = 0; j <= out->degree; j++) out->coefficient[j] = (nh_residue)nmod_poly_get_coeff_ui(chi, (slong)j);
    nmod_poly_clear(chi);
    nmod_mat_clear(m.A);
    nmod_mat_clear(m.E);
    return solved;
}

size_t nh_staircase_rank(const nh_sparse_pencil *p, nh_prime f, nh_residue lambda)
{
    nmod_mat_t m;
    nmod_mat_init(m, (slong)p->rows, (slong)p->columns, f.p);
    for (size_t k = 0; k < p->entries; k++)
        add_to(m, p->entry[k].row, p->entry[k].column, nh_residue_mul(f, p->entry[k].value,
            nh_residue_power(f, lambda, p->entry[k].power)));
    size_t rank = (size_t)nmod_mat_rank(m);
    nmod_mat_clear(m);
    return rank;
}
