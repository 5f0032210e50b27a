/* rational_value: exact values of expressions at a place with exact coordinates. */
#ifndef NH_RATIONAL_VALUE_H
#define NH_RATIONAL_VALUE_H

#include <flint/fmpq.h>

#include "graph/expr.h"

/* Symbols and their values, expressions of numbers. */
typedef struct {
    nh_dag *dag;
    size_t count;
    const nh_ex *symbol, *value;
} nh_rational_value_place;

/* The value of e at the place, simplified. */
nh_ex nh_rational_value_at(const nh_rational_value_place *place, nh_ex e);
/* The rational number that e is, an expression of numbers; false: it is not seen to be one. */
bool nh_rational_value_of(nh_dag *dag, nh_ex e, fmpq_t out);
/* The number as an expression. */
nh_ex nh_rational_value_number(nh_dag *dag, const fmpq_t value);
/* Is the value of e, an expression of numbers, certainly not 0? */
bool nh_rational_value_differs(nh_dag *dag, nh_ex e);
/* Is e, a function of the place's symbols alone, certainly analytic there?  No denominator and no radicand vanishes,
 * and its functions are sines, exponentials and the like. */
bool nh_rational_value_analytic(const nh_rational_value_place *place, nh_ex e);

#endif
