/* walls: where an expression may jump or have a kink, although it is finite on both sides, and its pieces on the sides.
 *
 * Sums, products, whole powers, sin, exp, ... are analytic wherever they are finite: quotients of them have poles,
 * and no jumps.  What is left are the zero sets of
 *
 *     u, 1/u     of |u|, sign(u) and u^x with a fractional exponent x
 *     y          of atan2(y, x), whose cut is y = 0, x < 0
 *     1/v        of atan(v): where v is infinite
 *     1 - v^2    of asin(v), acos(v);  v - 1 of acosh(v)
 *     z          of U(a, b, z) and of Bessel functions of z;  1 - z^2 of Legendre functions;  1 - z of 2F1
 *
 * each cut into its factors, so that sqrt((x - y)^2) gives x - y.  These are candidates: an evaluation must show
 * whether the expression jumps there. */
#ifndef NH_WALLS_H
#define NH_WALLS_H

#include "graph/expr.h"

enum { NH_MOST_WALLS = 40, NH_MOST_WALL_PARTS = 16, NH_MOST_SIDES = 8 };

typedef struct {
    size_t count;
    nh_ex e[NH_MOST_WALLS];   /* expressions that vanish on a wall; each once */
    bool edge[NH_MOST_WALLS]; /* the base of a root, and no square: where it changes its sign the root ends */
    /* wall of atan2, atan, asin or acos alone: on the other side another branch continues the function */
    bool cut[NH_MOST_WALLS];
    /* functions by whose signs a wall has different parts, as x for the cut y = 0 of atan2(y, x) */
    size_t parts;
    nh_ex part[NH_MOST_WALL_PARTS];
    bool cutting;  /* the walls that are added now are cuts */
    bool left_out; /* there are more than the room holds, or in deeper quotients than are looked at */
} nh_walls;

/* Adds the walls of e. */
void nh_walls_add(nh_walls *walls, nh_dag *dag, nh_ex e);

/* Adds the factors of the bases of negative powers, and of the arguments of logarithms: there e may be infinite. */
void nh_walls_add_poles(nh_walls *walls, nh_dag *dag, nh_ex e);

/* The walls of n expressions that can be crossed when the symbols `in` change: no ends of roots, no constants.  Writes
 * them into wall (room for NH_MOST_WALLS) and returns their number. */
size_t nh_walls_between(nh_dag *dag, size_t n, const nh_ex *e, size_t inputs, const nh_ex *in, nh_ex *wall);

/* The piece of e on one side of each wall u = 0 of |u| and sign(u): s u and s in their places, with s = sign(context,
 * u); where that is 0 they stay.  The outer ones come first: u is as it stands in e. */
nh_ex nh_walls_piece(nh_dag *dag, nh_ex e, nh_ex (*sign)(void *context, nh_ex u), void *context);

/* Sides that are not chosen: symbols s for sign(u), for which s^2 = 1. */
typedef struct {
    nh_dag *dag;
    size_t count;
    nh_ex sign[NH_MOST_SIDES], symbol[NH_MOST_SIDES]; /* sign(u), and s */
    bool left_out;                                    /* there are more */
} nh_wall_sides;
/* The symbol for sign(u), a new one where there is none for it yet; 0: there is no room. */
nh_ex nh_walls_side(nh_wall_sides *sides, nh_ex u);
/* e with the signs for their symbols. */
nh_ex nh_walls_signs(const nh_wall_sides *sides, nh_ex e);

#endif
