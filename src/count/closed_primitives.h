/* closed_primitives: antiderivatives of the roots and denominators that a system's equations have (closed_letters.h).
 *
 * What rolls has x' = r w, and w may be a constant over sqrt(a + c cos(h)^2): integrals along a coordinate enter the
 * constants of a motion. */
#ifndef NH_CLOSED_PRIMITIVES_H
#define NH_CLOSED_PRIMITIVES_H

#include "geometry/model.h"

/* Functions of which the derivatives by z are 1/z and 1/sqrt(a + b z + c z^2), where z is a coordinate, a sine or a
 * cosine and the powers are there; by z^k/sqrt(a + b z^n), n up to 8; of 1/sqrt(a - b sin(u)^2) and of this root by u;
 * of a sine and a cosine themselves.  `time`: as one of the coordinates.  Returns how many, no more than `most`. */
size_t nh_closed_primitives(const nh_model *model, bool time, size_t most, nh_ex *out);

#endif
