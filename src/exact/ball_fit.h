/* ball_fit: linear relations among expressions, fitted with many digits.
 *
 *     sum_j c_j e_j = 0,   some of the c_j being "leading": each solution is fixed by their values, the others follow
 *     by least squares
 *
 * Doubles cannot tell a true relation from one that holds to second order in a small perturbation: both have residuals
 * of 1e-14.  With hundreds of bits the residual of a true relation falls with the precision, and the other one stays at
 * 1e-14.
 *
 * With A = [L F] (leading and following columns, one row a point) the residual of leading values a is |L a + F x|^2 =
 * a^T G a,
 *
 *     G = L^T L - L^T F (F^T F)^-1 F^T L      (Schur complement),
 *
 * and the relations are the null vectors of G.  Several leading columns at once matter: a true relation may be a
 * combination of vectors none of which is true. */
#ifndef NH_BALL_FIT_H
#define NH_BALL_FIT_H

#include "exact/ball.h"

typedef struct nh_ball_fit nh_ball_fit;

/* leading[j]: e_j is a leading column.  Borrows the ball; copies the rest. */
nh_ball_fit *nh_ball_fit_create(nh_ball *ball, size_t n, const nh_ex *e, const bool *leading);
void nh_ball_fit_free(nh_ball_fit *fit);

/* Adds the point at which the ball stands as one equation.  False (and nothing added) when an expression is not finite
 * there. */
bool nh_ball_fit_add(nh_ball_fit *fit);

/* Computes the relations that cancel to `digits` over the added points, in reduced echelon form with respect to the
 * leading columns, and returns their number.  With `nearest`, if there is none, the relation that is nearest to
 * cancelling. */
size_t nh_ball_fit_solve(nh_ball_fit *fit, double digits, bool nearest);

/* log10(|sum_j c_j e_j| / max_j |c_j e_j|) of relation k at the point at which the ball stands, bounded rigorously for
 * the coefficients found (which are exact numbers by then).  False when an expression is not finite there. */
bool nh_ball_fit_residual(nh_ball_fit *fit, size_t k, double *log10_ratio);

/* The coefficient of e_j in relation k. */
double nh_ball_fit_coefficient(const nh_ball_fit *fit, size_t k, size_t j);

#endif
