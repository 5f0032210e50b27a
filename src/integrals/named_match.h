/* named_match: solutions of u'' = P u' + Q u, P and Q rational in x, by functions that have names.
 *
 *     three regular singular points           Gauss's function of a Moebius variable, times powers [DLMF 15.11]
 *     a conjugate pair and infinity           Riemann's equation with real coefficients
 *     R = B/x^2                               powers of x, with logarithms in waves
 *     R = A x^m + B/x^2                       Airy; Bessel, sqrt(x) J_n(.. x^((m + 2)/2)) [DLMF 10.13]
 *     R = A + B/x + C/x^2, A x^2 + B x + C,
 *     A x^2 + C + D/x^2                       Kummer's functions [DLMF 13.14, 12.7]
 *
 * where u = g v with g'/g = P/2 and v'' = R v.  The result is a proposal: the caller proves it. */
#ifndef NH_NAMED_MATCH_H
#define NH_NAMED_MATCH_H

#include "integrals/named_variable.h"

/* The value of an expression at a typical point, parameters included: decides
 * which real solution is meant. */
typedef double nh_named_value_of(void *context, nh_ex e);

/* Up to two solutions, with `meaning` substituted for the variable.  Returns their number. */
size_t nh_named_match(nh_dag *dag, const nh_named_equation *equation, nh_named_value_of *value, void *context,
                      nh_ex out[2]);

#endif
