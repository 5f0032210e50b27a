/* tables: smooth functions through measured values, and what an analysis says of systems with them. */
#include <cjson/cJSON.h>
#include <gsl/gsl_spline.h>
#include <gsl/gsl_spline2d.h>
#include <stdint.h>

#include "base/spline.h"
#include "graph/declared.h"
#include "graph/diff.h"
#include "graph/print.h"
#include "integrals/fitted.h"
#include "mechanics.h"
#include "program.h"
#include "system/sample.h"

/* ---- splines ---- */

enum { nodes = 23, other_nodes = 17 };

static double wavy(double x, double y) { return sin(1.3 * x + 0.2) * exp(0.4 * y) + x * y * y; }

static void check_one_variable(bool akima)
{
    double x[nodes], f[nodes];
    for (int i = 0; i < nodes; i++) x[i] = -1 + 0.09 * i + 0.02 * sin(i), f[i] = wavy(x[i], 0.7);
    nh_arena *arena = nh_arena_create();
    nh_spline *s = nh_spline_create(arena, akima, nodes, x, 1, NULL, f);
    gsl_spline *other = gsl_spline_alloc(akima ? gsl_interp_akima : gsl_interp_cspline, nodes);
    gsl_spline_init(other, x, f, nodes);
    uint64_t state = 5;
    for (int k = 0; k < 300; k++) {
        double at = k == 0 ? x[0] : k == 1 ? x[nodes - 1] : x[0] + (x[nodes - 1] - x[0]) * nh_random(&state);
        cr_expect(fabs(nh_spline_value(s, 0, 0, at, 0) - gsl_spline_eval(other, at, NULL)) < 1e-13);
        cr_expect(fabs(nh_spline_value(s, 1, 0, at, 0) - gsl_spline_eval_deriv(other, at, NULL)) < 1e-11);
        if (k > 1) cr_expect(fabs(nh_spline_value(s, 2, 0, at, 0) - gsl_spline_eval_deriv2(other, at, NULL)) < 1e-9);
    }
    cr_expect(isnan(nh_spline_value(s, 0, 0, x[0] - 1e-9, 0)) && isnan(nh_spline_value(s, 1, 0, x[nodes - 1] + 1e-9, 0)));
    gsl_spline_free(other);
    nh_arena_free(arena);
}

Test(tables, splines_in_one_variable_are_those_of_gsl)
{
    check_one_variable(false);
    check_one_variable(true);
}

Test(tables, splines_in_two_variables_are_those_of_gsl)
{
    double x[nodes], y[other_nodes], f[nodes * other_nodes], z[nodes * other_nodes];
    for (int i = 0; i < nodes; i++) x[i] = -1 + 0.1 * i;
    for (int j = 0; j < other_nodes; j++) y[j] = -0.5 + 0.11 * j;
    gsl_spline2d *other = gsl_spline2d_alloc(gsl_interp2d_bicubic, nodes, other_nodes);
    for (int i = 0; i < nodes; i++)
        for (int j = 0; j < other_nodes; j++) f[i * other_nodes + j] = wavy(x[i], y[j]), gsl_spline2d_set(other, z, (size_t)i, (size_t)j, wavy(x[i], y[j]));
    gsl_spline2d_init(other, x, y, z, nodes, other_nodes);
    nh_arena *arena = nh_arena_create();
    nh_spline *s = nh_spline_create(arena, false, nodes, x, other_nodes, y, f);
    uint64_t state = 6;
    for (int k = 0; k < 300; k++) {
        double a = x[0] + 2.2 * nh_random(&state), b = y[0] + 1.76 * nh_random(&state);
        cr_expect(fabs(nh_spline_value(s, 0, 0, a, b) - gsl_spline2d_eval(other, a, b, NULL, NULL)) < 1e-13);
        cr_expect(fabs(nh_spline_value(s, 1, 0, a, b) - gsl_spline2d_eval_deriv_x(other, a, b, NULL, NULL)) < 1e-11);
        cr_expect(fabs(nh_spline_value(s, 0, 1, a, b) - gsl_spline2d_eval_deriv_y(other, a, b, NULL, NULL)) < 1e-11);
        cr_expect(fabs(nh_spline_value(s, 2, 0, a, b) - gsl_spline2d_eval_deriv_xx(other, a, b, NULL, NULL)) < 1e-9);
        cr_expect(fabs(nh_spline_value(s, 1, 1, a, b) - gsl_spline2d_eval_deriv_xy(other, a, b, NULL, NULL)) < 1e-9);
    }
    gsl_spline2d_free(other);
    nh_arena_free(arena);
}

