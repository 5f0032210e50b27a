/* expr: hash-consed expressions in a light canonical form.
 *
 * An expression is an index into its graph; equal indices mean equal expressions, so common subexpressions are
 * shared for free and every memo table is an array.  The form is canonical under commutativity, associativity,
 * collection of like terms and like factors, exact rational arithmetic, and the signs of odd and even functions:
 *
 *     number    exact rational p/q (64 bit) or, when inexact, a double
 *     symbol    parameter, coordinate, velocity, ...
 *     sum       c0 + c1 e1 + c2 e2 + ...         content 1, first coefficient positive
 *     product   c * b1^x1 * b2^x2 * ...          (powers and quotients too: 1/b = b^-1, sqrt(b) = b^(1/2);
 *                                                 roots of numbers are split into roots of primes)
 *     function  sin, cos, ..., atan2, pi, bessel_j, ...
 *
 * Nothing deeper is done here (no trigonometric identities, no expansion): see normal.h. */
#ifndef NH_EXPR_H
#define NH_EXPR_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint32_t nh_ex; /* an expression of one graph */
typedef struct nh_dag nh_dag;

typedef enum { NH_NUMBER, NH_SYMBOL, NH_SUM, NH_PRODUCT, NH_FUNCTION } nh_kind;

/* An exact rational p/q with q > 0 in lowest terms; or (q == NH_LONG) one too long for 64 bits, which num_long.h keeps
 * under the index p, with d the nearest double; or (q == 0) the double d. */
typedef struct {
    int64_t p, q;
    double d;
} nh_num;

enum { NH_LONG = -1 };

/* The numbers 0 and 1 are the first nodes of every graph. */
static inline bool nh_is_zero(const nh_dag *dag, nh_ex e)
{
    (void)dag;
    return e == 0;
}
bool nh_is_number(const nh_dag *dag, nh_ex e, int64_t value);
/* Does `symbol` occur in `e`? (not through rules of implicit symbols, see diff.h) */
bool nh_depends(const nh_dag *dag, nh_ex e, nh_ex symbol);

#endif
