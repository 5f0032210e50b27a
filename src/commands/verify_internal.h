/* verify_internal: what the verification of a current and that of a field share. */
#ifndef NH_VERIFY_INTERNAL_H
#define NH_VERIFY_INTERNAL_H

#include "commands/verify.h"

/* What is asked: --current, --field, or --field --of equations.  `request` may be NULL. */
typedef struct {
    nh_system *system;
    nh_chart_choice chart;
    const char *text;
    const nh_options *options;
    const nh_request *request;
} nh_verification_question;
nh_verification *nh_verification_ask_current(nh_verification_question question, nh_error *error);
nh_verification *nh_verification_ask_field(nh_verification_question question, nh_error *error);
nh_verification *nh_verification_ask_motions(nh_verification_question question, nh_error *error);

/* Takes the system, and derives its model.  NULL: failed. */
nh_verification *nh_verification_start(nh_verification_question question, nh_error *error);

/* typed[begin .. begin + length) as a function of the system, with the names of verify_names.c; a field of these names,
 * in the chart, which is added to `out`. */
bool nh_verification_read(nh_verification *v, const char *option, const char *typed, size_t begin, size_t length,
                          nh_ex *out, nh_error *error);
bool nh_verification_read_field(nh_verification *v, const char *typed, nh_field *out, nh_error *error);

/* The verdict; for a run that was ended neither "yes" nor "no" is known: NULL, as for one that is not `good`. */
nh_verification *nh_verification_complete(nh_verification *v, bool good, nh_error *error);

/* The points at which expressions that should vanish are evaluated. */
nh_points *nh_verification_points(nh_model *model, const nh_options *options, nh_error *error);

/* Does the sum e of the n terms vanish, by this proof, or to all digits that a proof needs?  Otherwise the point where
 * |e| / sum of |terms| is largest becomes v->counterexample, with v->rate.  v->residual: the largest such ratio. */
bool nh_verification_vanishes(nh_verification *v, const nh_points *points, size_t n, const nh_ex *term,
                              const nh_proof *proof, const nh_options *options);

/* Is v->current conserved?  `conserved`, `region`, `proof` or the counterexample.  False: it is real nowhere, or the
 * domain has too few points. */
bool nh_verification_decide(nh_verification *v, const nh_options *options, nh_error *error);

/* The symmetry of a conserved quantity, and whether it is trivial. */
bool nh_verification_describe(nh_verification *v, const nh_options *options, nh_error *error);

#endif
