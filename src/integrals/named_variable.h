/* named_variable: a linear equation u'' = P u' + Q u in s, in another variable
 * x = r(s) in which P and Q are rational. */
#ifndef NH_NAMED_VARIABLE_H
#define NH_NAMED_VARIABLE_H

#include "graph/expr.h"

/* u'' = p u' + q u, the derivatives by `variable`. */
typedef struct {
    nh_ex variable, p, q;
    nh_ex meaning; /* of the variable: cos(s), s^2, exp(k s), .. */
} nh_named_equation;

enum { NH_MOST_EQUATIONS = 12 };

/* e as a function of cot s where that is possible and shorter: common factors that have both sines and cosines cancel
 * there. */
nh_ex nh_named_tidy(nh_dag *dag, nh_ex e, nh_ex s);

/* The same equation in the variables s, cos s, sin s, cot s, exp(k s) and their squares, as far as it is free of roots
 * and of s there.  Returns how many. */
size_t nh_named_variables(nh_dag *dag, const nh_named_equation *in_s, nh_named_equation out[NH_MOST_EQUATIONS]);

#endif
