/* gather: formulas as a person would write them: like terms gathered, squares completed, angles joined. */
#ifndef NH_GATHER_H
#define NH_GATHER_H

#include "graph/expr.h"

/* The form of e that is found to read best, no longer than e by nh_complexity, and proved equal to e; e itself where
 * none reads better, or e is long.  For formulas that are shown: it costs more than nh_simplify, which the search
 * uses. */
nh_ex nh_gather(nh_dag *dag, nh_ex e);

#endif
