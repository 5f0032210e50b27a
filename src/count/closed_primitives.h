/* closed_primitives: antiderivatives of the roots and denominators that a system's equations have (closed_letters.h).
 *
 * A rolling body has x' = r w, and w may be a constant over sqrt(a + c cos(h)^2): so integrals over a coordinate occur
 * in the constants of a motion. */
#ifndef NH_CLOSED_PRIMITIVES_H
#define NH_CLOSED_PRIMITIVES_H

#include "geometry/model.h"

/* Writes functions with these derivatives: 1/z and 1/sqrt(a + b z + c z^2) by z, where z is a coordinate, a sine or a
 * cosine and the powers occur; z^k/sqrt(a + b z^n) by z, n up to 8; 1/sqrt(a - b sin(u)^2) and this root by u; sine and
 * cosine themselves.  `time`: time counts as a coordinate.  Returns how many, at most `most`. */
size_t nh_closed_primitives(const nh_model *model, bool time, size_t most, nh_ex *out);

#endif
