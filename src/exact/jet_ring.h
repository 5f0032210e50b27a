/* jet_ring: power series in z_1..z_m modulo a prime, cut off behind a weighted order.
 *
 *     sum over e with |e| = sum_k weight_k e_k <= order of  c_e z^e
 *
 * A series is an array of `size` residues, its coefficients in the order of the exponents: by |e|, so that a prefix is
 * the series of a lower order.  Every operation that is not a product follows from the Euler field E = sum_k weight_k
 * z_k d/dz_k, (E y)_e = |e| y_e, coefficient by coefficient: for y = a^s, a E(y) = s E(a) y; for y = exp(u), E(y) =
 * E(u) y; for an integral, E(y) = E(u) f'(u).  The prime has to be larger than the order. */
#ifndef NH_JET_RING_H
#define NH_JET_RING_H

#include "base/memory.h"
#include "exact/residue.h"

typedef struct {
    nh_prime field;
    size_t variables, order, size;
    const size_t *weight;   /* variables */
    uint8_t *exponent;      /* size x variables */
    size_t *degree;         /* size: |e| */
    size_t *first;          /* order + 2: the first exponent of each |e| */
    uint32_t *before;       /* see nh_jet_ring_find */
    uint32_t *up;           /* variables x size: e + 1_k, or UINT32_MAX */
    uint32_t *variables_in; /* size: bit k % 32 for each e_k that is not 0 */
    size_t *pairs;          /* size + 1: e = left + right are the pairs from pairs[e] to pairs[e + 1] */
    uint32_t *left, *right;
    nh_residue *inverse; /* order + 1: of whole numbers */
    nh_arena *arena;
} nh_jet_ring;

/* The number of coefficients of a series; SIZE_MAX when there are more than `most`. */
size_t nh_jet_ring_size(size_t variables, const size_t *weight, size_t order, size_t most);

/* The ring of series up to the order, at most 255; the weights are copied. nh_jet_ring_free. */
nh_jet_ring *nh_jet_ring_create(nh_prime field, size_t variables, const size_t *weight, size_t order);
void nh_jet_ring_free(nh_jet_ring *ring);

/* The index of an exponent, which must be in the ring. */
size_t nh_jet_ring_find(const nh_jet_ring *ring, const uint8_t *exponent);

/* In the operations below `out` must not be an operand unless this is allowed. */
bool nh_jet_is_constant(const nh_jet_ring *ring, const nh_residue *a);
bool nh_jet_is_zero(const nh_jet_ring *ring, const nh_residue *a);
void nh_jet_constant(const nh_jet_ring *ring, nh_residue c, nh_residue *out);
void nh_jet_add_multiple(const nh_jet_ring *ring, nh_residue *sum, nh_residue c, const nh_residue *a); /* sum += c a */
void nh_jet_scale(const nh_jet_ring *ring, nh_residue *a, nh_residue c);                               /* a *= c */
void nh_jet_mul(const nh_jet_ring *ring, const nh_residue *a, const nh_residue *b, nh_residue *out);
/* sum += a b */
void nh_jet_add_product(const nh_jet_ring *ring, nh_residue *sum, const nh_residue *a, const nh_residue *b);
/* sum -= a b */
void nh_jet_sub_product(const nh_jet_ring *ring, nh_residue *sum, const nh_residue *a, const nh_residue *b);
/* out = da/dz_k, exact up to order - weight_k */
void nh_jet_derivative(const nh_jet_ring *ring, const nh_residue *a, size_t k, nh_residue *out);

/* Solve M x = b in place, M n x n and b n x count series, row by row: Gauss and Jordan.  M is destroyed.  False where
   it is singular at the point. */
bool nh_jet_solve(const nh_jet_ring *ring, size_t n, nh_residue *M, size_t count, nh_residue *b);

/* a^s with the constant term `at`; a must have one that is not 0.  s = -1: the reciprocal. */
void nh_jet_power(const nh_jet_ring *ring, const nh_residue *a, nh_residue s, nh_residue at, nh_residue *out);
/* exp(u - u(0)) times `at`. */
void nh_jet_exponential(const nh_jet_ring *ring, const nh_residue *u, nh_residue at, nh_residue *out);
/* sin(u) and cos(u) with these constant terms. */
void nh_jet_circle(const nh_jet_ring *ring, const nh_residue *u, nh_residue sine, nh_residue cosine, nh_residue *sin,
                   nh_residue *cos);
/* y with E(y) = slope E(u) and this constant term: y = f(u) where slope = f'(u). */
void nh_jet_integral(const nh_jet_ring *ring, const nh_residue *u, const nh_residue *slope, nh_residue at,
                     nh_residue *out);
/* The Euler field: (E a)_e = |e| a_e. */
void nh_jet_euler(const nh_jet_ring *ring, const nh_residue *a, nh_residue *out);
/* Its inverse on series without constant term, with this constant term added. */
void nh_jet_euler_inverse(const nh_jet_ring *ring, const nh_residue *a, nh_residue at, nh_residue *out);

#endif
