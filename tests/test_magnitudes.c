/* Bodies and units of very different sizes: what is proved does not depend on them. */
#include <criterion/criterion.h>

#include "analysed.h"
#include "catalogue.h"
#include "scratch.h"
#include "sweep.h"

/* The analysis is complete to the degree, with so many currents, all of them proved. */
static void expect_complete(const char *name, const char *text, size_t proved, size_t degree)
{
    char path[SCRATCH];
    FILE *out = scratch_open(path);
    cr_assert_not_null(out);
    fprintf(out, "name: magnitudes\n%s", text);
    fclose(out);
    nh_error error = {0};
    nh_request q = {.system_path = path};
    nh_options_default(&q.options);
    q.options.max_seconds = 1e6; /* the same on every machine */
    nh_analysis *r = nh_analysis_create(&q, &error);
    remove(path);
    cr_assert_not_null(r, "%s: %s", name, error.what);
    const nh_completeness *c = &r->completeness[NH_COMPLETE_IN_COORDINATES];
    cr_expect(c->counted && c->degree >= degree && !c->missing_at, "%s: complete to degree %zu", name, c->degree);
    cr_expect_eq(r->list->independent, proved, "%s: %zu currents", name, r->list->independent);
    cr_expect_eq(r->list->count, proved, "%s: %zu are listed", name, r->list->count);
    for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.proved, "%s: Phi%zu is not proved", name, k + 1);
    row o = {.rate = -INFINITY};
    compare(r, &o);
    cr_expect_eq(o.missing + o.wrong + o.untrue, 0, "%s: %s", name, o.names);
    nh_analysis_free(r);
}

/* The momentum is a function of the energy but for a part of 1e-10: an exact current is compared exactly. */
Test(magnitudes, a_pendulum_of_two_grams_on_a_cart_of_twelve_tons)
{
    expect_complete("cart",
                    "parameters: {m: 0.0023, L: 0.00125, g: 9.81}\n"
                    "coordinates: [x, {name: th, type: angle}]\n"
                    "lagrangian: 12000*x'^2/2 + m*(x'^2 + 2*L*x'*th'*cos(th) + L^2*th'^2)/2 + m*g*L*cos(th)\n"
                    "known: {currents: [{name: momentum, expr: \"12000*x' + m*(x' + L*th'*cos(th))\"}]}\n",
                    3, 4);
}

/* A fit that is inexact in its last digits differs from the momentum by as much as the momentum from the energy. */
Test(magnitudes, a_pendulum_of_grams_below_one_of_tons, PLAIN_ONLY)
{
    expect_complete("pendulums",
                    "parameters: {m1: 1200, m2: 0.004, l1: 30, l2: 0.02, g: 0}\n"
                    "coordinates: [{name: a, type: angle}, {name: b, type: angle}]\n"
                    "lagrangian: m1*l1^2*a'^2/2 + m2*(l1^2*a'^2 + l2^2*b'^2 + 2*l1*l2*a'*b'*cos(a - b))/2 + g*m1*l1*cos(a)\n"
                    "known: {currents: [{name: momentum, expr: \"m1*l1^2*a' + m2*(l1^2*a' + l2^2*b' + l1*l2*(a' + b')*cos(a - b))\"}]}\n",
                    2, 4);
}

/* ph' = (y'*cos(ph) - x'*sin(ph))/0.012 makes x' and y' coordinates of a chart that is steep everywhere, although it has
 * no singular point. */
Test(magnitudes, a_blade_a_centimetre_from_the_centre_of_a_heavy_body, PLAIN_ONLY)
{
    expect_complete("sled",
                    "coordinates: [x, y, {name: ph, type: angle}]\n"
                    "lagrangian: 1250*(x'^2 + y'^2)/2 + 3.1e-3*ph'^2/2\n"
                    "constraints: [\"y'*cos(ph) - x'*sin(ph) = 0.012*ph'\"]\n"
                    "known: {currents: [{name: E, expr: \"1250*(x'^2 + y'^2)/2 + 3.1e-3*ph'^2/2\"}]}\n",
                    3, 4);
}

/* Without parameters as with them, residues give the coefficients that doubles cannot name. */
Test(magnitudes, an_ion_in_a_trap_in_si_units, WHOLE_ONLY)
{
    expect_complete(
        "ion",
        "coordinates: [x, y, z]\n"
        "lagrangian: 1.67262e-27*(x'^2 + y'^2 + z'^2)/2 + 1.602e-19*0.35*(x*y' - y*x')/2"
        " - 1.602e-19*(2*z^2 - x^2 - y^2)*1.0e4\n"
        "domain: {x: [-1e-3, 1e-3], y: [-1e-3, 1e-3], z: [-1e-3, 1e-3]}\n"
        "known: {currents: [{name: turning, expr: \"1.67262e-27*(x*y' - y*x') + 2.8035e-20*(x^2 + y^2)\"}]}\n",
        4, 4);
}

/* The constraint says how fast the body is: velocities of the usual size hardly ever fulfil it, whether it is slow or fast. */
Test(magnitudes, a_body_of_any_constant_speed, PLAIN_ONLY)
{
    static const double speed[] = {0.5, 0.01, 2, 3000};
    for (size_t i = 0; i < sizeof speed / sizeof *speed; i++) {
        if (!sweep_tries(i, 3, 4)) continue;
        char text[300];
        snprintf(text, sizeof text, "name: constant\nparameters: {c: %g, g: 9.8}\ncoordinates: [x, y, z]\nlagrangian: (x'^2 + y'^2 + z'^2)/2 - g*z\nconstraints: [\"x'^2 + y'^2 + z'^2 = c^2\"]\n", speed[i]);
        nh_analysis *r = analysed_text(text);
        cr_expect_eq(r->list->independent, 5, "%g: %zu", speed[i], r->list->independent);
        for (size_t k = 0; k < r->list->count; k++) cr_expect(r->list->found[k].proof.proved, "%g: Phi%zu is not proved", speed[i], k + 1);
        nh_analysis_free(r);
    }
}
