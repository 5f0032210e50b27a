/* kovacic_riccati: invariant lines modulo the prime.  [docs/method.md, "No other integral"]
 *
 *     y = exp(int theta) P,   theta = Sum over the points of  sign [sqrt r] + e/(x - c)
 *     D P'' + 2 T P' + N P = 0,   D = prod (x - c)^k,   T = theta D,   N = (theta' + theta^2 - r) D
 *
 * in polynomials of degree at most the largest that is possible, never only in monic ones.  The first coefficient of P
 * modulo the prime, of x^k, makes  k + Sum e  the exponent at infinity: most choices of signs end there.
 *
 *     choices_begin    theta's parts at each point, with both signs
 *     nh_kovacic_riccati    all choices, one sign at a time (Gray's code); a kernel where the degree is possible */
#include "absence/kovacic_internal.h"

#include <flint/nmod_mat.h>
#include <flint/ulong_extras.h>

enum { most_signs = 22, enough = 2, products = 20 /* for each choice */ };

/* Of the entries of all matrices, each as often as a row is reduced, and of products of polynomials: seconds, about. */
static const double most_work = 1e9;

typedef struct {
    const nh_kovacic_problem *problem;
    ulong prime, half;      /* half: 1/2 */
    nmod_poly_t D, rD;      /* r D^2 */
    nmod_poly_struct *part; /* of T, two per pole, then infinity */
    ulong *exponent;        /* two per pole, then infinity */
    size_t signs;           /* poles at which the signs differ */
    size_t *signed_pole;
    slong most; /* degree of P */
    double work;
} choices;

/* ---- parts ---- */

static slong power(const nh_kovacic_place *place) { return place->irregular ? place->order / 2 : 1; }

/* S_0 .. of sqrt(t^order r). */
static void root_series(const nh_kovacic_problem *problem, size_t i, slong terms, nmod_poly_t out)
{
    nh_kovacic_prime_series(problem, i, terms, out);
    nmod_poly_scalar_mul_nmod(out, out, n_invmod(nmod_poly_get_coeff_ui(out, 0), problem->prime));
    nmod_poly_sqrt_series(out, out, terms);
    nmod_poly_scalar_mul_nmod(out, out, problem->root[i]);
}

static ulong residue_of(const choices *c, slong half)
{
    ulong size = n_mulmod2((ulong)(half < 0 ? -half : half) % c->prime, c->half, c->prime);
    return half < 0 ? n_negmod(size, c->prime) : size;
}

/* At pole i, with the sign + (0) or - (1). */
static void part_at(choices *c, size_t i, int minus)
{
    const nh_kovacic_problem *problem = c->problem;
    const nh_kovacic_place *place = problem->place + problem->at[i];
    slong k = power(place);
    ulong e = n_mulmod2(problem->root[i], c->half, c->prime);
    nmod_poly_t local, t;
    nmod_poly_init(local, c->prime);
    nmod_poly_init(t, c->prime);
    if (place->irregular) {
        root_series(problem, i, k, local);
        e = nmod_poly_get_coeff_ui(local, k - 1);
    }
    if (minus) {
        nmod_poly_neg(local, local);
        e = n_negmod(e, c->prime);
    }
    e = n_addmod(e, residue_of(c, place->half), c->prime);
    nmod_poly_set_coeff_ui(local, k - 1, e);
    nmod_poly_taylor_shift(local, local, n_negmod(problem->pole[i], c->prime));
    nmod_poly_set_coeff_ui(t, 1, 1);
    nmod_poly_set_coeff_ui(t, 0, n_negmod(problem->pole[i], c->prime));
    nmod_poly_pow(t, t, (ulong)k);
    nmod_poly_div(t, c->D, t);
    nmod_poly_mul(c->part + 2 * i + minus, local, t);
    c->exponent[2 * i + (size_t)minus] = e;
    nmod_poly_clear(t);
    nmod_poly_clear(local);
}

