/* Every integrator on motions with a closed form, their orders, what they conserve, and where they refuse. */
#include <stdio.h>

#include "base/linalg.h"
#include "graph/dag.h"
#include "mechanics.h"
#include "motion/method.h"
#include "motion/projection.h"

static const char *const pendulum =
    "name: test\ncoordinates: [{name: x, type: angle}, {name: y}]\n"
    "lagrangian: (1 + sin(y)^2/3)*x'^2/2 + y'^2/2 + cos(x) - y^2*(0.8 + cos(x)/4)\n";
static const char *const affine =
    "name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + y^2 + z^2)/2\nconstraints: [\"z' = y*x' + 0.4\"]\n";
static const char *const rolling =
    "name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\n"
    "lagrangian: (x'^2 + y'^2 + z'^2)/2 - (x^2 + 1.7*y^2 + z^2)/2\nconstraints: [\"z' = y*x'\"]\n";

/* With y' = x' at the start both are cos t for ever, but everything beside that comes back with the rate 1e4. */
static const char *const stiff =
    "name: test\ncoordinates: [{name: x}, {name: y}]\nlagrangian: (x'^2 + y'^2)/2 - x^2/2\nforces: [\"y = -1e4*(y' - x') - x\"]\n";

static nh_motion *run_method(const nh_model *o, const nh_method *method, const double *z0, size_t count, const double *times, double tolerance, double step)
{
    nh_error error = {0};
    nh_flow_options how = {.rtol = tolerance, .step = step};
    nh_dynamics *d = nh_dynamics_create(o);
    nh_flow_problem problem = nh_dynamics_problem(d);
    nh_programs *programs = nh_programs_create(o);
    nh_motion *motion = method->order ? nh_method_steps(method, programs, z0, count, times, &how, &error)
                                      : nh_method_flow(method, &problem, z0, count, times, &how, &error);
    must(motion != NULL, &error, method->name);
    cr_assert(motion->complete && motion->count == count, "%s: %s", method->name, motion->note);
    cr_expect_gt(motion->evaluations, 10);
    nh_programs_free(programs);
    nh_dynamics_free(d);
    return motion;
}

/* omega, v, phi of the sleigh: z = omega0 t/k. */
static double sleigh_error(const nh_model *o, const nh_method *method, double tolerance, double step)
{
    enum { COUNT = 6 };
    double times[COUNT], z0[5] = {0, 0, 0, 2, 0}, worst = 0;
    for (int i = 0; i < COUNT; i++) times[i] = 0.83 * i;
    nh_motion *motion = run_method(o, method, z0, COUNT, times, tolerance, step);
    for (size_t i = 0; i < COUNT; i++) {
        const double *z = motion->state + 5 * i;
        double s = times[i];
        cr_expect_eq(motion->time[i], times[i]);
        worst = fmax(worst, fabs(z[0] - 4 * atan(tanh(s / 2))));
        worst = fmax(worst, fmax(fabs(z[3] - 2 / cosh(s)), fabs(z[4] - 4 * tanh(s))));
    }
    nh_motion_free(motion);
    return worst;
}

Test(method, every_one_with_error_control_meets_the_closed_form)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 0, NULL);
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *m = nh_method_at(i);
        if (m->order) continue;
        double loose = sleigh_error(x.model, m, 1e-5, 0), tight = sleigh_error(x.model, m, 1e-10, 0);
        cr_expect(tight < 3e-8 && tight < loose / 50, "%s: %g, %g", m->name, loose, tight);
        cr_expect_eq(nh_method_find(m->name), m);
    }
    cr_expect_null(nh_method_find("Euler"));
    mechanics_clear(&x);
}

