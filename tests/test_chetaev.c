/* Motions with multipliers against closed forms and against reduced equations. */
#include <criterion/criterion.h>
#include <criterion/redirect.h>

#include <math.h>
#include <string.h>

#include "motion/integrators.h"
#include "motion/chetaev.h"

static void grid(size_t count, double from, double to, double *times)
{
    for (size_t i = 0; i < count; i++)
        times[i] = from + (to - from) * (double)i / (double)(count - 1);
    times[count - 1] = to;
}

static nh_chetaev_motion *run(const nh_chetaev_problem *problem, const double *initial, size_t count, const double *times,
                              double rtol)
{
    nh_error error = {0};
    nh_flow_options options = {.rtol = rtol};
    nh_chetaev_motion *result = nh_chetaev(problem, initial, count, times, &options, &error);
    cr_assert(result && result->motion->size == 2 * problem->coordinates + problem->constraints, "%s", error.what);
    return result;
}

static void assert_says(const nh_motion *motion, const char *words)
{
    cr_expect_not_null(strstr(motion->note, words), "the note \"%s\" lacks \"%s\"", motion->note, words);
}

/* ---- a pendulum in Cartesian coordinates: x x' + y y' = 0, L = m/2 (x'^2 + y'^2) - m g y ----
 *
 * m x'' + x mu = 0,  m y'' + m g + y mu = 0,  x x'' + y y'' + x'^2 + y'^2 = 0;  so  mu = m (x'^2 + y'^2 - g y)/(x^2 + y^2). */

typedef struct {
    double mass, gravity, wall; /* no terms from the wall's time on */
    size_t times;               /* the constraint this many times over, with factors */
    double damping;             /* f' = -damping f instead of 0 */
} pendulum_data;

static bool pendulum(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f,
                     void *context)
{
    const pendulum_data *data = context;
    size_t k = data->times;
    K[0] = K[3] = data->mass, K[1] = K[2] = 0;
    h[0] = 0, h[1] = data->mass * data->gravity;
    for (size_t a = 0; a < k; a++) {
        double factor = 1 + 2.7 * (double)a;
        f[a] = factor * (q[0] * v[0] + q[1] * v[1]);
        F[a] = factor * q[0];
        F[a + k] = factor * q[1];
        g[a] = factor * (v[0] * v[0] + v[1] * v[1]) + data->damping * f[a];
    }
    return t < data->wall;
}

/* The angle from the lowest point: theta'' = -g/l sin theta. */
static bool pendulum_angle(double t, const double *z, double *rate, void *context)
{
    (void)t;
    rate[0] = z[1];
    rate[1] = -*(double *)context * sin(z[0]);
    return true;
}

static const double pendulum_length = 1.37, pendulum_start_angle = 0.9, pendulum_start_rate = 0.45;

static void pendulum_start(double *initial)
{
    double l = pendulum_length, s = sin(pendulum_start_angle), c = cos(pendulum_start_angle);
    initial[0] = l * s, initial[1] = -l * c;
    initial[2] = l * c * pendulum_start_rate, initial[3] = l * s * pendulum_start_rate;
}

/* The pendulum from that start, its radial velocity increased by `radial`. */
static nh_chetaev_motion *swing(pendulum_data data, double radial, size_t count, const double *times, double rtol)
{
    double start[4];
    pendulum_start(start);
    start[2] += radial * sin(pendulum_start_angle);
    start[3] -= radial * cos(pendulum_start_angle);
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = data.times, .context = &data, .terms = pendulum};
    return run(&problem, start, count, times, rtol);
}

static const pendulum_data plain = {.mass = 0.83, .gravity = 9.81, .wall = INFINITY, .times = 1};

enum { PENDULUM_TIMES = 29 };

static nh_motion *pendulum_reference(const double *times)
{
    double ratio = 9.81 / pendulum_length, start[] = {pendulum_start_angle, pendulum_start_rate};
    nh_flow_problem problem = {.size = 2, .rate = pendulum_angle, .context = &ratio};
    nh_flow_options options = {.rtol = 1e-13};
    nh_error error = {0};
    nh_motion *motion = nh_cvode(&problem, start, PENDULUM_TIMES, times, &options, &error);
    cr_assert(motion && motion->complete);
    return motion;
}

