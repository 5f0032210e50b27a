/* special_values: algebraic numbers from their residues modulo several primes.
 *
 * Modulo each prime the special values are roots of a polynomial, which is squarefree and free of what belongs to a
 * point (nh_special_common). Its coefficients are lifted by the Chinese remainder theorem and rational reconstruction;
 * one prime more has to agree. Then it is factored over the integers. */
#ifndef NH_SPECIAL_VALUES_H
#define NH_SPECIAL_VALUES_H

#include "classify/staircase.h"

/* At two points: roots of chi, and of Q, where the equations at that point say nothing. Common to both points: of
 * either, `excluded`; of Q, degenerate ones `degenerate`; squarefree. */
typedef struct {
    nh_residue_polynomial excluded, degenerate; /* without, and alone the degenerate ones */
} nh_special_roots;
nh_special_roots nh_special_common(nh_prime field, const nh_residue_polynomial chi[2],
                                   const nh_residue_polynomial Q[2]);
void nh_special_roots_clear(nh_special_roots *roots);

/* Irreducible over Q: whole coefficients without common factor, the highest is positive. */
typedef struct {
    size_t degree;
    int64_t *coefficient;    /* degree + 1, from the constant term on; on the heap */
} nh_special_factor;

typedef struct {
    bool lifted;             /* the last prime agreed */
    size_t factors;
    nh_special_factor *factor;
    double norm;             /* sum of the sizes of the coefficients of their product */
} nh_special_factors;

/* Monic polynomials of one degree modulo several primes. */
nh_special_factors nh_special_lift(size_t primes, const nh_prime *prime, const nh_residue_polynomial *residue);
/* Has their product modulo the prime the roots of this polynomial, which is monic and squarefree? */
bool nh_special_agrees(const nh_special_factors *factors, nh_prime field, const nh_residue_polynomial *polynomial);
void nh_special_factors_clear(nh_special_factors *factors);

/* The least root modulo the prime, where there is one. */
bool nh_residue_polynomial_root(const nh_residue_polynomial *p, nh_prime field, nh_residue *root);
bool nh_special_root(const nh_special_factor *factor, nh_prime field, nh_residue *root);

/* Its real roots, ascending, as doubles; their number.  `out` has room for `degree`. */
size_t nh_special_reals(const nh_special_factor *factor, double *out);
/* The same for coefficients from the constant term on. */
size_t nh_special_roots_of(size_t degree, const double *coefficient, double *out);

#endif
