/* ball_internal: declarations for ball*.c, with Arb's numbers. */
#ifndef NH_BALL_INTERNAL_H
#define NH_BALL_INTERNAL_H

#include "exact/ball.h"
#include "exact/ball_arb.h"

/* Converts a number of the graph, to the ball's bits. */
void nh_ball_set_number(const nh_ball *ball, arb_t out, nh_num c);

/* Products of words in a product of two numbers of so many bits; numbers count as longer, for the other operations on
 * them. */
double nh_ball_products(long bits);

/* log10 of rigorous bounds of |v|. */
double nh_ball_log10_upper(const arb_t v);
double nh_ball_log10_lower(const arb_t v);

#endif
