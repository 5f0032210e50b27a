/* Common zeros modulo a prime (common_zeros.h), by FLINT's polynomials in two variables.
 *
 *      P_1, P_2, ..                            one from each point, times Q
 *      G = gcd                                 curves (values of one parameter), squarefree
 *      P_i/G                                   what is left has isolated zeros only:
 *      R_k(mu) = Res_lambda(sum_i r_i P_i/G, sum_i s_i P_i/G)     for random r, s, interpolated from values of mu
 *      E(mu) = gcd of the R_k                  the mu of isolated zeros
 *
 *      sections at several nu: monic polynomials; each coefficient is a rational function of nu, read off by the
 *      extended Euclidean algorithm for its values */
#include "classify/common_zeros.h"

#include <flint/nmod.h>
#include <flint/nmod_mpoly.h>
#include <flint/nmod_mpoly_factor.h>
#include <flint/nmod_poly.h>
#include <string.h>

#include "base/memory.h"
#include "base/progress.h"

enum { combinations = 3 };

/* ---- in and out ---- */

/* From the array of coefficients to FLINT's form. */
static void take(nmod_mpoly_t out, const nh_residue_polynomial *x, const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_zero(out, ctx);
    for (size_t i = x->degree[0] + 1; i-- > 0;)
        for (size_t j = x->degree[1] + 1; j-- > 0;) {
            nh_residue c = x->coefficient[j * (x->degree[0] + 1) + i];
            if (c) nmod_mpoly_push_term_ui_ui(out, c, (ulong[]){i, j}, ctx);
        }
}

