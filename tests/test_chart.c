/* chart: errors, drifts and statuses of the methods against what is known of them; the text, JSON and drawing of it. */
#include <cjson/cJSON.h>
#include <dirent.h>
#include <stdio.h>

#include "mechanics.h"
#include "sweep.h"
#include "document/benchmark.h"
#include "commands/benchmark_internal.h"

static nh_benchmark *compare(const char *path, const char *initial, double until, double budget)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = initial, .until_given = true};
    nh_options_default(&q.options);
    q.options.until = until;
    q.options.benchmark_columns = 40; /* of the discrete problem */
    nh_benchmark *c = nh_benchmark_run(&q, budget, &error);
    must(c != NULL, &error, path);
    return c;
}

static const nh_run_record *find(const nh_benchmark *c, const char *method, const char *formulation, double tolerance)
{
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (!strcmp(m->method, method) && strstr(m->formulation, formulation) && m->tolerance == tolerance) return m;
    }
    return NULL;
}

/* The heading passes pi/2, where the chart (phi', x') ends: never called right. */
static void expect_breakdown(const nh_benchmark *c)
{
    size_t seen = 0;
    for (size_t i = 0; i < c->count; i++)
        if (strstr(c->item[i].formulation, "coordinate velocities")) {
            seen++;
            cr_expect(c->item[i].status != NH_ACCURATE, "%s at %g: %s", c->item[i].method, c->item[i].tolerance, nh_run_record_status_name(c->item[i].status));
        }
    cr_expect_geq(seen, 5);
}

/* With error control the error follows the tolerance; the reference is the closed form's equal. */
Test(chart, errors_follow_the_tolerance_unless_the_chart_breaks_down, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/sleigh.yaml", "omega=2", 5, 2);
    cr_expect(c->agreement < 1e-10, "%g", c->agreement);
    cr_expect_geq(c->currents, 2);
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (m->status != NH_ACCURATE || isnan(m->tolerance)) continue;
        cr_expect(m->error < 1e4 * m->tolerance + c->agreement && m->worst_drift < 1e4 * m->tolerance, "%s in %s at %g: %g, %g", m->method, m->formulation, m->tolerance,
                  m->error, m->worst_drift);
        cr_expect(m->seconds > 0 && m->evaluations > 0);
    }
    const nh_run_record *loose = find(c, "GSL rkf45", "quasi", 1e-6), *tight = find(c, "GSL rkf45", "quasi", 1e-10);
    cr_assert(loose && tight);
    cr_expect(tight->error < loose->error / 100 && tight->evaluations > loose->evaluations);
    expect_breakdown(c);
    nh_benchmark_free(c);
}

static bool is_refused(const nh_benchmark *c, const char *words)
{
    for (size_t i = 0; i < c->refused; i++)
        if (strstr(c->refusal[i], words)) return true;
    return false;
}

/* A true closed form is the reference, for what it says; a wrong one is found out; one for other initial states is not looked at. */
Test(chart, closed_forms_are_references_when_they_are_true)
{
    nh_benchmark *c = compare("tests/data/closed_forms.yaml", "phi=-0.7, omega=2, v=0.3", 6, 0.3);
    cr_expect(strstr(c->reference, "closed form \"heading\" of phi, otherwise GSL rk8pd"), "%s", c->reference);
    cr_expect(is_refused(c, "closed form \"as if nothing turned it\": it is not this motion: phi") && is_refused(c, "CVODE Adams at 1e-13 agree to"));
    cr_expect(is_refused(c, "closed form \"of the root of what is negative\": it has no value on the way") && !is_refused(c, "for another start"));
    cr_expect(c->agreement < 1e-10 && c->agreement > 0, "%g", c->agreement);
    nh_benchmark_free(c);
    c = compare("tests/data/closed_forms.yaml", "omega=77", 0.1, 0.3);
    cr_expect(is_refused(c, "for another start"));
    nh_benchmark_free(c);
}