typedef struct {
    double position, multiplier, violation;
} errors;

static errors pendulum_errors(double rtol)
{
    double times[PENDULUM_TIMES], l = pendulum_length;
    grid(PENDULUM_TIMES, 0.2, 5.2, times);
    nh_motion *reference = pendulum_reference(times);
    nh_chetaev_motion *result = swing(plain, 0, PENDULUM_TIMES, times, rtol);
    cr_assert(result->motion->complete, "%s", result->motion->note);
    errors worst = {.violation = result->violation};
    for (size_t i = 0; i < PENDULUM_TIMES; i++) {
        const double *y = result->motion->state + 5 * i, *z = reference->state + 2 * i;
        double mu = 0.83 * (z[1] * z[1] + 9.81 * cos(z[0]) / l);
        worst.position = fmax(worst.position, fmax(fabs(y[0] - l * sin(z[0])), fabs(y[1] + l * cos(z[0]))));
        worst.multiplier = fmax(worst.multiplier, fabs(y[4] - mu));
    }
    nh_motion_free(reference);
    nh_chetaev_motion_free(result);
    return worst;
}

Test(chetaev, pendulum_converges_with_its_multiplier)
{
    errors loose = pendulum_errors(1e-6), middle = pendulum_errors(1e-8), tight = pendulum_errors(1e-10);
    cr_expect(loose.position < 1e-2 && middle.position < loose.position / 10 && tight.position < middle.position / 10,
              "%g %g %g", loose.position, middle.position, tight.position);
    cr_expect(middle.multiplier < loose.multiplier / 10 && tight.multiplier < middle.multiplier / 10, "%g %g %g",
              loose.multiplier, middle.multiplier, tight.multiplier);
    cr_expect(tight.position < 1e-6 && tight.multiplier < 2e-6 && 0 < tight.violation && tight.violation < 1e-7, "%g %g %g",
              tight.position, tight.multiplier, tight.violation);
    cr_expect_lt(middle.violation, loose.violation / 5, "%g %g", middle.violation, loose.violation);
}

/* Backward from where the forward motion ended, to its start; the last state is a consistent one up to the violation. */
Test(chetaev, forward_and_back_again)
{
    double there[] = {0.2, 1.9}, back[] = {1.9, 0.2}, start[4];
    pendulum_start(start);
    pendulum_data data = plain;
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = 1, .context = &data, .terms = pendulum};
    nh_chetaev_motion *forward = swing(plain, 0, 2, there, 1e-11);
    nh_chetaev_motion *backward = run(&problem, forward->motion->state + 5, 2, back, 1e-11);
    cr_assert(backward->motion->complete, "%s", backward->motion->note);
    for (size_t j = 0; j < 4; j++)
        cr_expect_float_eq(backward->motion->state[5 + j], start[j], 1e-7, "%zu: %g", j, backward->motion->state[5 + j] - start[j]);
    cr_expect_float_eq(backward->motion->state[9], forward->motion->state[4], 1e-5);
    nh_chetaev_motion_free(forward);
    nh_chetaev_motion_free(backward);
}

/* ---- the sleigh in (phi, x, y): f = x' sin phi - y' cos phi ----
 *
 * L = m/2 ((x' - a phi' sin phi)^2 + (y' + a phi' cos phi)^2) + J/2 phi'^2 - m c y (c pulls the blade down the slope):
 * mu = m omega v J/(J + m a^2) + m c cos phi, and on the level (c = 0)
 * omega = omega0 sech z, v = a k omega0 tanh z, phi = 2 k atan tanh(z/2), z = omega0 t/k, k^2 = 1 + J/(m a^2). */

typedef struct {
    double m, J, a, slope;
} sleigh_data;

static bool sleigh(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f, void *context)
{
    (void)t;
    const sleigh_data *d = context;
    double s = sin(q[0]), c = cos(q[0]), m = d->m, a = d->a;
    const double mass[9] = {d->J + m * a * a, -m * a * s, m * a * c, -m * a * s, m, 0, m * a * c, 0, m};
    memcpy(K, mass, sizeof mass);
    h[0] = 0;
    h[1] = -m * a * c * v[0] * v[0];
    h[2] = -m * a * s * v[0] * v[0] + m * d->slope;
    F[0] = 0, F[1] = s, F[2] = -c;
    g[0] = v[0] * (v[1] * c + v[2] * s);
    f[0] = v[1] * s - v[2] * c;
    return true;
}