Test(tables, the_estimated_error_is_above_the_true_one_and_sees_noise)
{
    enum { n = 101 };
    double x[n], f[n], noisy[n];
    uint64_t state = 1;
    for (int i = 0; i < n; i++) x[i] = i * M_PI / (n - 1), f[i] = sin(x[i]), noisy[i] = f[i] + 1e-6 * (2 * nh_random(&state) - 1); /* sin'' vanishes at both ends */
    nh_arena *arena = nh_arena_create();
    nh_spline *s = nh_spline_create(arena, false, n, x, 1, NULL, f), *r = nh_spline_create(arena, false, n, x, 1, NULL, noisy);
    double off = 0, all = 0;
    for (int i = 0; i < n; i++) off += pow(s->fx[i] - cos(x[i]), 2), all += pow(cos(x[i]), 2);
    cr_expect(s->error >= sqrt(off / all) && s->error < 100 * sqrt(off / all) + 1e-12, "estimated %g, true %g", s->error, sqrt(off / all));
    cr_expect(r->error > 1e-5 && r->error < 1e-3, "noise of 1e-6 over steps of 0.03 changes slopes by about 3e-5: %g", r->error);
    nh_arena_free(arena);
}

/* ---- files ---- */

static double central(double r) { return -1 / r; }

/* A table of V(r) with 200 values. */
static void write_radial(const place *p)
{
    nh_text t;
    nh_text_init(&t);
    nh_text_add(&t, "r,V\n");
    for (int i = 0; i < 200; i++) nh_text_addf(&t, "%.17g,%.17g\n", 0.4 + 2.6 * i / 199, central(0.4 + 2.6 * i / 199));
    write_here(p, "radial.csv", nh_text_string(&t));
    nh_text_clear(&t);
}

/* V(r) (1 + part cos(2 phi)) on 20 x 10 values. */
static void write_polar(const place *p, double part)
{
    nh_text t;
    nh_text_init(&t);
    nh_text_add(&t, "r,phi,V\n");
    for (int i = 0; i < 20; i++)
        for (int j = 0; j < 10; j++) {
            double r = 0.5 + 2.0 * i / 19, phi = -4 + 8.0 * j / 9;
            nh_text_addf(&t, "%.17g,%.17g,%.17g\n", r, phi, central(r) * (1 + part * cos(2 * phi)));
        }
    write_here(p, "polar.csv", nh_text_string(&t));
    nh_text_clear(&t);
}

static const char RADIAL[] = "coordinates: [{name: r, type: length}, {name: phi, type: angle}]\nparameters: {m: 1.3}\n"
                             "tables: [{name: V, file: radial.csv, in: [r]}]\nlagrangian: m/2*(r'^2 + r^2*phi'^2) - V(r)\n",
                  CARTESIAN[] = "coordinates: [{name: x, type: length}, {name: y, type: length}]\nparameters: {m: 1.3}\n"
                                "tables: [{name: V, file: radial.csv, in: r, spline: akima}]\nlagrangian: m/2*(x'^2 + y'^2) - V(sqrt(x^2 + y^2))\n"
                                "domain: {x: [0.4, 1.5], y: [0.4, 1.5]}\n",
                  POLAR[] = "coordinates: [{name: r, type: length}, {name: phi, type: angle}]\nparameters: {m: 1.3}\n"
                            "tables: [{name: V, file: polar.csv, in: [r, phi]}]\nlagrangian: m/2*(r'^2 + r^2*phi'^2) - V(r, phi)\n";

/* ---- expressions ---- */

