/* A fraction from residues: Chinese remainders for all primes but the last give x modulo their product m; Euclid's
 * algorithm for x and m, stopped half way, gives a/b = x (mod m) with a and b below the root of m/2, the only such
 * fraction; the last prime, which has no part in this, checks it. */
#include "exact/fraction.h"

bool nh_fraction_of(size_t primes, const nh_prime *prime, const nh_residue *residue, fmpq_t out)
{
    fmpz_t x, m;
    fmpz_init_set_ui(x, residue[0]);
    fmpz_init_set_ui(m, prime[0].p);
    for (size_t i = 1; i + 1 < primes; i++) {
        fmpz_CRT_ui(x, x, m, residue[i], prime[i].p, 0);
        fmpz_mul_ui(m, m, prime[i].p);
    }
    bool good = fmpq_reconstruct_fmpz(out, x, m);
    if (good) {
        nh_prime last = prime[primes - 1];
        nh_residue top = (nh_residue)fmpz_fdiv_ui(fmpq_numref(out), last.p),
                   bottom = (nh_residue)fmpz_fdiv_ui(fmpq_denref(out), last.p);
        good = bottom && nh_residue_mul(last, residue[primes - 1], bottom) == top;
    }
    fmpz_clear(m);
    fmpz_clear(x);
    return good;
}
