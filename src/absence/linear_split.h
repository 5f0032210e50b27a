/* linear_split: linear equations as sums of smaller ones.
 *
 * A constant rational change of the unknowns that makes A(x) block triangular, or block diagonal: subspaces that all
 * coefficients of A in x leave invariant.  They are found from kernels of elements of the algebra of these coefficients
 * (the "meataxe" of computational representation theory); what is not found is not split. */
#ifndef NH_LINEAR_SPLIT_H
#define NH_LINEAR_SPLIT_H

#include "absence/linear_equation.h"

/* The diagonal blocks, at least one if the size is not 0; the caller clears each and frees the array by nh_free.
 * `triangular`: something stands above them, so that they are quotients of invariant subspaces; else the equation is
 * their direct sum.  Returns their number. */
size_t nh_linear_equation_split(const nh_linear_equation *equation, nh_linear_equation **blocks, bool *triangular);

#endif
