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

/* What [Gamma, Z(Phi)] of a current is made of, as fields that are applied to the current.
 *
 * With Gamma(Phi) = 0 the components of [Gamma, Z'], Z' = Z - Z^0 Gamma, are derivatives of first order of Phi.  From
 * zeta = M^-1 Y(Phi), W' = -M^-1 (G^T zeta + X(Phi)), P = R M^-1, H = M^-1 G^T M^-1 (symmetry.h):
 *
 *     [Gamma, Z']^s = V^s(Phi),   V^s = (Gamma(P_sk) - P_sj Y_j(a^k) + P_sj G_lj (M^-1)_lk - P_rk d rho^s/dq^r) Y_k
 *     [Gamma, Z']^i = V^i(Phi),   V^i = -Gamma(H_ik) Y_k - H_ik [Gamma, Y_k] - Gamma((M^-1)_ij) X_j - (M^-1)_ij [Gamma,
 *     X_j]
 *                                       - P_sk da^i/dq^s Y_k + Y_l(a^i) (H_lk Y_k + (M^-1)_lj X_j)
 *     i_[Gamma,Z] phi^a = U_a(Phi),   U_a = phi^a_s V^s                         [CechMusilova2014, eq. 22;
 *     docs/method.md, sec. 5]
 *
 * So the currents with [Gamma, Z] in the canonical distribution are the functions that Gamma and all U_a annihilate,
 * those of case 1 are the functions that Gamma and all V annihilate: as many independent ones as the smallest
 * involutive distribution with these fields leaves (closure.h). */

typedef struct {
    size_t width;       /* 1 + m + n components of each field, along t, q, w */
    nh_ex *gamma;       /* width */
    size_t across, all; /* k; m + n */
    nh_ex *U, *V;       /* across x width, all x width */
} nh_bracket_fields;

/* In the arena, of the submanifold's model and forms. */
nh_bracket_fields *nh_bracket_fields_of(nh_arena *arena, const nh_submanifold *submanifold);
/* field(e), for `width` components. */
nh_ex nh_bracket_fields_apply(const nh_model *model, const nh_ex *field, nh_ex e);

#endif
