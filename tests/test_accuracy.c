/* An accuracy that is said to be reached is reached; one that cannot be is said not to be. */
#include <dirent.h>
#include <stdio.h>

#include "accuracy_cases.h"
#include "mechanics.h"
#include "sweep.h"
#include "commands/simulate.h"

enum { COUNT = 6 };

static nh_trajectory *accurate(const nh_model *o, const nh_state *initial, double until, double eps, size_t n, const nh_ex *e, bool smallest, nh_accuracy *a)
{
    double times[COUNT];
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    for (int i = 0; i < COUNT; i++) times[i] = initial->t + until * i / (COUNT - 1);
    nh_trajectory_request q = {.model = o, .initial = initial, .count = COUNT, .times = times, .options = &options, .n = n, .e = e, .smallest = smallest};
    return nh_trajectory_accurate(&q, eps, NULL, a, &error);
}

Test(accuracy, the_closed_form_is_met)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    double q[3] = {0}, v[3] = {2, 0, 0}, used = 0;
    nh_state initial = {.q = q, .v = v};
    nh_ex e[2] = {formula(x.model, "phi"), formula(x.model, "omega")};
    for (double eps = 1e-3; eps > 1e-12; eps /= 100) {
        nh_accuracy a;
        nh_trajectory *t = accurate(x.model, &initial, 6, eps, 2, e, true, &a);
        cr_assert(t && a.held, "%g: %s", eps, a.why);
        for (int i = 0; i < COUNT; i++) {
            double s = 6.0 * i / (COUNT - 1);
            cr_expect_float_eq(t->value[2 * i], 4 * atan(tanh(s / 2)), 3.2 * eps, "%g", eps);
            cr_expect_float_eq(t->value[2 * i + 1], 2 / cosh(s), 2 * eps, "%g", eps);
        }
        cr_expect_gt((double)t->motion->evaluations, used / 2); /* more digits, more work, roughly */
        used = (double)t->motion->evaluations;
        nh_trajectory_free(t);
    }
    mechanics_clear(&x);
}

static size_t asked, held;

static void try_system(const char *path, size_t index)
{
    mechanics x = mechanics_of_file(path, NH_CHART_AUTO, 0, NULL);
    double *at = nh_alloc_array(2 * x.model->m, sizeof *at);
    accuracy_case c;
    if (accuracy_start(&c, x.model, index, index % 2, at, at + x.model->m)) {
        accuracy_try(&c, false);
        asked += c.complete && c.known;
        held += c.a.held && c.known;
        cr_expect(!c.wrong, "%s: %g asked, %g found (%s)", path, c.eps, c.error, c.a.why);
    }
    nh_free(at);
    mechanics_clear(&x);
}

/* A sample of what `make bench` tries: every fourth system, one start each, and fewer of these in `make check`. */
Test(accuracy, what_is_held_is_true)
{
    char *name[most_files];
    size_t n = list("systems", name), tried = 0;
    for (size_t i = 0; i < n; free(name[i++])) {
        char path[400];
        snprintf(path, sizeof path, "systems/%s.yaml", name[i]);
        if (i % 4 || !sweep_tries(i / 4, 8, 24)) continue;
        try_system(path, i / 4);
        tried++;
    }
    cr_expect(2 * asked >= tried && 10 * held >= 8 * asked, "%zu of %zu held", held, asked);
}

/* Errors of 2e-7 at one tolerance and at a tenth of it, of nearly one sign: their difference says less than either is. */
Test(accuracy, two_runs_that_err_alike_are_not_believed)
{
    static const double eps[] = {1e-6, 3e-7, 1e-7, 3e-8, 1e-8};
    mechanics x = mechanics_of_file("systems/lagrange_top.yaml", NH_CHART_AUTO, 0, NULL);
    double *at = nh_alloc_array(2 * x.model->m, sizeof *at);
    accuracy_case c;
    cr_assert(accuracy_start(&c, x.model, 0, 2, at, at + x.model->m));
    for (size_t i = 0; i < sizeof eps / sizeof *eps; i++) {
        c.eps = eps[i];
        accuracy_try(&c, false);
        cr_expect(c.known && c.a.held && !c.wrong, "%g asked, %g found (%s)", c.eps, c.error, c.a.why);
    }
    nh_free(at);
    mechanics_clear(&x);
}