/* Off by what a table's six digits leave: found out, too. */
Test(chart, a_closed_form_that_is_nearly_true)
{
    nh_benchmark *c = compare("tests/data/closed_swing.yaml", NULL, 10, 0.3);
    cr_expect(is_refused(c, "closed form \"six digits\": it is not this motion") && strstr(c->reference, "closed form \"swing\"") && strstr(c->second, "GSL rk8pd"), "%s", c->reference);
    nh_benchmark_free(c);
}

Test(chart, closed_forms_that_are_shipped_are_true, PLAIN_ONLY)
{
    static const char *const folders[] = {"systems", "systems/stress"};
    size_t closed = 0;
    for (int f = 0; f < 2; f++) {
        DIR *folder = opendir(folders[f]);
        for (struct dirent *entry; (entry = readdir(folder));) {
            char path[400];
            nh_error error = {0};
            snprintf(path, sizeof path, "%s/%s", folders[f], entry->d_name);
            if (!strstr(entry->d_name, ".yaml")) continue;
            nh_system *system = nh_system_read(path, 0, NULL, &error);
            must(system != NULL, &error, path);
            nh_known_motion *known;
            size_t motions;
            must(nh_system_motions(system, &motions, &known, &error), &error, path);
            nh_system_free(system);
            if (!motions) continue;
            nh_request q = {.system_path = path, .until_given = true};
            nh_options_default(&q.options);
            q.options.until = 9;
            nh_benchmark_work b; /* the reference only: nothing is measured */
            must(nh_benchmark_work_open(&b, &q, 60, &error) && nh_benchmark_work_reference(&b, &error), &error, path);
            closed++;
            cr_expect(strstr(b.out->reference, "closed form") && !is_refused(b.out, "closed form") && b.out->agreement < 1e-7, "%s: %s, %g", path, b.out->reference, b.out->agreement);
            nh_benchmark_work_close(&b);
            nh_benchmark_free(b.out);
        }
        closedir(folder);
    }
    cr_expect_geq(closed, 12);
}

/* With all the numbers.  As every text for a terminal it has 80 columns. */
static void write_text(const nh_benchmark *c, const nh_robustness *s, nh_text *out)
{
    enum { columns = 80 };
    const nh_run run = {.shown = 4000, .seconds = NAN};
    nh_benchmark_write(c, s, &run, (nh_pen_style){.form = NH_PEN_TEXT, .verbose = true}, out);
    for (const char *line = nh_text_string(out); *line; line += *line == '\n') {
        const char *end = line + strcspn(line, "\n");
        size_t width = 0;
        for (const char *byte = line; byte < end; byte++) width += ((unsigned char)*byte & 0xc0) != 0x80;
        cr_expect_leq(width, (size_t)columns, "%.*s", (int)(end - line), line);
        line = end;
    }
}

/* Two chaotic motions that differ at the end are no reference, whoever chose the time: then nothing is right, and that is said; else the time is shortened. */
Test(chart, no_two_methods_agree, WHOLE_ONLY)
{
    nh_benchmark *c = compare("systems/double_pendulum.yaml", "p=2, q=2", 60, 3);
    cr_expect(c->doubtful && c->agreement > 1e-3, "%g", c->agreement);
    for (size_t i = 0; i < c->count; i++) cr_expect(c->item[i].status != NH_ACCURATE && c->item[i].status != NH_UNDETECTED && !c->item[i].front, "%s", c->item[i].method);
    nh_text text;
    nh_text_init(&text);
    write_text(c, NULL, &text);
    cr_expect(strstr(nh_text_string(&text), "warning: no two methods agree on this motion"));
    nh_text_clear(&text);
    nh_benchmark_free(c);
}

Test(chart, a_time_that_nobody_chose_is_shortened_until_two_methods_agree, WHOLE_ONLY)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/double_pendulum.yaml", .initial = "p=2, q=2"};
    nh_options_default(&q.options);
    q.options.until = 60;
    nh_benchmark *c = nh_benchmark_run(&q, 1, &error);
    must(c != NULL, &error, "double_pendulum");
    cr_expect(c->shortened && !c->doubtful && c->agreement < 1e-4 && c->end < 60, "%g, %g", c->agreement, c->end);
    nh_benchmark_free(c);
}

