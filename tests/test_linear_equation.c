/* Linear equations with rational coefficients: entries over one denominator, second order, normal form. */
#include <criterion/criterion.h>

#include "absence/linear_equation.h"

static void set(nh_linear_equation *e, size_t i, size_t j, const char *num, const char *den)
{
    fmpq_poly_t n, d;
    fmpq_poly_init(n);
    fmpq_poly_init(d);
    cr_assert_eq(fmpq_poly_set_str(n, num), 0);
    cr_assert_eq(fmpq_poly_set_str(d, den), 0);
    nh_linear_equation_set(e, i, j, n, d);
    fmpq_poly_clear(n);
    fmpq_poly_clear(d);
}

static void expect(const fmpz_poly_t p, const char *text)
{
    fmpz_poly_t q;
    fmpz_poly_init(q);
    cr_assert_eq(fmpz_poly_set_str(q, text), 0);
    cr_expect(fmpz_poly_equal(p, q), "%s", text);
    fmpz_poly_clear(q);
}

Test(linear_equation, one_denominator)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 2);
    set(&e, 0, 1, "1  1/2", "2  0 1");    /* 1/(2 x) */
    set(&e, 1, 0, "2  0 1", "2  -1/3 1"); /* x/(x - 1/3) */
    set(&e, 1, 1, "2  0 -2", "3  0 1 1"); /* -2/(1 + x) */
    nh_linear_equation_reduce(&e);
    expect(e.den, "4  0 -2 4 6");
    expect(e.num + 0, "0");
    expect(e.num + 1, "3  -1 2 3");
    expect(e.num + 2, "4  0 0 6 6");
    expect(e.num + 3, "3  0 4 -12");
    set(&e, 1, 1, "0", "1  1"); /* what is set last holds */
    set(&e, 1, 0, "1  1", "1  1");
    nh_linear_equation_reduce(&e);
    expect(e.den, "2  0 2");
    expect(e.num + 1, "1  1");
    expect(e.num + 2, "2  0 2");
    nh_linear_equation_clear(&e);
}

/* Both unknowns of the second order agree with (y, y') and with a rescaled unknown. */
Test(linear_equation, second_order)
{
    nh_linear_equation e;
    nh_linear_equation_init(&e, 2);
    /* y1 = y, y2 = x y' of y'' + y'/x + (1 + 4/x) y = 0:  y1' = y2/x, y2' = -(x + 4) y1 */
    set(&e, 0, 1, "1  1", "2  0 1");
    set(&e, 1, 0, "2  -4 -1", "1  1");
    fmpq_poly_t p, pd, q, qd;
    fmpq_poly_init(p);
    fmpq_poly_init(pd);
    fmpq_poly_init(q);
    fmpq_poly_init(qd);
    cr_assert(nh_linear_equation_second_order(&e, p, pd, q, qd));
    fmpz_poly_t r, rd;
    fmpz_poly_init(r);
    fmpz_poly_init(rd);
    nh_linear_equation_normal_form(p, pd, q, qd, r, rd);
    /* 1/(4x^2) - 1/(2x^2) - 1 - 4/x */
    expect(r, "3  -1 -16 -4");
    expect(rd, "3  0 0 4");
    set(&e, 0, 0, "2  0 1", "2  1 1"); /* a is not 0: y1' = x/(1+x) y1 + y2/x */
    set(&e, 1, 1, "1  3", "2  0 1");
    cr_assert(nh_linear_equation_second_order(&e, p, pd, q, qd));
    /* P = -(a + d + b'/b), Q = a b'/b - a' - b c + a d; at x = 2 */
    fmpq_poly_t x;
    fmpq_poly_init(x);
    cr_assert_eq(fmpq_poly_set_str(x, "1  2"), 0);
    fmpq_t at, value, below;
    fmpq_init(at);
    fmpq_init(value);
    fmpq_init(below);
    fmpq_set_si(at, 2, 1);
    fmpq_poly_evaluate_fmpq(value, p, at);
    fmpq_poly_evaluate_fmpq(below, pd, at);
    fmpq_div(value, value, below);
    fmpq_set_si(at, -5, 3); /* -2/3 - 3/2 + 1/2 */
    cr_expect(fmpq_equal(value, at));
    fmpq_set_si(at, 2, 1);
    fmpq_poly_evaluate_fmpq(value, q, at);
    fmpq_poly_evaluate_fmpq(below, qd, at);
    fmpq_div(value, value, below);
    fmpq_set_si(at, 32, 9); /* -1/3 - 1/9 + 3 + 1 */
    cr_expect(fmpq_equal(value, at));
    set(&e, 0, 1, "0", "1  1");
    nh_linear_equation_reduce(&e);
    cr_expect_not(nh_linear_equation_second_order(&e, p, pd, q, qd));
    fmpq_clear(at);
    fmpq_clear(value);
    fmpq_clear(below);
    fmpq_poly_clear(x);
    fmpz_poly_clear(r);
    fmpz_poly_clear(rd);
    fmpq_poly_clear(p);
    fmpq_poly_clear(pd);
    fmpq_poly_clear(q);
    fmpq_poly_clear(qd);
    nh_linear_equation_clear(&e);
}
