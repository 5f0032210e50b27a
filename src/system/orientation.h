/* orientation: coordinates of type `orientation`: rotations without a singular state.
 *
 * An orientation R has three coordinates s = (R_1, R_2, R_3), the axis times tan(angle/4) (modified Rodrigues
 * parameters), nine entries R_xx .. R_zz of the rotation matrix, which takes components in the body to those in space,
 * and three angular velocities w, in the body or in space, which are quasi-velocities [SchaubJunkins1996]:
 *
 *     s' = F w,   F = ((1 - s.s) 1 + 2 [s] + 2 s s^T)/4   (body; -2 [s] in space),   F F^T = ((1 + s.s)/4)^2 1,
 *     R  = 1 + (8 [s]^2 + 4 (1 - s.s) [s])/(1 + s.s)^2,   [s] x = s cross x.
 *
 * s and its shadow -s/(s.s) are the same rotation and obey the same equations, so that a motion goes on in the shadow
 * where s grows: no orientation is singular (motion/turns.h).  In the frame of the fields e_k that belong to w_k,
 *
 *     [e_i, e_j] = +- eps_ijk e_k   (+ in the body, - in space),
 *
 * and the equations of motion are Hamel's (geometry/model.c). */
#ifndef NH_ORIENTATION_H
#define NH_ORIENTATION_H

#include "graph/expr.h"
#include "system/deck.h"

typedef struct {
    const char *name;
    const nh_deck_node *node;
    nh_ex q[3], v[3];               /* its coordinates and their velocities */
    size_t first;                   /* these are the system's coordinates first, first + 1, first + 2 */
    bool space;                     /* the angular velocities are components in space */
    const char *word[3], *entry[9]; /* names of the angular velocities and of the matrix entries */
    nh_ex matrix[9];                /* row-major */
    nh_ex entry_symbol[9];          /* symbols that stand for these in printed formulas */
    nh_ex map[9];                   /* F */
    nh_ex rate[3];                  /* the angular velocities as functions of coordinates and their velocities */
    nh_ex body[3];                  /* the same in the body */
    nh_ex framed[3];                /* symbols that stand for `rate` in nh_system.framed and in framed constraints */
    nh_ex framed_body[3];           /* those in the body */
    nh_ex omega[3];                 /* quasi-velocities */
} nh_orientation;

/* All expressions, from q, v and the names. */
void nh_orientation_build(nh_dag *dag, nh_orientation *orientation);
/* For printed formulas: parts that are linear in the matrix entries are written in their symbols; that they are equal
 * is proved. */
nh_ex nh_orientation_in_entries(nh_dag *dag, const nh_orientation *orientation, nh_ex e);

#endif
