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
#include "graph/expr.h"

enum { NH_MOST_NAMED = 8 };

/* Currents, proved, into `out`; their number.  First with two of the words that are symbols, or of `form`, combinations
 * of two with coefficients that depend on s, in which the equation may be simpler; a position q stands for q Gamma(s):
 * of a plane wave x' f(u) + x u' h(u).  Then with all words.  *open: an equation that matches nothing, as a text in the
 * arena; or NULL. */
size_t nh_named_coefficients(const nh_model *model, nh_ex variable, size_t words, const nh_ex *word, size_t forms,
                             const nh_ex *form, nh_arena *arena, nh_ex out[NH_MOST_NAMED], const char **open);

/* A linear equation u'' = P u' + Q u in s, in another variable
 * x = r(s) in which P and Q are rational. */

/* u'' = p u' + q u, the derivatives by `variable`. */
typedef struct {
    nh_ex variable, p, q;
    nh_ex meaning; /* of the variable: cos(s), s^2, exp(k s), .. */
} nh_named_equation;

enum { NH_MOST_EQUATIONS = 12 };

/* e as a function of cot s where that is possible and shorter: common factors that have both sines and cosines cancel
 * there. */
nh_ex nh_named_tidy(nh_dag *dag, nh_ex e, nh_ex s);

/* The same equation in the variables s, cos s, sin s, cot s, exp(k s) and their squares, as far as it is free of roots
 * and of s there.  Returns how many. */
size_t nh_named_variables(nh_dag *dag, const nh_named_equation *in_s, nh_named_equation out[NH_MOST_EQUATIONS]);

/* Solutions of u'' = P u' + Q u, P and Q rational in x, by functions that have names.
 *
 *     three regular singular points           Gauss's function of a Moebius variable, times powers [DLMF 15.11]
 *     a conjugate pair and infinity           Riemann's equation with real coefficients
 *     R = B/x^2                               powers of x, with logarithms in waves
 *     R = A x^m + B/x^2                       Airy; Bessel, sqrt(x) J_n(.. x^((m + 2)/2)) [DLMF 10.13]
 *     R = A + B/x + C/x^2, A x^2 + B x + C,
 *     A x^2 + C + D/x^2                       Kummer's functions [DLMF 13.14, 12.7]
 *
 * where u = g v with g'/g = P/2 and v'' = R v.  The result is a proposal: the caller proves it. */

/* The value of an expression at a typical point, parameters included: decides
 * which real solution is meant. */
typedef double nh_named_value_of(void *context, nh_ex e);

/* Up to two solutions, with `meaning` substituted for the variable.  Returns their number. */
size_t nh_named_match(nh_dag *dag, const nh_named_equation *equation, nh_named_value_of *value, void *context,
                      nh_ex out[2]);

/* The linear equations that the coefficients f_i(s) of a current satisfy.
 *
 *     Gamma(sum_i f_i b_i) = sum_i ( f_i' Gamma(s) b_i + f_i Gamma(b_i) ) = 0,
 *
 * sorted by products of states, is a linear system for the f_i with coefficients in s.  Differentiated and eliminated
 * it becomes g' = A g, f = T g for a few of them.  Where A has blocks each can be solved by itself. */

enum { NH_NAMED_WORDS = 32, NH_NAMED_ORDER = 3 };

/* Two or three unknowns that are coupled with each other and with no other. */
typedef struct {
    size_t order;
    nh_ex A[NH_NAMED_ORDER][NH_NAMED_ORDER]; /* g_i' = sum_j A_ij g_j */
    nh_ex T[NH_NAMED_WORDS][NH_NAMED_ORDER]; /* f_i = sum_j T_ij g_j */
} nh_named_block;

/* The blocks of the system for these words, at most NH_NAMED_WORDS of them; 0 where an entry has a complexity above
 * `longest`. */
size_t nh_named_blocks(const nh_model *model, nh_ex s, size_t words, const nh_ex *word, size_t longest,
                       nh_named_block out[NH_NAMED_WORDS]);

#endif
