/* higher_series: Laurent's series of higher variational equations at the pole of the motion, modulo a prime.
 *
 *     u_0 = a t^-2 + ..,  a = 4/sigma_3;  the coefficient of t^4 is fixed by the level
 *     z_k'' - g_z(u_0, 0) z_k = what lower orders give
 *     u_k'' - f_u(u_0, 0) u_k = what z_k and lower orders give
 *
 * The coefficient of t^m is multiplied by m (m - 1) - 12, or m (m - 1) - n (n + 1), and is free where that is 0: at
 * m = -3, 4, or -n, n + 1; the other side has to be 0 there, or the solution has a logarithm.  For |m| below the prime
 * the factor is 0 modulo it nowhere else, so that the series has p-integral coefficients where the free ones are whole
 * numbers, and its reduction is what is computed here. */
#include <stdint.h>

#include <flint/nmod_poly.h>

#include "absence/higher_internal.h"
#include "base/memory.h"

enum {
    shortest = 64,
    longest = 4096,
    smallest_prime = 1 << 16,
    nothing = 1 << 30,
    pole = -2,
    along_low = -3,
    along_high = 4,
    cubic = 3
};

/* sum c_i t^(low + i), known for exponents below `known`.  The series 0: low = known = nothing. */
typedef struct {
    slong low, known;
    nmod_poly_t c;
} series;

typedef struct {
    nmod_t mod;
    const nh_higher_system *system;
    unsigned orders, most[NH_HIGHER_DIRECTIONS]; /* most: highest power of u, of z */
    series *power[NH_HIGHER_DIRECTIONS];         /* (most + 1) x (orders + 1): the e^k-part of u^i, of z^i */
    series slope[NH_HIGHER_DIRECTIONS];          /* f_u(u_0, 0), g_z(u_0, 0) */
    ulong *coefficient[NH_HIGHER_DIRECTIONS];    /* of the rates */
    uint64_t state;                              /* of the free constants */
} work;

typedef struct {
    slong low, high; /* s < s' with s + s' = 1; y'' - s (s - 1) t^-2 y */
} exponents;

/* ---- series ---- */

static void series_init(series *s, nmod_t mod)
{
    s->low = s->known = nothing;
    nmod_poly_init(s->c, mod.n);
}

static void series_zero(series *s)
{
    s->low = s->known = nothing;
    nmod_poly_zero(s->c);
}

static bool is_nothing(const series *s) { return s->low == nothing; }

static ulong at(const series *s, slong m)
{
    return is_nothing(s) || m < s->low ? 0 : nmod_poly_get_coeff_ui(s->c, m - s->low);
}

static slong least(slong a, slong b) { return a < b ? a : b; }

static void cut(series *s)
{
    if (s->known < nothing) nmod_poly_truncate(s->c, s->known > s->low ? s->known - s->low : 0);
}

/* out += factor a b */
static void add_product(series *out, const series *a, const series *b, ulong factor)
{
    if (is_nothing(a) || is_nothing(b) || !factor) return;
    nmod_poly_t product;
    nmod_poly_init(product, a->c->mod.n);
    slong low = a->low + b->low, known = nothing;
    if (b->known < nothing) known = a->low + b->known;
    if (a->known < nothing) known = least(known, b->low + a->known);
    nmod_poly_mul(product, a->c, b->c);
    nmod_poly_scalar_mul_nmod(product, product, factor);
    if (is_nothing(out)) {
        out->low = low;
        nmod_poly_swap(out->c, product);
    } else {
        slong first = least(low, out->low);
        nmod_poly_shift_left(product, product, low - first);
        nmod_poly_shift_left(out->c, out->c, out->low - first);
        nmod_poly_add(out->c, out->c, product);
        out->low = first;
    }
    out->known = least(out->known, known);
    cut(out);
    nmod_poly_clear(product);
}

/* ---- the motion ---- */

