/* Parameters stay symbols: a number in a formula is no parameter's value, and what needs a value says so. */
#include "program.h"
#include "sweep.h"

#include <cjson/cJSON.h>
#include <math.h>

/* What a command line answers, as JSON. */
static cJSON *answer(const char *line)
{
    place p = place_with_systems();
    finished f = run(&p, line);
    cJSON *json = cJSON_Parse(f.out);
    cr_assert_not_null(json, "%s: %s", line, f.err);
    finished_clear(&f);
    place_clear(&p);
    return json;
}

static const char *text_of(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    return cJSON_IsString(item) ? item->valuestring : "";
}

static double number_of(const cJSON *object, const char *key)
{
    const cJSON *item = cJSON_GetObjectItemCaseSensitive(object, key);
    return cJSON_IsNumber(item) ? item->valuedouble : NAN;
}

/* The current with this expression; NULL. */
static const cJSON *current(const cJSON *root, const char *expression)
{
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "currents")) if (!strcmp(text_of(item, "expression"), expression)) return item;
    return NULL;
}

/* What `analyze` says, after a look at every current with a closed form: it holds for all parameters. */
static cJSON *all_hold(const char *arguments)
{
    char line[200];
    snprintf(line, sizeof line, "analyze %s --json -", arguments);
    cJSON *root = answer(line);
    const cJSON *item, *list = cJSON_GetObjectItemCaseSensitive(root, "currents");
    cr_expect_gt(cJSON_GetArraySize(list), 0, "%s", line);
    cJSON_ArrayForEach(item, list)
        if (!cJSON_IsObject(cJSON_GetObjectItemCaseSensitive(item, "series")))
            cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s: %s", arguments, text_of(item, "expression"));
    return root;
}

/* ---- currents ---- */

/* At k = 1 the arguments have no letter, and the formulas hold for all k nevertheless. */
Test(parameters, a_value_that_only_looks_special_is_none, PLAIN_ONLY)
{
    cJSON *root = answer("analyze sleigh --json - --set k=1 --set a=0.7");
    const cJSON *phi = current(root, "m*(v*sin(phi/k) + a*k*omega*cos(phi/k))");
    cr_assert_not_null(phi, "the current that is a momentum at k = 1 is not there with its parameters");
    cr_expect_str_eq(text_of(phi, "holds"), "all parameters");
    cJSON_Delete(root);
}

Test(parameters, a_claim_is_verified_with_the_values_that_it_needs, PLAIN_ONLY)
{
    cJSON *fixed = answer("verify sleigh --json - --set k=1 --set a=0.7 --current v*sin(phi)+a*omega*cos(phi)"),
          *free = answer("verify sleigh --json - --current v*sin(phi/k)+a*k*omega*cos(phi/k)"),
          *numbers = answer("verify sleigh --json - --set k=1 --set a=0.7 --current 10*v*sin(phi)+7*omega*cos(phi)");
    const cJSON *holds = cJSON_GetObjectItemCaseSensitive(fixed, "holds"), *two = cJSON_GetObjectItemCaseSensitive(numbers, "holds");
    cr_expect(cJSON_GetArraySize(holds) == 1 && number_of(holds, "k") == 1);
    cr_expect_str_eq(text_of(free, "holds"), "all parameters");
    cr_expect(cJSON_GetArraySize(two) == 2 && number_of(two, "k") == 1 && number_of(two, "a") == 0.7);
    cJSON_Delete(fixed);
    cJSON_Delete(free);
    cJSON_Delete(numbers);
}

/* The relation of the rates is the proof, where the sum of the rates is too long for one. */
Test(parameters, momenta_of_three_bodies_hold_for_all_masses, WHOLE_ONLY)
{
    cJSON *root = answer("analyze three_bodies --json -");
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "currents")) cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s", text_of(item, "expression"));
    cJSON_Delete(root);
}

/* ---- numbers inside of terms: rates, frequencies, exponents ---- */

