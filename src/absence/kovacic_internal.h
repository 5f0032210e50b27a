/* kovacic_internal: what the parts of kovacic.c share.
 *
 * At a pole c of r write t = x - c, at infinity t = x.  A solution whose logarithmic derivative is rational begins with
 *
 *     exp(sign int [sqrt r]) t^e,   e = half/2 + sign weight
 *
 *     pole of order 1         half 2, weight 0                  r = b/t + ..: the other exponent, 0, has a logarithm
 *     pole of order 2         half 1, weight sqrt(1 + 4 b)/2    r = b/t^2 + ..
 *     pole of order 2k > 2    half k, weight S_(k-1)            sqrt(r) = t^-k (S_0 + S_1 t + ..)
 *     infinity, o >= 2        half 1, weight sqrt(1 + 4 b)/2    r = b/x^2 + ..
 *     infinity, o = -2j < 2   half -j, weight S_(j+1)           sqrt(r) = x^j (S_0 + S_1/x + ..)
 *
 * and [sqrt r] is t^-k (S_0 + .. + S_(k-2) t^(k-2)), at infinity S_0 x^j + .. + S_j.  These are Kovacic's. */
#ifndef NH_KOVACIC_INTERNAL_H
#define NH_KOVACIC_INTERNAL_H

#include <flint/nmod_poly.h>

#include "absence/kovacic.h"
#include "evaluate/arb.h"

/* most_degree: of a polynomial that is to be excluded.  most_poles: of r, with all that belongs to them. */
enum { nh_kovacic_most_degree = 400, nh_kovacic_most_poles = 60 };

/* All roots of an irreducible factor of the denominator, or infinity. */
typedef struct {
    fmpz_poly_t factor; /* primitive; 1 at infinity */
    slong order;        /* of the poles of r; at infinity o, r ~ x^-o, and 2 for every o >= 2 */
    bool irregular;
    bool constant; /* order 2: 1 + 4 b is the same rational number at all of them */
    fmpq_t square; /* that number */
    bool rational; /* it is the square of `root` */
    fmpq_t root;
    slong half;
} nh_kovacic_place;

typedef struct {
    nh_arena *arena;
    fmpz_poly_t num, den; /* r, reduced */
    size_t places;        /* finite ones; place[places] is infinity */
    nh_kovacic_place *place;
    size_t poles;
    size_t *at;     /* the place of each pole, then of infinity */
    acb_ptr weight; /* per pole, then infinity */
    bool odd;       /* an irregular point has odd order: no invariant line exists */
    /* modulo the prime */
    ulong prime; /* 0: not yet */
    ulong *pole;
    ulong *root; /* per pole, then infinity: of 1 + 4 b; of the leading coefficient of r at irregular ones */
} nh_kovacic_problem;

/* In characteristic 0.  r is not 0 and has at most most_poles poles. */
void nh_kovacic_problem_begin(nh_kovacic_problem *problem, nh_arena *arena, const fmpz_poly_t num,
                              const fmpz_poly_t den);
void nh_kovacic_problem_end(nh_kovacic_problem *problem);
/* The degrees that the polynomial of Riccati's equation may have, and the exponents' texts.  False: with obstacle. */
bool nh_kovacic_degrees(nh_kovacic_problem *problem, nh_kovacic *out);
/* What is said where they are too large. */
const char *nh_kovacic_large(nh_arena *arena);
/* lowest, degree and possible of an invariant; the degree is over most_degree where numbers are too large. */
void nh_kovacic_bounds(const nh_kovacic_problem *problem, nh_kovacic_invariant *invariant);

/* The smallest suitable prime after `after`; fills prime, pole and root.  False: none was found. */
bool nh_kovacic_prime_find(nh_kovacic_problem *problem, ulong after);
/* 1 + 4 b, or the leading coefficient of r, at pole i (infinity: i = poles) modulo the prime. */
ulong nh_kovacic_prime_square(const nh_kovacic_problem *problem, size_t i);
/* `terms` terms of the series of t^order r at pole i, at infinity those of x^o r in 1/x. */
void nh_kovacic_prime_series(const nh_kovacic_problem *problem, size_t i, slong terms, nmod_poly_t out);

/* Solutions of Riccati's equation modulo the prime, at most 2.  False: with obstacle. */
bool nh_kovacic_riccati(const nh_kovacic_problem *problem, nh_kovacic *out);
/* The kernel of a possible invariant. */
void nh_kovacic_invariant_find(const nh_kovacic_problem *problem, nh_kovacic_invariant *invariant);

/* nh_kovacic_decide with the smallest suitable prime after `after` >= 12. */
nh_kovacic *nh_kovacic_decide_after(nh_arena *arena, const fmpz_poly_t r_num, const fmpz_poly_t r_den, ulong after);

#endif
