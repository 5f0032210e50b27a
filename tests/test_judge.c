/* judge: medians and quartiles, floor, front and observed order of numbers that are made so that the answers are known. */
#include <criterion/criterion.h>
#include <float.h>
#include <math.h>
#include <string.h>

#include "commands/benchmark_judge.h"

enum { most = 16 };

/* A method of this order: e = c h^order, and never below `least`. */
static size_t made(double order, double c, double least, size_t levels, double *step, double *error)
{
    for (size_t i = 0; i < levels; i++) {
        step[i] = pow(0.25, (double)i + 1);
        error[i] = fmax(c * pow(step[i], order), least);
    }
    return levels;
}

static nh_judge_order of(int expected, bool smooth, size_t n, const double *step, const double *error, double floor)
{
    return nh_judge_order_of(expected, smooth, 8, n, step, error, floor);
}

/* ---- times ---- */

Test(judge, the_median_does_not_move_with_outliers_of_ten_to_forty)
{
    double time[7] = {1.02, 40, 0.99, 1.00, 10, 1.01, 1.03};
    nh_judge_spread s = nh_judge_spread_of(7, time);
    cr_expect_eq(s.count, 7);
    cr_expect_eq(s.median, 1.02);
    cr_expect_float_eq(s.low, 1.005, 1e-12); /* between the second and the third of 0.99, 1.00, 1.01, .. */
    cr_expect_float_eq(s.high, (1.03 + 10) / 2, 1e-12);
}

Test(judge, quartiles_of_numbers_in_a_row_are_those_of_every_table)
{
    double five[] = {5, 3, 1, 2, 4}, four[] = {4, 1, 3, 2};
    nh_judge_spread s = nh_judge_spread_of(5, five);
    cr_expect(s.low == 2 && s.median == 3 && s.high == 4, "%g %g %g", s.low, s.median, s.high);
    s = nh_judge_spread_of(4, four); /* as R's quantile() and numpy.percentile() */
    cr_expect(s.low == 1.75 && s.median == 2.5 && s.high == 3.25, "%g %g %g", s.low, s.median, s.high);
}

Test(judge, one_time_has_no_spread_and_none_has_no_median)
{
    double one[] = {2}, two[] = {3, 1};
    nh_judge_spread s = nh_judge_spread_of(1, one);
    cr_expect(s.median == 2 && isnan(s.low) && isnan(s.high));
    s = nh_judge_spread_of(2, two);
    cr_expect(s.median == 2 && isnan(s.low));
    cr_expect(isnan(nh_judge_spread_of(0, one).median));
}

/* ---- floor and front ---- */

Test(judge, an_error_of_the_reference_is_below_the_floor_and_a_missing_one_is_not)
{
    cr_expect(nh_judge_below(1e-13, 4e-13) && nh_judge_below(4e-13, 4e-13));
    cr_expect_not(nh_judge_below(5e-13, 4e-13));
    cr_expect_not(nh_judge_below(NAN, 4e-13));
}

/* The same by definition: nobody dominates it. */
static bool dominated(size_t n, const nh_judge_point *p, size_t i)
{
    for (size_t j = 0; j < n; j++) {
        double a = fmax(p[i].error, p[i].floor), b = fmax(p[j].error, p[j].floor);
        if (p[j].counts && ((p[j].work < p[i].work && b <= a) || (p[j].work <= p[i].work && b < a))) return true;
    }
    return false;
}

Test(judge, the_front_holds_what_nothing_beats)
{
    nh_judge_point p[] = {{1e-3, 0, 1, true, false},  {1e-6, 0, 2, true, false},   {1e-6, 0, 3, true, false}, {1e-2, 0, 1.5, true, false},
                          {1e-9, 0, 9, true, false},  {1e-12, 0, 0.5, false, true}, {NAN, 0, 0.1, true, true}, {1e-5, 0, 2, true, false}};
    static const bool front[] = {true, true, false, false, true, false, false, false};
    nh_judge_front(8, p);
    for (size_t i = 0; i < 8; i++) cr_expect_eq(p[i].front, front[i], "%zu", i);
}