static void part_at_infinity(choices *c, int minus)
{
    const nh_kovacic_problem *problem = c->problem;
    size_t i = problem->poles;
    const nh_kovacic_place *place = problem->place + problem->places;
    ulong e = n_mulmod2(problem->root[i], c->half, c->prime);
    if (place->irregular) {
        slong j = -place->order / 2;
        nmod_poly_t local;
        nmod_poly_init(local, c->prime);
        root_series(problem, i, j + 2, local);
        e = nmod_poly_get_coeff_ui(local, j + 1);
        nmod_poly_truncate(local, j + 1);
        nmod_poly_reverse(local, local, j + 1);
        if (minus) nmod_poly_neg(local, local);
        nmod_poly_mul(c->part + 2 * i + minus, local, c->D);
        nmod_poly_clear(local);
    }
    if (minus) e = n_negmod(e, c->prime);
    c->exponent[2 * i + (size_t)minus] = n_addmod(e, residue_of(c, place->half), c->prime);
}

static void read_denominators(choices *c)
{
    const nh_kovacic_problem *problem = c->problem;
    nmod_poly_t t;
    nmod_poly_init(t, c->prime);
    nmod_poly_one(c->D);
    for (size_t i = 0; i < problem->poles; i++) {
        nmod_poly_zero(t);
        nmod_poly_set_coeff_ui(t, 1, 1);
        nmod_poly_set_coeff_ui(t, 0, n_negmod(problem->pole[i], c->prime));
        nmod_poly_pow(t, t, (ulong)power(problem->place + problem->at[i]));
        nmod_poly_mul(c->D, c->D, t);
    }
    fmpz_poly_get_nmod_poly(c->rD, problem->num);
    nmod_poly_mul(c->rD, c->rD, c->D);
    nmod_poly_mul(c->rD, c->rD, c->D);
    fmpz_poly_get_nmod_poly(t, problem->den);
    nmod_poly_div(c->rD, c->rD, t);
    nmod_poly_clear(t);
}

static void choices_begin(choices *c, const nh_kovacic_problem *problem, slong most)
{
    size_t points = problem->poles + 1;
    *c = (choices){.problem = problem, .prime = problem->prime, .most = most};
    c->half = (c->prime + 1) / 2;
    nmod_poly_init(c->D, c->prime);
    nmod_poly_init(c->rD, c->prime);
    c->part = nh_arena_alloc(problem->arena, 2 * points * sizeof *c->part);
    c->exponent = nh_arena_alloc(problem->arena, 2 * points * sizeof *c->exponent);
    c->signed_pole = nh_arena_alloc(problem->arena, points * sizeof *c->signed_pole);
    for (size_t k = 0; k < 2 * points; k++) nmod_poly_init(c->part + k, c->prime);
    read_denominators(c);
    for (size_t i = 0; i < problem->poles; i++) {
        const nh_kovacic_place *place = problem->place + problem->at[i];
        part_at(c, i, 0);
        part_at(c, i, 1);
        if (place->order != 1 && !(place->constant && fmpq_is_zero(place->square))) c->signed_pole[c->signs++] = i;
    }
    part_at_infinity(c, 0);
    part_at_infinity(c, 1);
}

static void choices_end(choices *c)
{
    for (size_t k = 0; k < 2 * (c->problem->poles + 1); k++) nmod_poly_clear(c->part + k);
    nmod_poly_clear(c->rD);
    nmod_poly_clear(c->D);
}

/* ---- one choice ---- */

/* T of the choice; `minus`: the poles with the sign -, as bits of the number of a signed pole. */
static void theta(const choices *c, ulong minus, int infinity, nmod_poly_t T)
{
    size_t next = 0;
    nmod_poly_set(T, c->part + 2 * c->problem->poles + infinity);
    for (size_t i = 0; i < c->problem->poles; i++) {
        bool is = next < c->signs && c->signed_pole[next] == i;
        nmod_poly_add(T, T, c->part + 2 * i + (is && (minus >> next & 1)));
        next += is;
    }
}

/* N = (T' D - T D' + T^2 - r D^2)/D, without a remainder by the choice of the exponents. */
static void last_coefficient(const choices *c, const nmod_poly_t T, nmod_poly_t N)
{
    nmod_poly_t product;
    nmod_poly_init(product, c->prime);
    nmod_poly_derivative(N, T);
    nmod_poly_mul(N, N, c->D);
    nmod_poly_derivative(product, c->D);
    nmod_poly_mul(product, product, T);
    nmod_poly_sub(N, N, product);
    nmod_poly_mul(product, T, T);
    nmod_poly_add(N, N, product);
    nmod_poly_sub(N, N, c->rD);
    nmod_poly_div(N, N, c->D);
    nmod_poly_clear(product);
}

