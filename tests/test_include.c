/* include: what is united, what is replaced, and in which file a mistake is told. */
#include <criterion/criterion.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "problem/analysis_file.h"
#include "system/system.h"

static char folder[] = "/tmp/nhsym-include-XXXXXX";

static void put(const char *name, const char *text)
{
    char path[200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "w");
    cr_assert_not_null(file);
    fputs(text, file);
    fclose(file);
}

static nh_system *get(const char *name, nh_error *error)
{
    char path[200];
    nh_error_clear(error);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    return nh_system_read(path, 0, NULL, error);
}

static void setup(void)
{
    cr_assert_not_null(mkdtemp(folder));
    char parts[200];
    snprintf(parts, sizeof parts, "%s/parts", folder);
    mkdir(parts, 0700);
    put("parts/spring.yaml", "name: spring\ntitle: A spring\nparameters:\n  - {name: k, value: 2}\n  - {name: m, value: 3}\ncoordinates: [x]\n"
                             "definitions:\n  - V = k*x^2/2\nlagrangian: m*x'^2/2 - V\ndomain: {x: [0.5, 1]}\n");
}

static void teardown(void)
{
    static const char *const names[] = {"parts/spring.yaml", "two.yaml", "three.yaml", "bad.yaml", "parts/broken.yaml", "word.yaml", "parts/word.yaml"};
    char path[200];
    for (size_t i = 0; i < sizeof names / sizeof *names; i++) {
        snprintf(path, sizeof path, "%s/%s", folder, names[i]);
        unlink(path);
    }
    snprintf(path, sizeof path, "%s/parts", folder);
    rmdir(path);
    rmdir(folder);
}

TestSuite(include, .init = setup, .fini = teardown);

static void check_parameters(const nh_system *s)
{
    static const char *const names[] = {"k", "m", "c"};
    static const double values[] = {5, 3, 7};
    cr_assert_eq(s->parameters, 3);
    for (size_t i = 0; i < 3; i++) {
        cr_expect_str_eq(s->parameter[i].name, names[i]);
        cr_expect_eq(s->parameter[i].value, values[i]);
    }
}

Test(include, lists_grow_maps_unite_and_the_later_file_decides)
{
    nh_error error;
    put("two.yaml", "include: parts/spring.yaml\nname: two\nparameters:\n  - {name: k, value: 5}\n  - {name: c, value: 7}\ncoordinates: [y]\n"
                    "definitions:\n  - W = c*(x - y)^2/2\nlagrangian: m*(x'^2 + y'^2)/2 - V - W\ndomain: {y: [1, 2]}\n");
    put("three.yaml", "include: two.yaml\nname: three\nforces: [\"x = -c*x'\"]\n");
    nh_system *s = get("three.yaml", &error);
    cr_assert_not_null(s, "%s", error.what);
    cr_expect_str_eq(s->name, "three");
    cr_expect_str_eq(s->title, "A spring");
    check_parameters(s);
    cr_assert_eq(s->coordinates, 2);
    cr_expect_str_eq(s->coordinate[1].name, "y");
    cr_expect_eq(s->definitions, 2);
    cr_expect_eq(s->intervals, 2);
    cr_expect(s->has_forces);
    nh_ex e;
    cr_assert(nh_system_expression_text(s, "test", "m*(x'^2 + y'^2)/2 - k*x^2/2 - c*(x - y)^2/2", 0, NULL, &e, &error));
    cr_expect_eq(e, s->lagrangian);
    nh_system_free(s);
}

/* `two` and `three`, one after the other built upon the spring, have k = 5, m = 3 and c = 7 in this order. */
static void try_parameters(const char *two, const char *three)
{
    nh_error error;
    put("two.yaml", two);
    put("three.yaml", three);
    nh_system *s = get("three.yaml", &error);
    cr_assert_not_null(s, "%s", error.what);
    check_parameters(s);
    cr_expect_str_eq(s->parameter[2].unit, "N/m");
    nh_system_free(s);
}

Test(include, parameters_may_be_a_map_in_any_of_the_files)
{
    try_parameters("include: parts/spring.yaml\nparameters: {k: 5, c: {value: 7, unit: N/m}}\n", "include: two.yaml\nname: three\n");
    try_parameters("include: parts/spring.yaml\nparameters: {c: 8}\n", "include: two.yaml\nparameters:\n  - {name: k, value: 5}\n  - {name: c, value: 7, unit: N/m}\n");
    nh_error error;
    put("bad.yaml", "name: bad\nparameters: {k: 5, c: {value: 7, unti: N/m}}\ncoordinates: [x]\nlagrangian: x'^2\n");
    cr_assert_null(get("bad.yaml", &error));
    cr_expect(strstr(error.where, "bad.yaml:2:34"), "%s", error.where);
    cr_expect_str_eq(error.hint, "did you mean `unit`?");
}

/* A file of an earlier version, and one of today that builds on it. */
Test(include, old_names_of_keys_are_those_of_today)
{
    nh_error error;
    put("two.yaml", "name: two\ncoordinates: [x, y]\nlagrangian: x'^2 + y'^2\nchart: {velocities: [u], map: [\"x' = u\"]}\n"
                    "stress: [{name: long, over: \"until=1:10\", chart: quasi}]\n");
    put("three.yaml", "include: two.yaml\nvelocities: {names: [w], map: [\"y' = w\"]}\nrobustness: [{name: longer, over: \"until=1:100\", velocities: coordinates}]\n");
    nh_system *s = get("three.yaml", &error);
    cr_assert_not_null(s, "%s %s", error.where, error.what);
    cr_assert_eq(s->quasi, 2);
    cr_expect(s->quasi_map[0] == s->quasi_velocity[0] && s->quasi_map[1] == s->quasi_velocity[1]);
    cr_assert_eq(s->robustness_maps, 2);
    cr_expect_str_eq(s->robustness_map[0].velocities, "quasi");
    cr_expect_str_eq(s->robustness_map[1].velocities, "coordinates");
    nh_system_free(s);
    put("three.yaml", "system: two\nchart: coordinates\n");
    char path[200];
    snprintf(path, sizeof path, "%s/three.yaml", folder);
    nh_analysis_file *a = nh_analysis_file_read(path, &error);
    cr_assert_not_null(a, "%s", error.what);
    cr_expect_eq(a->chart, NH_CHART_COORDINATES);
    nh_analysis_file_free(a);
}

Test(include, mistakes_are_told_where_they_stand)
{
    nh_error error;
    put("parts/broken.yaml", "name: broken\ncoordinates: [x]\nlagrangian: x'^2 - q\n");
    put("bad.yaml", "include: parts/broken.yaml\nname: bad\n");
    cr_assert_null(get("bad.yaml", &error));
    cr_expect(strstr(error.where, "parts/broken.yaml:3:"), "%s", error.where);
    cr_expect(strstr(error.excerpt, "lagrangian: x'^2 - q"), "%s", error.excerpt);
    put("bad.yaml", "include: parts/spring.yaml\nname: bad\nforces: [z = 1]\n");
    cr_assert_null(get("bad.yaml", &error));
    cr_expect(strstr(error.where, "bad.yaml:3:"), "%s", error.where);
    cr_expect(strstr(error.excerpt, "forces: [z = 1]"), "%s", error.excerpt);
}

Test(include, an_included_file_is_a_system_file)
{
    nh_error error;
    put("parts/word.yaml", "- spring\n");
    put("word.yaml", "include: parts/word.yaml\n");
    cr_assert_null(get("word.yaml", &error));
    cr_expect(strstr(error.where, "parts/word.yaml:1:1"), "%s", error.where);
}
