/* Special values over the rationals, by FLINT's polynomials in several variables. */
#include "classify/special_values.h"

#include <flint/fmpq.h>
#include <flint/fmpz_mpoly_factor.h>
#include <flint/fmpz_vec.h>
#include <flint/nmod_mpoly.h>
#include <flint/nmod_poly.h>
#include <flint/nmod_poly_factor.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "exact/fraction.h"

enum { most = NH_MOST_PARAMETERS };

/* ---- terms ---- */

static size_t length_of(const size_t degree[most]) { return (degree[0] + 1) * (degree[1] + 1) * (degree[2] + 1); }

/* The exponents of the coefficient with this index. */
static void exponents_of(const size_t degree[most], size_t index, ulong e[most])
{
    for (int v = 0; v < most; v++) {
        e[v] = index % (degree[v] + 1);
        index /= degree[v] + 1;
    }
}

size_t nh_special_length(const nh_special_factor *s) { return length_of(s->degree); }

int nh_special_variable(const nh_special_factor *s, size_t degree)
{
    int v = 0;
    while (v < most && (degree ? s->degree[v] != degree : !s->degree[v])) v++;
    return v;
}

bool nh_special_rational(const nh_special_factor *s, int64_t *top, int64_t *bottom)
{
    if (s->degree[0] + s->degree[1] + s->degree[2] != 1) return false;
    *top = -s->coefficient[0];
    *bottom = s->coefficient[1];
    return true;
}

/* By degrees, then by coefficients from the highest on. */
static int by_size(const void *a, const void *b)
{
    const nh_special_factor *x = a, *y = b;
    for (int v = 0; v < most; v++)
        if (x->degree[v] != y->degree[v]) return x->degree[v] < y->degree[v] ? -1 : 1;
    for (size_t k = length_of(x->degree); k-- > 0;)
        if (x->coefficient[k] != y->coefficient[k]) return x->coefficient[k] < y->coefficient[k] ? -1 : 1;
    return 0;
}

bool nh_special_same(const nh_special_factor *a, const nh_special_factor *b) { return by_size(a, b) == 0; }

nh_special_factor nh_special_copy(const nh_special_factor *from)
{
    nh_special_factor out = *from;
    size_t count = length_of(from->degree);
    out.coefficient = nh_alloc_array(count, sizeof *out.coefficient);
    memcpy(out.coefficient, from->coefficient, count * sizeof *out.coefficient);
    return out;
}

/* ---- lifting ---- */

/* Rational numbers from their residues modulo all primes but the last, which has to confirm them, times their common
 * denominator.  The caller frees the vector by _fmpz_vec_clear(.., count); NULL: a number was not confirmed. */
static fmpz *lift_numbers(size_t primes, const nh_prime *prime, size_t count, const nh_residue_polynomial *residue)
{
    fmpq_t *q = nh_alloc_array(count, sizeof *q);
    nh_residue *r = nh_alloc_array(primes, sizeof *r);
    fmpz *out = _fmpz_vec_init((slong)count);
    fmpz_t common;
    bool good = true;
    fmpz_init_set_ui(common, 1);
    for (size_t k = 0; k < count; k++) fmpq_init(q[k]);
    for (size_t k = 0; k < count && good; k++) {
        for (size_t i = 0; i < primes; i++) r[i] = residue[i].coefficient[k];
        good = nh_fraction_of(primes, prime, r, q[k]);
        fmpz_lcm(common, common, fmpq_denref(q[k]));
    }
    for (size_t k = 0; k < count && good; k++) {
        fmpz_divexact(out + k, common, fmpq_denref(q[k]));
        fmpz_mul(out + k, out + k, fmpq_numref(q[k]));
    }
    for (size_t k = 0; k < count; k++) fmpq_clear(q[k]);
    fmpz_clear(common);
    nh_free(r);
    nh_free(q);
    if (good) return out;
    _fmpz_vec_clear(out, (slong)count);
    return NULL;
}

