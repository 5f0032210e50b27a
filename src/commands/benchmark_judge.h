/* benchmark_judge: what measured numbers say, and nothing else: no clock, no system.
 *
 *     times    median and quartiles of repeated runs, because single times are off by 10 to 40 now and then
 *     floor    an error up to that of the reference is not told apart from it
 *     front    the runs than which none is both cheaper and more accurate (Pareto's front)
 *     order    the observed order of convergence beside that of the theory, and why they differ */
#ifndef NH_BENCHMARK_JUDGE_H
#define NH_BENCHMARK_JUDGE_H

#include <stdbool.h>
#include <stddef.h>

typedef struct {
    size_t count;
    double low, median, high; /* quartiles: NAN for fewer than three values; median: NAN for none */
} nh_judge_spread;

/* Sorts the values, which are finite.  Quartile p lies at place p (n - 1) of the sorted values, counted from 0, with
 * linear interpolation. */
nh_judge_spread nh_judge_spread_of(size_t count, double *value);

/* An error that is no larger than that of the reference. */
bool nh_judge_below(double error, double floor);

typedef struct {
    double error, floor, work;
    bool counts; /* only such points are compared */
    bool front;  /* the answer */
} nh_judge_point;

/* Marks the points than which none has both less work and a smaller error, one of them strictly; errors below the floor
 * count as the floor, so that they tie.  Points that agree in both are both on the front. */
void nh_judge_front(size_t count, nh_judge_point *point);

typedef enum {
    NH_ORDER_UNKNOWN, /* fewer than two errors */
    NH_ORDER_EXPECTED,
    NH_ORDER_HIGHER,
    NH_ORDER_FLOOR,       /* the errors are those of the reference */
    NH_ORDER_ROUNDING,    /* as many steps lose as much by rounding */
    NH_ORDER_STALLED,     /* larger steps showed the order, the smallest one no longer does */
    NH_ORDER_ROUGH,       /* the right-hand side is not smooth */
    NH_ORDER_LARGE_STEPS, /* it still rises from step to step, or there is only one pair of steps */
    NH_ORDER_UNEXPLAINED
} nh_order_reason;

typedef struct {
    double observed; /* NAN: unknown */
    nh_order_reason reason;
} nh_judge_order;

/* The errors of a method of this order for steps that fall, over a motion as long as `span`; an error that is not
 * finite is left out.  Observed is log(e/e') / log(h/h') of the two smallest steps whose errors are three times the
 * floor and three times what rounding may add up to, epsilon span / h; where there are no two such, of the two largest
 * steps.  Steps below that with the smallest error say nothing.  An order is as expected within 0.15 and a tenth of
 * it. */
nh_judge_order nh_judge_order_of(int expected, bool smooth, double span, size_t count, const double *step,
                                 const double *error, double floor);

/* May log(e/e') / log(h/h') be told from the floor? */
bool nh_judge_tells(double error, double smaller, double floor);

/* ", because the error is at the reference's floor"; "" where the order is as expected. */
const char *nh_judge_order_why(nh_order_reason reason);

#endif