/* (phi, omega, v): (J + m a^2) omega' = -m a omega v,  v' = a omega^2 - c sin phi. */
static bool sleigh_reduced(double t, const double *z, double *rate, void *context)
{
    (void)t;
    const sleigh_data *d = context;
    rate[0] = z[1];
    rate[1] = -d->m * d->a * z[1] * z[2] / (d->J + d->m * d->a * d->a);
    rate[2] = d->a * z[1] * z[1] - d->slope * sin(z[0]);
    return true;
}

enum { SLEIGH_TIMES = 17 };

static errors compare_sleigh(const sleigh_data *d, const nh_chetaev_motion *result, const double *exact)
{
    errors worst = {.violation = result->violation};
    for (size_t i = 0; i < SLEIGH_TIMES; i++) {
        const double *y = result->motion->state + 7 * i, *z = exact + 3 * i;
        double mu = d->m * z[1] * z[2] * d->J / (d->J + d->m * d->a * d->a) + d->m * d->slope * cos(z[0]);
        worst.position = fmax(worst.position, fmax(fabs(y[0] - z[0]), fabs(y[3] - z[1])));
        worst.position = fmax(worst.position, fabs(y[4] * cos(y[0]) + y[5] * sin(y[0]) - z[2]));
        worst.multiplier = fmax(worst.multiplier, fabs(y[6] - mu));
    }
    return worst;
}

Test(chetaev, sleigh_on_the_level_against_its_closed_form)
{
    sleigh_data d = {.m = 1.7, .J = 0.62, .a = 0.53};
    double k = sqrt(1 + d.J / (d.m * d.a * d.a)), omega0 = 1.83, times[SLEIGH_TIMES], exact[3 * SLEIGH_TIMES];
    grid(SLEIGH_TIMES, 0, 4.1, times);
    for (size_t i = 0; i < SLEIGH_TIMES; i++) {
        double z = omega0 * times[i] / k;
        exact[3 * i] = 2 * k * atan(tanh(z / 2));
        exact[3 * i + 1] = omega0 / cosh(z);
        exact[3 * i + 2] = d.a * k * omega0 * tanh(z);
    }
    nh_chetaev_problem problem = {.coordinates = 3, .constraints = 1, .context = &d, .terms = sleigh};
    nh_chetaev_motion *result = run(&problem, (double[]){0, 0.31, -1.27, omega0, 0, 0}, SLEIGH_TIMES, times, 1e-10);
    cr_assert(result->motion->complete, "%s", result->motion->note);
    errors worst = compare_sleigh(&d, result, exact);
    cr_expect(worst.position < 1e-8 && worst.multiplier < 2e-7 && worst.violation < 1e-7, "%g %g %g", worst.position,
              worst.multiplier, worst.violation);
    cr_expect(result->motion->jacobians > 0 && result->motion->steps > 50 && result->motion->evaluations > result->motion->steps);
    nh_chetaev_motion_free(result);
}

/* Of index 2 the constraint holds as well as the interpolation between the steps. */
Test(chetaev, of_index_2_the_constraint_holds)
{
    sleigh_data d = {.m = 1.7, .J = 0.62, .a = 0.53};
    double k = sqrt(1 + d.J / (d.m * d.a * d.a)), omega0 = 1.83, times[SLEIGH_TIMES], exact[3 * SLEIGH_TIMES];
    grid(SLEIGH_TIMES, 0, 4.1, times);
    for (size_t i = 0; i < SLEIGH_TIMES; i++) {
        double z = omega0 * times[i] / k;
        exact[3 * i] = 2 * k * atan(tanh(z / 2)), exact[3 * i + 1] = omega0 / cosh(z), exact[3 * i + 2] = d.a * k * omega0 * tanh(z);
    }
    errors worst[2];
    for (int holds = 0; holds < 2; holds++) {
        nh_chetaev_problem problem = {.coordinates = 3, .constraints = 1, .holds = holds, .context = &d, .terms = sleigh};
        nh_chetaev_motion *result = run(&problem, (double[]){0, 0.31, -1.27, omega0, 0, 0}, SLEIGH_TIMES, times, 1e-8);
        cr_assert(result->motion->complete, "%s", result->motion->note);
        worst[holds] = compare_sleigh(&d, result, exact);
        nh_chetaev_motion_free(result);
    }
    cr_expect(worst[1].position < 3e-7 && worst[1].multiplier < 1e-4, "%g %g", worst[1].position, worst[1].multiplier);
    cr_expect(worst[1].violation < 3e-8 && worst[1].violation < worst[0].violation / 3, "%g, %g", worst[1].violation, worst[0].violation);
}

