/* Currents whose coefficients are Airy, Bessel, Legendre, Gauss's or Kummer's
 * functions: found, named and proved for all parameters; what has no such
 * coefficients stays a series, with its equation. */
#include "mechanics.h"
#include "scratch.h"

#include "commands/analyze.h"
#include "graph/print.h"
#include "sweep.h"

static nh_analysis *ask(const char *path)
{
    nh_error error = {0};
    nh_request request = {.system_path = path};
    nh_options_default(&request.options);
    request.options.until = 0.7;
    nh_analysis *r = nh_analysis_create(&request, &error);
    cr_assert_not_null(r, "%s: %s", path, error.what);
    return r;
}

static nh_analysis *ask_text(const char *text)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_analysis *r = ask(path);
    remove(path);
    return r;
}

/* `count` independent currents, proved for all parameters, `named` of them with
 * this function, and no series. */
static void expect_named(nh_analysis *r, size_t count, const char *name, size_t named)
{
    size_t seen = 0;
    cr_assert_eq(r->list->independent, count, "%zu currents, expected %zu with %s", r->list->independent, count, name);
    for (size_t k = 0; k < r->list->count; k++) {
        const nh_current *f = &r->list->found[k];
        char *text = nh_print_string(r->question->model->dag, f->phi);
        cr_assert_null(f->series, "a series beside %s", name);
        cr_assert(f->proof.proved && f->proof.all_parameters, "%s", text);
        cr_assert_lt(f->heldout, 1e-9, "%s: %g", text, f->heldout);
        seen += strstr(text, name) != NULL;
        nh_free(text);
    }
    cr_assert_eq(seen, named, "%zu currents with %s, expected %zu", seen, name, named);
    nh_analysis_free(r);
}

#define HEAD(parameters) "name: test\nparameters: [" parameters "]\ncoordinates: [{name: x, type: length}]\n"

Test(named_search, airy)
{
    expect_named(ask_text(HEAD("{name: m, value: 1.1}, {name: k, value: 2}") "lagrangian: m/2*x'^2 "
                                                                             "- m*k*t*x^2/2\n"),
                 2, "airy_", 2);
    expect_named(ask_text(HEAD("{name: m, value: 1.2}, {name: c, value: 0.3}, {name: k, value: 2}, "
                               "{name: b, value: 0.4}") "lagrangian: m/2*x'^2 - (k*t - "
                                                        "b)*x^2/2\nforces: [\"x = -c*x'\"]\ndomain: "
                                                        "{t: [0.5, 3]}\n"),
                 2, "airy_", 2);
}

/* Lengthening pendulum [Cauchy], powers of time, an exponential that fades,
 * Bessel's own equation. */
Test(named_search, bessel, PLAIN_ONLY)
{
    static const char *const systems[] = {
        HEAD("{name: g, value: 9}, {name: a, value: 1}, {name: v, value: 0.3}")
            "lagrangian: (a + v*t)^2*x'^2/2 - g*(a + v*t)*x^2/2\ndomain: {t: [0.1, 2]}\n",
        HEAD("{name: w, value: 1.4}") "lagrangian: x'^2/2 - w^2*t^3*x^2/2\ndomain: {t: [0.3, 2]}\n",
        HEAD("{name: w, value: 1.4}") "lagrangian: x'^2/2 + w^2*t^2*x^2/2 + x^2/t^2\ndomain: {t: [0.3, 1.5]}\n",
        HEAD("{name: a, value: 0.6}, {name: w, value: 1.7}") "lagrangian: x'^2/2 - w^2*exp(-a*t)*x^2/2\n",
        HEAD("{name: n, value: 0.3}") "lagrangian: t*(x'^2 - (1 - n^2/t^2)*x^2)/2\ndomain: {t: [1, 3]}\n",
    };
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++)
        if (sweep_tries(i, 4, 4)) expect_named(ask_text(systems[i]), 2, "bessel_", 2);
}

Test(named_search, kummer, WHOLE_ONLY)
{
    expect_named(ask_text(HEAD("{name: a, value: 1.3}") "lagrangian: x'^2/2 + (t^2/4 + "
                                                        "a)*x^2/2\ndomain: {t: [0.5, 2]}\n"),
                 2, "hyp", 2);
    expect_named(ask_text(HEAD("{name: b, value: 0.7}, {name: c, value: 2}") "lagrangian: x'^2/2 + "
                                                                             "(c^2 + b/t + "
                                                                             "2/t^2)*x^2/2\ndomain: "
                                                                             "{t: [0.5, 2]}\n"),
                 2, "hyp", 2);
}

/* Parabolic cylinder functions: both are analytic at t = 0, through which motions go, where U of t^2 is not; one grows by many powers of ten. */
Test(named_search, parabolic_cylinder, PLAIN_ONLY)
{
    expect_named(ask_text(HEAD("{name: k, value: 0.7}") "lagrangian: x'^2/2 + (t^2 + k)*x^2/2\n"), 2, "hyp1f1", 2);
    expect_named(ask_text(HEAD("{name: k, value: 0.7}") "lagrangian: x'^2/2 + (t^2 + k)*x^2/2\ndomain: {t: [-1, 1]}\n"), 2, "hyp1f1", 2);
}

