/* For the files of the series with parameters. */
#ifndef NH_PARAMETRIC_INTERNAL_H
#define NH_PARAMETRIC_INTERNAL_H

#include "integrals/parametric.h"

/* Q, Q X_i, Q w^l' at one value of each parameter.  False: a singular one, or an obstacle. */
bool nh_parametric_value(nh_parametric *family, nh_parametric_series *series, nh_residue lambda, nh_residue mu,
                         nh_residue *out);

/* The coefficients, without a common factor that depends on the parameters alone. False: as above, or an obstacle. */
bool nh_parametric_interpolate(nh_parametric *family, nh_parametric_series *series);

#endif
