/* verify_internal: what the verification of a current and that of a field share. */
#ifndef NH_VERIFY_INTERNAL_H
#define NH_VERIFY_INTERNAL_H

#include "commands/verify.h"

/* Takes the system, and derives its model.  NULL: failed. */
nh_verification *nh_verification_start(nh_system *system, nh_chart_choice chart, const nh_options *options,
                                       nh_error *error);

/* The verdict; for a run that was ended neither "yes" nor "no" is known: NULL, as for one that is not `good`. */
nh_verification *nh_verification_complete(nh_verification *v, bool good, nh_error *error);

/* The points at which expressions that should vanish are evaluated. */
nh_points *nh_verification_points(nh_model *model, const nh_options *options, nh_error *error);

/* Finds the point where |e| / sum of |terms| is largest, e the sum of the n terms: *residual, v->counterexample and
 * v->rate.  False: it vanishes at all of them. */
bool nh_verification_worst_point(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term,
                                 double *residual);

/* Is it zero by this proof and this residual? */
bool nh_verification_accepts(const nh_proof *proof, double residual, const nh_options *options);

/* The symmetry of a conserved quantity, and whether it is trivial. */
bool nh_verification_describe(nh_verification *v, const nh_options *options, nh_error *error);

#endif
