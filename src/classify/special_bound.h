/* special_bound: how long the numbers can be at which a linear system with a parameter loses rank.
 *
 * Let D Gamma have polynomials with whole coefficients in the coordinates, the velocities and lambda, and q0 whole
 * coordinates. The equations for derivatives of c_alpha at q0 have whole coefficients: in the row of w^beta and of the
 * derivative e
 *
 *     sum over f <= e of binomial(e, f) d^f G(q0) d^(e - f) c,        sum over f of binomial(e, f) |d^f q^g| <= (|q0| +
 *     e)^g.
 *
 * Sines and cosines of single coordinates are taken where the tangent of half the angle is a whole number u:
 * sin = 2 u/h, cos = (1 - u^2)/h, h = 1 + u^2. A derivative d^f of sin^i cos^j, m = i + j, is a form of degree m in
 * both whose coefficients have the sum of sizes m^f at most: times h^m it is whole and at most m^f h^m, and the sum
 * over f of binomial(e, f) m^f is (1 + m)^e. A coordinate, its sine and its cosine may have values that do not belong
 * together: they are algebraically independent but for sin^2 + cos^2 = 1, so that a minor that is not zero there is not
 * zero at almost all points.
 *
 * A minor m(lambda) of size R is at most the product of the R largest sums of sizes in a row, which also bounds the
 * leading coefficient and Mahler's measure of everything that divides it [docs/method.md, sec. 11]. */
#ifndef NH_SPECIAL_BOUND_H
#define NH_SPECIAL_BOUND_H

#include "classify/parametric.h"

typedef struct {
    /* log2 of an upper bound for the leading coefficient and Mahler's measure of D(q0, lambda) m(lambda) */
    double bits;
    double degree; /* an upper bound for its degree */
} nh_special_bound;

/* The bound for the equations of this degree and parity up to the weight order - 1, at these whole coordinates, none of
 * them zero.  False: D Gamma is not of this kind. */
bool nh_special_bound_find(const nh_parametric *family, size_t degree, nh_parity parity, size_t order,
                           const int64_t *coordinate, size_t rank, nh_special_bound *out);

/* The tangent of half the angle that is taken where this whole coordinate is chosen. */
int64_t nh_special_bound_tangent(int64_t coordinate);

#endif
