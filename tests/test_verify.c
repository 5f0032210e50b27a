/* verify and simulate: the paper's claims about the sleigh, confirmed or refuted; a motion against its closed form. */
#include <criterion/criterion.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "commands/simulate.h"
#include "commands/verify.h"
#include "document/simulation.h"
#include "document/verification.h"
#include "exact/normal.h"
#include "graph/dag.h"
#include "sweep.h"

static const char SLEIGH[] = "systems/sleigh.yaml";

static nh_options defaults(void)
{
    nh_options o;
    nh_options_default(&o);
    return o;
}

static nh_system *sleigh(size_t n, const nh_setting *setting)
{
    nh_error error;
    nh_error_clear(&error);
    nh_system *s = nh_system_read(SLEIGH, n, setting, &error);
    cr_assert_not_null(s, "%s", error.what);
    return s;
}

static nh_verification *current(const char *text, nh_chart_choice chart)
{
    nh_error error;
    nh_error_clear(&error);
    nh_options o = defaults();
    nh_verification *v = nh_verification_of_current(sleigh(0, NULL), chart, text, &o, &error);
    cr_assert_not_null(v, "%s: %s", text, error.what);
    return v;
}

static nh_verification *field(const char *text, nh_chart_choice chart)
{
    nh_error error;
    nh_error_clear(&error);
    nh_options o = defaults();
    nh_verification *v = nh_verification_of_field(sleigh(0, NULL), chart, text, &o, &error);
    cr_assert_not_null(v, "%s: %s", text, error.what);
    return v;
}

/* ---- currents ---- */

static const char PHI2[] = "m*x'/cos(phi)*sin(phi/k) + m*a*k*phi'*cos(phi/k)", PHI2B[] = "m*x'/cos(phi)*cos(phi/k) - m*a*k*phi'*sin(phi/k)";

/* A current plus a term that doubles, or 77 digits, do not see beside it; functions that are flat to hundreds of
 * digits.  (Each was "Yes, to 75 digits", or "a constant".) */
#define ENERGY "m*v^2+m*a^2*k^2*omega^2"
Test(verify, what_is_small_beside_the_rest_is_refuted_with_a_state)
{
    static const char *const list[] = {
        ENERGY "+1e-100*omega", ENERGY "+1e-300*sin(phi)", ENERGY "+1e-200*exp(sqrt(1+v^2))", ENERGY "*(1+1e-90*x)",
        "1e9*(" ENERGY ")+exp(-300*(phi^2+1))", "tanh(300*(phi^2+1))", "tanh(30*(phi^2+1))", "exp(-1e4*(phi^2+1))",
        "sin(phi)^2+cos(phi)^2+1e-90*x", "atan(1e30*(phi^2+1))", "sqrt(1+1e-80*x^2)", "tanh(300*(" ENERGY "+1))*(1+1e-99*v)"};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_verification *v = current(list[i], NH_CHART_AUTO);
        cr_expect(!v->conserved, "%s", list[i]);
        cr_expect(v->has_counterexample && v->counterexample, "%s: no state", list[i]);
        nh_verification_free(v);
    }
}

Test(verify, a_flat_function_of_a_current_is_no_constant_and_an_identity_is_one)
{
    static const struct {
        const char *text;
        bool constant;
    } list[] = {{"tanh(300*(" ENERGY "+1))", false},          {"exp(-1000*(" ENERGY "+1))", false},
                {"sin(phi)^2+cos(phi)^2", true},              {"(sqrt(3+2*sqrt(2))-1-sqrt(2))*omega", true},
                {"1e-100*(" ENERGY ")", false}};
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_verification *v = current(list[i].text, NH_CHART_AUTO);
        cr_expect(v->conserved, "%s", list[i].text);
        cr_expect_eq(v->trivial, list[i].constant, "%s", list[i].text);
        nh_verification_free(v);
    }
}

Test(verify, true_currents_are_proved_for_all_parameters_in_both_charts)
{
    static const char *const list[] = {"-m/2*(x'^2/cos(phi)^2 + a^2*k^2*phi'^2)", PHI2, PHI2B};
    for (size_t i = 0; i < 3; i++)
        for (int chart = NH_CHART_QUASI; chart <= NH_CHART_COORDINATES; chart++) {
            nh_verification *v = current(list[i], (nh_chart_choice)chart);
            cr_expect(v->conserved && v->proof.all_parameters, "%s", list[i]);
            cr_expect(v->has_symmetry && v->symmetry.kase == (i == 0 ? 1 : 3), "%s: case %d", list[i], v->symmetry.kase);
            cr_expect_not(v->has_counterexample);
            nh_verification_free(v);
        }
}

