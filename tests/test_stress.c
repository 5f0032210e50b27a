/* stress: maps that a system file names, those of the discrete problem, those by fixed steps; and that a count of steps ends a cell.  What is measured over ranges is in
 * test_chart.c. */
#include <dirent.h>
#include <math.h>
#include <stdio.h>

#include "mechanics.h"
#include "sweep.h"
#include "document/benchmark.h"
#include "document/html.h"

static nh_robustness *map_within(const char *path, const char *over, double steps, double budget)
{
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    if (steps > 0) q.options.robustness_steps = steps;
    nh_robustness *s = nh_robustness_create(&q, over, budget, &error);
    must(s != NULL, &error, path);
    return s;
}

static nh_robustness *map_over(const char *path, const char *over, double steps) { return map_within(path, over, steps, HUGE_VAL); }

static const nh_robustness_map *map_of(const nh_robustness *s, const char *name)
{
    for (size_t i = 0; i < s->maps; i++)
        if (!strcmp(s->map[i].name, name)) return &s->map[i];
    cr_assert_fail("no map %s", name);
    return NULL;
}

static size_t with_status(const nh_robustness_map *map, size_t method, nh_run_record_status status)
{
    size_t n = 0;
    for (size_t i = method; i < map->cells; i += map->methods) n += map->cell[i].status == status;
    return n;
}

/* Where the two methods of the reference end elsewhere nothing is right or silently wrong: here a constraint is singular at cos(a) = 0, and chaos. */
Test(stress, no_reference_that_two_methods_do_not_confirm, WHOLE_ONLY)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/double_pendulum.yaml", .initial = "p=2, q=2"};
    nh_options_default(&q.options);
    nh_robustness *s = nh_robustness_create(&q, "until=50:60:2", HUGE_VAL, &error);
    must(s != NULL, &error, "double_pendulum");
    cr_expect(s->count[NH_ACCURATE] == 0 && s->count[NH_UNDETECTED] == 0);
    for (size_t i = 0; i < s->map[0].cells; i++) cr_expect(isnan(s->map[0].cell[i].error), "%g", s->map[0].cell[i].error);
    nh_robustness_free(s);
}

/* A page shows a map over two things as a plane: one downwards, the other across, for each method. */
Test(stress, a_plane_on_the_page)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "phi=0.1, omega=2", .until_given = true};
    nh_options_default(&q.options);
    q.options.until = 1;
    nh_benchmark *c = nh_benchmark_run(&q, 0.2, &error);
    must(c != NULL, &error, "sleigh");
    nh_robustness *s = nh_robustness_create(&q, "a=1:2:3, phi=0.25:0.75:3", HUGE_VAL, &error);
    must(s != NULL, &error, "sleigh");
    nh_text page;
    nh_text_init(&page);
    nh_run run = {0};
    nh_benchmark_write(c, s, &run, (nh_pen_style){.form = NH_PEN_PAGE}, &page);
    const char *text = nh_text_string(&page), *table = strstr(text, "a and phi: CVODE BDF");
    cr_assert_not_null(table);
    const char *end = strstr(table, "</table>");
    size_t rows = 0, cells = 0;
    for (const char *at = table; (at = strstr(at, "<th scope=\"row\">")) && at < end; at++) rows++;
    for (const char *at = table; (at = strstr(at, "<td class=")) && at < end; at++) cells++;
    cr_expect(rows == 3 && cells == 9, "%zu, %zu", rows, cells);
    cr_expect(strstr(table, "0.25</th>") < end && strstr(table, "0.75</th>") < end);
    nh_text_clear(&page);
    nh_robustness_free(s);
    nh_benchmark_free(c);
}

/* ---- by name ---- */

Test(stress, a_map_that_the_file_names, PLAIN_ONLY)
{
    nh_robustness *s = map_over("systems/suslov.yaml", "inertia ratios up to 1e6", 0);
    cr_assert(s->maps == 1 && s->map[0].cells == 125 && !strcmp(s->map[0].axis, "A") && !strcmp(s->map[0].second_axis, "C"));
    cr_expect(s->count[NH_UNDETECTED] == 0 && s->count[NH_ACCURATE] + s->count[NH_FLAGGED] > 100, "%zu right", s->count[NH_ACCURATE]);
    nh_robustness_free(s);
}

Test(stress, every_named_map_can_be_read)
{
    static const char *const folders[] = {"systems", "systems/stress"};
    size_t named = 0;
    for (int f = 0; f < 2; f++) {
        char *name[most_files];
        size_t n = list(folders[f], name);
        for (size_t s = 0; s < n; free(name[s++])) {
            char path[400];
            nh_error error = {0};
            snprintf(path, sizeof path, "%s/%s.yaml", folders[f], name[s]);
            nh_system *system = nh_system_read(path, 0, NULL, &error);
            must(system != NULL, &error, path);
            for (size_t i = 0; i < system->robustness_maps; i++, named++) /* a name that does not fit fails here */
                if (sweep_tries(named, 10, 20)) nh_robustness_free(map_within(path, system->robustness_map[i].name, 0, 1e-3));
            nh_system_free(system);
        }
    }
    cr_expect_geq(named, 9);
}

Test(stress, a_name_that_is_not_there)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/suslov.yaml"};
    nh_options_default(&q.options);
    cr_expect_null(nh_robustness_create(&q, "inertia", 1, &error));
    cr_expect(strstr(error.what, "neither a range nor a robustness map") && strstr(error.hint, "inertia ratios up to 1e6"), "%s: %s", error.what, error.hint);
}

