/* higher_internal: the equations of motion as polynomials, as the parts of higher.c share them. */
#ifndef NH_HIGHER_INTERNAL_H
#define NH_HIGHER_INTERNAL_H

#include "absence/higher.h"
#include "evaluate/arb.h"

enum { NH_HIGHER_ALONG, NH_HIGHER_ACROSS, NH_HIGHER_DIRECTIONS };
enum { NH_HIGHER_DEGREE = 12 }; /* of f and g in each letter, at most */

/* A polynomial in u and z with rational coefficients that are not 0. */
typedef struct {
    size_t count;
    unsigned char *u, *z; /* exponents, per term */
    fmpq *coefficient;
} nh_higher_polynomial;

/* u'' = rate[0], z'' = rate[1] */
typedef struct {
    nh_higher_polynomial rate[NH_HIGHER_DIRECTIONS];
    fmpq_poly_t curve;  /* sigma, of degree 3; sigma' = 2 f(u, 0) */
    fmpq_poly_t normal; /* dg/dz(u, 0), of degree 1 at most: z_1'' = normal(u_0) z_1 */
    slong exponent;     /* n: normal has the leading coefficient n (n + 1) sigma_3/4 */
} nh_higher_system;

/* 0 everywhere; the caller clears it. */
void nh_higher_system_init(nh_higher_system *s);
void nh_higher_system_clear(nh_higher_system *s);
/* The polynomial e in the symbols u and z; false: it is none with rational coefficients, or too large.  p is empty
 * before. */
bool nh_higher_polynomial_of(nh_dag *dag, nh_ex e, nh_ex u, nh_ex z, nh_higher_polynomial *p);
/* The terms with the z-th power of z. */
void nh_higher_polynomial_part(const nh_higher_polynomial *p, unsigned z, fmpq_poly_t out);
/* Fills curve, normal and exponent from the rates and the square of u' on the motion; NULL, or why they are not as
 * above. */
const char *nh_higher_system_complete(nh_higher_system *s, const nh_higher_polynomial *square);

typedef struct {
    unsigned order; /* 0: none is seen */
    bool across;
    slong power;
} nh_higher_logarithm;

/* The first order up to `most` at which a logarithm is seen modulo the prime, for some fixed values of the constants.
 * False: a denominator, or the leading coefficient of sigma, is 0 modulo the prime, the prime is below 2^16, so that
 * the factors of the recursion might be 0, or the series get too long. */
bool nh_higher_logarithm_find(const nh_higher_system *s, ulong prime, unsigned most, nh_higher_logarithm *out);

/* A closed path of the motion with a multiplier whose absolute value is not 1, with balls of so many bits: the trace
 * of its matrix, and the absolute value of the multiplier.  False: none is certain. */
bool nh_higher_multiplier(const nh_higher_system *s, long bits, acb_t trace, arb_t size);
/* A solution P(u), or u' P(u) where `odd`, of the normal equation; false: there is none. */
bool nh_higher_solution(const nh_higher_system *s, fmpq_poly_t P, bool *odd);

#endif
