/* classify: at which values of a parameter does a system have more integrals polynomial in the velocities than for
 * almost all?
 *
 * A(lambda) is the linear system Gamma(Phi) = 0 up to an order r at a point and modulo a prime (count.h), N = columns -
 * rank for almost all lambda.  Where its rank is this generic one the number of integrals is at most N: so special
 * values are roots of the product chi of the elementary divisors of A (staircase.h), modulo every prime and at every
 * point [docs/method.md, sec. 11].  Roots common to two points are lifted from several primes (special_values.h), and
 * the integrals are counted at each.
 *
 * Instead of integrals the solutions of a linear family can be counted (linear_family.h): then the numbers are P.
 *
 * What is proved: no transcendental number is special; a number that is special and not among the values (special,
 * degenerate or examined in vain) has, modulo each of the primes, the residue of one of them, or no residue. For
 * rationals up to a `height` this cannot be; for no number at all modulo as many primes as a bound demands
 * (special_bound.h). */
#ifndef NH_CLASSIFY_H
#define NH_CLASSIFY_H

#include "classify/parametric.h"
#include "classify/special_values.h"

enum { NH_CLASSIFY_MOST_PRIMES = 12 };

typedef struct {
    size_t parameter; /* index of lambda in the model */
    bool two;
    size_t second; /* index of mu where `two`; with bottom > 0 mu is held at top/bottom */
    int64_t top, bottom;
    bool three;
    /* index of nu where `three`; held at third_top/third_bottom, which the search sets when third_bottom == 0 */
    size_t third;
    int64_t third_top, third_bottom;
    size_t planes; /* where `three`: planes nu = a/b up to this height are examined one after another */
    size_t plane;  /* where `two`: the largest size of a determinant; beyond it lines are examined instead */
    size_t lines;  /* lines mu = a/b up to this height are examined */
    bool shape;    /* coefficients do not depend on cyclic coordinates */
    /* not NULL: its solutions are counted instead of integrals, and its levels are the degrees */
    const nh_linear_family *linear;
    size_t degree;   /* the highest degree */
    double work;     /* products of residues that one count may take */
    double products; /* products of residues that the search for the values of one degree may take */
    size_t theorem;  /* most primes of a proof that leaves out no number */
    size_t unknowns; /* size of the largest linear system */
    size_t known;
    const nh_ex *current; /* integrals that hold for every value */
} nh_classify_question;

/* An upper bound for the number of integrals of one degree. */
typedef struct {
    /* bound: N, the constant 1 included; order: r; rank: of the integrals' differentials at a point */
    size_t bound, order, rank;
    bool counted, bounded, settled;
} nh_classify_number;

typedef struct {
    nh_special_factor polynomial; /* the values are its roots */
    /* the equations are singular there: det M, or what they are divided by, vanishes at every point */
    bool degenerate;
    size_t first; /* the lowest degree at which there are more integrals than for almost all values; 0:
                              * none */
    size_t open;  /* the lowest degree at which this is undecided; 0: none */
    nh_classify_number number[NH_COUNT_HIGHEST_DEGREE + 1]; /* by degree */
} nh_classify_value;

typedef struct {
    nh_classify_number number; /* for almost all values */
    size_t known;              /* independent products of known integrals, with 1 */
    size_t unknowns, power;    /* size of the linear system, and its degree in the parameter */
    size_t roots;              /* number of roots of chi common to the points, degenerate ones excluded */
    bool lifted;               /* the roots are known as numbers; otherwise only modulo the primes */
    size_t primes;
    uint64_t prime[NH_CLASSIFY_MOST_PRIMES];
    /* no other rational number with numerator and denominator up to this is special; 0: the roots of this or of a lower
     * degree are not lifted */
    double height;
    /* generic nullity of the equations for the integrals with this degree's parity, where `split` */
    size_t nullity;
    bool split; /* integrals are even or odd in the velocities */
    /* an upper bound for the length of special values in bits (special_bound.h); 0: not known */
    double bits;
    size_t theorem_primes;       /* so many primes exclude every other complex number */
    bool theorem;                /* all of them were tried, for both parities */
    nh_classify_number infinite; /* for the parameter at infinity, where the equations have this limit */
} nh_classify_row;

typedef struct {
    size_t rows, values, capacity;
    nh_classify_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    /* special and degenerate values, and values where A loses rank although there are not more integrals (first ==
     * 0) */
    nh_classify_value *value;
    size_t step;
    bool limit;           /* the equations have a limit as the parameter goes to infinity */
    const char *obstacle; /* why nothing was classified, or NULL */
    const char *end;      /* why no higher degree was reached, or NULL */
} nh_classification;

/* Classifies degree after degree, up to the question's degree or to a limit (`end`).  Never NULL: what cannot be
 * classified has an `obstacle`.  The caller frees the result.  [docs/method.md, sec. 11] */
nh_classification *nh_classify(const nh_model *model, const nh_classify_question *question);
/* A classification with an obstacle and nothing else. */
nh_classification *nh_classification_refused(const char *obstacle);
void nh_classification_free(nh_classification *classification);

#endif
