/* lagrange_poincare: the objects of the Lagrange-d'Alembert-Poincare equations as expressions on a slice
 * [CendraDiaz2018, sec. 4 and 5].
 *
 *     S_x = null(om_e), basis chi;      om_e A_i = om_x,i,   chi^T (Kf_ei - Kf_ee A_i) = 0
 *     (poincare.h)
 *     B^a_ij = d_i A^a_j - d_j A^a_i - C_bc^a A^b_i A^c_j,      v = zeta + A x' = nu^alpha chi_alpha,      omega = v -
 *     A x' = zeta l(x, x', v) = 1/2 x' Kh x' + 1/2 nu I nu - V,   Kh = H^T Kf H, H = (1; -A),   I = chi^T Kf_ee chi
 *     mu_a = (Kf_e (x', omega))_a,   pi_i = Kh_ij x'^j
 *
 *     with lifts that are orthogonal to S for another inner product also C = chi^T (Kf_ei - Kf_ee A_i), in l as
 *     x'^i C_i,alpha nu^alpha and in pi_i as C_i,alpha nu^alpha
 *
 *     mu_a' chi^a = mu([omega, chi]),      pi_i' = dl/dx^i + mu_a B^a_ij x'^j + mu([A_i, v])
 *
 * Needs V + D = TQ.  Without constraints S is the whole algebra and A the mechanical connection: the Lagrange-Poincare
 * equations; without shape those of Euler-Poincare. */
#ifndef NH_LAGRANGE_POINCARE_H
#define NH_LAGRANGE_POINCARE_H

#include "reduction/slice.h"

typedef struct {
    const nh_slice *slice;
    size_t n, d, r;     /* shape, group, dimension of S */
    nh_ex *chi;         /* d x r */
    nh_ex *A, *B;       /* d x n; d x n x n */
    nh_ex *dx, *nu;     /* n; r: symbols x', nu_1, ... */
    nh_ex *omega, *v;   /* d */
    nh_ex *Kh, *I;      /* n x n; r x r */
    nh_ex *C;           /* n x r; 0 where the lifts are orthogonal to S for the kinetic energy */
    const nh_ex *lifts; /* the inner product for the lifts, or NULL */
    nh_ex *mu, *pi;     /* d; n */
    nh_ex *slope;       /* n: dl/dx^i at constant x' and v */
} nh_lagrange_poincare;

/* lifts: an inner product of the generators (d x d) to which the lifts are orthogonal, or NULL: the kinetic energy.
 * NULL where the constraints cannot be solved in the group directions. */
nh_lagrange_poincare *nh_lagrange_poincare_of(nh_arena *arena, const nh_slice *slice, const nh_ex *lifts);
/* C_bc^a xi^b eta^c, d components. */
void nh_lagrange_poincare_bracket(const nh_lagrange_poincare *l, const nh_ex *xi, const nh_ex *eta, nh_ex *out);

#endif
