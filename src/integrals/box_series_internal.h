/* box_series_internal: exponents, for the files of box_series. */
#ifndef NH_BOX_SERIES_INTERNAL_H
#define NH_BOX_SERIES_INTERNAL_H

#include "integrals/box_series.h"

/* |alpha| */
size_t nh_box_order(size_t n, const unsigned char *alpha);

/* Lists the exponents of n variables with |alpha| = degree, degree - step, ..; powers of the first variables come
 * first.  `out` (number of exponents x n) may be NULL.  The result is their number. */
size_t nh_box_exponents(size_t n, size_t degree, size_t step, unsigned char *out);

#endif
