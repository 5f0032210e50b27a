/* Parameters stay symbols in groups, momenta, densities and reduced equations, whatever their values are; what needs a value says so. */
#include "parameter_sets.h"
#include "program.h"
#include "sweep.h"

#include <cjson/cJSON.h>

/* ---- files of our own ---- */

/* [d/dy, d/dx + k y d/dz] = k d/dz: the group's constants contain the parameter. */
static const char heisenberg[] =
    "name: heisenberg\nparameters: [{name: k, value: 2}, {name: m, value: 3}]\n"
    "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: z, type: length}]\n"
    "lagrangian: m/2*(x'^2 + y'^2 + (z' - k*x*y')^2)\n";

/* A knife edge under a point at the distance k - 1 from it: there is an invariant measure for k = 1 only. */
static const char knife[] =
    "name: knife\nparameters: [{name: k, value: 1}, {name: m, value: 3}, {name: J, value: 0.7}]\n"
    "coordinates: [{name: p, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
    "lagrangian: m/2*((x' - (k - 1)*p'*sin(p))^2 + (y' + (k - 1)*p'*cos(p))^2) + J/2*p'^2\n"
    "constraints: [\"y' = x'*tan(p)\"]\ndomain: {p: [-1, 1]}\n";

/* A body on an oblique helical joint on the ground, whose axis does not go through its centre of mass. */
static const char helix[] =
    "name: helix\nparameters: [{name: h, value: 1}, {name: m, value: 2}, {name: l, value: 0.35}]\n"
    "bodies:\n  - {name: a, mass: m, inertia: [1, 1, 1]}\n  - {name: b, mass: m, inertia: [0, 0, 1], center: [l, 0, 0]}\n"
    "joints:\n  - {type: helical, child: a, axis: [1, 2, 2], pitch: h, coordinates: [q]}\n  - {type: planar, child: b, coordinates: [x, y, p]}\n";

static cJSON *answer(const char *file, const char *arguments)
{
    place p = place_make();
    char line[400];
    write_here(&p, "own.yaml", file);
    snprintf(line, sizeof line, "reduce own.yaml --json - %s", arguments);
    finished f = run(&p, line);
    cJSON *json = cJSON_Parse(f.out);
    cr_assert_not_null(json, "%s: %s", line, f.err);
    finished_clear(&f);
    place_clear(&p);
    return json;
}

static cJSON *at(const cJSON *object, const char *key) { return cJSON_GetObjectItemCaseSensitive(object, key); }

/* A part of two answers is the same text. */
static void same(const cJSON *a, const cJSON *b, const char *what)
{
    char *s = cJSON_PrintUnformatted(a), *t = cJSON_PrintUnformatted(b);
    cr_assert(a && b, "%s is missing", what);
    cr_expect_str_eq(s, t, "%s", what);
    cJSON_free(s);
    cJSON_free(t);
}

/* ---- groups ---- */

Test(parameters_reduce, constants_of_a_group_are_symbols)
{
    cJSON *file = answer(heisenberg, ""), *other = answer(heisenberg, "--set k=0.61735 --set m=1.2345"), *one = answer(heisenberg, "--set k=1");
    const cJSON *stage = cJSON_GetArrayItem(at(file, "stages"), 0), *rate = cJSON_GetArrayItem(at(stage, "equations"), 0), *bracket = cJSON_GetArrayItem(at(at(file, "group"), "brackets"), 0);
    cr_expect_str_eq(at(rate, "rate")->valuestring, "k*m*zeta2*zeta3");
    cr_expect_str_eq(at(at(bracket, "is"), "2")->valuestring, "k");
    const cJSON *all[] = {other, one};
    for (size_t i = 0; i < 2; i++) {
        same(at(at(file, "group"), "brackets"), at(at(all[i], "group"), "brackets"), "brackets");
        same(at(stage, "equations"), at(cJSON_GetArrayItem(at(all[i], "stages"), 0), "equations"), "equations");
        same(at(file, "momenta"), at(all[i], "momenta"), "momenta");
    }
    cJSON_Delete(file);
    cJSON_Delete(other);
    cJSON_Delete(one);
}

