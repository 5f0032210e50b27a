/* Random systems with built-in symmetries: nothing that is reported as certain is false, and what is built in plainly is found. */
#include <criterion/criterion.h>

#include <unistd.h>

#include "catalogue.h"
#include "random_system.h"
#include "scratch.h"
#include "sweep.h"

#include "graph/dag.h"

enum { systems = 70, generated = 140 };

/* The search is bounded by the size of its stages, not by time, so that it finds the same on every machine. */
static nh_options quick_options(void)
{
    nh_options options;
    nh_options_default(&options);
    options.max_seconds = 1e6;
    options.stage_columns = 30;
    options.until = 0.1;
    options.steps = 2000;
    return options;
}

static row analysed(random_system *r, const nh_options *options)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    random_system_write(r, "random", out);
    fclose(out);
    row o = compare_path(path, options);
    remove(path);
    return o;
}

Test(random, nothing_false_and_what_is_plain_is_found, PLAIN_ONLY)
{
    nh_options options = quick_options();
    size_t tried = 0, known = 0, missing = 0, found = 0;
    for (uint64_t i = 0; i < systems; i++) {
        if (!sweep_tries(i, 90, 180)) continue;
        tried++;
        random_system r = random_system_create(20261121 + i);
        row o = analysed(&r, &options);
        const char *note = random_system_note(&r);
        cr_expect_eq(o.wrong, 0, "%d: %s: %s", (int)i, note, o.names);
        cr_expect_eq(o.unread, 0, "%d: %s: a current not checked by the multiplier form", (int)i, note);
        cr_expect_leq(o.found, o.maximum, "%d: %s", (int)i, note);
        cr_expect_null(strstr(o.names, "error"), "%d: %s: %s", (int)i, note, o.names);
        /* An energy that only a moving observer sees may be hidden; plainly there it must be found. */
        if (r.energy && !r.moves) cr_expect_null(strstr(o.names, "energy"), "%d: %s: %s", (int)i, note, o.names);
        known += o.known;
        missing += o.missing;
        found += o.found;
        nh_dag_free(r.dag);
    }
    cr_expect_geq(known, tried / 2, "only %zu built in", known);
    cr_expect_geq(found, known - missing);
    cr_expect_leq(3 * missing, known, "%zu of %zu built in are missing", missing, known);
}

/* The generator itself: its currents are conserved by the multiplier form, to all digits, and other functions are not. */
Test(random, what_is_built_in_is_conserved, PLAIN_ONLY)
{
    size_t tried = 0, checked = 0, kinds[CONSTRAINT_KINDS] = {0};
    for (uint64_t i = 0; i < generated; i++) {
        if (!sweep_tries(i, 40, 120)) continue;
        tried++;
        nh_error error = {0};
        random_system r = random_system_create(31 + i);
        char *text = NULL;
        size_t size;
        FILE *out = open_memstream(&text, &size);
        random_system_write(&r, "random", out);
        fclose(out);
        nh_system *system = nh_system_parse("random", text, 0, NULL, &error);
        cr_assert_not_null(system, "%s\n%s", error.what, text);
        nh_model *model = nh_model_create(system, nh_chart_create(system, NH_CHART_AUTO, 1, &error), &error);
        cr_assert_not_null(model, "%s\n%s", error.what, text);
        nh_points *at = nh_points_create(model, points, 1, 99, &error);
        cr_assert_not_null(at, "%s\n%s", error.what, text);
        multiplier_motion *motion = multiplier_motion_create(model, at, bits);
        cr_expect_geq(motion->points, (size_t)least_points, "%d: %s", (int)i, random_system_note(&r));
        kinds[r.kind]++;
        cr_expect(nh_is_exact(model->dag, system->lagrangian), "%d: %s", (int)i, text);
        for (size_t k = 0; k < system->currents; k++) {
            multiplier_rate rate = multiplier_rate_of(motion, system->current[k].value);
            multiplier_rate off = multiplier_rate_of(motion, nh_add(model->dag, system->current[k].value, system->coordinate[0].q));
            cr_expect_lt(rate.upper, rate.exact ? -60 : -11, "%d: %s of %s changes at 1e%.0f\n%s", (int)i, system->current[k].name, random_system_note(&r), rate.lower, text);
            cr_expect_gt(off.lower, -8);
            checked += rate.exact;
        }
        multiplier_motion_free(motion);
        nh_points_free(at);
        nh_model_free(model);
        nh_system_free(system);
        nh_dag_free(r.dag);
        free(text);
    }
    cr_expect_geq(2 * checked, tried);
    for (size_t i = 0; i < CONSTRAINT_KINDS && tried == generated; i++) cr_expect_geq(kinds[i], (size_t)1, "no %s", constraint_names[i]);
}
