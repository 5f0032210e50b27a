/* The staircase algorithm modulo a prime (staircase.h, [VanDooren1979]), with FLINT's echelon forms and
 * characteristic polynomial; determinants of what it leaves of two parameters.
 *
 *      [  E  |  A  ]   row echelon     [ E' | A' ]     moving rows: they have a part in E
 *                      ----------->    [ 0  | C  ]     constant equations C y = 0, substituted in E' and A'
 *
 *      until no constant row is left; then the transposes, for columns; until neither changes anything:
 *      E square and invertible, chi(lambda) = det(lambda + E^-1 A)
 *
 * Each step leaves the rank of A(lambda) less the number of pivots as it was, for every lambda. First those equations
 * go that contain no parameter from the start: they are most equations. */
#include "classify/staircase.h"

#include <flint/nmod_mat.h>
#include <flint/nmod_poly.h>
#include <flint/ulong_extras.h>
#include <math.h>

#include "base/memory.h"
#include "base/progress.h"

/* The coefficients of the powers of the parameter, the constant one first. */
typedef struct {
    size_t count, used; /* used: rank that was eliminated from them */
    nmod_mat_t *m;
} matrices;

static ulong prime_of(const matrices *x) { return x->m[0]->mod.n; }
static slong rows_of(const matrices *x) { return nmod_mat_nrows(x->m[0]); }
static slong columns_of(const matrices *x) { return nmod_mat_ncols(x->m[0]); }

static matrices zeros(size_t count, slong rows, slong columns, ulong p)
{
    matrices x = {.count = count, .m = nh_alloc_array(count, sizeof *x.m)};
    for (size_t k = 0; k < count; k++) nmod_mat_init(x.m[k], rows, columns, p);
    return x;
}

static void clear(matrices *x)
{
    for (size_t k = 0; k < x->count; k++) nmod_mat_clear(x->m[k]);
    nh_free(x->m);
}

static void replace(matrices *x, matrices by)
{
    by.used = x->used;
    clear(x);
    *x = by;
}

/* ---- the pencil as matrices ---- */

/* m_ij += value. */
static void add_to(nmod_mat_t m, size_t row, size_t column, nh_residue value)
{
    nmod_mat_entry(m, row, column) = n_addmod(nmod_mat_entry(m, row, column), value, m->mod.n);
}

/* One dense matrix for each power lambda^i mu^j, at i + (degree + 1) j. */
static matrices matrices_of(const nh_sparse_pencil *p, nh_prime f)
{
    matrices x = zeros((p->degree + 1) * (p->second + 1), (slong)p->rows, (slong)p->columns, f.p);
    for (size_t k = 0; k < p->entries; k++)
        add_to(x.m[p->entry[k].power], p->entry[k].row, p->entry[k].column, p->entry[k].value);
    return x;
}

/* ---- constant equations ---- */

static bool row_is_zero(const nmod_mat_t m, slong row, slong from, slong to)
{
    for (slong j = from; j < to; j++)
        if (nmod_mat_entry(m, row, j)) return false;
    return true;
}

/* M := the columns `open` of M, with the eliminated columns replaced by the constant equations C (reduced, with these
 * pivots). */
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

/* Eliminates by the equations C y = 0, in reduced echelon form with `rank` rows: their pivots leave the pencil. */
static void use_constants(matrices *x, const nmod_mat_t C, slong rank)
{
    slong columns = nmod_mat_ncols(C), opens = 0;
    slong *pivot = nh_alloc_array((size_t)rank + 1, sizeof *pivot),
          *open = nh_alloc_array((size_t)columns + 1, sizeof *open);
    for (slong j = 0, i = 0; j < columns; j++) {
        if (i < rank && nmod_mat_entry(C, i, j)) pivot[i++] = j;
        else open[opens++] = j;
    }
    for (size_t k = 0; k < x->count; k++) substitute_in(x->m[k], C, rank, pivot, opens, open);
    x->used += (size_t)rank;
    nh_free(open);
    nh_free(pivot);
}