/* x'' = 9 x from (1, -3): e^(-3t) and, from rounding, e^(3t). (Not 16 and 4: powers of two would not be rounded.) */
Test(accuracy, an_unstable_motion_is_not_passed_off)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 + 9/2*x^2\n", NH_CHART_AUTO);
    double q[2] = {1, 0}, v[2] = {-3, 1};
    nh_state initial = {.q = q, .v = v};
    nh_ex e = formula(x.model, "x");
    for (double until = 2; until < 17; until += 2) {
        nh_accuracy a;
        nh_trajectory *t = accurate(x.model, &initial, until, 1e-9, 1, &e, true, &a);
        cr_assert_not_null(t);
        double worst = 0;
        for (int i = 0; i < COUNT; i++) worst = fmax(worst, fabs(t->value[i] - exp(-3 * until * i / (COUNT - 1))));
        if (a.held) cr_expect_lt(worst, 1e-9, "until %g: %g, %s", until, worst, a.why);
        if (until >= 14) cr_expect(!a.held, "until %g: %g", until, worst);
        nh_trajectory_free(t);
    }
    mechanics_clear(&x);
}

/* Stiff: the explicit pair is not chosen. */
Test(accuracy, a_stiff_motion_gets_another_method)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - x^2/2\n"
                                    "forces: [\"y = -1e5*(y' - cos(x))\"]\n", NH_CHART_AUTO);
    double q[2] = {0.4, 0}, v[2] = {0.3, 0.9};
    nh_state initial = {.q = q, .v = v};
    nh_accuracy a;
    nh_ex e = formula(x.model, "y");
    nh_trajectory *t = accurate(x.model, &initial, 20, 1e-6, 1, &e, true, &a);
    cr_assert(t && a.held, "%s", a.why);
    cr_expect(strcmp(t->method, "CVODE BDF") == 0 && strcmp(a.second, "ARKODE ESDIRK") == 0, "%s, %s", t->method, a.second);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

Test(accuracy, beyond_rounding_is_refused)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "omega=2", .until_given = true, .accuracy = 1e-17};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, "sleigh");
    cr_expect(s->checked && !s->accuracy.held && strstr(s->accuracy.why, "not reached"), "%s", s->accuracy.why);
    nh_simulation_free(s);
}

/* The motion along which currents are checked, by the accuracy and by a way that the caller knows. */
Test(accuracy, the_checked_motion_is_as_accurate)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - x^2/2\nconstraints: [\"y' = cos(x)*x'\"]\n", NH_CHART_AUTO);
    double q[2] = {1, sin(1)}, v[2] = {0, 0};
    nh_state initial = {.q = q, .v = v};
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    nh_integration_plan adams = {nh_method_find("CVODE Adams"), NH_OWN_VELOCITIES, 1e-9, NAN, 1e-9, 1e3};
    nh_ex e = x.model->E;
    nh_validation_request request = {.model = x.model, .currents = 1, .current = &e, .initial = &initial, .until = 30, .outputs = 61, .options = &options};
    nh_integration_plans measured = {.count = 1, .way = &adams, .plain = true};
    for (double eps = 1e-4; eps > 1e-11; eps /= 100) {
        request.accuracy = eps;
        request.ways = eps < 1e-7 ? &measured : NULL; /* then CVODE is said to be the cheapest */
        nh_validation *r = nh_validate(&request, &error);
        must(r != NULL, &error, "the validation");
        cr_expect(r->checked && (r->accuracy.held || eps < 1e-9), "%g: %s", eps, r->accuracy.why);
        if (eps > 1e-9) cr_expect_str_eq(r->method, request.ways ? "CVODE Adams" : "GSL rk8pd");
        cr_expect_eq(r->tolerance[NH_DRIFT_RUNS - 1], r->accuracy.tolerance);
        double worst = 0; /* y = sin(x) at every time; dE/dt = 0 */
        for (size_t i = 0; i < r->count; i++) worst = fmax(worst, fabs(r->state[i * r->size + 1] - sin(r->state[i * r->size])));
        cr_expect_lt(worst, r->accuracy.held ? eps : 1, "%g: %g, %s", eps, worst, r->accuracy.why);
        cr_expect(r->current[0].small, "%g", r->current[0].drift[NH_DRIFT_RUNS - 1]);
        nh_validation_free(r);
    }
    mechanics_clear(&x);
}

