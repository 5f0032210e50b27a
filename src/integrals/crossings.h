/* crossings: points at which motions reach a wall (exact/walls.h), with points on both sides of it.
 *
 * Lines through the sampling box, and far beyond it, are followed until a wall's function g changes its sign, or
 * touches zero like (x - y)^2: lines in the chart, lines in (t, q, v) projected onto the constraints, which reach
 * walls at which the chart ends, and motions that begin in the box, roughly, both ways in time.  Between the other
 * walls a function that jumps somewhere on a wall jumps nearly everywhere: of each combination of their signs, near the
 * box and far from it, a few crossings are taken.  A motion arrives there when its speed towards the wall stays:
 * Gamma(g)/|grad g| has the sign that leads to it and does not fall to zero, and the equations of motion are finite on
 * both sides, or integrable: eps |Gamma| falls with the distance eps.  It goes through, or, where the other side leads
 * to the wall as well, slides along it, as with dry friction.  An invariant wall (x' = 0 of a free particle), a wall
 * that repels on both sides or without bound, the end of the domain of a root, and what lies behind a pole (open_way.h)
 * are not reached.
 */
#ifndef NH_CROSSINGS_H
#define NH_CROSSINGS_H

#include "base/option.h"
#include "exact/ball.h"
#include "exact/walls.h"
#include "geometry/model.h"

enum { NH_CROSSING_DEPTHS = 3 };

typedef struct {
    nh_ex wall;
    bool touches; /* the function has one sign on both sides */
    /* (t, q, w, u): points where the function is negative, positive, each nearer to the wall than the one before */
    double *point[2][NH_CROSSING_DEPTHS];
} nh_crossing;

typedef struct {
    size_t count;
    nh_crossing *item;
} nh_crossings;

/* Belongs to the arena.  `state` is that of nh_random. */
nh_crossings nh_crossings_find(const nh_model *model, const nh_walls *walls, uint64_t *state, nh_arena *arena);

/* Where one branch of a quadratic constraint ends and the other begins.
 *
 * The chart gives a dependent velocity u by one root of a u^2 + b u + c = 0, and ends where the radicand R vanishes.
 * Motions need not end there: the projectile of constant speed passes z' = 0 at its highest point.  They go on along
 * the other root if the rate of sqrt(R) along Gamma stays finite there and does not vanish.  A current with 1/z' in an
 * arctangent is constant on both branches, and jumps between them. */

typedef struct {
    nh_ex wall;             /* zero where the branches meet, in the velocity u */
    nh_ex root, there;      /* the symbol of u, 0 where the chart has one branch; and its value on the other branch */
    nh_ex rate;             /* of sqrt(R) along Gamma */
    nh_crossings crossings; /* the points of both sides are the same ones: (t, q, w) */
} nh_branch_end;

/* No crossings where the chart has one branch, and where no motion was seen to change it.  Belongs to the arena. */
nh_branch_end nh_branch_end_of(const nh_model *model, const nh_options *options, nh_arena *arena);

/* Does R touch zero at this crossing of another wall, as x'^2 + y'^2 does where a point comes to rest?  Motions go over
 * to the other branch there as well if the rate of sqrt(R) has the same limit on both sides. */
bool nh_branch_end_is_at(const nh_model *model, const nh_branch_end *end, nh_ball *ball, const nh_crossing *c);

/* phi as it is printed, on the other branch: the symbol of u stands for the root.  phi itself where there is none. */
nh_ex nh_branch_end_beyond(const nh_model *model, const nh_branch_end *end, nh_ex phi);

#endif
