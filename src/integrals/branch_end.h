/* branch_end: where one branch of a quadratic constraint ends and the other begins.
 *
 * The chart gives a dependent velocity u by one root of a u^2 + b u + c = 0, and ends where the radicand R vanishes.
 * Motions need not end there: the projectile of constant speed passes z' = 0 at its highest point.  They go on along
 * the other root if the rate of sqrt(R) along Gamma stays finite there and does not vanish.  A current with 1/z' in an
 * arctangent is constant on both branches, and jumps between them. */
#ifndef NH_BRANCH_END_H
#define NH_BRANCH_END_H

#include "base/option.h"
#include "integrals/crossings.h"

typedef struct {
    nh_ex wall;             /* zero where the branches meet, in the velocity u */
    nh_ex root, there;      /* the symbol of u, and its value on the other branch */
    nh_crossings crossings; /* the points of both sides are the same ones: (t, q, w) */
} nh_branch_end;

/* No crossings where the chart has one branch, and where no motion was seen to change it.  Belongs to the arena. */
nh_branch_end nh_branch_end_of(const nh_model *model, const nh_options *options, nh_arena *arena);

/* phi as it is printed, on the other branch: the symbol of u stands for the root. */
nh_ex nh_branch_end_beyond(const nh_model *model, const nh_branch_end *end, nh_ex phi);

#endif
