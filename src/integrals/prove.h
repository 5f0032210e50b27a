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
    bool proved;          /* exactly zero, at least for the given parameters */
    bool all_parameters;  /* for all parameter values */
    /* else, where it is proved for all values of some: the others, which must have theirs; NULL: for the given values
       only */
    const nh_ex *fixed;
    double digits;        /* of cancellation, least over the points; 0 when it could not be evaluated */
    size_t points;        /* that could be evaluated */
    /* numbers in it were too long for exact rationals: more than a double's digits cannot be asked for */
    bool rounded;
    bool refuted;         /* a ball excludes zero: Phi with these coefficients is not conserved */
} nh_proof;

/* Gamma(Phi) term by term, one for each direction: 1 + m + n of them. */
void nh_rate_terms(const nh_model *model, nh_ex phi, nh_ex *term);

/* What is known of a current. */
typedef struct {
    /* its coefficients hold for all parameter values, so that step 1 makes sense; but for those fixed: */
    bool free;
    const nh_ex *fixed; /* what must have its value, or be related to others (integrals/fixed.h); NULL: none must */
    bool related;      /* an exact relation of its terms' rates is the proof */
    /* set by the proof: Phi holds numbers that are no rationals, whose sums may come out whole; nothing is proved of
       it */
    bool rounded;
} nh_claim;
/* The three steps of docs/method.md, sec. 4, "Proof", on Gamma(phi): for all parameter values, for the given ones, in
 * balls.  What the claim leaves out is not tried. */
nh_proof nh_prove_claim(const nh_model *model, nh_ex phi, nh_claim claim, const nh_options *options);

/* `parameters_free`: the claim's `free`, with nothing fixed. */
nh_proof nh_prove_current(const nh_model *model, nh_ex phi, bool parameters_free, const nh_options *options);

/* The same for any expression that should vanish on the submanifold. */
nh_proof nh_prove_zero(const nh_model *model, size_t terms, const nh_ex *term, bool parameters_free,
                       const nh_options *options);

/* Of two statements together. */
nh_proof nh_proof_both(const nh_model *model, nh_proof a, nh_proof b);

/* Only the digits of step 3: a few evaluations. */
double nh_prove_digits(const nh_model *model, nh_ex phi, const nh_options *options);

#endif
