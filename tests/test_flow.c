/* Motions with closed forms, and every way a motion can end early. */
#include <criterion/criterion.h>
#include <criterion/redirect.h>

#include <math.h>
#include <string.h>

#include "motion/integrators.h"

/* ---- systems ---- */

static const double sleigh_a = 1.0, sleigh_k = 2.0, sleigh_omega = 2.0;
static long rate_calls;
static double latest_time;

/* State (omega, v, phi, x, y). */
static bool sleigh(double t, const double *z, double *rate, void *context)
{
    (void)context;
    rate_calls++, latest_time = fmax(latest_time, t);
    rate[0] = -z[0] * z[1] / (sleigh_a * sleigh_k * sleigh_k);
    rate[1] = sleigh_a * z[0] * z[0];
    rate[2] = z[0];
    rate[3] = z[1] * cos(z[2]);
    rate[4] = z[1] * sin(z[2]);
    return true;
}

/* omega, v, phi of the sleigh that starts with v = 0, phi = 0:  z = omega0 t / k. */
static void sleigh_exact(double t, double *omega, double *v, double *phi)
{
    double z = sleigh_omega * t / sleigh_k;
    *omega = sleigh_omega / cosh(z);
    *v = sleigh_a * sleigh_k * sleigh_omega * tanh(z);
    *phi = 2 * sleigh_k * atan(tanh(z / 2));
}

/* The same sleigh in the chart (phi', x'), which ends where cos phi = 0.  State (phi', x', phi). */
static bool sleigh_chart(double t, const double *z, double *rate, void *context)
{
    (void)t, (void)context;
    double c = cos(z[2]);
    rate[0] = -z[0] * z[1] / (sleigh_a * sleigh_k * sleigh_k * c);
    rate[1] = sleigh_a * z[0] * z[0] * c - z[0] * z[1] * tan(z[2]);
    rate[2] = z[0];
    return true;
}

static bool heading_pivot(double t, const double *z, double *value, void *context)
{
    (void)t, (void)context;
    value[0] = 7.25; /* one guard that never acts, before the one that does */
    value[1] = cos(z[2]);
    return true;
}

static bool broken_guard(double t, const double *z, double *value, void *context)
{
    (void)z, (void)context;
    value[0] = 3.7;
    return t < 1.35;
}

typedef struct {
    double frequency, wall;      /* the rate is refused from the wall's time on */
    bool silent, wrong_jacobian; /* silent: the wall gives NaN and claims success */
    long jacobian_calls;
} oscillator_data;

static bool oscillator(double t, const double *z, double *rate, void *context)
{
    const oscillator_data *data = context;
    double w = data->frequency;
    rate[0] = w * z[1];
    rate[1] = t < data->wall ? -w * z[0] : NAN;
    return t < data->wall || data->silent;
}

static bool oscillator_jacobian(double t, const double *z, double *jacobian, void *context)
{
    (void)t, (void)z;
    oscillator_data *data = context;
    data->jacobian_calls++;
    jacobian[0] = jacobian[3] = 0;
    jacobian[1] = -data->frequency; /* row 1, column 0 */
    jacobian[2] = data->frequency;
    if (data->wrong_jacobian)
        jacobian[0] = INFINITY;
    return true;
}

static bool blow_up(double t, const double *z, double *rate, void *context)
{
    (void)t, (void)context;
    rate[0] = z[0] * z[0];
    return true;
}

static bool decay(double t, const double *z, double *rate, void *context)
{
    (void)context;
    rate[0] = -1300.0 * (z[0] - cos(t)) - sin(t); /* solution cos t, stiff */
    return true;
}

static const nh_flow_problem sleigh_problem = {.size = 5, .rate = sleigh};
static const double sleigh_start[5] = {2.0, 0, 0, 0, 0};
static const double oscillator_start[2] = {0.731, -1.207};

static void grid(size_t count, double from, double to, double *times)
{
    for (size_t i = 0; i < count; i++)
        times[i] = from + (to - from) * (double)i / (double)(count - 1);
    times[count - 1] = to;
}

