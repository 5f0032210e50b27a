/* stages: brackets and equations by stages against the bracket itself, reference values, and the true accelerations. */
#include "oracle.h"
#include "reduced.h"

#include <stdio.h>
#include <stdlib.h>

#include "reduction/group.h"
#include "reduction/poincare.h"
#include "reduction/subspace.h"
#include "system/sample.h"

/* Six chains of normal subgroups, three draws each: bracket and Euler-Poincare right-hand side in parts. */
Test(stages, reference_values)
{
    cJSON *data = oracle_read("tests/data/stages_oracle.json");
    tally bracket = {.what = "bracket"}, rates = {.what = "beta'"}, direct = {.what = "one stage"};
    double printed = 0;
    for (const cJSON *each = oracle_get(data, "cases")->child; each; each = each->next) {
        static double c[1000], g0[100], eta[10], other[10], beta[10], want[10], got[10], xi[10], x[10], y[10];
        size_t size[10], order[10], blocks = 0, d = 0;
        for (const cJSON *b = oracle_get(each, "blocks")->child; b; b = b->next, blocks++) {
            double index[10];
            size[blocks] = oracle_flat(b, index);
            for (size_t i = 0; i < size[blocks]; i++) order[d++] = (size_t)index[i];
        }
        nh_algebra g = nh_algebra_create(d);
        cr_assert_eq(oracle_flat(oracle_get(each, "structure_constants"), c), d * d * d);
        memcpy(g.c, c, d * d * d * sizeof *c);
        cr_assert_eq(oracle_flat(oracle_get(each, "metric"), g0), d * d);
        nh_error error = {0};
        nh_ideals chain;
        must(nh_ideals_init(&chain, &g, blocks, size, order, g0, &error), &error, "the chain");
        oracle_flat(oracle_get(each, "eta"), eta);
        oracle_flat(oracle_get(each, "etabar"), other);
        oracle_flat(oracle_get(each, "beta"), beta);
        cr_assert_eq(oracle_flat(oracle_get(each, "bracket"), want), d);
        nh_ideals_bracket(&chain, eta, other, got);
        tally_add(&bracket, d, got, want, 0);
        nh_ideals_join(&chain, eta, x); /* the same by the bracket of the algebra */
        nh_ideals_join(&chain, other, y);
        nh_algebra_bracket(&g, x, y, xi);
        nh_ideals_split(&chain, xi, got);
        tally_add(&direct, d, got, want, 0);
        oracle_flat(oracle_get(each, "betadot"), want);
        nh_ideals_euler_poincare(&chain, eta, beta, got);
        tally_add(&rates, d, got, want, 0);
        oracle_flat(oracle_get(each, "betadot_printed_eq20"), want);
        for (size_t i = 0; i < d; i++) printed = fmax(printed, fabs(got[i] - want[i]));
        nh_ideals_clear(&chain);
        nh_algebra_clear(&g);
    }
    tally_check(&bracket, 1e-13, "stages");
    tally_check(&rates, 1e-13, "stages");
    tally_check(&direct, 1e-13, "stages");
    cr_expect_gt(printed, 1, "the misprinted equation 20 cannot be told from the right one");
    cJSON_Delete(data);
}

static nh_algebra euclidean(void) /* e1, e2 translations, e3 the turn, e4 a circle beside it */
{
    nh_algebra g = nh_algebra_create(4);
    g.c[(2 * 4 + 0) * 4 + 1] = 1, g.c[(0 * 4 + 2) * 4 + 1] = -1;
    g.c[(2 * 4 + 1) * 4 + 0] = -1, g.c[(1 * 4 + 2) * 4 + 0] = 1;
    return g;
}

