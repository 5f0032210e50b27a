/* linear_pencil: the equations of a linear family as a linear system for Taylor coefficients. */
#ifndef NH_LINEAR_PENCIL_H
#define NH_LINEAR_PENCIL_H

#include "classify/parametric.h"

/* For every value: false where there are more than `most` unknowns. The entries are on the heap. */
bool nh_linear_pencil(const nh_parametric *family, const nh_parametric_series *series, size_t level, size_t most,
                      nh_sparse_pencil *out);

/* P at one value, at which the coefficients are `values`; false: more work than `most`. */
bool nh_linear_dimension(const nh_parametric *family, const nh_parametric_series *series, const nh_residue *values,
                         size_t level, double most, size_t *out);

#endif
