/* relative: null vectors of conditions, relative to the size of what they are conditions on.
 *
 *     A x = 0    with    |B x| = 1,        rows of A: conditions at places; rows of B: values there; columns: fields,
 *                one function each
 *
 * so that a combination of columns that nearly cancels is no null vector.  B's independent columns come from
 * integrals/basis.h. */
#ifndef NH_RELATIVE_H
#define NH_RELATIVE_H

#include "base/error.h"
#include "base/option.h"

typedef struct {
    size_t columns, conditions, values; /* rows of A, rows of B */
    size_t room, space;
    double *a, *b; /* row by row */
} nh_relative;

/* A new row of zeros; it moves when the next one is made. */
double *nh_relative_condition(nh_relative *relative);
double *nh_relative_value(nh_relative *relative);
/* Are there too few rows for so many columns? */
bool nh_relative_wants_more(const nh_relative *relative);
void nh_relative_clear(nh_relative *relative);

/* columns x count null vectors; the caller frees them.  The singular values on both sides of the cut, where they are
 * wanted.  NULL with a message when nothing could be evaluated anywhere. */
double *nh_relative_null(const nh_relative *relative, const nh_options *options, size_t *count, double *last_null,
                         double *first_other, nh_error *error);
/* The root mean square of each column of B. */
void nh_relative_sizes(const nh_relative *relative, double *size);

/* Reduced echelon form of `count` vectors of length n with the last columns of `order` as pivots; entries are compared
 * as v_j size_j, or as they are (size NULL), and small ones become zero. */
void nh_relative_echelon(size_t n, size_t count, const size_t *order, const double *size, double *v);

#endif
