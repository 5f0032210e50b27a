/* For the files of the series with parameters. */
#ifndef NH_PARAMETRIC_INTERNAL_H
#define NH_PARAMETRIC_INTERNAL_H

#include "classify/parametric.h"

/* The highest powers of functions of the parameter that these expressions are divided by join the factors. */
void nh_parametric_denominators(nh_parametric *family, size_t n, const nh_ex *e, size_t *power);
/* Does one of these expressions depend on a parameter? */
bool nh_parametric_depends(const nh_parametric *family, size_t n, const nh_ex *e);
/* sum := sum times factor, for series; `work` has room for one. */
void nh_parametric_times(const nh_jet_ring *ring, nh_residue *sum, const nh_residue *factor, nh_residue *work);
/* det M for an n x n matrix of series, which is destroyed; zero where M is singular at the point. */
void nh_parametric_determinant(const nh_jet_ring *ring, size_t n, nh_residue *M, nh_residue *out);

/* Gives the parameters their residues. */
void nh_parametric_set(nh_parametric *family);

/* For the motion at the residues of the parameters: Q, then Q X_i, then Q w^l'.  False: the value is singular, or there
 * is an obstacle. */
bool nh_parametric_motion(nh_parametric *family, const nh_jet_ring *ring, nh_residue *coordinate, nh_residue *out);

/* The same for a linear family (parametric_linear.c). */
void nh_parametric_linear_open(nh_parametric *family);
size_t nh_parametric_linear_length(const nh_parametric *family, const nh_jet_ring *ring);
bool nh_parametric_linear_value(nh_parametric *family, nh_parametric_series *series, nh_residue *out);
/* Q alone, at the values that the parameters have. */
bool nh_parametric_linear_multiplier(nh_parametric *family, const nh_jet_ring *ring, nh_residue *out);

/* Q, Q X_i, Q w^l' at the residues of the parameters.  False: the value is singular, or there is an obstacle. */
bool nh_parametric_value(nh_parametric *family, nh_parametric_series *series, nh_residue *out);

/* The coefficients, with common factors that depend on the parameters alone divided out.  False: as above. */
bool nh_parametric_interpolate(nh_parametric *family, nh_parametric_series *series);

#endif