/* The residue of a rational number; false: the prime divides its denominator. */
static bool residue(const fmpq_t x, nmod_t mod, ulong *out)
{
    ulong below = fmpz_fdiv_ui(fmpq_denref(x), mod.n);
    if (!below) return false;
    *out = nmod_mul(fmpz_fdiv_ui(fmpq_numref(x), mod.n), n_invmod(below, mod.n), mod);
    return true;
}

static bool residues(const fmpq_poly_t f, nmod_t mod, ulong *out, size_t n)
{
    fmpq_t x;
    fmpq_init(x);
    bool good = true;
    for (size_t i = 0; i < n && good; i++) {
        fmpq_poly_get_coeff_fmpq(x, f, (slong)i);
        good = residue(x, mod, out + i);
    }
    fmpq_clear(x);
    return good;
}

static ulong whole(slong x, nmod_t mod) { return x < 0 ? nmod_neg((ulong)-x, mod) : (ulong)x; }

/* The coefficient of t^4 that u'^2 = sigma(u) has, from those of u = t^-2 (c_0 + .. + c_5 t^5): with u_4 = x the
 * coefficient of t^0 in u'^2 - sigma(u) is -28 a x + .. */
static ulong level_constant(nmod_t mod, const ulong *sigma, const nmod_poly_t u)
{
    enum { squares = 6, divisor = 28 };
    nmod_poly_t rate, power;
    nmod_poly_init(rate, mod.n);
    nmod_poly_init(power, mod.n);
    for (slong i = 0; i < nmod_poly_length(u); i++)
        nmod_poly_set_coeff_ui(rate, i, nmod_mul(whole(i + pole, mod), nmod_poly_get_coeff_ui(u, i), mod));
    nmod_poly_mul(power, rate, rate);
    ulong sum = nmod_poly_get_coeff_ui(power, squares);
    nmod_poly_one(power);
    for (slong k = 0; k <= cubic; k++) {
        sum = nmod_sub(sum, nmod_mul(sigma[k], nmod_poly_get_coeff_ui(power, 2 * k), mod), mod);
        nmod_poly_mul(power, power, u);
    }
    nmod_poly_clear(rate);
    nmod_poly_clear(power);
    return nmod_mul(sum, n_invmod(nmod_mul(divisor, nmod_poly_get_coeff_ui(u, 0), mod), mod.n), mod);
}

/* u_0 up to t^(length - 3), from 2 u'' = sigma'(u); false: the prime will not do. */
static bool motion(const work *w, slong length, series *out)
{
    enum { four = 4 };
    nmod_t mod = w->mod;
    ulong sigma[cubic + 1], half = n_invmod(2, mod.n);
    if (!residues(w->system->curve, mod, sigma, cubic + 1) || !sigma[cubic]) return false;
    ulong a = nmod_mul(four, n_invmod(sigma[cubic], mod.n), mod);
    ulong square = nmod_mul(nmod_mul(cubic, sigma[cubic], mod), half, mod), linear = sigma[2],
          constant = nmod_mul(sigma[1], half, mod);
    series_zero(out);
    out->low = pole;
    out->known = length + pole;
    nmod_poly_set_coeff_ui(out->c, 0, a);
    for (slong i = 1; i < length; i++) { /* the coefficient of t^(i - 2) */
        slong m = i + pole;
        if (m == along_high) {
            nmod_poly_set_coeff_ui(out->c, i, level_constant(mod, sigma, out->c));
            continue;
        }
        ulong sum = 0;
        for (slong j = 1; j < i; j++)
            NMOD_ADDMUL(sum, nmod_poly_get_coeff_ui(out->c, j), nmod_poly_get_coeff_ui(out->c, i - j), mod);
        sum = nmod_mul(sum, square, mod);
        if (i >= 2) NMOD_ADDMUL(sum, linear, nmod_poly_get_coeff_ui(out->c, i - 2), mod);
        if (m == 2) sum = nmod_add(sum, constant, mod);
        ulong factor = whole((m - along_low) * (m - along_high), mod);
        nmod_poly_set_coeff_ui(out->c, i, nmod_mul(sum, n_invmod(factor, mod.n), mod));
    }
    return true;
}