/* e or -e: nothing fixes the sign of a current that is no energy. */
static bool current_of_either_sign(const cJSON *list, const char *e)
{
    char *minus = malloc(strlen(e) + 2);
    cr_assert_not_null(minus);
    sprintf(minus, *e == '-' ? "%s" : "-%s", *e == '-' ? e + 1 : e);
    bool found = current(list, e) || current(list, minus);
    free(minus);
    return found;
}

/* What `--set` gives the parameters: the same formulas, each for all parameters. */
typedef struct {
    const char *system, *set[3];
    int currents;
} named_case;

static cJSON *analyzed(const place *p, const char *set)
{
    char line[200];
    snprintf(line, sizeof line, "analyze s.yaml --json - %s", set);
    finished f = run(p, line);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_not_null(root, "%s: %s", line, f.err);
    finished_clear(&f);
    return root;
}

static void expect_names(const named_case *c)
{
    place p = place_make();
    write_here(&p, "s.yaml", c->system);
    cJSON *first = NULL;
    for (size_t i = 0; i < 3 && c->set[i]; i++) {
        cJSON *root = analyzed(&p, c->set[i]);
        const cJSON *list = cJSON_GetObjectItemCaseSensitive(root, "currents"), *item;
        cr_expect_eq(cJSON_GetArraySize(list), c->currents, "%s: %d currents", c->set[i], cJSON_GetArraySize(list));
        cJSON_ArrayForEach(item, list)
        {
            const char *e = text_of(item, "expression");
            cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s: %s", c->set[i], e);
            cr_expect(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(item, "proved")), "%s: %s", c->set[i], e);
            cr_expect(!first || current_of_either_sign(first, e), "%s gives another formula: %s", c->set[i], e);
        }
        if (first) cJSON_Delete(root);
        else first = root;
    }
    cJSON_Delete(first);
    place_clear(&p);
}

/* Frequencies are no products of parameters: (H +- sqrt(H^2 - 4 a M))/(2 M), and whole numbers at some values. */
Test(parameters, frequencies_of_a_trap_are_named, PLAIN_ONLY)
{
    expect_names(&(named_case){"name: s\nparameters: {a: 0.7, H: 3.1, M: 1.9}\ncoordinates: [u, v]\n"
                               "lagrangian: M*(u'^2 + v'^2)/2 + H*(u*v' - v*u')/2 + a*(u^2 + v^2)/2\n",
                               {"", "--set a=0.4321 --set H=2.7183 --set M=1.1", "--set a=2 --set H=3 --set M=1"}, 4});
}

Test(parameters, frequencies_in_a_turning_frame_are_named, PLAIN_ONLY)
{
    expect_names(&(named_case){"name: s\nparameters: {w: 2.3, W: 0.31}\ncoordinates: [x, y]\n"
                               "lagrangian: (x'^2 + y'^2)/2 + W*(x*y' - y*x') - (w^2 - W^2)/2*(x^2 + y^2)\n",
                               {"", "--set w=1.9173 --set W=0.7712", "--set w=3 --set W=1"}, 4});
}

/* A decay and a frequency together; two decays. */
Test(parameters, rates_of_damped_motions_are_named, PLAIN_ONLY)
{
    static const char damped[] = "name: s\nparameters: {m: 1.3, k: 2.1, c: 0.3, b: 0.7}\ncoordinates: [x, y]\n"
                                 "lagrangian: m*(x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 - b*x*y\nforces: [\"x = -c*x'\", \"y = -c*y'\"]\n";
    expect_names(&(named_case){damped, {"", "--set m=0.9174 --set k=1.7731 --set c=0.4 --set b=0.3219"}, 4});
    static const char one[] = "name: s\nparameters: {m: 1.3, k: 2.1, c: 0.3}\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^2/2\nforces: [\"x = -c*x'\"]\n";
    expect_names(&(named_case){one, {"", "--set m=2 --set k=1.7 --set c=0.4321"}, 2});
    expect_names(&(named_case){one, {"--set c=5.3", "--set c=4.7719 --set m=0.7", "--set m=1 --set k=2 --set c=3"}, 2});
}

