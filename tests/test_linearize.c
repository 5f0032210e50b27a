/* linearize: linear equations of motion and their eigenvalues, against matrices and eigenvalues that are known otherwise. */
#include <criterion/criterion.h>

#include <math.h>

#include "base/linalg.h"
#include "commands/linearize.h"
#include "program.h"
#include "sweep.h"

static nh_linearized *asked(const char *system, const char *at, const char *over, bool project, nh_error *error)
{
    char path[300];
    snprintf(path, sizeof path, strchr(system, '/') ? "%s" : "systems/%s.yaml", system);
    nh_request q = {.system_path = path, .initial = at, .over = over, .project = project};
    nh_options_default(&q.options);
    nh_error_clear(error);
    return nh_linearize_create(&q, error);
}

static nh_linearized *linearized(const char *system, const char *at, const char *over)
{
    nh_error error;
    nh_linearized *x = asked(system, at, over, false, &error);
    cr_assert_not_null(x, "%s at %s: %s", system, at, error.what);
    return x;
}

/* Is re + i im an eigenvalue, to so many times its own bound and the given error? */
static bool has(const nh_linear_equations *e, double re, double im, double error)
{
    for (size_t i = 0; i < e->eigenvalues; i++)
        if (hypot(e->eigenvalue[i].re - re, e->eigenvalue[i].im - im) <= e->eigenvalue[i].error + error) return true;
    return false;
}

static size_t number_of(const nh_linearized *x, const nh_linear_equations *e, const char *name)
{
    for (size_t i = 0; i < e->s + e->n; i++)
        if (!strcmp(nh_linearize_name(x, e, i), name)) return i;
    cr_assert_fail("%s is not there", name);
    return 0;
}

/* ---- Whipple's bicycle ----
 *
 * Matrices of Meijaard, Papadopoulos, Ruina and Schwab, Proc. R. Soc. A 463 (2007), sec. 7:
 * M q'' + v C1 q' + (g K0 + v^2 K2) q = 0, q = (lean, steer). */
static const double M[] = {80.81722, 2.31941332208709, 2.31941332208709, 0.29784188199686},
                    C1[] = {0, 33.86641391492494, -0.85035641456978, 1.68540397397560},
                    K0[] = {-80.95, -2.59951685249872, -2.59951685249872, -0.80329488458618},
                    K2[] = {0, 76.59734589573222, 0, 2.65431523794604}, gravity = 9.81;

/* The four eigenvalues by LAPACK. */
static void by_matrices(double v, double *re, double *im)
{
    double A[16] = {0}, det = M[0] * M[3] - M[1] * M[2], inverse[4] = {M[3], -M[1], -M[2], M[0]};
    for (int i = 0; i < 2; i++) {
        A[i + (2 + i) * 4] = 1;
        for (int j = 0; j < 2; j++)
            for (int l = 0; l < 2; l++) {
                double part = -inverse[2 * i + l] / det;
                A[2 + i + j * 4] += part * (gravity * K0[2 * l + j] + v * v * K2[2 * l + j]);
                A[2 + i + (2 + j) * 4] += part * v * C1[2 * l + j];
            }
    }
    cr_assert(nh_eigen(4, A, re, im, NULL));
}

static void compare_bicycle(const nh_linearized *x, const nh_linear_equations *e, double v)
{
    const char *q[] = {"lean", "steer"}, *w[] = {"lean'", "steer'"};
    double re[4], im[4];
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 2; j++) {
            size_t row = number_of(x, e, w[i]) - e->s, column = number_of(x, e, w[j]) - e->s,
                   at = number_of(x, e, q[j]);
            double k = gravity * K0[2 * i + j] + v * v * K2[2 * i + j];
            cr_expect_float_eq(e->M[row * e->n + column], M[2 * i + j], 1e-12);
            cr_expect_float_eq(e->C[row * e->n + column], v * C1[2 * i + j], 1e-12 * (1 + v));
            cr_expect_float_eq(e->N[row * e->s + at], k, 1e-11 * (1 + v * v), "v = %g: %.15g", v, k);
        }
    by_matrices(v, re, im);
    for (int i = 0; i < 4; i++)
        cr_expect(has(e, re[i], im[i], 3e-12 * (1 + hypot(re[i], im[i]))), "v = %g lacks %.15g %+.15g i", v, re[i], im[i]);
    cr_expect_eq(e->eigenvalues, 5, "and 0, of the speed: there are %zu", e->eigenvalues);
}

