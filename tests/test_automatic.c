/* The method that suits: the explicit pair where equations are not stiff, CVODE BDF where they are, and events at guards all the same. */
#include <criterion/criterion.h>
#include <math.h>
#include <string.h>

#include "motion/automatic.h"

typedef struct {
    double rate, wave; /* x' = -rate (x - cos t), and an oscillator of frequency `wave` beside it */
    long evaluations;
} relaxing;

static bool relax(double t, const double *z, double *rate, void *context)
{
    relaxing *r = context;
    r->evaluations++;
    rate[0] = -r->rate * (z[0] - cos(t));
    rate[1] = z[2];
    rate[2] = -r->wave * r->wave * z[1];
    return true;
}

static bool at_half(double t, const double *z, double *value, void *context)
{
    (void)t, (void)context;
    value[0] = z[1] - 0.5;
    return true;
}

static nh_motion *moved(relaxing *r, double until, double effort, bool guarded, const nh_method **used)
{
    static const double start[] = {1, 1, 0};
    double times[] = {0, until / 2, until};
    nh_error error = {0};
    nh_flow_problem problem = {.size = 3, .context = r, .rate = relax, .guards = guarded, .guard = guarded ? at_half : NULL};
    nh_flow_options options = {.rtol = 1e-9, .absolute = 1e-3, .effort = effort, .early = true};
    nh_motion *motion = nh_automatic(&problem, start, 3, times, &options, used, &error);
    cr_assert_not_null(motion, "%s", error.what);
    return motion;
}

Test(automatic, equations_that_are_not_stiff_keep_the_pair)
{
    relaxing r = {.rate = 1, .wave = 2};
    const nh_method *used;
    nh_motion *motion = moved(&r, 20, 0, false, &used);
    cr_expect_str_eq(used->name, "GSL rk8pd");
    cr_expect(motion->complete && fabs(motion->state[2 * 3 + 1] - cos(40)) < 1e-7, "%g", motion->state[2 * 3 + 1] - cos(40));
    nh_motion_free(motion);
}

/* x follows the slow manifold x = (r^2 cos t + r sin t)/(r^2 + 1) after a time of 1/r. */
Test(automatic, stiff_equations_go_to_bdf)
{
    relaxing r = {.rate = 1e6, .wave = 0.1};
    const nh_method *used;
    nh_motion *motion = moved(&r, 40, 0, false, &used);
    double exact = (r.rate * r.rate * cos(40) + r.rate * sin(40)) / (r.rate * r.rate + 1);
    cr_expect_str_eq(used->name, "CVODE BDF");
    cr_expect(motion->complete && fabs(motion->state[2 * 3] - exact) < 1e-6, "%g", motion->state[2 * 3] - exact);
    cr_expect(motion->evaluations > 0.99 * (double)r.evaluations, "%ld of %ld evaluations are counted", motion->evaluations, r.evaluations); /* but for Jacobians by differences */
    nh_motion_free(motion);
}

/* Long, but an oscillation that BDF has to follow as well: the pair goes on, from where it is. */
Test(automatic, a_long_motion_is_not_taken_for_a_stiff_one)
{
    relaxing r = {.rate = 1, .wave = 20};
    const nh_method *used;
    nh_motion *motion = moved(&r, 6000, 0, false, &used);
    cr_expect_str_eq(used->name, "GSL rk8pd");
    cr_expect(motion->complete && motion->effort > nh_automatic_quick, "%g units, %ld evaluations", motion->effort, motion->evaluations);
    cr_expect_lt(fabs(motion->state[2 * 3 + 1] - cos(20.0 * 6000)), 1e-3);
    nh_motion_free(motion);
}

Test(automatic, a_guard_ends_the_motion)
{
    relaxing r = {.rate = 1, .wave = 1};
    nh_motion *motion = moved(&r, 10, 0, true, NULL);
    cr_expect(!motion->complete && motion->guard_hit == 0 && fabs(motion->end_time - acos(0.5)) < 1e-4, "%g", motion->end_time);
    nh_motion_free(motion);
}

Test(automatic, a_limit_of_work_ends_both)
{
    relaxing r = {.rate = 1e6, .wave = 0.1};
    nh_motion *motion = moved(&r, 1e6, 1e6, false, NULL);
    cr_expect(!motion->complete && strstr(motion->note, "counted operations"), "%s", motion->note);
    nh_motion_free(motion);
}

/* Dry friction on a disk, z its velocity: when it has come to rest the steps only go around z = 0. */
static bool chatter(double t, const double *z, double *rate, void *context)
{
    (void)t, (void)context;
    double size = hypot(z[0], z[1]);
    rate[0] = -z[0] / size;
    rate[1] = -z[1] / size;
    return true;
}

/* What would take a thousand times what is allowed ends after a small part of it; what is half as long as it would have to be does not. */
Test(automatic, a_motion_that_hardly_advances_ends_early)
{
    static const double start[] = {0.3, 0.4}, times[] = {0, 1000};
    nh_error error = {0};
    nh_flow_problem problem = {.size = 2, .rate = chatter};
    nh_flow_options options = {.rtol = 1e-7, .absolute = 1, .effort = 1e8, .early = true};
    nh_motion *motion = nh_method_flow(nh_method_find("GSL rk8pd"), &problem, start, 2, times, &options, &error);
    cr_assert_not_null(motion, "%s", error.what);
    cr_expect(!motion->complete && motion->limited && strstr(motion->note, "hardly advances at t = 0.5"), "%s", motion->note);
    cr_expect_lt(motion->effort, options.effort / 8);
    nh_motion_free(motion);
    relaxing r = {.rate = 1, .wave = 20};
    motion = moved(&r, 1000, 0, false, NULL);
    double half = motion->effort / 2;
    nh_motion_free(motion);
    motion = moved(&r, 1000, half, false, NULL);
    cr_expect(!motion->complete && strstr(motion->note, "was reached at") && motion->effort >= half, "%s", motion->note);
    nh_motion_free(motion);
}