/* The speed is kept: momenta grow with exp(E x/(M u^2)). */
Test(parameters, rates_of_a_thermostat_are_named, PLAIN_ONLY)
{
    expect_names(&(named_case){"name: s\nparameters: {M: 0.83, E: 1.37, u: 0.91}\ncoordinates: [x, y, z]\nlagrangian: M*(x'^2 + y'^2 + z'^2)/2 + E*x\n"
                               "constraints: [\"x'^2 + y'^2 + z'^2 = u^2\"]\ndependent: [z]\ndomain: {x': [-0.4, 0.4], y': [-0.4, 0.4], z': [0.3, 0.9]}\n",
                               {"", "--set M=1.2719 --set E=0.9123 --set u=1.1", "--set M=2 --set E=3 --set u=1"}, 5});
}

/* The one current with these values fixed, all others for all parameters. */
static void expect_special(const char *system, const char *parameter, double value, const char *expression)
{
    place p = place_make();
    write_here(&p, "s.yaml", system);
    cJSON *root = analyzed(&p, "");
    const cJSON *special = current(root, expression), *holds = cJSON_GetObjectItemCaseSensitive(special, "holds");
    cr_assert_not_null(special, "no %s", expression);
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(special, "proved")) && cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(special, "proved_for_all_parameters")));
    cr_expect(cJSON_GetArraySize(holds) == 1 && number_of(holds, parameter) == value, "holds: %s", cJSON_PrintUnformatted(holds));
    const cJSON *first = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "currents"), 0);
    cr_expect_str_eq(text_of(first, "holds"), "all parameters");
    cJSON_Delete(root);
    place_clear(&p);
}

/* x^n with n = -2: given as a parameter it must have its value, and the others stay symbols; given as a number nothing is special. */
Test(parameters, only_the_special_one_is_fixed)
{
    expect_special("name: s\nparameters: {m: 1.3, k: 0.7, n: -2}\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^n\ndomain: {x: [0.5, 2]}\n", "n", -2,
                   "m*x*x' - t*(m*x'^2 + 2*k/x^2)");
    expect_special("name: s\nparameters: {g: 2, m: 1.3, c: 2.1, d: 1.7, b: 0.9}\ncoordinates: [x, y]\n"
                   "lagrangian: m*(x'^2 + y'^2)/2 - c*x^2/2 - d*y^2/2 - b*(x^2*y + g*y^3)\n", "g", 2,
                   "(x*(x*(c*(4*c - d + 4*b*y) + b^2*(x^2 + 4*y^2)) + 4*m*b*x'*y') + m*x'^2*(4*c - d - 4*b*y))/2");
    expect_names(&(named_case){"name: s\nparameters: {m: 1.3, k: 0.7}\ncoordinates: [x]\nlagrangian: m*x'^2/2 - k*x^(-2)\ndomain: {x: [0.5, 2]}\n",
                               {"", "--set m=0.9127 --set k=1.1371"}, 2});
}

/* The last current, or further integral, holds where a parameter is this expression of others. */
static void expect_related(const char *system, const char *list, const char *parameter, const char *expression)
{
    place p = place_make();
    write_here(&p, "s.yaml", system);
    cJSON *root = analyzed(&p, "");
    const cJSON *all = cJSON_GetObjectItemCaseSensitive(root, list), *last = cJSON_GetArrayItem(all, cJSON_GetArraySize(all) - 1),
                *holds = cJSON_GetObjectItemCaseSensitive(last, "holds");
    cr_assert_not_null(last, "%s: nothing", system);
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(last, "proved")) && cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(last, "proved_for_all_parameters")));
    cr_expect(cJSON_GetArraySize(holds) == 1 && !strcmp(text_of(holds, parameter), expression), "%s: holds: %s", text_of(last, "expression"),
              cJSON_PrintUnformatted(holds));
    cJSON_Delete(root);
    place_clear(&p);
}