/* Also J = 0: all mass in one point, K has rank 2 of 3. */
Test(chetaev, sleigh_on_a_slope_against_the_reduced_equations)
{
    double inertias[] = {0.62, 0.0}, times[SLEIGH_TIMES];
    grid(SLEIGH_TIMES, 0.7, 3.9, times);
    for (int i = 0; i < 2; i++) {
        sleigh_data d = {.m = 1.7, .J = inertias[i], .a = 0.53, .slope = 2.44};
        double reduced_start[3] = {0.41, 1.83, -0.66};
        double c = cos(0.41), s = sin(0.41), start[6] = {0.41, 0.31, -1.27, 1.83, -0.66 * c, -0.66 * s};
        nh_flow_problem reduced = {.size = 3, .rate = sleigh_reduced, .context = &d};
        nh_flow_options options = {.rtol = 1e-13};
        nh_error error = {0};
        nh_motion *exact = nh_cvode(&reduced, reduced_start, SLEIGH_TIMES, times, &options, &error);
        nh_chetaev_problem problem = {.coordinates = 3, .constraints = 1, .context = &d, .terms = sleigh};
        nh_chetaev_motion *result = run(&problem, start, SLEIGH_TIMES, times, 1e-10);
        cr_assert(exact && exact->complete && result->motion->complete, "%s", result->motion->note);
        errors worst = compare_sleigh(&d, result, exact->state);
        cr_expect(0 < worst.position && worst.position < 3e-8 && worst.multiplier < 3e-7 && worst.violation < 1e-7,
                  "J = %g: %g %g %g", d.J, worst.position, worst.multiplier, worst.violation);
        nh_motion_free(exact);
        nh_chetaev_motion_free(result);
    }
}

/* ---- a constraint that is not linear: (x'^2 + y'^2 - c^2)/2 = 0 in a uniform field ----
 *
 * The direction t of the velocity obeys c t' = -gamma cos t: y' = -c tanh z, x' = c sech z, z = gamma t/c; mu = -m gamma y'/c^2. */

static const double body_mass = 2.13, field = 3.37, body_speed = 1.91;

static bool constant_speed(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f,
                           void *context)
{
    (void)t, (void)q, (void)context;
    K[0] = K[3] = body_mass, K[1] = K[2] = 0;
    h[0] = 0, h[1] = body_mass * field;
    F[0] = v[0], F[1] = v[1];
    g[0] = 0;
    f[0] = (v[0] * v[0] + v[1] * v[1] - body_speed * body_speed) / 2;
    return true;
}

Test(chetaev, constant_speed_in_a_field)
{
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = 1, .terms = constant_speed};
    double start[4] = {0.4, 0.9, body_speed, 0}, times[] = {0, 0.33, 0.81, 1.4};
    nh_chetaev_motion *result = run(&problem, start, 4, times, 1e-10);
    cr_assert(result->motion->complete, "%s", result->motion->note);
    for (size_t i = 0; i < 4; i++) {
        const double *y = result->motion->state + 5 * i;
        double z = field * times[i] / body_speed, rise = -body_speed * tanh(z);
        cr_expect_float_eq(y[1], 0.9 - body_speed * body_speed / field * log(cosh(z)), 1e-8, "%g", times[i]);
        cr_expect_leq(hypot(y[2] - body_speed / cosh(z), y[3] - rise), 1e-8, "%g", times[i]);
        cr_expect_float_eq(y[4], -body_mass * field * rise / (body_speed * body_speed), 2e-6, "%g", times[i]);
    }
    cr_expect_lt(result->violation, 1e-7);
    nh_chetaev_motion_free(result);
}