/* 1e8 radians in the default time, none of which can be reached: the time becomes that of what can be. */
Test(chart, a_very_fast_motion, PLAIN_ONLY)
{
    nh_error error = {0};
    nh_request q = {.system_path = "tests/data/ion.yaml"};
    nh_options_default(&q.options);
    nh_benchmark *c = nh_benchmark_run(&q, 0.1, &error);
    must(c != NULL, &error, "ion");
    cr_expect(c->shortened && c->end - c->begin < 0.01 && c->end > c->begin, "%g", c->end - c->begin);
    nh_benchmark *again = nh_benchmark_run(&q, 0.1, &error); /* counted work decides until when, not the clock */
    must(again != NULL, &error, "ion");
    cr_expect_eq(again->end, c->end);
    nh_benchmark_free(again);
    nh_benchmark_free(c);
}

/* Some of the chart's probes lie near z = 0, where z' is large, so that the terms of dE/dt are, too: E is conserved all the same. */
Test(chart, what_is_conserved_near_the_end_of_a_chart)
{
    nh_benchmark *c = compare("tests/data/sphere.yaml", "z=-1, x'=1", 1, 0.3);
    cr_expect(c->currents == 1 && !strcmp(c->current[0], "E") && !is_refused(c, "relaxation, order 4: the energy is not conserved"));
    nh_benchmark_free(c);
}

Test(chart, a_known_current_that_is_none)
{
    nh_benchmark *c = compare("tests/data/closed_swing.yaml", NULL, 3, 0.3);
    cr_expect(is_refused(c, "the known current \"none\": it is not conserved"));
    nh_benchmark_free(c);
}

Test(chart, projection_has_no_drift, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/contact_oscillator.yaml", NULL, 8, 20);
    const nh_run_record *plain = find(c, "GSL rk8pd", "", 1e-4), *projected = find(c, "GSL rk8pd, projected", "", 1e-4);
    cr_assert(plain && projected);
    cr_expect(projected->worst_drift < 1e-12 && plain->worst_drift > 1e-9, "%g, %g", projected->worst_drift, plain->worst_drift);
    nh_benchmark_free(c);
}

/* The reason is that of the system. */
Test(chart, why_the_energy_preserving_method_is_refused)
{
    static const struct {
        const char *path, *why;
    } all[] = {{"systems/ball_on_turntable.yaml", "the constraints are affine"}, {"systems/skate_with_friction.yaml", "forces without a potential"},
               {"systems/bead_on_turning_wire.yaml", "the constraints are affine"}, {"systems/damped_oscillator.yaml", "time occurs in the energy"}};
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) {
        nh_benchmark *c = compare(all[i].path, NULL, 1, 0.05);
        char words[200];
        snprintf(words, sizeof words, "energy-preserving: it would converge to a different motion: %s", all[i].why);
        bool refused = false;
        for (size_t k = 0; k < c->refused; k++) refused |= strstr(c->refusal[k], strstr(all[i].why, "forces") ? "it has no terms for forces without a potential" : words) != NULL;
        cr_expect(refused, "%s: %s", all[i].path, all[i].why);
        nh_benchmark_free(c);
    }
}

Test(chart, what_would_be_wrong_is_refused, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/ball_on_turntable.yaml", NULL, 1, 0.3);
    bool refused = false;
    for (size_t i = 0; i < c->refused; i++) refused |= strstr(c->refusal[i], "energy-preserving: it would converge to a different motion") != NULL;
    for (size_t i = 0; i < c->count; i++) cr_expect(!strstr(c->item[i].method, "energy"));
    cr_expect(refused);
    nh_benchmark_free(c);
}

