/* named_function: derivatives of the functions that have a name but no
 * elementary form.
 *
 *     f'' = P(x) f' + Q(x) f,   and f' is a function of the language: f_prime
 * [DLMF]
 *
 * so that the derivatives of an expression are polynomials in f, f' and known functions; when such a polynomial is zero
 * the expression vanishes. */
#ifndef NH_NAMED_FUNCTION_H
#define NH_NAMED_FUNCTION_H

#include "graph/function.h"

/* The derivative of the named function e with respect to its argument i; not-a-number where it has no closed form. */
nh_ex nh_named_function_rate(nh_dag *dag, nh_ex e, size_t i);

/* `text` with the letters of nh_function_arguments for `argument`, f for the
 * function, g for its derivative; F and G are those of `other`. False where it
 * divides by zero. */
bool nh_named_function_read(nh_dag *dag, const char *text, nh_function f, nh_function other, const nh_ex *argument,
                            nh_ex *out);

/* Does an incomplete elliptic integral stand in e? */
bool nh_named_function_has_elliptic(const nh_dag *dag, nh_ex e);

/* The function f for f and for f_prime; any function from the elliptic integrals on in the list is returned itself. */
nh_function nh_named_function_base(nh_function f);

#endif
