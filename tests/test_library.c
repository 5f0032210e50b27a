/* library: the public interface (nhsym.h), and nothing else. */
#include <criterion/criterion.h>

#include <math.h>
#include <nhsym.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "scratch.h"
#include "sweep.h"

/* A harmonic oscillator: energy and phase. */
static const char skate[] = "name: skate\nparameters: [{name: b, value: 3}]\ncoordinates: [{name: phi, type: angle}, x, y]\n"
                            "lagrangian: x'^2 + y'^2 + phi'^2/4 + 2*b*x\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n";
static const char oscillator[] = "name: spring\n"
                                 "parameters:\n  - {name: m, value: 2}\n  - {name: k, value: 8}\n"
                                 "coordinates: [x]\n"
                                 "lagrangian: m*x'^2/2 - k*x^2/2\n";

typedef struct {
    nh_context *context;
    nh_problem *problem;
    nh_error    error;
} opened;

static opened open_one(nh_question question)
{
    opened o = {.context = nh_context_create()};
    o.problem = nh_problem_open(o.context, &question, &o.error);
    return o;
}

static void close_one(opened *o)
{
    nh_problem_free(o->problem);
    nh_context_free(o->context);
}

Test(library, a_text_in_memory_is_analysed)
{
    opened o = open_one((nh_question){.system_text = oscillator, .set = "k = 18"});
    cr_assert_not_null(o.problem, "%s", o.error.what);
    cr_expect_str_eq(nh_problem_name(o.problem), "spring");
    cr_expect_eq(nh_problem_coordinates(o.problem), 1u);
    cr_expect_str_eq(nh_problem_coordinate(o.problem, 0), "x");
    cr_expect_null(nh_problem_coordinate(o.problem, 1));
    double k = 0;
    cr_expect_str_eq(nh_problem_parameter(o.problem, 1, &k), "k");
    cr_expect_eq(k, 18.0);
    nh_analysis *a = nh_analyze(o.problem, &o.error);
    close_one(&o); /* the result lives on */
    cr_assert_not_null(a, "%s", o.error.what);
    cr_expect_str_eq(nh_analysis_verdict(a), "FOUND");
    cr_expect_str_eq(nh_analysis_search(a), "complete");
    cr_expect_eq(nh_analysis_independent(a), 2u);
    cr_expect_eq(nh_analysis_most(a), 2u);
    bool energy = false;
    for (size_t i = 0; i < nh_analysis_currents(a); i++) {
        nh_current_facts f = nh_current_describe(a, i);
        energy |= strstr(f.meaning, "energy") != NULL;
        cr_expect(f.proved);
        cr_expect_lt(f.drift, 1e-6);
    }
    cr_expect(energy);
    nh_analysis_free(a);
}

/* x = cos 3t is a motion of the oscillator with k/m = 9: what is conserved keeps its value. */
Test(library, currents_have_values)
{
    opened o = open_one((nh_question){.system_text = oscillator, .set = "k=18"});
    nh_analysis *a = nh_analyze(o.problem, &o.error);
    cr_assert_not_null(a, "%s", o.error.what);
    for (size_t i = 0; i < nh_analysis_currents(a); i++) {
        double t = 0.7, q0 = 1, v0 = 0, q = cos(3 * t), v = -3 * sin(3 * t);
        double first = nh_current_value(a, i, 0, &q0, &v0), later = nh_current_value(a, i, t, &q, &v);
        cr_expect_float_eq(first, later, 1e-12 * (1 + fabs(first)));
    }
    cr_expect(isnan(nh_current_value(a, nh_analysis_currents(a), 0, (double[]){0}, (double[]){0})));
    char *plain = nh_current_formula(a, 0, NH_SYNTAX_PLAIN), *latex = nh_current_formula(a, 0, NH_SYNTAX_LATEX), *mathml = nh_current_formula(a, 0, NH_SYNTAX_MATHML);
    cr_expect_not_null(strstr(plain, "x'"));
    cr_expect_not_null(strstr(latex, "\\dot"));
    cr_expect_not_null(strstr(mathml, "<m"));
    nh_string_free(plain);
    nh_string_free(latex);
    nh_string_free(mathml);
    nh_analysis_free(a);
    close_one(&o);
}

