/* ball_rank: is a row of values no combination of the rows before it?  By elimination in ball arithmetic: what is
 * left of it then has rigorous bounds. */
#ifndef NH_BALL_RANK_H
#define NH_BALL_RANK_H

#include "exact/ball.h"

/* Rows of `width` expressions, each multiplied by scale[column]; what is left of the last row, relative to its
 * largest entry, as log10 of a lower and an upper bound: a finite lower one proves that the rank grows.  False where
 * something is not finite, the rows before are not known to be independent, or the row vanishes. */
bool nh_ball_rank_left(nh_ball *ball, size_t rows, size_t width, const nh_ex *e, const double *scale,
    double *log10_lower, double *log10_upper);

#endif
