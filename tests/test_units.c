/* Units of length, mass and time change no digit of a motion: methods with fixed steps, projections, what is refused, and what is compared. */
#include <float.h>
#include <stdio.h>

#include "mechanics.h"
#include "motion/validation.h"
#include "motion/method.h"
#include "motion/projection.h"

enum { OUTPUTS = 6 };
static const char *const fixed[] = {"midpoint", "midpoint, order 4", "Lagrange-d'Alembert", "energy-preserving", "relaxation, order 4", "relaxation, order 8"};

typedef struct {
    double length, mass, time;
} units;
static const units all_units[] = {{1e-9, 1, 1}, {1e9, 1, 1}, {1, 1e-9, 1}, {1, 1e9, 1}, {1, 1, 1e-9}, {1, 1, 1e9}};
enum { UNITS = sizeof all_units / sizeof *all_units };

/* An oscillator with a cubic force; three of them with a rolling constraint; in the given units. */
static void write_spring(const units *u, char *out, size_t size)
{
    double k = u->mass / u->time / u->time;
    snprintf(out, size, "name: test\ncoordinates: [{name: x}]\nlagrangian: %.17g*x'^2/2 - %.17g*x^2/2 - %.17g*x^4/4\n", u->mass, k, k / u->length / u->length);
}

static void write_rolling(const units *u, char *out, size_t size)
{
    double k = u->mass / u->time / u->time;
    snprintf(out, size, "name: test\ncoordinates: [{name: x}, {name: y}, {name: z}]\nlagrangian: %.17g*(x'^2 + y'^2 + z'^2)/2 - %.17g*(x^2 + 1.7*y^2 + z^2)/2\nconstraints: [\"z' = y*x'/%.17g\"]\n"
                        "velocities: {names: [u, w], map: [\"x' = u\", \"y' = w\", \"z' = y*u/%.17g\"]}\n"
                        "domain: {x: [-%.17g, %.17g], y: [-%.17g, %.17g], z: [-%.17g, %.17g], u: [-%.17g, %.17g], w: [-%.17g, %.17g]}\n",
             u->mass, k, u->length, u->length, u->length, u->length, u->length, u->length, u->length, u->length, u->length / u->time, u->length / u->time, u->length / u->time, u->length / u->time);
}

typedef struct {
    void (*write)(const units *u, char *out, size_t size);
    size_t m, n;
    double z0[5];
} mechanism;
static const mechanism mechanisms[] = {{write_spring, 1, 1, {0.9, 0.3}}, {write_rolling, 3, 2, {0.4, 0.7, -0.2, 0.5, -0.6}}};

static mechanics in_units(const mechanism *c, const units *u, double *z0, double *times)
{
    char text[1000];
    c->write(u, text, sizeof text);
    for (size_t i = 0; i < c->m + c->n; i++) z0[i] = c->z0[i] * u->length / (i < c->m ? 1 : u->time);
    for (int i = 0; i < OUTPUTS; i++) times[i] = i * u->time;
    return mechanics_of_text(text, c->n < c->m ? NH_CHART_QUASI : NH_CHART_COORDINATES);
}

/* States at the outputs in units of their own; evaluations. */
static long fixed_steps(const mechanism *c, const units *u, const nh_method *method, double *out)
{
    double z0[5], times[OUTPUTS];
    nh_error error = {0};
    mechanics x = in_units(c, u, z0, times);
    nh_flow_options how = {.step = 0.1 * u->time};
    nh_programs *programs = nh_programs_create(x.model);
    nh_motion *motion = nh_method_steps(method, programs, z0, OUTPUTS, times, &how, &error);
    must(motion != NULL, &error, method->name);
    cr_assert(motion->complete, "%s: %s", method->name, motion->note);
    size_t size = c->m + c->n;
    for (size_t i = 0; i < OUTPUTS * size; i++) out[i] = motion->state[i] / u->length * (i % size < c->m ? 1 : u->time);
    long evaluations = motion->evaluations;
    nh_motion_free(motion);
    nh_programs_free(programs);
    mechanics_clear(&x);
    return evaluations;
}

