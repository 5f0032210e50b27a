/* Functions on a curve w^2 = sigma(x), and values of expressions there: the laws of a field with a derivation, and values in doubles. */
#include "absence_cases.h"

static void set_polynomial(fmpz_poly_t p, const char *text) { cr_assert_eq(fmpz_poly_set_str(p, text), 0); }

static nh_curve_element element(const char *even, const char *odd, const char *den)
{
    nh_curve_element e, one;
    nh_curve_field_element_init(&e);
    nh_curve_field_element_init(&one);
    nh_curve_field_set_si(&one, 0);
    set_polynomial(e.even, even);
    set_polynomial(e.odd, odd);
    set_polynomial(e.den, den);
    nh_curve_field_add(&e, &e, &one); /* reduced */
    nh_curve_field_element_clear(&one);
    return e;
}

static nh_curve_field field_of(const char *num, const char *den)
{
    nh_curve_field f;
    nh_curve_field_init(&f);
    set_polynomial(f.num, num);
    set_polynomial(f.den, den);
    return f;
}

Test(curve_field, laws)
{
    nh_curve_field f = field_of("4  2 0 -7 3", "2  1 5");
    nh_curve_element a = element("2  1 2", "3  0 0 -3", "2  4 6"), b = element("1  5", "2  -1 1", "3  1 0 1"), c[4];
    for (size_t i = 0; i < 4; i++) nh_curve_field_element_init(&c[i]);
    /* (a b)' = a' b + a b' */
    nh_curve_field_mul(&f, &c[0], &a, &b);
    nh_curve_field_derivative(&f, &c[0], &c[0]);
    nh_curve_field_derivative(&f, &c[1], &a);
    nh_curve_field_mul(&f, &c[1], &c[1], &b);
    nh_curve_field_derivative(&f, &c[2], &b);
    nh_curve_field_mul(&f, &c[2], &c[2], &a);
    nh_curve_field_add(&c[1], &c[1], &c[2]);
    cr_expect(nh_curve_field_equal(&c[0], &c[1]));
    /* a^-2 a^2 = 1, and a b - a b = 0 */
    cr_assert(nh_curve_field_pow(&f, &c[0], &a, -2));
    cr_assert(nh_curve_field_pow(&f, &c[1], &a, 2));
    nh_curve_field_mul(&f, &c[2], &c[0], &c[1]);
    nh_curve_field_set_si(&c[3], 1);
    cr_expect(nh_curve_field_equal(&c[2], &c[3]));
    nh_curve_field_mul(&f, &c[0], &a, &b);
    nh_curve_field_submul(&f, &c[0], &a, &b);
    cr_expect(nh_curve_field_is_zero(&c[0]));
    cr_expect_not(nh_curve_field_inv(&f, &c[1], &c[0]));
    /* w w = sigma */
    nh_curve_field_set_w(&c[0]);
    nh_curve_field_mul(&f, &c[0], &c[0], &c[0]);
    cr_expect(nh_curve_field_is_even(&c[0]) && !nh_curve_field_is_odd(&c[0]));
    cr_expect(fmpz_poly_equal(c[0].even, f.num) && fmpz_poly_equal(c[0].den, f.den));
    for (size_t i = 0; i < 4; i++) nh_curve_field_element_clear(&c[i]);
    nh_curve_field_element_clear(&a);
    nh_curve_field_element_clear(&b);
    nh_curve_field_clear(&f);
}

/* The root of even/den; NULL: none. */
static void expect_root(const char *even, const char *den, nh_curve_side side, const char *root)
{
    nh_curve_element a = element(even, "0", den), r = element(root ? root : "0", "0", "1  1"), out;
    nh_curve_field_element_init(&out);
    bool found = nh_curve_field_sqrt(&out, &a, side);
    cr_expect_eq(found, root != NULL, "%s", even);
    if (found && root) cr_expect(fmpz_poly_equal(out.even, r.even), "%s: %s", even, root);
    nh_curve_field_element_clear(&a);
    nh_curve_field_element_clear(&r);
    nh_curve_field_element_clear(&out);
}

Test(curve_field, roots)
{
    expect_root("3  0 0 4", "1  9", NH_CURVE_FAR, "2  0 2");
    expect_root("3  0 0 4", "1  9", NH_CURVE_FAR_BELOW, "2  0 -2");
    expect_root("3  0 0 4", "1  9", NH_CURVE_NEAR, NULL); /* |x| has no sign near 0 */
    expect_root("3  1 -2 1", "1  1", NH_CURVE_FAR, "2  -1 1");
    expect_root("3  1 -2 1", "1  1", NH_CURVE_NEAR, "2  1 -1");
    expect_root("3  1 -2 1", "1  1", NH_CURVE_FAR_BELOW, "2  1 -1");
    expect_root("5  1 0 2 0 1", "3  0 0 1", NH_CURVE_FAR_BELOW, "3  -1 0 -1"); /* (1 + x^2)/x */
    expect_root("2  1 1", "1  1", NH_CURVE_FAR, NULL);
    expect_root("1  2", "1  1", NH_CURVE_FAR, NULL);
    expect_root("3  0 0 -1", "1  1", NH_CURVE_FAR, NULL);
}

