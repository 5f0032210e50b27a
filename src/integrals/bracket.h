/* bracket: [Gamma, Z] of a constraint symmetry as a combination of Gamma and Z.
 *
 *     L_Z alpha = F_a phi^a,   F_a = V_a(Phi) + Omega(Z, V_a),   phi^b(V_a) = delta^b_a          [CechMusilova2014, eq.
 *     12]
 *     [Gamma, Z] = a Gamma (case 1),   [Gamma, Z] = a Gamma + b Z (case 2)                        [CechMusilova2014,
 *     sec. 3.3] */
#ifndef NH_BRACKET_H
#define NH_BRACKET_H

#include "geometry/submanifold.h"
#include "integrals/symmetry.h"

typedef struct {
    nh_ex *F, *form;   /* k; k: i_[Gamma,Z] phi^a of the submanifold's forms */
    bool along_motion; /* field is [Gamma, Z] - motion Gamma, which is shorter; else motion is 0 */
    nh_ex motion;
    nh_field field; /* simplified */
    nh_ex *rate;    /* m: its components along the velocities of the coordinates */
    bool decided;   /* a and b exist, and the relation is an identity of expressions */
    nh_ex a, b;     /* b is 0 in case 1 */
} nh_bracket;

/* The symmetry and the submanifold belong to the same model. */
nh_bracket *nh_bracket_of(nh_arena *arena, const nh_submanifold *submanifold, const nh_symmetry *symmetry);

#endif