/* Back to an array, on the heap. */
static nh_residue_polynomial written(const nmod_mpoly_t p, const nmod_mpoly_ctx_t ctx)
{
    nh_residue_polynomial out = {.degree = {0}};
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

nh_residue_polynomial nh_residue_polynomial_times(nh_prime f, const nh_residue_polynomial *x,
                                                  const nh_residue_polynomial *y)
{
    nh_residue_polynomial out = {.degree = {x->degree[0] + y->degree[0], x->degree[1] + y->degree[1]}};
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
static ulong *values_of(const nh_residue_polynomial *x, nh_prime f, size_t count)
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
static bool resultant(const nh_residue_polynomial *x, const nh_residue_polynomial *y, nh_prime f, nmod_poly_t out)
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

/* A random linear combination of the polynomials. */
static nh_residue_polynomial combined(nh_prime f, size_t count, nmod_mpoly_t *p, uint64_t *random,
                                      const nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_t sum, part;
    nmod_mpoly_init(sum, ctx);
    nmod_mpoly_init(part, ctx);
    for (size_t k = 0; k < count; k++) {
        nmod_mpoly_scalar_mul_ui(part, p[k], nh_residue_random(f, random), ctx);
        nmod_mpoly_add(sum, sum, part, ctx);
    }
    nh_residue_polynomial out = written(sum, ctx);
    nmod_mpoly_clear(part, ctx);
    nmod_mpoly_clear(sum, ctx);
    return out;
}

/* The product of mu - mu_k over isolated zeros. */
static bool find_across(nh_prime f, size_t count, nmod_mpoly_t *p, const nmod_mpoly_ctx_t ctx,
                        nh_residue_polynomial *out)
{
    uint64_t random = 99991;
    nh_residue_polynomial x[combinations];
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
    out->degree[1] = nmod_poly_degree(sum) > 0 ? (size_t)nmod_poly_degree(sum) : 0;
    out->coefficient = nh_alloc_array(out->degree[1] + 1, sizeof *out->coefficient);
    for (size_t j = 0; j <= out->degree[1]; j++)
        out->coefficient[j] = (nh_residue)nmod_poly_get_coeff_ui(sum, (slong)j);
    for (size_t k = 0; k < combinations; k++) nh_free(x[k].coefficient);
    nmod_poly_clear(part);
    nmod_poly_clear(sum);
    return good;
}

/* ---- both ---- */

static nh_residue_polynomial constant_one(void)
{
    nh_residue_polynomial out = {.coefficient = nh_alloc_array(1, sizeof *out.coefficient)};
    out.coefficient[0] = 1;
    return out;
}

bool nh_common_zeros_find(nh_prime f, size_t polynomials, const nh_residue_polynomial *polynomial, size_t singulars,
                          const nh_residue_polynomial *singular, nh_common_zeros *out)
{
    size_t all = polynomials + singulars, powers = 0;
    nmod_mpoly_ctx_t ctx;
    nmod_mpoly_t special, degenerate, *p = nh_alloc_array(all, sizeof *p);
    nmod_mpoly_ctx_init(ctx, 2, ORD_LEX, f.p);
    nmod_mpoly_init(special, ctx);
    nmod_mpoly_init(degenerate, ctx);
    *out = (nh_common_zeros){.nullity = 0};
    for (size_t k = 0; k < all; k++) {
        nmod_mpoly_init(p[k], ctx);
        take(p[k], k < polynomials ? &polynomial[k] : &singular[k - polynomials], ctx);
        powers += k < polynomials ? polynomial[k].degree[1] : 0;
    }
    common(special, polynomials, p, ctx);
    common(degenerate, singulars, p + polynomials, ctx);
    for (size_t k = 0; k < polynomials; k++) nmod_mpoly_divides(p[k], p[k], special, ctx);
    bool good = true;
    if (powers) good = find_across(f, polynomials, p, ctx, &out->part[NH_ZEROS_ACROSS]);
    else out->part[NH_ZEROS_ACROSS] = constant_one();
    without_multiplicity(special, ctx);
    without_multiplicity(degenerate, ctx);
    nmod_mpoly_gcd(p[0], special, degenerate, ctx);
    nmod_mpoly_divides(special, special, p[0], ctx);
    out->part[NH_ZEROS_SPECIAL] = written(special, ctx);
    out->part[NH_ZEROS_DEGENERATE] = written(degenerate, ctx);
    for (size_t k = 0; k < all; k++) nmod_mpoly_clear(p[k], ctx);
    nmod_mpoly_clear(degenerate, ctx);
    nmod_mpoly_clear(special, ctx);
    nmod_mpoly_ctx_clear(ctx);
    nh_free(p);
    return good;
}

void nh_common_zeros_clear(nh_common_zeros *zeros)
{
    for (int k = 0; k < NH_ZEROS_PARTS; k++) nh_free(zeros->part[k].coefficient);
    *zeros = (nh_common_zeros){.nullity = 0};
}

/* ---- lists ---- */

/* Have both the same degrees, as sections of one surface have? */
static bool are_alike(const nh_common_zeros *a, const nh_common_zeros *b)
{
    bool alike = a->nullity == b->nullity;
    for (int k = 0; k < NH_ZEROS_PARTS; k++)
        alike &= !memcmp(a->part[k].degree, b->part[k].degree, sizeof a->part[k].degree);
    return alike;
}

void nh_common_zeros_list_add(nh_common_zeros_list *x, uint64_t key, nh_common_zeros *zeros)
{
    if (x->count == 1 && !are_alike(&x->at[0], zeros)) nh_common_zeros_list_clear(x);
    if (x->count && !are_alike(&x->at[0], zeros)) {
        nh_common_zeros_clear(zeros);
        return;
    }
    x->key[x->count] = key;
    x->at[x->count++] = *zeros;
}

void nh_common_zeros_list_clear(nh_common_zeros_list *x)
{
    for (size_t k = 0; k < x->count; k++) nh_common_zeros_clear(&x->at[k]);
    x->count = 0;
}

/* ---- from sections to one polynomial ---- */

/* The rational function top/bottom with these values, bottom monic; false: there are too few values.  The remainders of
 * the extended Euclidean algorithm are bottom times the interpolating polynomial. */
static bool rational_function(nh_prime f, size_t count, const ulong *place, const ulong *value, nmod_poly_t top,
                              nmod_poly_t bottom)
{
    enum { spare = 1 };
    nmod_poly_t all, q, r, t;
    bool found = false;
    nmod_poly_init(all, f.p);
    nmod_poly_init(q, f.p);
    nmod_poly_init(r, f.p);
    nmod_poly_init(t, f.p);
    nmod_poly_product_roots_nmod_vec(all, place, (slong)count);
    nmod_poly_interpolate_nmod_vec(top, place, value, (slong)count);
    nmod_poly_one(bottom);
    while (!found && !nmod_poly_is_zero(top)) {
        found = nmod_poly_degree(top) + nmod_poly_degree(bottom) + 1 + spare < (slong)count;
        if (found) break;
        nmod_poly_divrem(q, r, all, top);
        nmod_poly_swap(all, top);
        nmod_poly_swap(top, r);
        nmod_poly_mul(r, q, bottom);
        nmod_poly_sub(r, t, r);
        nmod_poly_swap(t, bottom);
        nmod_poly_swap(bottom, r);
    }
    if (!found && nmod_poly_degree(bottom) == 0) found = true; /* the function is zero */
    if (found && !nmod_poly_is_zero(bottom)) {
        ulong scale = nmod_inv(nmod_poly_get_coeff_ui(bottom, nmod_poly_degree(bottom)), bottom->mod);
        nmod_poly_scalar_mul_nmod(top, top, scale);
        nmod_poly_scalar_mul_nmod(bottom, bottom, scale);
    }
    nmod_poly_clear(t);
    nmod_poly_clear(r);
    nmod_poly_clear(q);
    nmod_poly_clear(all);
    return found;
}

static void write_powers(size_t each, int v, const nmod_poly_struct *top, nh_residue_polynomial *out)
{
    for (size_t z = 0; z < each; z++)
        if (nmod_poly_degree(top + z) > (slong)out->degree[v]) out->degree[v] = (size_t)nmod_poly_degree(top + z);
    out->coefficient = nh_alloc_array(each * (out->degree[v] + 1), sizeof *out->coefficient);
    for (size_t z = 0; z < each; z++)
        for (size_t k = 0; k <= out->degree[v]; k++)
            out->coefficient[k * each + z] = (nh_residue)nmod_poly_get_coeff_ui(top + z, (slong)k);
}

bool nh_residue_polynomial_from(nh_prime f, int v, size_t count, const uint64_t *place,
                                const nh_residue_polynomial *section, nh_residue_polynomial *out)
{
    size_t each = (section[0].degree[0] + 1) * (section[0].degree[1] + 1);
    *out = (nh_residue_polynomial){.degree = {section[0].degree[0], section[0].degree[1]}};
    nmod_poly_struct *top = nh_alloc_array(2 * each, sizeof *top), *bottom = top + each;
    ulong *at = nh_alloc_array(2 * count, sizeof *at), *value = at + count;
    nmod_poly_t shared, q;
    bool good = true;
    nmod_poly_init(shared, f.p);
    nmod_poly_init(q, f.p);
    nmod_poly_one(shared);
    for (size_t i = 0; i < count; i++) at[i] = nh_residue_of(f, (int64_t)place[i]);
    for (size_t z = 0; z < 2 * each; z++) nmod_poly_init(top + z, f.p);
    for (size_t z = 0; z < each && good; z++) {
        for (size_t i = 0; i < count; i++) value[i] = section[i].coefficient[z];
        good = rational_function(f, count, at, value, top + z, bottom + z);
        if (!good) break;
        nmod_poly_gcd(q, shared, bottom + z); /* the least common multiple */
        nmod_poly_div(q, bottom + z, q);
        nmod_poly_mul(shared, shared, q);
    }
    for (size_t z = 0; z < each && good; z++) {
        nmod_poly_div(q, shared, bottom + z);
        nmod_poly_mul(top + z, top + z, q);
    }
    if (good) write_powers(each, v, top, out);
    for (size_t z = 0; z < 2 * each; z++) nmod_poly_clear(top + z);
    nmod_poly_clear(q);
    nmod_poly_clear(shared);
    nh_free(at);
    nh_free(top);
    return good;
}

bool nh_common_zeros_from(nh_prime f, int v, const nh_common_zeros_list *sections, nh_common_zeros *out)
{
    bool good = true;
    *out = (nh_common_zeros){.nullity = sections->at[0].nullity};
    for (int part = 0; part < NH_ZEROS_PARTS && good; part++) {
        nh_residue_polynomial section[NH_ZEROS_MOST];
        for (size_t k = 0; k < sections->count; k++) section[k] = sections->at[k].part[part];
        good = nh_residue_polynomial_from(f, v, sections->count, sections->key, section, &out->part[part]);
    }
    if (!good) nh_common_zeros_clear(out);
    return good;
}
