/* darboux_gauss: Gauss's equation along a line, and its group.
 *
 *     z = phi^k:   exponent differences 1/k at 0, 1/2 at 1, sqrt((k - 2)^2 + 8 k lambda)/(2 k) at infinity
 *     u'' = r u,   -4 r = (1 - a)/z^2 + (1 - b)/(1 - z)^2 + (1 - a - b + c)/(z (1 - z)),   a, b, c their squares
 *
 * The table says for which rational lambda the group has no part SL(2); Kovacic's algorithm proves for a given lambda
 * outside of it that the group is SL(2).  Both are asked: the table was typed, and the algorithm has limits. */
#include "absence/darboux_internal.h"
#include "absence/kovacic.h"

/* part += c p */
static void add(fmpq_poly_t part, const fmpq_t c, const char *p)
{
    fmpq_poly_t term;
    fmpq_poly_init(term);
    fmpq_poly_set_str(term, p);
    fmpq_poly_scalar_mul_fmpq(term, term, c);
    fmpq_poly_add(part, part, term);
    fmpq_poly_clear(term);
}

/* 4 z^2 (1 - z)^2 r, into `out`. */
static void numerator(long k, const fmpq_t lambda, fmpq_poly_t out)
{
    enum { of_lambda = 8, quarter = 4 };
    fmpq_t a, b, c, one, sum;
    fmpq_t *const all[] = {&a, &b, &c, &one, &sum};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) fmpq_init(*all[i]);
    fmpq_set_si(one, 1, 1);
    fmpq_set_si(a, 1, (ulong)(k * k));
    fmpq_set_si(b, 1, quarter);
    fmpq_set_si(c, of_lambda * k, 1);
    fmpq_mul(c, c, lambda);
    fmpq_set_si(sum, (k - 2) * (k - 2), 1);
    fmpq_add(c, c, sum);
    fmpq_set_si(sum, quarter * k * k, 1);
    fmpq_div(c, c, sum);
    fmpq_sub(sum, a, one);
    add(out, sum, "3  1 -2 1"); /* -(1 - a) (1 - z)^2 */
    fmpq_sub(sum, b, one);
    add(out, sum, "3  0 0 1"); /* -(1 - b) z^2 */
    fmpq_add(sum, sum, a);
    fmpq_sub(sum, sum, c);
    add(out, sum, "3  0 1 -1"); /* -(1 - a - b + c) z (1 - z) */
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) fmpq_clear(*all[i]);
}

bool nh_darboux_excluded(nh_arena *arena, long k, const fmpq_t lambda)
{
    if (nh_darboux_allowed(k, lambda)) return false;
    fmpq_poly_t r;
    fmpz_poly_t num, den, common;
    fmpq_poly_init(r);
    fmpz_poly_init(num);
    fmpz_poly_init(den);
    fmpz_poly_init(common);
    numerator(k, lambda, r);
    fmpq_poly_get_numerator(num, r);
    fmpz_poly_set_str(den, "5  0 0 4 -8 4"); /* 4 z^2 (1 - z)^2 */
    fmpz_poly_scalar_mul_fmpz(den, den, fmpq_poly_denref(r));
    fmpz_poly_gcd(common, num, den);
    fmpz_poly_div(num, num, common);
    fmpz_poly_div(den, den, common);
    bool excluded = nh_kovacic_decide(arena, num, den)->group == NH_GROUP_SL2;
    fmpz_poly_clear(num);
    fmpz_poly_clear(den);
    fmpz_poly_clear(common);
    fmpq_poly_clear(r);
    return excluded;
}
