/* print_quotient: expressions from the parts of quotients (normal_quotient.h). */
#ifndef NH_PRINT_QUOTIENT_H
#define NH_PRINT_QUOTIENT_H

#include "exact/kernel.h"
#include "exact/normal_quotient.h"

/* constant * monomial * prod factor^power; sin/cos in the monomial becomes tan, which is always shorter.  With
 * `collect` the factors are written as x*(a + b) + c instead of a*x + b*x + c; that needs the kernels' lengths. */
nh_ex nh_print_quotient_product(const nh_kernels *kernels, const nh_pieces *pieces, bool collect);

/* The terms of the numerator, each over the denominator: for quotients that are not factored. */
nh_ex nh_print_quotient_terms(const nh_kernels *kernels, const nh_pieces *pieces);

/* Bounds from below of the lengths of these (nh_complexity), without building them: a form that is no shorter than what
 * is there need not be. */
size_t nh_print_quotient_product_least(const nh_kernels *kernels, const nh_pieces *pieces, bool collect);
size_t nh_print_quotient_terms_least(const nh_kernels *kernels, const nh_pieces *pieces);

#endif
