/* benchmark_fit: the variables of the polynomials of the discrete problem. */
#ifndef NH_BENCHMARK_FIT_H
#define NH_BENCHMARK_FIT_H

#include "geometry/model.h"

/* Does a sine, a cosine or a tangent in the equations of motion depend on q? */
bool nh_fit_is_wave(const nh_model *model, nh_ex q);
/* The chart's velocities, sines and cosines of angles, and the other coordinates on which the equations depend, into
 * out (room for 3 m); returns their number. */
size_t nh_fit_letters(const nh_model *model, nh_ex *out);

#endif
