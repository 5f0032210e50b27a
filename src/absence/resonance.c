#include "absence/resonance.h"

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly.h>
#include <flint/fmpz_poly_factor.h>
#include <flint/fq_nmod_poly.h>
#include <flint/fq_nmod_poly_factor.h>
#include <flint/nmod_mat.h>
#include <flint/nmod_poly_factor.h>

#include "absence/polynomial_text.h"

enum {
    primes = 40,         /* that are tried */
    before_prime = 1000, /* the first is above it */
    most_field = 24      /* degree of the field that holds the roots modulo p */
};

/* ---- the span of the roots modulo a prime ---- */

/* The field's elements as rows: one root of each irreducible factor and its conjugates, the powers by Frobenius. */
static void put_roots(nmod_mat_t rows, slong *row, const nmod_poly_t factor, const fq_nmod_ctx_t field)
{
    fq_nmod_poly_t f;
    fq_nmod_poly_factor_t linear;
    fq_nmod_t value;
    fq_nmod_poly_init(f, field);
    fq_nmod_poly_factor_init(linear, field);
    fq_nmod_init(value, field);
    for (slong i = 0; i <= nmod_poly_degree(factor); i++) {
        fq_nmod_set_ui(value, nmod_poly_get_coeff_ui(factor, i), field);
        fq_nmod_poly_set_coeff(f, i, value, field);
    }
    fq_nmod_poly_roots(linear, f, 0, field);
    for (slong i = 0; i < linear->num; i++, ++*row) {
        fq_nmod_poly_get_coeff(value, linear->poly + i, 0, field);
        for (slong k = 0; k < nmod_mat_ncols(rows); k++)
            nmod_mat_entry(rows, *row, k) = nmod_poly_get_coeff_ui(value, k);
    }
    fq_nmod_clear(value, field);
    fq_nmod_poly_factor_clear(linear, field);
    fq_nmod_poly_clear(f, field);
}

/* The dimension over F_p of the span of the roots of all factors in F_(p^degree). */
static size_t span_of(const nmod_poly_factor_t parts, ulong p, slong degree)
{
    slong roots = 0, row = 0;
    for (slong i = 0; i < parts->num; i++) roots += nmod_poly_degree(parts->p + i);
    fmpz_t prime;
    nmod_mat_t rows;
    fq_nmod_ctx_t field;
    fmpz_init_set_ui(prime, p);
    nmod_mat_init(rows, roots, degree, p);
    fq_nmod_ctx_init(field, prime, degree, "a");
    for (slong i = 0; i < parts->num; i++) put_roots(rows, &row, parts->p + i, field);
    size_t rank = (size_t)nmod_mat_rank(rows);
    fq_nmod_ctx_clear(field);
    nmod_mat_clear(rows);
    fmpz_clear(prime);
    return rank;
}

/* 0 where the prime divides the leading coefficient or the field is too large. */
static size_t span_modulo(const fmpz_poly_t f, ulong p)
{
    if (!fmpz_fdiv_ui(fmpz_poly_lead(f), p)) return 0;
    nmod_poly_t reduced;
    nmod_poly_factor_t parts;
    nmod_poly_init(reduced, p);
    nmod_poly_factor_init(parts);
    fmpz_poly_get_nmod_poly(reduced, f);
    nmod_poly_factor(parts, reduced);
    slong degree = 1;
    for (slong i = 0; i < parts->num && degree <= most_field; i++) {
        slong next = nmod_poly_degree(parts->p + i);
        degree *= next / (slong)n_gcd((ulong)degree, (ulong)next);
    }
    size_t span = degree <= most_field ? span_of(parts, p, degree) : 0;
    nmod_poly_factor_clear(parts);
    nmod_poly_clear(reduced);
    return span;
}

/* ---- how large the span can be ---- */

/* Is g(x) = f(-x), but for a number? */
static bool mirrored(const fmpz_poly_t f, const fmpz_poly_t g)
{
    if (fmpz_poly_degree(f) != fmpz_poly_degree(g)) return false;
    for (int sign = -1; sign <= 1; sign += 2) {
        bool same = true;
        for (slong i = 0; i <= fmpz_poly_degree(f) && same; i++) {
            const fmpz *a = fmpz_poly_get_coeff_ptr(f, i), *b = fmpz_poly_get_coeff_ptr(g, i);
            bool equal = fmpz_equal(a, b), opposite = fmpz_cmpabs(a, b) == 0 && fmpz_sgn(a) == -fmpz_sgn(b);
            same = (i % 2 ? -sign : sign) > 0 ? equal : opposite;
        }
        if (same) return true;
    }
    return false;
}

/* An upper bound of the dimension over Q: the roots of an irreducible factor add up to a rational number, those of an
 * even one are pairs of opposite ones, and those of a mirrored one are known.  No further prime is tried where it is
 * reached. */
static size_t most_span(const fmpz_poly_factor_t parts)
{
    size_t most = 0;
    bool rational = false; /* is there a rational number that is not 0 in the span? */
    for (slong i = 0; i < parts->num; i++) {
        const fmpz_poly_struct *g = parts->p + i;
        slong degree = fmpz_poly_degree(g);
        bool known = false;
        for (slong j = 0; j < i && !known; j++) known = mirrored(g, parts->p + j);
        if (degree > 0) rational |= !fmpz_is_zero(fmpz_poly_get_coeff_ptr(g, degree - 1));
        if (!known) most += (size_t)(degree > 1 && mirrored(g, g) ? degree / 2 : degree - 1);
    }
    return most + rational;
}

