/* Motions across kinks and jumps of their equations: steps end there, so that what is conserved drifts by what the tolerance lets expect, with every method that controls its error. */
#include <criterion/criterion.h>

#include <stdio.h>

#include "mechanics.h"
#include "sweep.h"
#include "motion/dynamics.h"
#include "motion/ensemble.h"
#include "motion/method.h"
#include "motion/trajectory.h"
#include "system/sample.h"

typedef struct {
    const char *text, *current[3]; /* continuous and conserved */
    bool cancels;                  /* as it is written, without simplification, it has no digits near the kink: not in all coordinates */
} piecewise;

static const piecewise CASES[] = {
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - abs(x)\n", .current = {"x'^2/2 + abs(x)"}},
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - 40*abs(x)\n", .current = {"x'^2/2 + 40*abs(x)"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt((x - y)^2)\n", .current = {"x' + y'", "(x'^2 + y'^2)/2 + abs(x - y)"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - sqrt(x^2 - 2*x*y + y^2)\n", .current = {"x' + y'", "(x'^2 + y'^2)/2 + abs(x - y)"}, .cancels = true},
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - x*abs(t - 2)\n", .current = {"x' + (t - 2)*abs(t - 2)/2", "x - (t - 2)*x' - abs(t - 2)^3/3"}},
    {.text = "parameters: [{name: c, value: 1.3}]\ncoordinates: [x]\nlagrangian: x'^2/2 - x*sqrt((t - c)^2)\n", .current = {"x' + (t - c)*abs(t - c)/2"}},
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - x*sign(t)\n", .current = {"x' + abs(t)", "x - t*x' - t*abs(t)/2"}},
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - acos(cos(x))\n", .current = {"x'^2/2 + acos(cos(x))"}, .cancels = true},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x) - abs(y)\n", .current = {"x'^2/2 + abs(x)", "y'^2/2 + abs(y)"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x - y) - abs(x + y)\n", .current = {"(x' + y')^2/4 + abs(x + y)", "(x' - y')^2/4 + abs(x - y)"}},
    {.text = "coordinates: [x]\nlagrangian: x'^2/2 - 4*abs(sin(x))\n", .current = {"x'^2/2 + 4*abs(sin(x))"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + abs(x')/4 - y\n", .current = {"x' + sign(x')/4", "y' + t"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 + abs(x)*y'\n", .current = {"y' + abs(x)", "x'^2 + y'^2"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2\nconstraints: [\"y' = abs(x)*x'\"]\n", .current = {"y - x*abs(x)/2", "x'^2 + y'^2"}},
    {.text = "coordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - abs(x - sin(y))\n", .current = {"(x'^2 + y'^2)/2 + abs(x - sin(y))"}},
};
enum { COUNT = sizeof CASES / sizeof *CASES, STARTS = 2, OUTPUTS = 17 };
static const double BEGIN = -1, END = 7;

static mechanics system_of(size_t i)
{
    char text[400];
    snprintf(text, sizeof text, "name: test\n%s", CASES[i].text);
    return mechanics_of_text(text, NH_CHART_AUTO);
}

/* The largest change along a motion, relative to 1 + |value|: all sizes are about 1. */
static double drift_of(size_t count, size_t n, const double *value)
{
    double worst = count == OUTPUTS ? 0 : INFINITY;
    for (size_t i = 1; i < count; i++)
        for (size_t k = 0; k < n; k++) worst = fmax(worst, fabs(value[i * n + k] - value[k]) / (1 + fabs(value[k])));
    return worst;
}

static size_t currents_of(const mechanics *x, size_t i, nh_ex *e)
{
    size_t n = 0;
    for (; n < 3 && CASES[i].current[n]; n++) e[n] = formula(x->model, CASES[i].current[n]);
    return n;
}

static void random_state(const nh_model *o, uint64_t *seed, double *z)
{
    for (size_t j = 0; j < o->m + o->n; j++) z[j] = 3 * nh_random(seed) - 1.5;
}

/* In the velocities of the chart, or in all coordinates. */
static double drift_by(nh_dynamics *d, const nh_method *method, bool everywhere, const double *z0, double tolerance, size_t n, const nh_ex *e)
{
    double times[OUTPUTS], value[3 * OUTPUTS], y0[2 * 8];
    nh_error error = {0};
    size_t m = nh_dynamics_model(d)->m;
    cr_assert(m <= 8 && nh_dynamics_velocities(d, BEGIN, z0, y0 + m));
    memcpy(y0, z0, m * sizeof *y0);
    for (size_t i = 0; i < OUTPUTS; i++) times[i] = BEGIN + (END - BEGIN) * (double)i / (OUTPUTS - 1);
    nh_flow_options options = {.rtol = tolerance, .absolute = 1e-3, .max_steps = 1e5};
    nh_flow_problem problem = nh_dynamics_problem(d);
    nh_motion *motion = everywhere ? nh_motion_everywhere(d, method, y0, OUTPUTS, times, &options, NULL, NULL, &error) : nh_method_flow(method, &problem, z0, OUTPUTS, times, &options, &error);
    must(motion != NULL, &error, method->name);
    cr_expect(nh_along(d, motion, n, e, value));
    double drift = drift_of(motion->count, n, value);
    cr_expect(motion->complete, "%s at %g: %s", method->name, tolerance, motion->note);
    nh_motion_free(motion);
    return drift;
}

Test(kinks, drifts_fall_with_the_tolerance)
{
    static const double tolerance[] = {1e-5, 1e-8, 1e-11}, allowed = 1e4;
    for (size_t i = 0; i < COUNT; i++) {
        if (!sweep_tries(i, 2, 8)) continue;
        mechanics x = system_of(i);
        nh_ex e[3];
        size_t n = currents_of(&x, i, e);
        nh_dynamics *d = nh_dynamics_create(x.model);
        double z[16];
        uint64_t seed = 11;
        for (int k = 0; k < STARTS; k++) {
            random_state(x.model, &seed, z);
            for (size_t a = 0; a < nh_method_count(); a++)
                for (size_t t = 0; t < (CASES[i].cancels ? 3 : 6) && nh_method_at(a)->order == 0; t++) {
                    double drift = drift_by(d, nh_method_at(a), t >= 3, z, tolerance[t % 3], n, e);
                    cr_expect(drift < allowed * tolerance[t % 3], "%s, start %d, %s%s at %g: %.1e", CASES[i].text, k, nh_method_at(a)->name, t >= 3 ? ", all coordinates" : "", tolerance[t % 3], drift);
                }
        }
        nh_dynamics_free(d);
        mechanics_clear(&x);
    }
}

/* Members of ensembles, too, and what the smallest model for what is watched leaves of a system. */
Test(kinks, ensembles_and_scenes)
{
    enum { MEMBERS = 5 };
    double times[OUTPUTS];
    for (size_t i = 0; i < OUTPUTS; i++) times[i] = BEGIN + (END - BEGIN) * (double)i / (OUTPUTS - 1);
    for (size_t i = 0; i < COUNT; i++) {
        if (!sweep_tries(i + 1, 3, 8)) continue;
        mechanics x = system_of(i);
        nh_ex e[3];
        nh_error error = {0};
        nh_options options;
        nh_options_default(&options);
        uint64_t seed = 3;
        size_t n = currents_of(&x, i, e), size = x.model->m + x.model->n;
        double z[16 * MEMBERS];
        for (size_t k = 0; k < MEMBERS; k++) random_state(x.model, &seed, z + k * size);
        nh_trajectory_request q = {.model = x.model, .count = OUTPUTS, .times = times, .options = &options, .n = n, .e = e};
        q.initial = &(nh_state){.t = BEGIN, .q = z, .v = z + x.model->m};
        nh_ensemble *all = nh_ensemble_create(&q, MEMBERS, z, 2, &error);
        must(all != NULL, &error, CASES[i].text);
        for (size_t k = 0; k < MEMBERS; k++) {
            double drift = drift_of(OUTPUTS, n, all->value + k * OUTPUTS * n);
            cr_expect(drift < 1e-6, "%s: member %zu drifts by %.1e", CASES[i].text, k, drift);
        }
        nh_ensemble_free(all);
        mechanics_clear(&x);
    }
}

/* Dry friction holds a body fast: no velocity solves the equations from then on.  The motion ends, and says why. */
Test(kinks, a_motion_that_is_held_ends)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [x]\nlagrangian: x'^2/2 - x/10\nforces: [x = -sign(x')]\n", NH_CHART_AUTO);
    nh_dynamics *d = nh_dynamics_create(x.model);
    nh_flow_problem problem = nh_dynamics_problem(d);
    const double z[] = {0, 1}, times[] = {0, 1, 5};
    for (size_t a = 0; a < nh_method_count(); a++) {
        nh_error error = {0};
        nh_flow_options options = {.rtol = 1e-6, .absolute = 1e-3, .max_steps = 1e6};
        if (nh_method_at(a)->order || !sweep_tries(a, 2, 6)) continue;
        nh_motion *motion = nh_method_flow(nh_method_at(a), &problem, z, 3, times, &options, &error);
        must(motion != NULL, &error, nh_method_at(a)->name);
        cr_expect(!motion->complete && strstr(motion->note, "both sides lead back"), "%s: %s", nh_method_at(a)->name, motion->note);
        cr_expect_float_eq(motion->end_time, 1 / 1.1, 1e-5, "%s: t = %g", nh_method_at(a)->name, motion->end_time);
        cr_expect_float_eq(motion->end_state[0], 1 / 2.2, 1e-5, "%s: x = %g", nh_method_at(a)->name, motion->end_state[0]);
        nh_motion_free(motion);
    }
    nh_dynamics_free(d);
    mechanics_clear(&x);
}

/* What crosses a wall for a multistep method is a short motion by another one: it knows the length of the whole, and sees as soon that it is held. */
Test(kinks, a_multistep_method_is_held_as_soon_as_others)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [x, y]\nlagrangian: (x'^2 + y'^2)/2 - 2*abs(x*y' - y*x')\n", NH_CHART_AUTO);
    nh_dynamics *d = nh_dynamics_create(x.model);
    nh_flow_problem problem = nh_dynamics_problem(d);
    const double z[] = {-0.0928, -0.14235, -0.255, -0.9677}, times[] = {0, 1, 10};
    for (int a = 0; a < 2; a++) {
        nh_error error = {0};
        nh_flow_options options = {.rtol = 1e-10, .absolute = 1e-3, .max_steps = 1e5};
        const char *name = a ? "bdf" : "adams";
        nh_motion *motion = nh_method_flow(nh_method_find(name), &problem, z, 3, times, &options, &error);
        must(motion != NULL, &error, name);
        cr_expect(!motion->complete && strstr(motion->note, "both sides lead back"), "%s: %s", name, motion->note);
        cr_expect_lt(motion->evaluations, 20000, "%s: %zu evaluations", name, (size_t)motion->evaluations);
        nh_motion_free(motion);
    }
    nh_dynamics_free(d);
    mechanics_clear(&x);
}
