/* num_long: rationals too long for 64 bits.
 *
 * They occur when equations of motion are solved symbolically, because a product of decimals has as many digits as both
 * together.  If they were rounded some certificates would be lost (a rate that cancels to 16 digits proves nothing).
 * Equal ones are kept once, for the life of the process, so that a nh_num remains a plain value; past a limit of length
 * or number they become doubles after all. */
#ifndef NH_NUM_LONG_H
#define NH_NUM_LONG_H

#include <gmp.h>

#include "base/text.h"
#include "graph/expr.h"

/* The number as a nh_num: p/q where it fits into 64 bits, a double past the limits.  Thread-safe. */
nh_num nh_num_of_mpq(const mpq_t value);

/* The value of an exact number. */
void nh_num_get_mpq(mpq_t out, nh_num a);

/* How a number is written: `*top` over `*bottom`, two whole numbers; a double, and a long number that is a short
 * decimal or would fill the line, is written in one piece, over 1. */
void nh_num_split(nh_num a, nh_num *top, nh_num *bottom);

/* Adds one part to `out`: digits, or the double. */
void nh_num_write(nh_num piece, nh_text *out);

/* A whole number of any length from its digits. */
nh_num nh_num_of_digits(const char *digits, size_t count);

#endif
