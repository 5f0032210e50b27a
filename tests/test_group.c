/* group: dimensions, algebras and closed forms of symmetry groups. */
#include "reduced.h"

#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "reduction/group.h"
#include "reduction/subspace.h"
#include "sweep.h"

static nh_options options_of(uint64_t seed)
{
    nh_options o;
    nh_options_default(&o);
    o.seed = (double)seed;
    return o;
}

typedef struct {
    const char *name, *text, *file, *algebra;
    size_t dimension, orbit, of_metric; /* of_metric 0: not compared */
    size_t settings;
    nh_setting setting[3];
} expected;

static const expected known[] = {
    {.name = "crane", .text = CRANE, .algebra = "SE(2) x R^3", .dimension = 6, .orbit = 6, .of_metric = 22},
    {.name = "snakeboard", .text = SNAKEBOARD, .algebra = "SE(2) x R", .dimension = 4, .orbit = 4, .of_metric = 15},
    {.name = "cart", .text = CART, .algebra = "SE(2) x R^2", .dimension = 5, .orbit = 5},
    {.name = "twisted cart", .text = TWISTED_CART, .algebra = "SE(2) x R^2", .dimension = 5, .orbit = 5},
    {.name = "vertical disk", .file = "systems/vertical_disk.yaml", .algebra = "SE(2) x R", .dimension = 4, .orbit = 4},
    {.name = "disk", .text = DISK, .algebra = "SE(2) x R", .dimension = 4, .orbit = 4, .of_metric = 5},
    {.name = "sleigh", .file = "systems/sleigh_inertia.yaml", .algebra = "SE(2)", .dimension = 3, .orbit = 3},
    {.name = "particle", .file = "systems/nonholonomic_particle.yaml", .algebra = "R^2", .dimension = 2, .orbit = 2, .of_metric = 6},
    {.name = "ball, three moments", .file = "systems/chaplygin_ball.yaml", .algebra = "SE(2)", .dimension = 3, .orbit = 3, .of_metric = 6},
    {.name = "ball, two moments", .file = "systems/chaplygin_ball.yaml", .algebra = "SE(2) x R", .dimension = 4, .orbit = 4, .of_metric = 7,
     .settings = 1, .setting = {{.name = "B", .value = 1.1}}},
    {.name = "ball, one moment", .file = "systems/chaplygin_ball.yaml", .algebra = "SO(3) x SE(2)", .dimension = 6, .orbit = 5, .of_metric = 9,
     .settings = 2, .setting = {{.name = "B", .value = 1.1}, {.name = "C", .value = 1.1}}},
    {.name = "top", .file = "systems/euler_top.yaml", .algebra = "SO(3)", .dimension = 3, .orbit = 3},
    {.name = "Kepler", .file = "systems/kepler.yaml", .algebra = "SO(3)", .dimension = 3, .orbit = 2, .of_metric = 6},
};

static reducible make_known(const expected *k, uint64_t seed)
{
    nh_error error = {0};
    nh_system *s = k->text ? nh_system_parse(k->name, k->text, k->settings, k->setting, &error) : nh_system_read(k->file, k->settings, k->setting, &error);
    return reducible_make(s, seed, &error);
}

Test(group, dimension_and_algebra_without_an_ansatz, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const expected *e = &known[i];
        for (uint64_t seed = 1; seed <= 2; seed++) {
            nh_error error = {0};
            nh_options options = options_of(seed);
            reducible x = make_known(e, seed);
            const nh_kinetic *k = x.kinetic;
            cr_assert(k->reducible, "%s: %s", e->name, k->obstacle);
            clock_t begin = clock();
            nh_jets *j = nh_jets_find(k, &options, &error);
            must(j != NULL, &error, e->name);
            cr_expect_eq(j->dimension, e->dimension, "%s, seed %d: dimension %zu (values %g | %g)", e->name, (int)seed, j->dimension, j->last_null, j->first_other);
            cr_expect_eq(j->orbit, e->orbit, "%s: orbit %zu", e->name, j->orbit);
            cr_expect(e->of_metric == 0 || j->of_metric == e->of_metric, "%s: isometries %zu", e->name, j->of_metric);
            cr_expect(j->closure < 1e-8, "%s: closure %g", e->name, j->closure);
            cr_expect(j->last_null * 1e3 < j->first_other, "%s: no gap, %g | %g", e->name, j->last_null, j->first_other);
            nh_algebra_report r;
            nh_text name;
            nh_text_init(&name);
            nh_algebra_report_init(&r, &j->algebra, options.group, options.cluster, (size_t)options.ideals, 5);
            nh_algebra_name(&r, NULL, &name);
            cr_expect_str_eq(nh_text_string(&name), e->algebra, "%s: %s", e->name, nh_text_string(&name));
            if (getenv("NHSYM_TEST_FIGURES"))
                printf("%-22s %zu of %zu isometries, orbit %zu, %s, values %.1e | %.1e, closure %.1e, %.2f s\n", e->name, j->dimension, j->of_metric, j->orbit,
                       nh_text_string(&name), j->last_null, j->first_other, j->closure,
                       (double)(clock() - begin) / CLOCKS_PER_SEC);
            nh_text_clear(&name);
            nh_algebra_report_clear(&r);
            nh_jets_free(j);
            reducible_clear(&x);
        }
    }
}

/* Geodesics in the field of a black hole: the metric is indefinite, there are no jets, and still the four symmetries have closed forms. */
Test(group, of_an_indefinite_metric)
{
    nh_error error = {0};
    nh_options options = options_of(1);
    nh_system *s = nh_system_parse("Schwarzschild",
                                   "name: black_hole\nparameters: [{name: M, value: 0.2}]\n"
                                   "coordinates: [T, {name: r, type: length}, {name: th, type: angle}, {name: ph, type: angle}]\n"
                                   "lagrangian: (-(1 - 2*M/r)*T'^2 + r'^2/(1 - 2*M/r) + r^2*(th'^2 + sin(th)^2*ph'^2))/2\n"
                                   "domain: {r: [1, 2], th: [0.5, 2.5]}\n",
                                   0, NULL, &error);
    reducible x = reducible_make(s, 1, &error);
    cr_assert_not_null(x.kinetic, "%s", error.what);
    cr_expect_not(x.kinetic->metric);
    nh_group *g = nh_group_find(x.kinetic, &options, &error);
    must(g != NULL, &error, "the group");
    cr_expect_str_eq(g->name, "SO(3) x R");
    nh_group_free(g);
    reducible_clear(&x);
}
