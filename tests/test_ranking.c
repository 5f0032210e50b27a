/* What a chart leaves for later runs: how equations are recognised again, where it is kept, and what is chosen from it. */
#include "base/cache.h"
#include "expr/fingerprint.h"
#include "mechanics.h"
#include "motion/accuracy.h"
#include "program.h"
#include "random_expression.h"
#include "study/ranking.h"
#include "study/reduce.h"

/* ---- fingerprints ---- */

static uint64_t fingerprint_of(const char *text, const char *first)
{
    nh_dag *d = nh_dag_create();
    parsed(d, first); /* what was made before decides the order inside the graph */
    nh_ex in[2] = {nh_symbol(d, "x"), nh_symbol(d, "y")}, fixed = nh_symbol(d, "a"), e = parsed(d, text);
    uint64_t out = nh_fingerprint(d, 1, &e, 2, in, 1, &fixed, (double[]){0.1});
    nh_dag_free(d);
    return out;
}

Test(ranking, equal_expressions_are_recognised)
{
    static const char *const equal[][2] = {{"(x + y)^2", "x^2 + 2*x*y + y^2"},       {"sin(x - y)", "-sin(y - x)"},       {"cos(x - y)/(x - y)", "-cos(y - x)/(y - x)"},
                                           {"sqrt(x + y)*sqrt(x + y)", "x + y"},      {"a*x", "x/10"},                     {"x^(-3/2)*x^2", "sqrt(x)"},
                                           {"(x^2 - y^2)/(x - y)", "x + y"},          {"exp(x + y - x)", "exp(y)"},        {"1/(1 + 1/x)", "x/(x + 1)"}};
    static const char *const different[][2] = {{"x - y", "y - x"}, {"sin(x)", "cos(x)"}, {"sqrt(x)", "x"}, {"x^2", "x^3"}, {"a*x", "0.1000001*x"}, {"atan2(x, y)", "atan2(y, x)"}, {"x", "y"},
                                               {"x^0.3333333", "x^(1/3)"}, {"exp(x)", "exp(-x)"}, {"sin(x - y)", "sin(y - x)"}, {"x^y", "y^x"}};
    for (size_t i = 0; i < sizeof equal / sizeof *equal; i++) cr_expect_eq(fingerprint_of(equal[i][0], "y - x"), fingerprint_of(equal[i][1], "x - y"), "%s, %s", equal[i][0], equal[i][1]);
    for (size_t i = 0; i < sizeof different / sizeof *different; i++) cr_expect_neq(fingerprint_of(different[i][0], "x"), fingerprint_of(different[i][1], "x"), "%s, %s", different[i][0], different[i][1]);
    cr_expect_eq(fingerprint_of("sin(x - y) + x*(x - y)", "y - x"), fingerprint_of("sin(x - y) + x*(x - y)", "x"));
}

/* In another graph and another order; and no two of many agree by accident. */
Test(ranking, random_expressions_have_fingerprints_of_their_own)
{
    enum { MANY = 400 };
    source s = source_create(5);
    uint64_t seen[MANY];
    nh_ex before[MANY];
    for (size_t i = 0; i < MANY; i++) {
        before[i] = random_expression(&s, 4);
        seen[i] = nh_fingerprint(s.dag, 1, &before[i], SYMBOLS, s.symbol, 0, NULL, NULL);
        for (size_t j = 0; j < i; j++) cr_expect_eq(seen[i] == seen[j], before[i] == before[j], "%zu, %zu", i, j);
    }
    nh_dag_free(s.dag);
}

static uint64_t key_of_text(const char *text)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    uint64_t key = nh_ranking_key(x.model);
    mechanics_clear(&x);
    return key;
}

