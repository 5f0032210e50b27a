/* reduction_sheet_internal: what the files reduction_sheet*.c share. */
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

/* the name of shape coordinate i */
const char *nh_reduction_sheet_x(const nh_reduction_builder *b, const nh_slice *slice, size_t i);
void nh_reduction_sheet_frame(const nh_reduction_builder *b, const nh_slice *slice);
/* A (d x n), and the lifts */
void nh_reduction_sheet_lift(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *A, const char *letter);
void nh_reduction_sheet_curvature(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *B,
                                  const char *letter);
void nh_reduction_sheet_symmetric(const nh_reduction_builder *b, const nh_slice *slice, const nh_ex *e,
                                  const char *letter);
void nh_reduction_sheet_kinetic(const nh_reduction_builder *b, const nh_ex *K); /* 1/2 x' K x', terms of a sum */
/* label = 1/2 p K^-1 p + 1/2 theta I^-1 theta + V; locked = I^-1, or NULL. */
void nh_reduction_sheet_hamiltonian(const nh_reduction_builder *b, const char *label, const nh_ex *inverse,
                                    const nh_ex *locked, nh_ex V);
/* A second stage. */
void nh_reduction_sheet_second(nh_reduction_builder *b, const nh_second *second, const nh_reduction_theory *theory);
/* The whole group by stages along a chain, with an inner product g0 on the algebra (d x d, or NULL: orthonormal
 * generators). */
void nh_reduction_sheet_stages(const nh_reduction_builder *b, const nh_lagrange_poincare *l, const nh_ideals *chain,
                               const nh_ex *inner);

#endif
