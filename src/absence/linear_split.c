#include "absence/linear_split.h"

#include <flint/fmpq_mat.h>
#include <flint/fmpz_poly_factor.h>

/* The coefficients of A in x, but for the denominator: A_0, A_1, .. */
typedef struct {
    size_t n, count;
    fmpq_mat_struct *a;
} coefficients;

typedef struct {
    const nh_linear_equation *equation; /* whose denominator all blocks share */
    nh_linear_equation *block;
    size_t blocks, capacity;
    bool triangular;
} pieces;

static void coefficients_init(coefficients *c, size_t n, size_t count)
{
    c->n = n;
    c->count = count;
    c->a = nh_alloc_array(count + 1, sizeof *c->a);
    for (size_t k = 0; k < count; k++) fmpq_mat_init(c->a + k, (slong)n, (slong)n);
}

static void coefficients_clear(coefficients *c)
{
    for (size_t k = 0; k < c->count; k++) fmpq_mat_clear(c->a + k);
    nh_free(c->a);
}

static void coefficients_of(coefficients *c, const nh_linear_equation *equation)
{
    size_t n = equation->size;
    slong count = 0;
    for (size_t k = 0; k < n * n; k++)
        if (fmpz_poly_length(equation->num + k) > count) count = fmpz_poly_length(equation->num + k);
    coefficients_init(c, n, (size_t)count);
    for (size_t k = 0; k < n * n; k++)
        for (slong i = 0; i < fmpz_poly_length(equation->num + k); i++)
            fmpz_poly_get_coeff_fmpz(fmpq_mat_entry_num(c->a + i, (slong)(k / n), (slong)(k % n)), equation->num + k,
                                     i);
}

/* ---- subspaces, by rows in echelon form ---- */

/* Leaves the independent rows. */
static void independent(fmpq_mat_t rows)
{
    slong rank = fmpq_mat_rref(rows, rows), n = fmpq_mat_ncols(rows);
    fmpq_mat_t kept;
    fmpq_mat_init(kept, rank, n);
    for (slong i = 0; i < rank; i++)
        for (slong j = 0; j < n; j++) fmpq_set(fmpq_mat_entry(kept, i, j), fmpq_mat_entry(rows, i, j));
    fmpq_mat_swap(rows, kept);
    fmpq_mat_clear(kept);
}

/* The column of the first entry of row i that is not 0. */
static slong pivot(const fmpq_mat_t echelon, slong i)
{
    slong j = 0;
    while (fmpq_is_zero(fmpq_mat_entry(echelon, i, j))) j++;
    return j;
}

/* The vectors v with M v = 0. */
static void kernel(fmpq_mat_t rows, const fmpq_mat_t M)
{
    fmpq_mat_t echelon;
    slong n = fmpq_mat_ncols(M), made = 0;
    fmpq_mat_init_set(echelon, M);
    slong rank = fmpq_mat_rref(echelon, echelon);
    fmpq_mat_clear(rows);
    fmpq_mat_init(rows, n - rank, n);
    for (slong j = 0, i = 0; j < n; j++) {
        if (i < rank && pivot(echelon, i) == j) {
            i++;
            continue;
        }
        for (slong k = 0; k < rank; k++)
            fmpq_neg(fmpq_mat_entry(rows, made, pivot(echelon, k)), fmpq_mat_entry(echelon, k, j));
        fmpq_one(fmpq_mat_entry(rows, made, j));
        made++;
    }
    fmpq_mat_clear(echelon);
}

/* The smallest subspace with all rows that the coefficients leave invariant; with `dual` their transposes. */
static void close_rows(fmpq_mat_t rows, const coefficients *c, bool dual)
{
    fmpq_mat_t image, both, turned;
    fmpq_mat_init(turned, (slong)c->n, (slong)c->n);
    independent(rows);
    slong before;
    do {
        before = fmpq_mat_nrows(rows);
        for (size_t k = 0; k < c->count && fmpq_mat_nrows(rows) < (slong)c->n; k++) {
            fmpq_mat_init(image, fmpq_mat_nrows(rows), (slong)c->n);
            fmpq_mat_init(both, 2 * fmpq_mat_nrows(rows), (slong)c->n);
            fmpq_mat_transpose(turned, c->a + k);
            fmpq_mat_mul(image, rows, dual ? c->a + k : turned);
            fmpq_mat_concat_vertical(both, rows, image);
            fmpq_mat_swap(rows, both);
            independent(rows);
            fmpq_mat_clear(image);
            fmpq_mat_clear(both);
        }
    } while (fmpq_mat_nrows(rows) > before);
    fmpq_mat_clear(turned);
}

/* ---- invariant subspaces ---- */

