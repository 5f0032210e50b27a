/* Special surfaces over the rationals: FLINT's polynomials in three variables. */
#include "classify/special_surfaces.h"

#include <flint/fmpz.h>
#include <flint/nmod.h>
#include <flint/nmod_mpoly.h>
#include <flint/nmod_poly.h>
#include <string.h>

#include "base/memory.h"
#include "classify/special_curves_internal.h"

/* ---- from sections to one polynomial ---- */

/* The rational function top/bottom with these values, bottom monic; false: there are too few values.  The remainders of
 * the extended Euclidean algorithm are bottom times the interpolating polynomial. */
static bool rational_function(nh_prime f, size_t count, const ulong *nu, const ulong *value, nmod_poly_t top,
                              nmod_poly_t bottom)
{
    enum { spare = 1 };
    nmod_poly_t all, q, r, t;
    bool found = false;
    nmod_poly_init(all, f.p);
    nmod_poly_init(q, f.p);
    nmod_poly_init(r, f.p);
    nmod_poly_init(t, f.p);
    nmod_poly_product_roots_nmod_vec(all, nu, (slong)count);
    nmod_poly_interpolate_nmod_vec(top, nu, value, (slong)count);
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

static void write_surface(size_t width, const nmod_poly_struct *top, nh_residue_surface *out)
{
    size_t each = width * (out->degree[1] + 1);
    for (size_t z = 0; z < each; z++)
        if (nmod_poly_degree(top + z) > (slong)out->degree[2]) out->degree[2] = (size_t)nmod_poly_degree(top + z);
    out->coefficient = nh_alloc_array(each * (out->degree[2] + 1), sizeof *out->coefficient);
    for (size_t z = 0; z < each; z++)
        for (size_t k = 0; k <= out->degree[2]; k++)
            out->coefficient[k * each + z] = (nh_residue)nmod_poly_get_coeff_ui(top + z, (slong)k);
}

bool nh_residue_surface_from(nh_prime f, size_t count, const nh_residue *nu, const nh_residue_surface *section,
                             nh_residue_surface *out)
{
    size_t width = section[0].degree[0] + 1, each = width * (section[0].degree[1] + 1);
    *out = (nh_residue_surface){.degree = {section[0].degree[0], section[0].degree[1], 0}};
    nmod_poly_struct *top = nh_alloc_array(2 * each, sizeof *top), *bottom = top + each;
    ulong *at = nh_alloc_array(2 * count, sizeof *at), *value = at + count;
    nmod_poly_t shared, q;
    bool good = true;
    nmod_poly_init(shared, f.p);
    nmod_poly_init(q, f.p);
    nmod_poly_one(shared);
    for (size_t i = 0; i < count; i++) at[i] = nu[i];
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
    if (good) write_surface(width, top, out);
    for (size_t z = 0; z < 2 * each; z++) nmod_poly_clear(top + z);
    nmod_poly_clear(q);
    nmod_poly_clear(shared);
    nh_free(at);
    nh_free(top);
    return good;
}

/* ---- modulo a prime ---- */

bool nh_special_surface_point(const nh_special_surface *s, nh_prime f, uint64_t seed, nh_residue at[3])
{
    enum { tries = 40 };
    uint64_t random = seed;
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1), total = each * (s->degree[2] + 1);
    int v = s->degree[0] ? 0 : s->degree[1] ? 1 : 2;
    bool found = false;
    nh_residue_polynomial p = {.degree = s->degree[v]};
    p.coefficient = nh_alloc_array(p.degree + 1, sizeof *p.coefficient);
    for (int k = 0; k < tries && !found; k++) {
        for (int i = 0; i < 3; i++) at[i] = nh_residue_random(f, &random);
        memset(p.coefficient, 0, (p.degree + 1) * sizeof *p.coefficient);
        for (size_t z = 0; z < total; z++) {
            size_t e[3] = {z % width, z % each / width, z / each};
            nh_residue c = nh_residue_of(f, s->coefficient[z]);
            for (int i = 0; i < 3; i++)
                if (i != v) c = nh_residue_mul(f, c, nh_residue_power(f, at[i], e[i]));
            p.coefficient[e[v]] = nh_residue_add(f, p.coefficient[e[v]], c);
        }
        found = nh_residue_polynomial_root(&p, f, &at[v]);
    }
    nh_free(p.coefficient);
    return found;
}

static void section_modulo(const nh_special_surface *s, nh_prime f, nh_residue nu, nmod_mpoly_t out,
                           const nmod_mpoly_ctx_t ctx)
{
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1);
    nmod_mpoly_zero(out, ctx);
    for (size_t z = 0; z < each; z++) {
        nh_residue sum = 0;
        for (size_t k = s->degree[2] + 1; k-- > 0;)
            sum = nh_residue_add(f, nh_residue_mul(f, sum, nu), nh_residue_of(f, s->coefficient[k * each + z]));
        if (sum) nmod_mpoly_set_coeff_ui_ui(out, sum, (ulong[]){z % width, z / width}, ctx);
    }
}