/* ---- no constraint: a free particle in polar coordinates, m (r'' - r theta'^2) = 0, m (r^2 theta'' + 2 r r' theta') = 0 ---- */

static bool polar(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f, void *context)
{
    (void)t, (void)F, (void)g, (void)f;
    double m = *(double *)context;
    K[0] = m, K[1] = K[2] = 0, K[3] = m * q[0] * q[0];
    h[0] = -m * q[0] * v[1] * v[1];
    h[1] = 2 * m * q[0] * v[0] * v[1];
    return q[0] > 0;
}

Test(chetaev, without_constraints_a_straight_line)
{
    double m = 3.19, distance = 0.84, speed = 1.26, start[4] = {distance, 0.37, 0, speed / distance}, times[] = {0, 0.5, 1.3, 4.2};
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = 0, .context = &m, .terms = polar};
    nh_chetaev_motion *result = run(&problem, start, 4, times, 1e-11);
    cr_assert(result->motion->complete && result->motion->size == 4, "%s", result->motion->note);
    for (size_t i = 0; i < 4; i++) {
        cr_expect_float_eq(result->motion->state[4 * i], hypot(distance, speed * times[i]), 1e-8);
        cr_expect_float_eq(result->motion->state[4 * i + 1], 0.37 + atan2(speed * times[i], distance), 1e-8);
    }
    cr_expect_eq(result->violation, 0);
    nh_chetaev_motion_free(result);
}

/* Without the differences in q and v Newton's matrix knows nothing of the stiffness, and the steps become tiny. */
static bool stiff(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f, void *context)
{
    (void)F, (void)g, (void)f, (void)context;
    K[0] = 1.3;
    h[0] = 6.3e3 * (v[0] - cos(t)) + 1.3 * sin(t) + 2.9 * (q[0] - sin(t)); /* q = sin t */
    return true;
}

Test(chetaev, stiffness_does_not_shorten_the_steps)
{
    nh_chetaev_problem problem = {.coordinates = 1, .constraints = 0, .terms = stiff};
    nh_chetaev_motion *result = run(&problem, (double[]){0, 1}, 2, (double[]){0, 5.9}, 1e-8);
    cr_expect(result->motion->complete && result->motion->steps < 1000, "%ld %s", result->motion->steps, result->motion->note);
    cr_expect_float_eq(result->motion->state[2], sin(5.9), 1e-6);
    nh_chetaev_motion_free(result);
}

/* ---- beginnings and ends ---- */

Test(chetaev, one_time_gives_the_multiplier_of_the_start)
{
    double start[4], time = 0.2;
    pendulum_start(start);
    nh_chetaev_motion *result = swing(plain, 0, 1, &time, 1e-9);
    double mu = 0.83 * (pendulum_start_rate * pendulum_start_rate + 9.81 * cos(pendulum_start_angle) / pendulum_length);
    cr_expect(result->motion->complete && result->motion->count == 1);
    cr_expect_arr_eq(result->motion->state, start, sizeof start);
    cr_expect(fabs(result->motion->state[4] - mu) < 1e-13 && fabs(result->motion->end_state[4] - mu) < 1e-13);
    nh_chetaev_motion_free(result);
}

/* The largest violation at the outputs, not the last one: it starts with 0.2 m/s along the rod and is damped. */
Test(chetaev, a_wrong_start_is_seen_in_the_violation)
{
    pendulum_data damped = plain;
    damped.damping = 8.7;
    nh_chetaev_motion *result = swing(damped, 0.2, 2, (double[]){0.2, 0.9}, 1e-9);
    const double *y = result->motion->state + 5;
    double terms = 0; /* x x' + y y' = 0, beside |x| and |y| times the sizes of the velocities: 1, which is the scale, or more */
    for (int i = 0; i < 10; i += 5)
        for (int j = 0; j < 2; j++) terms = fmax(terms, fabs(result->motion->state[i + j]) * fmax(1, fabs(result->motion->state[i + 2 + j])));
    cr_expect_float_eq(result->violation, 0.2 * pendulum_length / terms, 1e-12, "%g", result->violation);
    cr_expect_float_eq(y[0] * y[2] + y[1] * y[3], 0.2 * pendulum_length * exp(-8.7 * 0.7), 1e-7);
    nh_chetaev_motion_free(result);
}