static nh_motion *run(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                      const nh_flow_options *options)
{
    nh_error error = {0};
    nh_motion *motion = nh_cvode(problem, initial, count, times, options, &error);
    cr_assert(motion && error.code == NH_OK, "%s", error.what);
    return motion;
}

static void assert_says(const nh_motion *motion, const char *words)
{
    cr_expect_not_null(strstr(motion->note, words), "the note \"%s\" lacks \"%s\"", motion->note, words);
}

/* ---- accuracy ---- */

static double sleigh_error(nh_flow_method method, double rtol, double end)
{
    enum { COUNT = 38 };
    double times[COUNT], worst = 0;
    grid(COUNT, 0, end, times);
    nh_flow_options options = {.method = method, .rtol = rtol};
    nh_motion *motion = run(&sleigh_problem, sleigh_start, COUNT, times, &options);
    cr_assert(motion->complete && motion->count == COUNT && motion->note[0] == '\0');
    for (size_t i = 0; i < COUNT; i++) {
        double omega, v, phi;
        const double *z = motion->state + i * 5;
        cr_assert_eq(motion->time[i], times[i]);
        sleigh_exact(times[i], &omega, &v, &phi);
        worst = fmax(worst, fmax(fabs(z[0] - omega), fmax(fabs(z[1] - v), fabs(z[2] - phi))));
    }
    nh_motion_free(motion);
    return worst;
}

Test(flow, the_error_falls_with_the_tolerance)
{
    for (nh_flow_method method = NH_ADAMS; method <= NH_BDF; method++) {
        double loose = sleigh_error(method, 1e-6, 10), middle = sleigh_error(method, 1e-8, 10);
        double tight = sleigh_error(method, 1e-10, 10);
        cr_expect(1e-9 < loose && loose < 1e-4, "%g", loose);
        cr_expect_lt(middle, loose / 10, "%g %g", loose, middle);
        cr_expect(tight < middle / 10 && tight < 1e-8, "%g %g", middle, tight);
    }
}

Test(flow, a_long_sleigh_stays_cheap)
{
    rate_calls = 0;
    cr_expect_lt(sleigh_error(NH_ADAMS, 1e-10, 1000), 1e-7);
    cr_expect_lt(rate_calls, 3000, "%ld evaluations: has the iteration become the limit?", rate_calls);
}

Test(flow, the_rate_is_not_asked_beyond_the_last_time)
{
    latest_time = 0;
    sleigh_error(NH_ADAMS, 1e-8, 6.125);
    cr_expect(6.0 < latest_time && latest_time <= 6.125, "%.17g", latest_time);
}

static void check_oscillator(const nh_flow_problem *problem, nh_flow_method method, double bound)
{
    const oscillator_data *data = problem->context;
    double times[] = {-0.4, -0.4, 0.113, 2.0, 2.0, 9.731}; /* repeated times are allowed */
    nh_flow_options options = {.method = method, .rtol = 1e-11};
    nh_motion *motion = run(problem, oscillator_start, 6, times, &options);
    cr_assert(motion->complete, "%s", motion->note);
    for (size_t i = 0; i < 6; i++) {
        double angle = data->frequency * (times[i] - times[0]), c = cos(angle), s = sin(angle);
        double x = c * oscillator_start[0] + s * oscillator_start[1], y = c * oscillator_start[1] - s * oscillator_start[0];
        cr_expect_leq(hypot(motion->state[2 * i] - x, motion->state[2 * i + 1] - y), bound);
    }
    cr_expect(motion->end_time == times[5] && motion->guard_hit == -1);
    cr_expect_arr_eq(motion->end_state, motion->state + 10, 2 * sizeof(double));
    cr_expect(motion->steps > 10 && motion->evaluations >= motion->steps && motion->seconds > 0 && motion->jacobians > 0);
    nh_motion_free(motion);
}