Test(tables, derivatives_of_an_expression_are_those_of_the_spline_and_are_printed_as_they_are_read)
{
    place p = place_make();
    write_polar(&p, 0.1);
    write_here(&p, "polar.yaml", POLAR);
    char path[PATH_MAX + 20];
    snprintf(path, sizeof path, "%.4000s/polar.yaml", p.folder);
    mechanics x = mechanics_of_file(path, NH_CHART_AUTO, 0, NULL);
    nh_dag *d = x.model->dag;
    nh_ex e = formula(x.model, "r*V(r^2/2 + 1/2, phi)"), by_r = nh_diff(d, e, x.system->coordinate[0].q), both = nh_diff(d, by_r, x.system->coordinate[1].q);
    double z[5] = {0, 1.1, 0.3, 0, 0}, up[5] = {0, 1.1 + 1e-5, 0.3, 0, 0}, down[5] = {0, 1.1 - 1e-5, 0.3, 0, 0};
    cr_expect(fabs(value_at(x.model, by_r, z) - (value_at(x.model, e, up) - value_at(x.model, e, down)) / 2e-5) < 1e-8);
    char *text = nh_print_string(d, both);
    cr_expect_not_null(strstr(text, "V_rphi("), "%s", text);
    cr_expect_eq(formula(x.model, text), both, "%s", text);
    nh_free(text);
    mechanics_clear(&x);
    place_clear(&p);
}

/* ---- analyses ---- */

static cJSON *analysis_of(const place *p, const char *text)
{
    write_here(p, "system.yaml", text);
    finished f = run(p, "analyze system.yaml --json -");
    cr_assert_eq(f.code, 0, "%s", f.err);
    cJSON *json = cJSON_Parse(f.out);
    cr_assert_not_null(json);
    finished_clear(&f);
    return json;
}

/* How many currents are fitted to 1e-8, none of them proved. */
static size_t fitted_of(const cJSON *json)
{
    size_t n = 0;
    const cJSON *each;
    cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(json, "verdict")), "FITTED");
    cJSON_ArrayForEach(each, cJSON_GetObjectItem(json, "currents"))
    {
        cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(each, "fitted")) && cJSON_IsFalse(cJSON_GetObjectItem(each, "proved")));
        cr_expect_leq(cJSON_GetNumberValue(cJSON_GetObjectItem(each, "certified_digits")), 0);
        n += cJSON_GetNumberValue(cJSON_GetObjectItem(each, "heldout_residual")) <= 1e-8;
    }
    return n;
}

static bool has_current(const cJSON *json, const char *formula)
{
    const cJSON *each;
    cJSON_ArrayForEach(each, cJSON_GetObjectItem(json, "currents"))
        if (strstr(cJSON_GetStringValue(cJSON_GetObjectItem(each, "expression")), formula)) return true;
    return false;
}

Test(tables, energy_and_angular_momentum_of_a_central_table_are_fitted)
{
    place p = place_make();
    write_radial(&p);
    write_polar(&p, 0);
    const char *const systems[] = {RADIAL, CARTESIAN, POLAR};
    for (size_t i = 0; i < sizeof systems / sizeof *systems; i++) {
        cJSON *json = analysis_of(&p, systems[i]);
        cr_expect_eq(fitted_of(json), 2, "%s", systems[i]);
        cr_expect(has_current(json, "r^2*phi'") || has_current(json, "x*y' - y*x'") || has_current(json, "y*x' - x*y'"), "%s", systems[i]);
        cJSON_Delete(json);
    }
    place_clear(&p);
}

Test(tables, one_percent_that_breaks_the_symmetry_leaves_the_energy_alone)
{
    place p = place_make();
    write_polar(&p, 0.01);
    cJSON *json = analysis_of(&p, POLAR);
    cr_expect_eq(fitted_of(json), 1);
    cr_expect(has_current(json, "V(r, phi)"));
    cJSON_Delete(json);
    place_clear(&p);
}

