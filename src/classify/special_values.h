/* special_values: algebraic numbers from their residues modulo several primes.
 *
 * Modulo each prime the special values are roots of a polynomial, which is squarefree and free of what belongs to a
 * point (nh_special_common).  Its coefficients are lifted by the Chinese remainder theorem and rational reconstruction,
 * which one more prime has to confirm.  Then it is factored over the integers. */
#ifndef NH_SPECIAL_VALUES_H
#define NH_SPECIAL_VALUES_H

#include "classify/staircase.h"

/* Numbers that are, at both of two points, a root of chi or of Q (where Q vanishes, the equations at that point say
 * nothing): `degenerate` are those that are roots of Q at both points, `excluded` are the others.  Both polynomials are
 * squarefree. */
typedef struct {
    nh_residue_polynomial excluded, degenerate;
} nh_special_roots;
nh_special_roots nh_special_common(nh_prime field, const nh_residue_polynomial chi[2],
                                   const nh_residue_polynomial Q[2]);
void nh_special_roots_clear(nh_special_roots *roots);

/* A factor irreducible over Q: whole coefficients without common factor, the highest one positive. */
typedef struct {
    size_t degree;
    int64_t *coefficient; /* degree + 1, from the constant term on; on the heap */
} nh_special_factor;

typedef struct {
    bool lifted; /* one more prime confirmed the result */
    size_t factors;
    nh_special_factor *factor;
    double norm; /* sum of the absolute values of the coefficients of their product */
} nh_special_factors;

/* Lifts monic polynomials of one degree, given modulo several primes. */
nh_special_factors nh_special_lift(size_t primes, const nh_prime *prime, const nh_residue_polynomial *residue);
/* Modulo the prime: are all roots of this polynomial, which is monic and squarefree, roots of the product of the
 * factors? */
bool nh_special_agrees(const nh_special_factors *factors, nh_prime field, const nh_residue_polynomial *polynomial);
void nh_special_factors_clear(nh_special_factors *factors);

/* The least root modulo the prime; false where there is none. */
bool nh_residue_polynomial_root(const nh_residue_polynomial *p, nh_prime field, nh_residue *root);
bool nh_special_root(const nh_special_factor *factor, nh_prime field, nh_residue *root);

/* Its real roots as doubles, ascending, into `out` (room for `degree`); returns their number. */
size_t nh_special_reals(const nh_special_factor *factor, double *out);
/* The same for coefficients from the constant term on. */
size_t nh_special_roots_of(size_t degree, const double *coefficient, double *out);

#endif
