/* parameter_zeros: for which values of the parameters an expression vanishes identically in everything else.
 *
 *     e = prod_f f^power / denominator,    f = sum_m a_fm m
 *
 * with monomials m in the kernels that are not constant (modulo what these satisfy, such as sin^2 + cos^2 = 1) and
 * polynomials a_fm in the constant ones: e vanishes iff for some factor f all a_fm do. */
#ifndef NH_PARAMETER_ZEROS_H
#define NH_PARAMETER_ZEROS_H

#include "base/memory.h"
#include "graph/expr.h"

/* One way: all of these polynomials vanish. */
typedef struct {
    size_t count;
    nh_ex *polynomial;
} nh_parameter_zeros_way;

typedef struct {
    size_t ways; /* 0: e never vanishes */
    nh_parameter_zeros_way *way;
} nh_parameter_zeros;

/* `parameter`: the symbols that count as constants.  False where the expression is too large, or an inexact constant
   occurs. */
bool nh_parameter_zeros_find(nh_arena *arena, nh_dag *dag, nh_ex e, size_t parameters, const nh_ex *parameter,
                             nh_parameter_zeros *out);

/* A polynomial without a numerical factor and sign, simplified. */
nh_ex nh_parameter_zeros_polynomial(nh_dag *dag, nh_ex e);
/* Can positive parameters satisfy one of the ways?  Not a way with a polynomial whose coefficients all have one
 * sign. */
bool nh_parameter_zeros_may_be_positive(nh_dag *dag, const nh_parameter_zeros *zeros);

#endif
