/* Quotients split into content, monomial and factors, for display. */
#include <string.h>

#include "base/memory.h"
#include "exact/normal_quotient_internal.h"
#include "graph/num.h"

/* Factoring is for display: beyond these sizes the expanded form is shown. */
enum { factor_terms = 60, factor_degree = 24 };

typedef struct {
    nh_quotient_field *field;
    nh_arena *arena;
    nh_pieces *out;
    size_t capacity;
    fmpz_t num, den; /* the constant */
    bool fits;
} breaker;

static void multiply_constant(breaker *b, const fmpz_t c, int64_t power)
{
    fmpz_t p;
    fmpz_init(p);
    fmpz_pow_ui(p, c, (ulong)(power < 0 ? -power : power));
    if (power < 0) fmpz_mul(b->den, b->den, p);
    else fmpz_mul(b->num, b->num, p);
    fmpz_clear(p);
}

static void add_exponents(breaker *b, const fmpz_mpoly_t monomial, int64_t power)
{
    fmpz_mpoly_get_term_exp_ui(b->field->exponent, monomial, 0, b->field->ctx);
    for (size_t g = 0; g < b->out->generators; g++) b->out->exponent[g] += power * (int64_t)b->field->exponent[g];
}

/* Splits off the integer content and the monomial of a, which are added to the result; leaves the rest in a. */
static void take_content(breaker *b, fmpz_mpoly_t a, int64_t power)
{
    fmpz_mpoly_t m;
    fmpz_t c;
    fmpz_mpoly_init(m, b->field->ctx);
    fmpz_init(c);
    fmpz_mpoly_term_content(m, a, b->field->ctx);
    fmpz_mpoly_divexact(a, a, m, b->field->ctx);
    fmpz_mpoly_get_term_coeff_fmpz(c, m, 0, b->field->ctx);
    multiply_constant(b, c, power);
    add_exponents(b, m, power);
    if (fmpz_mpoly_is_fmpz(a, b->field->ctx)) {
        fmpz_mpoly_get_fmpz(c, a, b->field->ctx);
        multiply_constant(b, c, power);
        fmpz_mpoly_one(a, b->field->ctx);
    }
    fmpz_clear(c);
    fmpz_mpoly_clear(m, b->field->ctx);
}

/* Splits off value^n from a; the power goes to the generator. */
static void absorb(breaker *b, const nh_relation *r, fmpz_mpoly_t a, int64_t side, bool needs_root)
{
    const fmpz_mpoly_ctx_struct *ctx = b->field->ctx;
    int64_t *e = &b->out->exponent[r->generator];
    fmpz_mpoly_t q;
    fmpz_mpoly_init(q, ctx);
    while (!(needs_root && side * *e >= 0) && fmpz_mpoly_divides(q, a, r->num, ctx)) {
        fmpz_mpoly_swap(a, q, ctx);
        *e += side * (int64_t)r->order;
    }
    fmpz_mpoly_clear(q, ctx);
}

/* For display 1 - cos^2 = sin^2, and r/(B D) = r^(1-n)/D when r = B^(1/n). */
static void absorb_relations(breaker *b, fmpz_mpoly_t num, fmpz_mpoly_t den)
{
    for (size_t i = 0; i < b->field->relations; i++) {
        const nh_relation *r = &b->field->relation[i];
        if (!r->integral || r->num->length < 2) continue;
        absorb(b, r, den, -1, !r->pair);
        absorb(b, r, num, 1, !r->pair);
    }
}

static nh_num small_number(breaker *b, const fmpz_t c)
{
    if (!fmpz_fits_si(c) || fmpz_get_si(c) == INT64_MIN) b->fits = false;
    return nh_num_int(b->fits ? fmpz_get_si(c) : 0);
}

static void add_factor(breaker *b, const fmpz_mpoly_t a, int64_t power)
{
    nh_pieces *out = b->out;
    size_t n = (size_t)a->length, width = out->generators;
    nh_factor f = {.terms = n, .power = power};
    f.coefficient = nh_arena_alloc(b->arena, n * sizeof *f.coefficient);
    f.exponent = nh_arena_alloc(b->arena, n * width * sizeof *f.exponent);
    fmpz_t c;
    fmpz_init(c);
    for (size_t i = 0; i < n; i++) {
        fmpz_mpoly_get_term_coeff_fmpz(c, a, (slong)i, b->field->ctx);
        f.coefficient[i] = small_number(b, c);
        fmpz_mpoly_get_term_exp_ui(b->field->exponent, a, (slong)i, b->field->ctx);
        for (size_t g = 0; g < width; g++) f.exponent[i * width + g] = (int64_t)b->field->exponent[g];
    }
    fmpz_clear(c);
    if (out->factors == b->capacity) {
        nh_factor *old = out->factor;
        b->capacity = b->capacity ? 2 * b->capacity : 4;
        out->factor = nh_arena_alloc(b->arena, b->capacity * sizeof *out->factor);
        if (out->factors) memcpy(out->factor, old, out->factors * sizeof *old);
    }
    out->factor[out->factors++] = f;
}

