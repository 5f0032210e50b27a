/* Currents whose coefficients are functions of several variables without closed form: against error functions of a
 * complex argument, with bounds of their rates, and systems that have none. */
#include "mechanics.h"
#include "program.h"
#include "scratch.h"
#include "sweep.h"

#include <complex.h>
#include <math.h>

#include "base/linalg.h"
#include "commands/analyze.h"
#include "exact/ball.h"
#include "integrals/box_series.h"
#include "integrals/exact_points.h"
#include "system/sample.h"

/* ---- asking ---- */

/* With so much work for closed forms, which takes most of the time. */
static nh_analysis *ask_with(const char *text, double construct)
{
    char path[SCRATCH];
    cr_assert(scratch_text(path, text));
    nh_error error = {0};
    nh_request request = {.system_path = path};
    nh_options_default(&request.options);
    request.options.construct = construct;
    nh_analysis *r = nh_analysis_create(&request, &error);
    remove(path);
    cr_assert_not_null(r, "%s", error.what);
    return r;
}

static nh_analysis *ask(const char *text) { return ask_with(text, 1e5); }

/* Every series has a small bound, is new, and is constant along the motion; how many there are. */
static size_t check(const nh_analysis *r, const char *name)
{
    size_t n = 0;
    for (size_t k = 0; k < r->count; k++) {
        const nh_current *f = &r->found[k];
        if (!f->series || f->series->variables < 2) continue;
        n++;
        cr_expect(f->series->bound > 0 && f->series->bound < 1e-9 && f->heldout < 1e-9, "%s: %.1e, %.1e", name,
                  f->series->bound, f->heldout);
        cr_expect(!f->proof.proved && f->independence == NH_INDEPENDENT && f->drift.small, "%s: drift %.1e", name,
                  f->drift.drift[2]);
        cr_expect(f->has_symmetry, "%s", name);
    }
    return n;
}

static double between(uint64_t *state, double low, double high) { return low + (high - low) * nh_random(state); }

/* ---- a free particle in the plane ---- */

static const char plane[] = "name: plane\ncoordinates: [x, y]\nlagrangian: exp(x^2 - y^2)*(x'^2 + y'^2)/2\n";

/* w = int exp(z^2/2) dz = sum z^(2k+1)/(2^k k! (2k+1)) */
static double complex primitive(double complex z)
{
    double complex power = z, sum = 0;
    for (int k = 0; k < 60; k++) {
        sum += power / (2 * k + 1);
        power *= z * z / (2 * (k + 1));
    }
    return sum;
}

/* Both components of the velocity w', and the moment about w = 0. */
static void truth(const double z[5], double out[3])
{
    double complex position = z[1] + I * z[2], rate = cexp(position * position / 2) * (z[3] + I * z[4]),
                   moment = conj(primitive(position)) * rate;
    out[0] = creal(rate);
    out[1] = cimag(rate);
    out[2] = cimag(moment);
}

static void random_point(uint64_t *state, const nh_series *s, double z[5])
{
    z[0] = 0;
    for (size_t j = 0; j < 2; j++) z[1 + j] = between(state, s->low[j], s->high[j]);
    for (size_t j = 3; j < 5; j++) z[j] = between(state, -1, 1);
}

/* It is a combination of these three: the coefficients follow from three points, and hold at others. */
static void compare(const nh_analysis *r, const nh_current *f)
{
    nh_ex phi = f->phi;
    nh_tape *tape = nh_model_tape(r->model, 1, &phi);
    nh_tape_work *work = nh_tape_work_create(tape);
    uint64_t state = 11;
    double a[9], c[3], z[5], t[3];
    for (size_t p = 0; p < 3; p++) {
        random_point(&state, f->series, z);
        truth(z, t);
        for (size_t i = 0; i < 3; i++) a[p + 3 * i] = t[i];
        nh_tape_eval(tape, work, z, &c[p]);
    }
    cr_assert(nh_solve(3, a, 1, c, NULL));
    for (size_t p = 0; p < 50; p++) {
        double value;
        random_point(&state, f->series, z);
        truth(z, t);
        nh_tape_eval(tape, work, z, &value);
        cr_expect_lt(fabs(value - c[0] * t[0] - c[1] * t[1] - c[2] * t[2]), 1e-10);
    }
    nh_tape_work_free(work);
    nh_tape_free(tape);
}

/* The rate with all its digits at random points, velocities up to 1 in each component: below the bound. */
static void rate_is_bounded(const nh_analysis *r, const nh_current *f)
{
    nh_ball *ball = nh_ball_create(r->model->dag, 200);
    nh_ex rate = nh_model_values(r->model, nh_model_gamma(r->model, f->phi));
    uint64_t state = 5;
    double z[5], middle, radius, largest = 0;
    for (size_t p = 0; p < 20; p++) {
        random_point(&state, f->series, z);
        for (size_t i = 0; i < 5; i++) nh_ball_set_double(ball, r->model->chart->symbol[i], z[i]);
        cr_assert(nh_ball_value(ball, rate, &middle, &radius));
        largest = fmax(largest, fabs(middle) + radius);
    }
    cr_expect(largest > 0 && largest < f->series->bound, "%.2e and %.2e", largest, f->series->bound);
    nh_ball_free(ball);
}