/* Many states at once, more than a batch has: as one by one, and undefined where those are. */
Test(library, currents_have_values_at_many_states)
{
    enum { count = 700 };
    static const char singular[] = "name: far\ncoordinates: [r, s]\nlagrangian: (r'^2 + s'^2)/2 + log(r)\n";
    static double t[count], q[2 * count], v[2 * count], out[count];
    opened o = open_one((nh_question){.system_text = singular});
    nh_analysis *a = nh_analyze(o.problem, &o.error);
    cr_assert_not_null(a, "%s", o.error.what);
    for (size_t j = 0; j < count; j++) {
        t[j] = 0.01 * (double)j;
        q[j] = 0.01 * (double)j - 0.5; /* of r: negative at first */
        q[count + j] = sin((double)j);
        v[j] = cos((double)j);
        v[count + j] = 1.5 + sin(0.3 * (double)j);
    }
    size_t undefined = 0;
    for (size_t i = 0; i < nh_analysis_currents(a); i++) {
        cr_assert(nh_current_values(a, i, count, t, q, v, out));
        for (size_t j = 0; j < count; j++) {
            double one = nh_current_value(a, i, t[j], (double[]){q[j], q[count + j]}, (double[]){v[j], v[count + j]});
            undefined += isnan(one);
            if (isnan(one)) cr_expect(isnan(out[j]));
            else cr_expect_float_eq(out[j], one, 1e-14 * (1 + fabs(one)));
        }
    }
    cr_expect_geq(undefined, 50u); /* the energy has a logarithm */
    cr_expect_not(nh_current_values(a, nh_analysis_currents(a), count, t, q, v, out));
    nh_analysis_free(a);
    close_one(&o);
}

/* A bead on a rotating blade, y' cos t = x' sin t, at rest apart from that: its acceleration is (v cos t)', where v' = 0. */
Test(library, rates_are_accelerations)
{
    enum { count = 600 };
    static const char blade[] = "name: blade\nparameters: [{name: m, value: 3}, {name: g, value: 2}]\ncoordinates: [x, y]\n"
                                "lagrangian: m*(x'^2 + y'^2)/2 - m*g*y\nconstraints: [\"y'*cos(t) = x'*sin(t)\"]\n";
    static double t[count], q[2 * count], v[2 * count], a[2 * count];
    opened o = open_one((nh_question){.system_text = blade, .set = "g=0.5"});
    nh_rates *rates = nh_rates_create(o.problem, &o.error);
    close_one(&o); /* they live on */
    cr_assert_not_null(rates, "%s", o.error.what);
    for (size_t j = 0; j < count; j++) {
        t[j] = 0.01 * (double)j;
        double speed = 1 + cos((double)j);
        v[j] = speed * cos(t[j]);
        v[count + j] = speed * sin(t[j]);
    }
    nh_rates_at(rates, count, t, q, v, a);
    for (size_t j = 0; j < count; j++) {
        double speed = 1 + cos((double)j), along = -0.5 * sin(t[j]); /* v' = -g sin t */
        cr_expect_float_eq(a[j], along * cos(t[j]) - speed * sin(t[j]), 1e-12);
        cr_expect_float_eq(a[count + j], along * sin(t[j]) + speed * cos(t[j]), 1e-12);
    }
    nh_rates_at(rates, 1, NULL, (double[]){0, 0}, (double[]){NAN, 0}, a);
    cr_expect(isnan(a[0]) && isnan(a[1]));
    nh_rates_free(rates);
    o = open_one((nh_question){.system_text = "name: none\ncoordinates: [x, y]\nlagrangian: x'^2/2\n"});
    cr_expect_null(nh_rates_create(o.problem, &o.error));
    cr_expect(strstr(o.error.what, "inertia") || strstr(o.error.what, "singular"), "%s", o.error.what);
    close_one(&o);
}

