/* For the files that compute with special surfaces as polynomials. */
#ifndef NH_SPECIAL_CURVES_INTERNAL_H
#define NH_SPECIAL_CURVES_INTERNAL_H

#include <flint/fmpz_mpoly.h>

#include "classify/special_curves.h"

/* Converts a polynomial in three variables.  False: a coefficient is too long for 64 bits. */
bool nh_special_surface_take(nh_special_surface *out, const fmpz_mpoly_struct *p, const fmpz_mpoly_ctx_t ctx);

#endif
