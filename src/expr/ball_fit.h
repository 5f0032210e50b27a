/* ball_fit: a linear relation among expressions, fitted with many digits.
 *
 *     sum_j c_j e_j = 0,   c_j given for the fixed j, the others by least squares over the points added
 *
 * Doubles cannot tell a true relation from one that holds to second order in a small perturbation: both leave 1e-14.  Fitted again
 * with hundreds of bits a true one cancels as far as there are bits, the other one stays where it was. */
#ifndef NH_BALL_FIT_H
#define NH_BALL_FIT_H

#include "expr/ball.h"

typedef struct nh_ball_fit nh_ball_fit;

/* fixed[j]: c_j = value[j] and is not fitted.  Borrows the ball; copies the rest. */
nh_ball_fit *nh_ball_fit_create(nh_ball *ball, size_t n, const nh_ex *e, const bool *fixed, const double *value);
void nh_ball_fit_free(nh_ball_fit *fit);

/* The point at which the ball stands, as one equation.  False (and nothing added) when an expression is not finite there. */
bool nh_ball_fit_add(nh_ball_fit *fit);

/* The coefficients; false when the equations do not determine them. */
bool nh_ball_fit_solve(nh_ball_fit *fit);

/* log10(|sum_j c_j e_j| / max_j |c_j e_j|) at the point at which the ball stands, bounded rigorously for the coefficients found (which are
 * exact numbers by then).  False when an expression is not finite there. */
bool nh_ball_fit_residual(nh_ball_fit *fit, double *log10_ratio);

double nh_ball_fit_coefficient(const nh_ball_fit *fit, size_t j);

#endif
