/* Greatest common divisors by images modulo a prime: they are those of FLINT, and of what was multiplied. */
#include <criterion/criterion.h>
#include <stdlib.h>

#include "exact/normal_quotient_internal.h"

enum { generators = 9 };

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
    nh_quotient_field *f = nh_quotient_field_create(generators, 10000);
    size_t common = 0, none = 0;
    fmpz_mpoly_t c, a, b, gcd, q;
    fmpz_mpoly_init(c, f->ctx);
    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    fmpz_mpoly_init(gcd, f->ctx);
    fmpz_mpoly_init(q, f->ctx);
    srand(7);
    for (size_t round = 0; round < 300; round++) {
        const unsigned *in = among[round % (sizeof among / sizeof *among)];
        random_polynomial(f, 1 + (size_t)(rand() % 4), in[0], c);
        random_polynomial(f, 1 + (size_t)(rand() % 7), in[1], a);
        random_polynomial(f, 1 + (size_t)(rand() % 7), in[2], b);
        fmpz_mpoly_mul(a, a, c, f->ctx);
        fmpz_mpoly_mul(b, b, c, f->ctx);
        check_gcd(f, a, b, gcd);
        cr_assert(fmpz_mpoly_divides(q, gcd, c, f->ctx), "what was multiplied divides it");
        common += gcd->length > 1;
        none += fmpz_mpoly_is_fmpz(gcd, f->ctx);
    }
    cr_assert(common > 60 && none > 60, "%zu and %zu are not both many", common, none);
    fmpz_mpoly_clear(c, f->ctx);
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
    fmpz_mpoly_clear(gcd, f->ctx);
    fmpz_mpoly_clear(q, f->ctx);
    nh_quotient_field_free(f);
}

/* The point lies on the zeros of both leading coefficients in one generator: then nothing is concluded from it.  Its
 * coordinates are those of normal_gcd.c: of the generators 0 and 1. */
Test(normal_gcd, leading_coefficients_that_vanish_at_the_point)
{
    const ulong prime = (UINT64_C(1) << 61) - 1, step = UINT64_C(0x9e3779b97f4a7c15);
    nh_quotient_field *f = nh_quotient_field_create(generators, 10000);
    fmpz_mpoly_t lead, c, a, b, gcd;
    fmpz_mpoly_init(lead, f->ctx);
    fmpz_mpoly_init(c, f->ctx);
    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    fmpz_mpoly_init(gcd, f->ctx);
    fmpz_mpoly_gen(lead, 0, f->ctx);
    fmpz_mpoly_sub_ui(lead, lead, step % (prime - 1) + 1, f->ctx); /* zero at the coordinate */
    fmpz_mpoly_gen(c, 1, f->ctx);
    fmpz_mpoly_mul(c, c, lead, f->ctx);
    fmpz_mpoly_add_ui(c, c, 5, f->ctx); /* (x - x0) y + 5: its image has no y */
    fmpz_mpoly_gen(a, 2, f->ctx);
    fmpz_mpoly_add_ui(a, a, 3, f->ctx);
    fmpz_mpoly_gen(b, 3, f->ctx);
    fmpz_mpoly_add_ui(b, b, 4, f->ctx);
    fmpz_mpoly_mul(a, a, c, f->ctx);
    fmpz_mpoly_mul(b, b, c, f->ctx);
    check_gcd(f, a, b, gcd);
    cr_assert(fmpz_mpoly_equal(gcd, c, f->ctx));
    fmpz_mpoly_clear(lead, f->ctx);
    fmpz_mpoly_clear(c, f->ctx);
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
    fmpz_mpoly_clear(gcd, f->ctx);
    nh_quotient_field_free(f);
}

/* Powers of billions have no dense image. */
Test(normal_gcd, sparse_polynomials_of_high_degree)
{
    nh_quotient_field *f = nh_quotient_field_create(generators, 10000);
    fmpz_mpoly_t c, a, b, gcd;
    fmpz_mpoly_init(c, f->ctx);
    fmpz_mpoly_init(a, f->ctx);
    fmpz_mpoly_init(b, f->ctx);
    fmpz_mpoly_init(gcd, f->ctx);
    cr_assert(fmpz_mpoly_set_str_pretty(c, "x1^4000000000 - x2", NULL, f->ctx) == 0);
    cr_assert(fmpz_mpoly_set_str_pretty(a, "x1^4000000000 + x3", NULL, f->ctx) == 0);
    cr_assert(fmpz_mpoly_set_str_pretty(b, "x4^2 + 7", NULL, f->ctx) == 0);
    fmpz_mpoly_mul(a, a, c, f->ctx);
    fmpz_mpoly_mul(b, b, c, f->ctx);
    check_gcd(f, a, b, gcd);
    cr_assert(fmpz_mpoly_equal(gcd, c, f->ctx));
    fmpz_mpoly_clear(c, f->ctx);
    fmpz_mpoly_clear(a, f->ctx);
    fmpz_mpoly_clear(b, f->ctx);
    fmpz_mpoly_clear(gcd, f->ctx);
    nh_quotient_field_free(f);
}
