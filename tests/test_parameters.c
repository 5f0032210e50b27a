/* Parameters stay symbols: a number in a formula is no parameter's value, and what needs a value says so. */
#include "program.h"

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

/* ---- currents ---- */

Test(parameters, only_the_special_one_is_fixed)
{
    cJSON *root = answer("analyze sleigh --json - --set k=1 --set a=0.7");
    const cJSON *phi = current(root, "m*(v*sin(phi) + a*omega*cos(phi))"), *holds = cJSON_GetObjectItemCaseSensitive(phi, "holds");
    cr_assert_not_null(phi, "the momentum along a fixed direction is not there with its parameters");
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItemCaseSensitive(phi, "proved")) && cJSON_IsFalse(cJSON_GetObjectItemCaseSensitive(phi, "proved_for_all_parameters")));
    cr_expect(cJSON_GetArraySize(holds) == 1 && number_of(holds, "k") == 1, "holds: %s", cJSON_PrintUnformatted(holds));
    char *field = cJSON_PrintUnformatted(cJSON_GetObjectItemCaseSensitive(phi, "symmetry"));
    cr_expect_null(strstr(field, "k^2"), "the field has k: %s", field);
    cJSON_free(field);
    const cJSON *first = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "currents"), 0);
    cr_expect_str_eq(text_of(first, "holds"), "all parameters");
    cJSON_Delete(root);
}

Test(parameters, a_claim_is_verified_with_the_values_that_it_needs)
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
Test(parameters, momenta_of_three_bodies_hold_for_all_masses)
{
    cJSON *root = answer("analyze three_bodies --json -");
    const cJSON *item;
    cJSON_ArrayForEach(item, cJSON_GetObjectItemCaseSensitive(root, "currents")) cr_expect_str_eq(text_of(item, "holds"), "all parameters", "%s", text_of(item, "expression"));
    cJSON_Delete(root);
}

/* ---- groups ---- */

static const cJSON *momentum(const cJSON *root, size_t i) { return cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "momenta"), (int)i); }

Test(parameters, gauge_momenta_have_parameters_whatever_the_values)
{
    static const char *const line[] = {"reduce vertical_disk --json -", "reduce vertical_disk --json - --set r=0.6173", "reduce vertical_disk --json - --set r=2 --set J=3"};
    for (size_t i = 0; i < 3; i++) {
        cJSON *root = answer(line[i]);
        const cJSON *p = momentum(root, 1);
        cr_expect_str_eq(text_of(p, "expression"), "J*h'/r + m*(y'*sin(p) + x'*cos(p))", "%s", line[i]);
        cr_expect_str_eq(text_of(cJSON_GetObjectItemCaseSensitive(p, "field"), "h"), "1/r");
        cr_expect_str_eq(text_of(p, "holds"), "all parameters");
        cJSON_Delete(root);
    }
}

/* The masses' ratio, although both sums of distances keep their roots in the potential. */
Test(parameters, generators_have_parameters_whatever_the_values)
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

Test(parameters, a_second_group_has_parameters)
{
    cJSON *root = answer("reduce routh_sphere --json -");
    const cJSON *second = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(root, "stages"), 1), *field = cJSON_GetArrayItem(cJSON_GetObjectItemCaseSensitive(second, "generators"), 0);
    cr_expect_str_eq(text_of(field, "p"), "r/l");
    cr_expect_str_eq(text_of(field, "s"), "1");
    cJSON_Delete(root);
}
