/* prove: is Gamma(Phi) = 0 exactly?
 *
 * 1. The normal form of Gamma(Phi) with every parameter an indeterminate: zero is a proof for all parameter values.
 * 2. The same with the parameters at their given exact values: a proof for these.
 * 3. Ball arithmetic at random rational points, 256 bits and more: the number of digits to which the terms of
 *    Gamma(Phi) cancel. A formal near-integral cancels to 13 digits, a true one to as many as were computed. */
#ifndef NH_PROVE_H
#define NH_PROVE_H

#include "base/option.h"
#include "geometry/model.h"

typedef struct {
    bool proved;         /* exactly zero, at least for the given parameters */
    bool all_parameters; /* for all parameter values */
    /* not for all values: the parameters that must have their values, where the others are free; NULL: proved for the
     * given values only */
    const nh_ex *fixed;
    double digits; /* of cancellation, least over the points; 0 when it could not be evaluated */
    size_t points; /* number of points at which it could be evaluated */
    /* its numbers were too long for exact rationals: only a double's digits can be expected */
    bool rounded;
    bool sided;   /* proved where paired roots have the signs that they have at the probes (geometry/model.h) */
    bool refuted; /* a ball excludes zero: Phi with these coefficients is not conserved */
} nh_proof;

/* Gamma(Phi) term by term, one for each direction: 1 + m + n of them. */
void nh_rate_terms(const nh_model *model, nh_ex phi, nh_ex *term);

/* What is known of a current. */
typedef struct {
    /* its coefficients hold for all parameter values, except for the fixed ones, so that step 1 makes sense */
    bool free;
    /* parameters that must have their values, or be related to others (integrals/fixed.h); NULL: none */
    const nh_ex *fixed;
    bool related; /* an exact relation of its terms' rates is the proof */
    /* set by the proof: Phi contains numbers that are no rationals, whose sums may be whole numbers by rounding;
     * nothing is proved of it */
    bool rounded;
} nh_claim;
/* The three steps of docs/method.md, sec. 4, "Proof", on Gamma(phi): for all parameter values, for the given ones, in
 * balls.  Steps that the claim excludes are left out. */
nh_proof nh_prove_claim(const nh_model *model, nh_ex phi, nh_claim claim, const nh_options *options);

/* `parameters_free`: the claim's `free`, with nothing fixed. */
nh_proof nh_prove_current(const nh_model *model, nh_ex phi, bool parameters_free, const nh_options *options);

/* The same for any expression that should vanish on the submanifold. */
nh_proof nh_prove_zero(const nh_model *model, size_t terms, const nh_ex *term, bool parameters_free,
                       const nh_options *options);

/* The weaker of two statements: what holds of both. */
nh_proof nh_proof_both(const nh_model *model, nh_proof a, nh_proof b);

/* Only the digits of step 3: a few evaluations. */
double nh_prove_digits(const nh_model *model, nh_ex phi, const nh_options *options);

#endif
