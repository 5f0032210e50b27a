/* reduce in any units: the group, the stages and how well motions agree do not depend on what masses and times are measured in, and what is said about a given group not on lengths. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "graph/terms.h"
#include "scratch.h"
#include "sweep.h"
#include "commands/reduce_internal.h"

/* Lengths, masses and times are multiplied by these. */
typedef struct {
    double length, mass, time;
} units;

typedef struct {
    const char *name, *group; /* the group as fields */
    void (*text)(const units *u, char *text, size_t size);
    void (*initial)(const units *u, char *text, size_t size);
} moving;

static const units one = {1, 1, 1};

/* The box of sample points: places, then velocities, of two lengths. */
static int box(const units *u, char *text, size_t size)
{
    double l = u->length, v = l / u->time, w = 1 / u->time;
    return snprintf(text, size, "domain: {x: [%.17g, %.17g], y: [%.17g, %.17g], x': [%.17g, %.17g], y': [%.17g, %.17g], h': [%.17g, %.17g]", -l, 1.3 * l, -0.9 * l, 1.1 * l, -v, v, -v, v, -w, w);
}

static void disk_text(const units *u, char *text, size_t size)
{
    double l = u->length, m = u->mass;
    int n = snprintf(text, size,
                     "name: disk\nparameters: [{name: m, value: %.17g}, {name: J, value: %.17g}, {name: K, value: %.17g}, {name: r, value: %.17g}]\n"
                     "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}, {name: p, type: angle}]\n"
                     "lagrangian: m/2*(x'^2 + y'^2) + J/2*h'^2 + K/2*p'^2\nconstraints: [\"x' = r*cos(p)*h'\", \"y' = r*sin(p)*h'\"]\n",
                     1.3 * m, 0.7 * m * l * l, 0.4 * m * l * l, 0.6 * l);
    n += box(u, text + n, size - (size_t)n);
    snprintf(text + n, size - (size_t)n, ", p': [%.17g, %.17g]}\n", -1 / u->time, 1 / u->time);
}
static void disk_initial(const units *u, char *text, size_t size)
{
    snprintf(text, size, "x=%.17g, y=%.17g, h=0.1, p=0.4, h'=%.17g, p'=%.17g", 0.3 * u->length, -0.2 * u->length, 0.9 / u->time, 0.7 / u->time);
}

static void sleigh_text(const units *u, char *text, size_t size)
{
    double l = u->length, m = u->mass;
    int n = snprintf(text, size,
                     "name: sleigh\nparameters: [{name: m, value: %.17g}, {name: J, value: %.17g}, {name: a, value: %.17g}]\n"
                     "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}]\n"
                     "lagrangian: m/2*(x'^2 + y'^2) + m*a*h'*(cos(h)*y' - sin(h)*x') + (J + m*a^2)/2*h'^2\nconstraints: [\"sin(h)*x' - cos(h)*y' = 0\"]\n",
                     1.3 * m, 0.7 * m * l * l, 0.6 * l);
    n += box(u, text + n, size - (size_t)n);
    snprintf(text + n, size - (size_t)n, "}\n");
}
static void sleigh_initial(const units *u, char *text, size_t size)
{
    snprintf(text, size, "x=%.17g, y=%.17g, h=0.4, x'=%.17g, h'=%.17g", 0.3 * u->length, -0.2 * u->length, 0.9 * u->length / u->time, 0.7 / u->time);
}

