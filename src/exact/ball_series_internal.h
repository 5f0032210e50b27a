/* ball_series_internal: functions of power series that FLINT does not have, and a table of those that it has. */
#ifndef NH_BALL_SERIES_INTERNAL_H
#define NH_BALL_SERIES_INTERNAL_H

#include "evaluate/arb.h"
#include "graph/function.h"

/* Applies the function to p, in place, below x^terms.  Where it has a kink or a pole, or is not defined, coefficients
 * are not finite, or the answer is false.  False also for a function without series here. */
bool nh_ball_series_function(nh_function f, arb_poly_t p, slong terms, slong bits);
/* y := the angle of (x, y); false on its branch cut. */
bool nh_ball_series_angle(arb_poly_t y, const arb_poly_t x, slong terms, slong bits);
/* p := p^(halves n/2); false, with p unchanged, when n is too large. */
bool nh_ball_series_half_power(arb_poly_t p, int64_t n, int64_t halves, slong terms, slong bits);
/* p := p^x */
void nh_ball_series_power(arb_poly_t p, const arb_poly_t x, slong terms, slong bits);

#endif
