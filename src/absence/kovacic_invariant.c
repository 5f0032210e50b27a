/* kovacic_invariant: forms of degree m in (y, y') that stay constant, modulo the prime.
 * [docs/method.md, "No other integral"]
 *
 *     Sum a_i y^(m-i) y'^i,   a_m = prod (x - c)^lowest P
 *     (m - i + 1) a_(i-1) = -a_i' - (i + 1) r a_(i+1),   a_0' + r a_1 = 0
 *
 * as Taylor series at a point x0 that is no pole.  More terms or fewer are conditions all the same; some more than
 * there are unknowns are taken. */
#include "absence/kovacic_internal.h"

#include <flint/nmod_mat.h>
#include <flint/ulong_extras.h>

enum { more_terms = 12 };

/* Where series are taken: no point of symmetry. */
static const ulong first_point = 314159265;

/* The first point from first_point on, modulo the prime, that is no pole. */
static ulong point_of(const nh_kovacic_problem *problem)
{
    ulong x = first_point % problem->prime;
    for (size_t i = 0; i < problem->poles; i++)
        if (problem->pole[i] == x) {
            x = n_addmod(x, 1, problem->prime);
            i = (size_t)-1;
        }
    return x;
}

/* prod (x - c)^lowest at x0. */
static void first_factor(const nh_kovacic_problem *problem, const slong *lowest, ulong x0, slong terms, nmod_poly_t out)
{
    nmod_poly_t t, den;
    nmod_poly_init(t, problem->prime);
    nmod_poly_init(den, problem->prime);
    nmod_poly_one(out);
    nmod_poly_one(den);
    for (size_t i = 0; i < problem->poles; i++) {
        nmod_poly_zero(t);
        nmod_poly_set_coeff_ui(t, 1, 1);
        nmod_poly_set_coeff_ui(t, 0, n_submod(x0, problem->pole[i], problem->prime));
        nmod_poly_pow_trunc(t, t, (ulong)(lowest[i] < 0 ? -lowest[i] : lowest[i]), terms);
        if (lowest[i] < 0) nmod_poly_mullow(den, den, t, terms);
        else nmod_poly_mullow(out, out, t, terms);
    }
    nmod_poly_div_series(out, out, den, terms);
    nmod_poly_clear(den);
    nmod_poly_clear(t);
}

/* The series of r at x0. */
static void series_of(const nh_kovacic_problem *problem, ulong x0, slong terms, nmod_poly_t r)
{
    nmod_poly_t den;
    nmod_poly_init(den, problem->prime);
    fmpz_poly_get_nmod_poly(r, problem->num);
    fmpz_poly_get_nmod_poly(den, problem->den);
    nmod_poly_taylor_shift(r, r, x0);
    nmod_poly_taylor_shift(den, den, x0);
    nmod_poly_div_series(r, r, den, terms);
    nmod_poly_clear(den);
}

/* a becomes a_0' + r a_1 of a_m = a. */
static void descend(nmod_poly_t a, const nmod_poly_t r, slong m, slong terms)
{
    ulong prime = nmod_poly_modulus(a);
    nmod_poly_t above, product;
    nmod_poly_init(above, prime);
    nmod_poly_init(product, prime);
    for (slong i = m; i >= 0; i--) {
        nmod_poly_mullow(product, r, above, terms);
        nmod_poly_scalar_mul_nmod(product, product, i ? (ulong)(i + 1) : 1);
        nmod_poly_set(above, a);
        nmod_poly_derivative(a, a);
        nmod_poly_add(a, a, product);
        if (i) nmod_poly_scalar_mul_nmod(a, a, n_negmod(n_invmod((ulong)(m - i + 1), prime), prime));
    }
    nmod_poly_clear(product);
    nmod_poly_clear(above);
}

void nh_kovacic_invariant_find(const nh_kovacic_problem *problem, nh_kovacic_invariant *invariant)
{
    slong m = invariant->m, unknowns = invariant->degree + 1, terms = unknowns + m + more_terms, rows = terms - m - 1;
    ulong x0 = point_of(problem);
    nmod_poly_t r, first, a;
    nmod_mat_t matrix;
    nmod_poly_init(r, problem->prime);
    nmod_poly_init(first, problem->prime);
    nmod_poly_init(a, problem->prime);
    nmod_mat_init(matrix, rows, unknowns, problem->prime);
    series_of(problem, x0, terms, r);
    first_factor(problem, invariant->lowest, x0, terms, first);
    for (slong j = 0; j < unknowns; j++) {
        nmod_poly_shift_left(a, first, j);
        nmod_poly_truncate(a, terms);
        descend(a, r, m, terms);
        for (slong k = 0; k < rows; k++) nmod_mat_entry(matrix, k, j) = nmod_poly_get_coeff_ui(a, k);
    }
    invariant->solutions = unknowns - nmod_mat_rank(matrix);
    nmod_mat_clear(matrix);
    nmod_poly_clear(a);
    nmod_poly_clear(first);
    nmod_poly_clear(r);
}
