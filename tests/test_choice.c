/* From what --accuracy chooses, by what, and that this depends on nothing but the question: not on the load, and on nothing that an earlier run left. */
#include "base/effort.h"
#include "mechanics.h"
#include "motion/accuracy.h"
#include "program.h"
#include "sweep.h"
#include "commands/reduce.h"

/* ---- what is chosen ---- */

static nh_integration_plan run_of(const char *method, nh_velocities velocities, double setting, double error, double effort)
{
    const nh_method *m = nh_method_find(method);
    cr_assert_not_null(m, "%s", method);
    return (nh_integration_plan){m, velocities, m->order ? NAN : setting, m->order ? setting : NAN, error, effort};
}

Test(choice, the_cheapest_counts_with_its_confirmation)
{
    nh_integration_plan w[] = {run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-8, 1e-9, 3),         run_of("CVODE Adams", NH_OWN_VELOCITIES, 1e-8, 1e-9, 2),
                  run_of("GSL rk8pd", NH_ALL_COORDINATES, 1e-8, 1e-9, 2.5),      run_of("relaxation, order 8", NH_OWN_VELOCITIES, 0.1, 1e-9, 1),
                  run_of("GSL rkf45", NH_OTHER_VELOCITIES, 1e-8, 1e-9, 1.2),     run_of("GSL rkf45", NH_OWN_VELOCITIES, 1e-4, 1e-5, 0.1)};
    size_t n = sizeof w / sizeof *w;
    nh_integration_plan_limits all = {.other = true, .spacing = 1}, plain = {.spacing = 1}, scene = {.scene = true, .other = true, .spacing = 1}, dense = {.spacing = 0.01};
    nh_integration_plan_choice c = nh_integration_plan_cheapest(n, w, 1e-8, &all);
    cr_expect(c.way == &w[4] && fabs(c.next - (2 * 1 + 2) / 2.4) < 1e-12, "%g", c.next); /* the relaxed steps with CVODE Adams to confirm them */
    c = nh_integration_plan_cheapest(n, w, 1e-8, &plain);
    cr_expect(c.way == &w[3] && c.second == w[1].method);
    c = nh_integration_plan_cheapest(n, w, 1e-8, &dense); /* steps end at the outputs: shorter ones than that were not measured */
    cr_expect(c.way == &w[2] && c.second == w[1].method, "%s", c.way->method->name);
    c = nh_integration_plan_cheapest(n, w, 1e-8, &scene);
    cr_expect(c.way == &w[0]); /* 6 against 4 + 3 */
    cr_expect(nh_integration_plan_cheapest(n, w, 1e-3, &scene).way == &w[5]);
    cr_expect(nh_integration_plan_cheapest(n, w, 1e-10, &all).way == NULL);
    cr_expect_float_eq(nh_integration_plan_setting(&w[3], 1e-9 / 256), 0.05, 1e-12);
    cr_expect_float_eq(nh_integration_plan_setting(&w[0], 1e-9), 1e-8, 1e-20);
}

static nh_trajectory *accurate(const mechanics *x, const nh_model *other, const nh_state *initial, size_t count, double until, double eps, size_t ways, const nh_integration_plan *way, nh_accuracy *a)
{
    nh_options options;
    nh_error error = {0};
    double *times = nh_alloc_array(count, sizeof *times);
    nh_options_default(&options);
    for (size_t i = 0; i < count; i++) times[i] = initial->t + until * (double)i / (double)(count - 1);
    nh_ex e[2] = {formula(x->model, "phi"), formula(x->model, "omega")};
    nh_trajectory_request q = {.model = x->model, .other = other, .initial = initial, .count = count, .times = times, .options = &options, .n = 2, .e = e};
    nh_integration_plans from = {.count = ways, .way = way};
    nh_trajectory *t = nh_trajectory_accurate(&q, eps, &from, a, &error);
    nh_free(times);
    return t;
}