Test(parameters_reduce, brackets_in_words_have_symbols, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "reduce -v three_bodies");
    cr_expect_not_null(strstr(f.out, "[e_1,e_4] = (a + b)/a e_2"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* The fields of joints: null vectors of conditions with parameters. */
Test(parameters_reduce, fields_of_joints_have_symbols, WHOLE_ONLY)
{
    cJSON *file = answer(helix, ""), *other = answer(helix, "--set h=0.31416 --set l=1.27 --set m=0.9");
    same(at(file, "joints"), at(other, "joints"), "fields of joints");
    cJSON_Delete(file);
    cJSON_Delete(other);
    nh_options options;
    nh_options_default(&options);
    formulas f = {0};
    bool there = false;
    add_reduction(&f, "systems/cart_on_disc.yaml", 0, NULL, (special_value){0}, &options);
    for (size_t i = 0; i < f.count; i++) there |= !strcmp(f.list[i].text, "-sin(h); cos(h); -1/a");
    cr_expect(there, "the field of the extremity has a number for 1/a");
    formulas_clear(&f);
}

/* A body that is symmetric at these values only has one symmetry more; the others are written as ever. */
Test(parameters_reduce, a_special_value_adds_a_generator)
{
    cJSON *json;
    place p = place_with_systems();
    finished f = run(&p, "reduce euler_top --json - --set C=1.1"); /* A = C */
    cr_assert_not_null(json = cJSON_Parse(f.out), "%s", f.err);
    const cJSON *holds = at(at(json, "group"), "holds"), *last = cJSON_GetArrayItem(holds, 3);
    cr_assert_eq(cJSON_GetArraySize(holds), 4, "%d of 4 generators", cJSON_GetArraySize(holds));
    for (int i = 0; i < 3; i++) cr_expect_str_eq(cJSON_GetArrayItem(holds, i)->valuestring, "all parameters");
    const cJSON *tied = cJSON_GetArrayItem(last, 0); /* of no value is more needed than that it is the other one's */
    cr_expect(cJSON_GetArraySize(last) == 1 && cJSON_IsString(tied));
    if (tied && cJSON_IsString(tied)) cr_expect(!strcmp(tied->string, "A") ? !strcmp(tied->valuestring, "C") : !strcmp(tied->string, "C") && !strcmp(tied->valuestring, "A"));
    cJSON_Delete(json);
    finished_clear(&f);
    place_clear(&p);
}

/* ---- densities ---- */

Test(parameters_reduce, a_density_says_for_which_values)
{
    cJSON *json = answer(knife, "");
    const cJSON *measure = at(cJSON_GetArrayItem(at(json, "stages"), 0), "measure"), *holds = at(measure, "holds");
    cr_expect_str_eq(at(measure, "density")->valuestring, "cos(p)");
    cr_expect(cJSON_GetArraySize(holds) == 1 && at(holds, "k") && at(holds, "k")->valuedouble == 1);
    cJSON_Delete(json);
    place p = place_make();
    write_here(&p, "own.yaml", knife);
    finished f = run(&p, "reduce -v own.yaml --html page.html"), other = run(&p, "reduce -v own.yaml --set k=2");
    char *page = read_here(&p, "page.html");
    cr_expect_not_null(strstr(f.out, "density = cos(p)\n"), "%s", f.out);
    cr_expect_not_null(strstr(f.out, "the density holds for k = 1"), "%s", f.out);
    cr_expect_not_null(strstr(page, "density"));
    cr_expect_not_null(strstr(page, " for k = 1"));
    cr_expect_not_null(strstr(other.out, "no invariant measure"));
    free(page);
    finished_clear(&f);
    finished_clear(&other);
    place_clear(&p);
}

/* Near a pole of the coordinates 1e-9 of what has to be integrated is lost: at these values the density was not recognised. */
Test(parameters_reduce, a_density_is_found_for_values_far_apart, PLAIN_ONLY)
{
    place p = place_with_systems();
    finished f = run(&p, "reduce -v ball_on_slope --set m=6 --set J=7 --set r=9 --set b=5");
    cr_expect_not_null(strstr(f.out, "density = cos(psi_s)*cos(theta_s)\n"), "%s", f.out);
    finished_clear(&f);
    place_clear(&p);
}

/* Generators that hold for a value are marked wherever the equations of their group are written. */
Test(parameters_reduce, equations_of_a_special_group_say_so)
{
    static const char bowl[] = "name: bowl\nparameters: [{name: k, value: 1}, {name: m, value: 2}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}]\n"
                               "lagrangian: m/2*(x'^2 + y'^2) - (x^2 + k*y^2)/2\n";
    place p = place_make();
    write_here(&p, "own.yaml", bowl);
    finished latex = run(&p, "reduce own.yaml --to latex --initial x=1"), c = run(&p, "reduce own.yaml --to c --initial x=1");
    finished page = run(&p, "reduce -v own.yaml --html page.html --initial x=1");
    char *html = read_here(&p, "page.html");
    cr_expect_not_null(strstr(latex.out, "a group of symmetries for k = 1"), "%s%s", latex.out, latex.err);
    cr_expect_not_null(strstr(c.out, "a group of symmetries for k = 1"), "%s", c.out);
    cr_expect_not_null(strstr(page.out, " for k = 1;"), "%s", page.out);
    cr_expect_not_null(strstr(html, " for k = 1;"));
    free(html);
    finished_clear(&latex);
    finished_clear(&c);
    finished_clear(&page);
    place_clear(&p);
}

/* ---- a sample of bench_parameters ---- */

static void sample(const char *const *name, size_t n, bool currents)
{
    for (size_t i = 0; i < n; i++) {
        if (!sweep_tries(i, 12, 36)) continue;
        char path[200];
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        parameters_row o = parameters_of(path, currents, !currents, 1);
        cr_expect(o.formulas > 0, "%s: no formulas", name[i]);
        for (size_t set = 0; set < PARAMETER_SETS; set++)
            cr_expect(o.drawn[set] && (o.fate[set] == FATE_LETTERS || (set == 2 && o.fate[set] != FATE_OTHER)), "%s, %s: %s", name[i], parameter_set_name[set], o.words);
        cr_expect_eq(o.limited, 0, "%s: %s", name[i], o.words);
        nh_free(o.words);
    }
}

Test(parameters_reduce, reductions_are_the_same_letter_for_letter, PLAIN_ONLY)
{
    static const char *const name[] = {"sleigh", "vertical_disk", "three_bodies", "cart_on_disc", "knife_edge", "routh_sphere", "veselova", "pendulum_in_space", "two_wheel_cart", "disc_on_slope"};
    sample(name, sizeof name / sizeof *name, false);
}

/* For c = 0 the file's equations of motion are not finite; for r = 0 and g = 0 there are other generators, whose combinations the file's are. */
Test(parameters_reduce, what_a_special_value_changes_is_told_apart, PLAIN_ONLY)
{
    static const struct {
        const char *path, *name;
        formula_fate fate;
        bool finite;
    } of[] = {{"systems/rolling_ball.yaml", "r", FATE_FUNCTION, true}, {"systems/two_wheel_carriage.yaml", "c", FATE_NOTHING, false},
              {"systems/perpendicular_velocities.yaml", "g", FATE_FUNCTION, true}};
    nh_options options;
    nh_options_default(&options);
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        parameter_set p = {.count = 1, .setting = {{.name = of[i].name}}, .special = {.name = of[i].name}, .text = "0"};
        parameters_question q = {.currents = !of[i].finite, .reductions = of[i].finite, .options = options};
        formulas was = ask(of[i].path, &q, 0, NULL, p.special), is = ask(of[i].path, &q, 1, p.setting, p.special);
        nh_text words;
        nh_text_init(&words);
        cr_expect_eq(compare_formulas(&was, &is, &p, &words), of[i].fate, "%s: %s", of[i].path, nh_text_string(&words));
        cr_expect_eq(equations_mean_something(&was, p.special), of[i].finite, "%s", of[i].path);
        nh_text_clear(&words);
        formulas_clear(&was);
        formulas_clear(&is);
    }
}

/* The comparison itself: another formula, one that is missing, and one that holds for a value are seen. */
Test(parameters_reduce, the_comparison_sees_what_differs)
{
    formula a[] = {{.name = "Phi1", .text = "a*x"}, {.name = "Phi2", .text = "x'"}}, b[] = {{.name = "Phi1", .text = "2*x"}, {.name = "Phi2", .text = "x'", .limit = "for a = 2"}};
    formulas was = {.count = 2, .list = a, .answered = true}, is = {.count = 2, .list = b, .answered = true}, less = {.count = 1, .list = a, .answered = true};
    parameter_set plain = {.text = "a = 2"}, special = {.special = {"a", 2}, .text = "a = 2"};
    parameters_row o = {0};
    nh_text words;
    nh_text_init(&words);
    cr_expect(compare_formulas(&was, &was, &plain, &words) == FATE_LETTERS && compare_formulas(&less, &was, &special, &words) == FATE_LETTERS);
    cr_expect_str_eq(nh_text_string(&words), "");
    cr_expect(compare_formulas(&was, &is, &plain, &words) == FATE_OTHER && compare_formulas(&was, &less, &plain, &words) == FATE_OTHER && compare_formulas(&was, &is, &special, &words) == FATE_OTHER);
    list_limited(&is, "file", &o, &words);
    cr_expect_eq(o.limited, 1);
    nh_text_clear(&words);
}