Test(flow, oscillator_with_and_without_a_jacobian)
{
    oscillator_data data = {.frequency = 2.385, .wall = INFINITY};
    nh_flow_problem problem = {.size = 2, .rate = oscillator, .context = &data};
    check_oscillator(&problem, NH_ADAMS, 2e-9);
    check_oscillator(&problem, NH_BDF, 2e-8);
    cr_expect_eq(data.jacobian_calls, 0);
    problem.jacobian = oscillator_jacobian;
    check_oscillator(&problem, NH_ADAMS, 2e-9);
    check_oscillator(&problem, NH_BDF, 2e-8);
    cr_expect_gt(data.jacobian_calls, 2);
}

Test(flow, forward_and_back_again)
{
    nh_flow_options options = {.method = NH_ADAMS, .rtol = 1e-12};
    double there[] = {0.3, 1.1, 3.7}, back[] = {3.7, 2.9, 1.1, 0.3};
    double start[5] = {1.379, -0.416, 0.253, 2.71, -1.62};
    nh_motion *forward = run(&sleigh_problem, start, 3, there, &options);
    nh_motion *backward = run(&sleigh_problem, forward->state + 10, 4, back, &options);
    cr_assert(backward->complete, "%s", backward->note);
    for (size_t j = 0; j < 5; j++) {
        cr_expect_float_eq(backward->state[15 + j], start[j], 1e-9, "%zu: %g", j, backward->state[15 + j] - start[j]);
        cr_expect_float_eq(backward->state[10 + j], forward->state[5 + j], 1e-9);
        cr_expect_gt(fabs(backward->state[j] - start[j]), 1e-3, "nothing moved");
    }
    nh_motion_free(forward);
    nh_motion_free(backward);
}

Test(flow, stiff_decay_is_cheap_with_bdf)
{
    nh_flow_problem problem = {.size = 1, .rate = decay};
    nh_flow_options options = {.method = NH_BDF, .rtol = 1e-8};
    nh_motion *motion = run(&problem, (double[]){1.0}, 2, (double[]){0, 7.3}, &options);
    cr_expect(motion->complete);
    cr_expect_float_eq(motion->state[1], cos(7.3), 1e-6);
    long steps = motion->steps;
    nh_motion_free(motion);
    options.method = NH_ADAMS;
    motion = run(&problem, (double[]){1.0}, 2, (double[]){0, 7.3}, &options);
    cr_expect_gt(motion->steps, 5 * steps, "%ld %ld", motion->steps, steps);
    nh_motion_free(motion);
}

static double small_oscillation_error(const double *scale, long *steps)
{
    oscillator_data data = {.frequency = 1.713, .wall = INFINITY};
    nh_flow_problem problem = {.size = 2, .rate = oscillator, .context = &data};
    nh_flow_options options = {.method = NH_BDF, .rtol = 1e-6, .scale = scale};
    double start[] = {3.1e-5, 0}, times[] = {0, 5.37};
    nh_motion *motion = run(&problem, start, 2, times, &options);
    double error = fabs(motion->state[2] / start[0] - cos(1.713 * 5.37));
    *steps = motion->steps;
    nh_motion_free(motion);
    return error;
}

/* A motion of size 1e-5 is not seen by an absolute tolerance of 1e-6, but by one of 1e-6 times its size. */
Test(flow, the_scale_sets_the_absolute_tolerance)
{
    long steps_plain, steps_scaled;
    double plain = small_oscillation_error(NULL, &steps_plain);
    double scaled = small_oscillation_error((double[]){3.1e-5, 3.1e-5}, &steps_scaled);
    cr_expect(scaled < 3e-4 && plain > 20 * scaled, "%g %g", plain, scaled);
    cr_expect_gt(steps_scaled, 2 * steps_plain, "%ld %ld", steps_scaled, steps_plain);
}

/* ---- events ---- */