Test(chetaev, times_closer_than_rounding_are_told_and_not_printed, .init = cr_redirect_stderr)
{
    nh_chetaev_motion *result = swing(plain, 0, 2, (double[]){1.0, nextafter(1.0, 2.0)}, 1e-9);
    cr_expect(!result->motion->complete && result->motion->count == 1);
    assert_says(result->motion, "too close");
    nh_chetaev_motion_free(result);
    fflush(stderr);
    cr_assert_stderr_eq_str("");
}

static void assert_refused(const nh_chetaev_problem *problem, const double *initial, const nh_flow_options *options, nh_code code,
                           const char *words)
{
    nh_error error = {0};
    double times[] = {0, 1};
    cr_assert_null(nh_chetaev(problem, initial, 2, times, options, &error));
    cr_expect_eq(error.code, code);
    cr_expect_not_null(strstr(error.what, words), "\"%s\" lacks \"%s\"", error.what, words);
}

Test(chetaev, what_cannot_start_is_an_error)
{
    double start[4], zero[4] = {0};
    pendulum_start(start);
    pendulum_data twice = plain, once = plain, walled = plain;
    twice.times = 2;
    walled.wall = -1;
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = 2, .context = &twice, .terms = pendulum};
    nh_flow_options good = {.rtol = 1e-9}, bad = {.rtol = NAN};
    assert_refused(&problem, start, &good, NH_NUMERIC, "the reciprocal condition number");
    problem.constraints = 1, problem.context = &once;
    assert_refused(&problem, zero, &good, NH_NUMERIC, "the reciprocal condition number");
    assert_refused(&problem, start, &bad, NH_INPUT, "relative tolerance");
    problem.context = &walled;
    assert_refused(&problem, start, &good, NH_NUMERIC, "cannot be evaluated at the initial state");
    nh_chetaev_motion_free(NULL);
}

/* Masses of 1e-16 and of 1e16: the unit of mass must not look like a singular matrix. */
Test(chetaev, the_unit_of_mass_does_not_matter)
{
    double times[] = {0, 0.7}, masses[] = {0.83e-16, 0.83e16}, scaled[2];
    for (int i = 0; i < 2; i++) {
        pendulum_data data = plain;
        data.mass = masses[i];
        nh_chetaev_motion *result = swing(data, 0, 2, times, 1e-9);
        cr_expect(result->motion->complete, "%g: %s", masses[i], result->motion->note);
        scaled[i] = result->motion->state[9] / masses[i];
        nh_chetaev_motion_free(result);
    }
    cr_expect_float_eq(scaled[0], scaled[1], 1e-5, "%g %g", scaled[0], scaled[1]);
    cr_expect_gt(scaled[0], 1);
}

/* Bodies of 1e-12 and 1e12 and one between, coupled in the metric, under weights; y' + z' = 0.  Accelerations are constant: K a = -w - mu (0,1,1). */
static const double unlike_mass[3] = {1.3e-12, 0.7e12, 2.1}, unlike_weight[3] = {0.9, -0.4, 0.3}, unlike_coupling = 0.4;

static bool unlike_bodies(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f, void *context)
{
    (void)t, (void)q, (void)context;
    for (size_t i = 0; i < 3; i++) {
        for (size_t j = 0; j < 3; j++) K[i + 3 * j] = (i == j ? 1 : unlike_coupling) * sqrt(unlike_mass[i] * unlike_mass[j]);
        h[i] = unlike_mass[i] * unlike_weight[i];
        F[i] = i > 0;
    }
    g[0] = 0;
    f[0] = v[1] + v[2];
    return true;
}

