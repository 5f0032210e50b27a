/* Functions with a name but no elementary form: their values against GSL, their derivatives against complex differences, the relations between them,
 * exact proofs with them and refusals, and how they are written in every language. */
#include "program.h"
#include "random_expression.h"
#include "scratch.h"
#include "sweep.h"

#include <gsl/gsl_errno.h>
#include <gsl/gsl_odeiv2.h>
#include <gsl/gsl_sf.h>
#include <math.h>

#include "base/memory.h"
#include "document/source.h"
#include "document/typeset.h"
#include "evaluate/named_value.h"
#include "evaluate/tape.h"
#include "evaluate/tape_complex.h"
#include "exact/ball.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "graph/diff.h"
#include "graph/function.h"
#include "graph/node.h"
#include "graph/num.h"
#include "graph/parse.h"

/* ---- asking ---- */

static nh_ex meant(nh_dag *d, const char *text)
{
    nh_ex e = parsed(d, text);
    cr_assert(nh_kind_of(d, e) != NH_NUMBER || isfinite(nh_num_value(nh_number_of(d, e))), "%s", text);
    return e;
}

/* At x = spot, with the letters a, b, c, n, s, p for orders. */
enum { LETTERS = 7 };
static const char *const letter[LETTERS] = {"x", "a", "b", "c", "n", "s", "p"};
static const double order[LETTERS] = {0, 0.37, 1.21, 1.73, 0.43, 0.9, 1.4};

static double complex at(nh_dag *d, nh_ex e, double complex spot)
{
    nh_ex symbol[LETTERS];
    double complex in[LETTERS], out;
    for (int i = 0; i < LETTERS; i++) {
        symbol[i] = nh_symbol(d, letter[i]);
        in[i] = i ? order[i] : spot;
    }
    nh_tape *tape = nh_tape_create(d, LETTERS, symbol, 1, &e, 0, NULL, NULL);
    nh_ex unbound;
    cr_assert(!nh_tape_unbound(tape, &unbound), "%s", nh_name_of(d, unbound));
    double complex *work = nh_tape_complex_create(tape);
    nh_tape_eval_complex(tape, work, in, &out);
    nh_free(work);
    nh_tape_free(tape);
    return out;
}

static double real_at(nh_dag *d, nh_ex e, double spot)
{
    nh_ex symbol[LETTERS];
    double in[LETTERS], out;
    for (int i = 0; i < LETTERS; i++) {
        symbol[i] = nh_symbol(d, letter[i]);
        in[i] = i ? order[i] : spot;
    }
    nh_tape *tape = nh_tape_create(d, LETTERS, symbol, 1, &e, 0, NULL, NULL);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, in, &out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return out;
}

static double value(const char *text, double spot)
{
    nh_dag *d = nh_dag_create();
    double y = real_at(d, meant(d, text), spot);
    nh_dag_free(d);
    return y;
}

static void near(double a, double b, double tolerance, const char *what)
{
    cr_assert(fabs(a - b) <= tolerance * fmax(1, fabs(b)), "%s: %.17g, expected %.17g", what, a, b);
}

/* All functions, as calls with a moving last argument and orders that are letters. */
static const char *const calls[] = {
    "legendre_p(n, x)", "legendre_q(n, x)", "hyp2f1(a, b, c, x)", "gauss_f(s, p, c, x)", "hyp1f1(a, b, x)", "hyperu(a, b, x)", "bessel_j(n, x)",
    "bessel_y(n, x)", "bessel_i(n, x)", "bessel_k(n, x)", "airy_ai(x)", "airy_bi(x)", "legendre_p_prime(n, x)", "legendre_q_prime(n, x)",
    "hyp2f1_prime(a, b, c, x)", "gauss_f_prime(s, p, c, x)", "hyp1f1_prime(a, b, x)", "hyperu_prime(a, b, x)", "bessel_j_prime(n, x)",
    "bessel_y_prime(n, x)", "bessel_i_prime(n, x)", "bessel_k_prime(n, x)", "airy_ai_prime(x)", "airy_bi_prime(x)", "riemann_c(a, b, c, x)", "riemann_s(a, b, c, x)", "riemann_c_prime(a, b, c, x)",
    "riemann_s_prime(a, b, c, x)", "elliptic_k(x)", "elliptic_e(x)",
    "elliptic_f(x, a)", "elliptic_einc(x, a)", "elliptic_f(a, x)", "elliptic_einc(a, x)",
    "elliptic_pi(x, a, b)", "elliptic_pi(a, x, b)", "elliptic_pi(a, b, x)"};
enum { CALLS = sizeof calls / sizeof *calls };

/* ---- values ---- */