static void add_column(const nmod_poly_t f, slong shift, ulong factor, slong column, nmod_mat_t rows)
{
    for (slong i = 0; i < nmod_poly_length(f); i++) {
        ulong *entry = &nmod_mat_entry(rows, i + shift, column);
        *entry = n_addmod(*entry, n_mulmod2(nmod_poly_get_coeff_ui(f, i), factor, rows->mod.n), rows->mod.n);
    }
}

/* The dimension of the kernel in degree <= most. */
static slong kernel(choices *c, ulong minus, int infinity, slong most)
{
    nmod_poly_t T, N;
    nmod_mat_t rows;
    nmod_poly_init(T, c->prime);
    nmod_poly_init(N, c->prime);
    theta(c, minus, infinity, T);
    last_coefficient(c, T, N);
    slong length = nmod_poly_length(c->D);
    if (nmod_poly_length(T) > length) length = nmod_poly_length(T);
    if (nmod_poly_length(N) > length) length = nmod_poly_length(N);
    nmod_mat_init(rows, length + most, most + 1, c->prime);
    for (slong j = 0; j <= most; j++) {
        ulong first = (ulong)j % c->prime, before = (ulong)(j ? j - 1 : 0) % c->prime;
        if (j > 1) add_column(c->D, j - 2, n_mulmod2(first, before, c->prime), j, rows);
        if (j) add_column(T, j - 1, n_addmod(first, first, c->prime), j, rows);
        add_column(N, j, 1, j, rows);
    }
    c->work += (double)nmod_mat_nrows(rows) * (double)((most + 1) * (most + 1)) + (double)(products * length * length);
    slong dimension = most + 1 - nmod_mat_rank(rows);
    nmod_mat_clear(rows);
    nmod_poly_clear(N);
    nmod_poly_clear(T);
    return dimension;
}

/* The largest degree <= most that P can have modulo the prime; -1: none. */
static slong possible(const choices *c, ulong sum, int infinity)
{
    ulong k = n_submod(c->exponent[2 * c->problem->poles + (size_t)infinity], sum, c->prime);
    if ((slong)k > c->most) return -1;
    return (slong)k + (c->most - (slong)k) / (slong)c->prime * (slong)c->prime;
}

/* Solutions of one choice of signs at the poles, of both at infinity. */
static slong solutions(choices *c, ulong minus, ulong sum)
{
    slong plus = possible(c, sum, 0), negative = possible(c, sum, 1), found = 0;
    if (!c->problem->place[c->problem->places].irregular) {
        slong most = plus > negative ? plus : negative;
        return most < 0 ? 0 : kernel(c, minus, 0, most);
    }
    if (plus >= 0) found += kernel(c, minus, 0, plus);
    if (negative >= 0) found += kernel(c, minus, 1, negative);
    return found;
}

bool nh_kovacic_riccati(const nh_kovacic_problem *problem, nh_kovacic *out)
{
    choices c;
    if (!out->degrees) return true;
    choices_begin(&c, problem, out->degree_of_p[out->degrees - 1]);
    if (c.signs > most_signs) out->obstacle = "there are too many choices of signs";
    ulong sum = 0, minus = 0, end = out->obstacle ? 0 : (ulong)1 << c.signs;
    for (size_t i = 0; i < problem->poles; i++) sum = n_addmod(sum, c.exponent[2 * i], c.prime);
    for (ulong number = 1; number <= end && out->riccati < enough; number++) {
        out->riccati += solutions(&c, minus, sum);
        out->sign_vectors++;
        if (c.work > most_work) {
            out->obstacle = "there are too many choices of signs with a possible degree";
            break;
        }
        size_t bit = 0; /* of Gray's code, the one that changes now */
        while (!(number >> bit & 1)) bit++;
        if (bit >= c.signs) break;
        size_t pole = c.signed_pole[bit];
        int was = minus >> bit & 1;
        sum = n_addmod(n_submod(sum, c.exponent[2 * pole + (size_t)was], c.prime), c.exponent[2 * pole + (size_t)!was],
                       c.prime);
        minus ^= (ulong)1 << bit;
    }
    if (out->riccati > enough) out->riccati = enough;
    choices_end(&c);
    return !out->obstacle;
}
