/* The motions of the stages beside the full one: as comma-separated values, in the JSON, and as figures; against a closed form. */
#include <cjson/cJSON.h>
#include <math.h>

#include "program.h"
#include "sweep.h"

/* A coin of radius R that rolls upright: a' and b' are constant, and  x' = R a' cos(b), y' = R a' sin(b). */
static const char coin[] = "name: coin\nparameters: [{name: M, value: 1.7}, {name: J, value: 0.3}, {name: K, value: 0.2}, {name: R, value: 0.9}]\n"
                           "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: a, type: angle}, {name: b, type: angle}]\n"
                           "lagrangian: M/2*(x'^2 + y'^2) + J/2*a'^2 + K/2*b'^2\n"
                           "constraints: [\"x' = R*a'*cos(b)\", \"y' = R*a'*sin(b)\"]\n";

static double exact(char name, double t)
{
    static const double R = 0.9, spin = 1.2, turn = 0.7, b0 = 0.5;
    double b = b0 + turn * t;
    switch (name) {
    case 'x': return R * spin / turn * (sin(b) - sin(b0));
    case 'y': return R * spin / turn * (cos(b0) - cos(b));
    case 'a': return spin * t;
    default: return b;
    }
}

static const char *const INITIAL = "reduce coin.yaml --initial x=0,y=0,a=0,b=0.5,a'=1.2,b'=0.7 --until 4";

static finished coin_run(const place *p, const char *also, int code)
{
    char line[300];
    snprintf(line, sizeof line, "%s %s", INITIAL, also);
    return run_expecting(p, line, code);
}

/* The coordinate of a column, such as that of stage1.x; 0 for a momentum. */
static char coordinate_of(const char *column)
{
    const char *dot = strchr(column, '.'), *name = dot ? dot + 1 : column;
    return strlen(name) == 1 ? *name : 0;
}

Test(reduced_motion, every_row_is_the_closed_form)
{
    place p = place_make();
    write_here(&p, "coin.yaml", coin);
    finished f = coin_run(&p, "--to csv", 0);
    char column[40][60] = {{0}};
    size_t columns = 0, rows = 0, compared = 0;
    char *line = strtok(f.out, "\n");
    for (const char *c = line; *c && columns < 40; c += *c == ',') {
        size_t length = strcspn(c, ",");
        snprintf(column[columns++], sizeof *column, "%.*s", (int)length, c);
        c += length;
    }
    cr_assert_str_eq(column[0], "t");
    while ((line = strtok(NULL, "\n"))) {
        double t = strtod(line, NULL);
        const char *c = line;
        for (size_t k = 0; k < columns; k++, c += strcspn(c, ","), c += *c == ',') {
            char name = coordinate_of(column[k]);
            if (!k || !name) continue;
            cr_expect_float_eq(strtod(c, NULL), exact(name, t), 1e-8, "%s at t = %g: %.30s", column[k], t, c);
            compared++;
        }
        cr_expect_eq(*c, 0, "more cells than columns");
        rows++;
    }
    cr_expect_eq(rows, 81u);
    cr_expect_geq(compared, rows * 12, "the full motion and two stages of four coordinates");
    finished_clear(&f);
    place_clear(&p);
}