/* What holds at k = 18, m = 2, w = 3 holds for k = m w^2. */
Test(parameters, values_that_need_only_be_related, PLAIN_ONLY)
{
    expect_related("name: s\nparameters: {k: 18, m: 2, w: 3}\ncoordinates: [x, y]\nlagrangian: m*(x'^2 + y'^2)/2 - k*x^2/2 - m*w^2*y^2/2\n", "further_integrals", "k", "m*w^2");
    expect_related("name: s\nparameters: {m: 1.3, a: 0.7, b: 1.4}\ncoordinates: [x, y]\nlagrangian: m*(x'^2 + y'^2 - a^2*x^2 - b^2*y^2)/2\n", "further_integrals", "b", "2*a");
    expect_related("name: s\nparameters: {a: 2, b: 2}\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2 - a*x^2 - b*y^2)/2 - (x^2 + y^2)^2\n", "currents", "b", "a");
}

/* Stiffnesses 1, 4, 7 make a - 2 b + c zero, and with it a term of the integral of a particle on a sphere. */
Test(parameters, no_term_vanishes_at_the_given_values, PLAIN_ONLY)
{
    expect_names(&(named_case){"name: s\nparameters: {a: 1, b: 4, c: 7}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2 - a*x^2 - b*y^2 - c*z^2)/2\n"
                               "constraints: [\"z' = -(x*x' + y*y')/z\"]\n", {"", "--set b=2.3 --set c=9"}, 3});
}

/* What the first value of an unknown is called. */
static void expect_unknown(const cJSON *root, const char *set, const char *unknown, const char *name)
{
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(cJSON_GetObjectItemCaseSensitive(root, "unknowns"), unknown);
    cr_assert_geq(cJSON_GetArraySize(list), 1, "%s: no value of %s", set, unknown);
    cr_expect_str_eq(text_of(cJSON_GetArrayItem(list, 0), "recognised"), name, "%s: %s = %s", set, unknown,
                     text_of(cJSON_GetArrayItem(list, 0), "recognised"));
}

/* s = 5/8 at M = 1 and c = 5/4 is c/(2 M). */
Test(parameters, several_unknowns_at_once_are_named, PLAIN_ONLY)
{
    static const char *const set[] = {"", "--set M=1 --set c=1.25 --set k=2", "--set M=1.7192 --set k=2.3317 --set c=0.61"};
    place p = place_make();
    write_here(&p, "s.yaml", "name: s\nparameters: {M: 1, k: 4, c: 1}\ncoordinates: [x]\n"
                             "lagrangian: M*x'^2/2 - k*x^2/2\nforces: [\"x = -c*x'\"]\n");
    write_here(&p, "q.yaml", "name: q\nansatz:\n  - product:\n    - terms: [\"x*exp(s*t)\", \"x'*exp(s*t)\"]\n"
                             "    - {basis: fourier, in: t, frequency: nu}\nunknowns: {s: [0.05, 1], nu: [0.5, 3]}\n");
    for (size_t i = 0; i < 3; i++) {
        char line[120];
        snprintf(line, sizeof line, "--analysis q.yaml %s", set[i]);
        cJSON *root = analyzed(&p, line);
        const cJSON *item;
        expect_unknown(root, set[i], "s", "c/(2*M)");
        expect_unknown(root, set[i], "nu", "sqrt(4*M*k - c^2)/(2*M)");
        cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "currents"))
            cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s: %s", set[i], text_of(item, "expression"));
        cJSON_Delete(root);
    }
    place_clear(&p);
}

Test(parameters, rates_of_shipped_systems_are_named, PLAIN_ONLY)
{
    static const char *const name[] = {"penning_trap", "omni_robot", "constant_speed", "foucault_pendulum"};
    for (size_t i = 0; i < 4; i++)
        if (sweep_tries(i, 4, 4)) cJSON_Delete(all_hold(name[i]));
}

