/* For the files of the series with parameters. */
#ifndef NH_PARAMETRIC_INTERNAL_H
#define NH_PARAMETRIC_INTERNAL_H

#include "classify/parametric.h"

/* The highest powers that these expressions are divided by, of functions of the parameter, which join the factors. */
void nh_parametric_denominators(nh_parametric *family, size_t n, const nh_ex *e, size_t *power);
/* det M of n x n series, which are destroyed; zero where it is singular at the point. */
void nh_parametric_determinant(const nh_jet_ring *ring, size_t n, nh_residue *M, nh_residue *out);

/* Of the motion at one value of each parameter: Q, then Q X_i, then Q w^l'. False: a singular one, or an obstacle. */
bool nh_parametric_motion(nh_parametric *family, const nh_jet_ring *ring, nh_residue *coordinate, nh_residue lambda,
                          nh_residue mu, nh_residue *out);

/* The same for a linear family (parametric_linear.c). */
void nh_parametric_linear_open(nh_parametric *family);
size_t nh_parametric_linear_length(const nh_parametric *family, const nh_jet_ring *ring);
bool nh_parametric_linear_value(nh_parametric *family, nh_parametric_series *series, nh_residue lambda, nh_residue mu,
                                nh_residue *out);

/* Q, Q X_i, Q w^l' at one value of each parameter.  False: a singular one, or an obstacle. */
bool nh_parametric_value(nh_parametric *family, nh_parametric_series *series, nh_residue lambda, nh_residue mu,
                         nh_residue *out);

/* The coefficients, without a common factor that depends on the parameters alone. False: as above, or an obstacle. */
bool nh_parametric_interpolate(nh_parametric *family, nh_parametric_series *series);

#endif