static void copy_rows(nmod_mat_t to, const nmod_mat_t from, slong first, slong column)
{
    for (slong i = 0; i < nmod_mat_nrows(to); i++)
        for (slong j = 0; j < nmod_mat_ncols(to); j++)
            nmod_mat_entry(to, i, j) = nmod_mat_entry(from, first + i, column + j);
}

/* Does the row have no part in the matrices of any power but the first? */
static bool is_constant(const matrices *x, slong row)
{
    bool constant = true;
    for (size_t k = 1; k < x->count && constant; k++) constant = row_is_zero(x->m[k], row, 0, columns_of(x));
    return constant;
}

static void copy_row(nmod_mat_t to, slong row, const nmod_mat_t from, slong source)
{
    for (slong j = 0; j < nmod_mat_ncols(from); j++) nmod_mat_entry(to, row, j) = nmod_mat_entry(from, source, j);
}

/* Eliminates by those equations that contain no parameter from the start: they are most equations, and sparse matrices
 * stay small. */
static void constant_rows(matrices *x)
{
    slong rows = rows_of(x), columns = columns_of(x), constants = 0, constant = 0, other = 0;
    for (slong i = 0; i < rows; i++) constants += is_constant(x, i);
    nmod_mat_t C;
    nmod_mat_init(C, constants, columns, prime_of(x));
    matrices rest = zeros(x->count, rows - constants, columns, prime_of(x));
    for (slong i = 0; i < rows; i++) {
        if (is_constant(x, i)) {
            copy_row(C, constant++, x->m[0], i);
            continue;
        }
        for (size_t k = 0; k < x->count; k++) copy_row(rest.m[k], other, x->m[k], i);
        other++;
    }
    replace(x, rest);
    slong rank = constants ? nmod_mat_rref(C) : 0;
    use_constants(x, C, rank);
    nmod_mat_clear(C);
}

/* The echelon form of [.. | A_1 | A_0]: independent rows, and constant equations, whose number is returned. */
static slong row_step(matrices *x, double *products)
{
    slong rows = rows_of(x), columns = columns_of(x), rank, moving = 0, last = (slong)(x->count - 1) * columns;
    *products -= (double)rows * (double)rows * (double)columns * (double)x->count;
    if (!rows || !columns || *products < 0) return 0;
    nmod_mat_t W, C;
    nmod_mat_init(W, rows, (slong)x->count * columns, prime_of(x));
    for (slong i = 0; i < rows; i++)
        for (size_t k = 0; k < x->count; k++)
            for (slong j = 0; j < columns; j++)
                nmod_mat_entry(W, i, (k ? (slong)(k - 1) * columns : last) + j) = nmod_mat_entry(x->m[k], i, j);
    rank = nmod_mat_rref(W);
    while (moving < rank && !row_is_zero(W, moving, 0, last)) moving++;
    matrices rest = zeros(x->count, moving, columns, prime_of(x));
    for (size_t k = 0; k < x->count; k++) copy_rows(rest.m[k], W, 0, k ? (slong)(k - 1) * columns : last);
    nmod_mat_init(C, rank - moving, columns, prime_of(x));
    copy_rows(C, W, moving, last);
    nmod_mat_clear(W);
    replace(x, rest);
    use_constants(x, C, rank - moving);
    nmod_mat_clear(C);
    return rank - moving;
}

static void transpose(matrices *x)
{
    matrices t = zeros(x->count, columns_of(x), rows_of(x), prime_of(x));
    for (size_t k = 0; k < x->count; k++) nmod_mat_transpose(t.m[k], x->m[k]);
    replace(x, t);
}

/* Rows, columns, rows .. until nothing changes, the products are used up, or time is. */
static void reduce(matrices *x, double *products)
{
    constant_rows(x);
    for (bool changed = true; changed && rows_of(x) && columns_of(x) && *products >= 0 && !nh_late();) {
        slong rows = rows_of(x), columns = columns_of(x);
        while (row_step(x, products) > 0) {
        }
        transpose(x);
        while (row_step(x, products) > 0) {
        }
        transpose(x);
        changed = rows_of(x) != rows || columns_of(x) != columns;
    }
}