/* out = p(X) */
static void polynomial_of(fmpq_mat_t out, const fmpz_poly_struct *p, const fmpq_mat_t X)
{
    fmpz_t c;
    fmpz_init(c);
    fmpq_mat_zero(out);
    for (slong k = fmpz_poly_degree(p); k >= 0; k--) {
        fmpq_mat_mul(out, out, X);
        fmpz_poly_get_coeff_fmpz(c, p, k);
        for (slong i = 0; i < fmpq_mat_nrows(X); i++)
            fmpq_add_fmpz(fmpq_mat_entry(out, i, i), fmpq_mat_entry(out, i, i), c);
    }
    fmpz_clear(c);
}

/* Is the closure of one vector of the kernel of p(X) smaller than everything?  `dual`: of the transposes; then `rows`
 * become those that it annihilates. */
static bool from_kernel(fmpq_mat_t rows, const coefficients *c, const fmpz_poly_struct *p, const fmpq_mat_t X,
                        bool dual)
{
    fmpq_mat_t value, all;
    fmpq_mat_init(value, (slong)c->n, (slong)c->n);
    fmpq_mat_init(all, 0, (slong)c->n);
    polynomial_of(value, p, X);
    if (dual) fmpq_mat_transpose(value, value);
    kernel(all, value);
    bool found = false;
    for (slong i = 0; i < fmpq_mat_nrows(all) && !found; i++) {
        fmpq_mat_clear(rows);
        fmpq_mat_init(rows, 1, (slong)c->n);
        for (slong j = 0; j < (slong)c->n; j++) fmpq_set(fmpq_mat_entry(rows, 0, j), fmpq_mat_entry(all, i, j));
        close_rows(rows, c, dual);
        found = fmpq_mat_nrows(rows) < (slong)c->n;
    }
    if (found && dual) {
        kernel(all, rows);
        fmpq_mat_swap(rows, all);
        independent(rows);
    }
    fmpq_mat_clear(value);
    fmpq_mat_clear(all);
    return found;
}

/* Kernels of the irreducible factors of the characteristic polynomial. */
static bool from_element(fmpq_mat_t rows, const coefficients *c, const fmpq_mat_t X)
{
    fmpq_poly_t characteristic;
    fmpz_poly_t integral;
    fmpz_poly_factor_t factors;
    fmpq_poly_init(characteristic);
    fmpz_poly_init(integral);
    fmpz_poly_factor_init(factors);
    fmpq_mat_charpoly(characteristic, X);
    fmpq_poly_get_numerator(integral, characteristic);
    fmpz_poly_factor(factors, integral);
    bool found = false;
    for (slong k = 0; k < factors->num && !found; k++)
        found = from_kernel(rows, c, factors->p + k, X, false) || from_kernel(rows, c, factors->p + k, X, true);
    fmpz_poly_factor_clear(factors);
    fmpz_poly_clear(integral);
    fmpq_poly_clear(characteristic);
    return found;
}

enum { most_combinations = 12, largest_weight = 3 };

/* Element `number` of the algebra: the coefficients, products of two of them, combinations of these; false: no more. */
static bool element(fmpq_mat_t X, const coefficients *c, size_t number)
{
    if (number < c->count) {
        fmpq_mat_set(X, c->a + number);
        return true;
    }
    number -= c->count;
    if (number < c->count * c->count) {
        fmpq_mat_mul(X, c->a + number / c->count, c->a + number % c->count);
        return true;
    }
    number -= c->count * c->count;
    if (number >= most_combinations) return false;
    fmpq_mat_t term;
    fmpq_t weight;
    fmpq_mat_init(term, (slong)c->n, (slong)c->n);
    fmpq_init(weight);
    fmpq_mat_zero(X);
    for (size_t k = 0; k < c->count + c->count * c->count; k++) {
        element(term, c, k);
        slong w = (slong)((number * number + 3 * number * k + k * k + k) % (2 * largest_weight + 1)) - largest_weight;
        fmpq_set_si(weight, w, 1);
        fmpq_mat_scalar_mul_fmpq(term, term, weight);
        fmpq_mat_add(X, X, term);
    }
    fmpq_mat_clear(term);
    fmpq_clear(weight);
    return true;
}

/* A proper invariant subspace, as rows in echelon form. */
static bool invariant(fmpq_mat_t rows, const coefficients *c)
{
    fmpq_mat_t X;
    fmpq_mat_init(X, (slong)c->n, (slong)c->n);
    bool found = false;
    for (size_t k = 0; !found && element(X, c, k); k++) found = from_element(rows, c, X);
    fmpq_mat_clear(X);
    return found;
}

/* ---- blocks ---- */

