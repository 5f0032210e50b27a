/* chaplygin: the first stage of reduction where V + D = TQ and V cap D = 0 [ChhabraEmami2014, sec. 2], [Koiller1992].
 *
 *     A = om_e^-1 om_x                        connection on the slice: the horizontal lift of x' is (x', -A x') in the
 *                                             frame
 *     B^a_ij = d_i A^a_j - d_j A^a_i - C_bc^a A^b_i A^c_j                                curvature
 *     [ChhabraEmami2014, eq. 2.12]
 *     Khat = H^T Kf H,   H = (1; -A)          metric,      Hhat = 1/2 p Khat^-1 p + V
 *     [ChhabraEmami2014, eq. 2.10]
 *     J_a = (Kf_e H)_aj x'^j                  momentum of the group in the body frame
 *     Ups_ij = J_a B^a_ij                     the almost-symplectic form is dx ^ dp + 1/2 Ups dx ^ dx
 *                                             [ChhabraEmami2014, eq. 2.11]
 *     p_i' = -d_i Hhat + Ups_ij x'^j,   x' = Khat^-1 p,   zeta = -A x'
 *
 * In the paper J is the spatial momentum, which agrees at the identity only.
 *
 * With affine constraints om_x x' + om_e zeta + bf = 0, L = 1/2 u Kf u + af u - V and forces the same holds with A_0 =
 * om_e^-1 bf as one more component of the connection, along the time: zeta = -A x' - A_0,
 *
 *     J_a   = (Kf_e H)_aj x'^j + J0_a,   J0_a = af_a - Kf_ab A_0^b,       B^a_i0 = d_i A_0^a - C_bc^a A^b_i A_0^c
 *     Lhat  = 1/2 x' Khat x' + ahat x' - Vhat,   ahat_i = af_i - Kf_ib A_0^b - A^a_i J0_a,   Vhat = V - 1/2 A_0 Kf_ee
 *           A_0 + af_e A_0
 *     p_i'  = dLhat/dx^i - d ahat_i/dt + J_a (B^a_ij x'^j + B^a_i0) + (H^T Qf)_i,     p = Khat x' */
#ifndef NH_CHAPLYGIN_H
#define NH_CHAPLYGIN_H

#include "integrals/prove.h"
#include "reduction/reduced.h"

typedef struct {
    const nh_slice *slice;
    nh_dag *dag;
    size_t n, d;
    nh_ex *A;            /* d x n */
    nh_ex *B;            /* d x n x n: B[(a*n + i)*n + j] */
    nh_ex *K;            /* n x n */
    nh_ex *J;            /* d x n: J_a = J[a*n + j] x'^j */
    nh_ex *U;            /* n x n x n: Ups_ij = U[(k*n + i)*n + j] x'^k */
    nh_ex V;             /* Vhat */
    bool plain;          /* the following members are not used: linear constraints, L = K - V, no forces */
    nh_ex *A0, *J0, *B0; /* d, d, d x n: B0[a*n + i] = B^a_i0 */
    nh_ex *a;            /* n: ahat */
    nh_ex *force;        /* n, of (x, x'): forces beside Lhat, with the gyroscopic force Ups_ij x'^j */
    nh_reduced reduced;  /* x' as velocities, p their momenta */
} nh_chaplygin;

/* False with a message when om_e is singular. */
bool nh_chaplygin_init(nh_chaplygin *chaplygin, const nh_slice *slice, nh_error *error);

/* Invariant measure and Hamiltonization [BorisovMamaev2008].  With T^k_ij = (Khat^-1)^kl U_lij, Theta_j = T^i_ij:
 *
 *     exp(sigma(x)) dx dp is invariant  iff  d sigma = -Theta, so that d Theta = 0 is needed
 *     f with d(f Omega) = 0 exists      iff  T^k_ij = th_j delta^k_i - th_i delta^k_j, th = Theta/(n - 1), and d th =
 *                                       0;   d log f = -th
 *
 * Residuals are relative to the size of T and its derivative over the sample points. */
typedef struct {
    bool tested;
    bool measure, simple, factor;
    bool exact; /* these, and whether Theta is 0, were decided modulo primes; false: by numbers */
    /* the density is many-valued: Theta has a period along a turn of an angle on which the stage is regular.  A density
     * that vanishes, or grows without bound, where the coordinates are singular or orbits are tangent to D is not
     * local: the stage ends there */
    bool local;
    double size;       /* of Theta: 0 means that the Liouville measure is invariant */
    double curl;       /* largest |d Theta| */
    double phi_simple; /* largest residual of the algebraic condition */
    bool closed;       /* density.h: the density is known in closed form */
    nh_ex density;     /* exp(sigma); the factor is its (n - 1)th root */
    nh_proof proof;    /* of it */
} nh_chaplygin_measure;

/* Is there no gyroscopic force at the values of the parameters? */
bool nh_chaplygin_flat(const nh_slice *slice, const nh_ex *U);
/* K (n x n) and U (n x n x n, Ups_ij = U_kij x'^k) as functions of the slice's x: those of the first stage, or of the
 * second (second.h).  Ks, Us: the same on the slice that is shown, whose numbers are exact: these decide. */
nh_chaplygin_measure nh_chaplygin_measure_of(const nh_slice *slice, const nh_ex *K, const nh_ex *U,
                                             const nh_slice *shown, const nh_ex *Ks, const nh_ex *Us,
                                             const nh_options *options);

#endif
