/* companion: exact coefficients of a current together with those of its field, without M^-1.
 *
 *     sum_k c_k X_0(b_k) + A_i zeta^i = 0,    sum_k c_k Y_j(b_k) - M_ij zeta^i = 0        [docs/method.md, (11)]
 *
 * Gamma(Phi) = X_0(Phi) + a^j Y_j(Phi) with M a = A follows from these, and is long because of M^-1.  The field of a
 * momentum is short: with zeta^i = sum_a z_a w_a the equations are linear in c and z over the field of the parameters.
 * The functions w_a are the terms of zeta at the given values of the parameters. */
#ifndef NH_COMPANION_H
#define NH_COMPANION_H

#include "integrals/fixed.h"

/* The relation of n terms, known at the given values of the parameters.  `coefficient`: numbers at these values; on
 * success the coefficients for all values, or for as many as possible. */
nh_fixed nh_companion_relation(const nh_model *model, size_t n, const nh_ex *term, const nh_options *options,
                               nh_ex *coefficient);

/* The same at values of two digits near the given ones, where numbers of many digits make even the relation at the
 * given values too long.  It must hold for all values, and be `like` at the given ones. */
nh_fixed nh_companion_relation_nearby(const nh_model *model, size_t n, const nh_ex *term, const nh_ex *rate,
                                      const double *like, const nh_options *options, nh_ex *coefficient);

#endif
