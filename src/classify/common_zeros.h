/* common_zeros: the common zeros of polynomials in the parameters modulo a prime: numbers of one parameter, curves and
 * points of two, surfaces of three.
 *
 * Zeros of codimension one are those of the greatest common divisor.  With it divided out, every isolated zero of two
 * polynomials in lambda and mu has its mu among the roots of the resultants of random combinations; a root common to
 * two resultants belongs to a common zero, or to one at infinity, except by a coincidence of the random numbers.
 *
 * From the zeros where the last parameter has a value (a section), for several values, follow those for all: the
 * coefficients of a monic polynomial are rational functions of the value, found by the extended Euclidean algorithm,
 * which one more value has to confirm. */
#ifndef NH_COMMON_ZEROS_H
#define NH_COMMON_ZEROS_H

#include "classify/staircase.h"

/* Special zeros, degenerate ones, and what contains the isolated ones (1 where lambda is the only parameter). */
typedef enum { NH_ZEROS_SPECIAL, NH_ZEROS_DEGENERATE, NH_ZEROS_ACROSS, NH_ZEROS_PARTS } nh_zeros_part;

/* Their polynomials, all monic and squarefree, with coefficients on the heap. */
typedef struct {
    nh_residue_polynomial part[NH_ZEROS_PARTS];
    size_t nullity; /* of one parameter: of the linear system, for almost all values */
} nh_common_zeros;

/* Common zeros of all of `polynomial` are special; those common to all of `singular` are degenerate instead.
 * Polynomials in lambda, or in lambda and mu.  False: the deadline is over. */
bool nh_common_zeros_find(nh_prime field, size_t polynomials, const nh_residue_polynomial *polynomial, size_t singulars,
                          const nh_residue_polynomial *singular, nh_common_zeros *out);
void nh_common_zeros_clear(nh_common_zeros *zeros);

/* The product x y of polynomials in lambda and mu; its coefficients are on the heap. */
nh_residue_polynomial nh_residue_polynomial_times(nh_prime field, const nh_residue_polynomial *x,
                                                  const nh_residue_polynomial *y);

/* Zeros of the same degrees, by primes or by values of a parameter. */
enum { NH_ZEROS_MOST = 20 };
typedef struct {
    size_t count;
    uint64_t key[NH_ZEROS_MOST]; /* the index of the prime, or the value */
    nh_common_zeros at[NH_ZEROS_MOST];
} nh_common_zeros_list;

/* Takes the zeros.  Where their degrees or nullities differ from those of the list they are unlucky and freed; the
 * first ones are, when the second ones disagree with them. */
void nh_common_zeros_list_add(nh_common_zeros_list *list, uint64_t key, nh_common_zeros *zeros);
void nh_common_zeros_list_clear(nh_common_zeros_list *list);

/* The polynomial that has these sections at different values of parameter v, which is the last one; factors that depend
 * on it alone are left out.  False: there are too few. */
bool nh_residue_polynomial_from(nh_prime field, int v, size_t count, const uint64_t *value,
                                const nh_residue_polynomial *section, nh_residue_polynomial *out);
/* The same for all parts. */
bool nh_common_zeros_from(nh_prime field, int v, const nh_common_zeros_list *sections, nh_common_zeros *out);

#endif