Test(named_functions, values_agree_with_gsl)
{
    gsl_set_error_handler_off();
    for (double x = 0.06; x < 0.95; x += 0.11) {
        double a = order[1], b = order[2], c = order[3], n = order[4], s = order[5], p = order[6], w = sqrt(p - s * s / 4);
        near(value("bessel_j(n, x)", x), gsl_sf_bessel_Jnu(n, x), 1e-13, "J");
        near(value("bessel_y(n, x)", x), gsl_sf_bessel_Ynu(n, x), 1e-13, "Y");
        near(value("bessel_i(n, x)", x), gsl_sf_bessel_Inu(n, x), 1e-13, "I");
        near(value("bessel_k(n, x)", x), gsl_sf_bessel_Knu(n, x), 1e-13, "K");
        near(value("airy_ai(-9*x)", x), gsl_sf_airy_Ai(-9 * x, GSL_PREC_DOUBLE), 1e-12, "Ai");
        near(value("airy_bi_prime(3*x)", x), gsl_sf_airy_Bi_deriv(3 * x, GSL_PREC_DOUBLE), 1e-12, "Bi'");
        near(value("hyp2f1(a, b, c, x)", x), gsl_sf_hyperg_2F1(a, b, c, x), 1e-12, "2F1");
        near(value("gauss_f(s, p, c, x)", x), gsl_sf_hyperg_2F1_conj(s / 2, w, c, x), 1e-12, "2F1 with a, b conjugate");
        near(value("gauss_f(a + b, a*b, c, x)", x), gsl_sf_hyperg_2F1(a, b, c, x), 1e-12, "2F1 by sum and product");
        near(value("hyp1f1(a, b, 7*x)", x), gsl_sf_hyperg_1F1(a, b, 7 * x), 1e-12, "1F1");
        near(value("hyperu(a, b, x)", x), gsl_sf_hyperg_U(a, b, x), 1e-12, "U");
        near(value("legendre_p(7, x)", x), gsl_sf_legendre_Pl(7, x), 1e-13, "P_7");
        near(value("legendre_q(3, x)", x), gsl_sf_legendre_Ql(3, x), 1e-13, "Q_3");
        near(value("legendre_q(3, 1 + x)", x), gsl_sf_legendre_Ql(3, 1 + x), 1e-12, "Q_3 beyond 1");
        near(value("gauss_f(1, 1/4 + s^2, 1, (1 - x)/2)", x), gsl_sf_conicalP_0(s, x), 1e-12, "conical");
        near(value("elliptic_k(x)", x), gsl_sf_ellint_Kcomp(sqrt(x), GSL_PREC_DOUBLE), 1e-13, "K(m)");
        near(value("elliptic_e(x)", x), gsl_sf_ellint_Ecomp(sqrt(x), GSL_PREC_DOUBLE), 1e-13, "E(m)");
        near(value("elliptic_f(x, a)", x), gsl_sf_ellint_F(x, sqrt(a), GSL_PREC_DOUBLE), 1e-13, "F");
        near(value("elliptic_einc(x, a)", x), gsl_sf_ellint_E(x, sqrt(a), GSL_PREC_DOUBLE), 1e-13, "E(phi, m)");
        near(value("elliptic_pi(b, x, a)", x), gsl_sf_ellint_P(x, sqrt(a), -b, GSL_PREC_DOUBLE), 1e-13, "Pi(n, phi, m)");
    }
}

static int riemann_rates(double x, const double y[], double rate[], void *equation)
{
    const double *p = equation;
    rate[0] = y[1];
    rate[1] = (p[0] + (p[1] + p[2] * x) * x) / ((1 + x * x) * (1 + x * x)) * y[0];
    return GSL_SUCCESS;
}

/* Riemann's equation with the singular points i, -i and infinity: closed forms [DLMF 15.4.12, 15.8.1], and its motion by an
   integrator. */
Test(named_functions, riemann)
{
    const double spot[] = {-6, -0.8, 0, 1e-9, 0.3, 2.4, 40};
    for (size_t i = 0; i < sizeof spot / sizeof *spot; i++) {
        double x = spot[i], s = sqrt(1 - order[1]), turn = s * atan(x), far = sqrt(1 + x * x);
        near(value("riemann_c(a, 0, 0, x)", x), far * cos(turn), 1e-14 * far, "cosine of an arc tangent");
        near(value("riemann_s(a, 0, 0, x)", x), far * sin(turn) / s, 1e-14 * far, "sine of an arc tangent");
        near(value("riemann_c(c - 2, 0, c, x) - (1 + x^2)^((1 + sqrt(3))/2)*hyp2f1((1 + 2*sqrt(3) + sqrt(1 + 4*c))/4, "
                   "(1 + 2*sqrt(3) - sqrt(1 + 4*c))/4, 1/2, -x^2)", x),
             0, 1e-12 * far * far, "even");
        near(value("riemann_c(a, b, c, x)*riemann_s_prime(a, b, c, x) - riemann_s(a, b, c, x)*riemann_c_prime(a, b, c, x)", x), 1,
             1e-13 * far * far, "determinant of Wronski");
        double equation[3] = {order[1], order[2], order[3]}, at = 0, y[2] = {1, 0};
        gsl_odeiv2_system ode = {riemann_rates, NULL, 2, equation};
        gsl_odeiv2_driver *driver = gsl_odeiv2_driver_alloc_y_new(&ode, gsl_odeiv2_step_rk8pd, x < 0 ? -1e-3 : 1e-3, 1e-14, 1e-13);
        if (x != 0) cr_assert_eq(gsl_odeiv2_driver_apply(driver, &at, x, y), GSL_SUCCESS);
        gsl_odeiv2_driver_free(driver);
        near(value("riemann_c(a, b, c, x)", x), y[0], 1e-11, "its motion");
        near(value("riemann_c_prime(a, b, c, x)", x), y[1], 1e-11, "its rate");
    }
    cr_assert(isnan(value("riemann_c(a, b, c, x)", NAN)));
}