/* Names, notation, a total derivative and a factor of the Lagrangian do not change the equations of motion; a parameter does. */
Test(ranking, equations_are_recognised_however_they_are_written)
{
    uint64_t key = key_of_text("name: a\ncoordinates: [{name: x}, {name: y}]\nparameters: [{name: k, value: 2}]\nlagrangian: (x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 - x*y\nconstraints: [\"y' = x*x'\"]\n");
    cr_expect_eq(key, key_of_text("name: b\ncoordinates: [{name: u}, {name: v}]\nparameters: [{name: c, value: 4}]\nlagrangian: u'^2 + v'^2 - (u + v)^2 - c/4*(u^2 + v^2) + u*u'\nconstraints: [\"v' = u*u'\"]\n"));
    cr_expect_neq(key, key_of_text("name: a\ncoordinates: [{name: x}, {name: y}]\nparameters: [{name: k, value: 3}]\nlagrangian: (x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 - x*y\nconstraints: [\"y' = x*x'\"]\n"));
    cr_expect_neq(key, key_of_text("name: a\ncoordinates: [{name: x}, {name: y}]\nparameters: [{name: k, value: 2}]\nlagrangian: (x'^2 + y'^2)/2 - k*(x^2 + y^2)/2 - x*y\nconstraints: [\"y' = 2*x*x'\"]\n"));
}

/* ---- what is kept ---- */

static void in_folder(place *p)
{
    *p = place_make();
    char cache[PATH_MAX + 20];
    snprintf(cache, sizeof cache, "%s/deep/cache", p->folder);
    setenv("NHSYM_CACHE", cache, 1);
}

Test(ranking, what_is_kept_comes_back)
{
    place p;
    in_folder(&p);
    nh_error error = {0};
    nh_way way[3] = {{nh_method_find("GSL rk8pd"), NH_OWN_VELOCITIES, 1e-6, NAN, 3.3e-7, 1.0 / 3},
                     {nh_method_find("relaxation, order 8"), NH_OWN_VELOCITIES, NAN, 0.125, 1e-12, 2e-5},
                     {nh_method_find("CVODE BDF"), NH_ALL_COORDINATES, 1e-10, NAN, 2e-9, 1e-3}};
    nh_ranking kept = {.key = 0xfedcba9876543210u, .begin = -1, .end = 0.1, .count = 3, .way = way}, back;
    nh_arena *arena = nh_arena_create();
    cr_expect(!nh_ranking_read(kept.key, arena, &back) && back.count == 0);
    must(nh_ranking_write(&kept, "a \"name\"", &error), &error, "writing");
    cr_assert(nh_ranking_read(kept.key, arena, &back));
    cr_assert_eq(back.count, 3);
    cr_expect(back.begin == -1 && back.end == 0.1);
    for (size_t i = 0; i < 3; i++) {
        cr_expect(back.way[i].method == way[i].method && back.way[i].velocities == way[i].velocities && back.way[i].error == way[i].error && back.way[i].seconds == way[i].seconds, "%zu", i);
        cr_expect(isnan(way[i].step) ? isnan(back.way[i].step) && back.way[i].tolerance == way[i].tolerance : back.way[i].step == way[i].step, "%zu", i);
    }
    cr_expect(!nh_ranking_read(kept.key + 1, arena, &back));
    nh_arena_free(arena);
    place_clear(&p);
}

