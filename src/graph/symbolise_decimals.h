/* symbolise_decimals: replaces numbers in an expression by symbols, so that they can be varied. */
#ifndef NH_SYMBOLISE_DECIMALS_H
#define NH_SYMBOLISE_DECIMALS_H

#include "graph/expr.h"

enum { NH_MOST_LIFTED = 4 };

typedef struct {
    size_t count;
    double value[NH_MOST_LIFTED];  /* positive; a negative number becomes the negative of the symbol */
    bool exponent[NH_MOST_LIFTED]; /* it is the exponent of a power; otherwise a factor or a constant */
    nh_ex exact[NH_MOST_LIFTED];   /* the same number */
    nh_ex symbol[NH_MOST_LIFTED];
    bool overflow; /* there were more numbers than room */
} nh_lifted;

/* e with every inexact number (constant, coefficient, exponent) replaced by its symbol in the table, which grows. */
nh_ex nh_symbolise_decimals(nh_dag *dag, nh_ex e, nh_lifted *table);

/* Which numbers in functions and exponents are replaced. */
typedef enum {
    NH_SYMBOLISE_DECIMALS_ROUGH,     /* neither whole nor half: 0.7 in cos(0.7 t), not in x^(1/2) */
    NH_SYMBOLISE_DECIMALS_FRACTIONS, /* all that are not whole */
    NH_SYMBOLISE_DECIMALS_ALL        /* all factors in arguments, 1 too: cos(t) as cos(x t) */
} nh_symbolise_decimals_kind;

/* e with symbols for the numbers that are factors in arguments of exp, sin and the like (rationals and their roots),
 * and for exponents; what depends on the `constant` symbols alone stays. */
nh_ex nh_symbolise_decimals_inside(nh_dag *dag, nh_ex e, nh_symbolise_decimals_kind kind, size_t constants,
                                   const nh_ex *constant, nh_lifted *table);

#endif