/* The double next to the ball of 300 bits. */
static void expect_next_to_ball(nh_function f, const double *argument, double got)
{
    arb_ptr x = _arb_vec_init(4);
    arb_t ball;
    arb_init(ball);
    for (size_t k = 0; k < 4; k++) arb_set_d(x + k, argument[k]);
    nh_named_value_ball(f, x, ball, 300);
    cr_expect_eq(got, arf_get_d(arb_midref(ball), ARF_RND_NEAR), "%d at %g: %.17g", (int)f, argument[3], got);
    arb_clear(ball);
    _arb_vec_clear(x, 4);
}

/* Places of the same equation share a path with its series, and a few paths are kept: whatever else was asked in between, and in whatever order, each
 * is the double next to its ball. */
Test(named_functions, riemann_in_any_order)
{
    enum { most = 40, functions = 4 }; /* some of them want the same row */
    size_t places = sweep_whole() ? most : 12;
    static const nh_function f[functions] = {NH_RIEMANN_C, NH_RIEMANN_S_PRIME, NH_RIEMANN_C_PRIME, NH_RIEMANN_S};
    static double first[functions][most];
    for (int round = 0; round < 3; round++)
        for (size_t k = 0; k < functions; k++)
            for (size_t step = 0; step < places; step++) {
                size_t i = round == 1 ? places - 1 - step : step, g = round == 1 ? functions - 1 - k : k;
                double u = (double)i, argument[4] = {sin(u), cos(3 * u), round < 2 || i % 2 ? sin(5 * u) / 2 : NAN, 2 * sin(7 * u)};
                double got = nh_named_value(f[g], argument);
                if (round == 0) first[g][i] = got;
                else if (isnan(argument[2])) cr_expect(isnan(got), "%g", got);
                else cr_expect_eq(got, first[g][i], "%zu at %zu: %.17g, %.17g", g, i, got, first[g][i]);
            }
    for (size_t i = 0; i < places; i += 8)
        for (size_t g = 0; g < functions; g++) {
            double u = (double)i;
            const double argument[4] = {sin(u), cos(3 * u), sin(5 * u) / 2, 2 * sin(7 * u)};
            expect_next_to_ball(f[g], argument, first[g][i]);
        }
}

/* One path to either side: the place 0, places at its first steps, and far beyond the series that are kept; no value where a place is not finite. */
Test(named_functions, riemann_on_one_path)
{
    static const nh_function f[] = {NH_RIEMANN_C, NH_RIEMANN_C_PRIME, NH_RIEMANN_S, NH_RIEMANN_S_PRIME};
    static const double size[] = {0, 1e-300, 1e-9, 0.14985, 0.149851, 0.7, 3.3, 47, 1e4, 1e9, 1e17, 1e19};
    for (size_t g = 0; g < sizeof f / sizeof *f; g++)
        for (size_t i = 0; i < sizeof size / sizeof *size; i++)
            for (int side = -1; side <= 1; side += 2) {
                if (!sweep_tries(i + g + (side > 0), 2, 4)) continue;
                const double argument[4] = {0.37, 1.21, -0.3, side * size[i]};
                expect_next_to_ball(f[g], argument, nh_named_value(f[g], argument));
            }
    cr_expect(isnan(nh_named_value(NH_RIEMANN_C, (const double[]){1, 0, 0, INFINITY})));
    cr_expect(isnan(nh_named_value(NH_RIEMANN_C, (const double[]){1, INFINITY, 0, 1})));
}

/* Zero, a pole, a cut and large arguments. */
Test(named_functions, edges)
{
    cr_assert_eq(value("bessel_j(1, x)", 0), 0);
    cr_assert_eq(value("legendre_p(1, x)", 0), 0);
    cr_assert(!isfinite(value("bessel_y(n, x)", 0)));
    cr_assert(isnan(value("bessel_y(n, x)", -1)), "no real value on a cut");
    cr_assert(isnan(value("hyp2f1(a, b, c, x)", 2)));
    near(value("bessel_j(0, x)", 1e5), gsl_sf_bessel_J0(1e5), 1e-12, "J_0(1e5)");
    near(value("airy_ai(x)", 40), gsl_sf_airy_Ai(40, GSL_PREC_DOUBLE), 1e-15, "Ai(40)");
    cr_assert_gt(value("airy_ai(x)", 40), 1e-80);
}