/* Upright, straight, at rest and at any speed: where the charts of the wheels' velocities are singular. */
Test(linearize, whipples_bicycle_has_the_matrices_of_the_benchmark, PLAIN_ONLY)
{
    nh_linearized *x = linearized("whipple_bicycle", NULL, "x'=0,1,5/2,4,5,7");
    cr_assert_eq(x->rows, 6);
    for (size_t i = 0; i < x->rows; i++) {
        const nh_linear_row *row = &x->row[i];
        cr_assert_not_null(row->equations, "%s", row->why);
        cr_expect_eq(row->equations->residual, 0);
        cr_expect_not(row->equations->changes);
        compare_bicycle(x, row->equations, row->value.value);
    }
    nh_linearized_free(x);
}

/* Table 2 of the benchmark at v = 0, and its weave and capsize speeds. */
Test(linearize, whipples_bicycle_has_the_eigenvalues_and_speeds_of_the_benchmark, PLAIN_ONLY)
{
    nh_linearized *x = linearized("whipple_bicycle", "x'=0", NULL);
    const nh_linear_equations *e = x->row[0].equations;
    static const double at_rest[] = {3.13164324790656, 5.53094371765393};
    for (int i = 0; i < 2; i++)
        for (int sign = -1; sign < 2; sign += 2) cr_expect(has(e, sign * at_rest[i], 0, 1e-14));
    cr_expect_eq(x->row[0].verdict, NH_LINEAR_UNSTABLE);
    nh_linearized_free(x);
    x = linearized("whipple_bicycle", NULL, "x'=4,5,13/2");
    static const double speed[] = {4.29238253634111, 6.02426201538837};
    cr_assert_eq(x->changes, 2);
    for (size_t i = 0; i < 2; i++) {
        cr_expect_float_eq((x->change[i].low + x->change[i].high) / 2, speed[i], 3e-14);
        cr_expect_leq(x->change[i].high - x->change[i].low, 4e-14);
    }
    cr_expect_eq(x->change[0].positive_before, 2);
    cr_expect_eq(x->change[0].after, NH_LINEAR_BUT_ZERO);
    cr_expect_eq(x->change[1].positive_after, 1);
    nh_linearized_free(x);
}

/* ---- equilibria ---- */

/* det(K - w^2 M) = 0 for the linear equations of two pendulums, each up or down. */
Test(linearize, double_pendulum_at_its_four_equilibria)
{
    const double a = 1.3, b = 0.8, l = 0.7, h = 0.9, g = 9.81;
    static const char *const at[] = {NULL, "p=pi", "q=pi", "p=pi, q=pi"};
    for (int i = 0; i < 4; i++) {
        nh_linearized *x = linearized("double_pendulum", at[i], NULL);
        const nh_linear_equations *e = x->row[0].equations;
        double up_p = i & 1 ? -1 : 1, up_q = i & 2 ? -1 : 1, mixed = b * l * h * up_p * up_q;
        double m11 = (a + b) * l * l, m22 = b * h * h, k1 = up_p * (a + b) * g * l, k2 = up_q * b * g * h;
        double A = m11 * m22 - mixed * mixed, B = -(m11 * k2 + m22 * k1), D = sqrt(B * B - 4 * A * k1 * k2);
        cr_expect_eq(e->eigenvalues, 4);
        cr_expect_eq(e->residual, 0);
        for (int s = -1; s < 2; s += 2) {
            double square = (-B + s * D) / (2 * A), z = sqrt(fabs(square));
            cr_expect(square > 0 ? has(e, 0, z, 1e-13) : has(e, z, 0, 1e-13), "%s lacks %g", at[i], square);
        }
        cr_expect_eq(x->row[0].verdict, i ? NH_LINEAR_UNSTABLE : NH_LINEAR_MARGINAL);
        nh_linearized_free(x);
    }
}

static nh_linearized *of_text(const char *text, const char *at, const char *over, bool project, nh_error *error)
{
    place p = place_make();
    char path[PATH_MAX + 40];
    write_here(&p, "own.yaml", text);
    snprintf(path, sizeof path, "%s/own.yaml", p.folder);
    nh_linearized *x = asked(path, at, over, project, error);
    place_clear(&p);
    return x;
}

/* Equal frequencies: double eigenvalues, exactly. */
Test(linearize, double_eigenvalues_are_enclosed)
{
    nh_error error;
    nh_linearized *x = of_text("name: o\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 2*(x^2 + y^2)\n", NULL, NULL, false, &error);
    cr_assert_not_null(x, "%s", error.what);
    const nh_linear_equations *e = x->row[0].equations;
    cr_assert_eq(e->eigenvalues, 2);
    for (size_t i = 0; i < 2; i++) {
        cr_expect_eq(e->eigenvalue[i].times, 2);
        cr_expect_float_eq(fabs(e->eigenvalue[i].im), 2, 1e-15);
        cr_expect_lt(e->eigenvalue[i].error, 1e-14);
    }
    nh_linearized_free(x);
}