/* What is broken, old or foreign is as if it were not there; single entries that make no sense are left out. */
Test(ranking, what_cannot_be_read_is_no_ranking)
{
    static const char *const way = "{\"method\": \"GSL rk8pd\", \"velocities\": \"own velocities\", \"tolerance\": 1e-6, \"step\": null, \"error\": 1e-7, \"seconds_per_time\": 1e-3}";
    static const struct {
        const char *version, *ways;
        size_t count;
    } texts[] = {{NH_VERSION, "[%s]", 1},
                 {"0.0", "[%s]", 0},
                 {NH_VERSION, "[%s", 0},
                 {NH_VERSION, "{\"a\": %s}", 0},
                 {NH_VERSION, "7", 0},
                 {NH_VERSION, "[]", 0},
                 {NH_VERSION, "[null, 3, \"x\", %s, {\"method\": \"magic\"}]", 1},
                 {NH_VERSION, "[%s, {\"method\": \"GSL rk8pd\", \"velocities\": \"own velocities\", \"tolerance\": -1, \"error\": 1e-7, \"seconds_per_time\": 1}]", 1},
                 {NH_VERSION, "[{\"method\": \"relaxation, order 8\", \"velocities\": \"own velocities\", \"tolerance\": 1e-6, \"step\": null, \"error\": 1e-7, \"seconds_per_time\": 1}]", 0}};
    place p;
    in_folder(&p);
    nh_arena *arena = nh_arena_create();
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        nh_error error = {0};
        char ways[800], text[1000];
        nh_ranking back;
        snprintf(ways, sizeof ways, texts[i].ways, way);
        snprintf(text, sizeof text, "{\"schema\": 1, \"nhsym\": \"%s\", \"begin\": 0, \"end\": 1, \"ways\": %s}", texts[i].version, ways);
        must(nh_cache_write("charts/0000000000000007.json", text, &error), &error, "writing");
        cr_expect_eq(nh_ranking_read(7, arena, &back), texts[i].count > 0, "%zu", i);
        cr_expect_eq(back.count, texts[i].count, "%zu: %zu", i, back.count);
    }
    nh_arena_free(arena);
    place_clear(&p);
}

Test(ranking, the_folder_is_where_the_environment_says)
{
    nh_text path;
    const char *why;
    unsetenv("NHSYM_CACHE");
    setenv("XDG_CACHE_HOME", "/x", 1);
    setenv("HOME", "/h", 1);
    nh_text_init(&path);
    cr_expect(nh_cache_path("a", &path, &why) && !strcmp(nh_text_string(&path), "/x/nhsym/a"));
    nh_text_clear(&path);
    setenv("XDG_CACHE_HOME", "relative", 1);
    cr_expect(nh_cache_path("a", &path, &why) && !strcmp(nh_text_string(&path), "/h/.cache/nhsym/a"));
    nh_text_clear(&path);
    unsetenv("HOME");
    cr_expect(!nh_cache_path("a", &path, &why) && strstr(why, "HOME"));
    setenv("HOME", "/h", 1);
    setenv("NHSYM_CACHE", "", 1);
    cr_expect(!nh_cache_path("a", &path, &why) && strstr(why, "NHSYM_CACHE"));
    nh_error error = {0};
    cr_expect(!nh_cache_write("a", "text", &error) && strstr(error.what, "NHSYM_CACHE is empty"));
    cr_expect(nh_cache_read("a") == NULL);
    nh_text_clear(&path);
}

/* ---- what is chosen ---- */

static nh_way run_of(const char *method, nh_velocities velocities, double setting, double error, double seconds)
{
    const nh_method *m = nh_method_find(method);
    cr_assert_not_null(m, "%s", method);
    return (nh_way){m, velocities, m->order ? NAN : setting, m->order ? setting : NAN, error, seconds};
}

Test(ranking, the_cheapest_counts_with_its_confirmation)
{
    nh_way w[] = {run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-8, 1e-9, 3),         run_of("CVODE Adams", NH_OWN_VELOCITIES, 1e-8, 1e-9, 2),
                  run_of("GSL rk8pd", NH_ALL_COORDINATES, 1e-8, 1e-9, 2.5),      run_of("relaxation, order 8", NH_OWN_VELOCITIES, 0.1, 1e-9, 1),
                  run_of("GSL rkf45", NH_OTHER_VELOCITIES, 1e-8, 1e-9, 1.2),     run_of("GSL rkf45", NH_OWN_VELOCITIES, 1e-4, 1e-5, 0.1)};
    size_t n = sizeof w / sizeof *w;
    nh_way_limits all = {.other = true, .spacing = 1}, plain = {.spacing = 1}, scene = {.scene = true, .other = true, .spacing = 1}, dense = {.spacing = 0.01};
    nh_way_choice c = nh_way_cheapest(n, w, 1e-8, &all);
    cr_expect(c.way == &w[4] && fabs(c.next - (2 * 1 + 2) / 2.4) < 1e-12, "%g", c.next); /* the relaxed steps with CVODE Adams to confirm them */
    c = nh_way_cheapest(n, w, 1e-8, &plain);
    cr_expect(c.way == &w[3] && c.second == w[1].method);
    c = nh_way_cheapest(n, w, 1e-8, &dense); /* steps end at the outputs: shorter ones than that were not measured */
    cr_expect(c.way == &w[2] && c.second == w[1].method, "%s", c.way->method->name);
    c = nh_way_cheapest(n, w, 1e-8, &scene);
    cr_expect(c.way == &w[0]); /* 6 against 4 + 3 */
    cr_expect(nh_way_cheapest(n, w, 1e-3, &scene).way == &w[5]);
    cr_expect(nh_way_cheapest(n, w, 1e-10, &all).way == NULL);
    cr_expect_float_eq(nh_way_setting(&w[3], 1e-9 / 256), 0.05, 1e-12);
    cr_expect_float_eq(nh_way_setting(&w[0], 1e-9), 1e-8, 1e-20);
}