/* The sleigh's closed form is met by every method in every equations, whatever was said of it. */
Test(choice, every_way_meets_the_closed_form)
{
    static const struct {
        const char *method, *formulation;
        nh_velocities velocities;
        double setting, error;
        size_t count;
    } ways[] = {{"GSL rkf45", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 1e-9, 1e-9, 7},
                {"GSL rk8pd", "in coordinate velocities", NH_OTHER_VELOCITIES, 1e-9, 1e-9, 7},
                {"CVODE Adams", "all coordinates", NH_ALL_COORDINATES, 1e-9, 1e-9, 7},
                {"CVODE BDF", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 1e-6, 5e-9, 51},
                {"relaxation, order 8", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 0.02, 1e-9, 7},
                {"relaxation, order 8", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 0.02, 1e-9, 61},  /* an output every 0.02: one step each, then two */
                {"relaxation, order 8", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 0.02, 1e-17, 7},  /* it was promised too much */
                {"Lagrange-d'Alembert, order 4", NH_ON_SUBMANIFOLD, NH_OWN_VELOCITIES, 0.02, 5e-9, 7}};
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_error error = {0};
    nh_model *other = nh_model_create(x.system, nh_chart_create(x.system, NH_CHART_COORDINATES, 1, &error), &error);
    double q[3] = {0}, v[3] = {2, 0, 0}, until = 1.2; /* before cos(phi) = 0, where the coordinate velocities end */
    nh_state initial = {.q = q, .v = v};
    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) {
        nh_integration_plan w = run_of(ways[i].method, ways[i].velocities, ways[i].setting, ways[i].error, 1e4);
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

/* Coordinate velocities that end on the way, and a way that is not so accurate: the motion comes out all the same. */
Test(choice, what_does_not_do_is_replaced)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    nh_error error = {0};
    nh_model *other = nh_model_create(x.system, nh_chart_create(x.system, NH_CHART_COORDINATES, 1, &error), &error);
    double q[3] = {0}, v[3] = {2, 0, 0};
    nh_state initial = {.q = q, .v = v};
    nh_integration_plan through = run_of("GSL rk8pd", NH_OTHER_VELOCITIES, 1e-9, 1e-9, 1e4), loose = run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-4, 1e-3, 1e4);
    nh_accuracy a;
    nh_trajectory *t = accurate(&x, other, &initial, 5, 6, 1e-8, 1, &through, &a);
    cr_assert(t && a.held, "%s", a.why);
    cr_expect_float_eq(t->value[2 * 4], 4 * atan(tanh(3)), 3.2e-8);
    cr_expect(!strcmp(t->formulation, NH_ON_SUBMANIFOLD), "%s", t->formulation);
    nh_trajectory_free(t);
    t = accurate(&x, other, &initial, 5, 6, 1e-8, 1, &loose, &a);
    cr_expect(t && a.held && !a.measured && a.choice == NH_CHOICE_RACE, "%s", a.why);
    nh_trajectory_free(t);
    nh_model_free(other);
    mechanics_clear(&x);
}

/* ---- pilot runs ---- */

/* Another way has to save three tenths beside what remains of the best so far; where that is done with its first run it goes on without being measured again. */
Test(choice, pilot_runs_change_only_what_pays)
{
    nh_pilot_runs v = {.count = 3, .way = {run_of("GSL rk8pd", NH_OWN_VELOCITIES, 1e-8, 1e-9, 3), run_of("ARKODE Verner", NH_OWN_VELOCITIES, 1e-8, 1e-9, 2.7), run_of("GSL rkf45", NH_OWN_VELOCITIES, 1e-8, 1e-7, 0.1)}};
    const nh_method *best = v.way[0].method;
    nh_integration_plan_limits limits = {.spacing = 1};
    nh_integration_plan_choice c = nh_pilot_runs_choose(&v, best, 1e-8, &limits, false);
    cr_expect(c.way == &v.way[0] && c.next == 1, "%g", c.next);
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-8, &limits, true).way == NULL);
    v.way[1].effort = 2;
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-8, &limits, false).way == &v.way[1]);
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-8, &limits, true).way == NULL); /* two runs of 2 against one of 3 */
    v.way[1].effort = 1;
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-8, &limits, true).way == &v.way[1]);
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-12, &limits, true).way == NULL);
    v.way[0].error = 1e-7; /* the best so far was not measured below eps: whatever was */
    cr_expect(nh_pilot_runs_choose(&v, best, 1e-8, &limits, true).way == &v.way[1]);
}