bool nh_special_surfaces_cover(size_t surfaces, const nh_special_surface *s, nh_prime f, nh_residue nu,
                               const nh_residue_surface *curve)
{
    nmod_mpoly_ctx_t ctx;
    nmod_mpoly_t all, p;
    nmod_mpoly_ctx_init(ctx, 2, ORD_LEX, f.p);
    nmod_mpoly_init(all, ctx);
    nmod_mpoly_init(p, ctx);
    nmod_mpoly_one(all, ctx);
    for (size_t k = 0; k < surfaces; k++) {
        section_modulo(&s[k], f, nu, p, ctx);
        nmod_mpoly_mul(all, all, p, ctx);
    }
    bool covered = !nmod_mpoly_is_zero(all, ctx); /* otherwise a whole plane is special */
    nmod_mpoly_zero(p, ctx);
    for (size_t j = 0; j <= curve->degree[1]; j++)
        for (size_t i = 0; i <= curve->degree[0]; i++) {
            nh_residue c = curve->coefficient[j * (curve->degree[0] + 1) + i];
            if (c) nmod_mpoly_set_coeff_ui_ui(p, c, (ulong[]){i, j}, ctx);
        }
    covered = covered && !nmod_mpoly_is_zero(p, ctx) && nmod_mpoly_divides(all, all, p, ctx);
    nmod_mpoly_clear(p, ctx);
    nmod_mpoly_clear(all, ctx);
    nmod_mpoly_ctx_clear(ctx);
    return covered;
}

/* ---- what lies on what ---- */

static void read_surface(const nh_special_surface *s, fmpz_mpoly_t out, const fmpz_mpoly_ctx_t ctx)
{
    size_t width = s->degree[0] + 1, each = width * (s->degree[1] + 1);
    fmpz_mpoly_zero(out, ctx);
    for (size_t z = 0; z < each * (s->degree[2] + 1); z++)
        if (s->coefficient[z])
            fmpz_mpoly_set_coeff_si_ui(out, s->coefficient[z], (ulong[]){z % width, z % each / width, z / each}, ctx);
}

/* By the greatest common factor of the coefficients. */
static void divide_content(fmpz_mpoly_t p, const fmpz_mpoly_ctx_t ctx)
{
    fmpz_t content, c;
    fmpz_init(content);
    fmpz_init(c);
    for (slong k = 0; k < fmpz_mpoly_length(p, ctx); k++) {
        fmpz_mpoly_get_term_coeff_fmpz(c, p, k, ctx);
        fmpz_gcd(content, content, c);
    }
    if (!fmpz_is_zero(content)) fmpz_mpoly_scalar_divexact_fmpz(p, p, content, ctx);
    fmpz_clear(c);
    fmpz_clear(content);
}

bool nh_special_surface_section(const nh_special_surface *s, const nh_special_surface *with, int v,
                                nh_special_curve *out)
{
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t whole, plane, c, sum, a, b, power;
    nh_special_surface found = {.coefficient = NULL};
    fmpz_mpoly_ctx_init(ctx, 3, ORD_LEX);
    fmpz_mpoly_struct *all[] = {whole, plane, c, sum, a, b, power};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) fmpz_mpoly_init(all[k], ctx);
    read_surface(s, whole, ctx);
    read_surface(with, plane, ctx);
    fmpz_mpoly_get_coeff_vars_ui(a, plane, (slong[]){v}, (ulong[]){1}, 1, ctx);
    fmpz_mpoly_get_coeff_vars_ui(b, plane, (slong[]){v}, (ulong[]){0}, 1, ctx);
    fmpz_mpoly_neg(b, b, ctx);
    fmpz_mpoly_one(power, ctx);
    for (size_t e = s->degree[v] + 1; e-- > 0;) { /* Horner in b/a, times a^degree */
        fmpz_mpoly_get_coeff_vars_ui(c, whole, (slong[]){v}, (ulong[]){e}, 1, ctx);
        fmpz_mpoly_mul(sum, sum, b, ctx);
        fmpz_mpoly_mul(c, c, power, ctx);
        fmpz_mpoly_add(sum, sum, c, ctx);
        fmpz_mpoly_mul(power, power, a, ctx);
    }
    divide_content(sum, ctx);
    bool good = nh_special_surface_take(&found, sum, ctx);
    int i = v == 0 ? 1 : 0, j = v == 2 ? 1 : 2; /* the other two: v does not occur */
    *out = (nh_special_curve){.degree = {found.degree[i], found.degree[j]}, .coefficient = found.coefficient};
    for (size_t k = 0; k < sizeof all / sizeof *all; k++) fmpz_mpoly_clear(all[k], ctx);
    fmpz_mpoly_ctx_clear(ctx);
    return good;
}

bool nh_special_curve_covers(const nh_special_curve *whole, const nh_special_curve *part)
{
    fmpz_mpoly_ctx_t ctx;
    fmpz_mpoly_t p, q;
    fmpz_mpoly_ctx_init(ctx, 3, ORD_LEX);
    fmpz_mpoly_init(p, ctx);
    fmpz_mpoly_init(q, ctx);
    read_surface(whole, p, ctx);
    read_surface(part, q, ctx);
    bool inside = fmpz_mpoly_is_zero(p, ctx) || fmpz_mpoly_divides(p, p, q, ctx);
    fmpz_mpoly_clear(q, ctx);
    fmpz_mpoly_clear(p, ctx);
    fmpz_mpoly_ctx_clear(ctx);
    return inside;
}