/* At the edge of its stability a pair fails its error test many times in one step before the step is short enough. */
Test(method, pairs_go_on_where_the_error_test_fails_often)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - x^4/4 - z^2*(1 + x^2)/2 - 50*(y - sin(x))^2\n"
                                    "forces: [\"y = -60*(y' - x'*cos(x))\"]\n", NH_CHART_AUTO);
    nh_dynamics *d = nh_dynamics_create(x.model);
    nh_flow_problem problem = nh_dynamics_problem(d);
    const double start[6] = {1, 0, 0.5, 0, 0, 0.3}, times[2] = {0, 60};
    nh_error error = {0};
    nh_flow_options how = {.rtol = 1e-9};
    nh_motion *motion = nh_method_flow(nh_method_find("ARKODE Fehlberg"), &problem, start, 2, times, &how, &error);
    cr_assert_not_null(motion);
    cr_expect(motion->complete, "%s", motion->note);
    nh_motion_free(motion);
    nh_dynamics_free(d);
    mechanics_clear(&x);
}

Test(method, fixed_steps_have_their_order)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 0, NULL);
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *m = nh_method_at(i);
        if (!m->order) continue;
        double step = m->order > 4 ? 0.415 : 0.083; /* above rounding */
        double coarse = sleigh_error(x.model, m, 1e-8, step), fine = sleigh_error(x.model, m, 1e-8, step / 2), order = log2(coarse / fine);
        cr_expect(fabs(order - m->order) < (m->family == NH_METHOD_RELAXATION ? 1 : 0.3), "%s: errors %g, %g, order %.2f", m->name, coarse, fine, order);
    }
    mechanics_clear(&x);
}

/* Forward and back along the same steps: the implicit methods are symmetric. */
Test(method, implicit_steps_are_as_long_as_a_stiff_motion_is_smooth)
{
    enum { COUNT = 9 };
    static const char *const names[] = {"CVODE BDF", "ARKODE ESDIRK", "GSL rk8pd"};
    mechanics x = mechanics_of_text(stiff, NH_CHART_AUTO);
    const double start[4] = {1, 1, 0, 0};
    double times[COUNT];
    for (int i = 0; i < COUNT; i++) times[i] = 2.5 * i;
    for (int k = 0; k < 3; k++)
        for (double tolerance = 1e-4; tolerance > 1e-9; tolerance /= 100) {
            nh_motion *motion = run_method(x.model, nh_method_find(names[k]), start, COUNT, times, tolerance, 0);
            double worst = 0;
            for (size_t i = 0; i < COUNT; i++)
                for (size_t j = 0; j < 4; j++) worst = fmax(worst, fabs(motion->state[4 * i + j] - (j < 2 ? cos(times[i]) : -sin(times[i]))));
            cr_expect(worst < 200 * tolerance, "%s at %g: %g", names[k], tolerance, worst);
            cr_expect(k < 2 ? motion->evaluations < 6000 : motion->evaluations > 60000, "%s at %g: %ld", names[k], tolerance, motion->evaluations);
            nh_motion_free(motion);
        }
    mechanics_clear(&x);
}

Test(method, symmetric_steps_come_back)
{
    mechanics x = mechanics_of_text(rolling, NH_CHART_AUTO);
    const double start[5] = {0.4, -0.3, 0.2, 0.7, 0.5};
    double there[] = {0, 3.1}, back[] = {3.1, 0};
    for (size_t i = 0; i < nh_method_count(); i++) {
        const nh_method *m = nh_method_at(i);
        if (m->family != NH_METHOD_MIDPOINT) continue;
        nh_motion *a = run_method(x.model, m, start, 2, there, 0, 0.1), *b = run_method(x.model, m, a->state + 5, 2, back, 0, 0.1);
        for (size_t j = 0; j < 5; j++) cr_expect_float_eq(b->state[5 + j], start[j], 1e-11, "%s, %zu: %g", m->name, j, b->state[5 + j] - start[j]);
        nh_motion_free(a);
        nh_motion_free(b);
    }
    mechanics_clear(&x);
}

static double energy_drift(const nh_model *o, const nh_motion *motion)
{
    double worst = 0, first = 0, *point = nh_alloc_array(o->width, sizeof *point);
    for (size_t i = 0; i < motion->count; i++) {
        point[0] = motion->time[i];
        memcpy(point + 1, motion->state + i * motion->size, motion->size * sizeof *point);
        double e = value_at(o, o->E, point);
        if (i == 0) first = e;
        worst = fmax(worst, fabs(e - first));
    }
    nh_free(point);
    return worst;
}

