/* base_parameters: fewer parameters for the same expressions.
 *
 * A kinetic energy is linear in masses and moments of inertia: e_i = e_i0 + sum_j mu_j d e_i/d mu_j.  Where a column d
 * e/d mu_j is a combination of others with coefficients c_jB in the other parameters, mu_j may be 0 when every mu_B is
 * sum_j c_jB mu_j more: what is left are the base parameters of robotics [GautierKhalil1990]. */
#ifndef NH_BASE_PARAMETERS_H
#define NH_BASE_PARAMETERS_H

#include "base/memory.h"
#include "graph/expr.h"

typedef struct {
    size_t count;
    nh_ex *parameter, *meaning; /* the expression that a remaining parameter stands for */
} nh_base_parameters;

/* Rewrites n entries, functions of the variables.  False: no parameter can be eliminated. */
bool nh_base_parameters_of(nh_arena *arena, nh_dag *dag, size_t n, nh_ex *entry, size_t variables,
                           const nh_ex *variable, size_t parameters, const nh_ex *parameter, nh_base_parameters *out);

#endif
