/* residue: whole numbers modulo a prime of 31 bits.
 *
 * Products of two residues fit into 62 bits, so sums of products are reduced by one conditional subtraction
 * (nh_residue_gather), and by a division only at the end.
 *
 * The primes are 11 modulo 12, and neither 1 modulo 5 nor modulo 7: roots of order 3, 5 and 7 exist and are unique,
 * square roots exist for half of the residues. */
#ifndef NH_RESIDUE_H
#define NH_RESIDUE_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef uint32_t nh_residue;

typedef struct {
    uint64_t p;
    uint64_t bound;   /* the largest multiple of p up to 2^62 */
    uint64_t inverse; /* floor(2^62 / p) */
} nh_prime;

/* The `index`-th such prime below 2^31, from above. */
nh_prime nh_prime_at(size_t index);
/* The next one below f (p = 0: the first) that is -1 modulo `order`: the circle x^2 + y^2 = 1 has p + 1 points, and
 * angles whose multiple is a full turn.  p = 0: there is none above 2^30. */
nh_prime nh_prime_next(nh_prime f, uint64_t order);

/* The largest prime below f (p = 0: below 2^31) that is -1 modulo `order`, of any class else.  p = 0 as above. */
nh_prime nh_prime_below(nh_prime f, uint64_t order);

/* The `index`-th prime that is 1 modulo 12: there -1 and -3 have square roots, which they have modulo none of the
 * others. For equations without roots: nh_residue_root needs the others. */
nh_prime nh_prime_with_units(size_t index);

static inline nh_residue nh_residue_add(nh_prime f, nh_residue a, nh_residue b)
{
    uint64_t s = (uint64_t)a + b;
    return (nh_residue)(s >= f.p ? s - f.p : s);
}

static inline nh_residue nh_residue_negative(nh_prime f, nh_residue a) { return a ? (nh_residue)(f.p - a) : 0; }

static inline nh_residue nh_residue_sub(nh_prime f, nh_residue a, nh_residue b)
{
    return nh_residue_add(f, a, nh_residue_negative(f, b));
}

/* Of x below 2^62: floor(floor(x / 2^30) floor(2^62 / p) / 2^32) is at most 2 below the quotient (Barrett's reduction),
   as p is above 2^30. */
static inline nh_residue nh_residue_reduce(nh_prime f, uint64_t x)
{
    uint64_t quotient = (x >> 30) * (uint32_t)f.inverse >> 32, r = x - quotient * (uint32_t)f.p;
    r = r >= 2 * f.p ? r - 2 * f.p : r;
    return (nh_residue)(r >= f.p ? r - f.p : r);
}

static inline nh_residue nh_residue_mul(nh_prime f, nh_residue a, nh_residue b)
{
    return nh_residue_reduce(f, (uint64_t)a * b);
}

/* sum + a b, for a sum below the bound; the caller reduces it by nh_residue_reduce at the end. */
static inline uint64_t nh_residue_gather(nh_prime f, uint64_t sum, nh_residue a, nh_residue b)
{
    sum += (uint64_t)a * b;
    return sum >= f.bound ? sum - f.bound : sum;
}

/* y += c x, componentwise. */
void nh_residue_add_multiple(nh_prime f, size_t n, nh_residue *restrict y, const nh_residue *restrict x, nh_residue c);
/* y *= c */
void nh_residue_scale(nh_prime f, size_t n, nh_residue *y, nh_residue c);

nh_residue nh_residue_of(nh_prime f, int64_t value);
nh_residue nh_residue_power(nh_prime f, nh_residue a, uint64_t exponent);
nh_residue nh_residue_inverse(nh_prime f, nh_residue a); /* of a residue that is not 0 */
/* False: the prime divides the denominator. */
bool nh_residue_ratio(nh_prime f, int64_t top, int64_t bottom, nh_residue *out);

/* a = top/bottom modulo the prime with |top| and bottom below sqrt(p/2) and at most `longest`, if there is such a
 * fraction: there is no second one (Wang, Guy and Davenport 1982). */
bool nh_residue_fraction(nh_prime f, nh_residue a, int64_t longest, int64_t *top, int64_t *bottom);

/* The root of this order, for orders whose odd part is prime to p - 1: for square roots the one that is a square
 * itself.  False when there is none, or a is 0. */
bool nh_residue_root(nh_prime f, nh_residue a, uint64_t order, nh_residue *root);

/* Random residues that follow from the state alone (SplitMix64); never 0. */
nh_residue nh_residue_random(nh_prime f, uint64_t *state);

#endif