Test(method, energy_is_kept_where_it_is_promised)
{
    const char *const texts[] = {pendulum, rolling};
    for (int k = 0; k < 2; k++) {
        mechanics x = mechanics_of_text(texts[k], NH_CHART_AUTO);
        const double start[5] = {0.4, -0.3, 0.2, 0.7, 0.5};
        double times[] = {0, 10, 20, 40};
        static const char *const keep[] = {"energy-preserving", "energy-preserving, order 4", "relaxation, order 4", "relaxation, order 8"};
        nh_motion *b = run_method(x.model, nh_method_find("midpoint"), start, 4, times, 0, 0.2);
        cr_expect_gt(energy_drift(x.model, b), 1e-6);
        nh_motion_free(b);
        for (size_t i = 0; i < sizeof keep / sizeof *keep; i++) {
            nh_motion *a = run_method(x.model, nh_method_find(keep[i]), start, 4, times, 0, 0.2);
            cr_expect(energy_drift(x.model, a) < 1e-11, "%s: %g", keep[i], energy_drift(x.model, a));
            nh_motion_free(a);
        }
        mechanics_clear(&x);
    }
}

/* The blade turns at a constant rate: in the pair the terms of its acceleration cancel up to rounding. */
Test(method, rounding_of_an_acceleration_that_vanishes_is_no_other_motion)
{
    static const char *const skate = "name: skate\ncoordinates: [x, y, {name: p, type: angle}]\nparameters: {m: 1.5, J: 0.2, k: 4}\n"
                                     "lagrangian: m/2*(x'^2 + y'^2) + J/2*p'^2 - k/2*x^2\nconstraints: [\"x'*sin(p) = y'*cos(p)\"]\n";
    mechanics x = mechanics_of_text(skate, NH_CHART_AUTO);
    nh_programs *programs = nh_programs_create(x.model);
    const char *refused = nh_method_refused(nh_method_find("energy-preserving"), programs);
    cr_expect_null(refused, "%s", refused);
    nh_programs_free(programs);
    mechanics_clear(&x);
}

Test(method, a_wrong_motion_is_refused)
{
    nh_error error = {0};
    mechanics x = mechanics_of_text(affine, NH_CHART_AUTO);
    const double start[5] = {0.4, -0.3, 0.2, 0.7, 0.5};
    double times[] = {0, 1};
    nh_flow_options how = {.rtol = 1e-6, .step = 0.1};
    nh_programs *programs = nh_programs_create(x.model);
    static const char *const wrong[] = {"energy-preserving", "energy-preserving, order 4", "relaxation, order 4", "relaxation, order 8"};
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        const nh_method *m = nh_method_find(wrong[i]);
        cr_expect_not_null(nh_method_refused(m, programs));
        cr_expect_null(nh_method_steps(m, programs, start, 2, times, &how, &error));
        cr_expect(strstr(error.what, i < 2 ? "it would converge to a different motion" : "constant energy would give a wrong motion"), "%s", error.what);
        nh_error_clear(&error);
    }
    cr_expect_null(nh_midpoint_refused(programs, NH_LAGRANGE_DALEMBERT));
    nh_programs_free(programs);
    mechanics_clear(&x);
}

/* Many runs, one compilation of each program. */
Test(method, programs_are_compiled_once)
{
    mechanics x = mechanics_of_text(rolling, NH_CHART_AUTO);
    const double start[5] = {0.4, -0.3, 0.2, 0.7, 0.5};
    double times[] = {0, 1};
    nh_error error = {0};
    nh_flow_options how = {.rtol = 1e-6, .step = 0.1};
    nh_programs *programs = nh_programs_create(x.model);
    for (size_t i = 0, runs = 3; runs; i++) {
        const nh_method *m = nh_method_at(i % nh_method_count());
        runs -= i % nh_method_count() == 0;
        nh_motion *motion = m->order ? nh_method_steps(m, programs, start, 2, times, &how, &error) : NULL;
        if (motion) cr_expect_lt(motion->evaluations, 3000);
        nh_motion_free(motion);
    }
    cr_expect_eq(nh_programs_compiled(programs), NH_PROGRAMS, "%zu", nh_programs_compiled(programs));
    nh_programs_free(programs);
    mechanics_clear(&x);
}