/* A force -c x': sqrt(c^2/4 - k) - c/2; stable for c > 0, and marginal without. */
Test(linearize, damping_decides)
{
    nh_error error;
    nh_linearized *x = of_text("name: d\nparameters: {c: 0.5}\ncoordinates: [x]\nlagrangian: x'^2/2 - 2*x^2\nforces: [\"x = -c*x'\"]\n", NULL, "c=-1,0,1", false, &error);
    cr_assert_not_null(x, "%s", error.what);
    static const nh_linear_verdict verdict[] = {NH_LINEAR_UNSTABLE, NH_LINEAR_MARGINAL, NH_LINEAR_STABLE};
    for (size_t i = 0; i < 3; i++) {
        double c = x->row[i].value.value;
        cr_expect_eq(x->row[i].verdict, verdict[i]);
        cr_expect(has(x->row[i].equations, -c / 2, sqrt(4 - c * c / 4), 1e-15));
        cr_expect_float_eq(x->row[i].equations->C[0], c, 1e-15);
    }
    nh_linearized_free(x);
}

/* In x and y with x^2 + y^2 = l^2: the frequency is that of the angle; the position is completed by --project. */
#define PENDULUM "name: p\nparameters: {l: 2, g: 9.81}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - g*y\nconstraints: [x^2 + y^2 = l^2]\n"
Test(linearize, position_constraints)
{
    nh_error error;
    for (int up = -1; up < 2; up += 2) {
        nh_linearized *x = of_text(PENDULUM, up > 0 ? "y=l" : "y=-l", NULL, false, &error);
        cr_assert_not_null(x, "%s", error.what);
        double z = sqrt(9.81 / 2);
        cr_expect_eq(x->row[0].equations->eigenvalues, 2);
        cr_expect(up > 0 ? has(x->row[0].equations, z, 0, 1e-15) : has(x->row[0].equations, 0, z, 1e-15));
        nh_linearized_free(x);
    }
    cr_expect_null(of_text(PENDULUM, "y=-1.9", NULL, false, &error));
    cr_expect(strstr(error.what, "positions are off") && strstr(error.hint, "--project"), "%s %s", error.what, error.hint);
    nh_linearized *x = of_text(PENDULUM, "y=-1.9", NULL, true, &error);
    cr_assert_not_null(x, "%s", error.what);
    cr_expect_float_eq(hypot(x->row[0].equations->q[0], x->row[0].equations->q[1]), 2, 1e-15);
    nh_linearized_free(x);
}

/* ---- steady motions ---- */

/* An upright disk is stable above s'^2 = A m g r/(C (C + m r^2)) [Routh]. */
Test(linearize, rolling_disk_has_its_critical_speed)
{
    nh_linearized *x = linearized("rolling_disk", "h=pi/2", "s'=0.2,1");
    cr_assert_eq(x->changes, 1);
    double critical = sqrt(0.25 * 1.3 * 0.9 * 0.8 / (0.5 * (0.5 + 1.3 * 0.8 * 0.8)));
    cr_expect_float_eq(x->change[0].low, critical, 4e-15);
    cr_expect_eq(x->change[0].after, NH_LINEAR_MARGINAL);
    nh_linearized_free(x);
}

/* A sleigh whose centre of mass is ahead of the blade or behind it: m a v/(J + m a^2) decides. */
#define SLEIGH "name: s\nparameters: {a: 0.3}\ncoordinates: [x, y, f]\nlagrangian: ((x' - a*f'*sin(f))^2 + (y' + a*f'*cos(f))^2 + f'^2)/2\nconstraints: [\"y'*cos(f) = x'*sin(f)\"]\n"
Test(linearize, sleigh_runs_stably_one_way)
{
    nh_error error;
    static const char *const at[] = {"x'=2", "x'=-2", "f=0.7, x'=2*cos(0.7)"};
    for (int i = 0; i < 3; i++) {
        nh_linearized *x = of_text(SLEIGH, at[i], NULL, false, &error);
        cr_assert_not_null(x, "%s", error.what);
        const nh_linear_equations *e = x->row[0].equations;
        double z = (i == 1 ? 1 : -1) * 0.3 * 2 / (1 + 0.09);
        cr_expect(has(e, z, 0, 1e-14), "%s", at[i]);
        cr_expect_eq(e->residual, 0);
        cr_expect_eq(x->row[0].verdict, i == 1 ? NH_LINEAR_UNSTABLE : NH_LINEAR_BUT_ZERO, "%s", at[i]);
        nh_linearized_free(x);
    }
}