/* ---- one order ---- */

/* A free constant that is not 0: a fixed choice among many. */
static ulong constant(work *w)
{
    enum { high_bits = 33 };
    w->state = w->state * 6364136223846793005u + 1442695040888963407u;
    return 1 + (ulong)(w->state >> high_bits) % (w->mod.n - 1);
}

/* The coefficient of t^(m - 2) in side + slope out, without what t^-2 of the slope gives. */
static ulong other_side(const work *w, const series *slope, const series *side, const series *out, slong m)
{
    ulong sum = at(side, m + pole);
    for (slong i = slope->low + 1; i <= m + pole - out->low; i++)
        NMOD_ADDMUL(sum, at(slope, i), at(out, m + pole - i), w->mod);
    return sum;
}

/* The solution of y'' - slope y = side.  -1: a logarithm, where *power says; 0: the series is too short; 1: done. */
static int solve(work *w, exponents e, const series *slope, const series *side, series *out, slong *power)
{
    slong low = least(e.low, is_nothing(side) ? e.low : side->low - pole);
    slong known = slope->known - pole + low;
    if (!is_nothing(side)) known = least(known, side->known - pole);
    if (known <= e.high) return 0;
    series_zero(out);
    out->low = low;
    out->known = known;
    for (slong m = low; m < known; m++) {
        ulong sum = other_side(w, slope, side, out, m);
        slong factor = (m - e.low) * (m - e.high);
        if (!factor && sum) {
            *power = m;
            return -1;
        }
        ulong value = factor ? nmod_mul(sum, n_invmod(whole(factor, w->mod), w->mod.n), w->mod) : constant(w);
        nmod_poly_set_coeff_ui(out->c, m - low, value);
    }
    return 1;
}

static series *part(const work *w, int direction, unsigned power, unsigned k)
{
    return w->power[direction] + power * (w->orders + 1) + k;
}

/* The e^k-parts of all powers, from those of the first. */
static void fill_powers(work *w, unsigned k)
{
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++)
        for (unsigned i = 2; i <= w->most[d]; i++) {
            series_zero(part(w, d, i, k));
            for (unsigned l = 0; l <= k; l++)
                add_product(part(w, d, i, k), part(w, d, i - 1, l), part(w, d, 1, k - l), 1);
        }
}

/* The e^k-part of a rate. */
static void rate_part(const work *w, int direction, unsigned k, series *out)
{
    const nh_higher_polynomial *p = &w->system->rate[direction];
    series_zero(out);
    for (size_t i = 0; i < p->count; i++)
        for (unsigned l = 0; l <= k; l++)
            add_product(out, part(w, NH_HIGHER_ALONG, p->u[i], l), part(w, NH_HIGHER_ACROSS, p->z[i], k - l),
                        w->coefficient[direction][i]);
}

static exponents exponents_of(const work *w, int direction)
{
    slong n = direction == NH_HIGHER_ALONG ? -along_low : w->system->exponent;
    return (exponents){.low = -n, .high = n + 1};
}

/* As solve, for both directions: first z_k, which u_k depends on where the inertia couples u and z; u_k does not enter
 * the equation of z_k, since g(u, 0) = 0. */
static int next_order(work *w, unsigned k, nh_higher_logarithm *out)
{
    int done = 1;
    series side;
    series_init(&side, w->mod);
    for (int d = NH_HIGHER_DIRECTIONS; d-- > 0 && done > 0;) {
        slong power = 0;
        fill_powers(w, k); /* what is not found of order k is 0 until now */
        rate_part(w, d, k, &side);
        done = solve(w, exponents_of(w, d), &w->slope[d], &side, part(w, d, 1, k), &power);
        if (done < 0) *out = (nh_higher_logarithm){.order = k, .across = d == NH_HIGHER_ACROSS, .power = power};
    }
    fill_powers(w, k);
    nmod_poly_clear(side.c);
    return done;
}

/* ---- all orders ---- */

