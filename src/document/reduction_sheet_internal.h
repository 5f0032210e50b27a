/* reduction_sheet_internal: what reduction_sheet.c, reduction_sheet_bundle.c and reduction_sheet_stages.c share. */
#ifndef NH_REDUCTION_SHEET_INTERNAL_H
#define NH_REDUCTION_SHEET_INTERNAL_H

#include "commands/reduce.h"
#include "document/sheet.h"
#include "graph/print.h"

typedef struct {
    nh_sheet *s;
    nh_dag *d;
    const nh_slice *slice; /* of the present stage */
} nh_reduction_builder;

const char *nh_reduction_sheet_x(const nh_reduction_builder *b, const nh_slice *slice, size_t i); /* the name of shape coordinate i */
void nh_reduction_sheet_frame(const nh_reduction_builder *b, const nh_slice *slice);
void nh_reduction_sheet_lift(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *A, const char *letter); /* A (d x n), and the lifts */
void nh_reduction_sheet_curvature(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *B, const char *letter);
void nh_reduction_sheet_symmetric(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *e, const char *letter);
/* The whole group at once; and by stages along a chain, with an inner product g0 on the algebra (d x d, or NULL: orthonormal generators). */
void nh_reduction_sheet_bundle(const nh_reduction_builder *b, const nh_lagrange_poincare *l);
void nh_reduction_sheet_stages(const nh_reduction_builder *b, const nh_lagrange_poincare *l, const nh_ideals *chain, const nh_ex *inner);

#endif