Test(named_functions, balls_contain_the_doubles)
{
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < CALLS; i++) {
        nh_ex e = meant(d, calls[i]);
        nh_ball *ball = nh_ball_create(d, 300);
        for (int k = 0; k < LETTERS; k++) nh_ball_set_double(ball, nh_symbol(d, letter[k]), k ? order[k] : 0.3125);
        double mid, radius, y = real_at(d, e, 0.3125);
        cr_assert(nh_ball_value(ball, e, &mid, &radius), "%s", calls[i]);
        cr_assert(fabs(y - mid) <= radius + 2.3e-16 * fabs(mid), "%s: %.17g, %.17g", calls[i], y, mid);
        nh_ball_free(ball);
    }
    nh_dag_free(d);
}

/* Many points at once, and tapes whose orders are inputs or constants. */
Test(named_functions, batches_and_single_points_agree)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), e[CALLS];
    nh_ex fixed[LETTERS - 1];
    for (int i = 1; i < LETTERS; i++) fixed[i - 1] = nh_symbol(d, letter[i]);
    for (size_t i = 0; i < CALLS; i++) e[i] = meant(d, calls[i]);
    nh_tape *tape = nh_tape_create(d, 1, &x, CALLS, e, LETTERS - 1, fixed, order + 1);
    nh_tape_work *work = nh_tape_work_create(tape);
    double in[5] = {0.11, 0.23, 0.41, 0.52, 0.77}, out[CALLS][5], *row[CALLS], one[CALLS];
    for (size_t i = 0; i < CALLS; i++) row[i] = out[i];
    nh_tape_eval_batch(tape, work, 5, (const double *[]){in}, row);
    for (size_t p = 0; p < 5; p++) {
        nh_tape_eval(tape, work, &in[p], one);
        for (size_t i = 0; i < CALLS; i++) {
            cr_assert(isfinite(one[i]), "%s", calls[i]);
            cr_assert_eq(one[i], out[i][p], "%s", calls[i]);
            cr_assert_eq(one[i], real_at(d, e[i], in[p]), "%s", calls[i]);
        }
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_dag_free(d);
}

/* ---- derivatives ---- */

Test(named_functions, derivatives_are_complex_differences)
{
    static const double h = 1e-30;
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x");
    for (size_t i = 0; i < CALLS; i++) {
        nh_ex e = meant(d, calls[i]), rate = nh_diff(d, e, x), gradient;
        nh_gradient(d, e, 1, &x, &gradient);
        for (double spot = 0.07; spot < 0.9; spot += 0.2) {
            double expected = cimag(at(d, e, CMPLX(spot, h))) / h;
            near(real_at(d, rate, spot), expected, 1e-11, calls[i]);
            near(real_at(d, gradient, spot), expected, 1e-11, calls[i]);
        }
    }
    nh_dag_free(d);
}

/* For an amplitude 2 atan(..) they are written without the sine. */
Test(named_functions, derivatives_by_half_the_amplitude)
{
    static const char *const doubled[] = {"elliptic_f(2*atan(x), a)", "elliptic_einc(2*atan(x/3), a)", "elliptic_pi(a/4, 2*atan(2*x), a)", "elliptic_f(2*atan(a), x)"};
    static const double h = 1e-30;
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x");
    for (size_t i = 0; i < sizeof doubled / sizeof *doubled; i++) {
        nh_ex e = meant(d, doubled[i]), rate = nh_diff(d, e, x);
        for (double spot = 0.07; spot < 0.9; spot += 0.2) near(real_at(d, rate, spot), cimag(at(d, e, CMPLX(spot, h))) / h, 1e-11, doubled[i]);
    }
    nh_dag_free(d);
}

/* With respect to an order: nobody knows, and nothing is claimed. */
Test(named_functions, no_derivative_with_respect_to_orders)
{
    nh_dag *d = nh_dag_create();
    nh_ex rate = nh_diff(d, meant(d, "bessel_j(n, x)"), nh_symbol(d, "n"));
    cr_assert(isnan(real_at(d, rate, 0.5)));
    cr_assert_neq(nh_normal_is_zero(d, rate, 0), NH_ZERO);
    nh_dag_free(d);
}

/* ---- relations ---- */

