/* grids: the kinds of sample grids: their points, their numbers, and what an analysis does with them. */
#include <cjson/cJSON.h>
#include <stdint.h>

#include "mechanics.h"
#include "program.h"
#include "search/grid.h"
#include "system/sample.h"
#include "system/sample_grid.h"

/* ---- nodes ---- */

Test(grids, sparse_grids_have_the_numbers_of_points_of_the_literature)
{
    /* Smolyak's construction with nested Chebyshev extrema; Novak and Ritter 1996, table 1: d = 2, 3, 4, 10 */
    static const size_t dimension[] = {1, 2, 3, 4, 10}, expected[][5] = {{1, 3, 5, 9, 17}, {1, 5, 13, 29, 65}, {1, 7, 25, 69, 177}, {1, 9, 41, 137, 401}, {1, 21, 221, 1581, 8801}};
    for (size_t i = 0; i < 5; i++)
        for (size_t level = 0; level < 5; level++)
            cr_expect_eq(nh_sample_grid_count(NH_GRID_SPARSE, dimension[i], level), expected[i][level], "%zu variables, level %zu: %zu", dimension[i], level,
                         nh_sample_grid_count(NH_GRID_SPARSE, dimension[i], level));
}

/* All points differ and lie in [-1, 1]^d. */
static void check_nodes(nh_grid_kind kind, size_t d, size_t level)
{
    size_t count = nh_sample_grid_count(kind, d, level);
    double *node = nh_sample_grid_nodes(kind, d, level);
    for (size_t p = 0; p < count; p++) {
        for (size_t j = 0; j < d; j++) cr_assert(fabs(node[p * d + j]) <= 1, "%g", node[p * d + j]);
        for (size_t q = 0; q < p; q++) {
            double away = 0;
            for (size_t j = 0; j < d; j++) away = fmax(away, fabs(node[p * d + j] - node[q * d + j]));
            cr_assert_gt(away, 1e-6, "points %zu and %zu of level %zu in %zu variables are the same", p, q, level, d);
        }
    }
    nh_free(node);
}

Test(grids, the_nodes_of_a_grid_are_different_points_of_the_box)
{
    for (size_t d = 1; d <= 4; d++)
        for (size_t level = 1; level <= 4; level++) check_nodes(NH_GRID_SPARSE, d, level), check_nodes(NH_GRID_TENSOR, d, level);
}

Test(grids, the_nodes_of_a_tensor_grid_are_zeros_of_a_chebyshev_polynomial)
{
    enum { k = 7 };
    double *node = nh_sample_grid_nodes(NH_GRID_TENSOR, 2, k);
    cr_assert_eq(nh_sample_grid_count(NH_GRID_TENSOR, 2, k), k * k);
    for (size_t i = 0; i < 2 * k * k; i++) {
        double x = node[i];
        cr_expect(fabs(64 * pow(x, 7) - 112 * pow(x, 5) + 56 * pow(x, 3) - 7 * x) < 1e-13, "T_7(%g)", x); /* T_7 as powers */
    }
    nh_free(node);
}

/* The squared L2 star discrepancy of points in [0, 1]^d by Warnock's formula (1972). */
static double discrepancy(size_t d, size_t n, const double *x)
{
    double first = pow(1.0 / 3, (double)d), second = 0, third = 0;
    for (size_t p = 0; p < n; p++) {
        double product = 1;
        for (size_t j = 0; j < d; j++) product *= (1 - x[p * d + j] * x[p * d + j]) / 2;
        second += product;
        for (size_t q = 0; q < n; q++) {
            double both = 1;
            for (size_t j = 0; j < d; j++) both *= 1 - fmax(x[p * d + j], x[q * d + j]);
            third += both;
        }
    }
    return first - 2 * second / (double)n + third / (double)n / (double)n;
}

Test(grids, sobol_and_halton_points_have_less_discrepancy_than_random_ones)
{
    enum { d = 4, n = 512, seeds = 8 };
    double low[d] = {0}, high[d] = {1, 1, 1, 1}, x[d * n], sum[3] = {0};
    for (uint64_t seed = 1; seed <= seeds; seed++) {
        nh_sampler *sobol = nh_sampler_create(d, low, high, seed);
        for (size_t p = 0; p < n; p++) nh_sampler_next(sobol, x + p * d);
        nh_sampler_free(sobol);
        sum[0] += discrepancy(d, n, x);
        double *halton = nh_sample_halton(d, n, seed);
        for (size_t i = 0; i < d * n; i++) x[i] = (1 + halton[i]) / 2;
        nh_free(halton);
        sum[1] += discrepancy(d, n, x);
        uint64_t state = seed;
        for (size_t i = 0; i < d * n; i++) x[i] = nh_random(&state);
        sum[2] += discrepancy(d, n, x);
    }
    cr_expect_lt(4 * sum[0], sum[2], "Sobol %g, random %g", sum[0], sum[2]);
    cr_expect_lt(4 * sum[1], sum[2], "Halton %g, random %g", sum[1], sum[2]);
}