/* What a question points to is the caller's, and may change as soon as the problem is open. */
Test(library, a_question_is_read_once)
{
    char system[] = "systems/sleigh.yaml", analysis[] = "analyses/sleigh.yaml", set[] = "a = 0.3", velocities[] = "quasi", initial[] = "phi = 0.2";
    nh_question q = {.system = system, .analysis = analysis, .set = set, .velocities = velocities, .initial = initial, .until = 0.1};
    opened o = open_one(q);
    cr_assert_not_null(o.problem, "%s", o.error.what);
    char *const given[] = {system, analysis, set, velocities, initial};
    for (size_t i = 0; i < sizeof given / sizeof *given; i++) memset(given[i], '#', strlen(given[i]));
    nh_rates *rates = nh_rates_create(o.problem, &o.error);
    cr_expect_not_null(rates, "%s: %s", o.error.where, o.error.what);
    nh_simulation *motion = nh_simulate(o.problem, &o.error);
    cr_expect_not_null(motion, "%s: %s", o.error.where, o.error.what);
    nh_rates_free(rates);
    nh_simulation_free(motion);
    close_one(&o);
}

Test(library, a_motion_agrees_with_its_closed_form)
{
    opened o = open_one((nh_question){.system_text = oscillator, .set = "k=18", .initial = "x=1, x'=0", .until = 2, .step = 0.5, .accuracy = 1e-9});
    nh_simulation *s = nh_simulate(o.problem, &o.error);
    cr_assert_not_null(s, "%s", o.error.what);
    cr_assert_eq(nh_simulation_rows(s), 5u);
    cr_expect_str_eq(nh_simulation_column(s, 0), "t");
    cr_expect_str_eq(nh_simulation_column(s, 1), "x");
    for (size_t i = 0; i < nh_simulation_rows(s); i++) cr_expect_float_eq(nh_simulation_value(s, i, 1), cos(3 * nh_simulation_value(s, i, 0)), 1e-8);
    cr_expect(isnan(nh_simulation_value(s, 5, 1)));
    double x[5];
    nh_simulation_read(s, 1, x);
    for (size_t i = 0; i < 5; i++) cr_expect_eq(x[i], nh_simulation_value(s, i, 1));
    char *picture = nh_simulation_svg(s, 0, 1);
    cr_expect(picture && strstr(picture, "<svg") && strstr(picture, "</svg>") && !strstr(picture, "nan"));
    nh_string_free(picture);
    cr_expect_null(nh_simulation_svg(s, 0, nh_simulation_columns(s)));
    nh_simulation_free(s);
    close_one(&o);
}