Test(series_several, a_free_particle_in_isothermal_coordinates, .timeout = 120, PLAIN_ONLY)
{
    nh_analysis *r = ask(plane);
    cr_expect_eq(r->independent, 3u);
    cr_expect_eq(check(r, "plane"), 2u);
    for (size_t k = 0; k < r->count; k++) {
        if (!r->found[k].series) continue;
        const nh_series *s = r->found[k].series;
        cr_expect(s->low[0] <= -1 && s->high[0] >= 1 && s->low[1] <= -1 && s->high[1] >= 1);
        compare(r, &r->found[k]);
        rate_is_bounded(r, &r->found[k]);
    }
    nh_analysis_free(r);
}

/* A metric that is not flat has one integral, the energy, however little its curvature is. */
Test(series_several, nothing_where_nothing_is_missing, .timeout = 120)
{
    nh_analysis *r =
        ask("name: curved\ncoordinates: [x, y]\nlagrangian: exp(x^2 - 1.000001*y^2)*(x'^2 + y'^2)/2\n");
    cr_expect_eq(r->independent, 1u);
    cr_expect_eq(check(r, "curved"), 0u);
    nh_analysis_free(r);
}

/* ---- with constraints, and with time ---- */

/* An edge turns with a coordinate of a flat plane; the motion in the plane is free. */
Test(series_several, two_shape_coordinates_of_an_edge, .timeout = 120, WHOLE_ONLY)
{
    nh_analysis *r = ask("name: edge\ncoordinates: [u, v, y, z]\nlagrangian: (exp(u^2 - v^2)*(u'^2 + v'^2) + y'^2 + "
                         "z'^2)/2\nconstraints:\n  - z' = u*y'\n");
    cr_expect_eq(r->independent, 4u);
    cr_expect_eq(check(r, "edge"), 2u);
    nh_analysis_free(r);
}

/* X = erf(x (1 + t/4)) moves freely: X' has a closed form, X - t X' has none. */
Test(series_several, a_place_and_the_time, .timeout = 120, WHOLE_ONLY)
{
    nh_analysis *r = ask_with("name: error function\ncoordinates: [x]\nlagrangian: exp(-2*x^2*(1 + t/4)^2)*((1 + t/4)*x' "
                              "+ x/4)^2/2\ndomain: {x: [-1, 1], t: [0, 1]}\n",
                              1e8);
    cr_expect_eq(r->independent, 2u);
    cr_expect_eq(check(r, "error function"), 1u);
    nh_analysis_free(r);
}

/* The same plane with a mass that grows: both momenta and the moment depend on three variables. */
Test(series_several, two_coordinates_and_the_time, .timeout = 300, WHOLE_ONLY)
{
    nh_analysis *r = ask("name: growing\ncoordinates: [x, y]\nlagrangian: exp(t/5)*exp(x^2 - y^2)*(x'^2 + y'^2)/2\n");
    cr_expect_eq(r->independent, 4u);
    cr_expect_eq(check(r, "growing"), 3u);
    for (size_t k = 0; k < r->count; k++) cr_expect(!r->found[k].series || r->found[k].series->variables == 3);
    nh_analysis_free(r);
}

/* The energy times an exponential of t has a closed form, and needs no construction. */
Test(series_several, the_energy_of_a_mass_that_grows, .timeout = 60)
{
    nh_analysis *r = ask_with("name: growing\ncoordinates: [x, y]\nlagrangian: exp(t/5)*exp(x^2 - y^2)*(x'^2 + y'^2)/2\n", 0);
    cr_assert_eq(r->independent, 1u);
    cr_expect(!r->found[0].series && r->found[0].proof.proved);
    nh_analysis_free(r);
}

/* ---- the bound ---- */

/* Coefficients that are wrong by 1e-7 solve the equations to no more than that, and the bound says so. */
Test(series_several, a_wrong_function_has_no_small_bound, .timeout = 60)
{
    static const double low[] = {-0.5, -0.4}, high[] = {0.5, 0.6}, off = 1e-7;
    mechanics x = mechanics_of_text(plane, NH_CHART_COORDINATES);
    nh_arena *arena = nh_arena_create();
    const nh_ex variable[] = {x.model->system->coordinate[0].q, x.model->system->coordinate[1].q};
    nh_box_series *s = nh_box_series_create(x.model, 2, variable, 1, arena);
    cr_assert_not_null(s);
    cr_expect(s->split && s->words == 2);
    nh_box_functions f = nh_box_series_solve(s, low, high, 22, arena);
    cr_assert_eq(f.count, 3u);
    double bound[3], *c = nh_arena_alloc(arena, 3 * s->words * f.terms * sizeof *c);
    cr_assert(nh_ball_box_bound(x.model->dag, &s->equations, &f, 1e-9, bound));
    for (size_t k = 0; k < 3; k++) cr_expect(bound[k] > 0 && bound[k] < 1e-11, "%.1e", bound[k]);
    memcpy(c, f.coefficient, 3 * s->words * f.terms * sizeof *c);
    c[1] += off;
    f.coefficient = c;
    cr_expect_not(nh_ball_box_bound(x.model->dag, &s->equations, &f, 1e-9, bound));
    cr_assert(nh_ball_box_bound(x.model->dag, &s->equations, &f, 1e-4, bound));
    cr_expect(bound[0] > off && bound[0] < 1e3 * off && bound[1] < 1e-11, "%.1e, %.1e", bound[0], bound[1]);
    nh_arena_free(arena);
    mechanics_clear(&x);
}