static nh_trajectory *accurate(const mechanics *x, const nh_model *other, const nh_state *initial, size_t count, double until, double eps, size_t ways, const nh_way *way, nh_accuracy *a)
{
    nh_options options;
    nh_error error = {0};
    double *times = nh_alloc_array(count, sizeof *times);
    nh_options_default(&options);
    for (size_t i = 0; i < count; i++) times[i] = initial->t + until * (double)i / (double)(count - 1);
    nh_ex e[2] = {formula(x->model, "phi"), formula(x->model, "omega")};
    nh_trajectory_request q = {.model = x->model, .other = other, .initial = initial, .count = count, .times = times, .options = &options, .n = 2, .e = e};
    nh_ways from = {.count = ways, .way = way};
    nh_trajectory *t = nh_trajectory_accurate(&q, eps, &from, a, &error);
    nh_free(times);
    return t;
}

/* The sleigh's closed form is met by every method in every equations, whatever a chart said of it. */
Test(ranking, every_way_meets_the_closed_form)
{
    static const struct {
        const char *method, *formulation;
        nh_velocities velocities;
        double setting, error;
        size_t count;
    } ways[] = {{"GSL rkf45", "reduced equations", NH_OWN_VELOCITIES, 1e-9, 1e-9, 7},
                {"GSL rk8pd", "in coordinate velocities", NH_OTHER_VELOCITIES, 1e-9, 1e-9, 7},
                {"CVODE Adams", "all coordinates", NH_ALL_COORDINATES, 1e-9, 1e-9, 7},
                {"CVODE BDF", "reduced equations", NH_OWN_VELOCITIES, 1e-6, 5e-9, 51},
                {"relaxation, order 8", "reduced equations", NH_OWN_VELOCITIES, 0.02, 1e-9, 7},
                {"relaxation, order 8", "reduced equations", NH_OWN_VELOCITIES, 0.02, 1e-9, 61},  /* an output every 0.02: one step each, then two */
                {"relaxation, order 8", "reduced equations", NH_OWN_VELOCITIES, 0.02, 1e-17, 7},  /* a chart that promised too much */
                {"Lagrange-d'Alembert, order 4", "reduced equations", NH_OWN_VELOCITIES, 0.02, 5e-9, 7}};
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_error error = {0};
    nh_model *other = nh_model_create(x.system, nh_chart_create(x.system, NH_CHART_COORDINATES, 1, &error), &error);
    double q[3] = {0}, v[3] = {2, 0, 0}, until = 1.2; /* before cos(phi) = 0, where the coordinate velocities end */
    nh_state initial = {.q = q, .v = v};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        nh_way w = run_of(ways[i].method, ways[i].velocities, ways[i].setting, ways[i].error, 1e-5);
        nh_accuracy a;
        double eps = 1e-8;
        nh_trajectory *t = accurate(&x, other, &initial, ways[i].count, w.velocities == NH_OTHER_VELOCITIES ? 0.6 : until, eps, 1, &w, &a);
        cr_assert(t && a.held && a.measured, "%zu: %s", i, t ? a.why : "");
        cr_expect(!strcmp(t->method, ways[i].method) && strstr(t->formulation, ways[i].formulation), "%zu: %s, %s", i, t->method, t->formulation);
        cr_expect(isnan(a.step) == !w.method->order && isnan(a.tolerance) == !!w.method->order, "%zu", i);
        for (size_t k = 0; k < ways[i].count; k++) {
            double s = t->motion->time[k];
            cr_expect_float_eq(t->value[2 * k], 4 * atan(tanh(s / 2)), 3.2 * eps, "%zu, %s at %g", i, a.why, s);
            cr_expect_float_eq(t->value[2 * k + 1], 2 / cosh(s), 2 * eps, "%zu, %s at %g", i, a.why, s);
        }
        nh_trajectory_free(t);
    }
    nh_model_free(other);
    mechanics_clear(&x);
}

