/* polynomial_text: polynomials with rational coefficients in words. */
#ifndef NH_POLYNOMIAL_TEXT_H
#define NH_POLYNOMIAL_TEXT_H

#include <flint/fmpq_poly.h>
#include <flint/fmpz_poly.h>

#include "base/memory.h"

/* "x^3 - 7/5*x + 1", "0", in the arena. */
const char *nh_polynomial_text(nh_arena *arena, const fmpq_poly_t f, const char *variable);
const char *nh_polynomial_text_whole(nh_arena *arena, const fmpz_poly_t f, const char *variable);

#endif
