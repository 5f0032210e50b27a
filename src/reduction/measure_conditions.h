/* measure_conditions: for which parameters a reduced Chaplygin system has an invariant measure, or becomes Hamiltonian
 * by a conformal factor (chaplygin.h).
 *
 *     T^k_ij = (Khat^-1)^kl U_lij,      Theta_j = T^i_ij
 *     measure:  d_i Theta_j - d_j Theta_i = 0        factor:  that, and  T^k_ij - (Theta_j delta^k_i - Theta_i
 *                                                    delta^k_j)/(n - 1) = 0
 *
 * as expressions; each vanishes for the parameters that exact/parameter_zeros.h finds. Where they are too long for
 * that, once more with fewer parameters (base_parameters.h); and where that is too long, a value modulo a prime proves
 * that they do not vanish for almost all parameters (exact/generic_value.h). */
#ifndef NH_MEASURE_CONDITIONS_H
#define NH_MEASURE_CONDITIONS_H

#include "base/memory.h"
#include "exact/parameter_zeros.h"
#include "graph/expr.h"
#include "reduction/slice.h"

/* Fewer parameters for the same expressions.
 *
 * A kinetic energy is linear in masses and moments of inertia: e_i = e_i0 + sum_j mu_j d e_i/d mu_j.  Where a column d
 * e/d mu_j is a combination of others with coefficients c_jB in the other parameters, mu_j may be 0 when every mu_B is
 * sum_j c_jB mu_j more: what is left are the base parameters of robotics [GautierKhalil1990]. */

typedef struct {
    size_t count;
    nh_ex *parameter, *meaning; /* the expression that a remaining parameter stands for */
} nh_base_parameters;

/* Rewrites n entries, functions of the variables.  False: no parameter can be eliminated. */
bool nh_base_parameters_of(nh_arena *arena, nh_dag *dag, size_t n, nh_ex *entry, size_t variables,
                           const nh_ex *variable, size_t parameters, const nh_ex *parameter, nh_base_parameters *out);

/* ---- measure conditions ---- */

typedef struct {
    bool factor; /* of a conformal factor; else of the measure */
    nh_parameter_zeros where;
} nh_measure_condition;

typedef struct {
    bool known;                    /* false: an expression is too large */
    bool rare;                     /* then: for almost all parameters there is no measure, proved */
    bool never, never_hamiltonian; /* for positive values of the parameters no measure, or no factor: proved */
    size_t count;                  /* conditions, all of which must hold; those that are the same only once */
    nh_measure_condition *condition;
} nh_measure_conditions;

/* K (n x n), U (n x n x n) as for nh_chaplygin_measure_of. */
nh_measure_conditions nh_measure_conditions_of(nh_arena *arena, const nh_slice *slice, const nh_ex *K, const nh_ex *U);

#endif