/* The counterexample is checked by hand: Gamma(m v) = m a omega^2 in quasi-velocities. */
Test(verify, a_false_current_is_refuted_with_a_point)
{
    nh_verification *v = current("m*v", NH_CHART_QUASI);
    cr_assert(!v->conserved && v->has_counterexample);
    double omega = v->counterexample[4], expected = 2.0 * 1.0 * omega * omega;
    cr_expect_float_eq(v->rate, expected, 1e-12 * fabs(expected));
    cr_expect_gt(v->residual, 0.1);
    char *json = nh_verification_json(v, NULL);
    cr_expect_not_null(strstr(json, "\"conserved\":\tfalse"), "%s", json);
    cr_expect_not_null(strstr(json, "\"rate\":"), "%s", json);
    nh_free(json);
    nh_verification_free(v);
}

Test(verify, almost_is_not_conserved)
{
    nh_verification *v = current("v*sin(phi*0.500001) + 2*omega*cos(phi*0.500001)", NH_CHART_QUASI);
    cr_expect_not(v->conserved);
    cr_expect_lt(v->residual, 1e-4);
    cr_expect_gt(v->residual, 1e-9);
    nh_verification_free(v);
}

Test(verify, a_constant_is_called_trivial)
{
    nh_verification *v = current("sin(phi)^2 + cos(phi)^2", NH_CHART_QUASI);
    cr_expect(v->trivial && v->conserved);
    nh_verification_free(v);
}

/* ---- fields ---- */

#define R "sqrt(x'^2/(a^2*cos(phi)^2) + k^2*phi'^2)"
#define S "x'/(a*cos(phi))"
#define G "k^2/(" R ")^2*log((" R " + " S ")/(" R " - " S "))"
#define B "((phi'*t + x'/(a*phi'*cos(phi)))/" R ")"
#define D "((a*k^2*cos(phi) - x'*t)/" R ")"
#define PLACES "Z0=" G "; phi=" G "*phi' - " B "; x=" G "*x' + " D "; y=" G "*x'*tan(phi) + " D "*tan(phi)"
#define PHI_RATE G "*(-phi'*x'/(a*k^2*cos(phi)))"
#define X_RATE G "*(a*phi'^2*cos(phi) - phi'*x'*tan(phi))"

/* [CechMusilova2014], Z(Phi_3): the components along phi' and x' outside the Gamma term are printed with the wrong sign. */
Test(verify, the_third_field_as_printed_is_refuted_and_corrected_is_proved)
{
    static const char printed[] = PLACES "; phi'=" PHI_RATE " + " D "*phi'/(a*k^2*cos(phi)); x'=" X_RATE " + " B "*(a*phi'*cos(phi) - x'*tan(phi))";
    static const char corrected[] = PLACES "; phi'=" PHI_RATE " - " D "*phi'/(a*k^2*cos(phi)); x'=" X_RATE " - " B "*(a*phi'*cos(phi) - x'*tan(phi))";
    nh_verification *v = field(printed, NH_CHART_COORDINATES);
    cr_expect(!v->conserved && v->has_counterexample);
    cr_expect_eq(v->equation_number, 18, "%s", v->equation);
    nh_verification_free(v);
    v = field(corrected, NH_CHART_COORDINATES);
    cr_expect(v->conserved && v->proof.all_parameters);
    nh_verification_free(v);
}

Test(verify, fields_outside_the_distribution_or_without_symmetry_are_refuted)
{
    nh_verification *v = field("y=1", NH_CHART_QUASI);
    cr_expect_not(v->conserved);
    cr_expect_eq(v->equation_number, 6, "%s", v->equation);
    nh_verification_free(v);
    v = field("phi=1", NH_CHART_QUASI);
    cr_expect_not(v->conserved);
    cr_expect_eq(v->equation_number, 17, "%s", v->equation);
    nh_verification_free(v);
    v = field("Z0=1", NH_CHART_QUASI);
    cr_expect(v->conserved && v->symmetry.kase == 1);
    nh_verification_free(v);
}

