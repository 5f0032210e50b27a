/* spans: spaces of functions by their values at sample points. */
#ifndef NH_SPANS_H
#define NH_SPANS_H

#include "integrals/points.h"

/* Values of `n` combinations (vector: terms x n) of expressions at the points, each centred and of norm 1; points x n
   (nh_free). */
double *nh_span_values(const nh_model *model, const nh_points *points, size_t terms, const nh_ex *e, size_t n,
                       const double *vector);
/* Largest distance of the columns of b (rows x nb, of norm 1) from the span of those of a (rows x na). */
double nh_span_distance(size_t rows, size_t na, const double *a, size_t nb, const double *b);

#endif