/* A sleeping top in angles that are regular there: stable above (C w)^2 = 4 A m g l. */
#define TOP "name: t\nparameters: {A: 1.5, C: 0.5, P: 2}\ncoordinates: [u, v, s]\nlagrangian: A/2*(u'^2*cos(v)^2 + v'^2) + C/2*(s' + u'*sin(v))^2 - P*cos(u)*cos(v)\n"
Test(linearize, sleeping_top)
{
    nh_error error;
    nh_linearized *x = of_text(TOP, NULL, "s'=1,12", false, &error);
    cr_assert_not_null(x, "%s", error.what);
    cr_assert_eq(x->changes, 1);
    cr_expect_float_eq(x->change[0].low, sqrt(4 * 1.5 * 2) / 0.5, 1e-13);
    nh_linearized_free(x);
}

/* Not steady: an Atwood machine falls. */
Test(linearize, a_state_that_is_not_steady_says_so)
{
    nh_error error;
    nh_linearized *x = of_text("name: a\ncoordinates: [y, z]\nlagrangian: y'^2 + 3*z'^2/2 - 9.81*(2*y + 3*z)\nconstraints: [y + z = 0]\n", NULL, NULL, false, &error);
    cr_assert_not_null(x, "%s", error.what);
    cr_expect_eq(x->row[0].verdict, NH_LINEAR_UNSTEADY);
    cr_expect_float_eq(x->row[0].equations->residual, 9.81 / 5, 1e-14);
    nh_linearized_free(x);
}

/* At rest on the end of an axis the ellipsoid rocks in two directions: k c^T B = 0 leaves theta, psi and phi. */
Test(linearize, rattleback_at_rest)
{
    nh_linearized *x = linearized("rattleback", "theta=pi/2", NULL);
    const nh_linear_equations *e = x->row[0].equations;
    cr_expect_eq(e->residual, 0);
    cr_expect_eq(e->s, 3);
    cr_expect_eq(e->eigenvalues, 5, "two pairs and the spin about the vertical: %zu", e->eigenvalues);
    nh_linearized_free(x);
}

/* ---- what there is not ---- */

Test(linearize, refuses_kinks_poles_and_wrong_names)
{
    static const struct {
        const char *text, *at, *over, *what;
    } all[] = {
        {"name: k\ncoordinates: [x]\nlagrangian: x'^2/2 - abs(x)\n", NULL, NULL, "kink"},
        {"name: p\ncoordinates: [x]\nlagrangian: x'^2/2 - 1/x\n", NULL, NULL, "no value"},
        {"name: e\ncoordinates: [h, p]\nlagrangian: (h'^2 + p'^2*sin(h)^2)/2 - cos(h)\n", NULL, NULL, "not determined"},
        {PENDULUM, "y=-l, x'=1, y'=1", NULL, "velocities are off"},
        {PENDULUM, "z=1", NULL, "is not a coordinate or velocity"},
        {PENDULUM, "y=-l", "k=0:1:3", "is not a parameter, a coordinate or a velocity"},
    };
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        nh_error error;
        cr_expect_null(of_text(all[i].text, all[i].at, all[i].over, false, &error));
        cr_expect(strstr(error.what, all[i].what) != NULL, "%zu: %s", i, error.what);
    }
}

/* ---- documents ---- */

/* The heads of columns of numbers are words, or numbers where they are. */
Test(linearize, tables_have_their_heads)
{
    place p = place_with_systems();
    finished f = run_expecting(&p, "linearize double_pendulum --quiet --html page.html --tex page.tex", 0);
    finished_clear(&f);
    char *page = read_here(&p, "page.html"), *tex = read_here(&p, "page.tex");
    cr_expect(strstr(page, "<th scope=\"col\">real part</th>") && !strstr(page, "<th scope=\"col\"><data value=\"0\">"));
    cr_expect(strstr(tex, "real part & imaginary part"));
    free(page), free(tex);
    f = run_expecting(&p, "analyze pendulum --quiet --html page.html", 0);
    finished_clear(&f);
    page = read_here(&p, "page.html");
    cr_expect(strstr(page, "<th scope=\"col\"><data value=\"1e-10\">"), "the tolerances above the drifts are numbers");
    free(page);
    place_clear(&p);
}