/* Differences are off by about their order's share of rounding; a complex step and the exact Jacobian by rounding and nothing, the latter for less work. */
Test(chart, derivatives_by_differences, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/sleigh.yaml", "omega=2", 1, 0.2);
    static const double least[] = {0, 0, 1e-10, 1e-13, 0}, most[] = {0, 1e-14, 1e-6, 1e-8, 1e-10};
    static const long work[] = {1, 5, 6, 10, 20}; /* 5 states */
    cr_assert_eq(c->derivatives, 5);
    for (size_t i = 0; i < 5; i++) {
        const nh_derivative *d = &c->derivative[i];
        cr_expect(d->error >= least[i] && d->error <= most[i], "%s: %g", d->method, d->error);
        cr_expect_eq(d->evaluations, work[i], "%s: %ld", d->method, d->evaluations);
        cr_expect(d->seconds > 0 && isfinite(d->seconds));
    }
    nh_benchmark_free(c);
}

static bool has_formulation(const nh_benchmark *c, const char *words, size_t *right)
{
    bool any = false;
    for (size_t i = 0; i < c->count; i++) {
        const nh_run_record *m = &c->item[i];
        if (!strstr(m->formulation, words)) continue;
        any = true;
        *right += m->status == NH_ACCURATE;
        if (m->reduced && m->status == NH_ACCURATE && !isnan(m->tolerance)) cr_expect(m->error < 1e4 * m->tolerance && !m->front, "%s in %s at %g: %g", m->method, m->formulation, m->tolerance, m->error);
    }
    return any;
}

/* Quasi-velocities, coordinate velocities, all coordinates, multipliers of both indices, and the stages of the reduction, twice reduced too. */
Test(chart, every_formulation, WHOLE_ONLY)
{
    size_t right = 0;
    nh_benchmark *c = compare("systems/sleigh.yaml", "omega=2", 4, 20);
    cr_expect(has_formulation(c, "quasi-velocities", &right) && has_formulation(c, "coordinate velocities", &right) && has_formulation(c, "all coordinates", &right));
    right = 0;
    cr_expect(has_formulation(c, "reduced by SE(2), 2 states", &right) && right >= 10, "%zu", right);
    const nh_run_record *one = find(c, "IDA, index 1", "multipliers", 1e-8), *two = find(c, "IDA, index 2", "multipliers", 1e-8);
    cr_assert(one && two && one->status == NH_ACCURATE && two->status == NH_ACCURATE);
    cr_expect(two->error < 1e-5, "%g", two->error);
    nh_benchmark_free(c);
    c = compare("systems/vertical_disk.yaml", NULL, 4, 5);
    cr_expect(has_formulation(c, "reduced again by", &right));
    nh_benchmark_free(c);
}

/* Currents among polynomials: a plain SVD takes sin^2 + cos^2 - 1 for one, the quotient does not; both bases and routes find the known ones. */
Test(chart, the_discrete_problem, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/spherical_pendulum.yaml", NULL, 1, 12);
    size_t deceived = 0, exact = 0, routes = 0;
    cr_assert(c->fits > 20, "%zu", c->fits);
    for (size_t i = 0; i < c->fits; i++) {
        const nh_fitted *m = &c->fit[i];
        if (!strcmp(m->solver, "plain SVD")) {
            deceived += m->dimension > m->wanted;
            continue;
        }
        if (!strcmp(m->route, "current") && m->samples > 2 * m->functions) cr_expect_eq(m->dimension, m->wanted, "%zu functions, %s: %zu of %zu", m->functions, m->basis, m->dimension, m->wanted);
        if (m->functions >= 15) exact += m->error < 1e-8;
        routes += !strcmp(m->route, "symmetry");
        cr_expect(m->seconds > 0 && m->rank <= m->columns);
    }
    cr_expect(deceived > 0 && exact > 4 && routes > 0, "%zu, %zu, %zu", deceived, exact, routes);
    nh_benchmark_free(c);
}

