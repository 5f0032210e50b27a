/* lift: rounded numbers in an expression as symbols, so that they can be varied. */
#ifndef NH_LIFT_H
#define NH_LIFT_H

#include "expr/dag.h"

enum { NH_MOST_LIFTED = 4 };

typedef struct {
    size_t count;
    double value[NH_MOST_LIFTED]; /* positive; each stands for its negative too */
    nh_ex symbol[NH_MOST_LIFTED];
    bool overflow;                /* there were more */
} nh_lifted;

/* e with every inexact number (constant, coefficient, exponent) replaced by its symbol in the table, which grows. */
nh_ex nh_lift(nh_dag *dag, nh_ex e, nh_lifted *table);

#endif
