/* lift: the coefficients of an integral of which the terms are known (construct.h).
 *
 *     Phi = sum_j c_j f_j,   sum_j c_j Gamma(f_j) = 0
 *
 * Modulo a prime every random point gives one linear equation, and a few points more than terms determine the c_j,
 * for c_0 = 1.  At fixed residues of the parameters they are numbers; where four times one parameter makes some of
 * them 4^k times as large, and four times all of them multiplies the others by 4^D, the c_j are sums of these
 * monomials in the parameters (four, so that roots of parameters in the terms have values at both places), whose
 * rational coefficients then follow from points with random parameters.  Several primes give the fractions. Nothing
 * of this is a proof: that is the caller's. */
#ifndef NH_LIFT_H
#define NH_LIFT_H

#include "geometry/model.h"

typedef struct {
    nh_ex integral; /* 0: none was found */
    bool general;   /* for all parameters */
    double work;    /* products of residues */
} nh_lift_result;

/* The integral with these terms, f_0 with the coefficient 1: for all parameters where its coefficients are polynomials
 * in them, otherwise for the given values.  `time`: terms may depend on t.  `most`: limit of work. */
nh_lift_result nh_lift(const nh_model *model, bool time, size_t terms, const nh_ex *term, double most);

/* The coefficients of these terms in an integral for all parameters, if there are any, where with one of the first few
 * terms, or `pivot`, as f_0 they are polynomials.  `like`: at the parameters' values they are these numbers, up to a
 * factor.  False: there are none. */
bool nh_lift_coefficients(const nh_model *model, size_t terms, const nh_ex *term, const double *like, size_t pivot,
                          double most, nh_ex *coefficient);

#endif
