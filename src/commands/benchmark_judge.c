#include "commands/benchmark_judge.h"

#include <float.h>
#include <math.h>
#include <stdlib.h>

enum { least_for_quartiles = 3 };
static const double told = 3; /* times the floor: there an order can be read */

/* ---- times ---- */

static int ascending(const void *a, const void *b)
{
    double x = *(const double *)a, y = *(const double *)b;
    return (x > y) - (x < y);
}

static double at_part(size_t count, const double *sorted, double part)
{
    double place = part * (double)(count - 1);
    size_t below = (size_t)place;
    if (below + 1 >= count) return sorted[count - 1];
    return sorted[below] + (place - (double)below) * (sorted[below + 1] - sorted[below]);
}

nh_judge_spread nh_judge_spread_of(size_t count, double *value)
{
    nh_judge_spread s = {count, NAN, NAN, NAN};
    if (!count) return s;
    qsort(value, count, sizeof *value, ascending);
    s.median = at_part(count, value, 0.5);
    if (count < least_for_quartiles) return s;
    s.low = at_part(count, value, 0.25);
    s.high = at_part(count, value, 0.75);
    return s;
}

/* ---- floor and front ---- */

bool nh_judge_below(double error, double floor) { return error <= floor; }

/* NAN: there is none. */
static double known(const nh_judge_point *p) { return isnan(p->error) ? NAN : fmax(p->error, p->floor); }

void nh_judge_front(size_t count, nh_judge_point *point)
{
    for (size_t i = 0; i < count; i++) {
        nh_judge_point *p = &point[i];
        double mine = known(p);
        p->front = p->counts && isfinite(mine) && isfinite(p->work);
        for (size_t j = 0; j < count && p->front; j++) {
            const nh_judge_point *o = &point[j];
            double other = known(o);
            if (o->counts && o->work <= p->work && other <= mine && (o->work < p->work || other < mine))
                p->front = false;
        }
    }
}

/* ---- orders ---- */

bool nh_judge_tells(double error, double smaller, double floor) { return fmin(error, smaller) > told * floor; }

static double slope(const double *step, const double *error, size_t i, size_t j)
{
    return log(error[i] / error[j]) / log(step[i] / step[j]);
}

/* The first error from number i on that is finite; `count`: none. */
static size_t next(size_t count, const double *error, size_t i)
{
    while (i < count && !(isfinite(error[i]) && error[i] > 0)) i++;
    return i;
}

static bool as_expected(double observed, int expected) { return fabs(observed - expected) <= 0.15 + 0.1 * expected; }

/* Of an order that can be told from `pairs` pairs of steps; `before`: that of the pair with larger steps. */
static nh_order_reason reason_of(int expected, bool smooth, double observed, double before, size_t pairs, bool floored)
{
    if (as_expected(observed, expected)) return NH_ORDER_EXPECTED;
    if (observed > expected) return NH_ORDER_HIGHER;
    if (!smooth) return NH_ORDER_ROUGH;
    if (pairs < 2) return floored ? NH_ORDER_FLOOR : NH_ORDER_LARGE_STEPS;
    if (as_expected(before, expected)) return NH_ORDER_STALLED;
    return observed - before > 0.15 + 0.1 * expected ? NH_ORDER_LARGE_STEPS : NH_ORDER_UNEXPLAINED;
}

static size_t smallest(size_t count, const double *error)
{
    size_t least = count;
    for (size_t i = next(count, error, 0); i < count; i = next(count, error, i + 1))
        if (least == count || error[i] < error[least]) least = i;
    return least;
}

nh_judge_order nh_judge_order_of(int expected, bool smooth, double span, size_t count, const double *step,
                                 const double *error, double floor)
{
    nh_judge_order o = {NAN, NH_ORDER_UNKNOWN};
    double first = NAN, before = NAN;
    size_t pairs = 0, least = smallest(count, error);
    bool floored = false, rounded = false;
    for (size_t i = next(count, error, 0), j; i < count && (j = next(count, error, i + 1)) < count; i = j) {
        double p = slope(step, error, i, j), rounding = DBL_EPSILON * fabs(span / step[j]);
        if (isnan(first)) first = p;
        if (!nh_judge_tells(error[i], error[j], floor)) floored = true;
        else if (!nh_judge_tells(error[i], error[j], rounding)) rounded = true;
        else if (j <= least) {
            before = o.observed;
            o.observed = p;
            pairs++;
        }
    }
    if (pairs) {
        o.reason = reason_of(expected, smooth, o.observed, before, pairs, floored);
    } else if (!isnan(first)) {
        o.observed = first;
        o.reason = as_expected(first, expected) ? NH_ORDER_EXPECTED
                   : floored                    ? NH_ORDER_FLOOR
                   : rounded                    ? NH_ORDER_ROUNDING
                                                : NH_ORDER_UNEXPLAINED;
    }
    return o;
}

const char *nh_judge_order_why(nh_order_reason reason)
{
    static const char *const why[] = {[NH_ORDER_UNKNOWN] = "",
                                      [NH_ORDER_EXPECTED] = "",
                                      [NH_ORDER_HIGHER] = ", more than it promises for every motion",
                                      [NH_ORDER_FLOOR] = ", because the error is at the reference's floor",
                                      [NH_ORDER_ROUNDING] = ", because rounding in so many steps adds up to the error",
                                      [NH_ORDER_STALLED] = ", because at the smallest step it is no longer the step "
                                                           "that limits the error",
                                      [NH_ORDER_ROUGH] = ", because the right-hand side is not smooth",
                                      [NH_ORDER_LARGE_STEPS] = ", because the steps are still too large to show it",
                                      [NH_ORDER_UNEXPLAINED] = ", and nothing that was measured says why"};
    return why[reason];
}
