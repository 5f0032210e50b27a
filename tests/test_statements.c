/* What `analyze` and `verify` say: text, page, LaTeX and JSON say the same, each word means what it says, and nothing is said of what it does not hold for. */
#include <cjson/cJSON.h>

#include "program.h"
#include "sweep.h"

/* ---- the reports of one run ---- */

typedef struct {
    char *text, *page, *tex, *source;
    cJSON *json;
} reports;

static char *read_or_fail(const place *p, const char *name)
{
    char *text = read_here(p, name);
    cr_assert_not_null(text, "no file %s", name);
    return text;
}

static reports analyze(const place *p, const char *system)
{
    char line[300];
    snprintf(line, sizeof line, "analyze -v %s --json a.json --html a.html --tex a.tex", system);
    finished f = run_expecting(p, line, 0);
    reports r = {.text = f.out, .page = read_or_fail(p, "a.html"), .tex = read_or_fail(p, "a.tex"), .source = read_or_fail(p, "a.json")};
    free(f.err);
    r.json = cJSON_Parse(r.source);
    unfold(r.text);
    cr_assert_not_null(r.json, "%s", line);
    return r;
}

static reports verify(const place *p, const char *question, int code)
{
    char line[400];
    reports r = {0};
    snprintf(line, sizeof line, "verify -v %s --json a.json --html a.html", question);
    finished f = run_expecting(p, line, code);
    r.text = f.out;
    free(f.err);
    r.page = read_or_fail(p, "a.html");
    r.source = read_or_fail(p, "a.json");
    r.json = cJSON_Parse(r.source);
    unfold(r.text);
    cr_assert_not_null(r.json, "%s", line);
    return r;
}

static void reports_clear(reports *r)
{
    cJSON_Delete(r->json);
    free(r->text);
    free(r->page);
    free(r->tex);
    free(r->source);
}

static size_t occurrences(const char *text, const char *words)
{
    size_t n = 0;
    for (const char *at = text; (at = strstr(at, words)); at += strlen(words)) n++;
    return n;
}

static const cJSON *item(const cJSON *of, const char *key)
{
    const cJSON *found = cJSON_GetObjectItemCaseSensitive(of, key);
    cr_assert_not_null(found, "no key %s", key);
    return found;
}

/* ---- words ---- */

