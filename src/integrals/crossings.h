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

#endif
