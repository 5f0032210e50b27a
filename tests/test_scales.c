/* Amplitudes and units do not decide what is right: errors are relative to the sizes of quantities. */
#include <criterion/criterion.h>

#include "motion/vanishing.h"
#include "program.h"
#include "scales_cases.h"

static void try_all(const scales_of *s, double eps, size_t *tried, size_t *held)
{
    for (size_t i = 0; i < scales_systems; i++) {
        scales_result r = scales_try(&scales_all[i], s, eps);
        cr_expect(!r.wrong, "%s of amplitude %g, units %g, %g, %g: %g wanted, %g found (%s)", scales_all[i].name, s->amplitude, s->length, s->mass, s->time, eps, r.error, r.why);
        ++*tried;
        *held += r.held;
        if (!r.held) cr_log_warn("%s of amplitude %g, units %g, %g, %g: %s", scales_all[i].name, s->amplitude, s->length, s->mass, s->time, r.why);
    }
}

Test(scales, amplitudes)
{
    static const double amplitude[] = {1e-12, 1e-6, 1e12}, eps[] = {1e-4, 1e-8, 1e-11};
    size_t tried = 0, held = 0;
    for (size_t i = 0; i < sizeof amplitude / sizeof *amplitude; i++)
        for (size_t k = 0; k < sizeof eps / sizeof *eps; k++) try_all(&(scales_of){amplitude[i], 1, 1, 1}, eps[k], &tried, &held);
    cr_expect_eq(held, tried, "%zu of %zu", held, tried);
}

Test(scales, units)
{
    static const double unit[] = {1e-9, 1e9};
    size_t tried = 0, held = 0;
    for (size_t i = 0; i < 2; i++) {
        try_all(&(scales_of){1, unit[i], 1, 1}, 1e-7, &tried, &held);
        try_all(&(scales_of){1, 1, unit[i], 1}, 1e-7, &tried, &held);
        try_all(&(scales_of){1, 1, 1, unit[i]}, 1e-7, &tried, &held);
    }
    cr_expect_eq(held, tried, "%zu of %zu", held, tried);
}

/* What is zero is told apart from what is small, and from what the chart cannot tell. */
static void zeros_of(const char *text, const double *q, const double *v, size_t n, const char *const *names, bool *zero)
{
    mechanics x = mechanics_of_text(text, NH_CHART_AUTO);
    nh_error error = {0};
    double z[16];
    nh_ex e[8];
    nh_state initial = {.q = (double *)q, .v = (double *)v};
    for (size_t k = 0; k < n; k++) e[k] = formula(x.model, names[k]);
    nh_dynamics *d = nh_dynamics_create(x.model);
    must(nh_dynamics_start(d, &initial, true, z, &error), &error, "the start");
    nh_vanishing *w = nh_vanishing_create(x.model, n, e);
    nh_vanishing_test(w, z, zero);
    nh_vanishing_free(w);
    nh_dynamics_free(d);
    mechanics_clear(&x);
}

Test(scales, zero_is_not_small)
{
    static const char *const disk = "name: test\ncoordinates: [{name: x}, {name: y}, {name: phi, type: angle}, {name: psi, type: angle}]\nlagrangian: (x'^2 + y'^2)/2 + psi'^2/4 + phi'^2/8\n"
                                    "constraints: [\"x' = cos(phi)*psi'\", \"y' = sin(phi)*psi'\"]\nvelocities: {names: [w, p], map: [\"x' = cos(phi)*p\", \"y' = sin(phi)*p\", \"phi' = w\", \"psi' = p\"]}\n";
    static const char *const names[] = {"x", "x'", "y'", "phi'", "cos(phi)^2 + sin(phi)^2 - 1 + x'", "p*(phi - 1)"};
    double q[4] = {0, 0, acos(0), 0}, v[4] = {cos(q[2]), 1, 0, 1};
    bool zero[6];
    zeros_of(disk, q, v, 6, names, zero);
    cr_expect(zero[0] && zero[1] && !zero[2] && zero[3] && zero[4] && !zero[5]);
    q[2] -= 1e-10;
    v[0] = cos(q[2]);
    zeros_of(disk, q, v, 6, names, zero);
    cr_expect(!zero[0] && !zero[1] && !zero[2] && zero[3] && !zero[4] && !zero[5]);
}

/* y' = tan(phi) x' at phi = pi/2 is 1, of which rounding leaves no digit: not a zero. */
Test(scales, what_is_ill_conditioned_is_not_zero)
{
    static const char *const disk = "name: test\ncoordinates: [{name: x}, {name: y}, {name: phi, type: angle}]\nlagrangian: (x'^2 + y'^2 + phi'^2)/2\nconstraints: [\"y' = tan(phi)*x'\"]\n"
                                    "velocities: {names: [u, w], map: [\"x' = u\", \"y' = tan(phi)*u\", \"phi' = w\"]}\n";
    static const char *const names[] = {"y'", "phi'"};
    double q[3] = {0, 0, acos(0)}, v[3] = {6.123233995736766e-17, 1, 0};
    bool zero[2];
    zeros_of(disk, q, v, 2, names, zero);
    cr_expect(!zero[0] && zero[1]);
}

/* All columns of a motion of size 1e-12, as they are printed; and one that cancels down to rounding is not passed off. */
Test(scales, what_is_printed)
{
    place p = place_make();
    write_here(&p, "osc.yaml", "name: osc\ncoordinates: [{name: x}]\nlagrangian: x'^2/2 - x^2/2\n");
    finished r = run_expecting(&p, "simulate osc.yaml --initial x=1e-12 --accuracy 1e-6 --step 30 --until 30", 0);
    const char *last = strstr(r.out, "\n30,");
    cr_assert(last, "%s", r.out);
    cr_expect_float_eq(strtod(last + 4, NULL) / 1e-12, cos(30), 1e-6, "%s", last);
    finished_clear(&r);
    r = run_expecting(&p, "simulate osc.yaml --initial x=1 --watch x'^2+x^2-1 --accuracy 1e-6 --until 30", 4);
    cr_expect(strstr(r.err, "larger terms that cancel"), "%s", r.err);
    finished_clear(&r);
    place_clear(&p);
}
