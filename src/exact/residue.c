/* Arithmetic modulo a prime of 31 bits; powers, inverses and the search for primes are FLINT's. */
#include "exact/residue.h"

#include <flint/nmod.h>
#include <flint/ulong_extras.h>

#include "base/clones.h"

static nh_prime prime_of(uint64_t n) { return (nh_prime){n, ((uint64_t)1 << 62) / n * n, ((uint64_t)1 << 62) / n}; }

nh_prime nh_prime_below(nh_prime f, uint64_t order)
{
    const uint64_t top = (uint64_t)1 << 31;
    uint64_t n = f.p ? f.p - (f.p + 1) % order : top - 1 - top % order + order;
    do {
        if (n < top / 2 + order) return (nh_prime){0};
        n -= order;
    } while (!n_is_prime(n));
    return prime_of(n);
}

nh_prime nh_prime_next(nh_prime f, uint64_t order)
{
    do f = nh_prime_below(f, order / n_gcd(order, 12) * 12);
    while (f.p && (f.p % 5 == 1 || f.p % 7 == 1));
    return f;
}

nh_prime nh_prime_with_units(size_t index)
{
    uint64_t n = ((uint64_t)1 << 31) + 5; /* 1 modulo 12 */
    for (size_t found = 0; found <= index; found++) {
        do n -= 12;
        while (!n_is_prime(n));
    }
    return prime_of(n);
}

nh_prime nh_prime_at(size_t index)
{
    nh_prime f = nh_prime_next((nh_prime){0}, 1);
    for (size_t found = 0; found < index; found++) f = nh_prime_next(f, 1);
    return f;
}

/* x modulo p, for x below 2 p: the smaller of x and x - p, which is taken modulo 2^32. */
static inline uint32_t once(uint32_t x, uint32_t p) { return x < x - p ? x : x - p; }

/* c x - floor(x quotient / 2^32) p with quotient = floor(2^32 c / p) is between 0 and 2 p (Shoup's multiplication). */
static inline uint32_t times(uint32_t c, uint32_t quotient, uint32_t x, uint32_t p)
{
    return once(c * x - (uint32_t)((uint64_t)quotient * x >> 32) * p, p);
}

static uint32_t quotient_of(nh_prime f, nh_residue c) { return (uint32_t)(((uint64_t)c << 32) / f.p); }

NH_CLONES static void add_multiple(uint32_t p, uint32_t quotient, size_t n, nh_residue *restrict y,
                                   const nh_residue *restrict x, nh_residue c)
{
    for (size_t i = 0; i < n; i++) y[i] = once(y[i] + times(c, quotient, x[i], p), p);
}

NH_CLONES static void scale(uint32_t p, uint32_t quotient, size_t n, nh_residue *y, nh_residue c)
{
    for (size_t i = 0; i < n; i++) y[i] = times(c, quotient, y[i], p);
}

void nh_residue_add_multiple(nh_prime f, size_t n, nh_residue *restrict y, const nh_residue *restrict x, nh_residue c)
{
    if (c) add_multiple((uint32_t)f.p, quotient_of(f, c), n, y, x, c);
}

void nh_residue_scale(nh_prime f, size_t n, nh_residue *y, nh_residue c)
{
    scale((uint32_t)f.p, quotient_of(f, c), n, y, c);
}

nh_residue nh_residue_of(nh_prime f, int64_t value)
{
    int64_t r = value % (int64_t)f.p;
    return (nh_residue)(r < 0 ? r + (int64_t)f.p : r);
}

nh_residue nh_residue_power(nh_prime f, nh_residue a, uint64_t exponent)
{
    nmod_t mod;
    nmod_init(&mod, f.p);
    return (nh_residue)nmod_pow_ui(a, exponent, mod);
}

nh_residue nh_residue_inverse(nh_prime f, nh_residue a) { return (nh_residue)n_invmod(a, f.p); }

bool nh_residue_ratio(nh_prime f, int64_t top, int64_t bottom, nh_residue *out)
{
    nh_residue below = nh_residue_of(f, bottom);
    if (below) *out = nh_residue_mul(f, nh_residue_of(f, top), nh_residue_inverse(f, below));
    return below != 0;
}

/* Euclid's algorithm for p and a, until the remainder is small enough. */
bool nh_residue_fraction(nh_prime f, nh_residue a, int64_t longest, int64_t *top, int64_t *bottom)
{
    int64_t r0 = (int64_t)f.p, r1 = a, t0 = 0, t1 = 1;
    while (2 * r1 * r1 >= (int64_t)f.p) {
        int64_t q = r0 / r1, r2 = r0 - q * r1, t2 = t0 - q * t1;
        r0 = r1, r1 = r2;
        t0 = t1, t1 = t2;
    }
    *top = t1 < 0 ? -r1 : r1;
    *bottom = t1 < 0 ? -t1 : t1;
    return 2 * t1 * t1 < (int64_t)f.p && *bottom <= longest && *top <= longest && *top >= -longest;
}

bool nh_residue_root(nh_prime f, nh_residue a, uint64_t order, nh_residue *root)
{
    for (; order % 2 == 0; order /= 2) { /* p = 3 modulo 4: exactly one of the two roots is a square again */
        nh_residue r = nh_residue_power(f, a, (f.p + 1) / 4);
        if (nh_residue_mul(f, r, r) != a) return false;
        a = r;
    }
    if (!a || n_gcd(order, f.p - 1) != 1) return false;
    *root = order == 1 ? a : nh_residue_power(f, a, n_invmod(order % (f.p - 1), f.p - 1));
    return true;
}

nh_residue nh_residue_random(nh_prime f, uint64_t *state)
{
    uint64_t z = *state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return (nh_residue)(1 + (z ^ z >> 31) % (f.p - 1));
}
