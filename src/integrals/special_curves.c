/* Special curves over the rationals: FLINT's polynomials in two variables. */
#include "integrals/special_curves.h"

#include <flint/fmpz_mpoly.h>
#include <flint/fmpz_mpoly_factor.h>
#include <flint/fmpz_poly.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "integrals/special_values_internal.h"

/* ---- lifting ---- */

/* Coefficients times their common denominator; false: the last prime does not agree. */
static bool lift(size_t primes, const nh_prime *prime, const nh_residue_surface *residue, fmpz_mpoly_t out,
                 const fmpz_mpoly_ctx_t ctx)
{
    size_t width = residue[0].degree[0] + 1, count = width * (residue[0].degree[1] + 1);
    fmpq_t *q = nh_alloc_array(count, sizeof *q);
    nh_residue *r = nh_alloc_array(primes, sizeof *r);
    fmpz_t shared, x;
    bool good = true;
    fmpz_init_set_ui(shared, 1);
    fmpz_init(x);
    for (size_t k = 0; k < count; k++) fmpq_init(q[k]);
    for (size_t k = 0; k < count && good; k++) {
        for (size_t i = 0; i < primes; i++) r[i] = residue[i].coefficient[k];
        good = nh_special_reconstruct(primes, prime, r, q[k]);
        fmpz_lcm(shared, shared, fmpq_denref(q[k]));
    }
    for (size_t k = 0; k < count && good; k++) {
        fmpz_divexact(x, shared, fmpq_denref(q[k]));
        fmpz_mul(x, x, fmpq_numref(q[k]));
        if (!fmpz_is_zero(x)) fmpz_mpoly_set_coeff_fmpz_ui(out, x, (ulong[]){k % width, k / width}, ctx);
    }
    for (size_t k = 0; k < count; k++) fmpq_clear(q[k]);
    fmpz_clear(x);
    fmpz_clear(shared);
    nh_free(r);
    nh_free(q);
    return good;
}

/* False: too long for 64 bits. */
static bool take_curve(nh_special_curve *out, const fmpz_mpoly_struct *p, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_t c;
    bool good = true;
    fmpz_init(c);
    for (int v = 0; v < 2; v++) out->degree[v] = (size_t)fmpz_mpoly_degree_si(p, v, ctx);
    out->coefficient = nh_alloc_array((out->degree[0] + 1) * (out->degree[1] + 1), sizeof *out->coefficient);
    for (slong k = 0; k < fmpz_mpoly_length(p, ctx) && good; k++) {
        ulong e[2];
        fmpz_mpoly_get_term_exp_ui(e, p, k, ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, k, ctx);
        good = fmpz_fits_si(c);
        if (good) out->coefficient[e[1] * (out->degree[0] + 1) + e[0]] = fmpz_get_si(c);
    }
    fmpz_clear(c);
    return good;
}

/* By degrees, then by coefficients from the highest on. */
static int by_size(const void *a, const void *b)
{
    const nh_special_curve *x = a, *y = b;
    for (int v = 0; v < 2; v++)
        if (x->degree[v] != y->degree[v]) return x->degree[v] < y->degree[v] ? -1 : 1;
    for (size_t k = (x->degree[0] + 1) * (x->degree[1] + 1); k-- > 0;)
        if (x->coefficient[k] != y->coefficient[k]) return x->coefficient[k] < y->coefficient[k] ? -1 : 1;
    return 0;
}

static double norm_of(const fmpz_mpoly_t p, const fmpz_mpoly_ctx_t ctx)
{
    double sum = 0;
    fmpz_t c;
    fmpz_init(c);
    for (slong k = 0; k < fmpz_mpoly_length(p, ctx); k++) {
        fmpz_mpoly_get_term_coeff_fmpz(c, p, k, ctx);
        sum += fabs(fmpz_get_d(c));
    }
    fmpz_clear(c);
    return sum;
}