Test(verify, wrong_questions_are_explained)
{
    static const struct { const char *field, *what; } list[] = {
        {"phi=1; z=2", "`z` is neither Z0 nor a coordinate nor a velocity of the chart"},
        {"phi", "a component `name=expression` was expected, found `phi`"},
        {"phi=fi", "unknown name `fi`"},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++) {
        nh_error error;
        nh_error_clear(&error);
        nh_options o = defaults();
        cr_expect_null(nh_verification_of_field(sleigh(0, NULL), NH_CHART_QUASI, list[i].field, &o, &error));
        cr_expect_eq(error.code, NH_USAGE);
        cr_expect_str_eq(error.what, list[i].what);
    }
}

/* ---- simulate ---- */

static nh_simulation *motion(const char *initial, double until, double step, nh_chart_choice chart, nh_error *error)
{
    nh_error_clear(error);
    nh_request q = {.system_path = SLEIGH, .initial = initial, .until_given = true, .tolerance_given = true, .chart = chart, .step = step, .options = defaults()};
    q.options.until = until;
    return nh_simulation_create(&q, error);
}

static double last(const nh_simulation *s, const char *name)
{
    for (size_t k = 0; k < s->columns.count; k++)
        if (!strcmp(s->columns.track[k].name, name)) return s->value[(s->motion->count - 1) * s->columns.count + k];
    cr_expect_fail("no column %s", name);
    return NAN;
}

/* phi = 2 k atan tanh(z/2), z = omega0 t/k  [CechMusilova2014, eq. 33]; also in the chart that breaks down at cos phi = 0. */
Test(simulate, the_closed_form_in_both_charts)
{
    for (int chart = NH_CHART_QUASI; chart <= NH_CHART_COORDINATES; chart++) {
        nh_error error;
        nh_simulation *s = motion("phi=0, phi'=2.2", 4, 0.8, (nh_chart_choice)chart, &error);
        cr_assert_not_null(s, "%s", error.what);
        double z = 2.2 * 4 / 2, phi = 4 * atan(tanh(z / 2));
        cr_expect_eq(s->motion->count, 6);
        cr_expect_float_eq(last(s, "phi"), phi, 1e-8);
        cr_expect_float_eq(last(s, "phi'"), 2.2 / cosh(z), 1e-8);
        cr_expect_float_eq(last(s, "E"), 0.5 * 2 * 4 * 2.2 * 2.2, 1e-7);
        nh_text csv;
        nh_text_init(&csv);
        nh_motion_csv(s, &csv);
        cr_expect_eq(strncmp(nh_text_string(&csv), "t,phi,x,y,phi_dot,x_dot,y_dot,", 30), 0, "%.80s", nh_text_string(&csv));
        cr_expect_null(strstr(nh_text_string(&csv), "nan"));
        nh_text_clear(&csv);
        nh_simulation_free(s);
    }
}

/* Constant speed in gravity: where z' changes sign the chart of (x', y') ends, at the branch point of z' = +-sqrt(1 - x'^2 - y'^2), and the motion goes
 * on in all coordinates.  x' exp(-g z), y' exp(-g z) and the speed stay; z' follows from z' = tanh(c - g t) of the unit tangent. */
Test(simulate, a_motion_leaves_its_chart_and_its_branch, PLAIN_ONLY)
{
    static const char text[] = "name: rising\nparameters: [{name: g, value: 1.3}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
                               "lagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\nconstraints:\n  - x'^2 + y'^2 + z'^2 = 1\n";
    char path[] = "/tmp/nhsym-rising-XXXXXX";
    int descriptor = mkstemp(path);
    cr_assert(descriptor >= 0 && write(descriptor, text, sizeof text - 1) == (ssize_t)sizeof text - 1 && close(descriptor) == 0);
    static const char *const starts[] = {"x'=0.36, y'=0.48, z'=0.8", "x'=-0.1, y'=0.2", "x'=-0.1, y'=0.2, z'=0.97467943448089639"};
    for (size_t k = 0; k < 3; k++) {
        nh_error error = {0};
        nh_request q = {.system_path = path, .initial = starts[k], .until_given = true, .tolerance_given = true, .step = 0.25, .options = defaults()};
        q.options.until = 4;
        q.options.tolerance = 1e-11;
        nh_simulation *s = nh_simulation_create(&q, &error);
        cr_assert_not_null(s, "%s: %s", starts[k], error.what);
        cr_assert(s->motion->complete && s->motion->count == 17, "ended at %g", s->motion->end_time);
        const double *first = s->value + 3;
        double c = atanh(first[2]);
        for (size_t i = 0; i < s->motion->count; i++) {
            const double *v = s->value + i * s->columns.count + 3, t = s->motion->time[i], ratio = cosh(c) / cosh(c - 1.3 * t);
            cr_expect_float_eq(v[2], tanh(c - 1.3 * t), 2e-9, "z' at %g: %.17g instead of %.17g", t, v[2], tanh(c - 1.3 * t));
            cr_expect_float_eq(v[0], first[0] * ratio, 2e-9);
            cr_expect_float_eq(v[1], first[1] * ratio, 2e-9);
        }
        if (k != 1) cr_expect(first[2] > 0 && s->value[16 * s->columns.count + 5] < -0.9, "no apex was passed");
        nh_simulation_free(s);
    }
    remove(path);
}

