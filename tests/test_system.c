/* system: what a system file says, key by key, and the values that come of it.  (Refusals: test_bad.c.) */
#include <criterion/criterion.h>

#include <glob.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "names.h"
#include "graph/node.h"
#include "system/units.h"
#include "sweep.h"

/* Every key of FORMAT.md; numbers that are not found by accident. */
static const char ALL[] =
    "name: everything\n"
    "title: Všechno, \"quoted\"\n"
    "source: Čech & Musilová 2014, section 4\n"
    "doc: a remark\n"
    "parameters:\n"
    "  - {name: m, value: 2.385, unit: kg, doc: mass}\n"
    "  - {name: k, value: -.5, doc: \"k^2 = 1 + J/(m a^2)\"}\n"
    "  - {name: big, value: 1.25e3}\n"
    "coordinates:\n"
    "  - {name: phi, type: angle, doc: heading, unit: rad}\n"
    "  - {name: x, type: length}\n"
    "  - {name: y, type: number}\n"
    "  - z\n"
    "definitions:\n"
    "  - J = m*k^2 + 0.7\n"
    "  - T = J*phi'^2/2\n"
    "lagrangian: m/2*(x'^2 + y'^2) + T + 2^-1*m*z'^2\n"
    "  - big*1e-3*cos(phi - t)\n"
    "constraints:\n"
    "  - y' = x'*tan(phi)\n"
    "  - z - k*x = 0.3*t^2\n"
    "dependent: [y, z']\n"
    "velocities:\n"
    "  names: [omega, v]\n"
    "  map:\n"
    "    - y' = v*sin(phi)\n"
    "    - phi' = omega\n"
    "    - x' = v*cos(phi)\n"
    "    - z' = k*v*cos(phi) + 0.6*t\n"
    "forces:\n"
    "  - phi = -0.37*phi'\n"
    "  - x = J\n"
    "  - x = -x'^3\n"
    "domain:\n"
    "  phi: [-1.2, 1.1]\n"
    "  v: [-2, 3e0]\n"
    "  x': [0.5, 0.75]\n"
    "  t: [2, 7]\n"
    "known:\n"
    "  currents:\n"
    "    - {name: energy, expr: \"m/2*x'^2\", doc: not really}\n"
    "    - {name: hypot, expr: \"atan2(v, omega)\"}\n"
    "  not_conserved:\n"
    "    - {name: px, expr: m*x'}\n";

static const char *const STATE[] = {"t", "phi", "x", "y", "z", "phi'", "x'", "y'", "z'", "omega", "v"};
static const double VALUE[] = {0.83, 0.41, -1.7, 0.92, 0.26, 1.31, -0.77, 0.58, 2.03, 0.47, -1.19};
enum { state_count = 11 };

/* The value of an expression of ALL at STATE. */
static double at(const nh_system *s, nh_ex e) { return value_of(s, e, state_count, STATE, VALUE); }

static nh_system *everything(void) { return system_of(ALL); }

#define near(a, b) cr_expect(fabs((a) - (b)) <= 1e-13 * (1 + fabs(b)), "%.17g is not %.17g", (double)(a), (double)(b))

Test(system, texts)
{
    nh_system *s = everything();
    cr_expect_str_eq(s->name, "everything");
    cr_expect_str_eq(s->title, "Všechno, \"quoted\"");
    cr_expect_str_eq(s->source, "Čech & Musilová 2014, section 4");
    cr_expect_str_eq(s->parameter[0].unit, "kg");
    cr_expect_str_eq(s->parameter[0].doc, "mass");
    cr_expect_str_eq(s->parameter[1].unit, "");
    cr_expect_str_eq(s->parameter[1].doc, "k^2 = 1 + J/(m a^2)");
    cr_expect_str_eq(s->coordinate[0].doc, "heading");
    cr_expect_str_eq(s->coordinate[1].doc, "");
    cr_expect_str_eq(s->constraint[1].text, "z - k*x = 0.3*t^2");
    nh_system_free(s);
}

