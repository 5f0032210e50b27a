/* field_root: square roots in the field that functions generate.
 *
 *     sqrt(3 + 2 sqrt(2)) = 1 + sqrt(2),    sqrt(2 (1 + cos(x))) = 2 cos(x/2)
 *
 * Sines and cosines become rational functions of tan(a/2), so that without roots the field consists of quotients of
 * polynomials.  With r^2 = D, a + b r is the square of u + b r/(2 u) for u^2 = (a + n)/2 or (a - n)/2 and n^2 = a^2 -
 * b^2 D, or it is none: this needs square roots in the field without r only. */
#ifndef NH_FIELD_ROOT_H
#define NH_FIELD_ROOT_H

#include "graph/expr.h"

/* Generators besides symbols, logarithms and the like; arguments and radicands in canonical form (normal.h). */
typedef struct {
    size_t angles, exponents, roots;
    const nh_ex *angle, *exponent; /* a: sin(a), cos(a), exp(a) and those of whole multiples */
    const nh_ex *radicand;         /* of square roots; those that stand inside of others first */
} nh_root_field;

/* A function with the square e, of either sign, in these generators.  False: there is none, or it was not found. */
bool nh_field_root(nh_dag *dag, const nh_root_field *field, nh_ex e, nh_ex *root);

#endif
