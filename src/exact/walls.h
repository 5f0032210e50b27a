/* walls: where an expression may jump or have a kink, although it is finite on both sides.
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

enum { NH_MOST_WALLS = 40, NH_MOST_WALL_PARTS = 16 };

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

#endif