/* What a canonical form says is the same function. */
Test(named_functions, neighbouring_orders_by_values)
{
    static const char *const moved[] = {
        "legendre_p(n + 2, x)", "legendre_p(n - 2, x)", "legendre_q(n + 1, x)", "legendre_q_prime(n - 1, x)", "hyp2f1(a + 1, b, c, x)",
        "hyp2f1(a - 2, b, c, x)", "hyp2f1(a, b + 2, c - 1, x)", "hyp2f1_prime(a, b - 1, c + 2, x)", "hyp1f1(a + 2, b - 1, x)", "hyp1f1_prime(a - 1, b + 2, x)",
        "gauss_f(s, p, c + 2, x)", "gauss_f_prime(s, p, c - 2, x)", "hyperu(a + 2, b, x)", "hyperu(a - 2, b - 1, x)", "hyperu_prime(a, b + 2, x)",
        "bessel_j(n + 3, x)", "bessel_j_prime(n - 2, x)", "bessel_y(n - 2, x)", "bessel_y_prime(n + 1, x)", "bessel_i(n + 2, x)", "bessel_i_prime(n - 3, x)",
        "bessel_k(n + 2, x)", "bessel_k_prime(n - 1, x)", "bessel_j(3, x)", "bessel_k(7/2, x)", "legendre_p(4, x)", "bessel_y_prime(0, x)", "airy_bi_prime(x)"};
    nh_dag *d = nh_dag_create();
    for (size_t i = 0; i < sizeof moved / sizeof *moved; i++) {
        nh_ex e = meant(d, moved[i]), other = nh_canonical(d, e, 0);
        cr_assert_neq(e, other, "%s is not rewritten", moved[i]);
        for (double spot = 0.13; spot < 0.9; spot += 0.24) near(real_at(d, other, spot), real_at(d, e, spot), 1e-9, moved[i]);
    }
    nh_dag_free(d);
}

static void expect_zero(const char *text, bool zero)
{
    nh_dag *d = nh_dag_create();
    cr_assert_eq(nh_normal_is_zero(d, meant(d, text), 0), zero ? NH_ZERO : NH_NONZERO, "%s", text);
    nh_dag_free(d);
}

Test(named_functions, identities_are_exact)
{
    expect_zero("bessel_j(n + 1, x) + bessel_j(n - 1, x) - 2*n/x*bessel_j(n, x)", true);
    expect_zero("bessel_j(n + 1, x) - bessel_j(n - 1, x) - 2*n/x*bessel_j(n, x)", false);
    expect_zero("bessel_j(0, x)*bessel_y(1, x) - bessel_j(1, x)*bessel_y(0, x) + 2/(pi*x)", true);
    expect_zero("bessel_j(0, x)*bessel_y(1, x) - bessel_j(1, x)*bessel_y(0, x) - 2/(pi*x)", false);
    expect_zero("bessel_i(n, k*x)*bessel_k(n + 1, k*x) + bessel_i(n + 1, k*x)*bessel_k(n, k*x) - 1/(k*x)", true);
    expect_zero("airy_ai(x)*airy_bi_prime(x) - airy_ai_prime(x)*airy_bi(x) - 1/pi", true);
    expect_zero("airy_ai(x) - airy_bi(x)", false);
    expect_zero("(n + 1)*legendre_p(n + 1, x) - (2*n + 1)*x*legendre_p(n, x) + n*legendre_p(n - 1, x)", true);
    expect_zero("(n + 1)*legendre_p(n + 1, x) - (2*n + 1)*x*legendre_p(n, x) - n*legendre_p(n - 1, x)", false);
    expect_zero("(n + 1)*legendre_q(n + 1, cos(y)) - (2*n + 1)*cos(y)*legendre_q(n, cos(y)) + n*legendre_q(n - 1, cos(y))", true);
    expect_zero("hyp2f1_prime(a, b, c, x) - a*b/c*hyp2f1(a + 1, b + 1, c + 1, x)", true);
    expect_zero("hyp2f1_prime(a, b, c, x) - a*b/c*hyp2f1(a + 1, b + 1, c, x)", false);
    expect_zero("x*hyp2f1_prime(1/4, b, 5/4, x) - ((1 - x)^(-b) - hyp2f1(1/4, b, 5/4, x))/4", true);
    expect_zero("x*hyp2f1_prime(1/4, b, 5/4, x) - ((1 - x)^(-b) + hyp2f1(1/4, b, 5/4, x))/4", false);
    expect_zero("x*hyp2f1_prime(1/2, a, a + 1, x) - a/sqrt(1 - x) + a*hyp2f1(1/2, a, a + 1, x)", true);
    expect_zero("hyp1f1_prime(a, b, x) - a/b*hyp1f1(a + 1, b + 1, x)", true);
    expect_zero("hyperu_prime(a, b, x) + a*hyperu(a + 1, b + 1, x)", true);
    expect_zero("bessel_j(n, x + x*y) - bessel_j(n, x*(1 + y))", true);
}