Test(tables, what_only_the_error_of_the_table_breaks_is_told_as_nearly_conserved)
{
    place p = place_make();
    nh_text t;
    nh_text_init(&t);
    nh_text_add(&t, "x,y,V\n");
    for (int i = 0; i <= 40; i++)
        for (int j = 0; j <= 40; j++) {
            double x = -2 + i / 10.0, y = -2 + j / 10.0;
            nh_text_addf(&t, "%.17g,%.17g,%.17g\n", x, y, -exp(-(x * x + y * y) / 2));
        }
    write_here(&p, "plane.csv", nh_text_string(&t));
    nh_text_clear(&t);
    cJSON *json = analysis_of(&p, "coordinates: [{name: x, type: length}, {name: y, type: length}]\nparameters: {m: 1.3}\n"
                                  "tables: [{name: V, file: plane.csv, in: [x, y]}]\nlagrangian: m/2*(x'^2 + y'^2) - V(x, y)\ndomain: {x: [-1, 1], y: [-1, 1]}\n");
    cr_expect_eq(fitted_of(json), 1);
    const cJSON *almost = cJSON_GetArrayItem(cJSON_GetObjectItem(json, "almost_conserved"), 0);
    cr_assert_not_null(almost);
    const char *formula = cJSON_GetStringValue(cJSON_GetObjectItem(almost, "expression"));
    cr_expect(strstr(formula, "x*y'") && strstr(formula, "y*x'"), "%s", formula);
    double rate = cJSON_GetNumberValue(cJSON_GetObjectItem(almost, "rate"));
    cr_expect(rate > 1e-7 && rate < 1e-4, "%g", rate);
    cJSON_Delete(json);
    place_clear(&p);
}

