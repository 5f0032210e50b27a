/* Two parameters beyond the largest determinant: lines of rational values of the first one. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <string.h>

#include "program.h"
#include "sweep.h"

static const cJSON *key(const cJSON *object, const char *name) { return cJSON_GetObjectItem(object, name); }

static cJSON *classified(const char *words)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/%.150s --quiet --json -", p.project, words);
    finished f = run(&p, line);
    cr_assert_eq(f.code, 0, "%s: %s", line, f.err);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_not_null(root, "%s", line);
    finished_clear(&f);
    place_clear(&p);
    return root;
}

/* "eps - 2 = 0@2 1,1/3@2": curves, then points, with the degrees from which on they are special; all of them are proved. */
static void expect(const cJSON *root, const char *first, const char *second, const char *expected)
{
    char found[600] = "";
    const cJSON *item;
    cJSON_ArrayForEach(item, key(root, "special"))
    {
        const cJSON *where = key(item, "where");
        size_t at = strlen(found);
        const char *gap = at ? " " : "";
        int degree = key(item, "from_degree")->valueint;
        if (cJSON_IsString(where)) snprintf(found + at, sizeof found - at, "%s%s@%d", gap, where->valuestring, degree);
        else snprintf(found + at, sizeof found - at, "%s%s,%s@%d", gap, key(where, first)->valuestring, key(where, second)->valuestring, degree);
        cr_expect(cJSON_IsTrue(key(item, "proved")), "%s", found);
    }
    cr_expect_str_eq(found, expected);
}

static const cJSON *degree(const cJSON *root, int d) { return cJSON_GetArrayItem(key(root, "degrees"), d - 1); }

/* What determinants of size 31 say (test_plane), by lines. */
Test(plane_sweep, lines_find_what_determinants_find, PLAIN_ONLY)
{
    cJSON *root = classified("henon_heiles.yaml --over B,eps --set A=1 --degree 4 --option plane=20 --option lines=16");
    expect(root, "B", "eps", "eps - 2 = 0@2 1,1/3@2 16,16/3@4");
    cr_expect_eq(key(degree(root, 3), "lines")->valueint, 0);
    cr_expect_eq(key(degree(root, 4), "lines")->valueint, 318);
    cr_expect_eq(key(degree(root, 4), "excluded_height")->valueint, 16);
    cJSON_Delete(root);
}

/* What lies beyond the height is not found, and not excluded either. */
Test(plane_sweep, no_more_is_excluded_than_was_looked_at, PLAIN_ONLY)
{
    cJSON *root = classified("henon_heiles.yaml --over B,eps --set A=1 --degree 4 --option plane=20 --option lines=7");
    expect(root, "B", "eps", "eps - 2 = 0@2 1,1/3@2");
    cr_expect_eq(key(degree(root, 4), "excluded_height")->valueint, 7);
    cJSON_Delete(root);
}

/* Curves that determinants are too large for are found from their points on lines. */
Test(plane_sweep, curves_from_points_on_lines)
{
    cJSON *root = classified("henon_heiles.yaml --over B,eps --set A=1 --degree 2 --option plane=2 --option lines=3");
    expect(root, "B", "eps", "eps - 2 = 0@2 1,1/3@2");
    cr_expect_eq(key(degree(root, 1), "lines")->valueint, 0);
    cr_expect_eq(key(degree(root, 2), "excluded_height")->valueint, 3);
    cJSON_Delete(root);
}

/* Lines share the work of their degree: what was not reached is not excluded. */
Test(plane_sweep, work_ends_the_lines, PLAIN_ONLY)
{
    cJSON *root = classified("henon_heiles.yaml --over B,eps --set A=1 --degree 3 --option plane=2 --option staircase=1e6");
    int height = key(degree(root, 3), "excluded_height")->valueint;
    expect(root, "B", "eps", "eps - 2 = 0@2 1,1/3@2");
    cr_expect_eq(key(degree(root, 2), "excluded_height")->valueint, 10);
    cr_expect(height >= 1 && height < 10, "%d", height);
    cJSON_Delete(root);
}

/* Tops with the centre of mass on an axis: Lagrange's, which are a curve, and Kovalevskaya's, once for each equatorial axis; not Euler's, which has no weight. */
Test(plane_sweep, heavy_tops, WHOLE_ONLY)
{
    cJSON *root = classified("heavy_tops.yaml --over b,c --shape --degree 4 --option plane=20 --option lines=2");
    expect(root, "b", "c", "c - b = 0@1 1,2@4 2,1@4");
    cr_expect_eq(cJSON_GetArraySize(key(root, "degrees")), 4);
    cJSON_Delete(root);
}