/* ---- points ---- */

/* z' stays implicit, and has two values where x' and y' are small. */
static const char CUBIC[] = PARTICLE("cubic", AND_Z) "lagrangian: (x'^2 + y'^2 + z'^2)/2\n"
                                                     "constraints: [\"z'^4 + z'^2 = x'^2 + y'^2 + 1/2\"]\ndependent: [z]\n";

/* A linear constraint, whose velocities are moved onto it. */
static const char HEISENBERG[] = PARTICLE("heisenberg", AND_Z) FREE_IN_SPACE MASS "constraints: [\"z' = y*x'\"]\n";

static void check_points(const char *text, nh_grid_kind kind)
{
    mechanics x = mechanics_of_text(text, NH_CHART_COORDINATES);
    const nh_model *o = x.model;
    const nh_chart *c = o->chart;
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    nh_grid grid = {.kind = kind};
    nh_points *p = nh_grid_points(o, &options, &grid, 200, 1, &error);
    must(p != NULL, &error, text);
    cr_expect_geq(p->count, 100, "%s: %zu points", nh_sample_grid_word(kind), p->count);
    nh_ex *f = nh_alloc_array(o->k, sizeof *f), *v = nh_alloc_array(o->m, sizeof *v);
    double *value = nh_alloc_array(o->k * p->count, sizeof *value);
    for (size_t a = 0; a < o->k; a++) f[a] = nh_chart_compose(c, nh_chart_constraint(c, a));
    nh_points_evaluate(p, o, o->k, f, value);
    for (size_t i = 0; i < o->k * p->count; i++) cr_expect(fabs(value[i]) < 1e-12, "%s: the constraint is off by %g", nh_sample_grid_word(kind), value[i]);
    for (size_t j = 0; j < 1 + o->m; j++)
        for (size_t i = 0; i < p->count; i++)
            cr_expect(p->column[j][i] >= c->low[j] - 1e-9 && p->column[j][i] <= c->high[j] + 1e-9, "%s: %g", nh_sample_grid_word(kind), p->column[j][i]);
    for (size_t j = 1 + o->m; c->implicit && j < 1 + o->m + o->n; j++)
        for (size_t i = 0; i < p->count; i++)
            cr_expect(p->column[j][i] >= c->low[j] - 1e-9 && p->column[j][i] <= c->high[j] + 1e-9, "%s: velocity %g", nh_sample_grid_word(kind), p->column[j][i]);
    if (c->implicit) { /* both components of the constraint submanifold */
        size_t above = 0;
        for (size_t i = 0; i < p->count; i++) above += p->column[o->width - 1][i] > 0;
        cr_expect(above > p->count / 8 && above < p->count - p->count / 8, "%s: %zu of %zu points on one branch", nh_sample_grid_word(kind), above, p->count);
    }
    nh_free(value), nh_free(v), nh_free(f);
    nh_points_free(p);
    mechanics_clear(&x);
}

Test(grids, points_of_every_kind_lie_in_the_domain_on_the_constraints_and_on_both_branches)
{
    static const nh_grid_kind kinds[] = {NH_GRID_HALTON, NH_GRID_SPARSE, NH_GRID_TENSOR, NH_GRID_MOTION, NH_GRID_SOBOL};
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) check_points(CUBIC, kinds[i]), check_points(HEISENBERG, kinds[i]);
}

/* ---- analyses ---- */

static cJSON *answer(const place *p, const char *more)
{
    char line[300];
    snprintf(line, sizeof line, "analyze sleigh --json - %s", more);
    finished f = run(p, line);
    cr_assert_eq(f.code, 0, "%s: %s", line, f.err);
    cJSON *json = cJSON_Parse(f.out);
    cr_assert_not_null(json, "%s", line);
    finished_clear(&f);
    return json;
}

