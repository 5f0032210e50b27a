/* Values of a parameter at which there is a measure, a conformal factor, more symmetries or fewer directions: families
 * with known answers, families of particles whose condition for a measure is a formula, planted values, the command. */
#include <criterion/criterion.h>
#include <cjson/cJSON.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "commands/classify.h"
#include "names.h"
#include "program.h"
#include "sweep.h"

/* ---- families ---- */

/* "0 | a = 0: 1 proved": the number for almost all values at the first level, then the special ones. */
static void describe(const nh_classified *x, nh_text *out)
{
    const nh_classification *c = x->classification;
    if (c->obstacle) {
        nh_text_add(out, c->obstacle);
        return;
    }
    nh_text_addf(out, "%zu", c->rows ? c->row[0].number.bound : 0);
    for (size_t k = 0; k < c->specials; k++) {
        const nh_classify_special *v = &c->special[k];
        if (v->open) nh_text_addf(out, " | open %s", nh_classified_words(x, &v->polynomial));
        if (!v->first || v->degenerate) continue;
        nh_text_addf(out, " | %s: %zu%s", nh_classified_words(x, &v->polynomial), v->number[v->first].bound,
                     x->part[k].finding.complete >= v->first ? " proved" : "");
    }
}

static void expect(const char *path, const char *over, nh_linear_question of, const char *expected)
{
    nh_error error = {0};
    nh_text text;
    nh_classify_request q = {.system_path = path, .over = {over}, .of = of};
    nh_options_default(&q.options);
    nh_classified *x = nh_classify_system(&q, &error);
    must(x != NULL, &error, path);
    nh_text_init(&text);
    describe(x, &text);
    cr_expect_str_eq(nh_text_string(&text), expected, "%s, %s: %s, not %s", path, nh_linear_question_name(of),
                     nh_text_string(&text), expected);
    nh_text_clear(&text);
    nh_classified_free(x);
}

#define FAMILY(name) "tests/data/classify/" name ".yaml"

/* Only with its centre of mass on the blade [Borisov and Mamaev 2008]. */
Test(questions, sleigh)
{
    expect(FAMILY("sleigh"), "a", NH_OF_MEASURE, "0 | a = 0: 1 proved");
    expect(FAMILY("sleigh"), "a", NH_OF_HAMILTONIZATION, "0 | a = 0: 1 proved");
    expect(FAMILY("sleigh"), "a", NH_OF_SYMMETRIES, "3");
    expect(FAMILY("sleigh"), "a", NH_OF_INTEGRABILITY, "the equations of this question do not depend on the parameter");
}

/* Suslov's flow keeps a measure only where the constraint's axis is a principal one. */
Test(questions, suslov, PLAIN_ONLY)
{
    expect(FAMILY("suslov"), "D", NH_OF_MEASURE, "0 | D = 0: 1 proved");
    expect(FAMILY("suslov"), "D", NH_OF_HAMILTONIZATION, "0 | D = 0: 1 proved");
}

/* Veselova's system has a measure for every body; with (gamma + b e) W = 0 for b = 0, and for b = +-1, where the constraint is
 * integrable. */
Test(questions, veselova, PLAIN_ONLY)
{
    expect(FAMILY("veselova"), "b", NH_OF_MEASURE, "0 | b = 1: 1 proved | b = 0: 1 proved | b = -1: 1 proved");
    expect(FAMILY("veselova"), "b", NH_OF_INTEGRABILITY, "0 | b = 1: 1 proved | b = -1: 1 proved");
}

/* Three shape coordinates: Chaplygin's ball itself is Hamiltonian only for other forms of the equations, or on levels. */
Test(questions, balls, PLAIN_ONLY)
{
    expect(FAMILY("ball"), "l", NH_OF_HAMILTONIZATION, "0");
    expect(FAMILY("ball"), "l", NH_OF_SYMMETRIES, "3");
}

Test(questions, without_constraints)
{
    expect(FAMILY("oscillators"), "b", NH_OF_SYMMETRIES, "0 | b = 1: 1 proved | b = 0: 1 proved");
    expect(FAMILY("oscillators"), "b", NH_OF_HAMILTONIZATION, "without constraints every system is Hamiltonian");
    expect(FAMILY("oscillators"), "b", NH_OF_MEASURE, "1");
}

/* ---- particles with z' = A x' + B y' ---- */

/* For L = v^2/2 there is a measure, and a factor, where div(a (B_x - A_y)/(1 + a^2)) = 0, a = (A, B): [docs/method.md,
 * sec. 9] with Khat = 1 + a a^T. By differences. */
static double divergence(double k, double x, double y)
{
    static const double h = 1e-4;
    double sum = 0;
    for (int side = -1; side <= 1; side += 2) {
        double at[2][2] = {{x + side * h, y}, {x, y + side * h}};
        for (int i = 0; i < 2; i++) {
            double a[2] = {(k * k - 4) * at[i][1], (k - 2) * at[i][0]}, curvature = k - 2 - (k * k - 4);
            sum += side * a[i] * curvature / (1 + a[0] * a[0] + a[1] * a[1]) / (2 * h);
        }
    }
    return sum;
}

