/* kovacic_prime: the prime, and the singular points modulo it.  [docs/method.md, "No other integral"]
 *
 * Modulo the prime the leading coefficient of the denominator is not 0, all poles are residues and different ones, and
 * so are the square roots of all 1 + 4 b, and of the leading coefficients of r at irregular points, which are not 0. */
#include "absence/kovacic_internal.h"

#include <flint/fmpz_vec.h>
#include <flint/nmod_poly_factor.h>
#include <flint/ulong_extras.h>
#include <stdlib.h>

/* Of primes for which the cheap conditions hold; of all. */
enum { most_trials = 30000, most_primes = 1000000 };

static int by_size(const void *a, const void *b)
{
    ulong x = *(const ulong *)a, y = *(const ulong *)b;
    return (x > y) - (x < y);
}

/* Cheap conditions first: numbers that must be squares modulo the prime: 1 + 4 b where they are rational, and
 * discriminants, since no factor has roots that are not residues (Stickelberger). */
typedef struct {
    size_t count;
    fmpz *must_be_square; /* integers */
} conditions;

static void read_conditions(const nh_kovacic_problem *problem, conditions *c)
{
    c->must_be_square = _fmpz_vec_init(2 * (slong)problem->places + 2);
    c->count = 0;
    for (size_t i = 0; i <= problem->places; i++) {
        const nh_kovacic_place *place = problem->place + i;
        if (place->constant && !place->rational)
            fmpz_mul(c->must_be_square + c->count++, fmpq_numref(place->square), fmpq_denref(place->square));
        if (fmpz_poly_degree(place->factor) == 2) fmpz_poly_discriminant(c->must_be_square + c->count++, place->factor);
    }
}

static bool hold(const conditions *c, ulong prime)
{
    for (size_t i = 0; i < c->count; i++)
        if (n_jacobi_unsigned(fmpz_fdiv_ui(c->must_be_square + i, prime), prime) < 0) return false;
    return true;
}

/* All roots of a factor, in their order.  False: there are fewer than its degree. */
static bool split(const nh_kovacic_place *place, ulong prime, ulong *pole)
{
    nmod_poly_t f;
    nmod_poly_factor_t roots;
    nmod_poly_init(f, prime);
    nmod_poly_factor_init(roots);
    fmpz_poly_get_nmod_poly(f, place->factor);
    bool good = nmod_poly_degree(f) == fmpz_poly_degree(place->factor);
    if (good) {
        nmod_poly_roots(roots, f, 0);
        good = roots->num == nmod_poly_degree(f);
        for (slong k = 0; k < roots->num; k++) pole[k] = n_negmod(nmod_poly_get_coeff_ui(roots->p + k, 0), prime);
        qsort(pole, (size_t)roots->num, sizeof *pole, by_size);
    }
    nmod_poly_factor_clear(roots);
    nmod_poly_clear(f);
    return good;
}

static bool different(const nh_kovacic_problem *problem)
{
    ulong sorted[nh_kovacic_most_poles + 1];
    for (size_t i = 0; i < problem->poles; i++) sorted[i] = problem->pole[i];
    qsort(sorted, problem->poles, sizeof *sorted, by_size);
    for (size_t i = 1; i < problem->poles; i++)
        if (sorted[i] == sorted[i - 1]) return false;
    return true;
}

void nh_kovacic_prime_series(const nh_kovacic_problem *problem, size_t i, slong terms, nmod_poly_t out)
{
    nmod_poly_t den;
    nmod_poly_init(den, problem->prime);
    fmpz_poly_get_nmod_poly(out, problem->num);
    fmpz_poly_get_nmod_poly(den, problem->den);
    if (i < problem->poles) {
        nmod_poly_taylor_shift(out, out, problem->pole[i]);
        nmod_poly_taylor_shift(den, den, problem->pole[i]);
        nmod_poly_shift_right(den, den, problem->place[problem->at[i]].order);
    } else {
        nmod_poly_reverse(out, out, fmpz_poly_length(problem->num));
        nmod_poly_reverse(den, den, fmpz_poly_length(problem->den));
    }
    nmod_poly_div_series(out, out, den, terms);
    nmod_poly_clear(den);
}

ulong nh_kovacic_prime_square(const nh_kovacic_problem *problem, size_t i)
{
    const nh_kovacic_place *place = problem->place + problem->at[i];
    ulong prime = problem->prime;
    if (i == problem->poles && !place->irregular) /* b is 0 where r falls faster than x^-2 */
        return n_mulmod2(fmpz_fdiv_ui(fmpq_numref(place->square), prime),
                         n_invmod(fmpz_fdiv_ui(fmpq_denref(place->square), prime), prime), prime);
    nmod_poly_t series;
    nmod_poly_init(series, prime);
    nh_kovacic_prime_series(problem, i, 1, series);
    ulong lead = nmod_poly_get_coeff_ui(series, 0);
    nmod_poly_clear(series);
    return place->irregular ? lead : n_addmod(n_mulmod2(4, lead, prime), 1, prime);
}

/* The smaller one of the two roots at each point.  False: some is not there. */
static bool roots(nh_kovacic_problem *problem)
{
    for (size_t i = 0; i <= problem->poles; i++) {
        const nh_kovacic_place *place = problem->place + problem->at[i];
        problem->root[i] = 0;
        if (place->order == 1 || (place->irregular && problem->odd)) continue;
        ulong square = nh_kovacic_prime_square(problem, i), prime = problem->prime;
        if (place->irregular && !square) return false;
        if (n_jacobi_unsigned(square, prime) < 0) return false;
        ulong root = square ? n_sqrtmod(square, prime) : 0;
        problem->root[i] = root < prime - root ? root : prime - root;
        if (!root) problem->root[i] = 0;
    }
    return true;
}

static bool suits(nh_kovacic_problem *problem)
{
    ulong prime = problem->prime, *next = problem->pole;
    for (size_t i = 0; i < problem->places; i++) {
        if (!split(problem->place + i, prime, next)) return false;
        next += fmpz_poly_degree(problem->place[i].factor);
    }
    return different(problem) && roots(problem);
}

bool nh_kovacic_prime_find(nh_kovacic_problem *problem, ulong after)
{
    conditions c;
    read_conditions(problem, &c);
    bool found = false;
    problem->prime = after;
    for (size_t tried = 0, trials = 0; tried < most_primes && trials < most_trials && !found; tried++) {
        problem->prime = n_nextprime(problem->prime, 0);
        if (problem->prime <= problem->poles) continue; /* some residue must be no pole */
        if (!hold(&c, problem->prime) || !fmpz_fdiv_ui(fmpz_poly_lead(problem->den), problem->prime)) continue;
        found = suits(problem);
        trials++;
    }
    _fmpz_vec_clear(c.must_be_square, 2 * (slong)problem->places + 2);
    if (!found) problem->prime = 0;
    return found;
}