/* In velocities sqrt(m_i) v_i the metric is the same for all masses: C b = -h_i/s_i - mu F_i/s_i with b = s_i a_i, C = (1 - c) 1 + c e e^T. */
static double unlike_acceleration(double a[3])
{
    double c = unlike_coupling, x[3], y[3], sum_x = 0, sum_y = 0, above = 0, below = 0, s[3];
    for (size_t i = 0; i < 3; i++) s[i] = sqrt(unlike_mass[i]), x[i] = -s[i] * unlike_weight[i], y[i] = i > 0 ? -1 / s[i] : 0, sum_x += x[i], sum_y += y[i];
    for (size_t i = 0; i < 3; i++) { /* C^-1 = (1 - c e e^T/(1 + 2 c))/(1 - c) */
        x[i] = (x[i] - c * sum_x / (1 + 2 * c)) / (1 - c);
        y[i] = (y[i] - c * sum_y / (1 + 2 * c)) / (1 - c);
        if (i > 0) above += x[i] / s[i], below += y[i] / s[i];
    }
    for (size_t i = 0; i < 3; i++) a[i] = (x[i] - above / below * y[i]) / s[i];
    return -above / below;
}

Test(chetaev, masses_of_very_different_size_are_not_singular)
{
    double times[] = {0, 0.5, 1}, start[6] = {0.1, 0.2, 0.3, 1, 0.5, -0.5}, a[3], mu = unlike_acceleration(a);
    nh_chetaev_problem problem = {.coordinates = 3, .constraints = 1, .terms = unlike_bodies};
    nh_chetaev_motion *result = run(&problem, start, 3, times, 1e-10);
    cr_assert(result->motion->complete, "%s", result->motion->note);
    for (size_t k = 0; k < 3; k++) {
        const double *y = result->motion->state + 7 * k, t = times[k];
        for (size_t i = 0; i < 3; i++) {
            double q = start[i] + start[3 + i] * t + a[i] * t * t / 2;
            cr_expect_float_eq(y[i], q, 1e-7 * (1 + fabs(q)), "coordinate %zu at %g: %g, not %g", i, t, y[i], q);
        }
        cr_expect_float_eq(y[6], mu, 1e-5 * fabs(mu), "multiplier at %g: %g, not %g", t, y[6], mu);
    }
    nh_chetaev_motion_free(result);
}

Test(chetaev, a_wall_in_the_terms_is_reported_and_nothing_is_printed, .init = cr_redirect_stderr)
{
    pendulum_data data = plain;
    data.wall = 1.13;
    nh_chetaev_motion *result = swing(data, 0, 4, (double[]){0, 0.5, 1.0, 1.5}, 1e-9);
    cr_expect(!result->motion->complete && result->motion->count == 3 && result->motion->end_time < 1.13);
    assert_says(result->motion, "cannot be evaluated near t = 1.13");
    cr_expect_lt(result->violation, 1e-6);
    nh_chetaev_motion_free(result);
    fflush(stderr);
    cr_assert_stderr_eq_str("");
}

/* The constraint (1 - t/1.25) (x' - 2.2) = 0 says nothing at t = 1.25: mu = -4.7/(1 - t/1.25) grows without bound, while x is
 * as regular as can be.  Integrators that do not watch mu pass without a word, with mu wrong by 10 % before. */
static bool vanishing(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f,
                      void *context)
{
    (void)q, (void)context;
    double size = 1 - t / 1.25;
    K[0] = K[3] = 1.6, K[1] = K[2] = 0;
    h[0] = 4.7, h[1] = -0.9;
    F[0] = size, F[1] = 0;
    g[0] = -(v[0] - 2.2) / 1.25;
    f[0] = size * (v[0] - 2.2);
    return true;
}

Test(chetaev, a_constraint_that_dies_on_the_way_ends_in_words)
{
    double start[4] = {0, 0, 2.2, 0.1}, times[] = {0, 0.625, 2.5};
    nh_chetaev_problem problem = {.coordinates = 2, .constraints = 1, .terms = vanishing};
    nh_chetaev_motion *result = run(&problem, start, 3, times, 1e-9);
    cr_expect(fabs(result->motion->state[9] + 4.7 * 2) < 1e-6, "%g", result->motion->state[9]);
    cr_expect(!result->motion->complete && result->motion->count == 2, "%zu", result->motion->count);
    assert_says(result->motion, "near t = 1.249");
    assert_says(result->motion, "the reciprocal condition number");
    nh_chetaev_motion_free(result);
}