static double number_of(const cJSON *json, const char *object, const char *name)
{
    return cJSON_GetNumberValue(cJSON_GetObjectItem(cJSON_GetObjectItem(json, object), name));
}

Test(grids, every_grid_finds_the_currents_of_the_sleigh)
{
    static const char *const grids[] = {"sobol", "halton", "tensor", "sparse", "motion"};
    place p = place_with_systems();
    for (size_t i = 0; i < sizeof grids / sizeof *grids; i++) {
        char option[40];
        snprintf(option, sizeof option, "--grid %s", grids[i]);
        cJSON *json = answer(&p, option);
        const cJSON *samples = cJSON_GetObjectItem(json, "samples"), *each;
        cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(samples, "grid")), grids[i]);
        cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(json, "verdict")), "FOUND");
        size_t count = 0;
        cJSON_ArrayForEach(each, cJSON_GetObjectItem(json, "currents")) count++;
        cr_expect_geq(count, 5, "%s: %zu currents", grids[i], count);
        double least = cJSON_GetArrayItem(cJSON_GetObjectItem(cJSON_GetObjectItem(samples, "domain"), "v"), 0)->valuedouble;
        cr_expect_lt(least, 0);
        cJSON_Delete(json);
    }
    place_clear(&p);
}

/* The number that a refusal names is accepted, and found what there is. */
static void check_refusal(const place *p, const char *grid, size_t wanted)
{
    char line[200], again[80];
    size_t number;
    snprintf(line, sizeof line, "analyze sleigh --grid %s --samples %zu", grid, wanted);
    finished f = run(p, line);
    cr_assert_neq(f.code, 0, "%s was accepted", line);
    const char *hint = strstr(f.err, "write --samples ");
    cr_assert_not_null(hint, "%s: %s", line, f.err);
    cr_assert_eq(sscanf(hint, "write --samples %zu", &number), 1);
    cr_assert_gt(number, wanted);
    finished_clear(&f);
    snprintf(again, sizeof again, "--grid %s --samples %zu", grid, number);
    cJSON *json = answer(p, again);
    double used = number_of(json, "samples", "used"), rejected = number_of(json, "samples", "rejected");
    cr_expect_eq((size_t)(used + rejected), number, "%s: %g + %g", again, used, rejected);
    cJSON_Delete(json);
}

Test(grids, too_few_samples_are_refused_with_a_number_that_works)
{
    place p = place_with_systems();
    check_refusal(&p, "sobol", 20);
    check_refusal(&p, "halton", 30);
    check_refusal(&p, "tensor", 100);
    check_refusal(&p, "sparse", 41);
    place_clear(&p);
}

Test(grids, a_number_of_samples_below_256_is_obeyed)
{
    place p = place_with_systems();
    cJSON *json = answer(&p, "--samples 60");
    cr_expect_eq(number_of(json, "samples", "used"), 60);
    cJSON_Delete(json);
    place_clear(&p);
}

Test(grids, points_of_a_file_are_used_and_a_missing_column_is_named_with_its_line)
{
    place p = place_with_systems();
    nh_text table;
    nh_text_init(&table);
    nh_text_add(&table, "# measured\nt,phi,x,y,omega,v\n");
    uint64_t state = 3;
    for (int i = 0; i < 80; i++) {
        for (int j = 0; j < 6; j++) nh_text_addf(&table, "%s%.6f", j ? "," : "", j ? 2 * nh_random(&state) - 1 : nh_random(&state));
        nh_text_add(&table, "\n");
    }
    write_here(&p, "points.csv", nh_text_string(&table));
    write_here(&p, "short.csv", "# measured\nt,phi,x,omega,v\n0,1,1,1,1\n");
    nh_text_clear(&table);
    cJSON *json = answer(&p, "--grid points.csv");
    cr_expect_str_eq(cJSON_GetStringValue(cJSON_GetObjectItem(cJSON_GetObjectItem(json, "samples"), "grid")), "file");
    cr_expect_eq(number_of(json, "samples", "used") + number_of(json, "samples", "rejected"), 80);
    cJSON_Delete(json);
    finished f = run(&p, "analyze sleigh --grid short.csv");
    cr_expect_neq(f.code, 0);
    cr_expect_not_null(strstr(f.err, "short.csv:2: there is no column `y`"), "%s", f.err);
    cr_expect_not_null(strstr(f.err, "hint: "), "%s", f.err);
    finished_clear(&f);
    place_clear(&p);
}