Test(judge, ties_are_both_on_the_front)
{
    nh_judge_point p[] = {{1e-6, 0, 2, true, false}, {1e-6, 0, 2, true, false}, {1e-6, 0, 2.1, true, false}};
    nh_judge_front(3, p);
    cr_expect(p[0].front && p[1].front && !p[2].front);
}

Test(judge, below_the_floor_errors_tie_and_the_cheaper_run_wins)
{
    nh_judge_point p[] = {{1e-15, 1e-12, 5, true, false}, {8e-13, 1e-12, 4, true, false}, {1e-11, 1e-12, 1, true, false}};
    nh_judge_front(3, p);
    cr_expect(!p[0].front && p[1].front && p[2].front);
}

Test(judge, the_front_of_many_is_that_of_the_definition)
{
    enum { n = 300 };
    nh_judge_point p[n];
    unsigned long state = 12345;
    for (size_t i = 0; i < n; i++) { /* few different values, so that many tie */
        state = state * 6364136223846793005UL + 1442695040888963407UL;
        double work = (double)(1 + (state >> 40) % 20), part = (double)(state >> 33) / (double)(1UL << 31);
        p[i] = (nh_judge_point){pow(10, -part * 14 * work / 20), 1e-12, work, i % 7 != 0, false};
    }
    nh_judge_front(n, p);
    size_t on = 0;
    for (size_t i = 0; i < n; i++) {
        cr_expect_eq(p[i].front, p[i].counts && !dominated(n, p, i), "%zu", i);
        on += p[i].front;
    }
    cr_expect(on > 3 && on < 60, "%zu", on);
}

/* ---- orders ---- */

Test(judge, a_known_order_is_observed_and_needs_no_remark)
{
    static const int order[] = {1, 2, 4, 6, 8};
    double step[most], error[most];
    for (size_t k = 0; k < 5; k++) {
        size_t n = made(order[k], 1, 0, 3, step, error);
        nh_judge_order o = of(order[k], true, n, step, error, 1e-18);
        cr_expect_float_eq(o.observed, order[k], 1e-9, "%g", o.observed);
        cr_expect_eq(o.reason, NH_ORDER_EXPECTED);
        cr_expect_str_eq(nh_judge_order_why(o.reason), "");
    }
}

/* Steps that are no powers of each other. */
Test(judge, the_order_is_that_of_unequal_steps)
{
    static const double step[] = {0.5, 0.2, 0.03};
    double error[3];
    for (size_t i = 0; i < 3; i++) error[i] = 0.7 * pow(step[i], 3);
    cr_expect_float_eq(of(3, true, 3, step, error, 1e-18).observed, 3, 1e-9);
}

Test(judge, errors_at_the_floor_are_left_out_of_the_order)
{
    double step[most], error[most];
    size_t n = made(4, 1e-3, 1e-10, 6, step, error); /* 4e-6, 1.5e-8, 1e-10, 1e-10, .. */
    nh_judge_order o = of(4, true, n, step, error, 1e-10);
    cr_expect_float_eq(o.observed, 4, 1e-9, "%g", o.observed);
    cr_expect_eq(o.reason, NH_ORDER_EXPECTED);
}

Test(judge, an_order_that_only_the_floor_shows_says_so)
{
    static const double step[] = {0.25, 0.0625, 0.015625}, error[] = {3.5e-13, 1e-13, 1e-13};
    nh_judge_order o = of(8, true, 3, step, error, 1.2e-13);
    cr_expect_float_eq(o.observed, log(3.5) / log(4), 1e-9); /* 0.9 */
    cr_expect_eq(o.reason, NH_ORDER_FLOOR);
    cr_expect_str_eq(nh_judge_order_why(o.reason), ", because the error is at the reference's floor");
    /* one step above it: what is seen of the order is not the order, and the floor is why */
    static const double falls[] = {3e-11, 5e-12, 1e-12};
    o = of(8, true, 3, step, falls, 1e-12);
    cr_expect_float_eq(o.observed, log(6) / log(4), 1e-9);
    cr_expect_eq(o.reason, NH_ORDER_FLOOR);
}

