/* Equations of motion as polynomials in one or two parameters: evaluated at many values modulo a prime, and
 * interpolated. */
#include <flint/nmod_mpoly.h>
#include <flint/nmod_poly.h>
#include <string.h>

#include "base/progress.h"
#include "classify/parametric_internal.h"

enum { most_values = 32 };

/* Newton's divided differences, in place: value[k] at place[k] become coefficients. */
static void interpolate(nh_prime p, size_t count, const nh_residue *place, size_t length, nh_residue *value)
{
    for (size_t step = 1; step < count; step++)
        for (size_t k = count - 1; k >= step; k--) {
            nh_residue scale = nh_residue_inverse(p, nh_residue_sub(p, place[k], place[k - step]));
            for (size_t z = 0; z < length; z++)
                value[k * length + z] =
                    nh_residue_mul(p, scale, nh_residue_sub(p, value[k * length + z], value[(k - 1) * length + z]));
        }
    for (size_t step = count - 1; step-- > 0;) /* Horner: multiply the higher part by (x - place[step]) */
        for (size_t k = step; k + 1 < count; k++)
            nh_residue_add_multiple(p, length, value + k * length, value + (k + 1) * length,
                                    nh_residue_negative(p, place[step]));
}

/* The highest power that has a coefficient. */
static size_t highest(size_t count, size_t length, const nh_residue *value)
{
    while (count > 1) {
        const nh_residue *top = value + (count - 1) * length;
        for (size_t z = 0; z < length; z++)
            if (top[z]) return count - 1;
        count--;
    }
    return 0;
}

/* Interpolates in lambda, at the residue of mu: adds values until the last one changes nothing. */
static bool in_lambda(nh_parametric *f, nh_parametric_series *s)
{
    nh_prime p = s->ring->field;
    uint64_t random = f->counter.equations->point->random + 77;
    nh_residue place[most_values];
    size_t have = 0, degree = most_values;
    nh_residue *value = nh_alloc_array(most_values * s->length, sizeof *value);
    for (size_t want = 4; want <= most_values && degree == most_values && !nh_late(); want *= 2) {
        size_t tries = 0;
        for (; have < want && tries < 3 * most_values; tries++) {
            f->value[0] = place[have] = nh_residue_random(p, &random);
            if (nh_parametric_value(f, s, value + have * s->length)) have++;
            else if (f->counter.equations->obstacle) break;
        }
        if (have < want) break;
        nh_free(s->coefficient);
        s->coefficient = nh_alloc_array(want * s->length, sizeof *value);
        memcpy(s->coefficient, value, want * s->length * sizeof *value);
        interpolate(p, want, place, s->length, s->coefficient);
        size_t found = highest(want, s->length, s->coefficient);
        if (found + 1 < want) degree = found;
    }
    nh_free(value);
    s->degree = degree;
    if (have == most_values && degree == most_values)
        f->obstacle = "equations that are not polynomial in the parameter, of a degree that is not too high";
    return degree < most_values;
}

/* ---- common factors ---- */

static void entry(nmod_poly_t out, const nh_parametric_series *s, size_t z)
{
    nmod_poly_zero(out);
    for (size_t j = 0; j <= s->degree; j++) nmod_poly_set_coeff_ui(out, (slong)j, s->coefficient[j * s->length + z]);
}

/* Divides by the greatest common divisor of all coefficients. */
static void divide_content(nh_parametric_series *s)
{
    nmod_poly_t content, e;
    nmod_poly_init(content, s->ring->field.p);
    nmod_poly_init(e, s->ring->field.p);
    for (size_t z = 0; z < s->length && nmod_poly_degree(content) != 0; z++) {
        entry(e, s, z);
        nmod_poly_gcd(content, content, e);
    }
    for (size_t z = 0; z < s->length && nmod_poly_degree(content) > 0; z++) {
        entry(e, s, z);
        nmod_poly_div(e, e, content);
        for (size_t j = 0; j <= s->degree; j++)
            s->coefficient[j * s->length + z] = (nh_residue)nmod_poly_get_coeff_ui(e, (slong)j);
    }
    if (nmod_poly_degree(content) > 0) s->degree -= (size_t)nmod_poly_degree(content);
    nmod_poly_clear(e);
    nmod_poly_clear(content);
}

/* ---- two parameters ---- */

static void entry_of_two(nmod_mpoly_t out, const nh_parametric_series *s, size_t z, nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_zero(out, ctx);
    for (size_t j = 0; j <= s->second; j++)
        for (size_t i = 0; i <= s->degree; i++) {
            nh_residue c = s->coefficient[(j * (s->degree + 1) + i) * s->length + z];
            if (c) nmod_mpoly_set_coeff_ui_ui(out, c, (ulong[]){i, j}, ctx);
        }
}