/* (x^2 d^2 + x d + x^2 - n^2) J_n(x) = 0, and with a changed variable. */
Test(named_functions, equations_of_compositions)
{
    nh_dag *d = nh_dag_create();
    nh_ex x = nh_symbol(d, "x"), f = meant(d, "sqrt(x)*bessel_j(1/3, 2/3*x^(3/2))");
    nh_ex second = nh_diff(d, nh_diff(d, f, x), x);
    cr_assert_eq(nh_normal_is_zero(d, nh_add(d, second, nh_mul(d, x, f)), 0), NH_ZERO, "Airy's equation by Bessel functions");
    cr_assert_eq(nh_normal_is_zero(d, nh_sub(d, second, nh_mul(d, x, f)), 0), NH_NONZERO);
    nh_ex g = meant(d, "legendre_p(n, cos(x))"), slope = nh_diff(d, g, x);
    nh_ex left = nh_add(d, nh_diff(d, slope, x), nh_mul(d, meant(d, "cos(x)/sin(x)"), slope));
    cr_assert_eq(nh_normal_is_zero(d, nh_add(d, left, nh_mul(d, meant(d, "n*(n + 1)"), g)), 0), NH_ZERO, "Legendre's equation");
    nh_dag_free(d);
}

/* ---- writing ---- */

static void expect_typeset(const char *text, nh_typeset_form form, const char *expected)
{
    nh_text out;
    nh_text_init(&out);
    cr_assert(nh_typeset(text, form, &out), "%s", text);
    cr_assert_str_eq(nh_text_string(&out), expected);
    nh_text_clear(&out);
}

Test(named_functions, letters_on_paper)
{
    expect_typeset("bessel_j(n, x)", NH_LATEX, "J_{n}\\left(x\\right)");
    expect_typeset("bessel_j_prime(n + 1, 2*x)", NH_LATEX, "J'_{n + 1}\\left(2\\,x\\right)");
    expect_typeset("hyp2f1(a, b, c, x)", NH_LATEX, "{}_2F_1\\left(a, b; c; x\\right)");
    expect_typeset("hyp2f1_prime(a, b, c, x)", NH_LATEX, "{}_2F_1'\\left(a, b; c; x\\right)");
    expect_typeset("gauss_f(s, p, c, x)", NH_LATEX, "F_{s, p, c}\\left(x\\right)");
    expect_typeset("riemann_s_prime(a, b, c, x)", NH_LATEX, "\\mathrm{Ps}'_{a, b, c}\\left(x\\right)");
    expect_typeset("airy_ai_prime(x)", NH_LATEX, "\\mathrm{Ai}'\\left(x\\right)");
    expect_typeset("elliptic_f(phi, m)", NH_LATEX, "F\\left(\\varphi \\mid m\\right)");
    expect_typeset("elliptic_pi(n, phi, m)", NH_LATEX, "\\Pi\\left(n; \\varphi \\mid m\\right)");
    expect_typeset("bessel_j(n, x)^2", NH_LATEX, "{\\left(J_{n}\\left(x\\right)\\right)}^{2}");
    expect_typeset("bessel_y_prime(n, x)", NH_MATHML,
                   "<msub><msup><mi>Y</mi><mo>\u2032</mo></msup><mrow><mi>n</mi></mrow></msub><mo>\u2061</mo><mo stretchy=\"false\">(</mo><mi>x</mi><mo stretchy=\"false\">)</mo>");
}

/* Every function that a language has, called with these arguments, and what it computes. */
typedef struct {
    double expected[CALLS];
    size_t count;
    nh_text code;
} program;

static program program_of(const nh_source_language *language, const char *format)
{
    program p = {.count = 0};
    nh_dag *d = nh_dag_create();
    nh_ex symbol[LETTERS], number[LETTERS];
    nh_text_init(&p.code);
    for (int i = 0; i < LETTERS; i++) {
        symbol[i] = nh_symbol(d, letter[i]);
        number[i] = nh_number(d, nh_num_decimal(i ? order[i] : 0.31));
    }
    for (size_t i = 0; i < CALLS; i++) {
        nh_ex e = nh_substitute(d, meant(d, calls[i]), LETTERS, symbol, number);
        if (nh_source_lacks(language, d, e)) continue;
        nh_text word;
        nh_text_init(&word);
        nh_source *s = nh_source_create(language, d, &word);
        nh_source_whole(s);
        nh_source_plan(s, 1, &e);
        nh_source_put(s, e);
        nh_text_addf(&p.code, format, nh_text_string(&word));
        p.expected[p.count++] = real_at(d, e, 0);
        nh_source_free(s);
        nh_text_clear(&word);
    }
    nh_dag_free(d);
    return p;
}