Test(tables, verify_says_how_far_values_tell_and_code_is_refused)
{
    place p = place_make();
    write_polar(&p, 0.01);
    write_here(&p, "system.yaml", POLAR);
    finished f = run(&p, "verify system.yaml --current m/2*(r'^2+r^2*phi'^2)+V(r,phi)");
    cr_expect_not_null(strstr(f.out, "Yes."), "%s", f.out);
    cr_expect_not_null(strstr(f.out, "a table has no formula") ? f.out : strstr(f.out, "a\ntable has no formula"), "%s", f.out);
    finished_clear(&f);
    f = run(&p, "verify system.yaml --current r^2*phi'");
    cr_expect_not_null(strstr(f.out, "No."), "%s", f.out);
    finished_clear(&f);
    static const char *const languages[] = {"c", "python", "js"};
    for (int i = 0; i < 3; i++) {
        char line[80];
        snprintf(line, sizeof line, "export system.yaml --to %s", languages[i]);
        f = run(&p, line);
        cr_expect_neq(f.code, 0);
        cr_expect_not_null(strstr(f.err, "table of values"), "%s", f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(tables, commands_that_need_formulas_refuse_a_table)
{
    static const char *const lines[] = {"linearize system.yaml --at r=1", "classify system.yaml --over m"};
    place p = place_make();
    write_radial(&p);
    write_here(&p, "system.yaml", RADIAL);
    for (int i = 0; i < 2; i++) {
        finished f = run(&p, lines[i]);
        cr_expect_neq(f.code, 0);
        cr_expect_not_null(strstr(f.err, "needs formulas, but `V` is a table, which has none"), "%s: %s", lines[i], f.err);
        finished_clear(&f);
    }
    place_clear(&p);
}

Test(tables, a_motion_that_leaves_the_table_says_so)
{
    place p = place_make();
    write_radial(&p);
    write_here(&p, "system.yaml", RADIAL);
    finished f = run(&p, "simulate system.yaml --initial r=2,r'=2,phi'=0.1 --until 5 --csv out.csv");
    cr_expect_not_null(strstr(f.err, "it leaves the table of V(r), which ends at r = 3"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(tables, a_coordinate_is_sampled_where_its_table_has_values)
{
    place p = place_make();
    write_radial(&p);
    cJSON *json = analysis_of(&p, RADIAL);
    const cJSON *range = cJSON_GetObjectItem(cJSON_GetObjectItem(cJSON_GetObjectItem(json, "samples"), "domain"), "r");
    cr_expect_float_eq(cJSON_GetArrayItem(range, 0)->valuedouble, 0.4, 1e-12);
    cr_expect_float_eq(cJSON_GetArrayItem(range, 1)->valuedouble, 3, 1e-12);
    cJSON_Delete(json);
    place_clear(&p);
}

/* ---- errors ---- */

static void check_error(const char *csv, const char *table, const char *expected)
{
    char text[600];
    place p = place_make();
    if (csv) write_here(&p, "t.csv", csv);
    snprintf(text, sizeof text, "coordinates: [x, y]\ntables: [%s]\nlagrangian: (x'^2 + y'^2)/2\n", table);
    write_here(&p, "system.yaml", text);
    finished f = run(&p, "analyze system.yaml");
    cr_expect_neq(f.code, 0);
    cr_expect_not_null(strstr(f.err, expected), "expected %s, found %s", expected, f.err);
    cr_expect_not_null(strstr(f.err, "hint: "), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(tables, errors_of_tables_have_a_place_and_a_hint)
{
    static const char good[] = "x,V\n0,1\n1,2\n2,1\n3,0\n4,1\n";
    check_error(NULL, "{name: V, file: t.csv, in: [x]}", "system.yaml:2:26: the file `t.csv` cannot be opened");
    check_error(good, "{name: V, file: t.csv, in: [z]}", "t.csv: there is no column `z`");
    check_error(good, "{name: U, file: t.csv, in: [x]}", "t.csv: there is no column `U`");
    check_error("x,V\n0,1\n2,2\n1,1\n3,0\n4,1\n", "{name: V, file: t.csv, in: [x]}", "t.csv:4: the rows are not sorted");
    check_error("x,V\n0,1\n2,2\n2,1\n3,0\n4,1\n", "{name: V, file: t.csv, in: [x]}", "t.csv:4: the rows are not sorted");
    check_error("x,y,V\n0,0,1\n0,1,2\n1,0,1\n1,2,0\n", "{name: V, file: t.csv, in: [x, y]}", "t.csv:5: the rows are no sorted rectangle");
    check_error(good, "{name: V, in: [x]}", "system.yaml:2:10: a table was expected");
    check_error(good, "{name: V, file: t.csv, in: [x], spline: quintic}", "a spline is `cubic` or `akima`");
}

/* ---- digits ---- */

enum { trials = 200, samples = 64, columns = 6 };

static double gauss(uint64_t *state) { return sqrt(-2 * log(1 - nh_random(state))) * cos(2 * M_PI * nh_random(state)); }

Test(tables, digits_of_a_null_vector_of_noisy_equations_are_never_more_than_the_true_ones)
{
    size_t told = 0;
    for (uint64_t seed = 1; seed <= trials; seed++) {
        uint64_t state = seed;
        double truth[columns], *a = nh_alloc_array(samples * columns, sizeof *a), *b = nh_alloc_array(samples * columns, sizeof *b);
        for (int j = 0; j < columns; j++) truth[j] = j ? gauss(&state) : 1;
        for (int i = 0; i < samples; i++) {
            double sum = 0;
            for (int j = 1; j < columns; j++) sum += truth[j] * (a[i + j * samples] = gauss(&state));
            a[i] = -sum; /* A truth = 0 */
            for (int j = 0; j < columns; j++) a[i + j * samples] += 1e-6 * gauss(&state), b[i + j * samples] = gauss(&state);
        }
        nh_options options;
        nh_options_default(&options);
        nh_nullspace_options limits = nh_nullspace_options_from(&options);
        limits.likely = INFINITY, limits.gap = 1;
        nh_equations *equations = nh_equations_create(columns, 1);
        nh_equations_add(equations, samples, a, samples);
        nh_equations_add_values(equations, samples, b, samples);
        nh_error error = {0};
        nh_nullspace *s = nh_nullspace_solve(equations, &limits, &error);
        must(s && s->likely > 0, &error, "the null space");
        double off = 0, size = 0;
        for (int j = 0; j < columns; j++) {
            off = fmax(off, fabs(s->vector[j] / s->vector[0] - truth[j]));
            size = fmax(size, fabs(truth[j]));
        }
        double digits = nh_fitted_digits(s);
        cr_expect_leq(digits, -log10(off / size), "seed %d: %g digits stated, %g true", (int)seed, digits, -log10(off / size));
        told += digits >= 4;
        nh_nullspace_free(s);
        nh_equations_free(equations);
        nh_free(b), nh_free(a);
    }
    cr_expect_geq(told, trials / 2, "the digits are not simply left out: %zu of %d trials have four or more", told, trials);
}

/* The energy of an oscillator whose potential is a table with noise, as a combination of x^2 and x'^2, fitted at 64 points. */
static void check_noisy_table(place *p, uint64_t seed, double *stated, double *true_digits)
{
    enum { values = 41 };
    char path[PATH_MAX + 20];
    nh_text t;
    uint64_t state = 77 * seed;
    nh_text_init(&t);
    nh_text_add(&t, "x,V\n");
    for (int i = 0; i < values; i++) {
        double x = -1.5 + 3.0 * i / (values - 1);
        nh_text_addf(&t, "%.17g,%.17g\n", x, 0.7 * x * x * (1 + 1e-6 * gauss(&state)));
    }
    write_here(p, "noisy.csv", nh_text_string(&t));
    nh_text_clear(&t);
    snprintf(path, sizeof path, "%.4000s/noisy.yaml", p->folder);
    mechanics x = mechanics_of_file(path, NH_CHART_AUTO, 0, NULL);
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_fitted_options(x.model, &options);
    nh_points *fit = points_of(x.model, samples, seed), *again = points_of(x.model, 2 * samples, seed + 1000);
    nh_ex term[2] = {formula(x.model, "x^2"), formula(x.model, "x'^2")};
    nh_family family = {.kind = NH_TERMS, .terms = 2, .term = term};
    nh_ansatz *a = nh_ansatz_create(x.model, fit, 1, &family, 10, &error);
    must(a != NULL, &error, "the ansatz");
    nh_equations *equations = nh_equations_create(a->columns, 1);
    nh_rows *rows = nh_rows_create(x.model, a, 0, NULL);
    nh_rows_current(rows, fit, NULL, equations);
    nh_nullspace_options limits = nh_nullspace_options_from(&options);
    limits.likely = INFINITY, limits.gap = 1;
    nh_nullspace *s = nh_nullspace_solve(equations, &limits, &error);
    must(s && s->likely, &error, "the null space");
    nh_candidates *list = nh_echelon(x.model, fit, a, s, 1, &options);
    cr_assert_eq(list->count, 1);
    const nh_candidate *c = &list->candidate[0];
    cr_assert_eq(c->count, 2);
    double ratio = c->term[0] == term[0] ? c->coefficient[0] / c->coefficient[1] : c->coefficient[1] / c->coefficient[0];
    *stated = nh_fitted_again(x.model, again, c, &options);
    *true_digits = -log10(fabs(ratio / (0.7 / (1.3 / 2)) - 1));
    nh_candidates_free(list);
    nh_nullspace_free(s);
    nh_rows_free(rows);
    nh_equations_free(equations);
    nh_ansatz_free(a);
    nh_points_free(again), nh_points_free(fit);
    mechanics_clear(&x);
}

Test(tables, digits_of_coefficients_from_a_noisy_table_are_never_more_than_the_true_ones)
{
    place p = place_make();
    size_t told = 0;
    write_here(&p, "noisy.yaml", "coordinates: [{name: x, type: length}]\nparameters: {m: 1.3}\n"
                                 "tables: [{name: V, file: noisy.csv, in: [x]}]\nlagrangian: m/2*x'^2 - V(x)\ndomain: {x: [-1, 1]}\n");
    for (uint64_t seed = 1; seed <= trials; seed++) {
        double stated, digits;
        check_noisy_table(&p, seed, &stated, &digits);
        cr_expect_leq(stated, digits, "seed %d: %g digits stated, %g true", (int)seed, stated, digits);
        told += stated >= 2;
    }
    cr_expect_geq(told, trials / 2, "%zu of %d trials have two digits or more", told, trials);
    place_clear(&p);
}