Test(system, parameters_and_coordinates)
{
    nh_system *s = everything();
    cr_assert_eq(s->parameters, 3u);
    cr_expect_str_eq(s->parameter[1].name, "k");
    cr_expect_eq(s->parameter[0].value, 2.385);
    cr_expect_eq(s->parameter[1].value, -0.5);
    cr_expect_eq(s->parameter[2].value, 1250.0);
    cr_assert_eq(s->coordinates, 4u);
    cr_expect_eq(s->coordinate[0].type, NH_ANGLE);
    cr_expect_eq(s->coordinate[1].type, NH_LENGTH);
    cr_expect_eq(s->coordinate[2].type, NH_PLAIN);
    cr_expect_eq(s->coordinate[3].type, NH_PLAIN);
    cr_expect_str_eq(s->coordinate[3].name, "z");
    cr_expect_str_eq(nh_name_of(s->dag, s->coordinate[2].v), "y'");
    cr_expect_eq(nh_system_coordinate(s, "z"), 3);
    cr_expect_eq(nh_system_coordinate(s, "zz"), -1);
    nh_system_free(s);
}

Test(system, definitions_and_lagrangian)
{
    nh_system *s = everything();
    double J = 2.385 * 0.25 + 0.7, T = J * 1.31 * 1.31 / 2;
    cr_assert_eq(s->definitions, 2u);
    cr_expect_str_eq(s->definition[1].name, "T");
    near(at(s, s->definition[0].value), J);
    near(at(s, s->definition[1].value), T);
    near(at(s, s->lagrangian), 2.385 / 2 * (0.77 * 0.77 + 0.58 * 0.58 + 2.03 * 2.03) + T - 1.25 * cos(0.41 - 0.83));
    nh_system_free(s);
}

/* The rate of a definition is the sum of its derivatives times the velocities, by t too. */
Test(system, rates_of_definitions)
{
    nh_system *a = system_of("coordinates: [q, x]\nparameters: [{name: l, value: 0.7}]\ndefinitions: [\"X = x + l*sin(q)*t\", \"Y = X^2\"]\nlagrangian: X'^2 + x'*Y'\n");
    nh_system *b = system_of("coordinates: [q, x]\nparameters: [{name: l, value: 0.7}]\n"
                             "lagrangian: (x' + l*cos(q)*q'*t + l*sin(q))^2 + 2*x'*(x + l*sin(q)*t)*(x' + l*cos(q)*q'*t + l*sin(q))\n");
    static const char *const name[] = {"t", "q", "x", "q'", "x'"};
    static const double value[] = {0.83, 0.41, -1.7, 1.31, -0.77};
    double x = value_of(a, a->lagrangian, 5, name, value);
    near(x, value_of(b, b->lagrangian, 5, name, value));
    cr_expect(fabs(x) > 0.01, "%g", x);
    nh_system_free(a);
    nh_system_free(b);
}

Test(system, constraints_and_dependent)
{
    nh_system *s = everything();
    cr_assert_eq(s->constraints, 2u);
    cr_expect_not(s->constraint[0].position);
    cr_expect(s->constraint[1].position, "an equation between positions is differentiated");
    near(at(s, s->constraint[0].lhs), 0.58);
    near(at(s, s->constraint[0].rhs), -0.77 * tan(0.41));
    near(at(s, s->constraint[1].lhs) - at(s, s->constraint[1].rhs), 2.03 - 0.5 * 0.77 - 0.6 * 0.83);
    cr_assert_eq(s->dependents, 2u);
    cr_expect_eq(s->dependent[0], 2u);
    cr_expect_eq(s->dependent[1], 3u);
    nh_system_free(s);
}

Test(system, chart_in_any_order)
{
    nh_system *s = everything();
    cr_assert_eq(s->quasi, 2u);
    cr_expect_str_eq(nh_name_of(s->dag, s->quasi_velocity[0]), "omega");
    cr_expect_str_eq(nh_name_of(s->dag, s->quasi_velocity[1]), "v");
    near(at(s, s->quasi_map[0]), 0.47);
    near(at(s, s->quasi_map[1]), -1.19 * cos(0.41));
    near(at(s, s->quasi_map[2]), -1.19 * sin(0.41));
    near(at(s, s->quasi_map[3]), 0.5 * 1.19 * cos(0.41) + 0.6 * 0.83);
    nh_system_free(s);
}