/* m x'' + k x = u.  A table of a ramp, in 30 pieces, from rest where all is zero, u too: its sum has rounding, which is all that it has at first. */
Test(library, a_parameter_becomes_a_function_of_time)
{
    static const char driven[] = "name: driven\nparameters: [{name: k, value: 4}, {name: u, value: 0}]\ncoordinates: [x]\n"
                                 "lagrangian: x'^2/2 - k*x^2/2\nforces: [x = u]\n";
    const char *inputs[] = {"k*t", "input_of_library.csv:u"};
    FILE *table = fopen("input_of_library.csv", "w");
    cr_assert_not_null(table);
    fprintf(table, "t,u\n");
    for (int i = 0; i <= 30; i++) fprintf(table, "%.17g,%.17g\n", 0.1 * i, 0.4 * i + 1e-9 * (i % 2));
    fclose(table);
    for (size_t k = 0; k < 2; k++) {
        opened o = open_one((nh_question){.system_text = driven, .set = "k=4", .initial = "x=0, x'=0", .until = 3, .step = 0.5});
        cr_assert_not_null(o.problem, "%s", o.error.what);
        cr_expect_not(nh_problem_input(o.problem, "uu", "t", &o.error));
        cr_expect(strstr(o.error.what, "uu") && o.error.hint[0], "%s", o.error.what);
        cr_expect_not(nh_problem_input(o.problem, "u", "sin(tt)", &o.error));
        cr_expect_not(nh_problem_input(o.problem, "u", "nowhere.csv:u", NULL));
        cr_expect_eq(nh_problem_parameters(o.problem), 2u);
        cr_assert(nh_problem_input(o.problem, "u", inputs[k], &o.error), "%s", o.error.what);
        nh_simulation *s = nh_simulate(o.problem, &o.error);
        cr_assert_not_null(s, "%s", o.error.what);
        cr_assert_eq(nh_simulation_rows(s), 7u);
        for (size_t i = 0; i < 7; i++) {
            double t = nh_simulation_value(s, i, 0);
            cr_expect_float_eq(nh_simulation_value(s, i, 1), t - sin(2 * t) / 2, 1e-8);
        }
        nh_rates *rates = nh_rates_create(o.problem, &o.error);
        double a = 0;
        cr_assert_not_null(rates, "%s", o.error.what);
        nh_rates_at(rates, 1, (double[]){1.05}, (double[]){0.3}, (double[]){0}, &a);
        cr_expect_float_eq(a, 4 * 1.05 - 4 * 0.3, 1e-8);
        nh_rates_free(rates);
        nh_simulation_free(s);
        close_one(&o);
    }
    remove("input_of_library.csv");
}

Test(library, a_current_and_a_field_are_verified)
{
    opened o = open_one((nh_question){.system_text = oscillator});
    nh_verification *yes = nh_verify_current(o.problem, "m*x'^2/2 + k*x^2/2", &o.error), *no = nh_verify_current(o.problem, "x'", &o.error);
    nh_verification *field = nh_verify_field(o.problem, "Z0=1", &o.error);
    cr_assert(yes && no && field, "%s", o.error.what);
    cr_expect(nh_verification_holds(yes) && nh_verification_proved(yes));
    cr_expect(!nh_verification_holds(no));
    cr_expect(nh_verification_holds(field));
    char *latex = nh_verification_document(yes, NH_FORMAT_LATEX, &o.error);
    cr_expect(latex && strstr(latex, "\\end{document}"));
    nh_string_free(latex);
    nh_verification_free(yes);
    nh_verification_free(no);
    nh_verification_free(field);
    close_one(&o);
}

/* The oscillator with another force constant in y: more is conserved where the two agree. */
Test(library, a_parameter_is_classified)
{
    static const char two[] = "name: two\nparameters: [{name: k, value: 3}]\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + k*y^2)/2\n";
    opened o = open_one((nh_question){.system_text = two, .options = "degree=2"});
    nh_classified *c = nh_classify_over(o.problem, "k", false, &o.error);
    cr_assert_not_null(c, "%s", o.error.what);
    char *text = nh_classified_document(c, NH_FORMAT_TEXT, &o.error), *json = nh_classified_document(c, NH_FORMAT_JSON, &o.error);
    cr_expect(strstr(text, "k = 1"), "%s", text);
    cr_expect_eq(json[0], '{');
    nh_string_free(text);
    nh_string_free(json);
    char *page = nh_classified_document(c, NH_FORMAT_HTML, &o.error), *latex = nh_classified_document(c, NH_FORMAT_LATEX, &o.error);
    cr_expect(page && strstr(page, "</html>"));
    cr_expect(latex && strstr(latex, "\\end{document}"));
    nh_string_free(page);
    nh_string_free(latex);
    nh_classified_free(c);
    cr_expect_null(nh_classify_over(o.problem, "kk", false, &o.error));
    cr_expect_not_null(strstr(o.error.what, "kk"));
    close_one(&o);
}