/* ---- counted work ---- */

/* The same runs of the same motion need the same, whatever else goes on; tighter ones more. */
Test(choice, work_is_counted)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_AUTO, 0, NULL);
    double q[3] = {0}, v[3] = {2, 0, 0}, times[3] = {0, 5, 10}, effort[2] = {0};
    nh_state initial = {.q = q, .v = v};
    for (size_t k = 0; k < nh_method_count(); k++)
        for (int i = 0; i < 4; i++) { /* twice each of two */
            nh_options options;
            nh_error error = {0};
            nh_options_default(&options);
            options.tolerance = i < 2 ? 1e-6 : 1e-9;
            nh_trajectory_request r = {.model = x.model, .initial = &initial, .count = 3, .times = times, .options = &options, .method = nh_method_at(k), .step = i < 2 ? 0.1 : 0.05};
            nh_trajectory *t = nh_trajectory_create(&r, &error);
            must(t != NULL, &error, nh_method_at(k)->name);
            cr_assert(t->motion->complete, "%s: %s", nh_method_at(k)->name, t->motion->note);
            if (i % 2) cr_expect_eq(t->motion->effort, effort[i / 2], "%s", nh_method_at(k)->name);
            effort[i / 2] = t->motion->effort;
            r.max_effort = t->motion->effort / 2; /* it ends there, at the same place */
            nh_trajectory_free(t);
            t = nh_trajectory_create(&r, &error);
            cr_expect(!t->motion->complete && strstr(t->motion->note, "counted operations") && t->motion->effort < 1.2 * r.max_effort + 1e5, "%s: %s", nh_method_at(k)->name, t->motion->note);
            nh_trajectory_free(t);
            if (i == 3) cr_expect(effort[0] > 1000 && effort[1] > effort[0], "%s: %g and %g", nh_method_at(k)->name, effort[0], effort[1]);
        }
    mechanics_clear(&x);
}

/* The full motion of a reduction, and every stage, say what they need. */
Test(choice, reductions_count_too, PLAIN_ONLY)
{
    double effort[2];
    for (int i = 0; i < 2; i++) {
        nh_error error = {0};
        nh_request q = {.system_path = "systems/sleigh.yaml", .accuracy = 1e-6};
        nh_options_default(&q.options);
        nh_reduction *r = nh_reduction_create(&q, &error);
        must(r != NULL, &error, "sleigh");
        cr_expect(r->full.held && r->full.effort > 1000, "%s", r->full.why);
        effort[i] = r->full.effort;
        for (size_t s = 0; s < r->stages; s++) {
            cr_expect(r->stage[s].choice.held && r->stage[s].agreement < 1e-6 && r->stage[s].choice.next && strstr(r->stage[s].choice.why, "counted work"), "%s", r->stage[s].choice.why);
            effort[i] += r->stage[s].choice.effort;
        }
        nh_reduction_free(r);
    }
    cr_expect_eq(effort[0], effort[1]);
}

/* ---- units ---- */

