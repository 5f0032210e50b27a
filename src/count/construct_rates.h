/* construct_rates: exponentials and waves in cyclic coordinates that integrals contain.
 *
 * The equations do not change along a cyclic coordinate y, so d/dy maps the space of integrals of one degree into
 * itself:
 *
 *     d c_s/dy = sum_t A_ts c_t,      det(A - lambda) = 0
 *
 * A real eigenvalue lambda gives coefficients exp(lambda y) times functions of the others, a pair +-i omega gives
 * cos(omega y) and sin(omega y); 0 gives polynomials in y, of degree 0 where A's minimal
 * polynomial has no square factor.  A is computed from the power series of the solutions, modulo
 * a prime, and once more with random residues for the parameters: a monomial in these that equals omega^2 both times,
 * as 4 k/m, is its formula.  Else rates are found that are short fractions, or whose squares are.  Where A is 0 no
 * integral depends on y. */
#ifndef NH_CONSTRUCT_RATES_H
#define NH_CONSTRUCT_RATES_H

#include "geometry/model.h"

enum { NH_MOST_CONSTRUCT_RATES = 16 };

/* lambda, or omega > 0 of a wave, is rate*unit. */
typedef struct {
    nh_ex coordinate;
    nh_num rate;
    nh_ex unit; /* of numbers and parameters */
    bool root;  /* the unit has a square root, which the equations do not contain */
    bool wave;
} nh_construct_rate;

typedef struct nh_construct_rates {
    size_t count;
    nh_construct_rate item[NH_MOST_CONSTRUCT_RATES];
    size_t idle; /* cyclic coordinates on which no integral of the degree depends */
    nh_ex idle_coordinate[NH_MOST_CONSTRUCT_RATES];
    size_t pure; /* cyclic coordinates of which no power occurs in them, only exponentials and waves */
    nh_ex pure_coordinate[NH_MOST_CONSTRUCT_RATES];
    /* The words contain cyclic coordinates only by these rates, at no price, and roots of the inertia; else the rates
     * are letters like others. */
    bool only;
    double work; /* products of residues that were used */
} nh_construct_rates;

/* lambda or omega times the coordinate. */
nh_ex nh_construct_rate_argument(nh_dag *dag, const nh_construct_rate *rate);

/* The rates of the integrals of a degree, with coefficients in t, too, where `time`; written by `atom`, expressions of
 * the parameters, as far as possible.  There are none without a cyclic coordinate, on leaves, or where the work does
 * not suffice. */
nh_construct_rates nh_construct_rates_of(const nh_model *model, size_t degree, bool time, size_t atoms,
                                         const nh_ex *atom, double work);

#endif