Test(simulate, what_cannot_be_started_is_explained)
{
    nh_error error;
    cr_expect_null(motion("phi=0, x'=1, y'=1", 1, 0.5, NH_CHART_QUASI, &error));
    cr_expect_str_eq(error.what, "the initial velocities violate the constraints: the residual is 1");
    cr_expect_null(motion("psi=1", 1, 0.5, NH_CHART_QUASI, &error));
    cr_expect_not_null(strstr(error.what, "`psi`"), "%s", error.what);
}

/* Numbers that are too long for exact rationals: true to a double's digits is all that can be said, and must be said; false stays false. */
Test(verify, rounded_numbers)
{
    static const struct { const char *current; bool conserved; } list[] = {
        {"0.1234567890123456789*m*(v*sin(phi/k) + a*k*omega*cos(phi/k))", true},
        {"m*(v*sin(phi/k) + 1.0000001234567890123*a*k*omega*cos(phi/k))", false},
    };
    for (size_t i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_options options = defaults();
        nh_system *system = nh_system_read(SLEIGH, 0, NULL, &error);
        nh_verification *v = system ? nh_verification_of_current(system, NH_CHART_AUTO, list[i].current, &options, &error) : NULL;
        cr_assert_not_null(v, "%s", error.what);
        cr_expect_eq(v->conserved, list[i].conserved, "%s: %g digits", list[i].current, v->proof.digits);
        nh_verification_free(v);
    }
}

Test(simulate, watch_reads_a_list)
{
    nh_error error = {0};
    nh_request q = {.system_path = SLEIGH, .initial = "omega=2", .until_given = true, .tolerance_given = true, .step = 1, .options = defaults(), .watch = "phi, T = m/2*v^2, atan2(v, omega)"};
    q.options.until = 3;
    nh_simulation *s = nh_simulation_create(&q, &error);
    cr_assert(s && s->columns.count == 3 && s->scene, "%s", error.what);
    cr_expect(!strcmp(s->columns.track[1].name, "T") && !strcmp(s->columns.track[2].name, "atan2(v, omega)"), "%s, %s", s->columns.track[1].name, s->columns.track[2].name);
    cr_expect_eq(s->motion->size, 1); /* phi: the two currents that the file knows determine omega and v */
    const double *last = s->value + (s->motion->count - 1) * 3;
    cr_expect_float_eq(last[0], 4 * atan(tanh(1.5)), 1e-7);
    cr_expect_float_eq(last[1], 16 * tanh(3.0) * tanh(3.0), 1e-6);
    cr_expect_float_eq(last[2], atan2(4 * tanh(3.0), 2 / cosh(3.0)), 1e-7);
    nh_simulation_free(s);
    static const struct { const char *watch, *says; } wrong[] = {{"", "--watch names no quantity"}, {"nothing", "unknown name"}, {"phi=", "expression ends here"}};
    for (int i = 0; i < 3; i++) {
        nh_error_clear(&error);
        q.watch = wrong[i].watch;
        cr_expect_null(nh_simulation_create(&q, &error));
        cr_expect(strstr(error.what, wrong[i].says), "%s", error.what);
    }
    nh_error_clear(&error);
    q.watch = NULL;
    q.scene = true;
    cr_expect_null(nh_simulation_create(&q, &error));
    cr_expect(strstr(error.what, "--scene needs an analysis file"), "%s", error.what);
}