Test(named_search, gauss, PLAIN_ONLY)
{
    expect_named(ask_text(HEAD("{name: n, value: 1.3}") "lagrangian: (1 - t^2)*x'^2/2 - n*(n + "
                                                        "1)*x^2/2\ndomain: {t: [0.1, 0.8]}\n"),
                 2, "legendre_p", 2);
    expect_named(ask_text(HEAD("{name: n, value: 1.3}") "lagrangian: t*sqrt(t)*(1 - t)*x'^2/2 - n*sqrt(t)*x^2/2\ndomain: {t: [0.1, 0.8]}\n"),
                 2, "hyp2f1", 2);
    if (!sweep_whole()) return;
    expect_named(ask_text(HEAD("{name: w, value: 1.9}") "lagrangian: (1 - t^2)*x'^2/2 + "
                                                        "w^2*x^2/2\ndomain: {t: [0.1, 0.8]}\n"),
                 2, "gauss_f(1, w^2, 1, ", 2);
}

/* The rolling disk, whose parameters a and b are conjugate: k^2 = m C r^2/(A (C
 * + m r^2)) [Appell, Korteweg]. */
Test(named_search, rolling_disk, PLAIN_ONLY)
{
    nh_analysis *r = ask("systems/rolling_disk.yaml");
    for (size_t k = 0; k < r->list->count; k++) {
        char *text = nh_print_string(r->question->model->dag, r->list->found[k].phi);
        cr_assert(!strstr(text, "gauss_f") || strstr(text, "gauss_f(1, m*C*r^2/(A*(C + m*r^2)), 1, "), "%s", text);
        nh_free(text);
    }
    cr_assert(r->completeness[NH_COMPLETE_IN_COORDINATES].degree >= 2 && r->completeness[NH_COMPLETE_IN_COORDINATES].generic, "they are all of degree 2");
    expect_named(r, 3, "gauss_f", 2);
}

/* Euler's disk with thickness is "solved by using hypergeometric functions" [Cendra and Diaz 2007]: with singular points i, -i
 * and infinity of cot theta, for all parameters; there is no other integral of degree 2. */
Test(named_search, euler_disk, PLAIN_ONLY)
{
    nh_analysis *r = ask("systems/euler_disk.yaml");
    cr_assert(r->completeness[NH_COMPLETE_IN_COORDINATES].degree >= 2 && r->completeness[NH_COMPLETE_IN_COORDINATES].generic);
    expect_named(r, 3, "riemann_", 2);
}

/* The elementary ones among them: a frequency that falls as 1/(1 + t^2), and beyond the value at which it becomes a growth. */
Test(named_search, conjugate_points_elementary, PLAIN_ONLY)
{
    static const char *const force[][2] = {{"-k", "sqrt(k + 1)*atan(t)"}, {"k", "sqrt(k - 1)*atan(t)"}, {"1", "atan(t)"}, {"2", "sinh(atan(t))"}, {"-8", "sin(3*atan(t))"}};
    for (size_t i = 0; i < sizeof force / sizeof *force; i++) {
        char text[300];
        snprintf(text, sizeof text, "name: s\ncoordinates: [x]\nparameters: {k: 1.7}\nlagrangian: x'^2/2 + %s*x^2/(2*(1 + t^2)^2)\n", force[i][0]);
        expect_named(ask_text(text), 2, force[i][1], 1);
    }
}

static void expect_equation(nh_analysis *r, size_t series, const char *equation)
{
    size_t seen = 0;
    for (size_t k = 0; k < r->list->count; k++) {
        if (!r->list->found[k].series) continue;
        seen++;
        cr_assert_not_null(r->list->found[k].series->equation);
        cr_assert(strstr(r->list->found[k].series->equation, equation), "%s", r->list->found[k].series->equation);
    }
    cr_assert_eq(seen, series);
    nh_analysis_free(r);
}

/* Mathieu's equation has no solution with a name here. */
Test(named_search, equations_without_names, PLAIN_ONLY)
{
    expect_equation(ask_text(HEAD("{name: a, value: 1.1}, {name: e, value: 0.4}") "lagrangian: "
                                                                                  "x'^2/2 - (a + "
                                                                                  "e*cos(2*t))*x^"
                                                                                  "2/2\n"),
                    2, "f'' = (-a - e*cos(2*t))*f");
}

/* Integrals quadratic in the velocities with an inverse square: their coefficients satisfy an equation of third order, the symmetric square of that of the
 * oscillator without it [Ermakov, Lewis]. */
#define INVERSE_SQUARE(potential, domain) \
    HEAD("{name: k, value: 0.8}, {name: w, value: 1.3}") "lagrangian: x'^2/2 - (" potential ")*x^2/2 - k/x^2\ndomain: {x: [0.5, 2], t: " domain "}\n"

Test(named_search, products_of_named_functions, WHOLE_ONLY)
{
    expect_named(ask_text(INVERSE_SQUARE("w*t", "[0.5, 2]")), 2, "airy_", 2);
    expect_named(ask_text(INVERSE_SQUARE("-w*t^2", "[0.5, 1.5]")), 2, "bessel_", 2);
    expect_equation(ask_text(INVERSE_SQUARE("1 + w*cos(t)", "[0, 1]")), 2, "f(t)*(x'^2 + 2*k/x^2) + .., f = u*v with solutions u and v of u'' = (-w*cos(t) - 1)*u");
}

/* y'' = -z and z' = t y couple three words and no two of them: an equation of third order that is no symmetric square. */
Test(named_search, third_order_without_names, PLAIN_ONLY)
{
    expect_equation(ask_text("name: test\ncoordinates: [y, z]\nlagrangian: (y'^2 + z'^2)/2 - y*z\nconstraints: [\"z' = t*y\"]\ndomain: {t: [0.5, 1.5]}\n"), 3, "f''' = ");
}