Test(reduced_motion, the_json_has_what_the_table_has)
{
    place p = place_make();
    write_here(&p, "coin.yaml", coin);
    finished f = coin_run(&p, "--json", 0);
    cJSON *root = cJSON_Parse(f.out), *stage;
    cr_assert_not_null(root, "%.300s", f.out);
    cr_expect_eq(cJSON_GetArraySize(cJSON_GetObjectItem(cJSON_GetObjectItem(root, "full_motion"), "time")), 81);
    cJSON_ArrayForEach(stage, cJSON_GetObjectItem(root, "stages")) {
        const cJSON *motion = cJSON_GetObjectItem(stage, "motion"), *time = cJSON_GetObjectItem(motion, "time"), *place_of, *momentum;
        cJSON_ArrayForEach(place_of, cJSON_GetObjectItem(motion, "places"))
            for (int i = 0; i < cJSON_GetArraySize(time); i += 8)
                cr_expect_float_eq(cJSON_GetNumberValue(cJSON_GetArrayItem(place_of, i)),
                                   exact(place_of->string[0], cJSON_GetNumberValue(cJSON_GetArrayItem(time, i))), 1e-8, "%s", place_of->string);
        cr_expect_gt(cJSON_GetArraySize(cJSON_GetObjectItem(motion, "momenta")), 0);
        cJSON_ArrayForEach(momentum, cJSON_GetObjectItem(motion, "momenta")) { /* nothing turns the coin or drives it */
            double first = cJSON_GetNumberValue(cJSON_GetArrayItem(momentum, 0)), last = cJSON_GetNumberValue(cJSON_GetArrayItem(momentum, 80));
            cr_expect(fabs(first) > 0.01 && fabs(last - first) < 1e-8, "%s: %g, %g", momentum->string, first, last);
        }
    }
    cJSON_Delete(root);
    finished_clear(&f);
    place_clear(&p);
}

static size_t times(const char *text, const char *word)
{
    size_t n = 0;
    for (const char *c = text; (c = strstr(c, word)); c++) n++;
    return n;
}

Test(reduced_motion, every_stage_has_its_figures)
{
    place p = place_make();
    write_here(&p, "coin.yaml", coin);
    finished f = coin_run(&p, "--quiet --html page.html --tex page.tex", 0);
    char *page = read_here(&p, "page.html"), *tex = read_here(&p, "page.tex");
    size_t stages = times(page, "<h3>Stage ") + times(page, "<h3>In one step, stage ") + times(page, "<h3>Instead of one step, stage ");
    cr_assert_gt(stages, 1u);
    cr_expect_eq(times(page, "Its motion beside the full one"), stages);
    cr_expect_geq(times(page, "<figure>"), 2 * stages);
    cr_expect_eq(times(tex, "\\begin{axis}"), times(page, "<figure>") - times(page, "<div class=\"still\"><figure>"), "the page's first screen has a picture more");
    free(page), free(tex);
    finished_clear(&f);
    finished other = run_expecting(&p, "export coin.yaml --to csv", 2);
    cr_expect_not_null(strstr(other.err, "no language `csv`"), "%s", other.err);
    finished_clear(&other);
    place_clear(&p);
}

/* Two driven wheels under a group for which the printed equations and the motion have different independent velocities: momenta of others have no column
 * and no figure, as some of them have the name of a printed one. */
Test(reduced_motion, momenta_are_those_of_the_printed_equations, PLAIN_ONLY)
{
    place p = place_make();
    write_here(&p, "arm.yaml", "name: arm\nparameters: [{name: m, value: 1.2}, {name: l, value: 0.5}]\n"
               "bodies: [{name: cart, mass: m, inertia: [0.1, 0.1, 0.4]}, {name: hand, mass: 0.7, inertia: [0.1, 0.1, 0.2], center: [0.2, 0, 0]}]\n"
               "joints:\n  - {type: planar, child: cart, coordinates: [x, y, h]}\n  - {type: revolute, parent: cart, child: hand, at: [l, 0, 0], coordinates: [p]}\n"
               "wheels: [{type: knife-edge, body: hand, at: [0.6, 0, 0], axis: y}]\n");
    finished f = run_expecting(&p, "reduce -v arm.yaml --csv a.csv", 0);
    char *table = read_here(&p, "a.csv"), *name = strtok(table, ",\n");
    char *end = strstr(f.out, "\nStage 2");
    cr_assert_not_null(end, "%s", f.out);
    *end = 0;
    cr_expect_eq(times(f.out, "\n  p_x = "), 1);
    for (bool line = true; name && line; name = strtok(NULL, ",")) {
        char words[100];
        line = !strchr(name, '\n');
        if (strncmp(name, "stage1.p_", 9) && strncmp(name, "stage1.mu_", 10)) continue;
        snprintf(words, sizeof words, "\n  %s = ", name + 7);
        cr_expect_geq(times(f.out, words), 1, "%s is no momentum of the printed equations", name);
    }
    free(table);
    finished_clear(&f);
    place_clear(&p);
}