/* Runs `command FILE` and compares the lines that it prints; `needs`: succeeds where the language is there. */
static void expect_values(const char *needs, const char *command, const char *begin, const nh_source_language *language, const char *format,
                          const char *end, size_t least)
{
    if (system(needs)) {
        cr_log_warn("skipped: the values of %s: there is no `%s`", language->name, needs);
        return;
    }
    char path[SCRATCH], line[SCRATCH + 200];
    program p = program_of(language, format);
    cr_assert_geq(p.count, least, "%s has %zu functions", language->name, p.count);
    nh_text all;
    nh_text_init(&all);
    nh_text_add(&all, begin);
    nh_text_add(&all, nh_text_string(&p.code));
    nh_text_add(&all, end);
    cr_assert(scratch_text(path, nh_text_string(&all)));
    snprintf(line, sizeof line, "%s %s 2>/dev/null", command, path);
    FILE *pipe = popen(line, "r");
    for (size_t i = 0; i < p.count; i++) {
        double y;
        cr_assert_eq(fscanf(pipe, "%lf", &y), 1, "%s: value %zu of\n%s", language->name, i, nh_text_string(&all));
        near(y, p.expected[i], 1e-10, language->name);
    }
    cr_assert_eq(pclose(pipe), 0);
    remove(path);
    nh_text_clear(&all);
    nh_text_clear(&p.code);
}

Test(named_functions, sympy_computes_the_same, PLAIN_ONLY)
{
    expect_values("/usr/bin/python3 -c 'import sympy' 2>/dev/null", "/usr/bin/python3", "import sympy as sp\n", &nh_source_sympy,
                  "print(complex(sp.N(%s)).real)\n", "", 22);
}

Test(named_functions, scipy_computes_the_same)
{
    nh_text head;
    nh_text_init(&head);
    nh_text_add(&head, "import numpy as np\nimport mpmath as _mp\nfrom scipy import special as _sf\n");
    nh_text_add(&head, nh_source_python.series[1]);
    expect_values("/usr/bin/python3 -c 'import scipy, mpmath' 2>/dev/null", "/usr/bin/python3", nh_text_string(&head), &nh_source_python, "print(float(%s))\n", "", CALLS);
    nh_text_clear(&head);
}

Test(named_functions, octave_computes_the_same)
{
    expect_values("octave-cli --version >/dev/null 2>&1", "octave-cli --norc", "", &nh_source_matlab, "printf('%%.17g\\n', %s);\n", "", 10);
}

/* C by GSL. */
Test(named_functions, c_computes_the_same)
{
    program p = program_of(&nh_source_c, "%s,\n");
    double y[CALLS];
    nh_text code;
    cr_assert_geq(p.count, CALLS - 2);
    nh_text_init(&code);
    nh_text_addf(&code, "#include <gsl/gsl_sf.h>\n#include <math.h>\n#include <stdio.h>\n%sint main(void)\n{\n    const double y[] = {%s};\n",
                 nh_source_c.series[1], nh_text_string(&p.code));
    nh_text_add(&code, "    for (unsigned i = 0; i < sizeof y/sizeof *y; i++) printf(\"%.17g\\n\", y[i]);\n    return 0;\n}\n");
    long n = scratch_run_c_with("-lgsl -lgslcblas", nh_text_string(&code), y, CALLS);
    cr_assert_eq(n, (long)p.count);
    for (size_t i = 0; i < p.count; i++) near(y[i], p.expected[i], 1e-10, "C");
    nh_text_clear(&code);
    nh_text_clear(&p.code);
}

/* ---- the program ---- */

static const char airy_text[] = "name: drifting\nparameters: [{name: m, value: 1}, {name: k, value: 2}]\n"
                                "coordinates: [{name: x, type: length}]\nlagrangian: m/2*x'^2 - m*k*t*x^2/2\n";
static const char bessel_text[] = "name: stretched\nparameters: [{name: n, value: 0.3}]\ncoordinates: [{name: x, type: length}]\n"
                                  "lagrangian: t*(x'^2 - (1 - n^2/t^2)*x^2)/2\ndomain: {t: [1, 3]}\n";
static const char pendulum_text[] = "name: pendulum\nparameters: [{name: k, value: 3}]\ncoordinates: [{name: phi, type: length}]\n"
                                    "lagrangian: phi'^2/2 + cos(phi)\ndomain: {phi: [-0.5, 0.5], phi': [1.5, 2.5]}\n";

static void expect_verdict(const place *p, const char *file, const char *phi, int code, const char *words)
{
    finished r = run_vector(p, &(manner){0}, (char *[]){(char *)p->program, "verify", (char *)file, "--current", (char *)phi, "-v", NULL});
    cr_assert_eq(r.code, code, "%s: %d\n%s%s", phi, r.code, r.out, r.err);
    cr_assert(strstr(code > 1 ? r.err : r.out, words), "%s: %s%s", phi, r.out, r.err);
    finished_clear(&r);
}