Test(stages, chains_are_found_and_wrong_ones_refused)
{
    nh_algebra g = euclidean();
    size_t size[4], order[4];
    double metric[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    nh_error error = {0};
    nh_ideals chain;
    size_t blocks = nh_ideals_find(&g, size, order);
    cr_expect_eq(blocks, 3, "%zu blocks", blocks);
    must(nh_ideals_init(&chain, &g, blocks, size, order, metric, &error), &error, "the chain");
    nh_ideals_clear(&chain);
    size_t wrong_size[2] = {2, 2}, wrong[4] = {0, 1, 2, 3}; /* the turn and the circle are no ideal */
    cr_expect(!nh_ideals_init(&chain, &g, 2, wrong_size, wrong, metric, &error));
    cr_expect(strstr(error.what, "[e1, e3] has a component along e2"), "%s", error.what);
    nh_algebra_clear(&g);
}

/* se(2) > R^2 > R: the last is an ideal of R^2 only. Bracket and equations in parts are those of the algebra. */
Test(stages, subnormal_chains)
{
    nh_algebra g = euclidean();
    size_t size[4] = {1, 1, 1, 1}, order[4] = {2, 3, 0, 1}, pair[3] = {2, 1, 1};
    double metric[16] = {3, 0.2, 0.5, -0.7, 0.2, 2, 0.3, 0.4, 0.5, 0.3, 4, 0.1, -0.7, 0.4, 0.1, 2}, eta[4] = {0.7, -1.1, 0.4, 0.9}, other[4] = {1.3, 0.2, -0.8, 0.6};
    double x[4], y[4], bracket[4], parts[4], got[4], beta[4], mu[4] = {0.3, -0.5, 1.2, 0.8};
    nh_error error = {0};
    for (int k = 0; k < 2; k++) {
        nh_ideals chain;
        must(nh_ideals_init(&chain, &g, k ? 3 : 4, k ? pair : size, order, metric, &error), &error, "the chain");
        nh_ideals_bracket(&chain, eta, other, got);
        nh_ideals_join(&chain, eta, x);
        nh_ideals_join(&chain, other, y);
        nh_algebra_bracket(&g, x, y, bracket);
        nh_ideals_split(&chain, bracket, parts);
        for (size_t i = 0; i < 4; i++) cr_expect_float_eq(got[i], parts[i], 1e-14, "part %zu: %g, %g", i, got[i], parts[i]);
        nh_ideals_split_covector(&chain, mu, beta);
        nh_ideals_euler_poincare(&chain, eta, beta, got);
        double left = 0, right = 0; /* sum_i got_i other_i = <mu, [eta, other]> */
        for (size_t i = 0; i < 4; i++) left += got[i] * other[i], right += mu[i] * bracket[i];
        cr_expect_float_eq(left, right, 1e-14);
        nh_ideals_clear(&chain);
    }
    size_t wrong[4] = {0, 2, 1, 3}, three[2] = {1, 3};
    cr_expect(!nh_ideals_init(&(nh_ideals){0}, &g, 2, three, wrong, metric, &error), "the turn makes of e2 e1");
    nh_algebra_clear(&g);
}

static void equations(const char *name, nh_system *system, size_t n, const size_t *index, size_t blocks, const size_t *size, const size_t *order, size_t dimension, double tolerance)
{
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    reducible x = reducible_make(system, 11, &error);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, name);
    double *t = nh_alloc_array(g->action.d * n, sizeof *t), *metric = nh_alloc_array(n * n, sizeof *metric), y0[10];
    uint64_t seed = 2385;
    for (size_t i = 0; i < n; i++) t[index[i] + i * g->action.d] = 1;
    nh_action action;
    nh_action_sub(&action, &g->action, n, t, &options);
    must(nh_action_check(&action, &options, &error), &error, name);
    size_t shape[20], along[20], found_size[20], found_order[20];
    nh_slice slice;
    nh_ideals chain;
    nh_poincare p;
    nh_slice_choose(&action, shape, along);
    for (size_t a = 0; a < n; a++) y0[a] = x.kinetic->place[along[a]];
    nh_slice_init(&slice, &action, shape, along, y0);
    for (size_t i = 0; i < n; i++) /* any inner product */
        for (size_t j = 0; j <= i; j++) metric[i + j * n] = metric[j + i * n] = 0.4 * (2 * nh_random(&seed) - 1) + (i == j ? (double)n : 0);
    if (!blocks) blocks = nh_ideals_find(&action.algebra, found_size, found_order), size = found_size, order = found_order;
    must(nh_ideals_init(&chain, &action.algebra, blocks, size, order, metric, &error), &error, name);
    must(nh_poincare_check(&p, &slice, &chain, &options, &error), &error, name);
    double worst = fmax(fmax(p.one_vertical, p.one_horizontal), fmax(fmax(p.stages_vertical, p.stages_horizontal), fmax(p.bracket, p.euler_poincare)));
    if (getenv("NHSYM_TEST_FIGURES"))
        printf("%-26s %zu blocks, S of %zu, |B| %.2g: one stage %.1e %.1e, by stages %.1e %.1e, bracket %.1e\n", name, blocks, p.dimension, p.curvature, p.one_vertical, p.one_horizontal,
               p.stages_vertical, p.stages_horizontal, p.bracket);
    cr_expect(worst < tolerance, "%s: %g", name, worst);
    cr_expect_eq(p.dimension, dimension, "%s: S has dimension %zu", name, p.dimension);
    cr_expect(p.places >= 8);
    nh_ideals_clear(&chain);
    nh_action_clear(&action);
    nh_group_free(g);
    reducible_clear(&x);
    nh_free(t);
    nh_free(metric);
}

/* The constraint does not split along the chain in most of these. */
Test(stages, equations_agree_with_the_accelerations)
{
    nh_error error = {0};
    static const size_t all[] = {0, 1, 2, 3, 4, 5}, se2[] = {0, 1, 3}, circle_first[] = {0, 1, 2}, ball[] = {0, 1, 2}, one_two[] = {1, 2}, turn_first[] = {2, 0, 1}, psi_first[] = {0, 1, 2};
    equations("snakeboard, SE(2)", nh_system_parse("snakeboard", SNAKEBOARD, 0, NULL, &error), 3, se2, 2, one_two, turn_first, 1, 1e-11);
    equations("snakeboard, all", nh_system_parse("snakeboard", SNAKEBOARD, 0, NULL, &error), 4, all, 0, NULL, NULL, 2, 1e-11);
    equations("crane, all", nh_system_parse("crane", CRANE, 0, NULL, &error), 6, all, 0, NULL, NULL, 2, 1e-11);
    equations("disk, S^1 x R^2", nh_system_parse("disk", DISK, 0, NULL, &error), 3, circle_first, 2, one_two, psi_first, 1, 1e-11);
    equations("disk, all", nh_system_parse("disk", DISK, 0, NULL, &error), 4, all, 0, NULL, NULL, 2, 1e-11);
    equations("Chaplygin ball", nh_system_read("systems/chaplygin_ball.yaml", 0, NULL, &error), 3, ball, 0, NULL, NULL, 1, 1e-11);
    equations("cart, all", nh_system_parse("cart", CART, 0, NULL, &error), 5, all, 0, NULL, NULL, 2, 1e-11);
    equations("cart, SE(2)", nh_system_parse("cart", CART, 0, NULL, &error), 3, (size_t[]){0, 1, 4}, 0, NULL, NULL, 0, 1e-11);
    equations("top", nh_system_read("systems/euler_top.yaml", 0, NULL, &error), 3, all, 0, NULL, NULL, 3, 1e-11);
}