/* The discrete principle of affine constraints converges to the motion of the reduced equations. */
Test(method, lagrange_dalembert_of_affine_constraints)
{
    mechanics x = mechanics_of_text(affine, NH_CHART_AUTO);
    const double start[5] = {0.4, -0.3, 0.2, 0.7, 0.5};
    double times[] = {0, 2.3}, last = 0;
    nh_motion *exact = run_method(x.model, nh_method_find("GSL rk8pd"), start, 2, times, 1e-12, 0);
    for (double h = 0.1; h > 0.02; h /= 2) {
        nh_motion *a = run_method(x.model, nh_method_find("Lagrange-d'Alembert"), start, 2, times, 0, h);
        double worst = 0;
        for (size_t j = 0; j < 5; j++) worst = fmax(worst, fabs(a->state[5 + j] - exact->state[5 + j]));
        if (last > 0) cr_expect(fabs(log2(last / worst) - 2) < 0.2, "%g, %g", last, worst);
        last = worst;
        nh_motion_free(a);
    }
    nh_motion_free(exact);
    mechanics_clear(&x);
}

/* Energy, twice it and a multiple with an angular part: dependent rows do no harm. */
Test(method, projection_holds_dependent_currents)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 0, NULL);
    nh_model *o = x.model;
    nh_error error = {0};
    nh_ex current[] = {o->E, nh_mul(o->dag, nh_int(o->dag, 2), o->E), formula(o, "v*sin(phi/k) + a*k*omega*cos(phi/k)"), formula(o, "v*cos(phi/k) - a*k*omega*sin(phi/k)")};
    double z0[5] = {0.3, 0, 0, 2, 0.6}, times[] = {0, 5}, drift[2];
    for (int with = 0; with < 2; with++) {
        nh_dynamics *d = nh_dynamics_create(o);
        nh_projection *p = nh_projection_create(o, 4, current, 0, 5, z0);
        nh_flow_problem problem = nh_dynamics_problem(d);
        nh_flow_options how = {.rtol = 1e-5, .after = with ? nh_projection_apply : NULL, .after_context = p};
        nh_motion *motion = nh_gsl_odeiv(NH_RKF45, &problem, z0, 2, times, &how, &error);
        cr_assert(motion && motion->complete);
        drift[with] = energy_drift(o, motion);
        if (with) {
            double at[2], point[6] = {0}, end[6] = {5};
            memcpy(point + 1, z0, sizeof z0);
            memcpy(end + 1, motion->state + 5, 5 * sizeof *end);
            at[0] = value_at(o, current[2], point), at[1] = value_at(o, current[2], end);
            cr_expect_float_eq(at[0], at[1], 1e-12, "%g", at[1] - at[0]);
            cr_expect_float_eq(motion->state[5 + 3], 2 / cosh(5.0) , 0.5); /* the same motion */
            cr_expect_gt(nh_projection_evaluations(p), 5);
        }
        nh_motion_free(motion);
        nh_projection_free(p);
        nh_dynamics_free(d);
    }
    cr_expect(drift[0] > 1e-8 && drift[1] < 1e-12, "%g, %g", drift[0], drift[1]);
    mechanics_clear(&x);
}

/* Functions of others are not projected onto, nor what has no gradient of its own where the motion starts; each is told which. */
Test(method, projection_chooses_independent_currents)
{
    mechanics x = mechanics_of_file("systems/sleigh.yaml", NH_CHART_QUASI, 0, NULL);
    nh_model *o = x.model;
    nh_ex a = formula(o, "v*sin(phi/k) + a*k*omega*cos(phi/k)"), b = formula(o, "v*cos(phi/k) - a*k*omega*sin(phi/k)");
    nh_ex current[] = {o->E, nh_mul(o->dag, nh_int(o->dag, 2), o->E), a, b};
    const double generic[5] = {0.3, 0, 0, 2, 0.6}, turning[5] = {0, 0, 0, 2, 0}, *start[] = {generic, turning};
    static const char *const says[2][4] = {{NULL, "depends on the currents before", NULL, "depends on the currents before"}, {NULL, "depends on the currents before", "initial state", NULL}};
    for (int i = 0; i < 2; i++) {
        const char *why[4];
        cr_expect_eq(nh_projection_choose(o, 4, current, 0, 5, start[i], why), 2);
        for (int k = 0; k < 4; k++) cr_expect(says[i][k] ? why[k] && strstr(why[k], says[i][k]) : !why[k], "%d, %d: %s", i, k, why[k] ? why[k] : "chosen");
    }
    mechanics_clear(&x);
}