Test(named_functions, proofs_and_refusals)
{
    static const char all[] = "proved for all parameter values";
    place p = place_make();
    write_here(&p, "airy.yaml", airy_text);
    write_here(&p, "bessel.yaml", bessel_text);
    write_here(&p, "pendulum.yaml", pendulum_text);
    expect_verdict(&p, "airy.yaml", "airy_ai(-k^(1/3)*t)*x' + k^(1/3)*airy_ai_prime(-k^(1/3)*t)*x", 0, all);
    expect_verdict(&p, "airy.yaml", "airy_bi(-k^(1/3)*t)*x' + k^(1/3)*airy_bi_prime(-k^(1/3)*t)*x", 0, all);
    expect_verdict(&p, "airy.yaml", "airy_bi(-k^(1/3)*t)*x' + k^(1/3)*airy_ai_prime(-k^(1/3)*t)*x", 1, "not conserved");
    expect_verdict(&p, "airy.yaml", "airy_ai(k^(1/3)*t)*x' - k^(1/3)*airy_ai_prime(k^(1/3)*t)*x", 1, "not conserved");
    expect_verdict(&p, "bessel.yaml", "t*(bessel_j(n, t)*x' - bessel_j_prime(n, t)*x)", 0, all);
    expect_verdict(&p, "bessel.yaml", "t*bessel_y(n, t)*x' - (n*bessel_y(n, t) - t*bessel_y(n + 1, t))*x", 0, all);
    expect_verdict(&p, "bessel.yaml", "t*bessel_y(n, t)*x' - (n*bessel_y(n, t) + t*bessel_y(n + 1, t))*x", 1, "not conserved");
    expect_verdict(&p, "pendulum.yaml", "t - elliptic_f(phi/2, 4/(phi'^2/2 - cos(phi) + 1)/2)*2/sqrt(2*(phi'^2/2 - cos(phi) + 1))", 0, "Yes");
    expect_verdict(&p, "pendulum.yaml", "t - elliptic_f(phi/2, 4/(phi'^2/2 - cos(phi) + 1)/2)*3/sqrt(2*(phi'^2/2 - cos(phi) + 1))", 1, "not conserved");
    place_clear(&p);
}

Test(named_functions, errors_are_kind)
{
    place p = place_make();
    write_here(&p, "bessel.yaml", bessel_text);
    expect_verdict(&p, "bessel.yaml", "bessel_j(t)", 2, "`bessel_j` takes two arguments");
    expect_verdict(&p, "bessel.yaml", "bessel_j(t)", 2, "write bessel_j(n, x)");
    expect_verdict(&p, "bessel.yaml", "hyp2f1(n, n, t)", 2, "write hyp2f1(a, b, c, x)");
    expect_verdict(&p, "bessel.yaml", "airy_ai(1, t)", 2, "takes one argument");
    expect_verdict(&p, "bessel.yaml", "besselj(n, t)", 2, "write bessel_j(n, x)");
    expect_verdict(&p, "bessel.yaml", "bessel_q(n, t)", 2, "did you mean `bessel_");
    expect_verdict(&p, "bessel.yaml", "bessel_j(x, t)", 2, "only the last argument of bessel_j(n, x) may move");
    finished r = run(&p, "explain functions");
    cr_assert_eq(r.code, 0);
    cr_assert(strstr(r.out, "gauss_f") && strstr(r.out, "elliptic_einc"));
    finished_clear(&r);
    place_clear(&p);
}

/* In a Lagrangian: the energy is kept, and the motion is Bessel's function. */
Test(named_functions, motions)
{
    place p = place_make();
    write_here(&p, "bessel.yaml", bessel_text);
    finished r = run_vector(&p, &(manner){0}, (char *[]){p.program, "simulate", "bessel.yaml", "--initial", "t=1, x=0.6, x'=-0.2", "--until", "3",
                                                         "--watch", "W = t*(bessel_j(n, t)*x' - bessel_j_prime(n, t)*x)", "--accuracy", "1e-9", NULL});
    cr_assert_eq(r.code, 0, "%s", r.err);
    double first = NAN, last = NAN;
    for (char *line = strtok(r.out, "\n"); line; line = strtok(NULL, "\n")) {
        char *comma = strrchr(line, ',');
        if (!comma || (comma[1] != '-' && !(comma[1] >= '0' && comma[1] <= '9'))) continue;
        last = atof(comma + 1);
        if (isnan(first)) first = last;
    }
    cr_assert(isfinite(first) && fabs(first) > 0.01 && fabs(first - last) < 1e-8, "%g %g", first, last);
    finished_clear(&r);
    write_here(&p, "well.yaml", "name: well\ncoordinates: [{name: x, type: length}]\nlagrangian: x'^2/2 + bessel_j(0, x)\n");
    r = run(&p, "analyze -v well.yaml");
    cr_assert_eq(r.code, 0, "%s", r.err);
    cr_assert(strstr(r.out, "bessel_j(0, x)") && strstr(r.out, "minus the energy") && strstr(r.out, "proved"), "%s", r.out);
    finished_clear(&r);
    place_clear(&p);
}
