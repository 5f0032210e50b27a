/* budget: counted work of a computation, in units that do not depend on the clock, the load or the number of threads.
 *
 * A search ends when its budget is spent, so that the same question has the same answer on every machine; the deadline
 * of base/progress.h is a second limit.  Any thread may add work; whether the budget is spent, or how
 * much of it is left, is asked only where no other thread is working, or the answer would depend on which of them came
 * first.  One per context (base/context.h), as the deadline is. */
#ifndef NH_BUDGET_H
#define NH_BUDGET_H

#include <stdbool.h>

/* name, units, of what; a unit takes about a nanosecond on a machine of 2026 */
#define NH_WORK_TABLE(X)                                                                                               \
    X(DENSE, 0.2, "a multiplication and an addition of dense linear algebra, in doubles")                              \
    X(VALUE, 3, "an instruction of a straight-line program at one point")                                              \
    X(NODE, 250, "an expression that was made, or found to be there already")                                          \
    X(TERM, 4, "a product of two terms of exact polynomials, per word of the coefficients")                            \
    X(BALL, 1, "a product of two words in ball arithmetic")                                                            \
    X(RESIDUE, 6, "a multiplication modulo a prime")

typedef enum {
#define X(name, units, doc) NH_WORK_##name,
    NH_WORK_TABLE(X)
#undef X
} nh_work;

/* Starts a budget of so many millions of units; no limit when `millions` is not finite. nh_work_add counts `count`
 * operations of a kind; nh_budget_spent says whether the limit is reached. */
void nh_budget_begin(double millions);
void nh_work_add(nh_work kind, double count);
bool nh_budget_spent(void);
/* Does the rest of the budget suffice for `count` more operations of this kind? */
bool nh_budget_allows(nh_work kind, double count);
/* Millions of units that `count` operations of this kind take. */
double nh_work_millions(nh_work kind, double count);
/* The part of the budget that is spent: 0 at the beginning, above 1 beyond the limit; 0 when there is no limit. */
double nh_budget_part(void);
/* Millions of units spent since nh_budget_begin. */
double nh_budget_used(void);

#endif