/* A current's Z may be free of velocities along time and space without being a symmetry of the equations of motion: the word is projectable. */
Test(statements, projectable_is_said_alike, PLAIN_ONLY)
{
    place p = place_with_systems();
    reports r = analyze(&p, "sleigh");
    size_t projectable = 0, third = 0, both = 0;
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents"))
    {
        bool is = cJSON_IsTrue(item(current, "projectable")), case_3 = item(current, "case")->valueint == 3;
        projectable += is;
        third += case_3;
        both += is && case_3;
    }
    cr_assert(projectable > 0 && both > 0);
    cr_expect_eq(occurrences(r.text, "; Z is projectable\n"), projectable);
    cr_expect_eq(occurrences(r.page, "; <math><mi>Z</mi></math> is projectable</dd>"), projectable);
    cr_expect_eq(occurrences(r.tex, "; $Z$ is projectable\\par"), projectable);
    cr_expect_eq(occurrences(r.text, "Z is not a symmetry of the equations of motion, nor is [Gamma,Z] = a Gamma + b Z (case 3)"), third);
    cr_expect_eq(occurrences(r.tex, "$Z$ is not a symmetry of the equations of motion, nor is $[\\Gamma, Z] = a \\Gamma + b Z$ (case 3)"), third);
    cr_expect(!strstr(r.text, "point symmetry") && !strstr(r.page, "point symmetry") && !strstr(r.tex, "point symmetry"));
    reports_clear(&r);
    r = verify(&p, "sleigh --current m*(v*sin(phi/k)+a*k*omega*cos(phi/k))", 0);
    cr_expect(cJSON_IsTrue(item(item(r.json, "symmetry"), "projectable")));
    cr_expect(strstr(r.text, "Z is projectable") && strstr(r.page, "</math> is projectable"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* Semiholonomic is a property of linear and affine constraints: of nonlinear ones nothing is said. */
Test(statements, semiholonomic_is_for_constraints_that_it_is_defined_for, PLAIN_ONLY)
{
    place p = place_with_systems();
    reports r = analyze(&p, "constant_speed");
    cr_expect(cJSON_IsNull(item(item(r.json, "constraint"), "semiholonomic")), "%s", cJSON_Print(item(r.json, "constraint")));
    cr_expect(!strstr(r.text, "semiholonomic") && !strstr(r.page, "semiholonomic") && !strstr(r.tex, "semiholonomic"));
    reports_clear(&r);
    write_here(&p, "plane.yaml", "name: plane\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
                                 "lagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z' = y*x' + x*y'\"]\n");
    r = analyze(&p, "plane.yaml");
    cr_expect(cJSON_IsTrue(item(item(r.json, "constraint"), "semiholonomic")));
    reports_clear(&r);
    place_clear(&p);
}

/* The kind of the constraints in the same words. */
Test(statements, the_constraints_are_named_alike)
{
    static const char *const systems[] = {"appell_hamel", "skate_on_belt", "sleigh", "bead_on_turning_wire"};
    place p = place_with_systems();
    for (size_t s = 0; s < sizeof systems / sizeof *systems; s++) {
        if (!sweep_tries(s + 1, 3, 6)) continue;
        reports r = analyze(&p, systems[s]);
        const cJSON *c = item(r.json, "constraint");
        const char *type = item(c, "type")->valuestring;
        bool homogeneous = !strcmp(type, "nonlinear") && cJSON_IsTrue(item(c, "homogeneous")), moving = cJSON_IsTrue(item(c, "rheonomic"));
        const char *const all[] = {r.text, r.page, r.tex};
        for (size_t i = 0; i < 3; i++) {
            char words[100];
            snprintf(words, sizeof words, "%s%s constraint", homogeneous ? "homogeneous " : "", type);
            cr_expect_not_null(strstr(all[i], words), "%s: report %zu does not say %s", systems[s], i, words);
            cr_expect_eq(strstr(all[i], ", time-{}dependent") || strstr(all[i], ", time-dependent"), moving, "%s: report %zu", systems[s], i);
            cr_expect_not_null(strstr(all[i], item(c, "integrability")->valuestring), "%s: report %zu", systems[s], i);
        }
        reports_clear(&r);
    }
    place_clear(&p);
}

/* What does not change does not fall. */
Test(statements, a_drift_of_zero_is_zero)
{
    place p = place_with_systems();
    reports r = analyze(&p, "relativistic_particle");
    size_t zero = 0;
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents")) zero += item(current, "drift")->valuedouble == 0;
    cr_assert_gt(zero, 0u);
    cr_expect_eq(occurrences(r.page, "; it does not change at all</dd>"), zero);
    reports_clear(&r);
    place_clear(&p);
}

/* ---- fields ---- */

/* Every component and every i_[Gamma,Z] phi^a of the text is in the document and on the page. */
Test(statements, a_field_is_complete_in_every_report, PLAIN_ONLY)
{
    static const char *const systems[] = {"sleigh", "constant_speed", "skate_on_belt", "relativistic_particle", "appell_hamel"};
    place p = place_with_systems();
    for (size_t s = 0; s < sizeof systems / sizeof *systems; s++) {
        if (!sweep_tries(s + 3, 4, 8)) continue;
        reports r = analyze(&p, systems[s]);
        size_t along = occurrences(r.text, "d/d"), components = occurrences(r.text, "\n  Z_"), forms = occurrences(r.text, "\n  i_[Gamma,Z] phi^");
        cr_assert_gt(along + components, 0u);
        cr_expect_eq(occurrences(r.tex, "\\frac{\\partial }{\\partial "), along, "%s: Z along %zu directions in the text", systems[s], along);
        cr_expect_eq(occurrences(r.page, "<mfrac><mrow><mo>\u2202</mo></mrow>"), along, "%s: Z along %zu directions in the text", systems[s], along);
        cr_expect_eq(occurrences(r.tex, "\\nhformula{{Z}_{") + occurrences(r.tex, "\\par ${Z}_{"), components, "%s: %zu components in the text", systems[s], components);
        cr_expect_eq(occurrences(r.page, "<msub><mrow><mi>Z</mi></mrow><mrow>"), components, "%s: %zu components in the text", systems[s], components);
        cr_expect_eq(occurrences(r.tex, "\\nhformula{{i}_{[\\Gamma ,Z]}"), forms, "%s: %zu forms", systems[s], forms);
        size_t defined = occurrences(r.text, "\n  phi^");
        cr_expect(!forms == !defined && defined <= 2, "%s: the forms are defined once", systems[s]);
        cr_expect_eq(occurrences(r.page, "<mi>\u03d5</mi>"), forms + defined, "%s: %zu forms", systems[s], forms);
        reports_clear(&r);
    }
    place_clear(&p);
}

/* Components of [Gamma,Z] outside of the distribution belong to the forms that are printed: those of the geometry, where it is shown. */
Test(statements, the_forms_of_the_currents_are_those_of_the_geometry, WHOLE_ONLY)
{
    static const char sleigh[] = "name: own\nparameters: [{name: m, value: 2}, {name: J, value: 0.9}, {name: a, value: 0.6}]\n"
                                 "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: phi, type: angle}]\n"
                                 "lagrangian: m/2*((x' - a*phi'*sin(phi))^2 + (y' + a*phi'*cos(phi))^2) + J/2*phi'^2\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n"
                                 "velocities: {names: [omega, v], map: [\"phi' = omega\", \"x' = v*cos(phi)\", \"y' = v*sin(phi)\"]}\n";
    place p = place_make();
    write_here(&p, "own.yaml", sleigh);
    for (size_t geometry = 0; geometry < 2; geometry++) {
        reports r = analyze(&p, geometry ? "own.yaml --equations" : "own.yaml");
        cr_expect_eq(occurrences(r.text, "\n  phi^1 = -sin(phi) dx + cos(phi) dy\n"), !geometry, "%s", r.text);
        cr_expect_eq(occurrences(r.text, "\n  phi^1 = -tan(phi) dx + dy\n"), 2 * geometry, "%s", r.text);
        cr_expect_eq(occurrences(r.text, "\n  i_[Gamma,Z] phi^1 = -sqrt(m*v^2 + omega^2*(J + m*a^2))/(m*omega)\n"), !geometry, "%s", r.text);
        cr_expect_eq(occurrences(r.text, "\n  i_[Gamma,Z] phi^1 = -sqrt(m*v^2 + omega^2*(J + m*a^2))/(m*omega*cos(phi))\n"), geometry, "%s", r.text);
        /* S: the sum below the root */
        cr_expect_eq(occurrences(r.text, "\n  i_[Gamma,Z(Phi3)]phi^1 = -sqrt(S_"), geometry, "%s", r.text);
        cr_expect_eq(occurrences(r.text, ")/(m*omega*cos(phi))\n"), 2 * geometry, "%s", r.text);
        cr_expect_eq(occurrences(r.text, ") phi'' = 0\n") + occurrences(r.text, ") zeta^phi = 0\n"), 4 * geometry);
        cr_expect(!strstr(r.text, "(-J - m*a^2)"), "a sum of negative terms is minus a sum");
        reports_clear(&r);
    }
    place_clear(&p);
}

/* A slope of 0.3: what stands in the file stands in the formulas, and not the sine of a tenth. */
Test(statements, the_sine_of_a_number_stays, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "own.yaml", "name: own\nparameters: {m: 1, J: 0.4, g: 2}\ncoordinates: [x, y, {name: h, type: angle}]\n"
               "lagrangian: m*(x'^2 + y'^2)/2 + J*h'^2/2 - m*g*y*sin(0.3)\nconstraints: [\"y'*cos(h) = x'*sin(h)\"]\n");
    reports r = analyze(&p, "own.yaml");
    cr_expect(strstr(r.text, "g*sin(3/10)*cos(h)"), "%s", r.text);
    cr_expect_not(strstr(r.text, "(1/10)"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* The rate of an energy that is not conserved is a formula in all velocities, without the root that one of them is. */
Test(statements, the_rate_of_the_energy_is_a_formula)
{
    place p = place_make();
    write_here(&p, "own.yaml", "name: own\nparameters: [{name: c, value: 2}, {name: g, value: 1.5}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                                "lagrangian: (x'^2 + y'^2)/2 - g*y\nconstraints: [\"x'^2 + y'^2 = c^2\"]\ndependent: [y]\n");
    reports r = analyze(&p, "own.yaml");
    cr_expect_not_null(strstr(r.text, "warning: the energy is not conserved: it changes at the rate g*y'\n"), "%s", r.text);
    cr_expect_not_null(strstr(r.tex, "it changes at the rate $g\\,\\dot{y}$"));
    cr_expect_not_null(strstr(r.page, "it changes at the rate <math"));
    reports_clear(&r);
    place_clear(&p);
}

/* d/dy is not in the sleigh's canonical distribution, its phi^1(d/dy) = 1 (for y' = x' tan(phi)); it has no current. */
Test(statements, a_field_outside_the_distribution_has_no_current)
{
    place p = place_with_systems();
    reports r = verify(&p, "sleigh --field y=1", 1);
    cr_expect(strstr(r.text, "Z is not in the canonical distribution") && strstr(r.text, "i_Z phi^1 = 1\n") && !strstr(r.text, "the field's current"), "%s", r.text);
    cr_expect(strstr(r.page, "Z is not in the canonical distribution") && !strstr(r.page, "current of the field"));
    cr_expect(cJSON_IsNull(item(r.json, "current")) && cJSON_IsFalse(item(r.json, "in_distribution")));
    cr_expect_str_eq(cJSON_GetArrayItem(item(r.json, "i_Z_phi"), 0)->valuestring, "1");
    reports_clear(&r);
    r = verify(&p, "sleigh --field phi=1", 1); /* in the distribution, and no symmetry */
    cr_expect(strstr(r.text, "The current of the field\n  Phi = m*a^2*k^2*omega\n"), "%s", r.text);
    cr_expect(cJSON_IsTrue(item(r.json, "in_distribution")));
    cr_expect_str_eq(item(r.json, "current")->valuestring, "m*a^2*k^2*omega");
    reports_clear(&r);
    place_clear(&p);
}

/* A unit of the four-velocity: Lbar = -m/2, so that Gamma is a symmetry with a constant current.  In the chart of (x', y'), and of a constraint that is not solved. */
Test(statements, a_constant_current_is_trivial_on_the_submanifold)
{
    place p = place_make();
    for (int power = 1; power <= 3; power += 2) {
        char text[600];
        snprintf(text, sizeof text, "name: four\nparameters: [{name: m, value: 1.3}]\ncoordinates: [{name: T, type: length}, {name: x, type: length}, {name: y, type: length}]\n"
                                    "lagrangian: -m/2*(T'^2 - x'^2 - y'^2)\nconstraints: [\"(T'^2 - x'^2 - y'^2)^%d = 1\"]\ndomain: {T': [1, 2]}\n", power);
        write_here(&p, "four.yaml", text);
        reports r = verify(&p, "four.yaml --field t=1;T=T';x=x';y=y'", 0);
        cr_expect(cJSON_IsTrue(item(r.json, "trivial")), "%s", r.source);
        cr_expect_not_null(strstr(r.text, "it is trivial: the current is a constant"), "%s", r.text);
        reports_clear(&r);
    }
    place_clear(&p);
}

/* A rate whose terms cancel within themselves is zero to the digits of what they consist of: rounding is no counterexample. */
Test(statements, rounding_is_no_rate)
{
    static const struct {
        const char *expression;
        bool conserved;
    } row[] = {
        {"th'+(m*r^2+I*r^2)^(I/m)-(m+I)^(I/m)*r^(2*I/m)", true},
        {"th'+(m*r^2+I*r)^(I/m)-(m*r+I)^(I/m)*r^(I/m)", true},
        {"th'+1e-18*r", false},
        {"th'*(1+1e-30*r)", false},
        {"(1e9+r)*th'-1e9*th'", false},
    };
    place p = place_make();
    write_here(&p, "free.yaml", "name: free\nparameters: {m: 1.3, I: 0.7}\ncoordinates: [r, th]\nlagrangian: m/2*(r'^2 + th'^2) + 0*I\ndomain: {r: [0.5, 2]}\n");
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        char line[200];
        snprintf(line, sizeof line, "free.yaml --current %s", row[i].expression);
        reports r = verify(&p, line, !row[i].conserved);
        cr_expect_eq((bool)cJSON_IsTrue(item(r.json, "conserved")), row[i].conserved, "%s: %s", row[i].expression, r.text);
        cr_expect_eq(strstr(r.text, "The rate of change along the motion is") != NULL, !row[i].conserved, "%s", row[i].expression);
        reports_clear(&r);
    }
    place_clear(&p);
}

/* Of an integral of the constraints every term of the Noether equations vanishes: what rounding leaves has no size to be
 * compared with. */
Test(statements, a_residual_without_a_size_is_decided_exactly, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "ball.yaml", "name: ball\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - 1.9*y^2 - 3.1*z^2\n"
                                "constraints: [\"x*x' + y*y' + z*z' = 0\"]\ndomain: {y: [0.5, 1]}\n");
    reports r = analyze(&p, "ball.yaml");
    const cJSON *current;
    cr_expect_not_null(strstr(r.text, ": integral of the constraints"), "%s", r.text);
    cJSON_ArrayForEach(current, item(r.json, "currents")) cr_expect_lt(item(item(current, "symmetry"), "residual")->valuedouble, 1e-9, "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* A rate that doubles cannot tell from its rounding, atanh of nearly one, is measured in balls. */
Test(statements, a_residual_is_no_rounding, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "skate.yaml", "name: skate\nparameters: {b: 1e-9}\ncoordinates: [x, y, {name: p, type: angle}]\n"
                                 "lagrangian: (x'^2 + y'^2)/2 + b*p'^2/2\nconstraints: [\"x'*sin(p) - y'*cos(p) = b*p'\"]\n");
    reports r = analyze(&p, "skate.yaml");
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents"))
    {
        double residual = item(current, "heldout_residual")->valuedouble;
        cr_expect_lt(residual, 1e-6, "%s: %g", item(current, "name")->valuestring, residual);
    }
    reports_clear(&r);
    place_clear(&p);
}

/* A relation among currents must not look like one with coordinates. */
Test(statements, no_current_is_named_as_a_coordinate)
{
    place p = place_make();
    write_here(&p, "named.yaml", "name: named\nparameters: {Psi2: 0.7}\ncoordinates: [Phi1, x]\nlagrangian: (Phi1'^2 + Psi2*x'^2)/2\n");
    reports r = analyze(&p, "named.yaml");
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents"))
    {
        const char *name = item(current, "name")->valuestring;
        cr_expect(!strncmp(name, "Xi", 2), "%s", name);
    }
    cr_expect(strstr(r.text, "\nXi1: ") && !strstr(r.text, "\nPhi1: "), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* ---- by names that the reader knows ---- */

#define OSCILLATOR(parameter, known) "name: o\nparameters: {" parameter ": 2}\ncoordinates: [x, y]\n" \
    "lagrangian: (x'^2 + y'^2)/2 - " parameter "*(x^2 + y^2)/2\nknown: {currents: [" known "]}\n"

/* What is found is told by the file's own currents: one of the amplitudes by a multiple, one by a sum, one by a product. */
#define SINE(q) q "'*sin(t*sqrt(k)) - sqrt(k)*" q "*cos(t*sqrt(k))"
Test(statements, a_current_is_told_by_those_that_the_file_knows)
{
    place p = place_make();
    write_here(&p, "o.yaml", OSCILLATOR("k", "{name: sine, expr: 3*(" SINE("x") ")},\n"
                                             "  {name: sum, expr: " SINE("x") " + x'*cos(t*sqrt(k)) + sqrt(k)*x*sin(t*sqrt(k))},\n"
                                             "  {name: ratio, expr: (" SINE("y") ")/(" SINE("x") ")}"));
    reports r = analyze(&p, "o.yaml");
    size_t told = 0;
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents"))
    {
        const cJSON *known = item(current, "known");
        cr_expect(cJSON_IsNull(known) || (strchr(known->valuestring, '[') && strstr(r.text, known->valuestring)
                                          && strstr(r.page, known->valuestring)), "%s", r.text);
        told += cJSON_IsString(known);
    }
    cr_expect_eq(told, 3, "%zu: %s", told, r.text);
    cr_expect(strstr(r.text, "Phi2 = [sine]/3;") && strstr(r.text, "Phi3 = [sum] - [sine]/3;")
                  && strstr(r.text, "Phi4 = [sine]*[ratio]/3;"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* d/dt belongs to -E: both are printed, unless E is a name of the system. */
Test(statements, minus_the_energy_is_printed_with_the_energy)
{
    place p = place_make();
    write_here(&p, "k.yaml", OSCILLATOR("k", ""));
    write_here(&p, "e.yaml", OSCILLATOR("E", ""));
    reports with = analyze(&p, "k.yaml"), without = analyze(&p, "e.yaml");
    cr_expect(strstr(with.text, " = -E\n  E = (x'^2 + y'^2 + k*(x^2 + y^2))/2\n"), "%s", with.text);
    cr_expect(!strstr(without.text, " = -E\n") && strstr(without.text, " = -(x'^2 + y'^2 + E*(x^2 + y^2))/2\n"), "%s", without.text);
    reports_clear(&with);
    reports_clear(&without);
    place_clear(&p);
}

/* ---- modulo the constraints ---- */

#define FOUR_COORDINATES "parameters: [{name: m, value: 1.3}, {name: g, value: 0.9}]\n" \
    "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: u, type: length}, {name: w, type: length}]\n" \
    "lagrangian: m/2*(x'^2 + y'^2 + u'^2 + w'^2) - m*g*w\ndomain: {w': [0.2, 1.5], x': [0.3, 1], y': [0.3, 1]}\n"

/* The energy belongs to d/dt, whatever the constraints are: formulas are reduced by them, and proofs need no values of the parameters. */
Test(statements, formulas_are_reduced_by_the_constraints)
{
    static const char *const constraints[] = {"u' = y*x'\", \"w'^2 = x'^2 + y'^2", "w'^3 = x'^2*y' + y'^3\", \"u' = y*x'", "w'^2 = x'^2 + y'^2\", \"u'^2 + u'*w' = 3*x'^2",
                                              "w'^3 + w'*x'^2 = x'^2*y' + y'^3\", \"u' = y*w'"};
    place p = place_make();
    for (size_t i = 0; i < sizeof constraints / sizeof *constraints; i++) {
        if (!sweep_tries(i, 1, 4)) continue;
        char text[700];
        snprintf(text, sizeof text, "name: reduced\n" FOUR_COORDINATES "constraints: [\"%s\"]\n", constraints[i]);
        write_here(&p, "reduced.yaml", text);
        reports r = verify(&p, "reduced.yaml --current m/2*(x'^2+y'^2+u'^2+w'^2)+m*g*w", 0);
        const cJSON *z = item(r.json, "symmetry"), *component;
        cr_expect_str_eq(item(z, "Z0")->valuestring, "-1", "%s: %s", constraints[i], item(z, "Z0")->valuestring);
        size_t vanish = 0;
        cJSON_ArrayForEach(component, item(z, "components")) vanish += !strcmp(component->valuestring, "0");
        cr_expect_eq(vanish, 6u, "%s\n%s", constraints[i], r.source);
        cr_expect(cJSON_IsTrue(item(r.json, "proved_for_all_parameters")), "%s", constraints[i]);
        reports_clear(&r);
    }
    place_clear(&p);
}

/* ---- branches ---- */

/* The text from the answer to the equations: what is said of currents. */
static char *currents_of(const char *text, const char *from, const char *to)
{
    const char *begin = strstr(text, from), *end = begin ? strstr(begin, to) : NULL;
    cr_assert(begin && end, "no %s", begin ? to : from);
    return strndup(begin, (size_t)(end - begin));
}

#define CONE "name: cone\nparameters: [{name: m, value: 1.3}, {name: g, value: 0.9}, {name: k, value: 0.8}]\n" \
    "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\nlagrangian: -g*m*z + m*(x'^2 + y'^2 + z'^2)/2\n"

static void write_branches(const place *p)
{
    write_here(p, "up.yaml", CONE "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\ndomain: {z': [0.1, 3]}\n");
    write_here(p, "down.yaml", CONE "constraints: [\"z'^2 = k^2*(x'^2 + y'^2)\"]\ndomain: {z': [-3, -0.1]}\n");
    write_here(p, "root.yaml", CONE "constraints: [\"z' = -k*sqrt(x'^2 + y'^2)\"]\n");
}

/* Printed with the velocity, not the root, every current holds on both branches: asked of each of them by itself. */
Test(statements, currents_are_printed_so_that_they_hold_on_both_branches, PLAIN_ONLY)
{
    place p = place_make();
    write_branches(&p);
    reports r = analyze(&p, "up.yaml");
    char *text = currents_of(r.text, "FOUND", "Explicit motion"), *tex = currents_of(r.tex, "\\section{Currents}", "\\section{Explicit motion}");
    char *page = currents_of(r.page, "<section id=\"currents\">", "<section id=\"explicit\">");
    cr_expect(!strstr(text, "sqrt") && !strstr(tex, "\\sqrt") && !strstr(page, "msqrt"), "%s", text);
    cr_expect_not_null(strstr(r.text, "computed on the branch z' > 0; the equations hold on the branch z' < 0"), "%s", r.text);
    size_t count = 0;
    const cJSON *current;
    cJSON_ArrayForEach(current, item(r.json, "currents"))
    {
        char question[400] = "", *to = question;
        cr_expect(cJSON_IsTrue(item(current, "on_both_branches")));
        for (const char *c = item(current, "expression")->valuestring; *c; c++)
            if (*c != ' ') *to++ = *c;
        for (int side = 0; side < 2; side++) {
            char line[500];
            snprintf(line, sizeof line, "%s --current %s", side ? "down.yaml" : "up.yaml", question);
            reports v = verify(&p, line, 0);
            cr_expect(strstr(v.text, ", on both branches.\n") && cJSON_IsTrue(item(v.json, "on_both_branches")), "%s", v.text);
            reports_clear(&v);
        }
        count++;
    }
    cr_assert_geq(count, 4u);
    cr_expect_eq(occurrences(text, ", on both branches; "), count);
    cr_expect_eq(occurrences(tex, ", on both branches; "), count);
    cr_expect_eq(occurrences(page, ", on both branches; "), count);
    free(text), free(tex), free(page);
    reports_clear(&r);
    place_clear(&p);
}

/* y'^2 + y^2 is no polynomial in the energy, but the sum of the squares of two currents that depend on the time. */
Test(statements, a_further_integral_may_be_a_polynomial)
{
    place p = place_make();
    write_here(&p, "further.yaml", "name: further\ncoordinates: [x, y]\nlagrangian: (x'^2+y'^2)/2 - 2*x - abs(x) - y^2/2\n");
    reports r = analyze(&p, "further.yaml");
    cr_expect(strstr(r.text, "functions of the currents above") && !strstr(r.text, "no polynomials"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* A particle of constant speed falls: x' = c exp(g y/4) vanishes beside the error of the motion, and y' becomes -2, where atanh has no value. What is proved
 * does not drift, and nothing is left to be counted where all is found. */
Test(statements, a_proved_current_does_not_drift_by_itself)
{
    place p = place_make();
    write_here(&p, "fall.yaml", "name: fall\nparameters: [{name: g, value: 9.81}]\ncoordinates: [x, y]\nlagrangian: (x'^2+y'^2)/2 - g*y\nconstraints: [\"x'^2+y'^2=4\"]\n");
    reports r = analyze(&p, "fall.yaml");
    cr_expect(strstr(r.text, "FOUND: 3 independent currents of at most 3 (search complete)") && !strstr(r.text, "were not counted"), "%s", r.text);
    cr_expect(strstr(r.text, "it is proved to be constant, so this is the error of the motion") && !strstr(r.text, "so it is not the error"), "%s", r.text);
    cr_expect(strstr(r.text, "has no finite value at some states of the test motion") && !strstr(r.text, "drifts by inf"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* A field of many lines is left out of the text, which says how to see it. */
Test(statements, a_long_field_is_on_the_page, PLAIN_ONLY)
{
    place p = place_make();
    reports r = analyze(&p, "sleigh --option shown=10"), all = analyze(&p, "sleigh --option shown=4000");
    cr_expect(strstr(r.text, " symbols: the page shows it, and so does --option shown=") && !strstr(r.text, "Z_phi"), "%s", r.text);
    cr_expect(!strstr(all.text, " symbols: the page shows it") && occurrences(all.text, "Z_x = ") > occurrences(r.text, "Z_x = "), "%s", all.text);
    reports_clear(&r);
    reports_clear(&all);
    place_clear(&p);
}

/* The multiplier of z'^2 = a^2 (x'^2 + y'^2) depends on the direction of the velocity, however small that is: nothing is fast here. */
Test(statements, a_direction_is_no_rate, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "cone.yaml", "name: cone\nparameters: [{name: a, value: 0.4}, {name: g, value: 9.81}]\ncoordinates: [x, y, z]\n"
                                "lagrangian: (x'^2+y'^2+z'^2)/2 - g*z\nconstraints: [\"z'^2 = a^2*(x'^2+y'^2)\"]\n");
    reports r = analyze(&p, "cone.yaml");
    cr_expect(!strstr(r.text, "the forces act within"), "%s", r.text);
    reports_clear(&r);
    write_here(&p, "brake.yaml", "name: brake\nparameters: [{name: a, value: 5e4}]\ncoordinates: [x]\nlagrangian: x'^2/2 - x^2/2\nforces: [\"x = -a*x'\"]\n");
    r = analyze(&p, "brake.yaml");
    cr_expect(strstr(r.text, "the forces act within 2.0e-05 units of time"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* A skate on a belt: sqrt(1/cos(h)^2) (x' - V) is its speed times the sign of cos(h), which jumps where cos(h) = 0. The coordinates' velocities end there, the
 * motion goes on, and the speed with it. */
Test(statements, an_integral_goes_on_where_the_chart_ends, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "belt.yaml", "name: belt\nparameters: [{name: V, value: 0.8}]\ncoordinates: [x, y, {name: h, type: angle}]\n"
                                "lagrangian: (x'^2+y'^2+h'^2)/2\nconstraints: [\"sin(h)*(x'-V) - cos(h)*y' = 0\"]\n");
    reports r = analyze(&p, "belt.yaml");
    const cJSON *further;
    cJSON_ArrayForEach(further, item(r.json, "further_integrals")) {
        bool walled = strstr(item(further, "expression")->valuestring, "sqrt") != NULL;
        cr_expect(!walled && cJSON_IsNull(item(further, "region")), "%s", r.source);
    }
    cr_expect(strstr(r.text, "= (x' - V)/cos(h)") && !strstr(r.text, "sqrt(1/cos(h)^2)"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* With the root of x' and y' in it a current of one branch is none of the other. */
Test(statements, a_current_of_one_branch_says_so)
{
    static const char *const rooted = "--current m*(y'*sqrt(k^2*(x'^2+y'^2))*(k^2+1)-2*g*k^2*y)", *const other = "--current m*(y'*sqrt(k^2*(x'^2+y'^2))*(k^2+1)+2*g*k^2*y)";
    char line[300];
    place p = place_make();
    write_branches(&p);
    snprintf(line, sizeof line, "down.yaml %s", rooted);
    reports r = verify(&p, line, 0);
    cr_expect(strstr(r.text, ", on the branch z' < 0 only.\n") && strstr(r.page, ", on the branch z"), "%s", r.text);
    cr_expect(cJSON_IsFalse(item(r.json, "on_both_branches")));
    cr_expect_not_null(strstr(item(r.json, "current")->valuestring, "sqrt"), "%s", r.source);
    reports_clear(&r);
    snprintf(line, sizeof line, "up.yaml %s", rooted);
    r = verify(&p, line, 1);
    reports_clear(&r);
    snprintf(line, sizeof line, "up.yaml %s", other);
    r = verify(&p, line, 0);
    cr_expect_not_null(strstr(r.text, ", on the branch z' > 0 only.\n"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* A root that the user wrote is a dependent velocity too; it has no other branch. */
Test(statements, a_root_is_printed_as_its_velocity)
{
    place p = place_make();
    write_branches(&p);
    reports r = analyze(&p, "root.yaml");
    char *text = currents_of(r.text, "FOUND", "Chetaev multipliers");
    cr_expect_null(strstr(text, "sqrt"), "%s", text);
    cr_expect(!strstr(r.text, "branch"), "%s", r.text);
    cr_expect(cJSON_IsNull(item(item(r.json, "constraint"), "branch")));
    free(text);
    reports_clear(&r);
    place_clear(&p);
}

/* What is constant in a region only is compared with the bound, too, and what is counted on one side says so. */
Test(statements, completeness_names_the_region, WHOLE_ONLY)
{
    static const struct {
        const char *system, *where, *words;
        bool regional;
    } row[] = {
        {"coordinates: [x, y, z]\nparameters: {m: 1.1, a: 0.8, g: 9.81}\nlagrangian: m/2*(x'^2 + y'^2 + z'^2) - m*g*z\nconstraints: [\"x^2 + y^2 = a^2\"]\n",
         NULL, "is a function of those found", false},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x)\ndomain: {x: [0.5, 1]}\n", "for x > 0", "for x > 0: every integral", true},
        {"coordinates: [x, y]\nlagrangian: (x'^2 + 3*y'^2)/2 - (abs(x - y) - 1)^2\ndomain: {x: [0, 0.5], y: [1, 2]}\n", "for x - y < 0", "for x - y < 0: every integral", false},
    };
    for (size_t i = 0; i < sizeof row / sizeof *row; i++) {
        if (!sweep_tries(i + 2, 1, 3)) continue;
        place p = place_make();
        char text[400];
        snprintf(text, sizeof text, "name: s\n%s", row[i].system);
        write_here(&p, "s.yaml", text);
        reports r = analyze(&p, "s.yaml");
        const cJSON *c = item(r.json, "completeness"), *where = item(c, "where");
        cr_expect(row[i].where ? cJSON_IsString(where) && !strcmp(where->valuestring, row[i].where) : cJSON_IsNull(where), "%zu: %s", i, r.text);
        cr_expect_eq((bool)cJSON_IsTrue(item(c, "regional")), row[i].regional, "%zu", i);
        cr_expect_geq(item(c, "degree")->valueint, 4, "%zu", i);
        cr_expect_gt(occurrences(r.text, row[i].words), 0, "%zu: %s", i, r.text);
        reports_clear(&r);
        place_clear(&p);
    }
}

/* Geodesics of SL(2): time by a logarithm that is real where others are than the test motion is: its drift was said to be 0. */
Test(statements, what_is_not_real_has_no_drift, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "sl2.yaml", "name: sl2\ncoordinates: [x, y, z]\ndomain: {y: [0.6, 1.3]}\nlagrangian: ((x'^2 + y'^2)/y^2 + (z' + x'/y)^2)/2\n");
    reports r = analyze(&p, "sl2.yaml");
    size_t without = 0;
    for (const cJSON *c = item(r.json, "currents")->child; c; c = c->next) {
        bool none = cJSON_IsNull(item(c, "drift"));
        cr_expect_eq(none, cJSON_IsNull(item(c, "drift_order_ok")));
        cr_expect(!none || cJSON_GetArraySize(item(c, "real_where_positive")) > 0);
        without += none;
    }
    cr_expect_eq(without, 1);
    cr_expect_not_null(strstr(r.text, "not measured: it is real at no state of the test motion"), "%s", r.text);
    cr_expect(!strstr(r.text, "nan") && !strstr(r.page, ">nan"), "%s", r.text);
    reports_clear(&r);
    place_clear(&p);
}

/* Neither is it conserved, trivially, nor is it not. */
Test(statements, what_is_real_nowhere_is_refused)
{
    place p = place_make();
    write_here(&p, "fall.yaml", "name: fall\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - x\n");
    finished f = run_expecting(&p, "verify fall.yaml --current sqrt(-10-y'^2)", 4);
    cr_expect(strstr(f.err, "it has no real value at any of 256 states of the domain\nhint: is a sign below a root right?"), "%s", f.err);
    cr_expect_str_eq(f.out, "");
    finished_clear(&f);
    f = run_expecting(&p, "verify fall.yaml --current sqrt(1-y'^2)", 0);
    finished_clear(&f);
    place_clear(&p);
}