Test(flow, a_pivot_that_changes_sign_ends_the_motion)
{
    double times[11], start[3] = {sleigh_omega, 0, 0}, right = acos(-1.0) / 2;
    double crossing = 2 * atanh(tan(right / (2 * sleigh_k))) * sleigh_k / sleigh_omega; /* phi = pi/2 */
    grid(11, 0, 2, times);
    nh_flow_problem problem = {.size = 3, .rate = sleigh_chart, .guards = 2, .guard = heading_pivot};
    for (nh_flow_method method = NH_ADAMS; method <= NH_BDF; method++) {
        nh_flow_options options = {.method = method, .rtol = 1e-10};
        nh_motion *motion = run(&problem, start, 11, times, &options);
        cr_expect(!motion->complete && motion->guard_hit == 1 && motion->count == 5, "0, .2, .4, .6, .8 come before %g", crossing);
        cr_expect_float_eq(motion->end_time, crossing, 1e-6, "%g", motion->end_time - crossing);
        cr_expect_float_eq(motion->end_state[2], right, 1e-6);
        assert_says(motion, "guard 2 falls through zero at t = 0.881");
        for (size_t i = 0; i < motion->count; i++) {
            double omega, v, phi;
            sleigh_exact(motion->time[i], &omega, &v, &phi);
            cr_expect_leq(hypot(motion->state[3 * i + 2] - phi, motion->state[3 * i + 1] - v * cos(phi)), 1e-7);
        }
        nh_motion_free(motion);
    }
}

static bool first_coordinate(double t, const double *z, double *value, void *context)
{
    (void)t, (void)context;
    value[0] = z[0];
    return true;
}

/* x = cos(w t): a guard that is zero at the start acts only at the next crossing, forward and backward in time. */
Test(flow, guards_backward_and_zero_at_the_start)
{
    oscillator_data data = {.frequency = 1.713, .wall = INFINITY};
    nh_flow_problem problem = {.size = 2, .rate = oscillator, .context = &data, .guards = 1, .guard = first_coordinate};
    nh_flow_options options = {.rtol = 1e-11};
    double half = acos(-1.0) / data.frequency, top[] = {1, 0}, zero[] = {0, 1}, back[] = {0, -9}, forth[] = {0, 9};
    nh_motion *motion = run(&problem, top, 2, back, &options);
    cr_expect(motion->guard_hit == 0 && fabs(motion->end_time + half / 2) < 1e-8);
    nh_motion_free(motion);
    motion = run(&problem, zero, 2, forth, &options);
    cr_expect(motion->guard_hit == 0 && fabs(motion->end_time - half) < 1e-8);
    assert_says(motion, "guard 1 falls");
    nh_motion_free(motion);
}

Test(flow, a_guard_that_cannot_be_computed_is_told)
{
    nh_flow_problem problem = {.size = 5, .rate = sleigh, .guards = 1, .guard = broken_guard};
    nh_motion *motion = run(&problem, sleigh_start, 3, (double[]){0, 1, 2}, &(nh_flow_options){.rtol = 1e-9});
    cr_expect(!motion->complete && motion->count == 2 && motion->guard_hit == -1);
    assert_says(motion, "the guard cannot be evaluated near t = 1.");
    nh_motion_free(motion);
}

/* ---- ends that are nobody's wish ---- */

Test(flow, a_wall_in_the_rate_is_reported_and_nothing_is_printed, .init = cr_redirect_stderr)
{
    for (int variant = 0; variant < 4; variant++) {
        oscillator_data data = {.frequency = 2.385, .wall = 1.618, .silent = variant & 1};
        nh_flow_problem problem = {.size = 2, .rate = oscillator, .context = &data};
        nh_flow_options options = {.method = variant & 2 ? NH_BDF : NH_ADAMS, .rtol = 1e-9};
        double times[] = {0, 0.5, 1.0, 1.5, 2.0, 2.5};
        nh_motion *motion = run(&problem, oscillator_start, 6, times, &options);
        cr_expect(!motion->complete && motion->count == 4 && motion->end_time > 1.5 && motion->end_time < 1.618);
        assert_says(motion, "the right-hand side cannot be evaluated near t = 1.61");
        for (size_t i = 0; i < 2 * motion->count; i++)
            cr_expect(isfinite(motion->state[i]));
        nh_motion_free(motion);
    }
    fflush(stderr);
    cr_assert_stderr_eq_str("");
}

