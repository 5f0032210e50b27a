/* real_where: for which values of the parameters, and for which motions, a formula is real.
 *
 * A formula that is proved for all parameters is so as an identity of analytic functions; sqrt(m l^2 - I) in it is real
 * for some of their values only, and sqrt(-E) for bound motions only. */
#ifndef NH_REAL_WHERE_H
#define NH_REAL_WHERE_H

#include "geometry/model.h"

enum { NH_MOST_REAL_WHERE = 8 };

/* The expressions below even roots and in logarithms of e that must be positive and need not be: they depend on
 * parameters alone, and have either sign although every parameter keeps its own; or they depend on the state, and have
 * either sign in the sampling box.  Writes them to out; returns how many. */
size_t nh_real_where(const nh_model *model, nh_ex e, nh_ex out[NH_MOST_REAL_WHERE]);

/* The divisors of e that depend on parameters alone and may vanish although every parameter keeps its sign: e means
 * nothing where one of them is zero.  Writes them to out; returns how many. */
size_t nh_real_where_divisors(const nh_model *model, nh_ex e, nh_ex out[NH_MOST_REAL_WHERE]);

#endif