/* Drops the powers that are zero. */
static void shrink(nh_parametric_series *s, size_t degree, size_t second)
{
    size_t length = s->length;
    nh_residue *c = nh_alloc_array((degree + 1) * (second + 1) * length, sizeof *c);
    for (size_t j = 0; j <= second; j++)
        memcpy(c + j * (degree + 1) * length, s->coefficient + j * (s->degree + 1) * length,
               (degree + 1) * length * sizeof *c);
    nh_free(s->coefficient);
    s->coefficient = c;
    s->degree = degree;
    s->second = second;
}

/* Every coefficient divided by the common factor. */
static void divide_all(nh_parametric_series *s, nmod_mpoly_t content, nmod_mpoly_ctx_t ctx)
{
    nmod_mpoly_t e;
    nmod_mpoly_init(e, ctx);
    for (size_t z = 0; z < s->length; z++) {
        entry_of_two(e, s, z, ctx);
        nmod_mpoly_divides(e, e, content, ctx);
        for (size_t j = 0; j <= s->second; j++)
            for (size_t i = 0; i <= s->degree; i++)
                s->coefficient[(j * (s->degree + 1) + i) * s->length + z] =
                    (nh_residue)nmod_mpoly_get_coeff_ui_ui(e, (ulong[]){i, j}, ctx);
    }
    shrink(s, s->degree - (size_t)nmod_mpoly_degree_si(content, 0, ctx),
           s->second - (size_t)nmod_mpoly_degree_si(content, 1, ctx));
    nmod_mpoly_clear(e, ctx);
}

static void divide_content_of_two(nh_parametric_series *s)
{
    nmod_mpoly_ctx_t ctx;
    nmod_mpoly_t content, e;
    nmod_mpoly_ctx_init(ctx, 2, ORD_LEX, s->ring->field.p);
    nmod_mpoly_init(content, ctx);
    nmod_mpoly_init(e, ctx);
    for (size_t z = 0; z < s->length && !nmod_mpoly_is_one(content, ctx); z++) {
        entry_of_two(e, s, z, ctx);
        nmod_mpoly_gcd(content, content, e, ctx);
    }
    if (!nmod_mpoly_is_ui(content, ctx)) divide_all(s, content, ctx);
    nmod_mpoly_clear(e, ctx);
    nmod_mpoly_clear(content, ctx);
    nmod_mpoly_ctx_clear(ctx);
}

/* The coefficients in lambda at these values of mu, one after the other, as many for each as at the first. */
static bool columns(nh_parametric *f, nh_parametric_series *s, size_t count, const nh_residue *place, nh_residue **out)
{
    f->value[1] = place[0];
    bool good = in_lambda(f, s);
    size_t degree = good ? s->degree : 0, length = (degree + 1) * s->length;
    nh_residue *value = *out = nh_alloc_array(count * length, sizeof *value);
    for (size_t k = 0; k < count && good; k++) {
        f->value[1] = place[k];
        good = (k == 0 || in_lambda(f, s)) && s->degree <= degree;
        if (good) memcpy(value + k * length, s->coefficient, (s->degree + 1) * s->length * sizeof *value);
    }
    s->degree = degree;
    return good;
}

/* Doubles the number of values of mu until the last one changes nothing. */
static bool in_both(nh_parametric *f, nh_parametric_series *s)
{
    uint64_t random = f->counter.equations->point->random + 177;
    nh_residue place[most_values];
    for (size_t k = 0; k < most_values; k++) place[k] = nh_residue_random(s->ring->field, &random);
    for (size_t want = 4; want <= most_values && !nh_late(); want *= 2) {
        nh_residue *value;
        bool good = columns(f, s, want, place, &value);
        size_t length = (s->degree + 1) * s->length;
        if (good) interpolate(s->ring->field, want, place, length, value);
        size_t found = good ? highest(want, length, value) : 0;
        nh_free(s->coefficient);
        s->coefficient = value;
        s->second = found;
        if (!good) return false;
        if (found + 1 < want) return true;
    }
    f->obstacle = "equations that are not polynomial in the parameters, of a degree that is not too high";
    return false;
}

bool nh_parametric_interpolate(nh_parametric *f, nh_parametric_series *s)
{
    bool two = f->parameters > 1 && !f->held, good = two ? in_both(f, s) : in_lambda(f, s);
    if (good && two) divide_content_of_two(s);
    else if (good) divide_content(s);
    return good;
}