/* A disk of radius 0.8 that rolls and falls, with lengths in another unit. */
static const char *disk_in_units(double unit, char *out, size_t size)
{
    snprintf(out, size,
             "name: disk\nparameters: [{name: m, value: 1.3}, {name: A, value: %.17g}, {name: C, value: %.17g}, {name: r, value: %.17g}, {name: g, value: %.17g}]\n"
             "coordinates: [{name: x}, {name: y}, {name: p, type: angle}, {name: h, type: angle}, {name: s, type: angle}]\n"
             "lagrangian: A*(h'^2 + p'^2*sin(h)^2)/2 + C*(p'*cos(h) + s')^2/2 - g*m*r*sin(h) + m*(h'^2*r^2*cos(h)^2 + x'^2 + y'^2)/2\n"
             "constraints:\n  - \"-h'*r*sin(h)*sin(p) + p'*r*cos(h)*cos(p) + r*s'*cos(p) + x' = 0\"\n  - \"h'*r*sin(h)*cos(p) + p'*r*sin(p)*cos(h) + r*s'*sin(p) + y' = 0\"\n"
             "domain: {x: [%.17g, %.17g], y: [%.17g, %.17g], h: [0.8, 1.8]}\n",
             0.25 * unit * unit, 0.5 * unit * unit, 0.8 * unit, 0.9 * unit, -unit, unit, -unit, unit);
    return out;
}

/* The unit of length chooses neither the velocities nor the formulation. */
Test(choice, units_do_not_choose)
{
    static const double units[] = {1, 1e9, 1e-9, 1e3};
    char text[2000], chart[200] = "";
    double tilt = NAN;
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        mechanics x = mechanics_of_text(disk_in_units(units[i], text, sizeof text), NH_CHART_AUTO);
        double q[5] = {0, 0, 0, 1, 0}, v[5] = {0, 0, 0.5, 0, 1}, times[2] = {0, 3};
        bool given[5] = {false, false, true, true, true};
        nh_state initial = {.q = q, .v = v, .given = given};
        nh_options options;
        nh_error error = {0};
        nh_accuracy a;
        nh_options_default(&options);
        nh_ex e = formula(x.model, "h");
        nh_trajectory_request r = {.model = x.model, .initial = &initial, .count = 2, .times = times, .options = &options, .n = 1, .e = &e};
        nh_trajectory *t = nh_trajectory_accurate(&r, 1e-9, NULL, &a, &error);
        must(t != NULL, &error, "the disk");
        if (i == 0) snprintf(chart, sizeof chart, "%s", x.model->chart->name), tilt = t->value[1];
        cr_expect_str_eq(x.model->chart->name, chart);
        cr_expect(a.held && !strcmp(t->formulation, "equations of motion on the constraint submanifold"), "%g: %s; %s", units[i], t->formulation, a.why);
        cr_expect_float_eq(t->value[1], tilt, 2e-9, "%g: %.17g", units[i], t->value[1]);
        nh_trajectory_free(t);
        mechanics_clear(&x);
    }
}

/* ---- as a user sees it ---- */

/* A line of JSON that holds a time, or how the program was called. */
static bool of_the_clock(const char *line)
{
    static const char *const keys[] = {"seconds", "speedup", "command", "begun", "timing", "_s\":"};
    const char *end = strchr(line, '\n'), *colon = strchr(line, ':');
    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        const char *at = strstr(line, keys[i]);
        if (at && at < colon && (!end || at < end)) return true;
    }
    return false;
}

/* What is left of an answer without these lines (free it). */
static char *answer(const place *p, const char *line)
{
    finished f = run(p, line);
    cr_expect_eq(f.code, 0, "nhsym %s: %s", line, f.err);
    char *out = malloc(strlen(f.out) + strlen(f.err) + 1), *to = out;
    for (const char *from = f.out, *next; *from; from = next) {
        const char *end = strchr(from, '\n');
        next = end ? end + 1 : from + strlen(from);
        if (of_the_clock(from)) continue;
        memcpy(to, from, (size_t)(next - from));
        to += next - from;
    }
    strcpy(to, f.err);
    finished_clear(&f);
    return out;
}

enum { BUSY = 6 };

