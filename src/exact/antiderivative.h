/* antiderivative: closed forms of integrals in one variable.
 *
 *     F with dF/dx = f,   F = sum_j c_j g_j,   c_j in the field K of the constants
 *
 * f is a quotient of polynomials in kernels (kernel.h).  By Liouville's theorem an elementary F is of the same kind
 * plus logarithms of constants times new functions, whose arguments the denominator shows; the g_j are the candidates
 * of the parallel Risch algorithm [Bronstein2007], with arctangents in place of complex logarithms:
 *
 *     monomials of the kernels over the denominator, each factor of which has lost one power
 *     log p              for each factor p of the denominator
 *     atan, atanh        for a factor that is quadratic in a kernel, or linear in a sine and its cosine; for roots of
 *                        quadratic polynomials
 *     elliptic integrals, where they are asked for, for the root of a + b sin(u)^2 or a + b cos(u), of u or u/2
 *
 * The c_j come from an exact linear system (relation.h), which also proves dF/dx = f.  Where there is no such F, powers
 * of a logarithm or an inverse function are integrated by parts.  That no F is found proves nothing. */
#ifndef NH_ANTIDERIVATIVE_H
#define NH_ANTIDERIVATIVE_H

#include "graph/expr.h"

typedef struct {
    nh_dag *dag;
    nh_ex x;
    size_t constants;
    const nh_ex *constant; /* symbols: parameters, and constants of earlier integrations */
    size_t max_terms;      /* largest number of terms of polynomials; 0: the default of relation.h */
    bool elliptic;         /* elliptic integrals of an angle are candidates, too */
    bool within_half_turn; /* these with amplitudes from -pi/2 to pi/2, which jump */
    /* The sign of a function of x and the constants wherever F is needed; 0: it changes, or is not known.  It chooses
     * among the forms of a real logarithm. */
    int (*sign)(void *context, nh_ex e);
    /* Where the sign of a radicand changes from motion to motion: the sign for which F shall be real; 0 or NULL: none
     * is chosen. */
    int (*mostly)(void *context, nh_ex e);
    void *context;
} nh_integration;

bool nh_antiderivative(const nh_integration *integration, nh_ex f, nh_ex *F);

/* exp(-F) up to a constant factor, as powers where F has logarithms: |p| may be p in them. */
nh_ex nh_antiderivative_factor(nh_dag *dag, nh_ex F);

#endif