Test(questions, particles, PLAIN_ONLY)
{
    static const double special[] = {2, -1, -2, -3};
    for (size_t i = 0; i < 4; i++) cr_expect_float_eq(divergence(special[i], 0.7, 0.4), 0, 1e-6);
    for (double k = -4.05; k < 4; k += 0.1) cr_expect(fabs(divergence(k, 0.7, 0.4)) > 1e-4, "k = %g", k);
    expect(FAMILY("distribution"), "k", NH_OF_MEASURE,
           "0 | k = 2: 1 proved | k = -1: 1 proved | k = -2: 1 proved | k = -3: 1 proved");
    expect(FAMILY("distribution"), "k", NH_OF_HAMILTONIZATION,
           "0 | k = 2: 1 proved | k = -1: 1 proved | k = -2: 1 proved | k = -3: 1 proved");
    expect(FAMILY("distribution"), "k", NH_OF_INTEGRABILITY, "0 | k = 2: 1 proved | k = -1: 1 proved");
    expect(FAMILY("distribution"), "k", NH_OF_SYMMETRIES, "1 | k = 2: 4 proved | k = -2: 2 proved | k = -3: 2 proved");
}

/* ---- planted values ---- */

static int small(uint64_t *random) { return (int)(nh_residue_random(nh_prime_at(0), random) % 19) - 9; }

/* z' = dS + (bottom k - top)(A x' + B y') with random quadratic A and B, S of degree three: integrable at top/bottom, and
 * nowhere else; without S for comparison. */
static size_t planted(uint64_t *random, bool with, nh_linear_question question, bool *found)
{
    int s[4], a[6], top = small(random), bottom = 1 + abs(small(random)) % 7;
    char text[600];
    for (int i = 0; i < 4; i++) s[i] = small(random);
    for (int i = 0; i < 6; i++) a[i] = small(random);
    snprintf(text, sizeof text, "name: a\nparameters: {k: 0.37}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\n"
             "constraints: [\"z' = (%d*x + %d*y^2 + (%d*k - (%d))*(%d*x*y + %d*y + %d*y^2))*x' + (%d*x*y + %d*y%s + (%d*k - (%d))*"
             "(%d*x^2 + %d*x + %d*y^2))*y'\"]\n", s[0], s[1], bottom, top, a[0], a[1] ? a[1] : 1, a[2], 2 * s[1], s[2],
             with ? "" : " + 3*x + x^2", bottom, top, a[3], a[4], a[5]);
    nh_error error = {0};
    nh_system *y = nh_system_parse("a.yaml", text, 0, NULL, &error);
    must(y != NULL, &error, text);
    nh_model *o = nh_model_create(y, nh_chart_create(y, NH_CHART_AUTO, 1, &error), &error);
    must(o != NULL, &error, text);
    nh_options options;
    nh_options_default(&options);
    nh_linear_system *l = nh_linear_system_create(o, question, &options);
    cr_assert_null(l->obstacle, "%s", l->obstacle);
    nh_classify_question q = {.parameters = 1, .linear = &l->family, .work = 1e10, .products = 5e10, .unknowns = 6000};
    nh_classification *c = nh_classify(o, &q);
    size_t values = 0;
    for (size_t i = 0; i < c->specials; i++) {
        const nh_special_factor *f = &c->special[i].polynomial;
        if (!c->special[i].first) continue;
        values++;
        *found |= f->degree[0] == 1 && f->coefficient[1] * top + f->coefficient[0] * bottom == 0;
    }
    cr_expect_gt(c->rows, 0, "%s", text);
    nh_classification_free(c);
    nh_linear_system_free(l);
    nh_model_free(o);
    nh_system_free(y);
    return values;
}

Test(questions, planted_values_are_found, PLAIN_ONLY)
{
    uint64_t random = 17;
    for (int i = 0; i < 24; i++) {
        bool with = i % 2, found = false;
        nh_linear_question of = i % 4 < 2 ? NH_OF_MEASURE : NH_OF_INTEGRABILITY;
        size_t values = planted(&random, with, of, &found);
        cr_expect_eq(found, with, "round %d", i);
        cr_expect_eq(values, (size_t)with, "round %d: %zu", i, values);
    }
}

/* ---- the command ---- */

Test(questions, the_command)
{
    place p = place_make();
    char line[400];
    snprintf(line, sizeof line, "classify %.300s/tests/data/classify/suslov.yaml --over D --of measure --quiet --json -",
             p.project);
    finished f = run(&p, line);
    cr_assert_eq(f.code, 0, "%s", f.err);
    cJSON *root = cJSON_Parse(f.out), *value = cJSON_GetArrayItem(cJSON_GetObjectItem(root, "special"), 0);
    cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(root, "of")), "measure");
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(root, "nowhere_else")));
    cr_expect(cJSON_IsTrue(cJSON_GetObjectItem(value, "proved")));
    cr_expect_not_null(strstr(cJSON_GetStringValue(cJSON_GetObjectItem(value, "shown")), "exp(sigma) = cos(h)"));
    cJSON_Delete(root);
    finished_clear(&f);
    f = run(&p, "classify x.yaml --over D --of mesure");
    cr_expect_eq(f.code, NH_USAGE);
    cr_expect_not_null(strstr(f.err, "did you mean `measure`?"), "%s", f.err);
    finished_clear(&f);
    f = run(&p, "classify x.yaml --over D,E --of symmetries");
    cr_expect_eq(f.code, NH_USAGE);
    cr_expect_not_null(strstr(f.err, "one parameter"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}