/* Many output times change the motion of a one-step method only where steps end there. */
Test(method, outputs_do_not_change_the_motion)
{
    enum { COUNT = 201 };
    mechanics x = mechanics_of_text(pendulum, NH_CHART_AUTO);
    const double start[4] = {1.1, -0.3, 0.2, 0.7};
    double times[COUNT], two[] = {0, 20};
    for (int i = 0; i < COUNT; i++) times[i] = 0.1 * i;
    two[1] = times[COUNT - 1];
    const nh_method *m = nh_method_find("GSL rk8pd");
    nh_motion *many = run_method(x.model, m, start, COUNT, times, 1e-9, 0), *few = run_method(x.model, m, start, 2, two, 1e-9, 0);
    cr_expect_eq(many->steps, few->steps);
    for (size_t j = 0; j < 4; j++) cr_expect_float_eq(many->state[(COUNT - 1) * 4 + j], few->state[4 + j], 1e-12);
    nh_motion *exact = run_method(x.model, m, start, COUNT, times, 1e-13, 0);
    for (size_t i = 0; i < COUNT * 4; i++) cr_expect_float_eq(many->state[i], exact->state[i], 1e-5);
    nh_motion_free(many);
    nh_motion_free(few);
    nh_motion_free(exact);
    mechanics_clear(&x);
}

/* x'' = -x from (0, 1): the guard x - 0.5 changes its sign at pi/6, 5 pi/6, ... */
static bool half(double t, const double *z, double *value, void *context)
{
    (void)t, (void)context;
    value[0] = 2;
    value[1] = z[0] - 0.5;
    return true;
}

static bool circle(double t, const double *z, double *rate, void *context)
{
    (void)t, (void)context;
    rate[0] = z[1];
    rate[1] = -z[0];
    return true;
}

/* Every method with error control stops at a guard on request, with all outputs before it, and at a state that is as good as the others. */
Test(method, guards)
{
    enum { count = 41 };
    double times[count], z[2] = {0, 1};
    for (size_t i = 0; i < count; i++) times[i] = 0.05 * (double)i;
    nh_flow_problem problem = {.size = 2, .rate = circle, .guards = 2, .guard = half};
    for (size_t k = 0; k < nh_method_count(); k++) {
        const nh_method *method = nh_method_at(k);
        nh_error error = {0};
        nh_flow_options options = {.rtol = 1e-11, .guarded = true};
        if (method->order) continue;
        nh_motion *motion = nh_method_flow(method, &problem, z, count, times, &options, &error);
        cr_assert(motion != NULL, "%s: %s", method->name, error.what);
        cr_expect(!motion->complete && motion->guard_hit == 1, "%s: guard %ld", method->name, motion->guard_hit);
        cr_expect_float_eq(motion->end_time, M_PI / 6, 1e-6, "%s: %.12g", method->name, motion->end_time);
        cr_expect_float_eq(motion->end_state[0], sin(motion->end_time), 1e-8, "%s: %g", method->name, motion->end_state[0] - sin(motion->end_time));
        cr_expect_eq(motion->count, 11, "%s: %zu outputs", method->name, motion->count);
        for (size_t i = 0; i < motion->count; i++) cr_expect_float_eq(motion->state[2 * i], sin(times[i]), 1e-8, "%s", method->name);
        nh_motion_free(motion);
        if (method->family == NH_METHOD_CVODE) continue;
        options.guarded = false;
        motion = nh_method_flow(method, &problem, z, count, times, &options, &error);
        cr_expect(motion && motion->complete, "%s goes on without", method->name);
        nh_motion_free(motion);
    }
}