Test(units, fixed_steps_know_none)
{
    for (size_t c = 0; c < sizeof mechanisms / sizeof *mechanisms; c++)
        for (size_t k = 0; k < sizeof fixed / sizeof *fixed; k++) {
            const nh_method *method = nh_method_find(fixed[k]);
            double one[5 * OUTPUTS], other[5 * OUTPUTS];
            long usual = fixed_steps(&mechanisms[c], &(units){1, 1, 1}, method, one);
            for (size_t i = 0; i < UNITS; i++) {
                const units *u = &all_units[i];
                double worst = 0;
                long evaluations = fixed_steps(&mechanisms[c], u, method, other);
                for (size_t j = 0; j < OUTPUTS * (mechanisms[c].m + mechanisms[c].n); j++) worst = fmax(worst, fabs(other[j] - one[j]));
                cr_expect_lt(worst, 1e-12, "%s, mechanism %zu, units %g, %g, %g: %g", method->name, c, u->length, u->mass, u->time, worst);
                cr_expect(evaluations <= 2 * usual && usual <= 2 * evaluations, "%s, units %g, %g, %g: %ld, %ld", method->name, u->length, u->mass, u->time, evaluations, usual);
            }
        }
}

/* What is not the motion, or does not keep the energy, is refused in every unit. */
Test(units, refusals_know_none)
{
    for (size_t i = 0; i < UNITS; i++) {
        const units *u = &all_units[i];
        char text[1000];
        double k = u->mass / u->time / u->time;
        snprintf(text, sizeof text, "name: test\ncoordinates: [{name: x}]\nlagrangian: %.17g*x'^2/2 - %.17g*x^2/2\nforces: [\"x = -%.17g*x'/10\"]\ndomain: {x: [%.17g, %.17g], \"x'\": [%.17g, %.17g]}\n", u->mass, k, u->mass / u->time,
                 -u->length, u->length, -u->length / u->time, u->length / u->time);
        mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
        nh_programs *programs = nh_programs_create(x.model);
        cr_expect(nh_method_refused(nh_method_find("relaxation, order 4"), programs), "units %g, %g, %g", u->length, u->mass, u->time);
        cr_expect(nh_method_refused(nh_method_find("energy-preserving"), programs), "units %g, %g, %g", u->length, u->mass, u->time);
        nh_programs_free(programs);
        mechanics_clear(&x);
    }
}

/* A state off the energy is brought back by the same change of its parts. */
Test(units, projections_know_none)
{
    for (size_t c = 0; c < sizeof mechanisms / sizeof *mechanisms; c++) {
        size_t size = mechanisms[c].m + mechanisms[c].n;
        double one[5];
        for (size_t i = 0; i <= UNITS; i++) {
            const units *u = i ? &all_units[i - 1] : &(units){1, 1, 1};
            double z0[5], times[OUTPUTS], z[5];
            mechanics x = in_units(&mechanisms[c], u, z0, times);
            nh_projection *p = nh_projection_create(x.model, 1, &x.model->E, 0, times[OUTPUTS - 1], z0);
            for (size_t j = 0; j < size; j++) z[j] = z0[j] * (1 + 1e-3 * (double)(j + 1));
            cr_assert(nh_projection_apply(0, z, p));
            for (size_t j = 0; j < size; j++) {
                double part = z[j] / z0[j];
                if (i == 0) one[j] = part;
                cr_expect_float_eq(part, one[j], 1e-12, "state %zu, units %g, %g, %g: %g", j, u->length, u->mass, u->time, part - one[j]);
            }
            nh_projection_free(p);
            mechanics_clear(&x);
        }
    }
}

/* ---- what is compared ---- */