/* Of two parameters: on a curve of the plane. */
Test(library, two_parameters_are_classified)
{
    static const char two[] = "name: two\nparameters: {k: 3, h: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - (h*x^2 + k*y^2)/2\n";
    opened o = open_one((nh_question){.system_text = two, .options = "degree=1"});
    nh_classified *c = nh_classify_over(o.problem, "k, h", false, &o.error);
    cr_assert_not_null(c, "%s", o.error.what);
    char *text = nh_classified_document(c, NH_FORMAT_TEXT, &o.error);
    cr_expect(strstr(text, "h - k = 0"), "%s", text);
    nh_string_free(text);
    nh_classified_free(c);
    cr_expect_null(nh_classify_over(o.problem, "k, h, k, h", false, &o.error));
    cr_expect_not_null(strstr(o.error.what, "more than three"));
    close_one(&o);
}

Test(library, methods_are_compared)
{
    opened o = open_one((nh_question){.system_text = oscillator, .initial = "x=1", .until = 3});
    nh_benchmark *b = nh_benchmark_methods(o.problem, &(nh_comparison){.seconds = 0.2}, &o.error);
    cr_assert_not_null(b, "%s", o.error.what);
    static const nh_format formats[] = {NH_FORMAT_TEXT, NH_FORMAT_JSON, NH_FORMAT_HTML};
    for (int f = 0; f < 3; f++) {
        char *text = nh_benchmark_document(b, formats[f], &o.error);
        cr_expect(text && strstr(text, "CVODE Adams"));
        nh_string_free(text);
    }
    nh_benchmark_free(b);
    close_one(&o);
}

/* Whatever goes wrong, or right: NULL in place of an error is allowed everywhere. */
Test(library, errors_may_be_null)
{
    static const char *const system[] = {skate, oscillator}, *const initial[] = {"x'=1", "x'=", "no = 1", NULL};
    nh_context *context = nh_context_create();
    cr_expect_null(nh_problem_open(context, &(nh_question){.system_text = "nonsense: ["}, NULL));
    for (size_t i = 0; i < 8; i++) {
        nh_problem *p = nh_problem_open(context, &(nh_question){.system_text = system[i % 2], .initial = initial[i / 2], .until = 1}, NULL);
        if (!p) continue;
        nh_analysis *a = i ? NULL : nh_analyze(p, NULL);
        nh_simulation *s = nh_simulate(p, NULL), *zeros = nh_simulate_zeros(p, "x = ", NULL, NULL);
        nh_reduction *r = nh_reduce(p, NULL);
        nh_verification *v = nh_verify_current(p, "x'*", NULL), *field = nh_verify_field(p, "Z0=", NULL);
        nh_classified *c = nh_classify_over(p, "nothing", false, NULL);
        nh_benchmark *b = nh_benchmark_methods(p, &(nh_comparison){.seconds = 0.01, .methods = i % 2 ? "rk8pd" : "no"}, NULL);
        nh_linearized *x = nh_linearize(p, "k", NULL);
        nh_rates *rates = nh_rates_create(p, NULL);
        if (s) nh_string_free(nh_simulation_document(s, NH_FORMAT_HTML, NULL));
        if (s) nh_string_free(nh_simulation_document(s, (nh_format)99, NULL));
        if (r) nh_string_free(nh_reduction_document(r, NH_FORMAT_CSV, NULL));
        nh_analysis_free(a);
        nh_simulation_free(s);
        nh_simulation_free(zeros);
        nh_reduction_free(r);
        nh_verification_free(v);
        nh_verification_free(field);
        nh_classified_free(c);
        nh_benchmark_free(b);
        nh_linearized_free(x);
        nh_rates_free(rates);
        nh_problem_free(p);
    }
    nh_string_free(nh_systems(NULL));
    nh_context_free(context);
}

