/* linear_pencil: the equations of a linear family as a linear system for Taylor coefficients. */
#ifndef NH_LINEAR_PENCIL_H
#define NH_LINEAR_PENCIL_H

#include "classify/parametric.h"

/* The linear system for every value, with entries on the heap; false where it has more than `most` unknowns. */
bool nh_linear_pencil(const nh_parametric *family, const nh_parametric_series *series, size_t level, size_t most,
                      nh_sparse_pencil *out);

/* P at one value, at which the coefficients are `values`; false: it would take more work than `most`. */
bool nh_linear_dimension(const nh_parametric *family, const nh_parametric_series *series, const nh_residue *values,
                         size_t level, double most, size_t *out);

#endif
