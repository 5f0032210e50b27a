/* Greatest common divisors of polynomials.  Images modulo a prime, of one generator each, bound the divisor's degrees
 * from above: most pairs turn out to have none.  Else it has few generators, and it divides all coefficients of both
 * polynomials in the others: many short polynomials, most of which need no more than a division. */
#include <flint/fmpz_vec.h>
#include <flint/nmod.h>
#include <flint/nmod_poly.h>
#include <stdlib.h>

#include "base/memory.h"
#include "exact/normal_quotient_internal.h"

static const ulong prime = (UINT64_C(1) << 61) - 1;

typedef struct {
    size_t index; /* in its polynomial */
    const ulong *exponent;
    uint64_t key; /* the same for the same exponents of the generators that are not common */
} term;

/* A polynomial: its terms, their values at a point modulo the prime, and its coefficients: groups of its terms. */
typedef struct {
    const nh_quotient_field *f;
    const fmpz_mpoly_struct *a;
    size_t n, width; /* number of terms; of generators */
    ulong *exponent; /* n x width */
    ulong *value;    /* of each term */
    slong *degree;   /* in each generator */
    const bool *common;
    term *term;
    size_t *start, groups; /* groups + 1: the first term of each */
    size_t least;          /* the shortest group */
} polynomial;

/* ---- images of one generator ---- */

/* The point's coordinate; not zero. */
static ulong coordinate(size_t generator) { return (generator + 1) * UINT64_C(0x9e3779b97f4a7c15) % (prime - 1) + 1; }

static void evaluate(polynomial *p, const nh_quotient_field *f, const fmpz_mpoly_t a, nmod_t mod)
{
    *p = (polynomial){.f = f, .a = a, .n = (size_t)a->length, .width = (size_t)f->generators};
    p->exponent = nh_alloc_array(p->n * p->width + 1, sizeof *p->exponent);
    p->value = nh_alloc_array(p->n + 1, sizeof *p->value);
    p->degree = nh_alloc_array(p->width + 1, sizeof *p->degree);
    for (size_t i = 0; i < p->n; i++) {
        ulong *e = p->exponent + i * p->width;
        fmpz_mpoly_get_term_exp_ui(e, a, (slong)i, f->ctx);
        p->value[i] = fmpz_fdiv_ui(a->coeffs + i, prime);
        for (size_t g = 0; g < p->width; g++) {
            if (!e[g]) continue;
            if ((slong)e[g] > p->degree[g]) p->degree[g] = (slong)e[g];
            p->value[i] = nmod_mul(p->value[i], nmod_pow_ui(coordinate(g), e[g], mod), mod);
        }
    }
}

/* The polynomial in generator g at the point's other coordinates, but for factors of its coefficients: at g times the
 * coordinate.  Returns whether it has the full degree. */
static bool take_image(const polynomial *p, size_t g, nmod_t mod, nmod_poly_t out)
{
    nmod_poly_zero(out);
    for (size_t i = 0; i < p->n; i++) {
        slong e = (slong)p->exponent[i * p->width + g];
        nmod_poly_set_coeff_ui(out, e, nmod_add(nmod_poly_get_coeff_ui(out, e), p->value[i], mod));
    }
    return nmod_poly_degree(out) == p->degree[g];
}

/* May a common divisor have the generator?  Where the leading coefficient of one polynomial does not vanish at the
 * point, neither does that of a divisor, whose image divides both images. */
static bool images_have_divisor(const polynomial *a, const polynomial *b, size_t g, nmod_t mod, nmod_poly_t x,
                                nmod_poly_t y)
{
    bool full = take_image(a, g, mod, x);
    full |= take_image(b, g, mod, y);
    nmod_poly_gcd(x, x, y);
    return !full || nmod_poly_degree(x) > 0;
}

/* Finds the generators that a common divisor may have; returns how many. */
static size_t find_common(const polynomial *a, const polynomial *b, nmod_t mod, bool *common)
{
    enum { most_degree = 10000 }; /* images are dense */
    nmod_poly_t x, y;
    size_t count = 0;
    nmod_poly_init(x, prime);
    nmod_poly_init(y, prime);
    for (size_t g = 0; g < a->width; g++) {
        if (!a->degree[g] || !b->degree[g]) continue;
        common[g] = a->degree[g] > most_degree || b->degree[g] > most_degree || images_have_divisor(a, b, g, mod, x, y);
        count += common[g];
    }
    nmod_poly_clear(x);
    nmod_poly_clear(y);
    return count;
}

/* ---- coefficients in the other generators ---- */

static uint64_t key_of(const polynomial *p, const ulong *exponent)
{
    uint64_t key = 0;
    for (size_t g = 0; g < p->width; g++)
        if (!p->common[g]) key = (key ^ exponent[g]) * UINT64_C(0x9e3779b97f4a7c15) + g;
    return key;
}

static bool in_one_group(const polynomial *p, const term *x, const term *y)
{
    if (x->key != y->key) return false;
    for (size_t g = 0; g < p->width; g++)
        if (!p->common[g] && x->exponent[g] != y->exponent[g]) return false;
    return true;
}

static int by_group(const void *a, const void *b)
{
    const term *x = a, *y = b;
    if (x->key != y->key) return x->key > y->key ? 1 : -1;
    return (x->index > y->index) - (x->index < y->index);
}