/* The coefficients in a basis whose first vectors are the rows. */
static void change_basis(coefficients *c, const fmpq_mat_t rows)
{
    slong n = (slong)c->n, r = fmpq_mat_nrows(rows), next = r;
    fmpq_mat_t P, inverse;
    fmpq_mat_init(P, n, n);
    fmpq_mat_init(inverse, n, n);
    for (slong j = 0, i = 0; j < n; j++) { /* and the others the unit vectors of columns without pivot */
        if (i < r && pivot(rows, i) == j) {
            for (slong k = 0; k < n; k++) fmpq_set(fmpq_mat_entry(P, k, i), fmpq_mat_entry(rows, i, k));
            i++;
        } else {
            fmpq_one(fmpq_mat_entry(P, j, next++));
        }
    }
    fmpq_mat_inv(inverse, P);
    for (size_t k = 0; k < c->count; k++) {
        fmpq_mat_mul(c->a + k, inverse, c->a + k);
        fmpq_mat_mul(c->a + k, c->a + k, P);
    }
    fmpq_mat_clear(P);
    fmpq_mat_clear(inverse);
}

/* Are there numbers X with P_k X - X R_k = Q_k for all coefficients ((P, Q), (0, R))?  Then (1, X) takes Q away. */
static bool complement(const coefficients *c, slong r)
{
    slong n = (slong)c->n, s = n - r, unknowns = r * s;
    fmpq_mat_t M;
    fmpq_mat_init(M, (slong)c->count * unknowns, unknowns + 1);
    for (slong k = 0; k < (slong)c->count; k++)
        for (slong e = 0; e < unknowns; e++) {
            slong i = e / s, j = e % s, row = k * unknowns + e;
            const fmpq_mat_struct *a = c->a + k;
            for (slong l = 0; l < r; l++) fmpq_set(fmpq_mat_entry(M, row, l * s + j), fmpq_mat_entry(a, i, l));
            for (slong l = 0; l < s; l++)
                fmpq_sub(fmpq_mat_entry(M, row, i * s + l), fmpq_mat_entry(M, row, i * s + l),
                         fmpq_mat_entry(a, r + l, r + j));
            fmpq_set(fmpq_mat_entry(M, row, unknowns), fmpq_mat_entry(a, i, r + j));
        }
    slong rank = fmpq_mat_rref(M, M);
    bool is = !rank || pivot(M, rank - 1) < unknowns;
    fmpq_mat_clear(M);
    return is;
}

/* The coefficients of the diagonal block of n rows from `first`. */
static void diagonal_block(coefficients *out, const coefficients *c, slong first, slong n)
{
    coefficients_init(out, (size_t)n, c->count);
    for (size_t k = 0; k < c->count; k++)
        for (slong i = 0; i < n; i++)
            for (slong j = 0; j < n; j++)
                fmpq_set(fmpq_mat_entry(out->a + k, i, j), fmpq_mat_entry(c->a + k, first + i, first + j));
}

static void add_block(pieces *p, const coefficients *c)
{
    nh_grow(&p->block, &p->capacity, p->blocks + 1, sizeof *p->block);
    nh_linear_equation *e = p->block + p->blocks++;
    nh_linear_equation_init(e, c->n);
    fmpq_poly_t num, den;
    fmpq_poly_init(num);
    fmpq_poly_init(den);
    fmpq_poly_set_fmpz_poly(den, p->equation->den);
    for (size_t i = 0; i < c->n; i++)
        for (size_t j = 0; j < c->n; j++) {
            fmpq_poly_zero(num);
            for (size_t k = 0; k < c->count; k++)
                fmpq_poly_set_coeff_fmpq(num, (slong)k, fmpq_mat_entry(c->a + k, (slong)i, (slong)j));
            nh_linear_equation_set(e, i, j, num, den);
        }
    nh_linear_equation_reduce(e);
    fmpq_poly_clear(num);
    fmpq_poly_clear(den);
}

static void split(pieces *p, coefficients *c)
{
    fmpq_mat_t rows;
    fmpq_mat_init(rows, 0, (slong)c->n);
    if (c->n > 1 && invariant(rows, c)) {
        slong r = fmpq_mat_nrows(rows);
        coefficients part;
        change_basis(c, rows);
        if (!complement(c, r)) p->triangular = true;
        diagonal_block(&part, c, 0, r);
        split(p, &part);
        coefficients_clear(&part);
        diagonal_block(&part, c, r, (slong)c->n - r);
        split(p, &part);
        coefficients_clear(&part);
    } else if (c->n) {
        add_block(p, c);
    }
    fmpq_mat_clear(rows);
}

size_t nh_linear_equation_split(const nh_linear_equation *equation, nh_linear_equation **blocks, bool *triangular)
{
    coefficients c;
    pieces p = {.equation = equation};
    coefficients_of(&c, equation);
    split(&p, &c);
    coefficients_clear(&c);
    *blocks = p.block;
    *triangular = p.triangular;
    return p.blocks;
}
