/* special_curves: plane algebraic curves from their residues modulo several primes; surfaces likewise.
 *
 * As special_values.h, for polynomials in two and three variables: Chinese remainder theorem, rational reconstruction,
 * which one more prime has to confirm, and factorization over the integers. */
#ifndef NH_SPECIAL_CURVES_H
#define NH_SPECIAL_CURVES_H

#include "classify/common_curves.h"
#include "classify/special_values.h"

/* A factor irreducible over Q: sum of coefficient[(k * (degree[1] + 1) + j) * (degree[0] + 1) + i] lambda^i mu^j nu^k,
 * with whole coefficients without common factor. */
typedef struct {
    size_t degree[3];
    int64_t *coefficient; /* on the heap */
} nh_special_surface;
typedef nh_special_surface nh_special_curve; /* degree[2] is 0 without nu */

typedef struct {
    bool lifted;     /* one more prime confirmed the result */
    size_t surfaces; /* or curves */
    nh_special_surface *surface;
    double norm; /* sum of the absolute values of the coefficients of their product */
} nh_special_surfaces;

/* Lifts monic polynomials of the same degrees, given modulo several primes. */
nh_special_surfaces nh_special_surfaces_lift(size_t primes, const nh_prime *prime, const nh_residue_surface *residue);
void nh_special_surfaces_clear(nh_special_surfaces *surfaces);
bool nh_special_surface_same(const nh_special_surface *a, const nh_special_surface *b);
/* A copy with coefficients of its own. */
nh_special_surface nh_special_surface_copy(const nh_special_surface *surface);

/* A point of the curve modulo the prime, chosen by the number; false: it was not found. */
bool nh_special_curve_point(const nh_special_curve *curve, nh_prime field, uint64_t seed, nh_residue *lambda,
                            nh_residue *mu);

/* The other coordinate of its real points where lambda (0) or mu (1) has this value, ascending, into `out` (room for
 * the degree in that coordinate); returns their number. */
size_t nh_special_curve_reals(const nh_special_curve *curve, int fixed, double value, double *out);

/* Do all points with these lambda and the rational number mu lie on the curve? */
bool nh_special_curve_contains(const nh_special_curve *curve, const nh_special_factor *lambda, int64_t top,
                               int64_t bottom);

#endif