/* Gamma is long for want of a short M^-1; the fields are short. */
Test(parameters, coefficients_of_long_relations_have_parameters, WHOLE_ONLY)
{
    cJSON *ball = all_hold("chaplygin_ball"), *other = all_hold("chaplygin_ball --set A=1.2 --set B=1.6 --set r=0.5");
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(ball, "currents"))
        cr_expect(current(other, text_of(item, "expression")), "only at some values: %s", text_of(item, "expression"));
    cJSON_Delete(ball);
    cJSON_Delete(other);
    cJSON *crane = all_hold("crane_lagrangian");
    cr_expect(current(crane, "(jx2 + 2*jx4 + 2*c^2*m4)*(l*s + f*sin(psi1))/l"));
    cJSON_Delete(crane);
}

/* Every formula, in its place, for other values. */
static void expect_same_formulas(const char *system, const char *sets)
{
    char line[300];
    snprintf(line, sizeof line, "%s %s", system, sets);
    cJSON *file = all_hold(system), *other = all_hold(line);
    const cJSON *a = cJSON_GetObjectItemCaseSensitive(file, "currents"), *b = cJSON_GetObjectItemCaseSensitive(other, "currents");
    cr_assert_eq(cJSON_GetArraySize(a), cJSON_GetArraySize(b), "%s", line);
    for (int i = 0; i < cJSON_GetArraySize(a); i++)
        cr_expect_str_eq(text_of(cJSON_GetArrayItem(b, i), "expression"), text_of(cJSON_GetArrayItem(a, i), "expression"), "%s: Phi%d", line, i + 1);
    cJSON_Delete(file);
    cJSON_Delete(other);
}

/* Which of two equally simple currents comes first, and their signs, follow from the formulas; numbers of many digits make no relation too long. */
Test(parameters, order_and_signs_do_not_depend_on_the_values, WHOLE_ONLY)
{
    expect_same_formulas("chaplygin_ball", "--set A=6 --set B=7 --set C=9 --set m=5 --set r=8");
    if (sweep_whole()) expect_same_formulas("chaplygin_ball", "--set A=1.4456 --set B=1.8124 --set C=2.0697 --set m=1.6325 --set r=0.58974");
}

/* 0.8246527771 is no 475/576. */
Test(parameters, a_fraction_near_a_rate_is_not_taken_for_it, WHOLE_ONLY)
{
    expect_same_formulas("omni_robot", "--set m=5.2566 --set I=0.21323 --set J=0.0017997 --set L=0.25116 --set r=0.049145");
}

/* nu and 1 - nu are one rate: whichever is below 1/2, the same one is named. */
Test(parameters, a_rate_is_named_on_either_side_of_one_half, WHOLE_ONLY)
{
    expect_same_formulas("sleigh_inertia", "--set m=6 --set J=7 --set a=9");
    expect_same_formulas("sleigh_inertia", "--set m=1.3144 --set J=0.70769 --set a=0.49361");
}

/* ---- groups ---- */

static const cJSON *momentum(const cJSON *root, size_t i) { return cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "momenta"), (int)i); }

Test(parameters, gauge_momenta_have_parameters_whatever_the_values, PLAIN_ONLY)
{
    static const char *const line[] = {"reduce routh_sphere --json -", "reduce routh_sphere --json - --set r=0.6173", "reduce routh_sphere --json - --set r=2 --set C=3"};
    for (size_t i = 0; i < 3; i++) {
        cJSON *root = answer(line[i]);
        const cJSON *p = momentum(root, 0);
        cr_expect_str_eq(text_of(p, "expression"), "(A*r*p' + C*l*s' + (C*(r*(s' + p'*cos(h)) + l*p') - A*r*p'*cos(h))*cos(h))/(r*l)", "%s", line[i]);
        cr_expect_str_eq(text_of(cJSON_GetObjectItemCaseSensitive(p, "field"), "s"), "1/r");
        cr_expect_str_eq(text_of(p, "holds"), "all parameters");
        cJSON_Delete(root);
    }
}

