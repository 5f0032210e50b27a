/* Normal equations along planes: against formulas that are derived by hand. */
#include "absence_cases.h"

enum { polynomials = 4 }; /* of P and Q, or of two r */

typedef struct {
    fmpq_poly_t p, p_den, q, q_den;
} second_order;

static void second_order_init(second_order *s)
{
    fmpq_poly_init(s->p);
    fmpq_poly_init(s->p_den);
    fmpq_poly_init(s->q);
    fmpq_poly_init(s->q_den);
}

static void second_order_clear(second_order *s)
{
    fmpq_poly_clear(s->p);
    fmpq_poly_clear(s->p_den);
    fmpq_poly_clear(s->q);
    fmpq_poly_clear(s->q_den);
}

static bool equal_quotients(const fmpq_poly_t a, const fmpq_poly_t a_den, const fmpq_poly_t b, const fmpq_poly_t b_den)
{
    fmpq_poly_t left, right;
    fmpq_poly_init(left);
    fmpq_poly_init(right);
    fmpq_poly_mul(left, a, b_den);
    fmpq_poly_mul(right, b, a_den);
    bool same = fmpq_poly_equal(left, right);
    fmpq_poly_clear(left);
    fmpq_poly_clear(right);
    return same;
}

static void given(const char *p, const char *q, second_order *out)
{
    second_order_init(out);
    rational_of_text(p, out->p, out->p_den);
    rational_of_text(q, out->q, out->q_den);
}

/* y'' + P y' + Q y = 0 for the first unknown of the only block. */
static void expect_second_order(const nh_normal_equation *e, const char *p, const char *q)
{
    second_order found, expected;
    cr_assert_eq(e->blocks, 1);
    cr_assert_eq(e->block[0].size, 2);
    given(p, q, &expected);
    second_order_init(&found);
    cr_assert(nh_linear_equation_second_order(&e->block[0], found.p, found.p_den, found.q, found.q_den));
    cr_expect(equal_quotients(found.p, found.p_den, expected.p, expected.p_den), "P = %s", p);
    cr_expect(equal_quotients(found.q, found.q_den, expected.q, expected.q_den), "Q = %s", q);
    second_order_clear(&found);
    second_order_clear(&expected);
}

Test(normal_equation, henon_heiles)
{
    /* S = 2 h - B y^2 - 2 eps y^3: P = S'/(2 S), Q = (1 + 2 y)/S */
    static const struct {
        const char *B, *eps;
    } of[] = {{"1", "-1/3"}, {"1", "2"}, {"16", "16/3"}, {"7/3", "-5"}, {"1", "0"}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_text text, S, p, q;
        nh_text_init(&text);
        nh_text_init(&S);
        nh_text_init(&p);
        nh_text_init(&q);
        nh_text_addf(&text,
                     "name: hh\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + (%s)*y^2)/2 - x^2*y - (%s)*y^3\n",
                     of[i].B, of[i].eps);
        nh_text_addf(&S, "(2/7 - (%s)*x^2 - 2*(%s)*x^3)", of[i].B, of[i].eps);
        nh_text_addf(&p, "(-2*(%s)*x - 6*(%s)*x^2)/(2*%s)", of[i].B, of[i].eps, nh_text_string(&S));
        nh_text_addf(&q, "(1 + 2*x)/%s", nh_text_string(&S));
        absence_case c = absence_case_text(nh_text_string(&text));
        nh_normal_equation *e = equation_of(&c, "x = 0");
        expect_second_order(e, nh_text_string(&p), nh_text_string(&q));
        cr_expect_eq(e->known, 1);
        cr_expect_eq(e->dimension, 2);
        cr_expect(e->generic && e->single_valued && !e->periodic && !e->triangular);
        cr_expect_str_eq(e->variable, "y");
        nh_normal_equation_clear(e);
        absence_case_clear(&c);
        nh_text_clear(&text);
        nh_text_clear(&S);
        nh_text_clear(&p);
        nh_text_clear(&q);
    }
}