/* What is called wrong is an option. */
Test(chart, thresholds_are_options, WHOLE_ONLY)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "omega=2", .until_given = true};
    nh_options_default(&q.options);
    q.options.until = 5;
    q.options.benchmark_error = 1e-9;
    q.options.benchmark_far = 1;
    nh_benchmark *c = nh_benchmark_run(&q, 2, &error);
    must(c != NULL, &error, "sleigh");
    size_t wrong = 0;
    for (size_t i = 0; i < c->count; i++) wrong += c->item[i].status == NH_UNDETECTED;
    cr_expect_gt(wrong, 5);
    nh_benchmark_free(c);
}

/* A budget of nearly nothing still gives a document, which says that it is partial. */
Test(chart, a_short_budget_is_told)
{
    nh_benchmark *c = compare("systems/rolling_disk.yaml", NULL, 5, 0.15);
    cr_expect(c->partial);
    nh_benchmark_free(c);
}

static void check_document(const nh_benchmark *c)
{
    char *text = nh_benchmark_json(c, NULL, NULL);
    cJSON *root = cJSON_Parse(text), *motion = cJSON_GetObjectItem(root, "motion"), *item;
    cr_assert_not_null(root);
    cr_expect_eq((size_t)cJSON_GetArraySize(motion), c->count);
    cJSON_ArrayForEach(item, motion)
    {
        cr_expect(cJSON_IsString(cJSON_GetObjectItem(item, "method")) && cJSON_IsString(cJSON_GetObjectItem(item, "formulation")));
        cr_expect(cJSON_IsNull(cJSON_GetObjectItem(item, "tolerance")) != cJSON_IsNull(cJSON_GetObjectItem(item, "step")));
        cr_expect(cJSON_IsString(cJSON_GetObjectItem(item, "status")) && cJSON_IsBool(cJSON_GetObjectItem(item, "front")));
    }
    cr_expect(cJSON_IsArray(cJSON_GetObjectItem(root, "stress")));
    cr_expect(!strstr(text, "nan") && !strstr(text, "inf"));
    cJSON_Delete(root);
    nh_free(text);
}

Test(chart, text_json_and_drawing, PLAIN_ONLY)
{
    nh_benchmark *c = compare("systems/nonholonomic_particle.yaml", NULL, 4, 3);
    nh_text text, svg;
    nh_text_init(&text);
    nh_text_init(&svg);
    write_text(c, NULL, &text);
    nh_benchmark_svg(c, &svg);
    check_document(c);
    cr_expect(strstr(nh_text_string(&text), "  GSL rk8pd: accurate") && !strstr(nh_text_string(&text), "nan"), "%s", nh_text_string(&text));
    cr_expect(strstr(nh_text_string(&svg), "The discrete problem") && strstr(nh_text_string(&text), "The discrete problem"));
    cr_expect(strstr(nh_text_string(&svg), "<svg") && strstr(nh_text_string(&svg), "</svg>") && !strstr(nh_text_string(&svg), "nan") && !strstr(nh_text_string(&svg), "inf"));
    size_t fronts = 0;
    for (size_t i = 0; i < c->count; i++) fronts += c->item[i].front;
    cr_expect(fronts >= 1 && fronts < c->count);
    nh_text_clear(&text);
    nh_text_clear(&svg);
    nh_benchmark_free(c);
}

Test(chart, what_cannot_be_computed_is_explained)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "omega=2", .until_given = true};
    nh_options_default(&q.options);
    q.options.until = 0;
    cr_expect_null(nh_benchmark_run(&q, 1, &error));
    cr_expect_not_null(strstr(error.what, "ends where it begins"), "%s", error.what);
}

/* ---- stress ---- */

static nh_robustness *stress_of(const char *path, const char *initial, double until, double budget)
{
    nh_error error = {0};
    nh_request q = {.system_path = path, .initial = initial, .until_given = true};
    nh_options_default(&q.options);
    q.options.until = until;
    nh_robustness *s = nh_robustness_create(&q, NULL, budget, &error);
    must(s != NULL, &error, path);
    return s;
}

static const nh_robustness_map *map_of(const nh_robustness *s, const char *words)
{
    for (size_t i = 0; i < s->maps; i++)
        if (strstr(s->map[i].name, words)) return &s->map[i];
    cr_assert_fail("no map %s", words);
    return NULL;
}