static matrices reduced(const nh_sparse_pencil *p, nh_prime f, double *products, size_t *degree)
{
    nh_sparse_pencil small = nh_sparse_pencil_reduce(p, f);
    matrices x = matrices_of(&small, f);
    *degree = small.degree;
    x.used = small.pivots;
    nh_free(small.entry);
    reduce(&x, products);
    return x;
}

/* ---- results ---- */

bool nh_staircase(const nh_sparse_pencil *p, nh_prime f, double *products, nh_residue_polynomial *out, size_t *nullity)
{
    nmod_mat_t X;
    nmod_poly_t chi;
    size_t degree;
    matrices x = reduced(p, f, products, &degree);
    slong k = columns_of(&x);
    bool none = !k || !rows_of(&x), solved;
    *products -= 2 * pow((double)k, 3);
    solved = *products >= 0 && !nh_late() && (none || rows_of(&x) == k);
    nmod_poly_init(chi, f.p);
    nmod_poly_one(chi);
    if (solved && !none) {
        nmod_mat_init(X, k, k, f.p);
        solved = nmod_mat_solve(X, x.m[1], x.m[0]);
        if (solved) nmod_mat_neg(X, X);
        if (solved) nmod_mat_charpoly(chi, X);
        nmod_mat_clear(X);
    }
    *out = (nh_residue_polynomial){.degree = {(size_t)nmod_poly_degree(chi)}};
    out->coefficient = nh_alloc_array(out->degree[0] + 1, sizeof *out->coefficient);
    for (size_t j = 0; j <= out->degree[0]; j++)
        out->coefficient[j] = (nh_residue)nmod_poly_get_coeff_ui(chi, (slong)j);
    nmod_poly_clear(chi);
    *nullity = p->columns * (p->degree ? p->degree : 1) - x.used - (none ? 0 : (size_t)k); /* with companions */
    clear(&x);
    return solved;
}

nh_staircase_matrices nh_staircase_reduce(const nh_sparse_pencil *p, nh_prime f, double *products)
{
    size_t degree;
    matrices x = reduced(p, f, products, &degree);
    size_t rows = (size_t)rows_of(&x), columns = (size_t)columns_of(&x), at = 0;
    nh_staircase_matrices out = {.degree = degree,
                                 .second = p->second,
                                 .rows = rows,
                                 .columns = columns,
                                 .entry = nh_alloc_array(x.count * rows * columns + 1, sizeof *out.entry)};
    for (size_t k = 0; k < x.count; k++)
        for (size_t i = 0; i < rows; i++)
            for (size_t j = 0; j < columns; j++) out.entry[at++] = (nh_residue)nmod_mat_entry(x.m[k], i, j);
    clear(&x);
    return out;
}

size_t nh_staircase_rank(const nh_sparse_pencil *p, nh_prime f, nh_residue lambda)
{
    nmod_mat_t m;
    nmod_mat_init(m, (slong)p->rows, (slong)p->columns, f.p);
    for (size_t k = 0; k < p->entries; k++)
        add_to(m, p->entry[k].row, p->entry[k].column,
               nh_residue_mul(f, p->entry[k].value, nh_residue_power(f, lambda, p->entry[k].power)));
    size_t rank = (size_t)nmod_mat_rank(m);
    nmod_mat_clear(m);
    return rank;
}

/* ---- determinants of compressions: polynomials in lambda at values of mu, interpolated ---- */

/* The compressed coefficients of lambda^i at one mu: degree + 1 matrices. */
typedef struct {
    size_t degree;
    slong size;
    nmod_mat_t *m;
} square;