/* As --method, --csv, --svg, --over and --project of the command; the result outlives its question. */
Test(library, named_methods_are_compared)
{
    opened o = open_one((nh_question){.system_text = skate, .initial = "phi=0.3, phi'=1, x'=1, y'=0.4", .until = 1, .project = true});
    nh_benchmark *b = nh_benchmark_methods(o.problem, &(nh_comparison){.seconds = 0.2, .methods = "rk8pd, dalembert"}, &o.error);
    cr_assert_not_null(b, "%s", o.error.what);
    cr_expect_null(nh_benchmark_methods(o.problem, &(nh_comparison){.methods = "rk8pd, dalembrt"}, &o.error));
    cr_expect(o.error.code == NH_USAGE && strstr(o.error.hint, "`dalembert`"), "%s", o.error.hint);
    cr_expect_null(nh_benchmark_methods(o.problem, &(nh_comparison){.methods = "rk8pd", .over = "b=1:2"}, &o.error));
    cr_expect_not_null(strstr(o.error.what, "--over"), "%s", o.error.what);
    nh_benchmark *map = nh_benchmark_methods(o.problem, &(nh_comparison){.seconds = 0.4, .over = "b=1:2:3"}, &o.error);
    cr_assert_not_null(map, "%s", o.error.what);
    close_one(&o);
    char *table = nh_benchmark_document(b, NH_FORMAT_CSV, &o.error), *picture = nh_benchmark_document(b, NH_FORMAT_SVG, &o.error), *json = nh_benchmark_document(map, NH_FORMAT_JSON, &o.error);
    cr_expect(strstr(table, ",observed_order,") && strstr(table, "Lagrange-d'Alembert") && !strstr(table, "Cash"), "%s", table);
    cr_expect_not_null(strstr(picture, "</svg>"));
    cr_expect_not_null(strstr(json, "\"axes\":\t[\"b\"]"), "%s", json);
    nh_string_free(table);
    nh_string_free(picture);
    nh_string_free(json);
    nh_benchmark_free(map);
    nh_benchmark_free(b);
}

Test(library, what_has_no_table_or_picture_says_so)
{
    opened o = open_one((nh_question){.system_text = oscillator});
    nh_verification *v = nh_verify_current(o.problem, "x'", &o.error);
    cr_assert_not_null(v, "%s", o.error.what);
    cr_expect_null(nh_verification_document(v, NH_FORMAT_SVG, &o.error));
    cr_expect(o.error.code == NH_USAGE && strstr(o.error.what, "no picture"), "%s", o.error.what);
    nh_verification_free(v);
    close_one(&o);
}

Test(library, formulas_are_typeset)
{
    char *latex = nh_formula_typeset("J*phi'^2/2", NH_SYNTAX_LATEX), *mathml = nh_formula_typeset("J*phi'^2/2", NH_SYNTAX_MATHML), *none = nh_formula_typeset("J*(", NH_SYNTAX_LATEX);
    cr_expect(latex && strstr(latex, "\\dot"), "%s", latex);
    cr_expect(mathml && strstr(mathml, "<mover"), "%s", mathml);
    cr_expect_null(none);
    nh_string_free(latex);
    nh_string_free(mathml);
}

/* As one text, and as files with names; the names begin with what was asked for. */
Test(library, functions_are_exported)
{
    opened o = open_one((nh_question){.system = "mine", .system_text = oscillator});
    nh_export *x = nh_export_functions(o.problem, "c", "equations, currents", NULL, "spring_2", &o.error);
    cr_assert_not_null(x, "%s", o.error.what);
    close_one(&o);
    char *name = NULL, *whole = nh_export_code(x, 0, NULL, &o.error);
    cr_expect(whole && strstr(whole, "int spring_2_accelerations("), "%s", whole);
    static const char *const files[] = {"spring_2.c", "spring_2.h"};
    for (size_t i = 0; i < 2; i++) {
        char *text = nh_export_code(x, i, &name, &o.error);
        cr_expect(text && strstr(text, "spring_2_currents(") && !strcmp(name, files[i]), "%s: %s", name, text);
        cr_expect_lt(strlen(text), strlen(whole));
        nh_string_free(text);
        nh_string_free(name);
    }
    cr_expect(!nh_export_code(x, 2, &name, &o.error) && !name && o.error.code == NH_OK);
    nh_string_free(whole);
    nh_export_free(x);
}