static bool cheap_to_factor(const nh_quotient_field *f, const fmpz_mpoly_t a)
{
    if (a->length > factor_terms) return false;
    for (slong g = 0; g < f->generators; g++)
        if (fmpz_mpoly_degree_si(a, g, f->ctx) > factor_degree) return false;
    return fmpz_mpoly_max_bits(a) < 256 && fmpz_mpoly_max_bits(a) > -256;
}

/* Is a generator in one term only, to the first power?  Then a = A x + B is irreducible: the term A and B have no
 * common factor, because `a` is without content. */
static bool is_plainly_irreducible(const nh_quotient_field *f, const fmpz_mpoly_t a)
{
    uint64_t *count = nh_alloc_array((size_t)f->generators + 1, sizeof *count);
    for (slong i = 0; i < a->length; i++) {
        fmpz_mpoly_get_term_exp_ui(f->exponent, a, i, f->ctx);
        for (slong g = 0; g < f->generators; g++)
            if (f->exponent[g]) count[g] += f->exponent[g] == 1 ? 1 : 2;
    }
    bool found = false;
    for (slong g = 0; g < f->generators && !found; g++) found = count[g] == 1;
    nh_free(count);
    return found;
}

/* a = A x + B is gcd(A, B) times an irreducible polynomial, which is split off.  Mechanics is linear in masses. */
static bool take_linear(breaker *b, fmpz_mpoly_t a, int64_t sign)
{
    const fmpz_mpoly_ctx_struct *ctx = b->field->ctx;
    slong g = 0;
    while (g < b->field->generators && fmpz_mpoly_degree_si(a, g, ctx) != 1) g++;
    if (g == b->field->generators) return false;
    fmpz_mpoly_t content;
    fmpz_mpoly_init(content, ctx);
    bool found = fmpz_mpoly_content_vars(content, a, &g, 1, ctx);
    if (found) {
        fmpz_mpoly_divexact(a, a, content, ctx);
        add_factor(b, a, sign);
        fmpz_mpoly_swap(a, content, ctx);
    }
    fmpz_mpoly_clear(content, ctx);
    return found;
}

static void take_factors(breaker *b, fmpz_mpoly_t a, int64_t sign)
{
    const fmpz_mpoly_ctx_struct *ctx = b->field->ctx;
    if (is_plainly_irreducible(b->field, a)) {
        add_factor(b, a, sign);
        return;
    }
    while (take_linear(b, a, sign)) continue;
    if (fmpz_mpoly_is_one(a, ctx)) return;
    fmpz_mpoly_factor_t f;
    fmpz_mpoly_factor_init(f, ctx);
    if (fmpz_mpoly_factor(f, a, ctx)) {
        multiply_constant(b, f->constant, sign);
        for (slong i = 0; i < f->num; i++) add_factor(b, f->poly + i, sign * fmpz_get_si(f->exp + i));
    } else {
        add_factor(b, a, sign);
    }
    fmpz_mpoly_factor_clear(f, ctx);
}

/* `a` without content: as one factor, or as its irreducible ones. */
static void add_side(breaker *b, fmpz_mpoly_t a, bool factored, int64_t sign)
{
    if (fmpz_mpoly_is_one(a, b->field->ctx)) return;
    if (factored && cheap_to_factor(b->field, a)) take_factors(b, a, sign);
    else add_factor(b, a, sign);
}

static void set_constant(breaker *b)
{
    fmpz_t g;
    fmpz_init(g);
    fmpz_gcd(g, b->num, b->den);
    fmpz_divexact(b->num, b->num, g);
    fmpz_divexact(b->den, b->den, g);
    fmpz_clear(g);
    nh_num num = small_number(b, b->num), den = small_number(b, b->den);
    if (b->fits) b->out->constant = nh_num_mul(num, nh_num_inv(den));
}

bool nh_pieces_make(nh_quotient_field *field, nh_arena *arena, const nh_quotient *q, bool factored, nh_pieces *out)
{
    *out = (nh_pieces){.generators = field->declared, .constant = nh_num_int(0)};
    out->exponent = nh_arena_alloc(arena, out->generators * sizeof *out->exponent);
    if (nh_quotient_is_zero(field, q)) return true;
    breaker b = {.field = field, .arena = arena, .out = out, .fits = true};
    fmpz_init_set_ui(b.num, 1);
    fmpz_init_set_ui(b.den, 1);
    fmpz_mpoly_t num, den;
    fmpz_mpoly_init(num, field->ctx);
    fmpz_mpoly_init(den, field->ctx);
    fmpz_mpoly_set(num, q->num, field->ctx);
    fmpz_mpoly_set(den, q->den, field->ctx);
    take_content(&b, num, 1);
    take_content(&b, den, -1);
    absorb_relations(&b, num, den);
    take_content(&b, num, 1);
    take_content(&b, den, -1);
    add_side(&b, num, factored, 1);
    add_side(&b, den, factored, -1);
    set_constant(&b);
    fmpz_mpoly_clear(num, field->ctx);
    fmpz_mpoly_clear(den, field->ctx);
    fmpz_clear(b.num);
    fmpz_clear(b.den);
    return b.fits;
}