/* Coordinate velocities that end on the way, and a ranking without anything so accurate: the motion comes out all the same. */
Test(ranking, what_does_not_do_is_replaced)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_error error = {0};
    nh_model *other = nh_model_create(x.system, nh_chart_create(x.system, NH_CHART_COORDINATES, 1, &error), &error);
    double q[3] = {0}, v[3] = {2, 0, 0};
    nh_state initial = {.q = q, .v = v};
    nh_way through = run_of("GSL rk8pd", NH_OTHER_VELOCITIES, 1e-9, 1e-9, 1e-5), loose = run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-4, 1e-3, 1e-5);
    nh_accuracy a;
    nh_trajectory *t = accurate(&x, other, &initial, 5, 6, 1e-8, 1, &through, &a);
    cr_assert(t && a.held, "%s", a.why);
    cr_expect_float_eq(t->value[2 * 4], 4 * atan(tanh(3)), 3.2e-8);
    cr_expect(!strcmp(t->formulation, "reduced equations"), "%s", t->formulation);
    nh_trajectory_free(t);
    t = accurate(&x, other, &initial, 5, 6, 1e-8, 1, &loose, &a);
    cr_expect(t && a.held && !a.measured && strstr(a.why, "no error below that"), "%s", a.why);
    nh_trajectory_free(t);
    nh_model_free(other);
    mechanics_clear(&x);
}

/* ---- surveys ---- */

/* A survey is kept for accuracies like the one that it was made for, beside others; a chart takes its place for all, and is not touched by later ones. */
Test(ranking, a_chart_outranks_a_survey)
{
    place p;
    in_folder(&p);
    nh_error error = {0};
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_way way[2] = {run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-6, 3e-7, 1e-3), run_of("CVODE BDF", NH_OWN_VELOCITIES, 1e-9, 2e-9, 1e-4)};
    nh_arena *arena = nh_arena_create();
    nh_ranking back, loose = {.surveyed = true, .asks = 1, .asked = {1e-5}, .count = 1, .way = way}, tight = {.surveyed = true, .asks = 1, .asked = {1e-9}, .count = 2, .way = way},
                     plain = {.surveyed = true, .plain = true, .asks = 1, .asked = {1e-3}, .count = 1, .way = way};
    must(nh_ranking_keep(x.model, &loose, &error), &error, "the first survey");
    cr_assert(nh_ranking_read(nh_ranking_key(x.model), arena, &back));
    cr_expect(back.surveyed && !back.plain && nh_ranking_tells(&back, 2e-5, false) && nh_ranking_tells(&back, 1e-5, true) && !nh_ranking_tells(&back, 1e-9, false));
    must(nh_ranking_keep(x.model, &tight, &error), &error, "the second survey");
    cr_assert(nh_ranking_read(nh_ranking_key(x.model), arena, &back));
    cr_expect(back.count == 3 && nh_ranking_tells(&back, 1e-5, false) && nh_ranking_tells(&back, 1e-9, false) && !nh_ranking_tells(&back, 1e-7, false), "%zu", back.count);
    cr_expect(!nh_ranking_keep(x.model, &plain, &error)); /* it says less */
    nh_ranking chart = {.key = nh_ranking_key(x.model), .end = 10, .count = 1, .way = way + 1};
    must(nh_ranking_write(&chart, "sleigh", &error), &error, "the chart");
    loose = (nh_ranking){.surveyed = true, .asks = 1, .asked = {1e-5}, .count = 1, .way = way};
    cr_expect(!nh_ranking_keep(x.model, &loose, &error));
    cr_assert(nh_ranking_read(nh_ranking_key(x.model), arena, &back));
    cr_expect(!back.surveyed && back.count == 1 && back.way[0].method == way[1].method && nh_ranking_tells(&back, 1e-2, false));
    nh_arena_free(arena);
    mechanics_clear(&x);
    place_clear(&p);
}