Test(system, forces_add_up)
{
    nh_system *s = everything();
    cr_expect(s->has_forces);
    near(at(s, s->force[0]), -0.37 * 1.31);
    near(at(s, s->force[1]), 2.385 * 0.25 + 0.7 + 0.77 * 0.77 * 0.77);
    cr_expect(nh_is_zero(s->dag, s->force[2]));
    cr_expect(nh_is_zero(s->dag, s->force[3]));
    nh_system_free(s);
}

Test(system, domain)
{
    static const struct { const char *name; double low, high; } expected[] = {{"phi", -1.2, 1.1}, {"v", -2, 3}, {"x'", 0.5, 0.75}, {"t", 2, 7}};
    nh_system *s = everything();
    cr_assert_eq(s->intervals, 4u);
    for (size_t i = 0; i < 4; i++) {
        cr_expect_str_eq(nh_name_of(s->dag, s->interval[i].symbol), expected[i].name);
        cr_expect_eq(s->interval[i].low, expected[i].low);
        cr_expect_eq(s->interval[i].high, expected[i].high);
    }
    nh_system_free(s);
}

Test(system, known)
{
    nh_system *s = everything();
    cr_assert_eq(s->currents, 2u);
    cr_assert_eq(s->not_conserved, 1u);
    cr_expect_str_eq(s->current[0].name, "energy");
    cr_expect_str_eq(s->current[0].text, "m/2*x'^2");
    cr_expect_str_eq(s->trap[0].name, "px");
    near(at(s, s->current[0].value), 2.385 / 2 * 0.77 * 0.77);
    near(at(s, s->current[1].value), atan2(-1.19, 0.47));
    near(at(s, s->trap[0].value), -2.385 * 0.77);
    nh_system_free(s);
}

/* ---- what may be left out ---- */

Test(system, the_least_that_is_a_system)
{
    nh_system *s = system_of("coordinates: [x]\nlagrangian: x'^2/2\n");
    cr_expect_str_eq(s->name, "test");
    cr_expect_str_eq(s->title, "test", "without a title, the name");
    cr_expect_str_eq(s->source, "");
    cr_expect_eq(s->parameters + s->constraints + s->dependents + s->quasi + s->definitions + s->intervals + s->currents + s->not_conserved, 0u);
    cr_expect_not(s->has_forces);
    cr_expect(nh_is_zero(s->dag, s->force[0]));
    nh_system_free(s);
    nh_system_free(NULL);
}

Test(system, flow_and_block_styles_mean_the_same)
{
    nh_system *a = system_of("parameters: [{name: m, value: 2.5}]\ncoordinates: [x, y]\nlagrangian: m*x'^2*y'^2\nconstraints: [\"y' = x*x'\"]\n");
    nh_system *b = system_of("parameters:\n- name: m\n  value: 2.5\ncoordinates:\n- x\n- name: y\nlagrangian: >-\n  m*x'^2\n  *y'^2\n"
                             "constraints:\n- 'y'' = x*x'''\n");
    static const char *const names[] = {"x", "x'", "y'"};
    static const double values[] = {1.3, 0.7, -0.4};
    cr_expect_eq(b->coordinates, 2u);
    near(value_of(b, b->lagrangian, 3, names, values), value_of(a, a->lagrangian, 3, names, values));
    near(value_of(b, b->constraint[0].rhs, 3, names, values), 1.3 * 0.7);
    cr_expect_str_eq(b->constraint[0].text, "y' = x*x'");
    nh_system_free(a);
    nh_system_free(b);
}