/* The discriminant of a factor of degree 2. */
static void discriminant(fmpz_t out, const fmpz_poly_t f)
{
    enum { four = 4 };
    fmpz_t part;
    fmpz_init(part);
    fmpz_mul(out, fmpz_poly_get_coeff_ptr(f, 1), fmpz_poly_get_coeff_ptr(f, 1));
    fmpz_mul(part, fmpz_poly_get_coeff_ptr(f, 0), fmpz_poly_get_coeff_ptr(f, 2));
    fmpz_submul_ui(out, part, four);
    fmpz_clear(part);
}

/* The dimension of the span over Q of the roots of the factors of degree 1 and 2.  Square roots of whole numbers are
 * independent if no quotient of two of these numbers is a square. */
static size_t span_of_squares(const fmpz_poly_factor_t parts)
{
    size_t span = 0;
    bool rational = false;
    fmpz_t d, other;
    fmpz_init(d);
    fmpz_init(other);
    for (slong i = 0; i < parts->num; i++) {
        const fmpz_poly_struct *g = parts->p + i;
        slong degree = fmpz_poly_degree(g);
        if (degree > 2) continue;
        rational |= !fmpz_is_zero(fmpz_poly_get_coeff_ptr(g, degree - 1));
        if (degree < 2) continue;
        discriminant(d, g);
        bool known = false;
        for (slong j = 0; j < i && !known; j++) {
            if (fmpz_poly_degree(parts->p + j) != 2) continue;
            discriminant(other, parts->p + j);
            fmpz_mul(other, other, d);
            known = fmpz_is_square(other);
        }
        span += !known;
    }
    fmpz_clear(other);
    fmpz_clear(d);
    return span + rational;
}

/* The best of the primes, and of the factors of degree 1 and 2 alone. */
static void bound_span(nh_resonance *out, const fmpz_poly_t f)
{
    fmpz_poly_factor_t parts;
    fmpz_poly_factor_init(parts);
    fmpz_poly_factor(parts, f);
    size_t most = most_span(parts), squares = span_of_squares(parts);
    fmpz_poly_factor_clear(parts);
    ulong p = before_prime;
    for (int i = 0; i < primes && out->span < most; i++) {
        p = n_nextprime(p, 1);
        size_t span = span_modulo(f, p);
        if (span > out->span) out->span = span, out->prime = p;
    }
    if (!squares) squares = most > 0;
    if (squares > out->span) out->span = squares, out->prime = 0;
}

/* ---- diagonalizable ---- */

/* Does the polynomial vanish at the matrix? */
static bool annihilates(const fmpz_poly_t f, const fmpq_mat_t A)
{
    slong n = fmpq_mat_nrows(A);
    fmpq_mat_t value;
    fmpq_mat_init(value, n, n);
    for (slong k = fmpz_poly_degree(f); k >= 0; k--) {
        fmpq_mat_mul(value, value, A);
        for (slong i = 0; i < n; i++) {
            fmpq *entry = fmpq_mat_entry(value, i, i);
            fmpq_add_fmpz(entry, entry, fmpz_poly_get_coeff_ptr(f, k));
        }
    }
    bool zero = fmpq_mat_is_zero(value);
    fmpq_mat_clear(value);
    return zero;
}

/* It is iff the squarefree part of its characteristic polynomial vanishes at it. */
static bool diagonalizable(const fmpz_poly_t f, const fmpq_mat_t A)
{
    fmpz_poly_t slope, part;
    fmpz_poly_init(slope);
    fmpz_poly_init(part);
    fmpz_poly_derivative(slope, f);
    fmpz_poly_gcd(part, f, slope);
    fmpz_poly_div(part, f, part);
    bool vanishes = annihilates(part, A);
    fmpz_poly_clear(part);
    fmpz_poly_clear(slope);
    return vanishes;
}

nh_resonance *nh_resonance_of(nh_arena *arena, const fmpq_mat_t matrix)
{
    nh_resonance *out = nh_arena_alloc(arena, sizeof *out);
    *out = (nh_resonance){.letters = (size_t)fmpq_mat_nrows(matrix)};
    fmpq_poly_t characteristic;
    fmpz_poly_t f;
    fmpq_t trace;
    fmpq_poly_init(characteristic);
    fmpz_poly_init(f);
    fmpq_init(trace);
    fmpq_mat_charpoly(characteristic, matrix);
    /* It is monic, so that its numerator over the least common denominator is primitive. */
    fmpq_poly_get_numerator(f, characteristic);
    out->polynomial = nh_polynomial_text(arena, characteristic, "lambda");
    bound_span(out, f);
    out->diagonalizable = diagonalizable(f, matrix);
    out->at_most = out->letters - out->span - !out->diagonalizable;
    fmpq_mat_trace(trace, matrix);
    out->divergence = !fmpq_is_zero(trace);
    fmpq_clear(trace);
    fmpz_poly_clear(f);
    fmpq_poly_clear(characteristic);
    return out;
}
