/* named_value: values of Legendre, hypergeometric, Bessel and Airy functions
 * and of elliptic integrals, with rigorous bounds (Arb). */
#ifndef NH_NAMED_VALUE_H
#define NH_NAMED_VALUE_H

#include <complex.h>
#include <stdbool.h>

#ifndef CMPLX /* clang before 15 with the C library's header */
#define CMPLX(x, y) __builtin_complex((double)(x), (double)(y))
#endif

#include "evaluate/arb.h"
#include "graph/function.h"

/* f of the arguments that it takes.  Not finite where it is not real. */
void nh_named_value_ball(nh_function f, arb_srcptr argument, arb_t out, slong bits);

/* Correct to the last digits of a double, however many digits that needs; not-a-number where f is not real or too
 * hard. */
double nh_named_value(nh_function f, const double *argument);

/* At a complex point near the real axis. */
double complex nh_named_value_complex(nh_function f, const double complex *argument);

/* Solutions of (1 + z^2)^2 y'' = (a + b z + c z^2) y, with rigorous bounds (Arb).
 *
 * The first has y(0) = 1 and y'(0) = 0, the second 0 and 1; `prime` asks for y'. */

/* argument: a, b, c, z; the series are computed to about so many bits. */
void nh_riemann(acb_t out, bool second, bool prime, acb_srcptr argument, slong bits);

/* The same at a real place, which is fast where many places have the same a, b and c; not finite where one of them is
 * not. */
void nh_riemann_at(arb_t out, bool second, bool prime, const double *place, slong bits);

#endif