/* A hoop that rolls round a cone: its exponent and what it is a power of hold three parameters. */
Test(parameters, an_exponent_of_three_parameters, WHOLE_ONLY)
{
    place p = place_make();
    write_here(&p, "cone.yaml", "name: cone\ncoordinates: [r, {name: th, type: angle}, {name: psi, type: angle}]\nparameters: {m: 1.3, I: 0.7, al: 0.4, g: 9.81, R: 0.5}\n"
                                "lagrangian: m/2*(r'^2/sin(al)^2 + r^2*th'^2) + I/2*psi'^2 - m*g*r/tan(al)\nconstraints: [\"r*th' - R*psi' = 0\"]\ndomain: {r: [0.5, 2]}\n");
    finished f = run(&p, "analyze cone.yaml --json -");
    cJSON *root = cJSON_Parse(f.out);
    const cJSON *list = cJSON_GetObjectItemCaseSensitive(root, "currents"), *item;
    cr_assert_eq(cJSON_GetArraySize(list), 2, "%s", f.err);
    cJSON_ArrayForEach(item, list) cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s", text_of(item, "expression"));
    cJSON_Delete(root);
    finished_clear(&f);
    place_clear(&p);
}

/* Integrals in whose formulas a root of the equations of motion stands, of which the parameters divide the radicand. */
Test(parameters, a_root_with_parameters_below, PLAIN_ONLY)
{
    expect_names(&(named_case){
        "name: electric\ncoordinates: [x, y]\nparameters: {m: 1, c: 1, q: 1, E: 0.4}\n"
        "lagrangian: -m*c^2*sqrt(1 - (x'^2 + y'^2)/c^2) + q*E*x\n",
        {"", "--set c=1.7", "--set c=3 --set q=2.5 --set E=0.13"},
        4});
}

/* |u| and sign(u) stand in the accelerations together. */
Test(parameters, momenta_beside_a_kink, WHOLE_ONLY)
{
    expect_names(&(named_case){
        "name: spring\ncoordinates: [x, y]\nparameters: {m: 1, M: 2, k: 3, l: 0.5}\n"
        "lagrangian: m/2*x'^2 + M/2*y'^2 - k/2*(abs(x - y) - l)^2\n",
        {"", "--set M=2.7", "--set m=0.3 --set l=1.1"},
        3});
}

/* The masses' ratio, although both sums of distances keep their roots in the potential. */
Test(parameters, generators_have_parameters_whatever_the_values, PLAIN_ONLY)
{
    static const char *const line[] = {"reduce three_bodies --json -", "reduce three_bodies --json - --set a=1.43778 --set b=0.86224"};
    for (size_t i = 0; i < 2; i++) {
        cJSON *root = answer(line[i]), *group = cJSON_GetObjectItemCaseSensitive(root, "group");
        const cJSON *generators = cJSON_GetObjectItemCaseSensitive(group, "generators"), *holds = cJSON_GetObjectItemCaseSensitive(group, "holds"), *g;
        cr_assert_eq(cJSON_GetArraySize(generators), 4);
        cr_expect_str_eq(text_of(cJSON_GetArrayItem(generators, 3), "y3"), "x1 + b*x2/a");
        cJSON_ArrayForEach(g, holds) cr_expect(cJSON_IsString(g) && !strcmp(g->valuestring, "all parameters"));
        cr_expect_eq(cJSON_GetArraySize(holds), 4);
        cJSON_Delete(root);
    }
}

Test(parameters, a_second_group_has_parameters, PLAIN_ONLY)
{
    cJSON *root = answer("reduce routh_sphere --json -");
    const cJSON *second = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "stages"), 1), *field = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(second, "generators"), 0);
    cr_expect_str_eq(text_of(field, "p"), "r/l");
    cr_expect_str_eq(text_of(field, "s"), "1");
    cJSON_Delete(root);
}

/* For c = 0 a current was divided by c, and called proved. */
Test(parameters, no_current_is_divided_by_what_is_zero, PLAIN_ONLY)
{
    cJSON *json = answer("analyze two_wheel_carriage --json - --quiet --set c=0");
    const cJSON *item;
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(json, "currents")), 7);
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItemCaseSensitive(json, "warnings")), 0);
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(json, "currents")) cr_expect(isfinite(number_of(item, "drift")), "%s: its drift is no number", text_of(item, "expression"));
    cJSON_Delete(json);
}