/* z' = 40 x x' has a large factor and is determined at every point: no other coordinates are needed. */
Test(accuracy, a_steep_surface_does_not_end_its_chart)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - z\n"
                                    "constraints: [\"z - 20*x^2 - y^2 = 0\"]\n", NH_CHART_AUTO);
    cr_assert(x.model->chart->regular);
    double q[3] = {1, 0.5, 20.25}, v[3] = {0, 0.3, 0.3};
    nh_state initial = {.q = q, .v = v};
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    nh_ex e = x.model->E;
    nh_validation_request request = {.model = x.model, .currents = 1, .current = &e, .initial = &initial, .until = 5, .outputs = 61, .options = &options};
    nh_validation *r = nh_validate(&request, &error);
    must(r != NULL, &error, "the validation");
    cr_expect_str_eq(r->chart, x.model->chart->name);
    cr_expect(r->current[0].small, "%g", r->current[0].drift[NH_DRIFT_RUNS - 1]);
    nh_validation_free(r);
    mechanics_clear(&x);
}

/* What is known of another motion may be too hopeful: the accuracy is reached without it. */
Test(accuracy, what_was_measured_is_not_the_last_word)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    double q[3] = {0}, v[3] = {2, 0, 0}, times[COUNT];
    nh_state initial = {.q = q, .v = v};
    nh_ex e = formula(x.model, "phi");
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    for (int i = 0; i < COUNT; i++) times[i] = 6.0 * i / (COUNT - 1);
    nh_trajectory_request request = {.model = x.model, .initial = &initial, .count = COUNT, .times = times, .options = &options, .n = 1, .e = &e};
    nh_integration_plan hopeful = {nh_method_find("midpoint"), NH_OWN_VELOCITIES, NAN, 0.1, 1e-13, 1};
    nh_accuracy a;
    nh_trajectory *t = nh_trajectory_accurate(&request, 1e-12, &(nh_integration_plans){.count = 1, .way = &hopeful}, &a, &error);
    cr_assert(t && a.held, "%s", a.why);
    cr_expect_str_eq(t->method, "GSL rk8pd");
    cr_expect(strstr(a.why, "midpoint, did not reach the accuracy"), "%s", a.why);
    cr_expect(!a.measured && a.runs > 4);
    cr_expect_float_eq(t->value[COUNT - 1], 4 * atan(tanh(3.0)), 1e-11);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

/* ---- what is measured on the way ---- */

static nh_trajectory *by_pilot_runs(const nh_model *o, const nh_state *initial, double until, double eps, size_t n, const nh_ex *e, nh_accuracy *a)
{
    double times[COUNT];
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    options.steps = 1e8;
    for (int i = 0; i < COUNT; i++) times[i] = initial->t + until * i / (COUNT - 1);
    nh_trajectory_request q = {.model = o, .initial = initial, .count = COUNT, .times = times, .options = &options, .n = n, .e = e};
    return nh_trajectory_accurate(&q, eps, &(nh_integration_plans){.pilot = true}, a, &error);
}