Test(library, what_cannot_be_exported_says_why)
{
    static const char *const wrong[][5] = {{"fortran", NULL, NULL, NULL, "no language `fortran`"}, {NULL, NULL, NULL, NULL, "no language is given"},
                                           {"c", "equation", NULL, NULL, "no part `equation`"},    {"c", NULL, "kk", NULL, "`kk` is not a parameter"},
                                           {"c", NULL, NULL, "2nd", "`2nd` is not a name"}};
    opened o = open_one((nh_question){.system = "mine", .system_text = oscillator});
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        cr_expect_null(nh_export_functions(o.problem, wrong[i][0], wrong[i][1], wrong[i][2], wrong[i][3], &o.error));
        cr_expect(o.error.code == NH_USAGE && strstr(o.error.what, wrong[i][4]) && *o.error.hint, "%s", o.error.what);
    }
    close_one(&o);
}

Test(library, the_systems_are_listed)
{
    nh_error error = {0};
    char *list = nh_systems(&error);
    cr_assert_not_null(list, "%s", error.what);
    cr_expect(strstr(list, "\nsleigh ") && strstr(list, " Chaplygin sleigh\n"), "%s", list);
    nh_string_free(list);
}

Test(library, errors_have_place_cause_and_cure)
{
    opened o = open_one((nh_question){.system = "mine", .system_text = "name: a\ncoordinates: [x]\nlagrangian: x'^2/2 - kk*x\n"});
    cr_assert_null(o.problem);
    cr_expect_eq(o.error.code, NH_INPUT);
    cr_expect_str_eq(o.error.where, "mine:3:22", "%s", o.error.where);
    cr_expect_not_null(strstr(o.error.what, "kk"));
    close_one(&o);
    o = open_one((nh_question){.system = "sleighs"});
    cr_assert_null(o.problem);
    cr_expect_not_null(strstr(o.error.hint, "sleigh"), "%s", o.error.hint);
    close_one(&o);
    const nh_question wrong[] = {{.system = "sleigh", .options = "seeed=3"}, {.system = "sleigh", .set = "m"}, {.system = "sleigh", .velocities = "fast"}, {.set = "m=2"}};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        o = open_one(wrong[i]);
        cr_expect_null(o.problem);
        cr_expect_eq(o.error.code, NH_USAGE, "%s", o.error.what);
        close_one(&o);
    }
}

/* ---- threads ---- */

/* The JSON of an analysis, seconds cut out. */
static char *timeless(char *json)
{
    char *out = json;
    for (char *in = json; *in;) {
        static const char key[] = "seconds\":";
        if (!strncmp(in, key, sizeof key - 1)) in += sizeof key - 1 + strcspn(in + sizeof key - 1, ",}\n");
        else *out++ = *in++;
    }
    *out = 0;
    char *timing = strstr(json, "\"timing\"");
    if (timing) memmove(timing, timing + strcspn(timing, "}"), strlen(timing + strcspn(timing, "}")) + 1);
    return json;
}

static void *analyse(void *question)
{
    opened o = open_one(*(nh_question *)question);
    nh_analysis *a = o.problem ? nh_analyze(o.problem, &o.error) : NULL;
    char *json = a ? timeless(nh_analysis_document(a, NH_FORMAT_JSON, &o.error)) : NULL;
    nh_analysis_free(a);
    close_one(&o);
    return json;
}

Test(library, two_contexts_work_at_once, PLAIN_ONLY)
{
    nh_question question[] = {{.system = "sleigh"}, {.system_text = oscillator}, {.system = "kepler", .options = "threads=2"}};
    enum { count = sizeof question / sizeof *question };
    pthread_t thread[count];
    char     *alone[count];
    for (size_t i = 0; i < count; i++) alone[i] = analyse(&question[i]);
    for (size_t i = 0; i < count; i++) cr_assert_eq(pthread_create(&thread[i], NULL, analyse, &question[i]), 0);
    for (size_t i = 0; i < count; i++) {
        void *beside;
        cr_assert_eq(pthread_join(thread[i], &beside), 0);
        cr_assert(alone[i] && beside);
        cr_expect_str_eq(alone[i], beside, "%s", question[i].system ? question[i].system : "text");
        nh_string_free(alone[i]);
        nh_string_free(beside);
    }
}

