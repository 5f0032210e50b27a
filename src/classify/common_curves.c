/* Common zeros modulo a prime, by FLINT's polynomials in two variables; resultants are interpolated from their
 * values. */
#include "classify/common_curves.h"

#include <flint/nmod_mpoly.h>
#include <flint/nmod_mpoly_factor.h>
#include <flint/nmod_poly.h>

#include "base/memory.h"
#include "base/progress.h"

enum { combinations = 3 };

/* ---- in and out ---- */

static void take(nmod_mpoly_t out, const nh_residue_surface *x, const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_zero(out, ctx);
    for (size_t i = x->degree[0] + 1; i-- > 0;)
        for (size_t j = x->degree[1] + 1; j-- > 0;) {
            nh_residue c = x->coefficient[j * (x->degree[0] + 1) + i];
            if (c) nmod_mpoly_push_term_ui_ui(out, c, (ulong[]){i, j}, ctx);
        }
}

static nh_residue_surface written(const nmod_mpoly_t p, const nmod_mpoly_ctx_t ctx)
{
    nh_residue_surface out = {.degree = {0}};
    for (int v = 0; v < 2; v++) {
        slong degree = nmod_mpoly_degree_si(p, v, ctx);
        out.degree[v] = degree > 0 ? (size_t)degree : 0;
    }
    out.coefficient = nh_alloc_array((out.degree[0] + 1) * (out.degree[1] + 1), sizeof *out.coefficient);
    for (slong k = 0; k < nmod_mpoly_length(p, ctx); k++) {
        ulong e[2];
        nmod_mpoly_get_term_exp_ui(e, p, k, ctx);
        out.coefficient[e[1] * (out.degree[0] + 1) + e[0]] = (nh_residue)nmod_mpoly_get_term_coeff_ui(p, k, ctx);
    }
    return out;
}

nh_residue_surface nh_residue_surface_times(nh_prime f, const nh_residue_surface *x, const nh_residue_surface *y)
{
    nh_residue_surface out = {.degree = {x->degree[0] + y->degree[0], x->degree[1] + y->degree[1]}};
    size_t a = x->degree[0] + 1, b = y->degree[0] + 1, c = out.degree[0] + 1;
    out.coefficient = nh_alloc_array(c * (out.degree[1] + 1), sizeof *out.coefficient);
    for (size_t j = 0; j <= x->degree[1]; j++)
        for (size_t k = 0; k <= y->degree[1]; k++)
            for (size_t i = 0; i < a; i++)
                nh_residue_add_multiple(f, b, out.coefficient + (j + k) * c + i, y->coefficient + k * b,
                                        x->coefficient[j * a + i]);
    return out;
}

/* ---- common factors ---- */

/* The greatest common divisor of all of them. */
static void common(nmod_mpoly_t out, size_t count, nmod_mpoly_t *p, const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_zero(out, ctx);
    for (size_t k = 0; k < count && !nmod_mpoly_is_one(out, ctx); k++) nmod_mpoly_gcd(out, out, p[k], ctx);
}

/* The squarefree part. */
static void without_multiplicity(nmod_mpoly_t p, const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_factor_t factors;
    nmod_mpoly_factor_init(factors, ctx);
    nmod_mpoly_factor_squarefree(factors, p, ctx);
    nmod_mpoly_one(p, ctx);
    for (slong k = 0; k < factors->num; k++) nmod_mpoly_mul(p, p, factors->poly + k, ctx);
    if (!nmod_mpoly_is_zero(p, ctx)) nmod_mpoly_make_monic(p, p, ctx);
    nmod_mpoly_factor_clear(factors, ctx);
}

/* ---- isolated zeros ---- */

/* Values at 1, 2, .. of all coefficients in lambda: value[k * (degree[0] + 1) + i]. */
static ulong *values_of(const nh_residue_surface *x, nh_prime f, size_t count)
{
    size_t width = x->degree[0] + 1;
    ulong *value = nh_alloc_array(count * width, sizeof *value), *place = nh_alloc_array(2 * count, sizeof *place);
    nmod_poly_t p;
    nmod_poly_init(p, f.p);
    for (size_t k = 0; k < count; k++) place[k] = k + 1;
    for (size_t i = 0; i < width && !nh_late(); i++) {
        nmod_poly_zero(p);
        for (size_t j = 0; j <= x->degree[1]; j++) nmod_poly_set_coeff_ui(p, (slong)j, x->coefficient[j * width + i]);
        nmod_poly_evaluate_nmod_vec(place + count, p, place, (slong)count);
        for (size_t k = 0; k < count; k++) value[k * width + i] = place[count + k];
    }
    nmod_poly_clear(p);
    nh_free(place);
    return value;
}

static void in_lambda(size_t width, const ulong *value, nmod_poly_t out)
{
    nmod_poly_zero(out);
    for (size_t i = width; i-- > 0;) nmod_poly_set_coeff_ui(out, (slong)i, value[i]);
}

