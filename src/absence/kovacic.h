/* kovacic: the Galois group of y'' = r y over C(x), r in Q(x), by polynomials modulo one prime that do not exist.
 * [docs/method.md, "No other integral"] */
#ifndef NH_KOVACIC_H
#define NH_KOVACIC_H

#include "absence/linear_equation.h"
#include "base/json.h"

/* NH_GROUP_SL2 is proved.  NH_GROUP_TRIANGULAR: SL(2) or the triangular group of dimension 2, proved: not virtually
 * abelian.  NH_GROUP_OPEN: not refuted, which proves nothing.  NH_GROUP_UNDECIDED: not tried to the end. */
typedef enum { NH_GROUP_SL2, NH_GROUP_TRIANGULAR, NH_GROUP_OPEN, NH_GROUP_UNDECIDED } nh_kovacic_group;

/* Invariants of one degree m: a_m = prod (x - c)^lowest[c] P, deg P <= degree. */
typedef struct {
    unsigned m;
    bool possible;   /* the exponents allow one; else nothing was to be computed */
    slong *lowest;   /* per pole */
    slong degree;    /* of P */
    slong solutions; /* dimension of the kernel modulo the prime; 0: absent, proved; -1: not computed */
} nh_kovacic_invariant;

enum { NH_KOVACIC_INVARIANTS = 4 }; /* of degree 4, 6, 8 and 12 */

/* What a checker needs to repeat the proof. */
typedef struct {
    nh_kovacic_group group;
    bool regular;              /* every singular point, infinity included, is regular */
    const char *obstacle;      /* of NH_GROUP_UNDECIDED and NH_GROUP_OPEN: the first, in words; else NULL */
    const char *r_num, *r_den; /* polynomials in x, as text */
    size_t num_length, den_length;
    const char **num, **den; /* their coefficients, lowest degree first */
    ulong prime;             /* not 0 where something is proved */
    size_t poles;
    ulong *pole; /* modulo the prime; NULL without one, as `root` */
    bool *double_pole;
    slong *order; /* per pole, then infinity: r ~ (x - c)^-order; at infinity r ~ x^-order, or 2 where it is smaller */
    ulong *root;  /* per pole, then infinity: a square root of 1 + 4 b, of double poles and where infinity is regular;
                     of the leading coefficient of r at irregular points of even order; else 0 */
    const char **exponent; /* per pole, then infinity: sqrt(1 + 4 b) as text, "2/3" or "0.8819"; "1", of a simple pole;
                              "irregular of order 4".  Conjugate poles are not in the order of `pole` */
    size_t degrees;        /* that Riccati's P may have */
    slong *degree_of_p;
    size_t sign_vectors; /* that were tried, each up to the largest degree */
    slong riccati;       /* solutions found modulo the prime, at most 2; 0: no invariant line, proved */
    nh_kovacic_invariant invariant[NH_KOVACIC_INVARIANTS];
} nh_kovacic;

/* Where an irregular point is, NH_GROUP_SL2 follows from Riccati's equation and degree 4 alone; NH_GROUP_TRIANGULAR is
 * for regular equations only.  Decides; all of the answer is in the arena.  The same for the same r, always. */
nh_kovacic *nh_kovacic_decide(nh_arena *arena, const fmpz_poly_t r_num, const fmpz_poly_t r_den);

/* Puts into the object what tests/check_certificate.py reads: r_num, r_den (coefficients as texts, lowest degree
 * first), prime, poles, roots, root_infinity, degrees, and invariants, each with m, lowest and degree. */
void nh_kovacic_certificate(nh_json *object, const nh_kovacic *kovacic);

/* "SL(2)", "triangular, of dimension 2, or SL(2)", "open", "undecided". */
const char *nh_kovacic_word(nh_kovacic_group group);

#endif