Test(flow, a_solution_that_blows_up_ends_in_words)
{
    nh_flow_problem problem = {.size = 1, .rate = blow_up};
    double start = 0.8, times[] = {0, 1.2, 1.249, 3.0}; /* 1 / (1.25 - t) */
    for (nh_flow_method method = NH_ADAMS; method <= NH_BDF; method++) {
        nh_flow_options options = {.method = method, .rtol = 1e-10};
        nh_motion *motion = run(&problem, &start, 4, times, &options);
        cr_expect(!motion->complete && motion->count == 3, "%zu", motion->count);
        cr_expect(fabs(motion->state[1] - 20) < 1e-5 && fabs(motion->state[2] - 1000) < 0.1);
        assert_says(motion, "t = 1.2499999");
        assert_says(motion, "singular");
        cr_expect(isfinite(motion->end_state[0]));
        nh_motion_free(motion);
    }
}

Test(flow, a_jacobian_that_is_not_finite_is_named)
{
    oscillator_data data = {.frequency = 2.385, .wall = INFINITY, .wrong_jacobian = true};
    nh_flow_problem problem = {.size = 2, .rate = oscillator, .jacobian = oscillator_jacobian, .context = &data};
    nh_flow_options options = {.method = NH_BDF, .rtol = 1e-9};
    nh_motion *motion = run(&problem, oscillator_start, 2, (double[]){0, 1}, &options);
    cr_expect(!motion->complete && motion->count == 1);
    assert_says(motion, "the Jacobian of the right-hand side cannot be evaluated near t = ");
    nh_motion_free(motion);
}

Test(flow, the_limit_of_steps_is_exact)
{
    nh_flow_options options = {.rtol = 1e-9, .max_steps = 37};
    double times[] = {0, 0.01, 500};
    nh_motion *motion = run(&sleigh_problem, sleigh_start, 3, times, &options);
    cr_expect(!motion->complete && motion->count == 2 && motion->steps == 37, "%ld", motion->steps);
    assert_says(motion, "limit of 37 steps");
    cr_expect(motion->end_time > 0.01 && motion->end_time < 500);
    double omega, v, phi;
    sleigh_exact(motion->end_time, &omega, &v, &phi);
    cr_expect_float_eq(motion->end_state[2], phi, 1e-6);
    nh_motion_free(motion);
}

static bool at_the_third_call(void *context)
{
    return ++*(int *)context == 3;
}

Test(flow, cancelling_keeps_what_was_reached)
{
    int calls = 0;
    nh_flow_options options = {.rtol = 1e-9, .cancelled = at_the_third_call, .cancel_context = &calls};
    double times[] = {0, 1e-9, 100};
    nh_motion *motion = run(&sleigh_problem, sleigh_start, 3, times, &options);
    cr_expect(!motion->complete && motion->steps == 2 && motion->count == 2, "%zu %ld", motion->count, motion->steps);
    assert_says(motion, "cancelled");
    nh_motion_free(motion);
}

Test(flow, a_tolerance_below_rounding_is_raised_and_told)
{
    nh_motion *motion = run(&sleigh_problem, sleigh_start, 2, (double[]){0, 1.25}, &(nh_flow_options){.rtol = 1e-17});
    double omega, v, phi;
    sleigh_exact(1.25, &omega, &v, &phi);
    cr_expect(motion->complete && fabs(motion->state[5 + 2] - phi) < 1e-12, "%s", motion->note);
    assert_says(motion, "1e-14 was used");
    nh_motion_free(motion);
}

