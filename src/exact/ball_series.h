/* ball_series: Taylor series with rigorous bounds.
 *
 *     f(c + x) = sum_(k < N) a_k x^k + R(x),     R(x) = a_N(xi) x^N for a xi between c and c + x     (Taylor's theorem)
 *
 * The a_k are balls.  The coefficient a_N about all centres of an interval at once contains a_N(xi).  Beside the
 * variable there are functions of it that are defined by others: roots and integrals. */
#ifndef NH_BALL_SERIES_H
#define NH_BALL_SERIES_H

#include "exact/ball.h"

typedef struct nh_ball_series nh_ball_series;

/* symbol^2 = of, with the sign of its value in the ball; or d symbol/d variable = of, with its value there. */
typedef struct {
    nh_ex symbol, of;
    bool integral;
} nh_ball_defined;

/* About the value that the variable has in the ball.  The ball and everything else are borrowed. */
nh_ball_series *nh_ball_series_create(const nh_dag *dag, nh_ball *ball, nh_ex variable, size_t defined,
                                      const nh_ball_defined *define);
void nh_ball_series_free(nh_ball_series *series);

/* The terms below x^degree of each of `count` expressions, one row of `degree` after the other, and bounds of |R| for
 * |x| <= half, which include the rounding of the coefficients to doubles.  False where a bound is not finite, or
 * an e has functions without series. */
bool nh_ball_series_take(nh_ball_series *series, size_t count, const nh_ex *e, size_t degree, double half,
                         double *coefficient, double *bound);

/* Moves the centre to `to` in equal steps no longer than `step`, but at most 1000: the ball gets the values of the
 * variable, the roots and the integrals there, enclosed by series; short steps keep the enclosures small.
 * False where a series does not exist on the way: then the ball has the values of an earlier place. */
bool nh_ball_series_move(nh_ball_series *series, double to, double step);

#endif