/* A vertical disk with a weight off its centre: the place of the contact matters to nothing else. */
static void write_disk(const units *u, char *out, size_t size)
{
    double r = u->length, I = u->mass * r * r, e = I / u->time / u->time;
    snprintf(out, size, "name: test\ncoordinates: [{name: x}, {name: y}, {name: phi, type: angle}, {name: psi, type: angle}]\n"
                        "lagrangian: %.17g*(x'^2 + y'^2)/2 + %.17g*psi'^2/4 + %.17g*phi'^2/8 + %.17g*cos(psi)\nconstraints: [\"x' = %.17g*cos(phi)*psi'\", \"y' = %.17g*sin(phi)*psi'\"]\n"
                        "chart: {velocities: [w, p], map: [\"x' = %.17g*cos(phi)*p\", \"y' = %.17g*sin(phi)*p\", \"phi' = w\", \"psi' = p\"]}\n"
                        "domain: {x: [-%.17g, %.17g], y: [-%.17g, %.17g], w: [-%.17g, %.17g], p: [-%.17g, %.17g]}\n",
             u->mass, I, I, e, r, r, r, r, r, r, r, r, 1 / u->time, 1 / u->time, 1 / u->time, 1 / u->time);
}

/* How far the multiplier form, and the smallest model for phi' and psi, are off. */
static void differences(const units *u, double *out)
{
    char text[1500];
    write_disk(u, text, sizeof text);
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    nh_error error = {0};
    nh_options options;
    nh_options_default(&options);
    double q[4] = {0, 0, 0.3, 1.2}, v[4] = {0, 0, 0.7 / u->time, 1.3 / u->time};
    bool given[4] = {false, false, true, true};
    nh_state initial = {.q = q, .v = v, .given = given};
    nh_observable watch[2] = {{"turning", x.model->rho[2], true, false}, {"height", formula(x.model, "cos(psi)*psi'"), true, false}};
    nh_validation_request request = {.model = x.model, .currents = 1, .current = &x.model->E, .watches = 2, .watch = watch, .initial = &initial, .until = 9 * u->time, .outputs = 31, .options = &options};
    nh_validation *r = nh_validate(&request, &error);
    must(r != NULL, &error, "the disk");
    cr_assert(r->complete && r->multiplier_form && r->scene, "%s", r->note);
    memcpy(out, (double[]){r->state_difference, r->multiplier_difference, r->violation, r->scene_difference, r->current[0].drift[0]}, 5 * sizeof *out);
    nh_validation_free(r);
    mechanics_clear(&x);
}

Test(units, comparisons_know_none)
{
    static const char *const what[] = {"states", "multipliers", "constraints", "scene", "energy"};
    double one[5], other[5];
    differences(&(units){1, 1, 1}, one);
    for (size_t i = 0; i < UNITS; i++) {
        const units *u = &all_units[i];
        differences(u, other);
        for (int k = 0; k < 5; k++)
            cr_expect(other[k] <= 2 * one[k] && one[k] <= 2 * other[k], "%s, units %g, %g, %g: %g, %g", what[k], u->length, u->mass, u->time, other[k], one[k]);
    }
}

/* z' from a cubic equation that has no unit: for slow velocities to as many digits as for others. */
Test(units, implicit_velocities_know_none)
{
    mechanics x = mechanics_of_text("name: test\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2\nconstraints: [\"z'^3 + z'*(x'^2 + y'^2) = x'*y'^2\"]\n", NH_CHART_AUTO);
    const nh_chart *c = x.model->chart;
    size_t width = c->width;
    cr_assert_eq(c->implicit, 1);
    double *z = nh_alloc_array(2 * width, sizeof *z), *slow = z + width;
    for (int power = -15; power <= 15; power += 3) {
        for (size_t j = 0; j < width; j++) z[j] = slow[j] = 0.3 + 0.1 * (double)j;
        for (size_t j = 1 + x.model->m; j < width; j++) slow[j] *= pow(10, power);
        cr_assert(nh_chart_complete(c, z) && nh_chart_complete(c, slow), "1e%d", power);
        cr_expect_float_eq(slow[width - 1] / pow(10, power), z[width - 1], 1e-14, "1e%d: %g", power, slow[width - 1] / pow(10, power) / z[width - 1] - 1);
    }
    nh_free(z);
    mechanics_clear(&x);
}