Test(flow, one_time_needs_no_evaluation_and_two_may_be_too_close)
{
    nh_flow_options options = {.rtol = 1e-9};
    double time = 4.75;
    rate_calls = 0;
    nh_motion *motion = run(&sleigh_problem, sleigh_start, 1, &time, &options);
    cr_expect(motion->complete && motion->count == 1 && motion->time[0] == 4.75 && motion->end_time == 4.75);
    cr_expect_arr_eq(motion->state, sleigh_start, sizeof sleigh_start);
    nh_motion_free(motion);
    motion = run(&sleigh_problem, sleigh_start, 2, (double[]){4.75, 4.75}, &options);
    cr_expect(motion->complete && motion->count == 2 && motion->state[5] == sleigh_start[0]);
    cr_expect_eq(rate_calls, 0);
    nh_motion_free(motion);
    motion = run(&sleigh_problem, sleigh_start, 2, (double[]){1.0, nextafter(1.0, 2.0)}, &options);
    cr_expect(!motion->complete && motion->count == 1);
    assert_says(motion, "too close together");
    nh_motion_free(motion);
}

static void assert_refused(const nh_flow_problem *problem, const double *initial, size_t count, const double *times,
                           const nh_flow_options *options, nh_code code, const char *words)
{
    nh_error error = {0};
    cr_assert_null(nh_cvode(problem, initial, count, times, options, &error));
    cr_expect_eq(error.code, code);
    cr_expect_not_null(strstr(error.what, words), "\"%s\" lacks \"%s\"", error.what, words);
}

/* Runge-Kutta pairs, implicit and explicit ones, name the right-hand side, too. */
Test(flow, no_method_starts_where_there_is_no_rate)
{
    static const nh_arkode_method methods[] = {NH_DORMAND_PRINCE_5, NH_VERNER_6, NH_FEHLBERG_8, NH_ESDIRK_5};
    oscillator_data data = {.frequency = 2.385, .wall = -1};
    nh_flow_problem walled = {.size = 2, .rate = oscillator, .context = &data};
    nh_flow_options good = {.rtol = 1e-9};
    const double times[] = {0, 1};
    for (size_t i = 0; i < sizeof methods / sizeof *methods; i++) {
        nh_error error = {0};
        cr_assert_null(nh_arkode(methods[i], &walled, oscillator_start, 2, times, &good, &error));
        cr_expect_eq(error.code, NH_NUMERIC);
        cr_expect_not_null(strstr(error.what, "right-hand side cannot be evaluated at the initial"), "%s", error.what);
    }
}

Test(flow, what_cannot_start_is_an_error)
{
    oscillator_data data = {.frequency = 2.385, .wall = -1};
    nh_flow_problem walled = {.size = 2, .rate = oscillator, .context = &data}, empty = {.size = 0, .rate = oscillator};
    nh_flow_options good = {.rtol = 1e-9}, zero = {.rtol = 0}, bad = {.rtol = 1e-9, .scale = (double[]){1, -2.5}};
    double times[] = {0, 1, 0.5}, endless[] = {0, INFINITY}, infinite[] = {1.5, NAN};
    assert_refused(&walled, oscillator_start, 2, times, &good, NH_NUMERIC, "right-hand side cannot be evaluated at the initial");
    assert_refused(&walled, infinite, 2, times, &good, NH_NUMERIC, "initial value of state 2 is not a finite");
    assert_refused(&walled, oscillator_start, 3, times, &good, NH_INPUT, "time 3 is 0.5 after 1");
    assert_refused(&walled, oscillator_start, 2, endless, &good, NH_INPUT, "not a finite number");
    assert_refused(&walled, oscillator_start, 0, times, &good, NH_INPUT, "at least one output time");
    assert_refused(&walled, oscillator_start, 2, times, &zero, NH_INPUT, "relative tolerance must be a positive number, not 0");
    assert_refused(&walled, oscillator_start, 2, times, &bad, NH_INPUT, "scale of state 2 must be a positive number, not -2.5");
    assert_refused(&empty, oscillator_start, 2, times, &good, NH_INPUT, "at least one state");
    nh_motion_free(NULL);
}