/* Many thousands of periods of a driven oscillator, x = 2 sin(t): others are measured, the result is right whatever is chosen.  A tenth of one period: nothing is measured. */
Test(accuracy, a_long_motion_is_measured_and_a_short_one_is_not, PLAIN_ONLY)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2/2\nforces: [\"x = -x'/2 + cos(t)\"]\n", NH_CHART_AUTO);
    double q[1] = {0}, v[1] = {2}, until = 4e5;
    nh_state initial = {.q = q, .v = v};
    nh_accuracy a;
    nh_ex e = formula(x.model, "x");
    nh_trajectory *t = by_pilot_runs(x.model, &initial, until, 1e-5, 1, &e, &a);
    cr_assert(t && a.held, "%s", a.why);
    cr_expect(a.choice == NH_CHOICE_PILOT && strstr(a.why, "of the motion"), "%s", a.why);
    for (int i = 0; i < COUNT; i++) cr_expect_float_eq(t->value[i], 2 * sin(until * i / (COUNT - 1)), 2e-5);
    nh_trajectory_free(t);
    t = by_pilot_runs(x.model, &initial, 0.6, 1e-6, 1, &e, &a);
    cr_expect(t && a.held && a.choice == NH_CHOICE_SHORT && strstr(a.why, "would need more"), "%s", a.why);
    nh_trajectory_free(t);
    mechanics_clear(&x);
}

/* ---- ensembles ---- */

enum { MEMBERS = 150 };

/* Every member, from around `start` = (q, v), against a tight motion of its own. */
static void try_ensemble(const char *text, const double start[4], double until, double eps, size_t threads, double *value)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    size_t m = x.model->m, size = m + x.model->n, n = m;
    double initial[MEMBERS * 4], times[COUNT];
    cr_assert_eq(size, 4);
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    for (int i = 0; i < COUNT; i++) times[i] = until * i / (COUNT - 1);
    nh_ensemble_states(size, start, MEMBERS, 0.2, 3, initial);
    nh_trajectory_request q = {.model = x.model, .count = COUNT, .times = times, .options = &options, .n = n, .e = x.model->rho};
    nh_ensemble_accuracy a;
    nh_ensemble *e = nh_ensemble_accurate(&q, MEMBERS, initial, threads, eps, NULL, &a, &error);
    cr_assert(e && a.held, "%s", a.why);
    options.tolerance = 1e-14;
    for (size_t j = 0; j < MEMBERS; j++) {
        nh_state from = {.q = initial + j * size, .v = initial + j * size + m}; /* no constraints: w are the velocities */
        q.initial = &from;
        q.method = nh_method_find("GSL rk8pd");
        nh_trajectory *t = nh_trajectory_create(&q, &error);
        size_t which = 0;
        double off = nh_accuracy_difference(COUNT, n, e->value + j * COUNT * n, t->value, NULL, &which);
        cr_expect_lt(off, eps, "member %zu: %g (%s)", j, off, a.why);
        nh_trajectory_free(t);
    }
    if (value) memcpy(value, e->value, MEMBERS * COUNT * n * sizeof *value);
    nh_ensemble_free(e);
    mechanics_clear(&x);
}

Test(accuracy, every_member_of_an_ensemble_is_as_accurate, PLAIN_ONLY)
{
    static const char *const pendulum = "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 + cos(x) - y^4/4 + x*y/5\n";
    static const char *const kepler = "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 + 1/sqrt(x^2 + y^2)\n";
    static double one[MEMBERS * COUNT * 2], two[MEMBERS * COUNT * 2];
    try_ensemble(pendulum, (double[]){1, 0.5, 0.2, 0}, 20, 1e-5, 1, one);
    try_ensemble(pendulum, (double[]){1, 0.5, 0.2, 0}, 20, 1e-5, 2, two);
    cr_expect_eq(memcmp(one, two, sizeof one), 0); /* whatever the number of threads */
    try_ensemble(pendulum, (double[]){1, 0.5, 0.2, 0}, 20, 1e-9, 2, NULL);
    try_ensemble(kepler, (double[]){1, 0, 0, 0.5}, 15, 1e-8, 2, NULL);
}

enum { STIFF_MEMBERS = 8 };

