/* ball_rank: is a row of values linearly independent of the rows before it?  By elimination in ball arithmetic: the
 * remainder of the row then has rigorous bounds. */
#ifndef NH_BALL_RANK_H
#define NH_BALL_RANK_H

#include "exact/ball.h"

/* Rows of `width` expressions, each multiplied by scale[column].  Writes log10 of a lower and an upper bound for the
 * remainder of the last row, relative to its largest entry: a finite lower bound proves that the rank grows.  False
 * where something is not finite, the earlier rows are not known to be independent, or the row vanishes. */
bool nh_ball_rank_left(nh_ball *ball, size_t rows, size_t width, const nh_ex *e, const double *scale,
                       double *log10_lower, double *log10_upper);

#endif