/* Converts a factor.  False: a coefficient is too long for 64 bits. */
static bool take_factor(nh_special_factor *out, const fmpz_mpoly_struct *p, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_t c;
    bool good = true;
    fmpz_init(c);
    for (int v = 0; v < most; v++) {
        slong degree = fmpz_mpoly_degree_si(p, v, ctx);
        out->degree[v] = degree > 0 ? (size_t)degree : 0;
    }
    size_t width = out->degree[0] + 1, each = width * (out->degree[1] + 1);
    out->coefficient = nh_alloc_array(length_of(out->degree), sizeof *out->coefficient);
    for (slong z = 0; z < fmpz_mpoly_length(p, ctx) && good; z++) {
        ulong e[most];
        fmpz_mpoly_get_term_exp_ui(e, p, z, ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, z, ctx);
        good = fmpz_fits_si(c);
        if (good) out->coefficient[e[2] * each + e[1] * width + e[0]] = fmpz_get_si(c);
    }
    fmpz_clear(c);
    return good;
}

nh_special_factors nh_special_lift(size_t primes, const nh_prime *prime, const nh_residue_polynomial *residue)
{
    nh_special_factors out = {.norm = 1};
    size_t count = length_of(residue[0].degree);
    fmpz *number = primes > 1 ? lift_numbers(primes, prime, count, residue) : NULL;
    if (!number) return out;
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t p;
    fmpz_mpoly_factor_t factors;
    fmpz_mpoly_ctx_init(ctx, most, ORD_LEX);
    fmpz_mpoly_init(p, ctx);
    fmpz_mpoly_factor_init(factors, ctx);
    out.norm = 0;
    for (size_t z = 0; z < count; z++) {
        ulong e[most];
        exponents_of(residue[0].degree, z, e);
        if (!fmpz_is_zero(number + z)) fmpz_mpoly_set_coeff_fmpz_ui(p, number + z, e, ctx);
        out.norm += fabs(fmpz_get_d(number + z));
    }
    out.lifted = fmpz_mpoly_factor(factors, p, ctx);
    out.factor = nh_alloc_array((size_t)factors->num + 1, sizeof *out.factor);
    for (slong k = 0; k < factors->num; k++)
        out.lifted &= take_factor(&out.factor[out.factors++], factors->poly + k, ctx);
    qsort(out.factor, out.factors, sizeof *out.factor, by_size);
    fmpz_mpoly_factor_clear(factors, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpz_mpoly_ctx_clear(ctx);
    _fmpz_vec_clear(number, (slong)count);
    return out;
}

void nh_special_factors_clear(nh_special_factors *f)
{
    for (size_t k = 0; k < f->factors; k++) nh_free(f->factor[k].coefficient);
    nh_free(f->factor);
}

/* ---- modulo a prime ---- */

/* The least root; false: there is none, or the degree is lower modulo the prime. */
static bool least_root(const nmod_poly_t p, size_t degree, nh_prime f, nh_residue *root)
{
    nmod_poly_factor_t parts;
    bool found = false;
    nmod_poly_factor_init(parts);
    if (nmod_poly_degree(p) == (slong)degree) nmod_poly_factor(parts, p);
    for (slong k = 0; k < parts->num; k++) {
        if (nmod_poly_degree(parts->p + k) != 1) continue;
        nh_residue top = (nh_residue)nmod_poly_get_coeff_ui(parts->p + k, 1),
                   bottom = (nh_residue)nmod_poly_get_coeff_ui(parts->p + k, 0);
        nh_residue x = nh_residue_negative(f, nh_residue_mul(f, bottom, nh_residue_inverse(f, top)));
        if (!found || x < *root) *root = x;
        found = true;
    }
    nmod_poly_factor_clear(parts);
    return found;
}

bool nh_special_point(const nh_special_factor *s, nh_prime f, uint64_t seed, nh_residue at[most])
{
    enum { tries = 40 };
    uint64_t random = seed;
    int v = nh_special_variable(s, 0);
    bool found = false;
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (int k = 0; k < tries && !found && v < most; k++) {
        for (int i = 0; i < most; i++) at[i] = nh_residue_random(f, &random);
        nmod_poly_zero(p);
        for (size_t z = 0; z < length_of(s->degree); z++) {
            ulong e[most];
            exponents_of(s->degree, z, e);
            nh_residue c = nh_residue_of(f, s->coefficient[z]);
            for (int i = 0; i < most; i++)
                if (i != v) c = nh_residue_mul(f, c, nh_residue_power(f, at[i], e[i]));
            nmod_poly_set_coeff_ui(p, (slong)e[v],
                                   nh_residue_add(f, (nh_residue)nmod_poly_get_coeff_ui(p, (slong)e[v]), c));
        }
        found = least_root(p, s->degree[v], f, &at[v]);
    }
    nmod_poly_clear(p);
    return found;
}

/* p += c times the monomial */
static void add_term(nmod_mpoly_t p, nh_prime f, nh_residue c, const ulong *e, const nmod_mpoly_ctx_t ctx)
{
    nh_residue sum = nh_residue_add(f, (nh_residue)nmod_mpoly_get_coeff_ui_ui(p, e, ctx), c);
    nmod_mpoly_set_coeff_ui_ui(p, sum, e, ctx);
}

bool nh_special_cover(size_t factors, const nh_special_factor *s, nh_prime f, int v, nh_residue value,
                      const nh_residue_polynomial *polynomial)
{
    nmod_mpoly_ctx_t ctx;
    nmod_mpoly_t all, p;
    nmod_mpoly_ctx_init(ctx, most, ORD_LEX, f.p);
    nmod_mpoly_init(all, ctx);
    nmod_mpoly_init(p, ctx);
    nmod_mpoly_one(all, ctx);
    for (size_t k = 0; k < factors; k++) {
        nmod_mpoly_zero(p, ctx);
        for (size_t z = 0; z < length_of(s[k].degree); z++) {
            ulong e[most];
            exponents_of(s[k].degree, z, e);
            nh_residue c = nh_residue_of(f, s[k].coefficient[z]);
            if (v < most) c = nh_residue_mul(f, c, nh_residue_power(f, value, e[v]));
            if (v < most) e[v] = 0;
            if (c) add_term(p, f, c, e, ctx);
        }
        nmod_mpoly_mul(all, all, p, ctx);
    }
    bool covered = !nmod_mpoly_is_zero(all, ctx);
    nmod_mpoly_zero(p, ctx);
    for (size_t z = 0; z < length_of(polynomial->degree); z++) {
        ulong e[most];
        exponents_of(polynomial->degree, z, e);
        if (polynomial->coefficient[z]) add_term(p, f, polynomial->coefficient[z], e, ctx);
    }
    covered = covered && !nmod_mpoly_is_zero(p, ctx) && nmod_mpoly_divides(all, all, p, ctx);
    nmod_mpoly_clear(p, ctx);
    nmod_mpoly_clear(all, ctx);
    nmod_mpoly_ctx_clear(ctx);
    return covered;
}

/* ---- places ---- */

static void read_factor(const nh_special_factor *s, fmpz_mpoly_t out, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_mpoly_zero(out, ctx);
    for (size_t z = 0; z < length_of(s->degree); z++) {
        ulong e[most];
        exponents_of(s->degree, z, e);
        if (s->coefficient[z]) fmpz_mpoly_set_coeff_si_ui(out, s->coefficient[z], e, ctx);
    }
}

/* Writes b/a for parameter v in p, times a^degree, where a v - b = 0 is the equation. */
static void substitute(fmpz_mpoly_t p, int v, const nh_special_factor *equation, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_mpoly_t with, a, b, c, sum, power;
    fmpz_mpoly_struct *all[] = {with, a, b, c, sum, power};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) fmpz_mpoly_init(all[k], ctx);
    read_factor(equation, with, ctx);
    fmpz_mpoly_get_coeff_vars_ui(a, with, (slong[]){v}, (ulong[]){1}, 1, ctx);
    fmpz_mpoly_get_coeff_vars_ui(b, with, (slong[]){v}, (ulong[]){0}, 1, ctx);
    fmpz_mpoly_neg(b, b, ctx);
    fmpz_mpoly_one(power, ctx);
    slong degree = fmpz_mpoly_degree_si(p, v, ctx);
    for (slong e = degree; e >= 0; e--) { /* Horner's scheme */
        fmpz_mpoly_get_coeff_vars_ui(c, p, (slong[]){v}, (ulong[]){(ulong)e}, 1, ctx);
        fmpz_mpoly_mul(sum, sum, b, ctx);
        fmpz_mpoly_mul(c, c, power, ctx);
        fmpz_mpoly_add(sum, sum, c, ctx);
        fmpz_mpoly_mul(power, power, a, ctx);
    }
    fmpz_mpoly_swap(p, sum, ctx);
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) fmpz_mpoly_clear(all[k], ctx);
}

