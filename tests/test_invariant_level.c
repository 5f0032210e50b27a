/* Systems on levels of their integrals: the same motions as without the level, refusals, and special values on a level. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "exact/residue.h"
#include "geometry/model.h"
#include "graph/node.h"
#include "graph/num.h"
#include "program.h"
#include "sweep.h"

static nh_model *model_of(const char *text, const char *levels, nh_error *error)
{
    char all[2000];
    nh_error_clear(error);
    snprintf(all, sizeof all, "%s%s", text, levels);
    nh_system *s = nh_system_parse("level.yaml", all, 0, NULL, error);
    nh_chart *chart = s ? nh_chart_create(s, NH_CHART_AUTO, 1, error) : NULL;
    nh_model *o = chart ? nh_model_create(s, chart, error) : NULL;
    if (!o) nh_system_free(s);
    return o;
}

static void clear(nh_model *o)
{
    nh_system *s = o->system;
    nh_model_free(o);
    nh_system_free(s);
}

/* ---- motions ---- */

/* v^s and its rate at a point, by the tape of a model. */
static void motion(nh_model *o, const double *z, double *out)
{
    nh_ex *e = nh_alloc_array(2 * o->m, sizeof *e);
    for (size_t s = 0; s < o->m; s++) e[s] = o->rho[s], e[o->m + s] = nh_model_gamma(o, o->rho[s]);
    nh_tape *tape = nh_model_tape(o, 2 * o->m, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    nh_tape_eval(tape, work, z, out);
    nh_tape_work_free(work);
    nh_tape_free(tape);
    nh_free(e);
}

/* Accelerations on the level are those of the whole system, whose velocities are coordinate velocities. */
static void expect_same_motion(const char *text, const char *levels)
{
    nh_error error;
    nh_model *whole = model_of(text, "", &error), *level = model_of(text, levels, &error);
    cr_assert(whole && level, "%s: %s", text, error.what);
    uint64_t random = 7;
    for (int trial = 0; trial < 5; trial++) {
        double z[12] = {0}, full[12] = {0}, on[12], of[12];
        for (size_t i = 1; i < level->width; i++) z[i] = 0.3 + 0.5 * (double)(nh_residue_random(nh_prime_at(0), &random) % 1000) / 1000;
        motion(level, z, on);
        memcpy(full, z, (1 + level->m) * sizeof *z);
        for (size_t i = 0; i < whole->n; i++) {
            size_t s = whole->chart->free ? whole->chart->free[i] : i;
            full[1 + whole->m + i] = on[s];
        }
        motion(whole, full, of);
        for (size_t s = 0; s < 2 * level->m; s++) cr_expect_float_eq(on[s], of[s], 1e-9 * (1 + fabs(of[s])), "%s%s: %zu: %g, not %g", text, levels, s, on[s], of[s]);
    }
    clear(whole);
    clear(level);
}

static const char LAGRANGE[] = "name: top\nparameters: {A: 1.3, C: 0.7}\ncoordinates: [{name: phi, type: angle}, {name: theta, type: angle}, {name: psi, type: angle}]\n"
                               "lagrangian: A*(theta'^2 + phi'^2*sin(theta)^2)/2 + C*(psi' + phi'*cos(theta))^2/2 - cos(theta)\n";
static const char ROUND[] = "name: round\nparameters: {k: 0.4}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2)^2 - k*z^2*(x^2 + y^2)\n";
static const char EDGE[] = "name: edge\ncoordinates: [{name: phi, type: angle}, x, y]\nlagrangian: (x'^2 + y'^2 + 2*phi'^2)/2\nconstraints: [\"y'*cos(phi) = x'*sin(phi)\"]\n";

Test(invariant_level, motions_are_those_of_the_whole_system)
{
    expect_same_motion(LAGRANGE, "levels: [p_phi = 0]\n");
    expect_same_motion(LAGRANGE, "levels: [p_psi = 0]\n");
    expect_same_motion(LAGRANGE, "levels: [p_psi = 0, p_phi = 0]\n");
    expect_same_motion(LAGRANGE, "levels: [p_psi = A/3]\n"); /* affine: the program's own velocities */
    expect_same_motion(ROUND, "levels: [\"x*y' - y*x' = 0\"]\n");
    expect_same_motion(ROUND, "levels: [\"x*y' = y*x' + 1/5\"]\n");
    expect_same_motion(EDGE, "levels: [\"phi' = 0\"]\n");
    expect_same_motion(EDGE, "levels: [\"phi' = 1/2\"]\n");
}

/* The fields of the velocities have no denominators. */
Test(invariant_level, velocities_are_polynomial)
{
    nh_error error;
    nh_model *o = model_of(LAGRANGE, "levels: [p_phi = 0]\n", &error);
    cr_assert_not_null(o, "%s", error.what);
    cr_assert_eq(o->n, 2);
    cr_expect_str_eq(nh_name_of(o->dag, o->chart->w[0]), "v_theta");
    cr_expect_str_eq(nh_name_of(o->dag, o->chart->w[1]), "v_psi");
    for (size_t s = 0; s < o->m; s++) {
        NH_LIST(found);
        size_t count = nh_products_in(o->dag, o->rho[s], &found);
        for (size_t i = 0; i < count; i++)
            for (size_t k = 0; k < nh_arity(o->dag, found[i]); k++) cr_expect_gt(nh_num_value(nh_number_of(o->dag, nh_exponent_of(o->dag, found[i], k))), 0);
    }
    clear(o);
}

/* ---- refusals ---- */

Test(invariant_level, what_is_no_level_is_refused)
{
    static const struct {
        const char *levels, *what, *hint;
    } CASES[] = {
        {"levels: [p_theta = 0]\n", "motions leave this level: it is not one of an integral", "phi does not occur in the Lagrangian: `p_phi` may be constant"},
        {"levels: [p_phi^2 = 0]\n", "this level is not linear in the velocities", "write it as a momentum or another integral linear in the velocities, for example `p_phi = 0`"},
        {"levels: [theta = 1]\n", "this level contains no velocity", "write it as a momentum or another integral linear in the velocities, for example `p_phi = 0`"},
        {"levels: [p_ph = 0]\n", "unknown name `p_ph`", "did you mean `p_phi`?"},
        {"levels: p_phi = 0\n", "levels", ""},
    };
    for (size_t i = 0; i < sizeof CASES / sizeof *CASES; i++) {
        nh_error error;
        cr_assert_null(model_of(LAGRANGE, CASES[i].levels, &error));
        cr_expect(strstr(error.what, CASES[i].what), "%s: %s", CASES[i].levels, error.what);
        cr_expect(strstr(error.hint, CASES[i].hint), "%s: %s", CASES[i].levels, error.hint);
    }
}

/* ---- classification ---- */

static const cJSON *get(const cJSON *item, const char *name) { return cJSON_GetObjectItemCaseSensitive(item, name); }

/* Goryachev's and Chaplygin's top from the family of all tops with two equal moments, which holds no level: [BorisovMamaev2005]. */
Test(invariant_level, goryachev_and_chaplygin_are_found, WHOLE_ONLY)
{
    place p = place_make();
    char line[500];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/top.yaml --over C --shape --degree 3 --on p_phi=0 --json - --quiet", p.project);
    finished f = run(&p, line);
    cr_assert_eq(f.code, 0, "%s", f.err);
    cJSON *root = cJSON_Parse(f.out);
    cr_assert_str_eq(cJSON_GetArrayItem(get(root, "levels"), 0)->valuestring, "p_phi=0");
    size_t special = 0;
    const cJSON *v;
    cJSON_ArrayForEach(v, get(root, "special"))
    {
        const char *value = get(get(v, "where"), "C")->valuestring;
        special++;
        cr_expect(cJSON_IsTrue(get(v, "proved")), "C = %s", value);
        if (!strcmp(value, "1/4")) cr_expect_eq(get(v, "from_degree")->valueint, 3);
        else cr_expect_str_eq(value, "1");
    }
    cr_expect_eq(special, 2);
    cJSON_Delete(root);
    finished_clear(&f);
    place_clear(&p);
}