/* From around one state, all states of each member in `value`; how it was done in *a. */
static nh_ensemble *stiff_ensemble(const char *text, const double start[4], double until, size_t threads, const nh_integration_plans *ways, nh_ensemble_accuracy *a)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    double initial[STIFF_MEMBERS * 4], times[COUNT];
    nh_options options;
    nh_error error = {0};
    nh_options_default(&options);
    options.steps = 1e8;
    for (int i = 0; i < COUNT; i++) times[i] = until * i / (COUNT - 1);
    nh_ensemble_states(4, start, STIFF_MEMBERS, 0.1, 3, initial);
    nh_trajectory_request q = {.model = x.model, .count = COUNT, .times = times, .options = &options, .n = 2, .e = x.model->rho};
    nh_ensemble *e = nh_ensemble_accurate(&q, STIFF_MEMBERS, initial, threads, 1e-6, ways, a, &error);
    must(e != NULL, &error, "the ensemble");
    mechanics_clear(&x);
    return e;
}

/* Van der Pol's oscillator while it relaxes: in batches the pair of order 8 would take a hundred thousand steps for what BDF does in some hundred. */
Test(accuracy, members_of_a_stiff_ensemble_are_computed_alone, WHOLE_ONLY)
{
    static const char *const stiff = "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - (x^2 + y^2)/2\nforces: [\"x = 1000*(1 - x^2)*x'\"]\n";
    const double start[4] = {2, 0.5, 0, 0};
    nh_integration_plans pilot = {.pilot = true};
    nh_ensemble_accuracy a;
    nh_ensemble *e = stiff_ensemble(stiff, start, 100, 1, &pilot, &a);
    cr_expect(a.held && a.all_alone && a.alone == STIFF_MEMBERS && e->alone == STIFF_MEMBERS && e->incomplete == 0, "%s", a.why);
    cr_expect(a.way.method && (a.way.method == nh_method_find("CVODE BDF") || a.way.method == nh_method_find("ARKODE ESDIRK")) && strstr(a.why, "each alone by") && strstr(a.why, "in batches they would need"), "%s", a.why);
    cr_expect_lt(e->evaluations, 5000 * 1000, "%ld", e->evaluations); /* in batches more than a million steps of 13 */
    nh_ensemble_free(e);
    nh_integration_plan bdf = {nh_method_find("CVODE BDF"), NH_OWN_VELOCITIES, 1e-8, NAN, 1e-7, 1e6};
    nh_integration_plans given = {.count = 1, .way = &bdf}, *const ways[] = {&given, &pilot};
    for (int i = 0; i < 2; i++) {
        nh_ensemble *one = stiff_ensemble(stiff, start, 100, 1, ways[i], &a), *two = stiff_ensemble(stiff, start, 100, 2, ways[i], &a);
        cr_expect(a.all_alone && (i || a.choice == NH_CHOICE_GIVEN), "%s", a.why);
        cr_expect_eq(memcmp(one->value, two->value, STIFF_MEMBERS * COUNT * 2 * sizeof *one->value), 0);
        nh_ensemble_free(one);
        nh_ensemble_free(two);
    }
}

Test(accuracy, members_of_another_stay_in_batches)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/henon_heiles.yaml", .initial = "x=0.1, y'=0.2", .until_given = true, .accuracy = 1e-6, .ensemble = 300, .spread = 0.05};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, "henon_heiles");
    const nh_ensemble_accuracy *a = &s->accuracy_of_all;
    cr_expect(a->held && !a->all_alone && a->ratio > 1 && strstr(a->why, "in batches at") && strstr(a->why, "each alone (GSL rk8pd) would need"), "%s", a->why);
    nh_simulation_free(s);
}

Test(accuracy, an_ensemble_says_when_it_is_not)
{
    nh_error error = {0};
    nh_request q = {.system_path = "systems/sleigh.yaml", .initial = "omega=2", .until_given = true, .accuracy = 1e-17, .ensemble = 5, .spread = 0.1};
    nh_options_default(&q.options);
    nh_simulation *s = nh_simulation_create(&q, &error);
    must(s != NULL, &error, "sleigh");
    cr_expect(s->checked && !s->accuracy_of_all.held && s->accuracy_of_all.unsure == 5 && strstr(s->accuracy_of_all.why, "by 5 of 5 members"), "%s", s->accuracy_of_all.why);
    nh_simulation_free(s);
}