Test(chart, stress_calls_right_only_what_is, WHOLE_ONLY)
{
    nh_robustness *s = stress_of("systems/sleigh.yaml", "omega=2", 5, 20);
    size_t all = 0, sum = 0;
    for (size_t i = 0; i < s->maps; i++)
        for (size_t j = 0; j < s->map[i].cells; j++) {
            const nh_robustness_cell *c = &s->map[i].cell[j];
            all++;
            if (c->status == NH_ACCURATE) cr_expect(c->error <= s->accuracy, "%s at %g, %s: %g", s->map[i].name, c->at, c->method, c->error);
            if (c->status == NH_FLAGGED || c->status == NH_DETECTED || c->status == NH_FAILED) cr_expect(c->note && c->note[0], "%s at %g, %s", s->map[i].name, c->at, c->method);
        }
    for (int k = 0; k < NH_RUN_STATUSES; k++) sum += s->count[k];
    cr_expect(all > 100 && sum == all, "%zu, %zu", all, sum);
    /* the heading turns by pi: wherever it starts, it crosses cos phi = 0 */
    const nh_robustness_map *turned = map_of(s, "phi turned");
    for (size_t j = 0; j < turned->cells; j++)
        cr_expect(turned->cell[j].status != NH_ACCURATE && turned->cell[j].status != NH_UNDETECTED, "%g, %s: %s", turned->cell[j].at, turned->cell[j].method,
                  nh_run_record_status_name(turned->cell[j].status));
    cr_expect(map_of(s, "parameter m")->cells == 7 * turned->methods && map_of(s, "long times") && map_of(s, "badly scaled"));
    nh_robustness_free(s);
}

/* A map over two things that the user names: a range over decades is divided by ratios, one from 0 evenly. */
Test(chart, stress_over_what_is_named, PLAIN_ONLY)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "phi=0.1, omega=2", .until_given = true};
    nh_options_default(&q.options);
    q.options.until = 3;
    nh_robustness *s = nh_robustness_create(&q, "a=1e-3:10:3, phi=0:6:4", 10, &error);
    must(s != NULL, &error, "sleigh");
    cr_assert(s->maps == 1 && s->map[0].cells == 12 * s->map[0].methods && !strcmp(s->map[0].axis, "a") && !strcmp(s->map[0].second_axis, "phi"));
    static const double a[] = {1e-3, 0.1, 10}, phi[] = {0, 2, 4, 6};
    for (size_t i = 0; i < s->map[0].cells; i++) {
        const nh_robustness_cell *c = &s->map[0].cell[i];
        size_t value = i / s->map[0].methods;
        cr_expect_float_eq(c->at, a[value / 4], 1e-12);
        cr_expect_float_eq(c->second_at, phi[value % 4], 1e-12);
        cr_expect(c->status != NH_UNDETECTED && c->status != NH_FAILED, "%g, %g: %s", c->at, c->second_at, c->note);
    }
    cr_expect_str_eq(s->map[0].name, "a and phi");
    nh_robustness_free(s);
}

static void expect_no_map(const char *initial, const char *over, const char *what)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = initial};
    nh_options_default(&q.options);
    cr_expect_null(nh_robustness_create(&q, over, 1, &error));
    cr_expect(strstr(error.what, what) && error.hint[0], "%s: %s", over, error.what);
}

Test(chart, stress_over_what_is_not_there)
{
    expect_no_map("omega=2", "nothing=1:2", "no such parameter, coordinate, velocity or option");
    expect_no_map(NULL, "omega=1:2", "not given");
    expect_no_map("omega=2", "a", "neither a range nor a robustness map");
    expect_no_map("omega=2", "a=1", "is no range");
    expect_no_map("omega=2", "a=1:2:0", "is no range");
    expect_no_map("omega=2", "a=1:2:x", "is no range");
    expect_no_map("omega=2", "a=1:2, k=1:2, m=1:2", "at most 2");
}

