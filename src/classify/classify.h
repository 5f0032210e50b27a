/* classify: at which values of one, two or three parameters does a system have more integrals polynomial in the
 * velocities than for almost all?
 *
 * A(lambda) is the linear system Gamma(Phi) = 0 up to an order r at a point and modulo a prime (count.h), N = columns -
 * rank for almost all lambda.  Where its rank is this generic one the number of integrals is at most N: so special
 * values are zeros of polynomials, modulo every prime and at every point [docs/method.md, sec. 11]:
 *
 *     one parameter      the product chi of the elementary divisors of A (staircase.h) at two points: values
 *     lambda, mu         determinants of compressions at three points (staircase.h): curves, and isolated points,
 *                        whose mu is among the roots of a polynomial: a wall
 *     lambda, mu, nu     their sections at several nu: surfaces, and walls, cylinders over curves in mu and nu
 *
 * Zeros common to the points (common_zeros.h) are lifted from several primes and factored (special_values.h), and the
 * integrals are counted at each.  On a wall mu = a/b the system has one parameter less, lambda, and is classified.
 * Where determinants are too large lines mu = a/b are examined instead; of three parameters, planes nu = a/b are
 * examined for anything special besides sections of surfaces and walls (classify_sweep.c).  What is special within a
 * surface, or within a wall of three parameters, is another question, with one parameter less.
 *
 * Instead of integrals the solutions of a linear family can be counted (linear_family.h): then the numbers are P.
 *
 * What is proved: no transcendental number is special; values that are special and lie on none of the zeros (special,
 * degenerate or examined in vain) and on no wall have, modulo each of the primes, residues on one of them, or no
 * residues.  For rationals up to a `height` this cannot be; of one parameter for no number at all modulo as many primes
 * as a bound demands (special_bound.h).  Of three parameters this holds in the planes that were examined. */
#ifndef NH_CLASSIFY_H
#define NH_CLASSIFY_H

#include "classify/parametric.h"
#include "classify/special_values.h"

enum { NH_CLASSIFY_MOST_PRIMES = 12 };

typedef struct {
    size_t parameters;                    /* how many vary: 1 to NH_MOST_PARAMETERS */
    size_t parameter[NH_MOST_PARAMETERS]; /* indices of lambda, mu, nu in the model */
    /* the last ones may be held at top/bottom, where bottom > 0 */
    int64_t top[NH_MOST_PARAMETERS], bottom[NH_MOST_PARAMETERS];
    size_t plane;  /* of two: the largest size of a determinant; beyond it lines are examined instead */
    size_t lines;  /* lines mu = a/b up to this height are examined */
    size_t planes; /* of three: planes nu = a/b up to this height are examined one after another */
    bool shape;    /* coefficients do not depend on cyclic coordinates */
    /* not NULL: its solutions are counted instead of integrals, and its levels are the degrees */
    const nh_linear_family *linear;
    size_t degree;   /* the highest degree */
    double work;     /* products of residues that one count may take */
    double products; /* products of residues that the search for the zeros of one degree may take */
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

/* A value of one parameter, a curve of two, a surface of three. */
typedef struct {
    nh_special_factor polynomial; /* of which it has the zeros */
    /* the equations are singular there: det M, or what they are divided by, vanishes at every point */
    bool degenerate;
    size_t first; /* the lowest degree at which there are more integrals than for almost all values; 0: none */
    size_t open;  /* the lowest degree at which this is undecided; 0: none */
    nh_classify_number number[NH_COUNT_HIGHEST_DEGREE + 1]; /* by degree */
} nh_classify_special;

typedef struct {
    nh_classify_number number;        /* for almost all values */
    size_t known;                     /* independent products of known integrals, with 1 */
    size_t unknowns;                  /* size of the linear system, */
    size_t power[NH_MOST_PARAMETERS]; /* and its degrees in the parameters */
    bool lifted;                      /* the zeros are known as numbers; otherwise only modulo the primes */
    size_t primes;
    uint64_t prime[NH_CLASSIFY_MOST_PRIMES];
    /* no other rational numbers with numerators and denominators up to this are special; 0: the zeros of this or of a
     * lower degree are not lifted */
    double height;

    /* of one parameter: the number of roots of chi common to the points, degenerate ones excluded */
    size_t roots;
    /* generic nullity of the equations for the integrals with this degree's parity, where `split` */
    size_t nullity;
    bool split; /* integrals are even or odd in the velocities */
    /* an upper bound for the length of special values in bits (special_bound.h); 0: not known */
    double bits;
    size_t theorem_primes;       /* so many primes exclude every other complex number */
    bool theorem;                /* all of them were tried, for both parities */
    nh_classify_number infinite; /* for the parameter at infinity, where the equations have this limit */

    /* of more: degrees of the determinants, and values of the last parameter at which sections were taken */
    size_t size, sections;
    /* lines that were examined instead of determinants, or planes that were examined: `height` then covers pairs in the
     * planes in which nothing more was seen */
    size_t swept;
} nh_classify_row;

typedef struct nh_classification nh_classification;

/* Where something smaller may be special. */
typedef struct {
    nh_special_factor polynomial; /* in mu, of two parameters; in mu and nu, of three */
    /* of two parameters: the classification over lambda; NULL: mu is irrational, the line is a curve, or the run was
     * ended */
    nh_classification *within;
} nh_classify_wall;

/* A point that has more integrals than almost all points, and than almost all points of a curve on which it lies. */
typedef struct {
    size_t wall, value; /* one of the values that the classification within a wall found */
} nh_classify_point;

struct nh_classification {
    size_t rows, specials, walls, points, special_capacity, wall_capacity, point_capacity;
    nh_classify_row row[NH_COUNT_HIGHEST_DEGREE]; /* of degrees 1, 2, .. */
    /* special and degenerate ones, and ones where A loses rank although there are not more integrals (first == 0) */
    nh_classify_special *special;
    nh_classify_wall *wall;
    nh_classify_point *point; /* of two parameters */
    size_t step;
    bool limit;           /* of one parameter: the equations have a limit as it goes to infinity */
    const char *obstacle; /* why nothing was classified, or NULL */
    const char *end;      /* why no higher degree was reached, or NULL */
};

/* Classifies degree after degree, up to the question's degree or to a limit (`end`).  Never NULL: what cannot be
 * classified has an `obstacle`.  The caller frees the result.  [docs/method.md, sec. 11] */
nh_classification *nh_classify(const nh_model *model, const nh_classify_question *question);
/* A classification with an obstacle and nothing else. */
nh_classification *nh_classification_refused(const char *obstacle);
void nh_classification_free(nh_classification *classification);

#endif