/* sum += a times m */
static void add_multiple(nmod_mat_t sum, nh_prime f, nh_residue a, const nh_residue *m)
{
    slong columns = nmod_mat_ncols(sum);
    for (slong i = 0; i < nmod_mat_nrows(sum); i++)
        for (slong j = 0; j < columns; j++)
            nmod_mat_entry(sum, i, j) =
                nh_residue_add(f, (nh_residue)nmod_mat_entry(sum, i, j), nh_residue_mul(f, a, m[i * columns + j]));
}

size_t nh_staircase_generic_rank(const nh_staircase_matrices *m, nh_prime f)
{
    uint64_t random = 424242;
    nmod_mat_t sum;
    nh_residue lambda = nh_residue_random(f, &random), mu = nh_residue_random(f, &random);
    nmod_mat_init(sum, (slong)m->rows, (slong)m->columns, f.p);
    for (size_t k = 0; k < (m->degree + 1) * (m->second + 1); k++) {
        nh_residue power = nh_residue_mul(f, nh_residue_power(f, lambda, k % (m->degree + 1)),
                                          nh_residue_power(f, mu, k / (m->degree + 1)));
        add_multiple(sum, f, power, m->entry + k * m->rows * m->columns);
    }
    size_t rank = (size_t)nmod_mat_rank(sum);
    nmod_mat_clear(sum);
    return rank;
}

static void fill_random(nmod_mat_t m, nh_prime f, uint64_t *random)
{
    for (slong i = 0; i < nmod_mat_nrows(m); i++)
        for (slong j = 0; j < nmod_mat_ncols(m); j++) nmod_mat_entry(m, i, j) = nh_residue_random(f, random);
}

/* The matrix at a value of lambda. */
static void at_lambda(const square *s, nh_residue lambda, nmod_mat_t out)
{
    nmod_mat_zero(out);
    for (size_t i = s->degree + 1; i-- > 0;) {
        nmod_mat_scalar_mul(out, out, lambda);
        nmod_mat_add(out, out, s->m[i]);
    }
}

/* Interpolates from degree x size + 1 determinants. */
static void by_values(const square *s, nh_prime f, nmod_poly_t out)
{
    size_t count = s->degree * (size_t)s->size + 1;
    ulong *place = nh_alloc_array(count, sizeof *place), *value = nh_alloc_array(count, sizeof *value);
    nmod_mat_t m;
    nmod_mat_init(m, s->size, s->size, f.p);
    for (size_t k = 0; k < count; k++) {
        place[k] = k;
        at_lambda(s, (nh_residue)k, m);
        value[k] = nmod_mat_det(m);
    }
    nmod_poly_interpolate_nmod_vec(out, place, value, (slong)count);
    nmod_mat_clear(m);
    nh_free(value);
    nh_free(place);
}

/* det(B + u A) = det B det(1 + u B^-1 A),  the reversed characteristic polynomial of -B^-1 A, with B = X(shift) and
 * lambda = shift + u. False: B is singular. */
static bool by_eigenvalues(const square *s, nh_prime f, nh_residue shift, nmod_poly_t out)
{
    nmod_mat_t B, K;
    nmod_mat_init(B, s->size, s->size, f.p);
    nmod_mat_init(K, s->size, s->size, f.p);
    at_lambda(s, shift, B);
    ulong determinant = nmod_mat_det(B);
    bool good = determinant && nmod_mat_solve(K, B, s->m[1]);
    if (good) {
        nmod_mat_neg(K, K);
        nmod_mat_charpoly(out, K);
        nmod_poly_reverse(out, out, s->size + 1);
        nmod_poly_taylor_shift(out, out, nh_residue_negative(f, shift));
        nmod_poly_scalar_mul_nmod(out, out, determinant);
    }
    nmod_mat_clear(K);
    nmod_mat_clear(B);
    return good;
}

static void determinant_at(const square *s, nh_prime f, nmod_poly_t out)
{
    enum { shifts = 3 };
    for (nh_residue k = 0; k < shifts && s->degree == 1; k++)
        if (by_eigenvalues(s, f, 1000003 * k, out)) return;
    by_values(s, f, out);
}

