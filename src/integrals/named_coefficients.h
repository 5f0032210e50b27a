/* named_coefficients: currents sum_i f_i(s) b_i whose coefficients are functions with names.
 *
 * The f_i follow from two or three functions g' = A g (named_system.h).  One of these, y, satisfies an equation of the
 * order n of A, which is found from y, y', .. y^(n) = V g by Cramer's rule.  One of second order,
 *
 *     y'' = P y' + Q y,                                                                        (31)
 *
 * may have solutions with names (named_variable.h, named_match.h), exactly and for all parameters.  One of third order,
 * y''' = p y'' + q y' + r y, may be its symmetric square, y = u v with solutions u, v of (31), where
 *
 *     p = 3 P,    q = P' - 2 P^2 + 4 Q,    r = 2 Q' - 4 P Q.                                   (32) */
#ifndef NH_NAMED_COEFFICIENTS_H
#define NH_NAMED_COEFFICIENTS_H

#include "base/memory.h"
#include "geometry/model.h"

enum { NH_MOST_NAMED = 8 };

/* Currents, proved, into `out`; their number.  First with two of the words that are symbols, or of `form`, combinations
 * of two with coefficients that depend on s, in which the equation may be simpler; a position q stands for q Gamma(s):
 * of a plane wave x' f(u) + x u' h(u).  Then with all words.  *open: an equation that matches nothing, as a text in the
 * arena; or NULL. */
size_t nh_named_coefficients(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word, size_t forms,
                             const nh_ex *form, nh_arena *arena, nh_ex out[NH_MOST_NAMED], const char **open);

#endif
