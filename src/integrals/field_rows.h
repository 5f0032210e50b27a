/* field_rows: the constraint Noether equations of fields at sample points.
 *
 * A field is a sum of simple functions times simple fields, its bases.  A base B has a current Phi_B = z0 + pbar_i
 * zeta^i and components zeta_B; a function f of t and q has the current f and no zeta.  Products of them have
 *
 *     Phi = Phi_1 Phi_2 ..,   zeta = sum_i zeta_i prod_(j != i) Phi_j
 *
 * so that both equations [CechMusilova2014, eqs. 17, 19] are derivations, and follow Leibniz' rule:
 *
 *     (N0)   D_0(Phi) = X_0(Phi) + A_i zeta^i = 0
 *     (NY)   D_j(Phi) = Y_j(Phi) - M_ij zeta^i = 0
 *
 *     base        Phi_B               zeta_B     field
 *     time        pbar_i w^i - Lbar   w^i        -d/dt, but for what the constraints add to the velocities
 *     X_i         pbar_i              1 in i     the i-th direction that the constraints leave
 *     M^-1 X      w^i                 row of M^-1    where pbar = M w with a constant M
 *
 * Where R does not depend on w, (NY) of all of these is an identity and has no rows.  No acceleration occurs: M is not
 * inverted. */
#ifndef NH_FIELD_ROWS_H
#define NH_FIELD_ROWS_H

#include "integrals/ansatz.h"

typedef struct {
    nh_ex phi;
    const nh_ex *zeta; /* n */
} nh_field_base;

/* Time first, then X_1 .. X_n.  Belongs to the model's arena. */
typedef struct {
    size_t count;
    const nh_field_base *base;
    bool inclined; /* R depends on w: (NY) has rows */
} nh_field_bases;

nh_field_bases nh_field_rows_bases(const nh_model *model);

/* The number of equations at so many points: one of (N0), and n of (NY) where it is no identity, for each. */
size_t nh_field_rows_equations(const nh_model *model, const nh_field_bases *bases, size_t points);

/* Of every column of the ansatz: the equations, each relative to the local speed, into a (nh_field_rows_equations x
 * columns), and the values of its current into b (count x columns), both column-major.  Where `kappa` is not 0, a
 * function, b has kappa times the values, in the units of the equations: for the pencil of fields exp(-lambda q) B,
 * kappa = q' (only where (NY) has no rows). */
void nh_field_rows_all(const nh_model *model, const nh_field_bases *bases, const nh_ansatz *ansatz, nh_ex kappa,
                       const nh_points *points, double *a, double *b);

#endif