Test(judge, rounding_of_many_steps_is_no_order)
{
    static const double step[] = {8.0 / 4096, 8.0 / 16384, 8.0 / 65536};
    const double error[] = {4096 * DBL_EPSILON, 9000 * DBL_EPSILON, 30000 * DBL_EPSILON}; /* it grows */
    nh_judge_order o = of(8, true, 3, step, error, 1e-18);
    cr_expect(o.observed < 0 && o.reason == NH_ORDER_ROUNDING, "%g, %d", o.observed, o.reason);
}

Test(judge, what_follows_the_smallest_error_is_noise)
{
    static const double step[] = {0.25, 0.0625, 0.015625, 0.00390625};
    static const double rises[] = {1.6e-3, 2.5e-8, 7e-11, 2e-11}, stalls[] = {1e-3, 1e-3 / 256, 1e-3 / 65536, 1e-3 / 65536 / 4};
    static const double after[] = {3e-6, 5e-11, 4e-9, 2e-9}; /* 5e-11, then more */
    nh_judge_order o = of(8, true, 4, step, rises, 1e-18);
    cr_expect(o.reason == NH_ORDER_UNEXPLAINED && o.observed < 1, "%g", o.observed); /* 8, 4.2, 0.9: none of the reasons */
    o = of(4, true, 4, step, stalls, 1e-18);
    cr_expect_float_eq(o.observed, 1, 1e-9);
    cr_expect_eq(o.reason, NH_ORDER_STALLED);
    o = of(8, true, 4, step, after, 1e-18);
    cr_expect_float_eq(o.observed, log(3e-6 / 5e-11) / log(4), 1e-9, "%g", o.observed);
    cr_expect_eq(o.reason, NH_ORDER_EXPECTED);
}

Test(judge, an_order_below_that_of_the_theory_has_its_reason)
{
    double step[most], error[most];
    size_t n = made(1, 1, 0, 4, step, error);
    cr_expect_eq(of(4, false, n, step, error, 1e-18).reason, NH_ORDER_ROUGH);
    cr_expect_eq(of(4, true, n, step, error, 1e-18).reason, NH_ORDER_UNEXPLAINED); /* nothing is invented */
    cr_expect_eq(of(4, true, 2, step, error, 1e-18).reason, NH_ORDER_LARGE_STEPS);
    static const double rising[] = {1, 0.5, 0.05, 0.001}; /* 0.5, 1.66, 2.8 */
    nh_judge_order o = of(4, true, 4, step, rising, 1e-18);
    cr_expect(o.reason == NH_ORDER_LARGE_STEPS && fabs(o.observed - 2.82) < 0.01, "%g", o.observed);
    n = made(4, 1, 0, 3, step, error);
    cr_expect_eq(of(2, true, n, step, error, 1e-18).reason, NH_ORDER_HIGHER);
}

Test(judge, runs_without_an_error_are_passed_over)
{
    static const double step[] = {0.5, 0.25, 0.125, 0.0625}, error[] = {INFINITY, 1e-2, NAN, 1e-2 / 16};
    nh_judge_order o = of(2, true, 4, step, error, 1e-18);
    cr_expect_float_eq(o.observed, 2, 1e-12);
    cr_expect_eq(o.reason, NH_ORDER_EXPECTED);
    o = of(2, true, 2, step, error, 1e-18);
    cr_expect(isnan(o.observed) && o.reason == NH_ORDER_UNKNOWN);
    cr_expect(isnan(of(2, true, 0, step, error, 1e-18).observed));
}
