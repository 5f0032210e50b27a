/* named_squares: currents sum_i f_i(s) b_i whose coefficients follow from one that satisfies an equation of third
 * order.
 *
 * Gamma(Phi) = sum_i ( f_i' Gamma(s) b_i + f_i Gamma(b_i) ), sorted by products of states, is a linear system for the
 * f_i with coefficients in s. Differentiated and eliminated it becomes g' = A g for a few of them. Where three belong
 * together, one satisfies y''' = p y'' + q y' + r y. It is a symmetric square, y = u v with u and v solutions of
 * u'' = P u' + Q u, where
 *
 *     p = 3 P,    q = P' - 2 P^2 + 4 Q,    r = 2 Q' - 4 P Q. (32)
 *
 * Then u and v may have names (named_match.h). */
#ifndef NH_NAMED_SQUARES_H
#define NH_NAMED_SQUARES_H

#include "integrals/named_coefficients.h"

/* As nh_named_coefficients, for words that need not be symbols. */
size_t nh_named_squares(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word, nh_arena *arena,
                        nh_ex out[NH_MOST_NAMED], const char **open);

#endif
