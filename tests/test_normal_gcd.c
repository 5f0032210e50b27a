/* Greatest common divisors by images modulo a prime: they are those of FLINT, and of what was multiplied. */
#include <criterion/criterion.h>
#include <stdlib.h>

#include "exact/normal_quotient_internal.h"

enum { generators = 9 };

typedef struct {
    nh_quotient_field *f;
    fmpz_mpoly_t c, a, b, gcd, other;
} polynomials;

static polynomials create(void)
{
    polynomials p = {.f = nh_quotient_field_create(generators, 10000)};
    fmpz_mpoly_init(p.c, p.f->ctx);
    fmpz_mpoly_init(p.a, p.f->ctx);
    fmpz_mpoly_init(p.b, p.f->ctx);
    fmpz_mpoly_init(p.gcd, p.f->ctx);
    fmpz_mpoly_init(p.other, p.f->ctx);
    return p;
}

static void clear(polynomials *p)
{
    fmpz_mpoly_clear(p->c, p->f->ctx);
    fmpz_mpoly_clear(p->a, p->f->ctx);
    fmpz_mpoly_clear(p->b, p->f->ctx);
    fmpz_mpoly_clear(p->gcd, p->f->ctx);
    fmpz_mpoly_clear(p->other, p->f->ctx);
    nh_quotient_field_free(p->f);
}

/* A polynomial in the generators that `among` marks, with exponents of at most 2. */
static void random_polynomial(const nh_quotient_field *f, size_t terms, unsigned among, fmpz_mpoly_t out)
{
    fmpz_mpoly_zero(out, f->ctx);
    for (size_t i = 0; i < terms; i++) {
        ulong exponent[generators] = {0};
        for (size_t g = 0; g < generators; g++)
            if (among >> g & 1 && rand() % 3 == 0) exponent[g] = 1 + (ulong)(rand() % 2);
        fmpz_mpoly_set_coeff_si_ui(out, rand() % 19 - 9, exponent, f->ctx);
    }
    if (fmpz_mpoly_is_zero(out, f->ctx)) fmpz_mpoly_one(out, f->ctx);
}

static void check_gcd(const nh_quotient_field *f, const fmpz_mpoly_t a, const fmpz_mpoly_t b, fmpz_mpoly_t gcd)
{
    fmpz_mpoly_t wanted, own;
    fmpz_mpoly_init(wanted, f->ctx);
    fmpz_mpoly_init(own, f->ctx);
    cr_assert(fmpz_mpoly_gcd(wanted, a, b, f->ctx) && nh_quotient_field_gcd(f, gcd, a, b));
    cr_assert(fmpz_mpoly_equal(wanted, gcd, f->ctx));
    fmpz_mpoly_set(own, a, f->ctx);
    cr_assert(nh_quotient_field_gcd(f, own, own, b) && fmpz_mpoly_equal(wanted, own, f->ctx), "into the first");
    fmpz_mpoly_set(own, b, f->ctx);
    cr_assert(nh_quotient_field_gcd(f, own, a, own) && fmpz_mpoly_equal(wanted, own, f->ctx), "into the second");
    fmpz_mpoly_clear(wanted, f->ctx);
    fmpz_mpoly_clear(own, f->ctx);
}

/* Factors in the same generators, in some more, in none; common ones in all of them, in a few, in none. */
Test(normal_gcd, random_products)
{
    static const unsigned among[][3] = {{0x1ff, 0x1ff, 0x1ff}, {0x00f, 0x03f, 0x1f3}, {0x003, 0x1ff, 0x1ff},
                                        {0x000, 0x0ff, 0x1f0}, {0x01c, 0x1e0, 0x003}, {0x101, 0x001, 0x100}};
    polynomials p = create();
    size_t common = 0, none = 0;
    srand(7);
    for (size_t round = 0; round < 300; round++) {
        const unsigned *in = among[round % (sizeof among / sizeof *among)];
        random_polynomial(p.f, 1 + (size_t)(rand() % 4), in[0], p.c);
        random_polynomial(p.f, 1 + (size_t)(rand() % 7), in[1], p.a);
        random_polynomial(p.f, 1 + (size_t)(rand() % 7), in[2], p.b);
        fmpz_mpoly_mul(p.a, p.a, p.c, p.f->ctx);
        fmpz_mpoly_mul(p.b, p.b, p.c, p.f->ctx);
        check_gcd(p.f, p.a, p.b, p.gcd);
        cr_assert(fmpz_mpoly_divides(p.other, p.gcd, p.c, p.f->ctx), "what was multiplied divides it");
        common += p.gcd->length > 1;
        none += fmpz_mpoly_is_fmpz(p.gcd, p.f->ctx);
    }
    cr_assert(common > 60 && none > 60, "%zu and %zu are not both many", common, none);
    clear(&p);
}

/* The point lies on the zeros of both leading coefficients in one generator: then nothing is concluded from it.  Its
 * coordinates are those of normal_gcd.c: of the generators 0 and 1. */
Test(normal_gcd, leading_coefficients_that_vanish_at_the_point)
{
    const ulong prime = (UINT64_C(1) << 61) - 1, step = UINT64_C(0x9e3779b97f4a7c15);
    polynomials p = create();
    fmpz_mpoly_gen(p.other, 0, p.f->ctx);
    fmpz_mpoly_sub_ui(p.other, p.other, step % (prime - 1) + 1, p.f->ctx); /* zero at the coordinate */
    fmpz_mpoly_gen(p.c, 1, p.f->ctx);
    fmpz_mpoly_mul(p.c, p.c, p.other, p.f->ctx);
    fmpz_mpoly_add_ui(p.c, p.c, 5, p.f->ctx); /* (x - x0) y + 5: its image has no y */
    fmpz_mpoly_gen(p.a, 2, p.f->ctx);
    fmpz_mpoly_add_ui(p.a, p.a, 3, p.f->ctx);
    fmpz_mpoly_gen(p.b, 3, p.f->ctx);
    fmpz_mpoly_add_ui(p.b, p.b, 4, p.f->ctx);
    fmpz_mpoly_mul(p.a, p.a, p.c, p.f->ctx);
    fmpz_mpoly_mul(p.b, p.b, p.c, p.f->ctx);
    check_gcd(p.f, p.a, p.b, p.gcd);
    cr_assert(fmpz_mpoly_equal(p.gcd, p.c, p.f->ctx));
    clear(&p);
}

/* Powers of billions have no dense image. */
Test(normal_gcd, sparse_polynomials_of_high_degree)
{
    polynomials p = create();
    cr_assert(fmpz_mpoly_set_str_pretty(p.c, "x1^4000000000 - x2", NULL, p.f->ctx) == 0);
    cr_assert(fmpz_mpoly_set_str_pretty(p.a, "x1^4000000000 + x3", NULL, p.f->ctx) == 0);
    cr_assert(fmpz_mpoly_set_str_pretty(p.b, "x4^2 + 7", NULL, p.f->ctx) == 0);
    fmpz_mpoly_mul(p.a, p.a, p.c, p.f->ctx);
    fmpz_mpoly_mul(p.b, p.b, p.c, p.f->ctx);
    check_gcd(p.f, p.a, p.b, p.gcd);
    cr_assert(fmpz_mpoly_equal(p.gcd, p.c, p.f->ctx));
    clear(&p);
}
