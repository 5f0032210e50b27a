/* classify: at which values of a parameter does a system have more integrals polynomial in the velocities than for
 * almost all?
 *
 * A(lambda) is the linear system Gamma(Phi) = 0 up to an order r at a point and modulo a prime (count.h), N = columns -
 * rank for almost all lambda. Where its rank is the full one the number of integrals is at most N: so special values
 * are roots of the product chi of the elementary divisors of A (staircase.h), modulo every prime and at every point
 * [docs/method.md, sec. 11]. Roots common to two points are lifted from several primes (special_values.h), and the
 * integrals are counted at each.
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
    size_t parameter;        /* its index; the model has no other, but for */
    bool two;
    size_t second;           /* where there are two; with bottom > 0 it is held at top/bottom */
    int64_t top, bottom;
    bool three;
    size_t third;            /* where there are three: at which ratio it is held; bottom == 0: the search says */
    int64_t third_top, third_bottom;
    size_t planes;           /* with three, the height of nu whose planes are looked at one after another */
    size_t plane;            /* with two, the largest determinant; beyond it */
    size_t lines;            /* the height of mu whose lines are looked at one after another */
    bool shape;              /* coefficients do not depend on cyclic coordinates */
    const nh_linear_family *linear; /* its solutions are counted instead of integrals, its levels are the degrees; or
                              * NULL */
    size_t degree;           /* up to which */
    double work;             /* products of residues that one count may take */
    double products;         /* of residues that looking for the values of one degree may take */
    size_t theorem;          /* most primes of a proof that leaves out no number */
    size_t unknowns;         /* of the largest linear system */
    size_t known;
    const nh_ex *current;    /* integrals for all values */
} nh_classify_question;

/* How many integrals of a degree there are at most. */
typedef struct {
    size_t bound, order, rank; /* N with the constant 1; r; of their differentials at a point */
    bool counted, bounded, settled;
} nh_classify_number;

typedef struct {
    nh_special_factor polynomial; /* whose roots the values are */
    bool degenerate;         /* the equations mean nothing there: det M or what they are divided by is zero at every
                              * point */
    size_t first;            /* the lowest degree at which there are more integrals than for almost all values; 0:
                              * none */
    size_t open;             /* the lowest degree at which this was not decided; 0: none */
    nh_classify_number number[NH_COUNT_HIGHEST_DEGREE + 1]; /* by degree */
} nh_classify_value;

typedef struct {
    nh_classify_number number; /* for almost all values */
    size_t known;            /* independent products of known integrals, with 1 */
    size_t unknowns, power;  /* of the linear system; its degree in the parameter */
    size_t roots;            /* of chi, common to the points: without degenerate ones, how many of them */
    bool lifted;             /* they are numbers that are known; otherwise only modulo the primes */
    size_t primes;
    uint64_t prime[NH_CLASSIFY_MOST_PRIMES];
    double height;           /* no other rational number with numerator and denominator up to this is special; 0: not
                              * lifted, here or at a lower degree */
    size_t nullity;          /* of the equations for the integrals with this degree's parity, where they have one */
    bool split;              /* they have */
    double bits;             /* special values divide numbers of so many bits (special_bound.h); 0: not known */
    size_t theorem_primes;   /* so many exclude every other complex number; */
    bool theorem;            /* they were tried, here and for the other parity */
    nh_classify_number infinite; /* in the limit, where there is one */
} nh_classify_row;

typedef struct {
    size_t rows, values, capacity;
    nh_classify_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    nh_classify_value *value; /* special and degenerate ones, and numbers where A loses rank although there are not more
                               * integrals (first == 0) */
    size_t step;
    bool limit;              /* the equations have a limit as the parameter goes to infinity */
    const char *obstacle;    /* why nothing was done, or NULL */
    const char *end;         /* why no higher degree was reached, or NULL */
} nh_classification;

/* Degree after degree, up to that of the question or to a limit (`end`).  Never NULL: what cannot be classified has an
 * `obstacle`.  The caller frees it.  [docs/method.md, sec. 11] */
nh_classification *nh_classify(const nh_model *model, const nh_classify_question *question);
/* Nothing was done. */
nh_classification *nh_classification_refused(const char *obstacle);
void nh_classification_free(nh_classification *classification);

#endif