bool nh_special_contains(const nh_special_factor *s, const nh_special_place *place)
{
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t p, last;
    fmpz_mpoly_ctx_init(ctx, most, ORD_LEX);
    fmpz_mpoly_init(p, ctx);
    fmpz_mpoly_init(last, ctx);
    read_factor(s, p, ctx);
    for (size_t k = 0; k + 1 < place->count; k++) substitute(p, place->gives[k], &place->equation[k], ctx);
    read_factor(&place->equation[place->count - 1], last, ctx);
    bool inside = fmpz_mpoly_is_zero(p, ctx) || fmpz_mpoly_divides(p, p, last, ctx);
    fmpz_mpoly_clear(last, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpz_mpoly_ctx_clear(ctx);
    return inside;
}

/* ---- real zeros ---- */

static double value_of(size_t degree, const double *c, double x)
{
    double y = 0;
    for (size_t j = degree + 1; j-- > 0;) y = y * x + c[j];
    return y;
}

/* The real roots of c_0 + c_1 x + .., ascending: between roots of the derivative a polynomial is monotone. */
static size_t real_roots(size_t degree, const double *c, double *out)
{
    while (degree && c[degree] == 0) degree--;
    if (degree == 0) return 0;
    double *slope = nh_alloc_array(degree, sizeof *slope), *turn = nh_alloc_array(degree + 2, sizeof *turn), bound = 0;
    for (size_t j = 1; j <= degree; j++) slope[j - 1] = (double)j * c[j];
    for (size_t j = 0; j < degree; j++) bound = fmax(bound, fabs(c[j] / c[degree]));
    size_t turns = real_roots(degree - 1, slope, turn + 1), count = 0;
    turn[0] = -1 - bound; /* Cauchy's bound */
    turn[turns + 1] = 1 + bound;
    for (size_t k = 0; k <= turns; k++) {
        double low = turn[k], high = turn[k + 1], sign = value_of(degree, c, low);
        if (sign * value_of(degree, c, high) > 0) continue;
        for (int step = 0; step < 200; step++) {
            double middle = low + (high - low) / 2;
            if (sign * value_of(degree, c, middle) > 0) low = middle;
            else high = middle;
        }
        out[count++] = high;
    }
    nh_free(turn);
    nh_free(slope);
    return count;
}

size_t nh_special_reals(const nh_special_factor *s, int v, const double at[most], double *out)
{
    double *c = nh_alloc_array(s->degree[v] + 1, sizeof *c);
    for (size_t z = 0; z < length_of(s->degree); z++) {
        ulong e[most];
        exponents_of(s->degree, z, e);
        double term = (double)s->coefficient[z];
        for (int w = 0; w < most; w++)
            if (w != v && e[w]) term *= pow(at[w], (double)e[w]);
        c[e[v]] += term;
    }
    size_t count = real_roots(s->degree[v], c, out);
    nh_free(c);
    return count;
}
