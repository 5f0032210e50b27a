#include "exact/ball_rank.h"

#include <math.h>

#include "base/memory.h"
#include "exact/ball_internal.h"

/* The entry of a row whose distance from zero is certainly the largest; `width` where none is certainly nonzero. */
static size_t pivot_of(size_t width, arb_srcptr row)
{
    size_t best = width;
    double largest = -INFINITY;
    for (size_t j = 0; j < width; j++) {
        double size = nh_ball_log10_lower(row + j);
        if (size <= largest) continue;
        largest = size;
        best = j;
    }
    return best;
}

static void eliminate(size_t rows, size_t width, arb_ptr a, size_t r, size_t pivot, long bits)
{
    arb_t factor;
    arb_init(factor);
    for (size_t i = r + 1; i < rows; i++) {
        arb_div(factor, a + i * width + pivot, a + r * width + pivot, bits);
        for (size_t j = 0; j < width; j++) arb_submul(a + i * width + j, factor, a + r * width + j, bits);
        arb_zero(a + i * width + pivot);
    }
    arb_clear(factor);
}

static void bounds_of(size_t width, arb_srcptr row, double *lower, double *upper)
{
    *lower = *upper = -INFINITY;
    for (size_t j = 0; j < width; j++) {
        *lower = fmax(*lower, nh_ball_log10_lower(row + j));
        *upper = fmax(*upper, nh_ball_log10_upper(row + j));
    }
}

bool nh_ball_rank_left(nh_ball *ball, size_t rows, size_t width, const nh_ex *e, const double *scale,
                       double *log10_lower, double *log10_upper)
{
    long bits = nh_ball_bits(ball);
    arb_ptr a = _arb_vec_init((slong)(rows * width)), last = a + (rows - 1) * width;
    arb_t factor;
    double before_lower, before_upper;
    bool good = true;
    arb_init(factor);
    for (size_t k = 0; k < rows * width && good; k++) {
        good = nh_ball_eval(ball, e[k], a + k);
        arb_set_d(factor, scale[k % width]);
        arb_mul(a + k, a + k, factor, bits);
    }
    if (good) bounds_of(width, last, &before_lower, &before_upper);
    good = good && isfinite(before_lower);
    for (size_t r = 0; r + 1 < rows && good; r++) {
        size_t pivot = pivot_of(width, a + r * width);
        good = pivot < width;
        if (good) eliminate(rows, width, a, r, pivot, bits);
    }
    if (good) {
        bounds_of(width, last, log10_lower, log10_upper);
        *log10_lower -= before_upper;
        *log10_upper -= before_lower;
    }
    arb_clear(factor);
    _arb_vec_clear(a, (slong)(rows * width));
    return good;
}