/* Where two groups have one key by chance (one in 2^64), their terms may alternate, and what divides all pieces may be
 * too small: it is still a common divisor. */
static void group_terms(polynomial *p, const bool *common)
{
    p->common = common;
    p->term = nh_alloc_array(p->n + 1, sizeof *p->term);
    p->start = nh_alloc_array(p->n + 2, sizeof *p->start);
    for (size_t i = 0; i < p->n; i++) {
        const ulong *exponent = p->exponent + i * p->width;
        p->term[i] = (term){i, exponent, key_of(p, exponent)};
    }
    qsort(p->term, p->n, sizeof *p->term, by_group);
    for (size_t i = 0; i < p->n; i++)
        if (i == 0 || !in_one_group(p, p->term + i - 1, p->term + i)) p->start[p->groups++] = i;
    p->start[p->groups] = p->n;
    for (size_t k = 0; k < p->groups; k++)
        if (p->start[k + 1] - p->start[k] < p->start[p->least + 1] - p->start[p->least]) p->least = k;
}

/* The coefficient of group k, a polynomial in the common generators.  Its terms keep their order: all are divided by
 * the same monomial. */
static void take_coefficient(const polynomial *p, size_t k, fmpz_mpoly_t out)
{
    ulong *exponent = nh_alloc_array(p->width + 1, sizeof *exponent);
    fmpz_mpoly_zero(out, p->f->ctx);
    for (size_t i = p->start[k]; i < p->start[k + 1]; i++) {
        for (size_t g = 0; g < p->width; g++) exponent[g] = p->common[g] ? p->term[i].exponent[g] : 0;
        fmpz_mpoly_push_term_fmpz_ui(out, p->a->coeffs + p->term[i].index, exponent, p->f->ctx);
    }
    nh_free(exponent);
}

/* gcd := its gcd with all coefficients; false: FLINT does not find one. */
static bool divide_all(const polynomial *p, fmpz_mpoly_t gcd)
{
    const fmpz_mpoly_ctx_struct *ctx = p->f->ctx;
    fmpz_mpoly_t next, quotient;
    bool found = true;
    fmpz_mpoly_init(next, ctx);
    fmpz_mpoly_init(quotient, ctx);
    for (size_t k = 0; k < p->groups && found && !fmpz_mpoly_is_one(gcd, ctx); k++) {
        take_coefficient(p, k, next);
        if (!fmpz_mpoly_divides(quotient, next, gcd, ctx)) found = fmpz_mpoly_gcd(gcd, gcd, next, ctx);
    }
    fmpz_mpoly_clear(next, ctx);
    fmpz_mpoly_clear(quotient, ctx);
    return found;
}

static bool gcd_of_coefficients(polynomial *a, polynomial *b, const bool *common, fmpz_mpoly_t gcd)
{
    const fmpz_mpoly_ctx_struct *ctx = a->f->ctx;
    fmpz_mpoly_t other;
    fmpz_mpoly_init(other, ctx);
    group_terms(a, common);
    group_terms(b, common);
    take_coefficient(a, a->least, gcd);
    take_coefficient(b, b->least, other);
    bool found = fmpz_mpoly_gcd(gcd, gcd, other, ctx) && divide_all(a, gcd) && divide_all(b, gcd);
    fmpz_mpoly_clear(other, ctx);
    return found;
}

static void gcd_of_contents(const nh_quotient_field *f, fmpz_mpoly_t gcd, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    fmpz_t x, y;
    fmpz_init(x);
    fmpz_init(y);
    _fmpz_vec_content(x, a->coeffs, a->length);
    _fmpz_vec_content(y, b->coeffs, b->length);
    fmpz_gcd(x, x, y);
    fmpz_mpoly_set_fmpz(gcd, x, f->ctx);
    fmpz_clear(x);
    fmpz_clear(y);
}

static void clear(polynomial *p)
{
    nh_free(p->exponent);
    nh_free(p->value);
    nh_free(p->degree);
    nh_free(p->term);
    nh_free(p->start);
}

bool nh_quotient_field_gcd(const nh_quotient_field *f, fmpz_mpoly_t gcd, const fmpz_mpoly_t a, const fmpz_mpoly_t b)
{
    if (a->length < 2 || b->length < 2) return fmpz_mpoly_gcd(gcd, a, b, f->ctx);
    polynomial x, y;
    fmpz_mpoly_t result; /* gcd may be a or b */
    nmod_t mod;
    bool *common = nh_alloc_array((size_t)f->generators + 1, sizeof *common), found = true;
    nmod_init(&mod, prime);
    fmpz_mpoly_init(result, f->ctx);
    evaluate(&x, f, a, mod);
    evaluate(&y, f, b, mod);
    size_t count = find_common(&x, &y, mod, common), all = 0;
    for (size_t g = 0; g < x.width; g++) all += x.degree[g] || y.degree[g];
    if (count == 0) gcd_of_contents(f, result, a, b);
    else if (count == all) found = fmpz_mpoly_gcd(result, a, b, f->ctx);
    else found = gcd_of_coefficients(&x, &y, common, result);
    fmpz_mpoly_swap(gcd, result, f->ctx);
    fmpz_mpoly_clear(result, f->ctx);
    clear(&x);
    clear(&y);
    nh_free(common);
    return found;
}