static double at(const fmpz_poly_t p, double x)
{
    double value = 0;
    for (slong k = fmpz_poly_length(p); k-- > 0;) value = value * x + (double)fmpz_poly_get_coeff_si(p, k);
    return value;
}

/* In x (or an angle x), y = 0 and w = x', with w^2 = 2 + 3 x (or of tan(x/2)). */
static void expect_value(const char *text, bool angle, nh_curve_state expected)
{
    mechanics m = mechanics_of_text("name: v\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\n", NH_CHART_AUTO);
    nh_curve_field f = field_of("2  2 3", "1  1");
    nh_curve_element value;
    nh_curve_state state;
    const char *why = NULL;
    nh_ex e = formula(m.model, text), zero[] = {m.system->coordinate[1].q, m.system->coordinate[1].v};
    nh_curve_place place = {.dag = m.model->dag, .field = &f, .coordinate = m.system->coordinate[0].q, .velocity = m.system->coordinate[0].v,
                            .angle = angle, .zeros = 2, .zero = zero};
    nh_curve_field_element_init(&value);
    nh_curve_value(&place, 1, &e, &value, &state, &why);
    cr_expect_eq(state, expected, "%s: %d", text, state);
    cr_expect_eq(why == NULL, state == NH_CURVE_FINE, "%s", text);
    if (state == NH_CURVE_FINE) {
        double t = 0.713, w = sqrt(2 + 3 * t), z[] = {0, angle ? 2 * atan(t) : t, 0, w, 0};
        cr_expect_float_eq((at(value.even, t) + at(value.odd, t) * w) / at(value.den, t), value_at(m.model, e, z), 1e-12, "%s", text);
    }
    nh_curve_field_element_clear(&value);
    nh_curve_field_clear(&f);
    mechanics_clear(&m);
}

Test(curve_value, of_expressions)
{
    expect_value("(x + x'/3)^3/(1 + x'^2 - x) + 0.25*x^-2", false, NH_CURVE_FINE);
    expect_value("sqrt(x^2 + y^2)*(y + x')/(x + y)^(-5)", false, NH_CURVE_FINE);
    expect_value("(x^2 + y)^(3/2) + exp(y) + log(1 + x*y) + cos(y)*cosh(y) - tan(y + pi/4) + atan(y*x')", false, NH_CURVE_SINGULAR); /* the root of 2 */
    expect_value("(x^2 + y)^(3/2) + exp(y) + log(1 + x*y) + cos(y)*cosh(y) + cos(y + pi) + atan(y*x')", false, NH_CURVE_FINE);
    expect_value("sin(3*x)*cos(2*x - pi/2) + tan(x)^2 - sin(pi - x) + cos(-x + y)", true, NH_CURVE_FINE);
    expect_value("y*exp(x)", false, NH_CURVE_FINE);
    expect_value("x/x + y*sin(x)", false, NH_CURVE_FINE);
    expect_value("exp(x)", false, NH_CURVE_UNKNOWN);
    expect_value("sin(x)", false, NH_CURVE_UNKNOWN);
    expect_value("sin(x/2)", true, NH_CURVE_UNKNOWN);
    expect_value("x*sin(x)", true, NH_CURVE_UNKNOWN);
    expect_value("sqrt(1 + x^2)", false, NH_CURVE_UNKNOWN);
    expect_value("sqrt(2)*x", false, NH_CURVE_UNKNOWN);
    expect_value("cos(pi/5)*x", false, NH_CURVE_UNKNOWN);
    expect_value("sin(x*y + 1)", false, NH_CURVE_UNKNOWN);
    expect_value("x/y", false, NH_CURVE_SINGULAR);
    expect_value("y*(x + 1)/(y*(x + 2) + y^2)", false, NH_CURVE_SINGULAR);
    expect_value("sqrt(y)", false, NH_CURVE_SINGULAR);
    expect_value("y/(1 + exp(x))", false, NH_CURVE_SINGULAR); /* not known to be none */
    expect_value("y/(exp(x) - 1)", false, NH_CURVE_SINGULAR);
    expect_value("log(x)", false, NH_CURVE_SINGULAR);
    expect_value("tan(x + pi/2)*y", true, NH_CURVE_FINE);
    expect_value("tan(y + pi/2)", true, NH_CURVE_SINGULAR);
}
