/* Normal equations along planes: against formulas that are derived by hand. */
#include <math.h>

#include "absence_cases.h"

#include "sweep.h"

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
        nh_text_addf(
            &text,
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

/* P = S'/(2 S) + more, Q = k/S, for S as a text; all in x. */
static void expect_of(const char *system, const char *plane, const char *S, const char *slope, const char *more,
                      const char *k)
{
    nh_text p, q;
    nh_text_init(&p);
    nh_text_init(&q);
    nh_text_addf(&p, "(%s)/(2*(%s)) + (%s)", slope, S, more);
    nh_text_addf(&q, "(%s)/(%s)", k, S);
    absence_case c = absence_case_text(system);
    nh_normal_equation *e = equation_of(&c, plane);
    expect_second_order(e, nh_text_string(&p), nh_text_string(&q));
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
    nh_text_clear(&p);
    nh_text_clear(&q);
}

Test(normal_equation, spring_pendulum)
{
    /* r = sqrt(x^2 + y^2) is y on the plane, and its derivatives are those of r, not of y */
    expect_of("name: s\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 3/2*(x^2 + y^2) + 3*sqrt(x^2 + y^2) + 2*y\n",
              "x = 0, y > 0", "2/7 + 6*x + 4*x - 3*x^2", "10 - 6*x", "0", "3 - 3/x");
    expect_of("name: s\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 3/2*(x^2 + y^2) + 3*sqrt(x^2 + y^2) + 2*y\n",
              "x = 0, y < 0", "2/7 - 6*x + 4*x - 3*x^2", "-2 - 6*x", "0", "3 + 3/x");
    expect_of("name: s\ncoordinates: [r, {name: theta, type: angle}]\nlagrangian: (r'^2 + r^2*theta'^2)/2 - 3/2*r^2 + "
              "3*r + 2*r*cos(theta)\n",
              "theta = 0", "2/7 + 10*x - 3*x^2", "10 - 6*x", "2/x", "2/x");
    expect_of("name: s\ncoordinates: [r, {name: theta, type: angle}]\nlagrangian: (r'^2 + r^2*theta'^2)/2 - 3/2*r^2 + "
              "3*r + 2*r*cos(theta)\n",
              "theta = pi", "2/7 + 2*x - 3*x^2", "2 - 6*x", "2/x", "-2/x");
}

Test(normal_equation, swinging_atwood)
{
    expect_of("name: a\nparameters: [{name: M, value: 2.5}]\ncoordinates: [r, th]\nlagrangian: ((1 + M)*r'^2 + "
              "r^2*th'^2)/2 + r*(cos(th) - M)\n",
              "th = 0", "2*(1/7 - 3/2*x)/(7/2)", "-3/(7/2)", "2/x", "1/x");
}

Test(normal_equation, diagonal_planes)
{
    /* u = y - x:  u'' = -(12 - 2 c) x^2 u;  u = y + x where y = -x */
    const char *quartic = "name: q\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - y^4 - 5*x^2*y^2\n";
    expect_of(quartic, "y = x", "1/7 - 7*x^4", "-28*x^3", "0", "2*x^2");
    expect_of(quartic, "y = -x", "1/7 - 7*x^4", "-28*x^3", "0", "2*x^2");
    expect_of(quartic, "x = 0", "2/7 - 2*x^4", "-8*x^3", "0", "10*x^2");
}

Test(normal_equation, constraints)
{
    /* z' = k y x': (1 + k^2 y^2) x'' + k^2 y y' x' + (1 + 2 y) x = 0 near x = 0; z is left out */
    expect_of("name: n\nparameters: [{name: k, value: 0.5}]\ncoordinates: [x, y, z]\n"
              "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2)/2 - x^2*y - 2*y^3\nconstraints: [\"z' = "
              "k*y*x'\"]\ndependent: [z]\n",
              "x = 0", "2/7 - x^2 - 4*x^3", "-2*x - 12*x^2", "x/4/(1 + x^2/4)", "(1 + 2*x)/(1 + x^2/4)");
    expect_of("name: n\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (3*x^2 + 5*y^2)/2\nconstraints: "
              "[\"z' = y*x'\"]\ndependent: [z]\n",
              "x = 0", "2/7 - 5*x^2", "-10*x", "x/(1 + x^2)", "3/(1 + x^2)");
}

/* A heavy top with moments A, B, C in Euler's angles. */
static const char *top(const char *moments, const char *weight, nh_text *text)
{
    nh_text_init(text);
    nh_text_addf(text,
                 "name: top\nparameters: [%s]\ncoordinates: [{name: theta, type: angle}, {name: phi, type: angle}, "
                 "{name: psi, type: angle}]\n"
                 "definitions:\n  - w1 = psi'*sin(theta)*sin(phi) + theta'*cos(phi)\n  - w2 = psi'*sin(theta)*cos(phi) "
                 "- theta'*sin(phi)\n"
                 "  - w3 = psi'*cos(theta) + phi'\nlagrangian: (A*w1^2 + B*w2^2 + C*w3^2)/2 - (%s)\ndomain: {theta: "
                 "[0.5, 2.5]}\n",
                 moments, weight);
    return nh_text_string(text);
}

/* The momentum of psi holds one direction more: what is left is the equation of Routh's function. */
static void expect_top(const char *moments, const char *weight, const char *p, const char *q)
{
    const char *momentum =
        "A*(psi'*sin(theta)*sin(phi) + theta'*cos(phi))*sin(theta)*sin(phi) + B*(psi'*sin(theta)*cos(phi) - "
        "theta'*sin(phi))*sin(theta)*cos(phi) + C*(psi'*cos(theta) + phi')*cos(theta)";
    nh_text text;
    absence_case c = absence_case_text(top(moments, weight, &text));
    cr_expect_eq(c.shape->left, 1);
    nh_normal_equation *e = equation_with(&c, "theta = pi/2, psi' = 0", 1, &momentum);
    cr_assert_null(e->obstacle, "%s", e->obstacle);
    cr_expect_eq(e->known, 2);
    cr_expect_eq(e->used[1], 1);
    cr_expect_eq(e->dimension, 2);
    cr_expect(e->periodic);
    cr_expect_str_eq(e->variable, "tan(phi/2)");
    expect_second_order(e, p, q);
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
    nh_text_clear(&text);
}

Test(normal_equation, heavy_top)
{
    expect_top(
        "{name: A, value: 3}, {name: B, value: 2}, {name: C, value: 1}", "sin(theta)*sin(phi)",
        "(2*x^7 - 21*x^6 + 14*x^5 - 147*x^4 + 10*x^3 + 7*x^2 - 2*x - 7)/((x^2 + 1)*(x^2 - 14*x + 1)*(x^4 + 4*x^2 + 1))",
        "2*(2*x^6 - 49*x^5 - 2*x^4 - 28*x^3 - 2*x^2 - 49*x + 2)/(3*(x^2 + 1)^2*(x^2 - 14*x + 1)*(x^4 + 4*x^2 + 1))");
    expect_top("{name: A, value: 2}, {name: B, value: 2}, {name: C, value: 1}", "sin(theta)*sin(phi)",
               "(2*x^3 - 21*x^2 + 2*x - 7)/((x^2 + 1)*(x^2 - 14*x + 1))",
               "(x^2 - 28*x + 1)/((x^2 + 1)^2*(x^2 - 14*x + 1))");
    expect_top("{name: A, value: 4}, {name: B, value: 3}, {name: C, value: 2}", "sin(theta)*(sin(phi) + cos(phi))",
               "(48*x^7 - 63*x^6 + 230*x^5 - 343*x^4 - 44*x^3 - 21*x^2 + 54*x - 21)/(2*(x^2 + 1)*(x^2 + 3)*(3*x^2 + "
               "1)*(4*x^2 - 7*x - 3))",
               "(207*x^6 - 420*x^5 + 7*x^4 - 504*x^3 + 21*x^2 - 420*x - 171)/(6*(x^2 + 1)^2*(x^2 + 3)*(3*x^2 + "
               "1)*(4*x^2 - 7*x - 3))");
}

/* The two unknowns of a block of size 2 in the other order. */
static void swap_unknowns(nh_linear_equation *e)
{
    fmpz_poly_swap(e->num + 0, e->num + 3);
    fmpz_poly_swap(e->num + 1, e->num + 2);
}

Test(normal_equation, suslov)
{
    /* Kozlov's case: w2'' = cos(h) w2/I2 along h'^2 = 2 (1/7 - cos(h))/I1, so that S = (1 + x^2) (8 x^2 - 6)/42 for x = tan(h/2).  w2 is the
     * second unknown, and odd: the normal form is the same without regard to a factor w. */
    second_order found, expected;
    absence_case c = absence_case_text(
        "name: s\nparameters: [{name: I1, value: 3}, {name: I2, value: 2}, {name: I3, value: 5}]\n"
        "coordinates: [p, {name: h, type: angle}, {name: s, type: angle}]\n"
        "lagrangian: I1*(h'*cos(s) + p'*sin(h)*sin(s))^2/2 + I2*(-h'*sin(s) + p'*sin(h)*cos(s))^2/2 + I3*(p'*cos(h) + "
        "s')^2/2 - cos(h)\n"
        "constraints: [p'*cos(h) + s' = 0]\nvelocities:\n  names: [w1, w2]\n  map:\n    - h' = w1*cos(s) - w2*sin(s)\n"
        "    - p' = (w1*sin(s) + w2*cos(s))/sin(h)\n    - s' = -(w1*sin(s) + w2*cos(s))*cos(h)/sin(h)\n"
        "domain: {h: [0.6, 2.0]}\n");
    nh_normal_equation *e = equation_of(&c, "s = 0, w2 = 0");
    cr_expect_eq(e->dimension, 2);
    cr_expect(e->periodic);
    given("(32*x^3 + 4*x)/(2*(1 + x^2)*(8*x^2 - 6))", "-42*(1 - x^2)/(2*(1 + x^2)^2*(8*x^2 - 6))", &expected);
    second_order_init(&found);
    swap_unknowns(&e->block[0]);
    cr_assert(nh_linear_equation_second_order(&e->block[0], found.p, found.p_den, found.q, found.q_den));
    fmpz_poly_t r[polynomials];
    for (size_t i = 0; i < polynomials; i++) fmpz_poly_init(r[i]);
    nh_linear_equation_normal_form(found.p, found.p_den, found.q, found.q_den, r[0], r[1]);
    nh_linear_equation_normal_form(expected.p, expected.p_den, expected.q, expected.q_den, r[2], r[3]);
    cr_expect(fmpz_poly_equal(r[0], r[2]) && fmpz_poly_equal(r[1], r[3]));
    for (size_t i = 0; i < polynomials; i++) fmpz_poly_clear(r[i]);
    second_order_clear(&found);
    second_order_clear(&expected);
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

static void expect_entry(const nh_linear_equation *e, size_t i, size_t j, const char *text)
{
    fmpq_poly_t num, den, a, b;
    fmpq_poly_init(num);
    fmpq_poly_init(den);
    fmpq_poly_init(a);
    fmpq_poly_init(b);
    rational_of_text(text, num, den);
    fmpq_poly_set_fmpz_poly(a, e->num + i * e->size + j);
    fmpq_poly_set_fmpz_poly(b, e->den);
    cr_expect(equal_quotients(a, b, num, den), "entry (%zu, %zu) is %s", i, j, text);
    fmpq_poly_clear(num);
    fmpq_poly_clear(den);
    fmpq_poly_clear(a);
    fmpq_poly_clear(b);
}

Test(normal_equation, integrals_hold_directions)
{
    /* Sawada and Kotera: d(x y + x^3/3 + x y^2 + x' y') = (y + y^2, y') in normal directions, so x'_normal = -(y + y^2)/y' x_normal */
    const char *further[] = {"x*y + x^3/3 + x*y^2 + x'*y'", "2*E^2 + 1", "y*(x*y + x^3/3 + x*y^2 + x'*y')"};
    absence_case c = absence_case_text(
        "name: sk\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2 - x^2*y - y^3/3\n");
    nh_normal_equation *e = equation_with(&c, "x = 0", 2, further);
    cr_assert_null(e->obstacle);
    cr_expect_eq(e->known, 2);
    cr_expect_eq(e->unused, 1); /* a function of the energy */
    cr_expect_eq(e->used[0], 0);
    cr_expect_eq(e->used[1], 1);
    cr_assert_eq(e->dimension, 1);
    cr_assert_eq(e->blocks, 1);
    expect_entry(&e->block[0], 0, 0, "-(x + x^2)/(2/7 - x^2 - 2*x^3/3)");
    nh_normal_equation_clear(e);
    e = equation_with(&c, "x = 0", 3, further); /* the third is no integral, and it shows */
    cr_expect_str_eq(e->obstacle, "an integral does not hold near the plane");
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, multiples_of_the_energy)
{
    /* oblique letters, so that the energy has a differential across the plane: d(E (1 + y')) = dE + h dy' there */
    absence_case c =
        absence_case_text("name: o\ncoordinates: [x, y]\nlagrangian: ((x' + 2*y')^2 + y'^2)/2 - (x + 2*y)^4\n");
    const char *further[] = {"E*(1 + y')", "E^2*(1 + 3*y')"};
    nh_normal_equation *e = equation_with(&c, "y = 0", 2, further);
    cr_assert_null(e->obstacle, "%s", e->obstacle);
    cr_expect_eq(e->known, 2);
    cr_expect_eq(e->unused, 1);
    cr_assert_eq(e->dimension, 1);
    expect_entry(&e->block[0], 0, 0, "0"); /* y' is held, so that y does not change */
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, many_valued)
{
    /* near the motions of a pendulum: differentials that are functions on the curve do not make an integral single-valued */
    absence_case c = absence_case_text("name: m\ncoordinates: [th, y]\nlagrangian: (th'^2 + y'^2)/2 + cos(th)\n");
    static const struct {
        const char *integral;
        bool one_value;
    } of[] = {
        {"y'", true},      {"y' + y'^2*th", false},       {"y' + y'^2*cos(th)", true}, {"y' + log(2 + y')", false},
        {"exp(y')", true}, {"y' + y'^2*cos(th/2)", false}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_normal_equation *e = equation_with(&c, "y' = 0", 1, &of[i].integral);
        cr_assert_null(e->obstacle, "%s", e->obstacle);
        cr_expect_eq(e->known, 2);
        cr_expect_eq(e->single_valued, of[i].one_value, "%s", of[i].integral);
        cr_expect_eq(e->dimension, 0);
        nh_normal_equation_clear(e);
    }
    absence_case_clear(&c);
}

Test(normal_equation, two_integrals_at_once)
{
    /* three oscillators without a relation: each energy but that of the motion has differential 0; momenta of a free direction hold one each */
    const char *further[] = {"y'", "z'", "y'*z'", "x'^2/2 + x^4"};
    absence_case c = absence_case_text(
        "name: f\ncoordinates: [x, y, z, u]\nlagrangian: (x'^2 + y'^2 + z'^2 + u'^2)/2 - x^4 - x^2*u^2 + 0*y\n");
    cr_expect_eq(c.shape->left, 2);
    nh_normal_equation *e = equation_with(&c, "u = 0, y' = 0, z' = 0", 3, further);
    cr_assert_null(e->obstacle, "%s", e->obstacle);
    cr_expect_eq(e->known, 3);
    cr_expect_eq(e->unused, 1);
    cr_expect_eq(e->dimension, 2);
    expect_second_order(e, "-8*x^3/(2*(2/7 - 2*x^4))", "2*x^2/(2/7 - 2*x^4)");
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

/* The value of an entry at x. */
static double entry_at(const nh_linear_equation *block, size_t i, size_t j, double x)
{
    double num = 0, den = 0;
    const fmpz_poly_struct *n = block->num + i * block->size + j;
    for (slong k = fmpz_poly_degree(n); k >= 0; k--) num = num * x + fmpz_get_d(n->coeffs + k);
    for (slong k = fmpz_poly_degree(block->den); k >= 0; k--) den = den * x + fmpz_get_d(block->den->coeffs + k);
    return num / den;
}

/* A magnetic force and a potential that couples x and y are not reversible together: xi = u + w v satisfies
 * d xi/dz = C xi for both signs of w, if (u, v) satisfies the doubled equation. */
Test(normal_equation, doubled)
{
    absence_case c = absence_case_text(
        "name: t\ncoordinates: [x, y, z]\n"
        "lagrangian: (x'^2 + y'^2 + z'^2)/2 + 2*z*(x*y' - y*x') - (3*x^2 + 5*y^2 + z^2)/2 - x^2*z - 7*x*y\n");
    nh_normal_equation *e = equation_of(&c, "x = 0, y = 0");
    cr_assert_null(e->obstacle);
    cr_assert(e->doubled);
    cr_assert_eq(e->dimension, 4);
    cr_assert_eq(e->blocks, 1);
    enum { d = 4, both = 2 * d };
    cr_assert_eq(e->block[0].size, both);
    const double z = 0.21, S = 2.0 / 7 - z * z, slope = -z / S; /* w'/w */
    double u[d] = {0.3, -1.1, 0.7, 0.2}, v[d] = {-0.4, 0.9, 1.3, -0.6};
    for (int sign = -1; sign <= 1; sign += 2) {
        double w = sign * sqrt(S), xi[d];
        const double C[d][d] = {{0, 0, 1 / w, 0},
                                {0, 0, 0, 1 / w},
                                {-(3 + 2 * z) / w, 2 - 7 / w, 0, 4 * z / w},
                                {-2 - 7 / w, -5 / w, -4 * z / w, 0}};
        for (size_t i = 0; i < d; i++) xi[i] = u[i] + w * v[i];
        for (size_t i = 0; i < d; i++) {
            double expected = 0, du = 0, dv = 0;
            for (size_t j = 0; j < d; j++) expected += C[i][j] * xi[j];
            for (size_t j = 0; j < both; j++) {
                double value = j < d ? u[j] : v[j - d];
                du += entry_at(&e->block[0], i, j, z) * value;
                dv += entry_at(&e->block[0], d + i, j, z) * value;
            }
            cr_expect_float_eq(du + w * dv + slope * w * v[i], expected, 1e-12);
        }
    }
    cr_expect_eq(nh_normal_equation_orbit(e, 8), 4);
    cr_expect_eq(nh_normal_equation_orbit(e, 3), 2);
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, blocks)
{
    /* the block of size 4 of three degrees of freedom: K couples x and y */
    absence_case c = absence_case_text("name: t\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + "
                                       "2*y^2 + z^2)/2 - (x^2 + 2*y^2 + 3*x*y)*z + z^3/3\n");
    nh_normal_equation *e = equation_of(&c, "x = 0, y = 0");
    const char *S = "(2/7 - x^2 + 2*x^3/3)";
    cr_assert_eq(e->blocks, 1);
    cr_assert_eq(e->block[0].size, 4);
    cr_expect_not(e->triangular);
    static const char *const top_of[] = {"1 + 2*x", "3*x", "3*x", "2 + 4*x"};
    for (size_t i = 0; i < 2; i++)
        for (size_t j = 0; j < 2; j++) {
            nh_text entry;
            nh_text_init(&entry);
            nh_text_addf(&entry, "-(%s)/%s", top_of[2 * i + j], S);
            expect_entry(&e->block[0], i, j, "0");
            expect_entry(&e->block[0], i, 2 + j, i == j ? "1" : "0");
            expect_entry(&e->block[0], 2 + i, j, nh_text_string(&entry));
            nh_text_clear(&entry);
            nh_text_init(&entry);
            nh_text_addf(&entry, "-(-2*x + 2*x^2)/(2*%s)", S);
            expect_entry(&e->block[0], 2 + i, 2 + j, i == j ? nh_text_string(&entry) : "0");
            nh_text_clear(&entry);
        }
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
    /* with a rotation about z: two equal blocks; its momentum has differential 0 on the plane */
    const char *momentum = "x*y' - y*x'";
    c = absence_case_text("name: t\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2)/2 - "
                          "(x^2 + y^2)*z + z^3/3\n");
    e = equation_with(&c, "x = 0, y = 0", 1, &momentum);
    cr_assert_null(e->obstacle);
    cr_expect_eq(e->unused, 1);
    cr_expect_eq(e->dimension, 4);
    cr_assert_eq(e->blocks, 2);
    cr_expect_not(e->triangular);
    for (size_t b = 0; b < 2; b++) {
        cr_expect_eq(e->block[b].size, 2);
        expect_entry(&e->block[b], 0, 1, "1");
        expect_entry(&e->block[b], 1, 0, "-(1 + 2*x)/(2/7 - x^2 + 2*x^3/3)");
    }
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
    /* y feels x by a force that is none of a potential, x does not feel y */
    c = absence_case_text("name: t\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + 3*y^2 + "
                          "z^2)/2\nforces: {y: x*z}\n");
    e = equation_of(&c, "x = 0, y = 0");
    cr_assert_eq(e->blocks, 2);
    cr_expect(e->triangular);
    expect_entry(&e->block[0], 1, 0, "-1/(2/7 - x^2)");
    expect_entry(&e->block[1], 1, 0, "-3/(2/7 - x^2)");
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

static void expect_obstacle(const char *system, const char *plane, const char *obstacle)
{
    absence_case c = absence_case_text(system);
    nh_normal_equation *e = equation_with(&c, plane, 0, NULL);
    cr_assert_not_null(e->obstacle, "%s", system);
    cr_expect_str_eq(e->obstacle, obstacle);
    cr_expect_eq(e->blocks, 0);
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, obstacles)
{
    expect_obstacle("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(1 + y^2)*(1 + x^2)\n", "x = 0",
                    "roots remain on the plane");
    expect_obstacle("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - exp(y)*(1 + x^2)\n", "x = 0",
                    "functions that are not rational remain on the plane");
    expect_obstacle("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - sqrt(2)*x^2*y\n", "x = 0",
                    "irrational numbers remain");
    expect_obstacle("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - sin(y)*x^2*y\n", "x = 0",
                    "functions that are not rational remain on the plane");
    expect_obstacle("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - y^2 - x^2*y\nforces: {y: -y'}\n",
                    "x = 0", "the integral does not hold on the plane");
}

Test(normal_equation, numbers)
{
    /* decimals are the ratios that they are written as, of any length */
    absence_case c = absence_case_text(
        "name: d\nparameters: [{name: a, value: 0.1234567890123}, {name: b, value: 1e-9}]\ncoordinates: [x, y]\n"
        "lagrangian: (x'^2 + y'^2)/2 - a*b*y^4 - a*b*b*x^2*y^2\n");
    nh_normal_equation *e = equation_of(&c, "x = 0");
    expect_entry(&e->block[0], 1, 0, "-2*(1234567890123/10^13/10^9/10^9*x^2)/(2/7 - 2*1234567890123/10^13/10^9*x^4)");
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, levels)
{
    absence_case c = absence_case_text(
        "name: p\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (y^2 - 2/7*y + 1/49 + 1/7)*(1 + x^2)\n");
    nh_ex integral = c.of.model->E;
    bool generic = true;
    nh_known_integrals known = {1, &integral, &generic, 0};
    size_t n = 0;
    const char *last = "";
    for (;; n++) {
        nh_normal_equation *e = nh_normal_equation_of(c.arena, c.shape, plane_named(&c, "x = 0"), &known, n);
        bool end = e->obstacle != NULL;
        if (end) {
            cr_expect_str_eq(e->obstacle, "no further level is tried");
        } else {
            cr_expect_neq(e->level, nh_ratio(c.of.model->dag, 1, 7)); /* that of the state of rest */
            cr_expect_str_neq(e->curve, last);
            last = e->curve;
        }
        nh_normal_equation_clear(e);
        if (end) break;
    }
    cr_expect_geq(n, 10);
    known.energy = 1; /* the energy is found among the integrals, too */
    nh_normal_equation *e = nh_normal_equation_of(c.arena, c.shape, plane_named(&c, "x = 0"), &known, 0);
    cr_expect_null(e->obstacle);
    nh_normal_equation_clear(e);
    known.count = 0;
    known.energy = 0;
    e = nh_normal_equation_of(c.arena, c.shape, plane_named(&c, "x = 0"), &known, 0);
    cr_expect_str_eq(e->obstacle, "no integral determines the curve");
    nh_normal_equation_clear(e);
    absence_case_clear(&c);
}

Test(normal_equation, equal_ones)
{
    /* a reflection exchanges the diagonals, none the axes */
    absence_case c =
        absence_case_text("name: q\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - 2*y^4 - 5*x^2*y^2\n");
    absence_case d =
        absence_case_text("name: q\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x^4 - y^4 - 5*x^2*y^2\n");
    nh_normal_equation *e[] = {equation_of(&c, "x = 0"), equation_of(&c, "y = 0"), equation_of(&d, "x = 0"),
                               equation_of(&d, "y = x"), equation_of(&d, "y = -x")};
    cr_expect(nh_normal_equation_equal(e[3], e[4]));
    cr_expect_not(nh_normal_equation_equal(e[0], e[1]));
    cr_expect_not(nh_normal_equation_equal(e[2], e[3]));
    for (size_t i = 0; i < sizeof e / sizeof *e; i++) nh_normal_equation_clear(e[i]);
    absence_case_clear(&c);
    absence_case_clear(&d);
}

/* ---- of every system, in doubles: the block from differences of the rates, along the curve by the energy's values ---- */

enum { most_letters = 16 };

typedef struct {
    size_t n;                                  /* letters */
    double y[most_letters];                    /* the state on the plane */
    double block[most_letters * most_letters]; /* d xi/dt = block xi, n - 2 of them */
    double rate, slope;                        /* of the field's variable; w'/w per unit of it */
} differences;

static void evaluate(const absence_case *c, const nh_plane *plane, size_t n, const nh_ex *e, const double *y,
                     double *out)
{
    const nh_model *m = c->of.model;
    nh_tape *tape = nh_tape_create(m->dag, c->shape->count, plane->y, n, e, m->system->parameters, m->parameter,
                                   m->parameter_value);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, y, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

/* At t, a value of the variable; false where the velocity is not real. */
static bool differences_at(const absence_case *c, const nh_normal_equation *e, double t, differences *d)
{
    const nh_plane *plane = e->plane;
    size_t n = d->n = c->shape->count;
    double energy[3], up[most_letters], down[most_letters], step = 1e-5, h = nh_model_number(c->of.model, e->level);
    nh_ex E = nh_substitute(c->of.model->dag, c->of.model->E, n, c->shape->letter, plane->letter);
    memset(d->y, 0, sizeof d->y);
    d->y[0] = plane->angle ? 2 * atan(t) : t;
    for (int k = 0; k < 3; k++) {
        d->y[1] = k;
        evaluate(c, plane, 1, &E, d->y, &energy[k]);
    }
    double square = (h - energy[0]) / (energy[1] - energy[0]);
    if (!(square > 1e-3) || !(fabs(energy[2] - 4 * energy[1] + 3 * energy[0]) < 1e-9 * (1 + fabs(energy[2]))))
        return false;
    d->y[1] = sqrt(square);
    evaluate(c, plane, n, plane->rate, d->y, up);
    d->rate = up[0] * (plane->angle ? (1 + t * t) / 2 : 1);
    d->slope = up[1] / d->y[1] / d->rate;
    for (size_t j = 2; j < n; j++) {
        d->y[j] = step;
        evaluate(c, plane, n, plane->rate, d->y, up);
        d->y[j] = -step;
        evaluate(c, plane, n, plane->rate, d->y, down);
        d->y[j] = 0;
        for (size_t i = 2; i < n; i++) d->block[(i - 2) * (n - 2) + j - 2] = (up[i] - down[i]) / (2 * step);
    }
    return true;
}

static double at_point(const fmpz_poly_t p, double x)
{
    double value = 0;
    for (slong k = fmpz_poly_length(p); k-- > 0;) {
        fmpz_t c;
        fmpz_init(c);
        fmpz_poly_get_coeff_fmpz(c, p, k);
        value = value * x + fmpz_get_d(c);
        fmpz_clear(c);
    }
    return value;
}

/* Does the equation fit with xi_i = w^(s_i) eta_i, s_i the bits of `parity`? */
static bool fits(const nh_linear_equation *block, const differences *d, double t, unsigned parity)
{
    size_t n = block->size;
    double den = at_point(block->den, t), w = d->y[1];
    for (size_t i = 0; i < n; i++)
        for (size_t j = 0; j < n; j++) {
            int si = parity >> i & 1, sj = parity >> j & 1;
            double expected = d->block[i * n + j] / d->rate * pow(w, sj - si) - (i == j && si ? d->slope : 0);
            if (!(fabs(at_point(block->num + i * n + j, t) / den - expected) < 1e-5 * (1 + fabs(expected))))
                return false;
        }
    return true;
}

static bool expect_differences(const absence_case *c, const nh_normal_equation *e)
{
    static const double of_sides[][3] = {{0.613, 1.271, 2.713}, {-0.613, -1.271, -2.713}, {0.171, -0.347, 0.0613}};
    const double *tries = of_sides[e->plane->side];
    unsigned possible[1 << 8], count = 0;
    size_t n = e->dimension, seen = 0;
    for (unsigned s = 0; s < 1u << n; s++) possible[count++] = s;
    for (size_t k = 0; k < 3; k++) {
        differences d;
        unsigned left = 0;
        if (!differences_at(c, e, tries[k], &d)) continue;
        for (unsigned s = 0; s < count; s++)
            if (fits(&e->block[0], &d, tries[k], possible[s])) possible[left++] = possible[s];
        count = left;
        seen++;
    }
    cr_expect(seen == 0 || count > 0, "%s, %s", c->of.system->name, e->plane->words);
    return seen > 0;
}

Test(normal_equation, of_every_system)
{
    char *name[most_files];
    size_t n = list("systems", name), seen = 0;
    for (size_t i = 0; i < n; i++) {
        char path[300];
        nh_error error = {0};
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        free(name[i]);
        if (!sweep_tries(i + 1, 2, 8)) continue;
        nh_system *system = nh_system_read(path, 0, NULL, &error);
        nh_chart *chart = system ? nh_chart_create(system, NH_CHART_AUTO, 1, &error) : NULL;
        nh_model *model = chart ? nh_model_create(system, chart, &error) : NULL;
        if (!model) {
            nh_system_free(system);
            continue;
        }
        absence_case c = absence_case_of((mechanics){system, model});
        nh_known_integrals known = {1, &model->E, (const bool[]){true}, 0};
        for (size_t p = 0; p < c.planes; p++) {
            nh_normal_equation *e = nh_normal_equation_of(c.arena, c.shape, &c.plane[p], &known, 0);
            if (!e->obstacle && e->blocks == 1) seen += expect_differences(&c, e);
            nh_normal_equation_clear(e);
        }
        absence_case_clear(&c);
    }
    cr_expect_gt(seen, (size_t)(sweep_sanitized() ? 2 : 15));
}
