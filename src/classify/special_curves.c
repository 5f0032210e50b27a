/* Special curves and surfaces over the rationals: FLINT's polynomials in several variables. */
#include "classify/special_curves_internal.h"

#include <flint/fmpz_mpoly_factor.h>
#include <flint/fmpz_poly.h>
#include <flint/fmpz_vec.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "base/memory.h"
#include "classify/special_values_internal.h"

/* ---- lifting ---- */

static size_t length_of(const size_t degree[3]) { return (degree[0] + 1) * (degree[1] + 1) * (degree[2] + 1); }

/* False: the last prime does not agree. */
static bool lift(size_t primes, const nh_prime *prime, const nh_residue_surface *residue, fmpz_mpoly_t out,
                 const fmpz_mpoly_ctx_t ctx)
{
    const size_t *degree = residue[0].degree;
    size_t count = length_of(degree), width = degree[0] + 1, each = width * (degree[1] + 1);
    const nh_residue **all = nh_alloc_array(primes, sizeof *all);
    for (size_t i = 0; i < primes; i++) all[i] = residue[i].coefficient;
    fmpz *x = nh_special_lift_numbers(primes, prime, count, all);
    nh_free(all);
    if (!x) return false;
    for (size_t z = 0; z < count; z++)
        if (!fmpz_is_zero(x + z))
            fmpz_mpoly_set_coeff_fmpz_ui(out, x + z, (ulong[]){z % width, z % each / width, z / each}, ctx);
    _fmpz_vec_clear(x, (slong)count);
    return true;
}

bool nh_special_surface_take(nh_special_surface *out, const fmpz_mpoly_struct *p, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_t c;
    bool good = true;
    fmpz_init(c);
    for (int v = 0; v < 3; v++) {
        slong degree = fmpz_mpoly_degree_si(p, v, ctx);
        out->degree[v] = degree > 0 ? (size_t)degree : 0;
    }
    size_t width = out->degree[0] + 1, each = width * (out->degree[1] + 1);
    out->coefficient = nh_alloc_array(length_of(out->degree), sizeof *out->coefficient);
    for (slong z = 0; z < fmpz_mpoly_length(p, ctx) && good; z++) {
        ulong e[3];
        fmpz_mpoly_get_term_exp_ui(e, p, z, ctx);
        fmpz_mpoly_get_term_coeff_fmpz(c, p, z, ctx);
        good = fmpz_fits_si(c);
        if (good) out->coefficient[e[2] * each + e[1] * width + e[0]] = fmpz_get_si(c);
    }
    fmpz_clear(c);
    return good;
}

/* By degrees, then by coefficients from the highest on. */
static int by_size(const void *a, const void *b)
{
    const nh_special_surface *x = a, *y = b;
    for (int v = 0; v < 3; v++)
        if (x->degree[v] != y->degree[v]) return x->degree[v] < y->degree[v] ? -1 : 1;
    for (size_t k = length_of(x->degree); k-- > 0;)
        if (x->coefficient[k] != y->coefficient[k]) return x->coefficient[k] < y->coefficient[k] ? -1 : 1;
    return 0;
}

bool nh_special_surface_same(const nh_special_surface *a, const nh_special_surface *b) { return by_size(a, b) == 0; }

nh_special_surface nh_special_surface_copy(const nh_special_surface *from)
{
    nh_special_surface out = *from;
    size_t count = length_of(from->degree);
    out.coefficient = nh_alloc_array(count, sizeof *out.coefficient);
    memcpy(out.coefficient, from->coefficient, count * sizeof *out.coefficient);
    return out;
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

nh_special_surfaces nh_special_surfaces_lift(size_t primes, const nh_prime *prime, const nh_residue_surface *residue)
{
    nh_special_surfaces out = {.norm = 1};
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t p;
    fmpz_mpoly_factor_t factors;
    fmpz_mpoly_ctx_init(ctx, 3, ORD_LEX);
    fmpz_mpoly_init(p, ctx);
    fmpz_mpoly_factor_init(factors, ctx);
    if (primes > 1 && lift(primes, prime, residue, p, ctx)) {
        out.norm = norm_of(p, ctx);
        out.lifted = fmpz_mpoly_factor(factors, p, ctx);
        out.surface = nh_alloc_array((size_t)factors->num + 1, sizeof *out.surface);
        for (slong k = 0; k < factors->num; k++)
            out.lifted &= nh_special_surface_take(&out.surface[out.surfaces++], factors->poly + k, ctx);
        qsort(out.surface, out.surfaces, sizeof *out.surface, by_size);
    }
    fmpz_mpoly_factor_clear(factors, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpz_mpoly_ctx_clear(ctx);
    return out;
}

void nh_special_surfaces_clear(nh_special_surfaces *s)
{
    for (size_t k = 0; k < s->surfaces; k++) nh_free(s->surface[k].coefficient);
    nh_free(s->surface);
}

/* ---- points ---- */

/* The polynomial at one value of a variable, as a polynomial in the other variable, modulo the prime. */
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
