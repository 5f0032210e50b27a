/* named_function: derivatives of the functions that have a name but no
 * elementary form.
 *
 *     f'' = P(x) f' + Q(x) f,   and f' is a function of the language: f_prime
 * [DLMF]
 *
 * so that the derivatives of an expression are polynomials in f, f' and known
 * functions: what is zero after that is zero. */
#ifndef NH_NAMED_FUNCTION_H
#define NH_NAMED_FUNCTION_H

#include "graph/dag.h"

/* The derivative of the named function e with respect to its argument i; not a
 * number where that has no closed form. */
nh_ex nh_named_function_rate(nh_dag *dag, nh_ex e, size_t i);

/* `text` with the letters of nh_function_arguments for `argument`, f for the
 * function, g for its derivative; F and G are those of `other`. False where it
 * divides by zero. */
bool nh_named_function_read(nh_dag *dag, const char *text, nh_function f, nh_function other, const nh_ex *argument,
                            nh_ex *out);

/* f of f and of f_prime, and f_prime of f, for functions before the elliptic
 * integrals. */
nh_function nh_named_function_base(nh_function f);

#endif
