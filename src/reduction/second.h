/* second: further symmetry of a reduced Chaplygin system, and the second stage of its reduction [ChhabraEmami2014, sec.
 * 2.3].
 *
 * N acts on Qhat with generators zeta_b (the shape parts of symmetries that normalise the first group).  Conditions, at
 * all points of the slice:
 *
 *     (i)   Khat, V and Ups are invariant under N
 *     (ii)  sym_(lj) zeta^i U_lij = 0         weak: together with (i) the same as the conservation of p(zeta)
 *                                             [here]
 *     (ii') zeta^i U_lij = 0                  strong: the paper's hypothesis
 *                                             [ChhabraEmami2014, Prop. 2]
 *
 * The equations need (i) and (ii) only.  On a slice of Qhat, frame (d_i, e_a), C the constants of N:
 *
 *     I = Khat_ee  locked inertia,   Av = I^-1 Khat_ex  mechanical connection,   Kt = Khat_xx - Av^T I Av,   Bv the
 *                  curvature of Av
 *     v = zeta + Av x',   m = I v  momentum in the body frame,   pt = Kt x'
 *     m_b'  = C_ab^k zeta^a m_k
 *     pt_i' = 1/2 x'^T d_i Kt x' + 1/2 v^T d_i I v - d_i V + m_a Bv^a_ij x'^j + C_lk^a m_a Av^l_i v^k + g_i - Av^a_i
 *     g_a g = Fr^T Ups Fr (x', zeta)
 *
 * Where the first stage has more forces than the gyroscopic one (affine constraints, forces), or Lhat a part ahat x',
 * (i) asks that these and ahat are invariant, (ii) and (ii') that no force but the magnetic one of ahat acts along
 *     zeta; then g is all of them, m_b' has g_b, too, and m_b + ahat(zeta_b) is what (i) and (ii) conserve.
 *
 * For abelian N, m is constant, m_a Bv^a is the 2-form Xi of [ChhabraEmami2014, eq. 2.17], and the rest is eq. 2.19.
 * For other N the equations hold on the bundle of coadjoint orbits: (x, pt) and m on the orbit through its initial
 * value. */
#ifndef NH_SECOND_H
#define NH_SECOND_H

#include "reduction/chaplygin.h"

typedef struct {
    const nh_chaplygin *first;
    nh_kinetic *hat;               /* Khat and V on the shape space, as a system of its own */
    nh_action action;              /* N on the shape space */
    nh_slice slice;                /* of the shape space */
    size_t n, d;                   /* n shape coordinates of the second stage; dimension of N */
    nh_ex *inertia, *Av, *Kt, *Bv; /* d x d, d x n, n x n, d x n x n */
    /* n x n x n: the gyroscopic form on vectors horizontal for Av, U_kij x'^k; what m adds to it does not matter for a
       measure */
    nh_ex *U;
    nh_reduced reduced;              /* w = (x', v), p = (pt, m) */
    size_t orbit;                    /* dimension of a generic coadjoint orbit of N */
    double invariance, weak, strong; /* largest relative residuals of (i) for Ups, (ii), (ii') */
    bool abelian;
    bool magnetic;        /* Lhat has a part ahat x' */
    const double *pivots; /* as of a slice */
} nh_second;

/* Combinations c (count columns of length `candidates`) of fields that satisfy the weak condition (ii): echelon form;
 * returns their number. `field`: candidates x m components. */
size_t nh_second_candidates(const nh_chaplygin *first, size_t candidates, const nh_ex *field, const nh_options *options,
                            double *c);
/* One of these columns as expressions of the parameters. */
void nh_second_coefficients(const nh_chaplygin *first, size_t candidates, const nh_ex *field, const double *c,
                            const nh_options *options, nh_ex *exact);

/* Of the group of these fields (d x m, replaced) a largest one that acts freely on the shape space, among all
 * combinations; returns its dimension. */
size_t nh_second_free(const nh_chaplygin *first, size_t d, nh_ex *field, const nh_options *options);

/* Find N on the shape space from fields on Q, and check (i) and (ii).  Call nh_second_equations afterwards. */
bool nh_second_init(nh_second *second, const nh_chaplygin *first, size_t d, const nh_ex *field,
                    const nh_options *options, nh_error *error);
/* x: a place of the shape space (n of the first stage) through which the slice goes. */
bool nh_second_equations(nh_second *second, const size_t *shape, const size_t *along, const double *y0,
                         nh_error *error);
/* U_kij of the first stage on its shape space in the first `count` vectors of the frame h_1 .. h_n, e_1 .. e_d, h_i =
 * d_i - Av^a_i e_a: count^3 values, k first; count = n, or all of them. */
void nh_second_form(const nh_second *second, size_t count, nh_ex *out);
/* The same group on the same shape space, with the first stage's linear systems eliminated for a place of its (pivots:
 * n of the first stage, kept; NULL: as they are).  The equations are to be made next; nothing is to be cleared. */
bool nh_second_renew(nh_second *out, const nh_second *second, const double *pivots, nh_error *error);
void nh_second_clear(nh_second *second);

#endif
