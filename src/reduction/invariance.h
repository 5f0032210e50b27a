/* invariance: does a field on configuration space leave the metric, the potential and the constraints invariant?
 *
 *     (L_xi K)_rs = xi^l d_l K_rs + K_ls d_r xi^l + K_rl d_s xi^l = 0,        xi(V) = 0,
 *     xi^s d_s f^A + v^r (d_r xi^s) df^A/dv^s = 0   where f = 0               (the field, prolonged to velocities, is
 *                                                   tangent to f = 0)
 *
 *     (L_xi Q)_s = xi(Q_s), prolonged to velocities, + Q_l d_s xi^l = 0,      for forces without a potential
 *
 * For linear constraints the third one says that the flow maps D to itself.  Where the Lagrangian is not of the form K
 * - V the first two are replaced by the invariance of L under the prolonged field. */
#ifndef NH_INVARIANCE_H
#define NH_INVARIANCE_H

#include "base/text.h"
#include "integrals/prove.h"
#include "reduction/kinetic.h"

typedef struct {
    bool holds, proved, all_parameters; /* at the sample points; exactly; for all parameter values */
    const nh_ex *fixed;                 /* else the parameters that must have their values; NULL: all (nh_proof) */
    double residual;                    /* largest relative violation over the sample points */
} nh_condition;

/* A field with its components along the coordinates. */
typedef struct {
    const char *name; /* NULL unless the user gave one */
    nh_ex *component; /* m */
    nh_condition metric, potential, constraints, forces;
    bool invariant; /* do all conditions hold? */
    bool local;     /* many-valued on an angle: a field on a covering of the configuration space only */
} nh_generator;

/* Writes the m components along the coordinates to the generator (in the kinetic's arena), and checks its
 * conditions. */
void nh_generator_init(nh_generator *generator, const nh_kinetic *kinetic, const char *name, const nh_ex *component,
                       const nh_options *options);

/* The weakest of the proofs of its conditions. */
nh_proof nh_generator_proof(const nh_kinetic *kinetic, const nh_generator *generator);

/* The conditions as expressions: h of the metric (or 1: of L), 1 of the potential, f of the constraints and m of the
 * forces, where there are forces (both composed with the chart); `out` has room for h + 1 + f + m, h = m(m+1)/2.
 * Returns the number of those of the metric; *count: of all. */
size_t nh_invariance_equations(const nh_kinetic *kinetic, const nh_ex *component, nh_ex *out, size_t *count);

/* The potential without a constant factor. */
nh_ex nh_invariance_sum(const nh_kinetic *kinetic);

/* "-y d/dx + x d/dy + d/dtheta". */
void nh_generator_text(const nh_kinetic *kinetic, const nh_generator *generator, nh_text *out);

/* xi(e), and [xi, eta] of two fields. */
nh_ex nh_field_along(const nh_kinetic *kinetic, const nh_ex *component, nh_ex e);
void nh_field_bracket(const nh_kinetic *kinetic, const nh_ex *xi, const nh_ex *eta, nh_ex *out);

#endif