/* A planar body on a spring. */
static void body_text(const units *u, char *text, size_t size)
{
    double l = u->length, m = u->mass;
    int n = snprintf(text, size,
                     "name: body\nparameters: [{name: m, value: %.17g}, {name: J, value: %.17g}, {name: k, value: %.17g}]\n"
                     "coordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}]\nlagrangian: m/2*(x'^2 + y'^2) + J/2*h'^2 - k/2*(x^2 + y^2)\n",
                     1.3 * m, 0.7 * m * l * l, 0.5 * m / u->time / u->time);
    n += box(u, text + n, size - (size_t)n);
    snprintf(text + n, size - (size_t)n, "}\n");
}
static void body_initial(const units *u, char *text, size_t size)
{
    snprintf(text, size, "x=%.17g, y=%.17g, h=0.4, x'=%.17g, y'=%.17g, h'=%.17g", 0.3 * u->length, -0.2 * u->length, 0.9 * u->length / u->time, 0.4 * u->length / u->time, 0.7 / u->time);
}

static const moving all[] = {
    {"disk", "x=1; y=1; h=1; x=-y, y=x, p=1", disk_text, disk_initial},
    {"sleigh", "x=1; y=1; x=-y, y=x, h=1", sleigh_text, sleigh_initial},
    {"body", "x=-y, y=x; h=1", body_text, body_initial},
};

static nh_reduction *reduced(const moving *s, const units *u, bool given)
{
    char text[2000], initial[500], path[SCRATCH];
    nh_error error = {0};
    s->text(u, text, sizeof text);
    s->initial(u, initial, sizeof initial);
    cr_assert(scratch_text(path, text));
    nh_request q = {.system_path = path, .initial = initial, .group = given ? s->group : NULL};
    nh_options_default(&q.options);
    q.options.until = 10 * u->time;
    nh_reduction *r = nh_reduction_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s in units %g, %g, %g: %s", s->name, u->length, u->mass, u->time, error.what);
    return r;
}

/* Within a factor 10 of each other; what is below `fine` may be anything. */
static void near(const char *what, const moving *s, const units *u, double fine, double a, double b)
{
    static const double factor = 10;
    double x = fmax(a, fine), y = fmax(b, fine);
    cr_expect((a < 0) == (b < 0) && x <= factor * y && y <= factor * x, "%s in units %g, %g, %g: %s %g, not %g", s->name, u->length, u->mass, u->time, what, b, a);
}

static void same(const moving *s, const units *u, bool given)
{
    /* Motions are computed to 1e-12, and errors of that size depend on rounding: of a tenth of what decides it is said no more. */
    static const double fine = 1e-11, rounding = 1e-13;
    nh_reduction *a = reduced(s, &one, given), *b = reduced(s, u, given);
    cr_expect_str_eq(a->group->name, b->group->name, "%s in units %g, %g, %g", s->name, u->length, u->mass, u->time);
    cr_expect_eq(a->warnings, b->warnings, "%s in units %g, %g, %g: %s", s->name, u->length, u->mass, u->time, b->warnings ? b->warning[0] : "");
    cr_assert_eq(a->stages, b->stages);
    cr_expect(a->stages > 0);
    for (size_t i = 0; i < a->stages; i++) {
        const nh_reduction_stage *x = &a->stage[i], *y = &b->stage[i];
        cr_expect(x->kind == y->kind && strcmp(x->group, y->group) == 0 && x->measure.measure == y->measure.measure, "%s: %s by %s", s->name, nh_stage_kind_name(y->kind), y->group);
        cr_expect(x->complete && y->complete && !nh_stage_apart(y, &b->options), "%s, %s", s->name, y->note);
        near("agreement", s, u, fine, x->agreement, y->agreement);
        near("drift of the energy", s, u, fine, x->energy_drift, y->energy_drift);
        near("drift of the momentum", s, u, rounding, x->momentum_drift, y->momentum_drift);
    }
    nh_reduction_free(a);
    nh_reduction_free(b);
}

Test(reduce_scales, masses, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) same(&all[i], &(units){1, 1e-9, 1}, false), same(&all[i], &(units){1, 1e9, 1}, false);
}

Test(reduce_scales, times, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) same(&all[i], &(units){1, 1, 1e-9}, true), same(&all[i], &(units){1, 1, 1e8}, true);
}