/* Another way has to save three tenths beside what remains of the best so far; where that is done with its first run it goes on without being measured again. */
Test(ranking, a_survey_changes_only_what_pays)
{
    nh_survey v = {.count = 3, .way = {run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-8, 1e-9, 3), run_of("ARKODE Verner", NH_OWN_VELOCITIES, 1e-8, 1e-9, 2.7), run_of("GSL rkf45", NH_OWN_VELOCITIES, 1e-8, 1e-7, 0.1)}};
    const nh_method *best = v.way[0].method;
    nh_way_limits limits = {.spacing = 1};
    nh_way_choice c = nh_survey_choose(&v, best, 1e-8, &limits, false);
    cr_expect(c.way == &v.way[0] && c.next == 1, "%g", c.next);
    cr_expect(nh_survey_choose(&v, best, 1e-8, &limits, true).way == NULL);
    v.way[1].seconds = 2;
    cr_expect(nh_survey_choose(&v, best, 1e-8, &limits, false).way == &v.way[1]);
    cr_expect(nh_survey_choose(&v, best, 1e-8, &limits, true).way == NULL); /* two runs of 2 against one of 3 */
    v.way[1].seconds = 1;
    cr_expect(nh_survey_choose(&v, best, 1e-8, &limits, true).way == &v.way[1]);
    cr_expect(nh_survey_choose(&v, best, 1e-12, &limits, true).way == NULL);
    v.way[0].error = 1e-7; /* the best so far was not measured below eps: whatever was */
    cr_expect(nh_survey_choose(&v, best, 1e-8, &limits, true).way == &v.way[1]);
}

/* A survey of plain ways does not tell what is the cheapest of all. */
Test(ranking, a_plain_survey_says_less)
{
    place p;
    in_folder(&p);
    nh_error error = {0};
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_way way = run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-6, 3e-7, 1e-3), other = run_of("GSL rk8pd", NH_ALL_COORDINATES, 1e-6, 3e-7, 1e-3);
    nh_arena *arena = nh_arena_create();
    nh_ranking back, plain = {.surveyed = true, .plain = true, .asks = 1, .asked = {1e-5}, .count = 1, .way = &way}, full = {.surveyed = true, .asks = 1, .asked = {1e-5}, .count = 1, .way = &other};
    must(nh_ranking_keep(x.model, &plain, &error), &error, "a plain one");
    cr_assert(nh_ranking_read(nh_ranking_key(x.model), arena, &back));
    cr_expect(nh_ranking_tells(&back, 1e-5, true) && !nh_ranking_tells(&back, 1e-5, false));
    must(nh_ranking_keep(x.model, &full, &error), &error, "one of all ways");
    cr_assert(nh_ranking_read(nh_ranking_key(x.model), arena, &back));
    cr_expect(!back.plain && back.count == 1 && back.way[0].velocities == NH_ALL_COORDINATES && nh_ranking_tells(&back, 1e-5, true));
    nh_arena_free(arena);
    mechanics_clear(&x);
    place_clear(&p);
}