/* The momentum of a symmetry that the file names removes a velocity while it determines it; beside it the whole model, for comparison. */
Test(simulate, symmetries_of_the_file_make_scenes_smaller)
{
    static const char *const text = "name: rot\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: s, type: angle}]\n"
                                    "lagrangian: (x'^2 + y'^2)/2 + s'^2/2 - (x^2 + y^2)^2/4 - cos(s)\nsymmetry: [{x: -y, y: x}]\ndomain: {x: [1, 2], y: [-1, 1]}\n";
    char path[] = "/tmp/nhsym-rot-XXXXXX.yaml";
    int file = mkstemps(path, 5);
    cr_assert(file >= 0 && write(file, text, strlen(text)) == (ssize_t)strlen(text));
    close(file);
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = "x=1.2, y'=0.2", .until_given = true, .step = 1, .options = defaults(), .watch = "x^2 + y^2"};
    static const double end[2] = {1, 20};
    static const size_t states[2] = {3, 4}; /* x does not stay positive for long */
    for (int i = 0; i < 2; i++) {
        q.options.until = end[i];
        nh_simulation *s = nh_simulation_create(&q, &error);
        cr_assert(s && s->scene, "%s", error.what);
        cr_expect_eq(s->motion->size, states[i], "%s", s->scene);
        cr_expect(s->compared && s->whole_difference < 1e-6 && s->whole_seconds > 0, "%g", s->whole_difference);
        nh_simulation_free(s);
    }
    unlink(path);
}

/* ---- symmetries of the equations of motion ---- */

static nh_verification *motions(const char *file, const char *text, nh_chart_choice chart)
{
    nh_error error;
    nh_error_clear(&error);
    nh_options o = defaults();
    nh_system *s = nh_system_read(file, 0, NULL, &error);
    cr_assert_not_null(s, "%s", error.what);
    nh_verification *v = nh_verification_of_motions(s, chart, text, &o, &error);
    cr_assert_not_null(v, "%s: %s", text, error.what);
    return v;
}

/* Translations, rotations and scalings are; the sleigh's field of Phi_2 is a constraint symmetry and none of these; [Gamma,Z] = f Gamma has the f that the
 * weight of the time gives. */
Test(verify, symmetries_of_the_equations_of_motion)
{
    static const struct {
        const char *file, *field;
        bool holds;
        double factor;
    } list[] = {
        {"systems/kepler.yaml", "x=2*x; y=2*y; z=2*z; Z0=3*t", true, 3},
        {"systems/kepler.yaml", "x=2*x; y=2*y; z=2*z; Z0=2*t", false, 2},
        {"systems/sleigh.yaml", "y=1", true, 0}, /* not in the canonical distribution */
        {"systems/sleigh.yaml", "Z0=-t", true, -1}, /* nothing in it has a time of its own */
        {"systems/sleigh.yaml", "x=x; y=y", false, 0},
        {"systems/sleigh.yaml", "phi=1; x=-y; y=x", true, 0},
        {"systems/sleigh.yaml", "phi=cos(phi/k)/(a*k); x=cos(phi)*sin(phi/k); y=sin(phi)*sin(phi/k)", false, 0},
        {"systems/constant_speed.yaml", "x=-y; y=x", true, 0}, /* a nonlinear constraint */
        {"systems/constant_speed.yaml", "y=-z; z=y", false, 0},
    };
    for (size_t i = 0; i < sizeof list / sizeof *list; i++)
        for (int chart = NH_CHART_AUTO; chart <= NH_CHART_COORDINATES; chart += NH_CHART_COORDINATES) {
            nh_verification *v = motions(list[i].file, list[i].field, (nh_chart_choice)chart);
            cr_expect_eq(v->conserved, list[i].holds, "%s: %s", list[i].file, list[i].field);
            cr_expect(!v->conserved || (v->proof.proved && v->proof.all_parameters), "%s: not proved", list[i].field);
            cr_expect_neq(v->conserved, v->has_counterexample);
            cr_expect(nh_is_number(v->model->dag, v->factor, (int64_t)list[i].factor), "%s: another f", list[i].field);
            nh_verification_free(v);
        }
}

/* The scaling has Z(E) = -2 E, and every function that it makes of a current is conserved. */
Test(verify, what_a_symmetry_of_the_equations_makes_of_currents)
{
    nh_verification *v = motions("systems/kepler.yaml", "x=2*x; y=2*y; z=2*z; Z0=3*t", NH_CHART_AUTO);
    nh_dag *d = v->model->dag;
    cr_assert_gt(v->made, 3);
    for (size_t i = 0; i < v->made; i++) cr_expect_eq(nh_normal_is_zero(d, nh_model_gamma(v->model, v->make[i].value), 0), NH_ZERO, "Z(%s)", v->make[i].name);
    nh_ex sum = nh_add(d, v->make[0].value, nh_mul(d, nh_int(d, 2), v->model->E));
    cr_expect(!strcmp(v->make[0].name, "E") && nh_normal_is_zero(d, sum, 0) == NH_ZERO);
    nh_verification_free(v);
}
