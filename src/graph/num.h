/* num: the numbers of expressions. */
#ifndef NH_NUM_H
#define NH_NUM_H

#include "graph/expr.h"

nh_num nh_num_int(int64_t value);
nh_num nh_num_ratio(int64_t p, int64_t q);
nh_num nh_num_real(double value); /* exact when the double is a whole number below 2^53 */
/* The shortest decimal that rounds to the double: 0.1 is 1/10; or, where that has 14 digits or more, a ratio with a
   denominator up to 1000 that does: 1/3. */
nh_num nh_num_decimal(double value);
nh_num nh_num_add(nh_num a, nh_num b);
nh_num nh_num_mul(nh_num a, nh_num b);
nh_num nh_num_inv(nh_num a); /* of the rational 0: not-a-number */
nh_num nh_num_pow(nh_num a, int64_t n);
double nh_num_value(nh_num a);
static inline bool nh_num_is(nh_num a, int64_t p) { return a.q == 1 && a.p == p; }
bool nh_num_exact(nh_num a); /* is it a rational? */
/* is it a rational of 64 bits?  Then p and q can be used */
static inline bool nh_num_short(nh_num a) { return a.q > 0; }
bool nh_num_equal(nh_num a, nh_num b);
int64_t nh_gcd(int64_t a, int64_t b); /* not negative; the arguments are not INT64_MIN, as no p or q of a number is */

#endif
