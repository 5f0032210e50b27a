/* chetaev: the same motion in all coordinates with Lagrange multipliers, by IDA (index 1 or 2).
 *
 *     q' = v
 *     K v' + h = -mu_a df^a/dv       h = d/dt-part of p_s without v' minus dL/dq - Q;  K = d2L/dv dv
 *                                    (docs/method.md (7): dL/dq + Q - d/dt p = mu df/dv)
 *     f^a_v v' + f^a_q v + f^a_t = 0
 *
 * i.e. with everything on one side:   K v' + h + F^T mu = 0,   F v' + g = 0,   where F = df/dv (k x m), h, g
 * functions of (t,q,v). Of index 1 the constraint f itself is not imposed after t0: its violation measures the error.
 * Of index 2 the last equation is f^a = 0 itself, which then holds to the tolerance of Newton's iteration; the
 * multipliers lose digits [BrenanCampbellPetzold1996].  K may be singular as long as the bordered matrix is regular.
 * The callback computes K, h, F, g and f at once.
 *
 * Reference: [Hindmarsh2005], [Chetaev equations: CechMusilova2014, eq. 10]. */
#ifndef NH_CHETAEV_H
#define NH_CHETAEV_H

#include "motion/motion.h"

typedef struct {
    size_t coordinates; /* m */
    size_t constraints; /* k, may be 0 */
    bool holds;         /* index 2: f = 0 itself instead of its derivative */
    void *context;
    /* At (t, q, v): mass K (m x m, column-major), force h (m), F (k x m, column-major), g (k), f (k).  False when not
       finite. */
    bool (*terms)(double t, const double *q, const double *v, double *K, double *h, double *F, double *g, double *f,
                  void *context);
} nh_chetaev_problem;

typedef struct {
    nh_motion *motion; /* state: q (m), v (m), mu (k) */
    /* max_a,t |f^a| along the output points, relative to |df^a/dv_s| and the size of v_s: its scale, or |v_s| where
       that is larger */
    double violation;
} nh_chetaev_motion;

/* `initial`: q then v, consistent with the constraints (the multipliers and accelerations are computed).  `options`:
 * the method is always IDA's, the scales are those of q then v (2m). */
nh_chetaev_motion *nh_chetaev(const nh_chetaev_problem *problem, const double *initial, size_t count,
                              const double *times, const nh_flow_options *options, nh_error *error);
void nh_chetaev_motion_free(nh_chetaev_motion *motion);

#endif