/* c_0 + c_1 u_0 */
static void put_slope(const work *w, const ulong *c, series *out)
{
    series number;
    series_init(&number, w->mod);
    number.low = 0;
    nmod_poly_one(number.c);
    series_zero(out);
    add_product(out, part(w, NH_HIGHER_ALONG, 1, 0), &number, 1);
    nmod_poly_scalar_mul_nmod(out->c, out->c, c[1]);
    if (c[0]) add_product(out, &number, &number, c[0]);
    nmod_poly_clear(number.c);
}

/* f_u(u_0, 0) = sigma''(u_0)/2 */
static bool put_slopes(work *w)
{
    ulong c[2], sigma[cubic + 1];
    if (!residues(w->system->normal, w->mod, c, 2)) return false;
    put_slope(w, c, &w->slope[NH_HIGHER_ACROSS]);
    if (!residues(w->system->curve, w->mod, sigma, cubic + 1)) return false;
    c[0] = sigma[2];
    c[1] = nmod_mul(cubic, sigma[cubic], w->mod);
    put_slope(w, c, &w->slope[NH_HIGHER_ALONG]);
    return true;
}

static void work_init(work *w, const nh_higher_system *s, ulong prime, unsigned orders)
{
    enum { seed = 2026 };
    *w = (work){.system = s, .orders = orders, .state = seed};
    nmod_init(&w->mod, prime);
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++) w->most[d] = 1;
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++)
        for (size_t i = 0; i < s->rate[d].count; i++) {
            if (s->rate[d].u[i] > w->most[NH_HIGHER_ALONG]) w->most[NH_HIGHER_ALONG] = s->rate[d].u[i];
            if (s->rate[d].z[i] > w->most[NH_HIGHER_ACROSS]) w->most[NH_HIGHER_ACROSS] = s->rate[d].z[i];
        }
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++) {
        size_t all = (w->most[d] + 1) * (orders + 1);
        w->power[d] = nh_alloc_array(all, sizeof *w->power[d]);
        for (size_t i = 0; i < all; i++) series_init(w->power[d] + i, w->mod);
        series_init(&w->slope[d], w->mod);
        w->coefficient[d] = nh_alloc_array(s->rate[d].count + 1, sizeof *w->coefficient[d]);
        part(w, d, 0, 0)->low = 0; /* 1, known everywhere */
        nmod_poly_one(part(w, d, 0, 0)->c);
    }
}

static void work_clear(work *w)
{
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++) {
        size_t all = (w->most[d] + 1) * (w->orders + 1);
        for (size_t i = 0; i < all; i++) nmod_poly_clear(w->power[d][i].c);
        nmod_poly_clear(w->slope[d].c);
        nh_free(w->power[d]);
        nh_free(w->coefficient[d]);
    }
}

static bool begin(work *w, slong length)
{
    bool good = true;
    for (int d = 0; d < NH_HIGHER_DIRECTIONS; d++)
        for (size_t i = 0; i < w->system->rate[d].count && good; i++)
            good = residue(w->system->rate[d].coefficient + i, w->mod, w->coefficient[d] + i);
    good = good && motion(w, length, part(w, NH_HIGHER_ALONG, 1, 0)) && put_slopes(w);
    if (good) fill_powers(w, 0);
    return good;
}

/* As solve; the series of the motion has `length` coefficients.  -2: the prime will not do. */
static int find(const nh_higher_system *s, ulong prime, unsigned most, slong length, nh_higher_logarithm *out)
{
    work w;
    work_init(&w, s, prime, most);
    int done = begin(&w, length) ? 1 : -2;
    for (unsigned k = 1; k <= most && done > 0; k++) done = next_order(&w, k, out);
    work_clear(&w);
    return done;
}

bool nh_higher_logarithm_find(const nh_higher_system *s, ulong prime, unsigned most, nh_higher_logarithm *out)
{
    int done = 0;
    *out = (nh_higher_logarithm){0};
    if (prime < smallest_prime) return false;
    for (slong length = shortest; length <= longest && !done; length *= 2) done = find(s, prime, most, length, out);
    return done == 1 || done == -1;
}
