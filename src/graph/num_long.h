/* num_long: rationals too long for 64 bits.
 *
 * They come up when equations of motion are solved symbolically: products of decimals need twice their digits.
 * Rounding them would cost certificates (a rate that cancels to 16 digits proves nothing).  Equal ones are kept once,
 * for the life of the process, so that a nh_num remains a plain value; past a limit of length or number they become
 * doubles after all. */
#ifndef NH_NUM_LONG_H
#define NH_NUM_LONG_H

#include <gmp.h>

#include "base/text.h"
#include "graph/dag.h"

/* The number as a nh_num: short where it fits, a double past the limits.  Thread-safe. */
nh_num nh_num_of_mpq(const mpq_t value);

/* The value of an exact number. */
void nh_num_get_mpq(mpq_t out, nh_num a);

/* How a number is written: `*top` over `*bottom`, whole numbers; a double, and a long one that is a short decimal or
 * would fill the line, stays in one piece over 1. */
void nh_num_split(nh_num a, nh_num *top, nh_num *bottom);

/* A piece: digits, or the double. */
void nh_num_write(nh_num piece, nh_text *out);

/* A whole number of any length from its digits. */
nh_num nh_num_of_digits(const char *digits, size_t count);

#endif