/* Values at 0, 1, .. become coefficients, for every power of lambda. */
static void interpolate(nh_prime f, size_t width, size_t count, nh_residue *value)
{
    ulong *place = nh_alloc_array(count, sizeof *place), *y = nh_alloc_array(count, sizeof *y);
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (size_t i = 0; i < width; i++) {
        for (size_t k = 0; k < count; k++) place[k] = k, y[k] = value[k * width + i];
        nmod_poly_interpolate_nmod_vec(p, place, y, (slong)count);
        for (size_t k = 0; k < count; k++) value[k * width + i] = (nh_residue)nmod_poly_get_coeff_ui(p, (slong)k);
    }
    nmod_poly_clear(p);
    nh_free(y);
    nh_free(place);
}

/* L times every coefficient times C: size x size each. */
static nh_residue *compressed(const nh_staircase_matrices *m, nh_prime f, slong size, uint64_t seed)
{
    uint64_t random = seed;
    size_t count = (m->degree + 1) * (m->second + 1), at = 0;
    nh_residue *out = nh_alloc_array(count * (size_t)(size * size) + 1, sizeof *out);
    nmod_mat_t L, C, part, half, product;
    nmod_mat_init(L, size, (slong)m->rows, f.p);
    nmod_mat_init(C, (slong)m->columns, size, f.p);
    nmod_mat_init(part, (slong)m->rows, (slong)m->columns, f.p);
    nmod_mat_init(half, size, (slong)m->columns, f.p);
    nmod_mat_init(product, size, size, f.p);
    fill_random(L, f, &random);
    fill_random(C, f, &random);
    for (size_t k = 0; k < count; k++) {
        nmod_mat_zero(part);
        add_multiple(part, f, 1, m->entry + k * m->rows * m->columns);
        nmod_mat_mul(half, L, part);
        nmod_mat_mul(product, half, C);
        for (slong i = 0; i < size; i++)
            for (slong j = 0; j < size; j++) out[at++] = (nh_residue)nmod_mat_entry(product, i, j);
    }
    nmod_mat_clear(product);
    nmod_mat_clear(half);
    nmod_mat_clear(part);
    nmod_mat_clear(C);
    nmod_mat_clear(L);
    return out;
}

bool nh_staircase_determinant(const nh_staircase_matrices *m, nh_prime f, size_t rank, uint64_t seed,
                              nh_residue_polynomial *out)
{
    square s = {.degree = m->degree, .size = (slong)rank, .m = nh_alloc_array(m->degree + 1, sizeof *s.m)};
    nh_residue *power = compressed(m, f, s.size, seed);
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (size_t i = 0; i <= m->degree; i++) nmod_mat_init(s.m[i], s.size, s.size, f.p);
    *out = (nh_residue_polynomial){.degree = {m->degree * rank, m->second * rank}};
    size_t width = out->degree[0] + 1, count = out->degree[1] + 1;
    out->coefficient = nh_alloc_array(width * count, sizeof *out->coefficient);
    for (size_t k = 0; k < count && !nh_late(); k++) {
        for (size_t i = 0; i <= m->degree; i++) {
            nmod_mat_zero(s.m[i]);
            for (size_t j = 0; j <= m->second; j++)
                add_multiple(s.m[i], f, nh_residue_power(f, (nh_residue)k, j),
                             power + (j * (m->degree + 1) + i) * rank * rank);
        }
        determinant_at(&s, f, p);
        for (size_t i = 0; i < width; i++)
            out->coefficient[k * width + i] = (nh_residue)nmod_poly_get_coeff_ui(p, (slong)i);
    }
    interpolate(f, width, count, out->coefficient);
    for (size_t i = 0; i <= m->degree; i++) nmod_mat_clear(s.m[i]);
    nmod_poly_clear(p);
    nh_free(power);
    nh_free(s.m);
    bool good = !nh_late();
    if (!good) {
        nh_free(out->coefficient);
        *out = (nh_residue_polynomial){.coefficient = NULL};
    }
    return good;
}