/* The full motion of a reduction, by the one method that was measured: with error control, and with fixed steps. */
Test(ranking, reductions_choose_by_it)
{
    static const char *const methods[] = {"ARKODE Verner", "relaxation, order 8"};
    place p;
    in_folder(&p);
    for (size_t i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_reduce_request q = {.system_path = "systems/sleigh.yaml", .accuracy = 1e-6};
        nh_options_default(&q.options);
        nh_reduction *r = nh_reduce(&q, &error);
        must(r != NULL, &error, "sleigh");
        cr_expect(r->full.held && strcmp(r->full.method, methods[i]), "%s", r->full.why);
        nh_way way = {nh_method_find(methods[i]), NH_OWN_VELOCITIES, i ? NAN : 1e-9, i ? 0.05 : NAN, 1e-8, 1e-5};
        nh_ranking kept = {.key = nh_ranking_key(r->whole), .begin = 0, .end = 10, .count = 1, .way = &way};
        must(nh_ranking_write(&kept, "sleigh", &error), &error, "writing");
        nh_reduction_free(r);
        q.remember = true;
        r = nh_reduce(&q, &error);
        must(r != NULL, &error, "sleigh");
        cr_expect(r->full.held && !strcmp(r->full.method, methods[i]) && strstr(r->full.why, "in the chart of these equations"), "%s", r->full.why);
        cr_expect(i ? r->full.step > 0 && isnan(r->full.tolerance) : r->full.tolerance > 0 && isnan(r->full.step), "%s", r->full.why);
        for (size_t s = 0; s < r->stages; s++) cr_expect(r->stage[s].choice.held && r->stage[s].agreement < 1e-6, "%s", r->stage[s].choice.why);
        nh_reduction_free(r);
    }
    place_clear(&p);
}

/* ---- as a user sees it ---- */

/* A long motion is measured when it is computed, and what was measured serves the next; a chart takes its place. */
Test(ranking, a_long_motion_is_surveyed)
{
    static const char *const simulate = "simulate driven.yaml --initial x=1 --until 400000 --accuracy 1e-5 --step 200000 --option steps=1e8";
    static const char *const driven = "name: driven\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2/2\nforces: [\"x = -x'/2 + cos(t)\"]\n";
    place p = place_with_systems();
    write_here(&p, "driven.yaml", driven);
    finished f = run_expecting(&p, simulate, 0);
    cr_expect(strstr(f.err, "were measured"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, simulate, 0);
    cr_expect(strstr(f.err, "measured for an earlier motion"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}

Test(ranking, a_chart_is_remembered)
{
    static const char *const simulate = "simulate sleigh --set a=0.4 --initial omega=2 --until 3 --accuracy 1e-6 --step 1";
    place p = place_with_systems();
    finished f = run_expecting(&p, simulate, 0);
    cr_expect(strstr(f.err, "measuring other methods would take longer"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, "chart sleigh --set a=0.4 --budget 1 --verbose", 0);
    cr_expect(strstr(f.err, "will choose by this chart"), "%s", f.err);
    finished_clear(&f);
    f = run_expecting(&p, simulate, 0);
    cr_expect(strstr(f.err, "the chart of these equations"), "%s", f.err); /* which, on a busy machine, may have nothing below that */
    finished_clear(&f);
    f = run_expecting(&p, "simulate sleigh --set a=0.41 --initial omega=2 --until 3 --accuracy 1e-6 --step 1", 0); /* other equations */
    cr_expect(strstr(f.err, "measuring other methods would take longer") && !strstr(f.err, "chart"), "%s", f.err);
    finished_clear(&f);
    static const char *const nowhere[] = {"NHSYM_CACHE=", NULL};
    f = run_so(&p, &(manner){.environment = nowhere}, simulate);
    cr_expect(f.code == 0 && !strstr(f.err, "chart"), "%s", f.err); /* no advice that would not help */
    finished_clear(&f);
    static const char *const blocked[] = {"NHSYM_CACHE=/dev/null/x", NULL};
    f = run_so(&p, &(manner){.environment = blocked}, "chart sleigh --budget 0.2 --quiet");
    cr_expect_eq(f.code, 0);
    finished_clear(&f);
    f = run_so(&p, &(manner){.environment = blocked}, "chart sleigh --budget 0.2");
    cr_expect(f.code == 0 && strstr(f.err, "warning: the chart is not kept"), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}
