/* ball_arb: a ball's values as Arb's numbers, for linear algebra in balls. */
#ifndef NH_BALL_ARB_H
#define NH_BALL_ARB_H

#include "evaluate/arb.h"
#include "graph/expr.h"

typedef struct nh_ball nh_ball; /* exact/ball.h */

/* The value of e; false when it is not finite or a symbol has no value. */
bool nh_ball_eval(nh_ball *ball, nh_ex e, arb_t out);

void nh_ball_set_arb(nh_ball *ball, nh_ex symbol, const arb_t value);

/* A rigorous upper bound of |v|. */
double nh_ball_upper(const arb_t v);

#endif
