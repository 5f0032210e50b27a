/* ball: rigorous evaluation of expressions (Arb).
 *
 * Values are mid-points with rigorous radii.  A number outside of a ball is proved to differ from the value; a ball of
 * radius 1e-60 around zero proves that the value vanishes to 60 digits. */
#ifndef NH_BALL_H
#define NH_BALL_H

#include "graph/expr.h"

/* Values of some symbols, at some precision, and a memo of every evaluated node.  The ball borrows the graph;
 * nh_ball_free. */
typedef struct nh_ball nh_ball;

nh_ball *nh_ball_create(const nh_dag *dag, long bits);
void nh_ball_free(nh_ball *ball);
long nh_ball_bits(const nh_ball *ball);

/* Sets a symbol to the exact rational p/q, or to an exact double; forgets values that depended on it. */
void nh_ball_set_ratio(nh_ball *ball, nh_ex symbol, int64_t p, int64_t q);
void nh_ball_set_double(nh_ball *ball, nh_ex symbol, double value);
/* Sets a symbol to all numbers between two doubles at once. */
void nh_ball_set_between(nh_ball *ball, nh_ex symbol, double low, double high);
/* Sets a symbol to the value of an expression in symbols that are set already; indeterminate when it has none. */
void nh_ball_set_expression(nh_ball *ball, nh_ex symbol, nh_ex value);
/* The same, rounded to the mid-point: for iterations that correct themselves, whose radii would only grow. */
void nh_ball_set_middle(nh_ball *ball, nh_ex symbol, nh_ex value);

/* The value of e.  False when it is not finite there, or a symbol has no value. */
bool nh_ball_value(nh_ball *ball, nh_ex e, double *mid, double *radius);

/* An upper bound of |e| (mid + radius), as log10, so that values below the range of doubles differ; -infinity for an
 * exact zero.  False as above. */
bool nh_ball_log10_bound(nh_ball *ball, nh_ex e, double *log10_bound);

/* Is the value certainly not 0?  False as above, too. */
bool nh_ball_excludes_zero(nh_ball *ball, nh_ex e);

/* log10( |sum_i term[i]| / max_i |term[i]| ), both bounded rigorously: minus the number of digits to which the sum
 * vanishes.  False as above, or when every term is zero. */
bool nh_ball_relative_sum(nh_ball *ball, size_t n, const nh_ex *term, double *log10_ratio);

#endif