static void interrupt_at_once(void *data, const char *doing, double part)
{
    (void)doing;
    (void)part;
    nh_context_interrupt(data);
}

Test(library, an_interruption_ends_one_computation)
{
    opened o = open_one((nh_question){.system_text = oscillator});
    nh_context_on_progress(o.context, interrupt_at_once, o.context);
    nh_analysis *a = nh_analyze(o.problem, &o.error);
    cr_expect(!a || strcmp(nh_analysis_search(a), "complete"), "it was ended, and says that it is complete");
    nh_analysis_free(a);
    nh_context_on_progress(o.context, NULL, NULL);
    a = nh_analyze(o.problem, &o.error);
    cr_assert_not_null(a, "%s", o.error.what);
    cr_expect_str_eq(nh_analysis_search(a), "complete");
    nh_analysis_free(a);
    close_one(&o);
}

/* ---- documents and the example ---- */

Test(library, every_document_can_be_had)
{
    opened o = open_one((nh_question){.system = "sleigh", .until = 1});
    nh_analysis *a = nh_analyze(o.problem, &o.error);
    nh_reduction *r = nh_reduce(o.problem, &o.error);
    nh_simulation *s = nh_simulate(o.problem, &o.error);
    cr_assert(a && r && s, "%s", o.error.what);
    static const nh_format formats[] = {NH_FORMAT_TEXT, NH_FORMAT_JSON, NH_FORMAT_HTML, NH_FORMAT_LATEX};
    static const char *const begin[] = {"", "{", "<!DOCTYPE", ""};
    for (int f = 0; f < 4; f++) {
        char *text[] = {nh_analysis_document(a, formats[f], &o.error), nh_reduction_document(r, formats[f], &o.error), formats[f] == NH_FORMAT_LATEX ? NULL : nh_simulation_document(s, formats[f], &o.error)};
        for (int i = 0; i < 3; i++) {
            if (!text[i]) continue;
            cr_expect_gt(strlen(text[i]), 100u);
            cr_expect_eq(strncmp(text[i], begin[f], strlen(begin[f])), 0, "%.20s", text[i]);
            nh_string_free(text[i]);
        }
    }
    nh_analysis_free(a);
    nh_reduction_free(r);
    nh_simulation_free(s);
    close_one(&o);
}

Test(library, the_example_compiles_and_prints_the_currents, PLAIN_ONLY)
{
    char command[1000], line[2000], path[SCRATCH];
    bool momentum = false, energy = false;
    const char *build = getenv("NHSYM");
    FILE *example = fopen("docs/example.c", "r");
    size_t lines = 0;
    cr_assert_not_null(example);
    while (fgets(line, sizeof line, example)) lines++;
    fclose(example);
    cr_expect_leq(lines, 45u);
    scratch_name(path);
    cr_assert_not_null(mkdtemp(path));
    bool sane = build && strstr(build, "sanitize");
    snprintf(command, sizeof command, "${CC:-cc} -std=c17 -Wall -Wextra -Werror %s -Isrc docs/example.c build%s/libnhsym.a $(make -s --no-print-directory print-libraries) -o %s/example && %s/example; rm -r %s",
             sane ? "-fsanitize=address,undefined" : "", sane ? "-sanitize" : "", path, path, path);
    FILE *pipe = popen(command, "r");
    while (pipe && fgets(line, sizeof line, pipe)) {
        momentum |= strstr(line, "sin(phi/k)") != NULL;
        energy |= strstr(line, "(proved, ") != NULL;
    }
    cr_assert_eq(pclose(pipe), 0);
    cr_expect(momentum && energy);
}