static void keep_busy(pid_t *child)
{
    for (int i = 0; i < BUSY; i++) {
        child[i] = fork();
        cr_assert_geq(child[i], 0);
        for (volatile unsigned n = 0; child[i] == 0; n++) continue;
    }
}

static void leave_off(const pid_t *child)
{
    for (int i = 0; i < BUSY; i++) {
        kill(child[i], SIGKILL);
        waitpid(child[i], NULL, 0);
    }
}

/* Every command that takes an accuracy says the same by itself and beside six busy loops, with one thread and with two, and leaves nothing for later runs. */
Test(choice, the_same_on_a_busy_machine, WHOLE_ONLY)
{
    static const char *const driven = "name: driven\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2/2\nforces: [\"x = -x'/2 + cos(t)\"]\n";
    static const char *const lines[] = {"simulate driven.yaml --initial x=1 --until 4000 --accuracy 1e-7 --step 1000 --option steps=1e8 --json -",
                                        "simulate sleigh --initial omega=2 --until 3 --accuracy 1e-8 --step 1 --json -",
                                        "simulate henon_heiles --initial x=0.1 --until 10 --ensemble 40 --spread 0.05 --accuracy 1e-6 --json -",
                                        "simulate sleigh --watch phi --accuracy 1e-9 --step 2 --json -",
                                        "analyze vertical_disk --accuracy 1e-7 --quiet --json -",
                                        "reduce vertical_disk --accuracy 1e-7 --quiet --json -"};
    enum { LINES = sizeof lines / sizeof *lines };
    place p = place_with_systems();
    pid_t child[BUSY];
    char *idle[LINES];
    write_here(&p, "driven.yaml", driven);
    setenv("HOME", p.folder, 1);
    for (size_t i = 0; i < LINES; i++) idle[i] = answer(&p, lines[i]);
    cr_expect(strstr(idle[0], "were measured on"), "%s", idle[0]);
    cr_expect(strstr(idle[1], "measuring other methods would need more"), "%s", idle[1]);
    keep_busy(child);
    for (size_t i = 0; i < LINES; i++) {
        char line[400];
        snprintf(line, sizeof line, "%s --threads 2", lines[i]);
        char *busy = answer(&p, line);
        size_t same = 0;
        while (idle[i][same] && idle[i][same] == busy[same]) same++;
        cr_expect(idle[i][same] == busy[same], "%s: \"%.200s\" and \"%.200s\"", lines[i], idle[i] + same, busy + same);
        free(busy);
        free(idle[i]);
    }
    leave_off(child);
    finished f = run_vector(&p, &(manner){0}, (char *[]){"ls", "-A", NULL});
    cr_expect_str_eq(f.out, "analyses\ndriven.yaml\nsystems\n");
    finished_clear(&f);
    place_clear(&p);
}

/* Other values of the parameters choose the same dependent velocities, so that formulas can be compared; where these would hardly do, others. */
Test(choice, set_parameters_keep_the_chart)
{
    static const double radius[] = {1, 8, 0.05, 20, 1e-12};
    nh_chart *chart[5];
    nh_system *system[5];
    for (int i = 0; i < 5; i++) {
        nh_error error = {0};
        nh_setting setting[] = {{.name = "r", .value = radius[i]}, {.name = "A", .value = 6}};
        system[i] = nh_system_read("systems/chaplygin_ball.yaml", 2, setting, &error);
        cr_assert_not_null(system[i], "%s", error.what);
        chart[i] = nh_chart_create(system[i], NH_CHART_COORDINATES, 1, &error);
        cr_assert_not_null(chart[i], "%s", error.what);
    }
    for (int i = 1; i < 4; i++)
        cr_expect_arr_eq(chart[i]->dependent, chart[0]->dependent, system[0]->constraints * sizeof *chart[0]->dependent, "r = %g", radius[i]);
    for (int i = 0; i < 5; i++) nh_chart_free(chart[i]), nh_system_free(system[i]);
}