/* Expressions as anywhere else: precedence, signs, numbers, all functions. */
Test(system, the_whole_expression_language)
{
    static const struct { const char *text; double value; } list[] = {
        {"-x^2", -1.69}, {"2^-1*x", 0.65}, {"x^2^0.5", 0}, {"1e-3 + .5 + 2.", 2.501}, {"6/x/2", 3 / 1.3}, {"x - y - 1", 1.3 + 0.4 - 1},
        {"+-+x", -1.3}, {"2*pi", 6.283185307179586}, {"exp(1)^2", 7.38905609893065}, {"log(x)", 0}, {"atan2(y, -x)", 0}, {"abs(y) + sqrt(x)", 0},
        {"sinh(x) + cosh(y) + tanh(x)", 0}, {"asinh(x) + acosh(x) + atanh(y)", 0}, {"asin(y) + acos(y) + atan(x)", 0}, {"sin(x)*cos(x)*tan(x)", 0},
    };
    double x = 1.3, y = -0.4, special[16];
    static const char *const names[] = {"x", "y"};
    double values[] = {x, y};
    nh_system *s = system_of("coordinates: [x, y]\nlagrangian: x'^2 + y'^2\n");
    for (size_t i = 0; i < 16; i++) special[i] = list[i].value;
    special[2] = pow(x, pow(2, 0.5));
    special[9] = log(x);
    special[10] = atan2(y, -x);
    special[11] = fabs(y) + sqrt(x);
    special[12] = sinh(x) + cosh(y) + tanh(x);
    special[13] = asinh(x) + acosh(x) + atanh(y);
    special[14] = asin(y) + acos(y) + atan(x);
    special[15] = sin(x) * sin(x);
    for (size_t i = 0; i < 16; i++) {
        double got = value_of(s, expression_of(s, list[i].text), 2, names, values);
        cr_expect(fabs(got - special[i]) < 1e-14 * (1 + fabs(special[i])), "%s is %.17g, not %.17g", list[i].text, got, special[i]);
    }
    nh_system_free(s);
}

/* ---- settings ---- */

/* 1/3 as a value, a range's end: exact, for what needs exact values. */
Test(system, numbers_may_be_ratios)
{
    nh_error error = {0};
    nh_system *s = nh_system_parse("ratio.yaml",
                                   "name: r\nparameters: {k: 1/3, b: -5/2}\ncoordinates: [x]\nlagrangian: x'^2/2 - k*x^2 - b*x\ndomain: {x: [1/4, 3/4]}\n",
                                   0, NULL, &error);
    cr_assert_not_null(s, "%s", error.what);
    cr_expect_eq(s->parameter[0].value, 1.0 / 3);
    cr_expect_eq(s->parameter[1].value, -2.5);
    nh_system_free(s);
    cr_assert_null(nh_system_parse("ratio.yaml", "name: r\nparameters: {k: 1/0}\ncoordinates: [x]\nlagrangian: x'^2/2 - k*x^2\n", 0, NULL, &error));
    cr_expect_str_eq(error.what, "the value of a parameter must be a number, found `1/0`");
}

Test(system, settings_override_values)
{
    nh_error error = {0};
    nh_setting set[] = {{.name = "k", .value = 3.25}, {.name = "m", .value = 0.125}, {.name = "k", .value = 4.5}};
    nh_system *s = nh_system_parse("all.yaml", ALL, 3, set, &error);
    must(s != NULL, &error, "settings");
    cr_expect_eq(s->parameter[0].value, 0.125);
    cr_expect_eq(s->parameter[1].value, 4.5, "the last setting counts");
    cr_expect_eq(s->parameter[2].value, 1250.0);
    near(at(s, s->definition[0].value), 0.125 * 4.5 * 4.5 + 0.7);
    nh_system_free(s);
}

Test(system, settings_of_unknown_parameters_are_refused)
{
    nh_error error = {0};
    char text[1000];
    nh_setting set[] = {{.name = "bgi", .value = 3}, {.name = "phi", .value = 1}};
    cr_assert_null(nh_system_parse("all.yaml", ALL, 1, set, &error));
    cr_expect_eq(error.code, NH_USAGE);
    nh_error_format(&error, text, sizeof text);
    cr_expect_str_eq(text, "`bgi` is not a parameter of everything\nhint: did you mean `big`?");
    nh_error_clear(&error);
    cr_assert_null(nh_system_parse("all.yaml", ALL, 1, set + 1, &error), "a coordinate is no parameter");
    cr_expect_eq(error.code, NH_USAGE);
}

/* ---- expressions from elsewhere ---- */

Test(system, expressions_know_the_systems_names_and_the_extra_ones)
{
    nh_error error = {0};
    nh_system *s = everything();
    nh_named extra = {.name = "E", .value = s->lagrangian};
    nh_ex e;
    must(nh_system_expression_text(s, "--current", "2*E + J*omega - x'", 1, &extra, &e, &error), &error, "with E");
    near(at(s, e), 2 * at(s, s->lagrangian) + (2.385 * 0.25 + 0.7) * 0.47 + 0.77);
    cr_expect_not(nh_system_expression_text(s, "--current", "x + sin(E", 0, NULL, &e, &error), "E is not declared here");
    cr_expect_str_eq(error.where, "--current:9");
    cr_expect_str_eq(error.what, "unknown name `E`");
    cr_expect_str_eq(error.excerpt, "  x + sin(E\n          ^");
    nh_system_free(s);
}

