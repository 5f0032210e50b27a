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

#include "system/system_internal.h"

struct nh_orientation {
    const char *name;
    const nh_deck_node *node;
    size_t first;       /* its coordinates are first, first + 1, first + 2 */
    bool space;         /* the angular velocities are components in space */
    const char *word[3], *entry[9]; /* names of the angular velocities and of the matrix entries */
    nh_ex matrix[9];    /* row-major */
    nh_ex entry_symbol[9]; /* symbols that stand for these in printed formulas */
    nh_ex map[9];       /* F */
    nh_ex rate[3];      /* the angular velocities as functions of coordinates and their velocities */
    nh_ex body[3];      /* the same in the body */
    nh_ex framed[3];    /* symbols that stand for `rate` in nh_system.framed and in framed constraints */
    nh_ex framed_body[3]; /* those in the body */
    nh_ex omega[3];     /* quasi-velocities */
};

/* Declares the orientation that the map `item` of the file describes (NULL: one with default names): its coordinates
 * come next.  The caller has room for three coordinates. */
bool nh_orientation_declare(nh_system_reader *r, const nh_deck_node *item, const nh_deck_node *name, const char *doc);
/* After all velocities have symbols: matrices and angular velocities. */
void nh_orientations_build(nh_system *system);
/* The orientation of this name, or of which this is a coordinate; or NULL. */
nh_orientation *nh_orientation_named(const nh_system *system, const char *name);
const nh_orientation *nh_orientation_of(const nh_system *system, size_t coordinate);

/* A word that is an angular velocity or a matrix entry: `framed` gives the symbol of the angular velocity. */
bool nh_orientation_word(const nh_system *system, const char *word, bool framed, bool *velocity, nh_ex *out);
/* Velocities of orientations' coordinates, written in the angular velocities' symbols. */
nh_ex nh_orientation_framed(const nh_system *system, nh_ex e);
/* The symbols of the angular velocities, written in coordinates and their velocities. */
nh_ex nh_orientation_written(const nh_system *system, nh_ex e);

/* For printed formulas: what is linear in the matrix entries is written in their symbols; and back. */
nh_ex nh_orientation_shown(const nh_system *system, nh_ex e);
nh_ex nh_orientation_unshown(const nh_system *system, nh_ex e);

/* Where the file chooses no velocities: those of the other coordinates and the angular velocities, without those that
 * the constraints determine. */
bool nh_orientation_velocities(nh_system_reader *r);
/* From rates along the frame (m: of other coordinates their velocities) to those of the coordinates (m). */
void nh_orientation_map(const nh_system *system, const nh_ex *framed, nh_ex *out);

#endif