nh_special_curves nh_special_curves_lift(size_t primes, const nh_prime *prime, const nh_residue_surface *residue)
{
    nh_special_curves out = {.norm = 1};
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t p;
    fmpz_mpoly_factor_t factors;
    fmpz_mpoly_ctx_init(ctx, 2, ORD_LEX);
    fmpz_mpoly_init(p, ctx);
    fmpz_mpoly_factor_init(factors, ctx);
    if (primes > 1 && lift(primes, prime, residue, p, ctx)) {
        out.norm = norm_of(p, ctx);
        out.lifted = fmpz_mpoly_factor(factors, p, ctx);
        out.curve = nh_alloc_array((size_t)factors->num + 1, sizeof *out.curve);
        for (slong k = 0; k < factors->num; k++)
            out.lifted &= take_curve(&out.curve[out.curves++], factors->poly + k, ctx);
        qsort(out.curve, out.curves, sizeof *out.curve, by_size);
    }
    fmpz_mpoly_factor_clear(factors, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpz_mpoly_ctx_clear(ctx);
    return out;
}

void nh_special_curves_clear(nh_special_curves *c)
{
    for (size_t k = 0; k < c->curves; k++) nh_free(c->curve[k].coefficient);
    nh_free(c->curve);
}

/* ---- points ---- */

/* At one value of a variable, as a polynomial in the other, modulo the prime. */
static nh_residue_polynomial restricted(const nh_special_curve *c, nh_prime f, int fixed, nh_residue value)
{
    nh_residue_polynomial out = {.degree = c->degree[1 - fixed]};
    out.coefficient = nh_alloc_array(out.degree + 1, sizeof *out.coefficient);
    for (size_t k = 0; k <= out.degree; k++)
        for (size_t z = c->degree[fixed] + 1; z-- > 0;) {
            size_t i = fixed ? k : z, j = fixed ? z : k;
            nh_residue a = nh_residue_of(f, c->coefficient[j * (c->degree[0] + 1) + i]);
            out.coefficient[k] = nh_residue_add(f, nh_residue_mul(f, out.coefficient[k], value), a);
        }
    return out;
}

bool nh_special_curve_point(const nh_special_curve *c, nh_prime f, uint64_t seed, nh_residue *lambda, nh_residue *mu)
{
    enum { tries = 40 };
    uint64_t random = seed;
    int fixed = c->degree[0] > 0; /* mu, unless lambda does not occur */
    bool found = false;
    for (int k = 0; k < tries && !found; k++) {
        nh_residue value = nh_residue_random(f, &random), root;
        nh_residue_polynomial p = restricted(c, f, fixed, value);
        found = nh_residue_polynomial_root(&p, f, &root);
        nh_free(p.coefficient);
        if (found) *lambda = fixed ? root : value, *mu = fixed ? value : root;
    }
    return found;
}

size_t nh_special_curve_reals(const nh_special_curve *c, int fixed, double value, double *out)
{
    size_t degree = c->degree[1 - fixed];
    double *a = nh_alloc_array(degree + 1, sizeof *a);
    for (size_t k = 0; k <= degree; k++)
        for (size_t z = c->degree[fixed] + 1; z-- > 0;) {
            size_t i = fixed ? k : z, j = fixed ? z : k;
            a[k] = a[k] * value + (double)c->coefficient[j * (c->degree[0] + 1) + i];
        }
    size_t count = nh_special_roots_of(degree, a, out);
    nh_free(a);
    return count;
}

bool nh_special_curve_contains(const nh_special_curve *c, const nh_special_factor *lambda, int64_t top, int64_t bottom)
{
    fmpz_poly_t p, q;
    fmpz_t power, term;
    bool inside = true;
    fmpz_poly_init(p);
    fmpz_poly_init(q);
    fmpz_init(power);
    fmpz_init(term);
    for (size_t i = 0; i <= c->degree[0]; i++) { /* times bottom^degree */
        for (size_t j = 0; j <= c->degree[1]; j++) {
            fmpz_poly_get_coeff_fmpz(term, p, (slong)i);
            fmpz_set_si(power, top);
            fmpz_pow_ui(power, power, j);
            fmpz_mul_si(power, power, c->coefficient[j * (c->degree[0] + 1) + i]);
            for (size_t k = j; k < c->degree[1]; k++) fmpz_mul_si(power, power, bottom);
            fmpz_add(term, term, power);
            fmpz_poly_set_coeff_fmpz(p, (slong)i, term);
        }
    }
    for (size_t i = 0; i <= lambda->degree; i++) fmpz_poly_set_coeff_si(q, (slong)i, lambda->coefficient[i]);
    if (!fmpz_poly_is_zero(p)) {
        fmpz_poly_gcd(p, p, q);
        inside = fmpz_poly_degree(p) == fmpz_poly_degree(q);
    }
    fmpz_clear(term);
    fmpz_clear(power);
    fmpz_poly_clear(q);
    fmpz_poly_clear(p);
    return inside;
}