Test(system, bindings_are_the_parameters)
{
    nh_system *s = everything();
    const nh_ex *symbols;
    const double *values;
    nh_system_bindings(s, &symbols, &values);
    for (size_t i = 0; i < s->parameters; i++) {
        cr_expect_eq(symbols[i], s->parameter[i].symbol);
        cr_expect_eq(values[i], s->parameter[i].value);
    }
    nh_system_free(s);
}

/* A file and its text are read alike. */
Test(system, the_systems_that_ship_are_read)
{
    nh_error error = {0};
    nh_system *s = nh_system_read("systems/sleigh.yaml", 0, NULL, &error);
    must(s != NULL, &error, "systems/sleigh.yaml");
    cr_expect_eq(s->coordinates, 3u);
    cr_expect_eq(s->constraints, 1u);
    cr_expect_eq(s->quasi, 2u);
    cr_expect_geq(s->currents, 3u);
    nh_system_free(s);
}

/* Units of the SI with prefixes, products, quotients and powers; what is none is pointed at. */
Test(system, units)
{
    static const char *const good[] = {"", "1", "m", "kg m^2", "kg*m^2", "N/m", "1/s", "1/s^2", "rad/s", "kg/(m s)", "m^(1/2)", "m^-1", "kg\u00b7m\u00b2", "s\u207b\u00b9", "\u00b5m", "mmol", "deg", "\u00b0",
                                       "N m s/rad", "GHz", "eV", "(kg m)/s^2", "%"};
    static const struct {
        const char *text, *nearest;
        size_t offset, length;
    } bad[] = {{"banana", NULL, 0, 6}, {"kg metre", "m", 3, 5}, {"N/", NULL, 2, 1}, {"kg^x", NULL, 3, 1}, {"(m", NULL, 0, 1}, {"m)", NULL, 1, 1}, {"kkg", "kg", 0, 3}, {"2 m", NULL, 0, 1}, {"m^2^2", NULL, 3, 1}, {"kmin", "min", 0, 4}};
    for (size_t i = 0; i < sizeof good / sizeof *good; i++) {
        nh_unit_fault fault = {0};
        cr_expect(nh_is_unit(good[i], &fault), "`%s` is refused at %zu", good[i], fault.offset);
    }
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        nh_unit_fault fault = {0};
        cr_expect_not(nh_is_unit(bad[i].text, &fault), "`%s`", bad[i].text);
        cr_expect(fault.offset == bad[i].offset && fault.length == bad[i].length, "`%s`: %zu, %zu", bad[i].text, fault.offset, fault.length);
        cr_expect(bad[i].nearest ? fault.nearest && !strcmp(fault.nearest, bad[i].nearest) : !fault.nearest, "`%s`: %s", bad[i].text, fault.nearest ? fault.nearest : "nothing");
    }
}