/* Res_lambda of the first combination and another, in mu, from its values where neither has a lower degree. */
static bool resultant(const nh_residue_surface *x, const nh_residue_surface *y, nh_prime f, nmod_poly_t out)
{
    enum { spare = 8 };
    size_t count = x->degree[0] * y->degree[1] + x->degree[1] * y->degree[0] + 1, have = 0, all = count + spare;
    ulong *place = nh_alloc_array(count, sizeof *place), *value = nh_alloc_array(count, sizeof *value);
    ulong *of_x = values_of(x, f, all), *of_y = values_of(y, f, all);
    nmod_poly_t a, b;
    nmod_poly_init(a, f.p);
    nmod_poly_init(b, f.p);
    for (size_t k = 0; k < all && have < count && !nh_late(); k++) {
        in_lambda(x->degree[0] + 1, of_x + k * (x->degree[0] + 1), a);
        in_lambda(y->degree[0] + 1, of_y + k * (y->degree[0] + 1), b);
        if (nmod_poly_degree(a) < (slong)x->degree[0] || nmod_poly_degree(b) < (slong)y->degree[0]) continue;
        place[have] = k + 1;
        value[have++] = nmod_poly_resultant(a, b);
    }
    bool good = have == count;
    if (good) nmod_poly_interpolate_nmod_vec(out, place, value, (slong)count);
    nmod_poly_clear(b);
    nmod_poly_clear(a);
    nh_free(of_y);
    nh_free(of_x);
    nh_free(value);
    nh_free(place);
    return good;
}

static nh_residue_surface combined(nh_prime f, size_t count, nmod_mpoly_t *p, uint64_t *random,
                                   const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_t sum, part;
    nmod_mpoly_init(sum, ctx);
    nmod_mpoly_init(part, ctx);
    for (size_t k = 0; k < count; k++) {
        nmod_mpoly_scalar_mul_ui(part, p[k], nh_residue_random(f, random), ctx);
        nmod_mpoly_add(sum, sum, part, ctx);
    }
    nh_residue_surface out = written(sum, ctx);
    nmod_mpoly_clear(part, ctx);
    nmod_mpoly_clear(sum, ctx);
    return out;
}

static bool find_across(nh_prime f, size_t count, nmod_mpoly_t *p, const nmod_mpoly_ctx_t ctx,
                        nh_residue_polynomial *out)
{
    uint64_t random = 99991;
    nh_residue_surface x[combinations];
    nmod_poly_t sum, part;
    bool good = true;
    nmod_poly_init(sum, f.p);
    nmod_poly_init(part, f.p);
    for (size_t k = 0; k < combinations; k++) x[k] = combined(f, count, p, &random, ctx);
    for (size_t k = 1; k < combinations && good; k++) {
        good = resultant(&x[0], &x[k], f, part);
        nmod_poly_gcd(sum, sum, part);
    }
    nmod_poly_derivative(part, sum);
    nmod_poly_gcd(part, sum, part);
    if (nmod_poly_degree(sum) > 0) nmod_poly_div(sum, sum, part);
    out->degree = nmod_poly_degree(sum) > 0 ? (size_t)nmod_poly_degree(sum) : 0;
    out->coefficient = nh_alloc_array(out->degree + 1, sizeof *out->coefficient);
    for (size_t j = 0; j <= out->degree; j++) out->coefficient[j] = (nh_residue)nmod_poly_get_coeff_ui(sum, (slong)j);
    for (size_t k = 0; k < combinations; k++) nh_free(x[k].coefficient);
    nmod_poly_clear(part);
    nmod_poly_clear(sum);
    return good;
}

/* ---- both ---- */

bool nh_common_curves_find(nh_prime f, size_t polynomials, const nh_residue_surface *polynomial, size_t singulars,
                           const nh_residue_surface *singular, nh_common_curves *out)
{
    size_t all = polynomials + singulars;
    nmod_mpoly_ctx_t ctx;
    nmod_mpoly_t special, degenerate, *p = nh_alloc_array(all, sizeof *p);
    nmod_mpoly_ctx_init(ctx, 2, ORD_LEX, f.p);
    nmod_mpoly_init(special, ctx);
    nmod_mpoly_init(degenerate, ctx);
    for (size_t k = 0; k < all; k++) {
        nmod_mpoly_init(p[k], ctx);
        take(p[k], k < polynomials ? &polynomial[k] : &singular[k - polynomials], ctx);
    }
    common(special, polynomials, p, ctx);
    common(degenerate, singulars, p + polynomials, ctx);
    for (size_t k = 0; k < polynomials; k++) nmod_mpoly_divides(p[k], p[k], special, ctx);
    bool good = find_across(f, polynomials, p, ctx, &out->across);
    without_multiplicity(special, ctx);
    without_multiplicity(degenerate, ctx);
    nmod_mpoly_gcd(p[0], special, degenerate, ctx);
    nmod_mpoly_divides(special, special, p[0], ctx);
    out->special = written(special, ctx);
    out->degenerate = written(degenerate, ctx);
    for (size_t k = 0; k < all; k++) nmod_mpoly_clear(p[k], ctx);
    nmod_mpoly_clear(degenerate, ctx);
    nmod_mpoly_clear(special, ctx);
    nmod_mpoly_ctx_clear(ctx);
    nh_free(p);
    return good;
}

void nh_common_curves_clear(nh_common_curves *c)
{
    nh_free(c->special.coefficient);
    nh_free(c->degenerate.coefficient);
    nh_free(c->across.coefficient);
}
