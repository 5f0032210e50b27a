/* special_values: irreducible polynomials over the rationals from their residues modulo several primes, and their
 * zeros: values of one parameter, curves of two, surfaces of three.
 *
 * Modulo each prime the zeros are those of a polynomial that is squarefree and free of what belongs to a point
 * (common_zeros.h).  Its coefficients are lifted by the Chinese remainder theorem and rational reconstruction, which
 * one more prime has to confirm.  Then it is factored over the integers. */
#ifndef NH_SPECIAL_VALUES_H
#define NH_SPECIAL_VALUES_H

#include "classify/common_zeros.h"

/* A factor irreducible over Q: sum of coefficient[(k * (degree[1] + 1) + j) * (degree[0] + 1) + i] lambda^i mu^j nu^k,
 * with whole coefficients without common factor, the leading one positive.  A parameter that does not occur has degree
 * 0. */
typedef struct {
    size_t degree[NH_MOST_PARAMETERS];
    int64_t *coefficient; /* on the heap */
} nh_special_factor;

typedef struct {
    bool lifted; /* one more prime confirmed the result */
    size_t factors;
    nh_special_factor *factor;
    double norm; /* sum of the absolute values of the coefficients of their product */
} nh_special_factors;

/* Lifts monic polynomials of the same degrees, given modulo several primes. */
nh_special_factors nh_special_lift(size_t primes, const nh_prime *prime, const nh_residue_polynomial *residue);
void nh_special_factors_clear(nh_special_factors *factors);

bool nh_special_same(const nh_special_factor *a, const nh_special_factor *b);
/* A copy with coefficients of its own. */
nh_special_factor nh_special_copy(const nh_special_factor *factor);
/* The number of its coefficients. */
size_t nh_special_length(const nh_special_factor *factor);
/* The first parameter in which it has this degree, or any degree above 0 for `degree` 0; NH_MOST_PARAMETERS: none. */
int nh_special_variable(const nh_special_factor *factor, size_t degree);
/* Is it a polynomial in one parameter alone, of degree 1: does this parameter have the value top/bottom? */
bool nh_special_rational(const nh_special_factor *factor, int64_t *top, int64_t *bottom);

/* A zero modulo the prime, chosen by the number: the least root in one parameter, with the others at random; false:
 * none was found. */
bool nh_special_point(const nh_special_factor *factor, nh_prime field, uint64_t seed,
                      nh_residue at[NH_MOST_PARAMETERS]);

/* The real zeros in parameter v where the others have these values, as doubles, ascending, into `out` (room for the
 * degree in v); returns their number. */
size_t nh_special_reals(const nh_special_factor *factor, int v, const double at[NH_MOST_PARAMETERS], double *out);

/* Do the factors contain all zeros of the squarefree polynomial modulo the prime, where parameter v (none for
 * NH_MOST_PARAMETERS) has this value?  False where one of them vanishes for all values of the others. */
bool nh_special_cover(size_t factors, const nh_special_factor *factor, nh_prime field, int v, nh_residue value,
                      const nh_residue_polynomial *polynomial);

/* The zeros common to equations: each but the last one is of degree 1 in the parameter that it gives, which occurs in
 * none that follow; the last one is irreducible. */
typedef struct {
    size_t count;
    int gives[NH_MOST_PARAMETERS];
    nh_special_factor equation[NH_MOST_PARAMETERS]; /* coefficients are borrowed */
} nh_special_place;

/* Does the factor vanish in all points of the place? */
bool nh_special_contains(const nh_special_factor *factor, const nh_special_place *place);

#endif