/* Terms of other units than the terms beside them are told, with both units; numbers that are added, and symbols without a unit, may have any. */
Test(system, units_of_terms)
{
    static const struct {
        const char *parameters, *coordinates, *rest, *told; /* NULL: nothing is */
    } cases[] = {
        {"m: {value: 1, unit: kg}, k: {value: 1, unit: N/m}", "{name: x, type: length}", "lagrangian: m*x'^2/2 - k*x^2/2", NULL},
        {"m: {value: 1, unit: kg}, k: {value: 1, unit: N/m}", "{name: x, type: length}", "lagrangian: m*x'^2/2 - k*x/2", "kg m^2/s^2, and `k*x` has kg m/s^2"},
        {"m: {value: 1, unit: kg}", "{name: x, type: length}", "lagrangian: m*x'^2/2 - 9.81*m*x", "`m*x'^2` has the unit kg m^2/s^2, and `m*x` has kg m"},
        {"m: {value: 1, unit: kg}, k: 3", "{name: x, type: length}", "lagrangian: m*x'^2/2 - k*x^2/2", NULL},
        {"m: {value: 1, unit: kg}, l: {value: 1, unit: m}, g: {value: 1, unit: m/s^2}", "{name: a, type: angle}", "lagrangian: m*l^2*a'^2/2 + m*g*l*(cos(a) - 1)", NULL},
        {"m: {value: 1, unit: kg}, l: {value: 1, unit: m}, g: {value: 1, unit: m/s^2}", "{name: a, unit: deg}", "lagrangian: m*l^2*a'^2/2 + m*g*l*cos(a)", "`a`, the argument of a function, has the unit 0.0174533"},
        {"m: {value: 1, unit: g}, k: {value: 1, unit: N/m}", "{name: x, unit: m}", "lagrangian: m*x'^2/2 - k*x^2/2", "0.001 kg m^2/s^2, and `k*x^2` has kg m^2/s^2"},
        {"m: {value: 1, unit: kg}, G: {value: 1, unit: au^3/yr^2}", "{name: x, unit: au}", "lagrangian: m*x'^2/2 + m*G/abs(x)", NULL},
        {"m: {value: 1, unit: kg}, w: {value: 1, unit: 1/s}", "{name: x, type: length}", "lagrangian: m*x'^2/2 - m*x^2/2*w^2*cos(w*t)", NULL},
        {"m: {value: 1, unit: kg}, w: {value: 1, unit: s}", "{name: x, type: length}", "lagrangian: m*x'^2/2 - m*x'^2/2*cos(w*t)", "`t*w`, the argument of a function, has the unit s^2"},
        {"m: {value: 1, unit: kg}, c: {value: 1, unit: kg/s}", "{name: x, type: length}", "lagrangian: m*x'^2/2\nforces: [\"x = -c*x'\"]", NULL},
        {"m: {value: 1, unit: kg}, c: {value: 1, unit: kg/m}", "{name: x, type: length}", "lagrangian: m*x'^2/2\nforces: [\"x = -c*x'\"]", "the force on x do not agree: `-c*x'` has the unit kg/s, and the Lagrangian by the coordinate kg m/s^2"},
        {"m: {value: 1, unit: kg}, R: {value: 1, unit: m}", "{name: x, type: length}, {name: a, type: angle}", "lagrangian: m*x'^2/2 + m*R^2*a'^2/2\nconstraints: [\"x' = R*a'\"]", NULL},
        {"m: {value: 1, unit: kg}, R: {value: 1, unit: m}", "{name: x, type: length}, {name: a, type: angle}", "lagrangian: m*x'^2/2 + m*R^2*a'^2/2\nconstraints: [\"x' = a'\"]", "a constraint do not agree: `x'` has the unit m/s, and `a'` has 1/s"},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        char text[600];
        nh_error error = {0};
        snprintf(text, sizeof text, "name: s\nparameters: {%s}\ncoordinates: [%s]\n%s\n", cases[i].parameters, cases[i].coordinates, cases[i].rest);
        nh_system *s = nh_system_parse("s", text, 0, NULL, &error);
        must(s != NULL, &error, text);
        cr_expect_eq(s->notes, (size_t)(cases[i].told != NULL), "%s: %s", text, s->notes ? s->note[0] : "nothing");
        if (cases[i].told && s->notes) cr_expect(strstr(s->note[0], cases[i].told), "%s: %s", text, s->note[0]);
        nh_system_free(s);
    }
}

Test(system, units_of_the_systems_that_ship_agree, PLAIN_ONLY)
{
    glob_t found;
    size_t some = 0;
    cr_assert_eq(glob("systems/*.yaml", 0, NULL, &found), 0);
    for (size_t i = 0; i < found.gl_pathc; i++) {
        nh_error error = {0};
        nh_system *s = nh_system_read(found.gl_pathv[i], 0, NULL, &error);
        must(s != NULL, &error, found.gl_pathv[i]);
        for (size_t k = 0; k < s->notes; k++) cr_expect(!strstr(s->note[k], "units in"), "%s", s->note[k]);
        for (size_t k = 0; k < s->parameters; k++) some += *s->parameter[k].unit != 0;
        nh_system_free(s);
    }
    cr_expect_geq(some, 30u, "they have units");
    globfree(&found);
}