Test(chart, stress_as_text_and_json, PLAIN_ONLY)
{
    nh_robustness *s = stress_of("systems/isotropic_oscillator.yaml", NULL, 3, 3);
    nh_benchmark *c = compare("systems/isotropic_oscillator.yaml", NULL, 3, 1);
    nh_text text;
    nh_text_init(&text);
    write_text(c, s, &text);
    cr_expect(strstr(nh_text_string(&text), "long times") && strstr(nh_text_string(&text), "  In all: ") && !strstr(nh_text_string(&text), "nan"));
    char *json = nh_benchmark_json(c, s, NULL);
    cJSON *root = cJSON_Parse(json), *list = cJSON_GetObjectItem(root, "stress"), *map;
    cr_assert_eq((size_t)cJSON_GetArraySize(list), s->maps);
    size_t i = 0;
    cJSON_ArrayForEach(map, list)
    {
        cr_expect_eq((size_t)cJSON_GetArraySize(cJSON_GetObjectItem(map, "cells")), s->map[i].cells);
        cr_expect(cJSON_IsArray(cJSON_GetObjectItem(map, "axes")) && cJSON_IsArray(cJSON_GetObjectItem(cJSON_GetArrayItem(cJSON_GetObjectItem(map, "cells"), 0), "at")));
        i++;
    }
    cr_expect(!strstr(json, "nan") && !strstr(json, "inf"));
    cJSON_Delete(root);
    nh_free(json);
    nh_text_clear(&text);
    nh_benchmark_free(c);
    nh_robustness_free(s);
}

static double observed(const nh_benchmark *c, const char *method, size_t level)
{
    for (size_t i = 0; i + level < c->count; i++)
        if (!strcmp(c->item[i].method, method) && !strcmp(c->item[i].formulation, c->item[0].formulation)) return c->item[i + level].observed_order;
    return NAN;
}

/* Only what was asked for is measured; composed midpoint steps have order 4, single ones 2, and that shows in their errors; the table has a row per run. */
Test(chart, named_methods_and_their_orders)
{
    nh_error error = {0};
    const nh_method *const only[] = {nh_method_find("midpoint"), nh_method_find("midpoint-4"), nh_method_find("rkf45")};
    nh_request q = {.system_path = "systems/nonholonomic_particle.yaml", .until_given = true, .methods = 3, .method = only};
    nh_options_default(&q.options);
    q.options.until = 4;
    nh_benchmark *c = nh_benchmark_run(&q, 1, &error);
    must(c != NULL, &error, "nonholonomic_particle");
    for (size_t i = 0; i < c->count; i++) {
        bool named = false;
        for (size_t k = 0; k < 3; k++) named |= !strcmp(c->item[i].method, only[k]->name);
        cr_expect(named, "%s", c->item[i].method);
        cr_expect(!strcmp(c->item[i].method, "GSL rkf45") == (c->item[i].order == 0));
    }
    cr_expect(c->fits == 0 && c->derivatives == 0);
    cr_expect(isnan(observed(c, "midpoint", 0)) && isnan(observed(c, "GSL rkf45", 1)));
    cr_expect_float_eq(observed(c, "midpoint", 2), 2, 0.05, "%g", observed(c, "midpoint", 2));
    cr_expect_float_eq(observed(c, "midpoint, order 4", 1), 4, 0.1, "%g", observed(c, "midpoint, order 4", 1));
    nh_text text;
    nh_text_init(&text);
    write_text(c, NULL, &text);
    cr_expect(strstr(nh_text_string(&text), "Order of convergence") && strstr(nh_text_string(&text), "the integrators that were asked for"));
    nh_text_clear(&text);
    nh_benchmark_csv(c, &text);
    size_t lines = 0;
    for (const char *at = nh_text_string(&text); (at = strchr(at, '\n')); at++) lines++;
    cr_expect_eq(lines, c->count + 1);
    cr_expect(strstr(nh_text_string(&text), "\n\"midpoint, order 4\",") && !strstr(nh_text_string(&text), "nan"));
    nh_text_clear(&text);
    nh_benchmark_free(c);
}