Test(reduce_scales, masses_and_times, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) same(&all[i], &(units){1, 1e9, 1e8}, true), same(&all[i], &(units){1, 1e-9, 1e-9}, true);
}

/* A group that is given: no field is zero because another one is 1e9 times as large, no orbits nearly lie in the constraints. */
Test(reduce_scales, lengths, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) same(&all[i], &(units){1e-9, 1, 1}, true), same(&all[i], &(units){1e9, 1, 1}, true);
}

Test(reduce_scales, all_of_them, PLAIN_ONLY)
{
    for (size_t i = 0; i < sizeof all / sizeof *all; i++) same(&all[i], &(units){1e9, 1e-9, 1e8}, true), same(&all[i], &(units){1e-9, 1e9, 1e-9}, true);
}

/* The largest rate of a momentum at the probes, relative to the terms of the rate. */
static double largest_rate(const nh_model *o, nh_ex value)
{
    nh_ex phi = nh_chart_compose(o->chart, value), e[2] = {nh_model_gamma(o, phi), 0};
    e[1] = nh_terms_moduli(o->dag, e[0]);
    nh_tape *tape = nh_model_tape(o, 2, e);
    nh_tape_work *work = nh_tape_work_create(tape);
    double worst = 0;
    cr_assert_gt(o->chart->probes, 0);
    for (size_t p = 0; p < o->chart->probes; p++) {
        double at[2];
        nh_tape_eval(tape, work, o->chart->probe + p * o->width, at);
        if (at[0] != 0) worst = fmax(worst, fabs(at[0]) / at[1]);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
    return worst;
}

/* A small wheel in a large box: fields that hardly move anything in one direction, and everything in another one.  What is called conserved is conserved. */
Test(reduce_scales, lengths_far_apart, PLAIN_ONLY)
{
    static const double radius[] = {1e-9, 1e-6, 1e-3, 1, 1e6};
    static const char *const potential[] = {"", " - r*y", " - r^2*x^2", " - 3*cos(th)"};
    for (size_t i = 0; i < 5; i++)
        for (size_t j = 0; j < 8; j++) {
            char text[1000], path[SCRATCH];
            nh_error error = {0};
            if (!sweep_tries(i + j, 11, 16)) continue;
            snprintf(text, sizeof text, "name: wheel\nparameters: [{name: r, value: %.17g}]\ncoordinates: [{name: th, type: angle}, {name: x, type: length}, {name: y, type: length}]\n"
                                        "lagrangian: 1/2*(r^2*th'^2 + x'^2 + y'^2)%s\n", radius[i], potential[j % 4]);
            cr_assert(scratch_text(path, text));
            nh_request q = {.system_path = path, .weak = j >= 4};
            nh_options_default(&q.options);
            nh_reduction *r = nh_reduction_create(&q, &error);
            remove(path);
            cr_assert_not_null(r, "%s", error.what);
            cr_assert(nh_reduction_whole_model(r, &error), "%s", error.what);
            cr_expect_gt(r->momenta.count, 0, "r = %g, V =%s", radius[i], potential[j % 4]);
            for (size_t a = 0; a < r->momenta.count; a++)
                cr_expect_lt(largest_rate(r->whole, r->momenta.momentum[a].value), 1e-9, "r = %g, V =%s: momentum %zu is not conserved", radius[i], potential[j % 4], a);
            for (size_t a = 0; a < r->group->action.d; a++)
                cr_expect(nh_generator_proof(r->group->action.kinetic, &r->group->action.generator[a]).proved, "r = %g, V =%s: generator %zu", radius[i], potential[j % 4], a);
            nh_reduction_free(r);
        }
}

/* A plane on a spring and a rotor, whose inertia is a length of up to 1e9 and more: the rotation of the plane is in closed form. */
Test(reduce_scales, a_rotation_beside_a_great_inertia)
{
    static const double inertia[] = {1e-18, 1, 1e12, 1e18, 1e20};
    for (size_t i = 0; i < sizeof inertia / sizeof *inertia; i++) {
        char text[1000], path[SCRATCH];
        nh_error error = {0};
        snprintf(text, sizeof text, "name: rotor\nparameters: [{name: J, value: %g}]\ncoordinates: [{name: x, type: length}, {name: y, type: length}, {name: h, type: angle}]\n"
                                    "lagrangian: 1.3*(x'^2 + y'^2)/2 + J*h'^2/2 - (x^2 + y^2)\n", inertia[i]);
        cr_assert(scratch_text(path, text));
        nh_request q = {.system_path = path};
        nh_options_default(&q.options);
        nh_reduction *r = nh_reduction_create(&q, &error);
        remove(path);
        cr_assert_not_null(r, "%s", error.what);
        cr_expect_str_eq(r->group->name, "SO(2)^2", "J = %g", inertia[i]);
        cr_expect_eq(r->warnings, 0, "J = %g: %s", inertia[i], r->warnings ? r->warning[0] : "");
        nh_reduction_free(r);
    }
}

/* Velocities that violate the constraints are off by a part of their size, whatever that is. */
Test(reduce_scales, velocities_off_the_constraints)
{
    static const double size[] = {1e-12, 1, 1e12};
    for (size_t i = 0; i < sizeof size / sizeof *size; i++) {
        char text[2000], initial[500], path[SCRATCH];
        nh_error error = {0};
        sleigh_text(&one, text, sizeof text);
        snprintf(initial, sizeof initial, "h=0.3, x'=%.17g, y'=%.17g, h'=%.17g", size[i], size[i], 0.2 * size[i]);
        cr_assert(scratch_text(path, text));
        nh_request q = {.system_path = path, .initial = initial};
        nh_options_default(&q.options);
        q.options.until = 10 / size[i] < 1e9 ? 10 / size[i] : 1e9;
        cr_expect_null(nh_reduction_create(&q, &error), "velocities of size %g are taken", size[i]);
        cr_expect(strstr(error.what, "violate the constraints"), "%s", error.what);
        nh_error_clear(&error);
        remove(path);
    }
}

/* A light-like constraint, y'^2 = x'^2 + (c p')^2, in a unit of length of which c = 10^9 make one: the translations are there, and
 * velocities that are not given follow from the constraint. */
Test(reduce_scales, nonlinear_constraint_in_small_units)
{
    static const struct {
        const char *initial;
        bool allowed;
    } of[] = {{"x'=3e9, p'=4", true}, {"x'=3e9, y'=5e9", true}, {"y'=5e9", true}, {"x'=3e9, y'=5e9, p'=4", true}, {"x'=3e9, y'=-5e9, p'=4", true}, {"x'=3e9, y'=5e9, p'=4.001", false}};
    char path[SCRATCH];
    cr_assert(scratch_text(path, "name: light\ncoordinates: [x, y, {name: p, type: angle}]\nlagrangian: 1e-18*(x'^2 + y'^2)/2 + p'^2/2\nconstraints: [\"y'^2 = x'^2 + 1e18*p'^2\"]\n"));
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        nh_error error = {0};
        nh_request q = {.system_path = path, .initial = of[i].initial};
        nh_options_default(&q.options);
        q.options.until = 1;
        nh_reduction *r = nh_reduction_create(&q, &error);
        cr_expect_eq(r != NULL, of[i].allowed, "%s: %s", of[i].initial, error.what ? error.what : "taken");
        if (r) {
            const double *v = r->initial.v;
            cr_expect_eq(r->group->action.d, 3, "%s: %zu translations of 3", of[i].initial, r->group->action.d);
            cr_expect_lt(fabs(v[1] * v[1] - v[0] * v[0] - 1e18 * v[2] * v[2]), 1e-9 * v[1] * v[1], "%s: %g %g %g", of[i].initial, v[0], v[1], v[2]);
        }
        nh_error_clear(&error);
        nh_reduction_free(r);
    }
    remove(path);
}
