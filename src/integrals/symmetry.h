/* symmetry: the constraint symmetry of a current, and what kind it is.
 *
 * Where Lbar != 0 and M is regular every first integral is the Noether-type current of exactly one Chetaev field
 * Z = Z^0 X_0 + zeta^i X_i + W^i Y_i  [CechMusilova2014, eq. 20]:
 *
 *     zeta = M^-1 dPhi/dw,   Z^0 = (Phi - pbar_i zeta^i) / Lbar,   W = M^-1 (A Z^0 - G^T zeta - X(Phi))
 *
 *     [Gamma,Z]^0 = Gamma(Z^0),  [Gamma,Z]^s = Gamma(Z^s) - Z(rho^s),  [Gamma,Z]^i = Gamma(W^i) - Z(a^i)
 *     i_[Gamma,Z] phi^a = nu^a_s ([Gamma,Z]^s - rho^s [Gamma,Z]^0)                [CechMusilova2014, eq. 22]
 *
 * Case 1: [Gamma,Z] = a Gamma;  case 2: = a Gamma + b Z;  case 3: neither   [CechMusilova2014, sec. 3.3]. */
#ifndef NH_SYMMETRY_H
#define NH_SYMMETRY_H

#include "integrals/points.h"

/* An energy that is longer than this (nh_complexity) gets its symmetry, d/dt, without solving. */
enum { NH_SYMMETRY_LENGTHY = 200 };

typedef struct {
    nh_ex phi, Z0;
    nh_ex *zeta, *W;        /* n */
    nh_field field;         /* components in the chart: d/dt, d/dq (m), d/dw (n) */
    nh_ex *coordinate_rate; /* m: Z(rho^s), the component along d/dx' of a coordinate chart */
    bool along_motion;      /* Z = Z^0 Gamma + relative is much shorter, as for symmetries of evolutionary form */
    nh_field relative;      /* then: the components of Z - Z^0 Gamma; time is 0 */
    nh_ex *relative_rate;   /* and those along d/dx' of a coordinate chart */
    nh_field bracket;       /* [Gamma, Z] */
    nh_ex *bracket_form;    /* k: i_[Gamma,Z] phi^a */
    bool bracket_in_distribution, projectable;
    int kase;                /* 1, 2, 3; 0 when it could not be decided */
    double off[3];           /* largest relative residuals of (N0), (NX), (NY) over the points */
    double noether_residual; /* the largest of them */
} nh_symmetry;

/* Expressions belong to the model's graph, arrays to its arena.  Fails where Lbar vanishes identically. `same`:
 * relative size below which two fields are equal at a point. */
bool nh_symmetry_of(nh_model *model, const nh_points *points, nh_ex phi, double same, nh_symmetry *out,
                    nh_error *error);

/* Only Z^0 (returned) and zeta (n) of a current. */
nh_ex nh_symmetry_components(const nh_model *model, nh_ex phi, nh_ex *zeta);

/* Is phi the energy, or minus the energy, and conserved because neither L nor a force depends on time or does work, and
 * the constraints let velocities be scaled?  By the equations of motion Gamma(E) = (EL)_s rho^s - dL/dt with
 * (EL)_s Y_i(rho^s) = 0, so that it vanishes where rho^s = w^i Y_i(rho^s) and dL/dt = 0, however long the accelerations
 * are.  The symmetry of -E is d/dt then. */
bool nh_symmetry_is_energy(const nh_model *model, nh_ex phi);

/* A field given by Z^0 and zeta: its current alpha(Z) = Lbar Z^0 + pbar_i zeta^i. */
nh_ex nh_symmetry_current(const nh_model *model, nh_ex Z0, const nh_ex *zeta);

/* The largest residual of (N0), (NX) and (NY) [docs/method.md, eq. 11] over the points, relative to the largest of
 * their terms; off: of each of the three. */
double nh_symmetry_residual(const nh_model *model, const nh_points *points, nh_ex phi, nh_ex Z0, const nh_ex *zeta,
                            const nh_ex *W, double off[3]);

#endif