/* The chart of coordinate velocities ends at l = c sin(psi1): some motions cross it, and no cell of these is called right. */
Test(stress, the_front_axle_at_its_pole, WHOLE_ONLY)
{
    nh_robustness *s = map_over("systems/stress/front_axle.yaml", "at l = c sin(psi1)", 0);
    cr_expect(s->count[NH_UNDETECTED] == 0 && s->count[NH_DETECTED] > 10 && s->count[NH_ACCURATE] > 10, "%zu wrong, %zu caught, %zu right", s->count[NH_UNDETECTED], s->count[NH_DETECTED], s->count[NH_ACCURATE]);
    nh_robustness_free(s);
}

/* ---- counted, not timed ---- */

Test(stress, few_steps_are_out_of_time)
{
    nh_robustness *s = map_over("systems/isotropic_oscillator.yaml", "until=40:50:2", 10);
    for (size_t i = 0; i < s->map[0].cells; i++) cr_expect(s->map[0].cell[i].status == NH_TIMEOUT && s->map[0].cell[i].note[0], "%s: %s", s->map[0].cell[i].method, s->map[0].cell[i].note);
    nh_robustness_free(s);
    s = map_over("systems/isotropic_oscillator.yaml", "until=40:50:2", 1e5);
    cr_expect_eq(s->count[NH_TIMEOUT], 0);
    nh_robustness_free(s);
}

/* ---- fixed steps ---- */

/* Where nothing turns a motion round in time the discrete Lagrange-d'Alembert principle gains energy exponentially, and the implicit midpoint rule in an orthonormal
 * frame does not [ModinVerdier2020]. */
Test(stress, energy_by_fixed_steps, WHOLE_ONLY)
{
    nh_robustness *s = map_over("systems/stress/driven_particle.yaml", "turned round by nothing", 2e6);
    const nh_robustness_map *map = &s->map[0];
    double drift[2][3] = {{0}};
    cr_assert(map->cells == 30 && s->count[NH_UNDETECTED] == 0);
    for (size_t i = 0; i < map->cells; i++) {
        const nh_robustness_cell *c = &map->cell[i];
        size_t which = !strcmp(c->method, "Lagrange-d'Alembert") ? 0 : !strcmp(c->method, "midpoint") ? 1 : !strcmp(c->method, "energy-preserving") ? 2 : 3;
        if (which < 3 && c->second_at > 2000) drift[c->at > 2][which] = c->drift;
    }
    cr_expect(drift[1][0] > 100 * drift[0][0] && drift[1][0] > 1, "%g when it rotates, %g when it librates", drift[1][0], drift[0][0]);
    cr_expect(drift[1][1] < 0.1 && drift[1][2] < 1e-6, "midpoint %g, energy-preserving %g", drift[1][1], drift[1][2]);
    nh_robustness_free(s);
}

/* What would converge to a different motion is refused, with the reason. */
Test(stress, a_refusal_is_told, WHOLE_ONLY)
{
    nh_robustness *s = map_over("systems/ball_on_turntable.yaml", NULL, 100);
    const nh_robustness_map *map = map_of(s, "long times by fixed steps");
    size_t told = 0;
    for (size_t i = 0; i < map->cells; i++)
        if (!strcmp(map->cell[i].method, "energy-preserving")) told += map->cell[i].status == NH_FAILED && strstr(map->cell[i].note, "a different motion");
    cr_expect_eq(told, map->cells / map->methods);
    nh_robustness_free(s);
}

/* ---- the discrete problem ---- */

Test(stress, samples_that_hardly_determine)
{
    static const char *const path[] = {"systems/sleigh.yaml", "systems/henon_heiles.yaml", "systems/ball_on_turntable.yaml"};
    for (size_t i = 0; i < 3; i++) {
        if (!sweep_tries(i + 2, 1, 3)) continue;
        nh_robustness *s = map_over(path[i], "samples", 0);
        cr_expect(s->maps >= 3 && s->count[NH_UNDETECTED] == 0, "%s: %zu wrong", path[i], s->count[NH_UNDETECTED]);
        const nh_robustness_map *crowded = map_of(s, "clustered samples"), *noisy = map_of(s, "noisy samples"), *edge = map_of(s, "ansatz at the edge of dependence");
        cr_expect(crowded->cell[0].status == NH_ACCURATE && noisy->cell[0].status == NH_ACCURATE && edge->cell[0].status == NH_ACCURATE, "%s", path[i]);
        size_t right = with_status(crowded, 0, NH_ACCURATE), all = crowded->cells / crowded->methods;
        cr_expect_lt(right, all, "%s: some of them are not enough, and it is said", path[i]);
        cr_expect_eq(with_status(edge, 0, NH_DETECTED), 0, "%s", path[i]); /* the generalized solver is not deceived */
        nh_robustness_free(s);
    }
}

/* sin(phi) and sin((1 + d) phi): a plain SVD takes their difference for a current, the quotient does not. */
Test(stress, frequencies_that_nearly_coincide)
{
    nh_robustness *s = map_over("systems/sleigh.yaml", "samples", 0);
    const nh_robustness_map *map = map_of(s, "frequencies that nearly coincide");
    cr_expect(with_status(map, 0, NH_DETECTED) == 0 && with_status(map, 1, NH_DETECTED) > 0, "%zu, %zu", with_status(map, 0, NH_DETECTED), with_status(map, 1, NH_DETECTED));
    nh_robustness_free(s);
}
