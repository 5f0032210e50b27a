/* construct_rates: exponentials and waves in cyclic coordinates that integrals contain.
 *
 * The equations do not change along a cyclic coordinate y, so d/dy maps the space of integrals of one degree into
 * itself:
 *
 *     d c_s/dy = sum_t A_ts c_t,      det(A - lambda) = 0
 *
 * A real eigenvalue lambda gives coefficients exp(lambda y) times functions of the others, a pair +-i omega gives
 * cos(omega y) and sin(omega y); 0 gives polynomials in y.  A is computed from the power series of the solutions, modulo
 * a prime: rates that are short fractions are found.  Where A is 0 no integral depends on y. */
#ifndef NH_CONSTRUCT_RATES_H
#define NH_CONSTRUCT_RATES_H

#include "geometry/model.h"

enum { NH_MOST_CONSTRUCT_RATES = 16 };

typedef struct {
    nh_ex coordinate;
    nh_num rate; /* lambda, or omega > 0 of a wave */
    bool wave;
} nh_construct_rate;

typedef struct nh_construct_rates {
    size_t count;
    nh_construct_rate item[NH_MOST_CONSTRUCT_RATES];
    size_t idle; /* cyclic coordinates on which no integral of the degree depends */
    nh_ex idle_coordinate[NH_MOST_CONSTRUCT_RATES];
    double work; /* products of residues that were used */
} nh_construct_rates;

/* The rates of the integrals of a degree, with coefficients in t, too, where `time`.  There are none without a cyclic
 * coordinate, on leaves, or where the work does not suffice. */
nh_construct_rates nh_construct_rates_of(const nh_model *model, size_t degree, bool time, double work);

#endif
