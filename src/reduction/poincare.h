/* poincare: Lagrange-d'Alembert-Poincare equations, in one stage and by stages [CendraDiaz2018, sec. 4 and 5],
 * [Bloch1996].
 *
 * On a slice, S_x = null(om_e) with basis chi; the nonholonomic connection A_i makes (d_i, -A_i) lie in D and
 * orthogonal to S_x for K:
 *
 *     om_e A_i = om_x,i,      chi^T (Kf_ei - Kf_ee A_i) = 0                               (unique iff V + D = TQ)
 *
 * or, with an inner product g0 of the generators, chi^T g0 A_i = 0: of the vectors of D over d_i that with the shortest
 * part along V, which is 0 where d_i itself lies in D [CendraDiaz2018, eq. 48].
 *
 * v = zeta + A x' lies in S_x, l(x, x', v) = L(x', v - A x'), mu = dl/dv, pi_i = dl/dx'^i.  One stage:
 *
 *     mu'(chi) = mu([v - A x', chi]),      pi_i' = dl/dx^i + mu_a B^a_ij x'^j + mu([A_i, v])
 *
 * By stages, in parts of a chain of ideals (ideal_chain.h), beta = parts of mu:
 *
 *     sum_j beta_j'(chi_j)  = sum_i <beta_i, [parts(v - A x'), parts(chi)]_i>           one equation per chi, all
 *     blocks summed
 *     dl/dx^i - pi_i'       = sum_k <beta_k, parts(B_ji x'^j)_k - [parts(A_i), parts(v)]_k>
 *
 * (CendraDiaz2018, eq. 43, read as this full pairing; S need not split along the chain.)  Both are compared with the
 * true accelerations, which come from the equations with multipliers in the same frame. */
#ifndef NH_POINCARE_H
#define NH_POINCARE_H

#include "reduction/ideal_chain.h"
#include "reduction/slice.h"

typedef struct {
    size_t places;    /* compared at */
    size_t dimension; /* of S */
    /* largest residuals, each relative to the sum of the moduli of its terms */
    double one_vertical, one_horizontal, stages_vertical, stages_horizontal;
    /* by stages against the bracket itself, relative to the longest of vectors of these lengths */
    double bracket;
    double euler_poincare; /* by stages against ad*, relative to the largest sum of the moduli of its terms */
    double curvature;      /* largest |B| */
} nh_poincare;

/* With velocities of the sample points.  lifts: an inner product of the generators (d x d) to which the lifts are
 * orthogonal, or NULL: the kinetic energy.  Fails when V + D != TQ. */
bool nh_poincare_check(nh_poincare *out, const nh_slice *slice, const nh_ideals *chain, const double *lifts,
                       const nh_options *options, nh_error *error);

#endif
