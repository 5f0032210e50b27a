/* adapted_frame: coordinates in which the fields of motion have weights.
 *
 * X_0, X_1, .., X_n have weight 1, their brackets 2, brackets with these 3, and so on, until they span everything at
 * the point, or the tangent space of a leaf where the constraints are integrable.  Coordinates linear in such a frame
 * have its weights; those of weight 3 and more are corrected [BellaicheRisler1996],
 *
 *     z_j = y_j + sum over |alpha| < w_j of h_j,alpha y^alpha,
 *
 * so that every X_i has order -1: then Gamma(Phi) = 0 can be solved weight by weight (graded_solver.h). */
#ifndef NH_ADAPTED_FRAME_H
#define NH_ADAPTED_FRAME_H

#include "count/jet_equations.h"

typedef struct {
    size_t index;            /* j */
    const uint8_t *exponent; /* alpha, over the kept coordinates */
    nh_residue coefficient;
} nh_frame_correction;

typedef struct {
    nh_jet_equations *equations;
    nh_arena *arena;
    size_t all, kept;      /* number of coordinates; of those along the leaf, which come first */
    size_t *weight;        /* kept */
    size_t step;           /* the largest weight */
    nh_residue *to, *from; /* all x all: q - q0 = to y, and its inverse */
    size_t corrections;
    nh_frame_correction *correction;
} nh_adapted_frame;

/* The frame at the chosen point of the equations.  NULL: another point is needed, or the equations have an obstacle. */
nh_adapted_frame *nh_adapted_frame_create(nh_jet_equations *equations);
void nh_adapted_frame_free(nh_adapted_frame *frame);

/* Only the leaf at the chosen point: the number of directions across it, and as many covectors along q (`coordinates`
 * components each, room for a square) that vanish on it.  False: another point is needed. */
bool nh_adapted_frame_across(nh_jet_equations *equations, size_t *across, nh_residue *covector);

/* Writes, in a ring with the frame's weights, the coordinates q as series in z (`all` of them) and the fields along z
 * (fields x kept). */
bool nh_adapted_frame_series(const nh_adapted_frame *frame, const nh_jet_ring *ring, nh_residue *coordinate,
                             nh_residue *field);

#endif
