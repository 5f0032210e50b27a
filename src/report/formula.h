/* formula: how reports write the formulas of a result. */
#ifndef NH_FORMULA_H
#define NH_FORMULA_H

#include "study/result.h"

/* e with the user's own abbreviations, from the analysis file, instead of what they stand for. */
nh_ex nh_formula_abbreviate(const nh_result *result, nh_ex e);

/* The symmetry of a current as a sum of coefficients along basis fields: d/dt, d/dq, d/dx' of the chart of coordinate velocities (or of the only
 * one); or along Gamma first and then the rest, where that is much shorter.  Terms that vanish are left out.  The list belongs to the model's
 * arena. */
typedef struct {
    nh_ex coefficient;
    const char *along; /* t, a coordinate or a velocity; NULL: Gamma */
} nh_field_term;
size_t nh_formula_field(const nh_result *result, const nh_symmetry *z, nh_field_term **out);

#endif
